#include "export/c/linear_block.h"

namespace hysteron {
namespace {

using Vector = Eigen::VectorXd;

/// Calls one function of a block at the given states and inputs; zero where it has none.
Vector call(void (*function)(const View<double>&), View<double> v, const Vector& x, const Vector& u,
            Eigen::Index count) {
  Vector out = Vector::Zero(count);
  v.x = x.data();
  v.u = u.data();
  v.out = out.data();
  if (function != nullptr) function(v);
  return out;
}

}  // namespace

LinearBlock linear_block(const Program& program, const Run& run, int block) {
  const BlockInstance& b = program.blocks[static_cast<std::size_t>(block)];
  const View<double> v = view_of(program, run, block);
  const Eigen::Index n = b.sizes.states, m = b.n_u, p = b.sizes.outputs;
  const Vector x0 = Vector::Zero(n), u0 = Vector::Zero(m);
  const Vector rate0 = call(b.kernel->derivative, v, x0, u0, n), y0 = call(b.kernel->output, v, x0, u0, p);
  LinearBlock l{{n, n}, {n, m}, {p, n}, {p, m}, y0, rate0.isZero(0)};
  for (Eigen::Index k = 0; k < n; ++k) {
    const Vector x = Vector::Unit(n, k);
    l.a.col(k) = call(b.kernel->derivative, v, x, u0, n) - rate0;
    l.c.col(k) = call(b.kernel->output, v, x, u0, p) - y0;
  }
  for (Eigen::Index k = 0; k < m; ++k) {
    const Vector u = Vector::Unit(m, k);
    l.b.col(k) = call(b.kernel->derivative, v, x0, u, n) - rate0;
    l.d.col(k) = call(b.kernel->output, v, x0, u, p) - y0;
  }
  return l;
}

NumberMatrix written_matrix(const Eigen::MatrixXd& matrix) {
  NumberMatrix written;
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    NumberList row;
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) row.push_back({matrix(r, k), {}});
    written.rows.push_back(std::move(row));
  }
  return written;
}

bool is_linear_block(const BlockInstance& b) {
  return b.kernel->declaration.is_linear && !b.kernel->has_modes() && !b.kernel->is_sampled() && !b.sizes.history &&
         b.sizes.memory == 0 && !b.kernel->derivative_wants_rate && b.n_u >= 1;
}

}  // namespace hysteron
