// Observers and controllers that learn: closed forms from instant to instant.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/blocks/bench.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using bench::Bench;
using bench::Numbers;

const Bench::Values double_integrator{{"a", {1, 0.1, 0, 1}}, {"a columns", {2}}, {"b", {0.005, 0.1}},
                                      {"b columns", {1}},    {"c", {1, 0}},      {"c columns", {2}},
                                      {"period", {0.1}}};

TEST(ObserverBlock, FindsTheStatesInAsManySamplesAsThereAreWithADeadbeatGain) {
  // Eigenvalues of A - L C both zero: L = (2, 10) for a period of 0.1 s. The plant is elsewhere by (3, -2).
  auto values = double_integrator;
  values["gain"] = {2, 10};
  values["gain columns"] = {1};
  Bench b("observer", values, 2);
  EXPECT_FALSE(b.sizes.feedthrough);
  Numbers estimate = b.initial_states(), plant{3, -2};
  for (int k = 0; k < 4; ++k) {
    const double u = 0.7 - k;
    estimate = b.update({u, plant[0]}, estimate);
    plant = {plant[0] + 0.1 * plant[1] + 0.005 * u, plant[1] + 0.1 * u};
  }
  EXPECT_NEAR(estimate[0], plant[0], 1e-13);
  EXPECT_NEAR(estimate[1], plant[1], 1e-13);
  EXPECT_EQ(b.output(0, {0, 0}, estimate), estimate);
}

TEST(KalmanFilterBlock, IsTheObserverWithItsGain) {
  // Random walk: gain (P/(P + R)) with P = (Q + sqrt(Q^2 + 4 Q R))/2.
  const double q = 0.3, r = 2, p = (q + std::sqrt(q * q + 4 * q * r)) / 2;
  Bench b("kalman_filter",
          {{"a", {1}},
           {"a columns", {1}},
           {"b", {0.5}},
           {"b columns", {1}},
           {"c", {1}},
           {"c columns", {1}},
           {"process_noise", {q}},
           {"process_noise columns", {1}},
           {"measurement_noise", {r}},
           {"measurement_noise columns", {1}},
           {"period", {1}}},
          2);
  EXPECT_EQ(b.check(), "");
  EXPECT_NEAR(b.update({3, 5}, {4})[0], 4 + 0.5 * 3 + p / (p + r) * (5 - 4), 1e-13);
}

TEST(DisturbanceObserverBlock, SeesAConstantForceAsItsClosedFormSays) {
  const double inertia = 0.4, period = 1e-3, corner = 30, share = 1 - std::exp(-2 * M_PI * corner * period), force = 7;
  for (const double use : {0.0, 1.0}) {
    const Bench b("disturbance_observer",
                  {{"inertia", {inertia}}, {"corner", {corner}}, {"use", {use}}, {"period", {period}}});
    Numbers z = b.initial_states();
    double speed = 0;
    for (int k = 0; k < 50; ++k) {
      const double command = std::sin(0.3 * k), seen = force * (1 - std::pow(1 - share, k));
      const Numbers y = b.output(0, {command, speed}, z);
      EXPECT_NEAR(y[1], seen, 1e-11) << k;
      EXPECT_NEAR(y[0], use == 0 ? command - seen : command, 1e-11) << k;
      z = b.update({command, speed}, z);
      speed += period * (y[0] + force) / inertia;
    }
  }
}

TEST(DisturbanceObserverBlock, LetsAMassMoveAsIfThereWereNoLoad) {
  using tools::block;
  const auto program = tools::compiled(tools::diagram(
      {{"wanted", block("constant", {{"value", "2 N"}})},
       {"load", block("constant", {{"value", "5 N"}})},
       {"d", block("disturbance_observer", {{"inertia", "0.4 kg"}, {"corner", "30 Hz"}, {"period", "1 ms"}},
                   {"wanted", "body.velocity"})},
       {"all", block("sum", {{"signs", "++"}}, {"d.y", "load"})},
       {"body", block("mass_spring_damper", {{"mass", "0.4 kg"}, {"stiffness", "0 N/m"}}, {"all"})}},
      {"d.disturbance", "body.velocity"}));
  SimulateOptions options;
  options.instants = {0.1995, 0.2995};
  const auto traces = simulate(*program, start(*program), options);
  EXPECT_NEAR(traces.values[0][1], 5, 1e-5);  // 200 samples: exp(-37) of it is left
  EXPECT_NEAR((traces.values[1][1] - traces.values[1][0]) / 0.1, 2 / 0.4, 1e-4);
}

TEST(RepetitiveControllerBlock, RepeatsWhatWasWrongEveryCycle) {
  const Bench b("repetitive_controller",
                {{"samples", {5}}, {"gain", {2}}, {"lead", {1}}, {"keep", {0.5}}, {"period", {1}}});
  std::vector<Numbers> u(16, Numbers{0});
  u[0] = {1};
  const Numbers y = b.response(u, 1);
  for (std::size_t k = 0; k < y.size(); ++k)
    EXPECT_NEAR(y[k], k == 4 ? 1 : k == 9 ? 0.5 : k == 14 ? 0.25 : 0, 1e-15) << k;
}

TEST(RepetitiveControllerBlock, SmoothsWithoutDelay) {
  const Bench b("repetitive_controller", {{"samples", {6}}, {"smoothing", {1}}, {"period", {1}}});
  std::vector<Numbers> u(12, Numbers{0});
  u[1] = {1};
  const Numbers y = b.response(u, 1);
  EXPECT_NEAR(y[6], 0.25, 1e-15);
  EXPECT_NEAR(y[7], 0.5, 1e-15);
  EXPECT_NEAR(y[8], 0.25, 1e-15);
}

TEST(RepetitiveControllerBlock, LearnsAPeriodicDisturbanceAway) {
  // A plant that answers one sample later, y_(k+1) = u_k + d_(k+1): with lead 1 all is right behind the first cycle.
  const int n = 8;
  Bench b("repetitive_controller", {{"samples", {double(n)}}, {"lead", {1}}, {"period", {1}}});
  Numbers line = b.initial_states();
  double answer = 0;
  for (int k = 0; k < 5 * n; ++k) {
    const double error = -(answer + std::sin(2 * M_PI * k / n) + 0.3 * std::cos(6 * M_PI * k / n));
    if (k > n) {
      EXPECT_NEAR(error, 0, 1e-13) << k;
    }
    answer = b.output(0, {error}, line)[0];
    line = b.update({error}, line);
  }
}

}  // namespace
}  // namespace hysteron
