#include "replan/modal.hpp"

#include <gtest/gtest.h>

namespace cleancolor {
namespace {

ModalState after(const std::vector<std::string>& lines) {
  ModalState state;
  for (const std::string& text : lines) {
    GcodeLine line;
    EXPECT_FALSE(parse_line(text, line));
    const auto what = modal_line(line);
    EXPECT_TRUE(what) << text;
    if (what) take(state, *what, text);
  }
  return state;
}

using Lines = std::vector<std::string>;

TEST(Modal, SaysOnlyWhatDiffers) {
  const ModalState a = after({";TYPE:Perimeter", ";WIDTH:0.4", "M106 S100", "M204 P800"});
  const ModalState b = after({";TYPE:Perimeter", ";WIDTH:0.5", "M106 S100", "M204 P500"});
  EXPECT_EQ(lines_between(a, b), (Lines{";WIDTH:0.5", "M204 P500"}));
  EXPECT_TRUE(lines_between(a, a).empty());
}

TEST(Modal, KeepsApartWhatOneCommandSetsForSeveralThings) {
  const ModalState state = after({"M204 P800", "M204 T1000", "M106 P1 S50", "M106 S20", "M107"});
  EXPECT_EQ(state.size(), 4u);
  EXPECT_EQ(state.at("fan"), "M107");
}

TEST(Modal, EndsALabelBeforeAnotherBegins) {
  const ModalState a = after({"EXCLUDE_OBJECT_START NAME=a"}), b = after({"EXCLUDE_OBJECT_START NAME=b"});
  EXPECT_EQ(lines_between(a, b), (Lines{"EXCLUDE_OBJECT_END NAME=a", "EXCLUDE_OBJECT_START NAME=b"}));
  const ModalState none = after({"M486 S3", "M486 S-1"}), three = after({"M486 S3"});
  EXPECT_EQ(lines_between(three, none), (Lines{"M486 S-1"}));
  EXPECT_EQ(lines_between(none, three), (Lines{"M486 S3"}));
}

TEST(Modal, EndsALabelInTheWordsThatBeganIt) {
  const std::pair<const char*, const char*> ends[] = {
      {"; printing object a.stl id:0 copy 0", "; stop printing object a.stl id:0 copy 0"},
      {";printing object a", "; stop printing object a"},
      {" ;  start printing object, unique label id: 15", "; stop printing object, unique label id: 15"},
      {"M624 AQAAAAAAAAA=", "M625"},
      {"M486 S0", "M486 S-1"},
      {"EXCLUDE_OBJECT_START NAME=a", "EXCLUDE_OBJECT_END NAME=a"}};
  for (const auto& [begin, end] : ends) {
    ModalState none = after({begin});
    for (auto& [key, text] : none) text.clear();
    EXPECT_EQ(lines_between(after({begin}), none), Lines{end});
  }
}

TEST(Modal, IsNothingThatMovesOrHeats) {
  for (const char* text : {"G1 X5", "M104 S200 T0", "T1", "; a comment", "M73 P5"}) {
    GcodeLine line;
    EXPECT_FALSE(parse_line(text, line));
    EXPECT_FALSE(modal_line(line)) << text;
  }
}

}  // namespace
}  // namespace cleancolor
