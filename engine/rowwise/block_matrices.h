// Decides what linear blocks are as matrices, one by one and wired together. Internal to the exact advance.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// The matrices of one block, read off its functions at unit vectors; the last column is its constant part.
struct BlockMatrices {
  Eigen::MatrixXd derivative, output;  ///< rows over [x, u, 1]
};

/// Linear blocks that are wired together: signals and rates as rows over [their states, the signals that they read from
/// others, 1].
struct BlockRows {
  const Program& program;
  std::span<const int> blocks;              ///< in value order
  std::vector<BlockMatrices> matrices;      ///< per block
  std::vector<Eigen::RowVectorXd> signals;  ///< per signal of the program; empty where not known

  /// For the parameters of `run`, at which the blocks are linear. Known are the signals that they read from others.
  BlockRows(const Program& program, const Run& run, std::span<const int> blocks, std::span<const int> read);
  /// Makes the outputs of the blocks known, none of which need each other's at the same instant.
  void follow_wires();
  /// Rates of all states, where the outputs are known.
  Eigen::MatrixXd rates() const;

 private:
  Eigen::RowVectorXd row(const Eigen::MatrixXd& matrix, int i, std::size_t block, bool with_inputs) const;
  std::vector<Eigen::Index> first_state_;  ///< per block, and behind the last
  Eigen::Index columns_ = 0;
};

}  // namespace hysteron
