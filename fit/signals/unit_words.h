// Decides how a number is told to three digits: in the unit of its column, a small size with a prefix that suits it.
#pragma once

#include <string>

#include "engine/diagram/units.h"

namespace hysteron {

std::string size_text(double si, const Unit& unit);                 ///< a difference: "12 nm", of a column in mm too
std::string fall_text(double from, double to, const Unit& unit);    ///< two of them: "61.2 nm -> 0.234 nm"
std::string fraction_text(double share);                            ///< "1.2 %", of small ones "0.386 ppm"
std::string level_text(double si, const Unit& unit);                ///< a level: "21.5 degC"
std::string range_text(double low, double high, const Unit& unit);  ///< [SI] "0 .. 5 V"

}  // namespace hysteron
