#include "model/triangulate.hpp"

#include <numeric>

namespace cleancolor {

namespace {

/// Twice the vector area: along the mean normal, as long as twice the area.
Vec3 area_vector(std::span<const Vec3> corners) {
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum = sum + cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  return sum;
}

/// The corners seen along the axis nearest to their normal, so that the polygon runs counterclockwise.
std::vector<Vec2> flattened(std::span<const Vec3> corners) {
  const Vec3 n = area_vector(corners);
  const double ax = std::abs(n.x), ay = std::abs(n.y), az = std::abs(n.z);
  std::vector<Vec2> flat;
  flat.reserve(corners.size());
  for (const Vec3& p : corners) {
    if (az >= ax && az >= ay)
      flat.push_back(n.z >= 0 ? Vec2{p.x, p.y} : Vec2{p.y, p.x});
    else if (ax >= ay)
      flat.push_back(n.x >= 0 ? Vec2{p.y, p.z} : Vec2{p.z, p.y});
    else
      flat.push_back(n.y >= 0 ? Vec2{p.z, p.x} : Vec2{p.x, p.z});
  }
  return flat;
}

bool inside(Vec2 a, Vec2 b, Vec2 c, Vec2 p) {
  return cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
}

bool is_ear(const std::vector<Vec2>& flat, const std::vector<std::uint32_t>& ring, std::size_t i) {
  const std::size_t n = ring.size();
  const Vec2 a = flat[ring[(i + n - 1) % n]], b = flat[ring[i]], c = flat[ring[(i + 1) % n]];
  if (cross(b - a, c - b) <= 0) return false;
  for (std::size_t k = 2; k + 1 < n; ++k) {
    const Vec2 p = flat[ring[(i + k) % n]];
    if (inside(a, b, c, p) && !(p == a) && !(p == b) && !(p == c)) return false;
  }
  return true;
}

}  // namespace

std::vector<Triangle> triangulated(std::span<const Vec3> corners) {
  std::vector<std::uint32_t> ring(corners.size());
  std::iota(ring.begin(), ring.end(), 0U);
  std::vector<Triangle> triangles;
  triangles.reserve(corners.size() - 2);
  if (corners.size() > 3) {
    const std::vector<Vec2> flat = flattened(corners);
    std::size_t i = 0, tried = 0, tests = 0;
    while (ring.size() > 3 && tried < ring.size() && tests < 200 * corners.size()) {
      const std::size_t n = ring.size();
      tests += n;
      if (is_ear(flat, ring, i)) {
        triangles.push_back({ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]});
        ring.erase(ring.begin() + std::ptrdiff_t(i));
        tried = 0;
      } else {
        ++i;
        ++tried;
      }
      i %= ring.size();
    }
  }
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) triangles.push_back({ring[0], ring[i], ring[i + 1]});
  return triangles;
}

}  // namespace cleancolor
