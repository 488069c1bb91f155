#include <gtest/gtest.h>

#include <cmath>

#include "models/random.h"
#include "tests/blocks/bench.h"
#include "tests/models/golden.h"

namespace hysteron {
namespace {

using bench::Bench;

TEST(Sources, SineAndTriangleOfTheThesisAreReproduced) {
  HYSTERON_NEEDS_GOLDEN("signals");
  const auto trace = golden::read("signals");
  const Bench::Values values{{"amplitude", {3}}, {"offset", {3}}, {"frequency", {5}}, {"phase", {-M_PI / 2}}};
  const Bench sine("sine", values), triangle("triangle", values);
  for (std::size_t k = 0; k < trace.at("t [s]").size(); ++k) {
    const double t = trace.at("t [s]")[k];
    ASSERT_NEAR(sine.output(t)[0], trace.at("sine [V]")[k], 1e-9);  // ten digits of numbers up to 6
    ASSERT_NEAR(triangle.output(t)[0], trace.at("triangle [V]")[k], 1e-9);
  }
}

TEST(Sources, DefaultsAreAnOffsetAndAPhaseOfZero) {
  const Bench sine("sine", {{"amplitude", {2}}, {"frequency", {1}}});
  EXPECT_EQ(sine.output(0)[0], 0);
  EXPECT_NEAR(sine.output(0.25)[0], 2, 1e-15);
  EXPECT_DOUBLE_EQ(sine.shortest_period(), 1);
}

TEST(Sources, AConstantIsNoFunctionOfTime) {
  EXPECT_FALSE(bench::kernel_of("constant").uses_time) << "the exact advance refuses functions of time";
}

TEST(Sources, ChirpSweepsAsItsTextSays) {
  const Bench::Values values{{"amplitude", {1}}, {"from", {2}}, {"to", {50}}, {"duration", {4}}};
  auto logarithmic = values;
  logarithmic["sweep"] = {1};
  // In the middle of the sweep the phase has run 2 (2 + (26 - 2)/2) = 28 cycles, or 2*4/ln(25) (sqrt(25) - 1).
  EXPECT_NEAR(Bench("chirp", values).output(2)[0], std::sin(2 * M_PI * 28), 1e-12);
  EXPECT_NEAR(Bench("chirp", logarithmic).output(2)[0], std::sin(2 * M_PI * 8 / std::log(25.0) * 4), 1e-12);
}

TEST(Sources, MultisineIsTheSameForOneSeedAndAnotherForAnother) {
  Bench::Values values{{"rms", {2}},      {"offset", {1}},  {"lowest", {1}},
                       {"highest", {20}}, {"spacing", {1}}, {"seed", {3}}};
  const Bench b("multisine", values);
  double sum = 0, squares = 0;
  for (int k = 0; k < 1000; ++k) {  // one period: sums are exact
    const double y = b.output(k / 1000.0)[0] - 1;
    sum += y;
    squares += y * y;
  }
  EXPECT_NEAR(sum / 1000, 0, 1e-12);
  EXPECT_NEAR(std::sqrt(squares / 1000), 2, 1e-12);
  EXPECT_EQ(Bench("multisine", values).output(0.1)[0], b.output(0.1)[0]);
  values["seed"] = {4};
  EXPECT_NE(Bench("multisine", values).output(0.1)[0], b.output(0.1)[0]);
}

TEST(Sources, RecordedSignalMovesAsItsSeriesSays) {
  Bench b("recorded", {});
  const Series linear{{0, 1, 3}, {2, 5, 1}, Between::linear}, hold{{0, 1, 3}, {2, 5, 1}, Between::hold};
  b.series = &linear;
  EXPECT_EQ(b.output(-1)[0], 2);
  EXPECT_EQ(b.output(0.5)[0], 3.5);
  EXPECT_EQ(b.output(9)[0], 1);
  b.series = &hold;
  EXPECT_EQ(b.output(0.5)[0], 2);
  EXPECT_EQ(b.output(1)[0], 5);
  EXPECT_EQ(b.output(1, 0.5, {}, {}, {})[0], 2) << "the branch decides";
}

TEST(Sources, AnUnboundInputIsNotANumber) {
  EXPECT_TRUE(std::isnan(Bench("input", {}).output(0)[0])) << "never a silent zero";
}

TEST(SensorNoise, DependsOnSeedAndSampleOnly) {
  const Bench::Values values{{"rms", {0.5}}, {"period", {0.01}}, {"seed", {8}}};
  const Bench forward("sensor_noise", values), backward("sensor_noise", values);
  bench::Numbers a, b;
  for (int k = 0; k < 100; ++k) a.push_back(forward.output(0.01 * k + 0.005, {1})[0]);
  for (int k = 99; k >= 0; --k) b.insert(b.begin(), backward.output(0.01 * k + 0.002, {1})[0]);
  EXPECT_EQ(a, b);
  EXPECT_EQ(forward.sizes.smoothness, Smoothness::no_rate);
}

TEST(SensorNoise, HasItsRootMeanSquare) {
  const Bench b("sensor_noise", {{"rms", {0.5}}, {"period", {0.01}}, {"seed", {8}}});
  double squares = 0;
  for (int k = 0; k < 20000; ++k) squares += std::pow(b.output(0.01 * k + 0.005, {3})[0] - 3, 2);
  EXPECT_NEAR(std::sqrt(squares / 20000), 0.5, 5 * 0.5 / std::sqrt(2 * 20000.0));  // five standard errors
}

TEST(Math, StaticBlocksComputeTheirLaws) {
  EXPECT_EQ(Bench("sum", {}, 3).output(0, {1, 2, 4})[0], 7) << "all plus where no signs are given";
  EXPECT_EQ(Bench("sum", {{"signs", {'+', '-', '-'}}}, 3).output(0, {1, 2, 4})[0], -5);
  EXPECT_EQ(Bench("product", {}).output(0, {3, -4})[0], -12);
  EXPECT_EQ(Bench("pass", {}).output(0, {3})[0], 3);
  EXPECT_EQ(Bench("gain", {{"gain", {2}}}).output(0, {3})[0], 6);
  EXPECT_EQ(Bench("calibration", {{"gain", {2}}, {"offset", {1}}}).output(0, {3})[0], 7);
  EXPECT_EQ(Bench("saturation", {{"lower", {-1}}, {"upper", {2}}}).output(0, {3})[0], 2);
  EXPECT_EQ(Bench("constant", {{"value", {2.5}}}).output(7)[0], 2.5);
}

}  // namespace
}  // namespace hysteron
