// Decides which experiment would separate two fitted models of one device: the menu of EFFECTS 5, simulated with both.
// Does not fit.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/program.h"
#include "io/dataset.h"

namespace hysteron {

/// An experiment with its numbers for the device at hand.
struct Experiment {
  std::string word;       ///< of EFFECTS 5: "multisine", "step_hold" ...
  std::string text;       ///< what to do, with amplitude, frequency, duration and sampling in units
  double separation = 0;  ///< rms difference of the two models over the noise
  std::string between;    ///< "amplifier_lag and dead_time"
};

}  // namespace hysteron
