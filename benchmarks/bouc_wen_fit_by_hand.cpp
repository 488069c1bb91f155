#include "benchmarks/bouc_wen_fit_by_hand.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

namespace hysteron::benchmarks {
namespace {

/// z and its slopes by alpha, beta, gamma.
using State = std::array<double, 4>;

State slope(const std::array<double, 4>& p, double direction, const State& s) {
  const double z = s[0];
  const double by_z = -p[1] - direction * p[2] * (z < 0 ? -1 : 1);  // of dz/dx for x = |u - u_start|
  return {direction * p[0] + by_z * z, direction + by_z * s[1], -z + by_z * s[2],
          -direction * std::abs(z) + by_z * s[3]};
}

State moved(const State& s, double h, const State& k) {
  return {s[0] + h * k[0], s[1] + h * k[1], s[2] + h * k[2], s[3] + h * k[3]};
}

State step(const std::array<double, 4>& p, double du, const State& s) {
  const double d = du < 0 ? -1 : 1, h = std::abs(du);
  const State k1 = slope(p, d, s);
  const State k2 = slope(p, d, moved(s, h / 2, k1));
  const State k3 = slope(p, d, moved(s, h / 2, k2));
  const State k4 = slope(p, d, moved(s, h, k3));
  State next = s;
  for (std::size_t i = 0; i < 4; ++i) next[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  return next;
}

struct Normal {
  Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  double squares = 0;
};

/// J'J, J'r and r'r of one run.
Normal run(const std::vector<double>& u, const std::vector<double>& y, const std::array<double, 4>& p) {
  Normal n;
  State s{};
  for (std::size_t k = 0; k < u.size(); ++k) {
    if (k > 0) s = step(p, u[k] - u[k - 1], s);
    const double r = p[3] * u[k] - s[0] - y[k];
    const Eigen::Vector4d j(-s[1], -s[2], -s[3], u[k]);
    n.a.noalias() += j * j.transpose();
    n.b.noalias() += j * r;
    n.squares += r * r;
  }
  if (!std::isfinite(n.squares)) n.squares = std::numeric_limits<double>::infinity();
  return n;
}

}  // namespace

std::vector<double> bouc_wen_by_hand(const std::vector<double>& u, const std::array<double, 4>& p) {
  std::vector<double> y;
  State s{};
  for (std::size_t k = 0; k < u.size(); ++k) {
    if (k > 0) s = step(p, u[k] - u[k - 1], s);
    y.push_back(p[3] * u[k] - s[0]);
  }
  return y;
}

BoucWenFit fit_bouc_wen_by_hand(const std::vector<double>& u, const std::vector<double>& y,
                                const std::array<double, 4>& start, const std::array<double, 4>& low,
                                const std::array<double, 4>& high) {
  BoucWenFit fit{start, 0, 1};
  Normal now = run(u, y, fit.p);
  double damping = 1e-3, growth = 2;  // Nielsen, IMM-REP-1999-05
  for (int i = 0; i < 200 && damping < 1e15; ++i) {
    Eigen::Matrix4d a = now.a;
    a.diagonal() += damping * now.a.diagonal();
    const Eigen::Vector4d change = a.ldlt().solve(-now.b);
    std::array<double, 4> trial{};
    Eigen::Vector4d step;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto e = static_cast<Eigen::Index>(k);
      trial[k] = std::clamp(fit.p[k] + change[e], low[k], high[k]);
      step[e] = trial[k] - fit.p[k];
    }
    const Normal there = run(u, y, trial);
    ++fit.runs;
    const double foretold = -step.dot(2 * now.b + now.a * step);
    const double gain = (now.squares - there.squares) / foretold;
    if (there.squares < now.squares) {
      const bool done = now.squares - there.squares < 1e-9 * now.squares;
      fit.p = trial;
      now = there;
      damping *= std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3));
      damping = std::max(damping * .3, 1e-12);
      growth = 2;
      if (done) break;
    } else {
      if (std::abs(foretold) < 1e-9 * now.squares) break;
      damping *= growth;
      growth *= 2;
    }
  }
  fit.rms = std::sqrt(now.squares / static_cast<double>(u.size()));
  return fit;
}

}  // namespace hysteron::benchmarks
