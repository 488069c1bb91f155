// Decides how the steps of a program are carried out: gather inputs, call the block, keep its outputs. Pure towards the
// run; accept() alone changes memory. Allocates nothing.
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/program.h"

namespace hysteron {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

void gather(const BlockInstance& b, Work& work) {
  double* u = work.u.data() + b.u_begin;
  for (int i = 0; i < b.n_u; ++i) u[i] = work.y[at(b.source[at(i)])];
}

View<double> trial_view(const Program& program, const Run& run, Work& work, int block, double t, const double* x) {
  const BlockInstance& b = program.blocks[at(block)];
  View<double> v = view_of(program, run, block);
  v.x = x + b.x_begin;
  v.t = t;
  v.u = work.u.data() + b.u_begin;
  return v;
}

void value_step(const Program& program, const Run& run, Work& work, int block, double t, const double* x) {
  const BlockInstance& b = program.blocks[at(block)];
  if (b.sizes.feedthrough) gather(b, work);
  View<double> v = trial_view(program, run, work, block, t, x);
  if (b.sizes.memory > 0) {
    v.out = work.m.data() + b.m_begin;
    b.kernel->advance(v);
    v.m = v.out;
  }
  v.out = work.y.data() + b.y_begin;
  b.kernel->output(v);
}

void derivative_step(const Program& program, const Run& run, Work& work, int block, double t, const double* x) {
  const BlockInstance& b = program.blocks[at(block)];
  gather(b, work);
  View<double> v = trial_view(program, run, work, block, t, x);
  if (b.kernel->derivative_wants_rate) {
    double* du = work.du_buffer.data() + b.u_begin;
    for (int i = 0; i < b.n_u; ++i) du[i] = work.rate[at(b.source[at(i)])];
    v.du = du;
  }
  v.out = work.dx.data() + b.x_begin;
  b.kernel->derivative(v);
}

/// The block's outputs once more, with every argument carrying its rate in time.
void rate_step(const Program& program, const Run& run, Work& work, int block, double t, const double* x) {
  const BlockInstance& b = program.blocks[at(block)];
  const View<double> plain = trial_view(program, run, work, block, t, x);
  for (int i = 0; i < b.p_at.back(); ++i) work.dual_p[at(i)] = plain.p[i];
  for (int i = 0; i < b.n_u; ++i) work.dual_u[at(i)] = {work.y[at(b.source[at(i)])], work.rate[at(b.source[at(i)])]};
  for (int i = 0; i < b.sizes.states; ++i) work.dual_x[at(i)] = {plain.x[i], work.dx[at(b.x_begin + i)]};
  View<Dual> v;
  v.p = work.dual_p.data();
  v.p_at = plain.p_at;
  v.c = plain.c;
  v.n_c = plain.n_c;
  v.x = work.dual_x.data();
  v.n_x = plain.n_x;
  v.n_m = plain.n_m;
  v.u = work.dual_u.data();
  v.n_u = plain.n_u;
  v.n_y = plain.n_y;
  v.t = {t, 1.0};
  v.branch = plain.branch;
  v.series = plain.series;
  v.history = plain.history;
  if (b.sizes.memory > 0) {
    for (int i = 0; i < b.sizes.memory; ++i) work.dual_m_committed[at(i)] = plain.m[i];
    v.m = work.dual_m_committed.data();
    v.out = work.dual_m.data();
    b.kernel->advance_rate(v);
    v.m = work.dual_m.data();
  }
  v.out = work.dual_out.data();
  b.kernel->output_rate(v);
  for (int i = 0; i < b.sizes.outputs; ++i) work.rate[at(b.y_begin + i)] = work.dual_out[at(i)].rate;
}

void run_steps(const std::vector<Step>& steps, const Program& program, const Run& run, Work& work, double t,
               const double* x) {
  for (const Step& step : steps) {
    switch (step.order) {
      case Order::value:
        value_step(program, run, work, step.block, t, x);
        break;
      case Order::rate:
        rate_step(program, run, work, step.block, t, x);
        break;
      case Order::derivative:
        derivative_step(program, run, work, step.block, t, x);
        break;
    }
  }
}

/// Appends a point to the past of a signal and forgets what no dead time can reach any more.
void remember(const Program& program, Run& run, Work& work, int block, double t) {
  const BlockInstance& b = program.blocks[at(block)];
  History& h = run.histories[at(b.history_index)];
  const auto signal = at(b.source[0]);
  const double u = work.y[signal];
  const double rate = program.has_rate[signal] ? work.rate[signal] : std::numeric_limits<double>::quiet_NaN();
  if (h.t.empty()) h.before = u;
  // At a corner the point stands twice, with the rates of both sides.
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  if (!h.t.empty() && h.t.back() == t && h.u.back() == u && same(h.rate.back(), rate)) return;
  h.t.push_back(t);
  h.u.push_back(u);
  h.rate.push_back(rate);
  if (!b.kernel->reach_back) return;
  // A time that meets a point but for rounding may still ask for the interval before it.
  const double rounding = 64 * std::numeric_limits<double>::epsilon() * std::abs(t);
  const double needed = t - b.kernel->reach_back(view_of(program, run, block)) - rounding;
  while (h.first + 2 < h.t.size() && h.t[h.first + 1] < needed) ++h.first;
  if (h.first < 4096) return;
  const auto cut = static_cast<std::ptrdiff_t>(h.first);
  h.t.erase(h.t.begin(), h.t.begin() + cut);
  h.u.erase(h.u.begin(), h.u.begin() + cut);
  h.rate.erase(h.rate.begin(), h.rate.begin() + cut);
  h.first = 0;
}

}  // namespace

Work::Work(const Program& program)
    : y(at(program.n_y)),
      u(at(program.n_u)),
      m(at(program.n_m)),
      dx(at(program.n_x)),
      du_buffer(at(program.n_u)),
      rate(at(program.n_y)) {
  std::size_t inputs = 0, states = 0, memory = 0, parameters = 0, outputs = 0;
  for (const auto& b : program.blocks) {
    inputs = std::max(inputs, at(b.n_u));
    states = std::max(states, at(b.sizes.states));
    memory = std::max(memory, at(b.sizes.memory));
    parameters = std::max(parameters, at(b.p_at.back()));
    outputs = std::max(outputs, at(b.sizes.outputs));
  }
  dual_u.resize(inputs);
  dual_x.resize(states);
  dual_m.resize(memory);
  dual_m_committed.resize(memory);
  dual_p.resize(parameters);
  dual_out.resize(outputs);
}

void evaluate_values(const Program& program, const Run& run, Work& work, double t, const double* x) {
  run_steps(program.all_values, program, run, work, t, x);
}

void evaluate_derivatives(const Program& program, const Run& run, Work& work, double t, const double* x) {
  run_steps(program.derivative_steps, program, run, work, t, x);
}

void evaluate_memory_rates(const Program& program, const Run& run, Work& work, double t, const double* x) {
  run_steps(program.rate_steps, program, run, work, t, x);
}

void accept(const Program& program, Run& run, Work& work, double t, const double* x) {
  if (program.n_histories > 0) {
    evaluate_derivatives(program, run, work, t, x);
    evaluate_memory_rates(program, run, work, t, x);
  }
  evaluate_values(program, run, work, t, x);
  for (std::size_t b = 0; b < program.blocks.size(); ++b)
    if (program.blocks[b].history_index >= 0) remember(program, run, work, static_cast<int>(b), t);
  std::copy(work.m.begin(), work.m.end(), run.m.begin());
  run.t = t;
}

}  // namespace hysteron
