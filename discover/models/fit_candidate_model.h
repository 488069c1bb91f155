// Decides how the free numbers of one model of a discovery are fitted: in which order, to what accuracy. Does not
// decide which these are (free_numbers.h) nor what stands in the model (candidate_model.h). Internal to discover.
#pragma once

#include <vector>

#include "discover/models/candidate_model.h"

namespace hysteron {

/// Compiles the diagram of `c` and fits it: the parts that do not need each other one by one. `fresh` = index of the
/// effect that starts from its law instead of its values, -1 = none.
void fit_candidate_model(const FitContext& context, CandidateModel& c, Effort effort, int fresh);

/// Recordings whose start is searched for begin where the model was last found to begin, and states of effects no
/// further from equilibrium than what they follow moves.
void begin_as_found(const CandidateModel& c, DataModel& model);

/// How finely candidates are simulated.
DataModelOptions accuracy(const FitContext& context, const Program& program, Effort effort, double cost_of_a_step = 1);
/// The program so simulated on the recordings of the context; coarser where each step is one of a single point.
DataModel searched_model(const FitContext& context, const ProgramPointer& program, Effort effort,
                         std::shared_ptr<const Cuts> begin_with = nullptr);
std::vector<int> train_and_validate(const DataSet& data);
/// Noise of the outputs of `model`, which may be some of those that are judged.
NoiseModel noise_of(const FitContext& context, const DataModel& model);

}  // namespace hysteron
