// A discovery that is stopped at any moment tells what it had found by then; it fails nowhere, and claims nothing that
// the whole one would not have asked for.
#include "engine/diagram/stop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "discover/placement/add.h"
#include "discover/search/search_state.h"
#include "engine/diagram/error.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

class StopOfADiscovery : public Discoveries {
 protected:
  std::atomic<long> asked{0};  ///< by the last search: whether it is to stop

  /// What is found of a plain gain until it has been asked so often.
  Discovery stopped_at(long at, const DataSet& data, const std::vector<std::string>& of) {
    asked = 0;
    DiscoverOptions options;
    options.stop = [&] { return ++asked >= at; };
    return discovered(plain_gain(), data, of, options);
  }

  /// Plays, of which the recordings do not begin in the virgin state: an effect that stands upon another one.
  static DataSet of_a_device_with_a_past() {
    constexpr double white = 2e-4;
    std::vector<Recording> list;
    std::uint64_t seed = 70;
    for (const auto& [role, top] : {std::pair{Role::train, 1.0}, {Role::train, 0.6}, {Role::validate, 0.8}}) {
      const auto t = rows(900, 0.005);
      const auto u = decaying_triangle(t, top, 5);
      std::vector<double> y(u.size(), 0.0);
      for (const auto& [radius, weight] : {std::pair{0.0, 1.0}, {0.05, 0.2}, {0.12, 0.15}, {0.2, 0.1}}) {
        double at = radius;  // as after a visit to a large value
        for (std::size_t k = 0; k < u.size(); ++k) {
          at = std::max(u[k] - radius, std::min(u[k] + radius, at));
          y[k] += weight * at;
        }
      }
      const auto n = noise(t.size(), white, 0.1 * white, seed++);
      for (std::size_t k = 0; k < y.size(); ++k) y[k] += n[k];
      list.push_back(recording(std::to_string(seed) + ".csv", role, t, u, std::move(y)));
    }
    return data_set(std::move(list), white);
  }
};

TEST_F(StopOfADiscovery, AtAnyMomentTellsWhatWasFound) {
  const DataSet data = of_a_device_with_a_past();
  const auto found = [&](long at) {
    return stopped_at(at, data, {"hysteresis", "initial_remanence", "amplifier_lag", "calibration"});
  };
  const Discovery whole = found(1'000'000'000);
  ASSERT_FALSE(whole.steps.empty()) << tried(whole);
  EXPECT_FALSE(whole.broken_off);
  const long all = asked;
  bool some = false;
  for (long at = 1; at < all; at += std::max(1L, at)) {
    SCOPED_TRACE(std::to_string(at) + " of " + std::to_string(all));
    const Discovery now = found(at);
    EXPECT_TRUE(now.broken_off);
    for (const auto& w : now.warnings) EXPECT_EQ(w.find("ended early"), std::string::npos) << w;
    EXPECT_FALSE(now.headline.empty());
    EXPECT_TRUE(now.final_error.ok);
    EXPECT_FALSE(now.final_diagram.blocks.empty());
    EXPECT_NO_THROW(compile(now.final_diagram, registry));
    some = some || !now.steps.empty();
  }
  const Discovery late = found(all - 1);
  EXPECT_TRUE(some || !late.steps.empty()) << "what was found is in no result";
}

TEST_F(StopOfADiscovery, AtAnyMomentClaimsNothingThatExplainsNothing) {
  std::vector<Recording> list;
  for (std::uint64_t r = 0; r < 3; ++r) {
    const auto t = rows(600, 0.01);
    const auto u = several_sines(t, 1, {0.4 + 0.1 * static_cast<double>(r), 1.3});
    auto y = u;
    const auto n = noise(t.size(), 1e-3, 0, 90 + r);
    const auto jumps = noise(t.size() / 20, 0.02, 0, 190 + r);  // which no effect explains
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += n[k] + jumps[k / 20];
    list.push_back(recording(std::to_string(r) + ".csv", r < 2 ? Role::train : Role::validate, t, u, std::move(y)));
  }
  const DataSet data = data_set(std::move(list), 1e-3);
  const auto found = [&](long at) {
    return stopped_at(at, data, {"hysteresis", "backlash", "creep", "calibration", "asymmetry", "amplifier_lag"});
  };
  ASSERT_TRUE(found(1'000'000'000).steps.empty());
  const long all = asked;
  constexpr long moments = 24;
  for (long k = 1; k < moments; ++k) {
    const Discovery now = found(all * k / moments);
    EXPECT_TRUE(now.steps.empty()) << k << " of " << moments << ": " << tried(now);
  }
}

TEST_F(StopOfADiscovery, WhoTakesLongLeavesTimeForThoseBehind) {
  const DataSet data = of_a_device_with_a_past();
  const Diagram diagram = plain_gain();
  double clock = 0;
  DiscoverOptions options;
  options.spent = [&] { return clock; };
  const SearchState state(diagram, data, registry, effects, options);
  constexpr std::size_t n = 10;
  constexpr double until = 0.5, tick = 1e-3, least = 5e-3;
  std::vector<double> begun(n, -1.0), ended(n, -1.0);
  const auto takes = [&](std::size_t i) { return i == 0 || i == 4 || i == n - 1 ? 1.0 : least; };
  const auto job = [&](std::size_t i, const FitContext&) {
    begun[i] = clock;
    try {
      while (clock < begun[i] + takes(i)) {
        clock += tick;
        look_up();
      }
    } catch (const Stopped&) {
      ended[i] = clock;
      throw;
    }
    return false;
  };
  state.side_by_side(n, job, until);
  for (std::size_t i = 0; i < n; ++i) EXPECT_GE(begun[i], 0) << i << " was not begun";
  // A tenth of the half; a sixth of what is left, for which five others wait; all that is left. Within ticks.
  EXPECT_NEAR(ended[0], until / n, 2 * tick);
  EXPECT_NEAR(ended[4] - begun[4], (until - begun[4]) / 6, 2 * tick);
  EXPECT_NEAR(ended[n - 1], until, 2 * tick);
  for (const std::size_t i : {1, 2, 3, 5, 6, 7, 8}) EXPECT_LT(ended[i], 0) << i << " was broken off";
  clock = 0;
  state.side_by_side(1, [&](std::size_t, const FitContext&) {
    for (; clock < 0.9; clock += tick) look_up();
    return false;
  });
  EXPECT_GE(clock, 0.9) << "nobody said until when";
}

TEST_F(StopOfADiscovery, BeforeTheModelWasSimulatedEndsItByTheCallersOwnScope) {
  const DataSet data = of_a_device_with_a_past();
  const StopScope scope([] { return true; });
  EXPECT_THROW(discovered(plain_gain(), data, {"hysteresis"}), Stopped);
}

TEST_F(StopOfADiscovery, AnEffectThatAnotherOneStandsUponIsNotTakenFromUnderIt) {
  const Diagram with_plays = add_effect(plain_gain(), registry, effects.get("hysteresis"), "stage").diagram;
  const auto core = effects_in(with_plays).front().first;
  const Diagram with_past = add_effect(with_plays, registry, effects.get("initial_remanence"), core).diagram;
  ASSERT_EQ(effects_in(with_past).size(), 2U);
  try {
    remove_effect(with_past, registry, "hysteresis");
    FAIL() << "what is left of the past has no law to stand upon";
  } catch (const Error& e) {
    const Problem& p = e.problems.front();
    EXPECT_EQ(p.code, "stood_upon");
    EXPECT_NE(p.what.find("initial_remanence"), std::string::npos) << p.what;
    EXPECT_NE(p.cure.find("initial_remanence"), std::string::npos) << p.cure;
  }
  const Diagram without_past = remove_effect(with_past, registry, "initial_remanence");
  EXPECT_NO_THROW(compile(without_past, registry));
  EXPECT_NO_THROW(compile(remove_effect(without_past, registry, "hysteresis"), registry));
}

}  // namespace
}  // namespace hysteron
