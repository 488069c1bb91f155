// Decides how a set of effects is taken apart and put together again: its members, the set without one of them, and the
// steps in which it is told. Internal to discover.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "discover/search/search_state.h"

namespace hysteron {

/// One effect of a set: where it enters and by which law.
struct Member {
  const Effect* effect = nullptr;
  Place place;
  std::string law;
};

/// In the order in which they came.
std::vector<Member> members_of(const CandidateModel& candidate);

/// Whose is the straight line that a curve may take up: nobody's where a calibration was taken out to see what it gives
/// back.
enum class Line { of_a_curve, held };

/// Something else explains the step as well, and an experiment of this bench would tell. What only another instrument
/// tells after many recordings is missing under either name.
inline bool leaves_the_question_open(const FoundStep& step) {
  return !step.ties.empty() && step.experiment_would_tell && !(step.experiment && step.experiment->another_instrument);
}

/// The effect on a model, at the wire where the set has it, or, where that wire came with another effect, at the best
/// one; nullopt if it cannot be had.
std::optional<TriedEffect> tried_again(const SearchState& state, const FitContext& context, const CandidateModel& model,
                                       const Member& m, Line line = Line::of_a_curve);

/// The present set without member `i`, the others from the user's own model on: a law may have found the user's weights
/// and zeros anew, and these hold only beside it. Without a calibration, gain and zero are the user's again (who else
/// would take them up is not asked), or a curve's. nullopt if one of the others cannot be had.
std::optional<CandidateModel> rest_of(const SearchState& state, const FitContext& context, std::size_t i,
                                      Line line = Line::held);

}  // namespace hysteron
