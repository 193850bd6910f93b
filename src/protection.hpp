// protection.hpp
//
// Protection: what keeps the colours of one print apart, made from its layers: the angle at which the parts stand, and
// the rampart around them.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "base/progress.hpp"
#include "model/config.hpp"
#include "orient/azimuth.hpp"
#include "plan/planner.hpp"
#include "shield/rampart.hpp"
#include "slice/slices.hpp"

namespace cleancolor {

/// The extruders that print something, ascending, and the last layer of each.
struct Use {
  explicit Use(const Slices& slices);
  /// Those whose nozzles are hot in a layer: that print in it or above, or all where heaters stay on.
  std::vector<int> hot(int layer, const Config& config) const;

  std::vector<int> extruders;
  std::vector<std::optional<int>> last_layer;  // by extruder
};

/// How the Error ends that tells of no room for the rampart.
inline constexpr std::string_view room_advice =
    "; move the part (--center), turn it (--rotate, --azimuth), make it smaller (--scale), or go without: --rampart "
    "off";

/// Conforming, vertical or off: what the print gets. Off for one extruder alone.
RampartShape rampart_shape(const Config& config, const Use& use);

/// The rampart of a print, up to the last layer in which an idle nozzle is hot.
class PrintedRampart {
 public:
  /// Throws Error where a wall would leave the area that all needed nozzles reach.
  PrintedRampart(const Slices& slices, const Use& use, const Config& config, int threads);
  /// Of some layers alone, each with the walls that it would have without the others, wherever nozzles reach.
  PrintedRampart(const Slices& slices, const Use& use, const Config& config, int threads,
                 std::span<const int> some_layers);

  bool empty() const { return rampart_.walls.empty(); }

  /// Walls of the layer, and their brim in the first one. A wall belongs to its own extruder where that prints in this
  /// layer, or is primed in it (the first); else to one that does, or is hot.
  std::vector<Path> paths(int layer) const;

  /// What the order must know of the layer.
  RampartSite site(int layer) const;

 private:
  RampartOptions options(int threads) const;
  void require_reach() const;

  const Slices& slices_;
  const Use& use_;
  const Config& config_;
  bool split_ = false;
  Rampart rampart_;
};

/// The extruders that print in each layer, ascending.
std::vector<std::vector<int>> printing_by_layer(const Slices& slices);

/// What the planner must know of a layer; every nozzle is taken to reach everything.
PlanScene plan_scene(const Slices& slices, const Use& use, const Config& config, const PrintedRampart& rampart,
                     int layer);

/// Both curves, and the best turn that leaves room for the rampart. center_mm: where the middle of the turned parts'
/// box will be; empty: of the area that all needed nozzles reach.
Azimuths azimuths_of_print(const Slices& slices, const Use& use, const Config& config, std::optional<Vec2> center_mm,
                           int threads);

}  // namespace cleancolor
