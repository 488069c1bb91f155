// A discovery that is stopped at any moment tells what it had found by then; it fails nowhere, and claims nothing that
// the whole one would not have asked for.
#include "engine/diagram/stop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "discover/placement/add.h"
#include "engine/diagram/error.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

class StopOfADiscovery : public Discoveries {
 protected:
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
  std::atomic<long> asked{0};
  const auto found = [&](long at) {
    asked = 0;
    DiscoverOptions options;
    options.stop = [&] { return ++asked >= at; };
    return discovered(plain_gain(), data, {"hysteresis", "initial_remanence", "amplifier_lag", "calibration"}, options);
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
  std::atomic<long> asked{0};
  const auto found = [&](long at) {
    asked = 0;
    DiscoverOptions options;
    options.stop = [&] { return ++asked >= at; };
    return discovered(plain_gain(), data, {"hysteresis", "backlash", "creep", "calibration"}, options);
  };
  ASSERT_TRUE(found(1'000'000'000).steps.empty());
  const long all = asked;
  constexpr long moments = 24;
  for (long k = 1; k < moments; ++k) {
    const Discovery now = found(all * k / moments);
    EXPECT_TRUE(now.steps.empty()) << k << " of " << moments << ": " << tried(now);
  }
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
