#include "replan/same_print.hpp"

#include <gtest/gtest.h>

#include "replanning.hpp"

namespace cleancolor {
namespace {

using namespace test;

/// Roads of 10 m, 1 mm apart; the first ones moved by so much.
GcodePrint long_roads(int count, int moved = 0, double by_mm = 0) {
  std::string text = "M83\nG1 Z0.3 F600\n";
  for (int i = 0; i < count; ++i) {
    const double y = i + (i < moved ? by_mm : 0);
    text += fmt::format("G0 X-5000 Y{0:g}\nG1 X5000 Y{0:g} E300\n", y);
  }
  return read_gcode(text, "long.gcode");
}

TEST(SamePrint, ComparesManyRoadsOfMetresInLittleMemory) {
  const GcodePrint print = long_roads(4000);
  const AuditMachine machine = audit_machine(print, {});
  EXPECT_EQ(difference(print, print, machine), std::nullopt);
  EXPECT_TRUE(difference(print, long_roads(4000, 200, 5000), machine).has_value());
}

}  // namespace
}  // namespace cleancolor
