#include "model/ini.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "model/ini_dialect.hpp"
#include "model/options.hpp"
#include "model/text_file.hpp"
#include "model/text_scan.hpp"

namespace cleancolor {
namespace {

// Enough for the configuration at the end of any G-code file; the file itself may be huge.
constexpr std::uintmax_t gcode_tail_bytes = 4 * 1024 * 1024;

template <class Visit>
void for_each_line(std::string_view text, const Visit& visit) {
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    visit(trimmed(text.substr(0, end)), line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

bool is_key(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

std::string place(const std::string& file, const IniEntry& entry) {
  return entry.line == 0 ? fmt::format("{}: ", file) : fmt::format("{}:{}: ", file, entry.line);
}

// The work of with_ini, with what all its steps need at hand.
struct Import {
  Config config;
  std::vector<IniEntry> entries;  // every key once, by its current name, in the order of the file
  const std::string& file;
  const Progress& progress;

  const IniEntry* find(std::string_view key) const {
    const auto found = std::ranges::find(entries, key, &IniEntry::key);
    return found == entries.end() ? nullptr : &*found;
  }
  std::string_view value(std::string_view key) const {
    const IniEntry* entry = find(key);
    return entry ? std::string_view(entry->value) : std::string_view{};
  }
};

std::vector<IniEntry> last_of_each(const std::vector<IniEntry>& entries) {
  std::map<std::string, std::size_t> last;
  for (std::size_t i = 0; i < entries.size(); ++i) last[std::string(current_name(entries[i].key))] = i;
  std::vector<IniEntry> kept;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    std::string name(current_name(entries[i].key));
    if (last.at(name) == i) kept.push_back({std::move(name), entries[i].value, entries[i].line});
  }
  return kept;
}

// The values of an entry, one for each extruder; a list of the file that is too long is cut, a short one repeats its
// first. Machine limits are lists too, for a normal and a silent mode: the first counts.
std::vector<std::string> values_of(const Import& import, const Option& option, const IniEntry& entry) {
  std::vector<std::string> values = split_list(option, entry.value, place(import.file, entry));
  if (option.per_extruder()) {
    values.resize(import.config.extruders.size(), std::string(values.front()));
  } else if (option.kind() != OptionKind::text && option.kind() != OptionKind::polygon) {
    values.front() = values.front().substr(0, values.front().find(','));
  }
  return values;
}

// "16x16/PNG, 220x124/PNG" -> "16x16, 220x124"
std::string without_formats(std::string text) {
  for (std::size_t slash; (slash = text.find("/PNG")) != text.npos;) text.erase(slash, 4);
  return text;
}

// The text as we understand it, or "" where our own value stays; warns where the print will differ.
std::string understood(const Import& import, const Option& option, const IniEntry& entry, const std::string& text) {
  const std::string where = place(import.file, entry);
  if (option.kind() == OptionKind::choice && std::ranges::find(option.choices(), text) == option.choices().end()) {
    const Replacement replacement = nearest_value(option.name, text);
    if (replacement.value.empty()) return text;  // refused when it is parsed
    if (replacement.differs) {
      import.progress.warn(fmt::format("{}{} = {} is not known here; the nearest, {}, is taken", where, option.name,
                                       text, replacement.value));
    }
    return std::string(replacement.value);
  }
  const bool is_number = option.kind() == OptionKind::number || option.kind() == OptionKind::length_or_share;
  if (is_number && option.min > 0 && (text == "0" || text == "0%")) {
    import.progress.warn(fmt::format("{}{} = 0 leaves the value to the slicer; {} is taken", where, option.name,
                                     value_text(option, option_value(import.config, option))));
    return "";
  }
  if (option.name == "first_layer_height" && text.ends_with('%')) {
    const Option& share = *find_option("extrusion_width");  // any option that takes both, to read the percentage
    const auto height = std::get<LengthOrShare>(parse_option(share, text, where));
    return fmt::format("{}", height.of(import.config.layer_height_mm));
  }
  if (option.name == "thumbnails") return without_formats(text);
  if (option.name == "resolution" && text == "0") return "";
  return text == "nil" ? "" : text;
}

void put(Import& import, const Option& option, const IniEntry& entry) {
  const std::vector<std::string> values = values_of(import, option, entry);
  const std::string where = place(import.file, entry);
  std::string before;
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    // Equal values are warned of once.
    if (i == 0 || values[i] != before) text = understood(import, option, entry, values[i]);
    before = values[i];
    const bool keep = text.empty() && option.kind() != OptionKind::text && option.kind() != OptionKind::polygon;
    if (!keep) store_option(import.config, option, i, parse_option(option, text, where), where);
  }
}

void put_named(Import& import, std::string_view key) {
  if (const IniEntry* entry = import.find(key)) put(import, *find_option(key), *entry);
}

void add_extruders(Import& import) {
  const IniEntry* entry = import.find("nozzle_diameter");
  if (!entry) return;
  const std::size_t count = split_list(*find_option("nozzle_diameter"), entry->value).size();
  if (count > max_extruders) {
    throw Error(fmt::format("{}nozzle_diameter: {} values; there can be at most {} extruders",
                            place(import.file, *entry), count, max_extruders));
  }
  if (count > import.config.extruders.size()) set_extruder_count(import.config, count);
}

void put_offsets(Import& import) {
  const IniEntry* entry = import.find("extruder_offset");
  if (!entry || import.find("nozzle_offset")) return;
  const Option& option = *find_option("nozzle_offset");
  const std::string where = place(import.file, *entry);
  std::vector<Vec2> offsets;
  for (const std::string& text : values_of(import, option, *entry)) {
    offsets.push_back(std::get<Vec2>(parse_option(option, text, where)));
  }
  if (std::ranges::all_of(offsets, [](Vec2 p) { return p == Vec2{}; })) return;
  if (offsets.front() != Vec2{}) {
    import.progress.warn(fmt::format("{}extruder_offset: the first is {}x{}, not 0x0; all are taken relative to it",
                                     where, offsets.front().x, offsets.front().y));
  }
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    store_option(import.config, option, i, offsets[i] - offsets.front(), where);
  }
  if (import.config.gcode_flavor == Flavour::sailfish) {
    import.config.offsets_in = OffsetsIn::firmware;
    import.progress.warn(
        fmt::format("{}extruder_offset: sailfish adds the offsets of the nozzles itself; they are not "
                    "subtracted again",
                    where));
    return;
  }
  import.config.offsets_in = OffsetsIn::slicer;
}

// filament_retract_length and the like: where a material has its own value, it replaces the printer's.
void put_material_retractions(Import& import) {
  for (const IniEntry& entry : import.entries) {
    if (!entry.key.starts_with("filament_retract_") && !entry.key.starts_with("filament_deretract_")) continue;
    const Option* option = find_option(std::string_view(entry.key).substr(std::string_view("filament_").size()));
    if (option) put(import, *option, entry);
  }
}

// top_solid_min_thickness: as many solid layers as are this thick.
void raise_solid_layers(Import& import, std::string_view key, int Config::* layers) {
  const IniEntry* entry = import.find(key);
  if (!entry) return;
  const Option& any_length = *find_option("layer_height");
  const auto thickness_mm = std::get<double>(parse_option(any_length, entry->value, place(import.file, *entry)));
  const double needed = std::ceil(thickness_mm / import.config.layer_height_mm - 1e-6);
  // No solid layers at all means none, whatever the thickness.
  if (import.config.*layers > 0 && needed < 1000) {
    import.config.*layers = std::max(import.config.*layers, static_cast<int>(needed));
  }
}

void put_wall_generator(Import& import) {
  const IniEntry* entry = import.find("perimeter_generator");
  if (!entry || entry->value != "arachne") return;
  import.config.thin_walls = true;
  import.progress.warn(fmt::format(
      "{}perimeter_generator = arachne is not known here; loops of constant width with thin walls are printed",
      place(import.file, *entry)));
}

// Keys that are not options of ours but were taken into account all the same.
bool is_translated(std::string_view key) {
  constexpr std::string_view translated[] = {"extruder_offset", "top_solid_min_thickness", "bottom_solid_min_thickness",
                                             "perimeter_generator"};
  if (std::ranges::find(translated, key) != std::end(translated)) return true;
  return key.starts_with("filament_") && find_option(key.substr(std::string_view("filament_").size()));
}

bool is_gcode(std::string_view text) {
  return text.starts_with("G1 ") || text.find("\nG1 ") != text.npos || text.find("\nG0 ") != text.npos ||
         text.find("prusaslicer_config = begin") != text.npos;
}

}  // namespace

std::vector<IniEntry> read_ini(std::string_view text, const std::string& file) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (text.find('\0') != text.npos) throw Error(fmt::format("{}: not a text file; expected an .ini file", file));
  std::vector<IniEntry> entries;
  for_each_line(text, [&](std::string_view line, int number) {
    if (line.empty() || line.starts_with('#') || line.starts_with(';')) return;
    if (line.starts_with('[')) {
      throw Error(
          fmt::format("{}:{}: a bundle of several profiles; choose the profiles in PrusaSlicer and use File, "
                      "Export, Export Config",
                      file, number));
    }
    const std::size_t equals = line.find('=');
    const std::string_view key = trimmed(line.substr(0, equals));
    if (equals == line.npos || !is_key(key)) {
      throw Error(fmt::format("{}:{}: expected 'option = value'", file, number));
    }
    entries.push_back({std::string(key), std::string(trimmed(line.substr(equals + 1))), number});
  });
  return entries;
}

std::vector<IniEntry> read_gcode_config(std::string_view text, const std::string& file) {
  std::vector<IniEntry> entries;
  bool knows_option = false;
  for_each_line(text, [&](std::string_view line, int number) {
    if (line.empty()) return;
    if (!line.starts_with(';')) {
      entries.clear();
      knows_option = false;
      return;
    }
    const std::size_t equals = line.find('=');
    const std::string_view key = equals == line.npos ? "" : trimmed(line.substr(1, equals - 1));
    if (!is_key(key) || key == "prusaslicer_config") return;
    knows_option = knows_option || find_option(current_name(key));
    entries.push_back({std::string(key), std::string(trimmed(line.substr(equals + 1))), number});
  });
  if (!knows_option) {
    throw Error(fmt::format("{}: no configuration at the end of this G-code; export it from the slicer as .ini", file));
  }
  return entries;
}

IniResult with_ini(Config config, const std::vector<IniEntry>& entries, const std::string& file,
                   const Progress& progress) {
  Import import{std::move(config), last_of_each(entries), file, progress};
  // Later values depend on these two, wherever they stand in the file.
  add_extruders(import);
  put_named(import, "nozzle_diameter");
  put_named(import, "layer_height");

  std::vector<std::string> ignored;
  for (const IniEntry& entry : import.entries) {
    if (const Option* option = find_option(entry.key)) {
      put(import, *option, entry);
    } else if (!is_translated(entry.key) &&
               matters(entry.key, entry.value, [&](std::string_view key) { return import.value(key); })) {
      ignored.push_back(fmt::format("{} = {}", entry.key, entry.value));
    }
  }
  put_offsets(import);
  put_material_retractions(import);
  put_wall_generator(import);
  raise_solid_layers(import, "top_solid_min_thickness", &Config::top_solid_layers);
  raise_solid_layers(import, "bottom_solid_min_thickness", &Config::bottom_solid_layers);
  return {std::move(import.config), std::move(ignored)};
}

IniResult with_ini_file(Config config, const std::filesystem::path& file, const Progress& progress) {
  const std::string name = file.string();
  const std::string tail = end_of_file(file, gcode_tail_bytes);
  if (!is_gcode(tail)) return with_ini(std::move(config), read_ini(text_of_file(file), name), name, progress);
  std::vector<IniEntry> entries = read_gcode_config(tail, name);
  if (tail.size() == gcode_tail_bytes) {
    for (IniEntry& entry : entries) entry.line = 0;  // counted from somewhere in the file
  }
  return with_ini(std::move(config), entries, name, progress);
}

}  // namespace cleancolor
