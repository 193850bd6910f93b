// All seeds and findings of the fuzz target, read as the target reads them.
#include <gtest/gtest.h>

#include <filesystem>

#include "../../fuzz/gcode_target.hpp"
#include "support_errors.hpp"

namespace cleancolor {
namespace {

TEST(ReaderReplay, ReadsEverySeedAndFindingOfGcode) {
  int count = 0;
  for (const char* kind : {"seeds", "findings"}) {
    const std::filesystem::path folder = std::filesystem::path(CLEANCOLOR_ROOT) / "fuzz" / kind / "gcode";
    if (!std::filesystem::exists(folder)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      SCOPED_TRACE(entry.path().string());
      fuzz_gcode(file_text(entry.path()));
      ++count;
    }
  }
  EXPECT_GT(count, 0) << "no seeds in fuzz/seeds/gcode";
}

// A seed that is refused is not worth much: the fuzzer learns nothing from it.
TEST(ReaderReplay, AcceptsEverySeed) {
  for (const auto& entry : std::filesystem::directory_iterator(CLEANCOLOR_ROOT "/fuzz/seeds/gcode")) {
    SCOPED_TRACE(entry.path().string());
    EXPECT_EQ(error_of([&] { (void)read_gcode_file(entry.path()); }), "no error");
  }
}

}  // namespace
}  // namespace cleancolor
