#include "engine/compile/infinite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/diagram/error.h"
#include "engine/diagram/index.h"

namespace hysteron {
namespace {

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

/// Outputs and derivatives with all inputs at `u`, at the start and at rest.
bool has_finite_values(const Program& program, const Run& run, int block, double u) {
  const BlockInstance& b = program.blocks[at(block)];
  const std::vector<double> inputs(at(b.n_u), u), still(at(b.n_u)), sampled(at(b.sizes.sampled_states));
  std::vector<double> memory(at(b.sizes.memory)), out(at(std::max(b.sizes.outputs, b.sizes.states)));
  View<double> v = view_of(program, run, block);
  v.u = inputs.data();
  v.du = still.data();
  if (b.hit_index >= 0) v.x = sampled.data();
  if (b.kernel->advance != nullptr) {
    v.out = memory.data();
    b.kernel->advance(v);
    v.m = memory.data();
  }
  v.out = out.data();
  b.kernel->output(v);
  if (!all_finite({out.data(), at(b.sizes.outputs)})) return false;
  if (b.sizes.states == 0) return true;
  b.kernel->derivative(v);
  return all_finite({out.data(), at(b.sizes.states)});
}

}  // namespace

void check_infinite(const Program& program, const Run& run) {
  Problems problems;
  for (std::size_t i = 0; i < program.blocks.size(); ++i) {
    const BlockInstance& b = program.blocks[i];
    const std::span own(run.p.data() + b.p_begin, at(b.p_at.back()));
    if (b.series_index >= 0 || all_finite(own)) continue;
    const int block = static_cast<int>(i);
    const bool looks_back = b.history_index >= 0;
    if (!looks_back && has_finite_values(program, run, block, 0) && has_finite_values(program, run, block, 1)) continue;
    const auto& declared = b.kernel->declaration.parameters;
    for (std::size_t k = 0; k < declared.size(); ++k)
      if (!all_finite(own.subspan(at(b.p_at[k]), at(b.p_at[k + 1] - b.p_at[k]))))
        problems.add("bad_value", b.origin + "/" + declared[k].name,
                     fmt::format("\"{}\" of {} \"{}\" is not finite, and with it the block has no finite values",
                                 declared[k].name, b.kernel->declaration.type, b.path),
                     "give a finite number; only what would be a limit may be infinite");
  }
  problems.throw_if_any();
}

}  // namespace hysteron
