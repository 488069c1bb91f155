#include "engine/rowwise/advance_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/diagram/index.h"
#include "engine/diagram/stop.h"
#include "engine/program/steps.h"
#include "engine/rowwise/linear_part.h"

namespace hysteron {

namespace {

// Rows of a chunk: what all blocks together make of so many stays in the caches, and calls do not count any more.
constexpr std::size_t chunk = 256;

}  // namespace

AdvanceRows::AdvanceRows(const AdvancePlan& plan, int lanes)
    : plan_(plan), program_(*plan.program), lanes_(at(lanes)), own_(at(program_.n_y)), in_(at(program_.n_y)) {
  const auto add = [&](int b) {
    for (int s = plan_.block(b).y_begin; s < plan_.block(b).y_begin + plan_.block(b).sizes.outputs; ++s)
      signals_.push_back(s);
  };
  for (const int b : plan_.series) add(b);
  for (const int b : plan_.constants) add(b);
  const std::size_t sources = signals_.size();
  for (const auto& level : plan_.levels)
    for (const int b : level.nonlinear) add(b);
  for (const auto& loop : plan_.loops) signals_.insert(signals_.end(), loop.outputs.begin(), loop.outputs.end());
  for (const int b : plan_.momentary) add(b);
  for (const auto& part : plan_.parts)
    signals_.insert(signals_.end(), part.output_signals().begin(), part.output_signals().end());
  computed_.assign(at(program_.n_y), false);
  for (std::size_t i = sources; i < signals_.size(); ++i) computed_[at(signals_[i])] = true;
  std::size_t scratch = 0, inputs = 0, outputs = 0;
  for (const auto& b : program_.blocks) {
    scratch = std::max(scratch, RowsView::scratch_size(b.n_u, b.sizes.states, b.sizes.memory, b.sizes.outputs));
    inputs = std::max(inputs, at(b.n_u));
    outputs = std::max(outputs, at(b.sizes.outputs));
  }
  for (const auto& part : plan_.parts) {
    inputs = std::max(inputs, part.input_signals().size());
    outputs = std::max(outputs, part.output_signals().size());
  }
  scratch_.resize(scratch);
  inputs_.resize(inputs);
  outputs_.resize(outputs);
  x_.resize(lanes_ * at(program_.n_x));
  m_.resize(lanes_ * at(program_.n_m));
  views_.resize(lanes_ * program_.blocks.size());
}

/// Row -1 of every signal is the start; constants stand in every row.
void AdvanceRows::begin(std::span<AdvanceState* const> states, std::size_t rows) {
  const auto state_of = [&](std::size_t lane) -> const AdvanceState& {
    return *states[lane < states.size() ? lane : 0];
  };
  arena_.assign(signals_.size() * (rows + 1) * lanes_, 0.0);
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    double* row = arena_.data() + (i * (rows + 1) + 1) * lanes_;
    own_[at(signals_[i])] = row;
    in_[at(signals_[i])] = row;
    for (std::size_t l = 0; l < lanes_; ++l)
      row[static_cast<std::ptrdiff_t>(l) - static_cast<std::ptrdiff_t>(lanes_)] = state_of(l).y[at(signals_[i])];
  }
  for (const int b : plan_.constants)
    for (int s = plan_.block(b).y_begin; s < plan_.block(b).y_begin + plan_.block(b).sizes.outputs; ++s)
      for (std::size_t k = 0; k < rows * lanes_; ++k) own_[at(s)][k] = state_of(k % lanes_).y[at(s)];
  const auto take = [&](int block) {
    const BlockInstance& b = plan_.block(block);
    const auto n_x = at(b.sizes.states), n_m = at(b.sizes.memory);
    for (std::size_t l = 0; l < lanes_; ++l) {
      std::copy_n(state_of(l).x.begin() + b.x_begin, n_x, x_.data() + lanes_ * at(b.x_begin) + l * n_x);
      std::copy_n(state_of(l).run.m.begin() + b.m_begin, n_m, m_.data() + lanes_ * at(b.m_begin) + l * n_m);
      views_[lanes_ * at(block) + l] = state_of(l).work.views[at(block)];
    }
  };
  for (const auto& level : plan_.levels)
    for (const int block : level.nonlinear) take(block);
  for (const int block : plan_.momentary) take(block);
}

/// Steps, kinds and times of the rows that lead through the next points; how many rows.
std::size_t AdvanceRows::lay_out_rows(const Schedule& schedule, std::size_t first, std::size_t points, int substeps) {
  const bool times = plan_.has_histories || !plan_.momentary.empty();
  row_is_point_ = substeps == 1 && !plan_.has_histories;
  if (row_is_point_) {
    steps_ = schedule.h.data() + first;
    kinds_ = schedule.kind.data() + first;
    times_ = schedule.t.data() + first;
    return points;
  }
  for (auto* list : {&h_, &t_, &branch_}) list->clear();
  kind_.clear();
  row_.clear();
  for (std::size_t k = first; k < first + points; ++k) {
    const int pieces = schedule.kind[k] >= 0 ? substeps : 1;
    const double before = schedule.t[k - 1], way = schedule.t[k] - before;
    for (int i = 1; i <= pieces; ++i) {
      h_.push_back(schedule.h[k] / pieces);
      kind_.push_back(schedule.kind[k]);
      if (!times) continue;
      t_.push_back(i == pieces ? schedule.t[k] : before + way * i / pieces);
      branch_.push_back(before + 0.5 * way);
    }
    row_.push_back(h_.size() - 1);
  }
  steps_ = h_.data();
  kinds_ = kind_.data();
  times_ = t_.data();
  return h_.size();
}

void AdvanceRows::fill_sources(const Schedule& schedule, std::size_t first, std::size_t points, int substeps) {
  for (std::size_t s = 0; s < plan_.series.size(); ++s) {
    const auto signal = at(plan_.block(plan_.series[s]).y_begin);
    const auto values = schedule.values[s];
    if (lanes_ == 1 && substeps == 1) {
      in_[signal] = values.data() + first;
      continue;
    }
    double* to = own_[signal] - lanes_;
    to = std::fill_n(to, lanes_, values[first - 1]);
    for (std::size_t k = first; k < first + points; ++k) {
      const int pieces = schedule.kind[k] >= 0 ? substeps : 1;
      const double before = values[k - 1], way = values[k] - before;
      for (int i = 1; i < pieces; ++i) to = std::fill_n(to, lanes_, before + way * i / pieces);
      to = std::fill_n(to, lanes_, values[k]);
    }
  }
}

void AdvanceRows::pass_linear(std::span<AdvanceState* const> states, int part, std::size_t rows,
                              const Schedule& schedule, int substeps) {
  LinearPart::RowsOfPart r;
  r.count = static_cast<int>(rows);
  r.stride = static_cast<std::ptrdiff_t>(lanes_);
  r.w = inputs_.data();
  r.y = outputs_.data();
  r.kind = kinds_;
  r.lengths = &schedule.lengths;
  r.substeps = substeps;
  const auto point_at_lane = [&](std::size_t l) {
    const LinearPart& p = states[l]->parts[at(part)];
    for (std::size_t i = 0; i < p.input_signals().size(); ++i) inputs_[i] = in_[at(p.input_signals()[i])] + l;
    for (std::size_t i = 0; i < p.output_signals().size(); ++i) outputs_[i] = own_[at(p.output_signals()[i])] + l;
  };
  if (lanes_ > 1) {
    point_at_lane(0);
    std::array<LinearPart*, RowsView::most_lanes> parts{};
    for (std::size_t l = 0; l < states.size(); ++l) parts[l] = &states[l]->parts[at(part)];
    if (LinearPart::pass_lanes(std::span(parts).first(states.size()), r)) return;
  }
  for (std::size_t l = 0; l < states.size(); ++l) {
    point_at_lane(l);
    states[l]->parts[at(part)].pass(r);
  }
}

void AdvanceRows::pass_block(std::span<AdvanceState* const> states, int block, std::size_t rows) {
  const BlockInstance& b = plan_.block(block);
  if (b.history_index >= 0) {
    for (std::size_t l = 0; l < states.size(); ++l) pass_history(*states[l], static_cast<int>(l), block, rows);
    return;
  }
  for (std::size_t i = 0; i < at(b.n_u); ++i) inputs_[i] = in_[at(b.source[i])];
  for (int o = 0; o < b.sizes.outputs; ++o) outputs_[at(o)] = own_[at(b.y_begin + o)];
  RowsView r;
  r.lanes = static_cast<int>(lanes_);
  r.count = static_cast<int>(rows);
  r.views = views_.data() + lanes_ * at(block);
  r.u = inputs_.data();
  r.y = outputs_.data();
  r.x = x_.data() + lanes_ * at(b.x_begin);
  r.m = m_.data() + lanes_ * at(b.m_begin);
  r.h = steps_;
  if (b.kernel->uses_time) r.t = times_;
  r.path_steps = states.front()->path_steps_of(block);
  r.scratch = scratch_.data();
  b.kernel->rows(r);
}

void AdvanceRows::pass_history(AdvanceState& state, int lane, int block, std::size_t rows) {
  const BlockInstance& b = plan_.block(block);
  const auto source = at(b.source.front()), signal = at(b.y_begin);
  View<double>& v = state.work.views[at(block)];
  for (std::size_t k = 0; k < rows; ++k) {
    v.t = times_[k];
    v.branch = branch_[k];
    state.y[source] = in_[source][k * lanes_ + at(lane)];
    state.look_back(block, times_[k]);
    own_[signal][k * lanes_ + at(lane)] = state.y[signal];
  }
}

void AdvanceRows::pass_loop(AdvanceState& state, std::size_t lane, int loop, std::size_t rows) {
  const auto& part = plan_.loops[at(loop)];
  for (std::size_t k = 0; k < rows; ++k) {
    for (const int s : part.inputs) state.y[at(s)] = in_[at(s)][k * lanes_ + lane];
    state.move_loop(loop, steps_[k]);
    for (const int s : part.outputs) own_[at(s)][k * lanes_ + lane] = state.y[at(s)];
  }
}

void AdvanceRows::record(const Schedule& schedule, std::size_t first, std::size_t points,
                         std::span<Values* const> values) {
  const std::size_t instants = schedule.instants->size();
  std::size_t end = schedule.one_to_one ? std::min(instants, first + points) : next_instant_;
  while (end < instants && schedule.point_of(end) < first + points) ++end;
  const bool all = lanes_ == 1 && schedule.one_to_one && row_is_point_;
  for (std::size_t s = 0; s < plan_.signals.size(); ++s)
    for (std::size_t l = 0; l < values.size() && direct_[s] == 0; ++l) {
      const double* rows = in_[at(plan_.signals[s])] + l;
      double* to = (*values[l])[s].data();
      if (all)
        std::copy_n(rows, points, to + next_instant_);
      else
        for (std::size_t i = next_instant_; i < end; ++i) {
          const std::size_t point = schedule.point_of(i) - first;
          to[i] = rows[(row_is_point_ ? point : row_[point]) * lanes_];
        }
    }
  next_instant_ = end;
}

/// What is computed and wanted in every row is made in its place, where one run has one row per instant.
void AdvanceRows::find_direct(const Schedule& schedule, int substeps) {
  direct_.assign(plan_.signals.size(), 0);
  is_direct_.assign(at(program_.n_y), false);
  if (lanes_ > 1 || !schedule.one_to_one || substeps > 1 || plan_.has_histories) return;
  for (std::size_t s = 0; s < plan_.signals.size(); ++s) {
    const auto signal = at(plan_.signals[s]);
    if (!computed_[signal] || is_direct_[signal]) continue;
    direct_[s] = 1;
    is_direct_[signal] = true;
  }
}

void AdvanceRows::point_direct(std::size_t first, std::span<Values* const> values) {
  for (std::size_t s = 0; s < direct_.size(); ++s)
    if (direct_[s] != 0) {
      const auto signal = at(plan_.signals[s]);
      in_[signal] = own_[signal] = (*values.front())[s].data() + first;
    }
}

void AdvanceRows::keep_last_row(std::size_t rows) {
  for (const int s : signals_) {
    if (is_direct_[at(s)]) continue;
    double* row = own_[at(s)];
    std::copy_n(row + (rows - 1) * lanes_, lanes_, row - lanes_);
  }
}

/// Every run has a wanted signal that is no number any more: the rows behind would only say so again.
bool AdvanceRows::has_run_away(std::span<Values* const> values) const {
  if (next_instant_ == 0) return false;
  return std::all_of(values.begin(), values.end(), [&](const Values* run) {
    return std::any_of(run->begin(), run->end(), [&](const auto& v) { return !std::isfinite(v[next_instant_ - 1]); });
  });
}

void AdvanceRows::operator()(std::span<AdvanceState* const> states, const Schedule& schedule, int substeps,
                             std::span<Values* const> values) {
  const std::size_t points_at_once = std::max<std::size_t>(1, chunk / at(substeps));
  begin(states, points_at_once * at(substeps));
  find_direct(schedule, substeps);
  next_instant_ = 0;
  while (next_instant_ < schedule.instants->size() && schedule.point_of(next_instant_) == 0) {
    for (std::size_t s = 0; s < plan_.signals.size(); ++s)
      for (std::size_t l = 0; l < states.size(); ++l)
        (*values[l])[s][next_instant_] = states[l]->y[at(plan_.signals[s])];
    ++next_instant_;
  }
  for (std::size_t first = 1; first < schedule.t.size(); first += points_at_once) {
    look_up();
    const std::size_t points = std::min(points_at_once, schedule.t.size() - first);
    const std::size_t rows = lay_out_rows(schedule, first, points, substeps);
    fill_sources(schedule, first, points, substeps);
    point_direct(first, values);
    for (const auto& level : plan_.levels) {
      for (const int part : level.linear) pass_linear(states, part, rows, schedule, substeps);
      for (const int block : level.nonlinear) pass_block(states, block, rows);
      for (const int loop : level.loops)
        for (std::size_t l = 0; l < states.size(); ++l) pass_loop(*states[l], l, loop, rows);
    }
    for (const int block : plan_.momentary) pass_block(states, block, rows);
    record(schedule, first, points, values);
    if (has_run_away(values)) {
      for (auto* run : values)
        for (auto& v : *run)
          std::fill(v.begin() + static_cast<std::ptrdiff_t>(next_instant_), v.end(),
                    std::numeric_limits<double>::quiet_NaN());
      return;
    }
    keep_last_row(rows);
  }
}

}  // namespace hysteron
