// Global methods of NLopt on the same problem: controlled random search (CRS2), evolution strategies (ISRES, ESCH),
// dividing rectangles (DIRECT-L). Source: S. G. Johnson, The NLopt nonlinear-optimization package.
#include <nlopt.h>

#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <memory>

#include "engine/diagram/error.h"
#include "fit/estimate/global_search.h"

namespace hysteron {
namespace {

/// What the library sees of a point without a cost: so large that it loses, small enough to be reckoned with.
constexpr double lost = 1e100;

struct Asked {
  CostCounter& cost;
  nlopt_opt optimizer;
  std::exception_ptr error{};
};

/// No exception crosses the library: it is kept and thrown behind it.
double ask(unsigned n, const double* x, double*, void* data) {
  auto& asked = *static_cast<Asked*>(data);
  if (asked.error || asked.cost.ended()) {
    nlopt_force_stop(asked.optimizer);
    return lost;
  }
  try {
    const double cost = asked.cost(Point(x, x + n));
    if (asked.cost.ended()) nlopt_force_stop(asked.optimizer);
    return std::isfinite(cost) ? cost : lost;
  } catch (...) {
    asked.error = std::current_exception();
    nlopt_force_stop(asked.optimizer);
    return lost;
  }
}

using Library = std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)>;

Library library_for(nlopt_algorithm algorithm, std::size_t n) {
  Library library(nlopt_create(algorithm, static_cast<unsigned>(n)), &nlopt_destroy);
  if (!library)
    fail_numerics("no_solver", nlopt_algorithm_name(algorithm), "NLopt cannot begin", "choose another method");
  return library;
}

void optimize(const Library& library, CostCounter& cost, Point x) {
  Asked asked{cost, library.get()};
  nlopt_set_min_objective(library.get(), &ask, &asked);
  double reached = std::numeric_limits<double>::infinity();
  // What it returns says only why it stopped; the best point is in the counter.
  nlopt_optimize(library.get(), x.data(), &reached);
  if (asked.error) std::rethrow_exception(asked.error);
}

}  // namespace

void search_by_nlopt(const GlobalProblem& problem, const std::string& method, const GlobalSettings& settings,
                     CostCounter& cost) {
  static const std::map<std::string, nlopt_algorithm> algorithms{
      {"crs2", NLOPT_GN_CRS2_LM}, {"isres", NLOPT_GN_ISRES}, {"esch", NLOPT_GN_ESCH}, {"direct", NLOPT_GN_DIRECT_L}};
  const Library library = library_for(algorithms.at(method), problem.lower.size());
  nlopt_set_lower_bounds(library.get(), problem.lower.data());
  nlopt_set_upper_bounds(library.get(), problem.upper.data());
  nlopt_srand(settings.seed);  // of this thread
  Point centre;
  for (std::size_t i = 0; i < problem.lower.size(); ++i) centre.push_back((problem.lower[i] + problem.upper[i]) / 2);
  optimize(library, cost, centre);
}

Polished minimize_without_slopes(const std::function<double(const Point&)>& cost, const Point& start, const Point& step,
                                 double tolerance, long max_runs, const std::function<bool(double)>& go_on) {
  GlobalProblem problem;
  problem.cost = cost;
  GlobalSettings settings;
  settings.max_runs = max_runs;
  if (go_on) settings.go_on = [&](const GlobalProgress& p) { return go_on(p.cost); };
  GlobalResult result;
  CostCounter counter(problem, false, settings, result);
  const Library library = library_for(NLOPT_LN_SBPLX, start.size());
  nlopt_set_initial_step(library.get(), step.data());
  nlopt_set_xtol_rel(library.get(), tolerance);
  optimize(library, counter, start);
  return {result.best, result.cost, result.runs, result.stopped};
}

}  // namespace hysteron
