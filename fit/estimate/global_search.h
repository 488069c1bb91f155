// Decides how global methods ask for costs: counted, within the budget, the best kept, failures survived.
// Internal to fit/: swarm.cpp and nlopt_search.cpp search, global.cpp chooses between them.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "fit/estimate/global.h"

namespace hysteron {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

class CostCounter {
 public:
  using Cost = std::function<double(const Point&)>;

  CostCounter(const GlobalProblem& problem, bool scaled, const GlobalSettings& settings, GlobalResult& result);

  /// The budget is used up, or the caller wants no more.
  bool ended() const { return result_.stopped || result_.runs >= settings_.max_runs; }
  /// The cost, +inf where there is none.
  double operator()(const Point& point);
  /// Costs of as many of the points as the budget allows.
  std::vector<double> of_each(const std::vector<Point>& points);

 private:
  double count(const Point& point, double cost);

  const GlobalSettings& settings_;
  GlobalResult& result_;
  Cost cost_;
  std::function<std::vector<double>(const std::vector<Point>&)> of_each_;
};

/// PSO as in thesis Eqs. 4.1 to 4.3; with `attracted`, its data-driven variant, Eq. 4.13.
void search_by_swarm(const GlobalProblem& problem, bool attracted, const GlobalSettings& settings, CostCounter& cost);

/// "crs2", "isres", "esch", "direct" of NLopt.
void search_by_nlopt(const GlobalProblem& problem, const std::string& method, const GlobalSettings& settings,
                     CostCounter& cost);

struct Polished {
  Point best;  ///< empty if no point could be evaluated
  double cost = 0;
  long runs = 0;
  bool stopped = false;
};

/// Sbplx of NLopt from one start: for few unknowns and costs with kinks. `step`: where to look at first; ends where the
/// unknowns move by less than `tolerance` relative. `go_on` sees the best cost so far.
Polished minimize_without_slopes(const std::function<double(const Point&)>& cost, const Point& start, const Point& step,
                                 double tolerance, long max_runs, const std::function<bool(double)>& go_on);

}  // namespace hysteron
