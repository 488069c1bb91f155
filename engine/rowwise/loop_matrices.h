// Decides how the linear blocks of a feedback loop are evaluated together: every signal of theirs that another block or
// somebody outside reads, and the rates of their states, are sums over states, the outputs of the other blocks and the
// inputs of the loop. Internal to the exact advance.
#pragma once

#include <span>
#include <vector>

#include "engine/rowwise/advance_plan.h"

namespace hysteron {

class LoopMatrices {
 public:
  LoopMatrices(const AdvancePlan& plan, const AdvancePlan::LoopedPart& part);

  /// For the numbers of a run.
  void bind(const Run& run);
  /// Rates of all states of the loop to Work::dx; its inputs stand in Work::y.
  void derivatives(Work& work, const double* x) const { evaluate(derivatives_, work, x); }
  /// What the loop gives (LoopedPart::outputs) and what its blocks with modes read to Work::y; memory as in
  /// steps::value.
  void values(Work& work, const double* x) const { evaluate(values_, work, x); }

 private:
  enum class Kind { sum, rate_sum, value, derivative };
  struct Task {
    Kind kind;
    int of;  ///< place in sums_; block
  };
  struct Term {
    int from;
    double factor;
  };
  /// constant + sum of factors times states, then times signals. Places in terms_.
  struct Sum {
    int to = 0;  ///< signal; state
    double constant = 0;
    std::size_t begin = 0, states_end = 0, end = 0;
  };
  class Planner;

  void keep(std::span<const double> row, Sum& sum);
  void evaluate(const std::vector<Task>& tasks, Work& work, const double* x) const;
  double value_of(const Sum& sum, const Work& work, const double* x) const;

  const AdvancePlan& plan_;
  const Program& program_;
  std::vector<int> blocks_;            ///< linear ones in value order
  std::vector<int> states_, signals_;  ///< what sums are over: states of linear blocks; signals of others and inputs
  std::vector<Task> derivatives_, values_;
  std::vector<Sum> sums_, rates_;
  std::vector<Term> terms_;
};

}  // namespace hysteron
