// Decides which numbers of a diagram an FMU shows, under which name and value reference: the same for who exports it
// and for who runs it (interop/fmi). Does not write the model description (fmi_description.h).
#pragma once

#include <string>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// What a variable is to whoever drives the FMU.
enum class FmiRole { time, input, output, parameter, local };

struct FmiVariable {
  std::string name;
  FmiRole role = FmiRole::local;
  int place = -1;  ///< of an input, of a signal (outputs and locals), or in Program::parameters
  Unit unit{};     ///< in which its value is told
  bool difference = false;

  double to_si(double number) const { return difference ? unit.difference_to_si(number) : unit.to_si(number); }
  double from_si(double si) const { return difference ? unit.difference_from_si(si) : unit.from_si(si); }
};

/// Time, inputs, outputs, parameters and every other signal, each name once; the place in the list is the value
/// reference. A diagram without outputs shows what it records as outputs.
std::vector<FmiVariable> fmi_variables(const Program& program);

}  // namespace hysteron
