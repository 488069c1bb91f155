// Decides what a control engineer reads off a frequency response: bandwidth, crossovers, gain and phase margin. Knows
// no diagrams: a response is a function of the angular frequency.
#pragma once

#include <complex>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace hysteron {

using Response = std::function<std::complex<double>(double w)>;  ///< w [rad/s]

struct Bode {
  std::vector<double> w;          ///< [rad/s]
  std::vector<double> magnitude;  ///< in the unit of the response
  std::vector<double> phase;      ///< [rad], without jumps of 2 pi
};

struct Margins {
  std::optional<double> gain_margin;   ///< factor by which the gain may grow; absent: any
  double gain_margin_at = 0;           ///< [rad/s] where the phase is -180 deg
  std::optional<double> phase_margin;  ///< [rad]; absent: |L| never is 1
  double phase_margin_at = 0;          ///< [rad/s] where |L| = 1
  double delay_margin = 0;             ///< [s] dead time that takes the phase margin away
};

/// Frequencies on a logarithmic grid from a hundredth of the smallest to a hundred times the largest of |poles| other
/// than zero, denser around lightly damped ones; `delay`: the longest dead time [s], or 0.
std::vector<double> frequencies(std::span<const std::complex<double>> poles, double delay, int per_decade = 200);
Bode bode(const Response& response, std::span<const double> w);

/// Of the loop L, closed with the sign -1: smallest margins over all crossings, refined on the response itself.
Margins margins(const Response& loop, const Bode& bode);

/// First frequency [rad/s] at which the magnitude is 1/sqrt(2) of its value at the lowest one; absent if it never falls
/// so far.
std::optional<double> bandwidth(const Response& response, const Bode& bode);

enum class Crossing { falling, rising };
/// First frequency [rad/s] at which the magnitude passes `level` in that direction; absent if it never does.
std::optional<double> passes(const Response& response, const Bode& bode, double level, Crossing direction);

struct Peak {
  double magnitude = 0;
  double at = 0;  ///< [rad/s]
};
/// The largest magnitude on the grid, refined on the response itself.
Peak largest(const Response& response, const Bode& bode);

/// What closing the loop L with the sign -1 makes of it: T = L/(1 + L), S = 1/(1 + L). -3 dB is a factor 1/sqrt(2).
struct ClosedLoop {
  std::optional<double> open_half;         ///< [rad/s] |L| falls through -3 dB
  std::optional<double> closed_half;       ///< [rad/s] |T| falls through -3 dB of what it is at low frequencies
  std::optional<double> sensitivity_half;  ///< [rad/s] |S| rises through -3 dB
  Peak closed, sensitivity;                ///< largest |T| (at 0: nowhere above that at low frequencies), |S|
};
ClosedLoop closed_loop(const Response& loop, const Bode& bode);

}  // namespace hysteron
