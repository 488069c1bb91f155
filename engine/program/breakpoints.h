// Decides at which known times the signals of a program are not smooth: corners of the sources and their echoes behind
// dead times. Does not know what is done there (adaptive_step.cpp); reversals are not known in advance and are not
// here.
#pragma once

#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// Two times nearer than this are one instant: what sums and products of sample times lose by rounding.
inline double same_instant(double t) { return 4 * std::numeric_limits<double>::epsilon() * (t < 0 ? -t : t); }

/// The next corner of a source behind `t` [s], or infinity. Throws Error "bad_value", naming the block, if its corners
/// do not go on.
double breakpoint_behind(const Program& program, const Run& run, int block, double t);

/// Walks along the corners. A corner at c comes again at c + delay behind each dead time, as often as there are dead
/// times.
class Breakpoints {
 public:
  Breakpoints(const Program& program, const Run& run, double begin);

  double next() const;    ///< first corner behind the present time [s], or infinity
  double branch() const;  ///< a time inside the present smooth piece of every source [s]
  void pass(double t);    ///< the present time is now t; corners up to t (and within rounding) are behind
  /// The corners that `other`, of the same program, has still before it.
  void go_on_as(const Breakpoints& other) {
    t_ = other.t_;
    sources_ = other.sources_;
    delayed_ = other.delayed_;
  }
  void jumped(double t) { add_delayed(t, 0); }  ///< something else jumped at t: its echoes are corners, too

 private:
  using DelayedBreakpoint = std::pair<double, int>;  // time, how many dead times it has passed
  struct Source {
    int block;
    double next;
  };
  void add_delayed(double t, int generation);

  const Program& program_;
  const Run& run_;
  double t_;
  std::vector<Source> sources_;
  std::vector<double> delays_;
  std::priority_queue<DelayedBreakpoint, std::vector<DelayedBreakpoint>, std::greater<>> delayed_;
};

/// The longest step that memory and switches admit [s]: a quarter of the shortest period of what drives a block with
/// memory, modes, kinks or a past, as the periods of the sources make it (between two looks, which zero_crossings.h and
/// reversals.h take at the ends and in the middle of every step, it then turns once at most), and the shortest dead
/// time. Infinity if nothing limits it.
double longest_step(const Program& program, const Run& run, double span);

}  // namespace hysteron
