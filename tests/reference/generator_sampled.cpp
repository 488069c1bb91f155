// The generator: what runs at instants.
#include <algorithm>
#include <cmath>

#include "tests/reference/generator.h"

namespace reference {

Wire Generator::sampled_filter(const Wire& u) {
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

Json Generator::sampled(Json block) {
  block["period"] =
      with_unit(random.chance(0.5) ? random.one_of<double>({0.01, 0.02, 0.05, 0.1}) : random.spread(0.005, 0.2), "s");
  if (random.chance(0.2)) block["offset"] = with_unit(random.between(0, 0.3), "s");
  return block;
}

Wire Generator::hold(const Wire& u) { return add(sampled({{"type", "sample_hold"}}), {u}, u.size, false); }

Wire Generator::quantizer(const Wire& u) {
  Json block = {{"type", "quantizer"}, {"bits", 3 + random.below(8)}};
  block["lower"] = -random.between(0.7, 1.5) * u.size;
  block["upper"] = random.between(0.7, 1.5) * u.size;
  return add(sampled(block), {u}, u.size, false);
}

Wire Generator::delay_line(const Wire& u) {
  Json block = {{"type", "delay_line"}, {"samples", random.below(4)}};
  if (random.chance(0.3)) block["before"] = around(u.size);
  return add(sampled(block), {u}, u.size, false);
}

Wire Generator::filter(const Wire& u) {
  const double pole = random.between(-0.5, 0.9);
  Json block = {{"type", "discrete_transfer_function"}, {"gain", 1 - pole}};
  block["num"] = random.chance(0.5) ? Json{1} : Json{0.6, 0.4};
  block["den"] = {1, -pole};
  if (random.chance(0.4)) block["direct"] = "no";
  if (random.chance(0.2)) block["before"] = around(u.size);
  return add(sampled(block), {u}, u.size, false);
}

Json Generator::pid_numbers(double size) {
  Json block = {{"type", "sampled_pid"}, {"kp", random.between(0.2, 1.5)}};
  block["ki"] = with_unit(random.between(0, 5), "1/s");
  const double limit = random.between(0.5, 2) * size;
  block["lower"] = random.chance(0.3) ? Json("-inf") : Json(-limit);
  block["upper"] = random.chance(0.3) ? Json("inf") : Json(limit);
  block["rule"] = random.one_of<std::string>({"forward", "backward", "trapezoidal"});
  block["anti_windup"] = random.one_of<std::string>({"none", "clamping", "back_calculation"});
  return block;
}

Wire Generator::pid(const Wire& u) { return add(sampled(pid_numbers(u.size)), {u}, 2 * u.size, false); }

}  // namespace reference
