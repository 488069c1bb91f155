#include "blocks/hysteresis/bouc_wen.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void BoucWen::describe(BlockSpec<BoucWen>& spec) {
  spec.name("bouc_wen", "Bouc-Wen hysteresis").in_group("hysteresis").elementwise().rate_independent().at("core");
  spec.law("y = d_p u - z, dz/dt = alpha u' - (beta |u'| z + gamma u' |z|) |z/scale|^(exponent - 1)")
      .from("thesis Eqs. 2.36, 2.37; Ismail, Ikhouane, Rodellar, Arch. Comput. Methods Eng. 16 (2009) 161-188");
  spec.remark(
      "The law is driven by the rate of the input: after a step or a held signal put a lag, after noise a "
      "filter.");
  spec.remark(
      "For exponent 1, |z| stays below alpha/(beta + gamma), and scale has no effect. For other exponents "
      "beta and gamma are the values at z = scale: for parameters published with z in um write \"scale\": "
      "\"1 um\".");
  spec.remark(
      "Valid for beta >= 0 and beta + gamma > 0 (beta > gamma if alpha is negative): then |z| is bounded. "
      "Loops close if beta >= gamma. For a hardening spring use mass_on_bouc_wen_spring.");
  spec.variation("sharpness", "bouc_wen", {{"exponent", "1"}});
  spec.input(&In<double>::u, "u", "$a", "drive");
  spec.state(&State<double>::z, "z", "$b", "hysteretic part");
  spec.output(&Out<double>::y, "y", "$b", "displacement");
  spec.param(&Params<double>::alpha, "alpha", "$b/$a", "slope of z at z = 0");
  spec.param(&Params<double>::beta, "beta", "1/$a", "loop shape: dissipative term beta |u'| z").not_negative();
  spec.param(&Params<double>::gamma, "gamma", "1/$a", "loop shape: conservative term gamma u' |z|");
  spec.param(&Params<double>::d_p, "d_p", "$b/$a", "slope of the linear part, output per input").linear();
  spec.param(&Params<double>::exponent, "exponent", "", "sharpness of the transition to the limit, at least 1")
      .optional("1")
      .minimum = 1;
  spec.param(&Params<double>::scale, "scale", "$b",
             "value of z at which beta and gamma are given; only for exponents other than 1")
      .optional("0")
      .not_negative()
      .difference();
  spec.param(&Params<double>::initial, "initial", "$b", "initial value of the hysteretic part z")
      .optional("0")
      .difference();
}

std::string BoucWen::check(const Params<double>& p) {
  if (p.exponent != 1 && !(p.scale > 0))
    return "an exponent other than 1 needs \"scale\", the value of z at which beta and gamma are given; write "
           "e.g. \"scale\": \"1 um\"";
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
