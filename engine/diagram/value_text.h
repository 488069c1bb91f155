// Decides how a message shows a number: in the unit in which the file has it.
#pragma once

#include <fmt/format.h>

#include <string>

#include "engine/diagram/units.h"

namespace hysteron {

/// [SI] -> "2.5 mm"; of a plain number "2.5". `difference`: a size, without the origin of a unit such as degC.
inline std::string value_text(double si, const Unit& unit, bool difference = false) {
  const double number = difference ? unit.difference_from_si(si) : unit.from_si(si);
  return unit.text.empty() ? fmt::format("{:.6g}", number) : fmt::format("{:.6g} {}", number, unit.text);
}

}  // namespace hysteron
