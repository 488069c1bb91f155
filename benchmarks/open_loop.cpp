// W2: 100001 samples through ten play operators, w <- max(u - r, min(u, w)), y = sum c w.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "benchmarks/workloads.h"
#include "blocks/register_all.h"
#include "engine/advance.h"
#include "engine/simulate.h"

namespace hysteron::benchmarks {
namespace {

constexpr std::size_t samples = 100'001, operators = 10;
constexpr double row = 1e-4;         // [s]
constexpr double largest = 6.64536;  // [um] of y, WORKLOADS W2
constexpr std::array<double, operators> c{.7521, .1381, .0775, .0651, .0658, .0522, .0506, .0523, .0520, .1169};

double input(std::size_t k) { return 3 - 3 * std::cos(2 * std::numbers::pi * 5 * (static_cast<double>(k) * row)); }

const std::vector<double>& inputs() {
  static const std::vector<double> u = [] {
    std::vector<double> v(samples);
    for (std::size_t k = 0; k < samples; ++k) v[k] = input(k);
    return v;
  }();
  return u;
}

template <class Input>
void bare_loop(benchmark::State& state, Input u_at) {
  std::vector<double> y(samples);
  for (auto _ : state) {
    std::array<double, operators> w{};
    for (std::size_t k = 0; k < samples; ++k) {
      const double u = u_at(k);
      double sum = 0;
      for (std::size_t i = 0; i < operators; ++i) {
        w[i] = std::max(u - 0.6 * static_cast<double>(i), std::min(u, w[i]));
        sum += c[i] * w[i];
      }
      y[k] = sum;
    }
    benchmark::DoNotOptimize(y.data());
    benchmark::ClobberMemory();
  }
  state.counters["error"] = std::abs(*std::max_element(y.begin(), y.end()) - largest);
}

struct Model {
  ProgramPointer program;
  Run run;
  std::vector<double> t;
};

Model model_in_hysteron() {
  static const Registry registry = all_blocks();
  NumberList thresholds, weights;
  for (std::size_t i = 0; i < operators; ++i) {
    thresholds.push_back({0.6 * static_cast<double>(i), "V"});
    weights.push_back({c[i], "um/V"});
  }
  Diagram d;
  d.inputs["u"].unit = "V";
  auto& core = d.blocks["core"];
  core.type = "prandtl_ishlinskii";
  core.parameters["thresholds"] = thresholds;
  core.parameters["weights"] = weights;
  core.in.push_back({"", "u"});
  d.outputs["y"] = "core";
  Model m;
  m.program = compile(d, registry);
  m.run = start(*m.program);
  for (std::size_t k = 0; k < samples; ++k) m.t.push_back(static_cast<double>(k) * row);
  bind_input(*m.program, m.run, "u", std::make_shared<const Series>(Series{m.t, inputs(), Between::linear}));
  return m;
}

double error_of(const std::vector<double>& y) {
  return std::abs(*std::max_element(y.begin(), y.end()) * 1e6 - largest);
}

/// As a fit uses it: planned once, run many times.
void exact_advance(benchmark::State& state) {
  const auto m = model_in_hysteron();
  Advance advance(m.program, m.program->output_signals);
  std::vector<std::vector<double>> values;
  for (auto _ : state) advance(m.run, m.t, {}, values);
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

void register_open_loop() {
  benchmark::RegisterBenchmark("open loop/by hand", [](benchmark::State& s) {
    bare_loop(s, [u = inputs().data()](std::size_t k) { return u[k]; });
  });
  benchmark::RegisterBenchmark("open loop/by hand with cos", [](benchmark::State& s) { bare_loop(s, input); });
  benchmark::RegisterBenchmark("open loop/hysteron advance", exact_advance);
  benchmark::RegisterBenchmark("open loop/hysteron simulate", simulated);
}

}  // namespace hysteron::benchmarks
