#include "replan/walled_layers.hpp"

#include <gtest/gtest.h>

namespace cleancolor {
namespace {

/// Ten seconds of each extruder.
Layer layer_by(const std::vector<int>& extruders) {
  Layer layer;
  for (const int e : extruders) {
    Path path;
    path.extruder = e;
    path.points = {{0, 0}, {300, 0}};
    path.stretches = {{0, {Role::perimeter, 0.4, 0.3, 0.12, 30}}};
    layer.paths.push_back(path);
  }
  return layer;
}

TEST(WalledLayers, GoOnUntilIdleNozzlesHaveNothingLeft) {
  std::vector<Layer> layers(30, layer_by({1}));
  EXPECT_EQ(walled_layers(layers, {}), 10);
  layers[4] = layer_by({0, 1});
  EXPECT_EQ(walled_layers(layers, {}), 5 + 10);
  EXPECT_EQ(walled_layers(layers, {.time_s = 10}), 5 + 5);
  layers[12] = layer_by({0});
  EXPECT_EQ(walled_layers(layers, {}), 13 + 10);
  layers[25] = layer_by({0, 1});
  EXPECT_EQ(walled_layers(layers, {}), 30);
}

}  // namespace
}  // namespace cleancolor
