// W1: PI control of a fourth-order plant behind Bouc-Wen hysteresis, 2 s, 20001 rows, relative tolerance 1e-6.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "benchmarks/workloads.h"
#include "blocks/register_all.h"
#include "engine/simulate.h"

namespace hysteron::benchmarks {
namespace {

constexpr double until = 2, row = 1e-4, um = 1e-6;

const ClosedLoop& reference() {
  static const ClosedLoop loop = closed_loop_reference(until, 100);  // 1 us: off by less than 1e-9 um
  return loop;
}

double largest_error(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = a.size() == b.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst;
}

Node node(const char* type, std::vector<std::pair<std::string, Value>> parameters, std::vector<std::string> in = {}) {
  Node made;
  made.type = type;
  for (auto& [name, value] : parameters) made.parameters[name] = value;
  for (auto& from : in) made.in.push_back({"", from});
  return made;
}

NumberList numbers(std::initializer_list<double> values) {
  NumberList list;
  for (const double v : values) list.push_back({v, {}});
  return list;
}

ProgramPointer loop_in_hysteron() {
  static const Registry registry = all_blocks();
  Diagram d;
  d.blocks["reference"] =
      node("sine", {{"amplitude", "3 um"}, {"offset", "3 um"}, {"frequency", "5 Hz"}, {"phase", "-90 deg"}});
  d.blocks["error"] = node("sum", {{"signs", "+-"}}, {"reference", "stage"});
  d.blocks["controller"] = node("pi_controller", {{"kp", "1.207 V/um"}, {"ki", "7009 V/um/s"}}, {"error"});
  d.blocks["hysteresis"] = node(
      "bouc_wen", {{"alpha", "0.6187 um/V"}, {"beta", "0.2418 1/V"}, {"gamma", "0.0237 1/V"}, {"d_p", "1.6126 um/V"}},
      {"controller"});
  d.blocks["stage"] =
      node("transfer_function",
           {{"num", numbers({1.377e16})}, {"den", numbers({1, 2.813e4, 5.403e8, 4.981e12, 1.822e16})}}, {"hysteresis"});
  d.record = {"stage", "controller"};
  return compile(d, registry);
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

struct How {
  Method method = Method::bdf;
  bool compile_too = false;
  bool tolerances_as_by_hand = false;  ///< else as a user gets them
};

void in_hysteron(benchmark::State& state, How how) {
  auto program = loop_in_hysteron();
  SimulateOptions options{.until = until, .every = row, .method = how.method, .relative_tolerance = 1e-6};
  if (how.tolerances_as_by_hand) options.absolute_tolerance = absolute_tolerance(*program);
  Traces traces;
  for (auto _ : state) {
    if (how.compile_too) program = loop_in_hysteron();
    traces = simulate(*program, start(*program), options);
  }
  auto y = traces.values[0];
  for (auto& v : y) v /= um;
  state.counters["error"] = largest_error(y, reference().y);
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
}

}  // namespace hysteron::benchmarks
