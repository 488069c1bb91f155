#include "discover/models/fit_cost.h"

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

/// At most `most` combinations of scanned values, spread evenly over their lists.
void thin_scans(std::vector<FreeParameter>& free, double most) {
  double all = 1, lists = 0;
  for (const auto& f : free) {
    all *= static_cast<double>(std::max<std::size_t>(f.scan.size(), 1));
    lists += f.scan.size() > 1 ? 1 : 0;
  }
  if (all <= most) return;
  const auto keep = static_cast<std::size_t>(std::max(2.0, std::floor(std::pow(most, 1 / lists))));
  for (auto& f : free) {
    if (f.scan.size() <= keep) continue;
    std::vector<double> some;
    for (std::size_t k = 0; k < keep; ++k) some.push_back(f.scan[k * (f.scan.size() - 1) / (keep - 1)]);
    f.scan = std::move(some);
  }
}

/// How many of the free parameters are found by linear least squares.
double linear_ones(const CandidateModel& c, const std::vector<FreeParameter>& free) {
  std::vector<int> parameters;
  for (const auto& f : free) parameters.push_back(f.parameter);
  const auto affine = jointly_affine(*c.program, parameters, c.program->output_signals);
  return static_cast<double>(std::count(affine.begin(), affine.end(), true));
}

}  // namespace

double work_of_a_step(const Program& program) {
  constexpr double of_a_mass = 2;
  double states = 0;
  for (const auto& b : program.blocks)
    if (!b.kernel->declaration.is_linear) states = std::max(states, static_cast<double>(b.sizes.states));
  return std::max(1.0, states / of_a_mass);
}

double steps_from(DataModel& model, const std::vector<double>& noise, const Trial& fixed,
                  const std::vector<FreeParameter>& free) {
  Trial start;  // as the fit begins: substeps are chosen once
  for (const auto& f : free) start.push_back({f.parameter, f.start, f.recording});
  start.insert(start.end(), fixed.begin(), fixed.end());
  model.choose_substeps(start, noise);
  double steps = 0;
  int most = 1;
  for (const int r : model.recordings(Role::train)) {
    steps += static_cast<double>(model.steps(r));
    most = std::max(most, model.substeps(r));
  }
  steps *= work_of_a_step(model.program());
  if (model.goes_by_points()) return cost_of_a_point * steps;
  return most == 1 && !model.integrates() ? 0 : steps;  // linear and static: nothing is slow
}

void spend_less(const CandidateModel& c, double steps, std::vector<FreeParameter>& free, FitOptions& options) {
  options.max_iterations = 5;
  options.refine = 1;
  if (steps <= 0) return;
  const double simulations = screening_steps / steps;
  const double linear = linear_ones(c, free), searched = static_cast<double>(free.size()) - linear;
  thin_scans(free, std::max(4.0, simulations / 2 / (1 + linear)));
  options.max_iterations = static_cast<int>(std::clamp(simulations / 2 / (1 + linear + searched), 2.0, 5.0));
}

void keep_within_time(const CandidateModel& c, double steps, std::vector<FreeParameter>& free, FitOptions& options) {
  if (steps <= 0) return;
  const double linear = linear_ones(c, free), searched = static_cast<double>(free.size()) - linear;
  const double half = fit_steps / steps / 2;
  thin_scans(free, std::max(4.0, half / (1 + linear)));
  options.max_iterations =
      std::min(options.max_iterations, static_cast<int>(std::max(4.0, half / (1 + linear + searched))));
}

}  // namespace hysteron
