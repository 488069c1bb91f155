#include "engine/program/loop_equations.h"

#include <algorithm>

#include "engine/program/steps.h"

namespace hysteron::loop_equations {
namespace {

constexpr double singular = 1e-13;  // of the other pivots: no slope to speak of

}  // namespace

bool evaluate(LoopSolver& s, const Program& program, const Loop& loop) {
  const int n = static_cast<int>(loop.tears.size());
  bool finite = true;
  for (int first = 0; first < n; first += Jet::directions) {
    const int last = std::min(n, first + Jet::directions);
    for (int j = 0; j < n; ++j) {
      Jet tear(s.v[at(j)]);
      if (j >= first && j < last) tear.slope[j - first] = 1;
      number(s.jets, loop.tears[at(j)]) = tear;
    }
    steps::run(loop.steps, program, s.jets, s.x.data());
    ++s.evaluations;
    for (int i = 0; i < n; ++i) {
      const Jet& made = number(s.jets, loop.tears[at(i)]);
      s.residual[at(i)] = made.value - s.v[at(i)];
      finite = finite && std::isfinite(s.residual[at(i)]);
      for (int j = first; j < last; ++j) s.slope[at(i * n + j)] = (i == j ? 1.0 : 0.0) - made.slope[j - first];
    }
  }
  return finite;
}

bool factor(LoopSolver& s, const Loop& loop) {
  const int n = static_cast<int>(loop.tears.size());
  // In tolerances, over the relative one: about the size of the number, never zero.
  for (int i = 0; i < n; ++i) s.scale[at(i)] = tolerance(s, loop, i);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) s.factors[at(i * n + j)] = s.slope[at(i * n + j)] * (s.scale[at(j)] / s.scale[at(i)]);
  double largest = 0;
  for (int i = 0; i < n * n; ++i) largest = std::max(largest, std::abs(s.factors[at(i)]));
  s.weakest = 1;
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(s.factors[at(i * n + k)]) > std::abs(s.factors[at(pivot * n + k)])) pivot = i;
    s.pivots[at(k)] = pivot;
    const double p = s.factors[at(pivot * n + k)];
    // Against what cancelled to make it: 1 - dF/dv, where both are about one.
    s.weakest = std::min(s.weakest, std::abs(p) / std::max(1.0, largest));
    if (!(std::abs(p) > singular * std::max(1.0, largest))) return false;
    for (int j = 0; pivot != k && j < n; ++j) std::swap(s.factors[at(k * n + j)], s.factors[at(pivot * n + j)]);
    for (int i = k + 1; i < n; ++i) {
      const double share = s.factors[at(i * n + k)] /= p;
      for (int j = k + 1; j < n; ++j) s.factors[at(i * n + j)] -= share * s.factors[at(k * n + j)];
    }
  }
  return true;
}

void back_substitute(LoopSolver& s, int n) {
  auto& b = s.step;
  for (int i = 0; i < n; ++i) b[at(i)] = s.right[at(i)] / s.scale[at(i)];
  for (int k = 0; k < n; ++k) {
    std::swap(b[at(k)], b[at(s.pivots[at(k)])]);
    for (int i = k + 1; i < n; ++i) b[at(i)] -= s.factors[at(i * n + k)] * b[at(k)];
  }
  for (int k = n - 1; k >= 0; --k) {
    for (int j = k + 1; j < n; ++j) b[at(k)] -= s.factors[at(k * n + j)] * b[at(j)];
    b[at(k)] /= s.factors[at(k * n + k)];
  }
  for (int i = 0; i < n; ++i) b[at(i)] *= s.scale[at(i)];
}

}  // namespace hysteron::loop_equations
