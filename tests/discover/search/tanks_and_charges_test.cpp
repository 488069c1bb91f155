// Quantization, pyroelectric charge, outflow by the root and overflow, each hidden by a formula of its own; and cases
// in which each must not be claimed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "discover/placement/places.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;
using std::numbers::pi;

class TanksAndCharges : public Discoveries {};

struct Made {
  Role role;
  std::vector<double> t, u;
};

std::vector<Made> drives(double step, int n = 900) {
  const auto t = rows(n, step);
  const double T = t.back();
  return {{Role::train, t, levels(t, {0.4, 1, 0.2, 0.7})},
          {Role::train, t, several_sines(t, 1, {5.3 / T, 14.2 / T})},
          {Role::validate, t, several_sines(t, 0.95, {7.1 / T, 3.3 / T})}};
}

template <class Law>
DataSet made(const std::vector<Made>& drives, double white, Law law) {
  std::vector<Recording> list;
  std::uint64_t seed = 700;
  for (const auto& m : drives) {
    auto y = law(m.t, m.u, seed);
    list.push_back(recording(std::to_string(seed++) + ".csv", m.role, m.t, m.u, y));
  }
  return data_set(list, white, 0.1);
}

std::vector<double> with_noise(std::vector<double> y, double white, std::uint64_t seed) {
  const auto n = noise(y.size(), white, 0.1 * white, seed);
  for (std::size_t k = 0; k < y.size(); ++k) y[k] += n[k];
  return y;
}

// --- quantization -------------------------------------------------------------------------------------------------

/// Noise of `white`, then cut to multiples of `step` by counting them.
DataSet counted(double step, double white) {
  return made(drives(0.02), white, [&](const auto&, const auto& u, std::uint64_t seed) {
    auto y = with_noise(u, white, seed);
    for (auto& v : y) {
      const double whole = std::trunc(std::abs(v) / step), rest = std::abs(v) / step - whole;
      v = std::copysign((whole + (rest >= 0.5 ? 1 : 0)) * step, v);
    }
    return y;
  });
}

TEST_F(TanksAndCharges, CoarseLevelsAreNamedWithTheirStep) {
  const Discovery d = diagnosed(plain_gain(), counted(0.04, 2e-3));
  ASSERT_EQ(winner(d), "quantization") << tried(d);
  EXPECT_NEAR(value(d, "step"), 0.04, 1e-4);  // the noise of 2 mm is 8e-5 for each of the 24 steps below the top one
  // A row whose signal lies within the noise of an edge falls on the other side: sqrt(2 * 0.8 * 2e-3/0.04) of a step at
  // most.
  EXPECT_LT(d.final_error.rms_validate, 0.8 * d.base.rms_validate);
  EXPECT_NEAR(d.base.rms_validate, 0.04 / std::sqrt(12.0), 0.15 * 0.04 / std::sqrt(12.0));
}

TEST_F(TanksAndCharges, LevelsFinerThanTheNoiseAreNoEffect) {
  const Discovery fine = diagnosed(plain_gain(), counted(1e-3, 4e-3));
  EXPECT_EQ(fine.verdict, Verdict::adequate) << tried(fine);
  const Effect& e = effects.get("quantization");
  Excitation at;
  at.from_data = true;
  EXPECT_NE(e.unseen(at), "") << "no levels";
  at.resolution = 1e-7;
  EXPECT_NE(e.unseen(at), "") << "digits of the file";
  at.resolution = 1e-3;
  EXPECT_EQ(e.unseen(at), "");
}

// --- pyroelectric charge ------------------------------------------------------------------------------------------

/// A temperature of plateaus and ramps [K].
std::vector<double> warm(const std::vector<double>& t, double phase) {
  return sampled(t, [&, T = t.back()](double x) {
    const double s = std::fmod(3 * x / T + phase, 1.0);
    return 295 + 4 * std::clamp(s < 0.6 ? 8 * (s - 0.1) : 8 * (0.85 - s), 0.0, 1.0);
  });
}

/// y = u + what `law` makes of the temperature, with the column T.
template <class Law>
DataSet in_the_heat(double white, Law law) {
  std::vector<Recording> list;
  std::uint64_t seed = 740;
  for (const auto& m : drives(0.04)) {
    const auto T = warm(m.t, 0.13 * static_cast<double>(seed - 740));
    auto y = with_noise(m.u, white, seed);
    const auto w = law(m.t, T);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += w[k];
    list.push_back(recording(std::to_string(seed++) + ".csv", m.role, m.t, m.u, y));
    list.back().columns["T"] = T;
    list.back().units["T"] = parse_unit("degC");
  }
  DataSet data = data_set(list, white, 0.1);
  data.notes["T"].to = "T";
  return data;
}

TEST_F(TanksAndCharges, AChargeThatHeatMakesAndThatLeaksAwayIsNamed) {
  // As in the literature: w' = k T' - w/tau, by small Euler steps over straight pieces.
  const auto data = in_the_heat(2e-3, [](const auto& t, const auto& T) {
    std::vector<double> w{0};
    for (std::size_t k = 1; k < t.size(); ++k) {
      double v = w.back();
      const double h = (t[k] - t[k - 1]) / 100, slope = (T[k] - T[k - 1]) / (t[k] - t[k - 1]);
      for (int i = 0; i < 100; ++i) v += h * (0.02 * slope - v / 1.5);
      w.push_back(v);
    }
    return w;
  });
  const Discovery d = diagnosed(plain_gain(), data);
  ASSERT_EQ(winner(d), "pyro_charge_drift") << tried(d);
  EXPECT_EQ(d.verdict, Verdict::missing_effect) << tried(d);
  EXPECT_NEAR(value(d, "coefficient"), 0.02, 0.002);  // V/K; as for an expansion: noise and 1/f leave less than a tenth
  EXPECT_NEAR(value(d, "time"), 1.5, 0.15);
  EXPECT_NEAR(d.final_error.rms_validate, 2e-3, 2e-4);
}

TEST_F(TanksAndCharges, AnExpansionIsNoCharge) {
  const auto data = in_the_heat(2e-3, [](const auto& t, const auto& T) {
    std::vector<double> y;
    double w = T.front();
    for (std::size_t k = 0; k < t.size(); ++k) {
      for (int i = 0; k > 0 && i < 50; ++i) w += (t[k] - t[k - 1]) / 50 * (T[k] - w) / 2;
      y.push_back(0.02 * (w - 297));
    }
    return y;
  });
  const Discovery d = diagnosed(plain_gain(), data);
  EXPECT_EQ(winner(d), "thermal_expansion") << tried(d);
}

// --- tanks --------------------------------------------------------------------------------------------------------

/// A tank as the user has it: 1 m^2, an outlet of 0.5 m^3/s at 1 m, linear.
Diagram linear_tank() {
  Diagram d;
  d.inputs["u"].unit = "m^3/s";
  Node& tank = d.blocks["tank"];
  tank.type = "tank";
  tank.parameters["area"] = Value("1 m^2");
  tank.parameters["outlet"] = Value("0.5 m^3/s");
  tank.parameters["reference"] = Value("1 m");
  tank.parameters["law"] = Value("linear");
  tank.in = {{"", "u"}};
  d.outputs["y"] = "tank.level";
  return d;
}

/// What can be taken for each other in a tank; with the whole library a tank, which is nonlinear at its bottom, takes
/// minutes.
const std::vector<std::string> of_tanks{"calibration",         "sensor_lag",   "saturation",
                                        "sensor_nonlinearity", "sqrt_outflow", "overflow"};

/// The level under the outflow `leaves`, by small Euler steps, cut at `brim`.
template <class Outflow>
DataSet tank_level(double brim, Outflow leaves) {
  auto list = drives(0.75, 120);
  DataSet data = made(list, 2e-3, [&](const auto& t, const auto& u, std::uint64_t seed) {
    std::vector<double> y{0};
    double h = 0;
    for (std::size_t k = 1; k < t.size(); ++k) {
      const int n = 750;
      const double dt = (t[k] - t[k - 1]) / n;
      for (int i = 0; i < n; ++i) {
        const double q = u[k - 1] + (u[k] - u[k - 1]) * (i + 0.5) / n;
        h = std::clamp(h + dt * (q - leaves(h)), 0.0, brim);
      }
      y.push_back(h);
    }
    return with_noise(y, 2e-3, seed);
  });
  for (auto& r : data.recordings) r.units["u"] = parse_unit("m^3/s");
  return data;
}

/// The level of a second tank under two orifices in a row, by small Euler steps, 1 m^2 each.
DataSet two_tanks(double upper, double lower) {
  auto list = drives(0.75, 160);
  DataSet data = made(list, 2e-3, [&](const auto& t, const auto& u, std::uint64_t seed) {
    std::vector<double> y{0};
    double a = 0, b = 0;
    for (std::size_t k = 1; k < t.size(); ++k) {
      const int n = 750;
      const double dt = (t[k] - t[k - 1]) / n;
      for (int i = 0; i < n; ++i) {
        const double q = u[k - 1] + (u[k] - u[k - 1]) * (i + 0.5) / n, between = upper * std::sqrt(std::max(a, 0.0));
        a = std::max(0.0, a + dt * (q - between));
        b = std::max(0.0, b + dt * (between - lower * std::sqrt(std::max(b, 0.0))));
      }
      y.push_back(b);
    }
    return with_noise(y, 2e-3, seed);
  });
  for (auto& r : data.recordings) r.units["u"] = parse_unit("m^3/s");
  return data;
}

TEST_F(TanksAndCharges, AnOutletByTheRootIsNamed) {
  const Discovery d =
      diagnosed(linear_tank(), tank_level(1e9, [](double h) { return 0.5 * std::pow(h, 0.5); }), of_tanks);
  ASSERT_EQ(winner(d), "sqrt_outflow") << tried(d);
  EXPECT_NEAR(value(d, "outlet"), 0.5, 0.005);  // levels of 2 m, noise of 2 mm over 240 rows
  EXPECT_NEAR(d.final_error.rms_validate, 2e-3, 3e-4);
}

TEST_F(TanksAndCharges, OfTwoTanksInARowEachHasItsOwnOrificeAndTheDiagramItsFreeOutlets) {
  Diagram d = linear_tank();
  for (const char* name : {"upper", "lower"}) {
    auto& p = d.parameters[name];
    p.value = Value("0.3 m^3/s");
    p.lower = Number{1e-3, "m^3/s"};
    p.upper = Number{10, "m^3/s"};
    p.free = true;
  }
  const Node tank = *d.blocks.find("tank");
  d.blocks["second"] = tank;
  d.blocks["tank"].parameters["outlet"] = Value("$upper");
  d.blocks["second"].parameters["outlet"] = Value("$lower");
  d.blocks["second"].in = {{"", "tank.outflow"}};
  d.outputs["y"] = "second.level";
  const DataSet data = two_tanks(0.5, 0.4);
  const Discovery found = discovered(d, data, {"calibration", "sensor_nonlinearity", "sqrt_outflow", "overflow"});
  ASSERT_EQ(found.steps.size(), 1u) << tried(found);
  EXPECT_EQ(winner(found), "sqrt_outflow") << tried(found);
  std::vector<std::string> places = found.steps[0].winner.also_at;
  places.push_back(found.steps[0].winner.place);
  std::sort(places.begin(), places.end());
  EXPECT_EQ(places, (std::vector<std::string>{"second", "tank"}));
  EXPECT_NEAR(found.final_error.rms_validate, 2e-3, 3e-4);
}

TEST_F(TanksAndCharges, ATankThatRunsOverIsNamedWithItsBrim) {
  const Discovery d = diagnosed(linear_tank(), tank_level(1.1, [](double h) { return 0.5 * h; }), of_tanks);
  ASSERT_EQ(winner(d), "overflow") << tried(d);
  EXPECT_NEAR(value(d, "brim"), 1.1, 0.002);  // the flat tops have dozens of rows of 2 mm
  EXPECT_NEAR(d.final_error.rms_validate, 2e-3, 3e-4);
}

TEST_F(TanksAndCharges, ASensorThatIsFullIsNoOverflowAndAGainNoRoot) {
  DataSet clipped = tank_level(1e9, [](double h) { return 0.5 * h; });
  for (auto& r : clipped.recordings)
    for (auto& y : r.columns["y"]) y = std::min(y, 1.1);
  const Discovery full = diagnosed(linear_tank(), clipped, {"saturation", "overflow"});
  EXPECT_EQ(winner(full), "saturation") << tried(full);
  DataSet scaled = tank_level(1e9, [](double h) { return 0.5 * h; });
  for (auto& r : scaled.recordings)
    for (auto& y : r.columns["y"]) y *= 1.05;
  const Discovery gain = diagnosed(linear_tank(), scaled, {"calibration", "sqrt_outflow"}, exact());
  EXPECT_EQ(winner(gain), "calibration") << tried(gain);
  const Discovery nothing =
      diagnosed(linear_tank(), tank_level(1e9, [](double h) { return 0.5 * h; }), {"sqrt_outflow", "overflow"});
  EXPECT_EQ(nothing.verdict, Verdict::adequate) << tried(nothing);
}

TEST_F(TanksAndCharges, ATankThatHasTheRootAlreadyIsNoPlaceForIt) {
  Diagram d = linear_tank();
  EXPECT_EQ(places_of(effects.get("sqrt_outflow"), d, registry).size(), 1u);
  d.blocks.find("tank")->parameters["law"] = Value("square_root");
  EXPECT_EQ(places_of(effects.get("sqrt_outflow"), d, registry).size(), 0u);
  EXPECT_EQ(places_of(effects.get("overflow"), d, registry).size(), 1u);
}

}  // namespace
}  // namespace hysteron
