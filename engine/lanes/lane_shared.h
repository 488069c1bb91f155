// Decides what runs in lanes share: blocks without states and memory whose parameters are not varied and whose inputs
// are shared, computed once for all lanes, and where time allows once for all batches. Internal to lanes.cpp.
#pragma once

#include <span>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// Per block: is everything that it computes the same in all lanes?
std::vector<bool> shared_blocks(const Program& program, std::span<const int> parameters);

/// The shared part of a list of steps: the numbers of it that the other steps read, at times known beforehand.
class SharedNumbers {
 public:
  struct Instant {
    double t = 0, branch = 0;  ///< [s]
  };

  /// `read`: signals that are read besides by what the other steps tell (recorded ones).
  SharedNumbers(ProgramPointer program, const Run& run, const std::vector<Step>& steps, const std::vector<bool>& shared,
                std::span<const int> read, std::vector<Instant> instants);

  const std::vector<Slot>& slots() const { return slots_; }
  /// Is this slot the same at all instants?
  bool is_constant(std::size_t slot) const { return constant_[slot]; }
  /// Numbers in the order of slots(), at this place in `instants`.
  const double* numbers(std::size_t instant);

 private:
  void evaluate(const Instant& instant, double* to);

  ProgramPointer program_;
  Run run_;
  Work work_;
  std::vector<Step> steps_;
  std::vector<Slot> slots_;
  std::vector<bool> constant_;
  std::vector<Instant> instants_;
  std::vector<double> table_, now_;  // table_ is empty where it would be too large
  std::vector<double> x_;
};

}  // namespace hysteron
