// Decides how the code is tested where it runs: a C program with rows of the engine. Does not compute them (c_rows.h).
#pragma once

#include <string>

#include "export/c/c_rows.h"
#include "export/c/c_source.h"

namespace hysteron {

/// A program that steps through the rows, says how far its outputs are from the engine's, each in its unit, and ends
/// with 0: in double where all bits agree, in float where no output is further away than 1 % of what it spans. With a
/// number behind it, it also says how long so many steps take.
std::string c_test_source(const CSource& source, const CWish& wish, const SignalRows& inputs,
                          const SignalRows& outputs);

}  // namespace hysteron
