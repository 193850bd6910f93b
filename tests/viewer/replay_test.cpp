// All seeds and findings of the fuzz target, read as the target reads them.
#include <gtest/gtest.h>

#include "../../fuzz/request_target.hpp"
#include "support_errors.hpp"

namespace cleancolor {
namespace {

TEST(ViewerReplay, ReadsEverySeedAndFindingOfRequests) {
  int count = 0;
  for (const char* kind : {"seeds", "findings"}) {
    const std::filesystem::path folder = std::filesystem::path(CLEANCOLOR_ROOT) / "fuzz" / kind / "request";
    if (!std::filesystem::exists(folder)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      SCOPED_TRACE(entry.path().string());
      fuzz_request(file_text(entry.path()));
      ++count;
    }
  }
  EXPECT_GT(count, 0) << "no seeds in fuzz/seeds/request";
}

TEST(ViewerReplay, AcceptsTheJobsAmongTheSeeds) {
  for (const char* name : {"job.json", "least.json"})
    EXPECT_EQ(
        error_of([&] { (void)job_request(file_text(std::string(CLEANCOLOR_ROOT "/fuzz/seeds/request/") + name), {}); }),
        "no error");
}

}  // namespace
}  // namespace cleancolor
