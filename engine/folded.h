// Decides how dx/dt is computed for one set of parameter values: as evaluate_derivatives() does, but with the linear
// blocks as weighted sums. Each number that a linear block makes is a row: a constant and weights for states, values,
// rates and derivatives. A number that only rows read, and that costs less written into them than it costs itself, has
// none of its own. What is not linear, remembers, changes with time or closes a loop is called as before.
// Rows are read off the blocks' functions once, so parameters must not change while it is used; numbers differ from
// those of evaluate_derivatives() by rounding only. Values and rates that nobody but rows needs are not made: who wants
// signals evaluates values.
#pragma once

#include <vector>

#include "engine/program.h"

namespace hysteron {

class FoldedDerivative {
 public:
  /// Keeps references to the program and to `work`, which must stay where it is, its arrays too.
  FoldedDerivative(const Program& program, const Run& run, Work& work);

  /// Sets work.dx, and work.unsolved as evaluate_derivatives() does. `run` has the parameters of the construction.
  void operator()(const Run& run, double t, const double* x);

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
    int end;  // of its terms
  };
  /// Rows of this stretch, then one step.
  struct Stretch {
    int rows_end = 0;
    Step step;
    bool has_step = false;
  };

  const Program& program_;
  Work& work_;
  std::vector<double> x_;
  std::vector<Term> terms_;
  std::vector<Row> rows_;
  std::vector<Stretch> stretches_;
};

}  // namespace hysteron
