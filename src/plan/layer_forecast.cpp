#include "plan/layer_forecast.hpp"

#include <algorithm>

namespace cleancolor {
namespace {

constexpr double sample_mm = 0.25;
constexpr auto none_prints = std::size_t(-1);

}  // namespace

ForecastWalk::ForecastWalk(const TravelCost& cost, const OozeModel& model, const HopTime& hop)
    : cost_(&cost), model_(&model), hop_(hop), states_(cost.nozzles().size()), touches_(cost.nozzles().size()) {}

ForecastWalk::ForecastWalk(std::span<const Path> paths, const TravelCost& cost, const OozeModel& model,
                           const HopTime& hop)
    : ForecastWalk(cost, model, hop) {
  ForecastWalk before(cost, model, hop);
  for (const Path& path : paths) {
    if (path.extruder != paths.front().extruder) break;
    before.print(path);
  }
  states_ = before.states_;
}

void ForecastWalk::print(const Path& path, std::span<const Vec2> way) {
  std::ranges::fill(touches_, Touches{});
  arrived_mm3_.clear();
  const auto is_it = [&](const TravelCost::Nozzle& n) { return n.extruder == path.extruder; };
  const auto nozzle = std::size_t(std::ranges::find_if(cost_->nozzles(), is_it) - cost_->nozzles().begin());
  const Vec2 offset = cost_->nozzles()[nozzle].offset_mm;
  travel(way, path.start(), offset);
  begin(nozzle, path);
  RoadOf road(path);
  for (std::size_t i = 0; i < path.segments(); ++i) {
    const Vec2 a = path.points[i], b = path.points[(i + 1) % path.points.size()];
    go(a - offset, b - offset, distance(a, b) / road(i).speed_mm_s, nozzle);
  }
  if (path.road().role == Role::rampart) standing_ |= std::uint64_t(1) << std::min(walls_++, 63);
  carriage_ = path.end() - offset;
}

/// way, start: of the nozzle with that offset.
void ForecastWalk::travel(std::span<const Vec2> way, Vec2 start, Vec2 offset) {
  if (!carriage_) return;
  double way_mm = 0;
  Vec2 at = *carriage_ + offset;
  for (const Vec2 p : way) way_mm += distance(at, p), at = p;
  way_mm += distance(at, start);
  const double s_mm = hop_.seconds(way_mm) / std::max(way_mm, 1e-6);
  const auto to = [&](Vec2 p) {
    go(*carriage_, p, s_mm * distance(*carriage_, p), none_prints);
    carriage_ = p;
  };
  for (const Vec2 p : way) to(p - offset);
  to(start - offset);
}

/// All nozzles but the one at `printing` ooze. Positions are the carriage's.
void ForecastWalk::go(Vec2 from, Vec2 to, double seconds, std::size_t printing) {
  const int steps = int(distance(from, to) / sample_mm) + 1;
  const double left = model_->left(seconds / steps);
  for (int i = 0; i < steps; ++i) {
    const Vec2 p = lerp(from, to, (i + 0.5) / steps);
    for (std::size_t n = 0; n < states_.size(); ++n)
      if (n != printing) ooze(n, p + cost_->nozzles()[n].offset_mm, left);
  }
  result_.seconds += seconds;
}

/// The nozzle begins to print.
void ForecastWalk::begin(std::size_t nozzle, const Path& path) {
  if (begins_outer_wall(path))
    result_.hole_mm3 +=
        model_->volume_mm3 * (1 - states_[nozzle].left) * visibility_ahead(path, 0, path.start(), cost_->map());
  arrived_mm3_.clear();
  for (const IdleState& state : states_) arrived_mm3_.push_back(state.carried_mm3);
  touch(nozzle, 0);
  states_[nozzle] = {};
}

void ForecastWalk::ooze(std::size_t n, Vec2 at_mm, double left) {
  IdleState& state = states_[n];
  state.carried_mm3 += model_->volume_mm3 * state.left * (1 - left);
  state.left *= left;
  const LayerMap::Cell cell = cost_->map().at(at_mm);
  const bool smears = cell.visibility > 0 && cell.extruder != cost_->nozzles()[n].extruder;
  const bool wipes = cell.wall != 0 && (standing_ >> std::min(cell.wall - 1, 63) & 1) != 0;
  if (smears) result_.smear_mm3 += state.carried_mm3 * cell.visibility / 255.;
  if (!wipes && cell.extruder == LayerMap::air) return;
  touch(n, smears ? cell.visibility / 255. : 0);
}

/// It leaves what it carries.
void ForecastWalk::touch(std::size_t nozzle, double visibility) {
  Touches& t = touches_[nozzle];
  if (!t.first) t.first = visibility;
  const bool on_way = arrived_mm3_.empty();
  t.brought_mm3 += visibility * (on_way ? states_[nozzle].carried_mm3 : arrived_mm3_[nozzle]);
  if (!on_way) arrived_mm3_[nozzle] = 0;
  states_[nozzle].carried_mm3 = 0;
}

LayerForecast layer_forecast(std::span<const Path> paths, const TravelCost& cost, const OozeModel& model,
                             const HopTime& hop) {
  ForecastWalk walk(paths, cost, model, hop);
  for (const Path& path : paths) walk.print(path);
  return walk.result();
}

}  // namespace cleancolor
