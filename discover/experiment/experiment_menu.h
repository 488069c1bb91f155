// Decides which experiments there are for a device: the signals of each, with numbers for the device at
// hand. Does not simulate. What moves a drive alone is in drive_protocols.cpp, the others in side_protocols.cpp.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "discover/hypotheses/effect.h"
#include "engine/diagram/series.h"
#include "engine/diagram/units.h"
#include "engine/program/program.h"
#include "io/data/dataset.h"

namespace hysteron {

/// A signal beside the drive that an effect reads: a temperature, cycles behind the device, another axis.
struct SideRead {
  std::string name;
  Side kind = Side::none;
};

/// An input that an experiment can move, and how far the recordings moved it [SI].
struct Drive {
  std::string name;
  Unit unit;
  double lowest = 0, highest = 1;
};

/// What the menu needs to know of the device: how far and how fast the recordings drove it.
struct Device {
  std::vector<Drive> drives;        ///< inputs that moved; a temperature only where nothing else did
  std::vector<std::string> inputs;  ///< all of the user's diagram
  double shortest_step = 1e-3, longest_recording = 10;      ///< [s]
  std::map<std::string, double> levels;                     ///< of every input and column where recordings start [SI]
  std::map<std::string, std::pair<double, double>> ranges;  ///< lowest and highest [SI]
  /// Of every input and column: how fast it moved at most from row to row [SI/s].
  std::map<std::string, double> fastest{};
  std::vector<double> recorded_times;      ///< rows of the longest recording ...
  std::map<std::string, Series> recorded;  ///< ... and what moved in it
};
Device device_of(const Program& program, const DataSet& data);
/// [SI/s] that a signal may move; infinite where nobody knows.
double fastest_of(const Device& device, const std::string& signal);
/// "move u2, hold the other inputs: ", where there are others.
std::string which_moves(const Device& device, const Drive& drive);

/// The signals of one experiment, by its word; and how to tell it to a person.
struct Protocol {
  std::string word, text;
  std::map<std::string, Series> moves;  ///< inputs and side signals; what is not here stays where it started
  std::vector<double> t;                ///< rows [s]
  /// The temperature or the cycles too. In all others these do what they like: who reads one is not told apart.
  bool controls_sides = false;
};

/// What is left to choose of a protocol: as recorded, or faster or slower, and how much of the range that was used.
struct Variant {
  double slower = 1;  ///< times the time that it takes otherwise
  double part = 1;    ///< of the range
  /// Nowhere faster than the recordings were, which all of the bench was shown to bear: where that binds, triangles
  /// take longer, sines are smaller, and from level to level there is a ramp.
  bool as_recorded = false;
};

/// Experiments that move one drive, the others held: triangle, sine_amplitudes, low_frequencies, high_frequencies,
/// multisine, step_hold, fast_steps, and zero_run, in which it does not. Besides these there is precycle, before the
/// longest recording once more.
const std::vector<std::string>& drive_words();
/// Variant::slower to try, the usual one first: slow experiments faster, fast ones slower, those between both.
const std::vector<double>& paces(const std::string& word);
Protocol drive_protocol(const Device& device, const Drive& drive, const std::string& word, const Variant& variant = {});

/// Experiments for effects that read these side signals, moving `drive` where one moves: axes_independent;
/// temperature_staircase, temperature_constant, repeat_after_cycles.
std::vector<Protocol> side_protocols(const Device& device, const Drive& drive, const std::vector<SideRead>& sides);
/// A temperature, or what was behind the device: only an experiment that controls it (Protocol::controls_sides) tells.
bool needs_control(const SideRead& side);

}  // namespace hysteron
