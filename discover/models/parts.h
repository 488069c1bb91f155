// Decides which effects of a model can be fitted without the others: what moves no output in common shares no parameter
// and no residual. Internal to discover.
#pragma once

#include <string>
#include <vector>

#include "discover/models/candidate_model.h"

namespace hysteron {

/// Outputs that belong together, and the effects on the way to them.
struct Part {
  std::vector<std::string> outputs;
  std::vector<bool> effects;  ///< by their place in CandidateModel::standing
  bool has(std::size_t effect) const { return effects[effect]; }
};

/// Outputs that a block moves, as indices of the program's; all of them if nobody knows which block it is (-1).
std::vector<int> outputs_behind(const Program& program, int block);

/// The parts of a candidate whose program is compiled; one part if everything hangs together. `free_paths`: what is
/// free besides the laws (FitContext::free_paths); what the diagram declares free counts too.
std::vector<Part> parts_of(const CandidateModel& candidate, const std::vector<std::string>& free_paths);

/// The diagram with these outputs alone: nobody computes what no output sees.
Diagram seen_at(const Diagram& diagram, const std::vector<std::string>& outputs);

/// True if a parameter of the program moves one of its outputs.
bool moves_an_output(const Program& program, int parameter);

}  // namespace hysteron
