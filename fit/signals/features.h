// Decides what is read off a trace as one number or a spectrum: stroke, loop area, remanence, lines of a spectrum.
// Plain functions on rows; knows no diagrams. All numbers in the units of the rows.
#pragma once

#include <span>
#include <vector>

namespace hysteron::features {

double smallest(std::span<const double> y);
double largest(std::span<const double> y);
double stroke(std::span<const double> y);  ///< largest minus smallest
double mean(std::span<const double> y);
double rms(std::span<const double> y);           ///< about zero, not about the mean
double deviation(std::span<const double> y);     ///< rms about the mean
double largest_size(std::span<const double> y);  ///< max |y|
double sum_of_squares(std::span<const double> y);

/// Signed area of the loop y over x, the last row joined to the first: positive where y lags behind x (descending
/// branch above the ascending one). Exact for straight pieces between rows.
double loop_area(std::span<const double> x, std::span<const double> y);

/// What is left at the end of a cycle, over its largest value: (y_last - y_first) / max y (thesis Eq. 4.10).
double remanence(std::span<const double> y);

/// By how much a step response passes its last value, over the whole step: 0 where it never does.
double overshoot(std::span<const double> y);
/// From the first time until y stays within `share` of the whole step around its last value, between rows by a straight
/// line.
double settling(std::span<const double> t, std::span<const double> y, double share);

/// Value at `t` by a straight line between rows, in rows whose times increase; held beyond the ends.
double value_at(std::span<const double> t, std::span<const double> y, double at);

/// Amplitudes of the lines of a periodic record: 2 |DFT| / N at k / (N dt), k = 1 ... N/2 (the mean is left out).
struct Spectrum {
  std::vector<double> frequency, amplitude;
};
/// `dt` > 0 between rows, which stand evenly.
Spectrum spectrum(std::span<const double> y, double dt);
/// Root of the sum of the squared amplitudes above a frequency.
double size_above(const Spectrum& s, double frequency);
/// The largest amplitude above a frequency; 0 if there is no line.
double line_above(const Spectrum& s, double frequency);

/// The value below which `share` of the rows lie, by a straight line between the two nearest in order; 0 of none.
double quantile(std::span<const double> y, double share);

/// Largest difference between the cumulative shares of two sets (Kolmogorov, Smirnov): 0 alike, 1 apart. 0 if one is
/// empty.
double ks_distance(std::span<const double> a, std::span<const double> b);

/// Median of y among the rows that have the same x, x increasing.
struct Medians {
  std::vector<double> x, y;
};
Medians medians(std::span<const double> x, std::span<const double> y);

/// Counts per bin of equal width from the smallest to the largest value.
struct Histogram {
  std::vector<double> middle, count;
};
Histogram histogram(std::span<const double> y, int bins);

}  // namespace hysteron::features
