// Decides what becomes of the blocks of a nested diagram when it is switched off, switched on, or triggered. Does not
// decide when: the modes of the blocks that enable do (events.h).
#pragma once

#include <span>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// One block leaves a mode for another.
struct ModeChange {
  int modal, block;  ///< place in program.modal_blocks, in program.blocks
  int before, after;
};

class EnabledDiagrams {
 public:
  explicit EnabledDiagrams(const Program& program);
  bool any() const { return !program_.enablings.empty(); }

  /// Is this guard that of a block that enables or triggers?
  bool enables(int modal) const { return enabling_of_[static_cast<std::size_t>(modal)] >= 0; }
  /// Has what this block triggers run, so that it stops as soon as nothing else changes its mode?
  bool has_run(const Run& run, int modal) const;
  /// May the mode behind this guard change before samples are taken: of what enables, and inside of what is triggered.
  bool comes_early(int modal) const { return early_[static_cast<std::size_t>(modal)]; }

  /// Adds what follows from these changes: with a diagram those inside of it are switched off. `starting`: there are no
  /// edges yet, so nothing is triggered.
  void complete(const Run& run, std::vector<ModeChange>& changes, bool starting) const;
  /// Before the changes, with `work` evaluated in the old modes: what is switched off holds its outputs, and what was
  /// triggered also what it remembers.
  void switch_off(Run& run, const Work& work, std::span<const ModeChange> changes) const;
  /// Behind the changes: what is enabled to begin anew does.
  void switch_on(Run& run, std::vector<double>& x, std::span<const ModeChange> changes) const;
  /// The blocks inside of what changes; their outputs may jump.
  void list_inside(std::span<const ModeChange> changes, std::vector<int>& blocks) const;
  /// Sampled blocks (places in program.sampled_blocks) of what is being triggered.
  std::vector<int> triggered_samples(const Run& run) const;
  /// Of these sampled blocks those that run.
  std::vector<int> running(const Run& run, std::span<const int> sampled) const;

 private:
  const Enabling* enabling(const ModeChange& change) const;
  const BlockInstance& block(int b) const { return program_.blocks[static_cast<std::size_t>(b)]; }

  const Program& program_;
  std::vector<int> enabling_of_;  // per block with modes: into program.enablings, -1 = it enables nothing
  std::vector<bool> early_;
};

/// Is the sampled block run by a trigger in place of a clock?
bool runs_at_edges(const Program& program, const BlockInstance& block);

}  // namespace hysteron
