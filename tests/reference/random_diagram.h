// Decides what random diagrams are tried: sources, laws that switch or remember, bodies, sampled parts, dead times,
// loops, nested diagrams, choices and $names, of 2 to 12 blocks.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace reference {

/// What is changed of a diagram without changing what it means.
struct Variant {
  bool other_order = false;  ///< the blocks stand in another order and have other names
  double until = 0;          ///< another end [s]; 0 = as generated
  double every = 0;          ///< other rows [s]; 0 = as generated
  std::string method{};      ///< of the solver; "" = auto
  double tolerance = 0;      ///< relative; 0 = as declared
};

struct RandomDiagram {
  std::string text{};                          ///< of the diagram file
  std::map<std::string, std::string> files{};  ///< what it names: nested diagrams, recordings
};

/// From this seed on parts of drives are drawn besides: controllers, inertias, motors, gears. What smaller seeds give
/// stays what it was.
constexpr std::uint64_t first_seed_with_drives = 1'000'000;
/// And from this one on machines in their units, what is true or false, what that triggers, functions by name.
constexpr std::uint64_t first_seed_with_machines = 2'000'000;

RandomDiagram random_diagram(std::uint64_t seed, const Variant& variant = {});

}  // namespace reference
