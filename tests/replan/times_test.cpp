#include "replan/times.hpp"

#include <gtest/gtest.h>

#include "replanning.hpp"

namespace cleancolor {
namespace {

using namespace test;

std::string corrected(const std::string& told, double longer) {
  std::string text = replaced(fixture("prusaslicer.gcode"), "(silent mode) = 6m 6s", "(silent mode) = " + told);
  const GcodePrint print = read_gcode(text, "in.gcode");
  correct_estimates(text, print, longer);
  return text;
}

TEST(ReplanTimes, EachEstimateIsLongerByItsOwnTime) {
  const std::string text = corrected("1d 2h 3m 10s", 1.5);
  EXPECT_NE(text.find("\n; estimated printing time (normal mode) = 9m 9s\n"), text.npos);
  EXPECT_NE(text.find("\n; estimated printing time (silent mode) = 1d 15h 4m 45s\n"), text.npos);
}

TEST(ReplanTimes, AnEstimateThatIsNoTimeStays) {
  EXPECT_NE(corrected("N/A", 1.5).find("\n; estimated printing time (silent mode) = N/A\n"), std::string::npos);
}

}  // namespace
}  // namespace cleancolor
