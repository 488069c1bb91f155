#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "engine/block/dual.h"
#include "models/continuous/rate_limiter.h"
#include "models/continuous/tank.h"
#include "models/hysteresis/play.h"
#include "models/hysteresis/relay.h"
#include "models/mechanics/friction.h"
#include "models/mechanics/hard_stop.h"
#include "tests/models/modes.h"

namespace hysteron {
namespace {

using modes::Numbers;
using modes::Walk;

TEST(RelayModel, SwitchesOnAtOneLevelAndOffAtTheOther) {
  const relay::Params<double> p{.on_at = 1, .off_at = -0.5, .on_value = 7, .off_value = -7};
  const double u[] = {0, 0.99, 1.0, 0, -0.49, -0.5, 0.5, 2};
  const double expected[] = {-7, -7, 7, 7, 7, -7, -7, 7};
  auto mode = relay::off;
  for (int k = 0; k < 8; ++k) {
    if (relay::guard(p, mode, u[k]) <= 0) mode = relay::next(mode);
    EXPECT_EQ(relay::output(p, mode), expected[k]) << "input " << k;
  }
}

TEST(BacklashModel, DrivenSideRestsWhileTheGapIsCrossed) {
  // Gap 0.5: pushed to 1 - 0.25, rests until the drive has come back by the gap, then is pulled.
  double y = play::backlash(0.5, 0.0, 1.0);
  EXPECT_EQ(y, 0.75);
  y = play::backlash(0.5, y, 0.5);
  EXPECT_EQ(y, 0.75);
  y = play::backlash(0.5, y, 0.0);
  EXPECT_EQ(y, 0.25);
}

Walk sliding(const friction::Params<double>& p, std::function<double(double)> force, double x, double v) {
  const auto mode = [](int m) { return static_cast<friction::Mode>(m); };
  modes::System s;
  s.rate = [=](int m, double t, const Numbers& n) {
    return Numbers{n[1], friction::acceleration(p, mode(m), n[0], n[1], force(t))};
  };
  s.guard = [=](int m, double t, const Numbers& n) { return friction::guard(p, mode(m), n[0], n[1], force(t)); };
  s.land = [=](int& m, double t, Numbers& n) {
    m = friction::next(p, mode(m), n[0], force(t));
    n[1] = 0;
  };
  return {s, 1e-3, 0, friction::start(v), {x, v}};
}

TEST(FrictionModel, SlidingMassStopsAfterTheClosedFormWayAndStays) {
  // v0 = 2 m/s against F_c/m = 4 m/s^2: stops at 0.5 s after v0^2/(2 F_c/m) = 0.5 m.
  Walk walk = sliding(
      {.mass = 0.5, .coulomb = 2, .breakaway = 3}, [](double) { return 0.0; }, 0, 2);
  walk.until(1);
  ASSERT_EQ(walk.events.size(), 1u);
  EXPECT_NEAR(walk.events[0].t, 0.5, 1e-9);  // rest_speed over 4 m/s^2 later
  EXPECT_EQ(walk.mode, friction::stick);
  EXPECT_NEAR(walk.x[0], 0.5, 1e-12);
  EXPECT_EQ(walk.x[1], 0);
}

TEST(FrictionModel, StickingMassDoesNotCreepAndBreaksAwayAtItsForce) {
  // Force 5 t N: sticks until 3 N at 0.6 s, then slides against 2 N: v = (2.5 (t^2 - 0.36) - 2 (t - 0.6))/m.
  Walk walk = sliding(
      {.mass = 0.5, .coulomb = 2, .breakaway = 3}, [](double t) { return 5 * t; }, 0.1, 0);
  walk.until(0.599);
  EXPECT_EQ(walk.x[0], 0.1);
  walk.until(1);
  EXPECT_NEAR(walk.events[0].t, 0.6, 1e-12);
  EXPECT_NEAR(walk.x[1], (2.5 * (1 - 0.36) - 2 * 0.4) / 0.5, 1e-11);
}

TEST(FrictionModel, OscillatorLosesTheSameAmplitudeEachHalfCycle) {
  // Turning points of a mass on a spring with Coulomb friction: |x| falls by 2 F_c/k until k |x| is held.
  // k = 100 N/m, F_c = F_b = 10 N: 1 -> -0.8 -> 0.6 -> -0.4 -> 0.2 -> 0.0, every pi sqrt(m/k) = 0.31416 s.
  Walk walk = sliding(
      {.mass = 1, .stiffness = 100, .coulomb = 10, .breakaway = 10}, [](double) { return 0.0; }, 0.95, 0);
  const double half = 3.14159265358979 / 10;
  for (int k = 1; k <= 4; ++k) {
    walk.until(half * k);
    EXPECT_NEAR(std::fabs(walk.x[0]), 0.95 - 0.2 * k, 1e-9) << "turn " << k;  // RK4: (10 h)^4/120 per cycle
  }
  walk.until(3);
  EXPECT_EQ(walk.mode, friction::stick);
  EXPECT_NEAR(std::fabs(walk.x[0]), 0.05, 1e-8);
}

TEST(FrictionModel, StribeckCurveFallsFromBreakawayToCoulomb) {
  friction::Params<double> p{.coulomb = 1, .breakaway = 1.5, .stribeck_velocity = 0.01};
  EXPECT_EQ(friction::sliding_force(p, 0.0), 1.5);
  EXPECT_NEAR(friction::sliding_force(p, 0.01), 1 + 0.5 * std::exp(-1), 1e-15);
  EXPECT_NEAR(friction::sliding_force(p, 1.0), 1, 1e-15);
  EXPECT_EQ(friction::sliding_force(friction::Params<double>{.coulomb = 1, .breakaway = 2}, 0.0), 1);
  p.falls_by = 1;
  EXPECT_NEAR(friction::sliding_force(p, -0.02), 1 + 0.5 * std::exp(-2), 1e-15);
  p.falls_by = 1.5;
  EXPECT_NEAR(friction::sliding_force(p, -0.02), 1 + 0.5 * std::exp(-std::sqrt(8)), 1e-15);
}

TEST(FrictionModel, WithoutFrictionTheMassNeverSticks) {
  Walk walk = sliding(
      {.mass = 1, .stiffness = 100}, [](double) { return 0.0; }, 1, 0);
  walk.until(1);
  EXPECT_NEAR(walk.x[0], std::cos(10.0), 1e-8);
  EXPECT_NEAR(walk.x[1], -10 * std::sin(10.0), 1e-7);
  for (const auto& e : walk.events) EXPECT_NE(e.after, friction::stick);
  // Begins to slide. That it turns, at pi/10 and so on, is no event: there is nothing to stick to.
  EXPECT_EQ(walk.events.size(), 1u);
}

TEST(FrictionModel, ForceExactlyAtBreakawaySettles) {
  const friction::Params<double> p{.mass = 1, .coulomb = 2, .breakaway = 2};
  Walk walk = sliding(
      p, [](double) { return 2.0; }, 0, 0);  // throws if the modes chase each other
  walk.until(0.1);
  EXPECT_EQ(walk.x[0], 0);
}

Walk between_stops(const hard_stop::Params<double>& p, std::function<double(double)> force, double x, double v) {
  const auto mode = [](int m) { return static_cast<hard_stop::Mode>(m); };
  modes::System s;
  s.rate = [=](int m, double t, const Numbers& n) {
    return Numbers{n[1], hard_stop::acceleration(p, mode(m), n[0], n[1], force(t))};
  };
  s.guard = [=](int m, double t, const Numbers& n) { return hard_stop::guard(p, mode(m), n[0], force(t)); };
  s.land = [=](int& m, double t, Numbers& n) {
    const auto landing = hard_stop::land(p, mode(m), n[0], n[1], force(t));
    m = landing.mode;
    n = {landing.position, landing.velocity};
  };
  return {s, 1e-3, 0, hard_stop::free, {x, v}};
}

TEST(HardStopModel, BouncingMassRestsAfterTheSumOfItsBounces) {
  // Constant force 10 N on 1 kg towards a stop 0.8 m away: impact at 0.4 s with 4 m/s, bounces with e = 0.5 last
  // 2 e^n 4/10 s; the sum is 0.4 + 0.8 (0.5 + 0.25 + ...) = 1.2 s, cut at 4 e^n <= 1e-3 m/s.
  Walk walk = between_stops(
      {.mass = 1, .lower = -1, .upper = 0.8, .restitution = 0.5, .rest_speed = 1e-3}, [](double) { return 10.0; }, 0,
      0);
  walk.until(2);
  EXPECT_NEAR(walk.events[0].t, 0.4, 1e-12);
  EXPECT_EQ(walk.events.back().after, hard_stop::at_upper);
  EXPECT_NEAR(walk.events.back().t, 1.2, 4e-4);  // what is cut: 2 1e-3/10 s
  EXPECT_EQ(walk.events.size(), 12u);            // 4/2^12 = 9.8e-4 is the first rebound that is none
  EXPECT_EQ(walk.x[0], 0.8);
  EXPECT_EQ(walk.x[1], 0);
}

TEST(HardStopModel, MassLeavesItsStopWhenTheForceTurns) {
  // Force 1 - t presses until 1 s, then x = upper - (t - 1)^3/6.
  Walk walk = between_stops(
      {.mass = 1, .lower = -1, .upper = 0.5}, [](double t) { return 1 - t; }, 0.5, 0);
  walk.until(2);
  EXPECT_NEAR(walk.events.back().t, 1, 1e-12);
  EXPECT_NEAR(walk.x[0], 0.5 - 1.0 / 6, 1e-12);
}

TEST(HardStopModel, EveryEventIsAChangeToAModeThatMayStay) {
  const hard_stop::Params<double> p{.restitution = 0.7, .rest_speed = 0.1};
  for (const auto mode : {hard_stop::free, hard_stop::free_again, hard_stop::at_lower, hard_stop::at_upper})
    for (const double v : {2.0, 0.05, 0.0, -1.0})
      for (const double force : {3.0, 0.0, -3.0}) {
        const double x = 1 + hard_stop::depth;
        if (hard_stop::guard(p, mode, x, force) > 0) continue;
        const auto landing = hard_stop::land(p, mode, x, v, force);
        EXPECT_NE(landing.mode, mode);
        EXPECT_GT(hard_stop::guard(p, landing.mode, landing.position, force), 0) << mode << " " << v << " " << force;
      }
}

TEST(HardStopModel, EnergyOfAnElasticImpactIsKept) {
  // Free flight between two elastic stops: after whole periods the mass is where it was.
  Walk walk = between_stops(
      {.mass = 1, .restitution = 1}, [](double) { return 0.0; }, 0, 2);
  walk.until(6);  // period 2 x 2/2 s
  EXPECT_NEAR(walk.x[0], 0, 1e-10);
  EXPECT_EQ(walk.x[1], 2);
}

Walk limited(const rate_limiter::Params<double>& p, std::function<double(double)> u, double y) {
  const auto mode = [](int m) { return static_cast<rate_limiter::Mode>(m); };
  modes::System s;
  s.rate = [=](int m, double t, const Numbers& n) { return Numbers{rate_limiter::rate(p, mode(m), n[0], u(t))}; };
  s.guard = [=](int m, double t, const Numbers& n) { return rate_limiter::guard(p, mode(m), n[0], u(t)); };
  s.land = [=](int& m, double t, Numbers& n) { m = rate_limiter::next(p, n[0], u(t)); };
  return {s, 1e-3, 0, rate_limiter::tracking, {y}};
}

TEST(RateLimiterModel, StepIsARampAndThenAnExponential) {
  // Step of 3: rate 4 until the gap is 4 x 0.05 = 0.2, at 0.7 s.
  const rate_limiter::Params<double> p{.rise = 4, .fall = 2, .time = 0.05};
  Walk walk = limited(
      p, [](double) { return 3.0; }, 0);
  walk.until(0.5);
  EXPECT_EQ(walk.mode, rate_limiter::rising);
  EXPECT_NEAR(walk.x[0], 2, 1e-12);
  walk.until(1);
  EXPECT_EQ(walk.mode, rate_limiter::tracking);
  EXPECT_NEAR(walk.events.back().t, 0.7, 1e-6);  // the limit is left at a share 1e-6 of it
  EXPECT_NEAR(walk.x[0], 3 - 0.2 * std::exp(-6), 1e-9);
  for (const double t : {0.3, 0.7, 0.75, 1.5}) {
    EXPECT_NEAR(rate_limiter::after_hold(p, 0.0, 3.0, t), t <= 0.7 ? 4 * t : 3 - 0.2 * std::exp(-(t - 0.7) / 0.05),
                1e-14);
    EXPECT_NEAR(rate_limiter::after_hold(p, 0.0, -3.0, t), t <= 1.45 ? -2 * t : -3 + 0.1 * std::exp(-1), 1e-14);
  }
}

TEST(RateLimiterModel, SlowInputIsOnlyDelayed) {
  // Ramp of 1.9 below both limits: behind the start y = 1.9 (t - tau (1 - exp(-t/tau))).
  Walk walk = limited(
      {.rise = 4, .fall = 2, .time = 0.05}, [](double t) { return 1.9 * t; }, 0);
  walk.until(0.2);
  EXPECT_TRUE(walk.events.empty());
  EXPECT_NEAR(walk.x[0], 1.9 * (0.2 - 0.05 * (1 - std::exp(-4))), 1e-9);  // RK4: 0.02^4/120
}

TEST(RateLimiterModel, FastTriangleIsFollowedAtTheLimitsOfEitherDirection) {
  // Slopes +-10 against 4 and 2: up to 5 at 0.5 s, down to 0 at 1 s. The follower y = 10 (t - tau (1 - exp(-t/tau)))
  // grows as fast as 4 at t = -tau ln 0.6 and goes on at 4 until it meets the way back near 0.714 s, then at -2.
  const double tau = 1e-3, begins = -tau * std::log(0.6), reached = 10 * (begins - 0.4 * tau);
  Walk walk = limited(
      {.rise = 4, .fall = 2, .time = tau}, [](double t) { return t < 0.5 ? 10 * t : 10 - 10 * t; }, 0);
  walk.step = 1e-4;
  walk.until(0.6);
  EXPECT_NEAR(walk.events[0].t, begins, 1e-8);  // RK4: 0.1^4/120 of tau
  EXPECT_NEAR(walk.x[0], reached + 4 * (0.6 - begins), 1e-8);
  EXPECT_EQ(walk.mode, rate_limiter::rising);
  walk.until(0.85);
  EXPECT_EQ(walk.mode, rate_limiter::falling);
  const double before = walk.x[0];
  walk.until(0.9);
  EXPECT_NEAR(walk.x[0], before - 0.1, 1e-12);
  EXPECT_EQ(walk.events.size(), 3u);
}

TEST(RateLimiterModel, ARampIsFollowedAsBySmallSteps) {
  // Explicit steps of 1e-6 of a follower with tau = 0.05: their error is below h/2 times the largest second derivative
  // (10/0.05) over 1 s.
  const rate_limiter::Params<double> p{.rise = 4, .fall = 2, .time = 0.05};
  for (const double slope : {-10.0, -2.0, -1.0, 0.0, 3.0, 4.0, 9.0})
    for (const double begin : {-1.5, -0.1, 0.0, 0.15, 0.2, 2.0}) {
      double gap = begin;
      const int steps = 1000000;
      for (int i = 0; i < steps; ++i) gap += 1e-6 * (slope - std::max(-p.fall, std::min(p.rise, gap / p.time)));
      EXPECT_NEAR(rate_limiter::gap_after_ramp(p, begin, slope, 1), gap, 1e-4) << slope << " from " << begin;
    }
}

TEST(RateLimiterModel, ARampMayBeCutAnywhere) {
  const rate_limiter::Params<double> p{.rise = 4, .fall = 2, .time = 0.05};
  for (const double slope : {-10.0, -1.0, 3.0, 9.0})
    for (const double begin : {-1.5, -0.1, 0.15, 2.0}) {
      const double half = rate_limiter::gap_after_ramp(p, begin, slope, 0.3);
      EXPECT_NEAR(rate_limiter::gap_after_ramp(p, half, slope, 0.4), rate_limiter::gap_after_ramp(p, begin, slope, 0.7),
                  1e-13);  // some roundings
    }
}

TEST(RateLimiterModel, BehindARowThatIsAMillionTimesAsLongTheGapIsThatOfTheRamp) {
  const rate_limiter::Params<double> p{.rise = 4, .fall = 2, .time = 1e-9};
  const double rounding = 1e-24;
  EXPECT_NEAR(rate_limiter::gap_after_ramp(p, 0, 3, 1e-3), 3e-9, rounding);
  EXPECT_NEAR(rate_limiter::gap_after_ramp(p, 3e-9, -1, 1e-3), -1e-9, rounding);
  EXPECT_NEAR(rate_limiter::gap_after_ramp(p, 0, 3, 2e-9), 3e-9 * (1 - std::exp(-2)), rounding);
}

TEST(RateLimiterModel, WithoutATimeConstantThereIsNoGapWithinTheLimits) {
  const rate_limiter::Params<double> p{.rise = 4, .fall = 2, .time = 0};
  EXPECT_EQ(rate_limiter::gap_after_ramp(p, 0, 3.9, 7), 0);
  EXPECT_EQ(rate_limiter::gap_after_ramp(p, 0, 5, 7), 7);          // 5 - 4 a second
  EXPECT_EQ(rate_limiter::gap_after_ramp(p, 0.5, 3, 0.25), 0.25);  // closes by 1 a second
  EXPECT_EQ(rate_limiter::gap_after_ramp(p, 0.5, 3, 7), 0);
}

Walk filled(tank::Outlet law, const tank::Params<double>& p, std::function<double(double)> inflow, double level) {
  const auto mode = [](int m) { return static_cast<tank::Mode>(m); };
  modes::System s;
  s.rate = [=](int m, double t, const Numbers& n) { return Numbers{tank::rate(law, p, mode(m), n[0], inflow(t))}; };
  s.guard = [=](int m, double t, const Numbers& n) { return tank::guard(law, p, mode(m), n[0], inflow(t)); };
  s.land = [=](int& m, double, Numbers& n) {
    m = tank::next(mode(m), n[0]);
    n[0] = tank::held_level(p, n[0]);
  };
  return {s, 1e-2, 0, tank::open, {level}};
}
const double no_brim = std::numeric_limits<double>::infinity();

TEST(TankModel, LinearOutletDrainsExponentially) {
  Walk walk = filled(
      tank::Outlet::linear, {.area = 2, .outlet = 0.6, .height = no_brim}, [](double) { return 0.0; }, 5);
  walk.until(4);
  EXPECT_NEAR(walk.x[0], 5 * std::exp(-1.2), 1e-9);  // RK4 with 0.003 of the time constant
}

TEST(TankModel, OutletByAPowerOfTheLevelLiesBetweenPipeAndOrifice) {
  // h^(1-n) = h0^(1-n) - (1-n) c t/A: h^(1/4) = 1 - 0.25 behind t = 2.
  Walk walk = filled(
      tank::Outlet::power, {.area = 2, .outlet = 1, .height = no_brim, .exponent = 0.75}, [](double) { return 0.0; },
      1);
  walk.until(2);
  EXPECT_NEAR(walk.x[0], std::pow(0.75, 4), 1e-10);
  for (const double level : {0.1, 0.9, 4.0}) {
    EXPECT_NEAR(tank::outflow<double>(tank::Outlet::power, {.outlet = 3, .reference = 2, .exponent = 1}, level),
                tank::outflow<double>(tank::Outlet::linear, {.outlet = 3, .reference = 2}, level), 1e-15);
    EXPECT_NEAR(tank::outflow<double>(tank::Outlet::power, {.outlet = 3, .reference = 2, .exponent = 0.5}, level),
                tank::outflow<double>(tank::Outlet::square_root, {.outlet = 3, .reference = 2}, level), 1e-15);
  }
  const tank::Params<double> p{.outlet = 3, .reference = 2, .height = no_brim, .exponent = 0.7};
  EXPECT_NEAR(tank::outflow(tank::Outlet::power, p, tank::rest(tank::Outlet::power, p, 1.3)), 1.3, 1e-14);
}

TEST(TankModel, OrificeDrainsInFiniteTime) {
  // sqrt(h) = sqrt(h0) - c t/(2 A): 1 - 0.25 t, empty at 4 s.
  Walk walk = filled(
      tank::Outlet::square_root, {.area = 2, .outlet = 1, .height = no_brim}, [](double) { return 0.0; }, 1);
  walk.until(2);
  EXPECT_NEAR(walk.x[0], 0.25, 1e-10);
  walk.until(6);
  EXPECT_NEAR(walk.x[0], 0, 1e-5);  // the last step of 0.01 s reaches below (0.25 0.01)^2
  EXPECT_GE(walk.x[0], 0);
}

TEST(TankModel, AStepOfARowIsKuttasAndHeldBetweenBottomAndBrim) {
  // An orifice drains as a parabola, sqrt(h) = 1 - t/4 (area 2, outlet 1 at 1 m): one step of 0.1 s leaves h^5 of it.
  const tank::Params<double> orifice{.area = 2, .outlet = 1, .height = no_brim};
  const auto drained = tank::after(tank::Outlet::square_root, orifice, {1, 0}, 0, 0, 0.1);
  EXPECT_NEAR(drained.level, std::pow(1 - 0.025, 2), 1e-9);
  EXPECT_EQ(drained.spilled, 0);
  // A closed tank under a straight inflow from 1 to 3 m^3/s in 1 s takes 2 m^3: 0.9 + 1 m, of which 0.4 m are spilled.
  const tank::Params<double> closed{.area = 2, .outlet = 0, .height = 1.5};
  const auto filled = tank::after(tank::Outlet::linear, closed, {0.9, 5}, 1, 3, 1);
  EXPECT_EQ(filled.level, 1.5);
  EXPECT_NEAR(filled.spilled, 5 + 2 * 0.4, 1e-14);
  const auto pumped = tank::after(tank::Outlet::linear, closed, {0.9, 0}, -3, -3, 1);
  EXPECT_EQ(pumped.level, 0);
  EXPECT_EQ(pumped.spilled, 0);
}

TEST(TankModel, WaterOverTheBrimIsLost) {
  // Inflow 2 for 1.5 s into area 1, brim 1, no outlet yet: full at 0.5 s. Then -0.5 (a pump) lowers it at once.
  const tank::Params<double> p{.area = 1, .outlet = 0, .height = 1};
  Walk walk = filled(
      tank::Outlet::linear, p, [](double t) { return t < 1.5 ? 2.0 : -0.5; }, 0);
  walk.until(1.4999);
  EXPECT_NEAR(walk.events.back().t, 0.5, 1e-9);  // the film of 1 nm over 2 m/s later
  EXPECT_EQ(walk.x[0], 1);
  EXPECT_EQ(tank::overflow(tank::Outlet::linear, p, tank::full, 2.0), 2);
  EXPECT_EQ(tank::overflow(tank::Outlet::linear, p, tank::open, 2.0), 0);
  walk.until(2.5);
  EXPECT_NEAR(walk.x[0], 0.5, 1e-9);
  walk.until(5);  // pumped empty at 3.5 s and no further
  EXPECT_EQ(walk.mode, tank::empty);
  EXPECT_EQ(walk.x[0], 0);
}

TEST(TankModel, FullTankWithAnOutletLosesOnlyTheSurplus) {
  const tank::Params<double> p{.area = 1, .outlet = 0.5, .height = 4};
  EXPECT_EQ(tank::overflow(tank::Outlet::square_root, p, tank::full, 3.0), 2);               // 3 - 0.5 sqrt(4)
  EXPECT_EQ(tank::overflow(tank::Outlet::linear, p, tank::full, 3.0), 1);                    // 3 - 0.5 4
  const tank::Params<double> measured{.area = 1, .outlet = 1, .reference = 4, .height = 9};  // 1 = 0.5 sqrt(4)
  EXPECT_EQ(tank::outflow(tank::Outlet::square_root, measured, 1.0), 0.5);
  EXPECT_EQ(tank::outflow(tank::Outlet::linear, measured, 1.0), 0.25);
  EXPECT_EQ(tank::rest(tank::Outlet::square_root, measured, 1.5), 9);
  EXPECT_EQ(tank::rest(tank::Outlet::square_root, p, 0.5), 1);
  EXPECT_EQ(tank::rest(tank::Outlet::linear, p, 0.5), 1);
  EXPECT_EQ(tank::rest(tank::Outlet::square_root, p, 9.0), 4);
}

TEST(TankModel, EmptyOrificeHasARateThatIsANumber) {
  const tank::Params<Dual> p{.area = 1.0, .outlet = 1.0, .height = 1.0};
  EXPECT_EQ(tank::outflow(tank::Outlet::square_root, p, Dual{0, 1}).rate, 0);
  EXPECT_NEAR(tank::outflow(tank::Outlet::square_root, p, Dual{0.25, 1}).rate, 1, 1e-15);  // c/(2 sqrt h)
}

}  // namespace
}  // namespace hysteron
