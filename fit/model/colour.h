// Decides how coloured the noise of each output is, where nobody says: white rms and share of 1/f, most likely for the
// residual of the best model. Does not decide what is known beforehand (noise.h). Internal to fit/.
//
// In the cosine domain of whiten.h the coefficients of the residual are independent, with variances known up to white
// rms s and share a. A fit has taken its parameters out of them, and of slow noise most: therefore the restricted
// likelihood (Patterson, Thompson, Biometrika 58 (1971) 545), with J the derivatives of the residual by the parameters,
// V(s, a) the variances and r the residual of the fit weighted by V:
//
//   -2 ln L = ln det V + ln det J' V^-1 J + r' V^-1 r
//
// Neighbouring coefficients share their weight, so they enter as bands, each by its products [J r]' [J r].
#pragma once

#include <vector>

#include "fit/model/model.h"
#include "fit/model/noise.h"
#include "fit/model/score.h"
#include "fit/numerics/dense.h"

namespace hysteron {

/// What lies around a result: the whitened residual there and its derivatives, one column per determined parameter.
/// Rows: the recordings one behind the other, then one row per prior.
struct Neighbourhood {
  std::vector<int> recordings;
  std::vector<double> residual;
  Dense jacobian;
};

/// The noise most likely for what `around` shows. Shares that the data set states stay as they are; a white rms that it
/// states changes by no more than noise_from_residual() allows; `remark` says what was estimated.
NoiseModel noise_from_likelihood(const DataModel& model, const Judge& judge, const Neighbourhood& around);

/// Beyond this share what is left is no sensor's noise but what the model lacks. Weighted by it, a fit would follow the
/// fast part alone: the weights stay, and only the intervals know the colour.
inline constexpr double most_share_of_a_sensor = 3;

/// Variance of each whitened row of these recordings under `noise`, over that for which `judge` made it 1.
std::vector<double> row_variances(const DataModel& model, const Judge& judge, const NoiseModel& noise,
                                  const std::vector<int>& recordings);

}  // namespace hysteron
