#include "replan/dialect_words.hpp"

namespace cleancolor {
namespace {

constexpr DialectWords prusaslicer = {.layer_begins = {";LAYER_CHANGE", ";BEFORE_LAYER_CHANGE"},
                                      .header_ends = {";HEIGHT:", ";Z:"},
                                      .own_type = ";TYPE:Skirt/Brim",
                                      .own_object = {},
                                      .elapsed = {}};

constexpr DialectWords superslicer = {.layer_begins = {";LAYER_CHANGE", ";BEFORE_LAYER_CHANGE"},
                                      .header_ends = {";HEIGHT:", ";Z:"},
                                      .own_type = ";TYPE:Skirt",
                                      .own_object = {},
                                      .elapsed = {},
                                      .of_ways = {"; acceleration to travel", "; decel to extrusion", "; end travel"}};

constexpr DialectWords orcaslicer = {.layer_begins = {";LAYER_CHANGE", ";BEFORE_LAYER_CHANGE"},
                                     .header_ends = {";HEIGHT:", ";Z:"},
                                     .own_type = ";TYPE:Skirt",
                                     .own_object = {},
                                     .elapsed = {},
                                     .tower = ";TYPE:Prime tower"};

constexpr DialectWords bambustudio = {.layer_begins = {"; CHANGE_LAYER", {}},
                                      .header_ends = {"; LAYER_HEIGHT:", "; Z_HEIGHT:"},
                                      .own_type = "; FEATURE: Skirt",
                                      .own_object = {},
                                      .elapsed = {},
                                      .width = "; LINE_WIDTH: ",
                                      .height = "; LAYER_HEIGHT: ",
                                      .wipe_begins = "; WIPE_START",
                                      .wipe_ends = "; WIPE_END",
                                      .tower = "; FEATURE: Prime tower"};

constexpr DialectWords cura = {.layer_begins = {";LAYER:", {}},
                               .header_ends = {},
                               .own_type = ";TYPE:SKIRT",
                               .own_object = ";MESH:NONMESH",
                               .elapsed = ";TIME_ELAPSED:",
                               .travel = "G0",
                               .tells_sizes = false,
                               .zeroes_e = false,
                               .rises_before_layer = true,
                               .begins_drawn_back = true,
                               .tower_is_roads = true,
                               .times_heaters = true,
                               .lifts_at_change = true,
                               .pushes_at_change = true};

}  // namespace

const DialectWords* words_of(const GcodePrint& print) {
  switch (print.facts.dialect) {
    case Dialect::prusaslicer:
    case Dialect::slic3r:
      return &prusaslicer;
    case Dialect::superslicer:
      return &superslicer;
    case Dialect::orcaslicer:
    case Dialect::bambustudio:
      return print.text->find("\n; CHANGE_LAYER") == std::string::npos ? &orcaslicer : &bambustudio;
    case Dialect::cura:
      return &cura;
    default:
      return nullptr;
  }
}

std::optional<int> tool_taken(const GcodeLine& line) {
  if (line.letter == 'T') return line.number;
  const bool by_m = line.letter == 'M' && (line.number == 108 || line.number == 135);
  if (!by_m || !line.has_value('T')) return std::nullopt;
  return int(line['T']);
}

}  // namespace cleancolor
