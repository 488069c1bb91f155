#include "engine/simulate/divergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/diagram/index.h"
#include "engine/diagram/value_text.h"
#include "engine/program/loops.h"
#include "engine/program/nominal.h"

namespace hysteron {
namespace {

constexpr double runaway = 1e8;  // times its usual size

/// The unit of state k of a block: as it is declared, else that of an output declared alike; where neither says one it
/// is SI.
Unit unit_of_state(const Program& program, const BlockInstance& block, int k) {
  const auto& declaration = block.kernel->declaration;
  Unit unknown;
  unknown.text = "[SI]";
  if (declaration.states.size() != at(block.sizes.states)) return unknown;
  const UnitExpression& expression = declaration.states[at(k)].unit;
  for (std::size_t i = 0; i < declaration.outputs.size() && i < at(block.sizes.outputs); ++i)
    if (declaration.outputs[i].unit == expression) return program.signals[at(block.y_begin) + i].unit;
  return expression.find('$') == expression.npos ? parse_unit(expression) : unknown;
}

/// Of a signal or a state.
Unit unit_of(const Program& program, const WatchedQuantity& q) {
  const auto& block = program.blocks[at(q.block)];
  for (int i = block.y_begin; i < block.y_begin + block.sizes.outputs; ++i)
    if (program.signals[at(i)].path == q.name) return program.signals[at(i)].unit;
  for (int k = 0; k < block.sizes.states; ++k)
    if (program.state_names[at(block.x_begin + k)] == q.name) return unit_of_state(program, block, k);
  return {};
}

double size_of(const WatchedQuantity& q) { return std::abs(q.value) / q.usual; }

/// The shortest way along the wires from a block back to itself, both ends named; empty if there is none.
std::vector<std::string> way_around(const Program& program, int block) {
  std::vector<std::vector<int>> readers(program.blocks.size());
  for (std::size_t b = 0; b < program.blocks.size(); ++b)
    for (const int s : program.blocks[b].source)
      readers[at(program.signals[at(s)].block)].push_back(static_cast<int>(b));
  std::vector<int> from(program.blocks.size(), -1), todo{block};
  for (std::size_t k = 0; k < todo.size() && from[at(block)] < 0; ++k)
    for (const int reader : readers[at(todo[k])])
      if (from[at(reader)] < 0) {
        from[at(reader)] = todo[k];
        todo.push_back(reader);
      }
  std::vector<std::string> way;
  if (from[at(block)] < 0) return way;
  way.push_back(program.blocks[at(block)].path);
  for (int b = from[at(block)]; b != block; b = from[at(b)]) way.push_back(program.blocks[at(b)].path);
  way.push_back(program.blocks[at(block)].path);
  std::reverse(way.begin(), way.end());
  return way;
}

/// Those that no other one stands before, but around a loop: what grows behind them follows.
std::vector<const WatchedQuantity*> first_ones(const Program& program,
                                               const std::vector<const WatchedQuantity*>& grown) {
  std::vector<std::vector<bool>> reached;
  for (const auto* q : grown) reached.push_back(program.downstream_of(q->block));
  std::vector<const WatchedQuantity*> first;
  for (std::size_t i = 0; i < grown.size(); ++i) {
    bool follows = false;
    for (std::size_t k = 0; k < grown.size(); ++k)
      follows = follows || (reached[k][at(grown[i]->block)] && !reached[i][at(grown[k]->block)]);
    if (!follows) first.push_back(grown[i]);
  }
  return first;
}

bool has_finite_surroundings(const BlockInstance& block, const std::vector<double>& y, const double* x) {
  return std::all_of(block.source.begin(), block.source.end(), [&](int s) { return std::isfinite(y[at(s)]); }) &&
         std::all_of(x + block.x_begin, x + block.x_begin + block.sizes.states,
                     [](double v) { return std::isfinite(v); });
}

/// What is said of where the law ends; of a block that does not tell it, all that is said.
std::string law_cure(const BlockInstance& block) {
  const auto& declaration = block.kernel->declaration;
  std::vector<std::string> told;
  for (const auto& remark : declaration.remarks)
    if (remark.find("the run ends") != remark.npos) told.push_back(remark);
  return fmt::format("check the parameters of \"{}\", and what drives it, against what is said of {}: {}", block.path,
                     declaration.type, fmt::join(told.empty() ? declaration.remarks : told, " "));
}

std::string cure_of(const Program& program, int block) {
  const auto& path = program.blocks[at(block)].path;
  if (const auto way = way_around(program, block); !way.empty())
    return fmt::format("check gain and sign of the loop through \"{}\": {}", path, fmt::join(way, " -> "));
  return fmt::format("check the parameters of \"{}\", and what drives it: no loop leads through it", path);
}

}  // namespace

void throw_if_grown(const Program& program, const std::vector<WatchedQuantity>& quantities, double t,
                    const std::string& met) {
  std::vector<const WatchedQuantity*> grown;
  for (const auto& q : quantities)
    if (size_of(q) > runaway) grown.push_back(&q);
  if (grown.empty()) return;
  const auto first = first_ones(program, grown);
  const WatchedQuantity& worst =
      **std::max_element(first.begin(), first.end(),
                         [](const WatchedQuantity* a, const WatchedQuantity* b) { return size_of(*a) < size_of(*b); });
  const auto& path = program.blocks[at(worst.block)].path;
  const Unit unit = unit_of(program, worst);
  fail_numerics("diverged", path,
                fmt::format("{} grows without bound: it left its usual size, about {}, at t = {:.6g} s, and is {} at "
                            "t = {:.9g} s{}",
                            worst.name, value_text(worst.usual, unit, true), worst.since, value_text(worst.value, unit),
                            t, met.empty() ? "" : "\n  " + met),
                cure_of(program, worst.block));
}

void throw_if_upright(const Program& program, const Work& work, const std::vector<WatchedQuantity>& quantities,
                      double t, double span) {
  const WatchedQuantity* fastest = nullptr;
  double most = runaway, rate = 0;
  for (std::size_t i = 0; i < quantities.size(); ++i)
    if (const double sizes = std::abs(work.dx[i]) * span / quantities[i].usual; sizes > most)
      most = sizes, rate = work.dx[i], fastest = &quantities[i];
  if (fastest == nullptr) return;
  const auto& block = program.blocks[at(fastest->block)];
  const Unit unit = unit_of(program, *fastest);
  fail_numerics(
      "diverged", block.path,
      fmt::format("{} = {} changes by {} a second at t = {:.9g} s, faster than any step can follow: the law of {} does "
                  "not hold beyond",
                  fastest->name, value_text(fastest->value, unit), value_text(rate, unit, true), t,
                  block.kernel->declaration.type),
      law_cure(block));
}

GrowthWatch::GrowthWatch(std::vector<double> usual, double begin)
    : usual_(std::move(usual)), all_until_(begin), left_(usual_.size()) {
  for (const double size : usual_) limit_.push_back(beyond * size);
}

void GrowthWatch::see_each(double t, std::span<const double> x) {
  if (all_) std::fill(left_.begin(), left_.end(), all_until_);
  all_ = false;
  for (std::size_t i = 0; i < limit_.size(); ++i)
    if (std::abs(x[i]) <= limit_[i]) left_[i] = t;
}

std::vector<WatchedQuantity> GrowthWatch::quantities(const Program& program, std::span<const double> x) const {
  std::vector<WatchedQuantity> all;
  for (std::size_t b = 0; b < program.blocks.size(); ++b)
    for (int k = 0; k < program.blocks[b].sizes.states; ++k) {
      const std::size_t i = at(program.blocks[b].x_begin + k);
      all.push_back({static_cast<int>(b), program.state_names[i], x[i], usual_[i], all_ ? all_until_ : left_[i]});
    }
  return all;
}

std::vector<int> signals_of_states(const Program& program) {
  std::vector<int> list;
  for (const auto& b : program.blocks)
    if (b.sizes.states > 0 || b.sizes.sampled_states > 0)
      for (int i = 0; i < b.sizes.outputs; ++i) list.push_back(b.y_begin + i);
  return list;
}

void throw_if_rows_grow(const Program& program, const Run& run, std::span<const int> signals, std::span<const double> t,
                        const std::vector<std::vector<double>>& values) {
  std::size_t rows = t.size();  // until the first that is not finite
  for (const auto& v : values)
    rows =
        std::min(rows, static_cast<std::size_t>(
                           std::find_if(v.begin(), v.end(), [](double x) { return !std::isfinite(x); }) - v.begin()));
  if (rows == 0) return;
  const auto sizes = nominal_sizes(program, run);
  std::vector<double> usual;
  for (const int s : signals) usual.push_back(sizes.signals[at(s)] > 0 ? sizes.signals[at(s)] : 1);
  std::vector<WatchedQuantity> all;
  for (std::size_t s = 0; s < signals.size(); ++s) {
    const auto& signal = program.signals[at(signals[s])];
    double since = t.front();
    for (std::size_t row = 0; row < rows; ++row)
      if (std::abs(values[s][row]) <= GrowthWatch::beyond * usual[s]) since = t[row];
    all.push_back({signal.block, signal.path, values[s][rows - 1], usual[s], since});
  }
  throw_if_grown(program, all, t[rows - 1]);
}

void not_finite(const Program& program, const Run& run, Work& work, double t, const double* x) {
  evaluate_derivatives(program, run, work, t, x);
  throw_if_unsolved(program, work, t);
  evaluate_values(program, run, work, t, x);
  throw_if_unsolved(program, work, t);
  const auto bad = [](const std::vector<double>& v, int begin, int count) {
    for (int i = begin; i < begin + count; ++i)
      if (!std::isfinite(v[static_cast<std::size_t>(i)])) return i;
    return -1;
  };
  const auto tell = [&](const BlockInstance& block, const std::string& of, double value) {
    std::vector<std::string> near;
    const auto name_state = [&](int i) {
      const auto owner = std::find_if(program.blocks.begin(), program.blocks.end(), [&](const BlockInstance& b) {
        return i >= b.x_begin && i < b.x_begin + b.sizes.states;
      });
      near.push_back(fmt::format("state {} = {}", program.state_names[at(i)],
                                 value_text(x[i], unit_of_state(program, *owner, i - owner->x_begin))));
    };
    for (const int s : block.source)
      near.push_back(
          fmt::format("{} = {}", program.signals[at(s)].path, value_text(work.y[at(s)], program.signals[at(s)].unit)));
    for (int i = block.x_begin; i < block.x_begin + block.sizes.states; ++i) name_state(i);
    if (block.sizes.states == 0 && program.n_x > 0) {
      const auto* largest =
          std::max_element(x, x + program.n_x, [](double a, double b) { return std::abs(a) < std::abs(b); });
      name_state(static_cast<int>(largest - x));
    }
    const auto& declaration = block.kernel->declaration;
    if (std::isnan(value) && has_finite_surroundings(block, work.y, x))
      fail_numerics("diverged", block.path,
                    fmt::format("{} has no value at t = {:.9g} s: the law of {} does not hold there; {}", of, t,
                                declaration.type, fmt::join(near, ", ")),
                    law_cure(block));
    fail_numerics(
        "diverged", block.path,
        fmt::format("{} is {} at t = {:.9g} s (of block type {}); there {}", of, value, t, declaration.type,
                    fmt::join(near, ", ")),
        fmt::format("the simulation runs away or leaves the range of \"{}\": check its parameters, and gain and sign "
                    "of the loop around it",
                    block.path));
  };
  for (const int b : program.value_order) {
    const auto& block = program.blocks[static_cast<std::size_t>(b)];
    if (const int s = bad(work.y, block.y_begin, block.sizes.outputs); s >= 0)
      tell(block, program.signals[static_cast<std::size_t>(s)].path, work.y[static_cast<std::size_t>(s)]);
  }
  for (const auto& block : program.blocks)
    if (const int i = bad(work.dx, block.x_begin, block.sizes.states); i >= 0)
      tell(block, "the derivative of " + program.state_names[static_cast<std::size_t>(i)],
           work.dx[static_cast<std::size_t>(i)]);
  fail_numerics("diverged", "simulate", fmt::format("a value is not finite near t = {:.9g} s", t),
                "check the parameters, and gain and sign of the loops");
}

}  // namespace hysteron
