// Laws of the integration that hold for every diagram, and how the error follows the tolerance.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <thread>

#include "engine/block/block.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;
using std::numbers::pi;

Value matrix(const std::vector<std::vector<double>>& rows, const char* unit) {
  Value value;
  NumberMatrix numbers;
  for (const auto& row : rows) {
    numbers.rows.emplace_back();
    for (const double v : row) numbers.rows.back().push_back(Number{v, unit});
  }
  value.content = std::move(numbers);
  return value;
}

TEST(SimulateLaws, AcceptingAPointChangesNoSignalThere) {
  // Every block with memory or history at once, driven by a random walk.
  auto d = diagram(
      {{"two", block("play", {{"radius", "0.3 V"}}, {"u"})},
       {"one", block("play", {{"radius", "0.4 V"}, {"sides", "one"}}, {"u"})},
       {"operators", thesis_operators("u")},
       {"both_sides",
        block("prandtl_ishlinskii",
              {{"thresholds", list({0, 0.1, 0.7}, "V")}, {"weights", list({1, 0.4, -0.2}, "um/V")}, {"sides", "two"}},
              {"u"})},
       {"cascade", block("play", {{"radius", "0.2 um"}}, {"operators"})},
       {"inverse",
        block("prandtl_ishlinskii_inverse",
              {{"thresholds", list({0, 0.1, 0.7}, "V")}, {"weights", list({1, 0.4, -0.2}, "um/V")}, {"sides", "two"}},
              {"both_sides"})},
       {"joint", block("backlash", {{"gap", "0.5 V"}}, {"inverse"})},
       {"warm", block("constant", {{"value", "300 K"}})},
       {"tapi", block("tapi",
                      {{"thresholds", list({0, 0.1, 0.7}, "V")},
                       {"weights", list({1, 0.4, 0.2}, "um/V")},
                       {"p_s", "5 V"},
                       {"t_c", "600 K"},
                       {"beta", 0.5},
                       {"a", "0.02 V/K"}},
                      {"u", "warm"})},
       {"bent", block("asymmetric_prandtl_ishlinskii",
                      {{"thresholds", list({0, 0.1, 0.7}, "V")},
                       {"weights", list({1, 0.4, 0.2}, "um/V")},
                       {"saturation", "2 V"},
                       {"bend", "3 V"}},
                      {"u"})},
       {"axes", block("mux", {}, {"u", "u"})},
       {"coupled", block("coupled_tapi",
                         {{"thresholds", list({0, 0.4}, "V")},
                          {"weights", matrix({{1, 0.3}, {0.1, -0.05}, {-0.2, 0.1}, {1.2, 0.1}}, "um/V")},
                          {"p_s", matrix({{0.4, 0.1}, {-0.1, 0.3}}, "um")},
                          {"t_c", "600 K"},
                          {"beta", matrix({{0.5, 1}, {1.2, 0.7}}, "")},
                          {"a", matrix({{0.02, 0.02}, {0.02, 0.02}}, "V/K")}},
                         {"axes", "warm"})},
       {"charge", block("gain", {{"gain", "1 C/V"}}, {"u"})},
       {"stack",
        block("maxwell_capacitor", {{"yield_charges", list({0.4, 1.1}, "C")}, {"elastances", list({0.7, 0.3}, "1/F")}},
              {"charge"})},
       {"used", block("constant", {{"value", 10.0}})},
       {"aged", block("ageing", {{"per_decade", 0.02}, {"first", 100.0}, {"swing", "0.5 V"}}, {"u", "used"})},
       {"behind",
        block("late_prandtl_ishlinskii",
              {{"thresholds", list({0, 0.1, 0.7}, "V")}, {"weights", list({1, 0.4, 0.2}, "um/V")}, {"time", "0.2 s"}},
              {"u"})},
       {"uneven", block("generalized_prandtl_ishlinskii",
                        {{"thresholds", list({0, 0.1, 0.7}, "V")},
                         {"weights", list({1, 0.4, 0.2}, "um/V")},
                         {"sides", "two"},
                         {"lower", "-2 V"},
                         {"upper", "3 V"},
                         {"slope_at_lower", 0.3},
                         {"slope_at_upper", 1.7}},
                        {"u"})},
       {"relays", block("preisach",
                        {{"levels", list({-1, -0.2, 0.5, 2}, "V")},
                         {"weights", list({0.3, 0.2, 0.5, 0.1, 0.4, 0.25}, "um")},
                         {"gain", "1 um/V"}},
                        {"u"})},
       {"late", block("dead_time", {{"delay", "0.3 s"}}, {"cascade"})}},
      {"uneven", "relays", "two", "one", "joint", "tapi", "aged", "behind", "late", "bent", "coupled", "stack"},
      {{"u", "V"}});
  for (const auto& type : registry().types()) {
    const auto* kernel = registry().find(type);
    if (kernel->advance == nullptr) continue;
    const bool here =
        std::any_of(d.blocks.begin(), d.blocks.end(), [&](const auto& b) { return b.second.type == type; });
    EXPECT_TRUE(here) << type << " has memory and is not in this test";
  }
  const auto program = compiled(d);
  std::mt19937 random(7);
  std::normal_distribution<double> move(0, 1);
  std::vector<double> t, v;
  for (int k = 0; k < 2000; ++k) {
    t.push_back(0.01 * k);
    v.push_back((v.empty() ? 0 : v.back()) + move(random));
  }
  auto run = start(*program);
  bind_input(*program, run, "u", series(t, v));
  Work work(*program);
  run.branch = 0.005;
  accept(*program, run, work, 0, run.x.data());  // the start: what a dead time has seen for ever is the first value
  for (int k = 0; k + 1 < 2000; ++k) {
    for (const double at : {t[static_cast<std::size_t>(k)], t[static_cast<std::size_t>(k)] + 0.006}) {
      run.branch = t[static_cast<std::size_t>(k)] + 0.005;
      evaluate_values(*program, run, work, at, run.x.data());
      const auto before = work.y;
      accept(*program, run, work, at, run.x.data());
      evaluate_values(*program, run, work, at, run.x.data());
      ASSERT_EQ(before, work.y) << "t = " << at;
    }
  }
}

TEST(SimulateLaws, ResultsDoNotDependOnTheOutputGrid) {
  for (const auto& d : {bouc_wen_loop(), play_loop()}) {
    const auto program = compiled(d);
    SimulateOptions coarse{.until = 0.4, .every = 0.01}, fine = coarse;
    fine.every = 0.0005;
    const auto a = simulate(*program, start(*program), coarse);
    const auto b = simulate(*program, start(*program), fine);
    EXPECT_EQ(a.statistics.steps, b.statistics.steps);
    std::size_t common = 0;
    for (std::size_t i = 0, k = 0; i < a.t.size(); ++i) {
      while (k + 1 < b.t.size() && b.t[k] < a.t[i]) ++k;
      if (a.t[i] != b.t[k]) continue;  // 0.01 i and 0.0005 k may differ in the last bit
      ++common;
      EXPECT_EQ(a.values[0][i], b.values[0][k]) << "t = " << a.t[i];
      EXPECT_EQ(a.values[1][i], b.values[1][k]) << "t = " << a.t[i];
    }
    EXPECT_GT(common, 20U);
  }
}

TEST(SimulateLaws, TwoRunsInTwoThreadsDoNotSeeEachOther) {
  const auto program = compiled(play_loop());
  auto first = start(*program), second = start(*program);
  set_parameter(*program, second, "amplifier.gain", 2e6);
  const SimulateOptions options{.until = 0.4};
  const auto serial_first = simulate(*program, first, options), serial_second = simulate(*program, second, options);
  ASSERT_NE(serial_first.values, serial_second.values);
  Traces parallel_first, parallel_second;
  {
    std::jthread a([&] { parallel_first = simulate(*program, first, options); });
    std::jthread b([&] { parallel_second = simulate(*program, second, options); });
  }
  EXPECT_EQ(parallel_first.values, serial_first.values);
  EXPECT_EQ(parallel_second.values, serial_second.values);
}

TEST(SimulateLaws, ARunIsNotChangedByASimulationOfIt) {
  const auto program = compiled(play_loop());
  const auto run = start(*program);
  const auto once = simulate(*program, run, {.until = 0.3});
  const auto again = simulate(*program, run, {.until = 0.3});
  EXPECT_EQ(once.values, again.values);
}

/// Least-squares slope of log10(error) over log10(tolerance).
double slope(const std::vector<double>& tolerance, const std::vector<double>& error) {
  double mx = 0, my = 0, xx = 0, xy = 0;
  const auto n = static_cast<double>(error.size());
  for (std::size_t i = 0; i < error.size(); ++i) mx += std::log10(tolerance[i]) / n, my += std::log10(error[i]) / n;
  for (std::size_t i = 0; i < error.size(); ++i) {
    const double x = std::log10(tolerance[i]) - mx;
    xx += x * x;
    xy += x * (std::log10(error[i]) - my);
  }
  return xy / xx;
}

struct Convergence {
  std::vector<double> tolerance, error;
};

Convergence convergence(const Diagram& d, Method method, const std::vector<double>& reference, double until) {
  const auto program = compiled(d);
  Convergence c;
  for (const double tolerance : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
    SimulateOptions options{.until = until, .method = method, .relative_tolerance = tolerance};
    options.instants = grid(0, until, 2000);
    const auto traces = simulate(*program, start(*program), options);
    c.tolerance.push_back(tolerance);
    c.error.push_back(distance(trace(traces), reference) / largest(reference));
  }
  return c;
}

std::vector<double> tight(const Diagram& d, double until) {
  const auto program = compiled(d);
  SimulateOptions options{.until = until, .method = Method::adams, .relative_tolerance = 1e-12};
  options.instants = grid(0, until, 2000);
  return simulate(*program, start(*program), options).values[0];
}

/// The play loop by hand: classical Runge-Kutta, memory committed per step [V, um].
std::vector<double> play_loop_by_hand(double until, int rows, int steps_per_row) {
  std::vector<double> w(10, 0.0), y{0.0};
  double x = 0, v = 0;
  const double h = until / rows / steps_per_row;
  const auto drive = [&](double t, double position) { return 1.5 * (3 - 3 * std::cos(10 * pi * t) - position); };
  const auto force = [&](double u, bool commit) {
    double sum = 0;
    for (std::size_t i = 0; i < 10; ++i) {
      const double p = std::max(u - thesis_thresholds[i], std::min(u, w[i]));
      sum += thesis_weights[i] * p;
      if (commit) w[i] = p;
    }
    return sum;
  };
  const auto acceleration = [&](double t, double a, double b) {
    return 1e6 * (force(drive(t, a), false) - a) - 400 * b;
  };
  for (int k = 0; k < rows * steps_per_row; ++k) {
    const double t = k * h;
    const double v1 = v, a1 = acceleration(t, x, v1);
    const double v2 = v + h / 2 * a1, a2 = acceleration(t + h / 2, x + h / 2 * v1, v2);
    const double v3 = v + h / 2 * a2, a3 = acceleration(t + h / 2, x + h / 2 * v2, v3);
    const double v4 = v + h * a3, a4 = acceleration(t + h, x + h * v3, v4);
    x += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    force(drive(t + h, x), true);
    if ((k + 1) % steps_per_row == 0) y.push_back(x * 1e-6);
  }
  return y;
}

TEST(SimulateConvergence, ThePlayLoopAgreesWithARungeKuttaLoopByHand) {
  // Step 1 us: kinks and peaks inside a step cost about (h w)^2 ~ 1e-9 of the peak; seen 1e-8 between 1 us and 0.5 us.
  EXPECT_LT(distance(tight(play_loop(), 0.4), play_loop_by_hand(0.4, 2000, 200)), 1e-7 * 6e-6);
}

TEST(SimulateConvergence, TheErrorOfAPlayLoopFallsWithTheTolerance) {
  const auto c = convergence(play_loop(), Method::bdf, tight(play_loop(), 0.4), 0.4);
  EXPECT_GE(slope(c.tolerance, c.error), 0.7);
  EXPECT_LT(c.error[2], 1e-4);
}

TEST(SimulateConvergence, TheErrorOfABoucWenLoopFallsWithTheTolerance) {
  const auto c = convergence(bouc_wen_loop(), Method::bdf, tight(bouc_wen_loop(), 0.4), 0.4);
  EXPECT_GE(slope(c.tolerance, c.error), 0.7);
  EXPECT_LT(c.error[2], 1e-5);
}

TEST(SimulateConvergence, TheBoucWenLoopOfTheWorkloadsEndsAtItsReference) {
  // WORKLOADS W1: long double Runge-Kutta, y(2 s) = 1.12925593583e-5 um; y reaches 4.5 um, so that 1e-8 of it is 5e-8
  // um.
  const auto program = compiled(bouc_wen_loop());
  SimulateOptions options{.until = 2, .relative_tolerance = 1e-9};
  options.instants = {2};
  const auto traces = simulate(*program, start(*program), options);
  EXPECT_NEAR(trace(traces)[0] * 1e6, 1.12925593583e-5, 5e-8);
}

// --- reversals ------------------------------------------------------------------------------------------------------

long reversals(const Diagram& d, double until, const SeriesPointer& u = nullptr) {
  const auto program = compiled(d);
  auto run = start(*program);
  if (u) bind_input(*program, run, "u", u);
  return simulate(*program, run, {.until = until, .method = Method::bdf}).statistics.reversals;
}

Diagram play_behind_input() {
  return diagram({{"y", block("play", {{"radius", "0.1 V"}}, {"u"})}}, {"y"}, {{"u", "V"}});
}

TEST(SimulateReversals, RiseHoldFallTurnsOnce) {
  EXPECT_EQ(reversals(play_behind_input(), 3, series({0, 1, 2, 3}, {0, 1, 1, 0})), 1);
}

TEST(SimulateReversals, RiseHoldRiseTurnsNever) {
  EXPECT_EQ(reversals(play_behind_input(), 3, series({0, 1, 2, 3}, {0, 1, 1, 2})), 0);
}

/// u(t) = cos(7 t): a source of its own, with a rate that is zero where it starts.
struct CosineSeven {
  template <class T>
  struct Params {};
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<CosineSeven>& spec) {
    spec.name("cosine_seven", "for this test");
    spec.output(&Out<double>::y, "y", "V", "cos 7 t");
  }
  template <class T>
  static Out<T> output(const Params<T>&, const Time<T>& time) {
    using std::cos;
    return {cos(T{7.0} * time.t)};
  }
  static double shortest_period(const Params<double>&) { return 2 * pi / 7; }
};

/// Smooth everywhere: rises with sin^2, rests at exactly 1 between t = 1 and 2, then goes on up or back down.
template <int Direction>
struct RiseAndRest {
  template <class T>
  struct Params {};
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<RiseAndRest>& spec) {
    spec.name(Direction > 0 ? "rise_rest_rise" : "rise_rest_fall", "for this test");
    spec.output(&Out<double>::y, "y", "V", "the signal");
  }
  template <class T>
  static Out<T> output(const Params<T>&, const Time<T>& time) {
    using std::sin;
    if (time.branch >= 1 && time.branch < 2) return {T{1.0}};
    if (time.branch < 1) {
      const T s = sin(T{pi / 2} * time.t);
      return {s * s};
    }
    const T s = sin(T{pi / 2} * (time.t - T{2.0}));
    return {T{1.0} + T{double{Direction}} * s * s};
  }
  static double next_breakpoint(const Params<double>&, double t) {
    return t < 1 ? 1 : t < 2 ? 2 : std::numeric_limits<double>::infinity();
  }
  static double shortest_period(const Params<double>&) { return 1; }
};

const Registry& with_test_sources() {
  static const Registry all = [] {
    auto r = all_blocks();
    r.add(kernel<CosineSeven>());
    r.add(kernel<RiseAndRest<1>>());
    r.add(kernel<RiseAndRest<-1>>());
    return r;
  }();
  return all;
}

Traces play_behind_source(const std::string& type, double until) {
  const auto program =
      compile(diagram({{"u", block(type, {})}, {"y", block("play", {{"radius", "0.1 V"}}, {"u"})}}, {"y"}),
              with_test_sources());
  return simulate(*program, start(*program), {.until = until});
}

TEST(SimulateReversals, ACosineTurnsAtEachOfItsExtremes) {
  // Extremes of cos 7t behind t = 0 up to 3.3: k pi / 7, k = 1 .. 7.
  const auto traces = play_behind_source("cosine_seven", 3.3);
  EXPECT_EQ(traces.statistics.reversals, 7);
  EXPECT_NEAR(*std::min_element(trace(traces).begin(), trace(traces).end()), -0.9, 1e-10);
}

TEST(SimulateReversals, ASmoothRestDoesNotTurnButWhatFollowsMay) {
  EXPECT_EQ(play_behind_source("rise_rest_fall", 3).statistics.reversals, 1);
  EXPECT_EQ(play_behind_source("rise_rest_rise", 3).statistics.reversals, 0);
}

TEST(SimulateReversals, TheyAreLocatedAlsoBehindDynamics) {
  // A sine through a lag into a play: two reversals a period, the peak 1/sqrt(1 + (w tau)^2) of the settled wave.
  const auto program = compiled(diagram({{"u", block("sine", {{"amplitude", "1 V"}, {"frequency", "5 Hz"}})},
                                         {"x", block("lag", {{"times", list({0.002}, "s")}}, {"u"})},
                                         {"y", block("play", {{"radius", "0.1 V"}}, {"x"})}},
                                        {"y"}));
  const auto traces = simulate(*program, start(*program), {.until = 1, .relative_tolerance = 1e-8});
  EXPECT_EQ(traces.statistics.reversals, 10);
  const double a = 2 * pi * 5 * 0.002;
  EXPECT_NEAR(largest(trace(traces)), 1 / std::sqrt(1 + a * a) - 0.1, 1e-6);
}

TEST(SimulateReversals, AccuracyDependsOnThemCorrectnessDoesNot) {
  const auto program = compiled(play_loop());
  const auto reference = tight(play_loop(), 0.4);
  SimulateOptions options{.until = 0.4, .relative_tolerance = 1e-8};
  options.instants = grid(0, 0.4, 2000);
  const auto with = simulate(*program, start(*program), options);
  options.reversal_events = false;
  const auto without = simulate(*program, start(*program), options);
  const double error_with = distance(trace(with), reference), error_without = distance(trace(without), reference);
  EXPECT_LT(error_with, error_without);
  EXPECT_LT(error_without, 1e-3 * largest(reference));
}

}  // namespace
}  // namespace hysteron
