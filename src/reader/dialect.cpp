#include "reader/dialect.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "model/text_scan.hpp"

namespace cleancolor {

struct RoleName {
  std::string_view name;
  Role role;
};

namespace {

// ;TYPE: of PrusaSlicer and its relatives, ;TYPE: and FEATURE: of OrcaSlicer and BambuStudio, ;TYPE: of Cura and
// ideaMaker.
constexpr std::array<RoleName, 57> type_names = {{
    {"External perimeter", Role::external_perimeter},
    {"Perimeter", Role::perimeter},
    {"Internal perimeter", Role::perimeter},
    {"Overhang perimeter", Role::overhang_perimeter},
    {"Internal infill", Role::internal_infill},
    {"Solid infill", Role::solid_infill},
    {"Top solid infill", Role::top_solid_infill},
    {"Bridge infill", Role::bridge_infill},
    {"Internal bridge infill", Role::bridge_infill},
    {"Gap fill", Role::gap_fill},
    {"Thin wall", Role::external_perimeter},
    {"Ironing", Role::ironing},
    {"Skirt/Brim", Role::skirt_brim},
    {"Skirt", Role::skirt_brim},
    {"Brim", Role::skirt_brim},
    {"Support material", Role::support},
    {"Support material interface", Role::support_interface},
    {"Wipe tower", Role::wipe_tower},
    {"Custom", Role::custom},
    {"Unknown", Role::unknown},
    {"Inner wall", Role::perimeter},
    {"Outer wall", Role::external_perimeter},
    {"Overhang wall", Role::overhang_perimeter},
    {"Sparse infill", Role::internal_infill},
    {"Internal solid infill", Role::solid_infill},
    {"Top surface", Role::top_solid_infill},
    {"Bottom surface", Role::solid_infill},
    {"Bridge", Role::bridge_infill},
    {"Internal Bridge", Role::bridge_infill},
    {"Gap infill", Role::gap_fill},
    {"Support", Role::support},
    {"Support interface", Role::support_interface},
    {"Support transition", Role::support},
    {"Prime tower", Role::wipe_tower},
    {"Multiple", Role::unknown},
    {"Undefined", Role::unknown},
    {"WALL-OUTER", Role::external_perimeter},
    {"WALL-INNER", Role::perimeter},
    {"SKIN", Role::solid_infill},
    {"FILL", Role::internal_infill},
    {"SUPPORT", Role::support},
    {"SUPPORT-INTERFACE", Role::support_interface},
    {"SKIRT", Role::skirt_brim},
    {"PRIME-TOWER", Role::wipe_tower},
    {"SOLID-FILL", Role::solid_infill},
    {"BRIDGE", Role::bridge_infill},
    {"RAFT", Role::support},
    {"GAP-FILL", Role::gap_fill},
    {"WIPE-TOWER", Role::wipe_tower},
    {"SOLID-BOTTOM", Role::solid_infill},
    {"SOLID-TOP", Role::top_solid_infill},
    {"Prime Pillar", Role::wipe_tower},
    {"Purge", Role::custom},
    {"Flush", Role::custom},
    {"Mixed", Role::unknown},
    {"Floating vertical shell", Role::perimeter},
    {"Floating interface shell", Role::solid_infill},
}};

// Simplify3D, with or without "feature".
constexpr std::array<RoleName, 15> simplify3d_names = {{
    {"outer perimeter", Role::external_perimeter},
    {"inner perimeter", Role::perimeter},
    {"gap fill", Role::gap_fill},
    {"infill", Role::internal_infill},
    {"solid layer", Role::solid_infill},
    {"bridge", Role::bridge_infill},
    {"support", Role::support},
    {"dense support", Role::support_interface},
    {"skirt", Role::skirt_brim},
    {"brim", Role::skirt_brim},
    {"raft", Role::support},
    {"prime pillar", Role::wipe_tower},
    {"ooze shield", Role::skirt_brim},
    {"internal single extrusion", Role::perimeter},
    {"external single extrusion", Role::external_perimeter},
}};

// KISSlicer: "'Perimeter Path', 0.7 [feed mm/s], ...". A loop is an inner perimeter. All kinds of support begin with
// "Support".
constexpr std::array<RoleName, 15> kisslicer_names = {{
    {"Perimeter", Role::external_perimeter},
    {"Loop", Role::perimeter},
    {"Solid", Role::solid_infill},
    {"Crown", Role::gap_fill},
    {"Sparse Infill", Role::internal_infill},
    {"Stacked Sparse Infill", Role::internal_infill},
    {"Support Interface", Role::support_interface},
    {"Raft", Role::support},
    {"Pillar", Role::wipe_tower},
    {"Prime Pillar", Role::wipe_tower},
    {"Skirt", Role::skirt_brim},
    {"Brim", Role::skirt_brim},
    {"Wall", Role::skirt_brim},
    {"Destring/Wipe/Jump", Role::custom},
    {"Travel/Ironing", Role::ironing},
}};

// Behind the moves of Slic3r and of PrusaSlicer before 2.3 with verbose comments; spellings changed between versions.
constexpr std::array<RoleName, 19> behind_names = {{
    {"perimeter", Role::perimeter},
    {"small perimeter", Role::perimeter},
    {"contour internal perimeter", Role::perimeter},
    {"external perimeter", Role::external_perimeter},
    {"external small perimeter", Role::external_perimeter},
    {"perimeter external", Role::external_perimeter},
    {"overhang perimeter", Role::overhang_perimeter},
    {"infill", Role::internal_infill},
    {"fill", Role::internal_infill},
    {"solid infill", Role::solid_infill},
    {"solid fill", Role::solid_infill},
    {"top solid infill", Role::top_solid_infill},
    {"top solid fill", Role::top_solid_infill},
    {"bridge", Role::bridge_infill},
    {"skirt", Role::skirt_brim},
    {"brim", Role::skirt_brim},
    {"support material", Role::support},
    {"support material interface", Role::support_interface},
    {"gap fill", Role::gap_fill},
}};

std::optional<Role> role_of(std::span<const RoleName> names, std::string_view name) {
  const auto found = std::ranges::find(names, name, &RoleName::name);
  return found == names.end() ? std::nullopt : std::optional(found->role);
}

/// "'Perimeter Path', 0.7 [feed mm/s]"; nothing for other words in quotes ("'Destring Prime'"): the path goes on.
std::optional<Role> kisslicer_role(std::string_view text) {
  constexpr std::string_view ending = " Path";
  std::string_view name = text.substr(1, std::min(text.find('\'', 1), text.size()) - 1);
  if (!name.ends_with(ending)) return std::nullopt;
  name.remove_suffix(ending.size());
  if (const auto role = role_of(kisslicer_names, name)) return role;
  return name.starts_with("Support") ? Role::support : Role::unknown;
}

/// The number behind a tag; 0 where there is none.
double told(std::string_view text) {
  return std::max(0.0, number<double>(trimmed(text)).value_or(0));
}

/// "H0.200 W0.480" of Simplify3D.
double letter_value(std::string_view text, char letter) {
  for (std::size_t at = text.find(letter); at != std::string_view::npos; at = text.find(letter, at + 1)) {
    std::string_view digits = text.substr(at + 1);
    digits = digits.substr(0, digits.find(' '));
    if (const auto value = number<double>(digits)) return std::max(0.0, *value);
  }
  return 0;
}

}  // namespace

void CommentReader::says(std::string_view name, std::span<const RoleName> names) {
  state_.role = role_of(names, trimmed(name)).value_or(Role::unknown);
  on_own_lines_ = true;
}

void CommentReader::begin(Block block, Role role) {
  std::optional<Role>& before = before_[std::size_t(block)];
  if (!before || state_.role != role) before = state_.role;
  state_.role = role;
}

void CommentReader::end(Block block) {
  std::optional<Role>& before = before_[std::size_t(block)];
  if (before) state_.role = *before;
  before.reset();
}

void CommentReader::comment(std::string_view text) {
  text = trimmed(text);
  if (text.empty()) return;
  const auto tagged = [&](std::string_view tag) {
    if (!text.starts_with(tag)) return false;
    text.remove_prefix(tag.size());
    return true;
  };
  switch (text.front()) {
    case 'T':
      if (tagged("TYPE:")) says(text, type_names);
      break;
    case 'W':
      if (tagged("WIDTH:")) state_.width_mm = told(text);
      if (text == "WIPE_TOWER_START") begin(tower, Role::wipe_tower);
      if (text == "WIPE_TOWER_END") end(tower);
      break;
    case 'C':
      // Toolchanges of a wipe tower say no type of their own in some versions.
      if (text == "CP TOOLCHANGE START") begin(toolchange, Role::wipe_tower);
      if (text == "CP TOOLCHANGE END") end(toolchange);
      break;
    case 'H':
      if (tagged("HEIGHT:")) state_.height_mm = told(text);
      break;
    case 'F':
      if (tagged("FEATURE:")) says(text, type_names);
      if (text == "FLUSH_START") begin(flush, Role::custom);
      if (text == "FLUSH_END") end(flush);
      break;
    case 'L':
      if (tagged("LINE_WIDTH:")) state_.width_mm = told(text);
      if (tagged("LAYER_HEIGHT:")) state_.height_mm = told(text);
      break;
    case 'M':
      if (tagged("MESH:")) state_.object = trimmed(text) != "NONMESH";
      break;
    case 'R':
      if (text == "REFILL_START") begin(refill, Role::refill);
      if (text == "REFILL_END") end(refill);
      if (text == "RAMPART_WALL") state_.role = Role::rampart;
      break;
    case 'f':
      if (tagged("feature ")) says(text, simplify3d_names);
      break;
    case 't':
      if (tagged("tool H")) {
        state_.height_mm = told(text.substr(0, text.find(' ')));
        state_.width_mm = letter_value(text, 'W');
      }
      break;
    case '\'':
      if (const auto role = kisslicer_role(text)) state_.role = *role;
      break;
    case 'B':
      if (tagged("BEGIN_LAYER_")) {
        if (const std::size_t at = text.find("z_thickness="); at != std::string_view::npos) {
          const std::string_view value = text.substr(at + 12);
          state_.height_mm = told(value.substr(0, value.find(' ')));
        }
      }
      break;
    default:
      break;
  }
  // Older files of Simplify3D name the feature alone.
  if (facts_.dialect == Dialect::simplify3d)
    if (const auto role = role_of(simplify3d_names, text)) state_.role = *role;
}

void CommentReader::comment_behind_command(std::string_view text) {
  if (on_own_lines_) return;
  const Dialect dialect = facts_.dialect;
  if (dialect != Dialect::slic3r && dialect != Dialect::prusaslicer && dialect != Dialect::unknown) return;
  if (const auto role = role_of(behind_names, trimmed(text))) state_.role = *role;
}

}  // namespace cleancolor
