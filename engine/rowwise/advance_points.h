// Decides at which times an exact advance stops: rows, sampling instants, and where a dead time hands the jumps of
// these on. Internal to the exact advance.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "engine/events/clocks.h"
#include "engine/program/breakpoints.h"

namespace hysteron {

/// Of the step: rows and samples that differ by less differ by rounding only.
inline constexpr double same_row = 1e-9;

/// What times lose by rounding where a delay is added to them and taken off again.
inline double rounding_of(double t) { return 4 * same_instant(t); }

/// The points of an advance, one after the other: rows, sampling instants, and where a dead time hands the jumps of
/// these on.
class Points {
 public:
  Points(const Program& program, const Run& run, std::vector<double> rows, const std::vector<double>& delays)
      : rows_(std::move(rows)), clocks_(program, run, rows_.front()), delays_(delays), ticks_(clocks_.next()) {}

  double next() const { return std::min({row(), ticks_, next_delayed()}); }
  bool at_end() const { return row_ == rows_.size(); }

  /// The point behind `before`. Where a row and an instant meet but for rounding it is the instant, which others count
  /// their delays from.
  double advance(double before, Run& run) {
    const double event = std::min(ticks_, next_delayed());
    const double close = same_row * (std::min(row(), event) - before);
    t_ = std::abs(row() - event) <= close ? event : std::min(row(), event);
    while (row() <= t_ + close) ++row_;
    at_delayed_ = false;
    auto generation = delays_.size();
    while (next_delayed() <= t_ + rounding_of(t_)) {
      generation = std::min(generation, delayed_.top().second);
      at_delayed_ = true;
      delayed_.pop();
    }
    if (generation < delays_.size()) add_delayed(t_, generation);
    take(run);
    return t_;
  }
  void start(Run& run) {
    t_ = rows_[row_++];
    take(run);
  }

  bool is_delayed() const { return at_delayed_; }
  /// Sampled blocks that are due at the present point (places in Program::sampled_blocks).
  std::span<const int> due() const { return due_; }

 private:
  using DelayedBreakpoint = std::pair<double, std::size_t>;  // time, how many dead times it has passed

  double row() const { return row_ < rows_.size() ? rows_[row_] : std::numeric_limits<double>::infinity(); }
  double next_delayed() const {
    return delayed_.empty() ? std::numeric_limits<double>::infinity() : delayed_.top().first;
  }
  void take(Run& run) {
    due_ = {};
    if (ticks_ > t_ + rounding_of(t_)) return;
    due_ = clocks_.take(t_ + rounding_of(t_), run);
    ticks_ = clocks_.next();
    add_delayed(t_, 0);
  }
  void add_delayed(double t, std::size_t generation) {
    for (const double delay : delays_)
      if (delay > 0) delayed_.emplace(t + delay, generation + 1);
  }

  std::vector<double> rows_;
  std::size_t row_ = 0;
  Clocks clocks_;
  std::vector<double> delays_;
  double ticks_;  // the next sampling instant
  double t_ = 0;
  bool at_delayed_ = false;
  std::span<const int> due_;
  std::priority_queue<DelayedBreakpoint, std::vector<DelayedBreakpoint>, std::greater<>> delayed_;
};

}  // namespace hysteron
