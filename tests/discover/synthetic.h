// Decides how small recordings for tests are made, by formulas of their own: not by the blocks that are to be found.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "engine/diagram/diagram.h"
#include "io/data/dataset.h"

namespace hysteron::testing {

inline std::vector<double> rows(int n, double step) {
  std::vector<double> t(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) t[static_cast<std::size_t>(k)] = k * step;
  return t;
}

inline std::vector<double> sampled(const std::vector<double>& t, const std::function<double(double)>& f) {
  std::vector<double> v;
  for (const double x : t) v.push_back(f(x));
  return v;
}

/// A decaying triangle 0 .. `top` with `periods` periods, amplitudes falling to 20 %.
inline std::vector<double> decaying_triangle(const std::vector<double>& t, double top, int periods) {
  return sampled(t, [&, T = t.back()](double x) {
    const double phase = x / T * periods;
    const double a = top * (1 - 0.8 * std::floor(std::min(phase, periods - 1e-9)) / std::max(periods - 1, 1));
    const double p = phase - std::floor(phase);
    return a * (p < 0.5 ? 2 * p : 2 - 2 * p);
  });
}

/// Sum of sines that starts at zero.
inline std::vector<double> several_sines(const std::vector<double>& t, double top, const std::vector<double>& hertz) {
  return sampled(t, [&](double x) {
    double sum = 0;
    for (const double f : hertz) sum += 0.5 * (1 - std::cos(2 * std::numbers::pi * f * x));
    return top * sum / static_cast<double>(hertz.size());
  });
}

/// Levels, each held for the same time; the step takes one row.
inline std::vector<double> levels(const std::vector<double>& t, const std::vector<double>& values) {
  return sampled(t, [&, T = t.back()](double x) {
    const auto k = static_cast<std::size_t>(std::min(x / T, 1 - 1e-9) * static_cast<double>(values.size()));
    return x == 0 ? 0.0 : values[k];
  });
}

/// White noise, and 1/f noise as a sum of slow relaxations.
inline std::vector<double> noise(std::size_t n, double white, double slow, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::vector<double> v(n);
  std::vector<double> state(6, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    v[k] = white * normal(engine);
    double sum = 0;
    double tau = 3;
    for (auto& s : state) {
      const double keep = std::exp(-1 / tau);
      if (k == 0) s = normal(engine);
      s = keep * s + std::sqrt(1 - keep * keep) * normal(engine);
      sum += s;
      tau *= 4;
    }
    v[k] += slow * sum / std::sqrt(6.0);
  }
  return v;
}

inline Recording recording(const std::string& name, Role role, std::vector<double> t, std::vector<double> u,
                           std::vector<double> y) {
  Recording r;
  r.name = r.file = name;
  r.role = role;
  r.first = 0;
  r.last = t.size();
  r.t = std::move(t);
  r.columns["u"] = std::move(u);
  r.columns["y"] = std::move(y);
  r.units["u"] = parse_unit("V");
  r.units["y"] = parse_unit("m");
  return r;
}

inline DataSet data_set(std::vector<Recording> recordings, double white, double one_over_f = 0.3) {
  DataSet d;
  d.notes["u"].to = "u";
  d.notes["y"].to = "y";
  if (white > 0) d.notes["y"].noise.white = white;
  if (white > 0) d.notes["y"].noise.one_over_f = one_over_f;
  d.recordings = std::move(recordings);
  return d;
}

/// u -> gain 1 m/V -> y, exact.
inline Diagram plain_gain() {
  Diagram d;
  d.title = "gain";
  d.inputs["u"].unit = "V";
  Node& g = d.blocks["stage"];
  g.type = "gain";
  g.parameters["gain"] = Value("1 m/V");
  g.in = {{"", "u"}};
  d.outputs["y"] = "stage";
  return d;
}

/// Two axes without a word between them: u -> y, u2 -> y2.
inline Diagram two_plain_axes() {
  Diagram d = plain_gain();
  d.inputs["u2"].unit = "V";
  const Node stage = d.blocks["stage"];
  d.blocks["stage2"] = stage;
  d.blocks["stage2"].in = {{"", "u2"}};
  d.outputs["y2"] = "stage2";
  return d;
}

/// 1 kg on 400 N/m with 4 N s/m, driven by a force of some newtons: 3 Hz.
inline Diagram mass_on_spring() {
  Diagram d;
  d.inputs["u"].unit = "V";
  Node& force = d.blocks["force"];
  force.type = "gain";
  force.parameters["gain"] = Value("10 N/V");
  force.in = {{"", "u"}};
  Node& stage = d.blocks["stage"];
  stage.type = "mass_spring_damper";
  stage.parameters["mass"] = Value("1 kg");
  stage.parameters["stiffness"] = Value("400 N/m");
  stage.parameters["damping"] = Value("4 N s/m");
  stage.in = {{"", "force"}};
  d.outputs["y"] = "stage.position";
  return d;
}

}  // namespace hysteron::testing
