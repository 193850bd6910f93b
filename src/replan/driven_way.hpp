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

  // After so many places:
  bool drawn_back = false;
  std::size_t back_after = 0;
  std::optional<std::size_t> rises_after, forward_after;
  bool pushes_at_change = false;
  std::optional<std::size_t> again_from;
  std::size_t again_after = 0;
  std::int64_t again_e5 = 0;  // drawn back once more after it was pushed forward

  double rise_mm = 0;   // above the layer
  double top_z_mm = 0;  // of the nozzle

  void drive_to(Vec3 to_mm, std::uint32_t under_state);
  void draw_back();

  /// The first places, which are no way to what comes.
  std::vector<FilePoint> leave(std::size_t count);

  /// A run that begins there, with the way to it; then there is no way any more.
  RecoveredRun leads_to(Vec3 begin_mm);

  /// The last place.  Requires: there is one.
  FilePoint take_last();
};

}  // namespace cleancolor
