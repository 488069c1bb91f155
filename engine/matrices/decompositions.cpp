#include "engine/matrices/decompositions.h"

#include <Eigen/Eigenvalues>
#include <unsupported/Eigen/MatrixFunctions>

namespace hysteron {

Eigen::MatrixXd exponential(const Eigen::MatrixXd& a) { return a.exp(); }

Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXd& a) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(a, false);
  if (solver.info() != Eigen::Success) return {};
  return solver.eigenvalues();
}

EigenPairs eigen_pairs(const Eigen::MatrixXd& a) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace hysteron
