// replan/driven_way.hpp
//
// Driven way: what the carriage does between two roads of a file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.hpp"
#include "replan/recovered.hpp"

namespace cleancolor {

struct DrivenWay {
  std::vector<FilePoint> places;  // the last is where the next road begins
  std::vector<std::int64_t> z_um;
  bool rises = false;               // on the way, not on the spot
  std::vector<std::string> spiral;  // lines of a lift that goes round
  std::uint32_t state = 0;          // under which the way begins

  std::vector<FilamentMove> filament;
  bool drawn_back = false;
  std::size_t back_after = 0;  // so many places
  std::optional<std::size_t> rises_after;
  std::size_t fed_low = 0;  // of filament, moved before it rises

  double rise_mm = 0;   // above the layer
  double top_z_mm = 0;  // of the nozzle

  void drive_to(Vec3 to_mm, std::uint32_t under_state);
  void move_filament(std::int64_t by_e5);

  /// The first places, which are no way to what comes, with what is done there.
  void leave(std::size_t count, LeftWay& left);

  /// A run that begins there, with the way to it; then there is no way any more.
  RecoveredRun leads_to(Vec3 begin_mm);

  /// The last place.  Requires: there is one.
  FilePoint take_last();
};

}  // namespace cleancolor
