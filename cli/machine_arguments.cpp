#include "cli/machine_arguments.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "cli/words.hpp"
#include "model/settings.hpp"

namespace cleancolor {
namespace {

std::vector<Vec2> offsets_of(std::string_view text) {
  constexpr double farthest_mm = 1000;
  std::vector<Vec2> offsets;
  for (const std::string_view point : split(text, ',')) {
    const std::size_t x = point.find('x');
    Vec2 at;
    if (x == point.npos || !parse_whole(point.substr(0, x), at.x) || !parse_whole(point.substr(x + 1), at.y) ||
        !(std::abs(at.x) <= farthest_mm) || !(std::abs(at.y) <= farthest_mm))
      throw Error(
          fmt::format("--nozzle-offset: '{}' is not like 33x0, mm in X and Y; say 0x0,33x0 for two nozzles", point));
    offsets.push_back(at);
  }
  if (offsets.size() > max_tools)
    throw Error(fmt::format("--nozzle-offset: {} nozzles; at most {} are possible", offsets.size(), max_tools));
  if (offsets.front() != Vec2{})
    throw Error("--nozzle-offset: the first nozzle is at 0x0; the others are given as seen from it");
  return offsets;
}

template <class T, std::size_t n>
T choice(const std::string& option, const std::string& text, const std::array<std::pair<const char*, T>, n>& choices) {
  std::vector<std::string_view> names;
  for (const auto& [name, value] : choices) {
    if (text == name) return value;
    names.emplace_back(name);
  }
  throw Error(fmt::format("{}: '{}' is none of {}", option, text, fmt::join(names, ", ")));
}

}  // namespace

void add_machine(CLI::App& app, MachineTexts& texts) {
  const char* group = "The printer";
  app.add_option("--printer", texts.printer, "printer: a name from 'cleancolor profiles', or a .toml file")
      ->type_name("NAME|FILE.toml")
      ->group(group);
  app.add_option("--nozzle-offset", texts.nozzle_offset, "where each nozzle is, as seen from the first, mm")
      ->type_name("XxY,XxY...")
      ->group(group);
  app.add_option("--offsets-in", texts.offsets_in, "who makes up for the offsets: the file has them in X and Y, or not")
      ->type_name("slicer|firmware")
      ->group(group);
  app.add_option("--idle-nozzle", texts.idle_nozzle, "where nozzles are while another one is in use")
      ->type_name("same_height|lifted|parked|docked")
      ->group(group);
}

MachineOptions machine_options(const MachineTexts& texts) {
  MachineOptions options;
  options.printer = texts.printer;
  if (!texts.nozzle_offset.empty()) options.nozzle_offset_mm = offsets_of(texts.nozzle_offset);
  if (!texts.offsets_in.empty())
    options.offsets_in = choice<OffsetsIn, 2>("--offsets-in", texts.offsets_in,
                                              {{{"slicer", OffsetsIn::slicer}, {"firmware", OffsetsIn::firmware}}});
  if (!texts.idle_nozzle.empty())
    options.idle_nozzle = choice<IdleNozzle, 4>("--idle-nozzle", texts.idle_nozzle,
                                                {{{"same_height", IdleNozzle::same_height},
                                                  {"lifted", IdleNozzle::lifted},
                                                  {"parked", IdleNozzle::parked},
                                                  {"docked", IdleNozzle::docked}}});
  return options;
}

MachineRequest machine_request(const MachineOptions& options, const Progress& progress) {
  MachineRequest request;
  if (!options.printer.empty()) request.printer = config_of({.printer = options.printer}, progress);
  request.nozzle_offset_mm = options.nozzle_offset_mm;
  request.offsets_in = options.offsets_in;
  request.idle_nozzle = options.idle_nozzle;
  return request;
}

std::uint32_t layer_index(const std::string& text) {
  std::uint32_t layer = 0;
  if (!parse_whole(text, layer) || layer == 0)
    throw Error(fmt::format("--layer: '{}' is not a layer; they are numbered from 1", text));
  return layer - 1;
}

void require_layer(const GcodePrint& print, std::uint32_t layer) {
  if (layer >= print.layers.size())
    throw Error(fmt::format("{}: there is no layer {}; it has {}, numbered from 1", print.name,
                            std::uint64_t(layer) + 1, print.layers.size()));
}

}  // namespace cleancolor
