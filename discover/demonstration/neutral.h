// Decides at which values of its parameters an effect changes nothing, by trying them under the signal that shows it.
// Does not look at what blocks declare of their variations (Declaration::variations).
#pragma once

#include <string>
#include <vector>

namespace hysteron {

class DemoRun;

/// One parameter of a law, and the value at which it changes nothing: "0", "1", "towards 0" where the block refuses 0
/// itself, "towards inf" or "towards -inf" where it is a limit.
struct NeutralValue {
  std::string parameter;  ///< as in the file: "per_decade", "weights[1]", "the other weights"
  std::string value;
};

/// The fewest parameters of the trial's law with which nothing is changed, whatever the others are. Empty where it is
/// none of the usual values.
std::vector<NeutralValue> neutral_values(const DemoRun& trial);

}  // namespace hysteron
