// Sections by frequency and damping: their frequency responses, worked out from the rates and outputs of the blocks,
// are the quotients of polynomials that their pages give.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "models/linear/linear_system.h"
#include "tests/blocks/bench.h"

namespace hysteron {
namespace {

using bench::Bench;
using bench::Numbers;
using Complex = std::complex<double>;

constexpr double tau = 2 * std::numbers::pi;

/// C (i w - A)^-1 B + D from unit vectors in states and input, as real and imaginary parts of the states.
Complex response(const Bench& b, double w) {
  const auto n = static_cast<std::size_t>(b.states());
  const auto unit = [&](std::size_t i) {
    Numbers x(n, 0.0);
    if (i < n) x[i] = 1;
    return x;
  };
  const Numbers rate_of_input = b.derivative({1}, unit(n));
  std::vector<double> matrix(4 * n * n, 0.0), states(2 * n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    const Numbers rate = b.derivative({0}, unit(k));
    for (std::size_t r = 0; r < n; ++r) matrix[r * 2 * n + k] = matrix[(n + r) * 2 * n + n + k] = -rate[r];
    matrix[k * 2 * n + n + k] = -w;
    matrix[(n + k) * 2 * n + k] = w;
    states[k] = rate_of_input[k];
  }
  EXPECT_TRUE(linear_system::solve(matrix, states));
  Complex y = b.output(0, {1}, unit(n))[0];
  for (std::size_t k = 0; k < n; ++k) y += b.output(0, {0}, unit(k))[0] * Complex(states[k], states[n + k]);
  return y;
}

template <class Law>
void expect_response(const Bench& b, const Law& law) {
  for (double f = 0.03; f < 300; f *= 1.7) {
    const Complex wanted = law(Complex(0, tau * f)), got = response(b, tau * f);
    EXPECT_NEAR(std::abs(got - wanted), 0, 1e-12 * (1 + std::abs(wanted))) << f << " Hz";  // systems of 12 at most
  }
}

TEST(LeadLagBlock, HasOneZeroAndOnePole) {
  expect_response(Bench("lead_lag", {{"gain", {3}}, {"zero", {2}}, {"pole", {9}}}),
                  [](Complex s) { return 3.0 * (1.0 + s / (tau * 2)) / (1.0 + s / (tau * 9)); });
  expect_response(Bench("lead_lag", {{"zero", {HUGE_VAL}}, {"pole", {9}}}),
                  [](Complex s) { return 1.0 / (1.0 + s / (tau * 9)); });
}

TEST(LeadLagBlock, LeadsMostBetweenItsCorners) {
  const Bench b("lead_lag", {{"zero", {2}}, {"pole", {18}}});
  EXPECT_NEAR(std::arg(response(b, tau * 6)), std::asin(16.0 / 20), 1e-13);
}

TEST(NotchBlock, IsItsQuotientAndItsDepthAtTheFrequency) {
  const double w = tau * 5;
  const Bench b("notch", {{"frequency", {5}}, {"damping", {0.6}}, {"depth", {0.1}}});
  expect_response(
      b, [&](Complex s) { return (s * s + 2.0 * 0.1 * 0.6 * w * s + w * w) / (s * s + 2.0 * 0.6 * w * s + w * w); });
  EXPECT_NEAR(std::abs(response(b, w)), 0.1, 1e-13);
  EXPECT_NEAR(std::abs(response(Bench("notch", {{"frequency", {5}}, {"damping", {0.6}}}), w)), 0, 1e-13);
}

TEST(NotchBlock, TakesAResonanceOut) {
  // Damping 0.02 of the mode, 0.8 of the notch, depth their quotient: together a mode of damping 0.8.
  const Bench mode("resonance", {{"frequency", {5}}, {"damping", {0.02}}}),
      notch("notch", {{"frequency", {5}}, {"damping", {0.8}}, {"depth", {0.02 / 0.8}}}),
      well_damped("resonance", {{"frequency", {5}}, {"damping", {0.8}}});
  for (const double f : {0.5, 4.0, 5.0, 6.0, 40.0})
    EXPECT_NEAR(std::abs(response(mode, tau * f) * response(notch, tau * f) - response(well_damped, tau * f)), 0,
                1e-12);
}

TEST(SecondOrderBlock, PassesLowBandOrHigh) {
  const double w = tau * 5, z = 0.3;
  const auto below = [&](Complex s) { return s * s + 2.0 * z * w * s + w * w; };
  const auto made = [&](double pass) {
    return Bench("second_order", {{"gain", {2}}, {"frequency", {5}}, {"damping", {z}}, {"pass", {pass}}});
  };
  expect_response(made(0), [&](Complex s) { return 2.0 * w * w / below(s); });
  expect_response(made(1), [&](Complex s) { return 2.0 * 2.0 * z * w * s / below(s); });
  expect_response(made(2), [&](Complex s) { return 2.0 * s * s / below(s); });
  EXPECT_FALSE(made(0).sizes.feedthrough);
  EXPECT_FALSE(made(1).sizes.feedthrough);
  EXPECT_TRUE(made(2).sizes.feedthrough);
}

TEST(BiquadsBlock, IsTheProductOfItsSections) {
  const Bench b("biquads", {{"gain", {2}},
                            {"zero_frequencies", {3, HUGE_VAL, 8}},
                            {"zero_dampings", {0.1, 0, -0.4}},
                            {"pole_frequencies", {4, 20, 7}},
                            {"pole_dampings", {0.5, 0.7, 1.2}}});
  const auto quadratic = [](Complex s, double f, double z) {
    return s * s / (tau * f * tau * f) + 2.0 * z * s / (tau * f) + 1.0;
  };
  expect_response(b, [&](Complex s) {
    return 2.0 * quadratic(s, 3, 0.1) * quadratic(s, 8, -0.4) /
           (quadratic(s, 4, 0.5) * quadratic(s, 20, 0.7) * quadratic(s, 7, 1.2));
  });
}

TEST(ZeroPoleGainBlock, HasTheZerosAndPolesThatAreWritten) {
  const Bench b("zero_pole_gain", {{"gain", {5}},
                                   {"zeros", {-7}},
                                   {"zero_pairs", {2, 30}},
                                   {"zero_pairs columns", {2}},
                                   {"poles", {-3, -60}},
                                   {"pole_pairs", {-4, 25, -1, 90}},
                                   {"pole_pairs columns", {2}}});
  EXPECT_EQ(b.states(), 6);
  EXPECT_FALSE(b.sizes.feedthrough);
  const Complex z(2, 30), p(-4, 25), q(-1, 90);
  expect_response(b, [&](Complex s) {
    return 5.0 * (s + 7.0) * (s - z) * (s - std::conj(z)) /
           ((s + 3.0) * (s + 60.0) * (s - p) * (s - std::conj(p)) * (s - q) * (s - std::conj(q)));
  });
}

TEST(ZeroPoleGainBlock, ActsAtOnceWithAsManyZerosAsPoles) {
  const Bench b("zero_pole_gain", {{"gain", {5}}, {"zeros", {-7}}, {"poles", {-3}}});
  EXPECT_TRUE(b.sizes.feedthrough);
  expect_response(b, [](Complex s) { return 5.0 * (s + 7.0) / (s + 3.0); });
}

}  // namespace
}  // namespace hysteron
