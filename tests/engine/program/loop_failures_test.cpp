// Loops with several solutions, or none: which is found, and a failure that can be acted on.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/loop_diagrams.h"

namespace hysteron {
namespace {

using namespace tools;

/// v = u + v^2 / 4 V: solutions 2 -+ 2 sqrt(1 - u), which meet at u = 1 V.
Diagram folded(const std::string& source = "u") {
  return diagram({{"v", block("sum", {}, {source, "quarter"})},
                  {"square", block("product", {}, {"v", "v"})},
                  {"quarter", block("gain", {{"gain", "0.25 1/V"}}, {"square"})}},
                 {"v"}, volts);
}

TEST(Loops, OfSeveralSolutionsTheOneNearTheGuessIsFound) {
  auto d = folded();
  EXPECT_NEAR(value_at(*compiled(d), 0.5, "v"), 2 - std::sqrt(2), 1e-12);
  d.simulate.guess["v"] = Number{3.5, "V"};
  EXPECT_NEAR(value_at(*compiled(d), 0.5, "v"), 2 + std::sqrt(2), 1e-12);
  d.simulate.guess["v"] = Number{3500, "mV"};
  EXPECT_NEAR(value_at(*compiled(d), 0.5, "v"), 2 + std::sqrt(2), 1e-12);
}

TEST(Loops, ABranchIsFollowedFromAcceptedPointToAcceptedPoint) {
  auto d = folded();
  d.simulate.guess["v"] = Number{3.5, "V"};
  const auto program = compiled(d);
  auto run = start(*program);
  bind_input(*program, run, "u", series({0, 1}, {-8, 0.9}));
  const auto traces = simulate(*program, run, {.until = 1, .method = Method::bdf});
  for (std::size_t i = 0; i < traces.t.size(); ++i)
    EXPECT_NEAR(trace(traces)[i], 2 + 2 * std::sqrt(1 - (-8 + 8.9 * traces.t[i])), 1e-7);
}

Problem failure(const Program& program, const Run& run, const SimulateOptions& options) {
  try {
    simulate(program, run, options);
  } catch (const Error& e) {
    EXPECT_EQ(e.fault, Fault::numerics);
    return e.problems.front();
  }
  ADD_FAILURE() << "nothing failed";
  return {};
}

TEST(Loops, AFoldIsNamedWithTheWayAroundTheResidualAndThreeCures) {
  const auto program = compiled(folded());
  auto run = start(*program);
  bind_input(*program, run, "u", series({0, 1}, {0, 2}));
  const auto p = failure(*program, run, {.until = 1, .method = Method::bdf});
  EXPECT_EQ(p.code, "loop_unsolved");
  EXPECT_NE(p.what.find("v -> square -> quarter -> v"), std::string::npos) << p.what;
  EXPECT_NE(p.what.find("residual"), std::string::npos) << p.what;
  EXPECT_NE(p.what.find("fold"), std::string::npos) << p.what;
  EXPECT_NE(p.what.find(" V"), std::string::npos) << p.what;
  for (const char* cure : {"guess", "lag", "inverse"}) EXPECT_NE(p.cure.find(cure), std::string::npos) << p.cure;
}

TEST(Loops, TheIntegratorTriesSmallerStepsBeforeALoopIsGivenUp) {
  // x' = v(x), v = x + v^2/4: x grows until x = 1, where the loop folds; the failure is told within a step of that.
  auto d = folded("x");
  d.blocks["x"] = block("integrator", {{"initial", "0.1 V"}}, {"rate"});
  d.blocks["rate"] = block("gain", {{"gain", "1 1/s"}}, {"v"});
  d.inputs.erase("u");
  d.record = {"x"};
  const auto program = compiled(d);
  const auto p = failure(*program, start(*program), {.until = 10, .method = Method::bdf});
  EXPECT_EQ(p.code, "loop_unsolved") << p.what;
  const auto found = p.what.find("t = ");
  ASSERT_NE(found, std::string::npos);
  // dt = dx / (2 - 2 sqrt(1 - x)); with q = sqrt(1 - x): t = [q - ... ] = integral of q / (1 - q) dq = -q - ln(1 - q).
  const double q = std::sqrt(0.9);
  EXPECT_NEAR(std::stod(p.what.substr(found + 4)), -q - std::log(1 - q), 1e-2);
}

TEST(Loops, ALoopWithGainOneHasNoSolutionAndSaysSo) {
  const auto program = compiled(
      diagram({{"v", block("sum", {}, {"u", "same"})}, {"same", block("gain", {{"gain", 1.0}}, {"v"})}}, {"v"}, volts));
  auto run = start(*program);
  bind_input(*program, run, "u", series({0, 1}, {1, 2}));
  for (const auto method : {Method::bdf, Method::exact}) {
    const auto p = failure(*program, run, {.until = 1, .method = method});
    EXPECT_EQ(p.code, "loop_unsolved");
    EXPECT_NE(p.what.find("gain one"), std::string::npos) << p.what;
    EXPECT_NE(p.what.find("v -> same -> v"), std::string::npos) << p.what;
  }
}

TEST(Loops, ATroubleBeforeTheLoopIsNotBlamedOnIt) {
  const auto program = compiled(feedback(block("gain", {{"gain", 2.0}}, {"error"})));
  auto run = start(*program);
  bind_input(*program, run, "u", series({0, 1}, {0, std::numeric_limits<double>::infinity()}));
  EXPECT_NE(failure(*program, run, {.until = 1, .method = Method::bdf}).code, "loop_unsolved");
}

TEST(Loops, ADiagramMayForbidThem) {
  auto d = feedback(block("gain", {{"gain", 2.0}}, {"error"}));
  d.simulate.loops = "solve";
  EXPECT_NO_THROW(compiled(d));
  d.simulate.loops = "error";
  try {
    compiled(d);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().code, "algebraic_loop");
    EXPECT_NE(e.problems.front().what.find(" -> "), std::string::npos);
  }
}

TEST(Loops, AGuessThatNobodyUsesOrOfAnotherUnitIsAnError) {
  const auto code = [](const std::string& signal, const Number& number) {
    auto d = folded();
    d.blocks["after"] = block("gain", {{"gain", 2.0}}, {"v"});
    d.record = {"after"};
    d.simulate.guess[signal] = number;
    try {
      compiled(d);
    } catch (const Error& e) {
      EXPECT_EQ(e.problems.front().path, "/simulate/guess/" + signal);
      return e.problems.front().code;
    }
    return std::string();
  };
  EXPECT_EQ(code("v", Number{1, "V"}), "");
  EXPECT_EQ(code("square", Number{1, "V^2"}), "") << "any signal of the loop may be the one that is guessed";
  EXPECT_EQ(code("after", Number{1, "V"}), "unused_guess");
  EXPECT_EQ(code("w", Number{1, "V"}), "unknown_signal");
  EXPECT_EQ(code("v", Number{1, "um"}), "wrong_unit");
  EXPECT_EQ(code("v", Number{1, {}}), "wrong_unit");
}

}  // namespace
}  // namespace hysteron
