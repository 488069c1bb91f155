// Decides what the units are called that instruments and laboratories write: "Volts", "rev/min", "Nm", "tick/s", a "g"
// that may be two things. What the unit table of the engine reads as it stands is no concern of this one.
#pragma once

#include <string>
#include <string_view>

namespace hysteron {

enum class UnitAnswer { known, unknown, refused, ambiguous };

struct InstrumentUnit {
  UnitAnswer answer = UnitAnswer::unknown;
  std::string unit{};  ///< in words that parse_unit() reads; "" = none
  std::string note{};  ///< known: what was assumed, or ""; refused, ambiguous: why, in words
  std::string cure{};  ///< where it was refused or ambiguous
};

/// The unit `text` of a column called `column`. `is_time`: of the column of the times, in which "S" is a second.
InstrumentUnit instrument_unit(std::string_view text, std::string_view column = "", bool is_time = false);

/// Whether the text can only be meant as a unit, so that a row of such texts is a row of units: "V", "mm", "Volts", but
/// not "a" or "time".
bool looks_like_unit(std::string_view text);

}  // namespace hysteron
