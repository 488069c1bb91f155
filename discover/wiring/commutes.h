// Decides which laws can change places with which blocks. The walk along the wires: wiring.h.
#pragma once

namespace hysteron {

/// With which blocks a law can change places without any difference: places with only such blocks between them are one
/// finding.
enum class Commutes {
  nothing,
  gains,          ///< a law with memory: blocks without states, memory or bend
  linear,         ///< a linear, time-invariant law: linear blocks
  time_invariant  ///< a delay: every block that does not look at the clock
};

}  // namespace hysteron
