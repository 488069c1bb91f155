#include "engine/rowwise/loop_matrices.h"

#include <algorithm>
#include <set>

#include "engine/diagram/index.h"
#include "engine/program/steps.h"
#include "engine/rowwise/block_matrices.h"

namespace hysteron {

/// Turns the steps of the program into tasks: steps of linear blocks fall away, and what they would have written is
/// summed up where it is first read.
class LoopMatrices::Planner {
 public:
  Planner(LoopMatrices& to, const AdvancePlan::LoopedPart& part) : to_(to), part_(part) {
    for (const int b : part.blocks) inside_.insert(b);
  }

  std::vector<Task> tasks(const std::vector<Step>& steps) {
    tasks_.clear();
    written_.clear();
    for (const Step& step : steps) {
      if (is_linear(step.block)) continue;
      const BlockInstance& b = to_.plan_.block(step.block);
      if (step.order == Order::derivative || b.sizes.feedthrough) write_sources(b);
      tasks_.push_back({step.order == Order::derivative ? Kind::derivative : Kind::value, step.block});
    }
    return tasks_;
  }
  std::vector<Task> tasks_of_derivatives() {
    auto list = tasks(part_.derivatives);
    for (std::size_t i = 0; i < to_.rates_.size(); ++i) list.push_back({Kind::rate_sum, static_cast<int>(i)});
    return list;
  }
  std::vector<Task> tasks_of_values() {
    tasks(part_.values);
    for (const int block : part_.modal) write_sources(to_.plan_.block(block));
    for (const int s : part_.outputs) write(s);
    return tasks_;
  }

 private:
  bool is_linear(int block) const { return to_.plan_.graph.linear[at(block)]; }
  void write_sources(const BlockInstance& b) {
    for (const int s : b.source) write(s);
  }
  void write(int signal) {
    const int block = to_.plan_.block_of(signal);
    if (!inside_.contains(block) || !is_linear(block) || !written_.insert(signal).second) return;
    auto found = std::find_if(to_.sums_.begin(), to_.sums_.end(), [&](const Sum& s) { return s.to == signal; });
    if (found == to_.sums_.end()) found = to_.sums_.insert(found, Sum{.to = signal});
    tasks_.push_back({Kind::sum, static_cast<int>(found - to_.sums_.begin())});
  }

  LoopMatrices& to_;
  const AdvancePlan::LoopedPart& part_;
  std::set<int> inside_, written_;
  std::vector<Task> tasks_;
};

LoopMatrices::LoopMatrices(const AdvancePlan& plan, const AdvancePlan::LoopedPart& part)
    : plan_(plan), program_(*plan.program) {
  signals_ = part.inputs;
  for (const int b : program_.value_order) {
    if (std::find(part.blocks.begin(), part.blocks.end(), b) == part.blocks.end()) continue;
    const BlockInstance& block = plan.block(b);
    if (plan.graph.linear[at(b)]) {
      blocks_.push_back(b);
      for (int i = 0; i < block.sizes.states; ++i) {
        states_.push_back(block.x_begin + i);
        rates_.push_back({.to = block.x_begin + i});
      }
    } else {
      for (int o = 0; o < block.sizes.outputs; ++o) signals_.push_back(block.y_begin + o);
    }
  }
  Planner planner(*this, part);
  derivatives_ = planner.tasks_of_derivatives();
  values_ = planner.tasks_of_values();
}

void LoopMatrices::bind(const Run& run) {
  BlockRows rows(program_, run, blocks_, signals_);
  rows.follow_wires();
  terms_.clear();
  const auto keep_row = [&](const Eigen::RowVectorXd& row, Sum& sum) {
    keep({row.data(), static_cast<std::size_t>(row.size())}, sum);
  };
  for (Sum& sum : sums_) keep_row(rows.signals[at(sum.to)], sum);
  const Eigen::MatrixXd rates = rows.rates();
  for (std::size_t i = 0; i < rates_.size(); ++i) keep_row(rates.row(static_cast<Eigen::Index>(i)), rates_[i]);
}

/// row: over [states, signals, 1].
void LoopMatrices::keep(std::span<const double> row, Sum& sum) {
  const auto take = [&](const std::vector<int>& from, std::size_t first) {
    for (std::size_t i = 0; i < from.size(); ++i)
      if (const double factor = row[first + i]; factor != 0) terms_.push_back({from[i], factor});
    return terms_.size();
  };
  sum.constant = row.back();
  sum.begin = terms_.size();
  sum.states_end = take(states_, 0);
  sum.end = take(signals_, states_.size());
}

double LoopMatrices::value_of(const Sum& sum, const Work& work, const double* x) const {
  double value = sum.constant;
  for (std::size_t i = sum.begin; i < sum.states_end; ++i) value += terms_[i].factor * x[terms_[i].from];
  for (std::size_t i = sum.states_end; i < sum.end; ++i) value += terms_[i].factor * work.y[at(terms_[i].from)];
  return value;
}

void LoopMatrices::evaluate(const std::vector<Task>& tasks, Work& work, const double* x) const {
  for (const Task& task : tasks) switch (task.kind) {
      case Kind::sum:
        work.y[at(sums_[at(task.of)].to)] = value_of(sums_[at(task.of)], work, x);
        break;
      case Kind::rate_sum:
        work.dx[at(rates_[at(task.of)].to)] = value_of(rates_[at(task.of)], work, x);
        break;
      case Kind::value:
        steps::value(program_, work, task.of, x);
        break;
      case Kind::derivative:
        steps::derivative(work, task.of, x);
        break;
    }
}

}  // namespace hysteron
