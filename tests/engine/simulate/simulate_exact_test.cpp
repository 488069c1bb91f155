// The exact advance and CVODE are two ways to the same result; simulate() takes the first where the diagram allows it.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

/// A smooth but irregular recording, 1 ms a row.
SeriesPointer recording(Between between) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> phase(0, 6.28);
  const double a = phase(random), b = phase(random), c = phase(random);
  std::vector<double> t, v;
  for (int k = 0; k <= 600; ++k) {
    t.push_back(0.001 * k);
    const double s = t.back();
    v.push_back(3 - 1.5 * std::cos(31 * s + a) + std::sin(83 * s + b) - 0.4 * std::cos(170 * s + c));
  }
  return series(t, v, between);
}

/// Both methods on one diagram; the largest difference relative to the largest value.
double disagreement(const Diagram& d, Between between, double tolerance, bool at_rest) {
  const auto program = compiled(d);
  auto run = start(*program);
  const auto u = recording(between);
  bind_input(*program, run, "u", u);
  SimulateOptions options{.method = Method::automatic, .relative_tolerance = tolerance, .at_rest = at_rest};
  options.instants = u->t;
  const auto exact = simulate(*program, run, options);
  EXPECT_EQ(exact.statistics.method, "exact");
  options.method = Method::bdf;
  const auto bdf = simulate(*program, run, options);
  EXPECT_EQ(bdf.statistics.method, "bdf");
  return distance(trace(exact), trace(bdf)) / largest(trace(exact));
}

Node two_poles(const std::string& in) { return block("lag", {{"times", list({0.004, 0.0015}, "s")}}, {in}); }

TEST(ExactAndCvode, AgreeOnLinearDiagrams) {
  const auto d = diagram(
      {{"slow", block("creep", {{"amounts", list({0.02, 0.03})}, {"times", list({0.1, 1}, "s")}}, {"u"})},
       {"plant",
        block("transfer_function", {{"gain", "1 um/V"}, {"num", list({9e4})}, {"den", list({1, 120, 9e4})}}, {"slow"})},
       {"y", two_poles("plant")}},
      {"y"}, {{"u", "V"}});
  for (const bool at_rest : {false, true}) {
    EXPECT_LT(disagreement(d, Between::linear, 1e-8, at_rest), 20e-8);
    EXPECT_LT(disagreement(d, Between::hold, 1e-8, at_rest), 50e-8);  // 600 restarts
  }
}

TEST(ExactAndCvode, AgreeOnALinearLoop) {
  const auto d = diagram({{"e", block("sum", {{"signs", "+-"}}, {"u", "y"})},
                          {"c", block("pi_controller", {{"kp", 0.5}, {"ki", "80 1/s"}}, {"e"})},
                          {"y", two_poles("c")}},
                         {"y"}, {{"u", "V"}});
  EXPECT_LT(disagreement(d, Between::linear, 1e-8, true), 20e-8);
}

TEST(ExactAndCvode, AgreeOnMemoryBeforeAndBehindDynamics) {
  const auto before = diagram({{"core", thesis_operators("u")}, {"y", two_poles("core")}}, {"y"}, {{"u", "V"}});
  const auto behind = diagram({{"lag", two_poles("u")}, {"y", thesis_operators("lag")}}, {"y"}, {{"u", "V"}});
  // Rows are refined until nothing moves by the tolerance; what is left is of its size, and so is the error of the
  // other.
  EXPECT_LT(disagreement(before, Between::linear, 1e-6, true), 20e-6);
  EXPECT_LT(disagreement(behind, Between::linear, 1e-6, true), 20e-6);
}

TEST(ExactAndCvode, AgreeOnMemoryAlone) {
  const auto d = diagram({{"y", thesis_operators("u")}}, {"y"}, {{"u", "V"}});
  EXPECT_LT(disagreement(d, Between::linear, 1e-8, false), 1e-12);
  EXPECT_LT(disagreement(d, Between::hold, 1e-8, false), 1e-12);
}

TEST(ExactAndCvode, AgreeOnADeadTime) {
  const auto d = diagram({{"late", block("dead_time", {{"delay", "7.3 ms"}}, {"u"})}, {"y", two_poles("late")}}, {"y"},
                         {{"u", "V"}});
  EXPECT_LT(disagreement(d, Between::linear, 1e-6, true), 20e-6);
  const auto behind =
      diagram({{"x", two_poles("u")}, {"y", block("dead_time", {{"delay", "7.3 ms"}}, {"x"})}}, {"y"}, {{"u", "V"}});
  EXPECT_LT(disagreement(behind, Between::linear, 1e-6, true), 20e-6);
}

TEST(ExactAndCvode, AgreeOnWhichSideOfAHeldSampleADeadTimeShows) {
  // 7 ms is a whole number of rows: every row looks back at a jump, and must see the value behind it.
  const auto d = diagram({{"y", block("dead_time", {{"delay", "7 ms"}}, {"u"})}}, {"y"}, {{"u", "V"}});
  EXPECT_EQ(disagreement(d, Between::hold, 1e-6, true), 0);
  const auto program = compiled(d);
  auto run = start(*program);
  const auto u = recording(Between::hold);
  bind_input(*program, run, "u", u);
  SimulateOptions options;
  options.instants = u->t;
  const auto traces = simulate(*program, run, options);
  for (std::size_t k = 0; k < u->t.size(); ++k) EXPECT_EQ(trace(traces)[k], u->v[k < 7 ? 0 : k - 7]) << "row " << k;
}

TEST(ExactAndCvode, TheExactOneTakesOverOnlyWhereEverySourceIsARecording) {
  const auto program = compiled(diagram({{"w", block("sine", {{"amplitude", "1 V"}, {"frequency", "3 Hz"}})},
                                         {"s", block("sum", {}, {"u", "w"})},
                                         {"y", two_poles("s")}},
                                        {"y"}, {{"u", "V"}}));
  auto run = start(*program);
  bind_input(*program, run, "u", recording(Between::linear));
  EXPECT_EQ(simulate(*program, run, {.until = 0.1}).statistics.method, "bdf");
}

TEST(ExactAndCvode, TheExactOneMayBeginBeforeTheFirstInstant) {
  const auto program = compiled(diagram({{"y", two_poles("u")}}, {"y"}, {{"u", "V"}}));
  auto run = start(*program);
  bind_input(*program, run, "u", recording(Between::linear));
  SimulateOptions options;
  options.instants = {0.2, 0.3, 0.5};
  const auto late = simulate(*program, run, options);
  ASSERT_EQ(trace(late).size(), 3U);
  options.method = Method::bdf;
  options.relative_tolerance = 1e-8;
  EXPECT_LT(distance(trace(late), trace(simulate(*program, run, options))), 1e-6);
}

}  // namespace
}  // namespace hysteron
