// Decides how one step of a program is carried out for one scalar: gather inputs, call the block, keep its outputs.
// Pure towards the run, allocates nothing. Internal to the engine; the ways through the steps are in evaluate.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/diagram/index.h"
#include "engine/program/loops.h"
#include "engine/program/program.h"

namespace hysteron::steps {

/// A linear block without a constant part: its rates are its outputs where states and inputs are replaced by their
/// rates. Leaves traces in the scratch only.
template <class T>
bool goes_through_zero(const BlockInstance& b, WorkOf<T>& work, View<T> v) {
  const auto& declaration = b.kernel->declaration;
  if (!declaration.is_linear || b.hit_index >= 0 || b.sizes.memory > 0) return false;
  for (const auto& parameter : declaration.parameters)
    if (parameter.is_offset) return false;
  T* u = work.u.data() + b.u_begin;
  T* x = work.dx.data() + b.x_begin;
  T* out = work.rate.data() + b.y_begin;
  std::fill_n(u, b.n_u, T(0.0));
  std::fill_n(x, b.sizes.states, T(0.0));
  v.u = u;
  v.x = x;
  v.out = out;
  b.kernel->template functions<T>().output(v);
  return std::all_of(out, out + b.sizes.outputs, [](const T& y) { return value_of(y) == 0; });
}

/// Points the views at the numbers of `run`. A run keeps its arrays, so this is done once per run and work.
template <class T>
void bind(const Program& program, const Run& run, WorkOf<T>& work) {
  for (std::size_t i = 0; i < program.blocks.size(); ++i) {
    const BlockInstance& b = program.blocks[i];
    View<T>& v = work.views[i];
    if constexpr (std::is_same_v<T, double>) {
      v.p = run.p.data() + b.p_begin;
      v.m = run.m.data() + b.m_begin;
    } else {
      v.p = work.p.data() + b.p_begin;
      v.m = work.m_committed.data() + b.m_begin;
    }
    v.p_at = work.calls[i].source + b.n_u;
    v.c = run.c.data() + b.c_begin;
    v.n_c = b.sizes.constants;
    v.n_x = b.hit_index < 0 ? b.sizes.states : b.sizes.sampled_states;
    v.n_m = b.sizes.memory;
    v.n_u = b.n_u;
    v.n_y = b.sizes.outputs;
    v.key = b.key;
    v.u = b.adjacent >= 0 ? work.y.data() + b.adjacent : work.u.data() + b.u_begin;
    v.du = b.adjacent >= 0 ? work.rate.data() + b.adjacent : work.du.data() + b.u_begin;
    v.history = b.history_index < 0 ? nullptr : &run.histories[at(b.history_index)];
    if (work.rate_views.empty()) continue;
    work.calls[i].output_rate = goes_through_zero(b, work, v) ? nullptr : b.kernel->template functions<T>().output_rate;
    View<DualOf<T>>& r = work.rate_views[i];
    r.p = work.dual_p.data() + b.p_begin;
    r.x = work.dual_x.data();
    r.u = work.dual_u.data();
    r.out = work.dual_out.data();
    r.p_at = v.p_at;
    r.c = v.c;
    r.n_c = v.n_c;
    r.n_x = v.n_x;
    r.n_m = v.n_m;
    r.n_u = v.n_u;
    r.n_y = v.n_y;
    r.key = v.key;
    r.history = v.history;
  }
}

/// Before the steps of one evaluation: what depends on the run, on the time and on the present modes.
template <class T>
void begin(const Program& program, const Run& run, WorkOf<T>& work, double t) {
  const std::array<const void*, 4> arrays{run.p.data(), run.c.data(), run.m.data(), run.histories.data()};
  bool bound = true;  // written out: the comparison of arrays is a call of memcmp
  for (std::size_t i = 0; i < arrays.size(); ++i) bound = bound && work.bound_to[i] == arrays[i];
  if (!bound) {
    bind(program, run, work);
    work.bound_to = arrays;
  }
  for (const int block : program.time_blocks) {
    View<T>& v = work.views[at(block)];
    v.t = t;
    v.branch = run.branch;
    if (const int series = program.blocks[at(block)].series_index; series >= 0) v.series = run.series[at(series)].get();
  }
  for (const int block : program.modal_blocks)
    work.views[at(block)].mode = run.mode[at(program.blocks[at(block)].mode_index)];
  if (program.n_sides > 0)
    for (const int block : program.kinked_blocks)
      if (const int sides = program.blocks[at(block)].sides_index; sides >= 0)
        work.views[at(block)].sides = run.sides.empty() ? nullptr : run.sides.data() + sides;
  work.unsolved = -1;
  if (work.loops) {
    work.loops->run = &run;
    work.loops->jets.path = work.path;
    begin(program, run, work.loops->jets, t);
  }
}

template <class T>
void gather(const BlockInstance& b, const std::vector<T>& from, T* to) {
  if (b.adjacent >= 0) return;
  for (int i = 0; i < b.n_u; ++i) to[i] = from[at(b.source[at(i)])];
}

/// Forgets what no dead time of `reach_back` [s] asks for at t or later.
inline void forget(History& h, double t, double reach_back) {
  // A time that meets a point but for rounding may still ask for the interval before it.
  const double rounding = 64 * std::numeric_limits<double>::epsilon() * std::abs(t);
  const double needed = t - reach_back - rounding;
  while (h.first + 2 < h.t.size() && h.t[h.first + 1] < needed) ++h.first;
  if (h.first < 4096) return;
  const auto cut = static_cast<std::ptrdiff_t>(h.first);
  h.t.erase(h.t.begin(), h.t.begin() + cut);
  h.u.erase(h.u.begin(), h.u.begin() + cut);
  h.rate.erase(h.rate.begin(), h.rate.begin() + cut);
  h.first = 0;
}

/// Outputs of a block that jumps, on the way from old to new.
template <class T>
void between(const BlockInstance& b, const PathPoint& path, std::vector<T>& y) {
  for (int i = b.y_begin; i < b.y_begin + b.sizes.outputs; ++i)
    y[at(i)] = path.from[i] + path.s * (path.to[i] - path.from[i]);
}

/// Is the block switched off in this evaluation?
template <class T>
bool is_off(const WorkOf<T>& work, int block) {
  const int by = work.calls[at(block)].enabled_by;
  return by >= 0 && !runs_in_mode(work.views[at(by)].mode);
}

/// Outputs and memory of a block that is switched off: as they were.
template <class T>
void stay(const BlockInstance& b, WorkOf<T>& work, const T* committed) {
  std::copy_n(committed + (b.held_while_off - b.m_begin), b.sizes.outputs, work.y.data() + b.y_begin);
  std::copy_n(committed, b.sizes.memory, work.m.data() + b.m_begin);
}

/// The value of a block that remembers, is sampled, or may be on the path of a jump.
template <class T>
void special_value(const Program& program, WorkOf<T>& work, int block, const T* x) {
  const BlockInstance& b = program.blocks[at(block)];
  View<T>& v = work.views[at(block)];
  if (work.path != nullptr && work.path->jumping[block] != 0) return between(b, *work.path, work.y);
  if (is_off(work, block)) return stay(b, work, v.m);
  if (b.hit_index >= 0 && (work.due == nullptr || work.due[b.hit_index] == 0)) {  // holds its outputs
    std::copy_n(v.m + b.sizes.sampled_states, b.sizes.outputs, work.y.data() + b.y_begin);
    return;
  }
  const Functions<T>& call = b.kernel->template functions<T>();
  if (b.sizes.feedthrough) gather(b, work.y, work.u.data() + b.u_begin);
  v.x = b.hit_index < 0 ? x + b.x_begin : v.m;
  if (b.sizes.memory > 0) {
    const T* committed = v.m;
    v.out = work.m.data() + b.m_begin;
    call.advance(v);
    v.m = v.out;
    v.out = work.y.data() + b.y_begin;
    call.output(v);
    v.m = committed;
    return;
  }
  v.out = work.y.data() + b.y_begin;
  call.output(v);
}

template <class T>
void value(const Program& program, WorkOf<T>& work, int block, const T* x) {
  const auto& call = work.calls[at(block)];
  if (!call.plain || work.path != nullptr) return special_value(program, work, block, x);
  View<T>& v = work.views[at(block)];
  T* y = work.y.data();
  T* u = work.u.data() + call.u_begin;
  for (int i = 0; i < call.output_inputs; ++i) u[i] = y[call.source[i]];
  v.x = x + call.x_begin;
  v.out = y + call.y_begin;
  call.output(v);
}

template <class T>
void derivative(WorkOf<T>& work, int block, const T* x) {
  const auto& call = work.calls[at(block)];
  View<T>& v = work.views[at(block)];
  T* dx = work.dx.data() + call.x_begin;
  if ((work.path != nullptr && work.path->rate_independent[block] == 0) || is_off(work, block)) {
    std::fill_n(dx, v.n_x, T(0.0));
    return;
  }
  T* u = work.u.data() + call.u_begin;
  for (int i = 0; i < call.inputs; ++i) u[i] = work.y[at(call.source[i])];
  if (call.wants_rate) {
    T* du = work.du.data() + call.u_begin;
    for (int i = 0; i < call.inputs; ++i) du[i] = work.rate[at(call.source[i])];
  }
  v.x = x + call.x_begin;
  v.out = dx;
  call.derivative(v);
}

/// The rates of a block that jumps or holds, on the path of a jump, between instants and where it is switched off.
template <class T>
bool special_rate(const Program& program, WorkOf<T>& work, int block) {
  const BlockInstance& b = program.blocks[at(block)];
  if (work.path != nullptr && work.path->jumping[block] != 0) {
    if (work.calls[at(block)].source_only) between(b, *work.path, work.y);
    for (int i = b.y_begin; i < b.y_begin + b.sizes.outputs; ++i)
      work.rate[at(i)] = (work.path->to[i] - work.path->from[i]) / jump_duration;
    return true;
  }
  const bool off = is_off(work, block);
  if (off) stay(b, work, work.views[at(block)].m);
  if (b.hit_index < 0 && !off) return false;
  std::fill_n(work.rate.data() + b.y_begin, b.sizes.outputs, T(0.0));
  return true;
}

/// The block's outputs once more, with every argument carrying its rate in time. Of a source also its values: its rate
/// step stands in place of its value step (order.cpp).
template <class T>
void rate(const Program& program, WorkOf<T>& work, int block, const T* x) {
  const auto& call = work.calls[at(block)];
  if ((!call.plain || work.path != nullptr) && special_rate(program, work, block)) return;
  View<T>& plain = work.views[at(block)];
  if (call.output_rate == nullptr) {
    T* du = work.du.data() + call.u_begin;
    for (int i = 0; i < call.output_inputs; ++i) du[i] = work.rate[at(call.source[i])];
    const T* inputs = plain.u;
    plain.u = plain.du;
    plain.x = work.dx.data() + call.x_begin;
    plain.out = work.rate.data() + call.y_begin;
    call.output(plain);
    plain.u = inputs;
    return;
  }
  View<DualOf<T>>& v = work.rate_views[at(block)];
  DualOf<T>* p = work.dual_p.data() + call.p_begin;  // their rates are and stay zero
  for (int i = 0; i < call.parameters; ++i) p[i].value = plain.p[i];
  for (int i = 0; i < v.n_u; ++i) {
    const auto source = at(call.source[i]);
    work.dual_u[at(i)] = {work.y[source], work.rate[source]};
  }
  for (int i = 0; i < v.n_x; ++i) work.dual_x[at(i)] = {x[call.x_begin + i], work.dx[at(call.x_begin + i)]};
  if (call.timed) {
    v.t = {plain.t, T(work.path == nullptr ? 1.0 : 0.0)};
    v.branch = plain.branch;
    v.series = plain.series;
  }
  v.mode = plain.mode;
  if (v.n_m > 0) {
    for (int i = 0; i < v.n_m; ++i) work.dual_m_committed[at(i)] = plain.m[i];
    v.m = work.dual_m_committed.data();
    v.out = work.dual_m.data();
    program.blocks[at(block)].kernel->template functions<T>().advance_rate(v);
    v.m = work.dual_m.data();
    v.out = work.dual_out.data();
  }
  call.output_rate(v);
  for (int i = 0; i < v.n_y; ++i) work.rate[at(call.y_begin + i)] = work.dual_out[at(i)].rate;
  if (call.source_only)
    for (int i = 0; i < v.n_y; ++i) work.y[at(call.y_begin + i)] = work.dual_out[at(i)].value;
}

template <class T>
void run(const std::vector<Step>& steps, const Program& program, WorkOf<T>& work, const T* x) {
  for (const Step& step : steps) {
    switch (step.order) {
      case Order::value:
        value(program, work, step.block, x);
        break;
      case Order::rate:
        rate(program, work, step.block, x);
        break;
      case Order::derivative:
        derivative(work, step.block, x);
        break;
      case Order::loop:
        solve_loop(program, work, step.block, x);
        break;
    }
  }
}

/// Guards of all blocks with modes, from values and rates that are there.
template <class T>
void guards(const Program& program, WorkOf<T>& work, const T* x) {
  for (std::size_t i = 0; i < program.modal_blocks.size(); ++i) {
    const int block = program.modal_blocks[i];
    const BlockInstance& b = program.blocks[at(block)];
    View<T>& v = work.views[at(block)];
    if (is_off(work, block)) {
      work.guard[i] = T(1.0);
      continue;
    }
    gather(b, work.y, work.u.data() + b.u_begin);
    if (b.kernel->guard_wants_rate) gather(b, work.rate, work.du.data() + b.u_begin);
    v.x = x + b.x_begin;
    v.out = work.guard.data() + i;
    b.kernel->template functions<T>().guard(v);
  }
}

}  // namespace hysteron::steps
