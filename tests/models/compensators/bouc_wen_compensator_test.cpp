#include "models/compensators/bouc_wen_compensator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/block/dual.h"
#include "tests/models/golden.h"

namespace hysteron {
namespace {

using bouc_wen::Params;

// Thesis Table 2.1, in V and um.
const Params<double> table{.alpha = 0.6187, .beta = 0.2418, .gamma = 0.0237, .d_p = 1.6126};

TEST(BoucWenCompensator, CommandDrivesTheActuatorToTheWantedDisplacement) {
  // H(H^-1(r)) = r over reversals and minor loops; each move is followed to 1e-10 of its way, 40 um in all.
  for (const double exponent : {1.0, 2.0}) {
    Params<double> p = table;
    p.exponent = exponent;
    double z = 0, actuator = 0, r = 0, u = 0;
    for (const double to : {4.0, 1.0, 3.0, 2.5, 6.0, -5.0, 0.0}) {
      // the actuator sees the curve u(r), not one straight move: small pieces of r
      const int pieces = 400;
      for (int k = 1; k <= pieces; ++k) {
        z = bouc_wen::compensator_after(p, z, (to - r) / pieces);
        const double command = bouc_wen::command(p, r + (to - r) * k / pieces, z);
        actuator = bouc_wen::z_after(p, actuator, command - u);
        u = command;
      }
      r = to;
      EXPECT_NEAR(p.d_p * u - actuator, r, 1e-8);
    }
  }
}

TEST(BoucWenCompensator, RatesFulfilTheLoopTheyWereSolvedFrom) {
  // du = (dr + dz)/d_p and dz by the law from du: the residual is rounding.
  for (const double z : {-1.2, 0.0, 0.8})
    for (const double v : {-2.0, 3.0}) {
      const double dz = bouc_wen::compensator_rate(table, z, v);
      EXPECT_NEAR(bouc_wen::z_rate(table, z, (v + dz) / table.d_p), dz, 1e-14);
    }
}

TEST(BoucWenCompensator, SlopeOfTheThesisParametersStaysPositive) {
  // SPEC 2.3: denominator of Table 2.1 at least 0.63 on the steady loop 0 ... 6 um; its z is in +-1.440073.
  double least = 10;
  for (double z = -1.440073; z <= 1.440073; z += 0.001)
    for (const int d : {-1, 1}) least = std::fmin(least, bouc_wen::displacement_slope(table, z, d));
  EXPECT_NEAR(least, 0.9939 + (0.0237 - 0.2418) * 1.440073, 1e-4);
  EXPECT_GT(least, 0.63);
}

TEST(BoucWenCompensator, ScalingTheRateScalesTheAnswerAlike) {
  for (const double z : {-0.7, 0.0, 0.4})
    for (const double v : {-2.0, 0.0, 1.5})
      EXPECT_NEAR(bouc_wen::compensator_rate(table, z, 3 * v), 3 * bouc_wen::compensator_rate(table, z, v), 1e-15);
}

TEST(BoucWenCompensator, ActuatorMoveIsTheClosedForm) {
  // n = 1: q = z from -0.5 with u rising: exponential of rate beta - gamma up to zero, beta + gamma behind it.
  const double up = table.beta - table.gamma, down = table.beta + table.gamma;
  const double crossing = std::log(1 + up * 0.5 / table.alpha) / up;
  const double expected = table.alpha / down * (1 - std::exp(-down * (3 - crossing)));
  EXPECT_NEAR(bouc_wen::z_after(table, -0.5, 3.0), expected, 1e-9);
  EXPECT_NEAR(bouc_wen::z_after(table, 0.5, -3.0), -expected, 1e-9);
}

TEST(BoucWenCompensator, SaturatedPartStaysAtItsLimit) {
  // z = limit: the rate is rounding, and the path must not search for digits that are not there.
  EXPECT_NEAR(bouc_wen::z_after(table, bouc_wen::limit(table), 100.0), bouc_wen::limit(table), 1e-12);
}

TEST(BoucWenCompensator, DualCarriesTheExactDerivative) {
  const Params<Dual> p{table.alpha, {table.beta, 1}, table.gamma, table.d_p, 1, 1};
  const auto at = [&](double h) {
    Params<double> q = table;
    q.beta += h;
    return bouc_wen::compensator_after(q, -0.3 + 2 * h, 2 - h, 1e-13);
  };
  const double h = 1e-4;
  EXPECT_NEAR(bouc_wen::compensator_after(p, Dual{-0.3, 2}, Dual{2, -1}).rate, (at(h) - at(-h)) / (2 * h), 2e-7);
}

struct Case {
  const char* name;
  double z;  // at the start; the target is the reference minus this
};
class BoucWenCompensatorGolden : public testing::TestWithParam<Case> {};
TEST_P(BoucWenCompensatorGolden, TraceIsReproduced) {
  HYSTERON_NEEDS_GOLDEN(GetParam().name);
  const auto trace = golden::read(GetParam().name);
  const auto& r = trace.at("yr [um]");
  double z = GetParam().z;
  for (std::size_t k = 1; k < r.size(); ++k) {
    z = bouc_wen::compensator_after(table, z, r[k] - r[k - 1]);
    // ten digits of numbers up to 6, slopes up to 1.6 V/um
    ASSERT_NEAR(bouc_wen::command(table, r[k] - GetParam().z, z), trace.at("u [V]")[k], 8e-9) << "row " << k;
    ASSERT_NEAR(z, trace.at("z [um]")[k], 8e-9) << "row " << k;
  }
}
INSTANTIATE_TEST_SUITE_P(Traces, BoucWenCompensatorGolden,
                         testing::Values(Case{"bw_compensator_sine", 0}, Case{"bw_compensator_triangle", 0},
                                         Case{"bw_compensator_steady_sine", -1.440072912},
                                         Case{"bw_compensator_steady_triangle", -1.440072912}),
                         [](const auto& made) { return std::string(made.param.name); });

}  // namespace
}  // namespace hysteron
