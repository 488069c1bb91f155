// Decides what a setting from outside (--set, --choose, "set" and "choose" of a job) changes in a diagram, and how the
// name of a number is taken apart. Does not read a program: names.h.
#pragma once

#include <string>
#include <vector>

#include "engine/diagram/diagram.h"

namespace hysteron {

/// Applies `--set` and `--choose`. A number is set by any of its names (docs/diagrams.md, "Names"); where a block reads
/// it as "$kp" it is kp that is set, for all who read it. Returns a sentence for each setting that thereby changes more
/// than what it names. Throws Error naming the nearest valid names.
std::vector<std::string> settings_applied(Diagram& diagram, const std::vector<Override>& set,
                                          const std::vector<Override>& choose);

/// The name of a number taken apart: "axis/stage.weights[2]" -> "axis/stage", "weights", column 2.
struct NumberName {
  std::string block{};        ///< "" of a parameter of the diagram
  std::string parameter{};    ///< of that block, or of the nested diagram that it is
  int row = -1, column = -1;  ///< of an element of a list (column alone) or a matrix; -1 = none
};
NumberName number_name(const std::string& name);

}  // namespace hysteron
