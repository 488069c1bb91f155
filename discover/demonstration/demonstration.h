// Decides how an effect is shown to a person without any data: a standard signal that brings it out, its simplest law,
// and what comes out with it and without it. Does not draw (report/pages/effect_picture.h).
#pragma once

#include <string>
#include <vector>

#include "discover/demonstration/neutral.h"
#include "discover/hypotheses/effect.h"
#include "engine/block/kernel.h"
#include "engine/diagram/units.h"

namespace hysteron {

/// What an effect makes of a standard signal. Numbers in SI.
struct Demonstration {
  std::string signal;   ///< what goes in, for people: "a triangle that shrinks"
  std::string device;   ///< type of the block that lacks the effect; "" = it stands on a bare wire
  std::string law;      ///< Law::name
  std::string numbers;  ///< the values of its parameters, for people
  /// Values of the law's parameters with which it changes nothing: gain 1, offset 0 (neutral.h); empty = none known.
  std::vector<NeutralValue> null_value;
  bool against_input = false;  ///< looked at over the input: a loop or a curve; else over time
  bool log_time = false;       ///< t counts from a step, and the effect goes on by decades
  std::vector<double> t, in, without, with;
  std::vector<double> side;  ///< of an effect that reads a second signal, else empty
  std::string side_name;
  double span = 0;  ///< of what comes out without the effect, under the whole signal
  Unit in_unit, out_unit, side_unit;

  std::vector<double> difference() const;  ///< with - without
  /// Largest difference over the span.
  double share() const;
};

/// Drives the effect's own block, and the neutral bypass beside it, with the first standard signal that its own
/// declaration says can show it, at its start values. Where it does nothing at these, at others of its scan, or with
/// an amplitude of a tenth of the signal and a factor at the end of what is usual. `library`: where devices with memory
/// are taken from. Throws Error "not_shown" where no standard signal brings it out.
Demonstration demonstrate(const Effect& effect, const Effects& library, const Registry& registry);

}  // namespace hysteron
