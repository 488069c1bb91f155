#include "tests/reference/random_diagram.h"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "tests/reference/random_numbers.h"

namespace reference {
namespace {

using Json = nlohmann::ordered_json;

std::string with_unit(double value, const std::string& unit) {
  return Json(Random::four_digits(value)).dump() + " " + unit;
}

/// Numbers with four digits: what stands in the file is what is meant.
void shorten(Json& block) {
  for (auto& [key, value] : block.items()) {
    if (value.is_number_float()) value = Random::four_digits(value);
    if (value.is_array())
      for (auto& one : value)
        if (one.is_number_float()) one = Random::four_digits(one);
  }
}

/// A signal that may be read: its name and about how large it gets.
struct Wire {
  std::string name{};
  double size = 1;
  bool smooth = true;  ///< it does not jump
};

class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random(seed), blocks(Json::object()) {}

  RandomDiagram make() {
    const int count = 2 + random.below(11);
    source();
    if (count > 4 && random.chance(0.5)) source();
    if (count > 3 && random.chance(0.35)) loop();
    while (static_cast<int>(blocks.size()) < count) grow(any());
    choose_something();
    name_a_parameter();
    nest_something();
    return written();
  }

 private:
  // --- putting blocks down ------------------------------------------------------------------------------------------
  std::string fresh() { return "b" + std::to_string(++named); }

  Wire put(Json block, const std::vector<Wire>& in, double size, bool smooth, const std::string& port = "") {
    const std::string name = fresh();
    shorten(block);
    if (in.size() == 1) block["in"] = in[0].name;
    if (in.size() > 1) {
      block["in"] = Json::array();
      for (const auto& wire : in) block["in"].push_back(wire.name);
    }
    blocks[name] = std::move(block);
    return {port.empty() ? name : name + "." + port, size, smooth};
  }

  Wire add(Json block, const std::vector<Wire>& in, double size, bool smooth) {
    wires.push_back(put(std::move(block), in, size, smooth));
    return wires.back();
  }

  /// The newer ones more often: chains grow long.
  Wire any() {
    const int n = static_cast<int>(wires.size());
    return wires[static_cast<std::size_t>(std::max(random.below(n), random.below(n)))];
  }

  double around(double size) { return random.between(-0.8, 0.8) * size; }

  // --- sources
  // --------------------------------------------------------------------------------------------------------
  void wave(Json& block) {
    block["frequency"] = with_unit(random.spread(0.3, 6), "Hz");
    block["phase"] = random.chance(0.3) ? with_unit(-90, "deg") : with_unit(random.between(-180, 180), "deg");
  }

  Wire source() {
    const double a = random.spread(0.3, 3), o = random.chance(0.5) ? 0 : random.between(-a, a);
    Json block = Json::object();
    switch (random.below(12)) {
      case 0:
      case 1:
      case 2:
        block = {{"type", "sine"}, {"amplitude", a}, {"offset", o}};
        wave(block);
        return add(block, {}, a + std::abs(o), true);
      case 3:
        block = {{"type", "triangle"}, {"amplitude", a}, {"offset", o}};
        wave(block);
        return add(block, {}, a + std::abs(o), true);
      case 4:
        block = {{"type", "step"}, {"before", o}, {"after", a}, {"time", with_unit(random.between(0, 1.5), "s")}};
        return add(block, {}, std::max(a, std::abs(o)), false);
      case 5: {
        block = {{"type", "chirp"}, {"amplitude", a}, {"offset", o}};
        block["from"] = with_unit(random.spread(0.2, 2), "Hz");
        block["to"] = with_unit(random.spread(0.5, 8), "Hz");
        block["duration"] = with_unit(random.between(0.5, 3), "s");
        block["phase"] = with_unit(random.between(-180, 180), "deg");
        if (random.chance(0.5)) block["sweep"] = "logarithmic";
        return add(block, {}, a + std::abs(o), true);
      }
      case 6: {
        block = {{"type", "staircase"}, {"levels", Json::array()}};
        for (int i = 2 + random.below(6); i > 0; --i) block["levels"].push_back(random.between(-a, a));
        block["duration"] = with_unit(random.between(0.1, 0.7), "s");
        return add(block, {}, a, false);
      }
      case 7:
        return recording(a);
      case 8:
        return points(a);
      default:
        return piecewise(a, o);
    }
  }

  /// A ramp, pulses, trapezoids, or a move within limits.
  Wire piecewise(double a, double o) {
    Json block = Json::object();
    const std::string time = with_unit(random.between(0, 0.5), "s");
    switch (random.below(4)) {
      case 0:
        block = {{"type", "ramp"}, {"slope", with_unit(a / random.between(0.2, 1), "1/s")}, {"initial", o}};
        block["time"] = time;
        block["duration"] = with_unit(random.between(0.2, 1), "s");
        return add(block, {}, 5 * a + std::abs(o), true);
      case 1:
        block = {{"type", "pulse"}, {"low", o}, {"high", a}, {"period", with_unit(random.between(0.2, 0.9), "s")}};
        block["duty"] = random.between(0.1, 0.9);
        block["time"] = time;
        return add(block, {}, std::max(a, std::abs(o)), false);
      case 2:
        block = {{"type", "trapezoid"}, {"low", o}, {"high", a}};
        for (const char* part : {"rise", "top", "fall"}) block[part] = with_unit(random.between(0.05, 0.3), "s");
        if (random.chance(0.6)) block["period"] = with_unit(random.between(0.9, 1.5), "s");
        block["time"] = time;
        return add(block, {}, std::max(a, std::abs(o)), true);
      default:
        block = {{"type", "motion_profile"}, {"positions", Json::array()}, {"initial", o}};
        for (int i = 1 + random.below(4); i > 0; --i) block["positions"].push_back(random.between(-a, a));
        block["velocity"] = with_unit(a * random.spread(1, 10), "1/s");
        block["acceleration"] = with_unit(a * random.spread(10, 100), "1/s^2");
        block["jerk"] = with_unit(a * random.spread(100, 3000), "1/s^3");
        block["dwell"] = with_unit(random.between(0, 0.3), "s");
        block["time"] = time;
        wires.push_back(put(block, {}, std::max(a, std::abs(o)), true, "position"));
        return wires.back();
    }
  }

  Wire points(double a) {
    const bool hold = random.chance(0.4);
    Json block = {{"type", "time_table"}, {"times", Json::array()}, {"values", Json::array()}};
    block["between_points"] = hold ? "hold" : "linear";
    double t = random.between(0, 0.3);
    for (int i = 2 + random.below(8); i > 0; --i, t += random.between(0.05, 0.4)) {
      block["times"].push_back(with_unit(t, "s"));
      block["values"].push_back(random.between(-a, a));
    }
    return add(block, {}, a, !hold);
  }

  Wire recording(double a) {
    const std::string file = "rows" + std::to_string(++named) + ".csv";
    std::string text = "t [s],u\n";
    double t = 0;
    for (int i = 0; i < 30; ++i, t += random.between(0.02, 0.2))
      text += Json(t).dump() + "," + Json(random.between(-a, a)).dump() + "\n";
    files[file] = text;
    const bool hold = random.chance(0.4);
    Json block = {{"type", "recorded"}, {"file", file}, {"column", "u"}, {"between_samples", hold ? "hold" : "linear"}};
    return add(block, {}, a, !hold);
  }

  // --- blocks behind others
  // -------------------------------------------------------------------------------------------
  using Maker = Wire (Generator::*)(const Wire&);

  Wire grow(const Wire& u) {
    static const std::vector<Maker> makers = {&Generator::gain,         &Generator::sum,
                                              &Generator::sum,          &Generator::product,
                                              &Generator::saturation,   &Generator::dead_zone,
                                              &Generator::rectifier,    &Generator::rounding,
                                              &Generator::relay,        &Generator::relay,
                                              &Generator::play,         &Generator::play,
                                              &Generator::plays,        &Generator::preisach,
                                              &Generator::bouc_wen,     &Generator::jiles_atherton,
                                              &Generator::inverse,      &Generator::lag,
                                              &Generator::lag,          &Generator::integrator,
                                              &Generator::resonance,    &Generator::transfer,
                                              &Generator::dead_time,    &Generator::dead_time,
                                              &Generator::hold,         &Generator::quantizer,
                                              &Generator::delay_line,   &Generator::filter,
                                              &Generator::pid,          &Generator::limiter,
                                              &Generator::body,         &Generator::body,
                                              &Generator::smooth_curve, &Generator::creep,
                                              &Generator::modes,        &Generator::backlash,
                                              &Generator::section,      &Generator::sampled_filter,
                                              &Generator::expression,   &Generator::table,
                                              &Generator::level,        &Generator::of_two};
    return (this->*random.one_of(makers))(u);
  }

  Wire gain(const Wire& u) {
    const double g = (random.chance(0.3) ? -1 : 1) * random.spread(0.3, 3);
    return add({{"type", "gain"}, {"gain", g}}, {u}, std::abs(g) * u.size, u.smooth);
  }
  Wire sum(const Wire& u) {
    const Wire v = any();
    return add({{"type", "sum"}, {"signs", random.chance(0.5) ? "+-" : "++"}}, {u, v}, u.size + v.size,
               u.smooth && v.smooth);
  }
  Wire product(const Wire& u) {
    const Wire v = any();
    return add({{"type", "product"}}, {u, v}, u.size * v.size, u.smooth && v.smooth);
  }
  Wire saturation(const Wire& u) {
    const double a = around(u.size), b = a + random.between(0.1, 1) * u.size;
    return add({{"type", "saturation"}, {"lower", a}, {"upper", b}}, {u}, std::max(std::abs(a), std::abs(b)), u.smooth);
  }
  Wire dead_zone(const Wire& u) {
    const double a = random.between(0.1, 0.8) * u.size;
    const Wire inner = put({{"type", "saturation"}, {"lower", -a}, {"upper", a}}, {u}, a, u.smooth);
    return add({{"type", "sum"}, {"signs", "+-"}}, {u, inner}, u.size, u.smooth);
  }
  Wire rectifier(const Wire& u) {
    return add({{"type", "rectifier"}, {"mix", random.chance(0.5) ? 0.5 : random.between(0, 1)}}, {u}, u.size,
               u.smooth);
  }
  Wire rounding(const Wire& u) {
    return add({{"type", "rounding"}, {"step", random.between(0.1, 0.7) * u.size}}, {u}, u.size, false);
  }
  Wire relay(const Wire& u) {
    const double on = around(u.size), off = on - random.between(0.05, 0.8) * u.size;
    Json block = {{"type", "relay"}, {"on_at", on}, {"off_at", off}};
    block["on_value"] = random.between(-2, 2);
    block["off_value"] = random.between(-2, 2);
    if (random.chance(0.3)) block["initial"] = "on";
    return add(block, {u}, 2, false);
  }
  Wire expression(const Wire& u) {
    const double a = around(u.size), b = random.between(0.3, 1) * u.size;
    Json block = {{"type", "expression"}, {"a", a}, {"b", b}};
    switch (random.below(3)) {
      case 0:
        block["y"] = "a*sin(u/b) + u^2/sqrt(b^2 + u^2)";
        return add(block, {u}, 2 * u.size, u.smooth);
      case 1:
        block["y"] = "max(u, a) - 0.5*min(u, b) + abs(u)";
        return add(block, {u}, 3 * u.size, u.smooth);
      default:
        block["y"] = "if(u > a, b, c)";
        block["c"] = around(u.size);
        return add(block, {u}, u.size, false);
    }
  }
  Wire table(const Wire& u) {
    Json block = {{"type", "lookup"}, {"at", Json::array()}, {"values", Json::array()}};
    double at = random.between(-1, -0.4) * u.size;
    for (int i = 2 + random.below(4); i > 0; --i, at += random.between(0.2, 0.6) * u.size) {
      block["at"].push_back(at);
      block["values"].push_back(around(u.size));
    }
    if (random.chance(0.4)) block["outside"] = "extrapolate";
    return add(block, {u}, 4 * u.size, u.smooth);
  }
  Wire level(const Wire& u) {
    Json block = {{"type", "comparator"}, {"level", around(u.size)}};
    block["above"] = random.between(-2, 2);
    block["below"] = random.between(-2, 2);
    return add(block, {u}, 2, false);
  }
  Wire of_two(const Wire& u) {
    const Wire v = any();
    if (random.chance(0.5))
      return add({{"type", "min_max"}, {"is", random.chance(0.5) ? "max" : "min"}}, {u, v}, u.size + v.size,
                 u.smooth && v.smooth);
    const Wire control = any();
    return add({{"type", "switch"}, {"level", around(control.size)}}, {u, control, v}, u.size + v.size, false);
  }
  Wire play(const Wire& u) {
    Json block = {{"type", "play"}, {"radius", random.between(0.05, 0.7) * u.size}};
    if (random.chance(0.3)) block["sides"] = "one";
    if (random.chance(0.2)) block["before"] = around(u.size);
    return add(block, {u}, u.size, u.smooth);
  }
  Wire backlash(const Wire& u) {
    return add({{"type", "backlash"}, {"gap", random.between(0.05, 0.9) * u.size}}, {u}, u.size, u.smooth);
  }
  /// Thresholds from zero and positive weights.
  Json plays_of(const Wire& u, const std::string& type) {
    Json block = {{"type", type}, {"thresholds", {0}}, {"weights", {random.between(0.3, 1)}}};
    double r = 0;
    for (int i = 1 + random.below(4); i > 0; --i) {
      r += random.between(0.05, 0.3) * u.size;
      block["thresholds"].push_back(r);
      block["weights"].push_back(random.between(0.05, 0.4));
    }
    block["sides"] = random.chance(0.5) ? "one" : "two";
    return block;
  }
  Wire plays(const Wire& u) {
    if (random.chance(0.25)) {
      Json block = plays_of(u, "asymmetric_prandtl_ishlinskii");
      block.erase("sides");
      block["saturation"] = random.between(0.3, 1) * u.size;
      block["bend"] = random.between(0.3, 1) * u.size;
      return add(block, {u}, 3 * u.size, u.smooth);
    }
    Json block = plays_of(u, "prandtl_ishlinskii");
    if (random.chance(0.2)) block["before"] = around(u.size);
    return add(block, {u}, 2 * u.size, u.smooth);
  }
  Wire inverse(const Wire& u) {
    if (random.chance(0.4)) return add(plays_of(u, "prandtl_ishlinskii_inverse"), {u}, 3 * u.size, u.smooth);
    if (!u.smooth) return lag(u);
    if (random.chance(0.5)) {
      Json block = bouc_wen_numbers(u, "bouc_wen_inverse");
      return add(block, {u}, 2 * u.size, true);
    }
    return add(jiles_atherton_numbers(u, "jiles_atherton_inverse"), {u}, 2 * u.size, true);
  }
  Wire preisach(const Wire& u) {
    const int cells = 2 + random.below(3);
    Json block = {{"type", "preisach"}, {"levels", Json::array()}, {"weights", Json::array()}};
    double level = random.between(-1, -0.4) * u.size;
    block["before"] = level - 0.5 * u.size;
    for (int i = 0; i <= cells; ++i, level += random.between(0.2, 0.6) * u.size) block["levels"].push_back(level);
    for (int k = 0; k < cells * (cells + 1) / 2; ++k) block["weights"].push_back(random.between(0, 0.3));
    block["gain"] = random.between(0, 1);
    return add(block, {u}, 2 * u.size + 1, u.smooth);
  }
  Json bouc_wen_numbers(const Wire& u, const std::string& type) {
    const double width = random.between(0.5, 3) / u.size;  // 1/how far until it has bent
    Json block = {{"type", type}, {"alpha", random.between(0.2, 0.8)}, {"beta", width}};
    block["gamma"] = random.between(-0.5, 0.5) * width;
    block["d_p"] = random.between(1, 2);
    if (random.chance(0.4)) {
      block["exponent"] = random.between(1.2, 2.5);
      block["scale"] = random.between(0.2, 0.6) * u.size;
    }
    return block;
  }
  Wire bouc_wen(const Wire& u) {
    if (!u.smooth) return lag(u);
    return add(bouc_wen_numbers(u, "bouc_wen"), {u}, 2 * u.size, true);
  }
  Json jiles_atherton_numbers(const Wire& u, const std::string& type) {
    Json block = {{"type", type}, {"p_s", random.between(1.5, 4) * u.size}, {"a", random.between(1.2, 3) * u.size}};
    block["alpha"] = random.between(0, 0.15);
    block["k"] = random.between(0.2, 0.8) * u.size;
    block["c"] = random.between(0.2, 0.8);
    return block;
  }
  Wire jiles_atherton(const Wire& u) {
    if (!u.smooth) return lag(u);
    return add(jiles_atherton_numbers(u, "jiles_atherton"), {u}, 2 * u.size, true);
  }
  Wire lag(const Wire& u) {
    Json times = Json::array();
    for (int i = 1 + random.below(2); i > 0; --i) times.push_back(with_unit(random.spread(5, 500), "ms"));
    return add({{"type", "lag"}, {"times", times}}, {u}, u.size, true);
  }
  Wire integrator(const Wire& u) {
    const Wire rate = put({{"type", "gain"}, {"gain", with_unit(random.spread(0.5, 5), "1/s")}}, {u}, u.size, u.smooth);
    Json block = {{"type", "integrator"}};
    if (random.chance(0.3)) block["initial"] = around(u.size);
    return add(block, {rate}, 2 * u.size, true);
  }
  Wire resonance(const Wire& u) {
    Json block = {{"type", "resonance"}, {"frequency", with_unit(random.spread(1, 20), "Hz")}};
    block["damping"] = random.spread(0.05, 1);
    return add(block, {u}, 1.5 * u.size, true);
  }
  Wire modes(const Wire& u) {
    Json block = {{"type", "modes"}, {"frequencies", {with_unit(random.spread(1, 15), "Hz")}}};
    block["dampings"] = {random.spread(0.05, 0.5)};
    block["positions"] = {random.between(0.1, 0.6)};
    block["velocities"] = {random.between(-0.2, 0.2)};
    return add(block, {u}, 1.5 * u.size, u.smooth);
  }
  Wire creep(const Wire& u) {
    Json block = {{"type", "creep"}, {"amounts", {random.between(0.02, 0.3), random.between(0.02, 0.3)}}};
    block["times"] = {with_unit(random.spread(0.03, 0.3), "s"), with_unit(random.spread(0.3, 3), "s")};
    return add(block, {u}, 1.5 * u.size, u.smooth);
  }
  Wire transfer(const Wire& u) {
    const double w = random.spread(3, 60), d = random.between(0.1, 1.2);
    Json num = random.chance(0.3) ? Json{random.between(0, 1), w * random.between(0, 2), w * w} : Json{w * w};
    const bool direct = num.size() == 3;
    return add({{"type", "transfer_function"}, {"num", num}, {"den", {1, 2 * d * w, w * w}}}, {u}, 1.5 * u.size,
               u.smooth || !direct);
  }
  /// What is known by corner frequencies.
  Wire section(const Wire& u) {
    const auto corner = [&] { return with_unit(random.spread(1, 20), "Hz"); };
    switch (random.below(4)) {
      case 0:
        return add({{"type", "lead_lag"}, {"zero", corner()}, {"pole", corner()}}, {u}, 3 * u.size, u.smooth);
      case 1: {
        Json block = {{"type", "notch"}, {"frequency", corner()}, {"damping", random.between(0.1, 1)}};
        block["depth"] = random.between(0, 1.2);
        return add(block, {u}, 1.5 * u.size, u.smooth);
      }
      case 2: {
        Json block = {{"type", "second_order"}, {"frequency", corner()}, {"damping", random.between(0.1, 1.3)}};
        const auto pass = random.one_of<std::string>({"low", "band", "high"});
        block["pass"] = pass;
        return add(block, {u}, 1.5 * u.size, u.smooth || pass != "high");
      }
      default: {
        Json block = {{"type", "biquads"}, {"zero_frequencies", {corner(), corner()}}};
        block["zero_dampings"] = {random.between(-0.3, 0.5), random.between(0, 0.5)};
        block["pole_frequencies"] = {with_unit(random.spread(2, 20), "Hz"), with_unit(random.spread(2, 20), "Hz")};
        block["pole_dampings"] = {random.between(0.2, 1), random.between(0.2, 1)};
        return add(block, {u}, 10 * u.size, u.smooth);
      }
    }
  }
  Wire sampled_filter(const Wire& u) {
    const bool begins = random.chance(0.3);
    Json block;
    switch (random.below(4)) {
      case 0:
        block = {{"type", "fir"}, {"coefficients", {random.between(0, 0.6), random.between(-0.3, 0.5), 0.3}}};
        break;
      case 1:
        block = {{"type", "moving_average"}, {"samples", 1 + random.below(5)}};
        break;
      case 2: {
        block = {{"type", "discrete_integrator"}};
        block["rule"] = random.one_of<std::string>({"forward", "backward", "trapezoidal"});
        const Wire rate =
            put({{"type", "gain"}, {"gain", with_unit(random.spread(0.3, 3), "1/s")}}, {u}, u.size, u.smooth);
        return add(sampled(block), {rate}, 2 * u.size, false);
      }
      default:
        block = {{"type", "digital_filter"}, {"order", 1 + random.below(2)}};
        block["pass"] = random.one_of<std::string>({"low", "high"});
        block["corner"] = with_unit(random.between(0.3, 2.4), "Hz");
    }
    if (begins) block["before"] = around(u.size);
    return add(sampled(block), {u}, u.size, false);
  }
  Wire dead_time(const Wire& u) {
    return add({{"type", "dead_time"}, {"delay", with_unit(random.spread(0.01, 0.6), "s")}}, {u}, u.size, u.smooth);
  }
  Json sampled(Json block) {
    block["period"] =
        with_unit(random.chance(0.5) ? random.one_of<double>({0.01, 0.02, 0.05, 0.1}) : random.spread(0.005, 0.2), "s");
    if (random.chance(0.2)) block["offset"] = with_unit(random.between(0, 0.3), "s");
    return block;
  }
  Wire hold(const Wire& u) { return add(sampled({{"type", "sample_hold"}}), {u}, u.size, false); }
  Wire quantizer(const Wire& u) {
    Json block = {{"type", "quantizer"}, {"bits", 3 + random.below(8)}};
    block["lower"] = -random.between(0.7, 1.5) * u.size;
    block["upper"] = random.between(0.7, 1.5) * u.size;
    return add(sampled(block), {u}, u.size, false);
  }
  Wire delay_line(const Wire& u) {
    Json block = {{"type", "delay_line"}, {"samples", random.below(4)}};
    if (random.chance(0.3)) block["before"] = around(u.size);
    return add(sampled(block), {u}, u.size, false);
  }
  Wire filter(const Wire& u) {
    const double pole = random.between(-0.5, 0.9);
    Json block = {{"type", "discrete_transfer_function"}, {"gain", 1 - pole}};
    block["num"] = random.chance(0.5) ? Json{1} : Json{0.6, 0.4};
    block["den"] = {1, -pole};
    if (random.chance(0.4)) block["direct"] = "no";
    if (random.chance(0.2)) block["before"] = around(u.size);
    return add(sampled(block), {u}, u.size, false);
  }
  Json pid_numbers(double size) {
    Json block = {{"type", "sampled_pid"}, {"kp", random.between(0.2, 1.5)}};
    block["ki"] = with_unit(random.between(0, 5), "1/s");
    const double limit = random.between(0.5, 2) * size;
    block["lower"] = random.chance(0.3) ? Json("-inf") : Json(-limit);
    block["upper"] = random.chance(0.3) ? Json("inf") : Json(limit);
    block["rule"] = random.one_of<std::string>({"forward", "backward", "trapezoidal"});
    block["anti_windup"] = random.one_of<std::string>({"none", "clamping", "back_calculation"});
    return block;
  }
  Wire pid(const Wire& u) { return add(sampled(pid_numbers(u.size)), {u}, 2 * u.size, false); }
  Wire limiter(const Wire& u) {
    const double rate = random.spread(0.5, 10) * u.size;
    if (random.chance(0.4)) {
      Json block = {{"type", "slew_limit"}, {"rate", with_unit(rate, "1/s")}};
      block["time"] = with_unit(random.spread(2, 20), "ms");
      return add(block, {u}, u.size, true);
    }
    Json block = {{"type", "rate_limiter"}, {"rise", with_unit(rate, "1/s")}};
    block["fall"] = with_unit(random.spread(0.5, 10) * u.size, "1/s");
    block["time"] = with_unit(random.spread(2, 20), "ms");
    return add(block, {u}, u.size, true);
  }
  Wire smooth_curve(const Wire& u) {
    if (random.chance(0.5))
      return add({{"type", "soft_saturation"}, {"limit", random.between(0.3, 1.5) * u.size}}, {u}, u.size, u.smooth);
    Json block = {{"type", "polynomial"}, {"coefficients", {around(u.size), u.size, around(0.5 * u.size)}}};
    block["reference"] = u.size;
    block["lower"] = -random.between(0.5, 1.2) * u.size;
    block["upper"] = random.between(0.5, 1.2) * u.size;
    return add(block, {u}, 2 * u.size, u.smooth);
  }

  /// A force drives it; of its motion a number remains.
  Wire body(const Wire& u) {
    const double newtons = random.spread(0.5, 5), kilogram = random.spread(0.2, 3), force = newtons * u.size;
    const Wire push = put({{"type", "gain"}, {"gain", with_unit(newtons, "N")}}, {u}, force, u.smooth);
    const int kind = random.below(6);
    const bool spring = kind == 0 || kind == 3 || random.chance(0.7);
    const double w = random.spread(3, 40), stiffness = spring ? kilogram * w * w : 0;
    const double travel = spring ? force / stiffness : force / kilogram / 30;
    Json block = {{"type", "mass_spring_damper"}, {"mass", with_unit(kilogram, "kg")}};
    block["damping"] = with_unit(random.between(0.05, 0.6) * kilogram * w, "N*s/m");
    if (spring || kind == 3 || kind == 4) block["stiffness"] = with_unit(stiffness, "N/m");
    if (kind == 1 || kind == 2) {
      const double coulomb = random.between(0.05, 0.7) * force;
      block["type"] = "mass_with_friction";
      block["coulomb"] = with_unit(coulomb, "N");
      block["breakaway"] = with_unit(coulomb * random.between(1, 1.5), "N");
      if (random.chance(0.5)) block["stribeck_velocity"] = with_unit(random.between(0.1, 1) * travel * w, "m/s");
    } else if (kind == 5) {
      block["type"] = "mass_with_stops";
      block["lower"] = with_unit(-random.between(0.2, 1) * travel, "m");
      block["upper"] = with_unit(random.between(0.2, 1) * travel, "m");
      if (random.chance(0.6)) block["restitution"] = random.between(0.1, 0.8);
    } else if (kind == 4) {
      block["type"] = random.chance(0.5) ? "mass_with_presliding" : "mass_on_hysteretic_spring";
      const double slip = random.between(0.1, 0.5) * travel;
      block["contact_stiffness"] = {with_unit(random.between(0.1, 0.6) * force / slip, "N/m")};
      block["slip_distance"] = {with_unit(slip, "m")};
    } else if (kind == 3 && random.chance(0.6)) {
      block["type"] = "mass_on_stiffening_spring";
      block["stiffening"] = with_unit(random.between(0, 1) * stiffness / (travel * travel), "N/m^3");
    }
    const Wire mass = put(block, {push}, travel, true, "position");
    return add({{"type", "gain"}, {"gain", with_unit(u.size / travel, "1/m")}}, {mass}, 2 * u.size, true);
  }

  // --- loops
  // ----------------------------------------------------------------------------------------------------------
  /// reference - k measured -> one or two blocks -> what makes it a loop with memory of the past -> measured.
  void loop() {
    const Wire reference = any();
    const std::string error = fresh();
    blocks[error] = Json::object();  // its place in the file; the wires are known later
    Wire forward{error, 1.5 * reference.size, reference.smooth};
    const int kind = random.below(6);
    if (kind == 5) forward.smooth = false;
    for (int i = 1 + random.below(2); i > 0; --i) forward = grow_monotone(forward);
    if (kind <= 1) forward = lag(forward);
    if (kind == 2) forward = integrator(forward);
    if (kind == 3) forward = resonance(gain_of(forward, 0.3));
    if (kind == 4) forward = lag(dead_time(gain_of(forward, 0.6)));
    const Wire back = gain_of(forward, kind == 5 ? random.between(0.1, 0.6) : random.between(0.3, 1.5));
    blocks[error] = {{"type", "sum"}, {"signs", "+-"}, {"in", {reference.name, back.name}}};
    wires.push_back({error, 1.5 * reference.size, forward.smooth && reference.smooth});
  }
  Wire gain_of(const Wire& u, double g) {
    return add({{"type", "gain"}, {"gain", g}}, {u}, std::abs(g) * u.size, u.smooth);
  }
  Wire grow_monotone(const Wire& u) {
    static const std::vector<Maker> makers = {&Generator::saturation, &Generator::play,
                                              &Generator::plays,      &Generator::lag,
                                              &Generator::relay,      &Generator::pid,
                                              &Generator::hold,       &Generator::limiter,
                                              &Generator::backlash,   &Generator::smooth_saturation};
    const auto make = random.one_of(makers);
    return (this->*make)(u);
  }
  Wire smooth_saturation(const Wire& u) {
    return add({{"type", "soft_saturation"}, {"limit", random.between(0.3, 1.5) * u.size}}, {u}, u.size, u.smooth);
  }

  // --- ways to write it
  // -------------------------------------------------------------------------------------------------
  void choose_something() {
    if (!random.chance(0.25)) return;
    const std::string name = block_of_one_wire();
    if (name.empty()) return;
    const Json block = blocks[name];
    Json used = block;
    used.erase("in");
    blocks[name] = {{"choose", "used"}, {"in", block["in"]}, {"from", {{"other", used}, {"used", used}}}};
  }

  std::string block_of_one_wire() {
    std::vector<std::string> names;
    for (const auto& [name, block] : blocks.items())
      if (block.contains("type") && block.contains("in") && block["in"].is_string() && block["type"] != "diagram")
        names.push_back(name);
    return names.empty() ? "" : random.one_of(names);
  }

  void name_a_parameter() {
    parameters = Json::object();
    for (auto& [name, block] : blocks.items())
      for (auto& [key, value] : block.items()) {
        if (!value.is_number_float() || !random.chance(0.15)) continue;
        const std::string parameter = name + "_" + key;
        parameters[parameter] = {{"value", value}};
        value = "$" + parameter;
      }
  }

  /// One block, or it and the block that reads it alone, move into a diagram of their own.
  void nest_something() {
    if (!random.chance(0.25)) return;
    const std::string name = block_of_one_wire();
    if (name.empty() || blocks[name]["type"].get<std::string>().starts_with("mass")) return;
    Json inner = blocks[name];
    for (const auto& [key, value] : inner.items())
      if (value.is_string() && value.get<std::string>().starts_with("$")) return;
    const auto has_unit = [](const Json& value) {
      return value.is_string() && value.get<std::string>().find("1/s") != std::string::npos;
    };
    if (inner["type"] == "gain" && inner["gain"].is_string()) return;
    if (inner["type"] == "integrator" || std::any_of(inner.begin(), inner.end(), has_unit)) return;
    const Json in = inner["in"];
    if (blocks.contains(in.get<std::string>()) == false) return;
    inner["in"] = "u";
    const Json nested = {
        {"format", 1}, {"inputs", {{"u", Json::object()}}}, {"blocks", {{"law", inner}}}, {"outputs", {{"y", "law"}}}};
    files["inner.json"] = nested.dump(1);
    blocks[name] = {{"type", "diagram"}, {"file", "inner.json"}, {"in", in}};
  }

  RandomDiagram written() {
    Json diagram = {{"format", 1}};
    if (!parameters.empty()) diagram["parameters"] = parameters;
    diagram["blocks"] = blocks;
    diagram["record"] = Json::array();
    for (const auto& wire : wires) diagram["record"].push_back(wire.name);
    diagram["simulate"] = {{"until", with_unit(random.one_of<double>({1, 2, 3, 4}), "s")}, {"every", "10 ms"}};
    return {diagram.dump(1), files};
  }

  Random random;
  Json blocks, parameters = Json::object();
  std::vector<Wire> wires{};
  std::map<std::string, std::string> files{};
  int named = 0;
};

/// Names and wires of a diagram, written anew by a map of its names.
std::string renamed(const std::string& signal, const std::map<std::string, std::string>& names) {
  const auto dot = signal.find('.');
  const auto at = names.find(signal.substr(0, dot));
  if (at == names.end()) return signal;
  return dot == std::string::npos ? at->second : at->second + signal.substr(dot);
}

void in_other_order(Json& diagram, std::uint64_t seed) {
  Random random(seed + 77);
  std::vector<std::string> order;
  for (const auto& [name, block] : diagram["blocks"].items()) order.push_back(name);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  std::map<std::string, std::string> names;
  for (std::size_t i = 0; i < order.size(); ++i)
    names[order[i]] = std::string(1, static_cast<char>('a' + i % 26)) + (i < 26 ? "_" : "__");
  Json blocks = Json::object();
  for (const auto& name : order) {
    Json block = diagram["blocks"][name];
    if (block.contains("in") && block["in"].is_string()) block["in"] = renamed(block["in"], names);
    if (block.contains("in") && block["in"].is_array())
      for (auto& wire : block["in"]) wire = renamed(wire, names);
    blocks[names[name]] = block;
  }
  diagram["blocks"] = blocks;
  for (auto& signal : diagram["record"]) signal = renamed(signal, names);
}

}  // namespace

RandomDiagram random_diagram(std::uint64_t seed, const Variant& variant) {
  RandomDiagram made = Generator(seed).make();
  Json diagram = Json::parse(made.text);
  if (variant.other_order) in_other_order(diagram, seed);
  if (variant.until > 0) diagram["simulate"]["until"] = with_unit(variant.until, "s");
  if (variant.every > 0) diagram["simulate"]["every"] = with_unit(variant.every, "s");
  Json solver = Json::object();
  if (!variant.method.empty()) solver["method"] = variant.method;
  if (variant.tolerance > 0) solver["relative_tolerance"] = variant.tolerance;
  if (!solver.empty()) diagram["simulate"]["solver"] = solver;
  made.text = diagram.dump(1);
  return made;
}

}  // namespace reference
