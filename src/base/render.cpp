#include "base/render.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/draw.hpp"

namespace cleancolor {
namespace {

struct Vec3f {
  float x = 0, y = 0, z = 0;
};

Vec3f operator+(Vec3f a, Vec3f b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vec3f operator-(Vec3f a, Vec3f b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec3f operator*(Vec3f a, float s) {
  return {a.x * s, a.y * s, a.z * s};
}
float dot(Vec3f a, Vec3f b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vec3f cross(Vec3f a, Vec3f b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec3f unit(Vec3f a) {
  const float l = std::sqrt(dot(a, a));
  return l > 0 ? a * (1 / l) : Vec3f{0, 0, 1};
}

/// The eye's frame: x to the right, y up in the picture, z towards the viewer.
struct Eye {
  Vec3 right, up, toward;

  explicit Eye(const View& v) {
    const double ca = std::cos(v.azimuth_rad), sa = std::sin(v.azimuth_rad);
    const double ce = std::cos(v.elevation_rad), se = std::sin(v.elevation_rad);
    right = {ca, sa, 0};
    toward = {sa * ce, -ca * ce, se};
    up = {-sa * se, ca * se, ce};
  }
  Vec3 seen(Vec3 p) const { return {dot(right, p), dot(up, p), dot(toward, p)}; }
};

/// Depth and light of every sample; samples are pixels of a picture `scale` times as large.
struct Film {
  int width, height;
  std::vector<float> depth;           // towards the viewer
  std::vector<std::uint32_t> colour;  // 0 where nothing is seen, else 0xFFRRGGBB

  Film(int w, int h)
      : width(w), height(h), depth(std::size_t(w) * std::size_t(h), -INFINITY), colour(depth.size(), 0) {}
};

/// What the eye sees of a colour on a surface that faces this way, in the eye's frame.
std::uint32_t shaded(Vec3f normal, Vec3f rgb) {
  static const Vec3f key = unit({-0.45f, 0.65f, 0.62f});
  static const Vec3f fill = unit({0.8f, 0.1f, 0.55f});
  const float wrapped = std::max(0.f, (dot(normal, key) + 0.25f) / 1.25f);
  const float light = 0.44f + 0.56f * wrapped + 0.2f * std::max(0.f, dot(normal, fill)) + 0.06f * normal.y;
  const Vec3f half = unit(key + Vec3f{0, 0, 1});
  const float facing = std::max(0.f, dot(normal, half));
  const float f2 = facing * facing, f4 = f2 * f2, f8 = f4 * f4;
  const float shine = 14.f * f8 * f8 * f4;
  const auto channel = [&](float c) { return std::uint32_t(std::clamp(c * light + shine, 0.f, 255.f) + 0.5f); };
  return 0xFF000000u | channel(rgb.x) << 16 | channel(rgb.y) << 8 | channel(rgb.z);
}

struct Corner {
  Vec3f at;  // x, y in samples from the lower left; z in mm towards the viewer
  Vec3f normal;
};

/// Draws one triangle; its light is interpolated through the normals.
void draw(Film& film, const std::array<Corner, 3>& t, Vec3f rgb) {
  const Vec3f a = t[0].at, b = t[1].at, c = t[2].at;
  const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (!(area > 0)) return;  // seen from behind, or edge on
  const int x0 = std::max(0, int(std::ceil(std::min({a.x, b.x, c.x}) - 0.5f)));
  const int x1 = std::min(film.width - 1, int(std::floor(std::max({a.x, b.x, c.x}) - 0.5f)));
  const int y0 = std::max(0, int(std::ceil(std::min({a.y, b.y, c.y}) - 0.5f)));
  const int y1 = std::min(film.height - 1, int(std::floor(std::max({a.y, b.y, c.y}) - 0.5f)));
  if (x0 > x1 || y0 > y1) return;
  const float inverse = 1 / area;
  for (int y = y0; y <= y1; ++y) {
    const float py = float(y) + 0.5f;
    for (int x = x0; x <= x1; ++x) {
      const float px = float(x) + 0.5f;
      const float wa = ((b.x - px) * (c.y - py) - (b.y - py) * (c.x - px)) * inverse;
      const float wb = ((c.x - px) * (a.y - py) - (c.y - py) * (a.x - px)) * inverse;
      const float wc = 1 - wa - wb;
      constexpr float edge = -1e-4f;  // neighbours share their edges: no pinholes
      if (wa < edge || wb < edge || wc < edge) continue;
      const std::size_t i = std::size_t(y) * std::size_t(film.width) + std::size_t(x);
      const float z = wa * a.z + wb * b.z + wc * c.z;
      if (z <= film.depth[i]) continue;
      film.depth[i] = z;
      film.colour[i] = shaded(unit(t[0].normal * wa + t[1].normal * wb + t[2].normal * wc), rgb);
    }
  }
}

/// Draws a body whose vertices are given in samples.
void draw(Film& film, const Body& body, const std::vector<Vec3f>& at, float mm_per_sample) {
  // In the eye's frame all three axes in mm, or normals would lean.
  const auto in_mm = [&](std::uint32_t i) { return Vec3f{at[i].x * mm_per_sample, at[i].y * mm_per_sample, at[i].z}; };
  std::vector<Vec3f> face(body.triangles.size());
  std::vector<Vec3f> around(at.size());
  for (std::size_t i = 0; i < face.size(); ++i) {
    const auto& t = body.triangles[i];
    const Vec3f n = cross(in_mm(t[1]) - in_mm(t[0]), in_mm(t[2]) - in_mm(t[0]));  // as long as twice the area
    face[i] = n;
    for (const std::uint32_t v : t) around[v] = around[v] + n;
  }
  for (Vec3f& n : around) n = unit(n);

  const Vec3f rgb{float(body.rgb >> 16 & 255), float(body.rgb >> 8 & 255), float(body.rgb & 255)};
  constexpr float smooth = 0.8f;  // cosine of the angle up to which an edge is rounded in the light: 37 degrees
  for (std::size_t i = 0; i < face.size(); ++i) {
    if (face[i].z <= 0) continue;
    const Vec3f n = unit(face[i]);
    std::array<Corner, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = body.triangles[i][k];
      corners[k] = {at[v], dot(around[v], n) > smooth ? around[v] : n};
    }
    draw(film, corners, rgb);
  }
}

struct Offset {
  int dx, dy;
};

/// Where to look around a sample: four patterns that fill each other's gaps, for the four cells of a pixel.
std::array<std::array<Offset, 12>, 4> surroundings(int radius) {
  std::array<std::array<Offset, 12>, 4> patterns{};
  for (std::size_t q = 0; q < 4; ++q)
    for (std::size_t k = 0; k < 12; ++k) {
      const double angle = std::numbers::pi * (double(k) + double(q) / 4) / 12;  // half a turn: each looks both ways
      const double r = radius * (0.25 + 0.75 * double((5 * k + 3 * q) % 12) / 11);
      patterns[q][k] = {int(std::lround(r * std::cos(angle))), int(std::lround(r * std::sin(angle)))};
    }
  return patterns;
}

/// How much of the light a sample loses to what stands close around it, in [0, 1].
float hidden_share(const Film& film, int x, int y, const std::array<Offset, 12>& around, float reach_mm) {
  const auto index = [&](int u, int v) { return std::size_t(v) * std::size_t(film.width) + std::size_t(u); };
  const auto inside = [&](int u, int v) { return u >= 0 && v >= 0 && u < film.width && v < film.height; };
  const std::size_t i = index(x, y);
  float hidden = 0;
  for (const Offset o : around) {
    if (!inside(x + o.dx, y + o.dy) || !inside(x - o.dx, y - o.dy)) continue;
    const std::size_t j = index(x + o.dx, y + o.dy), k = index(x - o.dx, y - o.dy);
    if (film.colour[j] == 0 || film.colour[k] == 0) continue;
    // A plane rises on one side as much as it falls on the other: only hollows hide. What is far in front is no hollow.
    const float rise = 0.5f * (film.depth[j] + film.depth[k]) - film.depth[i];
    const float share = rise / reach_mm;
    hidden += std::clamp(share, 0.f, 1.f) * std::clamp(2.5f - share, 0.f, 1.f);
  }
  return std::min(1.f, hidden / 5);
}

/// Darker where nearer surfaces stand close around a place: holds the picture together like a soft shadow.
std::vector<float> occlusion(const Film& film, float mm_per_sample, int radius) {
  const auto patterns = surroundings(radius);
  const float reach_mm = float(radius) * mm_per_sample;
  std::vector<float> light(film.depth.size(), 1);
  // One value for every 2 x 2 samples: it varies slowly. Film sides are even.
  for (int y = 0; y < film.height; y += 2)
    for (int x = 0; x < film.width; x += 2) {
      const std::size_t i = std::size_t(y) * std::size_t(film.width) + std::size_t(x);
      if (film.colour[i] == 0) continue;
      const std::size_t cell = std::size_t((x / 2 & 1) + 2 * (y / 2 & 1));
      const float value = 1 - 0.45f * hidden_share(film, x, y, patterns[cell], reach_mm);
      const std::size_t above = i + std::size_t(film.width);
      light[i] = light[i + 1] = light[above] = light[above + 1] = value;
    }
  return light;
}

/// The mean of scale x scale samples for every pixel, as RGBA from the top row.
std::vector<std::uint8_t> developed(const Film& film, const std::vector<float>& light, int scale, bool transparent) {
  const int width = film.width / scale, height = film.height / scale;
  std::vector<std::uint8_t> rgba(std::size_t(width) * std::size_t(height) * 4);
  const float samples = float(scale * scale);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      float sum[4] = {};
      for (int v = 0; v < scale; ++v)
        for (int u = 0; u < scale; ++u) {
          const std::size_t i =
              std::size_t((height - 1 - y) * scale + v) * std::size_t(film.width) + std::size_t(x * scale + u);
          const std::uint32_t c = film.colour[i];
          if (c == 0) continue;
          for (int k = 0; k < 3; ++k) sum[k] += float(c >> (16 - 8 * k) & 255) * light[i];
          sum[3] += 1;
        }
      std::uint8_t* p = &rgba[4 * (std::size_t(y) * std::size_t(width) + std::size_t(x))];
      for (int k = 0; k < 3; ++k) {
        const float value =
            transparent ? (sum[3] > 0 ? sum[k] / sum[3] : 0) : (sum[k] + 255 * (samples - sum[3])) / samples;
        p[k] = std::uint8_t(std::clamp(value, 0.f, 255.f) + 0.5f);
      }
      p[3] = transparent ? std::uint8_t(255 * sum[3] / samples + 0.5f) : std::uint8_t(255);
    }
  return rgba;
}

}  // namespace

std::string rendered_png(std::span<const Body> bodies, const View& view) {
  assert(view.width_px > 0 && view.height_px > 0 && view.width_px <= 8192 && view.height_px <= 8192);
  const int scale = std::max(view.width_px, view.height_px) <= 1024 ? 4 : 2;
  Film film(view.width_px * scale, view.height_px * scale);

  const Eye eye(view);
  Box<Vec3> box;
  for (const Body& b : bodies)
    for (const Vec3 p : b.vertices) box.add(eye.seen(p));
  float mm_per_sample = 1;
  if (!box.empty()) {
    const Vec3 size = box.size();
    const double inside = 1 - 2 * view.margin;
    mm_per_sample = float(std::max({size.x / (inside * film.width), size.y / (inside * film.height), 1e-9}));
    for (const Body& b : bodies) {
      std::vector<Vec3f> at(b.vertices.size());
      for (std::size_t i = 0; i < at.size(); ++i) {
        const Vec3 p = eye.seen(b.vertices[i]) - box.center();
        at[i] = {float(p.x / double(mm_per_sample) + film.width / 2.0),
                 float(p.y / double(mm_per_sample) + film.height / 2.0), float(p.z)};
      }
      draw(film, b, at, mm_per_sample);
    }
  }
  const int radius = std::max(4, std::min(film.width, film.height) / 40);
  const auto light = occlusion(film, mm_per_sample, radius);
  return png(view.width_px, view.height_px, developed(film, light, scale, view.transparent));
}

}  // namespace cleancolor
