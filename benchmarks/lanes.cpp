// A Bouc-Wen law on 2000 recorded rows, value and four slopes: one Runge-Kutta step a row with forward sensitivities
// written by hand, against five runs of the exact advance side by side.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <numbers>

#include "benchmarks/diagrams.h"
#include "benchmarks/workloads.h"
#include "engine/rowwise/advance.h"

namespace hysteron::benchmarks {
namespace {

constexpr std::size_t rows = 2000;
constexpr double row = 2e-4;                                                  // [s]
constexpr std::array<double, 4> numbers_of_law{.6187, .2418, .0237, 1.6126};  // [um/V, 1/V, 1/V, um/V]
const std::array<const char*, 4> names{"law.alpha", "law.beta", "law.gamma", "law.d_p"};

const std::vector<double>& inputs() {  // [V]
  static const std::vector<double> u = [] {
    std::vector<double> v(rows);
    for (std::size_t k = 0; k < rows; ++k)
      v[k] = 3 - 3 * std::cos(2 * std::numbers::pi * 5 * (static_cast<double>(k) * row));
    return v;
  }();
  return u;
}

/// z and its slopes by alpha, beta, gamma.
using State = std::array<double, 4>;

State slope(double direction, const State& s) {
  const auto& [alpha, beta, gamma, d_p] = numbers_of_law;
  const double by_z = -beta - direction * gamma * (s[0] < 0 ? -1 : 1);  // of dz/dx for x = |u - u_start|
  return {direction * alpha + by_z * s[0], direction + by_z * s[1], -s[0] + by_z * s[2],
          -direction * std::abs(s[0]) + by_z * s[3]};
}
State moved(const State& s, double h, const State& k) {
  return {s[0] + h * k[0], s[1] + h * k[1], s[2] + h * k[2], s[3] + h * k[3]};
}

struct Columns {
  std::array<std::vector<double>, 5> of{};  ///< y [um], then its slopes
  Columns() {
    for (auto& column : of) column.assign(rows, 0.0);
  }
};

void run_by_hand(Columns& c) {
  const auto& u = inputs();
  State s{};
  for (std::size_t k = 1; k < rows; ++k) {
    const double du = u[k] - u[k - 1], d = du < 0 ? -1 : 1, h = std::abs(du);
    const State k1 = slope(d, s), k2 = slope(d, moved(s, h / 2, k1)), k3 = slope(d, moved(s, h / 2, k2)),
                k4 = slope(d, moved(s, h, k3));
    for (std::size_t i = 0; i < 4; ++i) s[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    c.of[0][k] = numbers_of_law[3] * u[k] - s[0];
    for (std::size_t i = 1; i < 4; ++i) c.of[i][k] = -s[i];
    c.of[4][k] = u[k];
  }
}

void by_hand(benchmark::State& state) {
  Columns c;
  for (auto _ : state) {
    run_by_hand(c);
    benchmark::DoNotOptimize(c.of.data());
    benchmark::ClobberMemory();
  }
  state.counters["error"] = 0;
}

struct Model {
  ProgramPointer program;
  std::vector<hysteron::Run> runs;
  std::shared_ptr<const std::vector<double>> instants;
};

Model model_in_hysteron() {
  Diagram d;
  d.inputs["u"].unit = "V";
  d.blocks["law"] = node("bouc_wen",
                         {{"alpha", Number{numbers_of_law[0], "um/V"}},
                          {"beta", Number{numbers_of_law[1], "1/V"}},
                          {"gamma", Number{numbers_of_law[2], "1/V"}},
                          {"d_p", Number{numbers_of_law[3], "um/V"}}},
                         {"u"});
  d.outputs["y"] = "law";
  Model m;
  m.program = compiled(d);
  std::vector<double> t;
  for (std::size_t k = 0; k < rows; ++k) t.push_back(static_cast<double>(k) * row);
  auto run = start(*m.program);
  bind_input(*m.program, run, "u", std::make_shared<const Series>(Series{t, inputs(), Between::linear}));
  m.instants = std::make_shared<const std::vector<double>>(std::move(t));
  m.runs.push_back(run);
  for (const char* name : names) {
    m.runs.push_back(run);
    const auto* info = m.program->find_parameter(name);
    set_parameter(*m.program, m.runs.back(), *info, info->value * (1 + 1e-6));
  }
  return m;
}

void side_by_side(benchmark::State& state) {
  const auto m = model_in_hysteron();
  Advance advance(m.program, m.program->output_signals);
  std::vector<const hysteron::Run*> runs;
  for (const auto& run : m.runs) runs.push_back(&run);
  std::vector<std::vector<std::vector<double>>> values;
  for (auto _ : state) advance.each(runs, m.instants, {.at_rest = false}, values);
  Columns c;
  run_by_hand(c);
  state.counters["error"] = largest_error(scaled(values[0][0], 1 / um), c.of[0]);
}

void one_by_one(benchmark::State& state) {
  const auto m = model_in_hysteron();
  Advance advance(m.program, m.program->output_signals);
  std::vector<std::vector<double>> values;
  for (auto _ : state)
    for (const auto& run : m.runs) advance(run, m.instants, {.at_rest = false}, values);
  state.counters["error"] = 0;
}

}  // namespace

void register_lanes() {
  benchmark::RegisterBenchmark("bouc-wen and four slopes, 2000 rows/by hand", by_hand);
  benchmark::RegisterBenchmark("bouc-wen and four slopes, 2000 rows/hysteron side by side", side_by_side);
  benchmark::RegisterBenchmark("bouc-wen and four slopes, 2000 rows/hysteron one by one", one_by_one);
}

}  // namespace hysteron::benchmarks
