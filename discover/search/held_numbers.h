// Decides which numbers of the user's model may be a few per cent off: a weight or a mass that is written as 2.00 and
// is 2.04. Internal to discover.
#pragma once

#include <map>
#include <string>

namespace hysteron {

struct SearchState;

/// Numbers that the model holds and that may be a few per cent off, by path, as written [SI]: what is given in its
/// blocks on the way to an output that is measured, but for zeros, thresholds, periods, and what sources say.
std::map<std::string, double> held_numbers(const SearchState& state);

}  // namespace hysteron
