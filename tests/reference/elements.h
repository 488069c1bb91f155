// Decides what elements that stick and slip hold a body back with: beside a spring, or in bearings.
#pragma once

#include <cmath>
#include <vector>

#include "tests/reference/law.h"

namespace reference {

/// dz/dt = v - |v| z/(slip g(v)), or, where they yield, as much as is left of their strength to the fourth.
struct Elements {
  explicit Elements(const Block& b, bool yields_ = false)
      : contact(b.list("contact_stiffness")),
        slip(b.list("slip_distance")),
        excess(b.number("excess", 0)),
        stribeck(b.number("stribeck_velocity", 1)),
        contact_time(b.number("contact_time", 0)),
        yields(yields_) {}
  int count() const { return static_cast<int>(contact.size()); }
  double rate(double v, double z, int i) const {
    const double most = slip[i] * (1 + excess * std::exp(-(v / stribeck) * (v / stribeck)));
    if (!yields) return v - std::abs(v) * z / most;
    return v * z > 0 ? v * (1 - std::pow(z / most, 4)) : v;
  }
  double hold(double v, const double* z) const {
    double force = 0;
    for (int i = 0; i < count(); ++i) force += contact[i] * (z[i] + contact_time * rate(v, z[i], i));
    return force;
  }
  double stiffness() const {
    double total = 0;
    for (const double c : contact) total += c;
    return total;
  }

 private:
  std::vector<double> contact, slip;
  double excess, stribeck, contact_time;
  bool yields;
};

}  // namespace reference
