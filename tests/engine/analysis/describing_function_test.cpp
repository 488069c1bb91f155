// Describing functions against their closed forms (Gelb, Vander Velde 1968, appendix B).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/analysis/linearize.h"
#include "engine/events/rest.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;
using std::numbers::pi;
using Complex = std::complex<double>;

/// y/u of a block alone, moved by a sine of the amplitude [V] at its input.
Complex factor(const Node& node, double amplitude) {
  Node own = node;
  own.in = {{"", "u"}};
  const auto p = compiled(diagram({{"y", own}}, {"y"}, {{"u", "V"}}));
  auto run = start(*p);
  bind_input(*p, run, "u", series({0}, {0}));
  settle_at_rest(*p, run, 0);
  LinearizeOptions options{{p->signal("u")}, {p->signal("y")}};
  options.amplitudes = {{p->block_index("y"), amplitude}};
  return linearize(*p, run, options).response(1).front();
}

void expect_near(Complex found, Complex expected, double tolerance) {
  EXPECT_LT(std::abs(found - expected), tolerance) << found << " and " << expected;
}

TEST(DescribingFunction, OfASaturationHasNoPhase) {
  const Node saturation = block("saturation", {{"lower", "-1 V"}, {"upper", "1 V"}});
  for (const double a : {0.5, 1.5, 10.0}) {
    const double r = std::min(1.0, 1 / a);
    const auto n = factor(saturation, a);
    EXPECT_NEAR(n.real(), 2 / pi * (std::asin(r) + r * std::sqrt(1 - r * r)), 1e-7);  // kinks: square of a point
    EXPECT_EQ(n.imag(), 0);
  }
}

TEST(DescribingFunction, OfAPlayLagsByTheAreaOfItsLoop) {
  const Node play = block("play", {{"radius", "1 V"}});
  for (const double a : {1.2, 2.0, 20.0}) {
    const double q = 1 - 2 / a;
    const Complex expected((pi / 2 + std::asin(q) + q * std::sqrt(1 - q * q)) / pi, -4 / (pi * a) * (1 - 1 / a));
    expect_near(factor(play, a), expected, 1e-6);
  }
  EXPECT_EQ(factor(play, 0.9), Complex(0)) << "inside its gap it stands still";
}

TEST(DescribingFunction, OfARelayWithHysteresis) {
  const Node relay =
      block("relay", {{"on_at", "0.5 V"}, {"off_at", "-0.5 V"}, {"on_value", "2 V"}, {"off_value", "-2 V"}});
  for (const double a : {0.6, 1.0, 5.0}) {
    const double h = 0.5 / a;
    expect_near(factor(relay, a), 8 / (pi * a) * Complex(std::sqrt(1 - h * h), -h), 2e-4 * 8 / (pi * a));  // one point
  }
}

TEST(DescribingFunction, OfARoundingTendsToOne) {
  const Node rounding = block("rounding", {{"step", "1 V"}});
  EXPECT_EQ(factor(rounding, 0.4), Complex(0));
  EXPECT_NEAR(factor(rounding, 1000).real(), 1, 1e-3);
  // Two levels: as of a relay with a dead zone of a half.
  EXPECT_NEAR(factor(rounding, 1).real(), 4 / pi * std::sqrt(1 - 0.25), 2e-4);
}

TEST(DescribingFunction, OfABoucWenLawIsElasticForSmallMotionsAndLags) {
  const Node law = block("bouc_wen", {{"alpha", "0.3"}, {"beta", "0.2 1/V"}, {"gamma", "0.02 1/V"}, {"d_p", "1.6"}});
  const auto small = factor(law, 1e-6);
  EXPECT_NEAR(small.real(), 1.3, 1e-6);
  const auto large = factor(law, 5);
  EXPECT_GT(large.real(), 1.3);
  EXPECT_LT(large.real(), 1.6);
  EXPECT_LT(large.imag(), 0) << "it lags: its loops cost energy";
}

TEST(DescribingFunction, OfALagIsRefused) { EXPECT_THROW(factor(block("lag", {{"times", list({1}, "s")}}), 1), Error); }

}  // namespace
}  // namespace hysteron
