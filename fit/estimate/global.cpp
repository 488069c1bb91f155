#include "fit/estimate/global.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "fit/estimate/global_search.h"

namespace hysteron {
namespace {

void check_bounds(const GlobalProblem& problem) {
  if (problem.lower.empty() || problem.lower.size() != problem.upper.size())
    fail("bad_bounds", "bounds",
         fmt::format("{} lower and {} upper bounds", problem.lower.size(), problem.upper.size()),
         "give one of each per unknown, and at least one unknown");
  for (std::size_t i = 0; i < problem.lower.size(); ++i)
    if (!(std::isfinite(problem.lower[i]) && std::isfinite(problem.upper[i]) && problem.lower[i] < problem.upper[i]))
      fail("bad_bounds", fmt::format("bounds[{}]", i),
           fmt::format("a global search needs a finite box, and [{}, {}] is none", problem.lower[i], problem.upper[i]),
           "give two finite bounds, the lower one first");
}

void check_attractor(const GlobalProblem& problem) {
  if (!problem.attractor || problem.attractor->components.empty())
    fail("no_attractor", "attractor", "\"nmpso\" needs a point that the data suggest, and none is given",
         "give an attractor, or use \"npso\"");
  const auto& all = problem.attractor->components;
  const int n = static_cast<int>(problem.lower.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& c = all[i];
    const auto where = fmt::format("attractor.components[{}]", i);
    if (c.component < 0 || c.component >= n)
      fail("bad_attractor", where, fmt::format("there is no unknown number {}", c.component),
           fmt::format("name one of the {} unknowns", n));
    if (c.of < 0) {
      if (!(c.low <= c.high))
        fail("bad_attractor", where, fmt::format("the range [{}, {}] is empty", c.low, c.high), "exchange its ends");
      continue;
    }
    // What it hangs on must be drawn, and before it.
    const bool drawn = std::any_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i),
                                   [&](const Attractor::Component& d) { return d.component == c.of && d.of < 0; });
    if (!drawn)
      fail("bad_attractor", where, fmt::format("it follows unknown number {}, which is not drawn before it", c.of),
           "list the drawn component first");
    if (c.upper.empty() || c.lower.empty())
      fail("bad_attractor", where, "a curve has no terms", "give upper and lower at least one exponential each");
  }
}

}  // namespace

Attractor piezo_attractor(int c, int k, double top) {
  Attractor a;
  a.components.resize(2);
  a.components[0] = {.component = c, .low = 0.001, .high = 0.999};
  // Thesis Eqs. 4.11 and 4.12 hold for an input of 0 to 1 V and grow with it, SPEC 4.2.
  a.components[1] = {.component = k,
                     .of = c,
                     .upper = {{0.112, 2.644}, {2.644e-9, 21.74}},
                     .lower = {{0.04517, 1.989}, {8.883e-16, 36.584}},
                     .scale = top};
  return a;
}

double GlobalResult::cost_after(long n) const {
  double reached = infinity;
  for (const auto& [run, value] : history)
    if (run <= n) reached = value;
  return reached;
}

long GlobalResult::runs_until(double wanted) const {
  for (const auto& [run, value] : history)
    if (value <= wanted) return run;
  return -1;
}

CostCounter::CostCounter(const GlobalProblem& problem, bool scaled, const GlobalSettings& settings,
                         GlobalResult& result)
    : settings_(settings), result_(result) {
  cost_ = scaled && problem.scaled_cost ? problem.scaled_cost : problem.cost;
  if (!(scaled && problem.scaled_cost)) of_each_ = problem.cost_of_each;
  result_.cost = infinity;
}

double CostCounter::count(const Point& point, double cost) {
  ++result_.runs;
  if (!std::isfinite(cost)) {
    ++result_.failures;
    cost = infinity;
  } else if (cost < result_.cost) {
    result_.cost = cost;
    result_.best = point;
    result_.history.emplace_back(result_.runs, cost);
  }
  return cost;
}

double CostCounter::operator()(const Point& point) {
  double cost = infinity;
  try {
    cost = cost_(point);
  } catch (const Stopped&) {  // what was found before is the result
    result_.stopped = true;
    return infinity;
  }
  cost = count(point, cost);
  if (settings_.go_on && !settings_.go_on({result_.runs, result_.cost})) result_.stopped = true;
  return cost;
}

std::vector<double> CostCounter::of_each(const std::vector<Point>& points) {
  std::vector<double> costs;
  if (!of_each_) {
    for (const auto& point : points) {
      if (ended()) break;
      costs.push_back((*this)(point));
    }
    return costs;
  }
  const auto left = static_cast<std::size_t>(std::max(0L, settings_.max_runs - result_.runs));
  const std::vector<Point> asked(points.begin(),
                                 points.begin() + static_cast<std::ptrdiff_t>(std::min(left, points.size())));
  try {
    costs = of_each_(asked);
  } catch (const Stopped&) {
    result_.stopped = true;
    return costs;
  }
  for (std::size_t i = 0; i < asked.size(); ++i) costs[i] = count(asked[i], costs[i]);
  if (settings_.go_on && !settings_.go_on({result_.runs, result_.cost})) result_.stopped = true;
  return costs;
}

const std::vector<std::string>& global_method_names() {
  static const std::vector<std::string> names{"pso", "npso", "nmpso", "crs2", "isres", "esch", "direct"};
  return names;
}

GlobalResult minimize_globally(const GlobalProblem& problem, const std::string& method,
                               const GlobalSettings& settings) {
  const auto& names = global_method_names();
  if (std::find(names.begin(), names.end(), method) == names.end())
    fail("unknown_method", "method", fmt::format("there is no global method \"{}\"", method),
         did_you_mean(method, names));
  check_bounds(problem);
  if (method == "nmpso") check_attractor(problem);
  if (settings.particles < 1 || settings.max_runs < 1)
    fail("bad_settings", "settings", fmt::format("{} particles, {} runs", settings.particles, settings.max_runs),
         "give at least one of each");
  GlobalResult result;
  result.method = method;
  const bool swarm = method == "pso" || method == "npso" || method == "nmpso";
  CostCounter cost(problem, method == "npso" || method == "nmpso", settings, result);
  if (swarm)
    search_by_swarm(problem, method == "nmpso", settings, cost);
  else
    search_by_nlopt(problem, method, settings, cost);
  return result;
}

}  // namespace hysteron
