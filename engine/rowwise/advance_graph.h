// Decides which part each block of a program plays in the exact advance, and whether there can be one. Internal to the
// exact advance; who does what when is told in advance.cpp.
#pragma once

#include <string>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

enum class AdvanceRole {
  source,     ///< recorded inputs, these as a dead time hands them on, and constants
  sampled,    ///< holds between its instants: a source that jumps
  linear,     ///< linear time-invariant, with or without states
  nonlinear,  ///< static, memory, dead time, states of their own
  looped,     ///< in a feedback loop with nonlinear blocks
  momentary   ///< follows a function of time and drives nothing that remembers: asked for at instants and rows only
};

struct AdvanceGraph {
  std::string why_not{};                  ///< "" or the block that stands in the way and why; then the rest is empty
  std::string in_the_way{};               ///< path of that block
  std::vector<AdvanceRole> role{};        ///< per block
  std::vector<bool> linear{};             ///< per block: outputs and rates are affine in (states, inputs)
  std::vector<int> late_of{};             ///< per block: the recorded input that a dead time hands on late; -1 = none
  std::vector<std::vector<int>> loops{};  ///< blocks of each feedback loop with nonlinear blocks
  std::vector<int> depth{};               ///< per block: nonlinear blocks in a row before it, see advance.cpp
  std::vector<bool> jumps{};              ///< per signal: may jump at a sampling instant
  std::vector<bool> delayed{};     ///< per block: a dead time whose input may jump, at an instant or behind another one
  std::vector<Step> hit_steps{};   ///< of Program::hit_values: sampled blocks and what stands between them
  std::vector<int> hit_signals{};  ///< what these steps read
};

/// linear_too: per block (empty: none), what counts as linear beside what is declared so.
AdvanceGraph advance_graph(const Program& program, const std::vector<bool>& linear_too = {});

/// Per block: linear at the numbers of this run (Kernel::is_linear_at), whatever those are that vary. Empty: none.
std::vector<bool> linear_at(const Program& program, const Run& run);

/// Likewise of one block in each of its modes (Kernel::is_affine_in_modes).
bool affine_in_modes(const Program& program, const Run& run, int block);

/// Why a block with modes is left to an integrator, which finds when they change.
std::string changes_mode(const BlockInstance& block);

}  // namespace hysteron
