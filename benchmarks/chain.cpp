// W3: N lags in a chain with feedback from neighbour to neighbour and from the far end, 1 s, relative tolerance 1e-6:
// N lags, N sums, 1.1 N gains and one source.
#include <benchmark/benchmark.h>

#include <map>
#include <string>

#include "benchmarks/diagrams.h"
#include "benchmarks/workloads.h"

namespace hysteron::benchmarks {
namespace {

ProgramPointer chain_in_hysteron(int n) {
  const auto name = [](const char* what, int i) { return what + std::to_string(i); };
  Diagram d;
  d.blocks["drive"] = node("sine", {{"amplitude", 1.0}, {"frequency", "5 Hz"}});
  for (int i = 0; i < n; ++i) {
    std::vector<std::string> in;
    std::string signs;
    const auto add = [&](const std::string& from, char sign) {
      in.push_back(from);
      signs += sign;
    };
    if (i > 0) add(name("x", i - 1), '+');
    if (i + 1 < n) {
      d.blocks[name("back", i)] = node("gain", {{"gain", 0.5}}, {name("x", i + 1)});
      add(name("back", i), '-');
    }
    if (i % 10 == 0) {
      d.blocks[name("far", i)] = node("gain", {{"gain", 0.2}}, {name("x", n - 1 - i)});
      add("drive", '+');
      add(name("far", i), '-');
    }
    d.blocks[name("in", i)] = node("sum", {{"signs", signs}}, in);
    d.blocks[name("x", i)] = node("lag", {{"times", numbers({chain_time_constant(i)}, "s")}}, {name("in", i)});
  }
  d.record = {name("x", 0), name("x", n / 2), name("x", n - 1)};
  return compiled(d);
}

double error_of(const std::vector<std::vector<double>>& traces, int n) {
  static std::map<int, std::vector<std::vector<double>>> references;
  auto& reference = references[n];
  if (reference.empty()) reference = chain_by_hand(n, 1e-11, 1e-13);
  double worst = 0;
  for (std::size_t s = 0; s < reference.size(); ++s) worst = std::max(worst, largest_error(traces[s], reference[s]));
  return worst;
}

void by_hand(benchmark::State& state, int n) {
  std::vector<std::vector<double>> traces;
  for (auto _ : state) traces = chain_by_hand(n, 1e-6, 1e-8);
  state.counters["error"] = error_of(traces, n);
}

void in_hysteron(benchmark::State& state, int n) {
  const auto program = chain_in_hysteron(n);
  const auto run = start(*program);
  const SimulateOptions options{.until = 1, .every = 1e-3, .method = Method::bdf, .relative_tolerance = 1e-6};
  Traces traces;
  for (auto _ : state) traces = simulate(*program, run, options);
  state.counters["error"] = error_of(traces.values, n);
  state.counters["steps"] = static_cast<double>(traces.statistics.steps);
}

}  // namespace

void register_chains() {
  for (const int n : {10, 100, 1000}) {
    const std::string group = "chain of " + std::string(n < 100 ? "  " : n < 1000 ? " " : "") + std::to_string(n);
    benchmark::RegisterBenchmark((group + " lags/by hand").c_str(), by_hand, n);
    benchmark::RegisterBenchmark((group + " lags/hysteron").c_str(), in_hysteron, n);
  }
}

}  // namespace hysteron::benchmarks
