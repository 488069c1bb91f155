// Decides the identifications of the thesis as steps on a model and its recordings: "slopes" (Prandtl-Ishlinskii) and
// "tapi". They give values, no intervals: fit.h does. The readings of slopes themselves: slopes_method.h.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fit/estimate/fit.h"
#include "fit/model/model.h"

namespace hysteron {

/// Which slope of the saturating part stands for it between two thresholds.
enum class SlopeRule {
  chord,   ///< the forward branch is met at every threshold
  tangent  ///< as printed in the thesis
};

/// Weights of a TAPI model with the same forward slopes as a classical one (thesis Eq. 5.16 as corrected):
///
///   c*_1 = c_1/(1 + s_1),  c*_i = sum_(j<=i) c_j - c*_1 s_i - sum_(j<i) c*_j
///
/// s_i: slope of P tanh(u/b) behind threshold i. P and b (= a T) in the unit of the thresholds; `top` is where the last
/// interval ends. Weights in y per u.
std::vector<double> tapi_weights(std::span<const double> classical, std::span<const double> thresholds, double p,
                                 double b, double top, SlopeRule rule = SlopeRule::chord);

struct ThesisMethodOptions {
  std::string block{};                                 ///< path; "" = the only one of its type
  std::vector<int> recordings{};                       ///< empty = all train recordings
  SlopeRule rule = SlopeRule::chord;                   ///< "tapi"
  std::function<bool(const FitProgress&)> progress{};  ///< false = end with what the steps so far have found
};

struct ThesisMethodResult {
  std::vector<ParameterValue> values;  ///< what to pass to DataModel::predict [SI]
  std::vector<std::string> steps;      ///< what each step found, for people
  double mean_error = 0;               ///< mean |measured - model| over the recordings [SI], zeros at their medians
  long runs = 0;                       ///< simulations of one recording
  bool stopped = false;
};

/// "slopes", "tapi".
const std::vector<std::string>& thesis_method_names();

/// Identifies the parameters of one block that takes an input of the diagram and makes a measured output itself.
///
/// "slopes": weights of a `prandtl_ishlinskii` with one-sided operators, from its thresholds (thesis section 2.1).
/// "tapi" (thesis section 5.2): weights, p_s, a, beta and before of a `tapi` block; t_c stays as given. Its four steps:
///  1. a classical model by slopes, on the recordings of the lowest mean temperature (within 1 K of it);
///  2. `before`, the remanence at the start, from the outputs at local minima of the input;
///  3. P_s and a T there by the smallest mean |error|, the weights converted for each trial;
///  4. beta from the outputs at local maxima of the input at all temperatures, P_s(T) held where step 3 found it. Left
///     out where all recordings have one temperature.
/// Throws Error: "unknown_method", "no_block", "not_direct", "two_sided", and those of weights_by_slopes.
ThesisMethodResult identify_as_thesis(DataModel& model, const std::string& method,
                                      const ThesisMethodOptions& options = {});

/// The same as a result of a fit: estimates without intervals, scores before and behind, the steps as remarks.
/// `judged` empty: all train and validate recordings.
FitResult fit_as_thesis(DataModel& model, const NoiseModel& noise, const std::string& method,
                        const ThesisMethodOptions& options = {}, std::vector<int> judged = {});

}  // namespace hysteron
