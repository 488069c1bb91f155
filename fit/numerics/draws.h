// Decides the random numbers of searches: a function of (seed, stream, index), so that a search gives the same numbers
// on every machine, in any order and with any number of threads. Does not keep a state.
#pragma once

#include <cstdint>

namespace hysteron::draws {

/// The mixing function of SplitMix64. Source: Steele, Lea, Flood, OOPSLA 2014, doi 10.1145/2660193.2660195.
constexpr std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// Uniform in (0, 1), never 0 nor 1: number `index` of stream `stream` of `seed`.
constexpr double uniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;  // 2^64 over the golden ratio, odd: the SplitMix64 increment
  const std::uint64_t key = mix(mix(seed + golden) ^ mix(stream + 2 * golden));
  return (static_cast<double>(mix(key + (index + 1) * golden) >> 12) + 0.5) * 0x1p-52;
}

}  // namespace hysteron::draws
