// Decides how a line turns in a recording whose rows are too few to follow amplitude and phase of every harmonic: all
// of them by one angle. Does not decide which recordings these are (wander.h). Internal to fit/.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace hysteron {

/// Of the squared length of a wave about one knot: what waves have in common to five digits (a line at a whole number
/// of half samples has no sine) is nobody's, and costs no more than a rounding error of the rest.
inline constexpr double in_common = 1e-10;

/// A sine in the rows of one recording.
struct ShownSine {
  double frequency = 0;  ///< [Hz]
  double squares = 0;    ///< that it takes away, summed over the rows [their unit squared]
};
/// The strongest sine in `rows` at times `t` [s] within `astray` [Hz] of `frequency` [Hz], among those that are
/// `allowed`; no squares if none is.
ShownSine strongest_about(std::span<const double> t, std::span<const double> rows, double frequency, double astray,
                          const std::function<bool(double)>& allowed);

/// How well `rows` at times `t` [s] know the frequency of the sine at `frequency` [Hz] in them, beside noise of the rms
/// `white` [unit of the rows]: one over its variance [1/Hz^2], 0 where they do not resolve it (the bound of Cramer and
/// Rao: Rife, Boorstyn, IEEE Trans. Inf. Theory 20 (1974) 591).
double known_frequency(std::span<const double> t, std::span<const double> rows, double frequency, double white);

/// A line and its harmonics about a frequency of this recording's own; what turns it from there is one angle, in
/// straight lines between knots. A mains of 50 Hz, 2 mHz off, is two turns off behind twenty minutes.
class TurningLine {
 public:
  /// `t`: times of the rows [s], rising; `shown`: what these hold beside everything else that is known; frequency [Hz]:
  /// of the line here. follows: for each harmonic (the line itself is the first), whether it may turn by a little more
  /// or less than the rest; the others turn with it as far as is known here. knots: two or more.
  TurningLine(std::span<const double> t, std::span<const double> shown, double frequency, std::vector<bool> follows,
              std::size_t knots);

  double rms() const { return rms_; }  ///< of the line, as it is shown
  /// Takes the line out of the rows, and how it turns a little more or less: least squares, in place.
  void take_out(std::span<double> rows) const;

 private:
  struct Factor;
  void settle(std::span<const double> shown);
  void make_factor();
  void follow(std::span<const double> shown);
  std::vector<double> fitted(std::span<const double> rows) const;

  std::vector<bool> follows_;
  std::size_t waves_ = 0, knots_ = 0;
  double rms_ = 0;
  std::vector<double> phase_;   ///< of each row [rad]
  std::vector<double> wave_;    ///< [row][wave]
  std::vector<double> turned_;  ///< of each row: change of the line per radian
  std::vector<std::size_t> knot_;
  std::vector<double> beyond_;  ///< of each row: its knot, and the part of the way to the next one
  std::shared_ptr<const Factor> factor_;
};

}  // namespace hysteron
