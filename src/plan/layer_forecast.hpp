// plan/layer_forecast.hpp
//
// Layer forecast: what the nozzles will spoil while a planned layer is printed, roads and travel alike.
//
//   paths with their travel, what lies where  ->  smears, holes
//
// A plain walk in small steps. Other than in ooze_forecast.hpp any plastic empties a nozzle that passes over it, as in
// the audit's definitions. It serves to compare plans of the same layers.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "plan/ooze_forecast.hpp"

namespace cleancolor {

struct LayerForecast {
  double smear_mm3 = 0, hole_mm3 = 0;  // x visibility
  double seconds = 0;                  // without accelerations of roads
};

/// paths: begun, with Path::travel, as they are printed; walls among them in the order of the map's.
/// Cost: about 0.2 ms for a layer of 1 m and two nozzles.
LayerForecast layer_forecast(std::span<const Path> paths, const TravelCost& cost, const OozeModel& model,
                             const HopTime& hop);

/// The same path by path. A copy goes on from where it was taken, so that ways from there can be compared.
/// Requires: cost and model outlive it.
class ForecastWalk {
 public:
  /// At the beginning of the layer. Whoever begins a layer has ended the one below: what the other nozzles bring with
  /// them is what such a run leaves on them.
  ForecastWalk(std::span<const Path> paths, const TravelCost& cost, const OozeModel& model, const HopTime& hop);

  void print(const Path& path) { print(path, path.travel); }
  /// By way of other places than Path::travel, likewise in the frame of its nozzle.
  void print(const Path& path, std::span<const Vec2> travel);

  const LayerForecast& result() const { return result_; }
  /// Nozzles are those of the cost.
  const std::vector<IdleState>& states() const { return states_; }
  const std::optional<Vec2>& carriage_mm() const { return carriage_; }

  /// What one nozzle did on the last way and path printed.
  struct Touches {
    /// How visible the foreign plastic was on which it first left what it carried; 0: it left it elsewhere, as where it
    /// began to print itself; nothing: nowhere.
    std::optional<double> first;
    double brought_mm3 = 0;  // x visibility, smeared on the way, and of what it carried there beside the path
  };
  const std::vector<Touches>& touches() const { return touches_; }

 private:
  ForecastWalk(const TravelCost& cost, const OozeModel& model, const HopTime& hop);
  void travel(std::span<const Vec2> way, Vec2 start, Vec2 offset);
  void go(Vec2 from, Vec2 to, double seconds, std::size_t printing);
  void begin(std::size_t nozzle, const Path& path);
  void ooze(std::size_t nozzle, Vec2 at_mm, double left);
  void touch(std::size_t nozzle, double visibility);

  const TravelCost* cost_;
  const OozeModel* model_;
  HopTime hop_;
  std::vector<IdleState> states_;
  std::vector<Touches> touches_;
  std::vector<double> arrived_mm3_;  // with each nozzle where the last way ended, still on it; empty on the way
  std::optional<Vec2> carriage_;
  std::uint64_t standing_ = 0;  // walls of the map, by bit
  int walls_ = 0;
  LayerForecast result_;
};

}  // namespace cleancolor
