#include "engine/simulate/simulate_parts.h"

#include <fmt/format.h>

#include "engine/program/loop_plan.h"
#include "engine/program/loops.h"

namespace hysteron {

void tell_counts(const Program& program, const Events& events, const Work& work, Statistics& s) {
  s.samples = events.hits();
  s.paths = events.paths();
  for (std::size_t i = 0; i < program.modal_blocks.size(); ++i)
    s.mode_changes.emplace_back(program.blocks[static_cast<std::size_t>(program.modal_blocks[i])].path,
                                events.changes()[i]);
  for (std::size_t i = 0; i < program.loops.size(); ++i) {
    const LoopCounters& c = work.loops->counters[i];
    s.loops.push_back({to_text(program, program.loops[i].path), c.solved, c.failed, c.evaluations, c.bracketed,
                       c.most_evaluations, c.worst_residual});
  }
}

void check_inputs(const Program& program, const Run& run) {
  Problems problems;
  for (std::size_t i = 0; i < program.input_names.size(); ++i)
    if (!run.series[i] || run.series[i]->t.empty())
      problems.add("unbound_input", "/inputs/" + program.input_names[i],
                   fmt::format("nothing drives the input \"{}\" of the diagram", program.input_names[i]),
                   "bind a recording to it (--data), or replace the input by a source block");
  problems.throw_if_any();
}

}  // namespace hysteron
