// Decides which experiment would separate fitted models of one device: the menu (menu.h), simulated with all of
// them. Does not fit.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "discover/experiment/experiment_menu.h"
#include "discover/experiment/menu.h"
#include "discover/hypotheses/effect.h"
#include "engine/program/program.h"

namespace hysteron {

struct Rivals;

/// What one input of the diagram does in an experiment.
struct DrivenInput {
  std::string name;
  Unit unit;
  std::vector<double> values{};      ///< [SI], in each row
  bool moves = false;                ///< else it holds the level at which the recordings start
  double fastest = 0, recorded = 0;  ///< [SI/s] from row to row: here, and at most in the recordings
};

/// The rows in which an experiment was simulated, between which what moves goes along straight lines.
struct DriveRows {
  std::vector<double> t;  ///< [s], rising
  std::vector<DrivenInput> inputs;
  double shortest_step = 0;          ///< [s] rows are to be recorded so near to each other
  std::vector<std::string> outputs;  ///< to be measured
  std::vector<std::string> besides;  ///< what else moves, or is to be recorded: temperatures, cycles, other axes
};

/// An experiment with its numbers for the device at hand.
struct Experiment {
  std::string word;       ///< of the menu: "multisine", "step_hold" ...
  std::string text;       ///< what to do, with amplitude, frequency, duration and sampling in units
  double separation = 0;  ///< rms difference of two models over the noise: the least of those that it tells apart
  double rows = 0;        ///< in which they were compared: chi2 between them is separation^2 * rows
  std::string between;    ///< who is told from whom: "amplifier_lag and dead_time"
  int rivals_told = 0;    ///< so many are told from the first
  bool another_instrument = false;  ///< a second sensor tells them, and whatever the drives of this bench do does not
  std::shared_ptr<const Rivals> rivals{};  ///< among whom it was chosen
  std::shared_ptr<const DriveRows> drive{};
};

/// A fitted model of the device, to be told from others.
struct Rival {
  std::string effect;
  ProgramPointer program;
  /// The same without what it ascribes to the sensor: the motion that a second sensor would see; nullptr = it ascribes
  /// nothing to the sensor.
  ProgramPointer motion{};
  SideRead side{};                       ///< that it reads
  std::vector<LookAlike> look_alikes{};  ///< which experiment is to tell it from whom
  std::vector<std::string> inputs{};     ///< on the way to what it moves; empty = any
  bool hidden = false;                   ///< no recording so far could show it
};

struct Rivals {
  std::vector<Rival> models;  ///< the best one first
  /// Is this separation, in so many rows, enough to tell two models of which one may be hidden?
  bool (*tells)(const Experiment& experiment, bool hidden) = nullptr;
};

/// How the models are seen: outputs, the white rms noise of each, and whether its zero is arbitrary (compared without
/// the mean).
struct Sight {
  std::vector<std::string> outputs;
  std::vector<double> noise;
  std::vector<bool> free_zero;
  bool second_sensor = true;  ///< one may be asked for
};

/// The best experiment, if the models can be simulated in any, and all among which it was chosen.
struct Separation {
  std::optional<Experiment> best;
  Menu menu;
};

/// Simulates all models on the menu: rms difference of each output over its noise, the largest output counts. Each
/// protocol that moves a drive is tried with each drive on the way to the rivals, then faster or slower, then with less
/// amplitude. The best tells most rivals from the first, then most from each other; of these a word of
/// Rival::look_alikes goes first if it separates by at least 2, then who separates most where it separates least. In
/// its place goes the same within the speed of the recordings, where that tells as many, by at least 2.
Separation separate(const Rivals& rivals, const Device& device, const Sight& sight);

}  // namespace hysteron
