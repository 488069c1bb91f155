// Decides whether a step of an integrator has passed over something that switches: a guard that falls, a kink or a jump
// of a law without modes (Kernel::kinks). An integrator looks at the ends of its steps only, and where the states are
// quiet these are long: a sine may rise above a level and fall below it again between two of them. Here every step is
// looked at in its middle too, and at the extremum of each function that comes near zero between.
// Does not decide how long a step may be (longest_step in breakpoints.h), nor what happens at a crossing
// (adaptive_step.cpp).
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "engine/integrators/root_bracket.h"
#include "engine/program/program.h"

namespace hysteron {

class ZeroCrossings {
 public:
  /// `kinks`: those of laws without modes as well, where states, memory or the past of a dead time depend on them.
  ZeroCrossings(const Program& program, bool kinks);

  bool watches() const { return functions() > 0; }

  /// A step that has been done, but whose end is not accepted yet: memory and modes are those of its beginning.
  struct Step {
    double from = 0, to = 0;  ///< [s]
    /// States at a time inside the step.
    const std::function<void(double t, std::vector<double>& x)>& states;
    /// Guards that are not positive at the end of the step are somebody else's business (the integrator's).
    bool ends_are_known = true;
  };
  struct Found {
    double t = 0;             ///< [s] behind the first crossing, by no more than rounding
    double before = 0;        ///< [s] before it, by no more than rounding
    std::vector<int> guards;  ///< which have fallen there: places in program.modal_blocks; empty: a kink
    double seen = 0;          ///< [s] up to here the step saw what is behind the kink
    bool bent = false;        ///< the step passes kinks whose sides are not kept: inside of it dx/dt is not smooth
  };
  /// Is a kink that the step passes worth cutting the step there. Asked where nothing but states depends on it.
  struct Noticed {
    /// The step saw both sides of it, at its ends; it lies between `before` and `behind` [s], in the step up to `to`.
    std::function<bool(double before, double behind, double to)> passed;
    /// The step saw its other side, at `seen` [s], at neither end. `remembered`: memory or the past of a dead time
    /// depend on it too.
    std::function<bool(double seen, bool remembered)> missed;
  };

  /// The first crossing inside the step.
  std::optional<Found> first(const Run& run, Work& work, const Step& step, const Noticed& noticed);
  /// Puts the sides of the run (Run::sides) where (t, x) is. True if one changed.
  bool choose_sides(Run& run, Work& work, double t, const std::vector<double>& x);
  /// The next step does not begin where the last one ended, or with other modes.
  void forget() { end_.t = std::numeric_limits<double>::quiet_NaN(); }

 private:
  struct Kinked {
    int block;
    bool remembered;  // memory or a dead time is behind it
    bool switches;    // so is something else that switches: its function has a corner where this one is zero
    bool keeps_sides;
  };
  struct Bracket {
    WatchedValues seen;  // where the function has the other sign
    bool missed = false;
  };
  std::optional<Found> look(const Run& run, Work& work, const Step& step, const Noticed& noticed);
  std::optional<Found> left_its_side(const Run& run, const Step& step);
  std::size_t guards() const { return program_.modal_blocks.size(); }
  std::size_t functions() const { return guards() + kinks_; }
  const Kinked& kinked(std::size_t function) const;
  void evaluate(const Run& run, Work& work, double t, std::vector<double>& g);
  std::optional<Bracket> bracket(const Run& run, Work& work, const Step& step, std::size_t i);
  WatchedValues locate(const Run& run, Work& work, const Step& step, std::size_t i, WatchedValues& behind);
  WatchedValues lowest(const Run& run, Work& work, const Step& step, std::size_t i);

  const Program& program_;
  std::vector<Kinked> kinked_;
  std::size_t kinks_ = 0;
  bool rates_ = false;                  // a guard wants the rates of its inputs
  std::vector<hysteron::Step> values_;  // what the functions need
  std::vector<double> x_, side_, seen_;
  Found last_;                       // crossing
  std::vector<double> side_behind_;  // it, of the functions that crossed there; else 0
  WatchedValues begin_, middle_, end_;
};

}  // namespace hysteron
