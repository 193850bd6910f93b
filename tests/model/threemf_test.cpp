// 3MF packages: units, transforms, components, colours, vendors' extruders, and how broken packages are refused.
#include <gtest/gtest.h>

#include "../../fuzz/stored_zip.hpp"
#include "meshes.hpp"
#include "model/limits.hpp"
#include "model/read.hpp"

namespace cleancolor {
namespace {

using Entries = std::vector<std::pair<std::string, std::string>>;

const std::string relations =
    "<Relationships><Relationship Target=\"/3D/3dmodel.model\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";

std::string package(const std::string& model, Entries more = {}) {
  Entries entries = {{"[Content_Types].xml", "<Types/>"}, {"_rels/.rels", relations}, {"3D/3dmodel.model", model}};
  entries.insert(entries.end(), more.begin(), more.end());
  return stored_zip(entries);
}

std::string model(const std::string& resources, const std::string& build, const std::string& attributes = "") {
  return "<model xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\" "
         "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" " +
         attributes + "><resources>" + resources + "</resources><build>" + build + "</build></model>";
}

/// A box of the size, 12 triangles; attributes of each triangle may follow.
std::string mesh(double size, const std::vector<std::string>& attributes = {}) {
  const Mesh box = box_mesh({0, 0, 0}, {size, size, size});
  std::string text = "<mesh><vertices>";
  for (const Vec3& p : box.vertices)
    text += "<vertex x=\"" + std::to_string(p.x) + "\" y=\"" + std::to_string(p.y) + "\" z=\"" + std::to_string(p.z) +
            "\"/>";
  text += "</vertices><triangles>";
  for (std::size_t i = 0; i < box.triangles.size(); ++i) {
    const Triangle& t = box.triangles[i];
    text += "<triangle v1=\"" + std::to_string(t[0]) + "\" v2=\"" + std::to_string(t[1]) + "\" v3=\"" +
            std::to_string(t[2]) + "\" " + (attributes.empty() ? "" : attributes[i % attributes.size()]) + "/>";
  }
  return text + "</triangles></mesh>";
}

std::string object(int id, const std::string& content, const std::string& attributes = "") {
  return "<object id=\"" + std::to_string(id) + "\" " + attributes + ">" + content + "</object>";
}

std::string item(int id, const std::string& attributes = "") {
  return "<item objectid=\"" + std::to_string(id) + "\" " + attributes + "/>";
}

std::vector<Part> read(const std::string& bytes, const Progress& progress = {}) {
  return read_model_bytes(bytes, "t.3mf", progress);
}

std::string reason(const std::string& bytes) {
  return refusal([&] { read(bytes); });
}

const std::string colours =
    "<basematerials id=\"50\"><base name=\"a\" displaycolor=\"#FF0000\"/><base name=\"b\" displaycolor=\"#0000FFFF\"/>"
    "<base name=\"bare\"/></basematerials>";

TEST(ThreeMf, ScalesByTheUnit) {
  for (const auto& [unit, mm] : {std::pair{"micron", 0.001}, std::pair{"inch", 25.4}, std::pair{"meter", 1000.0}}) {
    const std::string attribute = std::string("unit=\"") + unit + "\"";
    const auto parts =
        read(package(model(object(1, mesh(2)), item(1, "transform=\"1 0 0 0 1 0 0 0 1 3 0 0\""), attribute)));
    EXPECT_NEAR(bounds(parts.at(0).mesh).max.x, 5 * mm, 1e-9 * mm);
    EXPECT_NEAR(bounds(parts.at(0).mesh).max.y, 2 * mm, 1e-9 * mm);
  }
}

TEST(ThreeMf, AppliesNestedTransformsInnermostFirst) {
  // The box of 2 mm is moved by 1 along X, then turned by a quarter about Z and doubled, then lifted by 5.
  const std::string inner =
      "<components><component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 1 0 0\"/></components>";
  const std::string outer =
      "<components><component objectid=\"2\" transform=\"0 2 0 -2 0 0 0 0 2 0 0 0\"/></components>";
  const auto parts = read(package(model(object(1, mesh(2)) + object(2, inner) + object(3, outer),
                                        item(3, "transform=\"1 0 0 0 1 0 0 0 1 0 0 5\""))));
  const Box<Vec3> box = bounds(parts.at(0).mesh);
  EXPECT_EQ(box.min, (Vec3{-4, 2, 5}));
  EXPECT_EQ(box.max, (Vec3{0, 6, 9}));
  EXPECT_DOUBLE_EQ(volume_mm3(parts[0].mesh), 64);
}

TEST(ThreeMf, KeepsMirroredObjectsFacingOutward) {
  const auto parts = read(package(model(object(1, mesh(2)), item(1, "transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\""))));
  EXPECT_DOUBLE_EQ(volume_mm3(parts.at(0).mesh), 8);
}

TEST(ThreeMf, ReadsColoursOfObjectsAndOfTrianglesThatAgree) {
  const std::string groups = colours + "<m:colorgroup id=\"51\"><m:color color=\"#00FF00FF\"/></m:colorgroup>";
  const auto parts = read(package(model(groups + object(1, mesh(2), "pid=\"50\" pindex=\"1\"") +
                                            object(2, mesh(2, {"pid=\"51\" p1=\"0\""})) +
                                            object(3, mesh(2), "pid=\"50\" pindex=\"2\"") + object(4, mesh(2)),
                                        item(1) + item(2) + item(3) + item(4))));
  ASSERT_EQ(parts.size(), 4);
  EXPECT_EQ(parts[0].rgb, 0x0000FFU);
  EXPECT_EQ(parts[1].rgb, 0x00FF00U);
  EXPECT_EQ(parts[2].rgb, std::nullopt);
  EXPECT_EQ(parts[2].material, "bare");
  EXPECT_EQ(parts[3].rgb, std::nullopt);
}

TEST(ThreeMf, RefusesObjectsOfSeveralColoursOnlyWhereTheyAreBuilt) {
  const std::vector<std::vector<std::string>> painted = {{"pid=\"50\" p1=\"0\"", "pid=\"50\" p1=\"1\""},
                                                         {"pid=\"50\" p1=\"0\" p2=\"1\" p3=\"0\""},
                                                         {"slic3rpe:mmu_segmentation=\"8\"", ""},
                                                         {"paint_color=\"4\""}};
  for (const auto& attributes : painted) {
    const std::string resources = colours + object(1, mesh(2, attributes)) + object(2, mesh(2));
    EXPECT_TRUE(says(reason(package(model(resources, item(1)))), "a later version")) << attributes[0];
    EXPECT_EQ(read(package(model(resources, item(2)))).size(), 1) << attributes[0];
  }
  const std::string supports = object(1, mesh(2, {"paint_supports=\"4\" slic3rpe:custom_seam=\"8\" paint_color=\"\""}));
  EXPECT_EQ(read(package(model(supports, item(1)))).size(), 1);
}

TEST(ThreeMf, IgnoresTexturesWithAWarning) {
  const std::string texture = "<m:texture2dgroup id=\"52\" texid=\"9\"/>";
  Warnings warnings;
  read(package(model(texture + object(1, mesh(2, {"pid=\"52\" p1=\"7\" p2=\"8\" p3=\"9\""})), item(1))),
       warnings.progress);
  EXPECT_TRUE(warnings.contain("texture is ignored")) << warnings.all();
}

TEST(ThreeMf, FollowsComponentsIntoOtherModelParts) {
  const std::string other = model(object(1, mesh(3)), "", "unit=\"centimeter\"");
  const std::string start =
      model(object(1, mesh(2)) + object(2,
                                        "<components><component objectid=\"1\"/><component "
                                        "p:path=\"/3D/other.model\" objectid=\"1\"/></components>"),
            item(2), "requiredextensions=\"p\"");
  const auto parts = read(package(start, {{"3D/other.model", other}}));
  ASSERT_EQ(parts.size(), 2);
  EXPECT_DOUBLE_EQ(volume_mm3(parts[0].mesh), 8);
  EXPECT_NEAR(volume_mm3(parts[1].mesh), 27'000, 1e-9);
}

const std::string prusa =
    "<config><object id=\"1\"><metadata type=\"object\" key=\"extruder\" value=\"2\"/>"
    "<volume firstid=\"0\" lastid=\"3\"><metadata key=\"name\" value=\"low\"/><metadata key=\"extruder\" "
    "value=\"0\"/></volume>"
    "<volume firstid=\"4\" lastid=\"9\"><metadata key=\"name\" value=\"high\"/><metadata key=\"extruder\" "
    "value=\"3\"/></volume>"
    "<volume firstid=\"10\" lastid=\"11\"><metadata key=\"volume_type\" "
    "value=\"ParameterModifier\"/></volume></object></config>";

TEST(ThreeMf, CutsPrusaSlicersVolumesOutOfOneMesh) {
  Warnings warnings;
  const auto parts = read(package(model(object(1, mesh(2)), item(1)), {{"Metadata/Slic3r_PE_model.config", prusa}}),
                          warnings.progress);
  ASSERT_EQ(parts.size(), 2);
  EXPECT_EQ(parts[0].name, "t.3mf: low");
  EXPECT_EQ(parts[0].mesh.triangles.size(), 4);
  EXPECT_EQ(parts[0].extruder, 1);
  EXPECT_EQ(parts[1].mesh.triangles.size(), 6);
  EXPECT_EQ(parts[1].extruder, 2);
  EXPECT_TRUE(warnings.contain("modifier")) << warnings.all();
}

TEST(ThreeMf, RefusesVolumesBeyondTheMeshAndNegativeOnes) {
  const auto with = [](std::string config, const std::string& from, const std::string& to) {
    config.replace(config.find(from), from.size(), to);
    return reason(package(model(object(1, mesh(2)), item(1)), {{"Metadata/Slic3r_PE_model.config", config}}));
  };
  EXPECT_TRUE(says(with(prusa, "lastid=\"9\"", "lastid=\"12\""), "ends at triangle 12"));
  EXPECT_TRUE(says(with(prusa, "lastid=\"9\"", "lastid=\"3\""), "range"));
  EXPECT_TRUE(says(with(prusa, "ParameterModifier", "NegativeVolume"), "negative volume"));
  EXPECT_TRUE(says(with(prusa, "value=\"3\"", "value=\"x\""), "no extruder number"));
}

TEST(ThreeMf, GivesBambuStudiosPartsTheirExtrudersEvenWhereTheyShareAnId) {
  const std::string config =
      "<config><object id=\"2\"><metadata key=\"extruder\" value=\"4\"/><part id=\"1\" "
      "subtype=\"normal_part\"><metadata "
      "key=\"extruder\" value=\"2\"/></part><part id=\"1\" subtype=\"normal_part\"/><part id=\"1\" "
      "subtype=\"support_enforcer\"/></object></config>";
  const std::string three =
      "<components><component objectid=\"1\"/><component objectid=\"1\"/><component objectid=\"1\"/></components>";
  const auto parts = read(
      package(model(object(1, mesh(2)) + object(2, three), item(2)), {{"Metadata/model_settings.config", config}}));
  ASSERT_EQ(parts.size(), 2);
  EXPECT_EQ(parts[0].extruder, 1);
  EXPECT_EQ(parts[1].extruder, 3);
}

TEST(ThreeMf, LeavesOutSupportsAndWhatIsNotToBePrinted) {
  Warnings warnings;
  const auto parts =
      read(package(model(object(1, mesh(2), "type=\"support\"") + object(2, mesh(2)) + object(3, mesh(3)),
                         item(1) + item(2, "printable=\"0\"") + item(3))),
           warnings.progress);
  EXPECT_EQ(parts.size(), 1);
  EXPECT_EQ(warnings.texts.size(), 2) << warnings.all();
}

TEST(ThreeMf, RefusesWhatDoesNotFitTogetherAndSaysWhy) {
  const std::string cube = object(1, mesh(2));
  const auto build = [&](const std::string& attributes) { return reason(package(model(cube, item(1, attributes)))); };
  EXPECT_TRUE(says(build("transform=\"1 0 0 0 1 0 0 0 1 0 0\""), "11 numbers"));
  EXPECT_TRUE(says(build("transform=\"1 0 0 0 1 0 0 0 0 0 0 0\""), "flattens"));
  EXPECT_TRUE(says(build("transform=\"1 0 0 0 1 0 0 0 inf 0 0 0\""), "'inf'"));
  EXPECT_TRUE(says(build("transform=\"1e200 0 0 0 1e200 0 0 0 1e200 0 0 0\""), "flattens"));
  EXPECT_TRUE(says(reason(package(model(cube, item(7)))), "object 7 does not exist"));
  EXPECT_TRUE(says(reason(package(model(cube, ""))), "build of the 3MF file is empty"));
  EXPECT_TRUE(says(reason(package(model(cube + cube, item(1)))), "two resources have the id 1"));
  EXPECT_TRUE(says(reason(package(model(cube, item(1), "unit=\"furlong\""))), "no unit"));
  EXPECT_TRUE(
      says(reason(package(model(cube, item(1), "xmlns:z=\"urn:z\" requiredextensions=\"z\""))), "extension 'z'"));
  EXPECT_TRUE(says(reason(package(model(colours + object(1, mesh(2), "pid=\"50\" pindex=\"3\""), item(1)))),
                   "colour 3 of group 50"));
  EXPECT_TRUE(says(reason(package("<model><resources>")), "not well-formed"));
  EXPECT_TRUE(says(reason(stored_zip({{"a.txt", ""}})), "model part 3D/3dmodel.model is not in the package"));
}

TEST(ThreeMf, RefusesComponentsInACycleOrDoublingWithoutEnd) {
  const auto pair_of = [](int id) {
    const std::string one = "<component objectid=\"" + std::to_string(id) + "\"/>";
    return "<components>" + one + one + "</components>";
  };
  EXPECT_TRUE(says(reason(package(model(object(1, pair_of(2)) + object(2, pair_of(1)), item(1)))), "contains itself"));
  for (const std::string& leaf : {mesh(1), std::string("<components/>")}) {
    std::string resources = object(1, leaf);
    for (int id = 2; id <= 40; ++id) resources += object(id, pair_of(id - 1));  // 2^39 leaves
    EXPECT_FALSE(reason(package(model(resources, item(40)))).empty());
  }
}

TEST(ThreeMf, RefusesDamagedArchives) {
  const std::string whole = package(model(object(1, mesh(2)), item(1)));
  ASSERT_EQ(read(whole).size(), 1);
  for (std::size_t length = 4; length < whole.size(); length += 41)
    EXPECT_TRUE(reason(whole.substr(0, length)).starts_with("t.3mf: ")) << length;
  std::string changed = whole;
  changed[whole.find("vertex x=") + 10] = '7';
  EXPECT_TRUE(says(reason(changed), "damaged"));
}

TEST(ThreeMf, RefusesXmlWhoseTreeWouldTakeTooMuchMemory) {
  std::string many = "<model>";
  many.reserve(max_xml_tree_bytes / 16 + 100);
  while (many.size() < max_xml_tree_bytes / 16 + 50) many += "<a/>";
  EXPECT_TRUE(says(reason(package(many + "</model>")), "too large"));
}

}  // namespace
}  // namespace cleancolor
