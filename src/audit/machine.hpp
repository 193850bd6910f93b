// audit/machine.hpp
//
// AuditMachine: the printer that a G-code file is audited for, and how it was found out.
//
//   what the user says, else what the file says, else a guess from the geometry  ->  nozzles, offsets, limits
//
// Carriage frame: the carriage is where nozzle 0 is; nozzle i is at carriage + offset[i]. Offsets in the slicer: X Y of
// the file are carriage positions. In the firmware: X Y are positions of the nozzle in use, carriage = X Y - offset.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/motion.hpp"
#include "base/progress.hpp"
#include "base/vec.hpp"
#include "model/config.hpp"
#include "reader/print.hpp"

namespace cleancolor {

/// What the user says; what is empty is looked for in the file.
struct MachineRequest {
  std::optional<Config> printer = {};       // a printer profile
  std::vector<Vec2> nozzle_offset_mm = {};  // of each nozzle as seen from nozzle 0
  std::optional<OffsetsIn> offsets_in = {};
  std::optional<IdleNozzle> idle_nozzle = {};
};

struct AuditNozzle {
  Vec2 offset_mm;
  double filament_diameter_mm = 1.75;
  double filament_density_g_cm3 = 1.24;
  std::uint32_t rgb = 0;    // for pictures: filament_colour where told, else one of a palette
  std::string colour_name;  // "extruder 1 (#E8E8E8)"
};

struct AuditMachine {
  std::vector<AuditNozzle> nozzles;  // as many as the print has tools, at least
  OffsetsIn offsets_in = OffsetsIn::slicer;
  IdleNozzle idle_nozzle = IdleNozzle::same_height;
  MotionLimits limits;
  std::string offsets_source;  // "--printer replicator-dual": where nozzle offsets are known from
  std::string offsets_in_source;
};

/// Offsets of the nozzles: --nozzle-offset, else the printer profile, else the file, else the guess; always as seen
/// from the first. Of nozzles that are parked or docked while they idle (--idle-nozzle, else the profile, else a file
/// for a Prusa XL) none need be known, unless the geometry shows that the slicer applied them. Who applies them: the
/// user, else the file (a non-zero extruder_offset: slicer, whatever the profile says, for there lies the plastic;
/// zeroes: firmware), else the geometry (audit/offset_guess.hpp), else the profile. What was guessed, and what
/// contradicts the geometry or the file by more than 0.1 mm, is warned of.
///
/// Limits: the profile's, else those of the file's configuration, else the defaults of model/config.hpp. Filament: the
/// file's, else the profile's. Colours: the file's, else the profile's, where all can be told apart, else a palette.
/// One tool needs no offsets.
///
/// Throws Error where several tools print and nothing tells where their nozzles are (what to type is in the message),
/// or where fewer offsets are given than the print has tools.
AuditMachine audit_machine(const GcodePrint& print, const MachineRequest& request, const Progress& progress = {});

/// Where nozzle `nozzle` is when the file says `at` with `tool` in use.
inline Vec2 carriage_mm(const AuditMachine& machine, Vec2 at, int tool) {
  return machine.offsets_in == OffsetsIn::slicer ? at : at - machine.nozzles[std::size_t(tool)].offset_mm;
}

/// Where the plastic of the tool lies when the file says `at`.
inline Vec2 plastic_mm(const AuditMachine& machine, Vec2 at, int tool) {
  return machine.offsets_in == OffsetsIn::slicer ? at + machine.nozzles[std::size_t(tool)].offset_mm : at;
}

}  // namespace cleancolor
