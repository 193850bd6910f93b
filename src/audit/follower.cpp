#include "audit/follower.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace cleancolor {
namespace {

constexpr double purge_mm3 = 0.5;         // pushed in place: counts as printing
constexpr double least_wipe_mm3 = 1e-3;   // carried at its begin
constexpr double least_place_mm3 = 1e-3;  // worth a place

}  // namespace

Follower::Follower(const Scenario& scenario, const GcodePrint& print, const AuditMachine& machine, const Timeline& time)
    : scenario_(scenario), print_(print), machine_(machine), time_(time) {
  assert(!scenario.ooze.empty());
  const std::size_t count = machine.nozzles.size();
  for (std::size_t n = 0; n < count; ++n) {
    parameters_.push_back(scenario.ooze[std::min(n, scenario.ooze.size() - 1)]);
    nozzles_.emplace_back(parameters_.back());
  }
  wiping_.resize(count);
  pairs_.resize(count * count);
  result_.name = scenario.name;
  result_.layers.resize(print.layers.size());
}

void Follower::start(std::span<const double> celsius) {
  for (std::size_t n = 0; n < nozzles_.size(); ++n)
    if (time_.used[n]) nozzles_[n].start(celsius[n]);
}

/// Applies a heater's new target. Returns how long the print waits for it in this scenario.
double Follower::heater_wait_s(const Drive& drive) {
  const GcodeEvent& event = print_.events[drive.event];
  if (event.kind != GcodeEvent::Kind::target_temperature || event.tool >= nozzles_.size()) return 0;
  NozzleState& nozzle = nozzles_[event.tool];
  if (event.value >= 0) nozzle.set_target(event.value);
  return event.waits && parameters_[event.tool].halving_c > 0 ? nozzle.seconds_to_target() : 0;
}

void Follower::drive(const Drive& drive, std::span<const Crossing> crossings, double layer_z_mm, bool outer,
                     const PrintedVisibility& visibility) {
  double seconds = drive.duration_s;
  if (drive.event != Drive::no_event) seconds += heater_wait_s(drive);
  if (drive.filament_mm < 0 && drive.feeds < nozzles_.size())
    nozzles_[drive.feeds].retract(-drive.filament_mm * filament_area_mm2(machine_, drive.feeds));
  for (std::size_t n = 0; n < nozzles_.size(); ++n) {
    if (!time_.used[n]) continue;
    const auto begin = std::ranges::find_if(crossings, [&](const Crossing& c) { return c.nozzle == n; });
    const auto end = std::find_if(begin, crossings.end(), [&](const Crossing& c) { return c.nozzle != n; });
    if (drive.extrudes() && n == drive.feeds) {
      push(drive, outer, visibility);
      wiping_[n] = 0;
    } else if (begin == end || drive.z_mm > layer_z_mm + parameters_[n].touch_height_mm) {
      nozzles_[n].idle(seconds);
      if (drive.moves_xy() || !drive.known) wiping_[n] = 0;
    } else {
      pass(drive, int(n), {begin, end}, seconds);
    }
  }
}

void Follower::push(const Drive& drive, bool outer, const PrintedVisibility& visibility) {
  const bool prints = drive.lays || drive.pushed_mm3 > purge_mm3;
  const NozzleState::Pushed pushed = nozzles_[drive.feeds].push(drive.pushed_mm3, drive.duration_s, prints);
  if (pushed.made_up_mm3 <= 0 || !drive.lays || !outer) return;
  const double share = std::min(1., pushed.made_up_mm3 / drive.pushed_mm3);
  const Vec2 offset = nozzle_offset_mm(machine_, drive.feeds);
  const Vec2 from = drive.from_mm + offset, to = drive.to_mm + offset;
  const Vec2 middle = lerp(from, to, share / 2);
  const double v = visibility.at({middle.x, middle.y, print_.layers[drive.layer].z_mm});
  const double hole_mm3 = pushed.made_up_mm3 * v;
  layer_figures(drive.layer).hole_volume += hole_mm3;
  if (hole_mm3 < least_place_mm3) return;
  add({.kind = Place::Kind::hole,
       .nozzle = drive.feeds,
       .over = drive.feeds,
       .mm3 = float(hole_mm3),
       .visibility = float(v),
       .length_mm = float(share * distance(from, to)),
       .layer = drive.layer,
       .move = drive.move,
       .at_mm = from,
       .end_mm = lerp(from, to, share)});
}

void Follower::pass(const Drive& drive, int nozzle, std::span<const Crossing> crossings, double seconds) {
  NozzleState& state = nozzles_[std::size_t(nozzle)];
  float at = 0;
  for (const Crossing& c : crossings) {
    if (c.begin > at) {
      state.idle(seconds * double(c.begin - at));
      wiping_[std::size_t(nozzle)] = 0;
    }
    touch(drive, c, seconds * double(c.end - c.begin));
    at = c.end;
  }
  if (at < 1) {
    state.idle(seconds * double(1 - at));
    wiping_[std::size_t(nozzle)] = 0;
  }
  flush();
}

void Follower::touch(const Drive& drive, const Crossing& c, double seconds) {
  NozzleState& nozzle = nozzles_[c.nozzle];
  const OozeRules& rules = scenario_.rules;
  const bool auxiliary = c.what == Crossing::Over::auxiliary, visible = c.what == Crossing::Over::visible;
  const bool own = !auxiliary && c.over == c.nozzle;
  const bool wiping = wiping_[c.nozzle] != 0;
  wiping_[c.nozzle] = auxiliary;
  if ((rules.printed_only && !c.printed) || (own && !rules.own_empties)) return nozzle.idle(seconds);

  const double length_mm = double(c.end - c.begin) * distance(drive.from_mm, drive.to_mm);
  Figures& layer = layer_figures(drive.layer);
  const bool wipe = auxiliary && !wiping && nozzle.carried_mm3() > least_wipe_mm3;
  nozzle.idle(seconds);
  const double mm3 = nozzle.leave(length_mm, rules);
  const double v = visible ? double(c.visibility) : 0;
  if (auxiliary) {
    layer.wiped_volume += mm3;
    if (!wipe) return;
    layer.wipes += 1;
    return trace(drive, c, Place::Kind::wipe, mm3, mm3);
  }
  if (own) {
    layer.own_volume += mm3 * v;
    if (visible) trace(drive, c, Place::Kind::own, mm3, mm3 * v);
    return;
  }
  const bool print = drive.extrudes();
  for (Figures* f : {&layer, &pair_figures(c.nozzle, c.over)}) {
    if (visible) {
      (print ? f->smear_exposure_print : f->smear_exposure_travel) += length_mm;
      (print ? f->smear_exposure_print_visible : f->smear_exposure_travel_visible) += length_mm * v;
      (print ? f->smear_volume_print : f->smear_volume_travel) += mm3 * v;
    } else {
      (print ? f->inner_exposure_print : f->inner_exposure_travel) += length_mm;
    }
    (print ? f->inner_volume_print : f->inner_volume_travel) += mm3 * (1 - v);
  }
  if (visible) trace(drive, c, Place::Kind::smear, mm3, mm3 * v);
  trace(drive, c, Place::Kind::inner, mm3, mm3 * (1 - v));
}

void Follower::trace(const Drive& drive, const Crossing& c, Place::Kind kind, double mm3, double counted_mm3) {
  Trace& trace = traces_[std::size_t(kind)];
  if (trace.end >= 0 && (trace.end != c.begin || trace.place.over != c.over)) flush();
  const Vec2 offset = nozzle_offset_mm(machine_, c.nozzle);
  Place& p = trace.place;
  if (trace.end < 0)
    p = {.kind = kind,
         .nozzle = c.nozzle,
         .over = c.over,
         .travel = !drive.extrudes(),
         .layer = drive.layer,
         .move = drive.move,
         .at_mm = lerp(drive.from_mm, drive.to_mm, double(c.begin)) + offset,
         .end_mm = {}};
  p.end_mm = lerp(drive.from_mm, drive.to_mm, double(c.end)) + offset;
  p.mm3 += float(counted_mm3);
  trace.end = c.end;
  trace.left_mm3 += mm3;
  trace.seen_mm3 += mm3 * double(c.visibility);
}

/// What is worth it becomes a place.
void Follower::flush() {
  for (Trace& trace : traces_) {
    if (trace.end < 0) continue;
    Place& p = trace.place;
    p.length_mm = float(distance(p.at_mm, p.end_mm));
    p.visibility = trace.left_mm3 > 0 ? float(trace.seen_mm3 / trace.left_mm3) : 0;
    if (double(p.mm3) >= least_place_mm3) add(p);
    trace = {};
  }
}

ScenarioResult Follower::finish() {
  const int count = int(nozzles_.size());
  for (int nozzle = 0; nozzle < count; ++nozzle)
    for (int over = 0; over < count; ++over)
      if (nozzle != over) result_.pairs.push_back({nozzle, over, pair_figures(nozzle, over)});
  for (const Figures& layer : result_.layers) result_.total += layer;
  return std::move(result_);
}

}  // namespace cleancolor
