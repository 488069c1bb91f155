// Decides the points that runs in lanes pass: ends of steps, corners of the sources and rows, the same for all lanes.
// Internal to lanes.cpp.
#pragma once

#include <vector>

#include "engine/program/program.h"
#include "engine/simulate/simulate.h"

namespace hysteron {

struct LanePoint {
  double t = 0;              ///< [s]
  double branch = 0;         ///< time that decides the piece of every source behind t [s]
  double h = 0;              ///< step that leads to it [s]; 0 for the first
  double branch_before = 0;  ///< of that step [s]
  int rows = 0;              ///< output instants at this point
};

/// As fixed_step.h goes for euler and rk4, where instants lie on steps (why_not_in_lanes); for static diagrams from
/// instant to instant and corner to corner.
std::vector<LanePoint> lane_points(const Program& program, const Run& run, const SimulateOptions& options,
                                   const std::vector<double>& instants);

}  // namespace hysteron
