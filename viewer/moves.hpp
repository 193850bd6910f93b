// viewer/moves.hpp
//
// Every move of a print as arrays of numbers: what the page draws.
//
//   print, machine, timeline  ->  arrays, one value (or point) for each move; and what can be seen at the end
//
// The format and the meaning of each array: docs/viewer-api.md.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "audit/timeline.hpp"

namespace cleancolor {

namespace move_flag {
inline constexpr std::uint8_t lays = 1, known_start = 2, outermost = 4, tool_changed = 8, auxiliary = 16;
}

struct MoveArrays {
  std::vector<float> position;  // x, y, z of the tip in use
  std::vector<float> carriage;  // x, y of nozzle 0
  std::vector<float> end_s;
  std::vector<std::uint32_t> layer;
  std::vector<std::uint8_t> role, tool;
  std::vector<std::uint8_t> width, height;  // 0.01 mm
  std::vector<std::uint16_t> speed;         // 0.1 mm/s
  std::vector<float> pushed;                // mm3
  std::vector<std::uint8_t> flags;

  std::vector<float> layer_z, layer_height;     // by layer
  std::vector<std::uint32_t> tool_change_move;  // ascending
};

/// Same for any number of threads.  Cost: about 1 us of CPU a move, most of it to find what is outermost.
MoveArrays move_arrays(const GcodePrint& print, const AuditMachine& machine, const Timeline& time, int threads = 0);

/// The arrays as one binary answer.
std::string moves_file(const MoveArrays& moves);

/// "external_perimeter": the word of a role in the page and its API.
std::string_view role_word(Role role);

}  // namespace cleancolor
