#include "engine/program/needed.h"

#include <algorithm>
#include <limits>

#include "engine/diagram/index.h"
#include "engine/program/steps.h"

namespace hysteron {

std::vector<Step> steps_for(const Program& program, const std::vector<int>& signals) {
  std::vector<int> loop_of(program.blocks.size(), -1);
  for (std::size_t l = 0; l < program.loops.size(); ++l)
    if (program.loops[l].of_values())
      for (const int b : program.loops[l].blocks) loop_of[at(b)] = static_cast<int>(l);
  std::vector<bool> needed(program.blocks.size(), false);
  std::vector<int> todo;
  const auto need = [&](int signal) {
    const int b = program.signals[at(signal)].block;
    if (!needed[at(b)]) {
      needed[at(b)] = true;
      todo.push_back(b);
    }
  };
  for (const int s : signals) need(s);
  while (!todo.empty()) {
    const int block = todo.back();
    todo.pop_back();
    if (const int l = loop_of[at(block)]; l >= 0)
      for (const Slot& slot : program.loops[at(l)].outside) need(slot.index);
    const BlockInstance& b = program.blocks[at(block)];
    if (b.sizes.feedthrough && !b.kernel->is_sampled())
      for (const int s : b.source) need(s);
  }
  std::vector<Step> list;
  for (const Step& step : program.all_values) {
    const bool wanted = step.order != Order::loop ? needed[at(step.block)]
                                                  : std::any_of(program.loops[at(step.block)].blocks.begin(),
                                                                program.loops[at(step.block)].blocks.end(),
                                                                [&](int b) { return needed[at(b)]; });
    if (wanted) list.push_back(step);
  }
  return list;
}

void evaluate_steps(const Program& program, const Run& run, Work& work, double t, const double* x,
                    const std::vector<Step>& steps) {
  steps::begin(program, run, work, t);
  steps::run(steps, program, work, x);
  if (work.unsolved >= 0) std::fill(work.y.begin(), work.y.end(), std::numeric_limits<double>::quiet_NaN());
}

}  // namespace hysteron
