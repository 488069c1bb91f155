// Decides whether the recordings say otherwise than the data set how an input moves between its samples.
#pragma once

#include <optional>
#include <string>

#include "discover/search/discovery.h"

namespace hysteron {

struct FitContext;
struct SearchState;

/// Inputs that this search takes to move smoothly are told, with the cure.
void tell_smooth_inputs(SearchState& state);

/// Where an input that is held fits the user's model better moving along straight lines, or the other way round, and
/// what was found does not explain it otherwise, the user is told: how it moves is the user's word, and half a sample
/// of delay looks the same.
void tell_other_ways(SearchState& state);

/// An input that bends between its samples by all that the present model leaves: straight lines through them are
/// smaller than the signal, the more the quicker it is, which nothing in a device looks like but would be sold as a
/// mode of its structure. No parameter is added, and most of what stands above the noise must go in recordings of both
/// roles. `fits`: in which the present model is fitted again with such an input.
std::optional<SmoothInput> find_smooth_input(const SearchState& state, const FitContext& fits);

/// Tells of such an input where the search that takes it into account was broken off.
void tell_unused(SearchState& state, const SmoothInput& smooth);

}  // namespace hysteron
