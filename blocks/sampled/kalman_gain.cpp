#include "blocks/sampled/kalman_gain.h"

#include <Eigen/Dense>
#include <limits>

namespace hysteron::blocks {
namespace {

using Eigen::MatrixXd;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Every round doubles the time: more than a thousand million instants are no use of a filter.
constexpr int most_rounds = 30;

struct Plant {
  MatrixXd a, c, q, r;
  explicit Plant(const NoisyPlant& p)
      : a(Eigen::Map<const Rows>(p.a.data(), p.states, p.states)),
        c(Eigen::Map<const Rows>(p.c.data(), p.measured, p.states)),
        q(Eigen::Map<const Rows>(p.process_noise.data(), p.states, p.states)),
        r(Eigen::Map<const Rows>(p.measurement_noise.data(), p.measured, p.measured)) {}
};

std::vector<double> row_by_row(const MatrixXd& m) {
  std::vector<double> all(static_cast<std::size_t>(m.size()));
  Eigen::Map<Rows>(all.data(), m.rows(), m.cols()) = m;
  return all;
}

MatrixXd covariance(const Plant& plant) {
  const MatrixXd one = MatrixXd::Identity(plant.a.rows(), plant.a.cols());
  const MatrixXd none = MatrixXd::Constant(plant.a.rows(), plant.a.cols(), std::numeric_limits<double>::quiet_NaN());
  const Eigen::LDLT<MatrixXd> noise(plant.r);
  if (!noise.isPositive() || !(noise.vectorD().minCoeff() > 0)) return none;
  MatrixXd f = plant.a.transpose(), g = plant.c.transpose() * noise.solve(plant.c), p = plant.q;
  for (int round = 0; round < most_rounds && p.allFinite(); ++round) {
    const Eigen::PartialPivLU<MatrixXd> lu(one + g * p);
    const MatrixXd moved = lu.solve(f), growth = f.transpose() * p * moved;
    g += (f * lu.solve(g) * f.transpose()).eval();
    f = (f * moved).eval();
    p += 0.5 * (growth + growth.transpose());
    if (p.allFinite() && growth.cwiseAbs().maxCoeff() <= 1e-15 * p.cwiseAbs().maxCoeff()) return p;
  }
  return none;
}

}  // namespace

std::vector<double> prediction_covariance(const NoisyPlant& plant) { return row_by_row(covariance(Plant(plant))); }

std::vector<double> kalman_gain(const NoisyPlant& given) {
  const Plant plant(given);
  const MatrixXd p = covariance(plant), innovation = plant.c * p * plant.c.transpose() + plant.r;
  // The decomposition would make zeros of what is no number.
  if (!p.allFinite()) return std::vector<double>(static_cast<std::size_t>(p.rows() * plant.c.rows()), p(0, 0));
  return row_by_row(innovation.ldlt().solve(plant.c * p * plant.a.transpose()).transpose());
}

}  // namespace hysteron::blocks
