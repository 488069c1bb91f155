// Decides how residuals are whitened against a sensor's white and 1/f noise: one fixed filter in the cosine domain.
// Does not know where the noise figures come from (noise.h).
//
// Orthonormal DCT-II of the rows; coefficient k is divided by s sqrt(1 + A / (k + 1/2)), A = share^2 N / 7.9, and k = 0
// by s sqrt(1 + 4 A) (sum over k of 1/(k+1/2) is about 7.9 for some thousand rows, so that the 1/f
// part has the rms share * s). Predictions and columns pass the same filter, so 1/f noise cannot buy creep or drift. A
// constant stands in coefficient 0 alone: dropping it is exactly the estimation of one zero per recording. Rows are
// taken by their index: where time is not uniform, "frequency" means per row, not per second.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hysteron {

/// Orthonormal DCT-II in place, and its inverse. Thread safe; plans are cached per length.
void cosine_transform(std::span<double> rows);
void inverse_cosine_transform(std::span<double> coefficients);

/// Variance of cosine `k` of so many rows over that of white noise.
double coloured(double k, std::size_t rows, double share);

/// The filter of one output on one recording.
class Whitener {
 public:
  Whitener() = default;
  /// What apply() writes: coefficients by frequency, or any orthonormal mixture of them, which for white noise costs
  /// less. Lengths and products of what is written are the same.
  enum class Order { by_frequency, any };
  /// `white` rms [SI] > 0; `share` = rms of 1/f over white rms; `drop_zero`: the zero of this recording is free.
  Whitener(std::size_t rows, double white, double share, bool drop_zero, Order order = Order::by_frequency);

  /// White noise that is not the same in all rows: the rms of each [SI] > 0. Written in the order of time.
  Whitener(std::span<const double> rms_of_rows, bool drop_zero);

  std::size_t rows() const { return weight_.size(); }
  std::size_t size() const { return weight_.size() - (drop_zero_ ? 1 : 0); }  ///< numbers that apply() writes
  /// Whitened rows, size() numbers, written behind one another to `out`. `rows` is not changed.
  void apply(std::span<const double> rows, double* out) const;
  /// The constant [SI] that leaves least of these rows, whitened.
  double zero_of(std::span<const double> rows) const;
  /// Position of row-frequency half band in the output: indices >= this one belong to the upper half band.
  std::size_t upper_half() const;

 private:
  void apply_in_time(std::span<const double> rows, double* out) const;
  void apply_by_rows(std::span<const double> rows, double* out) const;

  std::vector<double> weight_;
  std::vector<double> constant_{};  ///< where rows differ in their weight: a constant, whitened, of length one
  bool drop_zero_ = false, in_time_ = false;
};

}  // namespace hysteron
