// All seeds and findings of the fuzz targets, read as the targets read them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "../../fuzz/config_targets.hpp"
#include "../../fuzz/model_targets.hpp"

namespace cleancolor {
namespace {

void replay(const std::string& target, void (*read)(std::string_view)) {
  std::size_t count = 0;
  for (const char* kind : {"seeds", "findings"}) {
    const std::filesystem::path folder = std::filesystem::path(CLEANCOLOR_ROOT) / "fuzz" / kind / target;
    if (!std::filesystem::exists(folder)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      SCOPED_TRACE(entry.path().string());
      std::ifstream file(entry.path(), std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(file), {}};
      read(bytes);
      ++count;
    }
  }
  EXPECT_GT(count, 0) << "no seeds in fuzz/seeds/" << target;
}

TEST(Replay, ReadsEverySeedAndFindingOfStl) {
  replay("stl", fuzz_stl);
}
TEST(Replay, ReadsEverySeedAndFindingOfObj) {
  replay("obj", fuzz_obj);
}
TEST(Replay, ReadsEverySeedAndFindingOfPly) {
  replay("ply", fuzz_ply);
}
TEST(Replay, ReadsEverySeedAndFindingOfAmf) {
  replay("amf", fuzz_amf);
}
TEST(Replay, ReadsEverySeedAndFindingOf3mf) {
  replay("3mf", fuzz_3mf);
}
TEST(Replay, ReadsEverySeedAndFindingOfToml) {
  replay("toml", fuzz_toml);
}
TEST(Replay, ReadsEverySeedAndFindingOfIni) {
  replay("ini", fuzz_ini);
}

}  // namespace
}  // namespace cleancolor
