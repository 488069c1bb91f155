// Decides how the smallest cost in a box is asked for where no slopes are trusted: one problem, methods by name.
// Does not know what the cost is made of, nor polish what it finds: fit.h does.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hysteron {

/// Values of the unknowns, in the order of the bounds.
using Point = std::vector<double>;

/// A point that the data suggest, towards which "nmpso" draws its particles at first. Components that are not named
/// here are not drawn. Source: thesis Eqs. 4.11 to 4.13.
struct Attractor {
  struct Exponential {
    double factor = 0, rate = 0;  ///< factor * exp(rate * x)
  };
  /// One component of the point: drawn anew for each particle and iteration, or found from one that is.
  struct Component {
    int component = -1;        ///< which unknown
    double low = 0, high = 0;  ///< drawn uniformly between these, where `of` is -1
    int of = -1;               ///< else: from this drawn unknown x, halfway between two curves, times `scale`,
    std::vector<Exponential> upper{}, lower{};  ///< each a sum of exponentials of x, then cut to the bounds
    double scale = 1;
  };
  std::vector<Component> components;
};

/// The attractor of the thesis for the Jiles-Atherton model on an input from 0 to `top` [unit of k]: c drawn between
/// 0.001 and 0.999, k halfway between the curves that enclose piezo loops. `c` and `k` are places in the point.
Attractor piezo_attractor(int c, int k, double top);

struct GlobalProblem {
  Point lower, upper;  ///< finite, lower < upper
  /// The cost of a point inside the bounds, not below zero; +inf or not a number where it cannot be evaluated: that
  /// candidate is lost, never the search.
  std::function<double(const Point&)> cost;
  /// Optional: many at once, with the same numbers. Swarms ask for all particles of an iteration together.
  std::function<std::vector<double>(const std::vector<Point>&)> cost_of_each{};
  /// Optional: the cost of the model scaled to the size of the data (its linear parameters found at each point). What
  /// "npso" and "nmpso" search, as the thesis does with the normalised model; all other methods search `cost`.
  std::function<double(const Point&)> scaled_cost{};
  std::optional<Attractor> attractor{};  ///< needed by "nmpso"
};

struct GlobalProgress {
  long runs = 0;    ///< costs asked for so far
  double cost = 0;  ///< best so far
};

struct GlobalSettings {
  std::uint64_t seed = 1;
  long max_runs = 505;  ///< budget of model runs: 100 iterations of five particles behind their start
  int particles = 5;    ///< of the swarms
  /// c_1, c_2, c_3: pull of a particle's own best, of the swarm's best, of the attractor.
  double own_pull = 1.494, swarm_pull = 1.494, attractor_pull = 1.494;
  std::function<bool(const GlobalProgress&)> go_on{};  ///< asked between runs; false = end with the best so far
};

struct GlobalResult {
  Point best;                   ///< empty if no point could be evaluated
  double cost = 0;              ///< +inf if no point could be evaluated
  long runs = 0, failures = 0;  ///< costs asked for; of those, without a value
  /// Best cost after each run that lowered it: (number of runs so far, cost).
  std::vector<std::pair<long, double>> history{};
  bool stopped = false;  ///< by go_on
  std::string method{};

  /// Best cost after `n` runs; +inf before the first that had a value.
  double cost_after(long n) const;
  /// Runs until the cost was at most `wanted`; -1 if it never was.
  long runs_until(double wanted) const;
};

/// Names: "pso", "npso", "nmpso" (swarm.h), "crs2", "isres", "esch", "direct" (NLopt).
const std::vector<std::string>& global_method_names();

/// Deterministic: the same problem, method and seed give the same result with any number of threads behind the cost.
/// Throws Error where the question is wrong: "unknown_method", "bad_bounds", "no_attractor", "bad_attractor".
GlobalResult minimize_globally(const GlobalProblem& problem, const std::string& method,
                               const GlobalSettings& settings = {});

}  // namespace hysteron
