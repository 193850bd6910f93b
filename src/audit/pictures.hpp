// audit/pictures.hpp
//
// Pictures of an audit: one layer from above, and smear over height.
#pragma once

#include <string>

#include "audit/audit.hpp"
#include "base/draw.hpp"

namespace cleancolor {

struct LayerPicture {
  double width_px = 900;
  bool legend = true;
};

/// A layer from above: roads of the part in the colours of their nozzles, as wide as they are; auxiliary plastic pale;
/// the way of every idle nozzle as a thin line in its colour, dashed while it travels; smears as discs of its colour
/// with an area as their volume; holes as black rings; wipes as small ticks. With a legend and a scale. Requires: layer
/// < print.layers.size(); scenario < result.scenarios.size().
Canvas layer_picture(const GcodePrint& print, const AuditMachine& machine, const AuditResult& result,
                     std::size_t scenario, std::uint32_t layer, const LayerPicture& options = {});

/// Smear volume (and hole volume) of every layer over its height, one curve a nozzle. Several audits in one picture
/// where files are compared: see report_html.
Canvas height_picture(const GcodePrint& print, const AuditMachine& machine, const AuditResult& result,
                      std::size_t scenario);

}  // namespace cleancolor
