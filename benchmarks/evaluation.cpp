// What a block costs in one evaluation beyond its arithmetic: dx/dt of W1's closed loop, and the values of a chain of
// gains and sums, against the same arithmetic written into one function. 1000 evaluations a turn.
#include <benchmark/benchmark.h>

#include <array>
#include <string>

#include "benchmarks/diagrams.h"
#include "benchmarks/workloads.h"
#include "engine/simulate/linear_row_kernel.h"

namespace hysteron::benchmarks {
namespace {

constexpr int evaluations = 1000;
constexpr std::size_t pairs = 50;  // of a gain and a sum

double step_of(int k) { return 1e-4 * k; }  // [s]

void loop_by_hand(benchmark::State& state) {
  std::array<double, 6> x{1, .1, .01, .001, 1e-4, .5}, dx{};
  for (auto _ : state)
    for (int k = 0; k < evaluations; ++k) {
      closed_loop_derivative(step_of(k), x.data(), dx.data());
      benchmark::DoNotOptimize(dx.data());
      benchmark::ClobberMemory();
    }
}

void loop_in_hysteron(benchmark::State& state) {
  const auto program = closed_loop_program();
  const auto run = start(*program);
  Work work(*program);
  std::vector<double> x(run.x.size(), 1e-7);
  for (auto _ : state)
    for (int k = 0; k < evaluations; ++k) {
      evaluate_derivatives(*program, run, work, step_of(k), x.data());
      benchmark::DoNotOptimize(work.dx.data());
      benchmark::ClobberMemory();
    }
  state.counters["blocks"] = evaluations * static_cast<double>(program->blocks.size());
  state.counters["calls"] = evaluations * static_cast<double>(program->derivative_steps.size());
}

/// As simulations do it: linear blocks as weighted sums.
void loop_folded(benchmark::State& state) {
  const auto program = closed_loop_program();
  const auto run = start(*program);
  Work work(*program);
  LinearRowKernel derivative(*program, run, work);
  std::vector<double> x(run.x.size(), 1e-7);
  for (auto _ : state)
    for (int k = 0; k < evaluations; ++k) {
      derivative(run, step_of(k), x.data());
      benchmark::DoNotOptimize(work.dx.data());
      benchmark::ClobberMemory();
    }
  state.counters["blocks"] = evaluations * static_cast<double>(program->blocks.size());
  state.counters["calls"] = evaluations * static_cast<double>(derivative.calls() + derivative.rows());
}

double gain_of(std::size_t i) { return 0.5 + 0.01 * static_cast<double>(i); }

void chain_by_hand_in_place(benchmark::State& state) {
  std::array<double, pairs> gain{}, y{};
  for (std::size_t i = 0; i < pairs; ++i) gain[i] = gain_of(i);
  benchmark::DoNotOptimize(gain.data());
  for (auto _ : state)
    for (int k = 0; k < evaluations; ++k) {
      const double drive = step_of(k);
      double last = drive;
      for (std::size_t i = 0; i < pairs; ++i) y[i] = last = gain[i] * last + drive;
      benchmark::DoNotOptimize(y.data());
      benchmark::ClobberMemory();
    }
}

void chain_in_hysteron(benchmark::State& state) {
  Diagram d;
  d.blocks["drive"] = node("integrator", {}, {"y" + std::to_string(pairs - 1)});
  std::string last = "drive";
  for (std::size_t i = 0; i < pairs; ++i) {
    const auto number = std::to_string(i);
    d.blocks["g" + number] = node("gain", {{"gain", gain_of(i)}}, {last});
    d.blocks["y" + number] = node("sum", {{"signs", "++"}}, {"g" + number, "drive"});
    last = "y" + number;
  }
  d.record = {last};
  const auto program = compiled(d);
  const auto run = start(*program);
  Work work(*program);
  std::vector<double> x(run.x.size());
  for (auto _ : state)
    for (int k = 0; k < evaluations; ++k) {
      x[0] = step_of(k);
      evaluate_values(*program, run, work, 0, x.data());
      benchmark::DoNotOptimize(work.y.data());
      benchmark::ClobberMemory();
    }
  state.counters["blocks"] = evaluations * static_cast<double>(program->blocks.size());
  state.counters["calls"] = state.counters["blocks"];
}

}  // namespace

void register_evaluation() {
  benchmark::RegisterBenchmark("evaluation of the closed loop/by hand", loop_by_hand);
  benchmark::RegisterBenchmark("evaluation of the closed loop/hysteron", loop_in_hysteron);
  benchmark::RegisterBenchmark("evaluation of the closed loop/hysteron, as in simulations", loop_folded);
  benchmark::RegisterBenchmark("evaluation of 50 gains and sums/by hand", chain_by_hand_in_place);
  benchmark::RegisterBenchmark("evaluation of 50 gains and sums/hysteron", chain_in_hysteron);
}

}  // namespace hysteron::benchmarks
