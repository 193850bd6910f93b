// Files as no slicer writes them on purpose, but custom G-code, unusual settings or damage do.

#include <gtest/gtest.h>

#include <chrono>

#include "replan/recovered.hpp"
#include "replanning.hpp"

namespace cleancolor {
namespace {

using namespace test;

RecoveredPrint recovered_text(const std::string& text) {
  return recovered_print(read_gcode(text, "in.gcode"));
}

TEST(ReplanRobust, AToolThatIsNoneInATowerIsRefused) {
  const std::string text = fixture("prusaslicer-tower.gcode");
  const std::size_t tower = text.find("; CP TOOLCHANGE WIPE");
  for (const char* tool : {"T-1", "T255", "T1000"}) {
    SCOPED_TRACE(tool);
    EXPECT_ERROR(recovered_text(with_line(text, tool, "G1 ", tower)), "a tool change that is not understood");
  }
}

TEST(ReplanRobust, AWipeOfNoLengthIsDrawnBackOnTheSpot) {
  const std::string text =
      replaced(fixture("prusaslicer-wipe.gcode"), "G1 X5.88 Y-.253 E3.12246", "G1 X7.4012 Y-.23 E3.12246");
  const GcodePrint print = read_gcode(replanned_text(text).text, "");
  for (const GcodeMove& move : print.moves) EXPECT_LT(std::abs(move.filament_mm), 5);
  EXPECT_NE(print.text->find(";WIPE_START"), std::string::npos);
}

}  // namespace
}  // namespace cleancolor
