#include "blocks/hysteresis/asymmetric_prandtl_ishlinskii.h"

#include "blocks/hysteresis/one_sided_plays.h"
#include "blocks/hysteresis/prandtl_ishlinskii.h"

namespace hysteron::blocks {

namespace {

constexpr char asymmetric_prandtl_ishlinskii_source[] =
    "thesis Eq. 5.15 at one temperature; operators: Kuhnen, Eur. J. Control 9 (2003) 407-418";

void asymmetric_prandtl_ishlinskii_parameters(Declaration& d) {
  d.list("thresholds", "$a", "threshold of each play operator; the first is 0 (linear part)")
      .increasing()
      .not_negative()
      .difference();
  d.list("weights", "$b/$a", "weight of each play operator; the first is also the weight of the saturating part")
      .as_long_as("thresholds");
  d.parameter("saturation", "$a", "saturation value of the saturating part, in the unit of the input")
      .not_negative()
      .difference();
  d.parameter("bend", "$a", "input scale over which the tanh saturates").positive().difference();
  d.parameter("before", "$a", "input value visited before the start, which sets the initial memory").optional("0");
}

}  // namespace

void AsymmetricPrandtlIshlinskii::describe(Declaration& d) {
  d.name("asymmetric_prandtl_ishlinskii", "asymmetric Prandtl-Ishlinskii hysteresis with a saturating part")
      .in_group("hysteresis")
      .at("core");
  d.law("y = weights[0] saturation tanh(u/bend) + sum weights[i] w_i, w_i = max(u - thresholds[i], min(u, w_i before))")
      .from(asymmetric_prandtl_ishlinskii_source);
  d.remark("This is the block tapi at one temperature: saturation = p_s (1 - T/t_c)^beta, bend = a T.");
  d.remembers("u", "the output w_i of each operator");
  d.input("u", "$a", "drive");
  d.output("y", "$b", "displacement");
  asymmetric_prandtl_ishlinskii_parameters(d);
  d.parameters[weights].linear();
}

Sizes AsymmetricPrandtlIshlinskii::sizes(const Shape& shape) { return one_play_per_threshold(shape, &Sizes::memory); }
std::string AsymmetricPrandtlIshlinskii::check(const View<double>& v) { return begins_at_zero(v.list(thresholds)[0]); }
void AsymmetricPrandtlIshlinskii::initial_memory(const View<double>& v) {
  start_one_sided_plays(v, v.list(thresholds), v.parameter(before));
}
std::string AsymmetricPrandtlIshlinskii::check_memory(const View<double>& v) {
  return check_nested(play::Sides::one, v.list(thresholds), v.memory());
}

void SampledAsymmetricInverse::describe(Declaration& d) {
  d.name("sampled_asymmetric_inverse", "sampled inverse of asymmetric_prandtl_ishlinskii")
      .in_group("sampled")
      .at("command");
  d.law("u_k solves weights[0] saturation tanh(u_k/bend) + sum weights[i] w_i(u_k) = y_k")
      .from(asymmetric_prandtl_ishlinskii_source);
  d.remark("Takes the parameters of the block that it compensates, its memory included.");
  d.remark(
      "The fixed-point iteration of the thesis converges only for saturation < bend; the exact solution "
      "(iterations 0) always converges.");
  d.input("y", "$b", "desired displacement");
  d.output("u", "$a", "command");
  d.state("w", "$a", "operators of the actuator");
  asymmetric_prandtl_ishlinskii_parameters(d);
  d.parameter("iterations", "", "0 = solved to machine precision; else the number of iterations of thesis Fig. 5.8")
      .optional("0")
      .not_negative();
  d.sampled();
}

Sizes SampledAsymmetricInverse::sizes(const Shape& shape) {
  return one_play_per_threshold(shape, &Sizes::sampled_states);
}
std::string SampledAsymmetricInverse::check(const View<double>& v) {
  return check_invertible(v.list(thresholds), v.list(weights));
}
void SampledAsymmetricInverse::initial_states(const View<double>& v) {
  start_one_sided_plays(v, v.list(thresholds), v.parameter(before));
}

Kernel asymmetric_prandtl_ishlinskii_block() { return kernel<AsymmetricPrandtlIshlinskii>(); }
Kernel sampled_asymmetric_inverse_block() { return kernel<SampledAsymmetricInverse>(); }

}  // namespace hysteron::blocks
