// Prints what it costs to identify Jiles-Atherton on the steady loop of the surrogate actuator S1: the thesis' particle
// swarms, the global methods of NLopt, and the local search of `fit` from random starts. Reached error against model
// runs and seconds, medians over seeds; and the shares that SPEC 4.3 gives for the swarms. Tables for
// docs/identification.md.
//
//   hysteron_identification [seeds]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "blocks/register_all.h"
#include "engine/simulate/simulate.h"
#include "fit/estimate/fit.h"
#include "fit/estimate/global.h"
#include "fit/numerics/draws.h"
#include "io/diagram/diagram_file.h"

namespace {

using namespace hysteron;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int per_cycle = 200;                    // rows; sums of squares are told for 2000, as in the thesis
constexpr double to_thesis = 2000.0 / per_cycle;  // N of SPEC 4.3
constexpr long budget = 505;                      // 100 iterations of 5 particles behind their start

const Registry& registry() {
  static const Registry all = all_blocks();
  return all;
}

/// Two cycles, the second judged: the steady loop of S1 on 0 ... 6 V at 5 Hz [V, m].
DataSet steady_loop() {
  Diagram d = read_diagram(std::string(HYSTERON_SOURCE_DIR) + "/diagrams/chapter2/s1_open_loop.json");
  const auto program = compile(d, registry());
  SimulateOptions options;
  for (int k = 0; k <= 2 * per_cycle; ++k) options.instants.push_back(1 + 0.2 * k / per_cycle);
  options.until = options.instants.back();
  options.relative_tolerance = 1e-9;
  const Traces traces = simulate(*program, start(*program), options);
  DataSet data;
  for (const char* name : {"u", "y"}) data.notes[name].to = name;
  data.notes["y"].zero_per_recording = true;
  data.notes["y"].noise.white = 10e-9;
  data.notes["y"].noise.one_over_f = 0.0;
  Recording r;
  r.name = r.file = "loop";
  r.t = traces.t;
  for (double& t : r.t) t -= 1;
  r.columns["u"] = traces.values[0];
  r.columns["y"] = traces.values[2];
  r.units["u"] = parse_unit("V");
  r.units["y"] = parse_unit("um");
  r.first = per_cycle;
  r.last = 2 * per_cycle;
  data.recordings.push_back(std::move(r));
  return data;
}

/// Jiles-Atherton with a scale, driven by the column u.
Diagram jiles_atherton() {
  Diagram d;
  d.inputs["u"].unit = "V";
  d.outputs["y"] = "law";
  Node& n = d.blocks["law"];
  n.type = "jiles_atherton";
  n.in = {{"", "u"}};
  n.parameters["p_s"] = "50 um";
  n.parameters["a"] = "50 V";
  n.parameters["alpha"] = "0.25 V/um";
  n.parameters["k"] = "5 V";
  n.parameters["c"] = 0.5;
  return d;
}

// Thesis Table 4.1, in um and V: P_s, a, alpha, k, c.
const Point lower{1, 1, 0.005, 0.01, 0.001}, upper{100, 100, 0.5, 10, 0.999};
const char* const names[] = {"law.p_s", "law.a", "law.alpha", "law.k", "law.c"};
const double si[] = {1e-6, 1, 1e6, 1, 1};

class SteadyLoop {
 public:
  explicit SteadyLoop(std::shared_ptr<const DataSet> data)
      : model_(compile(jiles_atherton(), registry()), std::move(data)) {
    for (int i = 0; i < 5; ++i) places_[i] = parameter_index(model_.program(), names[i]);
  }
  DataModel& model() { return model_; }

  /// Sums of squares [um^2] for N = 2000.
  struct Fitness {
    double thesis = infinity;   ///< zeros at the bottom of the loop; scaled: to the measured stroke
    double squares = infinity;  ///< scale and zero by least squares: what a fit with the linear parameter `scale` sees
  };
  Fitness fitness(const Point& x, bool scaled) {
    const Rows p = rows(x);
    if (p.empty()) return {};
    const Rows& y = model_.measured(0, 0);
    const double scale = scaled ? stroke(y) / stroke(p) : 1;
    const auto n = static_cast<double>(y.size());
    double sp = 0, sy = 0, spp = 0, spy = 0, syy = 0, sum = 0;
    for (std::size_t k = 0; k < y.size(); ++k) {
      sum += std::pow(scale * (p[k] - p[0]) - (y[k] - y[0]), 2);
      sp += p[k];
      sy += y[k];
    }
    for (std::size_t k = 0; k < y.size(); ++k) {
      spp += std::pow(p[k] - sp / n, 2);
      spy += (p[k] - sp / n) * (y[k] - sy / n);
      syy += std::pow(y[k] - sy / n, 2);
    }
    return {1e12 * to_thesis * sum, 1e12 * to_thesis * (syy - spy * spy / spp)};
  }

 private:
  Rows rows(const Point& x) {
    std::vector<ParameterValue> values;
    for (std::size_t i = 0; i < 5; ++i) values.push_back({places_[i], si[i] * x[i]});
    auto prediction = model_.predict(values, std::vector<int>{0}, false);
    return prediction.ok ? prediction.y[0][0] : Rows{};
  }
  static double stroke(const Rows& y) {
    const auto [low, high] = std::minmax_element(y.begin(), y.end());
    return *high - *low;
  }
  DataModel model_;
  int places_[5];
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double quantile(std::vector<double> v, double share) {
  if (v.empty()) return infinity;
  std::sort(v.begin(), v.end());
  return v[static_cast<std::size_t>(share * static_cast<double>(v.size() - 1) + 0.5)];
}

struct Searched {
  std::vector<GlobalResult> results;  // per seed
  /// Per seed: (runs so far, Fitness::squares) where the best point changed.
  std::vector<std::vector<std::pair<long, double>>> squares;
  double seconds = 0;  // of one search
};

Searched search(SteadyLoop& loop, const std::string& method, int seeds, long runs = budget) {
  GlobalProblem problem;
  problem.lower = lower;
  problem.upper = upper;
  problem.attractor = piezo_attractor(4, 3, 6);
  // The methods of NLopt get the normalised model too: they are held against the best of the thesis.
  const bool scaled = method != "pso";
  long run = 0;
  double best = infinity;
  std::vector<std::pair<long, double>> squares;
  problem.cost = [&, scaled](const Point& x) {
    ++run;
    const auto f = loop.fitness(x, scaled);
    if (f.thesis < best) {
      best = f.thesis;
      squares.emplace_back(run, f.squares);
    }
    return f.thesis;
  };
  Searched all;
  const auto begin = std::chrono::steady_clock::now();
  for (int seed = 1; seed <= seeds; ++seed) {
    GlobalSettings settings;
    settings.seed = static_cast<std::uint64_t>(seed);
    settings.max_runs = runs;
    run = 0;
    best = infinity;
    squares.clear();
    all.results.push_back(minimize_globally(problem, method, settings));
    all.squares.push_back(squares);
  }
  all.seconds = seconds_since(begin) / seeds;
  return all;
}

double runs_until(const std::vector<std::pair<long, double>>& history, double wanted) {
  for (const auto& [run, value] : history)
    if (value <= wanted) return static_cast<double>(run);
  return infinity;
}

std::vector<double> after(const Searched& s, long runs) {
  std::vector<double> costs;
  for (const auto& r : s.results) costs.push_back(r.cost_after(runs));
  return costs;
}

double share_below(const Searched& a, const Searched& b, long runs) {
  const auto ca = after(a, runs), cb = after(b, runs);
  int below = 0;
  for (std::size_t i = 0; i < ca.size(); ++i) below += ca[i] < cb[i] ? 1 : 0;
  return static_cast<double>(below) / static_cast<double>(ca.size());
}

void print_searches(const std::map<std::string, Searched>& searches) {
  fmt::print("\nFitness S [um^2], N = 2000, zero at the bottom of the loop: medians [quartiles] after iterations\n");
  fmt::print(
      "| method | 1 | 5 | 10 | 20 | 50 | 100 | quartiles at 100 | ms per search "
      "|\n|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& method : global_method_names()) {
    const auto& s = searches.at(method);
    fmt::print("| {} |", method);
    for (const int it : {1, 5, 10, 20, 50, 100}) fmt::print(" {:.3g} |", quantile(after(s, 5 + 5 * it), 0.5));
    fmt::print(" {:.3g} - {:.3g} | {:.0f} |\n", quantile(after(s, budget), 0.25), quantile(after(s, budget), 0.75),
               1000 * s.seconds);
  }
  fmt::print("\nShares of seeds\n| after iteration | 5 | 10 | 20 | 50 | 100 |\n|---|---|---|---|---|---|\n");
  for (const auto& [a, b] : {std::pair{"npso", "pso"}, {"nmpso", "npso"}}) {
    fmt::print("| {} below {} |", a, b);
    for (const int it : {5, 10, 20, 50, 100})
      fmt::print(" {:.2f} |", share_below(searches.at(a), searches.at(b), 5 + 5 * it));
    fmt::print("\n");
  }
}

struct LocalSearch {
  double reached = infinity;  // Fitness::squares
  long runs = 0;
  std::vector<std::pair<long, double>> squares{};
  double seconds = 0;
};

/// The local search of fit from one random start in the box; scale and zero linear. Ended after 1, 2, 3 ... iterations,
/// which tells its error against its runs.
LocalSearch local(SteadyLoop& loop, std::uint64_t seed) {
  DataModel& model = loop.model();
  auto free = free_parameters(model.program(), {"law.a", "law.alpha", "law.k", "law.c", "law.scale"});
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = i + 1;
    free[i].lower = si[j] * lower[j];
    free[i].upper = si[j] * upper[j];
    free[i].scan.clear();  // from this start alone
    free[i].start = si[j] * (lower[j] + draws::uniform(seed, 17, i) * (upper[j] - lower[j]));
  }
  free[4].lower = 0;
  free[4].upper = 1e3;
  LocalSearch found;
  const double per_chi2 = 1e12 * to_thesis * 1e-16;  // um^2 of chi2 with a noise of 10 nm
  for (int iterations = 1;; ++iterations) {
    FitOptions options;
    options.intervals = false;
    options.refine = 1;
    options.max_iterations = iterations;
    const long before = model.runs();
    const auto begin = std::chrono::steady_clock::now();
    const auto r = fit(model, noise_before_fit(model), free, options);
    const long runs = model.runs() - before;
    const bool ended = runs == found.runs || iterations == 60;  // it converged before
    found.seconds = seconds_since(begin);
    found.runs = runs;
    if (r.ok) {
      found.reached = per_chi2 * r.chi2;
      found.squares.emplace_back(runs, found.reached);
    }
    if (ended) return found;
  }
}

std::string count(double runs) { return std::isfinite(runs) ? fmt::format("{:.0f}", runs) : "never"; }

/// Medians of the runs until an error is reached, by the swarm of the thesis and by the local search.
void print_local(SteadyLoop& loop, int starts, const Searched& swarm, double at_the_end) {
  std::vector<LocalSearch> all;
  std::vector<double> reached, runs, seconds;
  for (int k = 1; k <= starts; ++k) {
    all.push_back(local(loop, static_cast<std::uint64_t>(k)));
    reached.push_back(all.back().reached);
    runs.push_back(static_cast<double>(all.back().runs));
    seconds.push_back(all.back().seconds);
  }
  fmt::print("\nModel runs until the error is reached (scale and zero by least squares, N = 2000), medians\n");
  fmt::print(
      "| error um^2 | nmpso | local search, {} random starts | ratio | starts that reach it |\n|---|---|---|---|---|\n",
      starts);
  for (const double wanted : {5.0, 2.0, 1.5, at_the_end, 1.0, 0.85}) {
    std::vector<double> by_swarm, by_start;
    for (const auto& history : swarm.squares) by_swarm.push_back(runs_until(history, wanted));
    int there = 0;
    for (const auto& one : all) {
      by_start.push_back(runs_until(one.squares, wanted));
      there += std::isfinite(by_start.back()) ? 1 : 0;
    }
    const double a = quantile(by_swarm, 0.5), b = quantile(by_start, 0.5);
    fmt::print("| {:.3g} | {} | {} | {} | {} |\n", wanted, count(a), count(b),
               std::isfinite(a) ? fmt::format("{:.1f}", a / b) : "", there);
  }
  fmt::print(
      "the local search ends at {:.4g} {:.4g} {:.4g} um^2 (quartiles) after {:.0f} {:.0f} {:.0f} runs, {:.0f} ms\n",
      quantile(reached, 0.25), quantile(reached, 0.5), quantile(reached, 0.75), quantile(runs, 0.25),
      quantile(runs, 0.5), quantile(runs, 0.75), 1000 * quantile(seconds, 0.5));
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 30;
  SteadyLoop loop(std::make_shared<const DataSet>(steady_loop()));
  const Point table{56, 48.6, 0.2512, 3.889, 0.6929};
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < 20; ++k) loop.fitness(table, true);
  const auto& why = loop.model().why_not_exact();
  fmt::print("one model run of two cycles, {} rows: {:.3g} ms{}\n", 2 * per_cycle, 1000 * seconds_since(begin) / 20,
             why.empty() ? ", exact advance" : " by integration: " + why);
  std::map<std::string, Searched> searches;
  for (const auto& method : global_method_names()) searches[method] = search(loop, method, seeds);
  print_searches(searches);
  std::vector<double> ends;
  for (const auto& history : searches.at("nmpso").squares) ends.push_back(history.back().second);
  print_local(loop, seeds, search(loop, "nmpso", seeds, 4 * budget), quantile(ends, 0.5));
}
