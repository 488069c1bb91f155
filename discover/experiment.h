// Decides which experiment would separate two fitted models of one device: the menu of EFFECTS 5, simulated with both.
// Does not fit.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "discover/effect.h"
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
  double rows = 0;        ///< in which they were compared: chi2 between them is separation^2 * rows
  std::string between;    ///< "amplifier_lag and dead_time"
};

/// A signal beside the drive that an effect reads: a temperature, cycles behind the device, another axis.
struct SideRead {
  std::string name;
  Side kind = Side::none;
};

/// What the menu needs to know of the device: how far and how fast the recordings drove it.
struct Device {
  std::string input;  ///< the drive that an experiment moves; the others stay as they started
  Unit unit;
  double lowest = 0, highest = 1;
  double shortest_step = 1e-3, longest_recording = 10;      ///< [s]
  std::vector<std::string> drives;                          ///< all inputs of the user's diagram
  std::map<std::string, double> levels;                     ///< of every input and column where recordings start [SI]
  std::map<std::string, std::pair<double, double>> ranges;  ///< lowest and highest [SI]
  std::vector<double> recorded_times;                       ///< rows of the longest recording ...
  std::map<std::string, Series> recorded;                   ///< ... and what moved in it
};
Device device_of(const Program& program, const DataSet& data);

/// The signals of one experiment, by its word; and how to tell it to a person.
struct Protocol {
  std::string word, text;
  std::map<std::string, Series> moves;  ///< inputs and side signals; what is not here stays where it started
  std::vector<double> t;                ///< rows [s]
};
/// Every experiment that can be simulated for effects that read these side signals: sine_amplitudes, triangle,
/// low_frequencies, high_frequencies, multisine, step_hold, fast_steps; with another axis axes_independent. Where one
/// reads a temperature or the cycles, only those that control them: temperature_staircase, temperature_constant,
/// repeat_after_cycles. In all others the temperature does what it likes, and tells nothing.
std::vector<Protocol> menu(const Device& device, const std::vector<SideRead>& sides = {});

/// Two fitted models of one device, to be told apart.
struct Rivals {
  ProgramPointer a, b;
  std::vector<SideRead> sides;         ///< that either of them reads
  std::vector<std::string> preferred;  ///< words of EFFECTS 6
  /// The same without what one of them ascribes to the sensor: the motion that a second sensor would see. Both or none.
  ProgramPointer motion_a, motion_b;
};

/// Simulates both models on the menu: rms difference of each output over `noise` (its white rms), the largest output
/// counts. A preferred word is taken if it separates by at least 2, else the one that separates most.
/// `free_zero`: outputs whose zero is arbitrary are compared without their mean.
std::optional<Experiment> separate(const Rivals& rivals, const std::vector<std::string>& outputs, const Device& device,
                                   const std::vector<double>& noise, const std::vector<bool>& free_zero);

}  // namespace hysteron
