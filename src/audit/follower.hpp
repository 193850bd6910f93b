// audit/follower.hpp
//
// Follower: all nozzles of one scenario through the print; part of replay.hpp.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "audit/audit.hpp"
#include "audit/crossings.hpp"
#include "audit/ooze.hpp"

namespace cleancolor {

class Follower {
 public:
  Follower(const Scenario& scenario, const GcodePrint& print, const AuditMachine& machine, const Timeline& time);

  /// The first plastic of the print is about to be laid. celsius: of each nozzle when it first prints; 0: unknown.
  void start(std::span<const double> celsius);

  /// All nozzles over one drive; outer: it lays an outer wall.
  void drive(const Drive& drive, std::span<const Crossing> crossings, double layer_z_mm, bool outer,
             const PrintedVisibility& visibility);

  /// Something that is the same in all scenarios.
  void count(std::uint32_t layer, double Figures::* figure, double by) { layer_figures(layer).*figure += by; }
  void add(const Place& place) { result_.places.push_back(place); }

  ScenarioResult finish();

 private:
  /// What one tip leaves on its way along one drive, joined while it lies without a gap over plastic of one kind.
  struct Trace {
    Place place;
    float end = -1;       // share of the drive; < 0: nothing yet
    double left_mm3 = 0;  // whatever its visibility
    double seen_mm3 = 0;  // and times v
  };

  double heater_wait_s(const Drive& drive);
  void push(const Drive& drive, bool outer, const PrintedVisibility& visibility);
  void pass(const Drive& drive, int nozzle, std::span<const Crossing> crossings, double seconds);
  void touch(const Drive& drive, const Crossing& crossing, double seconds);
  void trace(const Drive& drive, const Crossing& crossing, Place::Kind kind, double mm3, double counted_mm3);
  void flush();
  Figures& layer_figures(std::uint32_t layer) { return result_.layers[layer]; }
  Figures& pair_figures(int nozzle, int over) {
    return pairs_[std::size_t(nozzle) * nozzles_.size() + std::size_t(over)];
  }

  const Scenario& scenario_;
  const GcodePrint& print_;
  const AuditMachine& machine_;
  const Timeline& time_;
  std::vector<NozzleState> nozzles_;
  std::vector<OozeParameters> parameters_;  // of each
  std::vector<char> wiping_;                // of each: its last piece lay over auxiliary plastic, up to now
  std::vector<Figures> pairs_;              // nozzle x over
  std::array<Trace, 5> traces_;             // by Place::Kind
  ScenarioResult result_;
};

}  // namespace cleancolor
