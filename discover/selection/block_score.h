// Decides how well a model explains recordings, as one number that models of any size share:
//
//   S = - sum_b (n_b/2) ln(s^2 + RSS_b/rows_b) - (p/2) ln n_eff - ln(tried) - 1/2 sum ((x - x0)/(0.1 x0))^2
//
// Each block b of a recording and an output has an excess variance of its own: far from the truth only ratios of errors
// count, near the noise s the sum becomes chi2, an effect that acts in few rows keeps its vote, and one loud recording
// cannot speak for all. p/2 ln n is Schwarz's price of p free numbers (Annals of Statistics 6 (1978) 461), the last
// term the prior of the user's own numbers. A smooth misfit of ten thousand rows is some dozen witnesses: n_b counts
// rows over the correlation time tau of what the best model leaves. Does not fit and does not choose. Internal to
// discover.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "discover/models/evidence.h"
#include "fit/model/model.h"

namespace hysteron {

/// Squares of what one model leaves of one output in one recording, in pieces of time.
struct PieceSums {
  static constexpr std::size_t pieces = 48;  ///< has many divisors: blocks are made of whole pieces
  int recording = -1, output = -1;
  std::size_t rows = 0;
  std::vector<double> squares;  ///< [piece] [SI squared]; fewer where there are fewer rows
  double scatter = 0;           ///< half the mean square of the change from row to row: of white noise its variance
  double correlation = 1;       ///< see correlation_rows()
  double all() const;
};
/// Of train and validate recordings, in one order for all models of a data set.
using LeftSums = std::vector<PieceSums>;

/// Measured minus predicted, with what is free in each recording (zeros, starts) at its best. [recording, output] in
/// the order of LeftSums.
struct LeftRows {
  int recording = -1, output = -1;
  Rows rows;
};
/// At their best by these weights.
std::vector<LeftRows> left_rows(const Evidence& evidence, Prediction prediction, const NoiseModel& weights);
LeftSums left_sums(const std::vector<LeftRows>& left);

/// 1 + 2 sum of the autocorrelations up to the first that is 0.05 or less: so many rows say as much as one independent
/// one.
double correlation_rows(const Rows& rows);

/// No instrument is better than rounding lets it be, and no logarithm is taken of zero [SI squared].
double least_variance(const Evidence& evidence, int output);

/// By which all models of one data set are measured.
class BlockScore {
 public:
  /// `models`: what each of the models leaves that have been fitted so far, at least one. Noise is neither larger nor
  /// does it last longer than in that of them which leaves least: what more is seen of it in others is their misfit.
  BlockScore(const Evidence& evidence, const std::vector<LeftSums>& models);
  /// The first sum alone: no price of numbers.
  double fit_of(const LeftSums& left) const;
  /// The same of one recording.
  double fit_of(const LeftSums& left, int recording) const;
  double price(int numbers) const;  ///< p/2 ln n_eff
  /// Squares over the noise s^2, of each entry of LeftSums.
  std::vector<double> chi2_of(const LeftSums& left) const;
  double n_eff() const { return n_eff_; }
  double n_eff(int recording) const;
  /// Weights of a fit that raises the score: rows by 1/(s^2 + V) of their block, over its correlation time, so that
  /// chi2 counts independent witnesses. The logarithm lies below each of its tangents, so what lowers that chi2 raises
  /// the score by at least as much (Hunter and Lange, American Statistician 58 (2004) 30: iterations that majorize).
  NoiseModel weights(const Evidence& evidence, const LeftSums& left) const;
  /// rms over the noise s, of the output where that is largest.
  double over_noise(const LeftSums& left) const;
  /// Beyond the noise less than a tenth of what is explained (rms), of what a model leaves and what was left without.
  bool leaves_little(const LeftSums& left, const LeftSums& before) const;

 private:
  struct Block {
    std::size_t of = 0;  ///< LeftSums entry
    std::size_t first = 0, last = 0;
    double rows = 0, n = 0, s2 = 0;
  };
  std::vector<Block> blocks_;
  std::vector<int> recording_;
  double n_eff_ = 0;
};

}  // namespace hysteron
