// Decides how sure parameters are, and which ones (or combinations) the data do not determine. Internal to fit/.
// Does not simulate: it looks at the whitened Jacobian at the result.
//
// Columns are scaled to length one; a singular value near zero is a combination of parameters whose change leaves no
// trace (collinearity: Brun, Reichert, Kuensch, Water Resour. Res. 37 (2001) 1015). What is left has covariance s2
// (J'J)^-1.
#pragma once

#include <string>
#include <vector>

#include "fit/estimate/fit.h"
#include "fit/numerics/linear.h"

namespace hysteron {

/// One column of the Jacobian.
struct Sensitive {
  int estimate = -1;       ///< index into FitResult::estimates
  bool log_scale = false;  ///< the column is a derivative by ln(value)
  double value = 0;        ///< [SI]
  double size = 0;         ///< [SI] what counts as a change by 100 %; 0 = unknown
  double lower = 0, upper = 0;
};

/// Fills sigma, interval, determined, correlation and undetermined of `result` from the triangular factor of the
/// Jacobian (one column per entry of `columns`). `exact`: columns are good to 1e-6, else to 1e-3.
/// `coloured`: the same Jacobian with each row times the standard deviation that the residual has there, where that is
/// not one for all: covariance (J'J)^-1 J'VJ (J'J)^-1, of a fit whose weights are not those of its noise.
void judge_parameters(const NormalForm& jacobian, const std::vector<Sensitive>& columns, bool exact, FitResult& result,
                      const NormalForm* coloured = nullptr);

/// 97.5 % quantile of Student's t (Abramowitz, Stegun 26.7.5).
double student_975(double degrees_of_freedom);

}  // namespace hysteron
