// Whatever the reader lets through can be explained.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>

#include "base/error.hpp"
#include "explain/drawn_plan.hpp"
#include "explain/plan_picture.hpp"
#include "explain/plan_table.hpp"
#include "support_errors.hpp"

namespace cleancolor {
namespace {

/// Returns whether it could be read.
bool explain_all(const std::string& text) {
  const MachineRequest request{.nozzle_offset_mm = {{0, 0}, {33, 0}, {66, 0}, {0, 33}},
                               .offsets_in = OffsetsIn::slicer};
  try {
    const GcodePrint print = read_gcode(text, "bad.gcode");
    const AuditMachine machine = audit_machine(print, request);
    for (std::uint32_t layer = 0; layer < std::min<std::size_t>(3, print.layers.size()); ++layer) {
      const Explanation plan = explained(print, machine, layer);
      EXPECT_EQ(plan.runs.size(), plan.printed.runs.size());
      EXPECT_FALSE(plan_text(plan, print).empty());
      EXPECT_FALSE(plan_json(plan, print).empty());
      EXPECT_FALSE(plan_picture(print, {plan, machine}).svg().empty());
    }
  } catch (const Error&) {
    return false;
  }
  return true;
}

TEST(BadGcodeExplained, SamplesOfAllSlicers) {
  for (const auto& entry : std::filesystem::directory_iterator(CLEANCOLOR_ROOT "/tests/reader/samples")) {
    SCOPED_TRACE(entry.path());
    EXPECT_TRUE(explain_all(file_text(entry.path())));
  }
}

TEST(BadGcodeExplained, FarPlacesGiantStepsAndNoWidths) {
  for (const char* text : {
           "G1 X0 Y0 Z0.2 F600\nG1 X10 E1\n",
           "G1 X-9000 Y-9000 Z0.2 F600\nG1 X9000 Y9000 E1\n",
           "G1 X0 Y0 Z9000 F600\nG1 X10 E1\n",
           "M83\nG1 X0 Y0 Z0.2\nG1 X10 E1e-9\nG1 Z9000\nG1 X0 E10\nG1 Z0.4\nG1 Y9 E.1\n",
           "M83\nG1 X0 Y0 Z0.2\n;TYPE:External perimeter\nG1 X1 E.1\nG1 X0 E.1\nG1 X1 E.1\nG1 X0 E.1\n",
           "M83\nG1 X0 Y0 Z0.2\n;TYPE:External perimeter\nG1 X1e E.1\nT3\nG1 X1.0001 E9\nG28\nG1 X4 E1\nT2\nG1 X5 E1\n",
       }) {
    SCOPED_TRACE(text);
    explain_all(text);
  }
}

TEST(BadGcodeExplained, RandomDamage) {
  const std::string good = two_boxes(3).text();
  int read = 0;
  for (unsigned seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::string text = good;
    for (auto n = 1 + random() % 6; n > 0; --n) {
      const std::size_t at = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[at] = "0123456789.-GXYZETF \n;"[random() % 22];
          break;
        case 1:
          text.erase(at, random() % 40);
          break;
        default:
          text.insert(at, good.substr(random() % good.size(), random() % 60));
      }
    }
    read += explain_all(text);
  }
  EXPECT_GT(read, 30);
}

}  // namespace
}  // namespace cleancolor
