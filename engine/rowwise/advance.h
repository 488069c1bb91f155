// Decides how a diagram of static blocks, memory, linear time-invariant parts and nonlinear states outside of feedback
// loops, driven by recordings or by sampled blocks, is advanced row by row, exactly. Linear parts use
// cached matrix exponentials with first-order hold; behind a nonlinear block, and for nonlinear states, rows are split
// into substeps until the result no longer changes. Does not handle nonlinear blocks inside a feedback loop.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// "" if the program can be advanced exactly; else the block that stands in the way and why.
std::string why_not_exact(const Program& program);

struct AdvanceOptions {
  int substeps = 1;     ///< per row; 1 is exact where no nonlinear block feeds a linear part with states
  bool at_rest = true;  ///< states start in equilibrium for the first inputs; memory stays
};

/// The plan of an exact advance of one program. Immutable once built but for what it keeps between runs (matrix
/// exponentials, the values of recordings at the instants): one Advance per thread.
class Advance {
 public:
  /// Instants that are known by their place: what was worked out for them is kept for the next run.
  using Instants = std::shared_ptr<const std::vector<double>>;

  /// `signals`: what to return. Throws Error "not_exact".
  Advance(ProgramPointer program, std::vector<int> signals);
  ~Advance();
  Advance(Advance&&) noexcept;
  Advance& operator=(Advance&&) noexcept;

  /// Advances a copy of `run` through `instants` (increasing; the first is the start) and writes
  /// values[signal][instant] [SI]. Between instants the bound inputs move as their series say; their own samples need
  /// not be instants. Throws Error(Fault::numerics) "diverged" where a value is not finite.
  void operator()(const Run& run, const Instants& instants, const AdvanceOptions& options,
                  std::vector<std::vector<double>>& values);
  /// The same; instants are compared with those of the last call.
  void operator()(const Run& run, std::span<const double> instants, const AdvanceOptions& options,
                  std::vector<std::vector<double>>& values);

  /// Several runs of the program, side by side where they see nothing but rows: the same numbers as one after the
  /// other, to the last bit. Inputs are bound to the same recordings in all of them. values[run][signal][instant] [SI].
  /// Never throws for a run that fails; one text per run, "" or why.
  std::vector<std::string> each(std::span<const Run* const> runs, const Instants& instants,
                                const AdvanceOptions& options, std::vector<std::vector<std::vector<double>>>& values);

  /// True if substeps cannot change the result: no nonlinear block feeds a linear part with states, and no nonlinear
  /// block has states.
  bool exact_without_substeps() const;

  /// Some states of the last run (before any: of some run) are not linear, or stand in a loop with nonlinear blocks:
  /// where these are stiff no number of substeps that pays may suffice.
  bool integrates() const;

  /// Such a run passes many rows at once. It does not where sources that jump (held inputs) meet a dead time, or
  /// sampled blocks: then every instant is a point of its own, and some more are.
  bool passes_rows(const Run& run) const;

  long samples() const;  ///< runs of sampled blocks in the last advance

 private:
  struct Content;
  Content& content_of(const Run& run);

  std::unique_ptr<Content> content_;
  // Where blocks are linear at the numbers of a run though not in general (linear_at): the last such plan.
  std::vector<bool> linear_;
  std::unique_ptr<Content> with_linear_;
  const Content* last_ = nullptr;  ///< that advanced the last run; at first the general one
};

}  // namespace hysteron
