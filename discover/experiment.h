// Decides which experiment would separate two fitted models of one device: the menu of EFFECTS 5, simulated with both.
// Does not fit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/program.h"
#include "engine/series.h"
#include "engine/units.h"
#include "io/dataset.h"

namespace hysteron {

/// An experiment with its numbers for the device at hand.
struct Experiment {
  std::string word;       ///< of EFFECTS 5: "multisine", "step_hold" ...
  std::string text;       ///< what to do, with amplitude, frequency, duration and sampling in units
  double separation = 0;  ///< rms difference of the two models over the noise
  std::string between;    ///< "amplifier_lag and dead_time"
};

/// What the menu needs to know of the device: how far and how fast the recordings drove it.
struct Device {
  std::string input;  ///< the drive that an experiment moves; the others stay as they started
  Unit unit;
  double lowest = 0, highest = 1;
  double shortest_step = 1e-3, longest_recording = 10;  ///< [s]
  std::vector<double> others;  ///< level of every input of the program, by Program::input_names
  int input_index = 0;
};
Device device_of(const Program& program, const DataSet& data);

/// The drive of one experiment, by its word; and how to tell it to a person.
struct Protocol {
  std::string word, text;
  Series drive;
  std::vector<double> t;  ///< rows [s]
};
/// Every experiment that can be simulated with one drive: sine_amplitudes, triangle, low_frequencies, high_frequencies,
/// multisine, step_hold, fast_steps.
std::vector<Protocol> menu(const Device& device);

/// Simulates both models on the menu: rms difference of each output over `noise` (its white rms), the largest output
/// counts. `preferred` (a word of EFFECTS 6) is taken if it separates by at least 2, else the one that separates most.
/// `free_zero`: outputs whose zero is arbitrary are compared without their mean.
std::optional<Experiment> separate(const ProgramPointer& a, const ProgramPointer& b,
                                   const std::vector<std::string>& outputs, const Device& device,
                                   const std::vector<double>& noise, const std::vector<bool>& free_zero,
                                   const std::vector<std::string>& preferred);

}  // namespace hysteron
