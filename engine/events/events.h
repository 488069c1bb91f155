// Decides what happens at an instant at which something is not smooth, and in which order:
//   1. sources pass their corners; where one jumps, laws and memory follow the path of a fast ramp (path.h);
//   2. sampled blocks that are due run: continuous signals are read as they are behind the corner, outputs follow each
//      other in the order of the wires, then all sampled states change together; the jumps of their outputs are paths;
//   3. modes whose guard is not positive any more change, all of them together from one evaluation, each resetting its
//   own
//      states; jumps of their outputs are paths; again, until every mode may stay.
// What enables or triggers nested diagrams (enabled.h) changes its mode in every stage: corners switch before samples
// are taken, and where a sample switches, all samples of the instant are taken again, those of what runs then. Within a
// stage nothing depends on the order of blocks. Memory is committed before (by the caller, with the old formulas),
// along paths, and behind (by the caller).
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "engine/events/clocks.h"
#include "engine/events/enabled.h"
#include "engine/events/path.h"
#include "engine/events/sampling.h"
#include "engine/program/breakpoints.h"
#include "engine/program/program.h"

namespace hysteron {

class Events {
 public:
  /// begin, until [s]: the span of the simulation. Tolerances as of the integration; one absolute tolerance per state.
  Events(const Program& program, const Run& run, double begin, double until, double relative_tolerance,
         std::span<const double> absolute_tolerance);

  double next() const;    ///< first known instant behind the present: corners and sampling instants [s]
  double branch() const;  ///< a time inside the present smooth piece of every source [s]
  int guards() const { return static_cast<int>(program_.modal_blocks.size()); }

  /// To be called at a known instant (or the start) before begin(), pass() or cross(): what is due there is taken.
  void take(double t, Run& run);
  /// At the start: what is due at t; nothing has jumped yet.
  void begin(Run& run, Work& work, double t, std::vector<double>& x);
  /// At a known instant t, memory committed: cross(), then settle(). Returns true if states or modes changed.
  bool pass(Run& run, Work& work, double t, std::vector<double>& x);
  /// Inputs of the diagram jump at t, memory committed: `change` sets them in the run. What is due at t is left for
  /// pass(). Returns true if states or modes changed.
  bool jump(Run& run, Work& work, double t, std::vector<double>& x, const std::function<void()>& change);
  /// Takes over what `other`, of the same program, has still before it at its present time.
  void go_on_as(const Events& other);
  /// Breakpoints and samples that were taken, for this run or one beside it (forward_sensitivities.h). Returns true if
  /// states moved.
  bool cross(Run& run, Work& work, double t, std::vector<double>& x);
  /// Modes whose guards are not positive; `fired`: guards in whose step the integrator saw a root (may be empty).
  /// Returns true if a mode changed.
  bool settle(Run& run, Work& work, double t, std::vector<double>& x, std::span<const int> fired);
  /// These changes, for this run or one beside it: states are reset, jumps followed. Returns true if a path moved
  /// states.
  bool apply(Run& run, Work& work, double t, std::vector<double>& x, std::span<const ModeChange> changes);
  /// Called before modes change, with everything as it was; may be empty.
  std::function<void(std::span<const ModeChange>)> on_change{};
  /// Between these two calls nothing that begins has jumped.
  void starting(bool yes) { starting_ = yes; }
  /// Is a guard not positive at (t, x)?
  bool due(const Run& run, Work& work, double t, const std::vector<double>& x) const;

  /// Changes of mode so far, per block with modes.
  const std::vector<long>& changes() const { return changes_; }
  long hits() const { return hits_; }
  long paths() const { return paths_; }

 private:
  bool pass_corners(Run& run, Work& work, double t, std::vector<double>& x);
  bool cross_switching(Run& run, Work& work, double t, std::vector<double>& x);
  bool sample(Run& run, Work& work, double t, std::vector<double>& x, std::span<const int> due);
  bool sample_what_runs_now(Run& run, Work& work, double t, std::vector<double>& x,
                            std::span<const ModeChange> changes);
  void change(Run& run, Work& work, double t, std::vector<double>& x, std::span<const ModeChange> changes);
  std::vector<int> due_guards(const Run& run, const Work& work, std::span<const int> fired) const;
  [[noreturn]] void report_unsettled(double t, std::span<const int> due) const;
  bool follow(Run& run, Work& work, double t, std::vector<double>& x, std::span<const int> jumping);
  std::vector<ModeChange> find_changes(const Run& run, Work& work, const std::vector<double>& x,
                                       std::span<const int> due) const;
  void watch_chatter(double t);
  [[noreturn]] void report_chatter(double t, long changes, double within) const;

  const Program& program_;
  Breakpoints breakpoints_;
  Clocks clocks_;
  Sampling sampling_;
  JumpPath path_;
  double span_;
  double milestone_;  // [s]
  long since_milestone_ = 0;
  bool starting_ = false;
  std::vector<int> ranks_;                          // per guard, see start_order.h
  int settling_ = std::numeric_limits<int>::max();  // guards up to this rank
  EnabledDiagrams enabled_;
  bool early_ = false;        // only what comes before the samples settles
  std::vector<int> skipped_;  // samples of this instant that were not taken, since what they stand in was off
  struct Instant {
    bool breakpoint = false;
    std::vector<int> hits;  // places in program.sampled_blocks
  };
  Instant instant_;
  std::vector<double> before_, states_;
  std::vector<int> blocks_;
  std::vector<long> changes_;
  std::vector<double> recent_;  // times of the last changes of mode, a ring
  long hits_ = 0, paths_ = 0;
};

}  // namespace hysteron
