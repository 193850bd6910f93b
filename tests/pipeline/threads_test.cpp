// The same request gives the same bytes on any number of threads.

#include <gtest/gtest.h>

#include "model/settings.hpp"
#include "sanitized.hpp"
#include "slicing.hpp"

namespace cleancolor {
namespace {

using namespace test;

void expect_same_bytes(const char* name, const std::vector<std::string>& options) {
  SKIP_LARGE_WHERE_SANITIZED(name);
  if (!shared_models_are_there()) GTEST_SKIP() << "needs the models of " << CLEANCOLOR_SHARED;
  const TestFolder folder;
  const auto& all = models();
  const Model& model =
      *std::find_if(all.begin(), all.end(), [&](const Model& m) { return std::string(m.name) == name; });
  const Config config = config_of({.printer = "replicator-dual", .set = options});
  SliceRequest request = request_for(model, config, folder.path("out.gcode"));
  request.azimuth_deg.reset();
  std::string first;
  for (const int threads : {1, 2, 5}) {
    request.threads = threads;
    const Sliced result = sliced(request);
    if (first.empty()) first = result.text;
    ASSERT_FALSE(first.empty());
    EXPECT_TRUE(result.text == first) << threads << " threads";  // not EXPECT_EQ: it would print megabytes
  }
}

TEST(Threads, GiveTheSameBytesForBothColoursInEveryLayer) {
  expect_same_bytes("crystal", {"layer_height=0.4", "first_layer_height=0.3", "nozzle_diameter=0.5",
                                "extrusion_width=0.55", "perimeter_extrusion_width=0.55",
                                "external_perimeter_extrusion_width=0.55", "infill_extrusion_width=0.55",
                                "solid_infill_extrusion_width=0.55", "top_infill_extrusion_width=0.55"});
}
TEST(Threads, GiveTheSameBytesForThinWallsAndGyroid) {
  expect_same_bytes("rose", {"thin_walls=1", "gap_fill_enabled=1", "fill_pattern=gyroid", "seam_position=random"});
}
TEST(Threads, GiveTheSameBytesForAPartWithinAnother) {
  expect_same_bytes("robot-ice", {"interface_shells=1", "fill_pattern=grid", "seam_position=nearest"});
}

}  // namespace
}  // namespace cleancolor
