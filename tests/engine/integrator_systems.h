// Systems with closed forms, for tests of the integrator.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/integrators/integrator.h"

namespace hysteron::test {

inline constexpr double pi = std::numbers::pi;

inline OdeSystem oscillator(double omega) {
  OdeSystem s;
  s.states = 2;
  s.derivative = [omega](double, const double* x, double* dx) {
    dx[0] = x[1];
    dx[1] = -omega * omega * x[0];
    return true;
  };
  s.state_name = [](int i) { return i == 0 ? "mass.x" : "mass.v"; };
  return s;
}

inline const std::array<double, 2> tight{1e-12, 1e-12};

// x_i' = (x_(i-1) - x_i)/tau, x_(-1) = 1: x_(n-1)(t) = 1 - exp(-t/tau) sum_(k<n) (t/tau)^k/k!.
inline constexpr double tau = 0.05;
inline OdeSystem chain_of_lags(int n) {
  OdeSystem s;
  s.states = n;
  s.derivative = [n](double, const double* x, double* dx) {
    for (int i = 0; i < n; ++i) dx[i] = ((i == 0 ? 1.0 : x[i - 1]) - x[i]) / tau;
    return true;
  };
  return s;
}
inline double end_of_chain(int n, double t) {
  double sum = 0, term = 1;
  for (int k = 0; k < n; ++k) {
    sum += term;
    term *= t / tau / (k + 1);
  }
  return 1 - std::exp(-t / tau) * sum;
}

inline OdeSystem chain_with_sparse_jacobian(int n) {
  auto s = chain_of_lags(n);
  for (int column = 0; column < n; ++column) {
    s.pattern.column_begin.push_back(static_cast<int>(s.pattern.row.size()));
    s.pattern.row.push_back(column);
    if (column + 1 < n) s.pattern.row.push_back(column + 1);
  }
  s.pattern.column_begin.push_back(static_cast<int>(s.pattern.row.size()));
  s.jacobian = [n](double, const double*, double* entries) {
    for (int k = 0; k < 2 * n - 1; ++k) entries[k] = k % 2 == 0 ? -1 / tau : 1 / tau;
    return true;
  };
  return s;
}
inline OdeSystem chain_with_full_jacobian(int n) {
  auto s = chain_of_lags(n);
  s.jacobian = [n](double, const double*, double* entries) {
    for (int column = 0; column < n; ++column)
      for (int row = 0; row < n; ++row)
        entries[column * n + row] = row == column ? -1 / tau : row == column + 1 ? 1 / tau : 0;
    return true;
  };
  return s;
}

}  // namespace hysteron::test
