// All seeds and findings of the fuzz target, re-planned as the target does.
#include <gtest/gtest.h>

#include <filesystem>

#include "../../fuzz/replan_target.hpp"
#include "replanning.hpp"

namespace cleancolor {
namespace {

TEST(ReplanReplay, PlansOrRefusesEverySeedAndFinding) {
  int count = 0;
  for (const char* kind : {"seeds", "findings"}) {
    const std::filesystem::path folder = std::filesystem::path(CLEANCOLOR_ROOT) / "fuzz" / kind / "replan";
    if (!std::filesystem::exists(folder)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      SCOPED_TRACE(entry.path().string());
      fuzz_replan(file_text(entry.path()));
      ++count;
    }
  }
  EXPECT_GT(count, 0) << "no seeds in fuzz/seeds/replan";
}

TEST(ReplanReplay, PlansEverySeed) {
  for (const auto& entry : std::filesystem::directory_iterator(CLEANCOLOR_ROOT "/fuzz/seeds/replan")) {
    SCOPED_TRACE(entry.path().string());
    EXPECT_TRUE(test::replanned_text(file_text(entry.path())).changed);
  }
}

}  // namespace
}  // namespace cleancolor
