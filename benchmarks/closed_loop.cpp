// W1: PI control of a fourth-order plant behind Bouc-Wen hysteresis, 2 s, 20001 rows: CVODE with a relative tolerance
// of 1e-6, and classical Runge-Kutta with steps of 10 us.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "benchmarks/diagrams.h"
#include "benchmarks/workloads.h"
#include "engine/program/nominal.h"

namespace hysteron::benchmarks {

ProgramPointer closed_loop_program() {
  Diagram d;
  d.blocks["reference"] = thesis_sine("um");
  d.blocks["error"] = node("sum", {{"signs", "+-"}}, {"reference", "stage"});
  d.blocks["controller"] = node("pi_controller", {{"kp", "1.207 V/um"}, {"ki", "7009 V/um/s"}}, {"error"});
  d.blocks["hysteresis"] = node(
      "bouc_wen", {{"alpha", "0.6187 um/V"}, {"beta", "0.2418 1/V"}, {"gamma", "0.0237 1/V"}, {"d_p", "1.6126 um/V"}},
      {"controller"});
  d.blocks["stage"] = thesis_plant("hysteresis");
  d.record = {"stage", "controller"};
  return compiled(d);
}

namespace {

constexpr double until = 2, row = 1e-4;  // [s]

const ClosedLoop& reference() {
  static const ClosedLoop loop = closed_loop_in_fixed_steps(until, 100);  // 1 us: off by less than 1e-9 um
  return loop;
}

/// Such that the largest state of the plant has 1e-8 um, as by hand: 1e-8 um = this * 1e-6 * nominal size.
double absolute_tolerance(const Program& program) {
  const auto sizes = nominal_states(program, start(program));
  double largest = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i)
    if (program.state_names[i].starts_with("stage")) largest = std::max(largest, sizes[i]);
  return 1e-2 * um / largest;
}

void by_hand(benchmark::State& state) {
  ClosedLoop loop;
  for (auto _ : state) loop = closed_loop_by_hand(until, 1e-6, 1e-8);
  state.counters["error"] = largest_error(loop.y, reference().y);
}

/// 1e-5 s, recorded every tenth step.
void fixed_by_hand(benchmark::State& state) {
  ClosedLoop loop;
  for (auto _ : state) loop = closed_loop_in_fixed_steps(until, 10);
  state.counters["error"] = largest_error(loop.y, reference().y);
}

struct How {
  Method method = Method::bdf;
  bool compile_too = false;
  bool tolerances_as_by_hand = false;  ///< else as a user gets them
};

void in_hysteron(benchmark::State& state, How how) {
  auto program = closed_loop_program();
  SimulateOptions options{.until = until, .every = row, .method = how.method, .relative_tolerance = 1e-6, .step = 1e-5};
  if (how.tolerances_as_by_hand) options.absolute_tolerance = absolute_tolerance(*program);
  Traces traces;
  for (auto _ : state) {
    if (how.compile_too) program = closed_loop_program();
    traces = simulate(*program, start(*program), options);
  }
  state.counters["error"] = largest_error(scaled(traces.values[0], 1 / um), reference().y);
  state.counters["steps"] = static_cast<double>(traces.statistics.steps);
  state.counters["calls"] = static_cast<double>(traces.statistics.evaluations);
}

}  // namespace

void register_closed_loop() {
  benchmark::RegisterBenchmark("closed loop/by hand", by_hand);
  benchmark::RegisterBenchmark("closed loop/hysteron", in_hysteron, How{});
  benchmark::RegisterBenchmark("closed loop/hysteron, its tolerances", in_hysteron, How{.tolerances_as_by_hand = true});
  benchmark::RegisterBenchmark("closed loop/hysteron with compilation", in_hysteron, How{.compile_too = true});
  benchmark::RegisterBenchmark("closed loop/hysteron adams", in_hysteron, How{.method = Method::adams});
  benchmark::RegisterBenchmark("closed loop, rk4 of 10 us/by hand", fixed_by_hand);
  benchmark::RegisterBenchmark("closed loop, rk4 of 10 us/hysteron", in_hysteron, How{.method = Method::rk4});
}

}  // namespace hysteron::benchmarks
