#include "engine/rowwise/block_matrices.h"

#include <vector>

#include "engine/diagram/index.h"

namespace hysteron {

BlockMatrices matrices_of(const Program& program, const Run& run, int block) {
  const BlockInstance& b = program.blocks[at(block)];
  const int nx = b.sizes.states;
  const int columns = nx + b.n_u + 1;
  std::vector<double> x(at(nx)), u(at(b.n_u)), dx(at(nx)), y(at(b.sizes.outputs));
  BlockMatrices m{Eigen::MatrixXd::Zero(nx, columns), Eigen::MatrixXd::Zero(b.sizes.outputs, columns)};
  const auto call = [&](int column) {
    View<double> v = view_of(program, run, block);
    v.x = x.data();
    v.u = u.data();
    v.out = y.data();
    b.kernel->output(v);
    m.output.col(column) = Eigen::Map<const Eigen::VectorXd>(y.data(), b.sizes.outputs);
    if (nx == 0) return;
    v.out = dx.data();
    b.kernel->derivative(v);
    m.derivative.col(column) = Eigen::Map<const Eigen::VectorXd>(dx.data(), nx);
  };
  call(columns - 1);
  for (int i = 0; i < columns - 1; ++i) {
    double& unit = i < nx ? x[at(i)] : u[at(i - nx)];
    unit = 1;
    call(i);
    unit = 0;
    m.output.col(i) -= m.output.col(columns - 1);
    if (nx > 0) m.derivative.col(i) -= m.derivative.col(columns - 1);
  }
  return m;
}

}  // namespace hysteron
