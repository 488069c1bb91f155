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
      "On a loop that does not begin at rest, initial is the actuator's hysteretic part at displacement zero and "
      "origin "
      "its opposite.");
  spec.param(&P::alpha, "alpha", "$b/$a", "slope of z at z = 0");
  spec.param(&P::beta, "beta", "1/$a", "loop shape, dissipative part").not_negative();
  spec.param(&P::gamma, "gamma", "1/$a", "loop shape, conservative part");
  spec.param(&P::d_p, "d_p", "$b/$a", "slope of the linear part");
  spec.param(&P::exponent, "exponent", "", "sharpness of the bend, at least 1").optional("1").minimum = 1;
  spec.param(&P::scale, "scale", "$b", "size of z for which beta and gamma hold; only for exponents other than 1")
      .optional("0")
      .not_negative()
      .difference();
  spec.param(&P::initial, "initial", "$b", "hysteretic part at the start").optional("0").difference();
  spec.param(&P::origin, "origin", "$b", "added to the wanted displacement").optional("0").difference();
}

template <class P>
std::string law_check(const P& p) {
  if (p.exponent != 1 && !(p.scale > 0))
    return "an exponent other than 1 needs \"scale\", the size of z for which beta and gamma hold; write e.g. "
           "\"scale\": \"1 um\"";
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
  spec.name("bouc_wen_inverse", "drive that makes a Bouc-Wen actuator follow the wanted displacement")
      .in_group("compensators")
      .elementwise()
      .rate_independent()
      .at("command");
  spec.law(
          "u = (y + origin + z)/d_p, dz/dt = alpha u' - (beta |u'| z + gamma u' |z|) |z/scale|^(exponent - 1), u' = "
          "y'/(d_p - alpha + (beta sign(y') z + gamma |z|) |z/scale|^(exponent - 1))")
      .from(source);
  spec.remark(
      "The input must have a rate: noise needs a filter in between. Where it is sampled, sampled_bouc_wen_inverse "
      "costs "
      "less.");
  spec.input(&In<double>::y, "y", "$b", "wanted displacement");
  spec.state(&State<double>::z, "z", "$b", "hysteretic part");
  spec.output(&Out<double>::u, "u", "$a", "command");
  law_parameters(spec);
}
std::string BoucWenInverse::check(const Params<double>& p) { return law_check(p); }

void SampledBoucWenInverse::describe(BlockSpec<SampledBoucWenInverse>& spec) {
  spec.name("sampled_bouc_wen_inverse", "bouc_wen_inverse of a digital controller")
      .in_group("sampled")
      .elementwise()
      .at("command");
  spec.law("u_k = (y_k + origin + z_k)/d_p, z_k from z_(k-1) along the straight way from y_(k-1) to y_k")
      .from(std::string(source) + "; Cash, Karp, ACM Trans. Math. Softw. 16 (1990) 201-222");
  spec.remark(
      "Each sample is integrated with controlled error (1e-10 of its way), however large the step. Before the first "
      "instant the wanted displacement is taken to have been zero.");
  spec.input(&In<double>::y, "y", "$b", "wanted displacement");
  spec.state(&State<double>::z, "z", "$b", "hysteretic part");
  spec.state(&State<double>::y, "y", "$b", "last wanted displacement");
  spec.output(&Out<double>::u, "u", "$a", "command");
  law_parameters(spec);
  spec.sampled(&Params<double>::period, &Params<double>::offset);
}
std::string SampledBoucWenInverse::check(const Params<double>& p) { return law_check(p); }

Kernel bouc_wen_inverse_block() { return kernel<BoucWenInverse>(); }
Kernel sampled_bouc_wen_inverse_block() { return kernel<SampledBoucWenInverse>(); }

}  // namespace hysteron::blocks
