// Decides how recordings of two axes without a word between them are made for tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/discover/synthetic.h"

namespace hysteron::testing {

inline std::vector<double> plus(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += b[k];
  return a;
}

/// A lag tau y' = u - y of a signal that moves linearly between rows, exactly.
inline std::vector<double> lagged(const std::vector<double>& t, const std::vector<double>& u, double tau) {
  std::vector<double> y{u.front()};
  for (std::size_t k = 1; k < u.size(); ++k) {
    const double h = t[k] - t[k - 1], slope = (u[k] - u[k - 1]) / h;
    y.push_back(u[k] - slope * tau + (y.back() - u[k - 1] + slope * tau) * std::exp(-h / tau));
  }
  return y;
}

struct Motion {
  Role role;
  std::vector<double> t, u;
};

inline std::vector<Motion> motions() {
  std::vector<Motion> list;
  for (const auto& [role, hertz] : {std::pair{Role::train, std::vector<double>{1.1, 3.7}},
                                    {Role::train, {0.6, 7.3}},
                                    {Role::validate, {1.7, 5.2}}}) {
    const auto t = rows(800, 0.005);
    list.push_back({role, t, several_sines(t, 1, hertz)});
  }
  return list;
}

/// One data set of both axes; y and y2 from u and u2 by `first` and `second`.
using Response = std::function<std::vector<double>(const std::vector<double>& t, const std::vector<double>& u)>;
inline DataSet of_two_axes(double white, const Response& first, const Response& second) {
  std::vector<Recording> list;
  std::uint64_t seed = 900;
  for (auto& m : motions()) {
    const auto other = several_sines(m.t, 0.8, {0.9 + 0.01 * static_cast<double>(seed - 900), 4.4});
    list.push_back(recording(std::to_string(seed) + ".csv", m.role, m.t, m.u,
                             plus(first(m.t, m.u), noise(m.t.size(), white, 0.1 * white, seed))));
    list.back().columns["u2"] = other;
    list.back().units["u2"] = parse_unit("V");
    list.back().columns["y2"] = plus(second(m.t, other), noise(m.t.size(), white, 0.1 * white, seed + 50));
    list.back().units["y2"] = parse_unit("m");
    ++seed;
  }
  DataSet data = data_set(std::move(list), white);
  data.notes["u2"].to = "u2";
  data.notes["y2"].to = "y2";
  data.notes["y2"].noise = data.notes["y"].noise;
  return data;
}

}  // namespace hysteron::testing
