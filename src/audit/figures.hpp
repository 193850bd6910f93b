// audit/figures.hpp
//
// Figures: what an audit counts, with names, units and help in one table for text, JSON, HTML, --fail-over and docs.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.hpp"

namespace cleancolor {

/// Definitions: docs/audit.md. Lengths in mm, volumes in mm3, v: visibility in [0, 1].
struct Figures {
  double smear_exposure_travel = 0;          // idle nozzles over foreign visible plastic while no nozzle extrudes
  double smear_exposure_print = 0;           // while another nozzle extrudes
  double smear_exposure_travel_visible = 0;  // each mm times v
  double smear_exposure_print_visible = 0;
  double inner_exposure_travel = 0;  // over foreign plastic that is not visible
  double inner_exposure_print = 0;
  double smear_volume_travel = 0;  // ooze left on foreign plastic, times v
  double smear_volume_print = 0;
  double inner_volume_travel = 0;  // and the rest: on inner plastic, and 1 - v of that on visible plastic
  double inner_volume_print = 0;
  double own_volume = 0;       // left on visible plastic of the nozzle's own colour, times v
  double hole_volume = 0;      // missing while an outer wall is printed, times v
  double zippers = 0;          // starts and ends of extrusion on outer walls
  double zippers_visible = 0;  // sum of v
  double wipes = 0;            // crossings of auxiliary plastic by a carrying nozzle
  double wiped_volume = 0;
  double refills = 0;  // refill passes
  double refill_volume = 0;
  double tool_changes = 0;

  double smear_volume() const { return smear_volume_travel + smear_volume_print; }
  double inner_volume() const { return inner_volume_travel + inner_volume_print; }

  Figures& operator+=(const Figures& other);
};

/// One figure of the table: its public name, unit and meaning, and how to read it.
struct FigureInfo {
  std::string_view name;  // "smear_volume"
  std::string_view unit;  // "mm3", "mm", "1"
  std::string_view help;  // one line
  double (*of)(const Figures&);
  bool main = false;  // shown in the short table
};

/// In the order in which they are shown.
std::span<const FigureInfo> figure_table();

/// nullptr where there is none of this name.
const FigureInfo* find_figure(std::string_view name);

}  // namespace cleancolor
