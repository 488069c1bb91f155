// Decides what a heading of a column says: its name and its unit, in the ways in which laboratories write both.
#pragma once

#include <string>
#include <string_view>

namespace hysteron {

struct Heading {
  std::string name;
  std::string unit{};     ///< as written; "" = none
  bool has_unit = false;  ///< also where it says that there is none: "[-]"
};

/// "Force [N]", "Force (N)", "Force / N", "U/V", "C1 in V", "Zeit in s", and the plain name. What stands in round
/// brackets and is no unit is part of the name.
Heading heading_of(std::string_view text);

/// Whether a column of this name holds the times: t, Time, Zeit, timestamp ...
bool is_time_name(std::string_view name);
/// Whether it counts the rows: Sequence, sample, index, #.
bool is_counter_name(std::string_view name);

}  // namespace hysteron
