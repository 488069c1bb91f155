#include "engine/lanes/lane_evaluation.h"

#include <algorithm>

#include "engine/diagram/index.h"
#include "engine/lanes/lane_arithmetic.h"

namespace hysteron {
namespace {

/// A block whose size the diagram decides and whose outputs follow from parameters and inputs alone: its loop over rows
/// takes all lanes as one row.
bool takes_a_row_of_lanes(const BlockInstance& b) {
  return b.kernel->rows != nullptr && b.n_u > 0 && b.sizes.states == 0 && b.sizes.memory == 0 && b.series_index < 0;
}

}  // namespace

LaneEvaluation::LaneEvaluation(ProgramPointer program, const Run& run, std::vector<bool> shared)
    : program_(std::move(program)),
      series_(run.series),
      shared_(std::move(shared)),
      p_(program_->n_p),
      c_(program_->n_c),
      m_(program_->n_m),
      advanced_(program_->n_m),
      dx_(program_->n_x),
      y_(program_->n_y),
      rate_(program_->n_y) {
  const auto longest = [&](auto count) {
    int n = 0;
    for (const auto& b : program_->blocks) n = std::max(n, count(b));
    return at(n);
  };
  u_.resize(longest([](const BlockInstance& b) { return b.n_u; }));
  du_ = u_;
  dual_u_.resize(u_.size());
  out_.resize(longest([](const BlockInstance& b) { return b.sizes.outputs; }));
  dual_out_.resize(out_.size());
  dual_p_.resize(longest([](const BlockInstance& b) { return b.p_at.back(); }));
  dual_x_.resize(longest([](const BlockInstance& b) { return b.sizes.states; }));
  dual_m_.resize(longest([](const BlockInstance& b) { return b.sizes.memory; }));
  dual_advanced_ = dual_m_;
  scratch_.resize(RowsView::scratch_size(static_cast<int>(u_.size()), 0, 0, static_cast<int>(out_.size())));
}

LaneEvaluation::List LaneEvaluation::make_list(const Run& run, const std::vector<Step>& steps,
                                               std::span<const int> read,
                                               std::vector<SharedNumbers::Instant> instants) {
  List list{{}, SharedNumbers(program_, run, steps, shared_, read, std::move(instants))};
  for (const Step& step : steps)
    if (!shared_[at(step.block)]) list.calls.push_back(bind(step));
  for (Call& call : list.calls) {  // pointers into vectors that stay where they are
    call.view.u = call.u.data();
    call.view.du = call.du.data();
  }
  return list;
}

LaneEvaluation::Call LaneEvaluation::bind(const Step& step) {
  const BlockInstance& b = program_->blocks[at(step.block)];
  const LaneFunctions& f = b.kernel->lanes;
  Call call{step.order, &b, nullptr, {}, {}, {}};
  LanesView& v = call.view;
  v.lanes = Lanes::width;
  v.p = p_.row(b.p_begin);
  v.dx = dx_.row(b.x_begin);
  for (const int s : b.source) {
    call.u.push_back(y_.row(s));
    call.du.push_back(rate_.row(s));
  }
  switch (step.order) {
    case Order::value:
      call.function = f.output;
      v.out = y_.row(b.y_begin);
      if (call.function == nullptr && takes_a_row_of_lanes(b)) bind_row(call);
      break;
    case Order::rate:
      call.function = f.output_rate;
      v.out = rate_.row(b.y_begin);
      v.values = y_.row(b.y_begin);
      break;
    default:
      call.function = f.derivative;
      v.out = dx_.row(b.x_begin);
  }
  return call;
}

void LaneEvaluation::bind_row(Call& call) {
  const BlockInstance& b = *call.block;
  View<double> v;
  v.p_at = b.p_at.data();
  v.n_c = b.sizes.constants;
  v.n_u = b.n_u;
  v.n_y = b.sizes.outputs;
  v.key = b.key;
  for (int lane = 0; lane < Lanes::width; ++lane) {
    v.p = p_.row(b.p_begin) + lane * b.p_at.back();
    v.c = c_.row(b.c_begin) + lane * v.n_c;
    call.views.push_back(v);
  }
  for (int i = 0; i < v.n_y; ++i) call.y.push_back(y_.row(b.y_begin + i));
}

void LaneEvaluation::place(const Run& run, int lane, LaneNumbers& x) {
  const auto put = [&](const BlockInstance& b, const std::vector<double>& from, int begin, int count, LaneNumbers& to) {
    const double* numbers = from.data() + begin;
    double* target = to.row(begin);
    if (is_lane_major(b))
      std::copy_n(numbers, count, target + lane * count);
    else
      for (int i = 0; i < count; ++i) target[i * Lanes::width + lane] = numbers[i];
  };
  for (std::size_t i = 0; i < program_->blocks.size(); ++i) {
    if (shared_[i]) continue;
    const BlockInstance& b = program_->blocks[i];
    put(b, run.p, b.p_begin, b.p_at.back(), p_);
    put(b, run.c, b.c_begin, b.sizes.constants, c_);
    put(b, run.x, b.x_begin, b.sizes.states, x);
    put(b, run.m, b.m_begin, b.sizes.memory, m_);
  }
}

double LaneEvaluation::state(const BlockInstance& b, LaneNumbers& x, int i, int lane) {
  const double* own = x.row(b.x_begin);
  return is_lane_major(b) ? own[lane * b.sizes.states + i] : own[i * Lanes::width + lane];
}

void LaneEvaluation::begin(List& list) {
  const auto& slots = list.shared.slots();
  const double* numbers = list.shared.numbers(0);
  for (std::size_t s = 0; s < slots.size(); ++s)
    if (list.shared.is_constant(s)) lane_fill({number(slots[s]), numbers[s], Lanes::width});
}

void LaneEvaluation::evaluate(List& list, std::size_t instant, double t, double branch, const double* x) {
  const auto& slots = list.shared.slots();
  const double* numbers = list.shared.numbers(instant);
  for (std::size_t s = 0; s < slots.size(); ++s)
    if (!list.shared.is_constant(s)) lane_fill({number(slots[s]), numbers[s], Lanes::width});
  for (Call& call : list.calls) {
    const BlockInstance& b = *call.block;
    LanesView& v = call.view;
    v.t = t;
    v.branch = branch;
    v.x = x + at(b.x_begin) * Lanes::width;
    v.m = m_.row(b.m_begin);
    v.advanced = advanced_.row(b.m_begin);
    if (call.function != nullptr)
      call.function(v);
    else if (!call.views.empty())
      one_row(call);
    else
      one_by_one(call);
  }
}

void LaneEvaluation::one_row(const Call& call) {
  RowsView r;
  r.lanes = Lanes::width;
  r.count = 1;
  r.views = call.views.data();
  r.u = call.u.data();
  r.y = call.y.data();
  if (call.block->kernel->uses_time) r.t = &call.view.t;
  r.scratch = scratch_.data();
  call.block->kernel->rows(r);
}

/// Other blocks whose size the diagram decides: one lane behind the other, their numbers lane by lane.
void LaneEvaluation::one_by_one(Call& call) {
  const BlockInstance& b = *call.block;
  View<double> v;
  v.p_at = b.p_at.data();
  v.n_c = b.sizes.constants;
  v.n_x = b.sizes.states;
  v.n_m = b.sizes.memory;
  v.n_u = b.n_u;
  v.n_y = b.sizes.outputs;
  v.key = b.key;
  v.t = call.view.t;
  v.branch = call.view.branch;
  v.series = b.series_index < 0 ? nullptr : series_[at(b.series_index)].get();
  v.u = u_.data();
  v.du = du_.data();
  for (int lane = 0; lane < Lanes::width; ++lane) {
    v.p = call.view.p + lane * b.p_at.back();
    v.c = c_.row(b.c_begin) + lane * v.n_c;
    v.x = call.view.x + lane * v.n_x;
    v.m = call.view.m + lane * v.n_m;
    for (int i = 0; i < b.n_u; ++i) u_[at(i)] = call.u[at(i)][lane];
    if (call.order == Order::rate || b.kernel->derivative_wants_rate)
      for (int i = 0; i < b.n_u; ++i) du_[at(i)] = call.du[at(i)][lane];
    if (call.order == Order::value) {
      value_of_lane(call, v, lane);
    } else if (call.order == Order::rate) {
      rate_of_lane(call, v, lane);
    } else {
      v.out = call.view.out + lane * v.n_x;
      b.kernel->derivative(v);
    }
  }
}

void LaneEvaluation::value_of_lane(const Call& call, View<double>& v, int lane) {
  const Kernel& kernel = *call.block->kernel;
  if (v.n_m > 0) {
    v.out = call.view.advanced + lane * v.n_m;
    kernel.advance(v);
    v.m = v.out;
  }
  v.out = out_.data();
  kernel.output(v);
  for (int i = 0; i < v.n_y; ++i) call.view.out[i * Lanes::width + lane] = out_[at(i)];
}

void LaneEvaluation::rate_of_lane(const Call& call, const View<double>& v, int lane) {
  const Kernel& kernel = *call.block->kernel;
  const BlockInstance& b = *call.block;
  View<Dual> r;
  for (int i = 0; i < b.p_at.back(); ++i) dual_p_[at(i)] = Dual(v.p[i]);
  for (int i = 0; i < v.n_u; ++i) dual_u_[at(i)] = {u_[at(i)], du_[at(i)]};
  for (int i = 0; i < v.n_x; ++i) dual_x_[at(i)] = {v.x[i], call.view.dx[lane * v.n_x + i]};
  for (int i = 0; i < v.n_m; ++i) dual_m_[at(i)] = Dual(v.m[i]);
  r.p = dual_p_.data();
  r.p_at = v.p_at;
  r.c = v.c;
  r.n_c = v.n_c;
  r.x = dual_x_.data();
  r.n_x = v.n_x;
  r.m = dual_m_.data();
  r.n_m = v.n_m;
  r.u = dual_u_.data();
  r.n_u = v.n_u;
  r.n_y = v.n_y;
  r.key = v.key;
  r.t = {v.t, 1.0};
  r.branch = v.branch;
  r.series = v.series;
  if (v.n_m > 0) {
    r.out = dual_advanced_.data();
    kernel.advance_rate(r);
    r.m = dual_advanced_.data();
  }
  r.out = dual_out_.data();
  kernel.output_rate(r);
  for (int i = 0; i < v.n_y; ++i) call.view.out[i * Lanes::width + lane] = dual_out_[at(i)].rate;
  if (is_source_of_time(b))
    for (int i = 0; i < v.n_y; ++i) call.view.values[i * Lanes::width + lane] = dual_out_[at(i)].value;
}

}  // namespace hysteron
