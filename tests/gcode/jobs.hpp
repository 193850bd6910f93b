// Small jobs for the writer, and a reader of what it writes that shares nothing with it.
#pragma once

#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "gcode/writer.hpp"

namespace cleancolor::test {

inline Sink to_string(std::string& text) {
  return {.write = [&text](std::string_view b) { text += b; },
          .patch = [&text](std::uint64_t at, std::string_view b) { text.replace(at, b.size(), b); }};
}

/// Two extruders 33 mm apart; what takes many lines to say is left out.
inline Config two_extruders(Flavour flavour, OffsetsIn offsets_in) {
  Config c;
  c.gcode_flavor = flavour;
  c.offsets_in = offsets_in;
  c.remaining_times = false;
  c.start_gcode = "G28";
  c.end_gcode = "M84";
  c.seam_gap_distance = {0, false};
  c.travel_speed_mm_s = 120;
  c.extruders.resize(2);
  c.extruders[1].nozzle_offset_mm = {33, 0};
  return c;
}

inline Road road(Role role) {
  return {.role = role, .width_mm = 0.4, .height_mm = 0.3, .area_mm2 = 0.1, .speed_mm_s = 30};
}

inline Path square(int extruder, Vec2 at, double side, Role role = Role::external_perimeter) {
  return {.extruder = extruder,
          .closed = true,
          .points = {at, {at.x + side, at.y}, {at.x + side, at.y + side}, {at.x, at.y + side}},
          .stretches = {{0, road(role)}},
          .travel = {}};
}

inline Path zigzag(int extruder, Vec2 at, double side, double spacing) {
  Path p{.extruder = extruder,
         .closed = false,
         .points = {},
         .stretches = {{0, road(Role::internal_infill)}},
         .travel = {}};
  bool right = false;
  for (double y = 0; y <= side; y += spacing, right = !right) {
    p.points.push_back({at.x + (right ? side : 0), at.y + y});
    p.points.push_back({at.x + (right ? 0 : side), at.y + y});
  }
  return p;
}

/// Two cubes, one upon the other or side by side, loops and zigzag infill.
inline std::vector<Layer> two_cubes(int layers, bool stacked) {
  std::vector<Layer> result;
  for (int i = 0; i < layers; ++i) {
    Layer layer{.index = i,
                .print_z_mm = 0.3 * (i + 1),
                .height_mm = 0.3,
                .paths = {},
                .fan_by_extruder = {0, i > 0 ? 0.5 : 0.0}};
    const auto add = [&](int extruder, Vec2 at) {
      layer.paths.push_back(square(extruder, at + Vec2{1, 1}, 18, Role::perimeter));
      layer.paths.push_back(square(extruder, at, 20));
      layer.paths.push_back(zigzag(extruder, at + Vec2{1.5, 1.5}, 17, 2));
    };
    if (stacked) {
      add(i < layers / 2 ? 0 : 1, {-10, -10});
    } else {
      // Each layer begins with the tool of the layer below.
      for (int k = 0; k < 2; ++k) add((i + k) % 2, {(i + k) % 2 ? 5.0 : -25.0, -10});
    }
    result.push_back(std::move(layer));
  }
  return result;
}

inline PrintInfo info_of(const Config& config, const std::vector<Layer>& layers) {
  PrintInfo info;
  info.layer_count = int(layers.size());
  info.max_z_mm = layers.back().print_z_mm;
  info.initial_extruder = layers.front().paths.front().extruder;
  info.last_layer.resize(config.extruders.size());
  for (const Layer& l : layers)
    for (const Path& p : l.paths) {
      info.last_layer[std::size_t(p.extruder)] = l.index;
      if (&l == &layers.front())
        for (const Vec2 q : p.points) info.first_layer_box_mm.add(q);
    }
  return info;
}

struct Written {
  std::string text;
  PrintFigures figures;
};

inline Written written(const Config& config, const std::vector<Layer>& layers) {
  Written w;
  GcodeWriter writer(config, info_of(config, layers), to_string(w.text));
  for (const Layer& l : layers) writer.layer(l);
  w.figures = writer.finish();
  return w;
}

/// The lines from the first layer on, without comments that take no part and without the end.
inline std::string body(const std::string& text) {
  const std::size_t from = text.find(";LAYER_CHANGE");
  return text.substr(from, text.find("; filament used [mm]") - from);
}

struct Line {
  std::string code;  // "G1", "T1", "M104"
  std::map<char, double> words;
  bool has(char c) const { return words.contains(c); }
};

inline std::vector<Line> parsed(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream in(text);
  for (std::string row; std::getline(in, row);) {
    row = row.substr(0, row.find(';'));
    std::istringstream words(row);
    Line line;
    if (!(words >> line.code)) continue;
    for (std::string word; words >> word;)
      line.words[word[0]] = word.size() > 1 ? std::strtod(word.c_str() + 1, nullptr) : 0;
    lines.push_back(line);
  }
  return lines;
}

}  // namespace cleancolor::test
