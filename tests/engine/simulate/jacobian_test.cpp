// The Jacobian by slopes: against closed forms, against differences over every block, and sparse where the diagram is.
#include "engine/simulate/jacobian.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/program/nominal.h"
#include "tests/engine/event_blocks.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

/// d(dx_i)/dx_j as a full matrix [row][column].
std::vector<std::vector<double>> by_slopes(const Program& p, const hysteron::Run& run, double t,
                                           const std::vector<double>& x) {
  Jacobian jacobian(p);
  const auto& pattern = jacobian.pattern();
  std::vector<double> entries(pattern.row.size());
  EXPECT_TRUE(jacobian(run, t, x.data(), entries.data()));
  std::vector<std::vector<double>> full(x.size(), std::vector<double>(x.size(), 0.0));
  for (std::size_t j = 0; j < x.size(); ++j)
    for (int k = pattern.column_begin[j]; k < pattern.column_begin[j + 1]; ++k)
      full[static_cast<std::size_t>(pattern.row[static_cast<std::size_t>(k)])][j] =
          entries[static_cast<std::size_t>(k)];
  return full;
}

/// The same by central differences.
std::vector<std::vector<double>> by_differences(const Program& p, const hysteron::Run& run, double t,
                                                const std::vector<double>& x, const std::vector<double>& sizes) {
  Work work(p);
  std::vector<std::vector<double>> full(x.size(), std::vector<double>(x.size(), 0.0));
  for (std::size_t j = 0; j < x.size(); ++j) {
    const double h = 1e-6 * sizes[j];
    auto there = x;
    there[j] = x[j] + h;
    evaluate_derivatives(p, run, work, t, there.data());
    const auto up = work.dx;
    there[j] = x[j] - h;
    evaluate_derivatives(p, run, work, t, there.data());
    for (std::size_t i = 0; i < x.size(); ++i) full[i][j] = (up[i] - work.dx[i]) / (2 * h);
  }
  return full;
}

/// x' = (in - x)/tau in a chain with neighbours: three entries a column.
Diagram lags_in_a_row(int n) {
  std::vector<std::pair<std::string, Node>> blocks{{"u", block("sine", {{"amplitude", "1 V"}, {"frequency", "5 Hz"}})}};
  for (int i = 0; i < n; ++i) {
    const auto name = "x" + std::to_string(i);
    const auto before = i == 0 ? std::string("u") : "x" + std::to_string(i - 1);
    if (i + 1 < n) {
      blocks.emplace_back("g" + std::to_string(i), block("gain", {{"gain", 0.5}}, {"x" + std::to_string(i + 1)}));
      blocks.emplace_back("s" + std::to_string(i), block("sum", {{"signs", "+-"}}, {before, "g" + std::to_string(i)}));
    }
    blocks.emplace_back(name, block("lag", {{"times", list({0.01 * (1 + i % 7)}, "s")}},
                                    {i + 1 < n ? "s" + std::to_string(i) : before}));
  }
  return diagram(blocks, {"x" + std::to_string(n - 1)});
}

TEST(JacobianBySlopes, OfAChainOfLagsIsItsClosedFormAndItsPatternTheChain) {
  const int n = 50;
  const auto p = compiled(lags_in_a_row(n));
  const auto run = start(*p);
  const std::vector<double> x(static_cast<std::size_t>(p->n_x), 0.3);
  const auto j = by_slopes(*p, run, 0.1, x);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double tau = 0.01 * (1 + static_cast<double>(i % 7));
      const double expected = i == k ? -1 / tau : k + 1 == i ? 1 / tau : k == i + 1 ? -0.5 / tau : 0;
      EXPECT_NEAR(j[i][k], expected, 1e-12 * 100) << i << ", " << k;
    }
  Jacobian jacobian(*p);
  EXPECT_EQ(jacobian.pattern().row.size(), static_cast<std::size_t>(3 * n - 2));
  EXPECT_EQ(jacobian.colours(), 3);
}

TEST(JacobianBySlopes, AgreesWithDifferencesThroughRatesMemoryAndModes) {
  for (const auto& d : {bouc_wen_loop(), play_loop()}) {
    const auto p = compiled(d);
    auto run = start(*p);
    Work work(*p);
    const auto sizes = nominal_states(*p, run);
    auto x = run.x;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = sizes[i] * (0.1 + 0.07 * static_cast<double>(i));
    run.branch = 0.05;
    accept(*p, run, work, 0.02, x.data());
    const auto a = by_slopes(*p, run, 0.03, x), b = by_differences(*p, run, 0.03, x, sizes);
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t j = 0; j < x.size(); ++j) {
        double size = 0;  // of the row, in the sizes of its states: what differences can see
        for (std::size_t k = 0; k < x.size(); ++k) size = std::max(size, std::abs(a[i][k]) * sizes[k]);
        EXPECT_NEAR(a[i][j] * sizes[j], b[i][j] * sizes[j], 1e-8 * size) << i << ", " << j;
      }
  }
}

TEST(JacobianBySlopes, ChangesNothingButTheCost) {
  const auto p = compiled(bouc_wen_loop());
  SimulateOptions options{.until = 0.2, .every = 1e-3, .method = Method::bdf, .relative_tolerance = 1e-9};
  const auto slopes = simulate(*p, start(*p), options);
  options.exact_jacobian = false;
  const auto differences = simulate(*p, start(*p), options);
  EXPECT_LT(distance(trace(slopes), trace(differences)), 1e-6 * largest(trace(slopes)));
  EXPECT_LT(slopes.statistics.evaluations, differences.statistics.evaluations);
}

TEST(JacobianBySlopes, ALargeSparseDiagramIsSimulatedWithIt) {
  const auto p = compiled(lags_in_a_row(400));
  const SimulateOptions options{.until = 0.5, .every = 0.01, .method = Method::bdf, .relative_tolerance = 1e-8};
  SimulateOptions other = options;
  other.method = Method::runge_kutta;
  EXPECT_LT(distance(trace(simulate(*p, start(*p), options)), trace(simulate(*p, start(*p), other))), 1e-6);
}

}  // namespace
}  // namespace hysteron
