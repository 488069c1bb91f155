// Decides how tests of the simulation build diagrams by hand, bind series, and read golden traces. Holds no
// expectation.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "blocks/register_all.h"
#include "engine/program/program.h"
#include "engine/simulate/simulate.h"

namespace hysteron::tools {

using Parameters = std::vector<std::pair<std::string, Value>>;

inline const Registry& registry() {
  static const Registry all = all_blocks();
  return all;
}

inline Node block(std::string type, const Parameters& parameters, const std::vector<std::string>& in = {}) {
  Node node;
  node.type = std::move(type);
  for (const auto& [name, value] : parameters) node.parameters[name] = value;
  for (const auto& from : in) node.in.push_back({"", from});
  return node;
}

inline Value list(const std::vector<double>& values, const std::string& unit = "") {
  NumberList numbers;
  for (const double v : values) numbers.push_back(unit.empty() ? Number{v, {}} : Number{v, unit});
  return Value(std::move(numbers));
}

inline Diagram diagram(const std::vector<std::pair<std::string, Node>>& blocks, std::vector<std::string> record,
                       const std::vector<std::pair<std::string, std::string>>& inputs = {}) {
  Diagram d;
  for (const auto& [name, unit] : inputs) d.inputs[name].unit = unit;
  for (const auto& [name, node] : blocks) d.blocks[name] = node;
  d.record = std::move(record);
  return d;
}

inline ProgramPointer compiled(const Diagram& d) { return compile(d, registry()); }

inline SeriesPointer series(std::vector<double> t, std::vector<double> v, Between between = Between::linear) {
  return std::make_shared<const Series>(Series{std::move(t), std::move(v), between});
}

/// x at each t, for x' = rate(time, x, row that the step leads to) and x = 0 at the first: classical Runge-Kutta, so
/// many steps from row to row.
template <class Rate>
std::vector<double> integrated_by_hand(const std::vector<double>& t, int substeps, Rate rate) {
  std::vector<double> x{0};
  for (std::size_t i = 1; i < t.size(); ++i) {
    double now = x.back();
    const double h = (t[i] - t[i - 1]) / substeps;
    for (int k = 0; k < substeps; ++k) {
      const double s = t[i - 1] + k * h;
      const double k1 = rate(s, now, i), k2 = rate(s + h / 2, now + h / 2 * k1, i),
                   k3 = rate(s + h / 2, now + h / 2 * k2, i), k4 = rate(s + h, now + h * k3, i);
      now += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    x.push_back(now);
  }
  return x;
}

/// Trace number `i` of what was recorded.
inline const std::vector<double>& trace(const Traces& traces, std::size_t i = 0) { return traces.values.at(i); }

inline double largest(const std::vector<double>& v) {
  double m = 0;
  for (const double x : v) m = std::max(m, std::abs(x));
  return m;
}

/// Largest difference, failing where the lengths differ or a number is not finite (a comparison that checks nothing is
/// none).
inline double distance(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  EXPECT_FALSE(a.empty());
  double worst = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const double d = std::abs(a[i] - b[i]);
    if (!std::isfinite(d)) {
      ADD_FAILURE() << "not finite at row " << i;
      return d;
    }
    worst = std::max(worst, d);
  }
  return worst;
}

/// The largest distance of a signal from that of b, over the largest value of that.
inline double relative_distance(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
  double worst = 0;
  for (std::size_t s = 0; s < a.size(); ++s) worst = std::max(worst, distance(a[s], b[s]) / largest(b[s]));
  return worst;
}

inline Number number(double value, std::string unit) { return {value, std::move(unit)}; }

inline std::vector<double> grid(double begin, double until, int steps) {
  std::vector<double> t;
  for (int k = 0; k <= steps; ++k) t.push_back(begin + (until - begin) * k / steps);
  return t;
}

// The thesis' devices: SPEC 2.1, 2.3, 2.4. Lengths in um as written, so that what is recorded is in m.
inline const std::vector<double> thesis_weights{.7521, .1381, .0775, .0651, .0658, .0522, .0506, .0523, .0520, .1169};
inline const std::vector<double> thesis_thresholds{0, .6, 1.2, 1.8, 2.4, 3.0, 3.6, 4.2, 4.8, 5.4};

inline Node thesis_plant(const std::string& in) {
  return block("transfer_function",
               {{"num", list({1.377e16})}, {"den", list({1, 2.813e4, 5.403e8, 4.981e12, 1.822e16})}}, {in});
}
inline Node thesis_bouc_wen(const std::string& in) {
  return block("bouc_wen",
               {{"alpha", "0.6187 um/V"}, {"beta", "0.2418 1/V"}, {"gamma", "0.0237 1/V"}, {"d_p", "1.6126 um/V"}},
               {in});
}
inline Node thesis_operators(const std::string& in) {
  return block("prandtl_ishlinskii",
               {{"thresholds", list(thesis_thresholds, "V")}, {"weights", list(thesis_weights, "um/V")}}, {in});
}
inline Node thesis_controller(int number, const std::string& in) {
  if (number == 1) return block("pi_controller", {{"kp", "1.207 V/um"}, {"ki", "7009 V/um/s"}}, {in});
  return block("pi_controller", {{"kp", "0.5265 V/um"}, {"ki", "1521 V/um/s"}}, {in});
}
/// 0 .. 2 A with 5 Hz from its minimum, SPEC 1.
inline Node thesis_wave(const std::string& type, const std::string& amplitude) {
  return block(type, {{"amplitude", amplitude}, {"offset", amplitude}, {"frequency", "5 Hz"}, {"phase", "-90 deg"}});
}

/// W1 of the workloads: PI control of a plant behind Bouc-Wen hysteresis.
inline Diagram bouc_wen_loop() {
  return diagram({{"reference", thesis_wave("sine", "3 um")},
                  {"error", block("sum", {{"signs", "+-"}}, {"reference", "stage"})},
                  {"controller", thesis_controller(1, "error")},
                  {"hysteresis", thesis_bouc_wen("controller")},
                  {"stage", thesis_plant("hysteresis")}},
                 {"stage", "controller"});
}

/// Ten play operators in front of a stage of two states, position feedback.
inline Diagram play_loop() {
  return diagram(
      {{"reference", thesis_wave("sine", "3 um")},
       {"error", block("sum", {{"signs", "+-"}}, {"reference", "stage"})},
       {"amplifier", block("gain", {{"gain", "1.5 V/um"}}, {"error"})},
       {"hysteresis", thesis_operators("amplifier")},
       {"stage", block("transfer_function", {{"num", list({1e6})}, {"den", list({1, 400, 1e6})}}, {"hysteresis"})}},
      {"stage", "hysteresis"});
}

/// Columns of a golden trace by their name without unit; empty where ../shared is absent.
inline std::map<std::string, std::vector<double>> golden(const std::string& name) {
  std::ifstream file(std::filesystem::path(HYSTERON_SHARED_DIR) / "thesis" / "golden" / (name + ".csv"));
  std::map<std::string, std::vector<double>> columns;
  std::string line, cell;
  if (!std::getline(file, line)) return columns;
  std::vector<std::string> names;
  for (std::stringstream header(line); std::getline(header, cell, ',');)
    names.push_back(cell.substr(0, cell.find(" [")));
  while (std::getline(file, line)) {
    std::stringstream row(line);
    for (const auto& column : names) {
      std::getline(row, cell, ',');
      columns[column].push_back(std::stod(cell));
    }
  }
  return columns;
}

}  // namespace hysteron::tools
