// Decides what of a signal comes again with the period of a drive, and which single multiple of that period's frequency
// has more than any device makes of the drive. Whatever a device that has settled does with a drive that repeats,
// repeats as well; what is left has its lines from elsewhere. Names no cause.
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "fit/signals/excitation.h"

namespace hysteron {

/// The period of a drive, as sharp as many periods tell it; none where it repeats less than `fewest` times.
Period sharp_period(std::span<const double> u, double fewest);

/// Rows without the straight line on which whole periods follow each other, and without mean: the line that fits a sine
/// best is none of these.
std::vector<double> without_drift(std::span<const double> rows, double period);

/// One period: the mean over all that the rows hold, at each phase. A period need not be a whole number of rows.
class PeriodicPart {
 public:
  PeriodicPart(std::span<const double> rows, double period);
  double at_row(std::size_t row) const;
  std::size_t highest_order() const { return mean_.size() / 2; }
  /// Of exp(2 pi i order row / period), twice: the amplitude of a cosine.
  std::complex<double> harmonic(std::size_t order) const { return harmonic_of(mean_, order); }
  /// The same, but what lies beside a multiple of the period's frequency shows at that one alone: of rows that fade in
  /// and out.
  std::complex<double> sharp_harmonic(std::size_t order) const { return harmonic_of(faded_, order); }

 private:
  static std::complex<double> harmonic_of(const std::vector<double>& period, std::size_t order);
  double period_;
  std::vector<double> mean_, faded_;  ///< at phases 0, 1/size, 2/size ...
};

struct ForeignHarmonic {
  std::size_t order = 0;
  std::complex<double> expected;  ///< from the orders beside it
};
/// Orders at which the response towers over what the orders beside it lead to expect. Where the drive has harmonics
/// itself, response over drive goes on smoothly from order to order; where it has none, what a bend makes does. A
/// resonance lifts one order most, but those beside it, too. Up to the eighth order a bend of few powers makes a single
/// harmonic.
std::vector<ForeignHarmonic> foreign_harmonics(const PeriodicPart& response, const PeriodicPart& drive);

}  // namespace hysteron
