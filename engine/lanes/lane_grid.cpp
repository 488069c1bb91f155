#include "engine/lanes/lane_grid.h"

#include <algorithm>

#include "engine/program/breakpoints.h"
#include "engine/simulate/fixed_step.h"

namespace hysteron {

std::vector<LanePoint> lane_points(const Program& program, const Run& run, const SimulateOptions& options,
                                   const std::vector<double>& instants) {
  const bool fixed = has_fixed_steps(options.method);
  Breakpoints breakpoints(program, run, options.begin);
  std::vector<LanePoint> points;
  std::size_t next = 0;
  const auto arrive = [&](LanePoint point) {
    while (breakpoints.next() <= point.t + same_instant(point.t)) breakpoints.pass(point.t);
    point.branch = breakpoints.branch();
    for (; next < instants.size() && instants[next] <= point.t + same_instant(point.t); ++next) ++point.rows;
    points.push_back(point);
  };
  arrive({options.begin});
  for (long grid = 1; next < instants.size();) {
    const double t = points.back().t;
    const double stop = fixed ? options.begin + static_cast<double>(grid) * options.step : instants[next];
    if (fixed && stop <= t + same_instant(t)) {
      ++grid;
      continue;
    }
    const double end = std::min(stop, breakpoints.next());
    arrive({.t = end, .h = end - t, .branch_before = points.back().branch});
  }
  return points;
}

}  // namespace hysteron
