// The whole text of a tiny job in each flavour: one layer, a square of 10 mm by each of two extruders.

#include <gtest/gtest.h>

#include "gcode/jobs.hpp"

using namespace cleancolor;
using namespace cleancolor::test;

namespace {

std::string two_squares(Flavour flavour, OffsetsIn offsets_in, bool relative_e) {
  Config c = two_extruders(flavour, offsets_in);
  c.use_relative_e_distances = relative_e;
  Layer layer{.index = 0, .print_z_mm = 0.3, .height_mm = 0.3, .paths = {}, .fan_by_extruder = {0, 0.5}};
  layer.paths = {square(0, {0, 0}, 10), square(1, {20, 0}, 10)};
  const std::string text = written(c, {layer}).text;
  const std::size_t from = text.find("; nozzle_offset");
  return text.substr(from, text.find("; filament used [mm]") - from);
}

}  // namespace

TEST(Flavour, Marlin2StandsStillAtToolChangesAndCountsEFromZeroAfterThem) {
  EXPECT_EQ(two_squares(Flavour::marlin2, OffsetsIn::firmware, false), R"(; nozzle_offset = 0x0,33x0
; offsets_in = firmware

M107
M140 S60
M104 S215 T0
M104 S215 T1
M190 S60
;TYPE:Custom
G28
M109 S215 T0
M109 S215 T1
G21 ; set units to millimeters
G90 ; use absolute coordinates
T0 S1
M82 ; use absolute distances for extrusion
G92 E0
;LAYER_CHANGE
;Z:0.3
;HEIGHT:0.3
G1 E-.5 F1500
G1 Z.3 F7200
G1 X0 Y0
G1 E0 F1500
;TYPE:External perimeter
;WIDTH:0.4
G1 X10 E.41575 F1800
G1 Y10 E.8315
G1 X0 E1.24726
G1 Y0 E1.66301
G1 E.66301 F1500
G92 E0
T1 S1
G92 E0
M104 S0 T0
G1 E-.5 F1500
G1 X20 Y0 F7200
G1 Z.3
G1 E0 F1500
M106 S128
G1 X30 E.41575 F1800
G1 Y10 E.8315
G1 X20 E1.24726
G1 Y0 E1.66301
G1 E1.16301 F1500
M107
;TYPE:Custom
M84
)");
}

TEST(Flavour, KlipperGetsTheOffsetTakenOffAndRelativeE) {
  EXPECT_EQ(two_squares(Flavour::klipper, OffsetsIn::slicer, true), R"(; nozzle_offset = 0x0,33x0
; offsets_in = slicer

M107
M140 S60
M104 S215 T0
M104 S215 T1
M190 S60
;TYPE:Custom
G28
M109 S215 T0
M109 S215 T1
G21 ; set units to millimeters
G90 ; use absolute coordinates
T0
M83 ; use relative distances for extrusion
G92 E0
;LAYER_CHANGE
;Z:0.3
;HEIGHT:0.3
G1 E-.5 F1500
G1 Z.3 F7200
G1 X0 Y0
G1 E.5 F1500
;TYPE:External perimeter
;WIDTH:0.4
G1 X10 E.41575 F1800
G1 Y10 E.41575
G1 X0 E.41576
G1 Y0 E.41575
G1 E-1 F1500
T1
M104 S0 T0
G1 E-.5 F1500
G1 X-13 Y0 F7200
G1 Z.3
G1 E.5 F1500
M106 S128
G1 X-3 E.41575 F1800
G1 Y10 E.41575
G1 X-13 E.41576
G1 Y0 E.41575
G1 E-.5 F1500
M107
;TYPE:Custom
M84
)");
}

TEST(Flavour, ReprapfirmwareSetsTemperaturesByG10AndWaitsByM116) {
  EXPECT_EQ(two_squares(Flavour::reprapfirmware, OffsetsIn::firmware, true), R"(; nozzle_offset = 0x0,33x0
; offsets_in = firmware

M107
M140 S60
G10 P0 S215 R215
G10 P1 S215 R215
M190 S60
;TYPE:Custom
G28
M116 P0
M116 P1
G21 ; set units to millimeters
G90 ; use absolute coordinates
T0
M83 ; use relative distances for extrusion
G92 E0
;LAYER_CHANGE
;Z:0.3
;HEIGHT:0.3
G1 E-.5 F1500
G1 Z.3 F7200
G1 X0 Y0
G1 E.5 F1500
;TYPE:External perimeter
;WIDTH:0.4
G1 X10 E.41575 F1800
G1 Y10 E.41575
G1 X0 E.41576
G1 Y0 E.41575
G1 E-1 F1500
T1
G10 P0 S0 R0
G1 E-.5 F1500
G1 X20 Y0 F7200
G1 Z.3
G1 E.5 F1500
M106 S128
G1 X30 E.41575 F1800
G1 Y10 E.41575
G1 X20 E.41576
G1 Y0 E.41575
G1 E-.5 F1500
M107
;TYPE:Custom
M84
)");
}

TEST(Flavour, SailfishCountsEachToolOnItsOwnAxisAndNeverSetsBack) {
  EXPECT_EQ(two_squares(Flavour::sailfish, OffsetsIn::firmware, false), R"(; nozzle_offset = 0x0,33x0
; offsets_in = firmware

M127
M140 S60 T0
M104 S215 T0
M104 S215 T1
M134 T0
;TYPE:Custom
G28
M133 T0
M133 T1
G21 ; set units to millimeters
G90 ; use absolute coordinates
M108 T0
;LAYER_CHANGE
;Z:0.3
;HEIGHT:0.3
G1 A-.5 F1500
G1 Z.3 F7200
G1 X0 Y0
G1 A0 F1500
;TYPE:External perimeter
;WIDTH:0.4
G1 X10 A.41575 F1800
G1 Y10 A.8315
G1 X0 A1.24726
G1 Y0 A1.66301
G1 A.66301 F1500
M108 T1
M104 S0 T0
G1 B-.5 F1500
G1 X20 Y0 F7200
G1 Z.3
G1 B0 F1500
M126
G1 X30 B.41575 F1800
G1 Y10 B.8315
G1 X20 B1.24726
G1 Y0 B1.66301
G1 B1.16301 F1500
M127
;TYPE:Custom
M84
)");
}
