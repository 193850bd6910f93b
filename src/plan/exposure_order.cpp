#include "plan/exposure_order.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <random>

#include "plan/precedence.hpp"

namespace cleancolor {
namespace {

constexpr std::size_t most_hanging = 8;
constexpr double first_temperature_mm3 = 0.02, last_temperature_mm3 = 0.0005;
constexpr double most_visits = 400'000;  // steps x paths

/// A path as the search sees it, in both directions.
struct Item {
  std::array<Vec2, 2> start, end;
  std::array<std::array<Touches, most_hanging>, 2> touches;
  double seconds = 0;
  double start_visibility = 0;  // of outer walls; 0 elsewhere
  bool open = false;
  int row = -1;  // of ExposureRun::detours
};

struct State {
  Vec2 at_mm;
  int row = -1;  // of the island that it is in
  std::array<IdleState, most_hanging> idle;
  double smear_mm3 = 0, hole_mm3 = 0, seconds = 0;
};

class OrderSearch {
 public:
  OrderSearch(const ExposureRun& run, const LayerMap& map, const OozeModel& model, const OrderWeights& weights)
      : run_(run), model_(model), weights_(weights), count_(std::min(run.hanging.size(), most_hanging)) {
    begin_.at_mm = run.from_mm;
    for (std::size_t k = 0; k < count_; ++k) begin_.idle[k] = run.hanging[k].state;
    for (const Path& wall : run.walls) step(begin_, item(wall, map, run.standing), 0);
    begin_.smear_mm3 = begin_.hole_mm3 = begin_.seconds = 0;
    for (std::size_t i = 0; i < run.paths.size(); ++i) {
      items_.push_back(item(run.paths[i], map, run.own_walls));
      if (!run.detours.empty()) items_.back().row = run.island_row[i];
    }
    before_ = precedence(run.paths, run.external_first);
    order_.resize(items_.size());
    std::iota(order_.begin(), order_.end(), 0);
    turned_.resize(items_.size());
  }

  ExposureOrder best() {
    search();
    ExposureOrder result;
    result.order = order_;
    State state = begin_;
    for (const int i : order_) {
      result.at_start.emplace_back(state.idle.begin(), state.idle.begin() + std::ptrdiff_t(count_));
      step(state, items_[std::size_t(i)], turned_[std::size_t(i)]);
    }
    result.smear_mm3 = state.smear_mm3, result.hole_mm3 = state.hole_mm3, result.seconds = state.seconds;
    result.after = run_.hanging;
    for (std::size_t k = 0; k < count_; ++k) result.after[k].state = state.idle[k];
    return result;
  }

 private:
  Item item(const Path& path, const LayerMap& map, std::uint64_t walls) const {
    Item it{.start = {path.start(), path.end()}, .end = {path.end(), path.start()}, .touches = {}};
    it.open = !path.closed && !irons(path);
    it.seconds = seconds_of(path);
    if (begins_outer_wall(path)) it.start_visibility = visibility_ahead(path, 0, path.start(), map);
    for (std::size_t k = 0; k < count_; ++k) {
      const HangingNozzle& n = run_.hanging[k];
      const TouchTrack track(path, n.offset_mm, n.extruder, map, walls);
      it.touches[0][k] = track.forwards(model_);
      if (it.open) it.touches[1][k] = track.backwards(model_);
    }
    return it;
  }

  /// Goes to the path and prints it.
  void step(State& s, const Item& it, int direction) const {
    const auto d = std::size_t(direction);
    double way_mm = distance(s.at_mm, it.start[d]);
    if (s.row >= 0 && it.row >= 0) {
      const ExposureRun::Detour& detour = run_.detours[std::size_t(s.row)][std::size_t(it.row)];
      way_mm *= detour.factor;
      s.seconds += detour.extra_s;
    }
    const double hop_s = weights_.hop.seconds(way_mm);
    s.row = it.row;
    if (it.start_visibility > 0) s.hole_mm3 += model_.volume_mm3 * (1 - model_.left(hop_s)) * it.start_visibility;
    const double hop_left = model_.left(hop_s);
    for (std::size_t k = 0; k < count_; ++k) {
      IdleState& n = s.idle[k];
      n.carried_mm3 += model_.volume_mm3 * n.left * (1 - hop_left);
      n.left *= hop_left;
      s.smear_mm3 += it.touches[d][k].apply(n, model_);
    }
    s.seconds += hop_s + it.seconds;
    s.at_mm = it.end[d];
  }

  double cost(const State& s) const {
    return s.smear_mm3 + weights_.hole_weight * s.hole_mm3 + weights_.s_mm3 * s.seconds;
  }

  double cost_of_order() const {
    State s = begin_;
    for (const int i : order_) step(s, items_[std::size_t(i)], turned_[std::size_t(i)]);
    return cost(s);
  }

  /// Whether order_[from] can go to place `to`, the ones between closing up.
  bool can_move(std::size_t from, std::size_t to) const {
    const int moved = order_[from];
    const auto waits_for = [&](int i, int other) {
      const std::vector<int>& b = before_[std::size_t(i)];
      return std::ranges::find(b, other) != b.end();
    };
    for (std::size_t k = from + 1; k <= to; ++k)
      if (waits_for(order_[k], moved)) return false;
    for (std::size_t k = to; k < from; ++k)
      if (waits_for(moved, order_[k])) return false;
    return true;
  }

  void move(std::size_t from, std::size_t to) {
    const auto at = [&](std::size_t i) { return order_.begin() + std::ptrdiff_t(i); };
    if (from < to) {
      std::rotate(at(from), at(from) + 1, at(to) + 1);
    } else {
      std::rotate(at(to), at(from), at(from) + 1);
    }
  }

  void search() {
    const std::size_t n = items_.size();
    if (n == 0) return;
    const double steps = std::min(double(run_.steps_a_path) * double(n), most_visits / double(n));
    std::mt19937 random(run_.seed);
    const auto below = [&](std::size_t end) { return std::size_t(random() % end); };
    double now = cost_of_order(), best = now;
    std::vector<int> best_order = order_;
    std::vector<char> best_turned = turned_;
    for (int k = 0; k < int(steps); ++k) {
      const double share = k / steps;
      const double temperature = first_temperature_mm3 * std::pow(last_temperature_mm3 / first_temperature_mm3, share);
      const std::size_t from = below(n), to = below(n);
      const bool turns = from == to || random() % 4 == 0;
      const auto i = std::size_t(order_[from]);
      if (turns ? !items_[i].open : !can_move(from, to)) continue;
      if (turns) {
        turned_[i] = !turned_[i];
      } else {
        move(from, to);
      }
      const double tried = cost_of_order();
      const double chance = double(random()) / double(std::mt19937::max());
      if (tried <= now || chance < std::exp((now - tried) / temperature)) {
        now = tried;
        if (now < best) best = now, best_order = order_, best_turned = turned_;
      } else if (turns) {
        turned_[i] = !turned_[i];
      } else {
        move(to, from);
      }
    }
    order_ = std::move(best_order);
    turned_ = std::move(best_turned);
  }

  const ExposureRun& run_;
  const OozeModel& model_;
  const OrderWeights& weights_;
  std::size_t count_;  // of idle nozzles
  State begin_;
  std::vector<Item> items_;
  std::vector<std::vector<int>> before_;
  std::vector<int> order_;
  std::vector<char> turned_;  // by path
};

}  // namespace

ExposureOrder exposure_order(const ExposureRun& run, const LayerMap& map, const OozeModel& model,
                             const OrderWeights& weights) {
  return OrderSearch(run, map, model, weights).best();
}

}  // namespace cleancolor
