#include "blocks/sources/multisine.h"

#include <fmt/format.h>

#include "blocks/sources/seed.h"

namespace hysteron::blocks {

void Multisine::describe(BlockSpec<Multisine>& spec) {
  spec.name("multisine", "sum of sines of equal amplitude and random phases").in_group("sources");
  spec.law(
          "y = offset + rms sqrt(2/n) sum sin(2 pi f_k t + phi_k), f_k = lowest + k spacing <= highest, phi_k uniform "
          "in [0, 2 pi)")
      .from("Pintelon, Schoukens, System Identification: A Frequency Domain Approach, 2nd ed. (2012), section 2");
  spec.remark(
      "The period is 1/spacing if lowest is a multiple of spacing. The peak is about 3 to 4 times the rms "
      "value.");
  spec.remark("The same seed gives the same signal on every machine.");
  spec.output(&Out<double>::y, "y", "$a", "the signal");
  spec.param(&Params<double>::rms, "rms", "$a", "root mean square (rms) of the signal around the offset")
      .linear()
      .difference();
  spec.param(&Params<double>::offset, "offset", "$a", "mean value").optional("0").offset();
  spec.param(&Params<double>::lowest, "lowest", "Hz", "lowest frequency").positive();
  spec.param(&Params<double>::highest, "highest", "Hz", "highest frequency").positive();
  spec.param(&Params<double>::spacing, "spacing", "Hz", "spacing of neighbouring frequencies").positive();
  spec.param(&Params<double>::seed, "seed", "", "whole number that selects the random phases")
      .optional("1")
      .not_negative();
}

std::string Multisine::check(const Params<double>& p) {
  if (p.highest < p.lowest)
    return fmt::format("highest ({} Hz) is below lowest ({} Hz); exchange them", p.highest, p.lowest);
  constexpr double most = 100000;
  if (const double n = signals::multisine_count(p.lowest, p.highest, p.spacing); n > most)
    return fmt::format("{} sines are too many (at most {}); enlarge spacing or narrow the band", n, most);
  return check_seed(p.seed);
}

Kernel multisine_block() { return kernel<Multisine>(); }

}  // namespace hysteron::blocks
