#include "audit/replay.hpp"

#include <algorithm>

#include "audit/follower.hpp"

namespace cleancolor {
namespace {

/// The target of each nozzle's heater when it first lays plastic; 0 where the file does not say.
std::vector<double> first_print_celsius(const GcodePrint& print, const Timeline& time) {
  const std::size_t count = time.used.size();
  std::vector<double> target(count), first(count);
  std::vector<char> printed(count);
  std::size_t e = 0;
  for (std::size_t i = 0; i < print.moves.size(); ++i) {
    for (; e < print.events.size() && print.events[e].before_move <= i; ++e) {
      const GcodeEvent& event = print.events[e];
      if (event.kind == GcodeEvent::Kind::target_temperature && event.tool < count && event.value >= 0)
        target[event.tool] = event.value;
    }
    const std::uint8_t n = print.moves[i].feeds;
    if (n >= count || printed[n] || !(time.pushed_mm3[i] > 0)) continue;
    printed[n] = 1;
    first[n] = target[n];
  }
  return first;
}

}  // namespace

struct Replay::State {
  State(const GcodePrint& print_, const AuditMachine& machine_, const Timeline& time_,
        const PrintedVisibility& visibility_, const std::vector<Scenario>& scenarios);

  const GcodePrint& print;
  const AuditMachine& machine;
  const Timeline& time;
  const PrintedVisibility& visibility;
  std::vector<Follower> followers;
  std::vector<NozzleUse> nozzles;
  std::vector<std::uint32_t> laid;  // by layer: laying drives so far
  int tool_changes = 0;
  bool started = false;
  int tool = -1;  // of the last move

  // The run of laying moves that is not over yet.
  bool runs = false;
  bool run_outer = false;  // its last move
  Vec2 run_end_mm;
  std::uint32_t run_layer = 0, run_move = 0;
  std::uint8_t run_nozzle = 0;

  int refilled = -1;  // the nozzle whose refill pass is not over yet

  void one(const Drive& drive, std::span<const Crossing> crossings, const LayerPlastic& plastic);
  void count(std::uint32_t layer, double Figures::* figure, double by) {
    for (Follower& f : followers) f.count(layer, figure, by);
  }
  void change_tool(const Drive& drive);
  void refill(const Drive& drive);
  void run(const Drive& drive, bool outer);
  void end_run();
  void zipper(Place where);
  void use(const Drive& drive);
};

Replay::State::State(const GcodePrint& print_, const AuditMachine& machine_, const Timeline& time_,
                     const PrintedVisibility& visibility_, const std::vector<Scenario>& scenarios)
    : print(print_),
      machine(machine_),
      time(time_),
      visibility(visibility_),
      nozzles(machine_.nozzles.size()),
      laid(print_.layers.size()) {
  for (const Scenario& s : scenarios) followers.emplace_back(s, print, machine, time);
}

Replay::Replay(const GcodePrint& print, const AuditMachine& machine, const Timeline& time,
               const PrintedVisibility& visibility, const std::vector<Scenario>& scenarios)
    : state_(std::make_unique<State>(print, machine, time, visibility, scenarios)) {}

Replay::~Replay() = default;

void Replay::follow(const Crossings& crossings, std::span<const std::shared_ptr<const LayerPlastic>> plastic) {
  for (std::size_t i = 0; i < crossings.drives.size(); ++i) {
    const Drive& d = crossings.drives[i];
    state_->one(d, crossings.of(i), *plastic[d.layer]);
  }
}

void Replay::State::one(const Drive& drive, std::span<const Crossing> crossings, const LayerPlastic& plastic) {
  if (drive.lays && !started) {
    started = true;
    const std::vector<double> celsius = first_print_celsius(print, time);
    for (Follower& f : followers) f.start(celsius);
  }
  const bool outer = drive.lays && plastic.outer[laid[drive.layer]++] != 0;
  if (drive.event == Drive::no_event) {
    change_tool(drive);
    refill(drive);
    use(drive);
  }
  run(drive, outer);
  for (Follower& f : followers) f.drive(drive, crossings, plastic.z_mm, outer, visibility);
}

void Replay::State::change_tool(const Drive& drive) {
  if (tool >= 0 && drive.tool != tool) {
    ++tool_changes;
    count(drive.layer, &Figures::tool_changes, 1);
  }
  tool = drive.tool;
}

void Replay::State::refill(const Drive& drive) {
  if (drive.role != Role::refill) {
    refilled = -1;
    return;
  }
  if (!drive.extrudes()) return;
  if (refilled != drive.feeds) count(drive.layer, &Figures::refills, 1);
  refilled = drive.feeds;
  count(drive.layer, &Figures::refill_volume, drive.pushed_mm3);
}

/// Starts and ends of extrusions.
void Replay::State::run(const Drive& drive, bool outer) {
  const bool breaks =
      drive.lays ? runs && run_nozzle != drive.feeds : drive.filament_mm < 0 || drive.moves_xy() || !drive.known;
  if (breaks) end_run();
  if (!drive.lays) return;
  const Vec2 offset = nozzle_offset_mm(machine, drive.feeds);
  if (!runs && outer)
    zipper({.nozzle = drive.feeds,
            .layer = drive.layer,
            .move = drive.move,
            .at_mm = drive.from_mm + offset,
            .end_mm = {}});
  runs = true;
  run_outer = outer;
  run_end_mm = drive.to_mm + offset;
  run_layer = drive.layer;
  run_move = drive.move;
  run_nozzle = drive.feeds;
}

void Replay::State::end_run() {
  if (runs && run_outer)
    zipper({.nozzle = run_nozzle, .layer = run_layer, .move = run_move, .at_mm = run_end_mm, .end_mm = {}});
  runs = false;
}

/// where: nozzle, layer, move and point.
void Replay::State::zipper(Place where) {
  where.kind = Place::Kind::zipper;
  where.over = where.nozzle;
  where.mm3 = 1;
  where.end_mm = where.at_mm;
  const double v = visibility.at({where.at_mm.x, where.at_mm.y, print.layers[where.layer].z_mm});
  where.visibility = float(v);
  count(where.layer, &Figures::zippers, 1);
  count(where.layer, &Figures::zippers_visible, v);
  for (Follower& f : followers) f.add(where);
}

/// Plastic that stays where it is pushed belongs to no road: it is thrown away.
void Replay::State::use(const Drive& drive) {
  if (!drive.extrudes() || drive.feeds >= nozzles.size()) return;
  NozzleUse& n = nozzles[drive.feeds];
  (drive.lays && !is_auxiliary(drive.role) ? n.part_mm3 : n.auxiliary_mm3) += drive.pushed_mm3;
}

Replay::Result Replay::finish() {
  State& s = *state_;
  s.end_run();
  Result result;
  for (Follower& f : s.followers) result.scenarios.push_back(f.finish());
  for (std::size_t n = 0; n < s.nozzles.size(); ++n) {
    NozzleUse& use = s.nozzles[n];
    const double area_mm2 = filament_area_mm2(s.machine, int(n));
    const double g_mm3 = s.machine.nozzles[n].filament_density_g_cm3 / 1000;
    use.part_filament_mm = use.part_mm3 / area_mm2;
    use.auxiliary_filament_mm = use.auxiliary_mm3 / area_mm2;
    use.part_g = use.part_mm3 * g_mm3;
    use.auxiliary_g = use.auxiliary_mm3 * g_mm3;
  }
  result.nozzles = std::move(s.nozzles);
  result.tool_changes = s.tool_changes;
  return result;
}

}  // namespace cleancolor
