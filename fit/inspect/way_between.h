// Decides whether the recordings say otherwise than the data set how an input moves between its samples. Half a sample
// is all that a held input differs by from a straight line, and a wrong damping or lag differs by more: the free
// parameters of the diagram are found anew for each way before any two are compared.
#pragma once

#include <string>
#include <vector>

#include "fit/estimate/beside_calibration.h"
#include "fit/model/free_parameter.h"
#include "fit/model/model.h"
#include "fit/model/score.h"

namespace hysteron {

/// How the data set says that an input moves; straight where it says nothing.
Between given_way(const DataSet& data, const std::string& input);
void set_way(DataSet& data, const std::string& input, Between way);

/// What another way of an input between its samples would do to the error of the diagram.
struct InspectedBetween {
  std::string input;
  Between given = Between::linear, better = Between::hold;
  double fall = 0;  ///< share of the squared error that the other way takes away
};

/// The inputs for which another way is clearly better than the given one at its `best`. Where a free parameter does the
/// same as another way (a lag, a dead time), nothing can be told, and nothing is.
std::vector<InspectedBetween> other_ways_between(const DataModel& model, const Judge& judge,
                                                 const std::vector<int>& judged, const std::vector<FreeParameter>& free,
                                                 const BestPrediction& best);

/// For people; `is_fault`: the data set states what the recordings contradict.
struct BetweenWords {
  bool is_fault = false;
  std::string text;
};
BetweenWords words_of(const InspectedBetween& seen);

}  // namespace hysteron
