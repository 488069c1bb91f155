// dx/dt by weighted sums against dx/dt block by block.
#include "engine/simulate/linear_row_kernel.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/diagram/index.h"
#include "engine/program/needed.h"
#include "engine/program/nominal.h"
#include "tests/engine/allocations.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

NumberMatrix matrix(std::initializer_list<std::initializer_list<double>> rows) {
  NumberMatrix m;
  for (const auto& row : rows) {
    m.rows.emplace_back();
    for (const double v : row) m.rows.back().push_back({v, {}});
  }
  return m;
}

/// N lags in a chain with feedback from neighbour to neighbour.
Diagram chain(int n) {
  Diagram d;
  d.blocks["drive"] = block("sine", {{"amplitude", "1 V"}, {"frequency", "5 Hz"}});
  for (int i = 0; i < n; ++i) {
    const auto name = [](const char* what, int k) { return what + std::to_string(k); };
    d.blocks[name("back", i)] = block("gain", {{"gain", 0.5}}, {name("x", (i + 1) % n)});
    d.blocks[name("in", i)] = block("sum", {{"signs", "+-"}}, {i == 0 ? "drive" : name("x", i - 1), name("back", i)});
    d.blocks[name("x", i)] = block("lag", {{"times", list({0.01 + 0.001 * i}, "s")}}, {name("in", i)});
  }
  d.record = {"x0"};
  return d;
}

/// Linear blocks of all kinds: direct paths, offsets, vectors, a gain of zero, one signal read by many, and a loop.
Diagram all_kinds() {
  auto d = diagram(
      {{"u", block("sine", {{"amplitude", "1 V"}, {"frequency", "5 Hz"}})},
       {"shown", block("calibration", {{"gain", 1.5}, {"offset", "0.25 V"}}, {"u"})},
       {"direct",
        block("transfer_function", {{"gain", 2.0}, {"num", list({1, 3, 1})}, {"den", list({2, 3, 50})}}, {"shown"})},
       {"creeping", block("creep", {{"amounts", list({0.1, 0.2})}, {"times", list({0.1, 1}, "s")}}, {"direct"})},
       {"none", block("gain", {{"gain", 0.0}}, {"creeping"})},
       {"all", block("sum", {{"signs", "+-++"}}, {"none", "creeping", "shown", "direct"})},
       {"both", block("mux", {}, {"all", "direct"})},
       {"system", block("state_space",
                        {{"a", matrix({{0, 1}, {-400, -4}})},
                         {"b", matrix({{0, 1}, {400, 2}})},
                         {"c", matrix({{1, 0}, {0.5, 2}})},
                         {"input_unit", "V"},
                         {"output_unit", "V"}},
                        {"both"})},
       {"first", block("select", {{"indices", list({0})}}, {"system"})},
       {"hysteresis", thesis_bouc_wen("all")},
       {"error", block("sum", {{"signs", "+-"}}, {"first", "back"})},
       {"back", block("gain", {{"gain", 3.0}}, {"error"})},
       {"controller", block("pi_controller", {{"kp", 2.0}, {"ki", "5 1/s"}}, {"error"})},
       {"end", block("integrator", {}, {"controller"})}},
      {"hysteresis", "end"});
  return d;
}

class Folded : public testing::TestWithParam<int> {
 protected:
  static Diagram diagram_of(int which) {
    return which == 0 ? bouc_wen_loop() : which == 1 ? play_loop() : which == 2 ? chain(12) : all_kinds();
  }
};

TEST_P(Folded, GivesTheDerivativesOfTheBlocksToRounding) {
  const auto program = compiled(diagram_of(GetParam()));
  auto run = start(*program);
  Work work(*program), other(*program);
  LinearRowKernel folded(*program, run, work);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto nominal = nominal_states(*program, run);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> x;
    for (const double size : nominal) x.push_back(size * normal(random));
    const double t = 0.013 * trial;
    run.branch = t;
    folded(run, t, x.data());
    evaluate_derivatives(*program, run, other, t, x.data());
    double size = 0;
    for (const double v : other.dx) size = std::max(size, std::abs(v));
    for (std::size_t i = 0; i < x.size(); ++i)
      // Sums of up to twenty terms that may cancel, none much larger than the largest derivative.
      EXPECT_NEAR(work.dx[i], other.dx[i], 1e-13 * size) << program->state_names[i] << " in trial " << trial;
  }
}

TEST_P(Folded, TakesNothingFromTheHeap) {
  const auto program = compiled(diagram_of(GetParam()));
  const auto run = start(*program);
  Work work(*program);
  LinearRowKernel folded(*program, run, work);
  folded(run, 0, run.x.data());
  const auto before = allocations();
  for (int i = 0; i < 100; ++i) folded(run, 1e-3 * i, run.x.data());
  EXPECT_EQ(allocations(), before);
}

TEST_P(Folded, GivesTheSameBitsWhereItsInstantsWereForetold) {
  const auto program = compiled(diagram_of(GetParam()));
  const auto run = start(*program);
  Work work(*program), other(*program);
  LinearRowKernel foretold(*program, run, work), asked(*program, run, other);
  foretold.foretell(run, std::vector<double>{0, 0.01, 0.02, 0.03, 0.04});
  std::vector<double> x;
  for (const double size : nominal_states(*program, run)) x.push_back(0.3 * size);
  // One comes twice, one was not foretold, one does not come, and the first comes again.
  for (const double t : {0.0, 0.01, 0.01, 0.015, 0.02, 0.04, 0.0}) {
    foretold(run, t, x.data());
    asked(run, t, x.data());
    EXPECT_EQ(work.dx, other.dx) << t;
  }
}

INSTANTIATE_TEST_SUITE_P(Diagrams, Folded, testing::Range(0, 4));

TEST(NeededSteps, OfASignalAreThoseOnWhichItDependsAndGiveItsValue) {
  const auto program = compiled(all_kinds());
  const auto run = start(*program);
  std::vector<double> x;
  for (int i = 0; i < program->n_x; ++i) x.push_back(0.1 * (i + 1));
  Work whole(*program);
  evaluate_values(*program, run, whole, 0.3, x.data());
  for (int s = 0; s < program->n_y; ++s) {
    Work work(*program);
    const auto steps = steps_for(*program, {s});
    evaluate_steps(*program, run, work, 0.3, x.data(), steps);
    EXPECT_EQ(work.y[at(s)], whole.y[at(s)]) << program->signals[at(s)].path;
    EXPECT_LE(steps.size(), program->all_values.size());
  }
  EXPECT_EQ(steps_for(*program, {program->signal("end")}).size(), 1U);    // an integrator: its state
  EXPECT_EQ(steps_for(*program, {program->signal("shown")}).size(), 2U);  // and the sine
  // The loop of error and back, and from it select, state space (no direct path).
  EXPECT_EQ(steps_for(*program, {program->signal("controller")}).size(), 4U);
}

TEST(LinearRowKernel, OfALinearChainIsOneRowPerState) {
  const auto program = compiled(chain(12));
  const auto run = start(*program);
  Work work(*program);
  const LinearRowKernel folded(*program, run, work);
  EXPECT_EQ(folded.rows(), 12);
  EXPECT_EQ(folded.terms(), 36);  // itself, the one before (or the drive), the next
  EXPECT_EQ(folded.calls(), 1);   // the sine
}

TEST(LinearRowKernel, CallsFewerFunctionsThanThereAreSteps) {
  const auto program = compiled(bouc_wen_loop());
  const auto run = start(*program);
  Work work(*program);
  const LinearRowKernel folded(*program, run, work);
  EXPECT_EQ(folded.calls(), 3);  // the sine, and the hysteresis' output and derivative
  EXPECT_LT(folded.calls() + folded.rows(), static_cast<int>(program->derivative_steps.size()) + 1);
}

TEST(LinearRowKernel, AsksSourcesOnceAtAnInstantAndSeesTheNextOne) {
  const auto program = compiled(chain(3));
  auto run = start(*program);
  Work work(*program), other(*program);
  LinearRowKernel folded(*program, run, work);
  const std::vector<double> x{0.1, 0.2, 0.3};
  const auto expect_right = [&](double t) {
    folded(run, t, x.data());
    evaluate_derivatives(*program, run, other, t, x.data());
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(work.dx[i], other.dx[i], 1e-12) << t;
  };
  for (const double t : {0.01, 0.01, 0.02, 0.01, 0.01}) {
    expect_right(t);
    evaluate_values(*program, run, work, 7 * t, x.data());  // somebody else uses the same numbers meanwhile
  }
}

TEST(LinearRowKernel, AsksASourceAnewThatWasSetOrBelongsToAnotherPieceOrRun) {
  const auto program =
      compiled(diagram({{"x", block("lag", {{"times", list({0.1}, "s")}}, {"u"})}}, {"x"}, {{"u", "V"}}));
  auto run = start(*program);
  const auto held = std::make_shared<Series>(Series{{0.0}, {1.0}, Between::hold});
  bind_input(*program, run, "u", held);
  Work work(*program);
  LinearRowKernel folded(*program, run, work);
  const std::vector<double> x{0};  // x' = u / 0.1 s
  folded.foretell(run, std::vector<double>{0, 1});
  folded(run, 0, x.data());
  EXPECT_NEAR(work.dx[0], 10, 1e-13);
  held->v.front() = 2;
  folded.forget();
  folded(run, 0, x.data());
  EXPECT_NEAR(work.dx[0], 20, 1e-13);
  folded(run, 1, x.data());
  EXPECT_NEAR(work.dx[0], 20, 1e-13);
  auto other = run;  // other arrays, another series
  bind_input(*program, other, "u", series({0}, {3}, Between::hold));
  folded(other, 1, x.data());
  EXPECT_NEAR(work.dx[0], 30, 1e-13);
}

TEST(LinearRowKernel, OfARunWithOtherParametersIsThatOfThoseParameters) {
  const auto program = compiled(chain(5));
  auto run = start(*program);
  set_parameter(*program, run, "back1.gain", -2);
  Work work(*program), other(*program);
  LinearRowKernel folded(*program, run, work);
  const std::vector<double> x{1, 2, 3, 4, 5};
  folded(run, 0, x.data());
  evaluate_derivatives(*program, run, other, 0, x.data());
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(work.dx[i], other.dx[i], 1e-13 * std::abs(other.dx[i]));
}

TEST(LinearRowKernel, IsNotANumberWhereALoopHasNoSolution) {
  auto d = diagram({{"error", block("sum", {{"signs", "++"}}, {"u", "back"})},  // e = u + e
                    {"back", block("gain", {{"gain", 1.0}}, {"error"})},
                    {"y", block("lag", {{"times", list({0.1}, "s")}}, {"error"})}},
                   {"y"}, {{"u", "V"}});
  const auto program = compiled(d);
  auto run = start(*program);
  bind_input(*program, run, "u", series({0}, {1}));
  Work work(*program);
  LinearRowKernel folded(*program, run, work);
  folded(run, 0, run.x.data());
  EXPECT_TRUE(std::isnan(work.dx[0]));
  EXPECT_EQ(work.unsolved, 0);
}

}  // namespace
}  // namespace hysteron
