// Decides how a matrix is decomposed where several rooms of the engine need it: Eigen's algorithms, made into code in
// one place, because each place costs ten seconds of a build. Internal to the engine.
#pragma once

#include <Eigen/Core>

namespace hysteron {

/// e^a of a square matrix, by scaling and squaring of a Pade approximant (Higham, SIAM J. Matrix Anal. Appl. 26 (2005)
/// 1179-1193).
Eigen::MatrixXd exponential(const Eigen::MatrixXd& a);

/// Eigenvalues of a square matrix of finite numbers, by the QR algorithm; none where it does not converge.
Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXd& a);

/// a v_i = values_i v_i, with v_i the columns of `vectors`, each of length one.
struct EigenPairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};
/// Of a square matrix of finite numbers; multiple eigenvalues leave `vectors` without an inverse.
EigenPairs eigen_pairs(const Eigen::MatrixXd& a);

}  // namespace hysteron
