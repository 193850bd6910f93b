#include "plan/layer_forecast.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace cleancolor {
namespace {

constexpr double step_mm = 0.25;

class Walk {
 public:
  Walk(const TravelCost& cost, const OozeModel& model, std::vector<IdleState> states)
      : cost_(cost), model_(model), states_(std::move(states)) {}

  /// In order, with the way between them.
  void print(std::span<const Path> paths, const HopTime& hop) {
    for (const Path& path : paths) {
      const auto is_it = [&](const TravelCost::Nozzle& n) { return n.extruder == path.extruder; };
      const auto nozzle = std::size_t(std::ranges::find_if(cost_.nozzles(), is_it) - cost_.nozzles().begin());
      const Vec2 offset = cost_.nozzles()[nozzle].offset_mm;
      travel(path, offset, hop);
      begin(nozzle, path);
      RoadOf road(path);
      for (std::size_t i = 0; i < path.segments(); ++i) {
        const Vec2 a = path.points[i], b = path.points[(i + 1) % path.points.size()];
        go(a - offset, b - offset, distance(a, b) / road(i).speed_mm_s, nozzle);
      }
      if (path.road().role == Role::rampart) standing_ |= std::uint64_t(1) << std::min(walls_++, 63);
      carriage_ = path.end() - offset;
    }
  }

  const LayerForecast& result() const { return result_; }
  const std::vector<IdleState>& states() const { return states_; }

 private:
  static constexpr auto nobody = std::size_t(-1);

  void travel(const Path& path, Vec2 offset, const HopTime& hop) {
    if (!carriage_) return;
    const double way_mm = travel_mm(*carriage_ + offset, path), s_mm = hop.seconds(way_mm) / std::max(way_mm, 1e-6);
    const auto to = [&](Vec2 p) {
      go(*carriage_, p, s_mm * distance(*carriage_, p), nobody);
      carriage_ = p;
    };
    for (const Vec2 p : path.travel) to(p - offset);
    to(path.start() - offset);
  }

  /// All nozzles but the one at `printing` ooze. Positions are the carriage's.
  void go(Vec2 from, Vec2 to, double seconds, std::size_t printing) {
    const int steps = int(distance(from, to) / step_mm) + 1;
    const double left = model_.left(seconds / steps);
    for (int i = 0; i < steps; ++i) {
      const Vec2 p = lerp(from, to, (i + 0.5) / steps);
      for (std::size_t n = 0; n < states_.size(); ++n)
        if (n != printing) ooze(n, p + cost_.nozzles()[n].offset_mm, left);
    }
    result_.seconds += seconds;
  }

  /// The nozzle begins to print.
  void begin(std::size_t nozzle, const Path& path) {
    if (begins_outer_wall(path))
      result_.hole_mm3 +=
          model_.volume_mm3 * (1 - states_[nozzle].left) * visibility_ahead(path, 0, path.start(), cost_.map());
    states_[nozzle] = {};
  }

  void ooze(std::size_t n, Vec2 at_mm, double left) {
    IdleState& state = states_[n];
    state.carried_mm3 += model_.volume_mm3 * state.left * (1 - left);
    state.left *= left;
    const LayerMap::Cell cell = cost_.map().at(at_mm);
    const bool smears = cell.visibility > 0 && cell.extruder != cost_.nozzles()[n].extruder;
    const bool wipes = cell.wall != 0 && (standing_ >> std::min(cell.wall - 1, 63) & 1) != 0;
    if (smears) result_.smear_mm3 += state.carried_mm3 * cell.visibility / 255.;
    if (wipes || cell.extruder != LayerMap::air) state.carried_mm3 = 0;
  }

  const TravelCost& cost_;
  const OozeModel& model_;
  std::vector<IdleState> states_;
  std::optional<Vec2> carriage_;
  std::uint64_t standing_ = 0;
  int walls_ = 0;
  LayerForecast result_;
};

}  // namespace

LayerForecast layer_forecast(std::span<const Path> paths, const TravelCost& cost, const OozeModel& model,
                             const HopTime& hop) {
  // Whoever begins a layer has ended the one below: what the others bring with them is what such a run leaves on them.
  const auto changes = [&](const Path& path) { return path.extruder != paths.front().extruder; };
  Walk before(cost, model, std::vector<IdleState>(cost.nozzles().size()));
  before.print({paths.begin(), std::ranges::find_if(paths, changes)}, hop);
  Walk walk(cost, model, before.states());
  walk.print(paths, hop);
  return walk.result();
}

}  // namespace cleancolor
