// Decides how tests of stability write down loops by hand. Holds no expectation.
#pragma once

#include <vector>

#include "engine/analysis/linearize.h"

namespace hysteron::tools {

/// num(s)/den(s) exp(-s delay), highest power first; den[0] = 1, num shorter than or as long as den. Without a dead
/// time
/// (`delay` < 0) there is no channel; with one, of 0 s too, there is.
inline LinearModel loop_of(std::vector<double> num, const std::vector<double>& den, double delay = -1) {
  const std::size_t n = den.size() - 1;
  num.insert(num.begin(), den.size() - num.size(), 0.0);
  LinearModel m;
  m.states = static_cast<int>(n);
  m.inputs = m.outputs = 1;
  m.a.assign(n * n, 0.0);
  m.b.assign(n, 0.0);
  std::vector<double> c(n);
  for (std::size_t i = 0; i + 1 < n; ++i) m.a[i * n + i + 1] = 1;
  for (std::size_t j = 0; j < n; ++j) {
    m.a[(n - 1) * n + j] = -den[n - j];
    c[j] = num[n - j] - num[0] * den[n - j];
  }
  if (n > 0) m.b[n - 1] = 1;
  m.c = c;
  m.d = {num[0]};
  if (delay < 0) return m;
  m.delays = {delay};
  m.factors = {1.0};
  m.to_delays = c;
  m.to_delays_from_inputs = {num[0]};
  m.c.assign(n, 0.0);
  m.d = {0.0};
  m.b_delayed.assign(n, 0.0);
  m.d_delayed = {1.0};
  m.between_delays = {0.0};
  return m;
}

inline std::vector<double> product(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> p(a.size() + b.size() - 1, 0.0);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) p[i + j] += a[i] * b[j];
  return p;
}

}  // namespace hysteron::tools
