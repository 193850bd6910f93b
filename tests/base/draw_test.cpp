#include "base/draw.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <fstream>

#include "base/base64.hpp"
#include "base/render.hpp"
#include "sanitized.hpp"

using namespace cleancolor;

namespace {

constexpr std::string_view png_start = "\x89PNG\r\n";

std::string drawn_square(Colour c) {
  Canvas canvas({{0, 0}, {10, 10}}, 4);
  const std::vector<std::vector<Vec2>> rings = {{{2, 2}, {8, 2}, {8, 8}, {2, 8}}};
  canvas.fill(rings, c);
  canvas.line(rings[0], 0.5, colour(0x0000FF), true);
  canvas.text({1, 1}, 1, "a < b", colour(0));
  return canvas.png();
}

struct Cube {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

Cube cube(double size) {
  Cube c;
  for (int i = 0; i < 8; ++i) c.vertices.push_back({i & 1 ? size : 0, i & 2 ? size : 0, i & 4 ? size : 0});
  c.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return c;
}

}  // namespace

TEST(Base64, GivesTheExamplesOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

TEST(Canvas, DrawsTheSameBytesEveryTime) {
  EXPECT_EQ(drawn_square(colour(0xFF0000)), drawn_square(colour(0xFF0000)));
  EXPECT_NE(drawn_square(colour(0xFF0000)), drawn_square(colour(0x00FF00)));
  EXPECT_TRUE(drawn_square(colour(0xFF0000)).starts_with(png_start));
}

TEST(Canvas, DrawsToSvgWhatItDrawsToPng) {
  Canvas canvas({{0, 0}, {10, 10}}, 4);
  canvas.disc({5, 5}, 2, colour(0xFF0000));
  const std::string svg = canvas.svg();
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("width=\"40"), std::string::npos);
  EXPECT_NE(svg.find("rgb(100%"), std::string::npos);
}

TEST(Canvas, KeepsNothingOfAPictureThatIsGone) {
  if (test::sanitized) GTEST_SKIP() << "sanitizers keep freed memory";
  const auto used_mb = [] {
    std::ifstream statm("/proc/self/statm");
    long all_pages = 0, resident_pages = 0;
    statm >> all_pages >> resident_pages;
    return resident_pages * sysconf(_SC_PAGESIZE) / 1'000'000;
  };
  const auto draw = [] {
    Canvas canvas({{0, 0}, {100, 100}}, 4);
    for (int i = 0; i < 3000; ++i)  // some 3 MB of recording
      canvas.line(std::vector<Vec2>{{i * 0.01, 0}, {50, i * 0.02}}, 0.1, colour(0), false);
    return canvas.svg().size();
  };
  const std::size_t size = draw();
  const long before_mb = used_mb();
  for (int i = 0; i < 30; ++i) EXPECT_EQ(draw(), size);
  EXPECT_LT(used_mb() - before_mb, 30);
}

TEST(RenderedPng, AnEmptySceneIsTheBackgroundAlone) {
  const View view{.width_px = 8, .height_px = 4};
  EXPECT_EQ(rendered_png({}, view), png(8, 4, std::vector<std::uint8_t>(8 * 4 * 4, 0)));
  const View white{.width_px = 8, .height_px = 4, .transparent = false};
  EXPECT_EQ(rendered_png({}, white), png(8, 4, std::vector<std::uint8_t>(8 * 4 * 4, 255)));
}

TEST(RenderedPng, ABodyBehindAnotherIsNotSeen) {
  const Cube small = cube(1), large = cube(20);
  Cube front = small;
  for (Vec3& v : front.vertices) v = v + Vec3{9, 9, 9};  // inside the large one
  const Body outer{large.vertices, large.triangles, 0x3366CC};
  const std::array<Body, 2> both = {outer, Body{front.vertices, front.triangles, 0xFF0000}};
  EXPECT_EQ(rendered_png(both), rendered_png(std::array{outer}));
}

TEST(RenderedPng, TurningTheOrderOfBodiesChangesNothing) {
  const Cube a = cube(10);
  Cube b = cube(10);
  for (Vec3& v : b.vertices) v = v + Vec3{12, 0, 5};
  const Body red{a.vertices, a.triangles, 0xCC3333}, blue{b.vertices, b.triangles, 0x3333CC};
  EXPECT_EQ(rendered_png(std::array{red, blue}), rendered_png(std::array{blue, red}));
}
