// Decides what happens at an instant at which something is not smooth, and in which order:
//   1. sources pass their corners; where one jumps, laws and memory follow the path of a fast ramp (path.h);
//   2. sampled blocks that are due run: continuous signals are read as they are behind the corner, outputs follow each
//      other in the order of the wires, then all sampled states change together; the jumps of their outputs are paths;
//   3. modes whose guard is not positive any more change, all of them together from one evaluation, each resetting its
//   own
//      states; jumps of their outputs are paths; again, until every mode may stay.
// Within a stage nothing depends on the order of blocks. Memory is committed before (by the caller, with the old
// formulas), along paths, and behind (by the caller).
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "engine/clocks.h"
#include "engine/corners.h"
#include "engine/path.h"
#include "engine/program.h"

namespace hysteron {

class Events {
 public:
  /// begin, until [s]: the span of the simulation. Tolerances as of the integration; one absolute tolerance per state.
  Events(const Program& program, const Run& run, double begin, double until, double relative_tolerance,
         std::span<const double> absolute_tolerance);

  double next() const;    ///< first known instant behind the present: corners and sampling instants [s]
  double branch() const;  ///< a time inside the present smooth piece of every source [s]
  int guards() const { return static_cast<int>(program_.modal_blocks.size()); }

  /// At the start: what is due at t; nothing has jumped yet.
  void begin(Run& run, Work& work, double t, std::vector<double>& x);
  /// At a known instant t, memory committed. Returns true if states changed.
  bool pass(Run& run, Work& work, double t, std::vector<double>& x);
  /// Modes whose guards are not positive; `fired`: guards in whose step the integrator saw a root (may be empty).
  /// Returns true if a mode changed.
  bool settle(Run& run, Work& work, double t, std::vector<double>& x, std::span<const int> fired);
  /// Is a guard not positive at (t, x)?
  bool due(const Run& run, Work& work, double t, const std::vector<double>& x) const;

  /// Changes of mode so far, per block with modes.
  const std::vector<long>& changes() const { return changes_; }
  long hits() const { return hits_; }
  long paths() const { return paths_; }

 private:
  void sample(Run& run, Work& work, double t, const std::vector<double>& x, std::span<const int> due);
  bool follow(Run& run, Work& work, double t, std::vector<double>& x, std::span<const int> jumping);
  void change_modes(Run& run, Work& work, std::vector<double>& x, std::span<const int> due);
  void watch_chatter(double t);

  const Program& program_;
  Corners corners_;
  Clocks clocks_;
  JumpPath path_;
  double span_;
  bool starting_ = false;
  std::vector<double> before_, sampled_;
  std::vector<unsigned char> due_;
  std::vector<int> blocks_;
  std::vector<long> changes_;
  std::vector<double> recent_;  // times of the last changes of mode, a ring
  long hits_ = 0, paths_ = 0;
};

}  // namespace hysteron
