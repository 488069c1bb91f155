// Steps of any length of a mass on a spring, and of the elements beside it, against fine steps of Runge-Kutta.
#include "models/mechanics/mass_motion.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <tuple>

#include "models/mechanics/presliding.h"

namespace hysteron {
namespace {

using mass_motion::ExactStep;
using mass_motion::Force;
using mass_motion::Motion;

/// m x'' + d x' + k x = F, by so many steps that their error (their length to the power of four) is rounding.
Motion marched(double mass, double damping, double stiffness, Motion x, double h,
               const std::function<double(double)>& force_at) {
  const int steps = 20000;
  const double dt = h / steps;
  for (int i = 0; i < steps; ++i) {
    const auto rate = [&](const Motion& at, double share) {
      const double force = force_at((i + share) / steps);
      return Motion{at.velocity, (force - damping * at.velocity - stiffness * at.position) / mass};
    };
    const auto moved = [&](const Motion& by, double length) {
      return Motion{x.position + length * by.position, x.velocity + length * by.velocity};
    };
    const Motion k1 = rate(x, 0), k2 = rate(moved(k1, dt / 2), 0.5), k3 = rate(moved(k2, dt / 2), 0.5),
                 k4 = rate(moved(k3, dt), 1);
    x.position += dt / 6 * (k1.position + 2 * k2.position + 2 * k3.position + k4.position);
    x.velocity += dt / 6 * (k1.velocity + 2 * k2.velocity + 2 * k3.velocity + k4.velocity);
  }
  return x;
}

TEST(MassMotion, AStepOfAnyLengthIsWhatManySmallOnesSay) {
  // Mass 2 kg, 50 N/m: 5 rad/s, critical damping 20 N s/m. From one radian to a dozen.
  for (const double damping : {0.0, 0.5, 19.9999, 20.0, 20.0001, 60.0, 2000.0})
    for (const double h : {0.21, 2.5}) {
      const Motion start{0.01, -0.3};
      const ExactStep step(2, damping, 50, h);
      const Motion found = step(start, 1.5, -0.7),
                   truth = marched(2, damping, 50, start, h, [](double part) { return 1.5 - 2.2 * part; });
      EXPECT_NEAR(found.position, truth.position, 1e-11) << damping << " " << h;
      EXPECT_NEAR(found.velocity, truth.velocity, 1e-11) << damping << " " << h;
      const Motion more = step(start, 1.5, 0.3);
      EXPECT_NEAR(more.position - found.position, step.yield() * 1.0, 1e-15) << "a newton more at the end";
    }
}

TEST(MassMotion, AParabolaOfForceIsFollowedToo) {
  for (const double damping : {0.0, 0.5, 20.0, 60.0})
    for (const double h : {0.02, 0.21, 2.5}) {
      const Motion start{0.01, -0.3};
      const ExactStep step(2, damping, 50, h);
      const auto truth =
          marched(2, damping, 50, start, h, [](double part) { return 1.5 - 4 * part + 3 * part * part; });
      const Motion found = step(start, 1.5, -4, 3);
      EXPECT_NEAR(found.position, truth.position, 1e-11) << damping << " " << h;
      EXPECT_NEAR(found.velocity, truth.velocity, 1e-10) << damping << " " << h;  // 1e-16 (2 pi h/period)^-4 of 3 N
    }
}

TEST(MassMotion, AForceThatHangsOnThePlaceIsRightToTheFourthPowerOfTheStep) {
  // A spring half as hard again, as a force beside a linear one; against the exact motion on 75 N/m.
  const auto error = [](int steps) {
    const double h = 1.0 / steps;
    const ExactStep whole(2, 0.5, 50, h), half(2, 0.5, 50, h / 2);
    Motion x{0.01, -0.3};
    for (int i = 0; i < steps; ++i)
      x = mass_motion::step_under(whole, half, x, 0.2 * i * h, 0.2 * (i + 1) * h, [](double at) { return -25 * at; });
    const Motion truth = ExactStep(2, 0.5, 75, 1)(Motion{0.01, -0.3}, 0, 0.2);
    return std::fabs(x.position - truth.position);
  };
  EXPECT_LT(error(10), 2.6e-4 * 0.06);  // of the amplitude: half of 0.5^4/120, half a radian a step
  EXPECT_NEAR(std::log2(error(10) / error(20)), 4, 0.6);
}

TEST(MassMotion, AForceThatHangsOnTheVelocityIsRightToTheFourthPowerOfTheStepToo) {
  // A damper of 3 N s/m more, as a force beside a linear one of 0.5; against the exact motion with 3.5.
  const auto error = [](int steps) {
    const double h = 1.0 / steps;
    const ExactStep whole(2, 0.5, 50, h), half(2, 0.5, 50, h / 2);
    const auto none = [](double) { return 0.0; };
    const auto damper = [](const Motion& at) { return -3 * at.velocity; };
    Motion x{0.01, -0.3};
    for (int i = 0; i < steps; ++i)
      x = mass_motion::step_under(whole, half, x, 0.2 * i * h, 0.2 * (i + 1) * h, none, damper, 3);
    return std::fabs(x.velocity - ExactStep(2, 3.5, 50, 1)(Motion{0.01, -0.3}, 0, 0.2).velocity);
  };
  EXPECT_LT(error(10), 5e-5 * 0.3);  // of the amplitude: a few hundredths of (3/2 0.1)^4
  EXPECT_GT(std::log2(error(10) / error(20)), 3.5);
}

TEST(MassMotion, APullNearKnownPlacesIsThatOfTheParabolaThroughThem) {
  const auto pull = [](double x) { return 3 - 2 * x + 5 * x * x; };
  const mass_motion::NearPlaces known{{0.1, 0.3, 0.4}, {pull(0.1), pull(0.3), pull(0.4)}};
  for (const double off : {-0.002, 0.0, 0.0029}) {
    EXPECT_NEAR(known.at(0.3 + off, 0.3), pull(0.3 + off), 1e-14) << "rounding of 3";
    EXPECT_NEAR(known.at(0.4 + off, 0.4), pull(0.4 + off), 1e-14);
  }
  EXPECT_TRUE(std::isnan(known.at(0.304, 0.3))) << "more than a hundredth of the way";
  const mass_motion::NearPlaces still{{0.1, 0.1, 0.1}, {3, 3, 3}}, back{{0.1, 0.2, 0.1}, {3, 4, 3}};
  EXPECT_TRUE(std::isnan(still.at(0.1, 0.1)));
  EXPECT_TRUE(std::isnan(back.at(0.1, 0.1)));
}

TEST(MassMotion, TheEndBalancesAForceThatHangsOnIt) {
  // A hardening force, one that holds back by a constant at most, and one that pulls: x = free + yield F(x).
  const std::array<std::function<Force(double)>, 3> laws{
      [](double x) {
        return Force{-40 * x * x * x, -120 * x * x};
      },
      [](double x) {
        return Force{-3 * std::tanh(50 * x), -150 / (std::cosh(50 * x) * std::cosh(50 * x))};
      },
      [](double x) {
        return Force{2 * x, 2};
      }};
  for (const auto& law : laws)
    for (const double free : {-2.0, 1e-3, 0.7}) {
      const double x = mass_motion::end_position(free, 0.2, free, law);
      EXPECT_NEAR(x, free + 0.2 * law(x).value, 1e-13) << free;
    }
  const auto none = [](double x) { return Force{100 + x * x * 100, 200 * x}; };
  EXPECT_TRUE(std::isnan(mass_motion::end_position(1, 0.2, 1, none))) << "21 + 20 x^2 is never x";
}

/// dz = law(z, side) |dx| along a way in one direction.
double along(const std::function<double(double, double)>& rate, double z, double way) {
  const int steps = 40000;
  const double v = way / steps;
  for (int i = 0; i < steps; ++i) {
    const double k1 = rate(z, v), k2 = rate(z + k1 / 2, v), k3 = rate(z + k2 / 2, v);
    z += (k1 + 2 * (k2 + k3) + rate(z + k3, v)) / 6;
  }
  return z;
}

TEST(PreslidingModel, AWayOfAnyLengthIsWhatItsRateSays) {
  const double distance = 0.3;
  for (const double z : {-0.9, -0.5, -0.29, -0.1, 0.0, 0.2, 0.2999, 0.3003})
    for (const double way : {-4.0, -0.25, -0.01, 0.002, 0.3, 1.1, 9.0}) {
      const auto dahl = [&](double at, double v) { return presliding::deflection_rate(distance, at, v); };
      presliding::SlippingElement slipping(distance, z);
      EXPECT_NEAR(slipping.after(way), along(dahl, z, way), 1e-12) << z << " " << way;
      slipping.move(way);
      EXPECT_NEAR(slipping.z(), presliding::deflection_after(distance, way, z), 1e-15) << "rounding of 0.3";
      const auto slip = [&](double at, double v) { return presliding::slip_rate(distance, at, v); };
      presliding::YieldingElement yielding(distance, z);
      EXPECT_NEAR(yielding.after(way), along(slip, z, way), 2e-8 * distance) << z << " " << way;
      // Two ways in one direction are one; and the element knows its way again from its deflection.
      const double at_once = yielding.after(way);
      yielding.move(0.4 * way);
      EXPECT_NEAR(presliding::YieldingElement(distance, yielding.z()).after(0.6 * way), at_once, 2e-8 * distance);
      yielding.move(0.6 * way);
      EXPECT_NEAR(yielding.z(), at_once, 2e-8 * distance) << z << " " << way;
    }
  for (const double z : {-0.1, 0.1}) {
    presliding::YieldingElement still(distance, z);
    EXPECT_EQ(still.after(0), z);
    EXPECT_EQ(still.after(-0.0), z);
    still.move(0);
    EXPECT_EQ(still.z(), z);
  }
}

// ds/dw = 1 - s^4 is -4 (s - 1) near 1, and -s^4 far above it, from which s = (3 w)^(-1/3) in leading order.
TEST(PreslidingModel, WhatIsAboveItsLargestForceRelaxes) {
  for (const double above : {1e-15, 1e-12, 1e-8})
    for (const double way : {1e-4, 0.3, 2.0}) {
      const double exact = std::fmax(0, above * std::exp(-4 * way));
      EXPECT_NEAR(presliding::relaxed_share(1 + above, way) - 1, exact, 2.3e-16 + 1e-7 * exact) << above << " " << way;
    }
  EXPECT_NEAR(presliding::relaxed_share(1e3, 1e-5), std::pow(3e-5 + 1e-9, -1.0 / 3), 1e-2) << "of 32";
  EXPECT_EQ(presliding::relaxed_share(11, 50), 1);
}

TEST(PreslidingModel, TheShareBehindAWayIsTheInverseOfTheWay) {
  for (double share = 0; share < 0.9999; share += 0.0137)
    EXPECT_NEAR(presliding::YieldingShare::behind(presliding::yielding_way(share)), share, 1e-8);
  EXPECT_EQ(presliding::YieldingShare::behind(1e9), 1);
  EXPECT_EQ(presliding::YieldingShare::behind(-0.3), -presliding::YieldingShare::behind(0.3));
  EXPECT_TRUE(std::isnan(presliding::YieldingShare::behind(std::nan(""))));
}

}  // namespace
}  // namespace hysteron
