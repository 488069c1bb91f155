#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/block/dual.h"
#include "models/random.h"
#include "models/sampled/delay_line.h"
#include "models/sampled/discrete_filter.h"
#include "models/sampled/quantizer.h"
#include "models/sampled/sampled_pid.h"
#include "tests/models/golden.h"

namespace hysteron {
namespace {

using Numbers = std::vector<double>;
using sampled_pid::AntiWindup;
using sampled_pid::Rule;

struct Filter {
  Numbers b, a;
  std::size_t delay = 0;
  Numbers w = Numbers(discrete_filter::states(b.size() + delay, a.size()), 0.0);
  discrete_filter::Coefficients<double> coefficients() const { return {b, a, delay}; }
  double operator()(double u) {
    const double y = discrete_filter::output<double>(coefficients(), w, u);
    Numbers after(w.size());
    discrete_filter::update<double>(coefficients(), w, u, after.data());
    w = after;
    return y;
  }
};

TEST(DiscreteFilterModel, OutputIsTheDifferenceEquation) {
  // a_0 y_k = sum b_i u_(k-i) - sum_{i>0} a_i y_(k-i), also where one list is longer than the other.
  const std::pair<Numbers, Numbers> cases[] = {
      {{1, -0.3, 0.2}, {2, -0.5, 0.1, 0.05}}, {{0.5, 0.1, 0.7, 0.2}, {1, 0.4}}, {{3}, {1}}, {{0, 1}, {1, -1}}};
  for (const auto& [b, a] : cases) {
    Filter filter{b, a};
    Numbers u, y;
    for (std::uint64_t k = 0; k < 50; ++k) {
      u.push_back(random::normal(1, 0, k));
      double sum = 0;
      for (std::size_t i = 0; i < b.size() && i <= k; ++i) sum += b[i] * u[k - i];
      for (std::size_t i = 1; i < a.size() && i <= k; ++i) sum -= a[i] * y[k - i];
      y.push_back(sum / a[0]);
      ASSERT_NEAR(filter(u.back()), y.back(), 1e-12);
    }
  }
}

TEST(DiscreteFilterModel, DelayIsTheSameAnswerLater) {
  for (const std::size_t delay : {1u, 3u}) {
    Filter now{{1, -0.3, 0.2}, {2, -0.5, 0.1, 0.05}}, late{now.b, now.a, delay}, padded{Numbers(delay, 0.0), now.a};
    padded.b.insert(padded.b.end(), now.b.begin(), now.b.end());
    padded.w.assign(discrete_filter::states(padded.b.size(), padded.a.size()), 0.0);
    for (std::uint64_t k = 0; k < 30; ++k) {
      const double u = random::normal(8, 0, k);
      ASSERT_EQ(late(u), padded(u));
    }
    discrete_filter::rest(late.coefficients(), 3.0, late.w);
    for (int k = 0; k < 5; ++k) EXPECT_NEAR(late(3), 3 * 0.9 / 1.65, 1e-15);
  }
}

TEST(DiscreteFilterModel, FirstOrderStepIsAGeometricSeries) {
  Filter filter{{0.1}, {1, -0.9}};
  for (int k = 0; k < 40; ++k) EXPECT_NEAR(filter(1), 1 - std::pow(0.9, k + 1), 1e-15);
}

TEST(DiscreteFilterModel, AtRestTheOutputStays) {
  Filter filter{{1, -0.3, 0.2}, {2, -0.5, 0.1, 0.05}};
  discrete_filter::rest(filter.coefficients(), 3.0, filter.w);
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(filter(3), 3 * 0.9 / 1.65, 1e-15);
  Filter sum{{0, 1}, {1, -1}};
  discrete_filter::rest(sum.coefficients(), 1.0, sum.w);
  EXPECT_TRUE(std::isnan(sum.w[0]));
}

/// Of an error alone.
sampled_pid::Step<double> step_of(Rule rule, AntiWindup windup, const sampled_pid::Params<double>& p,
                                  const sampled_pid::State<double>& s, double error) {
  return sampled_pid::step(rule, windup, p, s, {error, 0.0, error});
}

TEST(SampledPidModel, RulesIntegrateAsTheyAreNamed) {
  // e = k h: forward sums e_0 ... e_(k-1), backward e_1 ... e_k, trapezoids are exact: t^2/2.
  const double h = 0.1;
  for (const Rule rule : {Rule::forward, Rule::backward, Rule::trapezoidal}) {
    const sampled_pid::Params<double> p{.gains = {.kp = 0, .ki = 1}, .lower = -100, .upper = 100, .period = h};
    sampled_pid::State<double> s;
    for (int k = 0; k <= 10; ++k) {
      const auto step = step_of(rule, AntiWindup::none, p, s, k * h);
      s = step.after;
      const double exact = k * h * k * h / 2, half = k * h * h / 2;
      EXPECT_NEAR(step.command,
                  rule == Rule::forward    ? exact - half
                  : rule == Rule::backward ? exact + half
                                           : exact,
                  1e-15);
    }
  }
}

TEST(SampledPidModel, DerivativeOfARampIsItsSlopeBehindTheFilter) {
  // D_k = kd s (1 - q^k), q = T_f/(T_f + T_s), for e = s k T_s.
  const sampled_pid::Params<double> p{
      .gains = {.kp = 0, .kd = 2}, .filter = 0.3, .lower = -100, .upper = 100, .period = 0.1};
  sampled_pid::State<double> s;
  for (int k = 0; k < 20; ++k) {
    const auto step = step_of(Rule::forward, AntiWindup::none, p, s, 5 * 0.1 * k);
    s = step.after;
    EXPECT_NEAR(step.command, 10 * (1 - std::pow(0.75, k)), 1e-14);
  }
}

TEST(SampledPidModel, ClampingStopsTheIntegralAtTheLimitAndReleasesItAtOnce) {
  const sampled_pid::Params<double> p{.gains = {.kp = 1, .ki = 1}, .lower = -2, .upper = 2, .period = 1};
  sampled_pid::State<double> wound, clamped;
  for (int k = 0; k < 50; ++k) {
    wound = step_of(Rule::forward, AntiWindup::none, p, wound, 1.0).after;
    clamped = step_of(Rule::forward, AntiWindup::clamping, p, clamped, 1.0).after;
  }
  EXPECT_EQ(wound.integral, 50);
  EXPECT_EQ(clamped.integral, 2);  // 1 + 2 is beyond the limit: the third second adds nothing
  EXPECT_EQ(step_of(Rule::forward, AntiWindup::none, p, wound, -1.0).command, 2);
  EXPECT_EQ(step_of(Rule::forward, AntiWindup::clamping, p, clamped, -1.0).command, 1);
  EXPECT_EQ(step_of(Rule::forward, AntiWindup::clamping, p, clamped, -1.0).after.integral, 1);
}

TEST(SampledPidModel, BackCalculationSettlesWhereItsLeakBalancesTheError) {
  // Steady: ki T e = T/T_t (raw - upper), raw = kp e + I: I = upper - kp e + ki T_t e = 2 - 1 + 0.5.
  const sampled_pid::Params<double> p{
      .gains = {.kp = 1, .ki = 1}, .lower = -2, .upper = 2, .tracking_time = 0.5, .period = 0.1};
  sampled_pid::State<double> s;
  for (int k = 0; k < 300; ++k) s = step_of(Rule::forward, AntiWindup::back_calculation, p, s, 1.0).after;
  EXPECT_NEAR(s.integral, 1.5, 1e-14);
}

TEST(SampledPidModel, WithinItsLimitsNoAntiWindupActs) {
  const sampled_pid::Params<double> p{.gains = {.kp = 1, .ki = 3}, .lower = -9, .upper = 9, .period = 0.1};
  sampled_pid::State<double> a, b, c;
  for (std::uint64_t k = 0; k < 50; ++k) {
    const double e = 0.3 * random::normal(2, 0, k);
    a = step_of(Rule::backward, AntiWindup::none, p, a, e).after;
    b = step_of(Rule::backward, AntiWindup::clamping, p, b, e).after;
    c = step_of(Rule::backward, AntiWindup::back_calculation, p, c, e).after;
    ASSERT_EQ(a.integral, b.integral);
    ASSERT_EQ(a.integral, c.integral);
  }
}

struct LoopCase {
  const char* name;
  double kp, ki;
};
class SampledPidGolden : public testing::TestWithParam<LoopCase> {};
TEST_P(SampledPidGolden, CommandOfTheThesisLoopIsReproduced) {
  HYSTERON_NEEDS_GOLDEN(GetParam().name);
  const auto trace = golden::read(GetParam().name);
  const sampled_pid::Params<double> p{
      .gains = {.kp = GetParam().kp, .ki = GetParam().ki}, .lower = -100, .upper = 100, .period = 1e-4};
  sampled_pid::State<double> s;
  for (std::size_t k = 0; k < trace.at("u [V]").size(); ++k) {
    const auto step = step_of(Rule::forward, AntiWindup::clamping, p, s, trace.at("r [um]")[k] - trace.at("y [um]")[k]);
    s = step.after;
    // r and y have ten digits (up to 6e-9 together): 1.2 of that directly, 0.7 of it each step in the integral, as a
    // random walk of 2000 steps at most 0.7 2e-9 sqrt(2000) 3 = 2e-7
    ASSERT_NEAR(step.command, trace.at("u [V]")[k], 2e-7) << "row " << k;
  }
}
INSTANTIATE_TEST_SUITE_P(Traces, SampledPidGolden,
                         testing::Values(LoopCase{"loop1_sine_sampled", 1.207, 7009},
                                         LoopCase{"loop2_sine_sampled", 0.5265, 1521}),
                         [](const auto& made) { return std::string(made.param.name); });

TEST(QuantizerModel, SixteenBitsOfTenVoltAreTheCodesOfAConverter) {
  const double q = 20.0 / 65536;
  EXPECT_EQ(quantizer::step(16.0, -10.0, 10.0), q);
  EXPECT_EQ(quantizer::quantize(16.0, -10.0, 10.0, 0.0), 0);
  EXPECT_EQ(quantizer::quantize(16.0, -10.0, 10.0, 1.49 * q), q);
  EXPECT_EQ(quantizer::quantize(16.0, -10.0, 10.0, 1.5 * q), 2 * q);
  EXPECT_EQ(quantizer::quantize(16.0, -10.0, 10.0, 11.0), 10 - q);
  EXPECT_EQ(quantizer::quantize(16.0, -10.0, 10.0, -11.0), -10);
}

TEST(QuantizerModel, ErrorIsAtMostHalfAStepAndLevelsAreKept) {
  const double q = quantizer::step(8.0, -1.0, 3.0);
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const double u = -1 + (4 - q) * random::uniform(5, 0, k);
    const double y = quantizer::quantize(8.0, -1.0, 3.0, u);
    ASSERT_LE(std::fabs(y - u), q / 2);
    ASSERT_EQ(quantizer::quantize(8.0, -1.0, 3.0, y), y);
  }
  EXPECT_EQ(quantizer::quantize(Dual{8.0}, Dual{-1.0}, Dual{3.0}, Dual{0.3, 5.0}).rate, 0);
}

TEST(DelayLineModel, EachValueComesOutAfterItsCount) {
  for (const std::size_t n : {0u, 1u, 3u}) {
    Numbers line(n, -1.0);
    for (int k = 0; k < 12; ++k) {
      EXPECT_EQ(delay_line::output<double>(line, k), k < static_cast<int>(n) ? -1 : k - static_cast<int>(n));
      delay_line::push<double>(line, k, line.data());
    }
  }
}

}  // namespace
}  // namespace hysteron
