#include "engine/simulate/step_defects.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/diagram/index.h"

namespace hysteron {
namespace {

// Backward differences start again at order one, which costs about as much accuracy as a jump of so many tolerances
// that the control of the error has found (a rounded chirp behind a lag: 30 tolerances off without cuts, less than 10
// with).
constexpr double jump_for_bdf = 30;
// A slope of dx/dt that changes by so much times the inverse of the step changes the Newton matrix as much as its
// identity does.
constexpr double noticed_slope = 0.5;
// Differences are taken over this share of a step: a polynomial of order five bends little within it, and rounding is
// far below.
constexpr double piece_of_step = 1.0 / 16;

}  // namespace

StepDefects::StepDefects(const Integrator& solver, Formula formula, int states, Derivative derivative,
                         Jacobian* jacobian, const Run& run, std::span<const double> tolerance)
    : solver_(solver),
      formula_(formula),
      states_(states),
      derivative_(std::move(derivative)),
      jacobian_(jacobian),
      run_(run),
      tolerance_(tolerance),
      x_(at(std::max(1, states))),
      before_(x_),
      after_(x_) {}

void StepDefects::slope_at(double t, std::vector<double>& dx) {
  solver_.interpolate(t, x_);
  derivative_(t, x_.data(), dx.data());
}

bool StepDefects::jumps(double from, double seen) {
  if (states_ == 0) return false;
  slope_at(from, before_);
  slope_at(seen, after_);
  for (std::size_t i = 0; i < after_.size(); ++i) after_[i] = (after_[i] - before_[i]) * (seen - from);
  return !(solver_.weighted_norm(after_) <= noticed_jump);
}

bool StepDefects::bends(double from, double before, double behind, double to) {
  if (states_ == 0) return false;
  return bends_the_states(from, before, behind, to) ||
         (formula_ == Formula::bdf && bends_newton(from, before, behind, to));
}

/// Does dx/dt jump, or its slope in time, by so much that the states at the end of the step are others.
bool StepDefects::bends_the_states(double from, double before, double behind, double to) {
  const double h = to - from, near = h * piece_of_step;
  if (formula_ == Formula::bdf) {
    slope_at(before, before_);
    slope_at(behind, after_);
    for (std::size_t i = 0; i < after_.size(); ++i) after_[i] = (after_[i] - before_[i]) * h;
    return !(solver_.weighted_norm(after_) <= jump_for_bdf);
  }
  const double left = std::min(near, before - from), right = std::min(near, to - behind);
  if (left < 1e-3 * h || right < 1e-3 * h) return false;  // too near to an end for a difference, or to matter
  std::vector<double> f[4];                               // kinks are rare
  const double times[] = {before - left, before, behind, behind + right};
  for (int i = 0; i < 4; ++i) slope_at(times[i], f[i] = before_);
  for (std::size_t i = 0; i < after_.size(); ++i) {
    after_[i] = (f[2][i] - f[1][i]) * h;
    before_[i] = ((f[3][i] - f[2][i]) / right - (f[1][i] - f[0][i]) / left) * h * h / 2;
  }
  return !(solver_.weighted_norm(after_) <= noticed_jump && solver_.weighted_norm(before_) <= noticed_jump);
}

/// Newton's iteration with the slopes of one side may not go where the other side leads, and yet seem to converge.
bool StepDefects::bends_newton(double from, double before, double behind, double to) {
  if (jacobian_ == nullptr) return false;
  const auto& pattern = jacobian_->pattern();
  const auto slopes = [&](double t, std::vector<double>& entries) {
    solver_.interpolate(t, x_);
    entries.resize(pattern.row.size());
    (*jacobian_)(run_, t, x_.data(), entries.data());
  };
  slopes(before, entries_before_);
  slopes(behind, entries_after_);
  for (std::size_t j = 0; j + 1 < pattern.column_begin.size(); ++j)
    for (auto k = at(pattern.column_begin[j]); k < at(pattern.column_begin[j + 1]); ++k) {
      const double units = tolerance_[j] / tolerance_[at(pattern.row[k])];
      const double change = std::abs(entries_after_[k] - entries_before_[k]) * (to - from) * units;
      if (!(change <= noticed_slope)) return true;
    }
  return false;
}

bool StepDefects::leads_to_its_end(double from) {
  if (states_ == 0) return true;
  const double to = solver_.t(), h = to - from, piece = h * piece_of_step;
  slope_at(to - piece / 2, before_);
  solver_.interpolate(to - piece, x_);
  const auto end = solver_.x();
  for (std::size_t i = 0; i < after_.size(); ++i) after_[i] = ((end[i] - x_[i]) / piece - before_[i]) * h;
  return solver_.weighted_norm(after_) <= 1;
}

}  // namespace hysteron
