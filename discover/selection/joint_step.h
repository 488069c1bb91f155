// Decides what one step of all numbers together would bring to a model of which only a part was fitted. Does not move
// them. Internal to discover.
#pragma once

#include "discover/selection/table_model.h"

namespace hysteron {

/// The most that the score of a model is believed to reach once all is fitted together, by `numbers`: the user's
/// numbers, what the diagram leaves free, the laws that stand and the new one. It is what linear least squares leaves
/// by the weights of the score, from where the model stands, and the same gain again for what is not linear. Infinite
/// where nothing can be told.
double most_by_joint_fit(const FitSetting& setting, const FitContext& context, const TableModel& fitted,
                         Numbers numbers);

/// May the model so fitted have more than this score, and come within a tie of this tie score?
bool may_reach(const FitSetting& setting, const FitContext& context, const TableModel& fitted, Numbers numbers,
               double more_than, double tie_score);

}  // namespace hysteron
