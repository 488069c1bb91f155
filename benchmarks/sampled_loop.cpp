// A digital loop: 10 kHz PI (forward rule), inverse of Jiles-Atherton, the fourth-order plant, 10 s. By hand: the plant
// by its zero-order-hold matrices, the inverse law by one classical Runge-Kutta step a sample.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>

#include "benchmarks/diagrams.h"
#include "benchmarks/workloads.h"

namespace hysteron::benchmarks {
namespace {

constexpr double until = 10, period = 1e-4;                                               // [s]
constexpr double kp = .5265, ki = 1521;                                                   // [-], [1/s]
constexpr double p_s = 55.9973, a = 48.5843, alpha = .2512, pinning = 3.8892, c = .6929;  // [um], [V], [V/um], [V], [-]

/// dE/dP of the inverse law, E [V], P [um].
double inverse_slope(double field, double polarisation, double direction) {
  const double h = std::tanh((field + alpha * polarisation) / a);
  const double q = p_s * h - polarisation, s = c * p_s * (1 - h * h);
  const double g = direction * (1 - c) * pinning - alpha * q;
  return g * (a - alpha * s) / ((1 - c) * a * q + s * g);
}

std::vector<double> loop_by_hand() {
  const double w = std::pow(1.822e16, 0.25);
  Eigen::Matrix<double, 5, 5> m = Eigen::Matrix<double, 5, 5>::Zero();
  m(0, 1) = m(1, 2) = m(2, 3) = w;
  m.row(3) << -w, -4.981e12 / (w * w), -5.403e8 / w, -2.813e4, 1.377e16 / (w * w * w);
  const Eigen::Matrix<double, 5, 5> e = (m * period).exp();
  const auto samples = static_cast<std::size_t>(std::lround(until / period)) + 1;
  std::vector<double> y(samples);
  std::array<double, 4> x{}, next{};
  double integral = 0, wanted = 0, u = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    y[k] = x[0];
    const double t = static_cast<double>(k) * period;
    const double error = 3 + 3 * std::sin(2 * std::numbers::pi * 5 * t - std::numbers::pi / 2) - x[0];
    const double command = kp * error + integral;
    integral += ki * period * error;
    const double move = command - wanted, direction = move < 0 ? -1 : 1;
    const double k1 = inverse_slope(u, wanted, direction);
    const double k2 = inverse_slope(u + move / 2 * k1, wanted + move / 2, direction);
    const double k3 = inverse_slope(u + move / 2 * k2, wanted + move / 2, direction);
    const double k4 = inverse_slope(u + move * k3, command, direction);
    u += move / 6 * (k1 + 2 * (k2 + k3) + k4);
    wanted = command;
    for (int i = 0; i < 4; ++i) {
      double sum = e(i, 4) * u;
      for (int j = 0; j < 4; ++j) sum += e(i, j) * x[static_cast<std::size_t>(j)];
      next[static_cast<std::size_t>(i)] = sum;
    }
    x = next;
  }
  return y;
}

ProgramPointer loop_in_hysteron() {
  Diagram d;
  d.blocks["reference"] = thesis_sine("um");
  d.blocks["error"] = node("sum", {{"signs", "+-"}}, {"reference", "stage"});
  d.blocks["controller"] = node("sampled_pid",
                                {{"kp", kp},
                                 {"ki", Number{ki, "1/s"}},
                                 {"lower", "-inf um"},
                                 {"upper", "inf um"},
                                 {"rule", "forward"},
                                 {"anti_windup", "none"},
                                 {"period", "0.1 ms"}},
                                {"error"});
  d.blocks["inverse"] = node("sampled_jiles_atherton_inverse",
                             {{"p_s", Number{p_s, "um"}},
                              {"a", Number{a, "V"}},
                              {"alpha", Number{alpha, "V/um"}},
                              {"k", Number{pinning, "V"}},
                              {"c", c},
                              {"period", "0.1 ms"}},
                             {"controller"});
  d.blocks["stage"] = thesis_plant("inverse", "1 um/V");
  d.record = {"stage"};
  return compiled(d);
}

void by_hand(benchmark::State& state) {
  std::vector<double> y;
  for (auto _ : state) y = loop_by_hand();
  state.counters["error"] = 0;
}

void in_hysteron(benchmark::State& state, Method method) {
  const auto program = loop_in_hysteron();
  const SimulateOptions options{.until = until, .every = period, .method = method, .relative_tolerance = 1e-6};
  Traces traces;
  for (auto _ : state) traces = simulate(*program, start(*program), options);
  state.counters["error"] = largest_error(scaled(traces.values[0], 1 / um), loop_by_hand());
  state.counters["steps"] = static_cast<double>(traces.statistics.steps);
  state.counters["calls"] = static_cast<double>(traces.statistics.evaluations);
}

}  // namespace

void register_sampled_loop() {
  const std::string group = "sampled loop, 10 kHz";
  benchmark::RegisterBenchmark((group + "/by hand").c_str(), by_hand);
  benchmark::RegisterBenchmark((group + "/hysteron").c_str(), in_hysteron, Method::automatic);
  benchmark::RegisterBenchmark((group + "/hysteron runge_kutta").c_str(), in_hysteron, Method::runge_kutta);
}

}  // namespace hysteron::benchmarks
