#include "draw/pictogram.h"

#include <cmath>
#include <map>
#include <numbers>

namespace hysteron::draw {
namespace {

template <class Law>
Curve sampled(double from, double to, int pieces, const Law& law) {
  Curve curve;
  for (int i = 0; i <= pieces; ++i) {
    const double x = from + (to - from) * i / pieces;
    curve.emplace_back(x, law(x));
  }
  return curve;
}

/// A hysteresis loop, rising branch to the right of the falling one.
std::vector<Curve> loop() {
  const auto rising = [](double x) { return 0.95 * std::tanh(2.4 * (x - 0.28)) / std::tanh(2.4 * 0.72); };
  const auto falling = [&](double x) { return -rising(-x); };
  const auto bent = [](double y) { return std::fmax(-0.95, std::fmin(0.95, y)); };
  return {sampled(-1, 1, 24, [&](double x) { return bent(rising(x)); }),
          sampled(-1, 1, 24, [&](double x) { return bent(falling(x)); })};
}

Curve wave(double periods) {
  return sampled(-1, 1, static_cast<int>(24 * periods),
                 [=](double x) { return 0.8 * std::sin(std::numbers::pi * periods * (x + 1)); });
}

/// A jagged line that is the same everywhere.
Curve noise() {
  const double levels[] = {0.1, -0.5, 0.7, -0.2, 0.4, -0.8, 0.2, 0.9, -0.4, 0.5, -0.7, 0.3, -0.1, 0.6, -0.6, 0.0};
  Curve curve;
  for (int i = 0; i < 16; ++i) curve.emplace_back(-1 + 2.0 * i / 15, levels[i]);
  return curve;
}

/// Around (x, y), as round as a pictogram whose sides are not alike lets it be.
Curve circle(double x, double y, double radius) {
  Curve curve;
  for (int i = 0; i <= 24; ++i) {
    const double a = 2 * std::numbers::pi * i / 24;
    curve.emplace_back(x + 0.7 * radius * std::cos(a), y + radius * std::sin(a));
  }
  return curve;
}

/// A staircase from (-1, ...) with these levels.
Curve stairs(const std::vector<double>& levels) {
  Curve curve;
  const auto n = static_cast<double>(levels.size());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    curve.emplace_back(-1 + 2 * static_cast<double>(i) / n, levels[i]);
    curve.emplace_back(-1 + 2 * static_cast<double>(i + 1) / n, levels[i]);
  }
  return curve;
}

std::map<std::string, Pictogram> make_all() {
  std::map<std::string, Pictogram> all;
  const auto over_time = [](std::vector<Curve> curves) { return Pictogram{false, true, std::move(curves), {}}; };
  const auto characteristic = [](std::vector<Curve> curves) { return Pictogram{true, false, std::move(curves), {}}; };

  all["sine"] = over_time({wave(1)});
  all["constant"] = over_time({{{-1, 0.5}, {1, 0.5}}});
  all["triangle"] = over_time({{{-1, 0}, {-0.75, 0.8}, {-0.25, -0.8}, {0.25, 0.8}, {0.75, -0.8}, {1, 0}}});
  all["step"] = over_time({{{-1, -0.6}, {-0.3, -0.6}, {-0.3, 0.7}, {1, 0.7}}});
  all["staircase"] = over_time({stairs({-0.8, -0.3, 0.2, 0.7, 0.1, -0.5})});
  all["square"] = over_time({stairs({0.7, -0.7, 0.7, -0.7})});
  all["ramp"] = over_time({{{-1, -0.7}, {-0.5, -0.7}, {1, 0.8}}});
  all["trapezoid"] = over_time({{{-1, -0.6}, {-0.7, -0.6}, {-0.3, 0.7}, {0.3, 0.7}, {0.7, -0.6}, {1, -0.6}}});
  all["s_curve"] = over_time({sampled(-1, 1, 32, [](double x) {
    const double s = std::fmax(0, std::fmin(1, 0.5 * (x / 0.7 + 1)));
    return -0.7 + 1.4 * s * s * (3 - 2 * s);
  })});
  all["chirp"] = over_time({sampled(-1, 1, 96, [](double x) { return 0.8 * std::sin(2.2 * (x + 1) * (x + 1.6)); })});
  all["multisine"] = over_time({sampled(-1, 1, 60, [](double x) {
    return 0.4 * (std::sin(3.1 * (x + 1)) + 0.7 * std::sin(7.7 * (x + 1) + 1) + 0.5 * std::sin(15 * (x + 1)));
  })});
  all["recorded"] = over_time({sampled(-1, 1, 40, [](double x) {
    return 0.55 * std::sin(2.6 * x + 0.4) + 0.2 * std::sin(9 * x) + 0.1 * std::sin(23 * x);
  })});
  all["noise"] = over_time({noise()});
  all["step_response"] =
      over_time({{{-1, -0.8}, {-0.7, -0.8}, {-0.7, 0.1}},
                 sampled(-0.7, 1, 24, [](double x) { return 0.8 - 0.7 * std::exp(-2 * (x + 0.7)); })});
  all["sampled"] = over_time({stairs({-0.7, -0.2, 0.4, 0.75, 0.6, 0.1})});

  all["saturation"] = characteristic({{{-1, -0.75}, {-0.45, -0.75}, {0.45, 0.75}, {1, 0.75}}});
  all["dead_zone"] = characteristic({{{-1, -0.8}, {-0.35, 0}, {0.35, 0}, {1, 0.8}}});
  all["play"] = {true,
                 false,
                 {{{-0.9, -0.8}, {0.2, -0.8}, {0.9, 0.8}, {-0.2, 0.8}, {-0.9, -0.8}}},
                 {{{{0.44, -0.26}, {0.62, 0.16}}, 1}, {{{-0.44, 0.26}, {-0.62, -0.16}}, 1}}};
  all["relay"] = {true,
                  false,
                  {{{-1, -0.75}, {0.4, -0.75}, {0.4, 0.75}, {1, 0.75}}, {{-0.4, -0.75}, {-0.4, 0.75}, {0.4, 0.75}}},
                  {{{{0.4, -0.2}, {0.4, 0.25}}, 1}, {{{-0.4, 0.2}, {-0.4, -0.25}}, 1}}};
  all["hysteresis"] = {true, false, loop(), {}};
  all["hysteresis_inverse"] = {true, false, {}, {}};
  for (Curve curve : loop()) {
    for (auto& [x, y] : curve) std::swap(x, y);
    all["hysteresis_inverse"].curves.push_back(std::move(curve));
  }
  all["quantizer"] = characteristic({{{-1, -0.8},
                                      {-0.7, -0.8},
                                      {-0.7, -0.4},
                                      {-0.25, -0.4},
                                      {-0.25, 0},
                                      {0.25, 0},
                                      {0.25, 0.4},
                                      {0.7, 0.4},
                                      {0.7, 0.8},
                                      {1, 0.8}}});
  all["friction"] = characteristic({{{-1, -0.75}, {-0.5, -0.5}, {0, -0.8}, {0, 0.8}, {0.5, 0.5}, {1, 0.75}}});
  all["hard_stop"] = characteristic({{{-0.7, -1}, {-0.6, 0}, {0.6, 0}, {0.7, 1}}});
  all["rate_limiter"] = over_time({{{-1, -0.7}, {-0.6, -0.7}, {-0.6, 0.7}, {1, 0.7}}, {{-0.6, -0.7}, {0.5, 0.7}}});
  // A mass on a spring before a wall; a vessel with its level.
  all["mass"] = {false,
                 false,
                 {{{-1, -0.8}, {-1, 0.8}},
                  {{-1, 0}, {-0.8, 0}, {-0.7, 0.4}, {-0.5, -0.4}, {-0.3, 0.4}, {-0.1, -0.4}, {0, 0}, {0.2, 0}},
                  {{0.2, -0.6}, {0.2, 0.6}, {1, 0.6}, {1, -0.6}, {0.2, -0.6}}},
                 {}};
  all["tank"] = {false, false, {{{-0.6, 0.9}, {-0.6, -0.8}, {0.6, -0.8}, {0.6, 0.9}}, {{-0.6, 0.2}, {0.6, 0.2}}}, {}};
  // Amplitudes over the frequency.
  const auto amplitude = [](double x) { return 0.7 - 0.7 * std::log1p(std::exp(4 * x)); };
  all["low_pass"] = over_time({sampled(-1, 0.65, 24, amplitude)});
  all["high_pass"] = over_time({sampled(-0.65, 1, 24, [=](double x) { return amplitude(-x); })});
  all["band_pass"] = over_time({sampled(-1, 1, 40, [](double x) { return 0.8 - 1.5 * std::tanh(2 * std::fabs(x)); })});
  all["notch"] = over_time({sampled(-1, 1, 40, [](double x) { return 0.7 - 1.3 * std::exp(-18 * x * x); })});
  // Pulses that grow wider; the windings of a coil; an arm that swings; the plates of two cells.
  all["pulses"] = over_time({{{-1, -0.6},
                              {-0.9, -0.6},
                              {-0.9, 0.6},
                              {-0.75, 0.6},
                              {-0.75, -0.6},
                              {-0.3, -0.6},
                              {-0.3, 0.6},
                              {0.05, 0.6},
                              {0.05, -0.6},
                              {0.3, -0.6},
                              {0.3, 0.6},
                              {0.85, 0.6},
                              {0.85, -0.6},
                              {1, -0.6}}});
  all["winding"] = {
      false,
      false,
      {{{-1, 0}, {-0.75, 0}},
       sampled(-0.75, 0.75, 48, [](double x) { return 0.7 * std::fabs(std::sin(2 * std::numbers::pi * (x + 0.75))); }),
       {{0.75, 0}, {1, 0}}},
      {}};
  all["pendulum"] = {false,
                     false,
                     {{{-0.4, 0.9}, {0.4, 0.9}},
                      {{0, 0.9}, {0.5, -0.5}},
                      {{0.35, -0.5}, {0.5, -0.3}, {0.65, -0.5}, {0.5, -0.7}, {0.35, -0.5}}},
                     {}};
  all["battery"] = {false,
                    false,
                    {{{-1, 0}, {-0.4, 0}},
                     {{-0.4, 0.8}, {-0.4, -0.8}},
                     {{-0.15, 0.4}, {-0.15, -0.4}},
                     {{0.15, 0.8}, {0.15, -0.8}},
                     {{0.4, 0.4}, {0.4, -0.4}},
                     {{0.4, 0}, {1, 0}}},
                    {}};
  // A disc on a shaft; two wheels; a belt around them; a thread; a rotor between its brushes.
  all["inertia"] = {
      false,
      false,
      {{{-1, 0}, {-0.3, 0}}, {{-0.3, -0.8}, {-0.3, 0.8}, {0.3, 0.8}, {0.3, -0.8}, {-0.3, -0.8}}, {{0.3, 0}, {1, 0}}},
      {}};
  all["gear"] = {false, false, {circle(-0.45, 0, 0.45), circle(0.4, 0, 0.8)}, {}};
  all["belt"] = {false,
                 false,
                 {circle(-0.6, 0, 0.4), circle(0.6, 0, 0.4), {{-0.6, 0.4}, {0.6, 0.4}}, {{-0.6, -0.4}, {0.6, -0.4}}},
                 {}};
  all["screw"] = {
      false,
      false,
      {{{-1, -0.4}, {-0.7, 0.4}, {-0.5, -0.4}, {-0.2, 0.4}, {0, -0.4}, {0.3, 0.4}, {0.5, -0.4}, {0.8, 0.4}, {1, -0.4}},
       {{-0.2, 0.7}, {0.3, 0.7}, {0.3, -0.7}, {-0.2, -0.7}, {-0.2, 0.7}}},
      {}};
  all["motor"] = {
      false, false, {circle(0, 0, 0.75), {{-0.25, -0.3}, {-0.25, 0.35}, {0, 0}, {0.25, 0.35}, {0.25, -0.3}}}, {}};
  // The blades of a propeller; the legs of a bridge and the load between them; four resistors; a contact.
  all["propeller"] = {false,
                      false,
                      {circle(0, 0, 0.15),
                       {{0.1, 0}, {0.4, 0.25}, {0.9, 0.2}, {0.9, 0}, {0.1, 0}},
                       {{-0.1, 0}, {-0.4, -0.25}, {-0.9, -0.2}, {-0.9, 0}, {-0.1, 0}}},
                      {}};
  all["bridge"] = {false,
                   false,
                   {{{-0.6, 0.8}, {0.6, 0.8}},
                    {{-0.6, -0.8}, {0.6, -0.8}},
                    {{-0.6, 0.8}, {-0.6, 0.6}, {-0.4, 0.25}},
                    {{-0.6, 0.2}, {-0.6, -0.2}, {-0.4, -0.55}},
                    {{-0.6, -0.6}, {-0.6, -0.8}},
                    {{0.6, 0.8}, {0.6, 0.6}, {0.8, 0.25}},
                    {{0.6, 0.2}, {0.6, -0.2}, {0.8, -0.55}},
                    {{0.6, -0.6}, {0.6, -0.8}},
                    {{-0.6, 0}, {0.6, 0}}},
                   {}};
  all["diamond"] = {false, false, {{{-0.6, 0}, {0, 0.9}, {0.6, 0}, {0, -0.9}, {-0.6, 0}}, {{-0.6, 0}, {0.6, 0}}}, {}};
  all["switch"] = {
      false, false, {{{-1, 0.6}, {-0.4, 0.6}}, {{-1, -0.6}, {-0.4, -0.6}}, {{-0.4, 0.6}, {0.5, 0}, {1, 0}}}, {}};
  all["comparator"] = characteristic({{{-1, -0.75}, {0, -0.75}, {0, 0.75}, {1, 0.75}}});
  all["rectifier"] = characteristic({{{-1, 0}, {0, 0}, {0.9, 0.9}}});
  all["sawtooth"] =
      characteristic({{{-1, -0.7}, {-0.35, 0.7}}, {{-0.35, -0.7}, {0.35, 0.7}}, {{0.35, -0.7}, {1, 0.7}}});
  all["calibration"] = characteristic({{{-1, -0.45}, {1, 0.95}}});
  all["straight"] = characteristic({{{-1, -0.8}, {1, 0.8}}});
  all["table"] = characteristic({{{-1, -0.9}, {-0.5, -0.2}, {0.2, 0.1}, {0.6, 0.7}, {1, 0.85}}});
  return all;
}

}  // namespace

const std::map<std::string, Pictogram>& all_pictograms() {
  static const std::map<std::string, Pictogram> all = make_all();
  return all;
}

const Pictogram* find_pictogram(const std::string& name) {
  const auto& all = all_pictograms();
  const auto found = all.find(name);
  return found == all.end() ? nullptr : &found->second;
}

}  // namespace hysteron::draw
