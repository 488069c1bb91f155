// Axes are built alike and have nothing to say to each other: rules that need two outputs.
#include <gtest/gtest.h>

#include <algorithm>

#include "discover/placement/excitation.h"
#include "engine/program/program.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/two_axes.h"

namespace hysteron {
namespace {

using namespace testing;
using std::numbers::pi;

class Axes : public Discoveries {};

TEST_F(Axes, TheGainOfOneOfTwoBranchesIsInSeriesWithNothing) {
  Diagram diagram = two_plain_axes();
  diagram.blocks["both"].type = "sum";
  diagram.blocks["both"].in = {{"", "stage"}, {"", "stage2"}};
  diagram.outputs["y"] = "both";
  const DataSet data = of_two_axes(
      1e-3, [](const auto&, const auto& u) { return u; }, [](const auto&, const auto& u) { return u; });
  const auto gain_is_free = [&](const Diagram& d, const std::string& wire) {
    Place place;
    place.wire = place.at = wire;
    return circumstances_at(d, registry, data, place, {"stage.gain"}).gain_is_free;
  };
  EXPECT_FALSE(gain_is_free(diagram, "both")) << "what u2 does there it does with the gain that the user gave";
  EXPECT_TRUE(gain_is_free(diagram, "stage"));
  EXPECT_TRUE(gain_is_free(two_plain_axes(), "stage"));
}

TEST_F(Axes, TheFrequencyOfAKnownLineStaysWhenOneOfTheOtherAxisComes) {
  // What a known line does beside being steady is left out, about its frequency: a line near by would cost nothing.
  constexpr double hertz = 59.95;
  constexpr double white = 1e-3;
  std::vector<Recording> list;
  std::uint64_t seed = 710;  // noise by which it would move
  for (const auto& [role, n] : {std::pair{Role::train, 1600}, {Role::train, 2000}, {Role::validate, 1800}}) {
    const auto t = rows(n, 0.0045);
    const auto line = [&, of = static_cast<double>(seed)](double part) {
      return sampled(t, [=](double x) { return part * white * std::cos(2 * pi * hertz * x + of); });
    };
    const auto u = several_sines(t, 1, {0.4, 0.9});
    Recording r =
        recording(std::to_string(seed) + ".csv", role, t, u, plus(plus(u, line(0.4)), noise(t.size(), white, 0, seed)));
    r.columns["u2"] = u;
    r.units["u2"] = parse_unit("V");
    r.columns["y2"] = plus(plus(u, line(0.4)), noise(t.size(), white, 0, seed + 50));
    r.units["y2"] = parse_unit("m");
    list.push_back(std::move(r));
    ++seed;
  }
  DataSet data = data_set(std::move(list), white);
  data.notes["u2"].to = "u2";
  data.notes["y2"].to = "y2";
  data.notes["y2"].noise = data.notes["y"].noise;
  const Discovery d = discovered(two_plain_axes(), data, {"mains_interference", "saturation", "slew_limit"});
  ASSERT_EQ(d.steps.size(), 1U) << tried(d);
  EXPECT_EQ(d.steps[0].winner.also_at.size(), 1U) << tried(d);
  for (const auto& s : d.steps) {
    EXPECT_EQ(s.winner.effect, "mains_interference") << tried(d);
    for (const auto& f : s.winner.found) {
      if (!f.estimate.path.ends_with(".frequency")) continue;
      EXPECT_NEAR(f.estimate.used, hertz, 0.01) << f.estimate.path;
    }
    EXPECT_GT(s.winner.fall_validate, 50) << tried(d);
  }
}

TEST_F(Axes, EachAxisHasALagOfItsOwnAndNoneHasTwo) {
  const auto lag = [](double tau) { return [tau](const auto& t, const auto& u) { return lagged(t, u, tau); }; };
  const Discovery d =
      discovered(two_plain_axes(), of_two_axes(1e-3, lag(8e-3), lag(3e-3)), {"amplifier_lag", "sensor_lag"});
  ASSERT_EQ(d.steps.size(), 1U) << tried(d);
  const Candidate& w = d.steps[0].winner;
  ASSERT_EQ(w.also_at.size(), 1U) << tried(d);
  EXPECT_NE(w.place.ends_with("2"), w.also_at[0].ends_with("2")) << tried(d);
  EXPECT_EQ(d.remainder, Remainder::noise);
}

TEST_F(Axes, WhatAnotherAxisLeavesIsNoReproachToTheEffectOfThisOne) {
  // The second axis wanders by a tenth of its stroke, which nothing in the list explains: ten times what the lag does.
  const Response wanders = [](const auto& t, const auto& u) {
    std::vector<double> y = u;
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += 0.1 * std::sin(2 * pi * 0.3 * t[k] * t[k] / t.back());
    return y;
  };
  const Response lag = [](const auto& t, const auto& u) { return lagged(t, u, 1e-3); };
  const Discovery d = discovered(two_plain_axes(), of_two_axes(1e-3, lag, wanders), {"amplifier_lag"});
  const auto at_first = std::find_if(d.candidates.begin(), d.candidates.end(),
                                     [](const Candidate& c) { return !c.place.ends_with("2"); });
  ASSERT_NE(at_first, d.candidates.end()) << tried(d);
  // All but noise of its own axis; of both together it is less than a tenth.
  EXPECT_GT(at_first->share_removed, 0.9) << tried(d);
  EXPECT_LT(at_first->share_removed, 1.1) << tried(d);
}

TEST_F(Axes, AStructureOfOneAxisIsNoReproachToTheEffectOfTheOther) {
  const Response line = [](const auto& t, const auto& u) {
    std::vector<double> y = u;
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += 4e-3 * std::sin(2 * pi * 31 * t[k]);
    return y;
  };
  const Response lag = [](const auto& t, const auto& u) { return lagged(t, u, 1e-4); };
  const Discovery d = discovered(two_plain_axes(), of_two_axes(1e-3, line, lag), {"amplifier_lag"});
  EXPECT_EQ(d.verdict, Verdict::missing_effect) << tried(d);
  ASSERT_EQ(d.steps.size(), 1U) << tried(d);
  EXPECT_TRUE(d.steps[0].winner.place.ends_with("2")) << tried(d);
  EXPECT_EQ(d.remainder, Remainder::structured);
  ASSERT_TRUE(d.structure.has_value()) << d.headline;
  EXPECT_EQ(d.structure->output, "y");
  EXPECT_NEAR(1 / d.structure->period, 31, 0.1);
  const Discovery alone = discovered(two_plain_axes(), of_two_axes(1e-3, lag, line), {"sensor_nonlinearity"});
  EXPECT_EQ(alone.verdict, Verdict::unexplained) << tried(alone);
}

}  // namespace
}  // namespace hysteron
