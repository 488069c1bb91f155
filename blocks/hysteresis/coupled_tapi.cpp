#include "blocks/hysteresis/coupled_tapi.h"

#include <fmt/format.h>

#include "blocks/hysteresis/prandtl_ishlinskii.h"
#include "models/compensators/prandtl_ishlinskii_inverse.h"

namespace hysteron::blocks {

namespace {

constexpr char coupled_tapi_source[] = "thesis Eqs. 5.26 to 5.31; each branch as block tapi";

void coupled_tapi_parameters(Declaration& d) {
  d.list("thresholds", "$a", "threshold of each play operator, the same for all branches; the first is 0 (linear part)")
      .increasing()
      .not_negative()
      .difference();
  d.matrix("weights", "$b/$a", "one row per branch (1 from 1, 1 from 2 ... 2 from 1 ...), one column per threshold");
  d.matrix("p_s", "$b", "saturation of each branch at 0 K, one row per output, one column per input").difference();
  d.parameter("t_c", "K", "Curie temperature, absolute").positive();
  d.matrix("beta", "", "exponent with which each saturation falls to 0 at t_c").not_negative();
  d.matrix("a", "$a/K", "input scale of each branch per kelvin: the tanh saturates over an input of a T").positive();
}

Sizes axes_of(const Shape& shape) {
  Sizes s;
  const int n = shape.rows_of("p_s"), m = shape.length("thresholds");
  s.outputs = n;
  s.output_lengths = {n};
  s.input_lengths = {n, 1};
  s.lengths_from = fmt::format("\"p_s\" has {} row{}", n, n == 1 ? "" : "s");
  for (const char* name : {"p_s", "beta", "a"})
    if (shape.rows_of(name) != n || shape.columns_of(name) != n)
      s.error = fmt::format("\"{}\" is {} x {}; make it {} x {}, a row per output and a column per input", name,
                            shape.rows_of(name), shape.columns_of(name), n, n);
  if (n < 1 || n > static_cast<int>(coupled_tapi::most_axes))
    s.error = fmt::format("{} axes; give 1 to {}", n, coupled_tapi::most_axes);
  else if (s.error.empty() && (shape.rows_of("weights") != n * n || shape.columns_of("weights") != m))
    s.error = fmt::format("\"weights\" is {} x {}; {} axes and {} thresholds make it {} x {}", shape.rows_of("weights"),
                          shape.columns_of("weights"), n, m, n * n, m);
  return s;
}

std::string check_first(double first) {
  if (first == 0) return "";
  return fmt::format("the first threshold is {{{} in thresholds}}; begin with 0, the linear part", first);
}

}  // namespace

void CoupledTapi::describe(Declaration& d) {
  d.name("coupled_tapi", "coupled axes with TAPI hysteresis: each input moves all outputs").in_group("hysteresis");
  d.law(
       "y_j = sum_i [p_s_ji (1 - T/t_c)^beta_ji tanh(u_i/(a_ji T)) + sum_k weights_ji,k w_i,k], w_i,k = max(u_i - "
       "thresholds[k], min(u_i, w_i,k before))")
      .from(coupled_tapi_source);
  d.remark(
      "p_s is in the unit of the output here; in the block tapi, which multiplies it by the first weight, "
      "it is in the unit of the input.");
  d.remark("Rows of p_s, beta and a are outputs, columns are inputs, as in a matrix_gain.");
  d.remembers("u", "the output w_i,k of each operator, axis by axis");
  d.input("u", "$a", "drive of each axis").vector();
  d.input("temperature", "K", "temperature of the material");
  d.output("y", "$b", "displacement of each axis").vector();
  coupled_tapi_parameters(d);
}

Sizes CoupledTapi::sizes(const Shape& shape) {
  Sizes s = axes_of(shape);
  s.memory = s.outputs * shape.length("thresholds");
  return s;
}

std::string CoupledTapi::check(const View<double>& v) { return check_first(v.list(thresholds)[0]); }

std::string CoupledTapi::check_memory(const View<double>& v) {
  const auto r = v.list(thresholds);
  for (std::size_t from = 0; from < v.memory().size(); from += r.size())
    if (auto why = check_nested(play::Sides::one, r, v.memory().subspan(from, r.size())); !why.empty()) return why;
  return "";
}

void SampledCoupledTapiInverse::describe(Declaration& d) {
  d.name("sampled_coupled_tapi_inverse", "sampled inverse of coupled_tapi: commands of all axes").in_group("sampled");
  d.law("u_k solves y_j = sum_i y_j(u_i, T_k) of block coupled_tapi for all axes j").from(coupled_tapi_source);
  d.remark("Takes the parameters of the block coupled_tapi that it compensates.");
  d.remark(
      "The axes are solved in turn (Gauss-Seidel) until converged. This requires diagonal dominance: each "
      "output depends on its own input more than on all others together.");
  d.remark("With axes \"single\" the coupling is neglected, as with one compensator per axis.");
  d.input("y", "$b", "desired displacement of each axis").vector();
  d.input("temperature", "K", "temperature of the material");
  d.output("u", "$a", "command of each axis").vector();
  d.state("w", "$a", "operators of the axes");
  coupled_tapi_parameters(d);
  d.text("axes", {"coupled", "single"}, "whether the cross-coupling between axes is compensated");
  d.sampled();
}

Sizes SampledCoupledTapiInverse::sizes(const Shape& shape) {
  Sizes s = axes_of(shape);
  s.sampled_states = s.outputs * shape.length("thresholds");
  return s;
}

std::string SampledCoupledTapiInverse::check(const View<double>& v) {
  const auto p = CoupledTapi::law(v);
  if (auto text = check_first(p.thresholds[0]); !text.empty()) return text;
  for (std::size_t j = 0; j < p.axes(); ++j)
    if (prandtl_ishlinskii::rising_slopes(p.branch(j, j)) < p.thresholds.size())
      return fmt::format("the weights of axis {} add up to a slope that is not positive; give a larger first weight",
                         j + 1);
  return "";
}

Kernel coupled_tapi_block() { return kernel<CoupledTapi>(); }
Kernel sampled_coupled_tapi_inverse_block() { return kernel<SampledCoupledTapiInverse>(); }

}  // namespace hysteron::blocks
