// audit/ooze.hpp
//
// Ooze: what leaves a nozzle that does not extrude, and what it then lacks.
//
// worst: V (1 - exp(-t / tau)) with the time t since the nozzle last printed; it depends on nothing else.
// model: an elastic part that the retraction takes back, and a slow one, both slower where the nozzle is cooler.
// Source: the figures of peers and their fits are in docs/audit.md.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace cleancolor {

/// Every number of one nozzle. Defaults of a scenario: worst_ooze(), model_ooze().
struct OozeParameters {
  double volume_mm3 = 2;      // V: that leaves in the end
  double time_s = 20;         // tau: after which 63 % of it have left
  double elastic_time_s = 0;  // K: pressure advance; the nozzle holds K x flow under pressure; 0: no elastic part
  double halving_c = 0;       // so many degrees cooler, half the ooze; 0: temperature does not matter
  double heating_c_s = 2;     // of the heater
  double cooling_c_s = 2;
  double touch_height_mm = std::numeric_limits<double>::infinity();  // a nozzle lifted by more (z-hop) touches nothing
};

OozeParameters worst_ooze();
OozeParameters model_ooze();

/// Variants of the definitions, for --sensitivity.
struct OozeRules {
  bool tireless = false;      // the clock restarts at each wipe or smear: ooze never tires
  bool printed_only = false;  // only plastic already printed can be touched
  bool own_empties = true;    // plastic of the nozzle's own colour takes its ooze
  double touch_mm = 0;        // > 0: a touch of s mm takes the share 1 - exp(-s / touch_mm); 0: all at once
};

/// One nozzle over time. Times are steps, never absolute, so that scenarios can have different waits.
class NozzleState {
 public:
  explicit NozzleState(const OozeParameters& parameters) : parameters_(parameters) {}

  /// The nozzle idles for so long.
  void idle(double seconds);

  /// Carried plastic is left somewhere: all of it, or what a touch of length_mm takes by the rules. Returns mm3.
  double leave(double length_mm, const OozeRules& rules);

  struct Pushed {
    double made_up_mm3 = 0;  // of what was pushed, missing from the road: a hole
    double carried_mm3 = 0;  // ooze that was still on the tip, mixed in
  };
  /// Plastic is pushed through the nozzle in so many seconds; prints: along a way, so the clock of idling starts anew.
  Pushed push(double mm3, double seconds, bool prints);

  /// The filament is drawn back (mm3 > 0) or pushed forward again (< 0).
  void retract(double mm3);

  void set_target(double celsius);
  /// Seconds that the heater needs to reach its target.
  double seconds_to_target() const;

  double carried_mm3() const { return carried_mm3_; }
  double missing_mm3() const { return missing_mm3_; }

 private:
  void warm(double seconds);
  double share_at_temperature() const;

  OozeParameters parameters_;
  double idle_s_ = 0;                                // since it last printed
  double carried_mm3_ = 0;                           // on the tip
  double missing_mm3_ = 0;                           // from the nozzle
  double slow_mm3_ = 0;                              // of the ooze that can leave slowly since it last printed
  double elastic_mm3_ = 0;                           // of the pressure left, at the moment it stopped
  double flow_mm3_s_ = 0;                            // while it last printed
  double celsius_ = 0, target_c_ = 0, print_c_ = 0;  // 0: not known yet
  bool started_ = false;                             // has printed before; a nozzle that never printed carries nothing
};

}  // namespace cleancolor
