// The readers of plain formats: what they read, and how they refuse what is malformed.
#include <gtest/gtest.h>

#include <bit>

#include "../../fuzz/stored_zip.hpp"
#include "meshes.hpp"
#include "model/amf.hpp"
#include "model/check.hpp"
#include "model/obj.hpp"
#include "model/ply.hpp"
#include "model/read.hpp"
#include "model/stl.hpp"

namespace cleancolor {
namespace {

void append(std::string& bytes, std::uint32_t value, bool big = false) {
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * (big ? 3 - i : i)) & 0xFF);
}

std::string binary_stl(const Mesh& mesh, std::string header = "cube") {
  header.resize(80, ' ');
  append(header, std::uint32_t(mesh.triangles.size()));
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) append(header, 0);
    for (const std::uint32_t v : t)
      for (const double c : {mesh.vertices[v].x, mesh.vertices[v].y, mesh.vertices[v].z})
        append(header, std::bit_cast<std::uint32_t>(float(c)));
    header += std::string(2, '\0');
  }
  return header;
}

std::string ascii_stl(const Mesh& mesh, const std::string& line_end) {
  std::string text = "solid cube with a name" + line_end;
  for (const Triangle& t : mesh.triangles) {
    text += " facet normal 0 0 0" + line_end + "  outer loop" + line_end;
    for (const std::uint32_t v : t)
      text += "   vertex " + std::to_string(mesh.vertices[v].x) + " " + std::to_string(mesh.vertices[v].y) + "\t" +
              std::to_string(mesh.vertices[v].z) + line_end;
    text += "  endloop" + line_end + " endfacet" + line_end;
  }
  return text + "endsolid" + line_end;
}

const Mesh cube = box_mesh({0, 0, 0}, {20, 20, 20});

TEST(Stl, ReadsBinaryEvenWhenItsHeaderSaysSolid) {
  for (const char* header : {"cube", "solid cube"}) {
    const Part part = read_stl(binary_stl(cube, header), "cube.stl");
    EXPECT_EQ(part.mesh.vertices.size(), 8);
    EXPECT_DOUBLE_EQ(volume_mm3(part.mesh), 8000);
  }
}

TEST(Stl, ReadsAsciiWithTheLineEndsOfAnySystem) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    const Part part = read_stl(ascii_stl(cube, end), "cube.stl");
    EXPECT_EQ(part.mesh.triangles.size(), 12);
    EXPECT_DOUBLE_EQ(volume_mm3(part.mesh), 8000);
  }
}

TEST(Stl, RefusesEveryTruncationOfAFile) {
  for (const std::string& whole : {binary_stl(cube), ascii_stl(cube, "\n")})
    for (std::size_t length = 0; length < whole.size(); length += 7) {
      SCOPED_TRACE(length);
      Warnings warnings;
      const std::string reason = refusal([&] { read_stl(whole.substr(0, length), "cube.stl", warnings.progress); });
      EXPECT_TRUE(!reason.empty() || warnings.contain("cut short")) << "truncation goes unnoticed";
      EXPECT_TRUE(reason.empty() || reason.starts_with("cube.stl: ")) << reason;
    }
}

TEST(Stl, NamesTheLineOfAWordThatIsNoNumber) {
  std::string text = ascii_stl(cube, "\r\n");
  text.replace(text.find("20.000000"), 9, "twenty");
  const std::string reason = refusal([&] { read_stl(text, "cube.stl"); });
  EXPECT_TRUE(says(reason, "line 5: a finite number should stand here, not 'twenty'"));
}

TEST(Obj, CutsPolygonsIntoTriangles) {
  // An L, extruded: its top and bottom are polygons that no fan covers from every corner.
  const std::string text =
      "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n"
      "v 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 2 1\nv 0 2 1\n"
      "f 3 2 1 6 5 4\nf 9 10 11 12 7 8\n"
      "f 1 2 8 7\nf 2/1 3/2 9/3 8/4\nf 3//1 4//1 10//1 9//1\nf 4 5 11 10\nf 5 6 12 11\nf -7 -12 -6 -1\n";
  const std::vector<Part> parts = read_obj(text, "l.obj");
  ASSERT_EQ(parts.size(), 1);
  EXPECT_EQ(parts[0].mesh.triangles.size(), 20);
  Warnings warnings;
  EXPECT_NEAR(volume_mm3(checked(parts[0].mesh, "l", warnings.progress)), 3, 1e-12);
  EXPECT_EQ(warnings.texts.size(), 0) << warnings.all();
}

std::string obj_tetrahedron(double x, int first) {
  std::string text;
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    text += "v " + std::to_string(p.x + x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  for (const Triangle& t : {Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{2, 0, 3}})
    text += "f " + std::to_string(t[0] + first) + " " + std::to_string(t[1] + first) + " " +
            std::to_string(t[2] + first) + "\n";
  return text;
}

TEST(Obj, MakesAPartOfEachMaterialWithItsColour) {
  const std::string text = "usemtl red\n" + obj_tetrahedron(0, 1) + "usemtl bare\n" + obj_tetrahedron(5, 5);
  const std::vector<Part> parts = read_obj(text, "two.obj", read_mtl("newmtl red\nKa 0 0 0\nKd 1 0 0.2\n"));
  ASSERT_EQ(parts.size(), 2);
  EXPECT_EQ(parts[0].rgb, 0xFF0033U);
  EXPECT_EQ(parts[1].rgb, std::nullopt);
  EXPECT_EQ(parts[1].material, "bare");
  EXPECT_EQ(parts[1].mesh.vertices.size(), 4);
}

TEST(Obj, RefusesASurfaceInSeveralMaterials) {
  std::string text = obj_tetrahedron(0, 1);
  text.insert(text.rfind("f "), "usemtl other\n");
  EXPECT_TRUE(says(refusal([&] { read_obj(text, "painted.obj"); }), "a later version"));
}

TEST(Obj, NamesTheLineOfWhatItRefuses) {
  for (const auto& [line, word] :
       {std::pair{"f 1 2 9", "vertex 9 does not exist"}, std::pair{"f 1 0 2", "start at 1"},
        std::pair{"f 1 2", "2 corners"}, std::pair{"v 1 2", "finite number"}, std::pair{"v 1 nan 2", "'nan'"},
        std::pair{"f 1 2 x", "'x'"}, std::pair{"f -5 1 2", "vertex -5 does not exist"}}) {
    const std::string reason =
        refusal([&] { read_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + std::string(line) + "\n", "bad.obj"); });
    EXPECT_TRUE(says(reason, "bad.obj: line 4"));
    EXPECT_TRUE(says(reason, word));
  }
}

std::string ply(const std::string& format) {
  const bool is_ascii = format == "ascii", is_big = format == "binary_big_endian";
  std::string text = "ply\nformat " + format +
                     " 1.0\ncomment a cube\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
                     "property uchar red\nelement face 12\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& p : cube.vertices) {
    for (const double c : {p.x, p.y, p.z})
      if (is_ascii)
        text += std::to_string(c) + " ";
      else
        append(text, std::bit_cast<std::uint32_t>(float(c)), is_big);
    text += is_ascii ? "255\n" : "\xFF";
  }
  for (const Triangle& t : cube.triangles) {
    text += is_ascii ? "3 " : "\x03";
    for (const std::uint32_t v : t)
      if (is_ascii)
        text += std::to_string(v) + " ";
      else
        append(text, v, is_big);
    if (is_ascii) text += "\n";
  }
  return text;
}

TEST(Ply, ReadsAllThreeEncodingsAlike) {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    Warnings warnings;
    const Part part = read_ply(ply(format), "cube.ply", warnings.progress);
    EXPECT_EQ(part.mesh.triangles, cube.triangles) << format;
    EXPECT_DOUBLE_EQ(volume_mm3(part.mesh), 8000) << format;
    EXPECT_TRUE(warnings.contain("colours")) << format;
  }
}

TEST(Ply, RefusesTruncationsAndIndicesThatDoNotExist) {
  for (const char* format : {"ascii", "binary_little_endian"}) {
    const std::string whole = ply(format);
    for (std::size_t length = 0; length + 8 < whole.size(); length += 5)
      EXPECT_TRUE(refusal([&] { read_ply(whole.substr(0, length), "cut.ply"); }).starts_with("cut.ply: ")) << length;
  }
  std::string wrong = ply("ascii");
  wrong.replace(wrong.rfind("3 7 5"), 5, "3 7 8");
  EXPECT_TRUE(says(refusal([&] { read_ply(wrong, "wrong.ply"); }), "vertex 8 does not exist; there are 8"));
}

std::string amf_mesh() {
  std::string text = "<vertices>";
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    text += "<vertex><coordinates><x>" + std::to_string(p.x) + "</x><y> " + std::to_string(p.y) + "</y><z>" +
            std::to_string(p.z) + "\n</z></coordinates></vertex>";
  return text + "</vertices>";
}

const std::string amf_triangles =
    "<triangle><v1>0</v1><v2>2</v2><v3>1</v3></triangle><triangle><v1>0</v1><v2>1</v2><v3>3</v3></triangle>"
    "<triangle><v1>1</v1><v2>2</v2><v3>3</v3></triangle><triangle><v1>2</v1><v2>0</v2><v3>3</v3></triangle>";

TEST(Amf, ReadsUnitsColoursExtrudersAndNames) {
  const std::string text =
      "<amf unit=\"inch\"><object id=\"1\"><metadata type=\"slic3r.extruder\">2</metadata><mesh>" + amf_mesh() +
      "<volume materialid=\"7\"><metadata type=\"Name\">hull</metadata>" + amf_triangles +
      "</volume><volume><color><r>0</r><g>1</g><b>0</b></color><metadata type=\"slic3r.extruder\">1"
      "</metadata>" +
      amf_triangles +
      "</volume></mesh></object><material id=\"7\"><color><r>1</r><g>0</g><b>0</b>"
      "</color></material></amf>";
  const std::vector<Part> parts = read_amf(text, "a.amf");
  ASSERT_EQ(parts.size(), 2);
  EXPECT_EQ(parts[0].name, "a.amf: hull");
  EXPECT_EQ(parts[0].rgb, 0xFF0000U);
  EXPECT_EQ(parts[0].extruder, 1);
  EXPECT_EQ(parts[1].rgb, 0x00FF00U);
  EXPECT_EQ(parts[1].extruder, 0);
  EXPECT_NEAR(volume_mm3(parts[0].mesh), 25.4 * 25.4 * 25.4 / 6, 1e-9);
}

TEST(Amf, PlacesConstellationsWithinConstellations) {
  const std::string text =
      "<amf><object id=\"1\"><mesh>" + amf_mesh() + "<volume>" + amf_triangles +
      "</volume></mesh></object><constellation id=\"2\"><instance objectid=\"1\"><deltax>5</deltax>"
      "</instance></constellation><constellation id=\"3\"><instance objectid=\"2\"><rz>90</rz>"
      "<deltaz>1</deltaz></instance><instance objectid=\"1\"/></constellation></amf>";
  const std::vector<Part> parts = read_amf(text, "a.amf");
  ASSERT_EQ(parts.size(), 2);
  const Box<Vec3> box = bounds(parts[0].mesh);  // 5 along X turned to 5 along Y
  EXPECT_NEAR(box.min.y, 5, 1e-12);
  EXPECT_NEAR(box.min.x, -1, 1e-12);
  EXPECT_NEAR(box.min.z, 1, 1e-12);
  EXPECT_EQ(bounds(parts[1].mesh).min, (Vec3{0, 0, 0}));
}

TEST(Amf, RefusesConstellationsWithinThemselvesAndColoursOfSingleTriangles) {
  const std::string object = "<object id=\"1\"><mesh>" + amf_mesh() + "<volume>" + amf_triangles;
  const std::string cycle =
      "<amf>" + object +
      "</volume></mesh></object><constellation id=\"2\"><instance objectid=\"3\"/></constellation>"
      "<constellation id=\"3\"><instance objectid=\"2\"/></constellation><constellation id=\"4\">"
      "<instance objectid=\"3\"/></constellation></amf>";
  EXPECT_TRUE(says(refusal([&] { read_amf(cycle, "a.amf"); }), "contains itself"));
  const std::string colours =
      "<amf>" + object +
      "<triangle><v1>0</v1><v2>1</v2><v3>2</v3><color><r>1</r><g>0</g><b>0</b></color></triangle>"
      "<triangle><v1>0</v1><v2>1</v2><v3>2</v3><color><r>0</r><g>0</g><b>0</b></color></triangle>"
      "</volume></mesh></object></amf>";
  EXPECT_TRUE(says(refusal([&] { read_amf(colours, "a.amf"); }), "more than one colour"));
}

TEST(Read, TellsFilesByTheirContent) {
  const std::string amf = "<?xml version=\"1.0\"?><amf><object id=\"1\"><mesh>" + amf_mesh() + "<volume>" +
                          amf_triangles + "</volume></mesh></object></amf>";
  EXPECT_EQ(read_model_bytes(binary_stl(cube), "cube.obj")[0].mesh.triangles.size(), 12);
  EXPECT_EQ(read_model_bytes(ply("ascii"), "cube.xyz")[0].mesh.triangles.size(), 12);
  EXPECT_EQ(read_model_bytes(amf, "a.txt")[0].mesh.triangles.size(), 4);
  EXPECT_EQ(read_model_bytes(stored_zip({{"a.amf", amf}}), "a.amf")[0].mesh.triangles.size(), 4);
  EXPECT_TRUE(says(refusal([] { read_model_bytes("\x89PNG....", "a.stl"); }), "PNG picture"));
  EXPECT_TRUE(says(refusal([] { read_model_bytes("hello", "a.txt"); }), "of no known kind"));
  EXPECT_TRUE(says(refusal([] { read_model("no such file.stl"); }), "cannot be opened"));
  EXPECT_TRUE(says(refusal([] { read_model(CLEANCOLOR_ROOT); }), "folder"));
}

}  // namespace
}  // namespace cleancolor
