#include "fit/estimate/profile.h"

#include <algorithm>
#include <cmath>

#include "engine/diagram/stop.h"
#include "fit/numerics/levenberg_marquardt.h"

namespace hysteron {
namespace {

const double limit =
    std::sqrt(3.841458820694124);  // of the root of the rise: 95 % of chi-square, one degree of freedom

/// One side of a profile; the members are what its steps hand on.
class Side {
 public:
  Side(const ProfileTask& task, int which, double sign)
      : task_(task), which_(static_cast<std::size_t>(which)), sign_(sign) {
    const auto& f = task.free[which_];
    log_ = f.log_scale;
    here_ = to_z(f.start);
    wall_ = sign > 0 ? f.upper : f.lower;
    wall_ = log_ && !(wall_ > 0) ? -std::numeric_limits<double>::infinity() : to_z(wall_);
  }

  /// Walks outwards; appends (value, rise). Returns the value at which the rise is 3.84, if there is one.
  std::optional<double> walk(double step, std::vector<std::pair<double, double>>& points, std::vector<double>& better) {
    others_ = task_.free;
    others_.erase(others_.begin() + static_cast<std::ptrdiff_t>(which_));
    double inner = 0, inner_root = 0, distance = step;
    for (int k = 0; k < 14; ++k) {
      const double to_wall = std::abs(wall_ - here_);
      const bool at_wall = distance >= to_wall;
      if (at_wall) distance = to_wall;
      if (!(distance > inner)) return {};
      const auto rise = at(here_ + sign_ * distance, better);
      if (!rise) return {};
      const double root = std::sqrt(std::max(0.0, *rise));
      points.emplace_back(value_of(here_ + sign_ * distance), *rise);
      if (root >= limit) return between(inner, inner_root, distance, root, points, better);
      if (at_wall) return {};
      // Near the result the root rises in proportion to the distance: the next step aims at half a unit more.
      const double aim = std::min(root + 0.6, limit * 1.1);
      const double next = root > 1e-3 ? distance * aim / root : 3 * distance;
      inner = distance;
      inner_root = root;
      distance = std::clamp(next, 1.15 * distance, 3 * distance);
    }
    return {};
  }

 private:
  double to_z(double value) const { return log_ ? std::log(value) : value; }
  double value_of(double z) const { return log_ ? std::exp(z) : z; }

  /// The crossing lies between two distances: one more fit there, then on a straight line of the root.
  std::optional<double> between(double a, double root_a, double b, double root_b,
                                std::vector<std::pair<double, double>>& points, std::vector<double>& better) {
    const auto cross = [&] { return a + (b - a) * (limit - root_a) / (root_b - root_a); };
    const double middle = cross();
    if (const auto rise = at(here_ + sign_ * middle, better)) {
      const double root = std::sqrt(std::max(0.0, *rise));
      points.emplace_back(value_of(here_ + sign_ * middle), *rise);
      (root < limit ? a : b) = middle;
      (root < limit ? root_a : root_b) = root;
    }
    return value_of(here_ + sign_ * cross());
  }

  /// Rise of chi2 over s2 with the parameter at z and all others fitted, from where they were.
  std::optional<double> at(double z, std::vector<double>& better) {
    const auto& f = task_.free[which_];
    auto fixed = task_.fixed;
    fixed.push_back({f.parameter, std::clamp(value_of(z), f.lower, f.upper), f.recording});
    auto affine = task_.affine;
    affine.erase(affine.begin() + static_cast<std::ptrdiff_t>(which_));
    Projection projection(*task_.model, *task_.judge, others_, affine, task_.recordings, fixed);
    SearchEnd end;
    const double tolerance = task_.model->why_not_exact().empty() ? 1e-8 : 1e-6;
    const auto point =
        search_locally(projection, projection.start(), task_.max_iterations, tolerance, task_.go_on, end);
    if (!point) return {};
    const auto values = projection.values(point->z, point->theta);
    for (std::size_t i = 0; i < others_.size(); ++i) others_[i].start = values[i].value;
    double chi2 = point->chi2;
    if (f.prior) {  // the held parameter's own prior
      const double a = to_z(f.prior->first), b = to_z(f.prior->second);
      chi2 += std::pow((0.5 * (a + b) - z) / ((b - a) / (2 * 1.959963984540054)), 2);
    }
    const double rise = (chi2 - task_.chi2) / task_.s2;
    if (rise < -1e-3) {
      better.clear();
      for (std::size_t i = 0; i < values.size() && better.size() < task_.free.size(); ++i) {
        if (i == which_) better.push_back(value_of(z));
        if (i < others_.size()) better.push_back(values[i].value);
      }
    }
    return rise;
  }

  const ProfileTask& task_;
  std::size_t which_;
  double sign_;
  bool log_ = false;
  double here_ = 0, wall_ = 0;
  std::vector<FreeParameter> others_;
};

}  // namespace

PointPointer search_locally(Projection& projection, std::vector<double> z, int max_iterations, double tolerance,
                            const std::function<bool()>& go_on, SearchEnd& end, double matters) {
  PointPointer best;
  const auto see = [&](std::span<const double> at) {
    auto point = projection.at(at);
    if (point->ok && (!best || point->chi2 < best->chi2)) best = point;
    return point;
  };
  if (projection.n_nonlinear() == 0) {
    see(z);
    end.converged = best != nullptr;
    end.message = "linear least squares: exact";
    return best;
  }
  LeastSquares problem;
  problem.lower = projection.lower();
  problem.upper = projection.upper();
  problem.largest_step = projection.largest_step();
  problem.residual = [&](std::span<const double> at, std::vector<double>& residual) {
    const auto point = see(at);
    if (point->ok) residual = point->residual;
    return point->ok;
  };
  problem.linear_model = [&](std::span<const double> at, LinearizedResidual& model) {
    return projection.linear_model(*projection.at(at), false, model);
  };
  if (projection.knows())
    problem.known_model = [&](std::span<const double> at, LinearizedResidual& model) {
      return projection.known_linear_model(*projection.at(at), model);
    };
  problem.go_on = go_on;
  problem.matters = matters;
  try {
    const auto found = minimize(problem, std::move(z), max_iterations, tolerance);
    end = {found.iterations, found.converged, found.flat, found.message};
  } catch (const Stopped&) {
    if (!best) throw;
    end.message = "stopped on request";
  }
  return best;
}

Profile profile_of(const ProfileTask& task, int which, double sigma, std::vector<double>& better) {
  Profile profile;
  profile.estimate = which;
  const auto& f = task.free[static_cast<std::size_t>(which)];
  // In the units of the walk: logarithms where the scale is logarithmic.
  double step = f.log_scale ? (sigma > 0 ? sigma / std::abs(f.start) : 0.1) : sigma;
  if (!(step > 0))
    step = f.start != 0 ? 0.1 * std::abs(f.start) : std::isfinite(f.upper - f.lower) ? 0.05 * (f.upper - f.lower) : 1;
  if (f.log_scale) step = std::min(step, 1.0);
  std::vector<std::pair<double, double>> points{{f.start, 0.0}};
  profile.low95 = Side(task, which, -1).walk(0.7 * step, points, better);
  profile.high95 = Side(task, which, 1).walk(0.7 * step, points, better);
  std::sort(points.begin(), points.end());
  for (const auto& [value, rise] : points) {
    profile.value.push_back(value);
    profile.rise.push_back(rise);
  }
  return profile;
}

}  // namespace hysteron
