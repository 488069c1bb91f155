#include "engine/rowwise/advance_state.h"

#include <algorithm>
#include <limits>

#include "engine/block/rows.h"
#include "engine/diagram/index.h"
#include "engine/events/path.h"
#include "engine/events/rest.h"
#include "engine/program/steps.h"
#include "engine/rowwise/advance_points.h"
#include "engine/rowwise/linear_part.h"

namespace hysteron {

AdvanceState::AdvanceState(const AdvancePlan& plan)
    : work(*plan.program),
      y(work.y),
      x(at(plan.program->n_x)),
      parts(plan.parts),
      plan_(plan),
      program_(*plan.program),
      inputs_(2 * at(program_.n_u)),
      input_places_(at(program_.n_u)),
      output_places_(at(program_.n_y)) {
  std::size_t scratch = 0;
  for (const auto& b : program_.blocks)
    scratch = std::max(scratch, RowsView::scratch_size(b.n_u, b.sizes.states, b.sizes.memory, b.sizes.outputs));
  scratch_.resize(scratch);
  loops_.reserve(plan.loops.size());
  for (const auto& loop : plan.loops) loops_.emplace_back(plan, loop, run, work, x, jets_);
  for (std::size_t i = 0; i < input_places_.size(); ++i) input_places_[i] = inputs_.data() + 2 * i + 1;
  for (std::size_t i = 0; i < output_places_.size(); ++i) output_places_[i] = y.data() + i;
}

AdvanceState::~AdvanceState() = default;

void AdvanceState::take(const Run& start, std::vector<SeriesPointer> series, int path_steps) {
  run = start;
  sources = std::move(series);
  x = run.x;
  path_steps_ = path_steps;
  hits = 0;
}

void AdvanceState::at_time(double t, double branch) {
  run.branch = branch;
  steps::begin(program_, run, work, t);
  for (std::size_t s = 0; s < plan_.series.size(); ++s)
    y[at(plan_.block(plan_.series[s]).y_begin)] = sources[s]->value(t, branch);
}

void AdvanceState::steps_value(int block) { steps::value(program_, work, block, x.data()); }

void AdvanceState::look_back(int block, double t) {
  const BlockInstance& b = plan_.block(block);
  History& h = run.histories[at(b.history_index)];
  const double u = y[at(b.source.front())];
  if (h.t.empty()) h.before = u;
  h.t.push_back(t);
  h.u.push_back(u);
  h.rate.push_back(std::numeric_limits<double>::quiet_NaN());
  if (b.kernel->reach_back) steps::forget(h, t, b.kernel->reach_back(work.views[at(block)]));
  evaluate(block);
}

/// Nonlinear blocks follow their inputs, h [s] behind the last point; memory is committed at once: every point of the
/// advance is an accepted one.
void AdvanceState::follow(int block, double t, double h) {
  const BlockInstance& b = plan_.block(block);
  if (b.history_index >= 0) return look_back(block, t);
  if (b.sizes.states > 0) return move_states(block, h);
  evaluate(block);
  if (b.sizes.memory > 0) std::copy_n(work.m.begin() + b.m_begin, b.sizes.memory, run.m.begin() + b.m_begin);
}

void AdvanceState::move_states(int block, double h) {
  const BlockInstance& b = plan_.block(block);
  for (int i = 0; i < b.n_u; ++i) inputs_[2 * at(b.u_begin + i) + 1] = y[at(b.source[at(i)])];
  RowsView rows;
  rows.count = 1;
  rows.views = &work.views[at(block)];
  rows.u = input_places_.data() + b.u_begin;
  rows.y = output_places_.data() + b.y_begin;
  rows.x = x.data() + b.x_begin;
  rows.m = run.m.data() + b.m_begin;
  rows.h = &h;
  rows.path_steps = path_steps_of(block);
  rows.scratch = scratch_.data();
  b.kernel->rows(rows);
  remember_inputs(block);
}

void AdvanceState::remember_inputs(int block) {
  const BlockInstance& b = plan_.block(block);
  for (int i = 0; i < b.n_u; ++i) inputs_[2 * at(b.u_begin + i)] = y[at(b.source[at(i)])];
}

/// Before the first instant: a dead time has its input always been, and nothing is remembered yet.
void AdvanceState::foresee(int block) {
  if (plan_.block(block).history_index >= 0)
    y[at(plan_.block(block).y_begin)] = y[at(plan_.block(block).source.front())];
  else
    evaluate(block);
}

void AdvanceState::start(std::span<const int> due, double t, double branch, bool at_rest, Sampling& sampling) {
  if (at_rest && plan_.has_own_rest) {
    run.branch = branch;
    settle_at_rest(program_, run, t);
    x = run.x;
    at_rest = false;
  }
  at_time(t, branch);
  for (const int b : plan_.constants) evaluate(b);
  for (const int b : program_.sampled_blocks) evaluate(b);  // what they hold
  const bool instant = !due.empty();
  for (const auto& level : plan_.levels) {
    for (const int i : level.linear) {
      parts[at(i)].bind(program_, run);
      parts[at(i)].start(program_, run, y, at_rest);
    }
    for (const int b : level.nonlinear) {
      remember_inputs(b);  // nothing moves at the start
      start_block(b, t, !instant);
    }
    for (const int i : level.loops) loops_[at(i)].start(!instant);
  }
  if (plan_.has_histories) rest_histories(t, !instant);
  for (const int b : plan_.momentary) evaluate(b);
  if (!instant) return;
  const auto memory = run.m;
  sample(due, t, sampling);
  if (plan_.has_histories) sample_until_at_rest(due, t, memory, sampling);
  begin_behind(t, true);
  if (plan_.has_histories) {
    rest_histories(t, true);
    for (const int b : plan_.momentary) evaluate(b);
  }
  for (const int b : plan_.momentary_behind) evaluate(b);
}

/// Everything behind what was sampled; nothing moves at the start.
void AdvanceState::begin_behind(double t, bool accept) {
  for (const auto& level : plan_.levels) {
    for (const int i : level.linear) parts[at(i)].refresh(y);
    for (const int b : level.nonlinear) {
      remember_inputs(b);
      start_block(b, t, accept);
    }
    for (const int i : level.loops) loops_[at(i)].start(accept);
  }
}

/// What was sampled behind a dead time has seen what that was before its own input was sampled: once more, until each
/// dead time has been what its input is. `memory`: as it was before any sample.
void AdvanceState::sample_until_at_rest(std::span<const int> due, double t, const std::vector<double>& memory,
                                        Sampling& sampling) {
  const auto rests = [&] {
    std::vector<double> list;
    for (const auto& h : run.histories) list.push_back(h.before);
    return list;
  };
  for (std::size_t round = 0; round <= run.histories.size(); ++round) {
    const auto before = rests();
    begin_behind(t, false);
    rest_histories(t, false);
    if (rests() == before) return;
    run.m = memory;
    hits -= static_cast<long>(due.size());
    sample(due, t, sampling);
  }
}

void AdvanceState::start_block(int block, double t, bool accept) {
  if (plan_.block(block).history_index >= 0) return evaluate(block);
  accept ? follow(block, t, 0) : foresee(block);
}

/// What each dead time reads was at rest before the start, dead times behind dead times included.
void AdvanceState::rest_histories(double t, bool accept) {
  std::vector<int> late;
  for (const auto& level : plan_.levels)
    for (const int b : level.nonlinear)
      if (plan_.block(b).history_index >= 0) late.push_back(b);
  for (std::size_t round = 0; round < late.size(); ++round) {
    for (const int b : late) {
      run.histories[at(plan_.block(b).history_index)].before = y[at(plan_.block(b).source.front())];
      evaluate(b);
    }
    for (const auto& level : plan_.levels) {
      for (const int i : level.linear) parts[at(i)].refresh(y);
      for (const int b : level.nonlinear) start_block(b, t, accept);
      for (const int i : level.loops) loops_[at(i)].start(accept);
    }
  }
  if (accept)
    for (const int b : late) look_back(b, t);
}

void AdvanceState::sample(std::span<const int> due, double t, Sampling& sampling) {
  if (plan_.needs_states)
    for (const auto& part : parts) part.store(program_, x);
  hits += static_cast<long>(due.size());
  sampling(run, work, t, x.data(), due, plan_.graph.hit_steps);
  for (const int b : program_.sampled_blocks) evaluate(b);
}

void AdvanceState::step(double t, double h, double branch) {
  at_time(t, branch);
  const double rounding = rounding_of(t);
  for (const auto& level : plan_.levels) {
    for (const int i : level.linear) parts[at(i)].step(h, rounding, y);
    const double counted = h > rounding ? h : 0;
    for (const int b : level.nonlinear) follow(b, t, counted);
    for (const int i : level.loops) move_loop(i, counted);
  }
}

/// Everything behind sources that have jumped; with_delays: dead times, too, whose own outputs may have jumped.
void AdvanceState::pass_on(double t, bool with_delays) {
  for (const auto& level : plan_.levels) {
    for (const int i : level.linear) parts[at(i)].refresh(y);
    for (const int b : level.nonlinear)
      if (with_delays || plan_.block(b).history_index < 0) follow(b, t, 0);
    for (const int i : level.loops) move_loop(i, 0);
  }
}

void AdvanceState::pass_on_samples(double t, bool with_delays) {
  for (const auto& level : plan_.levels) {
    for (const int i : level.linear_behind) parts[at(i)].refresh(y);
    for (const int b : level.nonlinear_behind)
      if (with_delays || plan_.block(b).history_index < 0) follow(b, t, 0);
    for (const int i : level.loops_behind) move_loop(i, 0);
  }
}

/// Memory behind a bend follows the jump of `jumping` from `from_` to their present values in pieces, but for the
/// last.
template <class PassOn>
void AdvanceState::walk(const std::vector<int>& jumping, PassOn pass) {
  to_.clear();
  bool any = false;
  for (std::size_t i = 0; i < jumping.size(); ++i) {
    to_.push_back(y[at(jumping[i])]);
    any = any || to_[i] != from_[i];
  }
  if (!any) return;
  for (int k = 1; k < jump_pieces; ++k) {
    for (std::size_t i = 0; i < jumping.size(); ++i)
      y[at(jumping[i])] = from_[i] + (to_[i] - from_[i]) * k / jump_pieces;
    pass();
  }
  for (std::size_t i = 0; i < jumping.size(); ++i) y[at(jumping[i])] = to_[i];
}

void AdvanceState::remember_from(const std::vector<int>& jumping) {
  from_.clear();
  for (const int s : jumping) from_.push_back(y[at(s)]);
}

void AdvanceState::jump(double t, double branch) {
  if (plan_.series_turn) remember_from(plan_.series_signals);
  at_time(t, branch);
  if (plan_.series_turn) {
    for (const int b : plan_.delays) evaluate(b);
    walk(plan_.series_signals, [&] { pass_on(t, false); });
  }
  pass_on(t, true);
}

void AdvanceState::hit(std::span<const int> due, double t, Sampling& sampling) {
  if (plan_.sampled_turn) remember_from(plan_.sampled_signals);
  sample(due, t, sampling);
  if (plan_.sampled_turn) walk(plan_.sampled_signals, [&] { pass_on_samples(t, false); });
  pass_on_samples(t, true);
}

}  // namespace hysteron
