// Sources, and what stops, holds or counts at instants of its own, one block at a time as in single_blocks.cpp.
#include <algorithm>
#include <array>
#include <cmath>

#include "benchmarks/single_blocks.h"

namespace hysteron::benchmarks {
namespace {

/// A function of time.
template <class Law>
std::function<void(std::vector<double>&)> of_time(Law law) {
  return [law](std::vector<double>& y) {
    for (std::size_t k = 0; k < samples; ++k) y[k] = law(static_cast<double>(k) * row);
  };
}

Case source(const char* type, const std::vector<std::pair<std::string, Value>>& parameters,
            std::function<void(std::vector<double>&)> law) {
  return {type, node(type, parameters), {}, "", std::move(law), true};
}

std::vector<Case> sources() {
  std::vector<Case> all;
  all.push_back(
      source("ramp", {{"slope", "2 1/s"}, {"time", "1 s"}}, of_time([](double t) { return t < 1 ? 0 : 2 * (t - 1); })));
  // edges between rows, where rounding of the time does not decide
  all.push_back(
      source("pulse", {{"high", 1.0}, {"period", "77 ms"}, {"duty", 0.3}, {"time", "0.03 ms"}}, of_time([](double t) {
               const double periods = (t - 3e-5) / 0.077, phase = periods - std::floor(periods);
               return t > 3e-5 && phase < 0.3 ? 1.0 : 0.0;
             })));
  all.push_back(source("trapezoid",
                       {{"high", 1.0}, {"rise", "10 ms"}, {"top", "20 ms"}, {"fall", "15 ms"}, {"period", "77 ms"}},
                       of_time([](double t) {
                         const double s = t - 0.077 * std::floor(t / 0.077);
                         return std::max(0.0, std::min({1.0, s / 0.01, (0.045 - s) / 0.015}));
                       })));
  const std::vector<double> times{0, 1, 2.5, 3, 6, 8}, values{0, 1, -1, 2, 0, 1};
  all.push_back(source("time_table", {{"times", numbers(times, "s")}, {"values", numbers(values)}},
                       [times, values](std::vector<double>& y) {
                         std::size_t i = 0;
                         for (std::size_t k = 0; k < samples; ++k) {
                           const double t = static_cast<double>(k) * row;
                           while (i + 2 < times.size() && t >= times[i + 1]) ++i;
                           const double share = std::min(1.0, (t - times[i]) / (times[i + 1] - times[i]));
                           y[k] = values[i] + share * (values[i + 1] - values[i]);
                         }
                       }));
  return all;
}

/// Share of the way between two rows at which u passes 1/2.
double crossing(double before, double now) { return (0.5 - before) / (now - before); }

void hold_rows(std::vector<double>& y) {
  const auto &u = input(0), &trigger = input(1);
  double held = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    if (k > 0 && trigger[k - 1] <= 0.5 && trigger[k] > 0.5)
      held = u[k - 1] + crossing(trigger[k - 1], trigger[k]) * (u[k] - u[k - 1]);
    y[k] = held;
  }
}

void count_rows(std::vector<double>& y) {
  const auto &u = input(0), &reset = input(1);
  double count = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    if (k > 0 && u[k - 1] <= 0.5 && u[k] > 0.5) ++count;
    if (reset[k] > 0.5) count = 0;
    y[k] = count;
  }
}

void timer_rows(std::vector<double>& y) {
  const auto& u = input(0);
  double elapsed = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    if (u[k] <= 0.5)
      elapsed = 0;
    else if (k > 0)
      elapsed += row * (u[k - 1] > 0.5 ? 1 : 1 - crossing(u[k - 1], u[k]));
    y[k] = elapsed;
  }
}

void edge_rows(std::vector<double>& y) {
  const auto& u = input(0);
  for (std::size_t k = 0; k < samples; ++k) y[k] = k > 0 && u[k] > 0.5 && u[k - 1] <= 0.5 ? 1 : 0;
}

constexpr double lower = -0.004, upper = 0.006;

/// Within a row that touches a limit only what leads away from it counts.
double limited(double x, double before, double now) {
  const double free = x + 0.5 * row * (before + now);
  if (free >= lower && free <= upper && x > lower && x < upper) return free;
  const double turn = before * now < 0 ? before / (before - now) : 1;
  const auto clamped = [](double v) { return std::clamp(v, lower, upper); };
  const double at_turn = clamped(x + 0.5 * row * turn * (before + (turn < 1 ? 0 : now)));
  return turn < 1 ? clamped(at_turn + 0.5 * row * (1 - turn) * now) : at_turn;
}

void limited_rows(std::vector<double>& y) {
  const auto& u = input(0);
  double x = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    if (k > 0) x = limited(x, u[k - 1], u[k]);
    y[k] = x;
  }
}

/// Anew from `start` where the reset rises, at the instant of its edge.
void reset_rows(std::vector<double>& y) {
  const auto &u = input(0), &reset = input(1), &start = input(2);
  double x = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    if (k > 0 && reset[k - 1] <= 0.5 && reset[k] > 0.5) {
      const double c = crossing(reset[k - 1], reset[k]), there = u[k - 1] + c * (u[k] - u[k - 1]);
      x = start[k - 1] + c * (start[k] - start[k - 1]) + 0.5 * row * (1 - c) * (there + u[k]);
    } else if (k > 0) {
      x += 0.5 * row * (u[k - 1] + u[k]);
    }
    y[k] = x;
  }
}

}  // namespace

std::vector<Case> event_cases() {
  std::vector<Case> all = sources();
  all.push_back({"sample_and_hold", node("sample_and_hold", {}), {"", ""}, "", hold_rows, true});
  all.push_back({"counter", node("counter", {}), {"", ""}, "", count_rows, true});
  all.push_back({"timer", node("timer", {}), {""}, "", timer_rows, true});
  all.push_back({"edge", node("edge", {{"period", "0.1 ms"}}), {""}, "", edge_rows});
  all.push_back({"limited_integrator",
                 node("limited_integrator", {{"lower", "-4 ms"}, {"upper", "6 ms"}}),
                 {""},
                 "",
                 limited_rows,
                 true});
  all.push_back({"integrator_with_reset", node("integrator_with_reset", {}), {"", "", "s"}, "", reset_rows, true});
  all.push_back({"pwm",
                 node("pwm", {{"frequency", "200 Hz"}}),
                 {""},
                 "",
                 [](std::vector<double>& y) {
                   const auto& u = input(0);
                   for (std::size_t k = 0; k < samples; ++k) {
                     const double s = 200 * static_cast<double>(k) * row, phase = s - std::floor(s);
                     y[k] = u[k] > 1 - 4 * std::abs(phase - 0.5) ? 1 : -1;
                   }
                 },
                 true});
  return all;
}

}  // namespace hysteron::benchmarks
