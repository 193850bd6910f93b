#include "cli/machine_arguments.hpp"

#include <fmt/format.h>

#include "audit/machine_texts.hpp"
#include "base/error.hpp"
#include "cli/words.hpp"
#include "model/settings.hpp"

namespace cleancolor {
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
  if (!texts.nozzle_offset.empty())
    options.nozzle_offset_mm = nozzle_offsets_of(texts.nozzle_offset, "--nozzle-offset");
  if (!texts.offsets_in.empty()) options.offsets_in = offsets_in_of(texts.offsets_in, "--offsets-in");
  if (!texts.idle_nozzle.empty()) options.idle_nozzle = idle_nozzle_of(texts.idle_nozzle, "--idle-nozzle");
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
