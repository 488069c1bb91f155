// Decides how a diagram in code is simulated by the implicit method at chosen instants. Holds no expectation.
#pragma once

#include "tests/engine/simulate_tools.h"

namespace hysteron::tools {

/// By the implicit method of variable order (BDF), from 0 to the last of the instants [s]; traces have a row for each.
inline Traces simulated_by_bdf(const Diagram& d, std::vector<double> instants, double relative_tolerance,
                               bool at_rest = false) {
  const auto program = compiled(d);
  SimulateOptions options;
  options.instants = std::move(instants);
  options.until = options.instants.back();
  options.method = Method::bdf;
  options.relative_tolerance = relative_tolerance;
  options.at_rest = at_rest;
  return simulate(*program, start(*program), options);
}

}  // namespace hysteron::tools
