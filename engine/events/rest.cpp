#include "engine/events/rest.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/diagram/stop.h"
#include "engine/program/breakpoints.h"
#include "engine/program/loops.h"
#include "engine/program/nominal.h"

namespace hysteron {
namespace {

// The unknowns are the states and, for each dead time, the value that its input had for ever. Columns are scaled by
// nominal sizes and rows by what such sizes make of them, so that "small" means the same for a nanometre and for a
// kilovolt.
constexpr int iterations_allowed = 50;
constexpr int halvings_allowed = 20;
constexpr double difference_step =
    1e-6;  // of the nominal size; central: exact for linear parts but for 1e-10 of rounding
constexpr double no_influence = 1e-12;   // of what a state of nominal size does: nothing moves this rate
constexpr double rank_threshold = 1e-8;  // above that rounding, below any coupling that matters
constexpr double reached = 1e-10, good_enough = 1e-7;

class RestProblem {
 public:
  RestProblem(const Program& program, const Run& run, double t)
      : program_(program),
        trial_(run),
        work_(program),
        t_(t),
        zero_(static_cast<std::size_t>(std::max(1, program.n_u))) {
    for (auto& history : trial_.histories) history = History{{}, {}, {}, 0, history.before};
    trial_.t = t;
    trial_.branch = Breakpoints(program, run, t).branch();
    set_loop_accuracy(program, trial_, reached, 1.0);
    const auto sizes = nominal_sizes(program, trial_);
    rate_of_size_one_ = sizes.time_scale > 0 ? 1 / sizes.time_scale : 1.0;
    size_.resize(program.n_x + static_cast<long>(trial_.histories.size()));
    for (int i = 0; i < program.n_x; ++i) size_[i] = sizes.states[static_cast<std::size_t>(i)];
    for (const auto& block : program.blocks) {
      if (block.history_index < 0) continue;
      const double size = sizes.signals[static_cast<std::size_t>(block.source.front())];
      size_[program.n_x + block.history_index] = size > 0 ? size : 1.0;
    }
  }

  Eigen::VectorXd start() const {
    Eigen::VectorXd z(size_.size());
    for (int i = 0; i < program_.n_x; ++i) z[i] = trial_.x[static_cast<std::size_t>(i)];
    for (std::size_t h = 0; h < trial_.histories.size(); ++h)
      z[program_.n_x + static_cast<long>(h)] = trial_.histories[h].before;
    return z;
  }

  /// Each block by itself in its own equilibrium for the inputs it has, as often as such inputs go on to move: where
  /// the way from the start has a flat piece (a limited rate), or none at all (below the bottom of a tank).
  Eigen::VectorXd block_by_block() {
    Eigen::VectorXd z = start();
    for (std::size_t pass = 0; pass <= program_.blocks.size(); ++pass) {
      put(z);
      evaluate_values(program_, trial_, work_, t_, z.data());
      const Eigen::VectorXd before = z;
      for (int b = 0; b < static_cast<int>(program_.blocks.size()); ++b) settle_block(b, z);
      if (z == before) break;
    }
    return z;
  }

  /// dx/dt with every rate zero, as they all are at rest; for dead times, what their input lacks to its past.
  Eigen::VectorXd residual(const Eigen::VectorXd& z) {
    put(z);
    evaluate_values(program_, trial_, work_, t_, z.data());
    if (work_.unsolved >= 0) return Eigen::VectorXd::Constant(z.size(), std::numeric_limits<double>::quiet_NaN());
    Eigen::VectorXd r = Eigen::VectorXd::Zero(z.size());
    for (int b = 0; b < static_cast<int>(program_.blocks.size()); ++b) {
      const auto& block = program_.blocks[static_cast<std::size_t>(b)];
      gather_inputs(block);
      if (block.history_index >= 0) {
        const long row = program_.n_x + block.history_index;
        r[row] = (inputs_.front() - z[row]) * rate_of_size_one_;
      }
      if (block.kernel->derivative == nullptr || is_off(program_, trial_, block)) continue;
      auto view = view_at(b, z);
      view.out = r.data() + block.x_begin;
      block.kernel->derivative(view);
    }
    return r;
  }

  /// Columns in units of the nominal sizes.
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& z) {
    Eigen::MatrixXd j(z.size(), z.size());
    for (long k = 0; k < z.size(); ++k) {
      const double h = difference_step * std::max(size_[k], std::abs(z[k]));
      Eigen::VectorXd moved = z;
      moved[k] = z[k] + h;
      const Eigen::VectorXd up = residual(moved);
      moved[k] = z[k] - h;
      j.col(k) = (up - residual(moved)) * (size_[k] / (2 * h));
    }
    return j;
  }

  /// The rate that counts as one, per row.
  Eigen::VectorXd row_size(const Eigen::MatrixXd& jacobian) const {
    return jacobian.cwiseAbs().rowwise().sum() + unit_rate();
  }
  Eigen::VectorXd unit_rate() const { return size_ * rate_of_size_one_; }
  const Eigen::VectorXd& size() const { return size_; }

  /// Says so if the loops of the diagram cannot be solved at z.
  void check_loops(const Eigen::VectorXd& z) {
    put(z);
    evaluate_values(program_, trial_, work_, t_, z.data());
    throw_if_unsolved(program_, work_, t_);
  }

  void finish(const Eigen::VectorXd& z, Run& run) {
    put(z);
    trial_.x.assign(z.data(), z.data() + program_.n_x);
    accept(program_, trial_, work_, t_, z.data());
    trial_.loop_relative = run.loop_relative;
    trial_.loop_absolute = run.loop_absolute;
    run = std::move(trial_);
  }

 private:
  void put(const Eigen::VectorXd& z) {
    for (std::size_t h = 0; h < trial_.histories.size(); ++h)
      trial_.histories[h].before = z[program_.n_x + static_cast<long>(h)];
  }
  void gather_inputs(const BlockInstance& block) {
    inputs_.clear();
    for (const int s : block.source) inputs_.push_back(work_.y[static_cast<std::size_t>(s)]);
  }
  /// Of block b, with the inputs that were gathered.
  View<double> view_at(int b, const Eigen::VectorXd& z) {
    auto view = view_of(program_, trial_, b);
    view.t = t_;
    view.branch = trial_.branch;
    view.x = z.data() + program_.blocks[static_cast<std::size_t>(b)].x_begin;
    view.u = inputs_.data();
    view.du = zero_.data();
    return view;
  }
  void settle_block(int b, Eigen::VectorXd& z) {
    const auto& block = program_.blocks[static_cast<std::size_t>(b)];
    gather_inputs(block);
    if (block.history_index >= 0) z[program_.n_x + block.history_index] = inputs_.front();
    if (block.kernel->rest == nullptr || block.kernel->is_sampled() || block.sizes.states == 0) return;
    if (is_off(program_, trial_, block)) return;
    std::vector<double> x(static_cast<std::size_t>(block.sizes.states));
    auto view = view_at(b, z);
    view.out = x.data();
    block.kernel->rest(view);
    if (!std::all_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); })) return;
    std::copy(x.begin(), x.end(), z.data() + block.x_begin);
  }

  const Program& program_;
  Run trial_;
  Work work_;
  double t_;
  double rate_of_size_one_ = 1;
  std::vector<double> zero_, inputs_;
  Eigen::VectorXd size_;
};

/// States whose rate no free unknown can change have no equilibrium of their own and stay: an integrator without input,
/// a law that is driven by a rate. What is left may lose its last influence with them.
void hold_free_states(Eigen::MatrixXd& jacobian, const Eigen::VectorXd& unit) {
  for (bool held = true; held;) {
    held = false;
    for (long i = 0; i < jacobian.rows(); ++i) {
      if ((jacobian.col(i).array() == 0).all() || jacobian.row(i).cwiseAbs().sum() > no_influence * unit[i]) continue;
      jacobian.col(i).setZero();
      held = true;
    }
  }
}

[[noreturn]] void no_rest(const Program& program, double t, const Eigen::VectorXd& rate,
                          const Eigen::VectorXd& relative) {
  std::vector<std::string> parts;
  std::string first;
  for (int i = 0; i < program.n_x; ++i) {
    if (std::abs(relative[i]) <= good_enough) continue;
    const auto& name = program.state_names[static_cast<std::size_t>(i)];
    if (first.empty()) first = name;
    if (parts.size() < 10) parts.push_back(fmt::format("{} (d/dt = {:.4g} SI/s)", name, rate[i]));
  }
  fail_numerics(
      "no_rest", first.empty() ? "simulate" : first,
      fmt::format("there is no equilibrium for the inputs at t = {:.9g} s: these states keep moving: {}", t,
                  fmt::join(parts, ", ")),
      "give initial states instead of \"rest\" (in a data set \"initial\": \"per_recording\" finds them), or let the "
      "inputs start where an integrator's input is zero");
}

/// How far Newton's method came.
struct Settled {
  Eigen::VectorXd z, rate, relative;  ///< relative: rates in units of what states of nominal size make of them
  bool finite() const { return relative.allFinite(); }
  bool reached_rest() const { return finite() && (z.size() == 0 || relative.lpNorm<Eigen::Infinity>() <= good_enough); }
};

Settled settle_from(RestProblem& problem, Eigen::VectorXd z) {
  Eigen::VectorXd rate = problem.residual(z);
  Eigen::VectorXd relative = Eigen::VectorXd::Zero(z.size());
  for (int iteration = 0; iteration < iterations_allowed && z.size() > 0; ++iteration) {
    look_up();
    Eigen::MatrixXd jacobian = problem.jacobian(z);
    const Eigen::VectorXd row = problem.row_size(jacobian);
    relative = rate.cwiseQuotient(row);
    if (!relative.allFinite() || relative.lpNorm<Eigen::Infinity>() <= reached) break;
    hold_free_states(jacobian, problem.unit_rate());
    // Of several equilibria the nearest, in nominal sizes.
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(rank_threshold);
    solver.compute(row.cwiseInverse().asDiagonal() * jacobian);
    const Eigen::VectorXd step = problem.size().cwiseProduct(solver.solve(-relative));
    bool better = false;
    double share = 1;
    for (int halving = 0; halving <= halvings_allowed && !better; ++halving, share /= 2) {
      const Eigen::VectorXd trial = z + share * step;
      const Eigen::VectorXd trial_rate = problem.residual(trial);
      const Eigen::VectorXd trial_relative = trial_rate.cwiseQuotient(row);
      better = trial_relative.allFinite() && trial_relative.norm() < relative.norm();
      if (!better) continue;
      z = trial;
      rate = trial_rate;
      relative = trial_relative;
    }
    if (!better) break;
  }
  return {std::move(z), std::move(rate), std::move(relative)};
}

/// Nested diagrams are on or off as the signals that enable them say. Returns true if one of them changed.
bool enable_for(const Program& program, Run& run, double t) {
  if (program.enablings.empty()) return false;
  bool changed = false;
  Work work(program);
  for (std::size_t depth = 0; depth <= program.enablings.size(); ++depth) {  // the outer ones first
    evaluate_guards(program, run, work, t, run.x.data());
    throw_if_unsolved(program, work, t);
    for (const auto& enabling : program.enablings) {
      const auto i = static_cast<std::size_t>(program.blocks[static_cast<std::size_t>(enabling.block)].mode_index);
      if (work.guard[i] > 0) continue;
      const int next = program.blocks[static_cast<std::size_t>(enabling.block)].kernel->next_mode(
          work.views[static_cast<std::size_t>(enabling.block)]);
      run.mode[i] = enabling.triggered ? next % enabled_mode : next;  // the start is no edge
      changed = true;
    }
  }
  return changed;
}

/// Whether every mode may stay there: what sticks moves at no place, and is at rest only where it is held.
bool modes_stay(const Program& program, const Run& run, double t, const Eigen::VectorXd& z) {
  Work work(program);
  evaluate_guards(program, run, work, t, z.data());
  for (const auto& block : program.blocks) {
    const bool is_held = block.mode_index >= 0 && block.kernel->rest != nullptr;
    if (is_held && !(work.guard[static_cast<std::size_t>(block.mode_index)] > 0)) return false;
  }
  return true;
}

/// Every block whose mode may not stay where the run is goes on to the next one, with its states as they are. Returns
/// true if one did.
bool change_modes(const Program& program, Run& run, double t) {
  Work work(program);
  evaluate_guards(program, run, work, t, run.x.data());
  if (work.unsolved >= 0) return false;
  bool changed = false;
  for (const int block : program.modal_blocks) {
    const BlockInstance& b = program.blocks[static_cast<std::size_t>(block)];
    const auto i = static_cast<std::size_t>(b.mode_index);
    if (b.sizes.states == 0 || is_off(program, run, b) || work.guard[i] > 0) continue;
    const int next = b.kernel->next_mode(work.views[static_cast<std::size_t>(block)]);
    changed = changed || next != run.mode[i];
    run.mode[i] = next;
  }
  return changed;
}

/// What cannot rest in its mode may move steadily in the next one: a shaft that is driven against its dry friction.
void move_steadily(const Program& program, Run& run, double t) {
  if (program.modal_blocks.empty()) return;
  Run moving = run;
  for (std::size_t changes = 0; changes <= program.modal_blocks.size(); ++changes) {
    if (!change_modes(program, moving, t)) {
      if (changes > 0) run = std::move(moving);
      return;
    }
    RestProblem problem(program, moving, t);
    const Settled end = settle_from(problem, problem.start());
    if (!end.reached_rest()) return;
    problem.finish(end.z, moving);
  }
}

void settle_what_runs(const Program& program, Run& run, double t) {
  RestProblem problem(program, run, t);
  Settled end = settle_from(problem, problem.start());
  if (!end.reached_rest() || !modes_stay(program, run, t, end.z))
    if (Settled second = settle_from(problem, problem.block_by_block()); second.reached_rest()) end = std::move(second);
  if (!end.finite()) problem.check_loops(end.z);
  if (!end.reached_rest()) no_rest(program, t, end.rate, end.relative);
  problem.finish(end.z, run);
  move_steadily(program, run, t);
}

}  // namespace

void settle_at_rest(const Program& program, Run& run, double t) {
  enable_for(program, run, t);
  settle_what_runs(program, run, t);
  // What the equilibrium itself switches: again, as long as each switching leads on to another.
  for (std::size_t i = 0; i <= program.enablings.size() && enable_for(program, run, t); ++i)
    settle_what_runs(program, run, t);
}

}  // namespace hysteron
