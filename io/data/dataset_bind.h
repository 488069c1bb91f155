// Decides what of a data set has to fit a program where nothing is compared with it. Where something is:
// check_binding() in dataset.h.
#pragma once

#include "engine/program/program.h"
#include "io/data/dataset.h"

namespace hysteron {

/// Checks that every recording has what the program's inputs need, with fitting units; its outputs may be missing.
/// Throws Error as check_binding() does.
void check_inputs(const DataSet& data, const Program& program);

}  // namespace hysteron
