#include "audit/ooze.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace cleancolor;

namespace {

const OozeRules rules;

NozzleState started(const OozeParameters& parameters) {
  NozzleState nozzle(parameters);
  nozzle.start(0);
  return nozzle;
}

double worst_mm3(double seconds) {
  return 2 * (1 - std::exp(-seconds / 20));
}

/// The model without pressure and temperature.
OozeParameters slow_only() {
  return {.volume_mm3 = 2, .time_s = 40, .missing_is_spent = true};
}

}  // namespace

TEST(Ooze, BeforeThePrintNothingFlows) {
  NozzleState nozzle(worst_ooze());
  nozzle.idle(1000);
  EXPECT_EQ(nozzle.carried_mm3(), 0);
  EXPECT_EQ(nozzle.missing_mm3(), 0);
}

TEST(Ooze, WorstIsAnExponentialWhateverTheSteps) {
  for (const int steps : {1, 7, 1000}) {
    SCOPED_TRACE(steps);
    NozzleState nozzle = started(worst_ooze());
    for (int i = 0; i < steps; ++i) {
      nozzle.idle(30.0 / steps);
      nozzle.carried_mm3();  // also where it is asked in between
    }
    EXPECT_NEAR(nozzle.carried_mm3(), worst_mm3(30), 1e-9);
    EXPECT_NEAR(nozzle.missing_mm3(), worst_mm3(30), 1e-9);
  }
}

TEST(Ooze, ATouchTakesAllAndTheClockGoesOn) {
  NozzleState nozzle = started(worst_ooze());
  nozzle.idle(10);
  EXPECT_NEAR(nozzle.leave(0.1, rules), worst_mm3(10), 1e-9);
  EXPECT_EQ(nozzle.carried_mm3(), 0);
  nozzle.idle(10);
  EXPECT_NEAR(nozzle.leave(0.1, rules), worst_mm3(20) - worst_mm3(10), 1e-9);
  EXPECT_NEAR(nozzle.missing_mm3(), worst_mm3(20), 1e-9) << "what is left outside is still missing inside";
}

TEST(Ooze, TirelessOozeStartsAnewAtEachTouch) {
  NozzleState nozzle = started(worst_ooze());
  nozzle.idle(10);
  nozzle.leave(0.1, {.tireless = true});
  nozzle.idle(10);
  EXPECT_NEAR(nozzle.leave(0.1, {.tireless = true}), worst_mm3(10), 1e-9);
}

TEST(Ooze, AShortTouchCanTakeAPart) {
  NozzleState nozzle = started(worst_ooze());
  nozzle.idle(10);
  EXPECT_NEAR(nozzle.leave(1, {.touch_mm = 2}), worst_mm3(10) * (1 - std::exp(-0.5)), 1e-9);
  EXPECT_NEAR(nozzle.carried_mm3(), worst_mm3(10) * std::exp(-0.5), 1e-9);
}

TEST(Ooze, PrintingMakesUpWhatIsMissingTakesAlongWhatIsCarriedAndRestartsTheClock) {
  NozzleState nozzle = started(worst_ooze());
  nozzle.idle(20);
  const double oozed = worst_mm3(20);
  const NozzleState::Pushed first = nozzle.push(0.5, 1, true);
  EXPECT_NEAR(first.made_up_mm3, 0.5, 1e-9);
  EXPECT_NEAR(first.carried_mm3, oozed, 1e-9);
  EXPECT_NEAR(nozzle.missing_mm3(), oozed - 0.5, 1e-9);
  EXPECT_NEAR(nozzle.push(5, 1, true).made_up_mm3, oozed - 0.5, 1e-9);
  EXPECT_EQ(nozzle.push(5, 1, true).made_up_mm3, 0);
  nozzle.idle(20);
  EXPECT_NEAR(nozzle.carried_mm3(), oozed, 1e-9);
}

TEST(Ooze, ALittlePushedInPlaceMakesUpButDoesNotRestartTheClock) {
  NozzleState nozzle = started(worst_ooze());
  nozzle.idle(20);
  EXPECT_NEAR(nozzle.push(0.3, 1, false).made_up_mm3, 0.3, 1e-9);
  EXPECT_NEAR(nozzle.carried_mm3(), worst_mm3(20), 1e-9);
  nozzle.idle(20);
  EXPECT_NEAR(nozzle.carried_mm3(), worst_mm3(40), 1e-9);
  EXPECT_NEAR(nozzle.missing_mm3(), worst_mm3(40) - 0.3, 1e-9);
}

TEST(Ooze, NoMoreIsMissingThanCanOoze) {
  NozzleState nozzle = started(worst_ooze());
  for (int i = 0; i < 10; ++i) {
    nozzle.idle(1000);
    nozzle.push(0.01, 0.1, true);  // restarts the clock, makes up next to nothing
  }
  nozzle.idle(1000);
  EXPECT_NEAR(nozzle.missing_mm3(), 2, 1e-9);
}

TEST(Ooze, InTheModelMissingPlasticCannotOozeAgain) {
  NozzleState nozzle = started(slow_only());
  nozzle.idle(1000);
  nozzle.push(0.5, 1, true);
  nozzle.idle(1000);
  EXPECT_NEAR(nozzle.carried_mm3(), 0.5, 1e-6);
  EXPECT_NEAR(nozzle.missing_mm3(), 2, 1e-6);
}

TEST(Ooze, PressureLeavesAfterTheStopUnlessARetractionTakesItBack) {
  OozeParameters parameters{.volume_mm3 = 0, .elastic_time_s = 0.4};
  // 3 mm3 in 1 s: 1.2 mm3 under pressure.
  NozzleState nozzle(parameters);
  nozzle.push(3, 1, true);
  nozzle.idle(0.4);
  EXPECT_NEAR(nozzle.carried_mm3(), 1.2 * (1 - std::exp(-1)), 1e-9);
  NozzleState retracted(parameters);
  retracted.push(3, 1, true);
  retracted.retract(1.0);
  retracted.idle(100);
  EXPECT_NEAR(retracted.carried_mm3(), 0.2, 1e-9);
  NozzleState late(parameters);
  late.push(3, 1, true);
  late.idle(0.4);
  late.retract(1.0);
  late.idle(100);
  EXPECT_NEAR(late.carried_mm3(), 1.2 * (1 - std::exp(-1)), 1e-9) << "there is less left than it takes back";
}

TEST(Ooze, ACoolerNozzleOozesSlower) {
  OozeParameters parameters{.volume_mm3 = 2, .time_s = 40, .halving_c = 10, .heating_c_s = 1e9, .cooling_c_s = 1e9};
  NozzleState nozzle(parameters);
  nozzle.set_target(200);
  nozzle.start(200);
  nozzle.set_target(180);
  nozzle.idle(80);  // a quarter as fast: as 20 s
  EXPECT_NEAR(nozzle.carried_mm3(), 2 * (1 - std::exp(-0.5)), 1e-6);
  nozzle.set_target(200);
  nozzle.idle(20);
  EXPECT_NEAR(nozzle.carried_mm3(), 2 * (1 - std::exp(-1.0)), 1e-6) << "what did not flow stays in the nozzle";
}

TEST(Ooze, WhileTheHeaterWorksTheFlowChangesWithIt) {
  // From 200 down to 180 within 10 s: the mean of 2^-x for x in [0, 2] is (1 - 1/4) / (2 ln 2).
  OozeParameters parameters{.volume_mm3 = 2, .time_s = 40, .halving_c = 10, .heating_c_s = 1e9, .cooling_c_s = 2};
  NozzleState nozzle(parameters);
  nozzle.set_target(200);
  nozzle.idle(1);  // hot before the print begins
  nozzle.start(200);
  nozzle.set_target(180);
  nozzle.idle(10);
  const double effective_s = 10 * 0.75 / (2 * std::log(2));
  EXPECT_NEAR(nozzle.carried_mm3(), 2 * (1 - std::exp(-effective_s / 40)), 1e-6);
}

TEST(Ooze, HeatersTakeTheirTimeUpButNothingWaitsForCooling) {
  OozeParameters parameters = model_ooze();
  NozzleState nozzle(parameters);
  nozzle.set_target(225);
  EXPECT_NEAR(nozzle.seconds_to_target(), (225 - 25) / parameters.heating_c_s, 1e-9);
  nozzle.idle(50);
  EXPECT_NEAR(nozzle.seconds_to_target(), 50, 1e-9);
  nozzle.idle(50);
  EXPECT_EQ(nozzle.seconds_to_target(), 0);
  nozzle.set_target(150);
  EXPECT_EQ(nozzle.seconds_to_target(), 0);
  EXPECT_EQ(NozzleState(parameters).seconds_to_target(), 0) << "a file that tells no temperatures";
}

TEST(Ooze, ANozzleThatPrintsIsHotWhateverTheFileSays) {
  OozeParameters parameters{.volume_mm3 = 2, .time_s = 40, .halving_c = 10};
  NozzleState nozzle(parameters);
  nozzle.set_target(200);
  nozzle.start(200);
  nozzle.set_target(0);
  nozzle.idle(1000);
  nozzle.push(10, 1, true);  // a macro has heated it
  nozzle.idle(40);
  EXPECT_NEAR(nozzle.carried_mm3(), 2 * (1 - std::exp(-1.0)), 1e-9);
}

TEST(Ooze, OddNumbersGiveFiniteOoze) {
  for (const OozeParameters& parameters :
       {OozeParameters{.volume_mm3 = 0}, OozeParameters{.time_s = 0}, OozeParameters{.time_s = 1e-300},
        OozeParameters{.elastic_time_s = 10, .halving_c = 1e-3, .heating_c_s = 0, .cooling_c_s = 0},
        OozeParameters{.halving_c = 0.01}}) {
    NozzleState nozzle(parameters);
    nozzle.set_target(1e6);
    nozzle.start(1);
    nozzle.idle(1e-9);
    nozzle.push(1, 0, true);
    nozzle.retract(-5);
    nozzle.set_target(-1e6);
    nozzle.idle(1e12);
    EXPECT_TRUE(std::isfinite(nozzle.carried_mm3()));
    EXPECT_TRUE(std::isfinite(nozzle.missing_mm3()));
    EXPECT_GE(nozzle.carried_mm3(), 0);
  }
}
