// Decides whether what the user's model leaves speaks of its numbers rather than of its structure: a weight or a mass
// that is written as 2.00 and is 2.04. Does not name effects; where it says yes, all begins anew with these numbers
// free.
#pragma once

#include <map>
#include <string>

namespace hysteron {

struct SearchState;
struct TriedEffect;

/// Numbers that the model holds and that may be a few per cent off, by path, as written [SI]: what is given in its
/// blocks on the way to an output that is measured, but for zeros, thresholds, periods, and what sources say.
std::map<std::string, double> held_numbers(const SearchState& state);

/// Do other values of these numbers, each near what is written, explain more than the effect that would be claimed
/// (nullptr: none would)? Then they go to SearchState::other_numbers.
bool are_the_numbers(SearchState& state, const TriedEffect* winner);

/// The same of each effect that stands: a law that finds the weights of a hysteresis anew beside its curve stands for
/// them where something else was missing beside them.
bool are_numbers_in_place_of_an_effect(SearchState& state);

/// Where more than noise is left at the end, effects and numbers may hide each other: a loop in the spring of a mass
/// takes what friction does beside a spring that is written too hard. All of them, to search once more with; empty =
/// nothing to try.
std::map<std::string, double> numbers_to_try(const SearchState& state);

/// The fewest of them with which `free_nominal_parameters`, that search, explains most of what `held`, the one before,
/// leaves; empty = it does not.
std::map<std::string, double> numbers_that_help(const SearchState& free_nominal_parameters, const SearchState& held);

/// Those that are not what is written, in the last model, with what it says of them.
void tell_other_numbers(SearchState& state);

/// Tells of them where the search that takes them into account was broken off.
void tell_unused_numbers(SearchState& state);

}  // namespace hysteron
