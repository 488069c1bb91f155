// Decides how a driving signal is cut into legs: turning points, rising and falling branches, holds, first cycle.
// Robust against quantised and noisy inputs: a turn counts only once the signal has come back by a threshold.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hysteron {

enum class Branch : signed char { falling = -1, hold = 0, rising = 1 };

/// Noise of a smooth signal [its unit]: least of its median absolute differences of order 2, 4 and 6, each scaled to
/// white noise.
double roughness(std::span<const double> u);

/// Rows at which u turns: extremes from which it comes back by more than `threshold`. Ends are no turns.
std::vector<std::size_t> turning_points(std::span<const double> u, double threshold);

/// The threshold used where nothing is said: 2 % of the span, or six times the roughness.
double turning_threshold(std::span<const double> u);
double turning_threshold(std::span<const double> u, double rough);  ///< with its roughness, where that is known

/// Branch of each row. Hold: at least five rows within 1e-4 of the span (or six times the roughness).
std::vector<Branch> branches(std::span<const double> u);
std::vector<Branch> branches(std::span<const double> u, double rough);  ///< with its roughness, where that is known

/// First row behind the first cycle: where the second turning point lies; u.size() if there are fewer than two.
std::size_t first_cycle_end(std::span<const double> u);
std::size_t first_cycle_end(std::span<const double> u, double threshold);

}  // namespace hysteron
