// Decides which unit an area, a ratio, a square or a difference of values is shown in. Does not convert values.
#pragma once

#include "engine/diagram/units.h"

namespace hysteron {

Unit without_offset(Unit unit);               ///< for a difference or a size: 1 degC of it is 1 K
Unit product(const Unit& a, const Unit& b);   ///< "um V"
Unit quotient(const Unit& a, const Unit& b);  ///< "um/V", "um/(V/um)"
Unit squared(const Unit& a);

}  // namespace hysteron
