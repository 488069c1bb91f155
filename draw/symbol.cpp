#include "draw/symbol.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "draw/pictogram.h"

namespace hysteron::draw {
namespace {

/// Types whose pictogram has another name than they, and whether the type must be told beside it.
struct Look {
  const char* picture;
  bool note = false;
};

const Look* find_look(const std::string& type) {
  static const std::map<std::string, Look> all{
      {"sine", {"sine"}},
      {"triangle", {"triangle"}},
      {"step", {"step"}},
      {"staircase", {"staircase"}},
      {"ramp", {"ramp"}},
      {"pulse", {"square"}},
      {"trapezoid", {"trapezoid"}},
      {"motion_profile", {"s_curve"}},
      {"time_table", {"table", true}},
      {"chirp", {"chirp"}},
      {"multisine", {"multisine"}},
      {"recorded", {"recorded"}},
      {"noise", {"noise"}},
      {"sampled_noise", {"noise", true}},
      {"sensor_noise", {"noise", true}},
      {"saturation", {"saturation"}},
      {"current_limit", {"saturation", true}},
      {"dead_zone", {"dead_zone"}},
      {"play", {"play"}},
      {"backlash", {"play", true}},
      {"relay", {"relay"}},
      {"prandtl_ishlinskii", {"hysteresis", true}},
      {"prandtl_ishlinskii_inverse", {"hysteresis_inverse", true}},
      {"bouc_wen", {"hysteresis", true}},
      {"bouc_wen_inverse", {"hysteresis_inverse", true}},
      {"jiles_atherton", {"hysteresis", true}},
      {"jiles_atherton_inverse", {"hysteresis_inverse", true}},
      {"tapi", {"hysteresis", true}},
      {"sampled_tapi_inverse", {"hysteresis_inverse", true}},
      {"asymmetric_prandtl_ishlinskii", {"hysteresis", true}},
      {"sampled_asymmetric_inverse", {"hysteresis_inverse", true}},
      {"coupled_tapi", {"hysteresis", true}},
      {"sampled_coupled_tapi_inverse", {"hysteresis_inverse", true}},
      {"maxwell_capacitor", {"hysteresis", true}},
      {"polynomial", {"table", true}},
      {"lookup", {"table", true}},
      {"preisach", {"hysteresis", true}},
      {"quantizer", {"quantizer"}},
      {"bearing_friction", {"friction", true}},
      {"rate_limiter", {"rate_limiter", true}},
      {"calibration", {"calibration"}},
      {"creep", {"step_response", true}},
      {"logarithmic_creep", {"step_response", true}},
      {"sample_hold", {"sampled", true}},
      {"sampled_bouc_wen_inverse", {"hysteresis_inverse", true}},
      {"sampled_jiles_atherton_inverse", {"hysteresis_inverse", true}},
      {"mass_spring_damper", {"mass", true}},
      {"mass_on_stiffening_spring", {"mass", true}},
      {"duffing", {"mass", true}},
      {"mass_with_friction", {"mass", true}},
      {"mass_with_stops", {"mass", true}},
      {"mass_with_cogging", {"mass", true}},
      {"mass_on_spring_of_plays", {"mass", true}},
      {"mass_on_bouc_wen_spring", {"mass", true}},
      {"integrator_with_friction", {"friction", true}},
      {"inertia", {"inertia", true}},
      {"inertia_with_friction", {"inertia", true}},
      {"inertia_with_presliding", {"inertia", true}},
      {"inertia_with_drag", {"inertia", true}},
      {"inertia_with_cogging", {"inertia", true}},
      {"gear", {"gear"}},
      {"periodic_error", {"sine", true}},
      {"fmu", {"sampled", true}},
      {"belt", {"belt"}},
      {"ball_screw", {"screw", true}},
      {"dc_motor", {"motor", true}},
      {"dc_motor_with_presliding", {"motor", true}},
      {"dc_winding", {"motor", true}},
      {"tank", {"tank", true}},
      {"notch", {"notch", true}},
      {"pwm", {"pulses", true}},
      {"winding", {"winding", true}},
      {"voice_coil", {"winding", true}},
      {"pendulum", {"pendulum", true}},
      {"pendulum_with_presliding", {"pendulum", true}},
      {"battery_cell", {"battery", true}},
      {"encoder", {"quantizer", true}},
      {"linear_encoder", {"quantizer", true}},
      {"soft_saturation", {"saturation", true}},
      {"wrap", {"sawtooth", true}},
      {"rectifier", {"rectifier"}},
      {"rounding", {"quantizer", true}},
      {"sensor_drift", {"ramp", true}},
      {"mains_interference", {"sine", true}},
      {"slew_limit", {"rate_limiter", true}},
      {"generalized_prandtl_ishlinskii", {"hysteresis", true}},
      {"late_prandtl_ishlinskii", {"hysteresis", true}},
      {"sliding_friction", {"friction", true}},
      {"guide_friction", {"friction", true}},
      {"mass_with_drag", {"mass", true}},
      {"mass_with_mode", {"mass", true}},
      {"mass_with_presliding", {"mass", true}},
      {"mass_on_hysteretic_spring", {"mass", true}},
      {"propeller", {"propeller", true}},
      {"h_bridge", {"bridge", true}},
      {"h_bridge_with_dead_time", {"bridge", true}},
      {"synchronous_motor", {"motor", true}},
      {"stepper_motor", {"motor", true}},
      {"wheatstone_bridge", {"diamond", true}},
      {"wheatstone_bridge_inverse", {"diamond", true}},
      {"comparator", {"comparator", true}},
      {"switch", {"switch"}},
      {"manual_switch", {"switch", true}},
  };
  const auto found = all.find(type);
  return found == all.end() ? nullptr : &found->second;
}

std::string power(const std::string& variable, std::size_t exponent) {
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  if (exponent == 0) return "";
  if (exponent == 1) return variable;
  std::string text = variable;
  for (const char c : std::to_string(exponent)) text += digits[c - '0'];
  return text;
}

/// z⁻ⁿ
std::string delayed(std::size_t n) { return n == 0 ? "" : n == 1 ? "z⁻¹" : power("z⁻", n); }

/// "0.5 s² + s + 1" from the coefficients, highest power first; in z⁻¹ lowest power first.
std::string polynomial(const std::vector<double>& coefficients, const std::string& variable) {
  const bool delays = variable == "z⁻";
  std::string text;
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    const double c = coefficients[i];
    if (c == 0 && coefficients.size() > 1) continue;
    const std::string s = delays ? delayed(i) : power(variable, coefficients.size() - 1 - i);
    const std::string size = std::abs(c) == 1 && !s.empty() ? "" : fmt::format("{:.4g}", std::abs(c));
    text += text.empty() ? (c < 0 ? "−" : "") : (c < 0 ? " − " : " + ");
    text += size + (size.empty() || s.empty() ? "" : " ") + s;
  }
  return text.empty() ? "0" : text;
}

double ports_height(int n_in, int n_out) { return port_distance * std::max({n_in, n_out, 1}) + 8; }

/// Wide and high enough for what stands in it.
Symbol sized(Symbol s, int n_in, int n_out) {
  double wide = 0;
  for (const auto& line : s.text) wide = std::max(wide, text_width(line, 12));
  s.width = std::max({s.width, std::ceil(wide) + 18, std::ceil(text_width(s.note, 9)) + 10});
  const double lines = 15 * static_cast<double>(s.text.size()) + (s.fraction ? 16 : 14);
  s.height = std::max({s.height, s.text.empty() ? 0 : lines, ports_height(n_in, n_out)});
  if (s.outline == Outline::box && std::max(n_in, n_out) > 1) s.port_names = true;
  return s;
}

Symbol fraction(const std::string& over, const std::string& under) {
  Symbol s;
  s.text = {over, under};
  s.fraction = true;
  return s;
}

Symbol formula(const std::string& text) {
  Symbol s;
  s.text = {text};
  return s;
}

Symbol picture(const std::string& name, const std::string& note) {
  Symbol s;
  s.picture = name;
  s.note = note;
  s.width = 64;
  s.height = note.empty() ? 44 : 54;
  return s;
}

Symbol sum(const Values& values, int n_in) {
  Symbol s;
  s.signs = values.text("signs");
  s.signs.resize(static_cast<std::size_t>(n_in), '+');
  s.shown = {"signs"};
  if (n_in <= 3) {
    s.outline = Outline::circle;
    s.width = s.height = 2 * sum_radius;
  } else {
    make_sum_box(s, n_in);
  }
  return s;
}

Symbol product(int n_in) {
  Symbol s;
  s.text = {"×"};
  s.width = 36;
  s.height = std::max(36.0, ports_height(n_in, 1));
  return s;
}

Symbol gain(const Values& values) {
  Symbol s;
  s.outline = Outline::triangle;
  s.text = {values.text("gain")};
  s.shown = {"gain"};
  // The text stands in the thick part of the triangle: two thirds of its width at half of its height.
  s.width = std::max(52.0, std::ceil(1.55 * text_width(s.text[0], 11)) + 14);
  s.height = std::min(64.0, std::max(44.0, 0.75 * s.width));
  return s;
}

Symbol lag(const Values& values) {
  const auto times = values.numbers("times");
  if (times.size() > 3) return fraction("1", fmt::format("(T₁s + 1) … ({} poles)", times.size()));
  static const char* const index[] = {"₁", "₂", "₃"};
  if (times.size() <= 1) return fraction("1", "T s + 1");
  std::string under;
  for (std::size_t i = 0; i < times.size(); ++i) under += fmt::format("(T{}s + 1)", index[i]);
  return fraction("1", under);
}

/// The polynomials with their numbers where they fit, else with their degrees.
Symbol transfer_function(const Values& values, const std::string& variable) {
  const auto num = values.numbers("num");
  const auto den = values.numbers("den");
  const std::string over = polynomial(num, variable);
  const std::string under = polynomial(den, variable);
  if (!num.empty() && !den.empty() && text_width(over, 12) < 150 && text_width(under, 12) < 150) {
    Symbol s = fraction(over, under);
    s.shown = {"num", "den"};
    return s;
  }
  const auto short_form = [&](const char* name, std::size_t n) {
    if (n < 2) return std::string(name);
    return variable == "s" ? fmt::format("{}₀{} + …", name, power(variable, n - 1))
                           : fmt::format("{}₀ + {}₁z⁻¹ + …", name, name);
  };
  return fraction(short_form("b", num.size()), short_form("a", den.size()));
}

/// A filter by which frequencies pass.
Symbol filter(const Values& values, const std::string& note) {
  const std::string pass = values.text("pass");
  Symbol s = picture(pass == "high"   ? "high_pass"
                     : pass == "band" ? "band_pass"
                     : pass == "stop" ? "notch"
                                      : "low_pass",
                     note);
  s.shown = {"pass"};
  return s;
}

Symbol discrete_integrator(const Values& values) {
  const std::string rule = values.text("rule");
  if (rule == "backward") return fraction("T z", "z − 1");
  if (rule == "trapezoidal") return fraction("T (z + 1)", "2 (z − 1)");
  return fraction("T", "z − 1");
}

/// The law itself where it is short.
Symbol expression(const Values& values) {
  const std::string law = values.text("y");
  if (law.empty() || text_width(law, 12) > 150) return formula("f(…)");
  Symbol s = formula(law);
  s.shown = {"y"};
  return s;
}

/// Blocks that one choice makes what they are: "sin", "max", "<".
Symbol chosen(const Values& values, const char* parameter, const std::map<std::string, std::string>& signs = {}) {
  const std::string choice = values.text(parameter);
  const auto sign = signs.find(choice);
  Symbol s = formula(sign == signs.end() ? choice : sign->second);
  s.shown = {parameter};
  return s;
}

/// Types that one transfer function stands for, whatever their numbers are.
struct Fraction {
  const char *over, *under;
};

const Fraction* find_fraction(const std::string& type) {
  static const std::map<std::string, Fraction> all{{"integrator", {"1", "s"}},
                                                   {"limited_integrator", {"1", "s"}},
                                                   {"integrator_with_reset", {"1", "s"}},
                                                   {"filtered_derivative", {"s", "T s + 1"}},
                                                   {"lead_lag", {"s/ω₁ + 1", "s/ω₂ + 1"}},
                                                   {"biquads", {"s²/ω₁² + 2D₁s/ω₁ + 1", "s²/ω₂² + 2D₂s/ω₂ + 1"}},
                                                   {"zero_pole_gain", {"k ∏(s − z)", "∏(s − p)"}},
                                                   {"resonance", {"ω²", "s² + 2Dωs + ω²"}},
                                                   {"modes", {"Σ aω²", "s² + 2Dωs + ω²"}}};
  const auto found = all.find(type);
  return found == all.end() ? nullptr : &found->second;
}

/// Types that a few letters stand for, and whether the type must be told below them.
struct Letters {
  const char* text;
  bool note = false;
};

const Letters* find_letters(const std::string& type) {
  static const std::map<std::string, Letters> all{{"divide", {"÷"}},
                                                  {"matrix_gain", {"K u"}},
                                                  {"fir", {"Σ bᵢ z⁻ⁱ"}},
                                                  {"pi_controller", {"kp + ki/s"}},
                                                  {"pid", {"PID"}},
                                                  {"pid_tracking", {"PID"}},
                                                  {"dead_time", {"e⁻ˢᵀ"}},
                                                  {"variable_dead_time", {"e⁻ˢᵀ"}},
                                                  {"delay_line", {"z⁻ⁿ"}},
                                                  {"abs", {"|u|"}},
                                                  {"sign", {"sgn"}},
                                                  {"sample_and_hold", {"S/H"}},
                                                  {"edge", {"↑"}},
                                                  {"counter", {"n"}},
                                                  {"timer", {"t"}},
                                                  {"state_machine", {"○→○"}},
                                                  {"select", {"⋮"}},
                                                  {"cross_coupling", {"u + c v"}},
                                                  {"late_cross_coupling", {"u + c v/(Ts + 1)"}},
                                                  {"temperature_gain", {"k(ϑ) u"}},
                                                  {"thermal_expansion", {"u + α Δϑ", true}},
                                                  {"pyro_charge", {"u + p Δϑ", true}},
                                                  {"ageing", {"k(lg n) u", true}},
                                                  {"load_dependence", {"u + F/c", true}},
                                                  {"input_shaper", {"A₁ + A₂e⁻ˢᵀ", true}},
                                                  {"thermal_network", {"C ϑ̇ = −G ϑ + q", true}},
                                                  {"moving_average", {"Σ u/n", true}},
                                                  {"observer", {"x̂", true}},
                                                  {"kalman_filter", {"x̂", true}},
                                                  {"disturbance_observer", {"d̂", true}},
                                                  {"impedance_estimator", {"Z", true}},
                                                  {"repetitive_controller", {"1/(1 − z⁻ⁿ)", true}}};
  const auto found = all.find(type);
  return found == all.end() ? nullptr : &found->second;
}

}  // namespace

double text_width(const std::string& text, double size) {
  double width = 0;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xC0) == 0x80) continue;  // continuation bytes of UTF-8
    if (std::string_view("ijl.,:;|!'()[] tfr/").find(c) != std::string_view::npos)
      width += 0.38;
    else if (std::string_view("mwMW").find(c) != std::string_view::npos)
      width += 0.9;
    else
      width += c >= 'A' && c <= 'Z' ? 0.7 : 0.6;
  }
  return width * size;
}

void make_sum_box(Symbol& sum, int n_in) {
  sum.outline = Outline::box;
  sum.text = {"Σ"};
  sum.width = 46;
  sum.height = ports_height(n_in, 1);
}

Symbol text_symbol(const std::vector<std::string>& lines, int n_in, int n_out) {
  Symbol s;
  s.text = lines;
  return sized(s, n_in, n_out);
}

Symbol symbol_of(const Declaration& declaration, const Values& values, int n_in, int n_out) {
  const std::string& type = declaration.type;
  if (type == "sum") return sum(values, n_in);
  if (type == "product") return product(n_in);
  if (type == "gain") return gain(values);
  Symbol s;
  if (type == "pass") {
    s = formula("1");
    s.width = 36;
  } else if (type == "constant") {
    s = formula(values.text("value"));
    s.shown = {"value"};
  } else if (type == "lag") {
    s = lag(values);
  } else if (type == "second_order" || type == "digital_filter") {
    s = filter(values, type);
  } else if (type == "discrete_integrator") {
    s = discrete_integrator(values);
  } else if (type == "transfer_function") {
    s = transfer_function(values, "s");
  } else if (type == "discrete_transfer_function") {
    s = transfer_function(values, "z⁻");
  } else if (type == "state_space") {
    s = text_symbol({"ẋ = A x + B u", "y = C x + D u"}, n_in, n_out);
  } else if (type == "discrete_state_space") {
    s = text_symbol({"x⁺ = A x + B u", "y = C x + D u"}, n_in, n_out);
  } else if (type == "mux" || type == "demux") {
    s = formula("⋮");
    s.width = type == "mux" ? 36 : 44;
  } else if (type == "sampled_pid" || type == "discrete_pid" || type == "discrete_pid_tracking") {
    s = formula("PID");
    s.note = "sampled";
    s.height = 54;
  } else if (type == "expression") {
    s = expression(values);
  } else if (type == "trigonometry") {
    s = chosen(values, "function");
  } else if (type == "min_max") {
    s = chosen(values, "is");
  } else if (type == "logic") {
    s = chosen(values, "is", {{"and", "&"}, {"or", "≥1"}, {"xor", "=1"}, {"not", "¬"}});
  } else if (type == "compare") {
    s = chosen(
        values, "is",
        {{"less", "<"}, {"at_most", "≤"}, {"equal", "="}, {"not_equal", "≠"}, {"at_least", "≥"}, {"greater", ">"}});
  } else if (const Fraction* of_s = find_fraction(type)) {
    s = fraction(of_s->over, of_s->under);
  } else if (const Letters* letters = find_letters(type)) {
    s = formula(letters->text);
    if (letters->note) {
      s.note = type;
      s.height = 54;
    }
  } else if (const Look* look = find_look(type)) {
    s = picture(look->picture, look->note ? type : "");
  } else {
    s = formula(type);  // recognized by its name
  }
  return sized(std::move(s), n_in, n_out);
}

}  // namespace hysteron::draw
