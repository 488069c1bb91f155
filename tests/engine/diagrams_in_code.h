// Diagrams built in C++ without a file, for tests.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "engine/diagram/diagram.h"

namespace hysteron::test {

/// A block with its type, its wires by position, and its parameters.
inline Node node(const std::string& type, const std::vector<std::string>& in = {},
                 std::initializer_list<std::pair<const char*, Value>> parameters = {}) {
  Node n;
  n.type = type;
  for (const auto& from : in) n.in.push_back({"", from});
  for (const auto& [name, value] : parameters) n.parameters[name] = value;
  return n;
}

inline NumberList numbers(std::initializer_list<double> values) {
  NumberList list;
  for (const double v : values) list.push_back({v, {}});
  return list;
}

inline NumberList volts(std::initializer_list<double> values) {
  NumberList list;
  for (const double v : values) list.push_back({v, "V"});
  return list;
}

inline SeriesPointer series(std::vector<double> t, std::vector<double> v, Between between = Between::linear) {
  return std::make_shared<const Series>(Series{std::move(t), std::move(v), between});
}

}  // namespace hysteron::test
