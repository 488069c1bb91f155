// Decides how a test calls one block without a diagram: parameters by name in SI, inputs, states and memory by hand.
// Does not check anything.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "blocks/register_all.h"
#include "engine/block/kernel.h"
#include "engine/diagram/units.h"

namespace hysteron::bench {

using Numbers = std::vector<double>;
using Duals = std::vector<Dual>;

inline const Registry& registry() {
  static const Registry all = all_blocks();
  return all;
}
inline const Kernel& kernel_of(const std::string& type) {
  const Kernel* k = registry().find(type);
  if (k == nullptr) throw std::logic_error("no block " + type);
  return *k;
}

inline Duals dual(const Numbers& value, const Numbers& rate = {}) {
  Duals d;
  for (std::size_t i = 0; i < value.size(); ++i) d.push_back({value[i], rate.empty() ? 0 : rate[i]});
  return d;
}
inline Numbers rates(const Duals& d) {
  Numbers r;
  for (const Dual& x : d) r.push_back(x.rate);
  return r;
}

/// One block with its numbers. Text parameters are given as the index of the choice, free texts as character codes, the
/// columns of a matrix "m" as "m columns". Blocks with vector ports get one wire, `inputs` elements long.
class Bench {
 public:
  using Values = std::map<std::string, Numbers>;

  Bench(const std::string& type, const Values& values, int inputs = -1) : kernel(kernel_of(type)) {
    const Declaration& d = kernel.declaration;
    p_at.push_back(0);
    shape.declaration = &d;
    for (const auto& q : d.parameters) {
      Numbers own;
      if (const auto given = values.find(q.name); given != values.end())
        own = given->second;
      else if (q.kind == ParameterKind::text)
        own = q.choices.empty() ? Numbers{} : Numbers{0};
      else if (q.default_text && q.default_text->empty())
        own = {};
      else if (q.default_text)
        own = {default_of(*q.default_text)};
      else
        throw std::logic_error(type + " needs " + q.name);
      p.insert(p.end(), own.begin(), own.end());
      p_at.push_back(static_cast<int>(p.size()));
      shape.list_lengths.push_back(static_cast<int>(own.size()));
      shape.text_choices.push_back(q.kind == ParameterKind::text && !own.empty() ? static_cast<int>(own[0]) : 0);
      const auto columns = values.find(q.name + " columns");
      shape.columns.push_back(columns == values.end() ? 0 : static_cast<int>(columns->second[0]));
      shape.structure.push_back(own);
    }
    for (const auto& [name, numbers] : values)
      if (d.parameter_index(name.substr(0, name.find(' '))) < 0)
        throw std::logic_error(type + " has no parameter " + name);
    shape.inputs = inputs < 0 ? static_cast<int>(d.inputs.size()) : inputs;
    n_u = shape.inputs;
    if (d.has_vector_ports()) {
      shape.input_lengths = {n_u};
      shape.inputs = 1;
    }
    sizes = kernel.sizes(shape);
    if (sizes.error.empty()) prepare();
  }

  /// A default in SI ("10 us").
  static double default_of(const std::string& text) {
    double number = 0;
    std::string unit;
    if (!split_quantity(text, number, unit)) throw std::logic_error("no quantity: " + text);
    return unit.empty() ? number : number * parse_unit(unit).scale;
  }

  void prepare() {
    c.assign(static_cast<std::size_t>(sizes.constants), 0);
    if (kernel.prepare == nullptr) return;
    View<double> v = view<double>(p, {}, {}, {}, 0, 0);
    v.out = c.data();
    kernel.prepare(v);
  }
  std::string check() const { return kernel.check == nullptr ? "" : kernel.check(view<double>(p, {}, {}, {}, 0, 0)); }

  /// Outputs for advanced memory `m`; the branch is the time where nothing else is said.
  Numbers output(double t, const Numbers& u = {}, const Numbers& x = {}, const Numbers& m = {}) const {
    return output(t, t, u, x, m);
  }
  Numbers output(double t, double branch, const Numbers& u, const Numbers& x, const Numbers& m) const {
    return call(kernel.output, view<double>(p, u, x, m, t, branch), sizes.outputs);
  }
  Duals output_rate(double t, double branch, const Duals& u, const Duals& x, const Duals& m) const {
    const Duals dp = dual(p);
    return call(kernel.output_rate, view<Dual>(dp, u, x, m, Dual{t, 1}, branch), sizes.outputs);
  }
  Numbers derivative(const Numbers& u, const Numbers& x, const Numbers& du = {}) const {
    View<double> v = view<double>(p, u, x, {}, 0, 0);
    v.du = du.data();
    return call(kernel.derivative, v, sizes.states);
  }
  Numbers advance(const Numbers& m, const Numbers& u) const {
    return call(kernel.advance, view<double>(p, u, {}, m, 0, 0), sizes.memory);
  }
  Duals advance_rate(const Duals& m, const Duals& u) const {
    const Duals dp = dual(p);
    return call(kernel.advance_rate, view<Dual>(dp, u, {}, m, Dual{0}, 0), sizes.memory);
  }
  /// Sampled states behind an instant.
  Numbers update(const Numbers& u, const Numbers& x) const {
    return call(kernel.update, view<double>(p, u, x, {}, 0, 0), sizes.sampled_states);
  }
  double guard(const Numbers& u, const Numbers& x = {}) const {
    return call(kernel.guard, view<double>(p, u, x, {}, 0, 0), 1)[0];
  }
  /// Lets a mode whose guard is not positive change, with the states, until one may stay. Returns how many changed.
  int settle(const Numbers& u, Numbers& x) {
    int changes = 0;
    for (; guard(u, x) <= 0; ++changes) {
      if (changes > 10) throw std::logic_error(kernel.declaration.type + ": the modes do not settle");
      View<double> v = view<double>(p, u, x, {}, 0, 0);
      const int next = kernel.next_mode(v);
      if (next == mode) throw std::logic_error(kernel.declaration.type + ": a mode follows itself");
      v.mode_before = mode;
      v.mode = mode = next;
      if (kernel.reset != nullptr) x = call(kernel.reset, v, sizes.states);
    }
    return changes;
  }
  int initial_mode() const {
    return kernel.initial_mode == nullptr ? 0 : kernel.initial_mode(view<double>(p, {}, {}, {}, 0, 0));
  }
  Numbers rest(const Numbers& u) const { return call(kernel.rest, view<double>(p, u, {}, {}, 0, 0), sizes.states); }
  Numbers initial_states() const {
    if (kernel.initial_states == nullptr) return Numbers(static_cast<std::size_t>(states()), 0);
    return call(kernel.initial_states, view<double>(p, {}, {}, {}, 0, 0), states());
  }
  Numbers initial_memory() const {
    if (kernel.initial_memory == nullptr) return Numbers(static_cast<std::size_t>(sizes.memory), 0);
    return call(kernel.initial_memory, view<double>(p, {}, {}, {}, 0, 0), sizes.memory);
  }
  double next_breakpoint(double t) const { return kernel.next_breakpoint(view<double>(p, {}, {}, {}, t, t)); }
  double shortest_period() const { return kernel.shortest_period(view<double>(p, {}, {}, {}, 0, 0)); }

  /// Output of a run by explicit Euler steps, memory committed after each, sampled blocks at every step: the response
  /// to inputs u[k] per wire.
  Numbers response(const std::vector<Numbers>& u, double step) const {
    Bench run = *this;
    return run.walk(u, step);
  }
  Numbers walk(const std::vector<Numbers>& u, double step) {
    Numbers x = initial_states(), m = initial_memory(), y;
    mode = initial_mode();
    for (std::size_t k = 0; k < u.size(); ++k) {
      hit = static_cast<long>(k);
      if (kernel.has_modes()) settle(u[k], x);
      if (sizes.memory > 0) m = advance(m, u[k]);
      y.push_back(output(static_cast<double>(k) * step, u[k], x, m)[0]);
      if (sizes.sampled_states > 0) x = update(u[k], x);
      if (sizes.states == 0) continue;
      Numbers du(u[k].size(), 0);
      for (std::size_t i = 0; i < du.size() && k > 0; ++i) du[i] = (u[k][i] - u[k - 1][i]) / step;
      const Numbers dx = derivative(u[k], x, du);
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += step * dx[i];
    }
    return y;
  }

  /// Continuous or sampled states.
  int states() const { return sizes.states + sizes.sampled_states; }

  Kernel kernel;
  int mode = 0;  ///< of a block with modes
  long hit = 0;  ///< of a sampled block
  std::uint64_t key = 0;
  Shape shape;
  Sizes sizes;
  Numbers p, c;
  std::vector<int> p_at;
  int n_u = 0;  ///< input numbers
  const Series* series = nullptr;
  const History* history = nullptr;

 private:
  template <class T>
  View<T> view(const std::vector<T>& parameters, const std::vector<T>& u, const std::vector<T>& x,
               const std::vector<T>& m, T t, double branch) const {
    View<T> v;
    v.p = parameters.data();
    v.p_at = p_at.data();
    v.c = c.data();
    v.n_c = sizes.constants;
    v.x = x.data();
    v.n_x = states();
    v.mode = mode;
    v.hit = hit;
    v.key = key;
    v.m = m.data();
    v.n_m = sizes.memory;
    v.u = u.data();
    v.n_u = n_u;
    v.n_y = sizes.outputs;
    v.t = t;
    v.branch = branch;
    v.series = series;
    v.history = history;
    return v;
  }
  template <class T>
  static std::vector<T> call(void (*function)(const View<T>&), View<T> v, int count) {
    if (function == nullptr) throw std::logic_error("the block has no such function");
    std::vector<T> out(static_cast<std::size_t>(count));
    v.out = out.data();
    function(v);
    return out;
  }
};

/// Every block type with parameters that make sense, for laws that hold for all of them.
struct Sample {
  std::string type;
  Bench::Values values;
  int inputs = -1;
};
inline void PrintTo(const Sample& s, std::ostream* out) { *out << s.type; }
inline std::vector<Sample> samples() {
  return {
      {"constant", {{"value", {2.5}}}},
      {"sine", {{"amplitude", {3}}, {"offset", {1}}, {"frequency", {0.7}}, {"phase", {0.4}}}},
      {"triangle", {{"amplitude", {3}}, {"offset", {1}}, {"frequency", {0.7}}, {"phase", {0.4}}}},
      {"step", {{"before", {1}}, {"after", {4}}, {"time", {0.35}}}},
      {"staircase", {{"levels", {1, 4, 2}}, {"duration", {0.3}}}},
      {"chirp",
       {{"amplitude", {3}},
        {"offset", {1}},
        {"from", {0.5}},
        {"to", {6}},
        {"duration", {0.9}},
        {"sweep", {1}},
        {"phase", {0.2}}}},
      {"multisine",
       {{"rms", {2}}, {"offset", {1}}, {"lowest", {0.5}}, {"highest", {4}}, {"spacing", {0.5}}, {"seed", {3}}}},
      {"gain", {{"gain", {-1.7}}}},
      {"sum", {{"signs", {'+', '-', '+'}}}, 3},
      {"product", {}},
      {"pass", {}},
      {"mux", {}, 3},
      {"demux", {{"lengths", {2, 1}}}, 3},
      {"select", {{"indices", {2, 0}}}, 3},
      {"matrix_gain", {{"matrix", {1, -2, 0.5, 0, 3, 1}}, {"matrix columns", {3}}}, 3},
      {"saturation", {{"lower", {-1}}, {"upper", {1.4}}}},
      {"calibration", {{"gain", {1.1}}, {"offset", {0.3}}}},
      {"polynomial", {{"coefficients", {0.2, 1, -0.3, 0.1}}, {"reference", {2}}, {"lower", {-1}}, {"upper", {1.7}}}},
      {"soft_saturation", {{"limit", {1.3}}, {"sharpness", {3}}}},
      {"generalized_prandtl_ishlinskii",
       {{"thresholds", {0, 0.4, 1.1}},
        {"weights", {1, 0.3, 0.2}},
        {"lower", {-1.5}},
        {"upper", {2}},
        {"slope_at_lower", {0.4}},
        {"slope_at_upper", {1.8}},
        {"before", {1.2}}}},
      {"generalized_prandtl_ishlinskii",
       {{"thresholds", {0.4, 1.1}},
        {"weights", {0.3, 0.2}},
        {"sides", {1}},
        {"lower", {-3}},
        {"upper", {3}},
        {"slope_at_lower", {1}},
        {"slope_at_upper", {0.6}}}},
      {"preisach",
       {{"levels", {-1, 0.2, 0.9, 1.5}},
        {"weights", {0.3, 0.2, 0.5, 0.1, 0.4, 0.25}},
        {"gain", {1.2}},
        {"before", {0.4}}}},
      {"late_prandtl_ishlinskii",
       {{"thresholds", {0, 0.4, 1.1}},
        {"weights", {1, 0.3, 0.2}},
        {"before", {-2}},
        {"time", {0.3}},
        {"share", {0.7}},
        {"spread", {0.6}}}},
      {"late_prandtl_ishlinskii",
       {{"thresholds", {0, 0.4, 1.1}}, {"weights", {1, 0.3, 0.2}}, {"sides", {1}}, {"time", {0.3}}, {"ahead", {1}}}},
      {"ageing", {{"per_decade", {0.03}}, {"first", {50}}, {"swing", {0.3}}}},
      {"load_dependence", {{"compliance", {0.2}}, {"softening", {0.1}}}},
      {"sensor_drift", {{"rate", {0.3}}, {"zero", {0.1}}}},
      {"rectifier", {{"mix", {0.4}}}},
      {"rounding", {{"step", {0.3}}}},
      {"pyro_charge", {{"coefficient", {0.4}}, {"time", {0.7}}}},
      {"mass_with_drag", {{"mass", {2}}, {"damping", {0.8}}, {"stiffness", {50}}, {"drag", {0.6}}}},
      {"mains_interference", {{"frequency", {1.3}}, {"cosine", {0.4, 0.1}}, {"sine", {-0.2, 0.3}}}},
      {"cross_coupling", {{"coefficient", {0.3}}}},
      {"late_cross_coupling", {{"coefficient", {0.3}}, {"time", {0.6}}}},
      {"temperature_gain", {{"sensitivity", {0.2}}, {"reference", {0.5}}, {"curvature", {0.1}}}},
      {"thermal_expansion", {{"coefficients", {0.4, -0.2}}, {"times", {0.3, 1.1}}, {"reference", {0.5}}}, 2},
      {"resonance", {{"frequency", {0.8}}, {"damping", {0.2}}}},
      {"modes",
       {{"frequencies", {0.8, 1.3}}, {"dampings", {0.2, 0.1}}, {"positions", {0.4, 0.1}}, {"velocities", {-0.3, 0.2}}}},
      {"mass_with_mode",
       {{"mass", {2}},
        {"damping", {0.8}},
        {"stiffness", {50}},
        {"share", {0.3}},
        {"frequency", {0.9}},
        {"mode_damping", {0.1}}}},
      {"mass_with_presliding",
       {{"mass", {2}},
        {"damping", {0.8}},
        {"stiffness", {50}},
        {"contact_stiffness", {20, 9}},
        {"slip_distance", {0.1, 0.4}},
        {"excess", {0.5}},
        {"stribeck_velocity", {0.7}},
        {"stiffening", {7}},
        {"quadratic", {3}},
        {"quintic", {0.4}},
        {"drag", {0.6}},
        {"contact_time", {0.03}}}},
      {"mass_on_hysteretic_spring",
       {{"mass", {2}},
        {"damping", {0.8}},
        {"stiffness", {50}},
        {"contact_stiffness", {20, 9}},
        {"slip_distance", {1.5, 4}}}},
      {"mass_on_bouc_wen_spring",
       {{"mass", {2}},
        {"damping", {0.8}},
        {"stiffness", {50}},
        {"hysteretic_share", {0.4}},
        {"beta", {0.7}},
        {"gamma", {-0.3}},
        {"stiffening", {7}},
        {"drag", {0.6}}}},
      {"mass_on_spring_of_plays",
       {{"mass", {2}},
        {"damping", {0.8}},
        {"stiffness", {50}},
        {"thresholds", {0.3, 1.2}},
        {"at_lower", {4, 2}},
        {"in_middle", {7, 1}},
        {"at_upper", {3, 5}},
        {"lower", {-2}},
        {"upper", {3}}}},
      {"sliding_friction", {{"level", {0.7}}, {"slip_distance", {0.3}}, {"crossover", {0.4}}}},
      {"guide_friction", {{"level", {0.2}}, {"slip_distance", {0.3}}, {"excess", {0.5}}, {"stribeck_velocity", {0.7}}}},
      {"integrator", {{"initial", {0.6}}}},
      {"transfer_function", {{"gain", {2}}, {"num", {1, 3}}, {"den", {0.5, 2, 8}}}},
      {"transfer_function", {{"gain", {2}}, {"num", {1, 0.2, 3}}, {"den", {0.5, 2, 8}}}},
      {"state_space",
       {{"a", {0, 1, -8, -2}},
        {"a columns", {2}},
        {"b", {0, 1, 8, 0.5}},
        {"b columns", {2}},
        {"c", {1, 0, 0.5, 2, 1, 1}},
        {"c columns", {2}},
        {"initial", {0.3, -0.2}}},
       2},
      {"state_space",
       {{"a", {-2}},
        {"a columns", {1}},
        {"b", {1, -3}},
        {"b columns", {2}},
        {"c", {4}},
        {"c columns", {1}},
        {"d", {0.5, 1}},
        {"d columns", {2}},
        {"input_unit", {'m', 'V'}},
        {"output_unit", {'u', 'm'}}},
       2},
      {"pi_controller", {{"kp", {1.2}}, {"ki", {3}}, {"initial", {0.1}}}},
      {"lag", {{"times", {0.3}}}},
      {"lag", {{"times", {0.3, 0.7}}}},
      {"creep", {{"amounts", {0.1, 0.3}}, {"times", {0.2, 2}}}},
      {"logarithmic_creep", {{"per_decade", {0.2}}, {"first_time", {0.1}}, {"times", {0.05, 0.2, 2}}}},
      {"dead_time", {{"delay", {0.21}}}},
      {"play", {{"radius", {0.4}}, {"before", {2}}}},
      {"play", {{"radius", {0.4}}, {"sides", {1}}, {"before", {-2}}}},
      {"prandtl_ishlinskii", {{"thresholds", {0, 0.4, 1.1}}, {"weights", {1, 0.3, 0.2}}}},
      {"prandtl_ishlinskii",
       {{"thresholds", {0, 0.4, 1.1}}, {"weights", {1, 0.3, 0.2}}, {"sides", {1}}, {"before", {3}}}},
      {"bouc_wen", {{"alpha", {0.6}}, {"beta", {0.24}}, {"gamma", {0.02}}, {"d_p", {1.6}}, {"initial", {0.2}}}},
      {"bouc_wen",
       {{"alpha", {0.6}}, {"beta", {0.24}}, {"gamma", {0.02}}, {"d_p", {1.6}}, {"exponent", {2}}, {"scale", {0.5}}}},
      {"jiles_atherton", {{"p_s", {56}}, {"a", {48.6}}, {"alpha", {0.25}}, {"k", {3.9}}, {"c", {0.69}}}},
      {"tapi",
       {{"thresholds", {0, 0.4, 1.1}},
        {"weights", {1, 0.3, 0.2}},
        {"p_s", {1.3}},
        {"t_c", {4}},
        {"beta", {0.5}},
        {"a", {0.8}},
        {"before", {-2}}}},
      {"asymmetric_prandtl_ishlinskii",
       {{"thresholds", {0, 0.4, 1.1}},
        {"weights", {1, 0.3, 0.2}},
        {"saturation", {1.1}},
        {"bend", {0.8}},
        {"before", {-2}}}},
      {"coupled_tapi",
       {{"thresholds", {0, 0.4}},
        {"weights", {1, 0.3, 0.1, -0.05, -0.2, 0.1, 1.2, 0.1}},
        {"weights columns", {2}},
        {"p_s", {0.4, 0.1, -0.1, 0.3}},
        {"p_s columns", {2}},
        {"t_c", {4}},
        {"beta", {0.5, 1, 1.2, 0.7}},
        {"beta columns", {2}},
        {"a", {0.8, 0.9, 1, 0.7}},
        {"a columns", {2}}},
       3},
      {"maxwell_capacitor", {{"yield_charges", {0.4, 1.1}}, {"elastances", {0.7, 0.3}}}},
      {"wheatstone_bridge", {{"supply", {5}}, {"resistance", {350}}, {"gauge_factor", {0.02}}}},
      {"wheatstone_bridge_inverse", {{"supply", {50}}, {"resistance", {350}}, {"gauge_factor", {0.02}}}},
      {"relay", {{"on_at", {0.5}}, {"off_at", {-0.5}}, {"on_value", {3}}, {"off_value", {-1}}, {"initial", {1}}}},
      {"backlash", {{"gap", {0.7}}, {"before", {1}}}},
      {"prandtl_ishlinskii_inverse", {{"thresholds", {0, 0.4, 1.1}}, {"weights", {1, 0.3, 0.2}}, {"before", {-2}}}},
      {"prandtl_ishlinskii_inverse",
       {{"thresholds", {0, 0.4, 1.1}}, {"weights", {1, 0.3, -0.2}}, {"sides", {1}}, {"before", {3}}}},
      {"bouc_wen_inverse", {{"alpha", {0.6}}, {"beta", {0.24}}, {"gamma", {0.02}}, {"d_p", {1.6}}, {"origin", {0.2}}}},
      {"bouc_wen_inverse",
       {{"alpha", {0.6}}, {"beta", {0.24}}, {"gamma", {0.02}}, {"d_p", {1.6}}, {"exponent", {2}}, {"scale", {0.5}}}},
      {"jiles_atherton_inverse",
       {{"p_s", {56}}, {"a", {48.6}}, {"alpha", {0.25}}, {"k", {3.9}}, {"c", {0.69}}, {"origin", {1.4}}}},
      {"rate_limiter", {{"rise", {4}}, {"fall", {2}}, {"time", {0.05}}}},
      {"slew_limit", {{"rate", {4}}, {"fall", {2}}, {"time", {0.05}}}},
      {"current_limit", {{"source", {0.4}}, {"sink", {0.2}}, {"capacitance", {0.1}}, {"time", {0.05}}}},
      {"mass_spring_damper", {{"mass", {2}}, {"damping", {0.8}}, {"stiffness", {50}}, {"initial_position", {0.3}}}},
      {"mass_on_stiffening_spring",
       {{"mass", {2}},
        {"damping", {0.8}},
        {"stiffness", {50}},
        {"stiffening", {7}},
        {"quadratic", {3}},
        {"quintic", {0.4}},
        {"drag", {0.6}}}},
      {"mass_with_friction",
       {{"mass", {0.5}},
        {"stiffness", {3}},
        {"coulomb", {1}},
        {"breakaway", {1.5}},
        {"stribeck_velocity", {0.2}},
        {"rest_speed", {1e-9}}}},
      {"mass_with_stops",
       {{"mass", {0.5}},
        {"stiffness", {3}},
        {"lower", {-1}},
        {"upper", {1}},
        {"restitution", {0.6}},
        {"rest_speed", {1e-6}}}},
      {"tank", {{"area", {2}}, {"outlet", {0.6}}, {"reference", {1}}, {"brim", {4}}, {"initial", {1}}}},
      {"tank", {{"area", {2}}, {"outlet", {0.6}}, {"reference", {1}}, {"law", {1}}, {"brim", {9}}, {"initial", {1}}}},
      {"thermal_network",
       {{"capacities", {4, 3}}, {"to_ambient", {0.2, 0.3}}, {"between", {0.7}}, {"initial", {300, 310}}},
       3},
      {"sample_hold", {{"period", {0.1}}}},
      {"quantizer", {{"bits", {5}}, {"lower", {-3}}, {"upper", {3}}, {"period", {0.1}}}},
      {"sampled_noise", {{"rms", {0.3}}, {"seed", {11}}, {"period", {0.1}}}},
      {"delay_line", {{"samples", {3}}, {"before", {0.4}}, {"period", {0.1}}}},
      {"delay_line", {{"samples", {0}}, {"period", {0.1}}}},
      {"discrete_transfer_function",
       {{"gain", {2}}, {"num", {1, -0.3, 0.2}}, {"den", {2, -0.5, 0.1, 0.05}}, {"before", {0.5}}, {"period", {0.1}}}},
      {"discrete_transfer_function",
       {{"gain", {2}}, {"num", {1, -0.3}}, {"den", {2, -0.5}}, {"direct", {1}}, {"period", {0.1}}}},
      {"sampled_pid",
       {{"kp", {1.2}},
        {"ki", {3}},
        {"kd", {0.1}},
        {"filter", {0.2}},
        {"lower", {-2}},
        {"upper", {2}},
        {"rule", {2}},
        {"anti_windup", {2}},
        {"period", {0.1}}}},
      {"sampled_bouc_wen_inverse",
       {{"alpha", {0.6}}, {"beta", {0.24}}, {"gamma", {0.02}}, {"d_p", {1.6}}, {"initial", {0.1}}, {"period", {0.1}}}},
      {"sampled_jiles_atherton_inverse",
       {{"p_s", {56}}, {"a", {48.6}}, {"alpha", {0.25}}, {"k", {3.9}}, {"c", {0.69}}, {"period", {0.1}}}},
      {"sampled_tapi_inverse",
       {{"thresholds", {0, 0.4, 1.1}},
        {"weights", {1, 0.3, -0.2}},
        {"p_s", {1.3}},
        {"t_c", {4}},
        {"beta", {0.5}},
        {"a", {0.8}},
        {"period", {0.1}}}},
      {"sampled_asymmetric_inverse",
       {{"thresholds", {0, 0.4, 1.1}},
        {"weights", {1, 0.3, -0.2}},
        {"saturation", {1.1}},
        {"bend", {0.8}},
        {"period", {0.1}}}},
      {"sampled_coupled_tapi_inverse",
       {{"thresholds", {0, 0.4}},
        {"weights", {1, 0.3, 0.1, -0.05, -0.2, 0.1, 1.2, 0.1}},
        {"weights columns", {2}},
        {"p_s", {0.4, 0.1, -0.1, 0.3}},
        {"p_s columns", {2}},
        {"t_c", {4}},
        {"beta", {0.5, 1, 1.2, 0.7}},
        {"beta columns", {2}},
        {"a", {0.8, 0.9, 1, 0.7}},
        {"a columns", {2}},
        {"period", {0.1}}},
       3},
      {"impedance_estimator",
       {{"samples", {20}}, {"layers", {2}}, {"area", {0.5}}, {"thickness", {0.1}}, {"period", {0.1}}}},
      {"sensor_noise", {{"rms", {0.3}}, {"period", {0.05}}, {"seed", {11}}}}};
}

/// The samples for which a law is meant, so that no test is skipped for a block that it does not concern.
template <class Wanted>
std::vector<Sample> samples_where(Wanted wanted) {
  std::vector<Sample> list;
  for (const auto& s : samples())
    if (wanted(Bench(s.type, s.values, s.inputs))) list.push_back(s);
  return list;
}
inline bool any_parameter(const Bench& b, bool ParameterDeclaration::*flag) {
  for (const auto& p : b.kernel.declaration.parameters)
    if (p.*flag && p.kind != ParameterKind::text) return true;
  return false;
}
inline std::string sample_name(const testing::TestParamInfo<Sample>& made) {
  return made.param.type + "_" + std::to_string(made.index);
}

}  // namespace hysteron::bench
