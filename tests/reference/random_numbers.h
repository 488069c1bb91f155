// Decides the random numbers of the diagrams: the same on every machine (splitmix64: Steele, Lea, Flood, OOPSLA 2014).
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace reference {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state(seed) {
    state = bits() ^ 0x1234567ULL;  // else the numbers of the next seed would be these, one later
  }

  std::uint64_t bits() {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31U);
  }
  /// Even between low and high, to four digits: what stands in the file is what is meant.
  double between(double low, double high) { return four_digits(low + (high - low) * part()); }
  /// Even in the logarithm, to four digits.
  double spread(double low, double high) { return four_digits(low * std::pow(high / low, part())); }
  int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
  bool chance(double p) { return part() < p; }
  static double four_digits(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", x);
    return std::strtod(text, nullptr);
  }
  template <class T>
  const T& one_of(const std::vector<T>& from) {
    return from[static_cast<std::size_t>(below(static_cast<int>(from.size())))];
  }

 private:
  double part() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }
  std::uint64_t state;
};

}  // namespace reference
