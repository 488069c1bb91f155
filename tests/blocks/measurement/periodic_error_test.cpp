// An error that comes again at the same positions.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/blocks/samples.h"

namespace hysteron {
namespace {

using bench::Bench;

const bench::Samples periodic_errors{
    {"periodic_error", {{"period", {0.9}}, {"cosine", {0.1}}, {"second_sine", {0.04}}}}};

TEST(PeriodicErrorBlock, AddsWhatComesAgainOnceAndTwiceAPeriod) {
  const Bench b("periodic_error", {{"period", {0.25}}, {"sine", {3e-3}}, {"second_cosine", {1e-3}}});
  for (double x = -1; x < 1; x += 0.0173)
    EXPECT_NEAR(b.output(0, {x})[0], x + 3e-3 * std::sin(2 * M_PI * x / 0.25) + 1e-3 * std::cos(4 * M_PI * x / 0.25),
                1e-15);  // rounding of numbers of size 1
  EXPECT_NEAR(b.output(0, {0.1})[0] - 0.1, b.output(0, {0.35})[0] - 0.35, 1e-15);
}

}  // namespace
}  // namespace hysteron
