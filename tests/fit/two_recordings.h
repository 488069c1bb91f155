// Two recordings and small models of them, for the tests of fits.
#pragma once

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "fit/estimate/fit.h"
#include "tests/fit/lab.h"

namespace hysteron::lab {

inline double sweep(double t) { return 5 + 5 * std::sin(2 * std::numbers::pi * (0.5 * t + 0.4 * t * t)); }
inline double decaying(double t) { return 5 * (1 - std::exp(-t) * std::cos(2 * std::numbers::pi * 2 * t)); }

inline DataSet two_recordings(std::size_t rows = 400, double step = 0.01) {
  DataSet data;
  data.notes["u"].to = "u";
  data.notes["y"].to = "y";
  data.notes["y"].noise.white = 10e-9;
  data.notes["y"].noise.one_over_f = 0.0;
  data.recordings = {recording("train", Role::train, step, rows, sweep),
                     recording("validate", Role::validate, step, rows, decaying)};
  return data;
}

inline const ParameterEstimate& estimate(const FitResult& r, const std::string& path) {
  for (const auto& e : r.estimates)
    if (e.path == path) return e;
  throw std::runtime_error("no estimate of " + path);
}

inline Diagram plays(int n, const std::string& sides = "one") {
  Diagram d = diagram("core");
  auto& core = add(d, "core", "prandtl_ishlinskii", "u");
  NumberList thresholds, weights;
  for (int i = 0; i < n; ++i) {
    thresholds.push_back({static_cast<double>(i), "V"});
    weights.push_back({i == 0 ? 1.0 : 0.1, "um/V"});
  }
  core.parameters["thresholds"] = thresholds;
  core.parameters["weights"] = weights;
  core.parameters["sides"] = sides;
  return d;
}

inline Diagram lag_and_gain() {
  Diagram d = diagram("g");
  add(d, "amplifier", "lag", "u").parameters["times"] = NumberList{{50, "ms"}};
  add(d, "g", "gain", "amplifier").parameters["gain"] = "1 um/V";
  return d;
}

}  // namespace hysteron::lab
