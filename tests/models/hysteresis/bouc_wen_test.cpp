#include "models/hysteresis/bouc_wen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/block/dual.h"
#include "tests/models/golden.h"

namespace hysteron::bouc_wen {
namespace {

// Thesis Table 2.1, in V and um.
const Params<double> table{.alpha = 0.6187, .beta = 0.2418, .gamma = 0.0237, .d_p = 1.6126};

/// z after a straight move of the input from u0 to u1: Runge-Kutta over the path (the law is rate independent, so the
/// move may last one second).
double move(const Params<double>& p, double z, double u0, double u1, int steps) {
  const double h = 1.0 / steps, v = u1 - u0;
  for (int i = 0; i < steps; ++i) {
    const double k1 = z_rate(p, z, v);
    const double k2 = z_rate(p, z + h / 2 * k1, v);
    const double k3 = z_rate(p, z + h / 2 * k2, v);
    const double k4 = z_rate(p, z + h * k3, v);
    z += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return z;
}

TEST(BoucWenModel, LoopSaturatesAtTheClosedFormLimit) {
  // dz/du = 0 for rising u and z > 0 gives z_max = alpha/(beta + gamma).
  const Params<double> p{.alpha = 1, .beta = 3, .gamma = 1};
  EXPECT_EQ(bouc_wen::limit(p), 0.25);
  EXPECT_NEAR(z_rate(p, 0.25, 1.0), 0.0, 1e-15);
}

TEST(BoucWenModel, LimitAlsoHoldsForOtherExponentsInTheirScale) {
  // alpha = (beta + gamma) z (z/scale)^(n-1).
  Params<double> p{.alpha = 1.0, .beta = 3.0, .gamma = 1.0, .exponent = 2};
  p.scale = 0.1;
  EXPECT_NEAR(bouc_wen::limit(p), std::sqrt(0.25 * 0.1), 1e-15);
  EXPECT_NEAR(z_rate(p, bouc_wen::limit(p), 1.0), 0.0, 1e-14);
}

TEST(BoucWenModel, ScalingTheRateScalesTheAnswerAlike) {
  for (const double z : {-0.7, 0.0, 0.4})
    for (const double v : {-2.0, 1.5}) EXPECT_NEAR(z_rate(table, z, 3 * v), 3 * z_rate(table, z, v), 1e-15);
}

TEST(BoucWenModel, VirginCurveIsThatOfTheThesisParameters) {
  // SPEC 2.3, oracle for Table 2.1 at u = 1 ... 6 V, six decimals.
  const double expected[] = {1.069222, 2.265147, 3.558231, 4.925820, 6.350539, 7.819068};
  double z = 0;
  for (int u = 1; u <= 6; ++u) {
    z = move(table, z, u - 1, u, 200);
    EXPECT_NEAR(table.d_p * u - z, expected[u - 1], 6e-7);
  }
}

TEST(BoucWenModel, RisingBranchIsTheExponentialOfTheClosedForm) {
  // n = 1, z >= 0, u rising: z = z_max (1 - exp(-(beta + gamma) u)).
  const double z = move(table, 0, 0, 3, 300);
  EXPECT_NEAR(z, bouc_wen::limit(table) * (1 - std::exp(-(table.beta + table.gamma) * 3)), 1e-11);
}

TEST(BoucWenModel, SteadyLoopHasTheEndsOfTheThesisParameters) {
  // SPEC 2.3: steady 0..6 V loop has z = -/+ 1.529441.
  double z = 0;
  for (int cycle = 0; cycle < 30; ++cycle) {
    z = move(table, z, 0, 6, 400);
    if (cycle == 29) {
      EXPECT_NEAR(z, 1.529441, 6e-7);
    }
    z = move(table, z, 6, 0, 400);
  }
  EXPECT_NEAR(z, -1.529441, 6e-7);
}

TEST(BoucWenModel, DualCarriesTheExactDerivative) {
  Params<double> p = table;
  p.exponent = 2;
  const Params<Dual> pd{p.alpha, p.beta, p.gamma, p.d_p, p.exponent, p.scale};
  const double z = 0.4, v = -1.3, dz = 0.7, dv = 2.1, h = 1e-6;
  const double difference = (z_rate(p, z + h * dz, v + h * dv) - z_rate(p, z - h * dz, v - h * dv)) / (2 * h);
  EXPECT_NEAR(z_rate(pd, Dual{z, dz}, Dual{v, dv}).rate, difference, 1e-9);  // 1e-16/h and h^2
}

struct Case {
  const char* name;
  double exponent;
};
class BoucWenGolden : public testing::TestWithParam<Case> {};
TEST_P(BoucWenGolden, TraceIsReproduced) {
  HYSTERON_NEEDS_GOLDEN(GetParam().name);
  const auto trace = golden::read(GetParam().name);
  Params<double> p = table;
  p.exponent = GetParam().exponent;
  const auto& u = trace.at("u [V]");
  double z = 0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    if (k > 0) z = move(p, z, u[k - 1], u[k], 40);  // the kink at z = 0 costs h^2: 1e-8 with 4 steps
    // ten digits of u (5e-10 V, slope up to 1.6 um/V) and of y (5e-10 um)
    ASSERT_NEAR(p.d_p * u[k] - z, trace.at("y [um]")[k], 2e-9) << "row " << k;
  }
}
INSTANTIATE_TEST_SUITE_P(Traces, BoucWenGolden,
                         testing::Values(Case{"bw_forward_sine", 1}, Case{"bw_forward_triangle", 1},
                                         Case{"bw_forward_n2_sine", 2}),
                         [](const auto& made) { return std::string(made.param.name); });

TEST(BoucWenModel, IsBoundedExactlyWhereCyclesLeaveItFinite) {
  // Cycles between -10 and 10 V. The largest limit of a bounded set here is alpha/(beta + gamma) = 10; what is not
  // bounded grows by exp(0.1 * 20) = 7 a cycle at least, or hardens to (exp(0.2 * 19) - 1)/0.2 = 220 in one stroke.
  int bounded = 0;
  for (const double alpha : {-1.0, 1.0})
    for (const double beta : {-0.5, -0.1, 0.0, 0.1, 0.5})
      for (const double gamma : {-0.7, -0.3, 0.0, 0.3, 0.7}) {
        const Params<double> p{.alpha = alpha, .beta = beta, .gamma = gamma};
        double z = 0, most = 0;
        for (int k = 0; k < 400 && most < 1e6; ++k)
          for (const double way : {10.0, -20.0, 10.0})
            most = std::max(most, std::abs(z = bouc_wen::z_in_closed_form(p, z, way)));
        bounded += bouc_wen::is_bounded(p) ? 1 : 0;
        EXPECT_EQ(bouc_wen::is_bounded(p), most < 20) << alpha << " " << beta << " " << gamma << ": " << most;
      }
  EXPECT_EQ(bounded, 20);
}

TEST(BoucWenModel, AWayOfAnyLengthInClosedForm) {
  // beta = gamma and beta < gamma bend nothing on one side; a negative slope turns the loop over.
  for (const auto [alpha, beta, gamma] :
       {std::array{0.6187, 0.2418, 0.0237}, std::array{0.6, 0.2, 0.2}, std::array{0.6, 0.1, 0.3},
        std::array{0.6, 0.3, -0.2}, std::array{-0.6, 0.3, 0.1}, std::array{0.0, 0.3, 0.1}}) {
    const Params<double> p{.alpha = alpha, .beta = beta, .gamma = gamma};
    for (const double z : {-1.7, -0.2, 0.0, 0.4, 1.9})
      for (const double way : {-8.0, -0.3, 0.01, 1.0, 20.0})
        // The corner at z = 0 is met inside one of 40 000 steps: their length squared times the change of slope.
        EXPECT_NEAR(bouc_wen::z_in_closed_form(p, z, way), move(p, z, 0, way, 40000), 2e-8)
            << alpha << " " << z << " " << way;
  }
  EXPECT_EQ(bouc_wen::z_in_closed_form(table, 0.3, 0), 0.3);
}

}  // namespace
}  // namespace hysteron::bouc_wen
