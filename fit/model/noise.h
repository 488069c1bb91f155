// Decides how large the noise of each output is: from the data sheet, corrected by the data, or guessed from them
// alone. Does not whiten (whiten.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/model/model.h"
#include "fit/signals/wander.h"

namespace hysteron {

enum class NoiseSource {
  data_sheet,  ///< the data set's note, as it stands
  corrected,   ///< the note, rescaled by the high band of a residual (factor within 0.7 .. 1.35 in variance)
  estimated,   ///< no note: the high band of a residual
  guessed      ///< no note and no residual yet: the high band of the measured rows themselves
};
std::string to_text(NoiseSource source);

struct NoiseOfOutput {
  double white = 0;         ///< rms [SI], resolution included
  double one_over_f = 0.3;  ///< rms of the 1/f part over the white rms; 0.3 where nobody says
  double resolution = 0;    ///< [SI]; 0 = unknown
  NoiseSource source = NoiseSource::guessed;
  bool share_is_stated = false;  ///< by the data set
  bool share_estimated = false;  ///< from a residual (colour.h)
  std::string remark{};          ///< what the user must be told of it; "" = nothing
  /// rms [SI] of equal pieces of a recording, by recording: where a model leaves more of some than of others, and all
  /// are weighed by what it leaves. Empty: `white` everywhere. White alone: one_over_f is 0.
  std::vector<std::vector<double>> pieces{};
  LeftOut left_out{};  ///< how a known line wanders: taken out of all that is whitened
  bool white_is_stated() const { return source == NoiseSource::data_sheet || source == NoiseSource::corrected; }
};

/// Data sheets are good to about 10 %; more is structure of the residual. Factors of the variance.
inline constexpr double least_change_of_data_sheet = 0.7, most_change_of_data_sheet = 1.35;

/// No instrument is better than this, and no weight may become infinite [SI].
double noise_floor(const DataModel& model, int output, double resolution);

struct NoiseModel {
  std::vector<NoiseOfOutput> outputs;  ///< as DataModel::outputs()
  std::vector<double> white() const;
};

/// What can be said before any fit: notes of the data set, else a guess from the high band of the measured rows.
NoiseModel noise_before_fit(const DataModel& model);

/// Corrected by the residual of the best model: s2 = median over recordings of median(w^2) /
/// 0.455 in the upper half band of the whitened residual; 0.455 is the median of chi-square with one degree of freedom.
/// Clipped to 0.7 .. 1.35 where a data sheet exists, free where none does (but never below resolution^2 / 12).
/// Where a data sheet states the white noise and not the share of 1/f, that share is the most likely one for the slow
/// half of the residual, with a prior about 0.3 and at most 1: what lies above that is no sensor's noise.
/// Beware: a recording that is smoother than its sampling (anti-aliasing, interpolation) or that rests on few levels of
/// its resolution shows less noise in the high band than it has; then `remark` says so and the figure is a lower bound.
NoiseModel noise_from_residual(const DataModel& model, const NoiseModel& before, const Prediction& best,
                               const std::vector<int>& recordings);

}  // namespace hysteron
