#include "base/output_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "base/error.hpp"

using namespace cleancolor;
namespace fs = std::filesystem;

namespace {

class OutputFileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::path(testing::TempDir()) /
             (std::string("cleancolor-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  static std::string content(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  std::size_t files() const { return std::size_t(std::distance(fs::directory_iterator(folder), {})); }

  fs::path folder;
};

}  // namespace

TEST_F(OutputFileTest, IsThereOnlyAfterCommit) {
  OutputFile file(folder / "a.gcode");
  file.write("G28\n");
  EXPECT_FALSE(fs::exists(folder / "a.gcode"));
  file.commit();
  EXPECT_EQ(content(folder / "a.gcode"), "G28\n");
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFileTest, WithoutCommitNothingIsLeftAndWhatWasThereStays) {
  write_file(folder / "a.gcode", "old");
  {
    OutputFile file(folder / "a.gcode");
    file.write(std::string(3 << 20, 'x'));
  }
  EXPECT_EQ(content(folder / "a.gcode"), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFileTest, PatchesReachBytesWrittenLongAgoAndJustNow) {
  std::string expected;
  OutputFile file(folder / "a");
  for (int i = 0; i < 300; ++i) {
    const std::string piece(20000, char('a' + i % 26));
    file.write(piece);
    expected += piece;
  }
  file.patch(5, "HELLO");
  file.patch(expected.size() - 3, "END");
  file.write("more");
  expected.replace(5, 5, "HELLO").replace(expected.size() - 3, 3, "END") += "more";
  EXPECT_EQ(file.size(), expected.size());
  file.commit();
  EXPECT_EQ(content(folder / "a"), expected);
}

TEST_F(OutputFileTest, FollowsALinkInsteadOfReplacingIt) {
  write_file(folder / "real", "old");
  fs::create_symlink(folder / "real", folder / "link");
  write_file(folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(content(folder / "real"), "new");
}

TEST_F(OutputFileTest, FailuresNamePathAndReason) {
  const auto failure = [](const fs::path& path) -> std::string {
    try {
      write_file(path, "x");
    } catch (const SystemError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(failure(folder / "missing/a").find("missing/a: cannot be created: No such file"), std::string::npos);
  EXPECT_NE(failure(folder).find("folder"), std::string::npos);
  EXPECT_NE(failure("/dev/null").find("regular"), std::string::npos);
  write_file(folder / "precious", "old");
  fs::permissions(folder / "precious", fs::perms::owner_read);
  EXPECT_NE(failure(folder / "precious").find("write-protected"), std::string::npos);
}

TEST_F(OutputFileTest, AFullDiscIsAnErrorAndLeavesNothing) {
  if (!fs::exists("/dev/shm") || ::geteuid() != 0) GTEST_SKIP() << "needs root to mount a small disc";
  const fs::path disc = folder / "disc";
  fs::create_directories(disc);
  if (std::system(("mount -t tmpfs -o size=1m none '" + disc.string() + "' 2>/dev/null").c_str()) != 0)
    GTEST_SKIP() << "cannot mount a small disc here";
  EXPECT_THROW(write_file(disc / "a", std::string(4 << 20, 'x')), SystemError);
  EXPECT_TRUE(fs::is_empty(disc));
  EXPECT_EQ(std::system(("umount '" + disc.string() + "'").c_str()), 0);
}
TEST_F(OutputFileTest, IsAsPrivateAsWhatItReplaces) {
  std::ofstream(folder / "mine") << "old";
  fs::permissions(folder / "mine", fs::perms::owner_read | fs::perms::owner_write);
  write_file(folder / "mine", "new");
  EXPECT_EQ(fs::status(folder / "mine").permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(content(folder / "mine"), "new");
}
