#include "engine/rowwise/block_matrices.h"

#include <vector>

#include "engine/diagram/index.h"

namespace hysteron {
namespace {

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

}  // namespace

BlockRows::BlockRows(const Program& p, const Run& run, std::span<const int> members, std::span<const int> read)
    : program(p), blocks(members), signals(p.signals.size()) {
  Eigen::Index states = 0;
  for (const int b : blocks) {
    matrices.push_back(matrices_of(program, run, b));
    first_state_.push_back(states);
    states += program.blocks[at(b)].sizes.states;
  }
  first_state_.push_back(states);
  columns_ = states + static_cast<Eigen::Index>(read.size()) + 1;
  Eigen::Index place = states;
  for (const int s : read) signals[at(s)] = Eigen::RowVectorXd::Unit(columns_, place++);
}

Eigen::RowVectorXd BlockRows::row(const Eigen::MatrixXd& matrix, int i, std::size_t block, bool with_inputs) const {
  const BlockInstance& b = program.blocks[at(blocks[block])];
  Eigen::RowVectorXd r = Eigen::RowVectorXd::Zero(columns_);
  for (int k = 0; k < b.sizes.states; ++k) r[first_state_[block] + k] += matrix(i, k);
  for (int k = 0; k < b.n_u && with_inputs; ++k)
    if (matrix(i, b.sizes.states + k) != 0) r += matrix(i, b.sizes.states + k) * signals[at(b.source[at(k)])];
  r[columns_ - 1] += matrix(i, b.sizes.states + b.n_u);
  return r;
}

/// First all outputs that need no input (they close the loops), then the rest in value order.
void BlockRows::follow_wires() {
  for (const bool feedthrough : {false, true})
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      const BlockInstance& b = program.blocks[at(blocks[k])];
      if (b.sizes.feedthrough != feedthrough) continue;
      for (int o = 0; o < b.sizes.outputs; ++o) signals[at(b.y_begin + o)] = row(matrices[k].output, o, k, feedthrough);
    }
}

Eigen::MatrixXd BlockRows::rates() const {
  Eigen::MatrixXd all(first_state_.back(), columns_);
  for (std::size_t k = 0; k < blocks.size(); ++k)
    for (int i = 0; i < program.blocks[at(blocks[k])].sizes.states; ++i)
      all.row(first_state_[k] + i) = row(matrices[k].derivative, i, k, true);
  return all;
}

}  // namespace hysteron
