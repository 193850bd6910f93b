// G-code of layers whose colours change more than once.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "model/settings.hpp"
#include "replay.hpp"
#include "slicing.hpp"

namespace cleancolor {
namespace {

using namespace test;

TEST(PrintOrderInGcode, OfThePaperIsPrintedRightWhereColoursTakeTurns) {
  // By decreasing length: colour 0, 1, 0, 1.
  const std::vector<Mesh> meshes{joined(box_mesh({0, 0, 0}, {30, 16, 2}), box_mesh({60, 0, 0}, {72, 16, 2})),
                                 joined(box_mesh({35, 0, 0}, {55, 16, 2}), box_mesh({76, 0, 0}, {80, 16, 2}))};
  for (const char* planner : {"planner=paper", "planner=clean", "planner=plain"})
    for (const char* walls : {"rampart_order=before_run", "rampart_order=layer_start"}) {
      SCOPED_TRACE(std::string(planner) + " " + walls);
      const Config config = config_of(
          {.printer = "replicator-dual", .set = {planner, walls, "print_order=paper", "rampart_brim_width=0"}});
      const TestFolder folder;
      const Sliced result = sliced(folder, meshes, config);
      const Printed printed = replayed(result.text, config);
      EXPECT_EQ(printed.broken, std::vector<std::string>{});
      std::map<int, std::vector<const PrintedRoad*>> layers;
      for (const PrintedRoad& road : printed.roads) layers[road.layer].push_back(&road);
      for (const auto& [layer, roads] : layers) {
        if (layer == 0) continue;
        std::vector<int> part;         // tools in their order, without the rampart
        std::map<int, bool> has_wall;  // by tool
        for (const PrintedRoad* road : roads) {
          const bool is_wall = !is_of_the_model(road->role);
          if (is_wall) {
            EXPECT_TRUE(std::ranges::find(part, road->tool) == part.end()) << "a wall after its colour's first run";
          } else if (part.empty() || part.back() != road->tool) {
            part.push_back(road->tool);
          }
          has_wall[road->tool] |= is_wall;
        }
        EXPECT_EQ(part, (std::vector<int>{0, 1, 0, 1})) << "layer " << layer;
        EXPECT_TRUE(has_wall[0] && has_wall[1]);
      }
    }
}

}  // namespace
}  // namespace cleancolor
