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
#include "engine/simulate.h"
#include "fit/draws.h"
#include "fit/fit.h"
#include "fit/global.h"
#include "io/diagram_file.h"

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

  /// Sum of squares [um^2] for N = 2000; zeros at the bottom of the loop. `scaled`: to the measured stroke.
  double fitness(const Point& x, bool scaled) {
    const Rows p = rows(x);
    if (p.empty()) return infinity;
    const Rows& y = model_.measured(0, 0);
    const double scale = scaled ? stroke(y) / stroke(p) : 1;
    double sum = 0;
    for (std::size_t k = 0; k < y.size(); ++k) sum += std::pow(scale * (p[k] - p[0]) - (y[k] - y[0]), 2);
    return 1e12 * to_thesis * sum;
  }
  /// The same with scale and zero by least squares: what a fit with the linear parameter `scale` sees.
  double least_squares(const Point& x) {
    const Rows p = rows(x);
    if (p.empty()) return infinity;
    const Rows& y = model_.measured(0, 0);
    const auto n = static_cast<double>(y.size());
    double sp = 0, sy = 0, spp = 0, spy = 0, syy = 0;
    for (std::size_t k = 0; k < y.size(); ++k) {
      sp += p[k];
      sy += y[k];
    }
    for (std::size_t k = 0; k < y.size(); ++k) {
      spp += std::pow(p[k] - sp / n, 2);
      spy += (p[k] - sp / n) * (y[k] - sy / n);
      syy += std::pow(y[k] - sy / n, 2);
    }
    return 1e12 * to_thesis * (syy - spy * spy / spp);
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
  std::vector<double> least_squares;  // per seed: at the best point
  double seconds = 0;                 // of one search
};

Searched search(SteadyLoop& loop, const std::string& method, int seeds) {
  GlobalProblem problem;
  problem.lower = lower;
  problem.upper = upper;
  problem.attractor = piezo_attractor(4, 3, 6);
  // The methods of NLopt get the normalised model too: they are held against the best of the thesis.
  const bool scaled = method != "pso";
  problem.cost = [&, scaled](const Point& x) { return loop.fitness(x, scaled); };
  Searched all;
  const auto begin = std::chrono::steady_clock::now();
  for (int seed = 1; seed <= seeds; ++seed) {
    GlobalSettings settings;
    settings.seed = static_cast<std::uint64_t>(seed);
    settings.max_runs = budget;
    all.results.push_back(minimize_globally(problem, method, settings));
  }
  all.seconds = seconds_since(begin) / seeds;
  for (const auto& r : all.results) all.least_squares.push_back(r.best.empty() ? infinity : loop.least_squares(r.best));
  return all;
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
  double reached = infinity;  // least squares, N = 2000 [um^2]
  long runs = 0, until = -1;  // all; until the error was `wanted`
  double seconds = 0;
};

/// The local search of fit from one random start in the box; scale and zero linear.
LocalSearch local(SteadyLoop& loop, std::uint64_t seed, double wanted, bool logarithmic) {
  DataModel& model = loop.model();
  auto free = free_parameters(model.program(), {"law.a", "law.alpha", "law.k", "law.c", "law.scale"});
  const int from[] = {1, 2, 3, 4};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto j = static_cast<std::size_t>(from[i]);
    const double share = draws::uniform(seed, 17, i);
    free[i].lower = si[j] * lower[j];
    free[i].upper = si[j] * upper[j];
    free[i].start = logarithmic && j != 4 ? si[j] * lower[j] * std::pow(upper[j] / lower[j], share)
                                          : si[j] * (lower[j] + share * (upper[j] - lower[j]));
  }
  free[4].lower = 0;
  free[4].upper = 1e3;
  LocalSearch found;
  const long before = model.runs();
  FitOptions options;
  options.intervals = false;
  options.refine = 1;
  options.max_iterations = 100;
  const double per_chi2 = 1e12 * to_thesis * 1e-16;
  options.progress = [&](const FitProgress& p) {
    if (found.until < 0 && per_chi2 * p.chi2 <= wanted) found.until = p.runs;
    return true;
  };
  const auto begin = std::chrono::steady_clock::now();
  const auto r = fit(model, noise_before_fit(model), free, options);
  found.seconds = seconds_since(begin);
  found.runs = model.runs() - before;
  if (r.ok) found.reached = per_chi2 * r.chi2;
  if (found.until >= 0) found.until = std::min(found.until, found.runs);
  return found;
}

void print_local(SteadyLoop& loop, int starts, double wanted, long swarm_runs) {
  std::vector<double> reached, until, runs, seconds;
  int failed = 0;
  for (int k = 1; k <= starts; ++k) {
    const auto one = local(loop, static_cast<std::uint64_t>(k), wanted, false);
    reached.push_back(one.reached);
    runs.push_back(static_cast<double>(one.runs));
    until.push_back(one.until < 0 ? infinity : static_cast<double>(one.until));
    seconds.push_back(one.seconds);
    failed += one.until < 0 ? 1 : 0;
  }
  fmt::print(
      "\nLocal search (variable projection) from {} random starts in the box, against {:.4g} um^2 with scale and zero "
      "by least squares\n",
      starts, wanted);
  fmt::print(
      "starts that reach it: {} of {}; runs until then: quartiles {:.0f} {:.0f} {:.0f}, the swarm's {}: {:.1f} times\n",
      starts - failed, starts, quantile(until, 0.25), quantile(until, 0.5), quantile(until, 0.75), swarm_runs,
      static_cast<double>(swarm_runs) / quantile(until, 0.5));
  fmt::print("at the end: error quartiles {:.4g} {:.4g} {:.4g}, runs {:.0f} {:.0f} {:.0f}, {:.0f} ms\n",
             quantile(reached, 0.25), quantile(reached, 0.5), quantile(reached, 0.75), quantile(runs, 0.25),
             quantile(runs, 0.5), quantile(runs, 0.75), 1000 * quantile(seconds, 0.5));
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 30;
  SteadyLoop loop(std::make_shared<const DataSet>(steady_loop()));
  const auto begin = std::chrono::steady_clock::now();
  const Point middle{56, 48.6, 0.2512, 3.889, 0.6929};
  for (int k = 0; k < 20; ++k) loop.fitness(middle, true);
  fmt::print("one model run of two cycles, {} rows: {:.3g} ms{}\n", 2 * per_cycle, 1000 * seconds_since(begin) / 20,
             loop.model().why_not_exact().empty() ? "" : " by integration: " + loop.model().why_not_exact());
  std::map<std::string, Searched> searches;
  for (const auto& method : global_method_names()) searches[method] = search(loop, method, seeds);
  print_searches(searches);
  const double wanted = quantile(searches.at("nmpso").least_squares, 0.5);
  print_local(loop, seeds, wanted, budget);
}
