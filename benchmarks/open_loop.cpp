// W2: 100001 samples through 10 or 80 play operators, w <- max(u - r, min(u, w)), y = sum c w.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <string>

#include "benchmarks/diagrams.h"
#include "benchmarks/workloads.h"
#include "engine/rowwise/advance.h"

namespace hysteron::benchmarks {
namespace {

constexpr std::size_t samples = 100'001;
constexpr double row = 1e-4;  // [s]
constexpr std::array<double, 10> c{.7521, .1381, .0775, .0651, .0658, .0522, .0506, .0523, .0520, .1169};

/// The ten operators of the thesis, or each of them split into `operators`/10 of equal weight.
template <std::size_t operators>
struct Core {
  static constexpr std::size_t parts = operators / 10;
  static constexpr double largest = parts == 1 ? 6.64536 : 6.2719275;  // [um] of y, WORKLOADS W2
  std::array<double, operators> threshold{}, weight{};                 // [V], [um/V]
  Core() {
    for (std::size_t i = 0; i < operators; ++i) {
      threshold[i] = 0.6 / parts * static_cast<double>(i);
      weight[i] = c[i / parts] / parts;
    }
  }
};

double input(std::size_t k) { return 3 - 3 * std::cos(2 * std::numbers::pi * 5 * (static_cast<double>(k) * row)); }

const std::vector<double>& inputs() {
  static const std::vector<double> u = [] {
    std::vector<double> v(samples);
    for (std::size_t k = 0; k < samples; ++k) v[k] = input(k);
    return v;
  }();
  return u;
}

template <std::size_t operators, class Input>
void bare_loop(benchmark::State& state, Input u_at) {
  constexpr std::size_t lanes = operators % 8 == 0 ? 8 : 2;
  const Core<operators> core;
  std::vector<double> y(samples);
  for (auto _ : state) {
    std::array<double, operators> w{};
    for (std::size_t k = 0; k < samples; ++k) {
      const double u = u_at(k);
      for (std::size_t i = 0; i < operators; ++i) w[i] = std::max(u - core.threshold[i], std::min(u, w[i]));
      std::array<double, lanes> sum{};  // side by side, so that no addition waits for the one before
      for (std::size_t i = 0; i < operators; i += lanes)
        for (std::size_t j = 0; j < lanes; ++j) sum[j] += core.weight[i + j] * w[i + j];
      y[k] = std::accumulate(sum.begin(), sum.end(), 0.0);
    }
    benchmark::DoNotOptimize(y.data());
    benchmark::ClobberMemory();
  }
  state.counters["error"] = std::abs(*std::max_element(y.begin(), y.end()) - Core<operators>::largest);
}

struct Model {
  ProgramPointer program;
  Run run;
  std::vector<double> t;
};

template <std::size_t operators>
Model model_in_hysteron() {
  const Core<operators> numbers;
  NumberList thresholds, weights;
  for (std::size_t i = 0; i < operators; ++i) {
    thresholds.push_back({numbers.threshold[i], "V"});
    weights.push_back({numbers.weight[i], "um/V"});
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
  m.program = compiled(d);
  m.run = start(*m.program);
  for (std::size_t k = 0; k < samples; ++k) m.t.push_back(static_cast<double>(k) * row);
  bind_input(*m.program, m.run, "u", std::make_shared<const Series>(Series{m.t, inputs(), Between::linear}));
  return m;
}

template <std::size_t operators>
double error_of(const std::vector<double>& y) {
  return std::abs(*std::max_element(y.begin(), y.end()) / um - Core<operators>::largest);
}

/// As a fit uses it: planned once, run many times.
template <std::size_t operators>
void exact_advance(benchmark::State& state) {
  const auto m = model_in_hysteron<operators>();
  Advance advance(m.program, m.program->output_signals);
  const auto instants = std::make_shared<const std::vector<double>>(m.t);
  std::vector<std::vector<double>> values;
  for (auto _ : state) advance(m.run, instants, {}, values);
  state.counters["error"] = error_of<operators>(values[0]);
}

/// As the verb "run" uses it.
template <std::size_t operators>
void simulated(benchmark::State& state) {
  const auto m = model_in_hysteron<operators>();
  SimulateOptions options;
  options.instants = m.t;
  options.signals = m.program->output_signals;
  Traces traces;
  for (auto _ : state) traces = simulate(*m.program, m.run, options);
  state.counters["error"] = error_of<operators>(traces.values[0]);
}

template <std::size_t operators>
void register_operators(const std::string& group) {
  const auto entry = [&](const char* name) { return group + name; };
  benchmark::RegisterBenchmark(entry("/by hand").c_str(), [](benchmark::State& s) {
    bare_loop<operators>(s, [u = inputs().data()](std::size_t k) { return u[k]; });
  });
  benchmark::RegisterBenchmark(entry("/by hand with cos").c_str(),
                               [](benchmark::State& s) { bare_loop<operators>(s, input); });
  benchmark::RegisterBenchmark(entry("/hysteron advance").c_str(), exact_advance<operators>);
  benchmark::RegisterBenchmark(entry("/hysteron simulate").c_str(), simulated<operators>);
}

}  // namespace

void register_open_loop() {
  register_operators<10>("open loop, 10 operators");
  register_operators<80>("open loop, 80 operators");
}

}  // namespace hysteron::benchmarks
