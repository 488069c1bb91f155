// Decides which numbers may seed random signals. Does not draw them: models/random.h.
#pragma once

#include <cmath>
#include <string>

namespace hysteron::blocks {

/// "" or what is wrong with the seed: it must be a whole number that a double holds exactly.
inline std::string check_seed(double seed) {
  if (seed >= 0 && seed <= 0x1p53 && std::floor(seed) == seed) return "";
  return "the seed must be a whole number from 0 to 9007199254740992; write e.g. 1";
}

}  // namespace hysteron::blocks
