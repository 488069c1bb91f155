// Decides how the workloads build their diagrams in C++, without files: short words for nodes and lists, and the
// devices that several of them share. Holds no workload.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "blocks/register_all.h"
#include "engine/program/program.h"
#include "engine/simulate/simulate.h"

namespace hysteron::benchmarks {

constexpr double um = 1e-6;  // [m]

inline Node node(const char* type, const std::vector<std::pair<std::string, Value>>& parameters,
                 const std::vector<std::string>& in = {}) {
  Node made;
  made.type = type;
  for (const auto& [name, value] : parameters) made.parameters[name] = value;
  for (const auto& from : in) made.in.push_back({"", from});
  return made;
}

inline NumberList numbers(const std::vector<double>& values) {
  NumberList list;
  for (const double v : values) list.push_back({v, {}});
  return list;
}
inline NumberList numbers(const std::vector<double>& values, const std::string& unit) {
  NumberList list;
  for (const double v : values) list.push_back({v, unit});
  return list;
}

/// 0 ... 6 with 5 Hz from its minimum, in `unit`: the reference and the drive of the thesis.
inline Node thesis_sine(const std::string& unit) {
  const std::string three = "3 " + unit;
  return node("sine", {{"amplitude", three}, {"offset", three}, {"frequency", "5 Hz"}, {"phase", "-90 deg"}});
}

/// G(s) of the thesis (Eq. 2.47): poles at -6663 +- 15262j and -7402 +- 3303j 1/s, 0.7558 at rest.
inline Node thesis_plant(const std::string& in, const Value& gain = 1.0) {
  return node(
      "transfer_function",
      {{"gain", gain}, {"num", numbers({1.377e16})}, {"den", numbers({1, 2.813e4, 5.403e8, 4.981e12, 1.822e16})}},
      {in});
}

inline ProgramPointer compiled(const Diagram& diagram) {
  static const Registry registry = all_blocks();
  return compile(diagram, registry);
}

/// Largest difference; infinite where the lengths differ, so that a comparison of nothing is seen.
inline double largest_error(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = a.size() == b.size() && !a.empty() ? 0 : INFINITY;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst;
}

inline std::vector<double> scaled(std::vector<double> v, double factor) {
  for (auto& x : v) x *= factor;
  return v;
}

}  // namespace hysteron::benchmarks
