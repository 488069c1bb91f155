// Runs the workloads interleaved and prints, for each group, CPU times as multiples of the program written by hand.
// Takes the options of Google Benchmark; without any, 7 repetitions in random order.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "benchmarks/workloads.h"

namespace {

class Ratios : public benchmark::ConsoleReporter {
 public:
  bool ReportContext(const Context& context) override { return ConsoleReporter::ReportContext(context); }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const auto& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      const auto name = run.run_name.function_name;
      if (!times_.contains(name)) order_.push_back(name);
      times_[name].push_back(run.GetAdjustedCPUTime());  // ns, the registered unit
      blocks_[name] = run.counters.contains("blocks") ? run.counters.at("blocks").value : 0.0;
      calls_[name] = run.counters.contains("calls") ? run.counters.at("calls").value : 0.0;
      errors_[name] = run.counters.contains("error") ? run.counters.at("error").value : 0.0;
    }
  }

  void Finalize() override {
    std::sort(order_.begin(), order_.end());
    std::string group;
    for (const auto& name : order_) {
      const auto slash = name.find('/');
      if (name.substr(0, slash) != group) {
        group = name.substr(0, slash);
        std::printf("\n%-40s %12s %8s %14s %12s\n", group.c_str(), "CPU ms", "ratio", "spread", "error");
      }
      auto& own = times_[name];
      std::sort(own.begin(), own.end());
      const double base = median(times_[group + "/by hand"]);
      std::printf("  %-38s %12.4g %8.2f %6.2f - %5.2f %12.2g\n", name.substr(slash + 1).c_str(), median(own) / 1e6,
                  median(own) / base, own.front() / base, own.back() / base, errors_[name]);
      if (blocks_[name] > 0)
        std::printf("  %38s %12.1f ns per block beyond the arithmetic, %.1f per call\n", "",
                    (median(own) - base) / blocks_[name], (median(own) - base) / calls_[name]);
    }
  }

 private:
  static double median(std::vector<double> v) {
    if (v.empty()) return 0;
    std::sort(v.begin(), v.end());
    return v[v.size() / 2];
  }

  std::map<std::string, std::vector<double>> times_;
  std::map<std::string, double> errors_, blocks_, calls_;
  std::vector<std::string> order_;
};

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv, argv + argc);
  if (argc == 1)
    for (const char* option :
         {"--benchmark_repetitions=7", "--benchmark_enable_random_interleaving=true", "--benchmark_min_time=0.1"})
      words.emplace_back(option);
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  int count = static_cast<int>(arguments.size());
  hysteron::benchmarks::register_closed_loop();
  hysteron::benchmarks::register_open_loop();
  hysteron::benchmarks::register_chains();
  hysteron::benchmarks::register_creep();
  hysteron::benchmarks::register_lanes();
  hysteron::benchmarks::register_evaluation();
  hysteron::benchmarks::register_expression();
  hysteron::benchmarks::register_sampled_loop();
  hysteron::benchmarks::register_single_blocks();
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  Ratios ratios;
  benchmark::RunSpecifiedBenchmarks(&ratios);
  benchmark::Shutdown();
  return 0;
}
