// audit/ooze.hpp
//
// Ooze: what leaves a nozzle that does not extrude, and what it then lacks.
//
// A nozzle has plastic `carried` on its tip and `missing` in it. Both grow by its outflow while it idles. What is
// carried is left on what the tip touches, or mixed into the next stroke; what is missing is made up by the first
// plastic pushed.
//
// worst: from t1 to t2 seconds after it last printed V (exp(-t1 / tau) - exp(-t2 / tau)) flows out; nothing else
// counts. model: g (E exp(-t / K) / K + S exp(-t / tau) / tau) mm3/s, where
//   E  the pressure left when it stopped, K x flow, less what a retraction takes back of it,
//   S  V less what is missing,
//   g  2^((T - T_print) / halving): what a cooler nozzle does not give stays in it.
//
// A nozzle begins to ooze when the print begins (start), full, as a machine primes it; before, it only heats up.
// Source: Klipper's pressure advance for E and K; users' tables of restart lengths for the slow part; docs/audit.md.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace cleancolor {

/// Every number of one nozzle. Defaults of a scenario: worst_ooze(), model_ooze().
struct OozeParameters {
  double volume_mm3 = 2;          // V: that leaves in the end
  double time_s = 20;             // tau: after which 63 % of it have left
  bool missing_is_spent = false;  // S: what is missing already cannot flow out again
  double elastic_time_s = 0;      // K: pressure advance; the nozzle holds K x flow under pressure; 0: no elastic part
  double halving_c = 0;           // so many degrees cooler, half the ooze; 0: temperature does not matter
  double heating_c_s = 2;         // of the heater
  double cooling_c_s = 2;
  double touch_height_mm = std::numeric_limits<double>::infinity();  // a nozzle lifted by more (z-hop) touches nothing
};

/// V = 2 mm3, tau = 20 s: what the paper refills, and "re-appears after a few seconds on idle extruders".
OozeParameters worst_ooze();

/// V = 2 mm3 likewise; tau = 40 s: the middle of 20 to 60 s, for PLA and ABS. K = 0.05 s: pressure advance of direct
/// drives; Bowden tubes have 0.4 and more. Half the ooze for each 10 degrees: Arrhenius' law for melts of PLA and ABS.
/// Heaters of 2 degrees a second: what slicers assume. A tip lifted by 0.6 mm touches nothing: a drop of 0.1 mm3 hangs
/// so deep.
///
/// Holes of the model are more than those of worst where many strokes begin after a short way without retraction: each
/// of them first builds up the pressure again, for K x flow mm3 at most. That is the thin start of a seam.
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

  /// The print begins: it idles from here on. celsius: of its first print, so that standby is known as such; 0:
  /// unknown.
  void start(double celsius);

  /// The nozzle idles for so long.
  void idle(double seconds) { pending_s_ += seconds; }

  /// Carried plastic is left somewhere: all of it, or what a touch of length_mm takes by the rules. Returns mm3.
  double leave(double length_mm, const OozeRules& rules);

  struct Pushed {
    double made_up_mm3 = 0;  // of what was pushed, missing from the road: a hole
    double carried_mm3 = 0;  // ooze that was still on the tip, mixed in
  };
  /// Plastic is pushed through the nozzle in so many seconds; prints: along a way, or enough of it in place, so the
  /// clock of idling starts anew and what is carried goes with it.
  Pushed push(double mm3, double seconds, bool prints);

  /// The filament is drawn back by so much; what is pushed forward again counts in push().  Requires: mm3 >= 0.
  void retract(double mm3);

  void set_target(double celsius);
  /// Seconds that the heater needs up to its target; nothing waits for cooling.
  double seconds_to_target();

  double carried_mm3();
  double missing_mm3();

 private:
  void settle();
  double warm(double seconds);
  double flow_share(double celsius) const;
  double slow_reserve() const;

  OozeParameters parameters_;
  double pending_s_ = 0;                             // idled, and not yet counted
  double carried_mm3_ = 0;                           // on the tip
  double missing_mm3_ = 0;                           // from the nozzle
  double slow_mm3_ = 0;                              // that can still leave slowly
  double elastic_mm3_ = 0;                           // and by pressure
  double most_elastic_mm3_ = 0;                      // when it stopped
  double celsius_ = 0, target_c_ = 0, print_c_ = 0;  // 0: not known yet
  bool started_ = false;
};

}  // namespace cleancolor
