// Decides the matrices of a block that is linear in its states and inputs, read off its own functions.
#pragma once

#include <Eigen/Core>

#include "engine/program/program.h"

namespace hysteron {

/// x' = A x + B u, y = C x + D u + y0, SI.
struct LinearBlock {
  Eigen::MatrixXd a, b, c, d;
  Eigen::VectorXd y0;
  bool rests = true;  ///< x' = 0 at x = 0, u = 0
};

/// Of a block that declares itself linear, has no modes and does not ask for rates.
LinearBlock linear_block(const Program& program, const Run& run, int block);

/// The matrix as a parameter of a diagram, SI.
NumberMatrix written_matrix(const Eigen::MatrixXd& matrix);

/// It does, and may be written so.
bool is_linear_block(const BlockInstance& block);

}  // namespace hysteron
