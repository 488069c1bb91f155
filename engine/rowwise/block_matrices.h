// Decides what a linear block is as matrices. Internal to the exact advance.
#pragma once

#include <Eigen/Core>

#include "engine/program/program.h"

namespace hysteron {

/// The matrices of one block, read off its functions at unit vectors; the last column is its constant part.
struct BlockMatrices {
  Eigen::MatrixXd derivative, output;  ///< rows over [x, u, 1]
};

/// For the parameters of `run`, at which the block is linear.
BlockMatrices matrices_of(const Program& program, const Run& run, int block);

}  // namespace hysteron
