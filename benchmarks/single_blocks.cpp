// One block at a time on 100 001 recorded rows 0.1 ms apart, as a fit passes them, against a loop written for its law:
// time per row. Linear laws by hand are recursions with matrix exponentials and straight inputs, as the advance has
// them; other states go one step of Runge-Kutta a row; sampled blocks run at every row.
#include "benchmarks/single_blocks.h"

#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <numbers>

#include "benchmarks/workloads.h"
#include "engine/rowwise/advance.h"

namespace hysteron::benchmarks {
namespace {

struct Model {
  ProgramPointer program;
  Run run;
  std::shared_ptr<const std::vector<double>> instants;
};

Model model_of(const Case& c) {
  Diagram d;
  Node block = c.block;
  for (std::size_t i = 0; i < c.units.size(); ++i) {
    const std::string name = "u" + std::to_string(i);
    d.inputs[name].unit = c.units[i];
    block.in.push_back({"", name});
  }
  d.blocks["b"] = block;
  d.outputs["y"] = "b" + c.output;
  Model m{compiled(d), {}, nullptr};
  m.run = start(*m.program);
  std::vector<double> t(samples);
  for (std::size_t k = 0; k < samples; ++k) t[k] = static_cast<double>(k) * row;
  for (std::size_t i = 0; i < c.units.size(); ++i)
    bind_input(*m.program, m.run, "u" + std::to_string(i),
               std::make_shared<const Series>(Series{t, input(i), Between::linear}));
  m.instants = std::make_shared<const std::vector<double>>(std::move(t));
  return m;
}

void tell_error(const Case& c, const std::vector<double>& values, benchmark::State& state) {
  std::vector<double> y(samples);
  c.by_hand(y);
  double size = 0;
  for (const double v : y) size = std::max(size, std::abs(v));
  state.counters["error"] = largest_error(values, y) / size;
}

void simulated_rows(const Case& c, const Model& m, benchmark::State& state) {
  SimulateOptions options;
  options.instants = *m.instants;
  options.signals = m.program->output_signals;
  Traces traces;
  for (auto _ : state) traces = simulate(*m.program, m.run, options);
  tell_error(c, traces.values[0], state);
}

void register_case(const Case& c) {
  const std::string group = "rows of " + c.name;
  benchmark::RegisterBenchmark((group + "/by hand").c_str(), [c](benchmark::State& state) {
    std::vector<double> y(samples);
    for (auto _ : state) {
      c.by_hand(y);
      benchmark::DoNotOptimize(y.data());
      benchmark::ClobberMemory();
    }
  });
  benchmark::RegisterBenchmark((group + "/hysteron").c_str(), [c](benchmark::State& state) {
    const Model m = model_of(c);
    if (c.simulated) return simulated_rows(c, m, state);
    Advance advance(m.program, m.program->output_signals);
    Columns values;
    AdvanceOptions options;
    options.at_rest = false;
    for (auto _ : state) advance(m.run, m.instants, options, values);
    tell_error(c, values[0], state);
  });
}

/// A law of one input without states.
template <class Law>
std::function<void(std::vector<double>&)> row_by_row(Law law) {
  return [law](std::vector<double>& y) {
    const auto& u = input(0);
    for (std::size_t k = 0; k < samples; ++k) y[k] = law(u[k]);
  };
}

std::vector<Case> linear_cases() {
  std::vector<Case> all;
  {
    const double z = tau * 20, p = tau * 90;
    const Recursion<1> law(Eigen::Matrix<double, 1, 1>(-p), Eigen::Matrix<double, 1, 1>(p),
                           Eigen::Matrix<double, 1, 1>(1 - p / z), p / z);
    all.push_back({"lead_lag", node("lead_lag", {{"zero", "20 Hz"}, {"pole", "90 Hz"}}), {""}, "", [law](auto& y) {
                     law(input(0), y);
                   }});
  }
  {
    const double w = tau * 50, d = 0.6, depth = 0.1;
    Eigen::Matrix2d a;
    a << 0, w, -w, -2 * d * w;
    const Recursion<2> law(a, Eigen::Vector2d(0, w), Eigen::RowVector2d(0, -2 * d * (1 - depth)), 1);
    all.push_back(
        {"notch", node("notch", {{"frequency", "50 Hz"}, {"damping", d}, {"depth", depth}}), {""}, "", [law](auto& y) {
           law(input(0), y);
         }});
  }
  {
    const double w = tau * 40, d = 0.3;
    Eigen::Matrix2d a;
    a << 0, w, -w, -2 * d * w;
    const Recursion<2> law(a, Eigen::Vector2d(0, w), Eigen::RowVector2d(1, 0), 0);
    all.push_back(
        {"second_order", node("second_order", {{"frequency", "40 Hz"}, {"damping", d}}), {""}, "", [law](auto& y) {
           law(input(0), y);
         }});
  }
  {
    const double w = tau * 40, v = tau * 90;  // two low-passes
    Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
    a.row(0) << 0, w, 0, 0;
    a.row(1) << -w, -2 * 0.3 * w, 0, 0;
    a.row(2) << 0, 0, 0, v;
    a.row(3) << v, 0, -v, -2 * 0.7 * v;
    const Recursion<4> law(a, Eigen::Vector4d(0, w, 0, 0), Eigen::RowVector4d(0, 0, 1, 0), 0);
    all.push_back({"biquads (2)",
                   node("biquads", {{"zero_frequencies", numbers({HUGE_VAL, HUGE_VAL}, "Hz")},
                                    {"zero_dampings", numbers({0, 0})},
                                    {"pole_frequencies", numbers({40, 90}, "Hz")},
                                    {"pole_dampings", numbers({0.3, 0.7})}}),
                   {""},
                   "",
                   [law](auto& y) { law(input(0), y); }});
  }
  {
    const double r = 4, l = 8e-3, k = 12;
    all.push_back({"voice_coil",
                   node("voice_coil", {{"force_constant", "12 N/A"}, {"resistance", "4 ohm"}, {"inductance", "8 mH"}}),
                   {"V", "m/s"},
                   ".force",
                   [=](auto& y) {
                     const Recursion<1> law(Eigen::Matrix<double, 1, 1>(-r / l), Eigen::Matrix<double, 1, 1>(1 / l),
                                            Eigen::Matrix<double, 1, 1>(k), 0);
                     const auto &v = input(0), &s = input(1);
                     double x = 0;
                     for (std::size_t i = 0; i < samples; ++i) {
                       if (i > 0) {
                         const double before = v[i - 1] - k * s[i - 1], change = v[i] - k * s[i] - before;
                         x = law.a[0][0] * x + law.b[0] * before + law.ramp[0] * change;
                       }
                       y[i] = k * x;
                     }
                   }});
  }
  return all;
}

std::vector<Case> sampled_cases() {
  std::vector<Case> all;
  {
    const double k = std::tan(std::numbers::pi * 300 * row);
    std::array<std::array<double, 5>, 2> sections{};  // Butterworth of order 4: pairs of damping cos(pi/8), cos(3 pi/8)
    for (std::size_t i = 0; i < 2; ++i) {
      const double q = 2 * std::sin(std::numbers::pi * (i == 0 ? 3 : 1) / 8), under = 1 + q * k + k * k;
      sections[i] = {k * k / under, 2 * k * k / under, k * k / under, (2 * k * k - 2) / under,
                     (1 - q * k + k * k) / under};
    }
    all.push_back({"digital_filter (order 4)",
                   node("digital_filter", {{"order", 4.0}, {"corner", "300 Hz"}, {"period", "0.1 ms"}}),
                   {""},
                   "",
                   [sections](auto& y) {
                     std::array<double, 4> w{};
                     const auto& in = input(0);
                     for (std::size_t i = 0; i < samples; ++i) {
                       double u = in[i];
                       for (std::size_t s = 0; s < 2; ++s) {
                         const auto& c = sections[s];
                         const double out = c[0] * u + w[2 * s];
                         w[2 * s] = c[1] * u - c[3] * out + w[2 * s + 1];
                         w[2 * s + 1] = c[2] * u - c[4] * out;
                         u = out;
                       }
                       y[i] = u;
                     }
                   }});
  }
  const std::vector<double> taps{0.05, 0.1, 0.2, 0.3, 0.2, 0.1, 0.03, 0.02};
  const auto past_sum = [](const std::vector<double>& weights) {
    return [weights](std::vector<double>& y) {
      const auto& u = input(0);
      for (std::size_t k = 0; k < samples; ++k) {
        double sum = 0;
        for (std::size_t i = 0; i < weights.size() && i <= k; ++i) sum += weights[i] * u[k - i];
        y[k] = sum;
      }
    };
  };
  all.push_back(
      {"fir (8)", node("fir", {{"coefficients", numbers(taps)}, {"period", "0.1 ms"}}), {""}, "", past_sum(taps)});
  all.push_back({"moving_average (8)",
                 node("moving_average", {{"samples", 8.0}, {"period", "0.1 ms"}}),
                 {""},
                 "",
                 past_sum(std::vector<double>(8, 0.125))});
  all.push_back({"discrete_integrator",
                 node("discrete_integrator", {{"rule", "trapezoidal"}, {"period", "0.1 ms"}}),
                 {""},
                 "",
                 [](auto& y) {
                   const auto& u = input(0);
                   double x = 0;
                   for (std::size_t k = 0; k < samples; ++k) {
                     y[k] = x + 0.5 * row * u[k];
                     x += row * u[k];
                   }
                 }});
  return all;
}

/// A law of two inputs without states.
template <class Law>
std::function<void(std::vector<double>&)> two_row_by_row(Law law) {
  return [law](std::vector<double>& y) {
    const auto &u = input(0), &v = input(1);
    for (std::size_t k = 0; k < samples; ++k) y[k] = law(u[k], v[k]);
  };
}

std::vector<Case> static_cases() {
  std::vector<Case> all;
  all.push_back({"abs", node("abs", {}), {""}, "", row_by_row([](double u) { return std::abs(u); })});
  all.push_back({"min_max", node("min_max", {}), {"", ""}, "", two_row_by_row([](double u, double v) {
                   return std::max(u, v);
                 })});
  all.push_back({"compare", node("compare", {{"is", "less"}}), {"", ""}, "", two_row_by_row([](double u, double v) {
                   return u < v ? 1.0 : 0.0;
                 })});
  all.push_back({"trigonometry", node("trigonometry", {{"function", "sin"}}), {""}, "", row_by_row([](double u) {
                   return std::sin(u);
                 })});
  all.push_back({"expression",
                 node("expression", {{"y", "a*sin(b*u) + max(u, 0)"}, {"a", 0.7}, {"b", 3.0}}),
                 {""},
                 "",
                 row_by_row([](double u) { return 0.7 * std::sin(3 * u) + std::max(u, 0.0); })});
  const std::array<double, 7> at{-1, -0.6, -0.3, 0, 0.3, 0.6, 1}, values{0.2, 0.5, 0.8, 0.9, 0.7, 0.4, 0.1};
  all.push_back(
      {"lookup (7 knots)",
       node("lookup", {{"at", numbers({at.begin(), at.end()})}, {"values", numbers({values.begin(), values.end()})}}),
       {""},
       "",
       row_by_row([=](double u) {
         if (u <= at.front()) return values.front();
         if (u >= at.back()) return values.back();
         std::size_t k = 1;
         while (u > at[k]) ++k;
         return values[k - 1] + (u - at[k - 1]) / (at[k] - at[k - 1]) * (values[k] - values[k - 1]);
       })});
  return all;
}

std::vector<Case> machine_cases() {
  std::vector<Case> all;
  all.push_back({"pendulum",
                 node("pendulum", {{"mass", "2 kg"}, {"length", "0.5 m"}, {"damping", "0.1 N*m*s/rad"}}),
                 {"N*m"},
                 ".angle",
                 [](auto& y) {
                   runge_kutta_rows<2, 1>(
                       {0, 0}, y,
                       [](const auto& x, const auto& u) {
                         return std::array<double, 2>{
                             x[1], (u[0] - 0.1 * x[1] - 2 * 9.80665 * 0.5 * std::sin(x[0])) / (2 * 0.5 * 0.5)};
                       },
                       [](const auto& x, const auto&) { return x[0]; });
                 }});
  all.push_back({"propeller",
                 node("propeller", {{"thrust_coefficient", "2e-5 N*s^2/rad^2"}, {"time", "50 ms"}}),
                 {"rad/s"},
                 ".thrust",
                 [](auto& y) {
                   runge_kutta_rows<1, 1>(
                       {0}, y, [](const auto& x, const auto& u) { return std::array<double, 1>{(u[0] - x[0]) / 0.05}; },
                       [](const auto& x, const auto&) { return 2e-5 * x[0] * std::abs(x[0]); });
                 }});
  all.push_back({"battery_cell (1 pair)",
                 node("battery_cell", {{"capacity", "100 C"},
                                       {"resistance", "20 mohm"},
                                       {"charges", numbers({0, 0.2, 0.8, 1})},
                                       {"open_circuit", numbers({3, 3.5, 3.8, 4.2}, "V")},
                                       {"resistances", numbers({0.01}, "ohm")},
                                       {"times", numbers({2}, "s")},
                                       {"initial", 0.7}}),
                 {"A"},
                 ".voltage",
                 [](auto& y) {
                   runge_kutta_rows<2, 1>(
                       {0.7, 0}, y,
                       [](const auto& x, const auto& u) {
                         return std::array<double, 2>{-u[0] / 100, (u[0] - x[1]) / 2};
                       },
                       [](const auto& x, const auto& u) {
                         const double open = x[0] > 0.8   ? 3.8 + (x[0] - 0.8) * 2
                                             : x[0] > 0.2 ? 3.5 + (x[0] - 0.2) / 2
                                                          : 3 + x[0] * 2.5;
                         return open - 0.02 * u[0] - 0.01 * x[1];
                       });
                 }});
  all.push_back({"synchronous_motor",
                 node("synchronous_motor", {{"resistance", "0.4 ohm"},
                                            {"inductance_d", "20 mH"},
                                            {"inductance_q", "30 mH"},
                                            {"flux", "0.05 V*s"},
                                            {"pole_pairs", 4.0}}),
                 {"V", "V", "rad/s"},
                 ".torque",
                 [](auto& y) {
                   runge_kutta_rows<2, 3>(
                       {0, 0}, y,
                       [](const auto& x, const auto& u) {
                         const double w = 4 * u[2];
                         return std::array<double, 2>{(u[0] - 0.4 * x[0] + w * 0.03 * x[1]) / 0.02,
                                                      (u[1] - 0.4 * x[1] - w * (0.02 * x[0] + 0.05)) / 0.03};
                       },
                       [](const auto& x, const auto&) { return 1.5 * 4 * x[1] * (0.05 - 0.01 * x[0]); });
                 }});
  all.push_back({"linear_encoder",
                 node("linear_encoder", {{"pitch", "0.02 m"}, {"divisions", 400.0}, {"error_sine", "1e-4 m"}}),
                 {"m"},
                 "",
                 row_by_row([](double u) {
                   const double q = 0.02 / 400;
                   return q * std::round((u + 1e-4 * std::sin(tau * u / 0.02)) / q);
                 })});
  all.push_back(
      {"h_bridge", node("h_bridge", {{"supply", "24 V"}, {"resistance", "0.1 ohm"}}), {"", "A"}, "", [](auto& y) {
         const auto &g = input(0), &i = input(1);
         for (std::size_t k = 0; k < samples; ++k) y[k] = 24 * g[k] - 0.1 * i[k];
       }});
  return all;
}

}  // namespace

void register_single_blocks() {
  for (const auto& cases : {static_cases(), linear_cases(), sampled_cases(), machine_cases(), drive_cases(),
                            more_cases(), event_cases(), observer_cases()})
    for (const auto& c : cases) register_case(c);
}

}  // namespace hysteron::benchmarks
