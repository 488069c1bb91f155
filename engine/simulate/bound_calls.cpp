#include "engine/simulate/bound_calls.h"

#include "engine/diagram/index.h"
#include "engine/program/steps.h"

namespace hysteron {

BoundCalls::Call* BoundCalls::add(const Step& step) {
  if (step.order == Order::loop) return nullptr;
  const auto& of_block = work_.calls[at(step.block)];
  if (of_block.enabled_by >= 0 || (step.order != Order::derivative && !of_block.plain)) return nullptr;
  Call& call = calls_.emplace_back();
  call.step = step;
  call.series = program_.blocks[at(step.block)].series_index;
  return &call;
}

void BoundCalls::bind(const Run& run) {
  steps::begin(program_, run, work_, run.t);  // binds the views of `work`, from which these are made
  timed_.clear();
  moded_.clear();
  sided_.clear();
  duals_.clear();
  for (Call& call : calls_) {
    const int block = call.step.block;
    call.view = work_.views[at(block)];
    call.view.x = x_ + work_.calls[at(block)].x_begin;
    call.dual = nullptr;
    call.before.clear();
    call.behind.clear();
    if (call.step.order == Order::rate)
      bind_rate(call);
    else
      bind_plain(call);
    follow(call);
  }
  bound_to_ = {run.p.data(), run.c.data(), run.m.data(), run.histories.data()};
}

void BoundCalls::copy_inputs(Call& call, const BlockInstance& b, const std::vector<double>& from, double* to) {
  if (b.adjacent >= 0) return;
  for (int i = 0; i < b.n_u; ++i) call.before.push_back({to + i, from.data() + b.source[at(i)]});
}

void BoundCalls::bind_plain(Call& call) {
  const BlockInstance& b = program_.blocks[at(call.step.block)];
  const auto& of_block = work_.calls[at(call.step.block)];
  const bool of_state = call.step.order == Order::derivative;
  call.function = of_state ? of_block.derivative : of_block.output;
  call.view.out = of_state ? work_.dx.data() + b.x_begin : work_.y.data() + b.y_begin;
  if (of_state || b.sizes.feedthrough) copy_inputs(call, b, work_.y, work_.u.data() + b.u_begin);
  for (int i = 0; of_block.source_only && i < b.sizes.outputs; ++i)
    call.behind.push_back({call.view.out + i, call.view.out + i});
  if (of_state && of_block.wants_rate) copy_inputs(call, b, work_.rate, work_.du.data() + b.u_begin);
}

void BoundCalls::bind_rate(Call& call) {
  const BlockInstance& b = program_.blocks[at(call.step.block)];
  const auto& of_block = work_.calls[at(call.step.block)];
  if (of_block.output_rate != nullptr) return bind_dual(call);
  // Linear without a constant part: its rates are its outputs at rates in place of numbers.
  call.function = of_block.output;
  if (b.sizes.feedthrough) copy_inputs(call, b, work_.rate, work_.du.data() + b.u_begin);
  call.view.u = call.view.du;
  call.view.x = work_.dx.data() + b.x_begin;
  call.view.out = work_.rate.data() + b.y_begin;
}

void BoundCalls::bind_dual(Call& call) {
  const BlockInstance& b = program_.blocks[at(call.step.block)];
  const auto& of_block = work_.calls[at(call.step.block)];
  DualCall& d = duals_.emplace_back();
  call.dual = &d;
  const int states = call.view.n_x, outputs = call.view.n_y;
  d.numbers.resize(at(of_block.parameters + b.n_u + states + outputs));
  Dual* p = d.numbers.data();
  Dual* u = p + of_block.parameters;
  Dual* x = u + b.n_u;
  Dual* out = x + states;
  for (int i = 0; i < of_block.parameters; ++i) p[i].value = call.view.p[i];
  for (int i = 0; i < b.n_u; ++i) {
    call.before.push_back({&u[i].value, work_.y.data() + b.source[at(i)]});
    call.before.push_back({&u[i].rate, work_.rate.data() + b.source[at(i)]});
  }
  for (int i = 0; i < states; ++i) {
    call.before.push_back({&x[i].value, x_ + b.x_begin + i});
    call.before.push_back({&x[i].rate, work_.dx.data() + b.x_begin + i});
  }
  for (int i = 0; i < outputs; ++i) {
    call.behind.push_back({work_.rate.data() + b.y_begin + i, &out[i].rate});
    if (of_block.source_only) call.behind.push_back({work_.y.data() + b.y_begin + i, &out[i].value});
  }
  d.function = of_block.output_rate;
  d.view = work_.rate_views[at(call.step.block)];
  d.view.p = p;
  d.view.u = u;
  d.view.x = x;
  d.view.out = out;
}

/// What evaluations set in the views of this call.
void BoundCalls::follow(Call& call) {
  const BlockInstance& b = program_.blocks[at(call.step.block)];
  View<Dual>* dual = call.dual == nullptr ? nullptr : &call.dual->view;
  const auto& of_block = work_.calls[at(call.step.block)];
  if (of_block.timed && !of_block.source_only) timed_.push_back(&call);
  if (b.mode_index >= 0) moded_.push_back({dual == nullptr ? &call.view.mode : &dual->mode, b.mode_index});
  if (b.sides_index >= 0 && dual == nullptr) sided_.push_back({&call.view.sides, b.sides_index});
}

void BoundCalls::set_time(Call& call, const Run& run, double t) {
  const Series* series = call.series >= 0 ? run.series[at(call.series)].get() : call.view.series;
  if (call.dual != nullptr) {
    View<Dual>& view = call.dual->view;
    view.t = {t, 1.0};
    view.branch = run.branch;
    view.series = series;
  } else {
    call.view.t = t;
    call.view.branch = run.branch;
    call.view.series = series;
  }
}

namespace {

/// set(t) puts the time into what the function sees.
template <class Set, class Function>
void ask_at(std::span<const double> instants, const std::vector<BoundCalls::Copy>& results, double* numbers,
            std::size_t stride, const Set& set, const Function& function) {
  const std::size_t count = results.size();
  const BoundCalls::Copy* const result = results.data();
  for (const double t : instants) {
    set(t);
    function();
    for (std::size_t i = 0; i < count; ++i) numbers[i] = *result[i].from;
    numbers += stride;
  }
}

}  // namespace

std::size_t BoundCalls::ask(Call& call, const Run& run, std::span<const double> instants, double* numbers,
                            std::size_t stride) {
  set_time(call, run, run.t);
  if (DualCall* const dual = call.dual; dual != nullptr)
    ask_at(
        instants, call.behind, numbers, stride, [dual](double t) { dual->view.t.value = t; },
        [dual] { dual->function(dual->view); });
  else
    ask_at(
        instants, call.behind, numbers, stride, [&call](double t) { call.view.t = t; },
        [&call] { call.function(call.view); });
  return call.behind.size();
}

}  // namespace hysteron
