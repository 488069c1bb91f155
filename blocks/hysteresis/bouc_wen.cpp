#include "blocks/hysteresis/bouc_wen.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void BoucWen::describe(BlockSpec<BoucWen>& spec) {
  spec.name("bouc_wen", "Bouc-Wen hysteresis, driven by the rate of its input")
      .in_group("hysteresis")
      .elementwise()
      .rate_independent()
      .at("core");
  spec.law("y = d_p u - z, dz/dt = alpha u' - (beta |u'| z + gamma u' |z|) |z/scale|^(exponent - 1)")
      .from("thesis Eqs. 2.36, 2.37; Ismail, Ikhouane, Rodellar, Arch. Comput. Methods Eng. 16 (2009) 161-188");
  spec.remark("The input must have a rate: a step or a held signal needs a lag in between, noise a filter.");
  spec.remark(
      "For exponent 1 |z| stays below alpha/(beta + gamma), and scale has no effect. For other exponents beta and "
      "gamma "
      "hold for z = scale: parameters published for z in um take scale \"1 um\".");
  spec.remark(
      "Holds for beta >= 0 and beta + gamma > 0 (beta > gamma where alpha is negative): then |z| has a limit. Loops "
      "close "
      "for beta not below gamma. A spring that hardens: mass_on_bouc_wen_spring.");
  spec.variation("sharpness", "bouc_wen", {{"exponent", "1"}});
  spec.input(&In<double>::u, "u", "$a", "drive");
  spec.state(&State<double>::z, "z", "$b", "hysteretic part");
  spec.output(&Out<double>::y, "y", "$b", "displacement");
  spec.param(&Params<double>::alpha, "alpha", "$b/$a", "slope of z at z = 0");
  spec.param(&Params<double>::beta, "beta", "1/$a", "loop shape, dissipative part").not_negative();
  spec.param(&Params<double>::gamma, "gamma", "1/$a", "loop shape, conservative part");
  spec.param(&Params<double>::d_p, "d_p", "$b/$a", "slope of the linear part").linear();
  spec.param(&Params<double>::exponent, "exponent", "", "sharpness of the bend, at least 1").optional("1").minimum = 1;
  spec.param(&Params<double>::scale, "scale", "$b",
             "size of z for which beta and gamma hold; only for exponents other than 1")
      .optional("0")
      .not_negative()
      .difference();
  spec.param(&Params<double>::initial, "initial", "$b", "hysteretic part at the start").optional("0").difference();
}

std::string BoucWen::check(const Params<double>& p) {
  if (p.exponent != 1 && !(p.scale > 0))
    return "an exponent other than 1 needs \"scale\", the size of z for which beta and gamma hold; write e.g. "
           "\"scale\": \"1 um\"";
  return bouc_wen_limit_check(p.alpha, p.beta, p.gamma);
}

std::string bouc_wen_limit_check(double alpha, double beta, double gamma) {
  if (bouc_wen::is_bounded({.alpha = alpha, .beta = beta, .gamma = gamma})) return "";
  return fmt::format(
      "beta = {{beta}} and gamma = {{gamma}} leave the hysteretic part without a limit; give beta not below zero and "
      "beta {} gamma above zero",
      alpha < 0 ? "-" : "+");
}

Kernel bouc_wen_block() { return kernel<BoucWen>(); }

}  // namespace hysteron::blocks
