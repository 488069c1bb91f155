// Axes are built alike and have nothing to say to each other: rules that need two outputs.
#include <gtest/gtest.h>

#include <algorithm>

#include "discover/placement/excitation.h"
#include "discover/search/search_state.h"
#include "engine/program/program.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/two_axes.h"

namespace hysteron {
namespace {

using namespace testing;
using std::numbers::pi;

class Axes : public Discoveries {};

TEST_F(Axes, AnEffectOfOneAxisIsInNobodysWayOnTheOther) {
  const auto same = [](const std::vector<double>&, const std::vector<double>& u) { return u; };
  const Diagram diagram = two_plain_axes();
  const DataSet data = of_two_axes(1e-3, same, same);
  const DiscoverOptions options;
  SearchState state(diagram, data, registry, effects, options);
  fit_base(state);
  const Effect& clamp = effects.get("saturation");
  const auto places = places_of(clamp, diagram, registry, &data);
  const auto on = [&](const std::string& wire) {
    return *std::find_if(places.begin(), places.end(), [&](const Place& p) { return p.wire == wire; });
  };
  const auto at = circumstances_at(diagram, registry, data, on("u2"), {});
  const CandidateModel model =
      with_effect(state.context, state.base, clamp, clamp.laws(at).front(), on("u2"), at, Effort::screen);
  ASSERT_TRUE(model.ok) << model.error;
  EXPECT_TRUE(standing_before(state, model, clamp, on("u2")));
  EXPECT_FALSE(standing_before(state, model, clamp, on("u")));
  EXPECT_FALSE(standing_before(state, model, effects.get("asymmetry"), on("u2")));
}

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

TEST_F(Axes, WhatExplainsAsMuchOnAnotherAxisIsWhatStandsOnTheFirst) {
  const auto same = [](const std::vector<double>&, const std::vector<double>& u) { return u; };
  const DataSet data = of_two_axes(1e-3, same, same);
  const DiscoverOptions options;
  const Diagram diagram = two_plain_axes();
  SearchState state(diagram, data, registry, effects, options);
  std::vector<TriedEffect> tried(3);
  tried[0].effect = effects.find("dead_time");
  tried[1].effect = effects.find("rate_dependence");
  tried[2].effect = effects.find("amplifier_lag");
  for (TriedEffect& t : tried) t.sharp = t.admitted = true;
  int winner = 0;
  std::vector<int> ties{1, 2};
  as_on_another_axis(state, tried, winner, ties);
  EXPECT_EQ(winner, 0) << "nothing stands";
  state.current.placed.emplace_back().effect = effects.find("amplifier_lag");
  as_on_another_axis(state, tried, winner, ties);
  EXPECT_EQ(winner, 2);
  EXPECT_EQ(ties, (std::vector<int>{1, 0}));
  state.current.placed.emplace_back().effect = effects.find("rate_dependence");
  as_on_another_axis(state, tried, winner, ties);
  EXPECT_EQ(winner, 2) << "it stands itself";
}

/// Two axes of which the first has a lag and a curve behind it, which stand in the present model already.
struct FirstAxisIsKnown {
  FirstAxisIsKnown(const Registry& registry, const Effects& effects, Response second)
      : data(of_two_axes(1e-3, late_and_bent(4e-3, 0.05), std::move(second))),
        state(diagram, data, registry, effects, options) {
    fit_base(state);
    for (const char* id : {"amplifier_lag", "asymmetry"}) {
      const Effect& e = effects.get(id);
      for (const auto& place : places_of(e, state.current.diagram, registry, &data)) {
        if (outputs_moved(state, state.current, place.wire) != std::vector<std::string>{"y"}) continue;
        const auto at = circumstances_on(state, state.current, {place}).front();
        state.current = with_effect(state.context, state.current, e, e.laws(at).front(), place, at, Effort::full);
        break;
      }
    }
    state.settle(state.current);
  }
  static Response late_and_bent(double tau, double bend) {
    return [=](const std::vector<double>& t, const std::vector<double>& u) {
      auto y = lagged(t, u, tau);
      for (double& v : y) v += bend * v * v;
      return y;
    };
  }
  Diagram diagram = two_plain_axes();
  DiscoverOptions options;
  DataSet data;
  SearchState state;
};

TEST_F(Axes, WhatIsAPatchAloneActsAsASetOnTheOtherAxis) {
  FirstAxisIsKnown both(registry, effects, FirstAxisIsKnown::late_and_bent(3e-3, 0.04));
  ASSERT_EQ(both.state.current.placed.size(), 2u);
  EXPECT_TRUE(as_a_set_on_another_output(both.state, 0));
  EXPECT_EQ(both.state.current.placed.size(), 4u);
  EXPECT_LT(both.state.current.error_of.over_floor(), 1.2) << "chi2 of 1600 rows is known to 4 %";
  ASSERT_EQ(both.state.d.steps.size(), 2u);
  EXPECT_EQ(both.state.d.steps[0].winner.effect, "amplifier_lag");
  EXPECT_EQ(both.state.d.steps[1].winner.effect, "asymmetry");
  EXPECT_FALSE(as_a_set_on_another_output(both.state, 0)) << "nothing is missing any more";
  // Where one of them does nothing, or both, they are no set.
  for (const auto& [tau, bend] : {std::pair{3e-3, 0.0}, {0.0, 0.04}, {0.0, 0.0}}) {
    const Response law =
        tau > 0 ? FirstAxisIsKnown::late_and_bent(tau, bend) : [bend = bend](const auto&, const auto& u) {
          auto y = u;
          for (double& v : y) v += bend * v * v;
          return y;
        };
    FirstAxisIsKnown one(registry, effects, law);
    EXPECT_FALSE(as_a_set_on_another_output(one.state, 0)) << tau << " " << bend;
    EXPECT_EQ(one.state.current.placed.size(), 2u);
  }
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
    Recording r = recording(std::to_string(seed) + ".csv", role, t, u,
                            plus(plus(u, line(0.4)), noise(t.size(), white, 0.6 * white, seed)));
    r.columns["u2"] = u;
    r.units["u2"] = parse_unit("V");
    r.columns["y2"] = plus(plus(u, line(0.4)), noise(t.size(), white, 0.6 * white, seed + 50));
    r.units["y2"] = parse_unit("m");
    list.push_back(std::move(r));
    ++seed;
  }
  DataSet data = data_set(std::move(list), white);
  data.notes["u2"].to = "u2";
  data.notes["y2"].to = "y2";
  data.notes["y2"].noise = data.notes["y"].noise;
  const Discovery d = discovered(two_plain_axes(), data, {"mains_interference", "saturation", "slew_limit"});
  ASSERT_EQ(d.steps.size(), 2U) << tried(d);
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
  ASSERT_EQ(d.steps.size(), 2U) << tried(d);
  const auto is_second = [](const Candidate& c) { return c.place.ends_with("2"); };
  EXPECT_NE(is_second(d.steps[0].winner), is_second(d.steps[1].winner)) << tried(d);
  for (const auto& c : d.candidates)
    if (c.step == 2) {
      EXPECT_NE(is_second(c), is_second(d.steps[0].winner)) << "tried again at " << c.place;
    }
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

/// Two axes by these responses, on which effects are claimed one by one, whatever else would explain the same.
struct ClaimedOnAxes {
  ClaimedOnAxes(const Registry& registry, const Effects& all, const Response& first, const Response& second)
      : effects(all), data(of_two_axes(1e-3, first, second)), state(diagram, data, registry, all, options) {
    fit_base(state);
  }
  static Response late(double tau) {
    return [tau](const auto& t, const auto& u) { return lagged(t, u, tau); };
  }
  /// `tied`: which one the recordings are said not to have told from it, an experiment would; "" = none.
  void claim(const std::string& id, const std::string& output, const std::string& tied) {
    TriedEffect t;
    t.effect = &effects.get(id);
    for (const auto& place : places_of(*t.effect, state.current.diagram, state.registry, &data))
      if (outputs_moved(state, state.current, place.wire) == std::vector<std::string>{output}) t.place = place;
    t.excitation = circumstances_on(state, state.current, {t.place}).front();
    t.laws = t.effect->laws(t.excitation);
    t.candidate =
        with_effect(state.context, state.current, *t.effect, t.laws.front(), t.place, t.excitation, Effort::full);
    t.admitted = true;
    FoundStep found;
    if (!tied.empty()) found.ties.emplace_back().effect = tied;
    found.experiment_would_tell = !tied.empty();
    take(state, static_cast<int>(state.d.steps.size()) + 1, t, std::move(found));
  }
  const Effects& effects;
  Diagram diagram = two_plain_axes();
  DiscoverOptions options;
  DataSet data;
  SearchState state;
};

/// The first axis has a delay or a lag, which it cannot tell; the second a lag and nothing else. A delay was taken.
struct LaterAxisTells : ClaimedOnAxes {
  LaterAxisTells(const Registry& registry, const Effects& all) : ClaimedOnAxes(registry, all, late(4e-4), late(8e-3)) {
    claim("dead_time", "y", "amplifier_lag");
    claim("amplifier_lag", "y2", "");
  }
};

TEST_F(Axes, WhatCouldNotBeToldIsWhatStandsOnALaterAxis) {
  LaterAxisTells axes(registry, effects);
  SearchState& state = axes.state;
  ASSERT_EQ(state.d.steps.size(), 2U);
  reconsider(state, 0);
  ASSERT_EQ(state.d.steps.size(), 2U);
  for (const auto& s : state.d.steps) EXPECT_EQ(s.winner.effect, "amplifier_lag");
  const auto first = std::find_if(state.d.steps.begin(), state.d.steps.end(),
                                  [](const FoundStep& s) { return !s.winner.place.ends_with("2"); });
  ASSERT_NE(first, state.d.steps.end());
  ASSERT_EQ(first->ties.size(), 1U);
  EXPECT_EQ(first->ties[0].effect, "dead_time");
}

TEST_F(Axes, WhatStandsOnBothIsLeftOnlyForLessError) {
  LaterAxisTells axes(registry, effects);
  SearchState& state = axes.state;
  reconsider(state, 0);
  TriedEffect other;
  other.effect = effects.find("dead_time");
  other.candidate = state.current;
  other.candidate.error_of.nrmse_validate = 1.01 * state.current.error_of.nrmse_validate;
  EXPECT_FALSE(may_leave(state, state.current.placed[0], other));
  other.candidate.error_of.nrmse_validate = 0.99 * state.current.error_of.nrmse_validate;
  EXPECT_TRUE(may_leave(state, state.current.placed[0], other));
  state.current.placed.pop_back();
  other.candidate.error_of.nrmse_validate = 1.01 * state.current.error_of.nrmse_validate;
  EXPECT_TRUE(may_leave(state, state.current.placed[0], other)) << "it stands on one axis alone";
}

TEST_F(Axes, ATieOfTheFirstStepIsLookedAtAgainBesideWhatCameLater) {
  const Response bent = [](const auto&, auto u) {
    for (double& v : u) v += 0.05 * v * v;
    return u;
  };
  // A lag of 8 ms and a delay of as much differ by 16 times the noise; one of 0.4 ms by less than a tenth of it. What
  // bends a plain gain no recording tells from what bends its sensor.
  for (const bool clear : {true, false}) {
    ClaimedOnAxes axes(registry, effects, ClaimedOnAxes::late(clear ? 8e-3 : 4e-4), bent);
    axes.claim("amplifier_lag", "y", "dead_time");
    axes.claim("asymmetry", "y2", "sensor_nonlinearity");
    auto& steps = axes.state.d.steps;
    ASSERT_LT(axes.state.current.error_of.over_floor(), rules::floor_gate);
    ties_beside_what_came_later(axes.state, 0);
    EXPECT_EQ(steps[0].ties.empty(), clear);
    EXPECT_EQ(steps[0].experiment_would_tell, !clear);
    ASSERT_EQ(steps[1].ties.size(), 1U);
    EXPECT_EQ(steps[1].ties[0].effect, "sensor_nonlinearity");
  }
}

TEST_F(Axes, WhatExplainsAnAxisAlmostAsWellIsWhatStandsOnTheOther) {
  // The first sensor is bent and off at zero, which no curve of a drive is. On the second axis that of the drive has a
  // number less for the same: 2 in what ties are counted in, 8 where each number costs the logarithm of the rows.
  const auto bent = [](double bend, double zero) {
    return [=](const auto&, auto u) {
      for (double& v : u) v += bend * v * v + zero;
      return u;
    };
  };
  DiscoverOptions exact;  // the gain of the second axis is, and would say as much by one number
  exact.numbers_are_exact = true;
  const Discovery d = discovered(two_plain_axes(), of_two_axes(1e-3, bent(0.05, -0.01), bent(1e-3, 0)),
                                 {"asymmetry", "sensor_nonlinearity"}, exact);
  ASSERT_EQ(d.steps.size(), 2U) << tried(d);
  for (const auto& s : d.steps) EXPECT_EQ(s.winner.effect, "sensor_nonlinearity") << tried(d);
}

}  // namespace
}  // namespace hysteron
