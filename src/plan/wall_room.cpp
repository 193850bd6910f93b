#include "plan/wall_room.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace cleancolor {
namespace {

constexpr double on_wall_mm2 = 0.06;  // of plastic beside the wall's own that sticks to it
constexpr double widest = 2;          // road, in widths of the wall's
constexpr double check_step_mm = 0.5;
constexpr double least_share = 0.5;   // of the room that must be left
constexpr double least_cosine = 0.7;  // of the angle between the way and the wall

}  // namespace

/// A short piece of a way.
struct WallRoom::Step {
  std::size_t segment = 0;  // of the way
  Vec2 begin_mm, end_mm;
  std::optional<Place> place;  // beside which its middle lies; nothing: it cannot be used
};

void WallRoom::stand(const Path& wall) {
  Wall w{.path = &wall, .begin_mm = {}, .laid_mm3 = {}};
  double sum = 0;
  for (std::size_t i = 0; i < wall.segments(); ++i) {
    w.begin_mm.push_back(sum);
    sum += distance(wall.points[i], wall.points[(i + 1) % wall.points.size()]);
  }
  w.laid_mm3.assign(std::size_t(sum) + 1, 0);
  walls_.push_back(std::move(w));
}

std::optional<WallRoom::Place> WallRoom::nearest(Vec2 p) const {
  std::optional<Place> best;
  double least = gap_mm_ * gap_mm_ / 4;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const Path& path = *walls_[w].path;
    for (std::size_t i = 0; i < path.segments(); ++i) {
      const Vec2 a = path.points[i], b = path.points[(i + 1) % path.points.size()];
      const Vec2 q = nearest_on_segment(a, b, p);
      if (length_squared(q - p) >= least || a == b) continue;
      least = length_squared(q - p);
      best = {.wall = w,
              .along_mm = walls_[w].begin_mm[i] + distance(a, q),
              .distance_mm = std::sqrt(least),
              .direction = (b - a) * (1 / distance(a, b))};
    }
  }
  return best;
}

/// Of all passes together on a mm of wall.
double WallRoom::area_mm2(const Place& place) const {
  const Road& road = walls_[place.wall].path->road();
  if (place.distance_mm < road.width_mm) return on_wall_mm2;
  return road.height_mm * std::min(widest * road.width_mm, std::max(0., gap_mm_ - road.width_mm) / 2);
}

bool WallRoom::is_clear(Vec2 p, double by_mm) const {
  if (map_.at(p).extruder != LayerMap::air) return false;
  constexpr int directions = 12;
  for (int k = 0; k < directions; ++k) {
    const double angle = 2 * std::numbers::pi * k / directions;
    for (const double r : {0.5 * by_mm, by_mm})
      if (map_.at(p + Vec2{std::cos(angle), std::sin(angle)} * r).extruder != LayerMap::air) return false;
  }
  return true;
}

std::vector<WallRoom::Step> WallRoom::steps(std::span<const Vec2> way_mm) const {
  std::vector<Step> result;
  for (std::size_t i = 0; i + 1 < way_mm.size(); ++i) {
    const double length = distance(way_mm[i], way_mm[i + 1]);
    if (length < 1e-9) continue;
    const int count = int(std::ceil(length / check_step_mm));
    for (int k = 0; k < count; ++k) {
      Step step{.segment = i,
                .begin_mm = lerp(way_mm[i], way_mm[i + 1], double(k) / count),
                .end_mm = lerp(way_mm[i], way_mm[i + 1], double(k + 1) / count),
                .place = {}};
      step.place = nearest(lerp(step.begin_mm, step.end_mm, 0.5));
      if (step.place && !is_usable(step)) step.place.reset();
      result.push_back(step);
    }
  }
  return result;
}

bool WallRoom::is_usable(const Step& step) const {
  const Place& place = *step.place;
  const Vec2 along = step.end_mm - step.begin_mm;
  if (std::abs(dot(along, place.direction)) < least_cosine * length(along)) return false;
  const Wall& wall = walls_[place.wall];
  const double all = area_mm2(place);
  const std::size_t stretch = std::min(std::size_t(place.along_mm), wall.laid_mm3.size() - 1);
  if (all - wall.laid_mm3[stretch] < least_share * all) return false;
  const double clear_mm = widest * wall.path->road().width_mm;
  return is_clear(step.begin_mm, clear_mm) && is_clear(step.end_mm, clear_mm);
}

WallRoom::Pass WallRoom::pass(std::span<const Vec2> way_mm, std::span<const Step> steps) const {
  const Step &first = steps.front(), &last = steps.back();
  Pass pass;
  pass.wall = walls_[first.place->wall].path->road();
  const auto pass_by = [](std::vector<Vec2>& points, Vec2 p, Vec2 end) {
    if (distance(p, end) > 1e-9) points.push_back(p);
  };
  for (std::size_t i = 1; i <= first.segment; ++i) pass_by(pass.before_mm, way_mm[i], first.begin_mm);
  pass.points_mm.push_back(first.begin_mm);
  for (std::size_t i = first.segment + 1; i <= last.segment; ++i)
    pass_by(pass.points_mm, way_mm[i], pass.points_mm.back());
  pass.points_mm.push_back(last.end_mm);
  for (std::size_t i = last.segment + 1; i + 1 < way_mm.size(); ++i) pass_by(pass.after_mm, way_mm[i], last.end_mm);
  // The area of road that no mm of wall has too little room for.
  std::map<std::pair<std::size_t, std::size_t>, double> length_mm;
  pass.most_area_mm2 = std::numeric_limits<double>::infinity();
  for (const Step& step : steps) {
    const double length = distance(step.begin_mm, step.end_mm);
    pass.length_mm += length;
    pass.most_area_mm2 = std::min(pass.most_area_mm2, area_mm2(*step.place));
    const std::size_t wall = step.place->wall;
    // A step that runs on over the end of its mm takes from both.
    const double from = std::clamp(step.place->along_mm - length / 2, 0., double(size_mm(wall)));
    const double to = std::clamp(step.place->along_mm + length / 2, 0., double(size_mm(wall)));
    const auto mm = std::min(std::size_t(from), size_mm(wall) - 1), next = std::min(mm + 1, size_mm(wall) - 1);
    const double here = to > from ? (std::min(to, double(mm + 1)) - from) / (to - from) : 1;
    length_mm[{wall, mm}] += here * length;
    length_mm[{wall, next}] += (1 - here) * length;
  }
  for (const Step& step : steps) {
    const std::size_t wall = step.place->wall;
    const double all = area_mm2(*step.place);
    for (const int by : {-1, 0, 1}) {
      const auto mm = std::ptrdiff_t(step.place->along_mm) + by;
      const auto found = mm < 0 ? length_mm.end() : length_mm.find({wall, std::size_t(mm)});
      if (found == length_mm.end() || found->second <= 1e-9) continue;
      const double room_mm3 = std::max(0., all - laid_mm3(wall, std::size_t(mm)));
      pass.most_area_mm2 = std::min(pass.most_area_mm2, room_mm3 / found->second);
    }
  }
  for (const auto& [place, length] : length_mm) pass.uses.push_back({place.first, place.second, length});
  return pass;
}

std::optional<WallRoom::Pass> WallRoom::longest_pass(std::span<const Vec2> way_mm, double shortest_mm) const {
  const std::vector<Step> all = steps(way_mm);
  std::size_t best_first = 0, best_last = 0;
  double longest = 0;
  for (std::size_t first = 0; first < all.size();) {
    std::size_t last = first;
    double length = 0;
    for (; last < all.size() && all[last].place; ++last) length += distance(all[last].begin_mm, all[last].end_mm);
    if (length > longest + 1e-9) longest = length, best_first = first, best_last = last;
    first = last + 1;
  }
  if (longest < shortest_mm - 1e-9 || best_last == best_first) return std::nullopt;
  return pass(way_mm, std::span(all).subspan(best_first, best_last - best_first));
}

void WallRoom::lay(const Pass& pass, double area_mm2) {
  for (const Pass::Use& use : pass.uses) walls_[use.wall].laid_mm3[use.mm] += area_mm2 * use.length_mm;
}

}  // namespace cleancolor
