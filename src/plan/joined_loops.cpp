#include "plan/joined_loops.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "plan/precedence.hpp"

namespace cleancolor {
namespace {

constexpr double reach_in_spacings = 1.6;  // of a joint: corners are further from each other than sides
// Half the gap of the inner loop, in distances of the loops: then the stroke outwards and half a stroke inwards take
// just as much plastic as the gap leaves out.
constexpr double half_gap = 1.134;
constexpr double most_trimmed = 1 / 3.;                      // of the inner loop, at each of its ends
constexpr double longest_lead = 0.75, shortest_lead = 0.25;  // in widths of the wall
constexpr double lead_out_share = 0.5;                       // of the wall's plastic, where it has closed already

double spacing_mm(const Path& outer) {
  return (outer.road().width_mm + outer.inner.back().road().width_mm) / 2;
}

/// A closed path's points from so many mm after its start to so many mm before its end.
std::vector<Vec2> without_ends(const Path& loop, double trim_mm, std::uint32_t& first_segment) {
  const std::size_t n = loop.points.size();
  const double all_mm = length_mm(loop);
  std::vector<Vec2> points;
  double way = 0;
  first_segment = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = loop.points[i], b = loop.points[(i + 1) % n];
    const double length = distance(a, b), end = way + length;
    if (end > trim_mm && way < all_mm - trim_mm) {
      if (points.empty()) {
        first_segment = std::uint32_t(i);
        points.push_back(way < trim_mm ? lerp(a, b, (trim_mm - way) / length) : a);
      }
      points.push_back(end > all_mm - trim_mm ? lerp(a, b, (all_mm - trim_mm - way) / length) : b);
    }
    way = end;
  }
  return points;
}

/// Appends the stretches of segments [first, first + count) of a path, which are segments [at, ...) of the joined one.
void append_stretches(Path& to, const Path& from, std::size_t first, std::size_t count, std::size_t at) {
  for (std::size_t s = 0; s < from.stretches.size(); ++s) {
    const std::size_t begin = std::max<std::size_t>(from.stretches[s].first_segment, first);
    const std::size_t end = s + 1 < from.stretches.size() ? from.stretches[s + 1].first_segment : from.segments();
    if (begin < std::min(end, first + count))
      to.stretches.push_back({std::uint32_t(begin - first + at), from.stretches[s].road});
  }
}

bool has_joint(const Path& path, bool anywhere) {
  if (joint_at(path, path.start())) return true;
  return anywhere && std::ranges::any_of(path.points, [&](Vec2 p) { return joint_at(path, p).has_value(); });
}

}  // namespace

std::optional<Joint> joint_at(const Path& path, Vec2 at_mm) {
  const Path& inner = path.inner.back();
  Joint joint;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < inner.points.size(); ++i) {
    const Vec2 q = nearest_on_segment(inner.points[i], inner.points[(i + 1) % inner.points.size()], at_mm);
    if (const double d = length_squared(q - at_mm); d < least) least = d, joint = {i, q};
  }
  const double reach = reach_in_spacings * spacing_mm(path);
  return least <= reach * reach ? std::optional(joint) : std::nullopt;
}

std::vector<Path> with_inner_loops(std::vector<Path> paths, bool anywhere) {
  // Loops of each extruder and island.
  std::map<std::pair<int, int>, std::vector<std::size_t>> islands;
  for (std::size_t i = 0; i < paths.size(); ++i)
    if (paths[i].island >= 0 && is_loop(paths[i])) islands[{paths[i].extruder, paths[i].island}].push_back(i);
  std::vector<char> is_inner(paths.size(), 0);
  for (const auto& [name, loops] : islands) {
    std::vector<Path> own;
    for (const std::size_t i : loops) own.push_back(paths[i]);
    const std::vector<int> outer = outer_loops(own);
    std::vector<int> longest(loops.size(), -1);
    for (std::size_t k = 0; k < loops.size(); ++k) {
      if (own[k].depth != 1 || !own[k].closed || outer[k] < 0) continue;
      int& best = longest[std::size_t(outer[k])];
      if (best < 0 || length_mm(own[k]) > length_mm(own[std::size_t(best)])) best = int(k);
    }
    for (std::size_t k = 0; k < loops.size(); ++k) {
      if (longest[k] < 0 || !own[k].closed) continue;
      const auto inner = std::size_t(longest[k]);
      own[k].inner = {own[inner]};
      const bool is_small = most_trimmed * length_mm(own[inner]) < spacing_mm(own[k]);
      if (is_small || !has_joint(own[k], anywhere)) continue;
      is_inner[loops[inner]] = 1;
      paths[loops[k]] = inner_aligned(std::move(own[k]));
    }
  }
  std::vector<Path> result;
  for (std::size_t i = 0; i < paths.size(); ++i)
    if (is_inner[i] == 0) result.push_back(std::move(paths[i]));
  return result;
}

Path inner_aligned(Path path) {
  if (path.inner.empty()) return path;
  if (const auto joint = joint_at(path, path.start())) {
    Path& inner = path.inner.back();
    inner = joint->at_mm == inner.points[joint->segment] ? started_at(std::move(inner), joint->segment)
                                                         : started_on(std::move(inner), joint->segment, joint->at_mm);
  }
  return path;
}

Path joined(Path path) {
  if (path.inner.empty()) return path;
  const Path inner = inner_aligned(path).inner.back();
  const double apart = distance(inner.start(), path.start());
  const double trim = std::min(half_gap * apart, most_trimmed * length_mm(inner));
  Path result = path;
  result.inner.clear();
  result.closed = false;
  result.depth = inner.depth;
  result.stretches.clear();
  std::uint32_t first = 0;
  result.points = without_ends(inner, trim, first);
  append_stretches(result, inner, first, result.points.size() - 1, 0);
  // The stroke outwards still has the inner loop's road.
  const Vec2 begin = result.points.front(), end = result.points.back();
  const std::size_t outer_from = result.points.size();
  result.inner_source = inner.source;
  result.outer_from = std::uint32_t(outer_from);
  result.points.insert(result.points.end(), path.points.begin(), path.points.end());
  result.points.push_back(path.start());
  append_stretches(result, path, 0, path.points.size(), outer_from);
  const double stroke = distance(end, path.start()), rest = 2 * trim - stroke, back = distance(path.start(), begin);
  if (rest > 0 && back > 0) {
    result.stretches.push_back({std::uint32_t(result.points.size() - 1), inner.stretches.front().road});
    result.points.push_back(lerp(path.start(), begin, std::min(1., rest / back)));
  }
  return result;
}

namespace {

/// Towards the plastic: outlines run counterclockwise, holes clockwise.
Vec2 inward(const Path& path, std::size_t segment, Vec2 at_mm) {
  const std::size_t n = path.points.size();
  const auto normal = [&](std::size_t i) {
    const Vec2 d = path.points[(i + 1) % n] - path.points[i];
    const double l = length(d);
    return l > 0 ? Vec2{-d.y, d.x} * (1 / l) : Vec2{};
  };
  Vec2 sum = normal(segment);
  if (at_mm == path.points[segment]) sum = sum + normal((segment + n - 1) % n);
  if (at_mm == path.points[(segment + 1) % n]) sum = sum + normal((segment + 1) % n);
  const double l = length(sum);
  return l > 0 ? sum * (1 / l) : Vec2{};
}

/// How far along the ray from p the segment from a to b is crossed; infinite where it is not.
double crossing_mm(Vec2 p, Vec2 direction, Vec2 a, Vec2 b) {
  const double side_a = cross(direction, a - p), side_b = cross(direction, b - p);
  if ((side_a < 0) == (side_b < 0)) return std::numeric_limits<double>::infinity();
  return dot(direction, lerp(a, b, side_a / (side_a - side_b)) - p);
}

}  // namespace

double lead_mm(const Path& path, std::size_t segment, Vec2 at_mm, std::span<const Path* const> loops) {
  constexpr double own_mm = 1e-3;  // nearer is the segment itself
  const Vec2 direction = inward(path, segment, at_mm);
  const double width_mm = path.road().width_mm;
  double room_mm = 2 * longest_lead * width_mm;
  for (const Path* loop : loops)
    for (std::size_t i = 0; i < loop->points.size(); ++i) {
      const double d = crossing_mm(at_mm, direction, loop->points[i], loop->points[(i + 1) % loop->points.size()]);
      if (d > own_mm) room_mm = std::min(room_mm, d);
    }
  return room_mm / 2 >= shortest_lead * width_mm ? room_mm / 2 : 0;
}

Path led_inside(Path path, double lead_mm) {
  if (lead_mm <= 0) return path;
  const Vec2 start = path.start(), inside = start + inward(path, 0, start) * lead_mm;
  Road lead = path.road();
  lead.role = Role::perimeter;
  path.closed = false;
  path.points.insert(path.points.begin(), inside);
  path.points.push_back(start);
  path.points.push_back(inside);
  for (Stretch& s : path.stretches) ++s.first_segment;
  path.stretches.insert(path.stretches.begin(), {0, lead});
  lead.area_mm2 *= lead_out_share;
  lead.width_mm *= lead_out_share;
  path.stretches.push_back({std::uint32_t(path.points.size() - 2), lead});
  return path;
}

}  // namespace cleancolor
