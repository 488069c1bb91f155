// Decides at which instants sampled blocks run. Instants are whole numbers of one tick, the greatest common divisor of
// all periods and offsets, so that blocks which belong together run together for ever; nothing is accumulated. What
// happens at an instant: events.h.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// n / d, both small: what a decimal number in a file means.
struct Fraction {
  std::int64_t n = 0, d = 1;
};
/// The fraction with the smallest denominator within a few ulp of x >= 0, by continued fractions (Khinchin, Continued
/// Fractions, 1964, theorem 17); d = 0 if numbers of 62 bits do not suffice.
Fraction nearest_fraction(double x);

/// When a sampled block runs, as its parameters say.
struct Clocking {
  Fraction period, offset;  ///< [s]
};
Clocking clocking_of(const Program& program, const Run& run, int block);

class Clocks {
 public:
  /// Periods and offsets from the run's parameters. Throws Error "no_common_clock".
  Clocks(const Program& program, const Run& run, double begin);

  double next() const;  ///< first instant that is not taken yet [s], or infinity
  /// Blocks (places in program.sampled_blocks) whose instant is t (within rounding); these instants are taken, and
  /// their numbers noted in run.hits.
  const std::vector<int>& take(double t, Run& run);

 private:
  struct Clock {
    std::int64_t period, offset, next;  // in ticks
    std::vector<int> members;
  };
  double time(std::int64_t ticks) const;

  std::vector<Clock> clocks_;
  std::int64_t ticks_per_second_ = 1;
  std::vector<int> due_;
};

}  // namespace hysteron
