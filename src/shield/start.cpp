#include "shield/start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Segments by rows of Y, so that only those nearby need be looked at.
class SegmentRows {
 public:
  explicit SegmentRows(const Box<Vec2>& box)
      : low_(box.empty() ? 0 : box.min.y), rows_(box.empty() ? 1 : std::size_t(box.size().y / spacing_mm) + 1) {}
  void add(Vec2 a, Vec2 b, std::size_t index) {
    for_rows(a, b, [&](std::size_t row) {
      rows_[row].push_back({a, b, index});
      return false;
    });
  }
  /// Whether the visitor says so of the index of any that a -> b crosses; one may come twice.
  template <class Visit>
  bool any_crossed(Vec2 a, Vec2 b, Visit visit) const {
    return for_rows(a, b, [&](std::size_t row) {
      return std::ranges::any_of(rows_[row],
                                 [&](const Segment& s) { return cross_each_other(a, b, s.a, s.b) && visit(s.index); });
    });
  }

 private:
  struct Segment {
    Vec2 a, b;
    std::size_t index;
  };
  template <class Visit>
  bool for_rows(Vec2 a, Vec2 b, Visit visit) const {
    const auto row = [&](double y) { return int(std::floor((y - low_) / spacing_mm)); };
    const int last = std::min(row(std::max(a.y, b.y)), int(rows_.size()) - 1);
    for (int r = std::max(0, row(std::min(a.y, b.y))); r <= last; ++r)
      if (visit(std::size_t(r))) return true;
    return false;
  }
  double low_;
  std::vector<std::vector<Segment>> rows_;
};

SegmentRows rows_of(std::span<const Path> walls) {
  Box<Vec2> box;
  for (const Path& wall : walls)
    for (const Vec2 p : wall.points) box.add(p);
  SegmentRows rows(box);
  for (std::size_t w = 0; w < walls.size(); ++w)
    for (std::size_t i = 0; i < walls[w].segments(); ++i)
      rows.add(walls[w].points[i], walls[w].points[(i + 1) % walls[w].points.size()], w);
  return rows;
}

/// Where a walk that has come so far is wiped.
struct Wipe {
  std::size_t step = 0;
  std::size_t steps_before = 0;  // that must have been printed; 0: a wall that stands already
};

/// What one idle nozzle meets on its way beside the wall.
struct Meeting {
  std::vector<double> over_part_mm;   // of the steps before each, and of all
  std::vector<Wipe> ahead, backward;  // by step, of walks in both directions
};

/// A wall in steps, and what stands around it.
struct Surroundings {
  std::span<const Place> places;
  std::size_t steps = 0;
  const Polygons& part;
  Box<Vec2> part_box;
  SegmentRows standing, own;
};

Surroundings surroundings(std::span<const Place> places, std::size_t steps, const WallScene& scene) {
  Box<Vec2> box;
  for (const Place& p : places) box.add(p.at_mm);
  Surroundings around{places, steps, scene.part, bounds_mm(scene.part), rows_of(scene.standing), SegmentRows(box)};
  for (std::size_t s = 0; s < steps; ++s) around.own.add(places[s].at_mm, places[(s + 1) % places.size()].at_mm, s);
  return around;
}

Meeting meeting(const Surroundings& around, Vec2 idle_mm) {
  const std::size_t n = around.steps;
  Meeting m{.over_part_mm = {0}, .ahead = {}, .backward = {}};
  const auto may_be_over = [&](Vec2 p) {
    const Box<Vec2>& box = around.part_box;
    return p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y;
  };
  for (std::size_t s = 0; s < n; ++s) {
    const Vec2 a = around.places[s].at_mm + idle_mm, b = around.places[(s + 1) % around.places.size()].at_mm + idle_mm;
    const Vec2 middle = lerp(a, b, 0.5);
    const bool is_over = may_be_over(middle) && contains(around.part, to_nm(middle));
    m.over_part_mm.push_back(m.over_part_mm.back() + (is_over ? distance(a, b) : 0));
    if (around.standing.any_crossed(a, b, [](std::size_t) { return true; })) {
      m.ahead.push_back({s, 0});
      m.backward.push_back({s, 0});
      continue;
    }
    // Of the steps of the wall itself that it crosses, the ones printed last before this one.
    std::size_t ahead = n, backward = n;
    around.own.any_crossed(a, b, [&](std::size_t t) {
      if (t != s) ahead = std::min(ahead, (s + n - t) % n), backward = std::min(backward, (t + n - s) % n);
      return false;
    });
    if (ahead < n) m.ahead.push_back({s, ahead}), m.backward.push_back({s, backward});
  }
  return m;
}

/// Way of an idle nozzle over the part before its first wipe, if the wall is begun at step `first` and printed in this
/// direction.
double exposure_mm(const Meeting& m, std::size_t first, bool backwards) {
  const std::vector<double>& over = m.over_part_mm;
  const std::vector<Wipe>& wipes = backwards ? m.backward : m.ahead;
  const std::size_t n = over.size() - 1;
  const auto steps_to = [&](const Wipe& w) { return backwards ? (first + n - w.step) % n : (w.step + n - first) % n; };
  const auto next =
      std::size_t(std::ranges::lower_bound(wipes, backwards ? first + 1 : first, {}, &Wipe::step) - wipes.begin());
  for (std::size_t i = 0; i < wipes.size(); ++i) {
    const Wipe& w = wipes[(backwards ? next + 2 * wipes.size() - 1 - i : next + i) % wipes.size()];
    if (steps_to(w) < w.steps_before) continue;
    // Steps from the first to this one, neither end nor begin of the list between them, or both.
    const auto between = [&](std::size_t begin, std::size_t end) {
      return over[end] - over[begin] + (begin > end ? over.back() : 0);
    };
    if (!backwards) return between(first, w.step);
    return steps_to(w) == 0 ? 0 : between(w.step + 1, first + 1);
  }
  return over.back();
}

/// The wall in steps, and what idle nozzles meet beside them.
struct Walk {
  std::vector<Place> places;
  std::size_t steps;
  std::vector<Meeting> meetings;  // by idle nozzle

  Walk(const Path& wall, const WallScene& scene)
      : places(places_of(wall)), steps(wall.closed ? places.size() : places.size() - 1) {
    const Surroundings around = surroundings(places, steps, scene);
    for (const Vec2 idle : scene.idle_mm) meetings.push_back(meeting(around, idle));
  }

  /// Begun at a place.
  double exposed_mm(std::size_t place, bool backwards) const {
    // Backwards, the first step is the one before the place.
    const std::size_t first = backwards ? (place + steps - 1) % steps : place;
    double sum = 0;
    for (const Meeting& m : meetings) sum += exposure_mm(m, first, backwards);
    return sum;
  }
};

}  // namespace

double exposure_mm(const Path& open_wall, const WallScene& scene, bool backwards) {
  const Walk walk(open_wall, scene);
  return walk.exposed_mm(backwards ? walk.places.size() - 1 : 0, backwards);
}

WallStart wall_start(const Path& wall, const WallScene& scene, Vec2 from_mm) {
  const Walk walk(wall, scene);
  WallStart best;
  best.exposure_mm = std::numeric_limits<double>::infinity();
  double best_mm = 0;
  const auto offer = [&](std::size_t place, bool backwards) {
    const double sum = walk.exposed_mm(place, backwards);
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
