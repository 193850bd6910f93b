#include "audit/sides.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <unordered_map>

#include "audit/voxel_surface.hpp"
#include "base/render.hpp"

namespace cleancolor {
namespace {

constexpr double elevation_rad = 20 * std::numbers::pi / 180;
constexpr double longest_blob_mm = 2;  // a touch begins with a blob; what follows is a thin film
constexpr int tint_steps = 8;          // so many colours between clean and covered

/// What lies on a quad.
struct Stain {
  double ooze = 0;  // how much of it is covered, in [0, 1], and by whose plastic
  std::uint8_t nozzle = 0;
  double hole = 0;
};

/// Quads by cells of 2 mm.
class QuadCells {
 public:
  explicit QuadCells(const VoxelSurface& surface) : surface_(surface) {
    for (std::uint32_t q = 0; q < surface.quads.size(); ++q) cells_[key_at(middle(q))].push_back(q);
  }

  Vec3 middle(std::uint32_t q) const {
    Vec3 m;
    for (const std::uint32_t v : surface_.quads[q]) m = m + surface_.vertices_mm[v] * 0.25;
    return m;
  }

  /// Calls visit(quad) for all in the cells of the box.
  template <class Visit>
  void for_near(const Box<Vec3>& box, Visit visit) const {
    const Key a = key_of(box.min), b = key_of(box.max);
    for (std::int64_t z = a.z; z <= b.z; ++z)
      for (std::int64_t y = a.y; y <= b.y; ++y)
        for (std::int64_t x = a.x; x <= b.x; ++x) {
          const auto found = cells_.find(packed({x, y, z}));
          if (found == cells_.end()) continue;
          for (const std::uint32_t q : found->second) visit(q);
        }
  }

 private:
  struct Key {
    std::int64_t x, y, z;
  };
  static Key key_of(Vec3 p) {
    const auto cell = [](double c) { return std::int64_t(std::floor(c / 2)); };
    return {cell(p.x), cell(p.y), cell(p.z)};
  }
  static std::int64_t packed(Key k) {
    constexpr std::int64_t side = std::int64_t(1) << 20;
    return ((k.z + side / 2) * side + k.y + side / 2) * side + k.x + side / 2;
  }
  std::int64_t key_at(Vec3 p) const { return packed(key_of(p)); }

  const VoxelSurface& surface_;
  std::unordered_map<std::int64_t, std::vector<std::uint32_t>> cells_;  // looked up only
};

/// How large a blob looks: its radius grows with the cube root of its volume.
double blob_radius_mm(double mm3) {
  return std::min(4., 0.4 + 0.9 * std::cbrt(std::max(mm3, 0.)));
}

double distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 ab = b - a;
  const double l2 = dot(ab, ab);
  const double t = l2 > 0 ? std::clamp(dot(p - a, ab) / l2, 0., 1.) : 0;
  return distance(p, a + ab * t);
}

/// What every quad carries in the end. Of several oozes the one that covers most.
std::vector<Stain> stains(const VoxelSurface& surface, const GcodePrint& print, const ScenarioResult& result) {
  std::vector<Stain> all(surface.quads.size());
  const QuadCells cells(surface);
  for (const Place& place : result.places) {
    const bool hole = place.kind == Place::Kind::hole;
    if (!hole && place.kind != Place::Kind::smear) continue;
    const GcodeLayer& layer = print.layers[place.layer];
    const double z = layer.z_mm - layer.height_mm / 2;
    const double way = distance(place.at_mm, place.end_mm);
    const Vec2 end = lerp(place.at_mm, place.end_mm, way > longest_blob_mm ? longest_blob_mm / way : 1);
    const Vec3 a{place.at_mm.x, place.at_mm.y, z}, b{end.x, end.y, z};
    const double r = blob_radius_mm(double(place.mm3));
    Box<Vec3> box;
    for (const Vec3 p : {a, b}) {
      box.add(p - Vec3{r, r, r});
      box.add(p + Vec3{r, r, r});
    }
    cells.for_near(box, [&](std::uint32_t q) {
      const double near = 1 - distance_to_segment(cells.middle(q), a, b) / r;
      if (near <= 0) return;
      const double cover = std::min(1., 2 * near);  // full up to half the radius
      Stain& s = all[q];
      if (hole) {
        s.hole = std::max(s.hole, cover);
      } else if (cover > s.ooze) {
        s.ooze = cover;
        s.nozzle = place.nozzle;
      }
    });
  }
  return all;
}

std::uint32_t blend(std::uint32_t from, std::uint32_t to, double share) {
  std::uint32_t rgb = 0;
  for (int shift = 0; shift <= 16; shift += 8) {
    const double a = double(from >> shift & 255), b = double(to >> shift & 255);
    rgb |= std::uint32_t(a + (b - a) * share + 0.5) << shift;
  }
  return rgb;
}

/// The quads of one colour, with vertices of their own.
struct ColouredMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Quads grouped by what colour they will show.
std::map<std::uint32_t, ColouredMesh> coloured(const VoxelSurface& surface, const std::vector<Stain>& stains,
                                               const AuditMachine& machine) {
  const auto rgb = [&](std::uint8_t nozzle) {
    return nozzle < machine.nozzles.size() ? machine.nozzles[nozzle].rgb : 0x808080u;
  };
  const auto step = [](double share) { return std::round(share * tint_steps) / tint_steps; };
  std::map<std::uint32_t, std::vector<std::uint32_t>> quads;
  for (std::uint32_t q = 0; q < surface.quads.size(); ++q) {
    const Stain& s = stains[q];
    const std::uint32_t stained = blend(rgb(surface.nozzle[q]), rgb(s.nozzle), step(s.ooze));
    quads[blend(stained, 0x202020, 0.8 * step(s.hole))].push_back(q);
  }

  std::map<std::uint32_t, ColouredMesh> meshes;
  std::vector<std::uint32_t> own(surface.vertices_mm.size());  // where a vertex is in the mesh, + 1
  for (const auto& [colour, members] : quads) {
    ColouredMesh& mesh = meshes[colour];
    for (const std::uint32_t q : members) {
      std::array<std::uint32_t, 4> c{};
      for (std::size_t k = 0; k < 4; ++k) {
        std::uint32_t& index = own[surface.quads[q][k]];
        if (index == 0) {
          mesh.vertices.push_back(surface.vertices_mm[surface.quads[q][k]]);
          index = std::uint32_t(mesh.vertices.size());
        }
        c[k] = index - 1;
      }
      mesh.triangles.push_back({c[0], c[1], c[2]});
      mesh.triangles.push_back({c[0], c[2], c[3]});
    }
    for (const std::uint32_t q : members)
      for (const std::uint32_t v : surface.quads[q]) own[v] = 0;
  }
  return meshes;
}

/// High enough that the part fills the width of its widest side.
int fitting_height_px(const VoxelSurface& surface, int width_px) {
  double wide = 1e-3, high = 1e-3;
  for (const Vec2 away : {Vec2{0, 1}, Vec2{1, 0}}) {
    Box<Vec2> box;
    for (const Vec3 p : surface.vertices_mm) {
      const double depth = dot({p.x, p.y}, away);
      box.add({cross({p.x, p.y}, away), depth * std::sin(elevation_rad) + p.z * std::cos(elevation_rad)});
    }
    if (box.empty()) return width_px;
    wide = std::max(wide, box.size().x);
    high = std::max(high, box.size().y);
  }
  return std::max(1, int(width_px * std::clamp(high / wide, 0.3, 2.)));
}

}  // namespace

std::vector<Side> sides(const GcodePrint& print, const AuditMachine& machine, const AuditResult& result,
                        std::size_t scenario, int width_px) {
  assert(scenario < result.scenarios.size() && result.visibility);
  const VoxelSurface surface = voxel_surface(result.visibility->voxels());
  const auto meshes = coloured(surface, stains(surface, print, result.scenarios[scenario]), machine);
  std::vector<Body> bodies;
  for (const auto& [rgb, mesh] : meshes) bodies.push_back({mesh.vertices, mesh.triangles, rgb});

  View view{.width_px = width_px,
            .height_px = fitting_height_px(surface, width_px),
            .azimuth_rad = 0,
            .elevation_rad = elevation_rad,
            .transparent = false};
  std::vector<Side> all;
  for (const char* name : {"front", "right", "back", "left"}) {
    all.push_back({name, rendered_png(bodies, view)});
    view.azimuth_rad += std::numbers::pi / 2;
  }
  return all;
}

}  // namespace cleancolor
