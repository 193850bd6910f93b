#include "plan/ooze_forecast.hpp"

#include <algorithm>

namespace cleancolor {
namespace {

constexpr double step_mm = 0.25;

}  // namespace

HopTime hop_time(const Config& config, int extruder) {
  const Extruder& e = config.extruders[std::size_t(extruder)];
  const double back_mm_s = e.retract_speed_mm_s;
  const double forth_mm_s = e.deretract_speed_mm_s > 0 ? e.deretract_speed_mm_s : back_mm_s;
  const Vec3 axes = config.machine_max_acceleration_mm_s2;
  double acceleration = std::min(axes.x, axes.y);
  if (config.machine_max_acceleration_travel_mm_s2 > 0)
    acceleration = std::min(acceleration, config.machine_max_acceleration_travel_mm_s2);
  return {.speed_mm_s = config.travel_speed_mm_s,
          .acceleration_mm_s2 = std::max(acceleration, 1.),
          .retract_before_mm = e.retract_before_travel_mm,
          .retract_s = e.retract_length_mm / back_mm_s + e.retract_length_mm / forth_mm_s};
}

double visibility_ahead(const Path& path, std::size_t segment, Vec2 at_mm, const LayerMap& map) {
  constexpr int samples = 4;
  constexpr double spacing_mm = 0.4;
  double sum = 0;
  for (int k = 0; k < samples; ++k) {
    sum += map.at(at_mm).visibility / 255.;
    // On by one spacing; at the end of an open path it stays.
    double rest = spacing_mm;
    for (std::size_t step = 0; step <= path.points.size(); ++step) {
      const bool is_end = !path.closed && segment + 1 == path.points.size();
      if (is_end) break;
      const Vec2 to = path.points[(segment + 1) % path.points.size()];
      const double length = distance(at_mm, to);
      if (length > rest) {
        at_mm = lerp(at_mm, to, rest / length);
        break;
      }
      rest -= length;
      at_mm = to;
      segment = path.closed ? (segment + 1) % path.points.size() : segment + 1;
    }
  }
  return sum / samples;
}

Touches then(const Touches& a, const Touches& b) {
  Touches t = a.any ? a : b;
  t.left_end = a.left_end * b.left_end;
  if (!b.any) return t;
  t.left_last = a.left_end * b.left_last;
  if (!a.any) {
    t.left_first = a.left_end * b.left_first;
    t.later = a.left_end * b.later;
  } else {
    t.later += b.first_visibility * (a.left_last - a.left_end * b.left_first) + a.left_end * b.later;
  }
  return t;
}

double seconds_of(const Path& path) {
  RoadOf road(path);
  double sum = 0;
  for (const Path& inner : path.inner) sum += seconds_of(inner);
  for (std::size_t i = 0; i < path.segments(); ++i)
    sum += distance(path.points[i], path.points[(i + 1) % path.points.size()]) / road(i).speed_mm_s;
  return sum;
}

TouchTrack::TouchTrack(const Path& path, Vec2 offset_mm, int idle, const LayerMap& map, std::uint64_t walls,
                       const LaidSoFar& laid)
    : own_weight_(laid.weight) {
  for (const Path& inner : path.inner) {
    TouchTrack& track = inner_.emplace_back(inner, offset_mm, idle, map, walls, laid);
    track.own_weight_ = 0;  // the wall around it is still to come
  }
  RoadOf road(path);
  for (std::size_t i = 0; i < path.segments(); ++i) {
    const Vec2 a = path.points[i] + offset_mm, b = path.points[(i + 1) % path.points.size()] + offset_mm;
    const double length = distance(a, b), s_mm = 1 / road(i).speed_mm_s;
    begin_s_.push_back(all_s_);
    s_mm_.push_back(s_mm);
    const int steps = int(length / step_mm) + 1;
    for (int k = 0; k < steps; ++k) {
      const Vec2 p = lerp(a, b, (k + 0.5) / steps);
      const LayerMap::Cell cell = map.at(p);
      const bool smears = cell.visibility > 0 && cell.extruder != idle;
      const bool wipes = cell.wall != 0 && (walls >> std::min(cell.wall - 1, 63) & 1) != 0;
      if (!smears && !wipes) continue;
      Touch touch{.at_s = all_s_ + length * s_mm * (k + 0.5) / steps,
                  .visibility = smears ? cell.visibility / 255. : 0};
      if (smears && laid.walls != nullptr) {
        const LaidWalls::Cell by = laid.walls->at(p);
        if (by.path == laid.path) touch.laid_s = by.at_s;
        if (by.path >= 0 && by.path < laid.path) touch.visibility *= 1 + laid.weight;
      }
      touches_.push_back(touch);
    }
    all_s_ += length * s_mm;
  }
}

void TouchTrack::add(Touches& t, double left, double visibility) {
  if (!t.any) {
    t.any = true;
    t.first_visibility = visibility;
    t.left_first = left;
  } else {
    t.later += visibility * (t.left_last - left);
  }
  t.left_last = left;
}

Touches TouchTrack::forwards(const OozeModel& model, double from_s) const {
  Touches t;
  const auto first = std::ranges::lower_bound(touches_, from_s, {}, &Touch::at_s);
  const auto since = [&](double s) { return s < from_s ? s + all_s_ - from_s : s - from_s; };
  const auto meet = [&](const Touch& touch) {
    const double at_s = since(touch.at_s);
    add(t, model.left(at_s), counted(touch, touch.laid_s >= 0 && since(touch.laid_s) < at_s));
  };
  std::for_each(first, touches_.end(), meet);
  std::for_each(touches_.begin(), first, meet);
  t.left_end = model.left(all_s_);
  // Inner loops are begun at about the same share of their way.
  for (const TouchTrack& inner : inner_) t = then(inner.forwards(model, inner.all_s_ * (from_s / all_s_)), t);
  return t;
}

Touches TouchTrack::backwards(const OozeModel& model) const {
  Touches t;
  for (std::size_t i = touches_.size(); i-- > 0;) {
    const Touch& touch = touches_[i];
    add(t, model.left(all_s_ - touch.at_s), counted(touch, touch.laid_s > touch.at_s));
  }
  t.left_end = model.left(all_s_);
  return t;
}

}  // namespace cleancolor
