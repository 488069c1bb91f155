// Decides how the columns of a table become lists that a block takes as its parameters. Does not know which parameters
// a block has.
#pragma once

#include <string>

#include "engine/diagram/diagram.h"

namespace hysteron {

/// Each column a list with the unit of its header: "at [mm]", "values [N]". With the columns "at" and "at_2" (to
/// "at_4") the rows are points of a grid, in any order: each axis becomes the list of its knots, the column "values"
/// that of the grid, the last axis fastest. Throws what read_table() throws, and Error "bad_value" for a grid with a
/// point that is missing or stands twice.
Ordered<Value> read_parameter_table(const std::string& file);

}  // namespace hysteron
