#include "cli/console.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace cleancolor {
namespace {

TEST(Console, PrintsOneLinePerStageWhereThereIsNoTerminal) {
  std::ostringstream out;
  Console console(out, {});
  const Progress progress = console.progress();
  progress.advance("reading", 0);
  progress.advance("reading", 0.5);
  progress.advance("slicing", 0);
  progress.warn("mended 2 holes");
  progress.advance("slicing", 1);
  EXPECT_EQ(out.str(), "reading\nslicing\nwarning: mended 2 holes\n");
}

TEST(Console, RedrawsABarOnATerminalAndRemovesItForOtherText) {
  std::ostringstream out;
  Console console(out, {.terminal = true, .quiet = false});
  const Progress progress = console.progress();
  progress.advance("slicing", 0.5);
  const std::string bar = "\r[###############               ] slicing 50%";
  EXPECT_EQ(out.str(), bar);
  progress.advance("slicing", 0.5001);
  EXPECT_EQ(out.str(), bar) << "the same percentage is not drawn again";
  progress.warn("mended");
  EXPECT_EQ(out.str(), bar + "\r" + std::string(bar.size() - 1, ' ') + "\r" + "warning: mended\n");
}

TEST(Console, CoversALongerBarWhole) {
  std::ostringstream out;
  Console console(out, {.terminal = true, .quiet = false});
  console.progress().advance("a long stage", 1);
  const std::size_t length = out.str().size();
  console.progress().advance("b", 0);
  EXPECT_EQ(out.str().size(), 2 * length);
}

TEST(Console, WhenQuietStillWarnsButOncePerText) {
  std::ostringstream out;
  Console console(out, {.terminal = true, .quiet = true});
  const Progress progress = console.progress();
  progress.advance("slicing", 0.5);
  progress.warn("a");
  progress.warn("b");
  progress.warn("a");
  EXPECT_EQ(out.str(), "warning: a\nwarning: b\n");
  EXPECT_EQ(console.warnings(), (std::vector<std::string>{"a", "b"}));
}

}  // namespace
}  // namespace cleancolor
