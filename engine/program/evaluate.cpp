// Decides the ways through the steps of a program, for values, derivatives, rates and guards. Pure towards the run;
// accept() alone changes memory. Allocates nothing.
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/diagram/index.h"
#include "engine/program/histories.h"
#include "engine/program/loops.h"
#include "engine/program/program.h"
#include "engine/program/steps.h"

namespace hysteron {
namespace {

/// Where a loop was not solved nothing may look like a result: a saturation behind it would make numbers of its NaN.
template <class T>
void spoil_if_unsolved(const WorkOf<T>& work, std::vector<T>& results) {
  if (work.unsolved >= 0) std::fill(results.begin(), results.end(), T(std::numeric_limits<double>::quiet_NaN()));
}

bool computes_rates(const Program& program) {
  const auto any = [](const std::vector<Step>& steps) {
    return std::any_of(steps.begin(), steps.end(), [](const Step& step) { return step.order == Order::rate; });
  };
  return any(program.derivative_steps) || any(program.rate_steps) ||
         std::any_of(program.loops.begin(), program.loops.end(), [&](const Loop& loop) { return any(loop.steps); });
}

template <class T>
void list_calls(const Program& program, WorkOf<T>& work) {
  std::size_t numbers = 0;
  for (const auto& b : program.blocks) numbers += b.source.size() + b.p_at.size();
  work.lists.reserve(numbers);  // pointers into it are kept
  work.calls.reserve(program.blocks.size());
  for (const auto& b : program.blocks) {
    const Functions<T>& functions = b.kernel->template functions<T>();
    typename WorkOf<T>::Call call;
    call.output = functions.output;
    call.derivative = functions.derivative;
    call.source = work.lists.data() + work.lists.size();
    work.lists.insert(work.lists.end(), b.source.begin(), b.source.end());
    work.lists.insert(work.lists.end(), b.p_at.begin(), b.p_at.end());
    call.inputs = b.adjacent >= 0 ? 0 : b.n_u;
    call.output_inputs = b.sizes.feedthrough ? call.inputs : 0;
    call.u_begin = b.u_begin;
    call.x_begin = b.x_begin;
    call.y_begin = b.y_begin;
    call.p_begin = b.p_begin;
    call.parameters = b.p_at.back();
    call.plain = b.hit_index < 0 && b.sizes.memory == 0 && b.enabling < 0;
    if (b.enabling >= 0) call.enabled_by = program.enablings[at(b.enabling)].block;
    call.wants_rate = b.kernel->derivative_wants_rate;
    call.source_only = is_source_of_time(b);
    work.calls.push_back(call);
  }
  for (const int block : program.time_blocks) work.calls[at(block)].timed = true;
}

}  // namespace

template <class T>
WorkOf<T>::WorkOf(const Program& program, bool with_loops)
    : y(at(program.n_y)),
      rate(at(program.n_y)),
      dx(at(program.n_x)),
      m(at(program.n_m)),
      guard(program.modal_blocks.size()),
      u(at(program.n_u)),
      du(at(program.n_u)),
      views(program.blocks.size()) {
  // Not null: of a program without parameters, constants, memory and past the arrays of a run are null themselves.
  bound_to[0] = this;
  std::size_t inputs = 0, states = 0, memory = 0, outputs = 0;
  for (const auto& b : program.blocks) {
    inputs = std::max(inputs, at(b.n_u));
    states = std::max(states, at(b.sizes.states));
    memory = std::max(memory, at(b.sizes.memory));
    outputs = std::max(outputs, at(b.sizes.outputs));
  }
  dual_u.resize(inputs);
  dual_x.resize(states);
  dual_m.resize(memory);
  dual_m_committed.resize(memory);
  dual_out.resize(outputs);
  if (computes_rates(program)) {
    dual_p.resize(at(program.n_p));
    rate_views.resize(program.blocks.size());
  }
  list_calls(program, *this);
  if constexpr (!std::is_same_v<T, double>) {
    p.resize(at(program.n_p));
    m_committed.resize(at(program.n_m));
  }
  if (with_loops && !program.loops.empty()) loops = std::make_unique<LoopSolver>(program);
}

template <class T>
WorkOf<T>::~WorkOf() = default;
template <class T>
WorkOf<T>::WorkOf(WorkOf&&) noexcept = default;
template <class T>
WorkOf<T>& WorkOf<T>::operator=(WorkOf&&) noexcept = default;

template <class T>
void WorkOf<T>::refresh(const Run& run) requires(!std::is_same_v<T, double>) {
  for (std::size_t i = 0; i < p.size(); ++i) p[i].value = run.p[i];
  for (std::size_t i = 0; i < m_committed.size(); ++i) m_committed[i].value = run.m[i];
}

template <class T>
void evaluate_values(const Program& program, const Run& run, WorkOf<T>& work, double t, const T* x) {
  steps::begin(program, run, work, t);
  steps::run(program.all_values, program, work, x);
  spoil_if_unsolved(work, work.y);
}

template <class T>
void evaluate_derivatives(const Program& program, const Run& run, WorkOf<T>& work, double t, const T* x) {
  steps::begin(program, run, work, t);
  steps::run(program.derivative_steps, program, work, x);
  spoil_if_unsolved(work, work.dx);
}

template <class T>
void evaluate_memory_rates(const Program& program, const Run& run, WorkOf<T>& work, double t, const T* x) {
  steps::begin(program, run, work, t);
  steps::run(program.rate_steps, program, work, x);
}

template <class T>
void evaluate_guards(const Program& program, const Run& run, WorkOf<T>& work, double t, const T* x) {
  steps::begin(program, run, work, t);
  steps::run(program.all_values, program, work, x);
  steps::run(program.derivative_steps, program, work, x);
  steps::run(program.rate_steps, program, work, x);
  steps::guards(program, work, x);
  spoil_if_unsolved(work, work.guard);
}

template struct WorkOf<double>;
template struct WorkOf<Jet>;
#define HYSTERON_EVALUATE(T)                                                                        \
  template void evaluate_values<T>(const Program&, const Run&, WorkOf<T>&, double, const T*);       \
  template void evaluate_derivatives<T>(const Program&, const Run&, WorkOf<T>&, double, const T*);  \
  template void evaluate_memory_rates<T>(const Program&, const Run&, WorkOf<T>&, double, const T*); \
  template void evaluate_guards<T>(const Program&, const Run&, WorkOf<T>&, double, const T*);
HYSTERON_EVALUATE(double)
HYSTERON_EVALUATE(Jet)
#undef HYSTERON_EVALUATE

void commit_memory(const Program& program, Run& run, const Work& work) {
  keep_loops(program, run, work, true);
  for (const int block : program.memory_blocks) {
    const BlockInstance& b = program.blocks[at(block)];
    std::copy_n(work.m.begin() + b.m_begin, b.sizes.memory, run.m.begin() + b.m_begin);
  }
}

void accept(const Program& program, Run& run, Work& work, double t, const double* x) {
  if (program.n_histories > 0 || program.has_rate_loops()) {
    evaluate_derivatives(program, run, work, t, x);
    throw_if_unsolved(program, work, t);
    evaluate_memory_rates(program, run, work, t, x);
    throw_if_unsolved(program, work, t);
    keep_loops(program, run, work, false);
  }
  evaluate_values(program, run, work, t, x);
  throw_if_unsolved(program, work, t);
  if (program.n_histories > 0) remember_signals(program, run, work, t);
  commit_memory(program, run, work);
  run.t = t;
}

}  // namespace hysteron
