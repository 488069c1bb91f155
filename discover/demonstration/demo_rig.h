// Decides on what and with which signals an effect is shown: a bare wire or a device that lacks it, and the standard
// signals by which effects of its kind are known. Internal to discover (demonstration.h).
#pragma once

#include <string>
#include <vector>

#include "discover/hypotheses/effect.h"
#include "discover/placement/places.h"
#include "engine/block/kernel.h"
#include "engine/diagram/diagram.h"
#include "engine/diagram/series.h"
#include "io/data/dataset.h"

namespace hysteron {

/// What an effect is, as far as it decides which signal shows it.
enum class Nature {
  beside,    ///< reads a second signal
  memory,    ///< remembers turning points
  settling,  ///< linear, or on a wire, with states: shows behind a step
  dynamic,   ///< changes a device with states
  clock,     ///< is there at rest too
  curve      ///< a static law
};
Nature nature_of(const Effect& effect, const Registry& registry);

/// A diagram from "in" to "out" with the place for an effect, which brings in the side signal that it reads.
struct DemoRig {
  Diagram diagram;
  Place place;
  std::string device;  ///< type of the block between, "" = none
  Unit unit;           ///< of "in"
  double top = 1;      ///< largest value of "in" [SI]
  std::string side;    ///< name of the side signal, "" = none
  Unit side_unit;
  double side_from = 0, side_to = 0;  ///< [SI]
};
/// The benches on which an effect may be shown, the most usual one first.
std::vector<DemoRig> demo_rigs(const Effect& effect, const Effects& library, const Registry& registry);

enum class Waveform { shrinking, shrinking_about_zero, step, levels, sine, sine_about_zero, waves };

/// A standard signal.
struct Stimulus {
  std::string text;    ///< for people
  Series in, side;     ///< [SI]
  double row = 0;      ///< [s] between the rows of a recording of it
  double length = 0;   ///< [s]
  double step_at = 0;  ///< [s] when it moves first
};
/// In the order in which they are tried for an effect of this nature.
std::vector<Waveform> waveforms_for(Nature nature);
Stimulus stimulus(Waveform waveform, const DemoRig& demo_rig, double length);

/// The stimulus as a recording of the bench, read with so many levels: the device itself is recorded nowhere.
DataSet recorded(const Stimulus& stimulus, const DemoRig& demo_rig);

}  // namespace hysteron
