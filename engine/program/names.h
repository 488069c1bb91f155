// Decides what a name that a user writes means in a program: a signal, or numbers. All verbs, jobs and data sets take
// the same names (docs/diagrams.md, "Names"). Does not decide how a value is changed before there is a program
// (settings.h).
#pragma once

#include <string>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// The name under which the program has what a user names in the diagram that it was compiled from:
/// "axis/stage.position" where a nested diagram has this as its output "axis.pos". Any other name as it is.
std::string program_name(const Diagram& diagram, const std::string& name);

/// A block ("stage"), its port ("stage.force"), what lies in a nested diagram ("axis/stage.force"), an output of the
/// diagram; with the index of an element ("tilt[1]", and "[0]" of a single number). A block stands before an output of
/// the same name. -1 if there is none, or a vector is named as a whole.
int find_named_signal(const Program& program, const std::string& name);
/// The same, and outputs of nested diagrams ("axis.pos"), of the program's diagram.
int find_named_signal(const Program& program, const Diagram& diagram, const std::string& name);
/// The same; throws Error "unknown_signal" with the nearest names, or the elements to choose from.
int named_signal(const Program& program, const Diagram& diagram, const std::string& name);
int named_signal(const Program& program, const std::string& name);
/// Every name of a signal, once.
std::vector<std::string> signal_names(const Program& program);

/// Places in program.parameters: a parameter of the diagram ("kp"), of a block ("stage.gain"; where this is "$kp" the
/// same number), of a block further in ("axis/stage.gain"), or what a nested diagram was given ("axis.mass"). All
/// elements of a list ("core.weights"), or one ("core.weights[2]", "coupling.matrix[0][1]", "[0]" of a single number).
/// Empty if there is none.
std::vector<int> find_named_parameters(const Program& program, const std::string& name);
/// The same; throws Error "unknown_parameter" with the nearest names.
std::vector<int> named_parameters(const Program& program, const std::string& name);
/// One number; throws Error "unknown_parameter", also where a list of several is named as a whole.
int named_parameter(const Program& program, const std::string& name);

/// Place in program.state_names ("stage.position"); throws Error "unknown_state" with the nearest names.
int named_state(const Program& program, const std::string& name);

}  // namespace hysteron
