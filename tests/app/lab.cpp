// Decides the small laboratory of these tests: a diagram that works, recordings of a known law, and ways to spoil them.
#include "tests/app/lab.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>

namespace hysteron::lab {

std::string recording(int rows, double extra) {
  std::string text = "t [s],u [V],y [um]\n";
  for (int i = 0; i < rows; ++i) {
    const double phase = 0.02 * i - std::floor(0.02 * i);
    const double u = phase < 0.5 ? 4 * phase : 4 - 4 * phase;  // 0 .. 2 V, period 0.5 s
    text += fmt::format("{:.2f},{:.6f},{:.6f}\n", 0.01 * i, u, 1.5 * u + 0.2 + extra);
  }
  return text;
}

namespace {

double triangle(double t) {
  const double phase = 2 * t - std::floor(2 * t);
  return phase < 0.5 ? 4 * phase : 4 - 4 * phase;
}

/// A lag of a signal that is a straight line between rows: y' = (u - y) / tau, exactly.
double lagged(double y, double from, double to, double step, double tau) {
  const double slope = (to - from) / step;
  return to - slope * tau + (y - from + slope * tau) * std::exp(-step / tau);
}

/// Normal numbers by Box and Muller from a generator that is the same on every machine.
class Noise {
 public:
  explicit Noise(unsigned seed) : generator_(seed) {}
  double operator()() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  double uniform() { return (static_cast<double>(generator_()) + 0.5) / 4294967296.0; }
  std::mt19937 generator_;
};

}  // namespace

std::string noisy_recording(unsigned seed, double tau) {
  constexpr double step = 0.005;
  Noise noise(seed);
  std::string text = "t [s],u [V],y [um]\n";
  double v = 0;
  for (int i = 0; i < 600; ++i) {
    const double u = triangle(step * i);
    v = tau > 0 && i > 0 ? lagged(v, triangle(step * (i - 1)), u, step, tau) : u;
    text += fmt::format("{:.3f},{:.6f},{:.6f}\n", step * i, u, 1.5 * v + 0.2 + 0.005 * noise());
  }
  return text;
}

std::string diagram() {
  return R"({
  "format": 1,
  "title": "Stage",
  "parameters": {"gain": {"value": 1.5, "unit": "um/V", "bounds": [0, 10], "free": true}},
  "inputs": {"u": {"unit": "V"}},
  "blocks": {
    "actuator": {"type": "gain", "gain": "$gain", "in": "u"},
    "sensor":   {"type": "calibration", "gain": 1, "offset": "0.2 um", "in": "actuator"}
  },
  "outputs": {"y": "sensor"},
  "record": ["actuator", "sensor"]
}
)";
}

std::string dataset() {
  return R"({
  "format": 1, "title": "two recordings",
  "columns": {"u": {"to": "u"}, "y": {"to": "y", "noise": "1 nm"}},
  "recordings": [
    {"file": "a.csv", "role": "train"},
    {"file": "b.csv", "role": "validate"}
  ]
}
)";
}

void furnish(const process::Folder& folder) {
  folder.write("diagram.json", diagram());
  folder.write("dataset.json", dataset());
  folder.write("a.csv", recording());
  folder.write("b.csv", recording(150));
}

}  // namespace hysteron::lab
