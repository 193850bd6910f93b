#include <gtest/gtest.h>

#include "base/duration_text.hpp"
#include "base/printable.hpp"

namespace cleancolor {
namespace {

TEST(Duration, IsTextThatAPersonReads) {
  EXPECT_EQ(duration_text(0), "0 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(59.6), "1 min 00 s");
  EXPECT_EQ(duration_text(200), "3 min 20 s");
  EXPECT_EQ(duration_text(3599.7), "1 h 00 min");
  EXPECT_EQ(duration_text(26 * 3600), "26 h 00 min");
}

TEST(Printable, KeepsLettersOfAnyLanguage) {
  EXPECT_EQ(printable("Würfel 立方体 🧊 <b>&\"'"), "Würfel 立方体 🧊 <b>&\"'");
  EXPECT_EQ(printable(""), "");
}

TEST(Printable, LeavesNothingThatMovesACursor) {
  EXPECT_EQ(printable("a\x1b[2Jb\r\n\tc\x7f"), "a?[2Jb???c?");
  EXPECT_EQ(printable("a\xc2\x9b"
                      "b"),
            "a?b");  // U+009B: what ESC [ is in one character
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b"),
            "a?b");  // U+202E: from here on right to left
}

TEST(Printable, LeavesNothingThatIsNoUtf8) {
  EXPECT_EQ(printable("a\xff"
                      "b\xc3"),
            "a?b?");                                 // a byte that never stands in it, and one cut off
  EXPECT_EQ(printable("\xc0\xaf"), "??");            // "/" in two bytes
  EXPECT_EQ(printable("\xed\xa0\x80"), "???");       // half of a pair
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "????");  // beyond the last character
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a?b");
}

}  // namespace
}  // namespace cleancolor
