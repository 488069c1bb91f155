// Decides how numbers look to people: always with a unit, never with more digits than are worth reading.
// Does not convert into other units than those the user's files speak.
#pragma once

#include <string>

#include "engine/diagram/readable_unit.h"
#include "engine/diagram/units.h"

namespace hysteron {

/// Four significant digits, without trailing zeros: "0.2129", "12.5", "1.2e-07".
std::string number_text(double value, int digits = 4);

/// So many digits that the half width of an interval about the value shows two: 0.4744 within 0.4730 .. 0.4758. 5 where
/// the interval has no width; 0 where the value is nothing beside it: 0.014 within -24 .. 24 is "0".
int digits_within(double value, double low, double high);

/// "0.2129 um" of a value in SI; a small value gets the prefix that suits it ("5.04 um" of 5.04e-6 m). Offsets of
/// the unit count (degC).
std::string quantity_text(double si, const Unit& unit, int digits = 4);

/// The same for a difference: an error of 0.5 K is 0.5 degC, not -272.65 degC.
std::string difference_text(double si, const Unit& unit, int digits = 4);

/// The unit in which differences from `small` to `large` [SI] stand beside each other, as on one axis: the one that
/// suits the small one, or, where the large one would have five digits before its point there, the one that suits the
/// large one.
ReadableUnit readable_unit_of_range(double small, double large, const Unit& unit);

/// "12.3 %" of a share.
std::string percent_text(double share);

/// "1 recording", "3 recordings".
std::string count_text(long n, const std::string& noun);

/// "um" or "1": what stands behind a number or in the brackets of an axis.
std::string unit_text(const Unit& unit);

/// "y [um]"
std::string axis_text(const std::string& name, const Unit& unit);

}  // namespace hysteron
