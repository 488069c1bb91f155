#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/block/dual.h"
#include "models/linear/thermal_network.h"
#include "models/mechanics/mass_spring_damper.h"
#include "tests/models/modes.h"

namespace hysteron {
namespace {

using Numbers = std::vector<double>;

Numbers march(const std::function<Numbers(double, const Numbers&)>& rate, Numbers x, double end, double step) {
  modes::System s;
  s.rate = [=](int, double t, const Numbers& n) { return rate(t, n); };
  s.guard = [](int, double, const Numbers&) { return 1.0; };
  modes::Walk walk{s, step, 0, 0, std::move(x)};
  walk.until(end);
  return walk.x;
}

TEST(MassSpringDamperModel, FreeMotionIsTheDampedCosine) {
  const mass_spring_damper::Params<double> p{.mass = 2, .damping = 0.8, .stiffness = 50};
  const auto x = march(
      [&](double, const Numbers& n) {
        return Numbers{n[1], mass_spring_damper::acceleration(p, n[0], n[1], 0.0)};
      },
      {0.01, 0}, 3, 1e-3);
  const double decay = 0.2, w = std::sqrt(25 - decay * decay);
  const double expected = 0.01 * std::exp(-3 * decay) * (std::cos(3 * w) + decay / w * std::sin(3 * w));
  EXPECT_NEAR(x[0], expected, 1e-12);  // RK4: (5e-3)^4/120 of 0.01 over 15 radians
  EXPECT_NEAR(mass_spring_damper::natural_frequency(p), 5 / (2 * 3.14159265358979), 1e-14);
}

TEST(MassSpringDamperModel, StiffeningSpringShiftsTheFrequencyAsItsPerturbationSays) {
  // Duffing: period 2 pi/(w0 (1 + 3/8 e - 21/256 e^2 ...)), e = k3 A^2/k = 0.01: next term 1e-7 of the period.
  const mass_spring_damper::Params<double> p{.mass = 1, .stiffness = 1, .stiffening = 0.01};
  const double period = 2 * 3.14159265358979 / (1 + 0.00375 - 21.0 / 256 * 1e-4);
  const auto x = march(
      [&](double, const Numbers& n) {
        return Numbers{n[1], mass_spring_damper::acceleration(p, n[0], n[1], 0.0)};
      },
      {1, 0}, period, 1e-3);
  EXPECT_NEAR(x[1], 0, 1e-6);
  EXPECT_NEAR(x[0], 1, 1e-12);
}

TEST(MassSpringDamperModel, RestBalancesTheForce) {
  for (const double k : {1.0, 1e4})
    for (const double k3 : {0.0, 1.0, 1e12, -1e-3})
      for (const double force : {-2.0, 0.0, 0.5, 3.0}) {
        const mass_spring_damper::Params<double> p{.mass = 1, .stiffness = k, .stiffening = k3};
        const double x = mass_spring_damper::rest(p, force);
        EXPECT_NEAR(mass_spring_damper::spring(p, x), force, 1e-11) << k << " " << k3 << " " << force;
      }
  const mass_spring_damper::Params<double> loose{.mass = 1, .stiffness = 0};
  EXPECT_TRUE(std::isnan(mass_spring_damper::rest(loose, 1.0)));
  EXPECT_EQ(mass_spring_damper::rest(loose, 0.0), 0);
  // softening: the spring's largest force is 2/3 k sqrt(k/(3 |k3|)) = 0.3849 N
  EXPECT_TRUE(std::isnan(mass_spring_damper::rest({.mass = 1, .stiffness = 1, .stiffening = -1}, 0.5)));
  EXPECT_NEAR(mass_spring_damper::rest({.mass = 1, .stiffness = 0, .stiffening = 2}, 16.0), 2, 1e-15);
}

struct Net {
  Numbers capacities, to_ambient, between;
  thermal_network::Network<double> view() const { return {capacities, to_ambient, between}; }
};

TEST(ThermalNetworkModel, PairsAreCountedRowByRow) {
  std::size_t place = 0;
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = i + 1; j < 5; ++j) EXPECT_EQ(thermal_network::pair_at(5, i, j), place++);
  EXPECT_EQ(place, thermal_network::pairs(5));
}

TEST(ThermalNetworkModel, OneBodyWarmsExponentially) {
  const Net net{{10}, {0.5}, {}};
  const auto t = march(
      [&](double, const Numbers& n) {
        Numbers out(1);
        const Numbers heat{3};
        thermal_network::rates<double>(net.view(), n, heat, 290.0, out.data());
        return out;
      },
      {290}, 20, 0.05);
  EXPECT_NEAR(t[0], 290 + 6 * (1 - std::exp(-1)), 1e-9);
}

TEST(ThermalNetworkModel, TwoEqualBodiesDecayInTheirTwoModes) {
  // Sum and difference decouple: rates g/C and (g + 2 g12)/C.
  const Net net{{4, 4}, {0.2, 0.2}, {0.7}};
  const auto t = march(
      [&](double, const Numbers& n) {
        Numbers out(2);
        const Numbers heat{0, 0};
        thermal_network::rates<double>(net.view(), n, heat, 300.0, out.data());
        return out;
      },
      {310, 302}, 5, 0.01);
  const double mean = 6 * std::exp(-0.05 * 5), half = 4 * std::exp(-0.4 * 5);
  EXPECT_NEAR(t[0], 300 + mean + half, 1e-9);
  EXPECT_NEAR(t[1], 300 + mean - half, 1e-9);
}

TEST(ThermalNetworkModel, HeatIsKeptWithoutAmbient) {
  const Net net{{1, 2, 3}, {0, 0, 0}, {0.3, 0.2, 0.9}};
  const Numbers at{300, 310, 280}, heat{1, 2, 0.5};
  Numbers out(3);
  thermal_network::rates<double>(net.view(), at, heat, 250.0, out.data());
  EXPECT_NEAR(out[0] + 2 * out[1] + 3 * out[2], 3.5, 1e-14);
}

TEST(ThermalNetworkModel, AtRestNothingFlows) {
  const Net net{{1, 2, 3}, {0.4, 0, 0.1}, {0.3, 0.2, 0.9}};
  const Numbers heat{1, 2, 0.5};
  Numbers at(3), out(3);
  thermal_network::rest(net.view(), heat, 290, at.data());
  thermal_network::rates<double>(net.view(), at, heat, 290.0, out.data());
  for (const double rate : out) EXPECT_NEAR(rate, 0, 1e-12);
  EXPECT_NEAR(0.4 * (at[0] - 290) + 0.1 * (at[2] - 290), 3.5, 1e-11);  // all heat leaves through the two ways
  const Net closed{{1, 2, 3}, {0, 0, 0}, {0.3, 0.2, 0.9}};
  thermal_network::rest(closed.view(), heat, 290, at.data());
  EXPECT_TRUE(std::isnan(at[0]));
}

}  // namespace
}  // namespace hysteron
