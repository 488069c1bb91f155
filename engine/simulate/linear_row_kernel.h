// Decides how dx/dt is computed for one set of parameter values: as evaluate_derivatives() does, but with the linear
// blocks as weighted sums. Each number that a linear block makes is a row: a constant and weights for states, values,
// rates and derivatives. A number that only rows read, and that costs less written into them than it costs itself, has
// none of its own. What is not linear, remembers, changes with time or closes a loop is called as before.
// Sources of time are asked once where several evaluations in a row are at one instant (two of four stages of
// Runge-Kutta's formula, the iterations of an implicit step).
// Rows are read off the blocks' functions once, so parameters must not change while it is used; numbers differ from
// those of evaluate_derivatives() by rounding only. Values and rates that nobody but rows needs are not made: who wants
// signals evaluates values.
#pragma once

#include <vector>

#include "engine/program/program.h"

namespace hysteron {

class LinearRowKernel {
 public:
  /// Keeps references to the program and to `work`, which must stay where it is, its arrays too.
  LinearRowKernel(const Program& program, const Run& run, Work& work);

  /// Sets work.dx, and work.unsolved as evaluate_derivatives() does. `run` has the parameters and series of the
  /// construction.
  void operator()(const Run& run, double t, const double* x);

  /// A source is another at the instant of the last call: an input of the diagram was set.
  void forget();

  int rows() const { return static_cast<int>(rows_.size()); }
  int terms() const { return static_cast<int>(terms_.size()); }
  int calls() const;  ///< of block functions and loops that are left

 private:
  struct Term {
    double weight;
    const double* number;
  };
  struct Row {
    double constant;
    double* target;
    int terms;
  };
  /// Rows of this stretch, then one step.
  struct Stretch {
    int rows_end = 0;
    Step step;
    bool has_step = false;
    int source = -1;  ///< into sources_, of a source of time
  };

  const Program& program_;
  Work& work_;
  std::vector<double> x_;
  std::vector<Term> terms_;
  std::vector<Row> rows_;
  std::vector<Stretch> stretches_;
  /// Where the numbers of a source stand in `work`, and what they were at the last instant.
  struct Source {
    double *value, *rate;
    int count, kept;
  };
  std::vector<Source> sources_;
  std::vector<double> kept_;  // values, then rates, of one source after the other
  double kept_t_, kept_branch_;
};

}  // namespace hysteron
