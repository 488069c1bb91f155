// Decides with which prefix of its unit people read a number: 0.017 nm, where 1.7e-05 um is the same.
// Does not decide its digits.
#pragma once

#include <string>
#include <string_view>

namespace hysteron {

struct ReadableUnit {
  double times = 1;  ///< what a number in the unit as it was is multiplied with
  std::string text;  ///< the unit that it then has
};

/// The unit in which a size of `number` is read without counting zeros: as it is from `least` on; else with the next
/// prefix of SI in which it is a hundredth or more. So 2.3e-4 um is 0.23 nm, as people who work with um say it. Units
/// that begin with no plain symbol of SI (deg, min, 1/s, m^2, kg) stay, and so do zero and
/// what is too small for every prefix.
ReadableUnit readable_unit(double number, std::string_view unit, double least = 0.01);

}  // namespace hysteron
