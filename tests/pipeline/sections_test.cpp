// The area of every layer of every extruder against the exact cross-section of its meshes, found without the slicer.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "slice/slices.hpp"
#include "slicing.hpp"

namespace cleancolor {
namespace {

using namespace test;

struct Section {
  double area_mm2 = 0;
  double perimeter_mm = 0;
};

/// Adds what a triangle gives to the border of one plane's cut.
///
/// A plane cuts a triangle in a segment with the inside on its left; by Green's theorem half the cross products of all
/// segments' ends are the area. Corners in the plane count as above it: no layer here is cut along a face, or which
/// side of the face counts would be a matter of taste.
void add_segment(Section& section, const std::array<Vec3, 3>& corners, double z) {
  Vec2 from, to;  // the border runs from where the triangle's edge goes down to where one goes up
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = corners[i], &b = corners[(i + 1) % 3];
    if ((a.z >= z) == (b.z >= z)) continue;
    const double t = (z - a.z) / (b.z - a.z);
    (a.z >= z ? from : to) = {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t};
  }
  section.area_mm2 += cross(from, to) / 2;
  section.perimeter_mm += distance(from, to);
}

std::vector<Section> sections(const Mesh& mesh, const std::vector<Slab>& slabs) {
  std::vector<Section> result(slabs.size());
  for (const Triangle& t : mesh.triangles) {
    const std::array corners = {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    const auto [low, high] = std::minmax({corners[0].z, corners[1].z, corners[2].z});
    auto slab =
        std::lower_bound(slabs.begin(), slabs.end(), low, [](const Slab& s, double z) { return s.slice_z_mm() <= z; });
    for (; slab != slabs.end() && slab->slice_z_mm() <= high; ++slab)
      add_segment(result[std::size_t(slab - slabs.begin())], corners, slab->slice_z_mm());
  }
  return result;
}

class Sections : public testing::TestWithParam<Model> {
 protected:
  void SetUp() override {
    if (!shared_models_are_there()) GTEST_SKIP() << "needs the models of " << CLEANCOLOR_SHARED;
  }
};

TEST_P(Sections, LayersHaveTheAreaOfTheMeshesCrossSection) {
  const Config config = config_for(GetParam());
  const std::vector<Part> parts = placed_parts(GetParam(), config);
  const Slices layers = slices(parts, {.extruders = int(config.extruders.size()),
                                       .first_layer_height_mm = GetParam().layer_mm,
                                       .layer_height_mm = GetParam().layer_mm,
                                       .resolution_mm = 0.02});
  std::vector<std::vector<Section>> expected(config.extruders.size(), std::vector<Section>(layers.slabs.size()));
  for (const Part& part : parts) {
    const std::vector<Section> own = sections(part.mesh, layers.slabs);
    for (std::size_t k = 0; k < own.size(); ++k) {
      Section& all = expected[std::size_t(*part.extruder)][k];
      all.area_mm2 += own[k].area_mm2;
      all.perimeter_mm += own[k].perimeter_mm;
    }
  }
  for (std::size_t e = 0; e < expected.size(); ++e)
    for (std::size_t k = 0; k < layers.slabs.size(); ++k) {
      const Section& section = expected[e][k];
      EXPECT_NEAR(area_mm2(layers.regions[k][e]), section.area_mm2,
                  std::max(0.005 * section.area_mm2, 0.02 * section.perimeter_mm) + 1e-6)
          << "extruder " << e + 1 << ", layer " << k << ", cut at " << layers.slabs[k].slice_z_mm();
    }
}

std::vector<Model> models_that_slice() {
  std::vector<Model> result;
  for (const Model& model : models())
    if (!*model.refusal) result.push_back(model);
  return result;
}

INSTANTIATE_TEST_SUITE_P(Models, Sections, testing::ValuesIn(models_that_slice()), [](const auto& of) {
  std::string name = of.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace cleancolor
