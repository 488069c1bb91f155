#include "models/hysteresis/coupled_tapi.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "models/hysteresis/prandtl_ishlinskii.h"
#include "tests/models/golden.h"

namespace hysteron::coupled_tapi {
namespace {

using Numbers = std::vector<double>;

/// The reference set of SPEC 5.3, V and um; its rows are inputs, ours are outputs. Plant F1: operators weakened.
struct Reference {
  Numbers r, c, p_s, beta, a;
  explicit Reference(double weakened = 1) {
    const double cd[3][3] = {{.62, -.055, .040}, {.048, .57, -.060}, {-.045, .052, .66}};
    const double sh[9] = {1, .22, .13, .10, .09, .08, .07, .07, .07};
    const double ps[3][3] = {{.9, -.07, .06}, {.06, .8, -.08}, {-.05, .07, 1.0}};
    const double be[3][3] = {{1.8, 1.6, 1.7}, {1.7, 1.9, 1.6}, {1.6, 1.7, 1.8}};
    for (int k = 0; k < 9; ++k) r.push_back(0.8 * k);
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 9; ++k) c.push_back(cd[i][j] * sh[k] * (k == 0 ? 1 : weakened));
        p_s.push_back(3 * ps[i][j]);
        beta.push_back(be[i][j]);
        a.push_back(0.0170);
      }
  }
  coupled_tapi::Params<double> law() const { return {r, c, p_s, beta, a, 623}; }
  void move(Numbers& memory, const Numbers& u) const {
    for (std::size_t i = 0; i < u.size(); ++i)
      for (std::size_t k = 0; k < r.size(); ++k)
        memory[i * r.size() + k] = play::follow_one_sided(r[k], memory[i * r.size() + k], u[i]);
  }
};

class CoupledGolden : public testing::TestWithParam<int> {};

TEST_P(CoupledGolden, OpenLoopIsReproduced) {
  const auto name = fmt::format("fpi_open_T{}", GetParam());
  HYSTERON_NEEDS_GOLDEN(name);
  const auto trace = golden::read(name);
  const Reference ref;
  for (std::size_t i = 0; i < 3; ++i) {
    Numbers memory(27, 0.0);
    for (std::size_t k = 0; k < trace.at("u_i [V]").size(); ++k) {
      Numbers u(3, 0.0), y(3);
      u[i] = trace.at("u_i [V]")[k];
      ref.move(memory, u);
      coupled_tapi::outputs<double>(ref.law(), memory, u, GetParam() + 273.15, y.data());
      for (std::size_t j = 0; j < 3; ++j)  // ten digits of u up to 8 V with a slope up to 1.6 um/V, and of y
        ASSERT_NEAR(y[j], trace.at(fmt::format("y{}(u{}) [um]", j + 1, i + 1))[k], 2e-8) << k;
    }
  }
}

TEST_P(CoupledGolden, CompensatorIsReproduced) {
  const auto name = fmt::format("fpi_compensator_T{}", GetParam());
  HYSTERON_NEEDS_GOLDEN(name);
  const auto trace = golden::read(name);
  const Reference ref;
  for (std::size_t j = 0; j < 3; ++j) {
    Numbers memory(27, 0.0), u(3, 0.0);
    const auto& wanted = trace.at(fmt::format("yd{} [um]", j + 1));
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      Numbers y(3, 0.0);
      y[j] = wanted[k];
      // The contraction between axes is below 0.3 here: 30 sweeps would do from any start.
      EXPECT_LE(
          coupled_tapi::input_for(ref.law(), memory, y, GetParam() + 273.15, coupled_tapi::Axes::coupled, u.data()),
          30);
      ref.move(memory, u);
      for (std::size_t i = 0; i < 3; ++i)  // ten digits of y up to 8 um over a slope of 0.57 um/V
        ASSERT_NEAR(u[i], trace.at(fmt::format("u{} for yd{} [V]", i + 1, j + 1))[k], 2e-8) << k;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Temperatures, CoupledGolden, testing::Values(23, 30, 35));

/// Largest error over all axes where axis after axis follows 4 (1 + sin) um, as SPEC 5.3 does.
double worst(double plant_celsius, double model_celsius, coupled_tapi::Axes axes, bool off_axis_only = false) {
  const Reference model, plant(1 - 0.0015 * (plant_celsius - 23));
  double most = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    Numbers memory(27, 0.0), own(27, 0.0), u(3, 0.0), y(3);
    for (int k = 0; k < 100; ++k) {
      Numbers wanted(3, 0.0);
      wanted[j] = 4 * (1 + std::sin(2 * std::numbers::pi * 0.02 * k - std::numbers::pi / 2));
      coupled_tapi::input_for(model.law(), memory, wanted, model_celsius + 273.15, axes, u.data());
      model.move(memory, u);
      plant.move(own, u);
      coupled_tapi::outputs<double>(plant.law(), own, u, plant_celsius + 273.15, y.data());
      for (std::size_t i = 0; i < 3; ++i)
        if (!off_axis_only || i != j) most = std::max(most, std::fabs(y[i] - wanted[i]));
    }
  }
  return most;
}

TEST(CoupledTapi, CompensatorKeepsThePlantBelowAFifthOfAMicrometre) {
  // Claim C5-08; errors as an independent program found them, told to 1 nm.
  EXPECT_LT(worst(23, 23, Axes::coupled), 1e-12);
  EXPECT_NEAR(worst(30, 30, Axes::coupled), 0.027, 0.001);
  EXPECT_NEAR(worst(35, 35, Axes::coupled), 0.046, 0.001);
  EXPECT_NEAR(worst(30, 23, Axes::coupled), 0.064, 0.001);
  EXPECT_NEAR(worst(35, 23, Axes::coupled), 0.109, 0.001);
}

TEST(CoupledTapi, SingleAxisCompensatorsLeaveTheCoupling) {
  // Claim C5-09. Where axis 2 alone reaches 8 um (8.35695 V), its branch to axis 3 stands at -0.85265 um, by a root
  // finder of another program; the coupled compensator leaves rounding.
  const double left = worst(23, 23, coupled_tapi::Axes::single, true);
  EXPECT_NEAR(left, 0.8526494, 1e-7);
  EXPECT_LT(worst(23, 23, coupled_tapi::Axes::coupled, true), 1e-12);
}

TEST(CoupledTapi, SaturationIsInUnitsOfTheOutputUnlikeThatOfOneAxis) {
  // E-44: c_1 P_s tanh in 5.15 (P_s in V), P_s tanh in 5.26 (P_s in um): the same curve for P_s(5.26) = c_1 P_s(5.15);
  // with one number in both they differ by the factor c_1 = 0.62 um/V.
  const Reference ref;
  const Numbers rest(9, 0.0);
  const auto law = ref.law();
  const double t = 296.15, u = 0.5;  // below the first threshold: the saturating and the linear part alone
  const double here = coupled_tapi::branch_at<double>(law, 0, 0, rest, u, t);
  EXPECT_NEAR(here, tapi::output_at<double>(law.law(0, 0), law.thresholds, law.branch(0, 0), rest, u, t), 1e-15);
  auto one_number = law.law(0, 0);
  one_number.p_s = ref.p_s[0];
  const double mixed = tapi::output_at<double>(one_number, law.thresholds, law.branch(0, 0), rest, u, t);
  EXPECT_NEAR((mixed - 0.62 * u) / (here - 0.62 * u), 0.62, 1e-12);
}

TEST(CoupledTapi, SaysSoWhereAxesHangOnEachOtherTooMuch) {
  Reference ref;
  for (std::size_t at = 0; at < 9; ++at)
    if (at % 4 != 0)
      for (std::size_t k = 0; k < 9; ++k) ref.c[9 * at + k] = 2;
  Numbers memory(27, 0.0), u(3, 0.0);
  coupled_tapi::input_for(ref.law(), memory, Numbers{1, 2, 3}, 296, coupled_tapi::Axes::coupled, u.data());
  EXPECT_TRUE(std::isnan(u[0]));
}

TEST(CoupledTapi, SlopeIsTheDifferenceQuotient) {
  const Reference ref;
  Numbers memory(27, 0.0);
  ref.move(memory, {7.3, 5, 6});
  ref.move(memory, {3.1, 2, 4});
  for (const double u : {2.9, 3.4, 7.9})
    for (std::size_t j = 0; j < 3; ++j) {
      const double h = 1e-6;
      const auto y = [&](double at) {
        return coupled_tapi::branch_at<double>(ref.law(), j, 0,
                                               coupled_tapi::operators_of<double>(ref.law(), memory, 0), at, 300);
      };
      EXPECT_NEAR(
          coupled_tapi::slope_at(ref.law(), j, 0, coupled_tapi::operators_of<double>(ref.law(), memory, 0), u, 300),
          (y(u + h) - y(u - h)) / (2 * h), 1e-8);
    }
}

}  // namespace
}  // namespace hysteron::coupled_tapi
