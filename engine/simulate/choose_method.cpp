#include "engine/simulate/choose_method.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/diagram/index.h"
#include "engine/matrices/decompositions.h"
#include "engine/program/breakpoints.h"
#include "engine/simulate/jacobian.h"

namespace hysteron {
namespace {

// Fewer jumps than these in the whole span cost little, whatever follows them.
constexpr double few_jumps = 20;
// |eigenvalue| times the time between jumps. Behind each jump BDF takes some 18 steps of 5000 instructions, Dormand and
// Prince's formula at least two or three (docs/performance.md), and it is stable up to 3.3 in this product: at 30 it
// takes nine or ten. The margin of two is for what the eigenvalues do later.
constexpr double stiff = 30;
// Eigenvalues of larger diagrams would cost more than they bring.
constexpr int most_states = 100;

/// What jumps at instants of its own: a sampled block, or a recording that is held. Time between jumps [s], else 0.
double time_between_jumps(const Program& program, const Run& run, int block) {
  const BlockInstance& b = program.blocks[at(block)];
  if (b.kernel->is_sampled()) {
    const int period = b.kernel->declaration.parameter_index("period");
    return run.p[at(b.p_begin + b.p_at[at(period)])];
  }
  if (b.series_index < 0) return 0;
  const auto& series = run.series[at(b.series_index)];
  if (!series || series->between != Between::hold || series->t.size() < 2) return 0;
  return (series->t.back() - series->t.front()) / static_cast<double>(series->t.size() - 1);
}

/// Does what the block puts out reach a continuous state without a sampled block between.
bool reaches_states(const Program& program, int from) {
  std::vector<std::vector<int>> readers(program.blocks.size());
  for (int b = 0; b < static_cast<int>(program.blocks.size()); ++b)
    for (const int s : program.blocks[at(b)].source) readers[at(program.signals[at(s)].block)].push_back(b);
  std::vector<bool> seen(program.blocks.size(), false);
  std::vector<int> todo{from};
  while (!todo.empty()) {
    const int b = todo.back();
    todo.pop_back();
    for (const int reader : readers[at(b)]) {
      const BlockInstance& r = program.blocks[at(reader)];
      if (seen[at(reader)] || r.kernel->is_sampled()) continue;
      if (r.sizes.states > 0) return true;
      seen[at(reader)] = true;
      todo.push_back(reader);
    }
  }
  return false;
}

/// Largest |eigenvalue| of d(dx/dt)/dx at the start [1/s]; not finite if there is none.
double fastest_eigenvalue(const Program& program, const Run& run, double begin) {
  Run at_start = run;
  at_start.t = begin;
  at_start.branch = Breakpoints(program, run, begin).branch();
  Jacobian jacobian(program);
  const auto& pattern = jacobian.pattern();
  std::vector<double> entries(pattern.row.size());
  if (!jacobian(at_start, begin, at_start.x.data(), entries.data())) return std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(program.n_x, program.n_x);
  for (int column = 0; column < program.n_x; ++column)
    for (int k = pattern.column_begin[at(column)]; k < pattern.column_begin[at(column) + 1]; ++k)
      matrix(pattern.row[at(k)], column) = entries[at(k)];
  if (!matrix.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  const Eigen::VectorXcd eigenvalues = eigenvalues_of(matrix);
  return eigenvalues.size() > 0 ? eigenvalues.cwiseAbs().maxCoeff() : std::numeric_limits<double>::quiet_NaN();
}

std::string time_text(double seconds) {
  return seconds >= 1      ? fmt::format("{:.4g} s", seconds)
         : seconds >= 1e-3 ? fmt::format("{:.4g} ms", 1e3 * seconds)
                           : fmt::format("{:.4g} us", 1e6 * seconds);
}

bool is_bound(const Program& program, const Run& run) {
  for (std::size_t i = 0; i < program.input_names.size(); ++i)
    if (!run.series[i]) return false;
  return true;
}

}  // namespace

double fastest_rate(const Program& program, const Run& run, double begin) {
  if (program.n_x == 0 || program.n_x > most_states || !is_bound(program, run))
    return std::numeric_limits<double>::quiet_NaN();
  return fastest_eigenvalue(program, run, begin);
}

MethodChoice choose_method(const Program& program, const Run& run, double begin, double span) {
  if (program.n_x == 0) return {Method::bdf, "there is nothing to integrate"};
  double shortest = std::numeric_limits<double>::infinity();
  std::string which;
  for (int b = 0; b < static_cast<int>(program.blocks.size()); ++b) {
    const double time = time_between_jumps(program, run, b);
    if (!(time > 0) || time >= shortest || !reaches_states(program, b)) continue;
    shortest = time;
    which = program.blocks[at(b)].path;
  }
  if (!(shortest < span / few_jumps)) return {Method::bdf, "few discontinuities reach the states"};
  const std::string jumps = fmt::format("\"{}\" jumps every {}", which, time_text(shortest));
  if (program.n_x > most_states)
    return {Method::bdf,
            fmt::format("{}, but {} states are too many to see whether they are stiff", jumps, program.n_x)};
  if (!is_bound(program, run)) return {Method::bdf, "the inputs are not known yet"};
  const double rate = fastest_rate(program, run, begin);
  if (!std::isfinite(rate)) return {Method::bdf, jumps + ", but the diagram has no slopes at the start"};
  const std::string fast = rate > 0 ? fmt::format("the fastest time constant at the start is {}", time_text(1 / rate))
                                    : "no state decays by itself";
  if (rate * shortest > stiff) return {Method::bdf, fmt::format("{}, but {}: stiff", jumps, fast)};
  return {Method::runge_kutta, fmt::format("{}, and {}: restarts are frequent and nothing is stiff", jumps, fast)};
}

}  // namespace hysteron
