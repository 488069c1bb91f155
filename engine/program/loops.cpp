#include "engine/program/loops.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/diagram/index.h"
#include "engine/program/loop_equations.h"
#include "engine/program/loop_plan.h"
#include "engine/program/loop_search.h"
#include "engine/program/nominal.h"
#include "engine/program/steps.h"

namespace hysteron {
namespace {

using namespace loop_equations;

constexpr double share_of_tolerance = 1e-3;  // well below what the integrator notices
constexpr double fold = 1e-3;                // weaker slopes than this where the search ended are called by their name

/// As search_loop(), and counts what it took.
bool solve_and_count(LoopSolver& s, const Program& program, int index) {
  const long before = s.evaluations;
  const bool solved = search_loop(s, program, program.loops[at(index)]);
  LoopCounters& c = s.counters[at(index)];
  const long took = s.evaluations - before;
  c.evaluations += took;
  c.most_evaluations = std::max(c.most_evaluations, static_cast<int>(took));
  ++(solved ? c.solved : c.failed);
  c.bracketed += solved && s.bracketed ? 1 : 0;
  return solved;
}

template <class T>
void give_up(const Program& program, WorkOf<T>& work, const Loop& loop) {
  const T none(std::numeric_limits<double>::quiet_NaN());
  for (const Step& step : loop.steps) {
    const BlockInstance& b = program.blocks[at(step.block)];
    if (step.order == Order::derivative)
      std::fill_n(work.dx.begin() + b.x_begin, b.sizes.states, none);
    else
      std::fill_n((step.order == Order::value ? work.y : work.rate).begin() + b.y_begin, b.sizes.outputs, none);
  }
}

/// The tears' slopes along the directions of `work`: what the steps make of the other slopes, through (I - F_v)^-1.
void find_slopes(LoopSolver& s, const Program& program, const Loop& loop, JetWork& work, const Jet* x) {
  const int n = static_cast<int>(loop.tears.size());
  steps::run(loop.steps, program, work, x);  // the tears stand still
  const bool regular = evaluate(s, program, loop) && factor(s, loop);
  for (int direction = 0; direction < Jet::directions; ++direction) {
    for (int i = 0; i < n; ++i) s.right[at(i)] = number(work, loop.tears[at(i)]).slope[direction];
    if (std::all_of(s.right.begin(), s.right.begin() + n, [](double r) { return r == 0; })) continue;
    if (regular)
      back_substitute(s, n);
    else
      std::fill_n(s.step.begin(), n, std::numeric_limits<double>::quiet_NaN());
    for (int i = 0; i < n; ++i) number(work, loop.tears[at(i)]).slope[direction] = s.step[at(i)];
  }
  for (int i = 0; i < n; ++i) number(work, loop.tears[at(i)]).value = s.v[at(i)];
}

}  // namespace

LoopSolver::LoopSolver(const Program& program)
    : jets(program, false), x(at(program.n_x)), counters(program.loops.size()) {
  std::size_t most = 0;
  for (const auto& loop : program.loops) most = std::max(most, loop.tears.size());
  for (auto* list : {&v, &residual, &trial, &scale, &right, &step, &weight, &best, &best_residual}) list->resize(most);
  slope.resize(most * most);
  factors.resize(most * most);
  pivots.resize(most);
  solved.resize(most);
}

template <class T>
void solve_loop(const Program& program, WorkOf<T>& work, int index, const T* x) {
  const Loop& loop = program.loops[at(index)];
  LoopSolver& s = *work.loops;
  take(s, program, loop, work, x);
  if (!s.outside_is_finite) return give_up(program, work, loop);  // the trouble lies elsewhere
  if (!solve_and_count(s, program, index)) {
    // A rate that only memory wished for is not missed for good: no reversal is seen at this instant.
    if (work.unsolved < 0 && loop.needed) work.unsolved = index;
    return give_up(program, work, loop);
  }
  for (std::size_t i = 0; i < loop.tears.size(); ++i) number(work, loop.tears[i]) = T(s.v[i]);
  if constexpr (std::is_same_v<T, Jet>) find_slopes(s, program, loop, work, x);
  if constexpr (std::is_same_v<T, Jet>)
    for (std::size_t i = 0; i < loop.tears.size(); ++i) s.solved[i] = number(work, loop.tears[i]);
  steps::run(loop.steps, program, work, x);
  // What is solved for is known better than what the steps make of it: with a high gain these magnify its rounding.
  for (std::size_t i = 0; i < loop.tears.size(); ++i) {
    if constexpr (std::is_same_v<T, Jet>) {
      number(work, loop.tears[i]) = s.solved[i];
    } else {
      T& made = number(work, loop.tears[i]);
      const double left = std::abs(made - s.v[i]);
      const double size = tolerance(s, loop, static_cast<int>(i)) / (s.run->loop_relative + roundings);
      double& worst = s.counters[at(index)].worst_residual;
      if (left > worst * size) worst = left / size;
      made = s.v[i];
    }
  }
}
template void solve_loop<double>(const Program&, WorkOf<double>&, int, const double*);
template void solve_loop<Jet>(const Program&, WorkOf<Jet>&, int, const Jet*);

void set_loop_accuracy(const Program& program, Run& run, double relative_tolerance, double absolute_tolerance) {
  if (program.loops.empty()) return;
  run.loop_relative = share_of_tolerance * relative_tolerance;
  const NominalSizes sizes = nominal_sizes(program, run);
  const double per_second = sizes.time_scale > 0 ? 1 / sizes.time_scale : 1.0;
  const auto length = parse_unit("m").dimension;
  for (const Loop& loop : program.loops)
    for (std::size_t i = 0; i < loop.tears.size(); ++i) {
      const Slot& slot = loop.tears[i];
      double size = 0;
      if (slot.order == Order::derivative) {
        size = sizes.states[at(slot.index)];
      } else {
        size = sizes.signals[at(slot.index)];
        if (!(size > 0)) size = program.signals[at(slot.index)].dimension == length ? usual_length : usual_size;
      }
      if (!loop.of_values()) size *= per_second;
      run.loop_absolute[at(loop.warm_begin) + i] = run.loop_relative * absolute_tolerance * size;
    }
}

void keep_loops(const Program& program, Run& run, const Work& work, bool values) {
  for (const Loop& loop : program.loops) {
    if (loop.of_values() != values || !loop.needed) continue;
    for (std::size_t i = 0; i < loop.tears.size(); ++i) run.warm[at(loop.warm_begin) + i] = number(work, loop.tears[i]);
  }
}

void throw_if_unsolved(const Program& program, const Work& work, double t) {
  if (work.unsolved < 0) return;
  const Loop& loop = program.loops[at(work.unsolved)];
  const LoopSolver& s = *work.loops;
  std::string text =
      fmt::format("no solution was found for the algebraic loop at t = {:.9g} s\n  {}", t, to_text(program, loop.path));
  const bool finite = std::isfinite(s.best_norm);
  for (std::size_t i = 0; i < loop.tears.size(); ++i) {
    const Slot& slot = loop.tears[i];
    const bool state = slot.order == Order::derivative;
    const SignalInfo* signal = state ? nullptr : &program.signals[at(slot.index)];
    const Unit unit = signal != nullptr ? signal->unit : Unit{};
    const std::string name = state ? program.state_names[at(slot.index)] : signal->path;
    const std::string kind = slot.order == Order::value  ? ""
                             : slot.order == Order::rate ? "rate of "
                                                         : "derivative of ";
    const std::string shown = (state ? "SI" : unit.text) + (slot.order == Order::value ? "" : state ? "" : "/s");
    const double start = s.run->warm[at(loop.warm_begin) + i];
    const auto show = [&](double si) {
      return slot.order == Order::value ? unit.from_si(si) : unit.difference_from_si(si);
    };
    text += finite
                ? fmt::format(
                      "\n  {}{}: from {:.6g} the search came to {:.6g} {}, where the blocks make {:.6g} of it "
                      "(residual {:.3g})",
                      kind, name, show(start), show(s.best[i]), shown, show(s.best[i] + s.best_residual[i]),
                      unit.difference_from_si(s.best_residual[i]))
                : fmt::format("\n  {}{}: at {:.6g} {}, where the search starts, the blocks make no finite number of it",
                              kind, name, show(start), shown);
  }
  if (s.jumps)
    text += "\n  what the blocks make jumps across that number: there is no value at which the loop agrees with itself";
  else if (finite && s.best_weakest < fold)
    text += fmt::format(
        "\n  the slope of the residual nearly vanishes there ({:.2g} of the loop's gain): a fold, behind which there "
        "is "
        "no solution, or a loop with gain one, which has none or any number",
        s.best_weakest);
  const Step& first = loop.path.front();
  fail_numerics(
      "loop_unsolved", program.blocks[at(first.block)].path, text,
      fmt::format(
          "give a start near the solution (\"simulate\": {{\"guess\": {{\"{}\": ...}}}}); or put a block with a "
          "state into the loop (a lag: the amplifier's or the sensor's dynamics), so that it is none any more; "
          "or use an explicit inverse block instead of the loop",
          loop.tears.front().order == Order::value ? program.signals[at(loop.tears.front().index)].path
                                                   : program.blocks[at(first.block)].path));
}

}  // namespace hysteron
