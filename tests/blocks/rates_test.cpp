// The rate of every block's output is exact: held against central differences of its values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "models/random.h"
#include "tests/blocks/samples.h"

namespace hysteron {
namespace {

using bench::Bench;
using bench::dual;
using bench::Duals;
using bench::moved;
using bench::Numbers;

Numbers draw(std::size_t n, std::uint64_t stream, double scale) {
  Numbers v;
  for (std::size_t i = 0; i < n; ++i) v.push_back(scale * random::normal(99, stream, i));
  return v;
}

class EverySample : public testing::TestWithParam<bench::Sample> {};

TEST_P(EverySample, CarriesTheExactRateOfItsOutput) {
  Bench b(GetParam().type, GetParam().values, GetParam().inputs);
  ASSERT_EQ(b.sizes.error, "");
  const History history{{0, 0.1, 0.4, 0.9}, {0, 1, 0.5, 2}, {3, -1, 2, 1}, 0, 0};
  b.history = &history;
  const auto nu = static_cast<std::size_t>(b.n_u), nx = static_cast<std::size_t>(b.states());
  const Numbers m = b.initial_memory();
  // Differences: rounding 1e-16/h = 1e-10, curvature h^2 times at most 2e5 (a sum of sines of 4 Hz) = 1e-7. Laws that
  // are integrated within one call are exact to 1e-10 of their way: with 1e-4 that leaves 1e-6.
  const bool integrated = GetParam().type.starts_with("sampled_") && GetParam().type.ends_with("_inverse");
  const double h = integrated ? 1e-4 : 1e-6, allowed = integrated ? 3e-6 : 2e-7;
  for (std::uint64_t trial = 0; trial < 50; ++trial) {
    const double t = 0.02 * static_cast<double>(trial) + 0.0031, branch = t;
    const Numbers u = draw(nu, 4 * trial, 2), du = draw(nu, 4 * trial + 1, 1), x = draw(nx, 4 * trial + 2, 1),
                  dx = draw(nx, 4 * trial + 3, 1);
    const auto value = [&](double e) {
      const Numbers at = moved(u, du, e);
      const Numbers memory = b.sizes.memory > 0 ? b.advance(m, at) : m;
      return b.output(t + e, branch, at, moved(x, dx, e), memory)[0];
    };
    const Duals memory = b.sizes.memory > 0 ? b.advance_rate(dual(m), dual(u, du)) : Duals{};
    const Dual y = b.output_rate(t, branch, dual(u, du), dual(x, dx), memory)[0];
    EXPECT_NEAR(y.value, value(0), 1e-13 * (1 + std::fabs(y.value)));
    EXPECT_NEAR(y.rate, (value(h) - value(-h)) / (2 * h), allowed * (1 + std::fabs(y.rate)))
        << GetParam().type << " trial " << trial;
  }
}

/// The engine asks such blocks for their outputs at the rates of states and inputs, in place of the rates of outputs.
TEST_P(EverySample, LinearWithoutOffsetsRatesFollowTheLawOfTheValues) {
  const Bench b(GetParam().type, GetParam().values, GetParam().inputs);
  const auto& d = b.kernel.declaration;
  if (!d.is_linear || std::any_of(d.parameters.begin(), d.parameters.end(), [](const auto& p) { return p.is_offset; }))
    return;
  const auto nu = static_cast<std::size_t>(b.n_u), nx = static_cast<std::size_t>(b.states());
  const Numbers at_zero = b.output(0, Numbers(nu, 0.0), Numbers(nx, 0.0));
  for (std::uint64_t trial = 0; trial < 10; ++trial) {
    const Numbers u = draw(nu, 4 * trial, 2), du = draw(nu, 4 * trial + 1, 1), x = draw(nx, 4 * trial + 2, 1),
                  dx = draw(nx, 4 * trial + 3, 1);
    const Numbers rate = bench::rates(b.output_rate(0, 0, dual(u, du), dual(x, dx), {})), law = b.output(0, du, dx);
    // A constant part (units with an offset) cancels to its own rounding.
    for (std::size_t i = 0; i < rate.size(); ++i)
      EXPECT_NEAR(law[i] - at_zero[i], rate[i], 1e-13 * (1 + std::fabs(rate[i]) + std::fabs(at_zero[i])));
  }
}

INSTANTIATE_TEST_SUITE_P(Blocks, EverySample, testing::ValuesIn(bench::samples()), bench::sample_name);

TEST(RecordedBlock, RateIsTheSlopeBetweenTheSamples) {
  Bench b("recorded", {});
  const Series series{{0, 1, 3}, {2, 5, 1}, Between::linear};
  b.series = &series;
  EXPECT_EQ(b.output_rate(0.5, 0.5, {}, {}, {})[0].rate, 3);
  EXPECT_EQ(b.output_rate(1.5, 1.5, {}, {}, {})[0].rate, -2);
  EXPECT_EQ(b.output_rate(1.0, 0.5, {}, {}, {})[0].rate, 3) << "at the sample the branch decides";
  EXPECT_EQ(b.output_rate(4.0, 4.0, {}, {}, {})[0].rate, 0);
}

}  // namespace
}  // namespace hysteron
