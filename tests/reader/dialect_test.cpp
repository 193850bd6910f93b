#include "reader/dialect.hpp"

#include <gtest/gtest.h>

namespace cleancolor {
namespace {

/// The role after these comments.
Role role_after(const std::vector<std::string>& comments, Dialect dialect = Dialect::unknown) {
  GcodeFacts facts;
  facts.dialect = dialect;
  CommentReader reader(facts);
  for (const std::string& comment : comments) reader.comment(comment);
  return reader.state().role;
}

Role role_behind(const std::vector<std::string>& comments, Dialect dialect) {
  GcodeFacts facts;
  facts.dialect = dialect;
  CommentReader reader(facts);
  for (const std::string& comment : comments) reader.comment_behind_command(comment);
  return reader.state().role;
}

TEST(Comments, TagsMeanTheSameInBothSpellingsOfOrcaSlicer) {
  GcodeFacts facts;
  CommentReader reader(facts);
  for (const char* text : {"TYPE:Outer wall", " FEATURE: Outer wall"}) {
    reader.comment("TYPE:Custom");
    reader.comment(text);
    EXPECT_EQ(reader.state().role, Role::external_perimeter) << text;
  }
  reader.comment("WIDTH:0.45");
  EXPECT_DOUBLE_EQ(reader.state().width_mm, 0.45);
  reader.comment(" LINE_WIDTH: 0.42");
  EXPECT_DOUBLE_EQ(reader.state().width_mm, 0.42);
  reader.comment(" LAYER_HEIGHT: 0.16");
  EXPECT_DOUBLE_EQ(reader.state().height_mm, 0.16);
}

TEST(Comments, ARefillEndsWithWhatWasPrintedBefore) {
  GcodeFacts facts;
  CommentReader reader(facts);
  reader.comment("TYPE:Skirt/Brim");
  reader.comment("REFILL_START");
  EXPECT_EQ(reader.state().role, Role::refill);
  reader.comment("REFILL_END");
  EXPECT_EQ(reader.state().role, Role::skirt_brim);
}

TEST(Comments, NonsenseChangesNothingButUnknownTypesAreUnknown) {
  GcodeFacts facts;
  CommentReader reader(facts);
  reader.comment("TYPE:Perimeter");
  for (const char* text :
       {"", " ", "'", "''", "tool H", "BEGIN_LAYER_OBJECT ", "WIDTH:", "WIDTH:nan", "HEIGHT:-3", "MESH:"})
    reader.comment(text);
  EXPECT_EQ(reader.state().width_mm, 0);
  EXPECT_EQ(reader.state().height_mm, 0);
  reader.comment("TYPE:Something new");
  EXPECT_EQ(reader.state().role, Role::unknown);
}

TEST(Comments, BlocksEndWithWhatWasPrintedBeforeThem) {
  EXPECT_EQ(role_after({"TYPE:Outer wall", " WIPE_TOWER_START"}), Role::wipe_tower);
  EXPECT_EQ(role_after({"TYPE:Outer wall", " WIPE_TOWER_START", " FLUSH_START"}), Role::custom);
  EXPECT_EQ(role_after({"TYPE:Outer wall", " WIPE_TOWER_START", " FLUSH_START", " FLUSH_END"}), Role::wipe_tower);
  EXPECT_EQ(role_after({"TYPE:Outer wall", " WIPE_TOWER_START", " FLUSH_START", " FLUSH_END", " WIPE_TOWER_END"}),
            Role::external_perimeter);
  EXPECT_EQ(role_after({"TYPE:Perimeter", " CP TOOLCHANGE START"}), Role::wipe_tower);
  EXPECT_EQ(role_after({"TYPE:Perimeter", " CP TOOLCHANGE START", "TYPE:Custom", " CP TOOLCHANGE END"}),
            Role::perimeter);
  EXPECT_EQ(role_after({"TYPE:Perimeter", "REFILL_END", " FLUSH_END", " WIPE_TOWER_END"}), Role::perimeter)
      << "what has not begun does not end";
}

TEST(Comments, ABlockThatNeverEndsIsForgottenByTheNext) {
  EXPECT_EQ(role_after({"TYPE:Outer wall", "REFILL_START", "TYPE:Inner wall", "REFILL_START", "REFILL_END"}),
            Role::perimeter);
}

TEST(Comments, VerboseWordsCountOnlyWhereNoLinesTellTheRole) {
  EXPECT_EQ(role_behind({" skirt", " perimeter"}, Dialect::slic3r), Role::perimeter);
  EXPECT_EQ(role_behind({" external small perimeter"}, Dialect::unknown), Role::external_perimeter);
  EXPECT_EQ(role_behind({" support material interface"}, Dialect::prusaslicer), Role::support_interface);
  EXPECT_EQ(role_behind({" perimeter", " move to first infill point", " retract"}, Dialect::slic3r), Role::perimeter);
  EXPECT_EQ(role_behind({" perimeter"}, Dialect::cura), Role::unknown);
  GcodeFacts facts;
  CommentReader reader(facts);
  reader.comment("TYPE:External perimeter");
  reader.comment_behind_command(" perimeter");
  EXPECT_EQ(reader.state().role, Role::external_perimeter);
}

TEST(Comments, KISSlicersWordsInQuotesArePathsOnlyWhereTheySaySo) {
  const std::string loop = " 'Loop Path', 0.4 [feed mm/s], 9.5 [head mm/s]";
  EXPECT_EQ(role_after({loop}), Role::perimeter);
  EXPECT_EQ(role_after({loop, " 'Destring Prime'"}), Role::perimeter);
  EXPECT_EQ(role_after({loop, " 'Support (may Stack) Path', 1"}), Role::support);
  EXPECT_EQ(role_after({loop, " 'Support Interface Path', 1"}), Role::support_interface);
  EXPECT_EQ(role_after({loop, " 'Prime Pillar Path'"}), Role::wipe_tower);
  EXPECT_EQ(role_after({loop, " 'Some New Path'"}), Role::unknown);
}

TEST(Comments, OldFilesOfSimplify3DNameTheFeatureAlone) {
  EXPECT_EQ(role_after({" outer perimeter"}, Dialect::simplify3d), Role::external_perimeter);
  EXPECT_EQ(role_after({" feature ooze shield"}, Dialect::simplify3d), Role::skirt_brim);
  EXPECT_EQ(role_after({" outer perimeter"}, Dialect::prusaslicer), Role::unknown);
}

TEST(Comments, TheToolOfSimplify3DIsHeightAndWidth) {
  GcodeFacts facts;
  CommentReader reader(facts);
  reader.comment(" tool H0.200 W0.480");
  EXPECT_DOUBLE_EQ(reader.state().height_mm, 0.2);
  EXPECT_DOUBLE_EQ(reader.state().width_mm, 0.48);
}

TEST(Comments, OurWallsAreRampartsAndOurRefillsAreRefills) {
  EXPECT_EQ(role_after({"TYPE:Perimeter", "RAMPART_WALL"}), Role::rampart);
  EXPECT_EQ(role_after({"RAMPART_WALL", "REFILL_START"}), Role::refill);
}

}  // namespace
}  // namespace cleancolor
