#include "engine/analysis/block_slopes.h"

#include "engine/diagram/index.h"
#include "engine/program/steps.h"

namespace hysteron {

bool BlockSlopes::cuts() const {
  const bool through_states = !c.isZero(0) && (!b.isZero(0) || !r.isZero(0));
  return d.isZero(0) && !through_states;
}

LocalSlopes::LocalSlopes(const Program& program, const Run& run)
    : program_(program), run_(run), values_(program), jets_(program) {
  evaluate_derivatives(program, run, values_, run.t, run.x.data());
  throw_if_unsolved(program, values_, run.t);
  evaluate_memory_rates(program, run, values_, run.t, run.x.data());
  evaluate_values(program, run, values_, run.t, run.x.data());
  throw_if_unsolved(program, values_, run.t);
  jets_.refresh(run);
  steps::begin(program, run, jets_, run.t);
}

void LocalSlopes::evaluate(int block, int first) {
  const BlockInstance& b = program_.blocks[at(block)];
  const bool sampled = b.hit_index >= 0;
  const int n = sampled ? b.sizes.sampled_states : b.sizes.states, m = b.n_u;
  const auto seeded = [&](double value, int column) {
    Jet jet(value);
    const int k = column - first;
    if (k >= 0 && k < Jet::directions) jet.slope[k] = 1;
    return jet;
  };
  x_.resize(at(n));
  u_.resize(at(m));
  du_.resize(at(m));
  for (int i = 0; i < n; ++i) x_[at(i)] = seeded(sampled ? run_.m[at(b.m_begin + i)] : run_.x[at(b.x_begin + i)], i);
  for (int i = 0; i < m; ++i) {
    u_[at(i)] = seeded(values_.y[at(b.source[at(i)])], n + i);
    du_[at(i)] = seeded(values_.rate[at(b.source[at(i)])], n + m + i);
  }
  m_.resize(at(b.sizes.memory));
  y_.assign(at(b.sizes.outputs), Jet());
  dx_.assign(at(n), Jet());
  const Functions<Jet>& call = b.kernel->functions<Jet>();
  View<Jet> v = jets_.views[at(block)];
  v.x = x_.data();
  v.u = u_.data();
  v.du = du_.data();
  v.y = nullptr;
  if (sampled) v.hit = run_.hits[at(b.hit_index)];
  if (b.sizes.memory > 0) {
    v.out = m_.data();
    call.advance(v);
    v.m = m_.data();
  }
  v.out = y_.data();
  call.output(v);
  if (n == 0) return;
  v.out = dx_.data();
  if (sampled && call.update != nullptr) call.update(v);
  if (!sampled && call.derivative != nullptr) call.derivative(v);
}

BlockSlopes LocalSlopes::operator()(int block) {
  const BlockInstance& b = program_.blocks[at(block)];
  const int n = b.hit_index >= 0 ? b.sizes.sampled_states : b.sizes.states, m = b.n_u, p = b.sizes.outputs;
  BlockSlopes s{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, m), Eigen::MatrixXd::Zero(n, m),
                Eigen::MatrixXd::Zero(p, n), Eigen::MatrixXd::Zero(p, m)};
  if (b.history_index >= 0 || is_off(program_, run_, b)) return s;
  const int columns = n + m + (b.kernel->derivative_wants_rate ? m : 0);
  for (int first = 0; first < columns; first += Jet::directions) {
    evaluate(block, first);
    for (int k = 0; k < Jet::directions && first + k < columns; ++k) {
      const int column = first + k;
      for (int i = 0; i < n; ++i) {
        auto& where = column < n ? s.a(i, column) : column < n + m ? s.b(i, column - n) : s.r(i, column - n - m);
        where = dx_[at(i)].slope[k];
      }
      for (int i = 0; i < p && column < n + m; ++i)
        (column < n ? s.c(i, column) : s.d(i, column - n)) = y_[at(i)].slope[k];
    }
  }
  if (!b.sizes.feedthrough) s.d.setZero();  // it may have read what is not its own
  return s;
}

}  // namespace hysteron
