// How far a simulation is: told in order, seldom, by adaptive and fixed steps, and without any effect on what comes
// out.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

/// With memory, so that events and steps alternate.
ProgramPointer busy() {
  return compiled(diagram({{"u", block("sine", {{"amplitude", "1 V"}, {"frequency", "50 Hz"}})},
                           {"h", block("play", {{"radius", "0.2 V"}}, {"u"})},
                           {"x", block("lag", {{"times", list({0.01}, "s")}}, {"h"})}},
                          {"x"}));
}

class Progress : public testing::TestWithParam<Method> {};

TEST_P(Progress, RisesFromBeginToEndAndChangesNothing) {
  const auto p = busy();
  SimulateOptions options{.begin = 1, .until = 5, .every = 1e-3, .method = GetParam(), .step = 1e-4};
  const Traces alone = simulate(*p, start(*p), options);
  std::vector<double> told;
  options.progress = [&](double fraction) { told.push_back(fraction); };
  const Traces watched = simulate(*p, start(*p), options);
  EXPECT_EQ(alone.values, watched.values);
  EXPECT_EQ(alone.statistics.evaluations, watched.statistics.evaluations);
  ASSERT_FALSE(told.empty()) << "the first is told at once";
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_GE(told.front(), 0);
  EXPECT_LE(told.back(), 1);
  // One at once, then one per 50 ms of all the time that it took.
  EXPECT_LE(static_cast<double>(told.size()), 1 + watched.statistics.seconds / 0.05);
}

TEST_P(Progress, IsAShareOfTheSpan) {
  const auto p = busy();
  double seen = -1;
  SimulateOptions options{.begin = 10, .until = 12, .every = 0.1, .method = GetParam(), .step = 1e-4};
  options.progress = [&](double fraction) {
    if (seen < 0) seen = fraction;
  };
  simulate(*p, start(*p), options);
  EXPECT_EQ(seen, 0) << "before the first step, whatever the time is";
}

INSTANTIATE_TEST_SUITE_P(Methods, Progress, testing::Values(Method::bdf, Method::runge_kutta, Method::rk4),
                         [](const auto& tested) { return method_name(tested.param); });

}  // namespace
}  // namespace hysteron
