// Decides how a diagram of static blocks, memory and linear time-invariant parts, driven by recordings or by sampled
// blocks, is advanced row by row, exactly (DESIGN 6.6). Linear parts use cached matrix exponentials with first-order
// hold; behind a nonlinear block rows are split into substeps until the result no longer changes. Does not handle
// nonlinear states nor memory inside a feedback loop.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/program.h"

namespace hysteron {

/// "" if the program can be advanced exactly; else the block that stands in the way and why.
std::string why_not_exact(const Program& program);

struct AdvanceOptions {
  int substeps = 1;     ///< per row; 1 is exact where no nonlinear block feeds a linear part with states
  bool at_rest = true;  ///< linear states start in equilibrium for the first inputs
};

/// The plan of an exact advance of one program. Immutable once built but for its cache of matrix exponentials:
/// one Advance per thread.
class Advance {
 public:
  /// `signals`: what to return. Throws Error "not_exact".
  Advance(ProgramPointer program, std::vector<int> signals);
  ~Advance();
  Advance(Advance&&) noexcept;
  Advance& operator=(Advance&&) noexcept;

  /// Advances a copy of `run` through `instants` (increasing; the first is the start) and writes
  /// values[signal][instant] [SI]. Between instants the bound inputs move as their series say; their own samples need
  /// not be instants.
  void operator()(const Run& run, std::span<const double> instants, const AdvanceOptions& options,
                  std::vector<std::vector<double>>& values);

  /// True if substeps cannot change the result: no nonlinear block feeds a linear part with states.
  bool exact_without_substeps() const;

  long samples() const;  ///< runs of sampled blocks in the last advance

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

}  // namespace hysteron
