// Linear systems at operating points, against closed forms.
#include "engine/analysis/linearize.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/analysis/margins.h"
#include "engine/events/rest.h"
#include "tests/engine/event_blocks.h"
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

void expect_near(Complex a, Complex b, double relative) {
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
    expect_near(model.response(w).front(), l / (1.0 + l), 1e-10);
  }
}

TEST(Linearize, AnOpenedLoopIsTheLoop) {
  const auto p = compiled(servo());
  const auto model = linear(*p, "e", "y", {"e"});
  for (const double w : {1.0, 30.0, 1000.0, 1e4}) expect_near(model.response(w).front(), loop_of_servo(w), 1e-10);
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
  for (const double w : {1.0, 1000.0}) expect_near(model.response(w).front(), (1.6126 - 0.6187) * 1e-6, 1e-12);
}

TEST(Linearize, AStaticCurveIsItsSlopeAtTheOperatingPoint) {
  // y = u^2 where u rests at 3 V.
  const auto p = compiled(diagram({{"c", block("constant", {{"value", "3 V"}})},
                                   {"u", block("lag", {{"times", list({1}, "s")}}, {"c"})},
                                   {"y", block("product", {}, {"u", "u"})}},
                                  {"y"}));
  // The equilibrium is found to 1e-10.
  expect_near(linear(*p, "u", "y").response(1).front(), 6.0, 1e-10);
  expect_near(linear(*p, "c", "y").response(1).front(), 6.0 / Complex(1, 1), 1e-10);
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
    expect_near(open.response(w).front(), l, 1e-12);
    expect_near(closed.response(w).front(), l / (1.0 + l), 1e-12);
  }
  // |L| = 1 at 3 rad/s, phase there -90 deg - 0.3 rad; phase -180 deg at pi/2/0.1 s.
  const Response loop = [&](double w) { return open.response(w).front(); };
  const auto m = margins(loop, bode(loop, frequencies(open.poles(), 0.1)));
  EXPECT_NEAR(m.phase_margin.value(), pi / 2 - 0.3, 1e-9);
  EXPECT_NEAR(m.phase_margin_at, 3, 1e-9);
  EXPECT_NEAR(m.delay_margin, (pi / 2 - 0.3) / 3, 1e-9);
  EXPECT_NEAR(m.gain_margin.value(), pi / 2 / 0.1 / 3, 1e-9);
  EXPECT_NEAR(m.gain_margin_at, pi / 2 / 0.1, 1e-8);
}

TEST(Linearize, ASampledBlockOnTheWayIsRefusedAndNotElsewhere) {
  const auto p = compile(diagram({{"held", block("test_sampler", {{"period", "1 ms"}}, {"u"})},
                                  {"y", block("lag", {{"times", list({0.1}, "s")}}, {"held"})}},
                                 {"y"}, {{"u", "V"}}),
                         test::registry_with_events());
  EXPECT_THROW(linear(*p, "u", "y"), Error);
  expect_near(linear(*p, "held", "y").response(10).front(), 1.0 / Complex(1, 1), 1e-12);
}

TEST(Margins, BandwidthOfALagIsItsCorner) {
  const Response lag = [](double w) { return 5.0 / Complex(1, w / 40); };
  const std::vector<Complex> poles{-40};
  EXPECT_NEAR(bandwidth(lag, bode(lag, frequencies(poles, 0))).value(), 40, 40 * 1e-4);  // seen from a hundredth: 1e-4
}

TEST(Margins, ThoseOfAnUnstableLoopAreNegativeAndBelowOne) {
  // 8/(s (s + 1)^2): the phase passes -180 deg at 1 rad/s, where |L| = 4.
  const Response loop = [](double w) {
    const Complex s(0, w);
    return 8.0 / (s * (s + 1.0) * (s + 1.0));
  };
  const std::vector<Complex> poles{0, -1, -1};
  const auto m = margins(loop, bode(loop, frequencies(poles, 0)));
  EXPECT_NEAR(m.gain_margin.value(), 0.25, 1e-9);  // at 1 rad/s |L| = 8/2
  EXPECT_NEAR(m.gain_margin_at, 1, 1e-9);
  EXPECT_LT(m.phase_margin.value(), 0);
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
