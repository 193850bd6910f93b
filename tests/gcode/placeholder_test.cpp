#include "gcode/placeholder.hpp"

#include <gtest/gtest.h>

#include <array>

#include "base/error.hpp"

using namespace cleancolor;

namespace {

class PlaceholdersTest : public testing::Test {
 protected:
  PlaceholdersTest() {
    config.extruders.resize(2);
    config.extruders[0].first_layer_temperature_c = 215;
    config.extruders[1].first_layer_temperature_c = 240;
    values.set("layer_num", 7);
    values.set("layer_z", 2.45);
    values.set("initial_extruder", 1);
    values.set("first_layer_print_min", std::array{-3.5, 4.0});
  }
  std::string filled(std::string_view text) const { return values.filled_in(text, "start_gcode"); }
  std::string failure(std::string_view text) const {
    try {
      return "gives " + filled(text);
    } catch (const Error& e) {
      return e.what();
    }
  }

  Config config;
  Placeholders values{config};
};

}  // namespace

TEST_F(PlaceholdersTest, TextWithoutPlaceholdersStaysAsItIs) {
  EXPECT_EQ(filled("G28 ; home\n"), "G28 ; home\n");
}

TEST_F(PlaceholdersTest, NamesInBracketsAndBracesAreReplaced) {
  EXPECT_EQ(filled("[layer_num] {layer_z} [layer_height]"), "7 2.45 0.3");
}

TEST_F(PlaceholdersTest, ListsAreIndexedByNumberByNameAndBySuffix) {
  EXPECT_EQ(filled("[first_layer_temperature_0]"), "215");
  EXPECT_EQ(filled("{first_layer_temperature[1]}"), "240");
  EXPECT_EQ(filled("{first_layer_temperature[initial_extruder]}"), "240");
  EXPECT_EQ(filled("X{first_layer_print_min[0]} Y{first_layer_print_min[1]}"), "X-3.5 Y4");
}

TEST_F(PlaceholdersTest, AListWithoutIndexIsThatOfTheCurrentExtruder) {
  values.set_current_extruder(1);
  EXPECT_EQ(filled("[first_layer_temperature]"), "240");
}

TEST_F(PlaceholdersTest, IndexOutOfRangeTakesTheFirstValue) {
  EXPECT_EQ(filled("{first_layer_temperature[5]} {first_layer_temperature[-1]}"), "215 215");
}

TEST_F(PlaceholdersTest, ExpressionsAreEvaluatedWithTheUsualPrecedence) {
  EXPECT_EQ(filled("{1 + 2 * 3 - 4 / 2}"), "5");
  EXPECT_EQ(filled("{(1 + 2) * -3}"), "-9");
  EXPECT_EQ(filled("{max(layer_z, 3) + min(1, 2)}"), "4");
  EXPECT_EQ(filled("{int(7.9) % 4} {round(2.5)}"), "3 3");
  EXPECT_EQ(filled("{0.1 + 0.2}"), "0.3");
  EXPECT_EQ(filled("{layer_num > 5 and not (layer_z < 2) ? \"high\" : \"low\"}"), "high");
}

TEST_F(PlaceholdersTest, OnlyTheBranchThatHoldsIsWritten) {
  const auto chosen = [&](int n) {
    values.set("layer_num", n);
    return filled("a{if layer_num == 0}first{elsif layer_num < 3}low{else}high{endif}z");
  };
  EXPECT_EQ(chosen(0), "afirstz");
  EXPECT_EQ(chosen(2), "alowz");
  EXPECT_EQ(chosen(3), "ahighz");
  EXPECT_EQ(filled("{if 0}{if 1}x{else}y{endif}{nonsense}{endif}z"), "z");
}

TEST_F(PlaceholdersTest, UnknownNameIsAnErrorThatNamesTemplateLineAndName) {
  const std::string message = failure("G28\nM104 S{first_layer_temprature[0]}");
  EXPECT_NE(message.find("start_gcode"), std::string::npos) << message;
  EXPECT_NE(message.find("line 2"), std::string::npos) << message;
  EXPECT_NE(message.find("'first_layer_temprature'"), std::string::npos) << message;
  EXPECT_NE(failure("[nonsense]").find("[nonsense]"), std::string::npos);
}

TEST_F(PlaceholdersTest, MalformedTemplatesAreErrors) {
  for (const char* text : {"{layer_num", "[layer_num", "{if 1}x", "{endif}", "{else}", "{1 +}", "{1 / 0}", "{(1}",
                           "{\"a\" - 1}", "{sin(1)}", "{}", "{1 2}", "{layer_num[}", "{1.2.3}", "{\"a}"})
    EXPECT_THROW(filled(text), Error) << text;
  EXPECT_THROW(filled("{" + std::string(100000, '(') + "}"), Error);
}
