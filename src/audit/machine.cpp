#include "audit/machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "audit/offset_guess.hpp"
#include "base/error.hpp"
#include "model/ini.hpp"
#include "model/motion_limits.hpp"

namespace cleancolor {
namespace {

// Distinguishable also for the colour-blind (Okabe and Ito, 2008).
constexpr std::array<std::uint32_t, 8> palette = {0x0072B2, 0xE69F00, 0x009E73, 0xCC79A7,
                                                  0x56B4E9, 0xD55E00, 0xF0E442, 0x555555};

std::string text_of(const std::vector<Vec2>& offsets_mm) {
  std::string text;
  for (const Vec2 p : offsets_mm) text += fmt::format("{}{:g}x{:g}", text.empty() ? "" : ",", p.x, p.y);
  return text;
}

std::string_view name_of(OffsetsIn in) {
  return in == OffsetsIn::slicer ? "slicer" : "firmware";
}

/// The limits of the printer as the file's own configuration tells them; nothing where it has none that can be read.
std::optional<Config> config_in(const GcodePrint& print, const Progress& progress) {
  std::vector<IniEntry> entries;
  for (const IniEntry& entry : print.facts.config)
    if (entry.key.starts_with("machine_max_") || entry.key == "nozzle_diameter") entries.push_back(entry);
  if (entries.empty()) return std::nullopt;
  try {
    return with_ini(Config{}, entries, print.name).config;
  } catch (const Error& fault) {
    progress.warn(fmt::format("{}; the limits of its printer are not used", fault.what()));
    return std::nullopt;
  }
}

/// What to type, with as many nozzles as the print has.
std::string example(const GcodePrint& print) {
  std::vector<Vec2> offsets;
  for (int n = 0; n < print.tools; ++n) offsets.push_back({33. * n, 0});
  const std::string text = fmt::format("--nozzle-offset {}", text_of(offsets));
  if (print.facts.offsets_in) return fmt::format("{} --offsets-in {}", text, name_of(*print.facts.offsets_in));
  return fmt::format("{} (and --offsets-in slicer, or --offsets-in firmware, where you know which)", text);
}

/// Several nozzles print, and nothing tells where they are.
[[noreturn]] void fail_without_offsets(const GcodePrint& print) {
  const bool one_nozzle = std::ranges::any_of(print.facts.config, [](const IniEntry& e) {
    return e.key == "single_extruder_multi_material" && e.value == "1";
  });
  if (one_nozzle) {
    throw Error(
        fmt::format("{}: by its configuration (single_extruder_multi_material) this print changes filament in one "
                    "nozzle, and no idle nozzle can ooze; if the printer has several, say where they are: {}",
                    print.name, example(print)));
  }
  throw Error(
      fmt::format("{}: {} nozzles print, and the file does not say where they are; choose the printer with --printer, "
                  "or say it: {}; where idle nozzles leave the print: --idle-nozzle parked",
                  print.name, print.tools, example(print)));
}

IdleNozzle idle_nozzle(const GcodePrint& print, const MachineRequest& request) {
  if (request.idle_nozzle) return *request.idle_nozzle;
  if (request.printer) return request.printer->idle_nozzle;
  return print.facts.docks_tools ? IdleNozzle::docked : IdleNozzle::same_height;
}

class Finder {
 public:
  Finder(const GcodePrint& print, const MachineRequest& request, const Progress& progress)
      : print_(print), request_(request), progress_(progress) {}

  AuditMachine machine() {
    find_offsets();
    find_offsets_in();
    return std::move(machine_);
  }

 private:
  void take(const std::vector<Vec2>& offsets_mm, std::string source) {
    offsets_ = offsets_mm;
    machine_.offsets_source = std::move(source);
  }

  void find_offsets() {
    const auto tools = std::size_t(print_.tools);
    if (!request_.nozzle_offset_mm.empty()) {
      take(request_.nozzle_offset_mm, "--nozzle-offset");
    } else if (request_.printer) {
      for (const Extruder& extruder : request_.printer->extruders) offsets_.push_back(extruder.nozzle_offset_mm);
      machine_.offsets_source = fmt::format("printer {}", request_.printer->printer_model);
    } else if (!print_.facts.nozzle_offset_mm.empty()) {
      take(print_.facts.nozzle_offset_mm, print_.facts.offsets_from);
    } else if (print_.facts.firmware_offset_mm.size() >= tools && tools > 1) {
      take(print_.facts.firmware_offset_mm, "M218 in the file");
      if (!print_.facts.offsets_in) told_in_ = OffsetsIn::firmware;
    } else if (tools == 1) {
      take({{0, 0}}, "one nozzle");
    } else if (const IdleNozzle idle = idle_nozzle(print_, request_);
               idle == IdleNozzle::parked || idle == IdleNozzle::docked) {
      // Such printers take their offsets into account themselves, unless the file shows that the slicer did.
      if (const std::vector<Vec2> guessed = guessed_offsets_mm(print_); shows_offsets(guessed)) {
        take_guess(guessed);
      } else {
        take(std::vector<Vec2>(tools),
             request_.idle_nozzle ? "--idle-nozzle" : "printer_model of the configuration block");
        if (!print_.facts.offsets_in) told_in_ = OffsetsIn::firmware;
      }
    } else {
      const std::vector<Vec2> guessed = guessed_offsets_mm(print_);
      if (guessed.empty()) fail_without_offsets(print_);
      take_guess(guessed);
    }
    if (offsets_.size() < tools) {
      throw Error(fmt::format("{}: {} nozzles print, but offsets of {} are given ({}); give one for each: {}",
                              print_.name, tools, offsets_.size(), machine_.offsets_source, example(print_)));
    }
    for (std::size_t n = offsets_.size(); n-- > 0;) offsets_[n] = offsets_[n] - offsets_[0];
    for (const Vec2 offset : offsets_) machine_.nozzles.emplace_back().offset_mm = offset;
    if (!request_.nozzle_offset_mm.empty() || request_.printer) compare_with_file();
  }

  static bool shows_offsets(const std::vector<Vec2>& guessed) {
    return std::ranges::any_of(guessed, [](Vec2 offset) { return offset != Vec2{}; });
  }

  void take_guess(const std::vector<Vec2>& guessed) {
    take(guessed, "a guess from the geometry");
    told_in_ = OffsetsIn::slicer;
    progress_.warn(
        fmt::format("{}: the file does not say where the nozzles are; its colours fit together with --nozzle-offset "
                    "{} --offsets-in slicer, which is taken; say it yourself if it is wrong",
                    print_.name, text_of(guessed)));
  }

  void compare_with_file() {
    const std::vector<Vec2>& told = print_.facts.nozzle_offset_mm;
    for (std::size_t n = 0; n < std::min(told.size(), offsets_.size()); ++n) {
      if (distance(told[n], offsets_[n]) <= 0.1) continue;
      progress_.warn(fmt::format("{}: the file was made for nozzles at {}, audited are nozzles at {} ({})", print_.name,
                                 text_of(told), text_of(offsets_), machine_.offsets_source));
      return;
    }
  }

  void find_offsets_in() {
    const bool apart = std::ranges::any_of(offsets_, [](Vec2 p) { return p.x != 0 || p.y != 0; });
    std::optional<OffsetsIn> fits;
    if (print_.tools > 1 && apart) fits = guessed_offsets_in(print_, offsets_);
    if (request_.offsets_in) {
      machine_.offsets_in = *request_.offsets_in;
      machine_.offsets_in_source = "--offsets-in";
    } else if (print_.facts.offsets_in) {
      machine_.offsets_in = *print_.facts.offsets_in;
      machine_.offsets_in_source = print_.facts.offsets_from;
    } else if (told_in_) {
      machine_.offsets_in = *told_in_;
      machine_.offsets_in_source = machine_.offsets_source;
    } else if (fits) {
      machine_.offsets_in = *fits;
      machine_.offsets_in_source = "a guess from the geometry";
      if (request_.printer && request_.printer->offsets_in == *fits) return;  // no more than was expected
      progress_.warn(fmt::format(
          "{}: the file does not say who makes up for the nozzle offsets; its colours fit together with "
          "--offsets-in {}, which is taken{}; say it yourself if it is wrong",
          print_.name, name_of(*fits),
          request_.printer ? fmt::format(" although the printer says {}", name_of(request_.printer->offsets_in)) : ""));
      return;
    } else {
      machine_.offsets_in = request_.printer ? request_.printer->offsets_in : OffsetsIn::firmware;
      machine_.offsets_in_source = request_.printer ? machine_.offsets_source : "the default";
      if (print_.tools > 1 && apart)
        progress_.warn(
            fmt::format("{}: neither the file nor its plastic tells who makes up for the nozzle offsets; --offsets-in "
                        "{} is taken ({}); say it yourself if it is wrong",
                        print_.name, name_of(machine_.offsets_in), machine_.offsets_in_source));
      return;
    }
    if (fits && *fits != machine_.offsets_in) {
      progress_.warn(
          fmt::format("{}: with --offsets-in {} ({}) the colours do not fit together; with --offsets-in {} they would: "
                      "check it",
                      print_.name, name_of(machine_.offsets_in), machine_.offsets_in_source, name_of(*fits)));
    }
  }

  const GcodePrint& print_;
  const MachineRequest& request_;
  const Progress& progress_;
  AuditMachine machine_;
  std::vector<Vec2> offsets_;
  std::optional<OffsetsIn> told_in_;
};

double told_for(const std::vector<double>& list, std::size_t n, double otherwise) {
  return list.empty() ? otherwise : list[std::min(n, list.size() - 1)];
}

/// "#RRGGBB"; nothing where it is none.
std::optional<std::uint32_t> rgb_of(const std::string& text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  std::uint32_t rgb = 0;
  const auto [end, fault] = std::from_chars(text.data() + 1, text.data() + 7, rgb, 16);
  return fault == std::errc{} && end == text.data() + 7 ? std::optional(rgb) : std::nullopt;
}

bool close(std::uint32_t a, std::uint32_t b) {
  int apart = 0;
  for (const int shift : {0, 8, 16}) apart += std::abs(int(a >> shift & 255) - int(b >> shift & 255));
  return apart < 60;
}

/// The file's own colours where they can be told apart, else a palette.
void put_colours(const GcodePrint& print, const MachineRequest& request, AuditMachine& machine) {
  const auto n = machine.nozzles.size();
  std::vector<std::uint32_t> rgb;
  for (std::size_t i = 0; i < n; ++i) {
    std::optional<std::uint32_t> told;
    if (i < print.facts.filament_colour.size()) told = rgb_of(print.facts.filament_colour[i]);
    if (!told && request.printer && i < request.printer->extruders.size()) {
      const Extruder& e = request.printer->extruders[i];
      told = rgb_of(e.filament_colour.empty() ? e.extruder_colour : e.filament_colour);
    }
    if (!told || std::ranges::any_of(rgb, [&](std::uint32_t other) { return close(other, *told); })) {
      rgb.clear();
      break;
    }
    rgb.push_back(*told);
  }
  for (std::size_t i = 0; i < n; ++i) {
    machine.nozzles[i].rgb = rgb.empty() ? palette[i % palette.size()] : rgb[i];
    machine.nozzles[i].colour_name = fmt::format("extruder {} (#{:06X})", i + 1, machine.nozzles[i].rgb);
  }
}

}  // namespace

AuditMachine audit_machine(const GcodePrint& print, const MachineRequest& request, const Progress& progress) {
  AuditMachine machine = Finder(print, request, progress).machine();
  machine.limits = motion_limits(request.printer ? *request.printer : config_in(print, progress).value_or(Config{}));
  machine.idle_nozzle = idle_nozzle(print, request);
  for (std::size_t n = 0; n < machine.nozzles.size(); ++n) {
    Extruder extruder;
    if (request.printer) extruder = request.printer->extruders[std::min(n, request.printer->extruders.size() - 1)];
    machine.nozzles[n].filament_diameter_mm =
        told_for(print.facts.filament_diameter_mm, n, extruder.filament_diameter_mm);
    machine.nozzles[n].filament_density_g_cm3 =
        told_for(print.facts.filament_density_g_cm3, n, extruder.filament_density_g_cm3);
  }
  put_colours(print, request, machine);
  return machine;
}

}  // namespace cleancolor
