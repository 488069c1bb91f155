// Decides what a diagram says at its best where each output may have any gain and offset: its free parameters are found
// together with these, for a value that the user left open, or a wrong calibration, is no fault of the data. As exact
// as a data check needs. Makes no claim about the values (fit.h).
#pragma once

#include <vector>

#include "fit/model/free_parameter.h"
#include "fit/model/model.h"
#include "fit/model/score.h"

namespace hysteron {

struct BestPrediction {
  std::vector<ParameterValue> values;
  Prediction prediction;  ///< each output with the gain and the offset that fit it best
};

/// Searched from the starts of `free` on these recordings; what cannot be simulated from there is not ok.
BestPrediction best_beside_calibration(DataModel& model, const Judge& judge, const std::vector<FreeParameter>& free,
                                       const std::vector<int>& recordings);

/// What these values say, each output with the gain and the offset that fit it best.
Prediction calibrated(DataModel& model, const std::vector<ParameterValue>& values, const std::vector<int>& recordings);

}  // namespace hysteron
