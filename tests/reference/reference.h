// Decides how the reference simulates: classical Runge-Kutta with fixed fine steps that end at every known instant;
// what switches within a step is located by bisection. It shares no line with the program that it judges.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/reference/diagram.h"

namespace reference {

struct Settings {
  double step = 1e-4;    ///< longest step [s]
  double disturbed = 0;  ///< by which share all sources are larger and by how many radians ahead
  long most_events = 20000;
};

/// What the signals were before and behind an instant.
struct Jump {
  double t = 0;
  std::vector<double> before{}, after{};
  bool known = false;  ///< beforehand: it may not come sooner or later
};

struct Result {
  std::vector<double> t{};
  std::vector<std::vector<double>> values{};  ///< [recorded signal][row]
  std::vector<double> scale{};  ///< largest size of each recorded signal and of what it is a difference of
  std::vector<Jump> jumps{};    ///< of recorded signals
  long events = 0;
};

/// The reference gives up: too many events in too short a time, numbers without bound, a loop without a solution.
struct GaveUp : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws Unknown or GaveUp.
Result simulate(const FlatDiagram& diagram, const Settings& settings);

}  // namespace reference
