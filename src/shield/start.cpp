#include "shield/start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace cleancolor {
namespace {

constexpr double spacing_mm = 1;  // of the places looked at
constexpr double same_exposure_mm = 1e-6;

/// A place of the wall; between it and the next lies step i.
struct Place {
  Vec2 at_mm;
  std::size_t segment = 0;
};

std::vector<Place> places_of(const Path& wall) {
  std::vector<Place> places;
  for (std::size_t i = 0; i < wall.segments(); ++i) {
    const Vec2 a = wall.points[i], b = wall.points[(i + 1) % wall.points.size()];
    const int steps = std::max(1, int(std::ceil(distance(a, b) / spacing_mm)));
    for (int k = 0; k < steps; ++k) places.push_back({lerp(a, b, double(k) / steps), i});
  }
  if (!wall.closed) places.push_back({wall.points.back(), wall.segments() - 1});
  return places;
}

bool cross_each_other(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  // Segments on one line have all sides 0, however far apart they lie.
  const auto apart = [](double p, double q, double r, double s) {
    return std::max(p, q) < std::min(r, s) || std::max(r, s) < std::min(p, q);
  };
  if (apart(a.x, b.x, c.x, d.x) || apart(a.y, b.y, c.y, d.y)) return false;
  const auto side = [](Vec2 p, Vec2 q, Vec2 r) { return cross(q - p, r - p); };
  return side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0;
}

Box<Vec2> box_of(std::span<const Vec2> points) {
  Box<Vec2> box;
  for (const Vec2 p : points) box.add(p);
  return box;
}

/// Segments by rows of Y, so that only those nearby need be looked at.
class SegmentRows {
 public:
  void add(Vec2 a, Vec2 b) {
    for (int row = row_of(std::min(a.y, b.y)); row <= row_of(std::max(a.y, b.y)); ++row) rows_[row].emplace_back(a, b);
  }
  bool cross(Vec2 a, Vec2 b) const {
    for (int row = row_of(std::min(a.y, b.y)); row <= row_of(std::max(a.y, b.y)); ++row) {
      const auto found = rows_.find(row);
      if (found == rows_.end()) continue;
      for (const auto& [c, d] : found->second)
        if (cross_each_other(a, b, c, d)) return true;
    }
    return false;
  }

 private:
  static int row_of(double y) { return int(std::floor(y / spacing_mm)); }
  std::unordered_map<int, std::vector<std::pair<Vec2, Vec2>>> rows_;
};

/// What one idle nozzle meets on its way beside the wall.
struct Meeting {
  std::vector<char> over_part;                // by step: comes over the part
  std::vector<char> wiped;                    // by step: crosses a wall that stands already
  std::vector<std::vector<std::size_t>> own;  // by step: steps of the wall itself that it crosses
};

Meeting meeting(const std::vector<Place>& places, std::size_t steps, Vec2 idle_mm, const WallScene& scene) {
  Meeting m{std::vector<char>(steps), std::vector<char>(steps), std::vector<std::vector<std::size_t>>(steps)};
  const Box<Vec2> part = bounds_mm(scene.part);
  SegmentRows standing;
  for (const Path& wall : scene.standing)
    for (std::size_t i = 0; i < wall.segments(); ++i)
      standing.add(wall.points[i], wall.points[(i + 1) % wall.points.size()]);
  std::vector<Vec2> at;
  for (const Place& p : places) at.push_back(p.at_mm);
  const Box<Vec2> own = box_of(at);
  const auto in = [](const Box<Vec2>& box, Vec2 p) {
    return p.x >= box.min.x - spacing_mm && p.x <= box.max.x + spacing_mm && p.y >= box.min.y - spacing_mm &&
           p.y <= box.max.y + spacing_mm;
  };
  for (std::size_t s = 0; s < steps; ++s) {
    const Vec2 a = at[s] + idle_mm, b = at[(s + 1) % at.size()] + idle_mm, middle = lerp(a, b, 0.5);
    m.over_part[s] = in(part, middle) && contains(scene.part, to_nm(middle));
    m.wiped[s] = standing.cross(a, b);
    if (!in(own, middle)) continue;
    for (std::size_t t = 0; t < steps; ++t)
      if (std::abs(at[t].x - middle.x) < 2 * spacing_mm && std::abs(at[t].y - middle.y) < 2 * spacing_mm &&
          cross_each_other(a, b, at[t], at[(t + 1) % at.size()]))
        m.own[s].push_back(t);
  }
  return m;
}

/// Way of an idle nozzle over the part before its first wipe, if the wall is begun at step `first` and printed in this
/// direction.
double exposure_mm(const Meeting& m, const std::vector<double>& step_mm, std::size_t first, bool backwards,
                   double bound_mm) {
  const std::size_t n = step_mm.size();
  const auto printed = [&](std::size_t step) { return backwards ? (first + n - step) % n : (step + n - first) % n; };
  double sum = 0;
  for (std::size_t k = 0; k < n && sum <= bound_mm; ++k) {
    const std::size_t s = backwards ? (first + n - k) % n : (first + k) % n;
    if (m.wiped[s]) return sum;
    for (const std::size_t t : m.own[s])
      if (printed(t) < k) return sum;
    if (m.over_part[s]) sum += step_mm[s];
  }
  return sum;
}

}  // namespace

namespace {

/// The wall in steps, and what idle nozzles meet beside them.
struct Walk {
  std::vector<Place> places;
  std::vector<double> step_mm;
  std::vector<Meeting> meetings;

  Walk(const Path& wall, const WallScene& scene) : places(places_of(wall)) {
    step_mm.resize(wall.closed ? places.size() : places.size() - 1);
    for (std::size_t s = 0; s < step_mm.size(); ++s)
      step_mm[s] = distance(places[s].at_mm, places[(s + 1) % places.size()].at_mm);
    for (const Vec2 idle : scene.idle_mm) meetings.push_back(meeting(places, step_mm.size(), idle, scene));
  }

  /// Begun at a place; sums beyond the bound need not be exact.
  double exposed_mm(std::size_t place, bool backwards, double bound_mm) const {
    // Backwards, the first step is the one before the place.
    const std::size_t first = backwards ? (place + step_mm.size() - 1) % step_mm.size() : place;
    double sum = 0;
    for (const Meeting& m : meetings) sum += exposure_mm(m, step_mm, first, backwards, bound_mm);
    return sum;
  }
};

}  // namespace

double exposure_mm(const Path& open_wall, const WallScene& scene, bool backwards) {
  const Walk walk(open_wall, scene);
  return walk.exposed_mm(backwards ? walk.places.size() - 1 : 0, backwards, std::numeric_limits<double>::infinity());
}

WallStart wall_start(const Path& wall, const WallScene& scene, Vec2 from_mm) {
  const Walk walk(wall, scene);
  WallStart best{.exposure_mm = std::numeric_limits<double>::infinity()};
  double best_mm = 0;
  const auto offer = [&](std::size_t place, bool backwards) {
    const double sum = walk.exposed_mm(place, backwards, best.exposure_mm);
    const Place& p = walk.places[place];
    const double way_mm = distance(p.at_mm, from_mm);
    const bool better = sum < best.exposure_mm - same_exposure_mm;
    if (!better && (sum > best.exposure_mm + same_exposure_mm || way_mm >= best_mm)) return;
    best = {p.segment, p.at_mm, backwards, sum};
    best_mm = way_mm;
  };
  if (wall.closed) {
    for (std::size_t p = 0; p < walk.places.size(); ++p)
      for (const bool backwards : {false, true}) offer(p, backwards);
  } else {
    offer(0, false);
    offer(walk.places.size() - 1, true);
  }
  return best;
}

Path begun(Path wall, const WallStart& start) {
  if (!wall.closed) return start.backwards ? reversed(std::move(wall)) : wall;
  wall = start.at_mm == wall.points[start.segment] ? started_at(std::move(wall), start.segment)
                                                   : started_on(std::move(wall), start.segment, start.at_mm);
  return start.backwards ? reversed(std::move(wall)) : wall;
}

}  // namespace cleancolor
