#include "replan/kept_print.hpp"

#include <algorithm>
#include <cmath>

#include "replan/dialect_words.hpp"
#include "replan/emitter.hpp"
#include "replan/filament_book.hpp"

namespace cleancolor {
namespace {

bool rises_by_itself(const RecoveredRun& run) {
  return !run.spiral.empty() || !run.way_z_um.empty();
}

class KeptPrint {
 public:
  KeptPrint(const RecoveredPrint& recovered, const GcodePrint& print, const Config& config, const std::string& header)
      : recovered_(recovered), words_(*words_of(print)), config_(config), out_(recovered, print, config, header) {}

  std::string text() && {
    for (const RecoveredLayer& layer : recovered_.layers) {
      begin_layer(layer);
      for (const RecoveredRun& run : layer.runs) {
        go(run);
        print(run);
        leave(run);
      }
      out_.end_layer();
    }
    if (out_.tool() != recovered_.end_tool) {
      lift_for_change();
      out_.change_tool(recovered_.end_tool);
      if (recovered_.prints_after_end) begin_plastic();
    }
    return out_.finish();
  }

 private:
  /// Up to its height, on the way to its first run.
  void begin_layer(const RecoveredLayer& layer) {
    out_.begin_layer(layer.header);
    const RecoveredRun& first = layer.runs.front();
    std::size_t fed = 0;
    for (const std::vector<FilamentMove>& moves = layer.leaving.filament;
         fed < layer.fed_low && fed < moves.size() && moves[fed].after == 0; ++fed)
      out_.feed(moves[fed].by_e5);
    if (first.tool == out_.tool())
      while (feeds(first, 0) && first.way_filament[fed_].by_e5 < 0) feed(first);
    if (rises_by_itself(first)) {
      out_.take_z(layer.z_mm);
    } else {
      if (first.drawn_back) lift(first);
      out_.set_z(layer.z_mm);
    }
    leave(layer.leaving, fed);
  }

  /// To where the run begins.
  void go(const RecoveredRun& run) {
    if (run.fixed && !run.fixed->lays) lift_for_change();
    if (run.tool != out_.tool()) change_tool(run);
    if (recovered_.drives_otherwise && !run.way.empty()) out_.set(of_moving(recovered_.states[run.way_state]));
    for (std::size_t i = 0; i <= run.way.size(); ++i) {
      stop_at(run, i);
      const FilePoint to = i < run.way.size() ? run.way[i] : run.from;
      run.way_z_um.empty() ? out_.travel(to) : out_.travel(to, run.way_z_um[std::min(i, run.way_z_um.size() - 1)]);
    }
    stop_at(run, run.way.size() + 1);
    fed_ = 0;
  }

  /// Nothing is drawn back any more, or less than files round to.
  void begin_plastic() {
    out_.lower();
    if (out_.drawn_back_e5() > filament_rounding_e5) out_.push_forward();
    out_.take_drawn_back(0);
  }

  /// Its wipe, and what is passed before the tool or the layer changes.
  void leave(const RecoveredRun& run) {
    if (!run.wipe.empty()) {
      for (const FilePoint p : run.wipe_from) out_.travel(p);
      out_.draw_back(out_.drawn_back_e5() + run.back_before_wipe_e5);
      out_.wipe(run.wipe);
    }
    leave(run.leaving, 0);
    has_left_ = true;
  }

  /// fed: so much of its filament was moved already.
  void leave(const LeftWay& left, std::size_t fed) {
    for (std::size_t i = 0; i <= left.places.size(); ++i) {
      for (; fed < left.filament.size() && left.filament[fed].after == i; ++fed) out_.feed(left.filament[fed].by_e5);
      if (i < left.places.size()) out_.travel(left.places[i]);
    }
  }

  void change_tool(const RecoveredRun& run) {
    if (run.spiral.empty()) lift_for_change();
    out_.rise(run.spiral);
    out_.change_tool(run.tool);
    if (!words_.pushes_at_change || !feeds(run, 0)) return;
    while (feeds(run, 0) && run.way_filament[fed_].by_e5 > 0) feed(run);
    out_.lower();
  }

  /// Before another tool is taken.
  void lift_for_change() {
    if (!has_left_) out_.draw_back(e5_of(extruder().retract_length_toolchange_mm));
    if (const double by = std::max(extruder().retract_lift_mm, recovered_.change_lift_mm); by > 0) out_.lift(by);
  }

  void lift(const RecoveredRun& run) {
    if (run.lifted && !rises_by_itself(run) && extruder().retract_lift_mm > 0) out_.lift(extruder().retract_lift_mm);
    if (!out_.is_lifted()) out_.rise(run.spiral);
  }

  /// What is done after so many places of the way.
  void stop_at(const RecoveredRun& run, std::size_t place) {
    const bool lifts = run.drawn_back && place == run.back_after;
    if (lifts && !(feeds(run, place) && run.way_filament[fed_].by_e5 < 0)) lift(run);
    while (feeds(run, place)) {
      const bool draws = run.way_filament[fed_].by_e5 < 0;
      if (!draws && (out_.is_lifted() || place > run.way.size())) out_.lower();
      feed(run);
      if (draws && lifts) lift(run);
    }
  }

  /// Whether filament is moved next there.
  bool feeds(const RecoveredRun& run, std::size_t place) const {
    return fed_ < run.way_filament.size() && run.way_filament[fed_].after == place;
  }

  void feed(const RecoveredRun& run) { out_.feed(run.way_filament[fed_++].by_e5); }

  /// With the comments before it.
  void print(const RecoveredRun& run) {
    out_.lines(run.notes);
    if (run.fixed && !run.fixed->lays) return out_.fixed(*run.fixed);
    begin_plastic();
    if (run.fixed) {
      out_.set_known(run.fixed->state);
      return out_.fixed(*run.fixed);
    }
    for (const RunRoad& road : run.roads) {
      out_.set_known(road.state);
      out_.road(road.to, road.filament_e5 - road.at_end_e5, road.feed_mm_min, road.arc);
      out_.road(road.to, road.at_end_e5, road.feed_mm_min);
    }
  }

  const Extruder& extruder() const { return config_.extruders[std::size_t(out_.tool())]; }

  const RecoveredPrint& recovered_;
  const DialectWords& words_;
  const Config& config_;
  Emitter out_;
  std::size_t fed_ = 0;    // moves of filament on the way to the next run
  bool has_left_ = false;  // a run
};

}  // namespace

std::string written_as_in_file(const RecoveredPrint& recovered, const GcodePrint& print, const Config& config,
                               const std::string& header) {
  return KeptPrint(recovered, print, config, header).text();
}

}  // namespace cleancolor
