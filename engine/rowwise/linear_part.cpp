#include "engine/rowwise/linear_part.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/diagram/index.h"
#include "engine/matrices/decompositions.h"
#include "engine/program/loop_plan.h"
#include "engine/rowwise/block_matrices.h"

namespace hysteron {
LinearPart::LinearPart(const Program& program, std::vector<int> blocks, std::vector<int> outputs)
    : blocks_(std::move(blocks)), outputs_(std::move(outputs)) {
  std::vector<bool> inside(program.blocks.size(), false);
  for (const int b : blocks_) inside[at(b)] = true;
  for (const int b : blocks_) {
    first_state_.push_back(n_);
    n_ += program.blocks[at(b)].sizes.states;
    for (const int s : program.blocks[at(b)].source)
      if (!inside[at(program.signals[at(s)].block)] && std::find(inputs_.begin(), inputs_.end(), s) == inputs_.end())
        inputs_.push_back(s);
  }
  for (const auto& loop : program.loops)
    for (const int b : loop.blocks) has_loop_ = has_loop_ || (loop.of_values() && inside[at(b)]);
  x_ = Eigen::VectorXd::Zero(n_);
  next_ = x_;
  w_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(inputs_.size()) + 1);
  w_[w_.size() - 1] = 1;
  w_before_ = w_;
  y_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(outputs_.size()));
}

/// All signals of the group at once, where some of them need each other at the same instant: rows = K rows + L, K what
/// the inputs from inside feed through, L what states, inputs from outside and constants give.
void LinearPart::solve_loops(const Program& program, const std::vector<BlockMatrices>& matrices,
                             std::vector<Eigen::RowVectorXd>& rows) const {
  const Eigen::Index columns = n_ + w_.size();
  std::vector<Eigen::Index> place(program.signals.size(), -1);
  Eigen::Index count = 0;
  for (const int block : blocks_)
    for (int o = 0; o < program.blocks[at(block)].sizes.outputs; ++o)
      place[at(program.blocks[at(block)].y_begin + o)] = count++;
  Eigen::MatrixXd k = Eigen::MatrixXd::Identity(count, count), l = Eigen::MatrixXd::Zero(count, columns);
  for (std::size_t m = 0; m < blocks_.size(); ++m) {
    const BlockInstance& b = program.blocks[at(blocks_[m])];
    const auto& output = matrices[m].output;
    for (int o = 0; o < b.sizes.outputs; ++o) {
      const auto row = place[at(b.y_begin + o)];
      for (int i = 0; i < b.sizes.states; ++i) l(row, first_state_[m] + i) += output(o, i);
      l(row, columns - 1) += output(o, b.sizes.states + b.n_u);
      if (!b.sizes.feedthrough) continue;
      for (int i = 0; i < b.n_u; ++i) {
        const double gain = output(o, b.sizes.states + i);
        const auto from = place[at(b.source[at(i)])];
        if (from >= 0)
          k(row, from) -= gain;
        else
          l.row(row) += gain * rows[at(b.source[at(i)])];
      }
    }
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(k);
  if (!lu.isInvertible()) {
    for (const auto& loop : program.loops)
      if (std::find(blocks_.begin(), blocks_.end(), loop.blocks.front()) != blocks_.end())
        fail_numerics("loop_unsolved", program.blocks[at(loop.path.front().block)].path,
                      "the algebraic loop has gain one, so that it has no solution, or any number is one: " +
                          to_text(program, loop.path),
                      "correct the gains around the loop, put a block with a state into it (a lag: the amplifier's or "
                      "the sensor's dynamics), or use an explicit inverse block instead of the loop");
  }
  const Eigen::MatrixXd solved = lu.solve(l);
  for (std::size_t s = 0; s < place.size(); ++s)
    if (place[s] >= 0) rows[s] = solved.row(place[s]);
}

bool LinearPart::is_bound_to(const Program& program, const Run& run) const {
  std::size_t place = 0;
  if (bound_to_.empty()) return false;
  for (const int block : blocks_) {
    const BlockInstance& b = program.blocks[at(block)];
    for (int i = 0; i < b.p_at.back(); ++i)
      if (bound_to_[place++] != run.p[at(b.p_begin + i)]) return false;
    for (int i = 0; i < b.sizes.constants; ++i)
      if (bound_to_[place++] != run.c[at(b.c_begin + i)]) return false;
  }
  return true;
}

void LinearPart::remember_numbers(const Program& program, const Run& run) {
  bound_to_.clear();
  for (const int block : blocks_) {
    const BlockInstance& b = program.blocks[at(block)];
    bound_to_.insert(bound_to_.end(), run.p.begin() + b.p_begin, run.p.begin() + b.p_begin + b.p_at.back());
    bound_to_.insert(bound_to_.end(), run.c.begin() + b.c_begin, run.c.begin() + b.c_begin + b.sizes.constants);
  }
}

void LinearPart::bind(const Program& program, const Run& run) {
  if (is_bound_to(program, run)) return;
  bound_to_.clear();
  const auto m = w_.size();
  BlockRows group(program, run, blocks_, inputs_);
  auto& rows = group.signals;
  if (has_loop_)
    solve_loops(program, group.matrices, rows);
  else
    group.follow_wires();
  const Eigen::MatrixXd dynamics = group.rates();
  const Eigen::MatrixXd a = dynamics.leftCols(n_);
  const Eigen::MatrixXd b = dynamics.rightCols(m);
  if (a_.rows() != a.rows() || a_ != a || b_.cols() != b.cols() || b_ != b) {
    a_ = a;
    b_ = b;
    cache_.clear();
    last_ = 0;
    packed_.clear();
    packed_count_ = 0;
    has_to_rest_ = false;
  }
  c_.resize(static_cast<Eigen::Index>(outputs_.size()), n_);
  d_.resize(static_cast<Eigen::Index>(outputs_.size()), m);
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    c_.row(static_cast<Eigen::Index>(i)) = rows[at(outputs_[i])].head(n_);
    d_.row(static_cast<Eigen::Index>(i)) = rows[at(outputs_[i])].tail(m);
  }
  feeds_through_ = !d_.leftCols(m - 1).isZero(0);
  find_seen();
  find_mixing();
  const std::size_t together = seen_.size() > most_in_registers ? 8 : 2;
  padded_ = (seen_.size() + together - 1) / together * together;
  c_rows_.assign(outputs_.size() * padded_, 0.0);
  d_rows_.clear();
  for (std::size_t o = 0; o < outputs_.size(); ++o) {
    const auto row = static_cast<Eigen::Index>(o);
    for (std::size_t i = 0; i < seen_.size(); ++i) c_rows_[o * padded_ + i] = c_(row, seen_[i]);
    for (Eigen::Index i = 0; i < m; ++i) d_rows_.push_back(d_(row, i));
  }
  row_scratch_.assign(2 * padded_, 0.0);
  remember_numbers(program, run);
}

void LinearPart::take_inputs(const std::vector<double>& y) {
  for (std::size_t i = 0; i < inputs_.size(); ++i) w_[static_cast<Eigen::Index>(i)] = y[at(inputs_[i])];
}

void LinearPart::write_outputs(std::vector<double>& y) const {
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    double sum = 0;
    for (Eigen::Index k = 0; k < w_.size(); ++k) sum += d_(row, k) * w_[k];
    for (Eigen::Index k = 0; k < n_; ++k) sum += c_(row, k) * x_[k];
    y[at(outputs_[i])] = sum;
  }
}

namespace {

/// A d = rate, row by row, for states have units of their own. What solving leaves is rounding; a state that cannot
/// rest leaves a share of its rate.
bool solves(const Eigen::MatrixXd& a, const Eigen::VectorXd& d, const Eigen::VectorXd& rate) {
  constexpr double rounding = 1e-9;  // of the terms of a row
  const Eigen::VectorXd terms = a.cwiseAbs() * d.cwiseAbs() + rate.cwiseAbs();
  return ((rate - a * d).array().abs() <= rounding * terms.array()).all();
}

/// An integrator whose input is not zero cannot rest; where everything else can, it moves on with one velocity, which
/// lies in the kernel of A: A (x - d) + B w = K c. Nothing where that has no solution either (a free mass that is
/// pushed).
std::optional<Eigen::VectorXd> to_steady_motion(const Eigen::MatrixXd& a, const Eigen::VectorXd& rate) {
  const Eigen::MatrixXd kernel = a.fullPivLu().kernel();
  Eigen::MatrixXd both(a.rows(), a.cols() + kernel.cols());
  both << a, kernel;
  const Eigen::VectorXd solution = both.completeOrthogonalDecomposition().solve(rate);
  if (!solves(both, solution, rate)) return std::nullopt;
  return solution.head(a.cols());
}

}  // namespace

void LinearPart::start(const Program& program, const Run& run, std::vector<double>& y, bool at_rest) {
  for (std::size_t k = 0; k < blocks_.size(); ++k)
    for (int i = 0; i < program.blocks[at(blocks_[k])].sizes.states; ++i)
      x_[first_state_[k] + i] = run.x[at(program.blocks[at(blocks_[k])].x_begin + i)];
  take_inputs(y);
  if (at_rest && n_ > 0) {
    // Least-norm correction: a free integrator keeps its value, everything else goes to A x + B w = 0.
    const Eigen::VectorXd rate = a_ * x_ + b_ * w_;
    if (!has_to_rest_) to_rest_.compute(a_);
    has_to_rest_ = true;
    const Eigen::VectorXd to_rest = to_rest_.solve(rate);
    x_ -= solves(a_, to_rest, rate) ? to_rest : to_steady_motion(a_, rate).value_or(to_rest);
  }
  w_before_ = w_;
  write_outputs(y);
}

/// A state is seen if an output reads it, or a state that is seen does.
void LinearPart::find_seen() {
  std::vector<bool> is_seen(at(n_));
  std::vector<int> open;
  const auto add = [&](int i) {
    if (is_seen[at(i)]) return;
    is_seen[at(i)] = true;
    open.push_back(i);
  };
  for (int i = 0; i < n_; ++i)
    if (!c_.col(i).isZero(0)) add(i);
  while (!open.empty()) {
    const int reader = open.back();
    open.pop_back();
    for (int i = 0; i < n_; ++i)
      if (a_(reader, i) != 0) add(i);
  }
  std::vector<int> seen;
  for (int i = 0; i < n_; ++i)
    if (is_seen[at(i)]) seen.push_back(i);
  if (seen == seen_) return;
  seen_ = std::move(seen);
  packed_.clear();
  packed_count_ = 0;
}

void LinearPart::find_mixing() {
  mixing_.clear();
  for (std::size_t i = 0; i < seen_.size(); ++i)
    if (std::any_of(seen_.begin(), seen_.end(), [&](int j) { return j != seen_[i] && a_(j, seen_[i]) != 0; }))
      mixing_.push_back(static_cast<int>(i));
}

LinearPart::Step LinearPart::make_long_step(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double h) {
  const auto n = a.rows();
  const double size = a.cwiseAbs().colwise().sum().maxCoeff() * h;
  const int halvings = std::max(0, std::ilogb(size) + 2);  // to a step in which A h is below one half
  const Eigen::MatrixXd first = a * std::ldexp(h, -halvings);
  // phi_1 = sum (A h)^k/(k + 1)!, phi_2 = sum (A h)^k/(k + 2)!: sixteen terms leave 2^-16/17! = 4e-20.
  Eigen::MatrixXd power = Eigen::MatrixXd::Identity(n, n), phi_1 = power, phi_2 = power / 2;
  double factorial = 1;
  for (int k = 1; k < 16; ++k) {
    power = power * first;
    factorial *= k + 1;
    phi_1 += power / factorial;
    phi_2 += power / (factorial * (k + 2));
  }
  Eigen::MatrixXd moved = first * phi_1;  // exp(A h) - 1: what decays slowly is as exact as what decays at once
  Eigen::MatrixXd constant = phi_1 * std::ldexp(h, -halvings), ramp = phi_2 * std::ldexp(h, -halvings);
  for (int k = 0; k < halvings; ++k) {
    ramp = ((moved * ramp + 2 * ramp + constant) / 2).eval();
    constant += (constant + moved * constant).eval();
    moved = (2 * moved + moved * moved).eval();
  }
  return {h, moved + Eigen::MatrixXd::Identity(n, n), constant * b, ramp * b};
}

LinearPart::Step LinearPart::make_step(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double h) {
  // Times the fastest time constant. The exponential of the large matrix below loses 3e-17 of it: 3e-11 at 1e6.
  constexpr double long_step = 1e4;
  if (a.size() > 0 && a.cwiseAbs().colwise().sum().maxCoeff() * h > long_step) return make_long_step(a, b, h);
  // exp of [[A, B, 0], [0, 0, I/h], [0, 0, 0]] h: the response to states, to constant inputs and to a unit ramp over h.
  const auto n = a.rows(), m = b.cols();
  Eigen::MatrixXd big = Eigen::MatrixXd::Zero(n + 2 * m, n + 2 * m);
  big.topLeftCorner(n, n) = a * h;
  big.block(0, n, n, m) = b * h;
  big.block(n, n + m, m, m).setIdentity();
  const Eigen::MatrixXd e = exponential(big);
  return {h, e.topLeftCorner(n, n), e.block(0, n, n, m), e.block(0, n + m, n, m)};
}

const LinearPart::Step& LinearPart::step_matrices(double h, double rounding) {
  const double same = std::max(1e-9 * h, rounding);  // times read from text differ in their last digits only
  if (last_ < cache_.size() && std::abs(cache_[last_].h - h) <= same) return cache_[last_];
  for (std::size_t i = 0; i < cache_.size(); ++i)
    if (std::abs(cache_[i].h - h) <= same) {
      last_ = i;
      return cache_[i];
    }
  if (cache_.size() >= most_steps_kept) cache_.clear();  // irregular times: do not grow without bound
  cache_.push_back(make_step(a_, b_, h));
  last_ = cache_.size() - 1;
  return cache_[last_];
}

void LinearPart::step(double h, double rounding, std::vector<double>& y) {
  take_inputs(y);
  if (n_ > 0 && h > rounding) {
    const Step& s = step_matrices(h, rounding);
    next_.noalias() = s.state * x_;
    for (Eigen::Index k = 0; k < w_.size(); ++k) {
      const double before = w_before_[k];
      const double change = w_[k] - before;
      if (before != 0)
        for (Eigen::Index i = 0; i < n_; ++i) next_[i] += s.input(i, k) * before;
      if (change != 0)
        for (Eigen::Index i = 0; i < n_; ++i) next_[i] += s.ramp(i, k) * change;
    }
    x_.swap(next_);
  }
  w_before_ = w_;
  write_outputs(y);
}

void LinearPart::refresh(std::vector<double>& y) {
  take_inputs(y);
  w_before_ = w_;
  if (feeds_through_) write_outputs(y);
}

void LinearPart::store(const Program& program, std::vector<double>& x) const {
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const BlockInstance& b = program.blocks[at(blocks_[k])];
    for (int i = 0; i < b.sizes.states; ++i) x[at(b.x_begin + i)] = x_[first_state_[k] + i];
  }
}

}  // namespace hysteron
