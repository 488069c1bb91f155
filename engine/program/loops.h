// Decides how an algebraic loop is solved inside an evaluation. Which blocks form one, and where it is cut:
// loop_plan.h.
//
// The tears v of a loop are numbers (values, or rates and derivatives) from which its steps make the same numbers anew:
// solved is r(v) = F(v) - v = 0.
//   1. The search starts at Run::warm, the solution at the last accepted point, never at that of the last trial: an
//      evaluation gives the same bits however often it is called. Of several solutions it finds one near there.
//   2. Newton with the exact slopes of F, eight tears at a time (Jet). At a kink (play operators, saturations) the
//      slope is that of the active piece: semismooth, so that a piecewise linear loop ends after as many pieces as it
//      visits.
//   3. Steps are shortened until the residual, measured in tolerances, falls.
//   4. A single tear also keeps the two nearest points where r has different signs: a step out of this bracket, or one
//      that does not bring r down, halves it instead. Where Newton finds none, the bracket is looked for at F(v) and in
//      doubling distances; so a continuous F that never rises with v is always solved, as is any whose r changes sign.
//   5. The error that is left is below loop_relative * |v|, a thousandth of what the integrator allows itself, with a
//      few roundings as floor; loop_absolute more only where another step does not help, because the terms of v cancel
//      (set_loop_accuracy). The last Newton step is taken without being checked, so what is really left is the square
//      of that.
//   6. Slopes through a solved loop (T = Jet) are those of the implicit function: (I - dF/dv) dv = dF/dx dx.
//   7. What cannot be solved makes the evaluation NaN, for which an integrator tries a smaller step; if that does not
//      help, throw_if_unsolved() tells the loop, its residuals and what to do.
// Nothing is allocated: LoopSolver is the scratch, one per Work.
#pragma once

#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// What it took to solve a loop, since construction.
struct LoopCounters {
  long solved = 0, failed = 0, evaluations = 0, bracketed = 0;
  int most_evaluations = 0;
  double worst_residual = 0;  ///< |F(v) - v| over the size of v, where it was left
};

struct LoopSolver {
  explicit LoopSolver(const Program& program);

  JetWork jets;  ///< evaluates the steps of a loop; slopes along the tears only
  std::vector<Jet> x;
  std::vector<LoopCounters> counters;  ///< per loop
  const Run* run = nullptr;            ///< of the present evaluation
  long evaluations = 0;                ///< of F, since construction
  bool outside_is_finite = true;

  // Of the last evaluation of F; the tears, the residual F(v) - v and I - dF/dv, row by row.
  std::vector<double> v, residual, slope;

  // Scratch.
  std::vector<double> trial, factors, scale, right, step, weight, best, best_residual;
  std::vector<int> pivots;
  std::vector<Jet> solved;
  double weakest = 1;  ///< smallest pivot of the last factorization, with rows and columns in units of the tears' sizes
  double best_norm = 0, best_weakest = 1;  ///< of a failed search: where the residual was smallest
  bool jumps = false;                      ///< the residual changes its sign without being zero
  bool bracketed = false;                  ///< the last search ended inside a bracket
};

/// Solves loop `index` at the point where `work` stands and carries out its steps. Sets work.unsolved if it fails.
template <class T>
void solve_loop(const Program& program, WorkOf<T>& work, int index, const T* x);

/// How exactly the loops of a run are solved: a thousandth of the integrator's tolerances (simulate.h), with sizes of
/// the signals from their sources. A run begins with those of the default tolerances.
void set_loop_accuracy(const Program& program, Run& run, double relative_tolerance, double absolute_tolerance);

/// Stores where the loops of values (or those of rates) stand in `work` as their next start.
void keep_loops(const Program& program, Run& run, const Work& work, bool values);

/// Throws Error(Fault::numerics) "loop_unsolved" if the last evaluation of `work`, at time t, failed to solve a loop:
/// the way around it, the residual of each tear, and the cures.
void throw_if_unsolved(const Program& program, const Work& work, double t);

}  // namespace hysteron
