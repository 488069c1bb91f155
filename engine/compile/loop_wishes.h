// Decides what the section "simulate" of a diagram says of its algebraic loops. Internal to compile().
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// What the diagram says of its algebraic loops.
struct LoopWishes {
  bool forbidden = false;
  std::vector<std::pair<int, double>> guesses{};  ///< signal, where a loop through it starts [SI]
  std::vector<int> guessed_signals() const;
};
/// Throws Error "bad_value", "unknown_signal" or "wrong_unit" at the word that is wrong.
LoopWishes loop_wishes(const SimulateSettings& settings, const Program& program);

/// Where a guess stands, as a JSON pointer; signals inside nested diagrams have a "/" in their names.
std::string place_of_guess(const std::string& signal);

}  // namespace hysteron
