// A resonance that is no mass (a circuit, a beam known by its frequency) whose spring is bent, hidden by its equation.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;
using std::numbers::pi;

class Duffings : public Discoveries {};

constexpr double hertz = 3, damping_ratio = 0.1;

/// V to V: gain 0.8, then a resonance of which frequency and damping are the user's.
Diagram circuit() {
  Diagram d = plain_gain();
  d.blocks["stage"].parameters["gain"] = Value("0.8 V/V");
  Node& ring = d.blocks["ring"];
  ring.type = "resonance";
  ring.parameters["frequency"] = Value("3 Hz");
  ring.parameters["damping"] = Value(damping_ratio);
  ring.in = {{"", "stage"}};
  d.outputs["y"] = "ring";
  return d;
}

/// y''/w^2 + 2 D y'/w + y + cubic y^3 = 0.8 u, by small steps of which the middle counts; noise of 1 mV.
DataSet ringing(double cubic) {
  const double w = 2 * pi * hertz;
  std::vector<Recording> list;
  std::uint64_t seed = 8800;
  for (const auto& [role, top, sines] : {std::tuple{Role::train, 0.5, std::vector{0.7, 2.4}},
                                         {Role::train, 1.5, std::vector{1.1, 2.9}},
                                         {Role::validate, 1.0, std::vector{0.9, 2.6}}}) {
    const auto t = rows(1500, 0.01);
    const auto u = several_sines(t, top, sines);
    auto y = noise(t.size(), 1e-3, 0, seed);
    double x = 0, v = 0;
    for (std::size_t k = 1; k < t.size(); ++k) {
      for (int i = 0; i < 200; ++i) {
        const double h = (t[k] - t[k - 1]) / 200, at = u[k - 1] + (u[k] - u[k - 1]) * (i + 0.5) / 200;
        x += 0.5 * h * v;
        v += h * (w * w * (0.8 * at - x - cubic * x * x * x) - 2 * damping_ratio * w * v);
        x += 0.5 * h * v;
      }
      y[k] += x;
    }
    list.push_back(recording(std::to_string(seed++) + ".csv", role, t, u, y));
    list.back().units["y"] = parse_unit("V");
  }
  return data_set(list, 1e-3, 0);
}

TEST_F(Duffings, AResonanceWhoseSpringGetsHarderIsToldInItsOwnUnit) {
  const Discovery d = diagnosed(circuit(), ringing(0.15));
  ASSERT_EQ(winner(d), "stiffening") << tried(d);
  // 1/V^2. 4500 rows with noise of 1 mV, in which the cubic part moves some 0.1 V: 1e-3/0.1/sqrt(4500) = 2e-4 of it,
  // and some times that beside frequency and damping; the steps leave (w h)^2/24 = 4e-8.
  EXPECT_NEAR(value(d, "stiffening"), 0.15, 0.15 * 0.01) << tried(d);
  const auto* found = &d.steps.front().winner.found.front();
  for (const auto& f : d.steps.front().winner.found)
    if (f.estimate.path.ends_with(".stiffening")) found = &f;
  EXPECT_EQ(found->estimate.unit.dimension, parse_unit("1/V^2").dimension);
}

TEST_F(Duffings, ASpringThatGetsSofterHasTheOtherSign) {
  const Discovery d = diagnosed(circuit(), ringing(-0.04));
  ASSERT_EQ(winner(d), "stiffening") << tried(d);
  EXPECT_NEAR(value(d, "stiffening"), -0.04, 0.04 * 0.02) << tried(d);
}

TEST_F(Duffings, AStraightSpringIsTakenAsItIs) {
  const Discovery d = diagnosed(circuit(), ringing(0));
  EXPECT_TRUE(d.steps.empty()) << tried(d);
}

}  // namespace
}  // namespace hysteron
