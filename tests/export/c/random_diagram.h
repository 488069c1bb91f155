// Decides what diagrams the C code is tried on that nobody has thought of: blocks of every kind that can be written, at
// random places behind two inputs, each of them an output.
#pragma once

#include <string>

namespace hysteron::in_c {

struct RandomDiagram {
  std::string json;
  bool jumps = false;  ///< one of its laws has a step: the last bit of a signal may decide about much of another one
};

/// The same for the same seed; its first block is of the kind seed % random_kinds(), so that so many seeds meet all.
RandomDiagram random_diagram(unsigned seed);
unsigned random_kinds();

}  // namespace hysteron::in_c
