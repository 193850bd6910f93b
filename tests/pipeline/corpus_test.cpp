// Every model of the shared folder slices into G-code that stays where it belongs, or is refused with the listed
// reason.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "replay.hpp"
#include "sanitized.hpp"
#include "slicing.hpp"

namespace cleancolor {
namespace {

using namespace test;

class Corpus : public testing::TestWithParam<Model> {
 protected:
  void SetUp() override {
    if (!shared_models_are_there()) GTEST_SKIP() << "needs the models of " << CLEANCOLOR_SHARED;
  }
};

bool contains(const Box<Vec2>& box, Vec2 p, double margin_mm) {
  return p.x >= box.min.x - margin_mm && p.x <= box.max.x + margin_mm && p.y >= box.min.y - margin_mm &&
         p.y <= box.max.y + margin_mm;
}

std::string at(const PrintedRoad& r) {
  return fmt::format("T{} {} at X {:.3f} Y {:.3f} Z {:.3f}", r.tool, r.role, r.to.x, r.to.y, r.z);
}

/// What one extruder's meshes span, in X, Y and Z; empty boxes for idle extruders.
std::vector<Box<Vec3>> boxes_of_extruders(const std::vector<Part>& parts, const Config& config) {
  std::vector<Box<Vec3>> boxes(config.extruders.size());
  for (const Part& part : parts)
    for (const Vec3& p : part.mesh.vertices) boxes[std::size_t(*part.extruder)].add(p);
  return boxes;
}

Box<Vec2> bed_of(const Config& config) {
  Box<Vec2> bed;
  for (const Vec2 p : config.bed_shape_mm) bed.add(p);
  return bed;
}

void expect_inside_the_bed(const Printed& printed, const Config& config) {
  const Box<Vec2> bed = bed_of(config);  // all beds here are rectangles
  for (const PrintedRoad& r : printed.roads) ASSERT_TRUE(contains(bed, r.from, 0) && contains(bed, r.to, 0)) << at(r);
  for (const PrintedTravel& t : printed.travels)
    ASSERT_TRUE(contains(bed, t.to, 0)) << "T" << t.tool << " travels to X " << t.to.x << " Y " << t.to.y;
}

void expect_inside_the_model(const Printed& printed, const std::vector<Box<Vec3>>& boxes, double layer_mm) {
  for (const PrintedRoad& r : printed.roads) {
    const Box<Vec3>& box = boxes[std::size_t(r.tool)];
    if (!is_of_the_model(r.role)) continue;
    ASSERT_LE(r.z, box.max.z + layer_mm) << at(r);
    ASSERT_GE(r.z, box.min.z) << at(r);
    const Box<Vec2> shadow{{box.min.x, box.min.y}, {box.max.x, box.max.y}};
    // Half a road beyond its middle lies its edge; contours and paths were each simplified by some hundredths.
    const double margin_mm = 0.03 - r.width_mm / 2;
    ASSERT_TRUE(contains(shadow, r.from, margin_mm) && contains(shadow, r.to, margin_mm)) << at(r);
  }
}

void expect_filament_as_said(const Printed& printed, const Sliced& result) {
  const std::vector<double> said = footer_numbers(result.text, "filament used [mm]");
  ASSERT_EQ(said.size(), printed.filament_mm.size());
  for (std::size_t e = 0; e < said.size(); ++e) {
    EXPECT_NEAR(printed.filament_mm[e], said[e], 0.006) << "extruder " << e + 1;
    EXPECT_NEAR(result.summary.extruders[e].filament_mm, said[e], 0.006);
  }
}

TEST_P(Corpus, SlicesWithinBedAndModelOrIsRefusedAsListed) {
  const Model& model = GetParam();
  SKIP_LARGE_WHERE_SANITIZED(model.name);
  const TestFolder folder;
  const Config config = config_for(model);
  const SliceRequest request = request_for(model, config, folder.path("out.gcode"));
  if (*model.refusal) {
    EXPECT_ERROR(slice(request), model.refusal);
    EXPECT_FALSE(std::filesystem::exists(request.output));
    return;
  }
  const Sliced result = sliced(request);
  const Printed printed = replayed(result.text, config);
  const auto boxes = boxes_of_extruders(placed_parts(model, config), config);
  EXPECT_EQ(printed.broken, std::vector<std::string>{});
  expect_inside_the_bed(printed, config);
  expect_inside_the_model(printed, boxes, model.layer_mm);
  expect_filament_as_said(printed, result);
  for (std::size_t e = 0; e < boxes.size(); ++e) EXPECT_EQ(printed.filament_mm[e] > 0, !boxes[e].empty());
  const bool is_exact = model.files.front().starts_with("paper/");  // parts share faces and do not overlap
  if (is_exact) {
    EXPECT_EQ(result.warnings.find("overlap"), std::string::npos) << result.warnings;
  }
  EXPECT_EQ(int(printed.layer_z_mm.size()), result.summary.layers);
  EXPECT_EQ(int(printed.tools.size()), result.summary.tool_changes + 1);
}

INSTANTIATE_TEST_SUITE_P(Models, Corpus, testing::ValuesIn(models()), [](const auto& of) {
  std::string name = of.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(CorpusTable, NamesEveryModelOfTheFolders) {
  if (!shared_models_are_there()) GTEST_SKIP() << "needs the models of " << CLEANCOLOR_SHARED;
  std::set<std::filesystem::path> listed;
  for (const Model& model : models())
    for (const std::string& file : model.files) listed.insert(shared_model(file));
  for (const char* folder : {"paper", "thirdparty"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_model(folder)))
      if (entry.is_regular_file()) {
        EXPECT_TRUE(listed.contains(entry.path())) << entry.path();
      }
}

}  // namespace
}  // namespace cleancolor
