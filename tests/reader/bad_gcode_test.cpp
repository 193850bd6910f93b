// What is refused, and what is said then.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "reader/read.hpp"
#include "support_errors.hpp"

namespace cleancolor {
namespace {

const std::string good = "G1 X0 Y0 Z0.2 F600\nG1 X10 E1\n";

std::string said(const std::string& text) {
  return error_of([&] { (void)read_gcode(text, "a.gcode"); });
}

void expect_at_line(const std::string& text, int line, const std::string& words) {
  const std::string error = said(text);
  EXPECT_TRUE(error.starts_with(fmt::format("a.gcode:{}: ", line))) << error;
  EXPECT_NE(error.find(words), std::string::npos) << error;
}

TEST(BadGcode, TheGoodFileIsGood) {
  EXPECT_EQ(said(good), "no error");
}

TEST(BadGcode, EmptyAndWithoutPlastic) {
  EXPECT_NE(said("").find("empty"), std::string::npos);
  EXPECT_NE(said("\n\n").find("no move lays plastic"), std::string::npos);
  EXPECT_NE(said("; only words\nG28\nG1 X10 Y10 Z1\nG1 E5\n").find("no move lays plastic"), std::string::npos);
  EXPECT_NE(said("solid cube\nfacet normal 0 0 1\nouter loop\n").find("no move lays plastic"), std::string::npos);
  EXPECT_NE(said("<html><body>404: not found</body></html>\n").find("no move lays plastic"), std::string::npos);
}

TEST(BadGcode, BinaryKindsAreNamed) {
  const std::string bgcode = said(std::string("GCDE\x01\x00\x00\x00\x01\x00", 10));
  EXPECT_NE(bgcode.find("binary G-code"), std::string::npos) << bgcode;
  EXPECT_NE(bgcode.find("Supports binary G-code"), std::string::npos) << bgcode;
  EXPECT_NE(said("PK\x03\x04" + good).find("zip"), std::string::npos);
  expect_at_line(good + std::string("G1 X\0 1\n", 8), 3, "binary");
}

TEST(BadGcode, CutOffInTheMiddleOfAMove) {
  for (const char* end : {"G1 X12.3 Y", "G1 X12.3 Y-", "G1 X12.3 Y.", "G1 X", "G92 E", "G2 X1 Y1 I"})
    expect_at_line(good + end, 3, "cut off");
  // Without a line end, but whole.
  EXPECT_EQ(said(good + "G1 X12.3 Y4"), "no error");
  EXPECT_EQ(said(good + "; the end"), "no error");
}

TEST(BadGcode, NumbersThatAreNone) {
  for (const char* line : {"G1 Xnan Y1", "G1 Xinf Y1", "G1 X-inf", "G1 X Y1 Z1", "G1 E--1", "G92 X", "G1 F"})
    expect_at_line(good + line + "\n" + good, 3, "has no number");
  for (const char* line : {"G1 X1.2.3", "G1 X1..2", "G1 X1-2"}) expect_at_line(good + line + "\n" + good, 3, "number");
}

TEST(BadGcode, FartherThanAnyPrinter) {
  for (const char* line : {"G1 X10001", "G1 Z-10001", "G92 X20000", "G1 X1000000000000000000000000000000000000000",
                           "G2 X1 Y1 I20000 J0", "G1 X1 E10002"})
    expect_at_line(good + line + "\n", 3, "damaged");
  expect_at_line(good + "G91\nG1 X9000\nG1 X9000\n", 5, "10 m");
  expect_at_line(good + "G1 X" + std::string(400, '9') + "\n", 3, "10 m");
}

TEST(BadGcode, ToolsThatNoPrinterHas) {
  for (const char* line : {"T16", "T99", "M108 T20", "M135 T-2", "M6 T1000", "ACTIVATE_EXTRUDER EXTRUDER=extruder77"})
    expect_at_line(good + line + "\n", 3, "tool");
  EXPECT_EQ(said(good + "T15\nT255\nT1000\nT1100\nT-1\nT?\nTx\nT\n"), "no error");
}

TEST(BadGcode, WrongChecksum) {
  expect_at_line("N1 G90*17\nN2 G91*18\n", 2, "checksum");
}

TEST(BadGcode, EndlessLine) {
  expect_at_line(good + "G1 " + std::string(2 << 20, 'X') + "\n", 3, "1 MB");
  EXPECT_EQ(said(good + ";" + std::string(2 << 20, 'X') + "\n"), "no error");
  EXPECT_EQ(said(good + "G1 X1 ;" + std::string(2 << 20, 'X') + "\n"), "no error");
}

TEST(BadGcode, FilesThatAreNotThere) {
  const TestFolder folder;
  EXPECT_ERROR(read_gcode_file(folder.path("none.gcode")), "none.gcode: there is no such file");
  EXPECT_ERROR(read_gcode_file(folder.path("")), "this is not a file");
}

TEST(BadGcode, AnInterruptIsHeard) {
  Progress progress;
  progress.interrupted = [] { return true; };
  EXPECT_ERROR(read_gcode(good, "a.gcode", progress), "interrupted");
}

// Every cut of a file is either read or refused with its name.
TEST(BadGcode, AnyPrefixIsReadOrRefused) {
  const std::string text = file_text(CLEANCOLOR_ROOT "/fuzz/seeds/gcode/prusa");
  for (std::size_t size = 0; size < text.size(); ++size) {
    const std::string error = said(text.substr(0, size));
    ASSERT_TRUE(error == "no error" || error.starts_with("a.gcode:")) << size << ": " << error;
  }
}

}  // namespace
}  // namespace cleancolor
