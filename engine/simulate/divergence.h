// Decides which block a run is told to have failed at: the state that grew without bound and since when, and only where
// none did the block whose value is not finite. A state that runs away makes others overflow first, far from it.
// Does not decide when a run has failed. Internal to the ways of simulating.
#pragma once

#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// A state, or the output of a block with states, at the last time at which all was finite.
struct WatchedQuantity {
  int block = 0;
  std::string name;
  double value = 0;  ///< [SI]
  double usual = 1;  ///< its nominal size [SI], above 0
  double since = 0;  ///< when it left its usual size [s]
};

/// Throws Error "diverged" where quantities are larger than any that is meant, 1e8 times their usual size: of those the
/// largest that no other of them stands before (but around a loop). t: of the values [s]; `met`: what the solver said.
void throw_if_grown(const Program& program, const std::vector<WatchedQuantity>& quantities, double t,
                    const std::string& met = "");

/// For a run whose steps have become too small at t [s], work.dx being its derivatives there: throws Error "diverged"
/// where a state changes so fast that it would be beyond all sizes within a small part of the span [s]: a law that is
/// upright there, and ends.
void throw_if_upright(const Program& program, const Work& work, const std::vector<WatchedQuantity>& quantities,
                      double t, double span);

/// Since when each state is beyond its usual size; costs a comparison per state and step.
class GrowthWatch {
 public:
  static constexpr double beyond = 10;  ///< times the nominal size, which is a guess
  /// Nominal sizes of the states [SI].
  GrowthWatch(std::vector<double> usual, double begin);

  /// States as accepted at t [s]; what is behind the last of the nominal sizes is not looked at.
  void see(double t, std::span<const double> x) {
    const double *state = x.data(), *limit = limit_.data();
    unsigned beyond_it = 0;
    for (std::size_t i = 0, n = limit_.size(); i < n; ++i) beyond_it += !(std::abs(state[i]) <= limit[i]);
    if (beyond_it > 0) return see_each(t, x);
    all_until_ = t;
    all_ = true;
  }
  std::vector<WatchedQuantity> quantities(const Program& program, std::span<const double> x) const;

 private:
  void see_each(double t, std::span<const double> x);

  std::vector<double> usual_, limit_;
  bool all_ = true;           // have their usual size, and had it last at
  double all_until_;          // [s]
  std::vector<double> left_;  // else: when each had it last [s]
};

/// The same of rows: outputs of blocks with states, values[signal][row] [SI], until the first that is not finite.
void throw_if_rows_grow(const Program& program, const Run& run, std::span<const int> signals, std::span<const double> t,
                        const std::vector<std::vector<double>>& values);
/// Every output of a block with states, sampled ones too: what throw_if_rows_grow wants to see.
std::vector<int> signals_of_states(const Program& program);

/// Throws Error "diverged" that names the first block in program order whose value at (t, x) is not finite.
[[noreturn]] void not_finite(const Program& program, const Run& run, Work& work, double t, const double* x);

}  // namespace hysteron
