#include "blocks/hysteresis/tapi.h"

#include <fmt/format.h>

#include "blocks/hysteresis/one_sided_plays.h"
#include "blocks/hysteresis/prandtl_ishlinskii.h"
#include "models/compensators/prandtl_ishlinskii_inverse.h"

namespace hysteron::blocks {

namespace {

constexpr char tapi_source[] =
    "thesis Eqs. 5.14, 5.15; P_s(T) of a second-order transition: Strukov, Levanyuk, Ferroelectric Phenomena in "
    "Crystals "
    "(1998); operators: Kuhnen, Eur. J. Control 9 (2003) 407-418";

void tapi_parameters(Declaration& d) {
  d.list("thresholds", "$a", "threshold of each play operator; the first is 0 (linear part)")
      .increasing()
      .not_negative()
      .difference();
  d.list("weights", "$b/$a", "weight of each play operator; the first is also the weight of the saturating part")
      .as_long_as("thresholds");
  d.parameter("p_s", "$a", "saturation at 0 K, in the unit of the input").not_negative().difference();
  d.parameter("t_c", "K", "Curie temperature, absolute").positive();
  d.parameter("beta", "", "exponent with which the saturation falls to 0 at t_c").not_negative();
  d.parameter("a", "$a/K", "input scale per kelvin: the tanh saturates over an input of a T").positive();
  d.parameter("before", "$a", "input value visited before the start, which sets the initial memory").optional("0");
}

}  // namespace

void Tapi::describe(Declaration& d) {
  d.name("tapi", "temperature-dependent asymmetric Prandtl-Ishlinskii hysteresis (TAPI)")
      .in_group("hysteresis")
      .at("core");
  d.law(
       "y = weights[0] P + sum weights[i] w_i, P = p_s (1 - T/t_c)^beta tanh(u/(a T)), w_i = max(u - thresholds[i], "
       "min(u, w_i before))")
      .from(tapi_source);
  d.remark("The temperature is absolute: values in degC are converted, plain numbers are in K.");
  d.remark("The loop area does not depend on temperature: only the memoryless saturating part does.");
  d.remark(
      "Weights of a classical model with the same slopes must be converted, not copied; the identification "
      "\"tapi\" does this.");
  d.remembers("u", "the output w_i of each operator");
  d.input("u", "$a", "drive");
  d.input("temperature", "K", "temperature of the material");
  d.output("y", "$b", "displacement");
  tapi_parameters(d);
  d.parameters[weights].linear();
}

Sizes Tapi::sizes(const Shape& shape) { return one_play_per_threshold(shape, &Sizes::memory); }
std::string Tapi::check(const View<double>& v) { return begins_at_zero(v.list(thresholds)[0]); }
void Tapi::initial_memory(const View<double>& v) { start_one_sided_plays(v, v.list(thresholds), v.parameter(before)); }
std::string Tapi::check_memory(const View<double>& v) {
  return check_nested(play::Sides::one, v.list(thresholds), v.memory());
}

void SampledTapiInverse::describe(Declaration& d) {
  d.name("sampled_tapi_inverse", "sampled inverse of TAPI: command for a desired displacement")
      .in_group("sampled")
      .at("command");
  d.law("u_k solves weights[0] P(u_k, T_k) + sum weights[i] w_i(u_k) = y_k, as block tapi")
      .from(std::string(tapi_source) + "; solved by bracketed Newton steps in place of thesis Fig. 5.8");
  d.remark("Takes the parameters of the block tapi that it compensates, its memory included.");
  d.remark(
      "The fixed-point iteration of the thesis converges only for p_s(T) < a T; the exact solution "
      "(iterations 0) always converges if the weights add up to positive slopes.");
  d.input("y", "$b", "desired displacement");
  d.input("temperature", "K", "temperature of the material");
  d.output("u", "$a", "command");
  d.state("w", "$a", "operators of the actuator");
  tapi_parameters(d);
  d.parameter("iterations", "", "0 = solved to machine precision; else the number of iterations of thesis Fig. 5.8")
      .optional("0")
      .not_negative();
  d.sampled();
}

Sizes SampledTapiInverse::sizes(const Shape& shape) { return one_play_per_threshold(shape, &Sizes::sampled_states); }

std::string check_invertible(std::span<const double> thresholds, std::span<const double> weights) {
  if (auto text = begins_at_zero(thresholds[0]); !text.empty()) return text;
  const std::size_t rising = prandtl_ishlinskii::rising_slopes(weights);
  if (rising < thresholds.size())
    return fmt::format(
        "the first {} weights add up to a slope that is not positive, so the actuator has no inverse; give a "
        "larger first weight",
        rising + 1);
  return "";
}

std::string SampledTapiInverse::check(const View<double>& v) {
  return check_invertible(v.list(thresholds), v.list(weights));
}

void SampledTapiInverse::initial_states(const View<double>& v) {
  start_one_sided_plays(v, v.list(thresholds), v.parameter(before));
}

Kernel tapi_block() { return kernel<Tapi>(); }
Kernel sampled_tapi_inverse_block() { return kernel<SampledTapiInverse>(); }

}  // namespace hysteron::blocks
