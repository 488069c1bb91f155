// Rows passed many at once against rows passed one by one: a sampled block that never runs makes the same diagram take
// the second way. States that are not linear against closed forms, golden traces and the integrator.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "engine/rowwise/advance.h"
#include "tests/engine/allocations.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;
using Blocks = std::vector<std::pair<std::string, Node>>;
using Values = std::vector<std::vector<double>>;

// The same recursions in another order of additions, some thousand rows of stable systems.
constexpr double exact = 1e-12;

SeriesPointer wave(std::vector<double> t, int seed, Between between) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> phase(0, 6.28);
  const double a = phase(random), b = phase(random);
  std::vector<double> v;
  for (const double s : t) v.push_back(3 - 2 * std::cos(31 * s + a) + std::sin(83 * s + b));
  return series(std::move(t), std::move(v), between);
}

std::vector<double> uneven(double h, int n) {
  std::vector<double> t;
  for (int k = 0; k < n; ++k) t.push_back(h * (k + 0.3 * std::sin(5.0 * k)));
  return t;
}

hysteron::Run bound(const Program& program, Between between, const std::vector<double>& times) {
  auto run = start(program);
  bind_input(program, run, "u", wave(times, 1, between));
  bind_input(program, run, "v", wave(grid(0, 1, 700), 2, Between::linear));
  return run;
}

ProgramPointer program_of(Blocks blocks, std::vector<std::string> record, bool one_by_one) {
  blocks.insert(blocks.begin(), {"both", block("sum", {}, {"u", "v"})});
  if (one_by_one) blocks.push_back({"never", block("sample_hold", {{"period", "1 s"}, {"offset", "1000 s"}}, {"u"})});
  record.insert(record.end(), {"u", "both"});
  if (one_by_one) record.push_back("never");
  return compiled(diagram(blocks, record, {{"u", "V"}, {"v", "V"}}));
}

/// Largest difference between the two ways, relative to the largest value of each signal.
double difference(const Blocks& blocks, const std::vector<std::string>& record, const std::vector<double>& instants,
                  int substeps, Between between, bool at_rest = true) {
  const auto fast = program_of(blocks, record, false), slow = program_of(blocks, record, true);
  Values a, b;
  const auto inputs = uneven(0.001, 900);
  const AdvanceOptions options{.substeps = substeps, .at_rest = at_rest};
  Advance(fast, fast->record_signals)(bound(*fast, between, inputs), instants, options, a);
  Advance(slow, slow->record_signals)(bound(*slow, between, inputs), instants, options, b);
  EXPECT_EQ(a.size() + 1, b.size());
  double worst = 0;
  for (std::size_t s = 0; s < a.size(); ++s) worst = std::max(worst, distance(a[s], b[s]) / largest(b[s]));
  return worst;
}

Node lags(const std::string& in, int count) {
  std::vector<double> times;
  for (int i = 0; i < count; ++i) times.push_back(0.002 * (1 + 0.3 * i));
  return block("lag", {{"times", list(times, "s")}}, {in});
}
Node play_on(const std::string& in) { return block("play", {{"radius", "0.4 V"}}, {in}); }
Node spring_on(const std::string& in) {
  return block("mass_on_stiffening_spring",
               {{"mass", "1 kg"}, {"damping", "80 N s/m"}, {"stiffness", "1e5 N/m"}, {"stiffening", "4e13 N/m^3"}},
               {in});
}
Node newton(const std::string& in) { return block("gain", {{"gain", "1 N/V"}}, {in}); }

Node hum_on(const std::string& in) {
  return block("mains_interference",
               {{"frequency", "50 Hz"}, {"cosine", list({0.1, 0.02}, "V")}, {"sine", list({-0.3, 0.05}, "V")}}, {in});
}

struct Case {
  const char* name;
  Blocks blocks;
  std::vector<std::string> record;
};

std::vector<Case> cases() {
  std::vector<Case> list;
  for (int n = 1; n <= 10; ++n) list.push_back({"lags", {{"x", lags("both", n)}, {"y", lags("u", 1)}}, {"x", "y"}});
  list.push_back({"loop",
                  {{"e", block("sum", {{"signs", "+-"}}, {"both", "x"})},
                   {"c", block("pi_controller", {{"kp", 0.5}, {"ki", "80 1/s"}}, {"e"})},
                   {"x", lags("c", 2)}},
                  {"x", "c", "e"}});
  list.push_back({"static", {{"p", block("product", {}, {"u", "v"})}, {"x", lags("p", 3)}}, {"x", "p"}});
  list.push_back({"operators",
                  {{"w", play_on("both")},
                   {"core", thesis_operators("w")},
                   {"x", lags("core", 2)},
                   {"z", block("play", {{"radius", "0.4 um"}}, {"x"})}},
                  {"w", "core", "x", "z"}});
  list.push_back({"bouc_wen",
                  {{"x", lags("u", 2)},
                   {"law", thesis_bouc_wen("x")},
                   {"second", thesis_bouc_wen("v")},
                   {"sum", block("sum", {}, {"law", "second"})},
                   {"y", lags("sum", 3)}},
                  {"x", "law", "second", "y"}});
  list.push_back({"spring",
                  {{"force", newton("both")}, {"mass", spring_on("force")}, {"y", lags("mass.position", 1)}},
                  {"mass.position", "mass.velocity", "y"}});
  list.push_back({"functions of time on top",
                  {{"x", lags("both", 2)},
                   {"w", play_on("x")},
                   {"hum", hum_on("x")},
                   {"drift", block("sensor_drift", {{"rate", "0.3 V/s"}, {"zero", "0.2 V"}}, {"w"})},
                   {"sum", block("sum", {}, {"hum", "drift"})},
                   {"y", block("product", {}, {"sum", "hum"})}},
                  {"x", "w", "hum", "drift", "y"}});
  return list;
}

TEST(AdvanceRows, ManyAtOnceAreTheSameAsOneByOne) {
  for (const auto& c : cases())
    for (const Between between : {Between::linear, Between::hold})
      for (const int substeps : {1, 4})
        EXPECT_LT(difference(c.blocks, c.record, grid(0, 0.9, 600), substeps, between), exact)
            << c.name << " " << c.record.size() << (between == Between::hold ? " held " : " linear ") << substeps;
}

TEST(AdvanceRows, ChunksOfRowsLeaveNoTrace) {
  // Rows of the chunk (256), one less, one more, and substeps that do not divide it.
  const auto all = cases();
  const Case& c = all[all.size() - 2];
  for (const int rows : {1, 2, 255, 256, 257, 513})
    for (const int substeps : {1, 3, 300})
      EXPECT_LT(difference(c.blocks, c.record, grid(0, 0.001 * rows, rows), substeps, Between::linear), exact)
          << rows << " " << substeps;
}

TEST(AdvanceRows, DeadTimesAndAStartThatIsNoRestAreTheSame) {
  const Blocks blocks{{"late", block("dead_time", {{"delay", "7.3 ms"}}, {"both"})},
                      {"x", lags("late", 2)},
                      {"later", block("dead_time", {{"delay", "1.1 ms"}}, {"x"})}};
  for (const bool at_rest : {true, false})
    for (const int substeps : {1, 2})
      EXPECT_LT(difference(blocks, {"late", "x", "later"}, grid(0, 0.8, 500), substeps, Between::linear, at_rest),
                exact);
  // Jumps of a held input behind a bend and behind a dead time go point by point on both ways.
  EXPECT_LT(difference({{"late", block("dead_time", {{"delay", "7.3 ms"}}, {"u"})}, {"w", play_on("late")}}, {"w"},
                       grid(0, 0.8, 500), 1, Between::hold),
            exact);
}

TEST(AdvanceRows, AnotherRecordingOrOtherInstantsAreNotTakenForTheFirst) {
  const auto program = program_of({{"x", lags("both", 2)}}, {"x"}, false);
  Advance advance(program, program->record_signals);
  auto run = bound(*program, Between::linear, uneven(0.001, 900));
  auto instants = grid(0, 0.5, 300);
  Values first, other, again, fresh;
  advance(run, instants, {}, first);
  auto second = run;
  bind_input(*program, second, "u", wave(uneven(0.0011, 900), 7, Between::linear));
  advance(second, instants, {}, other);
  Advance(program, program->record_signals)(second, instants, {}, fresh);
  EXPECT_EQ(other, fresh);
  EXPECT_GT(distance(first[0], other[0]), 0.1);
  advance(run, instants, {}, again);
  EXPECT_EQ(first, again);
  instants[150] += 3e-4;  // the same vector, another time in it
  advance(run, instants, {}, other);
  Advance(program, program->record_signals)(run, instants, {}, fresh);
  EXPECT_EQ(other, fresh);
}

TEST(AdvanceRows, ParametersOfTheRunCountEachTime) {
  const auto program = program_of({{"x", lags("both", 2)}, {"core", thesis_operators("x")}}, {"x", "core"}, false);
  Advance advance(program, program->record_signals);
  auto run = bound(*program, Between::linear, uneven(0.001, 900));
  const auto instants = std::make_shared<const std::vector<double>>(grid(0, 0.5, 300));
  Values before, changed, after, fresh;
  advance(run, instants, {}, before);
  auto other = run;
  set_parameter(*program, other, "x.times[1]", 0.009);
  set_parameter(*program, other, "core.weights[3]", 1e-6);
  advance(other, instants, {}, changed);
  Advance(program, program->record_signals)(other, instants, {}, fresh);
  EXPECT_EQ(changed, fresh);
  EXPECT_NE(changed, before);
  advance(run, instants, {}, after);
  EXPECT_EQ(after, before);
}

TEST(AdvanceRows, NothingIsAllocatedRowByRow) {
  const auto program =
      program_of({{"x", lags("u", 2)}, {"law", thesis_bouc_wen("x")}, {"hum", hum_on("x")}, {"y", lags("law", 3)}},
                 {"y", "hum"}, false);
  const auto count = [&](int rows) {
    Advance advance(program, program->record_signals);
    const auto run = bound(*program, Between::linear, grid(0, 1, 700));
    const auto instants = std::make_shared<const std::vector<double>>(grid(0, rows / 700.0, rows));
    Values values;
    advance(run, instants, {.substeps = 2}, values);
    const long before = allocations();
    advance(run, instants, {.substeps = 2}, values);
    return allocations() - before;
  };
  EXPECT_EQ(count(10), count(700));
}

TEST(AdvanceRows, AValueThatIsNoneNamesSignalAndTime) {
  const auto program = program_of({{"x", lags("u", 2)}, {"w", play_on("x")}}, {"w"}, false);
  auto run = start(*program);
  const auto t = grid(0, 1, 1000);
  std::vector<double> v(t.size(), 1.0);
  v[700] = std::numeric_limits<double>::quiet_NaN();
  bind_input(*program, run, "u", series(t, v));
  bind_input(*program, run, "v", series(t, std::vector<double>(t.size(), 1.0)));
  Values values;
  try {
    Advance(program, program->record_signals)(run, t, {}, values);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault, Fault::numerics);
    EXPECT_EQ(error.problems.front().code, "diverged");
    EXPECT_EQ(error.problems.front().path, "w");
    EXPECT_NE(error.problems.front().what.find("0.7 s"), std::string::npos) << error.problems.front().what;
  }
}

// --- states that are not linear

/// Signal `y` of a diagram of one input, with substeps.
std::vector<double> response(const Node& law, const SeriesPointer& u, const std::vector<double>& instants,
                             int substeps) {
  const auto program = compiled(diagram({{"y", law}}, {"y"}, {{"u", "V"}}));
  EXPECT_EQ(why_not_exact(*program), "");
  auto run = start(*program);
  bind_input(*program, run, "u", u);
  Values values;
  Advance(program, program->record_signals)(run, instants, {.substeps = substeps}, values);
  return values[0];
}

// z' = (alpha - (beta + gamma) z) u' for rising u and z >= 0.
double rising(double z, double move) {
  const double k = 0.2418 + 0.0237, top = 0.6187e-6 / k;
  return top + (z - top) * std::exp(-k * move);
}

TEST(AdvanceStates, ARampIntoBoucWenIsItsClosedForm) {
  const auto t = grid(0, 1, 100);
  std::vector<double> u;
  for (const double s : t) u.push_back(6 * s * s);  // any rise: the law knows no time
  const auto y = response(thesis_bouc_wen("u"), series(t, u), t, 2);
  // One step of order four over a rise of 0.06 V at most: (0.2655 * 0.06)^5/120 of 2.3 um, a hundred times.
  for (std::size_t k = 0; k < t.size(); ++k) EXPECT_NEAR(y[k], 1.6126e-6 * u[k] - rising(0, u[k]), 1e-15) << k;
}

TEST(AdvanceStates, AJumpIntoBoucWenIsTheRamp) {
  const auto t = grid(0, 1, 4);
  const std::vector<double> u{0, 1, 1, 4, 4.5};
  const auto y = response(thesis_bouc_wen("u"), series(t, u, Between::hold), t, 16);
  // 64 steps along a jump of 3 V.
  for (std::size_t k = 0; k < t.size(); ++k) EXPECT_NEAR(y[k], 1.6126e-6 * u[k] - rising(0, u[k]), 1e-15) << k;
}

TEST(AdvanceStates, AJumpIntoAGuideIsARampTooFastForAnyExcess) {
  const Node sticky =
      block("guide_friction",
            {{"level", "0.2 V"}, {"slip_distance", "0.3 V"}, {"excess", 0.5}, {"stribeck_velocity", "1 V/s"}}, {"u"});
  Node plain = sticky;
  plain.parameters.erase("excess");
  const auto t = grid(0, 1, 4);
  const auto u = series(t, {0, 1, 1, 0.4, 0.5}, Between::hold);
  const auto y = response(sticky, u, t, 1);
  EXPECT_EQ(y, response(plain, u, t, 1)) << "a jump is too fast for the excess";
  // y + level s = 1 with s = 1 - exp(-y/distance), and 0.4 from there.
  EXPECT_NEAR(y[1] + 0.2 * (1 - std::exp(-y[1] / 0.3)), 1, 1e-14);
  const double held = (1 - y[1]) / 0.2;
  EXPECT_NEAR(y[3] + 0.2 * (-1 + (1 + held) * std::exp((y[3] - y[1]) / 0.3)), 0.4, 1e-14);
  // The integrator follows the same path, to a hundred of its tolerances.
  const auto program = compiled(diagram({{"y", sticky}}, {"y"}, {{"u", "V"}}));
  auto run = start(*program);
  bind_input(*program, run, "u", u);
  SimulateOptions options{.method = Method::bdf, .relative_tolerance = 1e-9};
  options.instants = t;
  EXPECT_LT(distance(simulate(*program, run, options).values[0], y), 1e-7);
}

TEST(AdvanceStates, GoldenTracesAreFollowedAtTheirOwnRows) {
  for (const bool bouc_wen : {true, false}) {
    auto columns = golden(bouc_wen ? "bw_forward_sine" : "ja_forward_sine");
    if (columns.empty()) GTEST_SKIP() << "no ../shared/thesis/golden here";
    auto expected = columns[bouc_wen ? "y" : "P"];
    for (auto& v : expected) v *= 1e-6;
    const auto law = bouc_wen ? thesis_bouc_wen("u")
                              : block("jiles_atherton",
                                      {{"p_s", "55.9973 um"},
                                       {"a", "48.5843 V"},
                                       {"alpha", "0.2512 V/um"},
                                       {"k", "3.8892 V"},
                                       {"c", 0.6929}},
                                      {"u"});
    const auto u = series(columns["t"], columns["u"]);
    // Laws of the way of u, not of time: rows lie on it. The trace gives ten digits, its peaks are rows.
    EXPECT_LT(distance(response(law, u, u->t, 4), expected), 1e-8 * largest(expected)) << bouc_wen;
  }
}

/// The exact advance against bdf, both at `tolerance`, relative to the largest value of each signal.
double disagreement(const Blocks& blocks, const std::vector<std::string>& record, Between between, double tolerance,
                    bool at_rest) {
  const auto program = compiled(diagram(blocks, record, {{"u", "V"}}));
  auto run = start(*program);
  const auto u = wave(grid(0, 0.3, 300), 3, between);
  bind_input(*program, run, "u", u);
  SimulateOptions options{.method = Method::automatic, .relative_tolerance = tolerance, .at_rest = at_rest};
  options.instants = u->t;
  const auto ours = simulate(*program, run, options);
  EXPECT_EQ(ours.statistics.method, "exact");
  options.method = Method::bdf;
  const auto bdf = simulate(*program, run, options);
  double worst = 0;
  for (std::size_t s = 0; s < ours.values.size(); ++s)
    worst = std::max(worst, distance(ours.values[s], bdf.values[s]) / largest(ours.values[s]));
  return worst;
}

TEST(AdvanceStates, AgreeWithTheIntegratorBeforeAndBehindDynamics) {
  const Blocks hysteresis{{"x", lags("u", 2)}, {"law", thesis_bouc_wen("x")}, {"y", lags("law", 2)}};
  // Ten times the tolerance is what either may be off by (benchmarks/accuracy.cpp).
  EXPECT_LT(disagreement(hysteresis, {"law", "y"}, Between::linear, 1e-6, false), 20e-6);
  EXPECT_LT(disagreement(hysteresis, {"law", "y"}, Between::hold, 1e-6, false), 20e-6);
  const Blocks mass{{"force", newton("u")}, {"m", spring_on("force")}};
  for (const bool at_rest : {false, true}) {
    EXPECT_LT(disagreement(mass, {"m.position", "m.velocity"}, Between::linear, 1e-6, at_rest), 20e-6);
    EXPECT_LT(disagreement(mass, {"m.position"}, Between::hold, 1e-6, at_rest), 50e-6);  // 300 restarts
  }
}

TEST(AdvanceStates, AJumpThroughABendIsFollowedOnItsWay) {
  // u^2 of a jump from -1 to 2 falls to 0 before it rises to 4.
  const Blocks blocks{{"square", block("product", {}, {"u", "u"})},
                      {"scaled", block("gain", {{"gain", "1 1/V"}}, {"square"})},
                      {"y", thesis_bouc_wen("scaled")}};
  const auto program = compiled(diagram(blocks, {"y"}, {{"u", "V"}}));
  auto run = start(*program);
  bind_input(*program, run, "u", series({0, 1, 2, 3}, {0, -1, 2, 2}, Between::hold));
  Values values;
  Advance(program, program->record_signals)(run, grid(0, 3, 3), {}, values);
  double z = rising(0, 1);  // then down to u^2 = 0: z' = (alpha - gamma z + beta z) u' while z >= 0
  const double k = 0.2418 - 0.0237, bottom = -0.6187e-6 / k;
  // z falls through zero at the move d, and goes on with the signs of |z| turned.
  const double d = std::log((z - bottom) / -bottom) / k;
  ASSERT_LT(d, 1);
  z = -rising(0, 1 - d);
  // up from a negative z: z' = (alpha + (beta - gamma)|z| ...) until zero, then as from rest.
  const double e = std::log((-z - bottom) / -bottom) / k;
  z = rising(0, 4 - e);
  // The turn at u = 0 lies inside the 22nd of 64 pieces; missed by its height (1/64 V)^2 at most.
  EXPECT_NEAR(values[0][2], 1.6126e-6 * 4 - z, 2.5e-4 * 1.6e-6);
}

TEST(AdvanceStates, SampledStepsIntoARateIndependentLawAreFollowedAtTheirInstants) {
  const auto program = compiled(diagram({{"held", block("sample_hold", {{"period", "10 ms"}}, {"u"})},
                                         {"law", thesis_bouc_wen("held")},
                                         {"y", lags("law", 1)}},
                                        {"law", "y", "held"}, {{"u", "V"}}));
  auto run = start(*program);
  bind_input(*program, run, "u", wave(grid(0, 0.3, 300), 3, Between::linear));
  SimulateOptions options{.until = 0.3, .every = 1e-3, .relative_tolerance = 1e-7};
  const auto ours = simulate(*program, run, options);
  EXPECT_EQ(ours.statistics.method, "exact");
  options.method = Method::bdf;
  const auto bdf = simulate(*program, run, options);
  for (std::size_t s = 0; s < 3; ++s)
    EXPECT_LT(distance(ours.values[s], bdf.values[s]) / largest(bdf.values[s]), 20e-7) << s;
}

TEST(AdvanceStates, RowsTooLongForThemAreRefinedNotLost) {
  // Rows of 20 ms at an oscillation of 50 Hz: one step of Runge-Kutta a row runs away.
  const auto program =
      compiled(diagram({{"force", newton("u")}, {"m", spring_on("force")}}, {"m.position"}, {{"u", "V"}}));
  auto run = start(*program);
  bind_input(*program, run, "u", wave(grid(0, 2, 100), 3, Between::linear));
  SimulateOptions options{.until = 2, .every = 0.02, .relative_tolerance = 1e-6};
  const auto ours = simulate(*program, run, options);
  EXPECT_EQ(ours.statistics.method, "exact");
  options.method = Method::bdf;
  EXPECT_LT(distance(trace(ours), trace(simulate(*program, run, options))) / largest(trace(ours)), 20e-6);
}

}  // namespace
}  // namespace hysteron
