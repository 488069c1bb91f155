// Decides the random numbers of noise and random phases: a function of (seed, stream, index), so that any order of
// evaluation, any thread and any restart gives the same numbers. Does not keep a state.
#pragma once

#include <cmath>
#include <cstdint>

namespace hysteron::random {

/// The mixing function of SplitMix64. Source: Steele, Lea, Flood, OOPSLA 2014, doi 10.1145/2660193.2660195.
constexpr std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// 64 random bits number `index` of stream `stream` of `seed`.
constexpr std::uint64_t bits(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;  // 2^64 over the golden ratio, odd: the SplitMix64 increment
  const std::uint64_t key = mix(mix(seed + golden) ^ mix(stream + 2 * golden));
  return mix(key + (index + 1) * golden);
}

/// Uniform in (0, 1), never 0 nor 1.
constexpr double uniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
  return (static_cast<double>(bits(seed, stream, index) >> 12) + 0.5) * 0x1p-52;
}

/// Standard normal (mean 0, standard deviation 1) by Box and Muller, Ann. Math. Stat. 29 (1958) 610.
inline double normal(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
  constexpr double two_pi = 6.283185307179586476925287;
  const double radius = std::sqrt(-2 * std::log(uniform(seed, stream, 2 * index)));
  return radius * std::cos(two_pi * uniform(seed, stream, 2 * index + 1));
}

}  // namespace hysteron::random
