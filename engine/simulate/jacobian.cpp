#include "engine/simulate/jacobian.h"

#include <algorithm>
#include <cmath>

#include "engine/diagram/index.h"
#include "engine/program/steps.h"

namespace hysteron {
namespace {

using Set = std::vector<int>;  // of states, increasing

bool add(Set& to, const Set& from) {
  if (from.empty() || std::includes(to.begin(), to.end(), from.begin(), from.end())) return false;
  Set both;
  both.reserve(to.size() + from.size());
  std::set_union(to.begin(), to.end(), from.begin(), from.end(), std::back_inserter(both));
  to = std::move(both);
  return true;
}

/// What the values, rates and derivatives of each block depend on.
class Dependence {
 public:
  explicit Dependence(const Program& program)
      : program_(program),
        value_(program.blocks.size()),
        rate_(program.blocks.size()),
        derivative_(program.blocks.size()) {
    // Steps come in the order of their dependence, so one pass is enough but for loops.
    for (bool changed = true; changed;) {
      changed = false;
      for (const Step& step : program.derivative_steps) changed |= follow(step);
    }
  }
  const Set& derivative(int block) const { return derivative_[at(block)]; }

 private:
  bool follow(const Step& step) {
    if (step.order == Order::loop) {  // what one of them depends on, all do after some passes
      bool changed = false;
      for (const Step& inner : program_.loops[at(step.block)].steps) changed |= follow(inner);
      return changed;
    }
    const BlockInstance& b = program_.blocks[at(step.block)];
    bool changed = false;
    const auto from_sources = [&](Set& set, const std::vector<Set>& of) {
      for (const int s : b.source) changed |= add(set, of[at(program_.signals[at(s)].block)]);
    };
    Set own(at(b.sizes.states));
    for (std::size_t i = 0; i < own.size(); ++i) own[i] = b.x_begin + static_cast<int>(i);
    if (b.hit_index >= 0) return false;  // holds
    switch (step.order) {
      case Order::value:
        changed |= add(value_[at(step.block)], own);
        if (b.sizes.feedthrough) from_sources(value_[at(step.block)], value_);
        break;
      case Order::rate:
        changed |= add(rate_[at(step.block)], value_[at(step.block)]);
        changed |= add(rate_[at(step.block)], derivative_[at(step.block)]);
        if (b.sizes.feedthrough) from_sources(rate_[at(step.block)], rate_);
        break;
      case Order::derivative:
        changed |= add(derivative_[at(step.block)], own);
        from_sources(derivative_[at(step.block)], value_);
        if (b.kernel->derivative_wants_rate) from_sources(derivative_[at(step.block)], rate_);
        break;
      case Order::loop:
        break;
    }
    return changed;
  }

  const Program& program_;
  std::vector<Set> value_, rate_, derivative_;
};

/// Rows by columns; rows increase within a column because blocks do.
std::vector<std::vector<int>> columns_of(const Program& program) {
  const Dependence dependence(program);
  std::vector<std::vector<int>> columns(at(program.n_x));
  for (std::size_t b = 0; b < program.blocks.size(); ++b) {
    const BlockInstance& block = program.blocks[b];
    for (int i = 0; i < block.sizes.states; ++i)
      for (const int column : dependence.derivative(static_cast<int>(b)))
        columns[at(column)].push_back(block.x_begin + i);
  }
  return columns;
}

/// Greedy: each column takes the first colour that no column with a common row has.
std::vector<int> colour(const std::vector<std::vector<int>>& columns, int states) {
  std::vector<std::vector<int>> columns_of_row(at(states));
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (const int row : columns[c]) columns_of_row[at(row)].push_back(static_cast<int>(c));
  std::vector<int> colours(columns.size(), -1), taken_by(columns.size() + 1, -1);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    for (const int row : columns[c])
      for (const int other : columns_of_row[at(row)])
        if (colours[at(other)] >= 0) taken_by[at(colours[at(other)])] = static_cast<int>(c);
    int free = 0;
    while (taken_by[at(free)] == static_cast<int>(c)) ++free;
    colours[c] = free;
  }
  return colours;
}

}  // namespace

namespace {
SparsityPattern pattern_of(const std::vector<std::vector<int>>& columns) {
  SparsityPattern pattern;
  pattern.column_begin.push_back(0);
  for (const auto& column : columns) {
    pattern.row.insert(pattern.row.end(), column.begin(), column.end());
    pattern.column_begin.push_back(static_cast<int>(pattern.row.size()));
  }
  return pattern;
}
}  // namespace

Jacobian::Jacobian(const Program& program) : program_(program), work_(program), x_(at(program.n_x)) {
  const auto columns = columns_of(program);
  pattern_ = pattern_of(columns);
  colour_ = colour(columns, program.n_x);
  for (const int c : colour_) colours_ = std::max(colours_, c + 1);
}

bool Jacobian::operator()(const Run& run, double t, const double* x, double* entries) {
  work_.refresh(run);
  double sum = 0;  // of zeros: not zero if one of them is not finite
  for (int first = 0; first < colours_; first += Jet::directions) {
    for (std::size_t j = 0; j < x_.size(); ++j) {
      x_[j] = Jet(x[j]);
      const int direction = colour_[j] - first;
      if (direction >= 0 && direction < Jet::directions) x_[j].slope[direction] = 1;
    }
    evaluate_derivatives(program_, run, work_, t, x_.data());
    for (std::size_t j = 0; j < x_.size(); ++j) {
      const int direction = colour_[j] - first;
      if (direction < 0 || direction >= Jet::directions) continue;
      for (int k = pattern_.column_begin[j]; k < pattern_.column_begin[j + 1]; ++k)
        sum += 0 * (entries[k] = work_.dx[at(pattern_.row[at(k)])].slope[direction]);
    }
  }
  return sum == 0;
}

}  // namespace hysteron
