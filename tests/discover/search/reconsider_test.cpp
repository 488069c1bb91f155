// A set of effects that was found one by one is looked at again as a set: it may have to begin with another one.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "blocks/register_all.h"
#include "discover/effects/all.h"
#include "discover/search/discover.h"
#include "discover/search/search_state.h"
#include "engine/diagram/error.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

/// A joint with a gap: the driven side moves when the gap is crossed.
std::vector<double> across_a_gap(const std::vector<double>& u, double half) {
  std::vector<double> y;
  double at = u.front();
  for (const double v : u) y.push_back(at = std::max(v - half, std::min(v + half, at)));
  return y;
}

/// A lag of `tau` rows behind straight lines between rows.
std::vector<double> behind_a_lag(const std::vector<double>& u, double tau) {
  std::vector<double> y{u.front()};
  for (std::size_t k = 1; k < u.size(); ++k) {
    const double late = (u[k] - u[k - 1]) * tau;  // in the end, on this line
    y.push_back(u[k] - late + (y.back() - u[k - 1] + late) * std::exp(-1 / tau));
  }
  return y;
}

class Sets : public ::testing::Test {
 protected:
  /// Sines of several amplitudes through `law`; two recordings train, one judges.
  static DataSet seen_through(const std::function<std::vector<double>(const std::vector<double>&)>& law) {
    constexpr double white = 2e-4;
    std::vector<Recording> list;
    std::uint64_t seed = 40;
    for (const auto& [role, top] : {std::pair{Role::train, 1.0}, {Role::train, 0.5}, {Role::validate, 0.8}}) {
      const auto t = rows(1500, 0.005);
      const auto u = decaying_triangle(t, top, 6);
      auto y = law(u);
      const auto n = noise(t.size(), white, 0.1 * white, seed++);
      for (std::size_t k = 0; k < y.size(); ++k) y[k] += n[k];
      list.push_back(recording(std::to_string(seed) + ".csv", role, t, u, std::move(y)));
    }
    return data_set(std::move(list), white);
  }
  Discovery found(const DataSet& data, const std::vector<std::string>& only) {
    DiscoverOptions options;
    options.only = only;
    return discover(plain_gain(), data, registry, effects, options);
  }
  /// The lag of the amplifier stands alone, whatever else would explain the same.
  static bool begins_with_the_lag(SearchState& state) {
    fit_base(state);
    auto lags = list_candidates(state, 1);
    std::erase_if(lags, [](const TriedEffect& t) { return t.effect->id != "amplifier_lag"; });
    fit_candidates(state, lags, 1);
    return !lags.empty() && lags.front().candidate.ok && tell_again(state, lags.front().candidate);
  }
  /// This effect stands alone by the first law that `is` the one that is meant.
  static bool begins_with(SearchState& state, const std::string& effect,
                          const std::function<bool(const hysteron::Law&)>& is) {
    fit_base(state);
    auto list = list_candidates(state, 1);
    std::erase_if(list, [&](const TriedEffect& t) { return t.effect->id != effect; });
    if (list.empty()) return false;
    TriedEffect& t = list.front();
    const auto law = std::find_if(t.laws.begin(), t.laws.end(), is);
    if (law == t.laws.end()) return false;
    t.law = static_cast<std::size_t>(law - t.laws.begin());
    t.candidate = with_effect(state.context, state.current, *t.effect, *law, t.place, t.excitation, Effort::full);
    return t.candidate.ok && tell_again(state, t.candidate) && state.d.steps.front().winner.effect == effect;
  }
  /// Hysteresis by its law that could hold a curve.
  static bool begins_with_mixed_loops(SearchState& state) {
    return begins_with(state, "hysteresis", [](const hysteron::Law& l) { return !l.holds.empty(); });
  }
  static bool goes_on_with(SearchState& state, const std::string& effect) {
    const int step = static_cast<int>(state.d.steps.size()) + 1;
    auto list = list_candidates(state, step);
    std::erase_if(list, [&](const TriedEffect& t) { return t.effect->id != effect; });
    if (list.empty()) return false;
    fit_candidates(state, list, step);
    take(state, step, list.front(), {});
    return static_cast<int>(state.d.steps.size()) == step;
  }
  static bool goes_on_with_the_lag(SearchState& state) { return goes_on_with(state, "amplifier_lag"); }
  /// The state of a search for a curve, its loops and a lag in a plain gain, before anything was tried.
  struct Search {
    Search(const Sets& of, const DataSet& data) : state(user, data, of.registry, of.effects, options) {}
    const DiscoverOptions options = [] {
      DiscoverOptions o;
      o.only = {"hysteresis", "asymmetry", "amplifier_lag"};
      return o;
    }();
    const Diagram user = plain_gain();
    SearchState state;
  };
  static std::vector<std::string> standing(const SearchState& state) {
    std::vector<std::string> list;
    for (const auto& s : state.current.placed) list.push_back(s.effect->id);
    return list;
  }
  static std::set<std::string> names(const Discovery& d) {
    std::set<std::string> list;
    for (const auto& s : d.steps) list.insert(s.winner.effect);
    return list;
  }
  Registry registry = all_blocks();
  Effects effects = all_effects();
};

TEST_F(Sets, WhatBeganWithALookAlikeBeginsAgain) {
  // Many plays imitate a gap before a curve better than the gap alone does, and nothing goes on from there; the gap and
  // the curve together leave nothing.
  const auto data = seen_through([](const std::vector<double>& u) {
    auto y = across_a_gap(u, 0.03);
    for (auto& v : y) v += 0.08 * v * v;
    return y;
  });
  const Discovery d = found(data, {"hysteresis", "backlash", "sensor_nonlinearity"});
  EXPECT_EQ(names(d), (std::set<std::string>{"backlash", "sensor_nonlinearity"})) << [&] {
    std::string s = d.headline;
    for (auto& c : d.candidates)
      s += "\n" + std::to_string(c.step) + " " + c.effect + " at " + c.place + " " + std::to_string(c.fall_validate) +
           " score " + std::to_string(c.score) + " " + c.reason;
    return s;
  }();
  EXPECT_EQ(d.remainder, Remainder::noise);
  // The steps are those of the set that is left: each falls, and the last one is the final model.
  ASSERT_EQ(d.steps.size(), 2u);
  EXPECT_LT(d.steps[1].after.chi2_validate, d.steps[0].after.chi2_validate);
  EXPECT_NEAR(d.steps[1].after.chi2_validate, d.final_error.chi2_validate, 1e-9 * d.final_error.chi2_validate);
  EXPECT_TRUE(std::none_of(d.candidates.begin(), d.candidates.end(),
                           [](const Candidate& c) { return c.effect == "hysteresis" && c.claimed; }));
}

TEST_F(Sets, WhatStoodForGainAndZeroAloneIsACalibration) {
  // Plays are late by a part of the stroke and find gain and zero anew: alone they explain more than a calibration or a
  // lag. Beside the lag only gain and zero are left for them.
  const auto data = seen_through([](const std::vector<double>& u) {
    auto y = behind_a_lag(u, 0.6);
    for (auto& v : y) v = 1.01 * v + 2e-4;
    return y;
  });
  const Discovery d = found(data, {"hysteresis", "amplifier_lag", "calibration"});
  EXPECT_EQ(names(d), (std::set<std::string>{"amplifier_lag", "calibration"})) << d.headline;
}

TEST_F(Sets, ACalibrationBesideACurveOfTheSensorMayBeItsZero) {
  // A curve that has a zero of its own, behind a lag. The calibration was claimed first; the curve can be all of it.
  const auto data = seen_through([](const std::vector<double>& u) {
    auto y = behind_a_lag(u, 0.6);
    for (auto& v : y) v = v + 0.05 * v * v + 0.01;
    return y;
  });
  DiscoverOptions o;
  o.only = {"calibration", "sensor_nonlinearity", "amplifier_lag"};
  const Diagram user = plain_gain();
  SearchState state(user, data, registry, effects, o);
  ASSERT_TRUE(begins_with(state, "calibration", [](const hysteron::Law&) { return true; }));
  ASSERT_TRUE(goes_on_with(state, "sensor_nonlinearity"));
  const double score = state.current.score();
  EXPECT_FALSE(with_the_zero_of_a_curve(state, [] { return false; })) << "nothing else is there";
  EXPECT_EQ(standing(state), (std::vector<std::string>{"calibration", "sensor_nonlinearity"})) << "all is as before";
  EXPECT_EQ(state.current.score(), score);
  ASSERT_TRUE(with_the_zero_of_a_curve(state, [&] { return goes_on_with_the_lag(state); }));
  EXPECT_EQ(standing(state), (std::vector<std::string>{"sensor_nonlinearity", "amplifier_lag"}));
  EXPECT_LT(state.current.error_of.over_floor(), 1.12);
}

TEST_F(Sets, WhatExplainsTheSameInPlaceOfAMemberIsTold) {
  // A lag of a twentieth of a row: a delay of the same time differs from it by less than the noise. As a member of a
  // set that was found at once it had no step in which the two were compared.
  const DataSet data = seen_through([](const auto& u) { return behind_a_lag(u, 0.3); });
  DiscoverOptions options;
  options.only = {"amplifier_lag", "dead_time", "saturation"};
  const Diagram user = plain_gain();
  SearchState state(user, data, registry, effects, options);
  ASSERT_TRUE(begins_with_the_lag(state));
  EXPECT_TRUE(state.d.steps.front().ties.empty());
  reconsider(state, 0, Came::at_once);
  ASSERT_EQ(state.d.steps.size(), 1u);
  ASSERT_EQ(state.d.steps.front().ties.size(), 1u) << state.d.steps.front().sentence;
  EXPECT_EQ(state.d.steps.front().ties.front().effect, "dead_time");
  EXPECT_TRUE(state.d.steps.front().experiment.has_value());
}

TEST_F(Sets, WhoCouldHoldAnotherEffectBesideItsOwnMayHaveStoodForThatOneAlone) {
  // Plays of a bent drive take a curve up and imitate a lag; beside the lag there is nothing left of their own.
  const DataSet data = seen_through([](std::vector<double> u) {
    for (auto& v : u) v += 0.05 * v * (1 - v);
    return behind_a_lag(u, 0.6);
  });
  Search search(*this, data);
  SearchState& state = search.state;
  ASSERT_TRUE(begins_with_mixed_loops(state));
  ASSERT_TRUE(goes_on_with_the_lag(state));
  reconsider(state, 0);
  EXPECT_EQ(names(state.d), (std::set<std::string>{"amplifier_lag", "asymmetry"}))
      << state.current.error_of.over_floor();
}

/// A curve that bends four times, of which a cubic leaves most, and a lag.
std::vector<double> curved_and_late(std::vector<double> u) {
  for (auto& v : u) v += 0.004 * v * (5 - v * v * (20 - 16 * v * v));
  return behind_a_lag(u, 0.6);
}

bool has_law(const SearchState& state, const std::string& name) {
  const auto& standing = state.current.placed;
  return std::any_of(standing.begin(), standing.end(), [&](const PlacedEffect& s) { return s.law.name == name; });
}

TEST_F(Sets, WhatComesInAnothersPlaceIsRefinedAsAnyCandidateIs) {
  const DataSet data = seen_through(curved_and_late);
  Search search(*this, data);
  SearchState& state = search.state;
  ASSERT_TRUE(begins_with_mixed_loops(state));
  ASSERT_TRUE(goes_on_with_the_lag(state));
  reconsider(state, 0);
  ASSERT_EQ(names(state.d), (std::set<std::string>{"amplifier_lag", "asymmetry"}));
  EXPECT_TRUE(has_law(state, "of order 5"));
  EXPECT_LT(state.current.error_of.over_floor(), rules::floor_gate);
}

TEST_F(Sets, WhatStandsIsRefinedBesideWhatCameLater) {
  const DataSet data = seen_through(curved_and_late);
  DiscoverOptions options;
  options.only = {"asymmetry", "amplifier_lag"};
  const Diagram user = plain_gain();
  SearchState state(user, data, registry, effects, options);
  ASSERT_TRUE(begins_with(state, "asymmetry", [](const hysteron::Law& l) { return l.name == "cubic"; }));
  EXPECT_FALSE(refine_what_stands(state, 0)) << "alone all its laws were compared";
  ASSERT_TRUE(goes_on_with_the_lag(state));
  ASSERT_GT(state.current.error_of.over_floor(), rules::floor_gate);
  EXPECT_TRUE(refine_what_stands(state, 0));
  EXPECT_TRUE(has_law(state, "of order 5"));
  EXPECT_LT(state.current.error_of.over_floor(), rules::floor_gate);
  EXPECT_FALSE(refine_what_stands(state, 0)) << "nothing is better than what it has";
}

TEST_F(Sets, WhatAMixedLawHoldsIsAskedForOnceItIsEnough) {
  const DataSet data = seen_through([](std::vector<double> u) {
    for (auto& v : u) v += 0.05 * v * (1 - v);
    return behind_a_lag(u, 0.6);
  });
  bool enough = false;
  DiscoverOptions options;
  options.only = {"hysteresis", "asymmetry", "amplifier_lag"};
  options.enough = [&] { return enough; };
  const Diagram user = plain_gain();
  SearchState state(user, data, registry, effects, options);
  ASSERT_TRUE(begins_with_mixed_loops(state));
  ASSERT_TRUE(goes_on_with_the_lag(state));
  enough = true;
  conclude(state);
  EXPECT_EQ(names(state.d), (std::set<std::string>{"amplifier_lag", "asymmetry"})) << state.d.headline;
}

TEST_F(Sets, WhatDoesNothingBesideWhatCameLaterIsLeftOutWhateverTheTime) {
  const DataSet data = seen_through([](const auto& u) { return behind_a_lag(u, 0.6); });
  DiscoverOptions options;
  options.only = {"amplifier_lag", "saturation"};
  const Diagram user = plain_gain();
  SearchState state(user, data, registry, effects, options);
  ASSERT_TRUE(begins_with_the_lag(state));
  leave_out_idle(state);
  EXPECT_EQ(state.d.steps.size(), 1u) << "alone it stays, whatever it does";
  // A limit that no recording reaches, as if it had been claimed.
  auto limits = list_candidates(state, 2);
  ASSERT_FALSE(limits.empty());
  fit_candidates(state, limits, 2);
  const TriedEffect& limit = limits.front();
  ASSERT_TRUE(limit.candidate.ok);
  const double before = state.current.error_of.evidence();
  state.current = limit.candidate;
  state.current.error_of = state.evidence->error(state.current.prediction);
  ASSERT_NEAR(state.current.error_of.evidence(), before, 1) << "the limit limits something";
  FoundStep step;
  step.winner.effect = "saturation";
  step.winner.place = limit.place.where();
  state.d.steps.push_back(step);
  leave_out_idle(state);
  ASSERT_EQ(state.d.steps.size(), 1u);
  EXPECT_EQ(state.d.steps.front().winner.effect, "amplifier_lag") << "without which 0.6 rows of delay are left";
  ASSERT_EQ(state.current.placed.size(), 1u);
  EXPECT_EQ(state.current.placed.front().effect->id, "amplifier_lag");
  EXPECT_NEAR(state.current.error_of.evidence(), before, 1);
}

TEST_F(Sets, WhatTheOthersExplainAsWellIsLeftOutWhileThereIsTime) {
  // A lag of a third of a row, half of it told as a delay: switched off alone, each leaves the other too short by half;
  // fitted again the delay is all of it.
  const DataSet data = seen_through([](const auto& u) { return behind_a_lag(u, 0.3); });
  bool late = false;
  DiscoverOptions options;
  options.only = {"amplifier_lag", "dead_time"};
  options.stop = [&] { return late; };
  const Diagram user = plain_gain();
  SearchState state(user, data, registry, effects, options);
  ASSERT_TRUE(begins_with_the_lag(state));
  const double before = state.current.error_of.evidence();
  const auto lag = parameters_of(state.current, 0).front();
  state.current.diagram =
      with_parameters(state.current.diagram, *state.current.program,
                      {{parameter_index(*state.current.program, lag.estimate->path), lag.estimate->used / 2, -1}});
  auto delays = list_candidates(state, 2);
  std::erase_if(delays, [](const TriedEffect& t) { return t.effect->id != "dead_time"; });
  ASSERT_FALSE(delays.empty());
  TriedEffect& delay = delays.front();
  delay.candidate = with_effect(state.context, state.current, *delay.effect, delay.laws.front(), delay.place,
                                delay.excitation, Effort::screen);
  ASSERT_TRUE(delay.candidate.ok);
  ASSERT_NEAR(delay.candidate.error_of.evidence(), before, 8) << "a screening ends a few of chi2 early";
  take(state, 2, delay, {});
  ASSERT_EQ(state.d.steps.size(), 2u);
  late = true;
  leave_out_idle(state);
  EXPECT_EQ(state.d.steps.size(), 2u) << "neither is idle, and for more there is no time";
  late = false;
  leave_out_idle(state);
  ASSERT_EQ(state.d.steps.size(), 1u);
  EXPECT_EQ(state.d.steps.front().winner.effect, "dead_time") << "the last one was compared when it was claimed";
  ASSERT_EQ(state.current.placed.size(), 1u);
  EXPECT_NEAR(state.current.error_of.evidence(), before, 2);
  EXPECT_EQ(state.d.steps.front().after.rms_validate, state.current.error_of.rms_validate);
}

TEST_F(Sets, NothingIsClaimedOfWhichNotAllWereAskedOnceItIsEnough) {
  const DataSet data = seen_through([](const auto& u) {
    auto y = across_a_gap(u, 0.02);
    for (double& v : y) v += 0.004 * v * (1 - v);
    return y;
  });
  bool begun = false;
  DiscoverOptions options;
  options.only = {"backlash", "sensor_nonlinearity"};
  options.progress = [&](const std::string& what, double) { begun = begun || what.starts_with("step 2"); };
  options.enough = [&] { return begun; };
  const Discovery d = discover(plain_gain(), data, registry, effects, options);
  EXPECT_TRUE(d.broken_off);
  ASSERT_EQ(d.steps.size(), 1u);
  EXPECT_EQ(d.steps.front().winner.effect, "backlash");
}

TEST_F(Sets, WhatWasFoundStaysFoundWhereTheSearchForMoreFails) {
  const DataSet data = seen_through([](const auto& u) {
    auto y = across_a_gap(u, 0.02);
    for (double& v : y) v += 0.004 * v * (1 - v);
    return y;
  });
  DiscoverOptions options;
  options.only = {"backlash", "sensor_nonlinearity"};
  ASSERT_EQ(found(data, options.only).steps.size(), 2u);
  options.progress = [](const std::string& what, double) {
    if (what.starts_with("step 2")) fail_numerics("numerics.step", "stage.y", "no step is small enough", "none");
  };
  const Discovery d = discover(plain_gain(), data, registry, effects, options);
  ASSERT_EQ(d.steps.size(), 1u);
  EXPECT_EQ(d.steps.front().winner.effect, "backlash");
  EXPECT_EQ(to_text(d.verdict), "missing_effect");
  EXPECT_NEAR(d.final_error.rms_validate, d.steps.front().after.rms_validate, 1e-12);
  ASSERT_FALSE(d.warnings.empty());
  EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(), [](const std::string& w) {
    return w.find("ended early") != std::string::npos && w.find("no step is small enough") != std::string::npos;
  })) << d.warnings.front();
}

}  // namespace
}  // namespace hysteron
