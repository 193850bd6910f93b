// audit/pictures.hpp
//
// Pictures of an audit: one layer from above, and smear over height.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "audit/audit.hpp"
#include "base/draw.hpp"

namespace cleancolor {

struct LayerPicture {
  double width_px = 900;
  bool legend = true;
};

/// A layer from above: roads of the part in the colours of their nozzles, as wide as they are, outer walls stronger
/// than the rest; auxiliary plastic pale; the way of every nozzle that touches while it idles as a thin line in its
/// colour, dashed while it travels; smears as discs of their colour with an area as their volume, holes as black rings
/// likewise; wipes as small ticks. Shows the plastic of the layer: ways beyond it are cut off at the border.
///
/// Requires: layer < print.layers.size(); scenario < result.scenarios.size().
/// Cost: linear in the moves from the layer's first to its last.
Canvas layer_picture(const GcodePrint& print, const AuditMachine& machine, const AuditResult& result,
                     std::size_t scenario, std::uint32_t layer, const LayerPicture& options = {});

/// Volume of each layer over its height.
struct HeightCurve {
  std::string name;
  Colour colour;
  std::vector<Vec2> points;  // x: z in mm, ascending; y: mm3 in the layer
};

/// One curve for the smears of each nozzle that leaves any, and one for all holes.
std::vector<HeightCurve> height_curves(const GcodePrint& print, const AuditMachine& machine, const AuditResult& result,
                                       std::size_t scenario);

/// Curves in one picture with axes and a legend; several audits where they are compared.
Canvas height_picture(std::span<const HeightCurve> curves, double width_px = 900);

/// The colour of a nozzle, dark enough to be seen on white.
Colour line_colour(const AuditMachine& machine, std::size_t nozzle);

}  // namespace cleancolor
