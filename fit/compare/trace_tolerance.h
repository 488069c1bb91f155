// Decides how a tolerance on traces is written: "y: 2 nm + 0.1 %, 0.1 ms". Does not judge (trace_distance.h).
#pragma once

#include <optional>
#include <string>

#include "engine/diagram/units.h"
#include "fit/compare/trace_distance.h"

namespace hysteron {

/// As written: for one signal or for all whose unit fits, in the units of the words.
struct WrittenTolerance {
  std::string written;
  std::string signal;  ///< "" = all
  std::optional<double> absolute, relative, along;
  Unit unit{}, along_unit{};  ///< of absolute and along

  /// True if the absolute part has the dimension of the signal (or there is none).
  bool fits(const Unit& signal_unit) const;
  /// In SI. Throws Error "wrong_unit" where `along` has not the unit of the axis.
  TraceTolerance in_si(const Unit& axis, const std::string& axis_name) const;
};

/// Reads "[signal:] [2 nm] [+] [0.1 %] [, 0.1 ms]". Throws Error "bad_command_line" or "bad_unit".
WrittenTolerance read_trace_tolerance(const std::string& written);

}  // namespace hysteron
