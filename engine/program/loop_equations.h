// Decides how the equations of one loop are evaluated and their linear system is solved, with tears v and the residual
// r(v) = F(v) - v: what each step of the search (loop_search.h) is made of. Internal to engine/program.
#pragma once

#include <cmath>
#include <limits>

#include "engine/diagram/index.h"
#include "engine/program/loops.h"

namespace hysteron::loop_equations {

constexpr double roundings = 8 * std::numeric_limits<double>::epsilon();

template <class T>
T& number(WorkOf<T>& work, const Slot& slot) {
  auto& from = slot.order == Order::value ? work.y : slot.order == Order::rate ? work.rate : work.dx;
  return from[at(slot.index)];
}
inline double number(const Work& work, const Slot& slot) {
  const auto& from = slot.order == Order::value ? work.y : slot.order == Order::rate ? work.rate : work.dx;
  return from[at(slot.index)];
}

/// What stands outside the loop and what its blocks are made of, values only: slopes belong to the tears here.
template <class T>
void take(LoopSolver& s, const Program& program, const Loop& loop, WorkOf<T>& work, const T* x) {
  s.outside_is_finite = true;
  for (const Slot& slot : loop.outside) {
    const double value = value_of(number(work, slot));
    number(s.jets, slot) = Jet(value);
    s.outside_is_finite = s.outside_is_finite && std::isfinite(value);
  }
  const Run& run = *s.run;
  for (const int block : loop.blocks) {
    const BlockInstance& b = program.blocks[at(block)];
    for (int i = b.x_begin; i < b.x_begin + b.sizes.states; ++i) {
      s.x[at(i)] = Jet(value_of(x[i]));
      s.outside_is_finite = s.outside_is_finite && std::isfinite(s.x[at(i)].value);
    }
    for (int i = b.p_begin; i < b.p_begin + b.p_at.back(); ++i) s.jets.p[at(i)] = Jet(run.p[at(i)]);
    for (int i = b.m_begin; i < b.m_begin + b.memory_count(); ++i) s.jets.m_committed[at(i)] = Jet(run.m[at(i)]);
  }
}

/// F, its residual and its slopes at s.v. False where the residual is not finite.
bool evaluate(LoopSolver& s, const Program& program, const Loop& loop);

/// The error that tear i may keep.
inline double tight(const LoopSolver& s, int i) { return (s.run->loop_relative + roundings) * std::abs(s.v[at(i)]); }
/// The error with which it may be left where rounding allows no better: near zero, where terms of its size cancel.
inline double tolerance(const LoopSolver& s, const Loop& loop, int i) {
  return tight(s, i) + s.run->loop_absolute[at(loop.warm_begin + i)];
}

/// Factors the slopes: Gauss with row pivots. Rows and columns count in units of the tears' sizes, so that volts and
/// micrometres may stand in one loop. False if they are singular.
bool factor(LoopSolver& s, const Loop& loop);

/// s.step = (I - dF/dv)^-1 s.right, after factor(); `n` tears.
void back_substitute(LoopSolver& s, int n);

}  // namespace hysteron::loop_equations
