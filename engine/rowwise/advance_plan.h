// Decides what an exact advance of one program consists of: which blocks take part, in which order, which linear blocks
// are one part, what jumps reach, and whether substeps matter. Internal to the exact advance; advance.cpp tells the
// idea.
#pragma once

#include <vector>

#include "engine/program/program.h"
#include "engine/rowwise/advance_graph.h"

namespace hysteron {

class LinearPart;

struct AdvancePlan {
  struct Level {
    std::vector<int> linear;     ///< places in `parts`
    std::vector<int> nonlinear;  ///< blocks in value order
    std::vector<int> loops;      ///< places in `loops`
    // Those that a jump of sampled blocks reaches at once.
    std::vector<int> linear_behind, nonlinear_behind, loops_behind;
  };

  /// A feedback loop with nonlinear blocks: advance_loop.h.
  struct LoopedPart {
    std::vector<int> blocks;
    std::vector<Step> derivatives, values;
    std::vector<int> inputs, outputs;  ///< signals that it reads; those that it makes and others read
    std::vector<int> states;           ///< places in the states of the program
    std::vector<int> memory, modal;    ///< blocks that remember; that have modes
    bool follows_jumps = false;        ///< something in it remembers the way of a jump
  };

  ProgramPointer program;
  std::vector<int> signals;  ///< what is returned
  AdvanceGraph graph;
  std::vector<int> series, constants;            ///< sources; what comes late of a recording counts as one
  std::vector<int> delays;                       ///< dead times that hand jumps of sampled blocks on
  std::vector<int> momentary, momentary_behind;  ///< in value order; those that read what sampled blocks hold
  std::vector<int> series_signals, sampled_signals;
  std::vector<Level> levels;
  std::vector<LinearPart> parts;  ///< not bound to any numbers
  std::vector<LoopedPart> loops;
  std::vector<unsigned char> rate_independent, jumping;  ///< per block: states that move along a jump; nothing (path.h)
  bool integrates = false;                               ///< some states are not linear
  bool no_substeps_needed = true;
  bool series_turn = false, sampled_turn = false;  ///< their jumps turn in front of memory: path.h
  bool needs_states = false;                       ///< sampling evaluates blocks with states
  bool has_histories = false;                      ///< some block looks back
  bool has_own_rest = false;  ///< nonlinear states that go to an equilibrium: those of no rate-independent law

  /// linear_too: as for advance_graph. Throws Error "not_exact".
  AdvancePlan(ProgramPointer program, std::vector<int> signals, const std::vector<bool>& linear_too = {});
  ~AdvancePlan();
  AdvancePlan(const AdvancePlan&) = delete;
  AdvancePlan& operator=(const AdvancePlan&) = delete;

  const BlockInstance& block(int b) const { return program->blocks[static_cast<std::size_t>(b)]; }
  int block_of(int signal) const { return program->signals[static_cast<std::size_t>(signal)].block; }
  AdvanceRole role(int b) const { return graph.role[static_cast<std::size_t>(b)]; }
  bool has_states(int nonlinear) const { return block(nonlinear).sizes.states > 0; }
  bool is_rate_independent(int b) const { return block(b).kernel->declaration.is_rate_independent; }

  /// Runs on nothing but rows and jumps of held inputs, so that many rows can be passed at once.
  bool is_plain(const Run& run) const;
  /// Some recording is held between its samples.
  bool sources_jump(const Run& run) const;
  /// The recording that a source in `series` reads, itself or late.
  const SeriesPointer& recording(const Run& run, int b) const;
  /// [s] by which a source in `series` comes late.
  double lateness(const Run& run, int b) const;
  std::vector<double> delays_of(const Run& run) const;
  /// Functions of time with corners of their own.
  bool has_breakpoints() const;

 private:
  void find_needed();
  std::vector<int> blocks_in_value_order() const;
  void build_levels();
  void group_linear(int d, const std::vector<int>& order);
  LoopedPart looped_part(const std::vector<int>& blocks) const;
  std::vector<int> outside_readers(const std::vector<int>& members) const;
  bool any_source(int b, const std::vector<bool>& marked) const;
  bool any_input(const LoopedPart& loop, const std::vector<bool>& marked) const;
  void mark(int b, std::vector<bool>& marked, bool value) const;
  void find_curved();
  void mark_linear(int d);
  void find_behind();

  // Per block; per signal.
  std::vector<bool> needed_;
  std::vector<bool> curved_, kinked_, moves_;
};

}  // namespace hysteron
