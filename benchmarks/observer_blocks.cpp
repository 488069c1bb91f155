// What estimates or learns from sample to sample, one block at a time as in single_blocks.cpp, at every row.
#include <array>
#include <cmath>

#include "benchmarks/single_blocks.h"

namespace hysteron::benchmarks {
namespace {

/// x+ = A x + B u + L (measured - C x); the first state.
void observer_rows(std::vector<double>& y) {
  const auto &u = input(0), &measured = input(1);
  double p = 0, q = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    y[k] = p;
    const double miss = measured[k] - p;
    const double next = 0.98 * p + 0.1 * q + 0.3 * miss;
    q = -0.1 * p + 0.9 * q + 0.05 * u[k] + 0.2 * miss;
    p = next;
  }
}

/// The same for a rate of drift and a measured position: x+ = x + drift + L miss; stationary gains by iteration.
void kalman_rows(std::vector<double>& y) {
  const auto &u = input(0), &measured = input(1);
  double a = 1, b = 0, d = 1;  // covariance before the measurement
  for (int i = 0; i < 10000; ++i) {
    const double s = a + 0.01, ka = a / s, kb = b / s;
    const double ua = a - ka * a, ub = b - ka * b, ud = d - kb * b;
    a = ua + 2 * 0.1 * ub + 0.01 * ud + 1e-4;
    b = ub + 0.1 * ud;
    d = ud + 1e-4;
  }
  const double ka = (a + 0.1 * b) / (a + 0.01), kb = b / (a + 0.01);  // A P C' / (C P C' + R)
  double p = 0, q = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    y[k] = p;
    const double miss = measured[k] - p;
    const double next = p + 0.1 * q + ka * miss;
    q = q + 0.05 * u[k] + kb * miss;
    p = next;
  }
}

void disturbance_rows(std::vector<double>& y) {
  const auto &command = input(0), &speed = input(1);
  const double s = 1 - std::exp(-tau * 50 * row), rate = s * 0.02 / row;
  double z = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    const double momentum = rate * speed[k], disturbance = momentum - z;
    y[k] = command[k] - disturbance;
    z += s * (y[k] + momentum - z);
  }
}

/// w_k = e_k + keep w_(k - 50), y_k = gain keep w_(k - 50 + 2)
void repetitive_rows(std::vector<double>& y) {
  const auto& e = input(0);
  constexpr std::size_t cycle = 50, lead = 2;
  std::array<double, cycle> last{};
  for (std::size_t k = 0; k < samples; ++k) {
    y[k] = 0.5 * 0.9 * last[(k + lead) % cycle];
    last[k % cycle] = e[k] + 0.9 * last[k % cycle];
  }
}

}  // namespace

std::vector<Case> observer_cases() {
  std::vector<Case> all;
  all.push_back({"observer (2)",
                 node("observer", {{"a", matrix({{0.98, 0.1}, {-0.1, 0.9}})},
                                   {"b", matrix({{0}, {0.05}})},
                                   {"c", matrix({{1, 0}})},
                                   {"gain", matrix({{0.3}, {0.2}})},
                                   {"period", "0.1 ms"}}),
                 {"", ""},
                 "[0]",
                 observer_rows});
  all.push_back({"kalman_filter (2)",
                 node("kalman_filter", {{"a", matrix({{1, 0.1}, {0, 1}})},
                                        {"b", matrix({{0}, {0.05}})},
                                        {"c", matrix({{1, 0}})},
                                        {"process_noise", matrix({{1e-4, 0}, {0, 1e-4}})},
                                        {"measurement_noise", matrix({{0.01}})},
                                        {"period", "0.1 ms"}}),
                 {"", ""},
                 "[0]",
                 kalman_rows});
  all.push_back({"disturbance_observer",
                 node("disturbance_observer", {{"inertia", "0.02 s"}, {"corner", "50 Hz"}, {"period", "0.1 ms"}}),
                 {"", ""},
                 ".y",
                 disturbance_rows});
  all.push_back({"repetitive_controller",
                 node("repetitive_controller",
                      {{"samples", 50.0}, {"gain", 0.5}, {"lead", 2.0}, {"keep", 0.9}, {"period", "0.1 ms"}}),
                 {""},
                 "",
                 repetitive_rows});
  return all;
}

}  // namespace hysteron::benchmarks
