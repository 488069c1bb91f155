// What a round claims when others have been fitted behind it.
#include "discover/selection/selection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

class Selections : public Discoveries {};

/// A gain of one with a zero that is off by this [m], read with 1 mm of white noise that nobody states.
DataSet with_zero(double off) {
  std::vector<Recording> list;
  std::uint64_t seed = 6100;
  for (const Role role : {Role::train, Role::validate}) {
    const auto t = rows(500, 0.01);
    const auto u = several_sines(t, 1, {0.7, 2.1});
    auto y = noise(t.size(), 1e-3, 0, seed);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += u[k] + off;
    list.push_back(recording(std::to_string(seed++), role, t, u, y));
    list.back().start_is_stated = true;
  }
  return data_set(std::move(list), 0);
}

TEST_F(Selections, WhatIsNearlyClaimedIsClaimedWhereAnotherModelShowsLessNoise) {
  // 1000 rows: (1000/2) (0.175)^2 = 15 in ln p, within 4 by chance, less half of ln 1000 for a number and ln of all
  // tried.
  const DataSet data = with_zero(0.175e-3);
  const Diagram diagram = plain_gain();
  DiscoverOptions options;
  options.only = {"calibration"};
  SearchState state(diagram, data, registry, effects, options);
  fit_base(state);
  Selection selection(state, {});
  selection.run([](const TableModel&) { return false; });
  ASSERT_TRUE(selection.best().model.placed.empty());
  ASSERT_FALSE(selection.rounds().empty());
  const auto more = [&] {
    return selection.score_of(selection.rounds().back().rivals.front().fitted) - selection.score_of(selection.best());
  };
  ASSERT_GT(more(), 4);
  ASSERT_LT(more(), rules::by_score);
  EXPECT_FALSE(selection.claim_of_last_round()) << "nothing has changed";

  // A model that leaves a tenth of that: where the noise is none of what is left, ln(s^2 + RSS/rows) falls twice as
  // far.
  LeftSums less = selection.best().left;
  for (auto& piece : less) {
    for (double& square : piece.squares) square /= 100;
    piece.scatter /= 100;
  }
  selection.count_in(less);
  EXPECT_GT(more(), rules::by_score);
  EXPECT_TRUE(selection.claim_of_last_round());
  ASSERT_EQ(selection.best().model.placed.size(), 1U);
  EXPECT_EQ(selection.best().model.placed.front().effect->id, "calibration");
}

TEST_F(Selections, WhatHasBeenClaimedIsNotClaimedOnceMore) {
  const DataSet data = with_zero(1e-3);
  const Diagram diagram = plain_gain();
  DiscoverOptions options;
  options.only = {"calibration"};
  options.max_steps = 1;
  SearchState state(diagram, data, registry, effects, options);
  fit_base(state);
  Selection selection(state, {});
  int terms = 0;  // once for each that was added
  selection.run([&](const TableModel&) { return ++terms, false; });
  EXPECT_EQ(terms, 1) << "its round was claimed again and again";
  ASSERT_EQ(selection.best().model.placed.size(), 1U);
  EXPECT_FALSE(selection.claim_of_last_round());
}

// Under a line of the mains of ten times the noise only the square of a curve shows. Once the line is known the cube, a
// third of the noise, does: another law of the curve, and no further effect.
TEST_F(Selections, OfWhatStandsAnotherLawMayShowOnceMoreIsKnown) {
  std::vector<Recording> list;
  std::uint64_t seed = 6200;
  for (const Role role : {Role::train, Role::train, Role::validate}) {
    const auto t = rows(1500, 0.002);
    auto u = several_sines(t, 2, {0.7, 2.1});
    for (double& v : u) v -= 1;
    auto y = noise(t.size(), 1e-3, 0, seed);
    for (std::size_t k = 0; k < y.size(); ++k)
      y[k] += u[k] + 0.1 * u[k] * u[k] - 0.002 * u[k] * u[k] * u[k] + 0.01 * std::sin(100 * std::numbers::pi * t[k]);
    list.push_back(recording(std::to_string(seed++), role, t, u, y));
    list.back().start_is_stated = true;
  }
  const Discovery d = discovered(plain_gain(), data_set(std::move(list), 1e-3, 0),
                                 {"sensor_nonlinearity", "mains_interference", "saturation", "calibration"});
  std::set<std::string> laws;
  for (const auto& step : d.steps) laws.insert(step.winner.law);
  EXPECT_EQ(laws, (std::set<std::string>{"cubic", "one line"})) << tried(d);
  EXPECT_LT(d.final_error.rms_validate, 1.03e-3) << tried(d);  // rms of 1500 rows: 2 %
}

}  // namespace
}  // namespace hysteron
