// Decides how tests see what is wrong with a diagram.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "engine/diagram/error.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron::tools {

/// The problems that compiling a diagram gives.
inline std::vector<Problem> problems_of(const Diagram& diagram) {
  try {
    compile(diagram, registry());
  } catch (const Error& e) {
    EXPECT_EQ(e.fault, Fault::input);
    return e.problems;
  }
  return {};
}

}  // namespace hysteron::tools
