// Laws of one state or none, against closed forms.
#include "models/linear/resonance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "models/math/saturation.h"
#include "models/mechanics/presliding.h"

namespace hysteron {
namespace {

TEST(ResonanceModel, AnswersASineAsItsTransferFunctionSays) {
  // The particular solution q = Im(H e^(iat)), H = w^2/(w^2 - a^2 + 2 i z w a), satisfies the law at any instant.
  const double hertz = 3, z = 0.07, w = 2 * std::numbers::pi * hertz, a = 11;
  const std::complex<double> i(0, 1), h = w * w / (w * w - a * a + 2.0 * i * z * w * a);
  for (const double t : {0.0, 0.13, 0.7}) {
    const auto q = h * std::exp(i * a * t), v = i * a * q / w;
    const auto rate = resonance::rates(hertz, z, q.imag(), v.imag(), std::sin(a * t));
    // Rounding of numbers of size w |v|, below 100.
    EXPECT_NEAR(rate.q, (i * a * q).imag(), 1e-13);
    EXPECT_NEAR(rate.v, (i * a * v).imag(), 1e-12);
  }
}

TEST(PreslidingModel, FollowsItsExponentialAndTurnsAtTheReversal) {
  // dz/dx along the closed form, by the law itself: z' of z = d (1 - exp(-x/d)) is exp(-x/d) v.
  const double d = 2e-6, v = 3e-3;
  for (const double x : {0.0, 1e-6, 5e-6}) {
    const double deflection = presliding::deflection_after(d, x);
    EXPECT_NEAR(presliding::deflection_rate(d, deflection, v), std::exp(-x / d) * v, 1e-15 * v + 1e-18);
    EXPECT_LT(deflection, d);
    EXPECT_EQ(presliding::deflection_after(d, -x), -deflection);
  }
  // Behind a reversal it unloads at first steeper than it was loaded: 1 + z/d against 1 - z/d.
  EXPECT_NEAR(presliding::deflection_rate(d, d / 2, -v), -1.5 * v, 1e-18);
}

TEST(PreslidingModel, AnElementThatFlowsSettlesOnItsCurveAndRelaxesAtRest) {
  const double d = 0.2, crossover = 0.3;
  for (const double v : {-2.0, -0.1, 0.0, 0.4, 5.0}) {
    const double share = presliding::sliding_share(crossover, v);
    EXPECT_NEAR(share, v / std::sqrt(v * v + crossover * crossover), 1e-15);
    EXPECT_NEAR(presliding::yield_rate(d, crossover, share, v), 0, 1e-14) << "steady at " << v;
  }
  // At rest s' = -(v_c/d) s: the time constant of a Maxwell element.
  EXPECT_NEAR(presliding::yield_rate(d, crossover, 0.7, 0.0), -crossover / d * 0.7, 1e-15);
  // Without a crossover it is Dahl's element in other words: z = d s.
  for (const double v : {-1.5, 0.6})
    EXPECT_NEAR(d * presliding::yield_rate(d, 0.0, 0.7, v), presliding::deflection_rate(d, 0.7 * d, v), 1e-15);
  EXPECT_EQ(presliding::sliding_share(0.0, 0.0), 0) << "it holds nothing at rest";
}

TEST(PreslidingModel, AYieldingElementIsElasticOnItsWayBackAndHoldsAtItsDistance) {
  // Integrated over the path, where velocity times time is the way.
  const double d = 2e-6, step = d / 20000;
  const auto over = [&](auto rate, double z, double length) {
    const int n = static_cast<int>(std::lround(std::fabs(length) / step));
    for (int i = 0; i < n; ++i) {
      const double h = length / n;
      z += rate(d, z + rate(d, z, h) / 2, h);  // midpoint rule
    }
    return z;
  };
  const auto slip = [](double a, double z, double v) { return presliding::slip_rate(a, z, v); };
  const double left = over(slip, 0, 1.5 * d);
  EXPECT_GT(left, 0.9 * d);
  EXPECT_LT(left, d);
  const double turned = over(slip, left, -0.8 * d);
  EXPECT_NEAR(turned, left - 0.8 * d, 1e-6 * d) << "elastic";
  EXPECT_NEAR(over(slip, -left, 3 * d), over(slip, 0, 3 * d), 0.02 * d) << "yields at its distance";
  EXPECT_LT(over(slip, 0, 50 * d), d * (1 + 1e-9));
}

TEST(SaturationWithKnee, LeavesSmallSignalsNeverReachesTheLimitAndIsOdd) {
  EXPECT_EQ(saturation::with_knee(5.0, 2.0, 0.0), 0);
  EXPECT_NEAR(saturation::with_knee(5.0, 4.0, 1e-4), 1e-4, 1e-19);             // (1e-4/5)^4/4 is below rounding
  EXPECT_NEAR(saturation::with_knee(5.0, 2.0, 5.0), 5 / std::sqrt(2), 1e-14);  // u = size: size/2^(1/n)
  EXPECT_NEAR(saturation::with_knee(5.0, 1.0, 15.0), 15.0 / 4, 1e-14);         // n = 1: u/(1 + |u|/size)
  EXPECT_NEAR(saturation::with_knee(5.0, 100.0, 1e6), 5, 1e-12);               // no overflow of 2e5^100
  EXPECT_EQ(saturation::with_knee(5.0, 3.0, -7.0), -saturation::with_knee(5.0, 3.0, 7.0));
}

}  // namespace
}  // namespace hysteron
