// Decides how an effect puts numbers into a diagram, and in which words it says why it cannot be seen. Knows no single
// effect.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "discover/hypotheses/effect.h"
#include "engine/diagram/time_text.h"

namespace hysteron::effects {

/// Gives a block a parameter.
void give(Node& block, const std::string& parameter, Value value);
/// Values from `from` to `to`, `per_decade` of them in each decade, rounded to three digits so that a file stays
/// readable.
std::vector<double> per_decade(double from, double to, double per_decade);
/// `value` rounded to three significant digits.
double rounded(double value);
/// A rate [SI per second] of a signal in `unit`, as a parameter.
Number per_second(double si, const Unit& unit);
using hysteron::time_text;
/// What the law's block has written; nullptr if nothing, or something else.
template <class T>
const T* written(const Law& law, const char* parameter) {
  const Value* value = law.block.parameters.find(parameter);
  return value != nullptr ? std::get_if<T>(&value->content) : nullptr;
}
/// A unit as it is written into a file: as people wrote it, else its dimension.
std::string unit_text(const Unit& unit);
/// A level [SI], not a difference, as a parameter in `unit`: 20 degC stays 20 degC.
Number level(double si, const Unit& unit);
/// The same, rounded to a few hundredths of the `range` [SI, > 0] that the signal has, however far that is from zero.
Number level_within(double range, double si, const Unit& unit);
/// Part of the stroke behind which a clearance or a guide's friction has followed; domains switch over all of it.
inline constexpr double short_way = 0.1;
/// Why swings of fewer than three sizes show an effect only in part (`what` they leave open); "" where there are more.
std::string few_sizes(const Excitation& at, const char* what);
/// Why swings whose speeds differ less than `ratio` times do; `what` they leave open.
std::string one_speed(const Excitation& at, double ratio, const char* what);
/// Why nothing can be seen at a place where the signal does not move, "" where it does or nobody looked.
std::string stands_still(const Excitation& at);

}  // namespace hysteron::effects
