#include "viewer/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "audit/machine_texts.hpp"
#include "base/error.hpp"
#include "model/options.hpp"
#include "summary_json.hpp"

namespace cleancolor {
namespace {

using Json = nlohmann::ordered_json;

// In the order of Dialect.
constexpr std::array<std::string_view, 11> dialect_words = {"cleancolor", "prusaslicer", "superslicer", "slic3r",
                                                            "orcaslicer", "bambustudio", "cura",        "simplify3d",
                                                            "kisslicer",  "ideamaker",   "unknown"};

/// The value of an option in the configuration block; empty where there is none.
std::string_view told(const GcodePrint& print, std::string_view key) {
  for (const IniEntry& entry : print.facts.config)
    if (entry.key == key) return entry.value;
  return {};
}

/// What the action returns; nothing where the text is another slicer's, in words that we do not know.
template <class Action>
auto understood(const Action& action) -> std::optional<decltype(action())> {
  try {
    return action();
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// The outline of the bed: of the profile, else as the file tells it; empty where nothing does.
std::vector<Vec2> bed(const ReadPrint& read) {
  if (read.printer) return read.printer->bed_shape_mm;
  for (const char* key : {"bed_shape", "printable_area"}) {
    const std::string_view text = told(*read.print, key);
    const auto shape = understood([&] { return parse_option(*find_option("bed_shape"), text); });
    if (!text.empty() && shape) return std::get<std::vector<Vec2>>(*shape);
  }
  return {};
}

/// By nozzle; empty where nothing tells.
std::vector<std::string> filament_types(const ReadPrint& read) {
  const std::size_t count = read.machine->nozzles.size();
  const std::string_view text = told(*read.print, "filament_type");
  std::vector<std::string> types;
  if (!text.empty())
    types = understood([&] { return split_list(*find_option("filament_type"), text); }).value_or(types);
  else if (read.printer)
    for (const Extruder& e : read.printer->extruders) types.push_back(e.filament_type);
  types.resize(count);
  return types;
}

struct Weights {
  double part_mm3 = 0, auxiliary_mm3 = 0;
};

/// By nozzle. Plastic that stays where it is pushed belongs to no road: it is thrown away.
std::vector<Weights> weights(const ReadPrint& read) {
  std::vector<Weights> sums(read.machine->nozzles.size());
  for (std::size_t i = 0; i < read.print->moves.size(); ++i) {
    const GcodeMove& m = read.print->moves[i];
    const double pushed_mm3 = double(read.time->pushed_mm3[i]);
    if (!(pushed_mm3 > 0) || m.feeds >= sums.size()) continue;
    const bool part = (read.moves->flags[i] & move_flag::lays) && !is_auxiliary(m.role);
    (part ? sums[m.feeds].part_mm3 : sums[m.feeds].auxiliary_mm3) += pushed_mm3;
  }
  return sums;
}

Json nozzles(const ReadPrint& read) {
  const std::vector<std::string> types = filament_types(read);
  const std::vector<Weights> sums = weights(read);
  Json all = Json::array();
  for (std::size_t n = 0; n < read.machine->nozzles.size(); ++n) {
    const AuditNozzle& nozzle = read.machine->nozzles[n];
    const double g_mm3 = nozzle.filament_density_g_cm3 / 1000;
    all.push_back({{"offset_mm", {nozzle.offset_mm.x, nozzle.offset_mm.y}},
                   {"colour", fmt::format("#{:06X}", nozzle.rgb)},
                   {"filament", types[n]},
                   {"used", read.time->used[n] != 0},
                   {"part_g", sums[n].part_mm3 * g_mm3},
                   {"auxiliary_g", sums[n].auxiliary_mm3 * g_mm3}});
  }
  return all;
}

struct Boxes {
  Box<Vec3> all, part;
};

/// Of the plastic, roads with their width and height.
Boxes boxes(const ReadPrint& read) {
  Boxes boxes;
  const MoveArrays& m = *read.moves;
  for (std::size_t i = 1; i < m.flags.size(); ++i) {
    if (!(m.flags[i] & move_flag::lays)) continue;
    const GcodeMove& move = read.print->moves[i];
    const Vec2 offset = nozzle_offset_mm(*read.machine, move.feeds);
    const double half_mm = double(move.width_mm) / 2;
    const std::size_t first = m.flags[i] & move_flag::known_start ? i - 1 : i;
    for (std::size_t end = first; end <= i; ++end) {
      const Vec2 at = read.time->carriage_mm[end] + offset;
      for (Box<Vec3>* box : {&boxes.all, &boxes.part}) {
        if (box == &boxes.part && (m.flags[i] & move_flag::auxiliary)) continue;
        box->add({at.x - half_mm, at.y - half_mm, move.to_mm.z - double(move.height_mm)});
        box->add({at.x + half_mm, at.y + half_mm, move.to_mm.z});
      }
    }
  }
  return boxes;
}

Json box_json(const Box<Vec3>& box) {
  if (box.empty()) return nullptr;
  return {{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}};
}

/// candidates_deg: the angles that the curves are about, one by one.
Json azimuth_json(const Azimuths& azimuths) {
  Json json = azimuth_fields(azimuths);
  json["candidates_deg"] = Json::array();
  for (std::size_t deg = 0; deg < azimuths.exposure_s.size(); ++deg) json["candidates_deg"].push_back(deg);
  return json;
}

}  // namespace

Json print_summary(const ReadPrint& read) {
  const GcodePrint& print = *read.print;
  const Boxes plastic = boxes(read);
  Json outline = Json::array(), roles = Json::array();
  for (const Vec2 p : bed(read)) outline.push_back({p.x, p.y});
  for (int role = 0; role < role_count; ++role) roles.push_back(role_word(Role(role)));
  return {{"name", print.name},
          {"producer", print.facts.producer},
          {"dialect", dialect_words[std::size_t(print.facts.dialect)]},
          {"moves", print.moves.size()},
          {"layers", print.layers.size()},
          {"tools", print.tools},
          {"tool_changes", read.moves->tool_change_move.size()},
          {"print_time_s", read.time->print_time_s},
          {"travel_mm", read.time->travel_mm},
          {"nozzles", nozzles(read)},
          {"offsets_source", read.machine->offsets_source},
          {"idle_nozzle", idle_nozzle_word(read.machine->idle_nozzle)},
          {"bed_mm", outline},
          {"box_mm", box_json(plastic.all)},
          {"part_box_mm", box_json(plastic.part)},
          {"roles", roles},
          {"warnings", read.warnings},
          {"azimuth", read.azimuths ? azimuth_json(*read.azimuths) : Json()}};
}

}  // namespace cleancolor
