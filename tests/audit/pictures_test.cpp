#include "audit/pictures.hpp"

#include <cairo.h>
#include <gtest/gtest.h>

#include "audit/picture_parts.hpp"
#include "drawn.hpp"

namespace cleancolor {
namespace {

/// Pixels of a picture.
class Pixels {
 public:
  explicit Pixels(const Canvas& canvas) : png_(canvas.png()) {
    const auto read = [](void* self, unsigned char* bytes, unsigned count) {
      auto& p = *static_cast<Pixels*>(self);
      if (p.read_ + count > p.png_.size()) return CAIRO_STATUS_READ_ERROR;
      std::copy_n(p.png_.begin() + std::ptrdiff_t(p.read_), count, bytes);
      p.read_ += count;
      return CAIRO_STATUS_SUCCESS;
    };
    image_ = cairo_image_surface_create_from_png_stream(read, this);
  }
  ~Pixels() { cairo_surface_destroy(image_); }
  Pixels(const Pixels&) = delete;
  Pixels& operator=(const Pixels&) = delete;

  int width() const { return cairo_image_surface_get_width(image_); }
  int height() const { return cairo_image_surface_get_height(image_); }

  /// Pixels of a colour, within 4 steps of each channel.
  int count(std::uint32_t rgb) const {
    int found = 0;
    const unsigned char* rows = cairo_image_surface_get_data(image_);
    for (int y = 0; y < height(); ++y)
      for (int x = 0; x < width(); ++x) {
        const unsigned char* p = rows + std::ptrdiff_t(y) * cairo_image_surface_get_stride(image_) + 4 * x;
        bool same = true;
        for (int i = 0; i < 3; ++i) same &= std::abs(int(p[i]) - int(rgb >> (8 * i) & 255)) <= 4;
        found += same;
      }
    return found;
  }

 private:
  std::string png_;
  std::size_t read_ = 0;
  cairo_surface_t* image_ = nullptr;
};

constexpr std::uint32_t red = 0xC00000, blue = 0x0000C0;

/// Red on the left, blue 5 mm beside it, both printed in one layer.
struct TwoWalls {
  AuditMachine machine = drawn_machine({{0, 0}, {33, 0}});
  GcodePrint print;
  AuditResult result;

  TwoWalls() {
    machine.nozzles[0].rgb = red;
    machine.nozzles[1].rgb = blue;
    Drawing drawing(machine);
    for (int layer = 0; layer < 2; ++layer)
      drawing.layer(layer).tool(0, true).wall().road({0, 0}, {0, 10}).tool(1, true).wall().road({5, 0}, {5, 10});
    print = drawing.print();
    result = audit(print, machine);
    for (ScenarioResult& s : result.scenarios) s.places.clear();
  }
  Pixels picture(std::uint32_t layer = 1, const LayerPicture& options = {.width_px = 600, .legend = false}) const {
    return Pixels(layer_picture(print, machine, result, 0, layer, options));
  }
  void put(Place::Kind kind, float mm3, std::uint8_t nozzle) {
    Place p;
    p.kind = kind;
    p.nozzle = nozzle;
    p.mm3 = mm3;
    p.layer = 1;
    p.at_mm = {2.5, 5};
    result.scenarios[0].places.push_back(p);
  }
};

TEST(LayerPicture, ShowsRoadsInTheColoursOfTheirNozzles) {
  const TwoWalls walls;
  const Pixels picture = walls.picture();
  EXPECT_EQ(picture.width(), 600);
  // 10 mm x 0.4 mm each, at the scale of the picture; the borders of roads are darker.
  const double mm_px = (600 - 28) / (10 + 2 * 1.3);
  for (const std::uint32_t rgb : {red, blue}) {
    EXPECT_GT(picture.count(rgb), 0.6 * 4 * mm_px * mm_px) << rgb;
    EXPECT_LT(picture.count(rgb), 1.1 * 4 * mm_px * mm_px) << rgb;
  }
}

TEST(LayerPicture, ShowsASmearWithAnAreaAsItsVolume) {
  TwoWalls without, small, large;
  small.put(Place::Kind::smear, 0.1F, 1);
  large.put(Place::Kind::smear, 0.4F, 1);
  const int base = without.picture().count(blue);
  const int one = small.picture().count(blue) - base, four = large.picture().count(blue) - base;
  EXPECT_GT(one, 100);
  EXPECT_NEAR(double(four) / one, 4, 0.5);
  EXPECT_LE(std::abs(small.picture(0).count(blue) - base), 2) << "the smear lies in the other layer";
}

TEST(LayerPicture, ShowsAHoleAsABlackRing) {
  TwoWalls without, holed;
  holed.put(Place::Kind::hole, 0.4F, 0);
  EXPECT_GT(holed.picture().count(0x000000), without.picture().count(0x000000) + 50);
}

TEST(LayerPicture, ShowsAuxiliaryPlasticPale) {
  TwoWalls walls;
  const int strong = walls.picture().count(red);
  for (GcodeMove& m : walls.print.moves)
    if (m.tool == 0) m.role = Role::skirt_brim;
  EXPECT_LT(walls.picture().count(red), strong / 20);
}

TEST(LayerPicture, ShowsNozzlesOfAnyColour) {
  TwoWalls walls;
  for (const std::uint32_t rgb : {0xFFFFFFu, 0x000000u, 0xFFFF00u}) {
    walls.machine.nozzles[0].rgb = rgb;
    const Colour line = line_colour(walls.machine, 0);
    EXPECT_LT(lightness(line), 0.5) << "a thin line must be seen on white";
    EXPECT_NO_THROW(walls.picture());
  }
}

TEST(LayerPicture, OfAnEmptyLayerIsEmpty) {
  TwoWalls walls;
  walls.print.layers.push_back({100, 0.2});
  for (ScenarioResult& s : walls.result.scenarios) s.layers.emplace_back();
  EXPECT_EQ(walls.picture(2).count(red), 0);
}

TEST(LayerPicture, IsAlsoAnSvgOfTheSameSize) {
  const TwoWalls walls;
  const Canvas canvas = layer_picture(walls.print, walls.machine, walls.result, 0, 1);
  EXPECT_NE(canvas.svg().find("width=\"900"), std::string::npos);
  EXPECT_EQ(canvas.svg(), layer_picture(walls.print, walls.machine, walls.result, 0, 1).svg());
}

TEST(HeightCurves, SumSmearsByNozzleAndHolesOfAll) {
  TwoWalls walls;
  walls.put(Place::Kind::smear, 0.5F, 1);
  walls.put(Place::Kind::smear, 0.25F, 1);
  walls.put(Place::Kind::inner, 7, 1);
  for (Figures& f : walls.result.scenarios[0].layers) f = {};
  walls.result.scenarios[0].layers[0].hole_volume = 0.125;
  const auto curves = height_curves(walls.print, walls.machine, walls.result, 0);
  ASSERT_EQ(curves.size(), 2u) << "nozzle 0 leaves no smear";
  EXPECT_EQ(curves[0].name, "smears of T1");
  EXPECT_EQ(curves[0].points, (std::vector<Vec2>{{walls.print.layers[0].z_mm, 0}, {walls.print.layers[1].z_mm, 0.75}}));
  EXPECT_EQ(curves[1].name, "holes");
  EXPECT_EQ(curves[1].points[0].y, 0.125);
}

TEST(HeightPicture, DrawsEveryCurveAndAlsoNone) {
  const std::vector<HeightCurve> curves = {{"a", colour(red), {{0, 0}, {10, 1}}},
                                           {"b\xff", colour(blue), {{0, 1}, {10, 0}}}};
  const Pixels both(height_picture(curves)), none(height_picture({}));
  EXPECT_GT(both.count(red), 200);
  EXPECT_GT(both.count(blue), 200);
  EXPECT_EQ(none.count(red), 0);
}

TEST(Clipped, KeepsWhatLiesInTheBox) {
  Box<Vec2> box;
  box.add({0, 0});
  box.add({10, 10});
  const auto inside = [&](Vec2 a, Vec2 b) { return clipped(a, b, box); };
  EXPECT_EQ(inside({-5, 5}, {15, 5}), (std::pair<Vec2, Vec2>{{0, 5}, {10, 5}}));
  EXPECT_EQ(inside({2, 3}, {4, 5}), (std::pair<Vec2, Vec2>{{2, 3}, {4, 5}}));
  EXPECT_EQ(inside({5, 5}, {5, 1e9})->second, (Vec2{5, 10}));
  EXPECT_FALSE(inside({-5, 0}, {0, 20}).has_value());
  EXPECT_FALSE(inside({-5, 20}, {15, 20}).has_value());
  const std::vector<Vec2> way = {{5, 5}, {20, 5}, {20, 8}, {5, 8}};  // out and in again
  EXPECT_EQ(clipped(way, box).size(), 2u);
}

TEST(RoundNumber, IsTheLargestOf1And2And5) {
  EXPECT_DOUBLE_EQ(round_number(7), 5);
  EXPECT_DOUBLE_EQ(round_number(4.9), 2);
  EXPECT_DOUBLE_EQ(round_number(1), 1);
  EXPECT_DOUBLE_EQ(round_number(0.03), 0.02);
  EXPECT_DOUBLE_EQ(round_number(999), 500);
}

}  // namespace
}  // namespace cleancolor
