// Decides what a control engineer reads off a frequency response: bandwidth, crossovers, gain and phase margin. Knows
// no diagrams: a response is a function of the angular frequency, and whether a loop is stable is asked (stability.h).
#pragma once

#include <complex>
#include <functional>
#include <limits>
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

/// Is the loop stable when it is closed with the sign -1 and this factor more gain.
using StableAt = std::function<bool(double gain)>;

struct GainLimit {
  double factor = 1;  ///< of the gain
  double at = 0;      ///< [rad/s] where the phase then is -180 deg; infinite: at all high frequencies
};

/// What the closed loop bears, or what would make it stable.
struct Margins {
  bool stable = false;  ///< as closed
  /// The range of gains around 1 (of an unstable loop: the nearest one) in which it is stable. Absent below: down to
  /// none; absent above: any.
  std::optional<GainLimit> gain_from, gain_to;
  bool some_gain = true;  ///< of an unstable loop: there is such a range
  /// [rad] of the crossing of |L| = 1 that lies nearest to -180 deg; of an unstable loop only where it is negative (so
  /// much lead is missing). Absent: |L| never is 1, or the loop is unstable with its phase above -180 deg.
  std::optional<double> phase_margin;
  double phase_margin_at = 0;          ///< [rad/s] where |L| = 1
  std::optional<double> delay_margin;  ///< [s] of a stable loop: the shortest dead time that makes it unstable
  double delay_margin_at = 0;          ///< [rad/s]

  /// The limit that lies nearest, as a factor; of an unstable loop the nearest end of the range.
  std::optional<GainLimit> gain_margin() const;
};

/// Frequencies on a logarithmic grid from a hundredth of the smallest to a hundred times the largest of |poles| other
/// than zero, denser around lightly damped ones; `delay`: the longest dead time [s], or 0.
std::vector<double> frequencies(std::span<const std::complex<double>> poles, double delay, int per_decade = 200);
/// The same grid, longer where the response goes on to one beyond its ends: an integrator with a small gain passes one
/// far below every pole. `highest`: no frequency above that [rad/s].
std::vector<double> widened(const Response& response, std::vector<double> w,
                            double highest = std::numeric_limits<double>::infinity());
/// At these frequencies, and between them where phase or size change by more than a third or where a dead time of
/// `delay` [s] turns the phase unseen.
Bode bode(const Response& response, std::span<const double> w, double delay = 0);

/// Of the loop L, closed with the sign -1: margins over all crossings, refined on the response itself. Ranges of the
/// gain are those between crossings of the negative real axis, judged by `stable`. `ends`: further limits, where L
/// is real at the ends of the axis (gain_limit_at_end).
Margins margins(const Response& loop, const Bode& bode, const StableAt& stable, std::span<const GainLimit> ends = {});
/// The range of gains of `m` by trying gains alone, in steps of a twentieth: where no single response tells the
/// crossings. The frequencies of its limits are then unknown (NaN).
void search_gains(Margins& m, const StableAt& stable);
/// The factor at which an end of the response, a real number, passes -1; absent if no positive one does.
std::optional<GainLimit> gain_limit_at_end(double response, double at);

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
