#include "viewer/moves.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "audit/crossings.hpp"
#include "audit/exposed.hpp"
#include "base/parallel.hpp"
#include "viewer/array_file.hpp"

namespace cleancolor {
namespace {

constexpr std::uint32_t moves_per_block = 16384;

template <class T>
T clamped(double value) {
  return T(std::clamp(std::round(value), 0., double(std::numeric_limits<T>::max())));
}

/// When each move ends; what happens between two moves counts before the later one.
std::vector<float> ends_s(const GcodePrint& print, const Timeline& time) {
  std::vector<float> ends(print.moves.size());
  double now_s = 0;
  std::size_t e = 0;
  for (std::size_t i = 0; i < print.moves.size(); ++i) {
    for (; e < print.events.size() && print.events[e].before_move <= i; ++e) {
      now_s += double(time.jump_s[e]);
      if (print.events[e].kind == GcodeEvent::Kind::dwell) now_s += print.events[e].value;
    }
    now_s += double(time.duration_s[i]);
    ends[i] = float(now_s);
  }
  return ends;
}

/// What belongs to one move alone.
void fill_move(MoveArrays& arrays, const GcodePrint& print, const AuditMachine& machine, const Timeline& time,
               const Drive& drive) {
  const std::uint32_t i = drive.move;
  const GcodeMove& m = print.moves[i];
  const Vec2 tip = drive.to_mm + nozzle_offset_mm(machine, m.tool);
  arrays.position[3 * i] = float(tip.x);
  arrays.position[3 * i + 1] = float(tip.y);
  arrays.position[3 * i + 2] = float(m.to_mm.z);
  arrays.carriage[2 * i] = float(drive.to_mm.x);
  arrays.carriage[2 * i + 1] = float(drive.to_mm.y);
  arrays.layer[i] = m.layer;
  arrays.role[i] = std::uint8_t(m.role);
  arrays.tool[i] = m.tool;
  if (drive.lays) {
    arrays.width[i] = std::max<std::uint8_t>(1, clamped<std::uint8_t>(double(m.width_mm) * 100));
    arrays.height[i] = std::max<std::uint8_t>(1, clamped<std::uint8_t>(double(m.height_mm) * 100));
  }
  arrays.speed[i] = clamped<std::uint16_t>(double(m.speed_mm_s) * 10);
  arrays.pushed[i] = time.pushed_mm3[i];
  std::uint8_t flags = 0;
  if (drive.lays) flags |= move_flag::lays;
  if (drive.known && i > 0 && drive.from_mm == time.carriage_mm[i - 1]) flags |= move_flag::known_start;
  if (i > 0 && m.tool != print.moves[i - 1].tool) flags |= move_flag::tool_changed;
  if (is_auxiliary(m.role)) flags |= move_flag::auxiliary;
  arrays.flags[i] = flags;
}

/// Marks what can be seen when all is printed: visible roads of the part, and all that is laid beside it.
void mark_outermost(MoveArrays& arrays, const GcodePrint& print, const AuditMachine& machine, const Timeline& time,
                    int threads) {
  const LayerMoves layers = layer_moves(print, time);
  const auto roads = [&](std::size_t l) {
    return l < layers.ranges.size() ? layer_roads(print, machine, time, layers.ranges[l]) : LayerRoads{};
  };
  parallel_for(int(print.layers.size()), threads, [&](int l) {
    const LayerRoads layer = roads(std::size_t(l));
    const PartOutline above(roads(layers.above[std::size_t(l)]).roads);
    const std::vector<Exposure> exposed = exposures(layer.roads, PartOutline(layer.roads), above);
    for (std::size_t r = 0; r < exposed.size(); ++r)
      if (exposed[r].visible || is_auxiliary(layer.roads[r].role)) arrays.flags[layer.moves[r]] |= move_flag::outermost;
  });
}

}  // namespace

MoveArrays move_arrays(const GcodePrint& print, const AuditMachine& machine, const Timeline& time, int threads) {
  const std::size_t count = print.moves.size();
  MoveArrays arrays;
  arrays.position.resize(3 * count);
  arrays.carriage.resize(2 * count);
  arrays.end_s = ends_s(print, time);
  arrays.layer.resize(count);
  arrays.role.resize(count);
  arrays.tool.resize(count);
  arrays.width.resize(count);
  arrays.height.resize(count);
  arrays.speed.resize(count);
  arrays.pushed.resize(count);
  arrays.flags.resize(count);
  threads = thread_count(threads);
  const auto blocks = int((count + moves_per_block - 1) / moves_per_block);
  parallel_for(blocks, threads, [&](int block) {
    const std::uint32_t first = std::uint32_t(block) * moves_per_block;
    const auto last = std::uint32_t(std::min(count, std::size_t(first) + moves_per_block));
    for (const Drive& d : drives(print, machine, time, first, last))
      if (d.event == Drive::no_event) fill_move(arrays, print, machine, time, d);
  });
  mark_outermost(arrays, print, machine, time, threads);
  for (const GcodeLayer& layer : print.layers) {
    arrays.layer_z.push_back(float(layer.z_mm));
    arrays.layer_height.push_back(float(layer.height_mm));
  }
  for (std::size_t i = 0; i < count; ++i)
    if (arrays.flags[i] & move_flag::tool_changed) arrays.tool_change_move.push_back(std::uint32_t(i));
  return arrays;
}

std::string moves_file(const MoveArrays& m) {
  return array_file(std::array{
      named_array("position", m.position, 3), named_array("carriage", m.carriage, 2), named_array("end_s", m.end_s),
      named_array("layer", m.layer), named_array("role", m.role), named_array("tool", m.tool),
      named_array("width", m.width), named_array("height", m.height), named_array("speed", m.speed),
      named_array("pushed", m.pushed), named_array("flags", m.flags), named_array("layer_z", m.layer_z),
      named_array("layer_height", m.layer_height), named_array("tool_change_move", m.tool_change_move)});
}

std::string_view role_word(Role role) {
  constexpr std::array<std::string_view, role_count> words = {"external_perimeter",
                                                              "perimeter",
                                                              "overhang_perimeter",
                                                              "internal_infill",
                                                              "solid_infill",
                                                              "top_solid_infill",
                                                              "bridge_infill",
                                                              "gap_fill",
                                                              "skirt_brim",
                                                              "prime",
                                                              "rampart",
                                                              "ironing",
                                                              "support",
                                                              "support_interface",
                                                              "wipe_tower",
                                                              "refill",
                                                              "custom",
                                                              "unknown"};
  return words[std::size_t(role)];
}

}  // namespace cleancolor
