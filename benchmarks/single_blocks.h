// Decides how one block is timed on recorded rows: its inputs, what a case is, and how laws by hand go through them.
// Holds no law.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <unsupported/Eigen/MatrixFunctions>
#include <vector>

#include "benchmarks/diagrams.h"

namespace hysteron::benchmarks {

inline constexpr std::size_t samples = 100'001;
inline constexpr double row = 1e-4;  // [s]
inline constexpr double tau = 2 * std::numbers::pi;

using Columns = std::vector<std::vector<double>>;

/// Input i of at most four: between -1 and 1, from rest.
inline const std::vector<double>& input(std::size_t i) {
  static const Columns all = [] {
    Columns columns(4, std::vector<double>(samples));
    for (std::size_t c = 0; c < columns.size(); ++c)
      for (std::size_t k = 0; k < samples; ++k) {
        const double t = static_cast<double>(k) * row;
        columns[c][k] = 0.7 * std::sin(tau * (5 + 3.1 * static_cast<double>(c)) * t) + 0.3 * std::sin(tau * 17 * t);
      }
    return columns;
  }();
  return all[i];
}

/// A block, the units of its inputs, and its law: inputs, then where the first output goes.
struct Case {
  std::string name;
  Node block;
  std::vector<std::string> units;
  std::string output;
  std::function<void(std::vector<double>& y)> by_hand;
  bool simulated = false;  ///< not advanced row by row: the diagram is simulated, with the same rows
};

/// x+ = A x + B u + R (u+ - u), y = C x + D u, of x' = a x + b u.
template <int n>
struct Recursion {
  std::array<std::array<double, n>, n> a{};  // by columns
  std::array<double, n> b{}, ramp{}, c{};
  double d = 0;
  Recursion(const Eigen::Matrix<double, n, n>& rates, const Eigen::Matrix<double, n, 1>& in,
            const Eigen::Matrix<double, 1, n>& out, double direct)
      : d(direct) {
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n + 2, n + 2);
    m.topLeftCorner(n, n) = rates;
    m.block(0, n, n, 1) = in;
    m(n, n + 1) = 1 / row;
    const Eigen::MatrixXd e = (m * row).exp();
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) a[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] = e(i, j);
      b[static_cast<std::size_t>(i)] = e(i, n);
      ramp[static_cast<std::size_t>(i)] = e(i, n + 1);
      c[static_cast<std::size_t>(i)] = out(i);
    }
  }
  void operator()(const std::vector<double>& u, std::vector<double>& y) const {
    std::array<double, n> x{}, next{};
    for (std::size_t k = 0; k < samples; ++k) {
      if (k > 0) {
        const double before = u[k - 1], change = u[k] - before;
        for (std::size_t i = 0; i < n; ++i) next[i] = b[i] * before + ramp[i] * change;
        for (std::size_t j = 0; j < n; ++j)
          for (std::size_t i = 0; i < n; ++i) next[i] += a[j][i] * x[j];
        x = next;
      }
      double sum = d * u[k];
      for (std::size_t i = 0; i < n; ++i) sum += c[i] * x[i];
      y[k] = sum;
    }
  }
};

/// One step of Runge-Kutta a row: rates(x, u) with straight inputs; output(x).
template <std::size_t n, std::size_t m, class Rates, class Output>
void runge_kutta_rows(std::array<double, n> x, std::vector<double>& y, const Rates& rates, const Output& output) {
  using State = std::array<double, n>;
  using In = std::array<double, m>;
  const auto at = [](std::size_t k) {
    In u;
    for (std::size_t i = 0; i < m; ++i) u[i] = input(i)[k];
    return u;
  };
  const auto ahead = [](const State& s, double h, const State& k) {
    State moved;
    for (std::size_t i = 0; i < n; ++i) moved[i] = s[i] + h * k[i];
    return moved;
  };
  In before = at(0);
  for (std::size_t k = 0; k < samples; ++k) {
    const In now = at(k);
    if (k > 0) {
      In middle;
      for (std::size_t i = 0; i < m; ++i) middle[i] = 0.5 * (before[i] + now[i]);
      const State k1 = rates(x, before), k2 = rates(ahead(x, row / 2, k1), middle),
                  k3 = rates(ahead(x, row / 2, k2), middle), k4 = rates(ahead(x, row, k3), now);
      for (std::size_t i = 0; i < n; ++i) x[i] += row / 6 * (k1[i] + 2 * (k2[i] + k3[i]) + k4[i]);
    }
    before = now;
    y[k] = output(x, now);
  }
}

inline Value matrix(const Columns& rows) {
  NumberMatrix m;
  for (const auto& cells : rows) {
    m.rows.emplace_back();
    for (const double cell : cells) m.rows.back().push_back({cell, {}});
  }
  return Value(m);
}

/// A law of so many inputs without states.
template <std::size_t m, class Law>
std::function<void(std::vector<double>&)> of_inputs(Law law) {
  return [law](std::vector<double>& y) {
    std::array<const double*, m> in;
    for (std::size_t i = 0; i < m; ++i) in[i] = input(i).data();
    for (std::size_t k = 0; k < samples; ++k) {
      std::array<double, m> u;
      for (std::size_t i = 0; i < m; ++i) u[i] = in[i][k];
      y[k] = law(u);
    }
  };
}

/// What controllers, motors and machines of states cost: drive_blocks.cpp.
std::vector<Case> drive_cases();
/// What bends, switches, winds or is moved: more_blocks.cpp.
std::vector<Case> more_cases();
/// Sources, and what stops, holds or counts at instants of its own: event_blocks.cpp.
std::vector<Case> event_cases();
/// What estimates or learns from sample to sample: observer_blocks.cpp.
std::vector<Case> observer_cases();

}  // namespace hysteron::benchmarks
