// Global methods of NLopt on the same problem: controlled random search (CRS2), evolution strategies (ISRES, ESCH),
// dividing rectangles (DIRECT-L). Source: S. G. Johnson, The NLopt nonlinear-optimization package.
#include <nlopt.h>

#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <memory>

#include "engine/error.h"
#include "fit/global_search.h"

namespace hysteron {
namespace {

/// What the library sees of a point without a cost: so large that it loses, small enough to be reckoned with.
constexpr double lost = 1e100;

struct Asked {
  CostCounter& cost;
  nlopt_opt library;
  std::exception_ptr error{};
};

/// No exception crosses the library: it is kept and thrown behind it.
double ask(unsigned n, const double* x, double*, void* data) {
  auto& asked = *static_cast<Asked*>(data);
  if (asked.error || asked.cost.ended()) {
    nlopt_force_stop(asked.library);
    return lost;
  }
  try {
    const double cost = asked.cost(Point(x, x + n));
    if (asked.cost.ended()) nlopt_force_stop(asked.library);
    return std::isfinite(cost) ? cost : lost;
  } catch (...) {
    asked.error = std::current_exception();
    nlopt_force_stop(asked.library);
    return lost;
  }
}

}  // namespace

void search_by_nlopt(const GlobalProblem& problem, const std::string& method, const GlobalSettings& settings,
                     CostCounter& cost) {
  static const std::map<std::string, nlopt_algorithm> algorithms{
      {"crs2", NLOPT_GN_CRS2_LM}, {"isres", NLOPT_GN_ISRES}, {"esch", NLOPT_GN_ESCH}, {"direct", NLOPT_GN_DIRECT_L}};
  const auto n = problem.lower.size();
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> library(
      nlopt_create(algorithms.at(method), static_cast<unsigned>(n)), &nlopt_destroy);
  if (!library) fail_numerics("no_solver", method, "NLopt cannot begin", "choose another method");
  Asked asked{cost, library.get()};
  nlopt_set_min_objective(library.get(), &ask, &asked);
  nlopt_set_lower_bounds(library.get(), problem.lower.data());
  nlopt_set_upper_bounds(library.get(), problem.upper.data());
  nlopt_srand(settings.seed);  // of this thread
  Point x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = (problem.lower[i] + problem.upper[i]) / 2;
  double reached = std::numeric_limits<double>::infinity();
  // What it returns says only why it stopped; the best point is in the counter.
  nlopt_optimize(library.get(), x.data(), &reached);
  if (asked.error) std::rethrow_exception(asked.error);
}

}  // namespace hysteron
