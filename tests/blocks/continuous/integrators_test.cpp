// Integrators with limits and resets, filtered derivatives, dead zones, wrapping and delays that change.
#include <gtest/gtest.h>

#include <cmath>

#include "models/continuous/limited_integrator.h"
#include "tests/blocks/samples.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using bench::Bench;
using tools::block;
using tools::Parameters;

const bench::Samples samples{{"limited_integrator", {{"lower", {-1}}, {"upper", {1.5}}, {"initial", {0.6}}}},
                             {"integrator_with_reset", {{"lower", {-1}}, {"upper", {1.5}}, {"initial", {0.6}}}},
                             {"filtered_derivative", {{"time", {0.3}}}},
                             {"variable_dead_time", {{"longest", {0.5}}}},
                             {"dead_zone", {{"lower", {-1}}, {"upper", {0.4}}}},
                             {"wrap", {{"period", {3}}, {"lower", {-1}}}}};

constexpr Method methods[] = {Method::bdf, Method::runge_kutta, Method::adams};

Traces simulated(const Diagram& d, std::vector<double> instants, Method method = Method::bdf) {
  const auto program = tools::compiled(d);
  SimulateOptions options;
  options.instants = std::move(instants);
  options.until = options.instants.back();
  options.relative_tolerance = 1e-8;
  options.method = method;
  return simulate(*program, start(*program), options);
}

TEST(LimitedIntegratorBlock, StopsAtItsLimitAndLeavesItWhereItsInputTurns) {
  // u = 2 cos(pi t): y = 2/pi sin(pi t) up to 0.3, left at t = 0.5 where u turns: 0.3 + 2/pi (sin(pi t) - 1), down to
  // -0.4, left at 1.5, and so on each 2 s.
  const auto d =
      tools::diagram({{"u", block("sine", {{"amplitude", "2 V"}, {"frequency", "0.5 Hz"}, {"phase", "90 deg"}})},
                      {"y", block("limited_integrator", {{"lower", "-0.4 V s"}, {"upper", "0.3 V s"}}, {"u"})}},
                     {"y"});
  const auto expected = [](double t) {
    const double s = 2 / M_PI * std::sin(M_PI * t);
    if (t < 0.5) return std::min(0.3, s);
    const double turn = std::floor(t - 0.5), top = std::fmod(turn, 2) == 0 ? 1 : -1;
    const double way = s - top * 2 / M_PI;  // since it turned
    return top > 0 ? std::max(-0.4, 0.3 + way) : std::min(0.3, -0.4 + way);
  };
  for (const Method method : methods) {
    const auto traces = simulated(d, tools::grid(0, 5, 200), method);
    for (std::size_t k = 0; k < traces.t.size(); ++k)
      EXPECT_NEAR(traces.values[0][k], expected(traces.t[k]), 1e-7) << traces.t[k] << method_name(method);
  }
}

TEST(LimitedIntegratorBlock, PassesRowsOfRecordingsExactly) {
  // Straight lines; in the third row the input turns while the limit holds. 0.5; 0.5 + 2, held at 1; held until u turns
  // at 3.5 s, then 1 - 0.25; 1 further down.
  const std::vector<double> t{0, 1, 2, 4, 5}, u{0, 1, 3, -1, -1}, expected{0, 0.5, 1, 0.75, -0.25};
  double x = 0;
  for (std::size_t k = 1; k < t.size(); ++k) {
    x = limited_integrator::after({-1.0, 1.0}, x, u[k - 1], u[k], t[k] - t[k - 1]);
    EXPECT_NEAR(x, expected[k], 1e-15) << k;
  }
  const auto program = tools::compiled(tools::diagram(
      {{"y", block("limited_integrator", {{"lower", "-1 V s"}, {"upper", "1 V s"}}, {"u"})}}, {"y"}, {{"u", "V"}}));
  auto run = start(*program);
  bind_input(*program, run, "u", tools::series(t, u));
  SimulateOptions options;
  options.instants = t;
  options.until = 5;
  options.method = Method::bdf;
  EXPECT_LT(tools::distance(simulate(*program, run, options).values[0], expected), 1e-6) << "with its events";
}

TEST(IntegratorWithResetBlock, BeginsAnewWhereTheSignalSays) {
  // u = 1; the signal is on from 1 to 1.5 s and from 3 to 3.5 s.
  const auto pulse = block("pulse", {{"high", 1.0}, {"period", "2 s"}, {"duty", 0.25}, {"time", "1 s"}});
  const auto run = [&](const std::string& at) {
    const auto d = tools::diagram({{"u", block("constant", {{"value", "1 V"}})},
                                   {"r", pulse},
                                   {"s", block("ramp", {{"slope", "0.1 V"}, {"initial", "-1 V s"}})},
                                   {"y", block("integrator_with_reset", {{"reset_at", at}}, {"u", "r", "s"})}},
                                  {"y"});
    return simulated(d, {0.9, 1.2, 2, 3.3, 3.9}).values[0];
  };
  const auto expect = [](const std::vector<double>& got, const std::vector<double>& expected) {
    ASSERT_EQ(got.size(), expected.size());
    for (std::size_t k = 0; k < got.size(); ++k) EXPECT_NEAR(got[k], expected[k], 1e-7) << k;
  };
  // start is -1 + 0.1 t: -0.9 at 1 s, -0.85 at 1.5 s, -0.7 at 3 s, -0.65 at 3.5 s.
  expect(run("rising"), {0.9, -0.9 + 0.2, -0.9 + 1, -0.7 + 0.3, -0.7 + 0.9});
  expect(run("falling"), {0.9, 1.2, -0.85 + 0.5, -0.85 + 1.8, -0.65 + 0.4});
  expect(run("either"), {0.9, -0.9 + 0.2, -0.85 + 0.5, -0.7 + 0.3, -0.65 + 0.4});
  expect(run("while_on"), {0.9, -0.9, -0.9 + 0.5, -0.7, -0.7 + 0.4});
}

TEST(IntegratorWithResetBlock, ASignalThatIsOnAtTheStartSetsIt) {
  const auto d = tools::diagram({{"u", block("constant", {{"value", "1 V"}})},
                                 {"r", block("constant", {{"value", 1.0}})},
                                 {"s", block("constant", {{"value", "5 V s"}})},
                                 {"y", block("integrator_with_reset", {{"upper", "5.5 V s"}}, {"u", "r", "s"})}},
                                {"y"});
  const auto traces = simulated(d, {0, 0.2, 2});
  EXPECT_NEAR(traces.values[0][0], 5, 1e-12);
  EXPECT_NEAR(traces.values[0][1], 5.2, 1e-7);
  EXPECT_NEAR(traces.values[0][2], 5.5, 1e-7) << "its limits hold, too";
}

TEST(FilteredDerivativeBlock, OfARampIsItsSlopeBehindTheLag) {
  const auto d = tools::diagram({{"u", block("ramp", {{"slope", "3 V/s"}, {"time", "0.1 s"}})},
                                 {"y", block("filtered_derivative", {{"time", "0.2 s"}}, {"u"})}},
                                {"y"});
  const auto traces = simulated(d, {0.05, 0.3, 1.1});
  EXPECT_NEAR(traces.values[0][0], 0, 1e-12);
  EXPECT_NEAR(traces.values[0][1], 3 * (1 - std::exp(-1.0)), 1e-7);
  EXPECT_NEAR(traces.values[0][2], 3 * (1 - std::exp(-5.0)), 1e-7);
}

TEST(DeadZoneBlock, SwallowsItsZone) {
  const Bench b("dead_zone", {{"lower", {-1}}, {"upper", {2}}});
  for (const auto& [u, y] : std::initializer_list<std::pair<double, double>>{{-3, -2}, {-1, 0}, {1.9, 0}, {5, 3}})
    EXPECT_EQ(b.output(0, {u})[0], y) << u;
  // The area of what a sine of 1 has beyond 0.6, over ten turns: (2 cos a - 0.6 (pi - 2 a))/(2 pi) each, a = asin 0.6.
  const double a = std::asin(0.6), area = (2 * std::cos(a) - 0.6 * (M_PI - 2 * a)) / (2 * M_PI);
  const auto d = tools::diagram({{"u", block("sine", {{"amplitude", 1.0}, {"frequency", "1 Hz"}})},
                                 {"z", block("dead_zone", {{"lower", -2.0}, {"upper", 0.6}}, {"u"})},
                                 {"y", block("integrator", {}, {"z"})}},
                                {"y"});
  for (const Method method : methods)
    EXPECT_NEAR(simulated(d, {10}, method).values[0].back(), 10 * area, 1e-6) << method_name(method);
}

TEST(WrapBlock, IsASawtoothOfARampWhoseJumpsAreFound) {
  // 0.7 turns a second from -180 to 180 deg: the area over 3 s of (t mod 1/0.7) pieces, each of mean zero.
  const auto d = tools::diagram({{"u", block("ramp", {{"slope", "252 deg/s"}})},
                                 {"w", block("wrap", {{"period", "360 deg"}, {"lower", "-180 deg"}}, {"u"})},
                                 {"y", block("integrator", {}, {"w"})}},
                                {"w", "y"});
  const double slope = 252 * M_PI / 180;
  for (const Method method : methods) {
    const auto traces = simulated(d, {0.5, 1, 3}, method);
    EXPECT_NEAR(traces.values[0][0], 0.5 * slope, 1e-12);
    EXPECT_NEAR(traces.values[0][1], slope - 2 * M_PI, 1e-12);
    const double since = 3 * slope - 4 * M_PI;  // two whole turns, and the angle that is left
    EXPECT_NEAR(traces.values[1][2], 0.5 * since * since / slope, 1e-6) << method_name(method);
  }
  EXPECT_EQ(Bench("wrap", {{"period", {2}}}).output(0, {-0.5})[0], 1.5);
}

TEST(VariableDeadTimeBlock, IsItsInputAsLongAgoAsTheSignalSays) {
  // u = sin(2 t), delay = 0.3 + 0.2 t up to 0.5 s: the sine of t - delay, constant behind 1 s.
  const auto d =
      tools::diagram({{"u", block("sine", {{"amplitude", "1 V"}, {"frequency", std::to_string(1 / M_PI) + " Hz"}})},
                      {"late", block("ramp", {{"slope", 0.2}, {"initial", "0.3 s"}})},
                      {"y", block("variable_dead_time", {{"longest", "0.5 s"}}, {"u", "late"})}},
                     {"u", "y"});
  for (const Method method : methods) {
    const auto program = tools::compiled(d);
    SimulateOptions options;
    options.instants = tools::grid(0, 3, 60);
    options.until = 3;
    options.relative_tolerance = 1e-8;
    options.method = method;
    options.max_step = 0.2;  // below the shortest delay
    const auto traces = simulate(*program, start(*program), options);
    for (std::size_t k = 0; k < traces.t.size(); ++k) {
      const double t = traces.t[k], ago = t - std::min(0.5, 0.3 + 0.2 * t);
      EXPECT_NEAR(traces.values[1][k], ago < 0 ? 0 : std::sin(2 * ago), 1e-5) << t << method_name(method);
    }
  }
}

}  // namespace
}  // namespace hysteron
