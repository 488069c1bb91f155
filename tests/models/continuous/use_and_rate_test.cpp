// Laws of ageing, of what follows late, and of the mains: closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "models/continuous/ageing.h"
#include "models/disturbances/mains.h"
#include "models/hysteresis/late_hysteresis.h"

namespace hysteron {
namespace {

TEST(AgeingModel, TakesItsShareInEveryDecadeBeyondTheFirst) {
  EXPECT_EQ(ageing::gain(0.02, 100.0, 0.0), 1);
  EXPECT_NEAR(ageing::gain(0.02, 100.0, 900.0), 0.98, 1e-15);   // 1 + 900/100 = 10
  EXPECT_NEAR(ageing::gain(0.02, 100.0, 9900.0), 0.96, 1e-15);  // 100
  EXPECT_EQ(ageing::gain(0.0, 100.0, 1e9), 1) << "neutral";
}

TEST(AgeingModel, CountsHalfACycleForEveryTurn) {
  ageing::Count<double> c;
  // 0 1 0 1 0: turns at 1, 0, 1; the last way has not turned yet.
  for (int k = 0; k <= 400; ++k) c = ageing::count<double>(c, 0.1, 0.5 * (1 - std::cos(std::numbers::pi * k / 100)));
  EXPECT_EQ(c.cycles, 1.5);
}

TEST(AgeingModel, DoesNotCountWhatIsSmallerThanTheSwing) {
  ageing::Count<double> c;
  for (int k = 0; k <= 400; ++k) c = ageing::count<double>(c, 0.1, 1 + 0.04 * std::sin(k));
  EXPECT_EQ(c.cycles, 0);
  ageing::Count<double> none;
  for (int k = 0; k <= 400; ++k) none = ageing::count<double>(none, 0, 100 * std::sin(k));
  EXPECT_EQ(none.cycles, 0) << "swing 0 counts nothing";
}

TEST(LateModel, FollowsARampByItsTimeConstantLate) {
  // H = 3 t from rest: h = 3 (t - tau (1 - exp(-t/tau))).
  for (const double t : {0.01, 0.3, 2.0})
    EXPECT_NEAR(late::after_ramp(0.2, 0, 0, 3 * t, t), 3 * (t - 0.2 * (1 - std::exp(-t / 0.2))), 1e-14);
}

TEST(LateModel, ARampMayBeCutAnywhereAndNoTimeChangesNothing) {
  const double half = late::after_ramp(0.2, 0.7, 1, 1.3, 0.1);
  EXPECT_NEAR(late::after_ramp(0.2, half, 1.3, 1.9, 0.2), late::after_ramp(0.2, 0.7, 1, 1.9, 0.3), 1e-15);
  EXPECT_EQ(late::after_ramp(0.2, 0.7, 1, 5, 0), 0.7);
}

TEST(LateModel, AnOperatorThatIsTakenAlongWithinARowIsFollowedAsBySmallSteps) {
  // A play of 0.4 at w = 0 while u goes from 0.1 to 1.1 in 2 s: it stands still for 0.6 s, then goes with u.
  const double tau = 0.3, ahead = 0.4;
  double h = 0.2;
  const int steps = 2000000;
  for (int i = 0; i < steps; ++i) {
    const double u = 0.1 + (i + 0.5) / steps, w = std::max(u - 0.4, 0.0);
    h += 2.0 / steps / tau * (w - ahead * u - h);
  }
  // Steps of 1e-6 s: half a step times the rate, below 1, over tau.
  EXPECT_NEAR(late::after_row(tau, 0.2, ahead, 0, 0.7, 0.1, 1.1, 2, std::exp(-2 / tau)), h, 2e-6);
}

TEST(MainsModel, MeanSquareIsHalfTheSquaresOfTheAmplitudes) {
  const std::vector<double> cosine{0.3, 0, -0.1}, sine{0.4, 0.2, 0};
  double squares = 0;
  const int n = 1000;  // over one period a sum of equidistant rows is exact
  for (int k = 0; k < n; ++k) {
    const double y = mains::hum<double>(50, cosine, sine, 0.02 * k / n);
    squares += y * y / n;
  }
  EXPECT_NEAR(squares, 0.5 * (0.25 + 0.04 + 0.01), 1e-14);
}

}  // namespace
}  // namespace hysteron
