// Decides what is said of a program's small motions from one signal to another: response, poles, stability, and as a
// loop that is closed with the sign -1 its margins. Stability is counted before anything is read off. Continuous
// systems and sampled ones alike. Does not find the operating point, does not write (app).
#pragma once

#include <memory>
#include <optional>

#include "engine/analysis/linearize.h"
#include "engine/analysis/margins.h"

namespace hysteron {

struct SampledFacts {
  double period = 0;          ///< [s] common to all clocks on the way
  double sample = 0;          ///< [s] between the instants at which the input counts
  int looks = 1;              ///< such instants in one period
  bool acts_between = false;  ///< the input acts between them too, and was taken as held
};

struct SmallMotions {
  std::optional<SampledFacts> sampled;
  LinearModel model;  ///< continuous: all states; sampled: none
  Response response;  ///< SI
  Bode bode;
  /// On the way from input to output: [rad/s], or z over the common period. Without dead times.
  std::vector<std::complex<double>> poles, zeros;
  PoleCount count;                  ///< unstable ones of what lies between (the loop as opened), dead times included
  std::optional<PoleCount> closed;  ///< of the loop closed
  std::optional<Margins> margins;
  std::optional<ClosedLoop> closed_loop;  ///< of a stable one
  std::vector<int> cuts;                  ///< blocks that pass nothing on
  bool any_dead_time = false;
};

/// `loop`: from and to are those of a loop gain, and it is to be judged as closed with the sign -1.
/// Throws Error as linearize() and SampledModel do.
SmallMotions small_motions(const Program& program, const Run& run, const LinearizeOptions& options, bool loop);

}  // namespace hysteron
