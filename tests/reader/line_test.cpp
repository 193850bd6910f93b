// One line of G-code taken apart.
#include "reader/line.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <string>

namespace cleancolor {
namespace {

GcodeLine parsed(std::string_view text) {
  GcodeLine line;
  const auto fault = parse_line(text, line);
  EXPECT_FALSE(fault) << text << ": " << fault.value_or("");
  return line;
}

std::optional<std::string_view> fault_of(std::string_view text) {
  GcodeLine line;
  return parse_line(text, line);
}

std::string with_checksum(const std::string& text) {
  int sum = 0;
  for (const char c : text) sum ^= static_cast<unsigned char>(c);
  return fmt::format("{}*{}", text, sum);
}

TEST(GcodeLine, IsCommandParametersAndComment) {
  const GcodeLine line = parsed("G1 X1.5 E.2 ; to the left");
  EXPECT_EQ(line.letter, 'G');
  EXPECT_EQ(line.number, 1);
  EXPECT_TRUE(line.has('X') && line.has_value('X') && line.has_value('E'));
  EXPECT_FALSE(line.has('Y'));
  EXPECT_EQ(line['X'], 1.5);
  EXPECT_EQ(line['E'], 0.2);
  EXPECT_TRUE(line.has_comment);
  EXPECT_EQ(line.comment, " to the left");
}

TEST(GcodeLine, NumbersAreThoseThatFirmwareReads) {
  const GcodeLine line = parsed("G1 X1. Y-.5 Z+2 E-0.03125 F007200 I0 J-0");
  EXPECT_EQ(line['X'], 1);
  EXPECT_EQ(line['Y'], -0.5);
  EXPECT_EQ(line['Z'], 2);
  EXPECT_EQ(line['E'], -0.03125);
  EXPECT_EQ(line['F'], 7200);
  EXPECT_EQ(line['I'], 0);
  EXPECT_EQ(line['J'], 0);
}

// As strtod reads them, which rounds correctly: to the last bit up to 15 digits.
TEST(GcodeLine, NumbersOfUpTo15DigitsAreExact) {
  std::mt19937 random(7);
  for (int i = 0; i < 20000; ++i) {
    const int digits = 1 + int(random() % 15), point = int(random() % unsigned(digits + 1));
    std::string text;
    for (int k = 0; k < digits; ++k) {
      if (k == point) text += '.';
      text += char('0' + random() % 10);
    }
    if (random() % 2 == 0) text = "-" + text;
    ASSERT_EQ(parsed("G1 X" + text)['X'], std::strtod(text.c_str(), nullptr)) << text;
  }
}

TEST(GcodeLine, LongNumbersAreReadToo) {
  EXPECT_NEAR(parsed("G1 X0.33333333333333333333333333333333333333")['X'], 1.0 / 3, 1e-15);
  EXPECT_NEAR(parsed("G1 X123456789012345678901")['X'], 123456789012345678901.0, 1e6);
}

TEST(GcodeLine, NeedsNoBlanksAndKnowsSmallLetters) {
  for (const char* text : {"G1X1Y-2E.5", "g1x1y-2e.5", "  G1\tX1   Y-2 E.5 ", "G01 X 1 Y -2 E .5", "G1 X1 Y-2 E.5\r",
                           "N12 G1 X1 Y-2 E.5", "G1 (move) X1 (and) Y-2 E.5"}) {
    SCOPED_TRACE(text);
    const GcodeLine line = parsed(text);
    EXPECT_EQ(line.letter, 'G');
    EXPECT_EQ(line.number, 1);
    EXPECT_EQ(line['X'], 1);
    EXPECT_EQ(line['Y'], -2);
    EXPECT_EQ(line['E'], 0.5);
    EXPECT_FALSE(line.has_comment);
  }
}

// "1e5" is X1 and then E5 to firmware; a number never swallows the letter of the next parameter.
TEST(GcodeLine, KnowsNoExponents) {
  const GcodeLine line = parsed("G1 X1E5");
  EXPECT_EQ(line['X'], 1);
  EXPECT_EQ(line['E'], 5);
}

TEST(GcodeLine, NanAndInfAreNoNumbers) {
  for (const char* text : {"G1 Xnan Y1", "G1 Xinf Y1", "G1 X-inf Y1", "G1 X Y1"}) {
    GcodeLine line;
    const auto fault = parse_line(text, line);
    EXPECT_TRUE(fault || (line.has('X') && !line.has_value('X'))) << text;
  }
}

TEST(GcodeLine, NumbersThatAreNoneAreFaults) {
  for (const char* text : {"G1 X1.2.3", "G1 X1..2", "G0 Y1-2"}) {
    GcodeLine line;
    const auto fault = parse_line(text, line);
    EXPECT_TRUE(fault) << text;
  }
}

TEST(GcodeLine, FractionsOfCommandsAreKept) {
  const GcodeLine line = parsed("G92.1 X1");
  EXPECT_EQ(line.number, 92);
  EXPECT_EQ(line.fraction, 1);
}

TEST(GcodeLine, ToolWords) {
  EXPECT_EQ(parsed("T1").letter, 'T');
  EXPECT_EQ(parsed("T1").number, 1);
  EXPECT_EQ(parsed("t12 S1").number, 12);
  EXPECT_EQ(parsed("T-1").number, -1);
  EXPECT_EQ(parsed("T?").number, -1);
  EXPECT_EQ(parsed("T1 P0").present, 1u << ('P' - 'A'));
}

TEST(GcodeLine, CommandsInWords) {
  const GcodeLine line = parsed("SET_VELOCITY_LIMIT ACCEL=1000 SQUARE_CORNER_VELOCITY=5.5 ; fast");
  EXPECT_EQ(line.letter, 0);
  EXPECT_EQ(line.word, "SET_VELOCITY_LIMIT");
  EXPECT_EQ(word_argument(line.arguments, "ACCEL"), 1000);
  EXPECT_EQ(word_argument(line.arguments, "SQUARE_CORNER_VELOCITY"), 5.5);
  EXPECT_EQ(word_argument(line.arguments, "VELOCITY"), std::nullopt);
  EXPECT_EQ(line.comment, " fast");
  EXPECT_EQ(word_argument("accel=7", "ACCEL"), 7);
  EXPECT_EQ(word_argument("ACCEL=fast", "ACCEL"), std::nullopt);
  EXPECT_EQ(word_argument("", "ACCEL"), std::nullopt);
}

TEST(GcodeLine, CommentsAloneAndNothingAtAll) {
  EXPECT_EQ(parsed(";TYPE:Custom").comment, "TYPE:Custom");
  EXPECT_EQ(parsed("  ; a ; b").comment, " a ; b");
  for (const char* text : {"", "   ", "\r", "(only this)", "%"}) {
    const GcodeLine line = parsed(text);
    EXPECT_EQ(line.letter, 0) << text;
    EXPECT_TRUE(line.word.empty()) << text;
    EXPECT_FALSE(line.has_comment) << text;
  }
  EXPECT_TRUE(parsed("G1 X1;").has_comment);
}

TEST(GcodeLine, TextInQuotesIsNotTakenForParameters) {
  const GcodeLine line = parsed(R"(M98 P"home X1 ; Y2.g" S3)");
  EXPECT_TRUE(line.has('P'));
  EXPECT_FALSE(line.has('X'));
  EXPECT_FALSE(line.has_comment);
  EXPECT_EQ(line['S'], 3);
}

TEST(GcodeLine, ChecksumsAreVerified) {
  const std::string text = with_checksum("N17 G1 X1.5 E.2 ; to the left");  // the line has views into it
  const GcodeLine line = parsed(text);
  EXPECT_EQ(line['X'], 1.5);
  EXPECT_EQ(line.comment, " to the left");
  EXPECT_EQ(parsed(with_checksum("N17 G1 X1.5 "))['X'], 1.5);
  EXPECT_EQ(parsed(with_checksum("N17 G1 X1.5") + "\r")['X'], 1.5);

  // One digit changed.
  std::string damaged = with_checksum("N17 G1 X1.5 E.2");
  damaged[8] = '4';
  const auto fault = fault_of(damaged);
  ASSERT_TRUE(fault);
  EXPECT_NE(fault->find("checksum"), std::string_view::npos);
}

TEST(GcodeLine, AStarInACommentIsNoChecksum) {
  EXPECT_EQ(parsed("; 3*4 = 12").comment, " 3*4 = 12");
  EXPECT_EQ(parsed("G1 X1 ; 3*4 = 12").comment, " 3*4 = 12");
}

TEST(GcodeLine, NothingIsLeftOfTheLineBefore) {
  GcodeLine line;
  (void)parse_line("G1 X1 Y2 ; words", line);
  (void)parse_line("SET_FAN_SPEED SPEED=1", line);
  (void)parse_line("M104 S5", line);
  EXPECT_TRUE(line.word.empty());
  EXPECT_FALSE(line.has('X'));
  EXPECT_FALSE(line.has_comment);
  EXPECT_EQ(line.arguments, " S5");
}

}  // namespace
}  // namespace cleancolor
