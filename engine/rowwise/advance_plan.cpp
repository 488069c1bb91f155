#include "engine/rowwise/advance_plan.h"

#include <algorithm>
#include <numeric>

#include "engine/diagram/index.h"
#include "engine/events/path.h"
#include "engine/program/steps.h"
#include "engine/rowwise/linear_part.h"

namespace hysteron {

AdvancePlan::AdvancePlan(ProgramPointer p, std::vector<int> wanted, const std::vector<bool>& linear_too)
    : program(std::move(p)), signals(std::move(wanted)), graph(advance_graph(*program, linear_too)) {
  if (!graph.why_not.empty())
    fail("not_exact", graph.why_not, "this diagram cannot be advanced row by row exactly", "use the method \"bdf\"");
  find_needed();
  build_levels();
  find_curved();
  find_behind();
}

AdvancePlan::~AdvancePlan() = default;

void AdvancePlan::find_needed() {
  needed_.assign(program->blocks.size(), false);
  std::vector<int> todo = program->sampled_blocks;
  for (const int s : signals) todo.push_back(block_of(s));
  while (!todo.empty()) {
    const int b = todo.back();
    todo.pop_back();
    if (needed_[at(b)]) continue;
    needed_[at(b)] = true;
    for (const int s : block(b).source) todo.push_back(block_of(s));
  }
}

std::vector<int> AdvancePlan::blocks_in_value_order() const {
  std::vector<int> order;
  for (const int b : program->value_order)
    if (needed_[at(b)]) order.push_back(b);
  return order;
}

void AdvancePlan::build_levels() {
  const auto order = blocks_in_value_order();
  int deepest = 0;
  for (const int b : order) deepest = std::max(deepest, graph.depth[at(b)]);
  levels.resize(at(deepest) + 1);
  const auto add_signals = [&](int b, std::vector<int>& list) {
    for (int o = 0; o < block(b).sizes.outputs; ++o) list.push_back(block(b).y_begin + o);
  };
  const auto turns = turns_before_memory(*program);
  for (const int b : order) {
    switch (role(b)) {
      case AdvanceRole::source:
        if (block(b).series_index < 0 && graph.late_of[at(b)] < 0) {
          constants.push_back(b);
          break;
        }
        series.push_back(b);
        add_signals(b, series_signals);
        series_turn = series_turn || turns[at(b)];
        break;
      case AdvanceRole::sampled:
        add_signals(b, sampled_signals);
        sampled_turn = sampled_turn || turns[at(b)];
        break;
      case AdvanceRole::nonlinear:
        levels[at(graph.depth[at(b)])].nonlinear.push_back(b);
        has_histories = has_histories || block(b).history_index >= 0;
        has_own_rest = has_own_rest || (has_states(b) && !is_rate_independent(b));
        integrates = integrates || has_states(b);
        if (!graph.delayed[at(b)]) break;
        delays.push_back(b);
        add_signals(b, series_signals);
        series_turn = series_turn || turns[at(b)];
        break;
      case AdvanceRole::momentary:
        momentary.push_back(b);
        break;
      case AdvanceRole::linear:
      case AdvanceRole::looped:
        break;
    }
  }
  for (const auto& b : program->blocks)
    rate_independent.push_back(b.kernel->declaration.is_rate_independent && b.sizes.states > 0);
  jumping.assign(program->blocks.size(), 0);
  for (const auto& blocks : graph.loops) {
    if (!needed_[at(blocks.front())]) continue;
    levels[at(graph.depth[at(blocks.front())])].loops.push_back(static_cast<int>(loops.size()));
    loops.push_back(looped_part(blocks));
    const auto& states = loops.back().states;
    has_own_rest = has_own_rest || !states.empty();
    integrates = integrates || !states.empty();
  }
  for (int d = 0; d <= deepest; ++d) group_linear(d, order);
}

AdvancePlan::LoopedPart AdvancePlan::looped_part(const std::vector<int>& blocks) const {
  LoopedPart part;
  part.blocks = blocks;
  part.outputs = outside_readers(blocks);
  const auto inside = [&](int b) { return std::find(blocks.begin(), blocks.end(), b) != blocks.end(); };
  const auto take = [&](const std::vector<Step>& from, std::vector<Step>& to) {
    for (const Step& step : from)
      if (step.order != Order::loop && inside(step.block)) to.push_back(step);
  };
  take(program->derivative_steps, part.derivatives);
  take(program->all_values, part.values);
  for (const int block_in_loop : blocks) {
    const BlockInstance& b = block(block_in_loop);
    for (int i = 0; i < b.sizes.states; ++i) part.states.push_back(b.x_begin + i);
    if (b.sizes.memory > 0) part.memory.push_back(block_in_loop);
    if (b.kernel->has_modes()) part.modal.push_back(block_in_loop);
    part.follows_jumps = part.follows_jumps || b.sizes.memory > 0 || rate_independent[at(block_in_loop)] != 0;
    for (const int s : b.source)
      if (!inside(block_of(s)) && std::find(part.inputs.begin(), part.inputs.end(), s) == part.inputs.end())
        part.inputs.push_back(s);
  }
  return part;
}

/// Linear blocks of one depth that are wired together become one part.
void AdvancePlan::group_linear(int d, const std::vector<int>& order) {
  std::vector<int> parent(program->blocks.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int b) {
    while (parent[at(b)] != b) b = parent[at(b)];
    return b;
  };
  const auto here = [&](int b) { return needed_[at(b)] && role(b) == AdvanceRole::linear && graph.depth[at(b)] == d; };
  for (const int b : order)
    if (here(b))
      for (const int s : block(b).source)
        if (here(block_of(s))) parent[at(root(b))] = root(block_of(s));
  std::vector<int> roots;
  for (const int b : order)
    if (here(b) && std::find(roots.begin(), roots.end(), root(b)) == roots.end()) roots.push_back(root(b));
  for (const int r : roots) {
    std::vector<int> members;
    for (const int b : order)
      if (here(b) && root(b) == r) members.push_back(b);
    levels[at(d)].linear.push_back(static_cast<int>(parts.size()));
    parts.emplace_back(*program, members, outside_readers(members));
  }
}

std::vector<int> AdvancePlan::outside_readers(const std::vector<int>& members) const {
  std::vector<int> outputs;
  const auto inside = [&](int b) { return std::find(members.begin(), members.end(), b) != members.end(); };
  const auto add = [&](int s) {
    if (inside(block_of(s)) && std::find(outputs.begin(), outputs.end(), s) == outputs.end()) outputs.push_back(s);
  };
  for (const int s : signals) add(s);
  for (const int s : graph.hit_signals) add(s);
  for (std::size_t b = 0; b < program->blocks.size(); ++b)
    if (needed_[b] && !inside(static_cast<int>(b)))
      for (const int s : program->blocks[b].source) add(s);
  return outputs;
}

bool AdvancePlan::any_source(int b, const std::vector<bool>& marked) const {
  return std::any_of(block(b).source.begin(), block(b).source.end(), [&](int s) { return marked[at(s)]; });
}

bool AdvancePlan::any_input(const LoopedPart& loop, const std::vector<bool>& marked) const {
  return std::any_of(loop.inputs.begin(), loop.inputs.end(), [&](int s) { return marked[at(s)]; });
}

void AdvancePlan::mark(int b, std::vector<bool>& marked, bool value) const {
  for (int o = 0; o < block(b).sizes.outputs; ++o) marked[at(block(b).y_begin + o)] = value;
}

/// A signal moves between points if a recorded input or a state stands before it; it is curved there if a state or a
/// delay does (what turns at a row turns inside a row when it comes late). Substeps matter where a curved or kinked
/// signal drives states or comes late, or a curved one drives memory (an extreme inside a row), and for nonlinear
/// states, whatever drives them.
void AdvancePlan::find_curved() {
  curved_.assign(program->signals.size(), false);
  moves_ = kinked_ = curved_;
  for (const int b : series) mark(b, moves_, true);
  for (std::size_t d = 0; d < levels.size(); ++d) {
    for (const int i : levels[d].linear)
      if (parts[at(i)].has_states())
        for (const int s : parts[at(i)].input_signals())
          if (curved_[at(s)] || kinked_[at(s)]) no_substeps_needed = false;
    mark_linear(static_cast<int>(d));
    for (const int b : levels[d].nonlinear) {
      const bool any_curved = any_source(b, curved_);
      const bool is_late = block(b).history_index >= 0;
      if (has_states(b) || (any_curved && block(b).sizes.memory > 0) ||
          (is_late && (any_curved || any_source(b, kinked_))))
        no_substeps_needed = false;
      const bool any_moves = any_source(b, moves_) || (has_states(b) && !is_rate_independent(b));
      mark(b, moves_, any_moves);
      mark(b, kinked_, any_moves);
      mark(b, curved_, any_curved || ((has_states(b) || is_late) && any_moves));
    }
    for (const int i : levels[d].loops) {
      const auto& loop = loops[at(i)];
      if (!loop.states.empty()) no_substeps_needed = false;
      for (const int b : loop.blocks)
        for (auto* marked : {&moves_, &kinked_, &curved_}) mark(b, *marked, true);
    }
  }
}

void AdvancePlan::mark_linear(int d) {
  for (const int b : blocks_in_value_order()) {
    if (role(b) != AdvanceRole::linear || graph.depth[at(b)] != d) continue;
    const bool states = block(b).sizes.states > 0;
    mark(b, curved_, states || any_source(b, curved_));
    mark(b, moves_, states || any_source(b, moves_));
    mark(b, kinked_, any_source(b, kinked_));
  }
}

void AdvancePlan::find_behind() {
  for (auto& level : levels) {
    for (const int i : level.linear) {
      const auto& inputs = parts[at(i)].input_signals();
      if (std::any_of(inputs.begin(), inputs.end(), [&](int s) { return graph.jumps[at(s)]; }))
        level.linear_behind.push_back(i);
    }
    for (const int b : level.nonlinear)
      if (any_source(b, graph.jumps)) level.nonlinear_behind.push_back(b);
    for (const int i : level.loops)
      if (any_input(loops[at(i)], graph.jumps)) level.loops_behind.push_back(i);
  }
  for (const int b : momentary)
    if (any_source(b, graph.jumps)) momentary_behind.push_back(b);
  for (const Step& step : graph.hit_steps) {
    if (step.order == Order::loop)
      for (const int b : program->loops[at(step.block)].blocks) needs_states |= block(b).sizes.states > 0;
    else
      needs_states |= block(step.block).sizes.states > 0;
  }
}

bool AdvancePlan::is_plain(const Run& run) const {
  return program->sampled_blocks.empty() && !has_breakpoints() &&
         !(sources_jump(run) && (has_histories || series_turn));
}

bool AdvancePlan::sources_jump(const Run& run) const {
  return std::any_of(series.begin(), series.end(), [&](int b) { return recording(run, b)->between == Between::hold; });
}

const SeriesPointer& AdvancePlan::recording(const Run& run, int b) const {
  const int of = graph.late_of[at(b)];
  return run.series[at(block(of >= 0 ? of : b).series_index)];
}

double AdvancePlan::lateness(const Run& run, int b) const {
  return graph.late_of[at(b)] >= 0 ? block(b).kernel->reach_back(view_of(*program, run, b)) : 0;
}

std::vector<double> AdvancePlan::delays_of(const Run& run) const {
  std::vector<double> list;
  for (const int b : delays)
    if (block(b).kernel->reach_back) list.push_back(block(b).kernel->reach_back(view_of(*program, run, b)));
  return list;
}

bool AdvancePlan::has_breakpoints() const {
  return std::any_of(momentary.begin(), momentary.end(), [&](int b) { return block(b).kernel->next_breakpoint; });
}

}  // namespace hysteron
