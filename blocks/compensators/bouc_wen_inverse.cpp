#include "blocks/compensators/bouc_wen_inverse.h"

#include <fmt/format.h>

#include <cmath>

#include "blocks/hysteresis/bouc_wen.h"

namespace hysteron::blocks {

namespace {

constexpr char source[] =
    "thesis Fig. 2.8, Eq. 2.38 in solved form; Rakotondrabe, IEEE Trans. Autom. Sci. Eng. 8 (2011) 428-431";

template <class B>
void law_parameters(BlockSpec<B>& spec) {
  using P = typename B::template Params<double>;
  spec.remark("Takes the parameters of the block bouc_wen that it compensates.");
  spec.remark(
      "Where the actuator does not start at rest: initial is its hysteretic part at zero displacement, "
      "origin is minus that value.");
  spec.param(&P::alpha, "alpha", "$b/$a", "slope of z at z = 0");
  spec.param(&P::beta, "beta", "1/$a", "loop shape: dissipative term beta |u'| z").not_negative();
  spec.param(&P::gamma, "gamma", "1/$a", "loop shape: conservative term gamma u' |z|");
  spec.param(&P::d_p, "d_p", "$b/$a", "slope of the linear part, output per input");
  spec.param(&P::exponent, "exponent", "", "sharpness of the transition to the limit, at least 1")
      .optional("1")
      .minimum = 1;
  spec.param(&P::scale, "scale", "$b", "value of z at which beta and gamma are given; only for exponents other than 1")
      .optional("0")
      .not_negative()
      .difference();
  spec.param(&P::initial, "initial", "$b", "initial value of the hysteretic part z").optional("0").difference();
  spec.param(&P::origin, "origin", "$b", "added to the desired displacement; 0 where the actuator starts at rest")
      .optional("0")
      .difference();
}

template <class P>
std::string law_check(const P& p) {
  if (p.exponent != 1 && !(p.scale > 0))
    return "an exponent other than 1 needs \"scale\", the value of z at which beta and gamma are given; write "
           "e.g. \"scale\": \"1 um\"";
  if (!(p.d_p != 0)) return "d_p is zero: no command can be found; give the actuator's slope";
  if (!((p.d_p - p.alpha) / p.d_p > 0))
    return fmt::format(
        "the actuator's slope at z = 0, d_p - alpha = {{{} in d_p}}, is not of the sign of d_p: it has no inverse; give "
        "alpha below d_p",
        p.d_p - p.alpha);
  return bouc_wen_limit_check(p.alpha, p.beta, p.gamma);
}

}  // namespace

void BoucWenInverse::describe(BlockSpec<BoucWenInverse>& spec) {
  spec.name("bouc_wen_inverse", "inverse of Bouc-Wen hysteresis: command for a desired displacement")
      .in_group("compensators")
      .elementwise()
      .rate_independent()
      .at("command");
  spec.law(
          "u = (y + origin + z)/d_p, dz/dt = alpha u' - (beta |u'| z + gamma u' |z|) |z/scale|^(exponent - 1), u' = "
          "y'/(d_p - alpha + (beta sign(y') z + gamma |z|) |z/scale|^(exponent - 1))")
      .from(source);
  spec.remark(
      "The input must have a rate: noise needs a filter in between. For a sampled input use "
      "sampled_bouc_wen_inverse, which is faster.");
  spec.input(&In<double>::y, "y", "$b", "desired displacement");
  spec.state(&State<double>::z, "z", "$b", "hysteretic part");
  spec.output(&Out<double>::u, "u", "$a", "command");
  law_parameters(spec);
}
std::string BoucWenInverse::check(const Params<double>& p) { return law_check(p); }

void SampledBoucWenInverse::describe(BlockSpec<SampledBoucWenInverse>& spec) {
  spec.name("sampled_bouc_wen_inverse", "inverse of Bouc-Wen hysteresis in a digital controller")
      .in_group("sampled")
      .elementwise()
      .at("command");
  spec.law("u_k = (y_k + origin + z_k)/d_p, z_k from z_(k-1) along a straight line from y_(k-1) to y_k")
      .from(std::string(source) + "; Cash, Karp, ACM Trans. Math. Softw. 16 (1990) 201-222");
  spec.remark(
      "Each sample is integrated with error control (1e-10 of the step), however large the step. Before "
      "the first instant the desired displacement is taken as zero.");
  spec.input(&In<double>::y, "y", "$b", "desired displacement");
  spec.state(&State<double>::z, "z", "$b", "hysteretic part");
  spec.state(&State<double>::y, "y", "$b", "last desired displacement");
  spec.output(&Out<double>::u, "u", "$a", "command");
  law_parameters(spec);
  spec.sampled(&Params<double>::period, &Params<double>::offset);
}
std::string SampledBoucWenInverse::check(const Params<double>& p) { return law_check(p); }

Kernel bouc_wen_inverse_block() { return kernel<BoucWenInverse>(); }
Kernel sampled_bouc_wen_inverse_block() { return kernel<SampledBoucWenInverse>(); }

}  // namespace hysteron::blocks
