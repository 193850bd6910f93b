#include "cli/report.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "model/options.hpp"

namespace cleancolor {
namespace {

SliceRequest request_of_three() {
  SliceRequest request;
  set_extruder_count(request.config, 3);
  request.config.extruders[1].filament_type = "PVA";
  request.output = "out.gcode";
  return request;
}

const Summary summary = {.layers = 100,
                         .tool_changes = 94,
                         .time_s = 3725,
                         .extruders = {{1234.5, 3.7, 0}, {20, 0.06, 0}, {0, 0, 0}},
                         .protection = {}};

TEST(SummaryTable, ShowsEveryExtruderThatWasUsed) {
  EXPECT_EQ(summary_table(summary, request_of_three()),
            "out.gcode\n"
            "layers        100\n"
            "tool changes  94\n"
            "time          1 h 02 min\n"
            "\n"
            "extruder  material        filament    weight\n"
            "1         PLA              1.234 m    3.70 g\n"
            "2         PVA              0.020 m    0.06 g\n");
}

TEST(SummaryTable, ShowsCostWhereThereIsOne) {
  Summary with_cost = summary;
  with_cost.extruders[0].cost = 0.5;
  const std::string table = summary_table(with_cost, request_of_three());
  EXPECT_NE(table.find("weight      cost\n"), table.npos);
  EXPECT_NE(table.find("3.70 g      0.50\n"), table.npos);
}

TEST(SummaryJson, IsTheDocumentedObject) {
  const auto json = nlohmann::json::parse(summary_json(summary, request_of_three(), {"mended \xff"}));
  EXPECT_EQ(json["output"], "out.gcode");
  EXPECT_EQ(json["layers"], 100);
  EXPECT_EQ(json["tool_changes"], 94);
  EXPECT_EQ(json["time_s"], 3725);
  ASSERT_EQ(json["extruders"].size(), 3u);
  EXPECT_EQ(json["extruders"][1]["extruder"], 2);
  EXPECT_EQ(json["extruders"][0]["filament_mm"], 1234.5);
  EXPECT_EQ(json["extruders"][0]["filament_g"], 3.7);
  EXPECT_EQ(json["extruders"][0]["cost"], 0);
  EXPECT_EQ(json["warnings"].size(), 1u);
}

}  // namespace
}  // namespace cleancolor
