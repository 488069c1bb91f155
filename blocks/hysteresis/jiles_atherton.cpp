#include "blocks/hysteresis/jiles_atherton.h"

#include <fmt/format.h>

#include <cmath>

namespace hysteron::blocks {

namespace {

constexpr char jiles_atherton_source[] =
    "thesis Eqs. 2.23 to 2.35, the reversible term by the chain rule; Jiles, Atherton, J. Magn. Magn. Mater. 61 (1986) "
    "48-60; Smith, Ounaies, J. Intell. Mater. Syst. Struct. 11 (2000) 62-79";
constexpr char slope_text[] =
    "F(u, p, d) = [(A - p)/(k d - alpha/(1 - c) (A - p)) + R]/[1 - alpha R], A = p_s f((u + alpha p)/a), R = c p_s/a "
    "f'((u + alpha p)/a), f = tanh or Langevin's coth x - 1/x";

/// The parameters that the law and its inverse share, in the order of every Params above.
template <class B>
void jiles_atherton_parameters(BlockSpec<B>& spec) {
  using P = typename B::template Params<double>;
  spec.param(&P::p_s, "p_s", "$b", "saturation").positive().difference();
  spec.param(&P::a, "a", "$a", "input scale of the anhysteretic curve").positive().difference();
  spec.param(&P::alpha, "alpha", "$a/$b", "mean-field coupling: effective input per polarisation");
  spec.param(&P::k, "k", "$a", "pinning constant: about half the width of the loop").positive().difference();
  spec.param(&P::c, "c", "", "reversible fraction, below 1").not_negative().maximum = 1;
  spec.text("anhysteretic", {"tanh", "langevin"},
            "anhysteretic curve; parameters published for magnetic materials use langevin");
}

template <class P>
std::string law_check(const P& p) {
  if (!(p.c < 1)) return "with c = 1 there is no irreversible part; give a fraction below 1";
  const auto law = jiles_atherton_law(p);
  const double margin = jiles_atherton::reversible_margin(law);
  if (!(margin > 0))
    return fmt::format(
        "1 - alpha c p_s/{} = {:.4g} is not positive: the reversible part would be unstable; give a smaller "
        "alpha or c, or a larger a",
        law.curve == jiles_atherton::Curve::tanh ? "a" : "(3 a)", margin);
  return "";
}

template <class P>
std::string inverse_check(const P& p) {
  if (!(p.scale > 0)) return fmt::format("the scale is {:.4g}, so there is no inverse; give a positive one", p.scale);
  return law_check(p);
}

template <class B>
ParameterDeclaration& scale_parameter(BlockSpec<B>& spec) {
  return spec.param(&B::template Params<double>::scale, "scale", "", "factor from the polarisation to the output")
      .optional("1");
}

}  // namespace

void JilesAtherton::describe(BlockSpec<JilesAtherton>& spec) {
  spec.name("jiles_atherton", "Jiles-Atherton hysteresis")
      .in_group("hysteresis")
      .elementwise()
      .rate_independent()
      .at("core");
  spec.law(std::string("y = scale p, dp/dt = F(u, p, sign u') u', ") + slope_text).from(jiles_atherton_source);
  spec.remark("The input must have a rate: noise needs a filter in between. A jump is treated as a fast ramp.");
  spec.remark("A negative irreversible part is not set to zero: published piezo parameters assume this.");
  spec.remark(
      "The law is valid while alpha (A - p) d < (1 - c) k and alpha R < 1. With a large alpha and a small "
      "k the run stops where this limit is reached; parameters published for magnetic materials then "
      "usually need \"anhysteretic\": \"langevin\".");
  spec.remark(
      "\"upright\": \"passed\" continues the printed formula beyond that limit, with steps that jump over "
      "the pole. This is not physical; it reproduces published searches over random parameters.");
  spec.remark(
      "For the normalised model of the thesis (Eq. 4.4), scale is the ratio of the measured stroke to that "
      "of the law, found by linear least squares; p_s, a, alpha, k and c then describe the shape only.");
  spec.variation("scale", "jiles_atherton", {{"scale", "1"}});
  spec.input(&In<double>::u, "u", "$a", "input: field or voltage");
  spec.state(&State<double>::p, "p", "$b", "polarisation");
  spec.output(&Out<double>::y, "y", "$b", "polarisation or displacement");
  jiles_atherton_parameters(spec);
  spec.param(&Params<double>::initial, "initial", "$b", "initial polarisation").optional("0").difference();
  scale_parameter(spec).linear();
  spec.text("upright", {"ends", "passed"},
            "where the slope becomes infinite: stop the run, or continue with the formula");
}
std::string JilesAtherton::check(const Params<double>& p) {
  if (!(std::fabs(p.initial) <= p.p_s))
    return "initial is {initial}, beyond the saturation p_s = {p_s}; give it between -p_s and p_s";
  return law_check(p);
}

void JilesAthertonInverse::describe(BlockSpec<JilesAthertonInverse>& spec) {
  spec.name("jiles_atherton_inverse", "inverse of Jiles-Atherton: command for a desired displacement")
      .in_group("compensators")
      .elementwise()
      .rate_independent()
      .at("command");
  spec.law(std::string("du/dt = (y'/scale)/F(u, (y + origin)/scale, sign y'), ") + slope_text)
      .from(jiles_atherton_source);
  spec.remark("Takes the parameters of the block jiles_atherton that it compensates.");
  spec.remark(
      "The input must have a rate: noise needs a filter in between. For a sampled input use "
      "sampled_jiles_atherton_inverse, which is faster.");
  spec.remark(
      "Valid where F is positive; elsewhere there is no inverse, and the run ends. Where the actuator "
      "does not start at rest, origin is its output at zero displacement.");
  spec.input(&In<double>::y, "y", "$b", "desired displacement");
  spec.state(&State<double>::u, "u", "$a", "command");
  spec.output(&Out<double>::u, "u", "$a", "command");
  jiles_atherton_parameters(spec);
  spec.param(&Params<double>::initial, "initial", "$a", "initial command").optional("0").difference();
  spec.param(&Params<double>::origin, "origin", "$b", "output of the actuator that counts as zero displacement")
      .optional("0")
      .difference();
  scale_parameter(spec);
}
std::string JilesAthertonInverse::check(const Params<double>& p) { return inverse_check(p); }

void SampledJilesAthertonInverse::describe(BlockSpec<SampledJilesAthertonInverse>& spec) {
  spec.name("sampled_jiles_atherton_inverse", "inverse of Jiles-Atherton hysteresis in a digital controller")
      .in_group("sampled")
      .elementwise()
      .at("command");
  spec.law(std::string("u_k = u_(k-1) + integral from p_(k-1) to p_k of dp/F(u, p, d), p = (y + origin)/scale, ") +
           slope_text)
      .from(std::string(jiles_atherton_source) + "; Cash, Karp, ACM Trans. Math. Softw. 16 (1990) 201-222");
  spec.remark("Takes the parameters of the block jiles_atherton that it compensates.");
  spec.remark(
      "Each sample is integrated with error control (1e-10 of the step), however large the step. Before "
      "the first instant the desired displacement is taken as zero.");
  spec.input(&In<double>::y, "y", "$b", "desired displacement");
  spec.state(&State<double>::u, "u", "$a", "last command");
  spec.state(&State<double>::y, "y", "$b", "last desired displacement");
  spec.output(&Out<double>::u, "u", "$a", "command");
  jiles_atherton_parameters(spec);
  spec.param(&Params<double>::initial, "initial", "$a", "command before the first instant").optional("0").difference();
  spec.param(&Params<double>::origin, "origin", "$b", "output of the actuator that counts as zero displacement")
      .optional("0")
      .difference();
  scale_parameter(spec);
  spec.sampled(&Params<double>::period, &Params<double>::offset);
}
std::string SampledJilesAthertonInverse::check(const Params<double>& p) { return inverse_check(p); }

namespace {

/// A block whose curve is fixed: the loop over runs side by side becomes vector instructions only without a choice in
/// it.
template <class B, int choice>
struct OnCurve : B {
  template <class T>
  static typename B::template State<T> derivative(typename B::template Params<T> p,
                                                  const typename B::template State<T>& s,
                                                  const typename B::template In<T>& in,
                                                  const typename B::template In<T>& rate) {
    p.anhysteretic = T{static_cast<double>(choice)};
    return B::derivative(p, s, in, rate);
  }
};

/// A text is the same in all lanes.
template <class B>
void derivative_of_lanes(const LanesView& v) {
  static const auto tanh = block_detail::fixed_lanes<OnCurve<B, 0>>().derivative;
  static const auto langevin = block_detail::fixed_lanes<OnCurve<B, 1>>().derivative;
  constexpr int anhysteretic = 5;  // its place in Params
  (v.p[anhysteretic * v.lanes] == 0 ? tanh : langevin)(v);
}

template <class B>
Kernel on_either_curve() {
  Kernel k = kernel<B>();
  k.lanes.derivative = &derivative_of_lanes<B>;
  return k;
}

}  // namespace

Kernel jiles_atherton_block() { return on_either_curve<JilesAtherton>(); }
Kernel jiles_atherton_inverse_block() { return on_either_curve<JilesAthertonInverse>(); }
Kernel sampled_jiles_atherton_inverse_block() { return kernel<SampledJilesAthertonInverse>(); }

}  // namespace hysteron::blocks
