// Encoders: counts, errors of interpolation, and edges that a simulation finds.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/blocks/samples.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using bench::Bench;
using tools::block;

const bench::Samples encoders{
    {"encoder", {{"lines", {5}}, {"error_cosine", {0.1}}, {"error_sine", {-0.05}}}},
    {"linear_encoder", {{"pitch", {0.9}}, {"divisions", {0}}, {"error_cosine", {0.1}}, {"second_sine", {0.04}}}}};

TEST(EncoderBlock, CountsFourTimesPerLineWhereNothingElseIsSaid) {
  const Bench b("encoder", {{"lines", {1000}}});
  const double count = 2 * M_PI / 4000;
  for (const double at : {-3.4, 0.0, 0.49, 0.51, 7.2})
    EXPECT_NEAR(b.output(0, {at * count})[0], std::round(at) * count, 1e-15);
}

TEST(LinearEncoderBlock, InterpolatesWithThePeriodicErrorsOfItsSignals) {
  const Bench b("linear_encoder",
                {{"pitch", {20e-6}}, {"divisions", {0}}, {"error_cosine", {30e-9}}, {"second_sine", {50e-9}}});
  for (double x = 0; x < 60e-6; x += 1.7e-6)
    EXPECT_NEAR(b.output(0, {x})[0],
                x + 30e-9 * std::cos(2 * M_PI * x / 20e-6) + 50e-9 * std::sin(4 * M_PI * x / 20e-6), 1e-19);
  const Bench counted("linear_encoder", {{"pitch", {20e-6}}, {"divisions", {2000}}});
  EXPECT_NEAR(counted.output(0, {12.3456e-6})[0], 12.35e-6, 1e-18);
}

TEST(EncoderBlock, EveryCountIsFoundWhereSomethingRemembersIt) {
  // A turn in 1 s of a disc of 5 lines, 20 counts: the integral of the counts is that of the angle, half a count being
  // read too little and too much alike.
  const auto d = tools::diagram({{"w", block("constant", {{"value", "6.283185307179586 rad/s"}})},
                                 {"a", block("integrator", {}, {"w"})},
                                 {"e", block("encoder", {{"lines", 5.0}}, {"a"})},
                                 {"i", block("integrator", {}, {"e"})}},
                                {"i"});
  const auto program = tools::compiled(d);
  SimulateOptions options;
  options.instants = {1.0};
  for (const Method method : {Method::bdf, Method::runge_kutta}) {
    options.method = method;
    EXPECT_NEAR(simulate(*program, start(*program), options).values[0].back(), M_PI, 3e-5);
  }
}

}  // namespace
}  // namespace hysteron
