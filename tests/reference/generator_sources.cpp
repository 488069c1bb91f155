// The generator: sources.
#include <algorithm>
#include <cmath>

#include "tests/reference/generator.h"

namespace reference {

void Generator::wave(Json& block) {
  block["frequency"] = with_unit(random.spread(0.3, 6), "Hz");
  block["phase"] = random.chance(0.3) ? with_unit(-90, "deg") : with_unit(random.between(-180, 180), "deg");
}

Wire Generator::source() {
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

Wire Generator::piecewise(double a, double o) {
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

Wire Generator::points(double a) {
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

Wire Generator::recording(double a) {
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

}  // namespace reference
