// replan/kept_ways.hpp
//
// Kept ways: between the roads of a file, written as the file has them.
//
//   recovered runs in the file's order  ->  leaving of one, layer or tool changes, way to the next
#pragma once

#include "model/config.hpp"
#include "replan/dialect_words.hpp"
#include "replan/emitter.hpp"
#include "replan/recovered.hpp"

namespace cleancolor {

class KeptWays {
 public:
  KeptWays(const RecoveredPrint& recovered, const DialectWords& words, const Config& config, Emitter& out)
      : recovered_(recovered), words_(words), config_(config), out_(out) {}

  /// Up to its height, on the way to its first run.
  void begin_layer(const RecoveredLayer& layer);

  /// To where the run begins.
  void go(const RecoveredRun& run);

  /// The way there is over: plastic comes.
  void begin_plastic();

  /// Its wipe, and what is passed before the tool or the layer changes.
  void leave(const RecoveredRun& run);

 private:
  void leave(const LeftWay& left, std::size_t fed);
  void change_tool(const RecoveredRun& run);
  void lift(const RecoveredRun& run);
  void lift_for_change();
  void stop_at(const RecoveredRun& run, std::size_t place);
  bool feeds(const RecoveredRun& run, std::size_t place) const;
  void feed(const RecoveredRun& run);
  const Extruder& extruder() const { return config_.extruders[std::size_t(out_.tool())]; }

  const RecoveredPrint& recovered_;
  const DialectWords& words_;
  const Config& config_;
  Emitter& out_;
  std::size_t fed_ = 0;    // moves of filament on the way to the next run
  bool has_left_ = false;  // a run
};

}  // namespace cleancolor
