// Decides which programs, methods and varied parameters go in lanes, and what stands in the way.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/diagram/index.h"
#include "engine/lanes/lane_shared.h"
#include "engine/lanes/lanes.h"
#include "engine/program/breakpoints.h"
#include "engine/simulate/exact_advance.h"
#include "engine/simulate/fixed_step.h"
#include "engine/simulate/output_instants.h"

namespace hysteron {
namespace {

/// Laws that follow the path of a jump, which lanes do not.
bool follows_jumps(const BlockInstance& b) {
  return b.sizes.memory > 0 || (b.sizes.states > 0 && b.kernel->declaration.is_rate_independent);
}

std::string in_the_way(const BlockInstance& b, const std::string& what) {
  return fmt::format("{} \"{}\" {}", b.kernel->declaration.type, b.path, what);
}

/// A source that may jump, and a law behind it that would follow the jump's path.
std::string why_not_jump(const Program& program, const std::vector<SeriesPointer>& series) {
  for (std::size_t i = 0; i < program.blocks.size(); ++i) {
    const BlockInstance& b = program.blocks[i];
    const bool held =
        b.series_index >= 0 && series[at(b.series_index)] && series[at(b.series_index)]->between == Between::hold;
    if (!held && b.sizes.smoothness == Smoothness::smooth) continue;
    const auto reached = program.downstream_of(static_cast<int>(i));
    for (std::size_t k = 0; k < reached.size(); ++k)
      if (reached[k] && follows_jumps(program.blocks[k]))
        return in_the_way(b, fmt::format("jumps, and \"{}\" follows the path of a jump", program.blocks[k].path));
  }
  return "";
}

/// Rows at which no step ends.
bool rows_lie_inside_steps(const SimulateOptions& options) {
  const auto instants = output_instants(options);
  return std::any_of(instants.begin(), instants.end(), [&](double t) {
    const double end = options.begin + std::round((t - options.begin) / options.step) * options.step;
    return std::abs(t - end) > same_instant(t);
  });
}

std::string why_not_structure(const Program& program, const std::vector<SeriesPointer>& series) {
  for (const Loop& loop : program.loops)
    if (loop.needed)
      return in_the_way(program.blocks[at(loop.blocks.front())],
                        "stands in an algebraic loop, which is solved run by run");
  for (const BlockInstance& b : program.blocks) {
    if (b.mode_index >= 0) return in_the_way(b, "changes its mode at instants of its own in every run");
    if (b.kernel->is_sampled()) return in_the_way(b, "runs at sampling instants");
    if (b.history_index >= 0) return in_the_way(b, "looks back into the past of its input");
  }
  return why_not_jump(program, series);
}

}  // namespace

std::string why_not_in_lanes(const Program& program) { return why_not_structure(program, program.series); }

std::string why_not_in_lanes(const Program& program, const Run& run, const SimulateOptions& options,
                             std::span<const int> parameters) {
  if (auto why = why_not_structure(program, run.series); !why.empty()) return why;
  const bool fixed = has_fixed_steps(options.method);
  if (fixed && options.step > 0 && rows_lie_inside_steps(options))
    return "rows lie inside steps: a distance of rows that is a multiple of the step goes in lanes";
  if (!fixed) {
    if (program.n_x > 0)
      return fmt::format("the method \"{}\" is not one of fixed steps: euler or rk4 with a step go in lanes",
                         method_name(options.method));
    if (program.n_m > 0 && !advances_exactly(program, options))
      return "memory behind a source that turns between the rows: euler or rk4 with a step go in lanes";
  }
  const auto shared = shared_blocks(program, parameters);
  for (std::size_t i = 0; i < shared.size(); ++i)
    if (const BlockInstance& b = program.blocks[i]; !shared[i] && b.kernel->next_breakpoint != nullptr)
      return in_the_way(b, "has corners, and what is varied would move them");
  return "";
}

}  // namespace hysteron
