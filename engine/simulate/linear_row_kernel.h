// Decides how dx/dt is computed for one set of parameter values: as evaluate_derivatives() does, but with the linear
// blocks as weighted sums. Each number that a linear block makes is a row: a constant and weights for states, values,
// rates and derivatives. A number that only rows read, and that costs less written into them than it costs itself, has
// none of its own. What is not linear, remembers, changes with time or closes a loop is called as before.
// Sources of time are asked once where several evaluations in a row are at one instant (two of four stages of
// Runge-Kutta's formula, the iterations of an implicit step), and ahead where the instants are known.
// Rows are read off the blocks' functions once, so parameters must not change while it is used; numbers differ from
// those of evaluate_derivatives() by rounding only. Values and rates that nobody but rows needs are not made: who wants
// signals evaluates values.
#pragma once

#include <span>
#include <vector>

#include "engine/program/program.h"
#include "engine/simulate/bound_calls.h"

namespace hysteron {

class LinearRowKernel {
 public:
  /// Keeps references to the program and to `work`, which must stay where it is, its arrays too.
  LinearRowKernel(const Program& program, const Run& run, Work& work);
  LinearRowKernel(const LinearRowKernel&) = delete;
  LinearRowKernel& operator=(const LinearRowKernel&) = delete;

  /// Sets work.dx, and work.unsolved as evaluate_derivatives() does. `run` has the parameters and series of the
  /// construction.
  void operator()(const Run& run, double t, const double* x);
  /// The same where the caller has written the states into states(), which keeps them.
  void operator()(const Run& run, double t);
  double* states() { return x_.data(); }

  /// Sources of time will be asked for at these instants, in this order [s], while run.branch is what it is: asks them
  /// now, at once. One behind the other they take half the time, since nothing waits for them. An instant that does not
  /// come, or one that comes unforetold, changes nothing but the time that it takes.
  void foretell(const Run& run, std::span<const double> instants);
  bool has_sources() const { return !sources_.empty(); }

  /// A source is another at an instant that was asked for: an input of the diagram was set.
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
  /// Rows that have equally many terms, or a step.
  struct Piece {
    void (*carry_out)(const Piece&) = nullptr;
    const Row *first = nullptr, *last = nullptr;
    const Term* term = nullptr;               ///< of the first row
    int terms = 0;                            ///< of each row
    const BoundCalls::Call* bound = nullptr;  ///< of a step that is nothing but a call
    Step of{};
    LinearRowKernel* kernel = nullptr;
  };
  void add_row(const Row& row);
  void add_step(const Step& step);
  template <int width>
  static void add_up(const Piece& piece);
  static void add_up_long(const Piece& piece);
  static void call(const Piece& piece);
  static void call_function(const Piece& piece);
  static void step(const Piece& piece);
  void ask_sources(const Run& run, std::span<const double> instants, std::size_t first);
  void look_for_sources(const Run& run, double t);
  bool comes_next(const Run& run, double t) const {
    return next_instant_ < instants_.size() && instants_[next_instant_] == t && run.branch == foretold_branch_;
  }

  const Program& program_;
  Work& work_;
  std::vector<double> x_;
  BoundCalls calls_;
  std::vector<Term> terms_;
  std::vector<Row> rows_;
  std::vector<Piece> pieces_;
  bool other_steps_ = false;  ///< some are more than a call

  // What sources of time make stands in source_places_. What they made: one row of `foretold_` for each of the
  // instants, and one behind these for an instant that was not foretold.
  std::vector<BoundCalls::Call*> sources_;
  std::vector<double*> source_places_;
  std::vector<double> instants_, foretold_;
  std::size_t next_instant_ = 0;
  const double* kept_ = nullptr;  // the numbers of kept_t_
  double kept_t_, kept_branch_, foretold_branch_;
};

}  // namespace hysteron
