// Linear systems at operating points, against closed forms.
#include "engine/analysis/linearize.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/analysis/margins.h"
#include "engine/analysis/small_motions.h"
#include "engine/analysis/stability.h"
#include "engine/events/rest.h"
#include "tests/engine/event_blocks.h"
#include "tests/engine/linear_models.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;
using std::numbers::pi;
using Complex = std::complex<double>;

LinearModel linear(const Program& p, const std::string& from, const std::string& to,
                   const std::vector<std::string>& open = {}) {
  auto run = start(p);
  const auto zero = series({0}, {0});
  for (const auto& input : p.input_names) bind_input(p, run, input, zero);
  settle_at_rest(p, run, 0);
  LinearizeOptions options{{p.signal(from)}, {p.signal(to)}};
  for (const auto& name : open) options.open.push_back(p.signal(name));
  return linearize(p, run, options);
}

StableAt stable_at(const LinearModel& loop) {
  return [&loop](double gain) { return unstable_when_closed(loop, gain).stable(); };
}

void expect_equal(Complex a, Complex b, double relative) {
  EXPECT_LT(std::abs(a - b), relative * std::abs(b)) << a << " and " << b;
}

/// PI control of a second-order stage behind two blocks, with its loop.
Diagram servo() {
  return diagram({{"e", block("sum", {{"signs", "+-"}}, {"r", "y"})},
                  {"c", block("pi_controller", {{"kp", "0.5 V/V"}, {"ki", "40 1/s"}}, {"e"})},
                  {"y", block("transfer_function", {{"num", list({2e6})}, {"den", list({1, 300, 1e6})}}, {"c"})}},
                 {"y"}, {{"r", "V"}});
}
Complex loop_of_servo(double w) {
  const Complex s(0, w);
  return (0.5 + 40.0 / s) * 2e6 / (s * s + 300.0 * s + 1e6);
}

TEST(Linearize, AClosedLoopIsItsTransferFunction) {
  const auto p = compiled(servo());
  const auto model = linear(*p, "r", "y");
  for (const double w : {1.0, 30.0, 300.0, 1000.0, 1e4}) {
    const Complex l = loop_of_servo(w);
    expect_equal(model.response(w).front(), l / (1.0 + l), 1e-10);
  }
}

TEST(Linearize, AnOpenedLoopIsTheLoop) {
  const auto p = compiled(servo());
  const auto model = linear(*p, "e", "y", {"e"});
  for (const double w : {1.0, 30.0, 1000.0, 1e4}) expect_equal(model.response(w).front(), loop_of_servo(w), 1e-10);
  const auto poles = model.poles();
  ASSERT_EQ(poles.size(), 3U);
  EXPECT_NEAR(poles[0].real(), 0, 1e-6);
  EXPECT_NEAR(poles[1].real(), -150, 1e-6);
  EXPECT_NEAR(poles[1].imag(), std::sqrt(1e6 - 150 * 150), 1e-6);
}

TEST(Linearize, ALawThatIsDrivenByTheRateIsItsSlopeAtRest) {
  // dz = alpha du at z = 0: y = (d_p - alpha) u at every frequency, with the pole of z at zero, never seen.
  const auto p = compiled(diagram({{"y", thesis_bouc_wen("u")}}, {"y"}, {{"u", "V"}}));
  const auto model = linear(*p, "u", "y");
  for (const double w : {1.0, 1000.0}) expect_equal(model.response(w).front(), (1.6126 - 0.6187) * 1e-6, 1e-12);
}

TEST(Linearize, AStaticCurveIsItsSlopeAtTheOperatingPoint) {
  // y = u^2 where u rests at 3 V.
  const auto p = compiled(diagram({{"c", block("constant", {{"value", "3 V"}})},
                                   {"u", block("lag", {{"times", list({1}, "s")}}, {"c"})},
                                   {"y", block("product", {}, {"u", "u"})}},
                                  {"y"}));
  // The equilibrium is found to 1e-10.
  expect_equal(linear(*p, "u", "y").response(1).front(), 6.0, 1e-10);
  expect_equal(linear(*p, "c", "y").response(1).front(), 6.0 / Complex(1, 1), 1e-10);
}

TEST(Linearize, ADeadTimeCountsExactly) {
  const auto p = compiled(diagram({{"e", block("sum", {{"signs", "+-"}}, {"r", "late"})},
                                   {"x", block("integrator", {}, {"e"})},
                                   {"y", block("gain", {{"gain", "3 1/s"}}, {"x"})},
                                   {"late", block("dead_time", {{"delay", "0.1 s"}}, {"y"})}},
                                  {"y"}, {{"r", "V"}}));
  const auto open = linear(*p, "e", "late", {"e"}), closed = linear(*p, "r", "late");
  for (const double w : {0.3, 3.0, 20.0}) {
    const Complex l = 3.0 / Complex(0, w) * std::polar(1.0, -0.1 * w);
    expect_equal(open.response(w).front(), l, 1e-12);
    expect_equal(closed.response(w).front(), l / (1.0 + l), 1e-12);
  }
  // |L| = 1 at 3 rad/s, phase there -90 deg - 0.3 rad; phase -180 deg at pi/2/0.1 s.
  const Response loop = [&](double w) { return open.response(w).front(); };
  const auto m = margins(loop, bode(loop, frequencies(open.poles(), 0.1), 0.1), stable_at(open));
  EXPECT_NEAR(m.phase_margin.value(), pi / 2 - 0.3, 1e-9);
  EXPECT_NEAR(m.phase_margin_at, 3, 1e-9);
  EXPECT_NEAR(m.delay_margin.value(), (pi / 2 - 0.3) / 3, 1e-9);
  EXPECT_NEAR(m.gain_margin()->factor, pi / 2 / 0.1 / 3, 1e-9);
  EXPECT_NEAR(m.gain_margin()->at, pi / 2 / 0.1, 1e-8);
}

TEST(Linearize, ASourceOfTimeMovesLikeAnyOtherSignal) {
  // The rate of the sine is needed by the law behind it, and is made in one step with its value.
  const auto p = compiled(diagram(
      {{"reference", block("sine", {{"amplitude", "1 V"}, {"frequency", "5 Hz"}})},
       {"error", block("sum", {{"signs", "+-"}}, {"reference", "plant"})},
       {"c", block("pi_controller", {{"kp", "2"}, {"ki", "10 1/s"}}, {"error"})},
       {"h", block("bouc_wen", {{"alpha", "0.3"}, {"beta", "0.2 1/V"}, {"gamma", "0.02 1/V"}, {"d_p", "1.6"}}, {"c"})},
       {"plant", block("lag", {{"times", list({0.1}, "s")}}, {"h"})}},
      {"plant"}));
  const auto reference = linear(*p, "reference", "plant"), error = linear(*p, "error", "plant");
  EXPECT_NEAR(std::abs(reference.response(0.001).front()), 1, 1e-3) << "the integrator holds it";
  for (const double w : {0.1, 10.0, 1000.0})
    expect_equal(reference.response(w).front(), error.response(w).front(), 1e-12);
}

TEST(Linearize, ALoopIsOpenedInsideAnAlgebraicLoopToo) {
  const auto p = compiled(
      diagram({{"e", block("sum", {{"signs", "+-"}}, {"r", "y"})}, {"y", block("gain", {{"gain", "2"}}, {"e"})}}, {"y"},
              {{"r", "V"}}));
  expect_equal(linear(*p, "e", "y", {"e"}).response(1).front(), 2, 1e-14);
  expect_equal(linear(*p, "r", "y").response(1).front(), 2.0 / 3, 1e-14);
  expect_equal(linear(*p, "e", "y").response(1).front(), 2.0 / 3, 1e-14);
}

TEST(Linearize, WhatLiesBesideTheWayHasNoPolesThere) {
  // An unstable neighbour, and an integrator that only looks on.
  const auto p =
      compiled(diagram({{"y", block("lag", {{"times", list({0.5}, "s")}}, {"r"})},
                        {"sum", block("integrator", {}, {"y"})},
                        {"other", block("transfer_function", {{"num", list({1})}, {"den", list({1, -1})}}, {"r"})}},
                       {"y", "sum", "other"}, {{"r", "V"}}));
  const auto model = linear(*p, "r", "y").on_the_way();
  ASSERT_EQ(model.poles().size(), 1U);
  EXPECT_NEAR(model.poles()[0].real(), -2, 1e-14);
}

TEST(Linearize, ZerosAreThoseOfTheNumerator) {
  const auto p = compiled(
      diagram({{"y", block("transfer_function", {{"num", list({1, 3, 100})}, {"den", list({1, 6, 11, 6})}}, {"r"})}},
              {"y"}, {{"r", "V"}}));
  const auto zeros = linear(*p, "r", "y").zeros();
  ASSERT_EQ(zeros.size(), 2U);
  expect_equal(zeros[0], Complex(-1.5, std::sqrt(100 - 2.25)), 1e-9);
}

TEST(Linearize, ABlockThatPassesNothingOnIsNamed) {
  const auto p = compiled(diagram({{"e", block("sum", {{"signs", "+-"}}, {"r", "y"})},
                                   {"gap", block("play", {{"radius", "1 V"}}, {"e"})},
                                   {"other", block("play", {{"radius", "1 V"}}, {"r"})},
                                   {"y", block("lag", {{"times", list({0.1}, "s")}}, {"gap"})}},
                                  {"y", "other"}, {{"r", "V"}}));
  auto run = start(*p);
  bind_input(*p, run, "r", series({0}, {0}));
  settle_at_rest(*p, run, 0);
  LinearizeOptions options{{p->signal("r")}, {p->signal("y")}};
  EXPECT_EQ(blocks_that_cut(*p, run, options), std::vector<int>{p->block_index("gap")}) << "and not one beside the way";
  options.amplitudes = {{p->block_index("gap"), 100}};
  EXPECT_TRUE(blocks_that_cut(*p, run, options).empty());
  EXPECT_GT(std::abs(linearize(*p, run, options).response(1).front()), 0.4);
}

TEST(Linearize, ADescribingFunctionWithAPhaseCountsInTheStability) {
  // k/(s (s + 1)) closed over a play of radius 1 moved by 2: N = 0.5 - j/pi. It oscillates where -1/N meets k L: w from
  // the phase, k from the size; beyond it grows.
  const std::complex<double> n(0.5, -1 / pi);
  // -90 deg - atan(w) + arg N = -180 deg
  const double w = std::tan(pi / 2 + std::arg(n)), most = w * std::sqrt(1 + w * w) / std::abs(n);
  const auto outside = [&](double k) {
    const auto p =
        compiled(diagram({{"e", block("sum", {{"signs", "+-"}}, {"r", "back"})},
                          {"y", block("transfer_function", {{"num", list({k})}, {"den", list({1, 1, 0})}}, {"e"})},
                          {"back", block("play", {{"radius", "1 V"}}, {"y"})}},
                         {"y"}, {{"r", "V"}}));
    auto run = start(*p);
    bind_input(*p, run, "r", series({0}, {0}));
    LinearizeOptions options{{p->signal("r")}, {p->signal("y")}};
    options.amplitudes = {{p->block_index("back"), 2}};
    return small_motions(*p, run, options, false).count.outside;
  };
  EXPECT_EQ(outside(0.99 * most), 0);
  EXPECT_EQ(outside(1.01 * most), 2);
}

TEST(Linearize, ASampledBlockOnTheWayIsRefusedAndNotElsewhere) {
  const auto p = compile(diagram({{"held", block("test_sampler", {{"period", "1 ms"}}, {"u"})},
                                  {"y", block("lag", {{"times", list({0.1}, "s")}}, {"held"})}},
                                 {"y"}, {{"u", "V"}}),
                         test::registry_with_events());
  EXPECT_THROW(linear(*p, "u", "y"), Error);
  expect_equal(linear(*p, "held", "y").response(10).front(), 1.0 / Complex(1, 1), 1e-12);
}

TEST(Margins, BandwidthOfALagIsItsCorner) {
  const Response lag = [](double w) { return 5.0 / Complex(1, w / 40); };
  const std::vector<Complex> poles{-40};
  EXPECT_NEAR(bandwidth(lag, bode(lag, frequencies(poles, 0))).value(), 40, 40 * 1e-4);  // seen from a hundredth: 1e-4
}

TEST(Margins, ThoseOfAnUnstableLoopAreNegativeAndBelowOneAndWithoutADeadTime) {
  // 8/(s (s + 1)^2): the phase passes -180 deg at 1 rad/s, where |L| = 4.
  const Response loop = [](double w) {
    const Complex s(0, w);
    return 8.0 / (s * (s + 1.0) * (s + 1.0));
  };
  const std::vector<Complex> poles{0, -1, -1};
  const LinearModel own = tools::loop_of({8}, {1, 2, 1, 0});
  const auto m = margins(loop, bode(loop, frequencies(poles, 0)), stable_at(own));
  EXPECT_FALSE(m.stable);
  EXPECT_NEAR(m.gain_margin()->factor, 0.25, 1e-9);  // at 1 rad/s |L| = 8/2
  EXPECT_NEAR(m.gain_margin()->at, 1, 1e-9);
  EXPECT_FALSE(m.gain_from);
  EXPECT_LT(m.phase_margin.value(), 0);
  EXPECT_FALSE(m.delay_margin);
}

TEST(Margins, TheClosedLoopIsThatOfTheClosedForm) {
  // L = w0^2/(s (s + 2 d w0)), so that T is a second-order lag. With v = (w/w0)^2 and d = 0.5:
  // |L|^2 = 1/2: v^2 + v = 2; |T|^2 = 1/2: v^2 - v = 1; |S|^2 = 1/2: v^2 + 3 v = 1.
  constexpr double w0 = 100, d = 0.5;
  const Response loop = [](double w) {
    const Complex s(0, w);
    return w0 * w0 / (s * (s + 2 * d * w0));
  };
  const std::vector<Complex> poles{0, -2 * d * w0};
  const auto c = closed_loop(loop, bode(loop, frequencies(poles, 0)));
  EXPECT_NEAR(c.open_half.value(), w0, w0 * 1e-12);
  EXPECT_NEAR(c.closed_half.value(), w0 * std::sqrt((1 + std::sqrt(5.0)) / 2), w0 * 1e-12);
  EXPECT_NEAR(c.sensitivity_half.value(), w0 * std::sqrt((std::sqrt(13.0) - 3) / 2), w0 * 1e-12);
  EXPECT_NEAR(c.closed.magnitude, 1 / (2 * d * std::sqrt(1 - d * d)), 1e-12);
  EXPECT_NEAR(c.closed.at, w0 * std::sqrt(1 - 2 * d * d), w0 * 1e-7);  // a maximum: root of the rounding
  // |S|^2 = v (v + 1)/(v^2 - v + 1) is largest where v^2 - v - 1/2 = 0.
  const double v = (1 + std::sqrt(3.0)) / 2;
  EXPECT_NEAR(c.sensitivity.magnitude, std::sqrt(v * (v + 1) / (v * v - v + 1)), 1e-12);
}

}  // namespace
}  // namespace hysteron
