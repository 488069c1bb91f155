// Algebraic loops by entries of D: what goes round by blocks alone is none.
#include "engine/program/feedthrough.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

Value rows(const std::vector<std::vector<double>>& numbers) {
  NumberMatrix matrix;
  for (const auto& row : numbers) {
    matrix.rows.emplace_back();
    for (const double v : row) matrix.rows.back().push_back({v, {}});
  }
  return Value(std::move(matrix));
}

/// A state space model closed over its second output.
Diagram closed(double through) {
  auto d = diagram(
      {{"r", block("step", {{"after", "1"}})},
       {"e", block("sum", {{"signs", "+-"}}, {"r", "p[1]"})},
       {"p", block("state_space",
                   {{"a", rows({{0}})}, {"b", rows({{1}})}, {"c", rows({{0}, {1}})}, {"d", rows({{3}, {through}})}},
                   {"e"})}},
      {"p"});
  d.simulate.loops = "error";
  d.simulate.until = Number{2, "s"};
  d.simulate.every = Number{0.5, "s"};
  return d;
}

TEST(Feedthrough, AnOutputWhoseRowOfDIsZeroClosesNoAlgebraicLoop) {
  const auto p = compiled(closed(0));
  for (const auto& loop : p->loops) EXPECT_FALSE(is_algebraic(*p, loop));
  const auto run = simulate(*p, start(*p), simulate_options(*p));
  // x' = 1 - x: p[1] = 1 - exp(-t), p[0] = 3 exp(-t)
  EXPECT_NEAR(run.values[1].back(), 1 - std::exp(-2.0), 1e-6);  // the default tolerances
  EXPECT_NEAR(run.values[0].back(), 3 * std::exp(-2.0), 1e-5);
}

TEST(Feedthrough, OneThatIsNotZeroDoes) {
  try {
    compiled(closed(0.1));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.problems.front().code, "algebraic_loop");
  }
}

TEST(Feedthrough, EntriesOfAMatrixGainTellTheWay) {
  // Twice through one matrix, by different elements: y0 = 2 r, y1 = 3 y0.
  const auto with = [](double breakpoint) {
    auto d = diagram({{"r", block("sine", {{"amplitude", "1"}, {"frequency", "1 Hz"}})},
                      {"u", block("mux", {}, {"r", "y[0]"})},
                      {"y", block("matrix_gain", {{"matrix", rows({{2, breakpoint}, {0, 3}})}}, {"u"})}},
                     {"y"});
    d.simulate.loops = "error";
    d.simulate.until = Number{0.25, "s"};
    d.simulate.every = Number{0.25, "s"};
    return d;
  };
  const auto p = compiled(with(0));
  const auto run = simulate(*p, start(*p), simulate_options(*p));
  EXPECT_NEAR(run.values[0].back(), 2, 1e-14);
  EXPECT_NEAR(run.values[1].back(), 6, 1e-14);
  EXPECT_THROW(compiled(with(0.5)), Error);
}

TEST(Feedthrough, ATransferFunctionWithoutItsFirstCoefficientIsNone) {
  const auto with = [](double first) {
    auto d = diagram({{"r", block("step", {{"after", "1"}})},
                      {"e", block("sum", {{"signs", "+-"}}, {"r", "y"})},
                      {"y", block("transfer_function", {{"num", list({first, 1})}, {"den", list({1, 1})}}, {"e"})}},
                     {"y"});
    d.simulate.loops = "error";
    return d;
  };
  EXPECT_NO_THROW(compiled(with(0)));
  EXPECT_THROW(compiled(with(1)), Error);
}

}  // namespace
}  // namespace hysteron
