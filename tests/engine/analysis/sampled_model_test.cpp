// Sampled loops against pulse transfer functions in closed form, and against simulations that stay or leave.
#include "engine/analysis/sampled_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "engine/analysis/small_motions.h"
#include "engine/events/rest.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;
using std::numbers::pi;
using Complex = std::complex<double>;

SmallMotions motions(const Program& p, const std::string& from, const std::string& to,
                     const std::vector<std::string>& open, bool loop) {
  auto run = start(p);
  const auto zero = series({0}, {0});
  for (const auto& input : p.input_names) bind_input(p, run, input, zero);
  settle_at_rest(p, run, 0);
  LinearizeOptions options{{p.signal(from)}, {p.signal(to)}};
  for (const auto& name : open) options.open.push_back(p.signal(name));
  return small_motions(p, run, options, loop);
}

/// e = r - y, held with a gain every `period`, then 1/(0.5 s + 1).
Diagram held_lag(const std::string& gain, const std::string& period = "0.1 s") {
  return diagram({{"e", block("sum", {{"signs", "+-"}}, {"r", "y"})},
                  {"held", block("sample_hold", {{"period", period}}, {"e"})},
                  {"u", block("gain", {{"gain", gain}}, {"held"})},
                  {"y", block("lag", {{"times", list({0.5}, "s")}}, {"u"})}},
                 {"y"}, {{"r", "V"}});
}

TEST(SampledModel, AHeldLagIsItsPulseTransferFunction) {
  // L(z) = k (1 - a)/(z - a), a = exp(-T/0.5): closed pole a - k (1 - a), stable up to k = (1 + a)/(1 - a).
  const double a = std::exp(-0.2), most = (1 + a) / (1 - a);
  const auto p = compiled(held_lag("3"));
  const auto m = motions(*p, "e", "y", {"e"}, true);
  ASSERT_TRUE(m.sampled);
  EXPECT_EQ(m.sampled->looks, 1);
  EXPECT_NEAR(m.sampled->period, 0.1, 1e-15);
  EXPECT_FALSE(m.sampled->acts_between);
  for (const double w : {0.1, 3.0, 20.0, pi / 0.1}) {
    const Complex z = std::polar(1.0, 0.1 * w), expected = 3 * (1 - a) / (z - a);
    EXPECT_LT(std::abs(m.response(w) - expected), 1e-12 * std::abs(expected)) << w;
  }
  ASSERT_EQ(m.poles.size(), 1U);
  EXPECT_NEAR(m.poles[0].real(), a, 1e-14);
  EXPECT_TRUE(m.closed->stable());
  ASSERT_TRUE(m.margins->gain_to);
  EXPECT_NEAR(m.margins->gain_to->factor, most / 3, 1e-9);
  EXPECT_NEAR(m.margins->gain_to->at, pi / 0.1, 1e-9);
  EXPECT_FALSE(m.margins->gain_from);
  // |L| = 1 where |z - a| = 3 (1 - a).
  const double cosine = (1 + a * a - 9 * (1 - a) * (1 - a)) / (2 * a), w = std::acos(cosine) / 0.1;
  EXPECT_NEAR(m.margins->phase_margin_at, w, 1e-9 * w);
  const double phase = pi + std::arg(1.0 / (std::polar(1.0, 0.1 * w) - a));
  EXPECT_NEAR(m.margins->phase_margin.value(), phase, 1e-9);
  EXPECT_NEAR(m.margins->delay_margin.value(), phase / w, 1e-9);
  const auto closed = motions(*p, "r", "y", {}, false);
  ASSERT_EQ(closed.poles.size(), 1U);
  EXPECT_NEAR(closed.poles[0].real(), a - 3 * (1 - a), 1e-14);
}

TEST(SampledModel, BeyondItsLimitItIsUnstableAndTheGainToTakeBackIsTold) {
  const double a = std::exp(-0.2), most = (1 + a) / (1 - a);
  const auto m = motions(*compiled(held_lag("15")), "e", "y", {"e"}, true);
  EXPECT_EQ(m.closed->outside, 1);
  EXPECT_FALSE(m.margins->delay_margin);
  EXPECT_FALSE(m.closed_loop);
  EXPECT_NEAR(m.margins->gain_margin()->factor, most / 15, 1e-9);
}

TEST(SampledModel, DeadTimeInWholeSamplesIsBorneUpToTheMarginAndNoFurther) {
  const auto late = [](int samples) {
    auto d = held_lag("3");
    d.blocks["late"] = block("delay_line", {{"samples", static_cast<double>(samples)}, {"period", "0.1 s"}}, {"held"});
    d.blocks["u"] = block("gain", {{"gain", "3"}}, {"late"});
    return motions(*compiled(d), "e", "y", {"e"}, true).closed->outside;
  };
  const auto m = motions(*compiled(held_lag("3")), "e", "y", {"e"}, true);
  const int borne = static_cast<int>(std::floor(*m.margins->delay_margin / m.sampled->sample));
  ASSERT_GE(borne, 1);
  EXPECT_EQ(late(borne), 0);
  EXPECT_GT(late(borne + 1), 0);
}

TEST(SampledModel, AnIntegratorPlantWithAProportionalControllerBearsTwoOverItsPeriod) {
  const auto with = [](const std::string& gain) {
    return diagram({{"e", block("sum", {{"signs", "+-"}}, {"r", "y"})},
                    {"c", block("sampled_pid",
                                {{"kp", gain}, {"lower", "-1 V/s"}, {"upper", "1 V/s"}, {"period", "0.2 s"}}, {"e"})},
                    {"y", block("integrator", {}, {"c"})}},
                   {"y"}, {{"r", "V"}});
  };
  EXPECT_TRUE(motions(*compiled(with("9.9 1/s")), "e", "y", {"e"}, true).closed->stable());
  EXPECT_EQ(motions(*compiled(with("10.1 1/s")), "e", "y", {"e"}, true).closed->outside, 1);
}

TEST(SampledModel, TwoRatesAreJudgedOverTheirCommonPeriod) {
  // u of period 2 T acts on an integrator, whose output is held every T: the loop of the slow clock alone,
  // x' = x - 2 T k x, for the faster one only hands on what it sees at the slow instants.
  const auto with = [](const std::string& gain) {
    return diagram({{"e", block("sum", {{"signs", "+-"}}, {"r", "seen"})},
                    {"slow", block("sample_hold", {{"period", "0.2 s"}}, {"e"})},
                    {"u", block("gain", {{"gain", gain}}, {"slow"})},
                    {"x", block("integrator", {}, {"u"})},
                    {"seen", block("sample_hold", {{"period", "0.1 s"}}, {"x"})}},
                   {"x"}, {{"r", "V"}});
  };
  const auto m = motions(*compiled(with("4 1/s")), "e", "seen", {"e"}, true);
  EXPECT_NEAR(m.sampled->period, 0.2, 1e-15);
  EXPECT_TRUE(m.closed->stable());
  EXPECT_NEAR(m.margins->gain_to->factor, 2.5, 1e-9);
  EXPECT_EQ(motions(*compiled(with("11 1/s")), "r", "x", {}, false).count.outside, 1);
}

TEST(SampledModel, WhereAFasterClockLooksTheLimitOfTheGainIsExactToo) {
  // e every 0.1 s from r - x - (x as it was at the last even instant)/2, x' = 4 e: over two instants, with g = 0.4,
  // x becomes (1 - 3 g + 1.5 g^2) x, which stays above -1 and passes 1 at g = 2.
  const auto d = diagram({{"e", block("sum", {{"signs", "+-"}}, {"r", "back"})},
                          {"fast", block("sample_hold", {{"period", "0.1 s"}}, {"e"})},
                          {"u", block("gain", {{"gain", "4 1/s"}}, {"fast"})},
                          {"x", block("integrator", {}, {"u"})},
                          {"slow", block("sample_hold", {{"period", "0.2 s"}}, {"x"})},
                          {"half", block("gain", {{"gain", "0.5"}}, {"slow"})},
                          {"back", block("sum", {{"signs", "++"}}, {"x", "half"})}},
                         {"x"}, {{"r", "V"}});
  const auto m = motions(*compiled(d), "e", "back", {"e"}, true);
  EXPECT_EQ(m.sampled->looks, 2);
  EXPECT_TRUE(m.closed->stable());
  EXPECT_NEAR(m.margins->gain_to->factor, 5, 1e-7);
}

TEST(SampledModel, AnOffsetIsADelayOfThatTime) {
  // Sampled at 0, put out at 0.06 s (the computation): the integrator's loop x' = x - k (0.04 u_k + 0.06 u_(k-1)).
  const auto d = diagram({{"e", block("sum", {{"signs", "+-"}}, {"r", "x"})},
                          {"read", block("sample_hold", {{"period", "0.1 s"}}, {"e"})},
                          {"out", block("sample_hold", {{"period", "0.1 s"}, {"offset", "0.06 s"}}, {"read"})},
                          {"u", block("gain", {{"gain", "8 1/s"}}, {"out"})},
                          {"x", block("integrator", {}, {"u"})}},
                         {"x"}, {{"r", "V"}});
  const auto m = motions(*compiled(d), "r", "x", {}, false);
  // z^2 - (1 - 0.32) z + 0.48 = 0
  ASSERT_EQ(m.poles.size(), 2U);
  EXPECT_NEAR(std::norm(m.poles[0]), 0.48, 1e-13);
  EXPECT_NEAR(m.poles[0].real(), 0.34, 1e-13);
}

TEST(SampledModel, RandomLoopsStayOrLeaveAsItSays) {
  // Plants of second order, a controller with two clocks: what is judged unstable has grown a thousandfold where the
  // largest pole says so, and what is judged stable has died down.
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> u(0, 1);
  int stable = 0, unstable = 0;
  for (int i = 0; i < 60; ++i) {
    const double w = 2 + 8 * u(random), damping = 0.05 + u(random), gain = std::pow(10.0, 2 * u(random) - 1);
    const std::string slow = i % 3 == 0 ? "0.1 s" : i % 3 == 1 ? "0.15 s" : "0.3 s";
    const auto d = diagram(
        {{"r", block("step", {{"after", "1 V"}, {"time", "0.01 s"}})},
         {"e", block("sum", {{"signs", "+-"}}, {"r", "seen"})},
         {"c", block("sampled_pid",
                     {{"kp", std::to_string(gain)},
                      {"ki", std::to_string(2 * u(random)) + " 1/s"},
                      {"lower", "-1e99 V"},
                      {"upper", "1e99 V"},
                      {"period", slow}},
                     {"e"})},
         {"inner", block("sum", {{"signs", "+-"}}, {"c", "brake"})},
         {"y",
          block("transfer_function", {{"num", list({w * w})}, {"den", list({1, 2 * damping * w, w * w})}}, {"inner"})},
         {"brake", block("sample_hold", {{"period", "0.05 s"}, {"offset", "0.02 s"}}, {"y"})},
         {"seen", block("sample_hold", {{"period", "0.1 s"}}, {"y"})}},
        {"y"});
    const auto p = compiled(d);
    const auto m = motions(*p, "r", "y", {}, false);
    ASSERT_TRUE(m.sampled);
    const double largest_pole = std::abs(m.poles.front());
    const double rate = std::log(largest_pole) / m.sampled->period;  // [1/s]
    if (std::abs(rate) < 0.05) continue;
    ASSERT_EQ(m.count.outside > 0, rate > 0);
    auto settings = simulate_options(*p);
    const double until = std::min(300.0, 15 / std::abs(rate) + 5);
    settings.until = until;
    for (int k = 0; k <= 4000; ++k) settings.instants.push_back(until * k / 4000);
    const auto run = simulate(*p, start(*p), settings);
    const auto& y = run.values.front();
    const auto moved = [&](double from, double to) {
      double most = 0;
      for (std::size_t k = static_cast<std::size_t>(from * 4000) + 1; k < static_cast<std::size_t>(to * 4000); ++k)
        most = std::max(most, std::abs(y[k] - y[k - 1]));
      return most;
    };
    const double ratio = moved(0.75, 1) / moved(0, 0.25);
    if (rate > 0)
      EXPECT_GT(ratio, 10) << i << " rate " << rate;
    else
      EXPECT_LT(ratio, 0.1) << i << " rate " << rate;
    ++(rate > 0 ? unstable : stable);
  }
  EXPECT_GT(stable, 10);
  EXPECT_GT(unstable, 10);
}

TEST(SampledModel, ADeadTimeInContinuousTimeIsRefusedWithACure) {
  const auto d = diagram({{"e", block("sum", {{"signs", "+-"}}, {"r", "late"})},
                          {"held", block("sample_hold", {{"period", "0.1 s"}}, {"e"})},
                          {"y", block("lag", {{"times", list({0.5}, "s")}}, {"held"})},
                          {"late", block("dead_time", {{"delay", "0.03 s"}}, {"y"})}},
                         {"y"}, {{"r", "V"}});
  try {
    motions(*compiled(d), "e", "late", {"e"}, true);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.problems.front().cure.find("delay_line"), std::string::npos);
  }
}

}  // namespace
}  // namespace hysteron
