// Decides what a unit is: powers of base dimensions and a scale to SI, read by udunits2.
// Three things are ours: the aliases engineers write (deg), Hz and rad/s as different units, temperature differences.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace hysteron {

/// Powers of metre, kilogram, second, ampere, kelvin, mole, candela, radian, cycle.
/// Hz is cycle/s, so that 5 Hz is never taken for 5 rad/s nor for 5 1/s.
struct Dimension {
  std::array<std::int8_t, 9> power{};
  bool operator==(const Dimension&) const = default;
  bool none() const { return *this == Dimension{}; }
};
Dimension operator*(const Dimension& a, const Dimension& b);
Dimension operator/(const Dimension& a, const Dimension& b);
std::string to_text(const Dimension& d);  ///< "m s^-1", "1" for none

/// A unit as written. SI value = scale * number + offset (offset only for degC, degF ...).
struct Unit {
  std::string text;
  Dimension dimension;
  double scale = 1;
  double offset = 0;

  double to_si(double number) const { return scale * number + offset; }
  double from_si(double si) const { return (si - offset) / scale; }
  double difference_to_si(double number) const { return scale * number; }  ///< a noise of 0.01 degC is 0.01 K
  double difference_from_si(double si) const { return si / scale; }
};

/// Reads a unit ("um", "V/um", "1/s", "%", "" = dimensionless). Thread safe; results are cached.
/// Throws Error "bad_unit" at `path`.
Unit parse_unit(std::string_view text, const std::string& path = "unit");

/// The factor from values of dimension `from` to `to` in SI: 1 if equal, 2 pi from cycle to rad, 0 if they do not fit.
double dimension_factor(const Dimension& from, const Dimension& to);

/// Splits "0.1 um/V" into number and unit text; "5" has the unit "". Returns false if no number stands in front.
bool split_quantity(std::string_view text, double& number, std::string& unit);

/// The unit whose SI scale is one for a dimension, for values of which nobody said a unit.
Unit si_unit(const Dimension& d);

}  // namespace hysteron
