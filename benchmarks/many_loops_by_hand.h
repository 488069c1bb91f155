// A Jiles-Atherton law on one input, in many parameter sets: what a programmer with vectors of four writes.
#pragma once

#include <array>
#include <span>
#include <vector>

namespace hysteron::benchmarks {

/// One parameter set [V, um]: p_s, a, alpha, k, c.
using LoopNumbers = std::array<double, 5>;

/// Polarisation at rows 2000, 3000 and 4000 of two periods of 2000 points of 3 - 3 cos, from p = 0.
struct LoopPoints {
  std::array<double, 3> p{};
};

void euler_by_hand(std::span<const LoopNumbers> sets, std::span<LoopPoints> points);
void rk4_by_hand(std::span<const LoopNumbers> sets, std::span<LoopPoints> points);

}  // namespace hysteron::benchmarks
