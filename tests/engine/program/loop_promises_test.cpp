// The promises of engine/program/loops.h: pure, exact slopes, no allocation, the same in any order of blocks.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/engine/allocations.h"
#include "tests/engine/loop_diagrams.h"

namespace hysteron {
namespace {

using namespace tools;

TEST(Loops, AnEvaluationGivesTheSameBitsHoweverOftenAndAfterWhatever) {
  const auto program = compiled(kinked());
  auto run = with_input(*program, 0.7);
  Work work(*program);
  accept(*program, run, work, 0, run.x.data());
  const double x = 0.21, other = -3;
  evaluate_derivatives(*program, run, work, 0, &x);
  const double first = work.dx[0];
  const auto before = run;
  evaluate_derivatives(*program, run, work, 0, &other);
  EXPECT_NE(work.dx[0], first);
  evaluate_derivatives(*program, run, work, 0, &x);
  EXPECT_EQ(work.dx[0], first) << "a trial left a trace";
  EXPECT_EQ(run.warm, before.warm);
  Work fresh(*program);
  evaluate_derivatives(*program, run, fresh, 0, &x);
  EXPECT_EQ(fresh.dx[0], first);
}

TEST(Loops, TheResultDoesNotDependOnTheOrderOfBlocksInTheFile) {
  const auto drive = series({0, 0.1, 0.25, 0.3}, {0, 2, -1, 0.4});
  std::vector<Traces> both;
  for (const bool reversed : {false, true}) {
    const auto program = compiled(kinked(reversed));
    auto run = start(*program);
    bind_input(*program, run, "u", drive);
    both.push_back(simulate(*program, run, {.until = 0.3, .method = Method::bdf}));
  }
  for (std::size_t s = 0; s < 3; ++s) EXPECT_EQ(trace(both[0], s), trace(both[1], s));
}

TEST(Loops, SlopesThroughALoopAreThoseOfDifferences) {
  const auto program = compiled(kinked());
  auto run = with_input(*program, 0.3);
  Work work(*program);
  accept(*program, run, work, 0, run.x.data());
  const int gain = program->find_parameter("amplified.gain")->slots[0];
  const int half = program->find_parameter("half.gain")->slots[0];
  const auto derivative = [&](double x, double change_gain, double change_half) {
    auto moved = run;
    moved.p[at(gain)] += change_gain;
    moved.p[at(half)] += change_half;
    evaluate_derivatives(*program, moved, work, 0, &x);
    return work.dx[0];
  };
  for (const double x0 : {0.01, 0.4, -0.9, 3.0}) {  // on the play's flank, inside it, on both limits
    JetWork jets(*program);
    jets.refresh(run);
    Jet x(x0);
    x.slope[0] = 1;
    jets.p[at(gain)].slope[3] = 1;
    jets.p[at(half)].slope[7] = 1;
    evaluate_derivatives(*program, run, jets, 0, &x);
    const double h = 1e-6;
    EXPECT_EQ(jets.dx[0].value, derivative(x0, 0, 0));
    // Central differences of straight pieces: rounding over h, about 1e-10 of a rate of 100 V/s.
    EXPECT_NEAR(jets.dx[0].slope[0], (derivative(x0 + h, 0, 0) - derivative(x0 - h, 0, 0)) / (2 * h), 1e-6) << x0;
    EXPECT_NEAR(jets.dx[0].slope[3], (derivative(x0, h, 0) - derivative(x0, -h, 0)) / (2 * h), 1e-6) << x0;
    EXPECT_NEAR(jets.dx[0].slope[7], (derivative(x0, 0, h) - derivative(x0, 0, -h)) / (2 * h), 1e-6) << x0;
    EXPECT_EQ(jets.dx[0].slope[1], 0);
  }
}

TEST(Loops, SlopesThroughALoopOfRatesAreThoseOfDifferences) {
  const BoucWenNumbers p;
  const auto program = compiled(diagram({{"slow", block("lag", {{"times", list({0.1}, "s")}}, {"u"})},
                                         {"v", block("sum", {{"signs", "+-"}}, {"slow", "y"})},
                                         {"y", bouc_wen(p, p.d_p, "v")}},
                                        {"y"}, volts));
  const auto run = with_input(*program, 2);
  Work work(*program);
  const auto z_index = at(static_cast<int>(std::find(program->state_names.begin(), program->state_names.end(), "y.z") -
                                           program->state_names.begin()));
  ASSERT_LT(z_index, 2U);
  const std::vector<double> x0{0.3, 0.3};
  JetWork jets(*program);
  jets.refresh(run);
  std::vector<Jet> x{Jet(x0[0]), Jet(x0[1])};
  x[0].slope[0] = x[1].slope[1] = 1;
  evaluate_derivatives(*program, run, jets, 0, x.data());
  for (std::size_t k = 0; k < 2; ++k) {
    const double h = 1e-6;
    auto up = x0, down = x0;
    up[k] += h;
    down[k] -= h;
    evaluate_derivatives(*program, run, work, 0, up.data());
    const double above = work.dx[z_index];
    evaluate_derivatives(*program, run, work, 0, down.data());
    // Differences of a smooth function of size 10: h^2 and rounding over h.
    EXPECT_NEAR(jets.dx[z_index].slope[k], (above - work.dx[z_index]) / (2 * h), 1e-7) << k;
  }
}

TEST(Loops, AnEvaluationTakesNothingFromTheHeap) {
  const auto program = compiled(kinked());
  auto run = with_input(*program, 0.7);
  Work work(*program);
  JetWork jets(*program);
  jets.refresh(run);
  const double x = 0.1;
  const Jet jet(0.1);
  evaluate_derivatives(*program, run, work, 0, &x);
  const long before = allocations();
  for (int i = 0; i < 10; ++i) {
    evaluate_derivatives(*program, run, work, 0, &x);
    evaluate_memory_rates(*program, run, work, 0, &x);
    evaluate_values(*program, run, work, 0, &x);
    evaluate_derivatives(*program, run, jets, 0, &jet);
    accept(*program, run, work, 0, &x);
  }
  EXPECT_EQ(allocations(), before);
}

TEST(Loops, TheErrorFollowsTheToleranceThatIsAskedFor) {
  // v = u - v^3, smooth: v = 1 at u = 2. The start is 0, so nothing is exact by luck.
  const auto program = compiled(diagram({{"v", block("sum", {{"signs", "+-"}}, {"u", "cube"})},
                                         {"square", block("product", {}, {"v", "v"})},
                                         {"third", block("product", {}, {"square", "v"})},
                                         {"cube", block("gain", {{"gain", "1 1/V^2"}}, {"third"})}},
                                        {"v"}, volts));
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-10}) {
    auto run = with_input(*program, 2);
    set_loop_accuracy(*program, run, tolerance, 1e-2);
    Work work(*program);
    evaluate_values(*program, run, work, 0, run.x.data());
    EXPECT_NEAR(work.y[at(program->signal("v"))], 1, std::max(1e-3 * tolerance, 1e-15)) << tolerance;
  }
}

}  // namespace
}  // namespace hysteron
