#include "audit/machine.hpp"

#include <gtest/gtest.h>

#include "reader/read.hpp"
#include "support_errors.hpp"

namespace cleancolor {
namespace {

// Twelve lines of tool 0 along X, and as many of tool 1 beside them:
//
//   00000000001111111111      tool 1 lies at x = 10 ... 20
//   00000000001111111111
//
// shift: how far the numbers of tool 1 in the file are from where its plastic lies.
std::string two_blocks(double shift, const std::string& head = "", const std::string& tail = "") {
  std::string text = head + "M83\nG1 Z0.3 F6000\n";
  for (int tool = 0; tool < 2; ++tool) {
    text += "T" + std::to_string(tool) + "\n;TYPE:Solid infill\n";
    const double x = tool * 10 + (tool == 1 ? shift : 0);
    for (int row = 0; row < 24; ++row) {
      const std::string y = std::to_string(row * 0.4);
      text += "G1 X" + std::to_string(x + 0.2) + " Y" + y + "\nG1 X" + std::to_string(x + 9.8) + " Y" + y + " E0.4\n";
    }
  }
  return text + tail;
}

const std::vector<Vec2> offsets = {{0, 0}, {33, 0}};

TEST(AuditMachine, TakesWhatTheUserSays) {
  const GcodePrint print = read_gcode(two_blocks(-33), "a.gcode");
  const AuditMachine machine = audit_machine(print, {.nozzle_offset_mm = offsets, .offsets_in = OffsetsIn::slicer});
  EXPECT_EQ(machine.nozzles[1].offset_mm, (Vec2{33, 0}));
  EXPECT_EQ(machine.offsets_in, OffsetsIn::slicer);
  EXPECT_EQ(machine.offsets_source, "--nozzle-offset");
  EXPECT_EQ(plastic_mm(machine, {-20, 5}, 1), (Vec2{13, 5}));
  EXPECT_EQ(carriage_mm(machine, {-20, 5}, 1), (Vec2{-20, 5}));
}

TEST(AuditMachine, TakesOffsetsFromTheFile) {
  const GcodePrint print = read_gcode(two_blocks(-33, "", "; extruder_offset = 0x0,33x0\n"), "a.gcode");
  Warned warned;
  const AuditMachine machine = audit_machine(print, {}, warned.progress);
  EXPECT_EQ(machine.nozzles[1].offset_mm, (Vec2{33, 0}));
  EXPECT_EQ(machine.offsets_in, OffsetsIn::slicer);
  EXPECT_TRUE(warned.warnings.empty());
}

TEST(AuditMachine, SeesFromThePlasticWhoAppliesTheOffsets) {
  for (const bool slicer : {true, false}) {
    const GcodePrint print = read_gcode(two_blocks(slicer ? -33 : 0), "a.gcode");
    Warned warned;
    const AuditMachine machine = audit_machine(print, {.nozzle_offset_mm = offsets}, warned.progress);
    EXPECT_EQ(machine.offsets_in, slicer ? OffsetsIn::slicer : OffsetsIn::firmware);
    ASSERT_EQ(warned.warnings.size(), 1u) << "a guess is told";
  }
}

TEST(AuditMachine, WarnsWhereTheUsersWordContradictsThePlastic) {
  const GcodePrint print = read_gcode(two_blocks(-33), "a.gcode");
  Warned warned;
  audit_machine(print, {.nozzle_offset_mm = offsets, .offsets_in = OffsetsIn::firmware}, warned.progress);
  ASSERT_EQ(warned.warnings.size(), 1u);
  EXPECT_NE(warned.warnings[0].find("--offsets-in slicer"), std::string::npos) << warned.warnings[0];
}

TEST(AuditMachine, AsksWhereNothingTells) {
  const GcodePrint print = read_gcode(two_blocks(0), "a.gcode");
  EXPECT_ERROR(audit_machine(print, {}), "--nozzle-offset 0x0,33x0");
  const GcodePrint zeroes = read_gcode(two_blocks(0, "", "; extruder_offset = 0x0,0x0\n"), "a.gcode");
  EXPECT_ERROR(audit_machine(zeroes, {}), "--nozzle-offset 0x0,33x0 --offsets-in firmware");
}

TEST(AuditMachine, AsksForAnOffsetOfEveryNozzle) {
  const GcodePrint print = read_gcode(two_blocks(0), "a.gcode");
  EXPECT_ERROR(audit_machine(print, {.nozzle_offset_mm = {{0, 0}}}), "offsets of 1 are given");
}

TEST(AuditMachine, OneNozzleNeedsNoOffsets) {
  const GcodePrint print = read_gcode("M83\nG1 X0 Y0 Z0.3 F1200\nG1 X10 E1\n", "a.gcode");
  Warned warned;
  EXPECT_EQ(audit_machine(print, {}, warned.progress).nozzles.size(), 1u);
  EXPECT_TRUE(warned.warnings.empty());
}

TEST(AuditMachine, TakesLimitsFilamentAndColoursFromTheFile) {
  const GcodePrint print =
      read_gcode(two_blocks(-33, "",
                            "; extruder_offset = 0x0,33x0\n; filament_diameter = 2.85,2.85\n"
                            "; filament_colour = #FF0000;#00FF00\n; machine_max_acceleration_x = 777,777\n"
                            "; nozzle_diameter = 0.4,0.4\n"),
                 "a.gcode");
  const AuditMachine machine = audit_machine(print, {});
  EXPECT_DOUBLE_EQ(machine.limits.max_acceleration_mm_s2[0], 777);
  EXPECT_DOUBLE_EQ(machine.nozzles[0].filament_diameter_mm, 2.85);
  EXPECT_EQ(machine.nozzles[1].rgb, 0x00FF00u);
}

TEST(AuditMachine, ColoursThatCannotBeToldApartBecomeAPalette) {
  const GcodePrint print =
      read_gcode(two_blocks(-33, "", "; extruder_offset = 0x0,33x0\n; filament_colour = #FF8000;#FF8000\n"), "a.gcode");
  const AuditMachine machine = audit_machine(print, {});
  EXPECT_NE(machine.nozzles[0].rgb, machine.nozzles[1].rgb);
}

/// A printer whose second nozzle is `x` mm to the right.
Config printer(double x, OffsetsIn in) {
  Config config;
  config.printer_model = "two nozzles";
  config.extruders.resize(2);
  config.extruders[1].nozzle_offset_mm = {x, 0};
  config.offsets_in = in;
  config.machine_max_feedrate_mm_s = {77, 77, 7};
  config.idle_nozzle = IdleNozzle::lifted;
  return config;
}

TEST(AuditMachine, TheFileSaysWhereItsPlasticLiesWhateverThePrinterDoes) {
  const GcodePrint print = read_gcode(two_blocks(-33, "", "; extruder_offset = 0x0,33x0\n"), "a.gcode");
  Warned warned;
  const AuditMachine machine = audit_machine(print, {.printer = printer(33, OffsetsIn::firmware)}, warned.progress);
  EXPECT_EQ(machine.offsets_in, OffsetsIn::slicer);
  EXPECT_EQ(machine.offsets_source, "printer two nozzles");
  EXPECT_TRUE(warned.warnings.empty());
}

TEST(AuditMachine, WarnsWhereThePrinterHasOtherNozzlesThanTheFile) {
  const GcodePrint print = read_gcode(two_blocks(-33, "", "; extruder_offset = 0x0,33x0\n"), "a.gcode");
  Warned warned;
  const AuditMachine machine = audit_machine(print, {.printer = printer(33.2, OffsetsIn::firmware)}, warned.progress);
  EXPECT_EQ(machine.nozzles[1].offset_mm, (Vec2{33.2, 0}));
  ASSERT_EQ(warned.warnings.size(), 1u);
  EXPECT_NE(warned.warnings[0].find("0x0,33x0"), std::string::npos) << warned.warnings[0];
}

TEST(AuditMachine, ThePrinterOfTheUserWinsOverTheLimitsOfTheFile) {
  const GcodePrint print =
      read_gcode(two_blocks(0, "", "; machine_max_feedrate_x = 500\n; nozzle_diameter = 0.4,0.4\n"), "a.gcode");
  const AuditMachine machine = audit_machine(print, {.printer = printer(33, OffsetsIn::firmware)});
  EXPECT_DOUBLE_EQ(machine.limits.max_speed_mm_s[0], 77);
  EXPECT_EQ(machine.idle_nozzle, IdleNozzle::lifted);
  const AuditMachine told =
      audit_machine(print, {.printer = printer(33, OffsetsIn::firmware), .idle_nozzle = IdleNozzle::docked});
  EXPECT_EQ(told.idle_nozzle, IdleNozzle::docked);
}

TEST(AuditMachine, WhatThePrinterAndThePlasticSayAlikeIsNoWarning) {
  const GcodePrint print = read_gcode(two_blocks(0), "a.gcode");
  Warned warned;
  EXPECT_EQ(audit_machine(print, {.printer = printer(33, OffsetsIn::firmware)}, warned.progress).offsets_in,
            OffsetsIn::firmware);
  EXPECT_TRUE(warned.warnings.empty());
  EXPECT_EQ(audit_machine(print, {.printer = printer(33, OffsetsIn::slicer)}, warned.progress).offsets_in,
            OffsetsIn::firmware);
  EXPECT_EQ(warned.warnings.size(), 1u);
}

TEST(AuditMachine, OffsetsAreSeenFromNozzleZero) {
  const GcodePrint print = read_gcode(two_blocks(0), "a.gcode");
  const AuditMachine machine =
      audit_machine(print, {.nozzle_offset_mm = {{-10, 1}, {23, 2}}, .offsets_in = OffsetsIn::firmware});
  EXPECT_EQ(machine.nozzles[0].offset_mm, (Vec2{0, 0}));
  EXPECT_EQ(machine.nozzles[1].offset_mm, (Vec2{33, 1}));
}

TEST(AuditMachine, FilamentChangedInOneNozzleOozesFromNoOther) {
  const GcodePrint print =
      read_gcode(two_blocks(0, "", "; extruder_offset = 0x0,0x0\n; single_extruder_multi_material = 1\n"), "a.gcode");
  EXPECT_ERROR(audit_machine(print, {}), "one nozzle");
}

TEST(AuditMachine, LimitsThatCannotBeReadAreWarnedOf) {
  const GcodePrint print =
      read_gcode(two_blocks(-33, "", "; extruder_offset = 0x0,33x0\n; machine_max_feedrate_x = fast\n"), "a.gcode");
  Warned warned;
  const AuditMachine machine = audit_machine(print, {}, warned.progress);
  ASSERT_EQ(warned.warnings.size(), 1u);
  EXPECT_NE(warned.warnings[0].find("machine_max_feedrate_x"), std::string::npos) << warned.warnings[0];
  EXPECT_DOUBLE_EQ(machine.limits.max_speed_mm_s[0], Config{}.machine_max_feedrate_mm_s.x);
}

}  // namespace
}  // namespace cleancolor
