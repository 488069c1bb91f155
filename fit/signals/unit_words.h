// Decides how a number is told in the unit of its column, to three digits.
#pragma once

#include <string>

#include "engine/diagram/units.h"

namespace hysteron {

std::string size_text(double si, const Unit& unit);                 ///< a difference: "12 nm"
std::string level_text(double si, const Unit& unit);                ///< a level: "21.5 degC"
std::string range_text(double low, double high, const Unit& unit);  ///< [SI] "0 .. 5 V"

}  // namespace hysteron
