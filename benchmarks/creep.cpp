// A fourth-order plant with three relaxations on 20 000 recorded rows 0.1 ms apart, between which the input moves
// linearly: the exact advance against the matrix recursion x+ = A x + B u + R (u+ - u) written for these seven states.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>

#include "benchmarks/diagrams.h"
#include "benchmarks/workloads.h"
#include "engine/rowwise/advance.h"

namespace hysteron::benchmarks {
namespace {

constexpr std::size_t rows = 20'000;
constexpr double row = 1e-4;                            // [s]
constexpr std::array<double, 3> share{.02, .015, .01};  // [-]
constexpr std::array<double, 3> tau{.01, .1, 1};        // [s]
constexpr int n = 7;

const std::vector<double>& inputs() {  // [V], from rest
  static const std::vector<double> u = [] {
    std::vector<double> v(rows);
    for (std::size_t k = 0; k < rows; ++k)
      v[k] = 3 - 3 * std::cos(2 * std::numbers::pi * 5 * (static_cast<double>(k) * row));
    return v;
  }();
  return u;
}

struct Recursion {
  std::array<std::array<double, n>, n> a{};  // by columns
  std::array<double, n> b{}, ramp{};
};

/// States: y, y'/w, y''/w^2, y'''/w^3 of the plant, three relaxations.
Recursion recursion_by_hand() {
  const double w = std::pow(1.822e16, 0.25);
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n + 2, n + 2);
  const double gain = 1.377e16 / (w * w * w);
  m(0, 1) = m(1, 2) = m(2, 3) = w;
  m.row(3) << -w, -4.981e12 / (w * w), -5.403e8 / w, -2.813e4, gain * share[0], gain * share[1], gain * share[2], gain,
      0;
  for (int k = 0; k < 3; ++k) {
    m(4 + k, 4 + k) = -1 / tau[static_cast<std::size_t>(k)];
    m(4 + k, n) = 1 / tau[static_cast<std::size_t>(k)];
  }
  m(n, n + 1) = 1 / row;
  const Eigen::MatrixXd e = (m * row).exp();
  Recursion r;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) r.a[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] = e(i, j);
  for (int i = 0; i < n; ++i) {
    r.b[static_cast<std::size_t>(i)] = e(i, n);
    r.ramp[static_cast<std::size_t>(i)] = e(i, n + 1);
  }
  return r;
}

const std::vector<double>& by_recursion(const Recursion& r, std::vector<double>& y) {
  const auto& u = inputs();
  std::array<double, n> x{}, next{};
  y[0] = 0;
  for (std::size_t k = 1; k < rows; ++k) {
    const double before = u[k - 1], change = u[k] - before;
    for (std::size_t i = 0; i < n; ++i) next[i] = r.b[i] * before + r.ramp[i] * change;
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i) next[i] += r.a[j][i] * x[j];
    x = next;
    y[k] = x[0];
  }
  return y;
}

void by_hand(benchmark::State& state) {
  const auto recursion = recursion_by_hand();
  std::vector<double> y(rows);
  for (auto _ : state) {
    by_recursion(recursion, y);
    benchmark::DoNotOptimize(y.data());
    benchmark::ClobberMemory();
  }
  state.counters["error"] = 0;
}

struct Model {
  ProgramPointer program;
  Run run;
  std::vector<double> t;
};

Model model_in_hysteron() {
  Diagram d;
  d.inputs["u"].unit = "V";
  d.blocks["creep"] = node(
      "creep",
      {{"amounts", numbers({share[0], share[1], share[2]})}, {"times", numbers({tau[0], tau[1], tau[2]}, "s")}}, {"u"});
  d.blocks["plant"] = thesis_plant("creep", "1 um/V");
  d.outputs["y"] = "plant";
  Model m;
  m.program = compiled(d);
  m.run = start(*m.program);
  for (std::size_t k = 0; k < rows; ++k) m.t.push_back(static_cast<double>(k) * row);
  bind_input(*m.program, m.run, "u", std::make_shared<const Series>(Series{m.t, inputs(), Between::linear}));
  return m;
}

double error_of(const std::vector<double>& y) {
  std::vector<double> expected(rows);
  return largest_error(scaled(y, 1 / um), by_recursion(recursion_by_hand(), expected));
}

/// As a fit uses it: planned once, run many times.
void exact_advance(benchmark::State& state) {
  const auto m = model_in_hysteron();
  Advance advance(m.program, m.program->output_signals);
  const auto instants = std::make_shared<const std::vector<double>>(m.t);
  std::vector<std::vector<double>> values;
  for (auto _ : state) advance(m.run, instants, {}, values);
  state.counters["error"] = error_of(values[0]);
}

/// As the verb "run" uses it.
void simulated(benchmark::State& state) {
  const auto m = model_in_hysteron();
  SimulateOptions options;
  options.instants = m.t;
  options.signals = m.program->output_signals;
  Traces traces;
  for (auto _ : state) traces = simulate(*m.program, m.run, options);
  state.counters["error"] = error_of(traces.values[0]);
}

}  // namespace

void register_creep() {
  benchmark::RegisterBenchmark("plant and creep, 20000 rows/by hand", by_hand);
  benchmark::RegisterBenchmark("plant and creep, 20000 rows/hysteron advance", exact_advance);
  benchmark::RegisterBenchmark("plant and creep, 20000 rows/hysteron simulate", simulated);
}

}  // namespace hysteron::benchmarks
