// plan/ooze_forecast.hpp
//
// Ooze forecast: what idle nozzles will smear while paths are printed in some order, told so fast that thousands of
// orders can be tried.
//
// A nozzle that printed last t seconds ago has let out V (1 - exp(-t / tau)). What hangs on it is left on the first
// visible foreign plastic that it touches, or on a wall of the rampart; nothing else empties it (a careful assumption:
// plans made so do well under others too). Beside one path the touches are known beforehand, so the path acts on a
// nozzle by five numbers, whatever came before.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "model/config.hpp"
#include "plan/cost.hpp"
#include "plan/laid_walls.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

struct OozeModel {
  double volume_mm3 = 2;
  double time_s = 20;

  double left(double seconds) const { return std::exp(-seconds / time_s); }  // share that is still to come
};

/// How long a travel takes, from standstill to standstill, with drawing back and pushing forward where it is long.
struct HopTime {
  double speed_mm_s = 150;
  double acceleration_mm_s2 = 1500;
  double retract_before_mm = 1;
  double retract_s = 0.04;  // both ways

  double seconds(double way_mm) const {
    const double full_mm = speed_mm_s * speed_mm_s / acceleration_mm_s2;  // from here on it reaches its speed
    const double moving = way_mm < full_mm ? 2 * std::sqrt(way_mm / acceleration_mm_s2)
                                           : way_mm / speed_mm_s + speed_mm_s / acceleration_mm_s2;
    return moving + (way_mm > retract_before_mm ? retract_s : 0);
  }
};

/// Of an extruder, by its speeds and lengths.
HopTime hop_time(const Config& config, int extruder);

/// One idle nozzle.
struct IdleState {
  double left = 1;         // share of the ooze still to come
  double carried_mm3 = 0;  // on the tip
};

/// What printing one path does to one idle nozzle.
struct Touches {
  bool any = false;
  double first_visibility = 0;  // of the first touch; 0: a wall
  double left_first = 1;        // OozeModel::left of the time from the start of the path to the first touch,
  double left_last = 1;         // to the last,
  double left_end = 1;          // and to the end
  double later = 0;             // sum over later touches of visibility x share that came out since the one before

  /// Prints the path: what is smeared, x visibility, mm3.
  double apply(IdleState& nozzle, const OozeModel& model) const {
    const double reserve = model.volume_mm3 * nozzle.left;
    double smeared = 0;
    if (any) {
      smeared = (nozzle.carried_mm3 + reserve * (1 - left_first)) * first_visibility + reserve * later;
      nozzle.carried_mm3 = reserve * (left_last - left_end);
    } else {
      nozzle.carried_mm3 += reserve * (1 - left_end);
    }
    nozzle.left *= left_end;
    return smeared;
  }
};

/// One after the other.
Touches then(const Touches& a, const Touches& b);

/// How plainly the first millimetres of a path from a place on one of its segments can be seen, in the mean: where
/// plastic is missing after a travel.
double visibility_ahead(const Path& path, std::size_t segment, Vec2 at_mm, const LayerMap& map);

/// Whether plastic that is missing after a travel is missing in an outer wall.
inline bool begins_outer_wall(const Path& path) {
  return path.depth == 0 && path.inner.empty();
}

/// The road of each segment of a path, segments ascending.
class RoadOf {
 public:
  explicit RoadOf(const Path& path) : path_(path) {}
  const Road& operator()(std::size_t segment) {
    while (next_ < path_.stretches.size() && path_.stretches[next_].first_segment <= segment) ++next_;
    return path_.stretches[next_ - 1].road;
  }

 private:
  const Path& path_;
  std::size_t next_ = 1;
};

/// How long a path takes with its inner loops, without accelerations.
double seconds_of(const Path& path);

/// What an idle nozzle touches beside a path, in time.
class TouchTrack {
 public:
  /// The nozzle hangs at `offset_mm` from the one that prints. walls: bit w: wall w of the map stands already.
  /// laid.path: this one, of which laid.walls knows as much as is given here.
  /// Cost: about 5 ns for each 0.25 mm.
  TouchTrack(const Path& path, Vec2 offset_mm, int idle, const LayerMap& map, std::uint64_t walls,
             const LaidSoFar& laid = {});

  /// The path walked as it is given, or from its other end; a closed one from so many seconds after its first point.
  Touches forwards(const OozeModel& model, double from_s = 0) const;
  Touches backwards(const OozeModel& model) const;

  /// Seconds from the first point of the path to a place on one of its segments.
  double seconds_at(const Path& path, std::size_t segment, Vec2 at_mm) const {
    return begin_s_[segment] + distance(path.points[segment], at_mm) * s_mm_[segment];
  }

 private:
  struct Touch {
    double at_s = 0, visibility = 0;
    double laid_s = -1;  // when the path itself lays what is touched; -1: it does not
  };
  double counted(const Touch& touch, bool is_laid) const { return touch.visibility * (is_laid ? 1 + own_weight_ : 1); }
  static void add(Touches& touches, double left, double visibility);

  std::vector<Touch> touches_;
  std::vector<double> begin_s_, s_mm_;  // of each segment
  double all_s_ = 0;
  double own_weight_ = 0;          // of the path's own wall, as LaidSoFar::weight
  std::vector<TouchTrack> inner_;  // of Path::inner
};

}  // namespace cleancolor
