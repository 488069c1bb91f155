// Decides which blocks of a program stand in C code, in which order and how often, and what each of them is there;
// refuses by name what cannot. Does not write text.
#pragma once

#include <string>
#include <vector>

#include "engine/block/c_law.h"
#include "engine/program/program.h"

namespace hysteron {

/// A block that is written.
struct PlannedBlock {
  int block = -1;  ///< in Program::blocks
  CCode code;
  long every = 1;  ///< steps from one of its instants to the next
  long first = 0;  ///< step of the first
  /// It takes part in what stands before a jump: see CPlan::before_jumps.
  bool before_jumps = false;
};

struct CPlan {
  ProgramPointer program;
  Run begin;                         ///< as the code begins
  double period = 0;                 ///< [s] from step to step; 0: nothing in the code depends on it
  std::vector<PlannedBlock> blocks;  ///< in the order of the outputs
  /// Memory reads what both moves from step to step and jumps with what is sampled. In the engine it first follows the
  /// one, while what is sampled stands still, and then the other, and may turn between: so must the code. This concerns
  /// the blocks marked so: memory, what leads to it, and what is sampled in front of that, whose last outputs are read.
  bool before_jumps = false;
  std::vector<int> inputs, outputs;  ///< signals
};

/// Blocks on which the outputs of the program depend, over any path, by place in Program::blocks.
std::vector<bool> needed_for_outputs(const Program& program);
/// The shortest period of those that are sampled [s]; 0: none is.
double shortest_period(const Program& program);

/// Throws Error "not_in_c" with every block that cannot be written. period [s]; 0: the shortest of the sampled blocks.
CPlan plan_c(const ProgramPointer& program, double period);

}  // namespace hysteron
