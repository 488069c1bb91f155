// Decides whether a measured column comes late (or early) by something that its note does not say.
// Reported, never applied silently: the same number of samples at different sample rates is a fact of the
// data, the same number of seconds a dead time of the device; with one rate it is a tie.
#pragma once

#include <string>
#include <vector>

#include "fit/model/model.h"
#include "fit/model/score.h"

namespace hysteron {

enum class DelayKind { none, samples, seconds, tie, unclear };

struct RecordingDelay {
  int recording = -1;
  double step = 0;  ///< median distance of rows [s]
  double samples =
      0;  ///< best shift of the measured rows behind the model, parabola through the grid; > 0 = measured is late
  double seconds = 0;    ///< samples * step
  double sigma = 0;      ///< of `samples`, from the curvature of chi2 scaled by its own floor
  double fall = 0;       ///< share of the squared error that the shift takes away, 0..1
  bool at_edge = false;  ///< best at the end of the grid: no delay of some samples
};

struct DelayFinding {
  int output = 0;
  DelayKind kind = DelayKind::none;
  double samples = 0;  ///< where kind is samples or tie
  double seconds = 0;  ///< where kind is seconds or tie
  double fall = 0;     ///< of the squared error over all recordings, 0..1
  std::vector<RecordingDelay> recordings;
  std::string sentence;  ///< for people; says what to write into the data set file, "" for none
};

/// Looks for a delay of each output within +-`reach` samples on the recordings that the prediction holds.
std::vector<DelayFinding> find_delays(const DataModel& model, const Judge& judge, const Prediction& prediction,
                                      int reach = 5);

}  // namespace hysteron
