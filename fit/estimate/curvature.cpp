#include "fit/estimate/curvature.h"

#include <algorithm>
#include <cmath>

#include "fit/numerics/dense.h"

namespace hysteron {
namespace {

constexpr double z975 = 1.959963984540054;
constexpr double least_rise = 0.7, most_rise = 1.4;  // of what a parabola rises
constexpr double hardly_any = 0.05;  // share of the variance of a linear parameter that comes from those searched

/// What the covariance says of the parameters, in the units of the search.
struct Spread {
  std::vector<std::size_t> searched;  ///< of `correlated`: those that are searched
  std::vector<double> sigma;          ///< of each of `correlated`
  std::vector<int> place;             ///< of each: among the nonlinear parameters, or -1 - place among the linear
};

int place_in(const std::vector<int>& list, int x) {
  return static_cast<int>(std::find(list.begin(), list.end(), x) - list.begin());
}

Spread spread_of(const Projection& projection, const FitResult& result) {
  Spread spread;
  for (std::size_t i = 0; i < result.correlated.size(); ++i) {
    const int index = result.correlated[i];
    const auto& e = result.estimates[static_cast<std::size_t>(index)];
    spread.sigma.push_back(e.log_scale ? *e.sigma / std::abs(e.used) : *e.sigma);
    spread.place.push_back(e.linear ? -1 - place_in(projection.linear(), index)
                                    : place_in(projection.nonlinear(), index));
    if (!e.linear) spread.searched.push_back(i);
  }
  return spread;
}

/// The end of the interval of one estimate, the others moved along as the covariance says; how much of the way the
/// bounds let one go.
double walk(const Projection& projection, const ProjectedPoint& best, const FitResult& result, const Spread& spread,
            std::size_t i, double sign, Projection::Point& end) {
  const std::size_t n = result.correlated.size();
  end = {best.z, best.theta};
  for (std::size_t j = 0; j < n; ++j) {
    const double step = sign * z975 * result.correlation[i * n + j] * spread.sigma[j];
    (spread.place[j] < 0 ? end.theta[static_cast<std::size_t>(-1 - spread.place[j])]
                         : end.z[static_cast<std::size_t>(spread.place[j])]) += step;
  }
  const auto low = projection.lower(), high = projection.upper();
  double way = 1;
  for (std::size_t k = 0; k < end.z.size(); ++k)
    if (const double step = end.z[k] - best.z[k]; step != 0)
      way = std::min(way, ((step > 0 ? high[k] : low[k]) - best.z[k]) / step);
  for (std::size_t k = 0; k < end.z.size(); ++k) end.z[k] = best.z[k] + way * (end.z[k] - best.z[k]);
  for (std::size_t k = 0; k < end.theta.size(); ++k)
    end.theta[k] = best.theta[k] + way * (end.theta[k] - best.theta[k]);
  return way;
}

/// The share of a linear estimate's variance that comes from the parameters searched: c' R^-1 c, R their correlation,
/// c theirs with it.
double share_of(const Spread& spread, const FitResult& result, std::size_t i) {
  const std::size_t m = spread.searched.size(), n = result.correlated.size();
  Dense r(m, m);
  std::vector<double> c(m);
  for (std::size_t a = 0; a < m; ++a) {
    c[a] = result.correlation[i * n + spread.searched[a]];
    for (std::size_t b = 0; b < m; ++b) r(a, b) = result.correlation[spread.searched[a] * n + spread.searched[b]];
  }
  const auto solved = minimum_norm(r, c, 1e-13);
  return dot(c.data(), solved.x.data(), m);
}

}  // namespace

std::vector<int> curved_estimates(Projection& projection, const ProjectedPoint& best, const FitResult& result) {
  const Spread spread = spread_of(projection, result);
  std::vector<Projection::Point> ends;
  std::vector<double> expected;
  std::vector<int> of;
  for (const std::size_t i : spread.searched)
    for (const double sign : {-1.0, 1.0}) {
      Projection::Point end;
      const double way = walk(projection, best, result, spread, i, sign, end);
      if (way < 0.3) continue;  // a bound ends the interval before it could bend
      ends.push_back(std::move(end));
      expected.push_back(way * way * z975 * z975);
      of.push_back(result.correlated[i]);
    }
  if (ends.empty()) return {};
  std::vector<int> curved;
  const auto chi2 = projection.chi2_of(ends, best);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const double rise = (chi2[i] - best.chi2) / (result.s2 * expected[i]);
    if (rise >= least_rise && rise <= most_rise) continue;
    if (curved.empty() || curved.back() != of[i]) curved.push_back(of[i]);
  }
  if (curved.empty()) return curved;
  // A linear parameter moves with them.
  for (std::size_t i = 0; i < result.correlated.size(); ++i)
    if (spread.place[i] < 0 && share_of(spread, result, i) > hardly_any) curved.push_back(result.correlated[i]);
  return curved;
}

}  // namespace hysteron
