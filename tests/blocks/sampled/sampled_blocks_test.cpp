// Sampled blocks, one by one: what they give at their instants is what the models give.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/program/program.h"
#include "engine/simulate/simulate.h"
#include "models/random.h"
#include "tests/blocks/bench.h"
#include "tests/blocks/sampled/rows.h"
#include "tests/models/golden.h"

namespace hysteron {
namespace {

using bench::Bench;
using bench::Numbers;
using bench::rows;

TEST(SampledBlocks, HavePeriodAndOffsetAsTheirLastParameters) {
  int found = 0;
  for (const auto& type : bench::registry().types()) {
    const auto& d = bench::kernel_of(type).declaration;
    if (!d.is_sampled) continue;
    ++found;
    ASSERT_GE(d.parameters.size(), 2u) << type;
    EXPECT_EQ(d.parameters[d.parameters.size() - 2].name, "period") << type;
    EXPECT_EQ(d.parameters.back().name, "offset") << type;
  }
  EXPECT_GE(found, 12);
}

TEST(SampledPidBlock, ReproducesTheCommandOfTheThesisLoop) {
  HYSTERON_NEEDS_GOLDEN("loop1_sine_sampled");
  const auto trace = golden::read("loop1_sine_sampled");
  Numbers error;
  for (std::size_t k = 0; k < trace.at("u [V]").size(); ++k)
    error.push_back(1e-6 * (trace.at("r [um]")[k] - trace.at("y [um]")[k]));
  const double inf = HUGE_VAL;
  const Bench b("sampled_pid",
                {{"kp", {1.207e6}}, {"ki", {7009e6}}, {"lower", {-inf}}, {"upper", {inf}}, {"period", {1e-4}}});
  const Numbers u = b.response(rows(error), 1e-4);
  for (std::size_t k = 0; k < u.size(); ++k)  // ten digits of r and y, summed: as in the test of the model
    ASSERT_NEAR(u[k], trace.at("u [V]")[k], 2e-7) << "row " << k;
}

TEST(SampledPidBlock, BackCalculationFollowsInTheTimeOfTheIntegralWhereNothingIsSaid) {
  // tracking_time 0 = kp/ki = 0.5 s: I = upper - kp e + ki T_t e = 2 - 1 + 1 for e = 1, ki = 2.
  Bench b("sampled_pid",
          {{"kp", {1}}, {"ki", {2}}, {"lower", {-2}}, {"upper", {2}}, {"anti_windup", {2}}, {"period", {0.1}}});
  Numbers x = b.initial_states();
  for (int k = 0; k < 300; ++k) x = b.update({1}, x);
  EXPECT_NEAR(x[0], 2, 1e-13);
  EXPECT_EQ(b.output(0, {1}, x)[0], 2);
}

TEST(DiscreteTransferFunctionBlock, StepResponseIsAGeometricSeriesInItsUnit) {
  const Bench b("discrete_transfer_function", {{"gain", {3}}, {"num", {0.1}}, {"den", {1, -0.9}}, {"period", {1}}});
  const Numbers y = b.response(rows(Numbers(30, 2.0)), 1);
  for (std::size_t k = 0; k < y.size(); ++k) EXPECT_NEAR(y[k], 6 * (1 - std::pow(0.9, k + 1.0)), 1e-14);
}

TEST(DiscreteTransferFunctionBlock, WithoutDirectPathItIsOneSampleLaterAndDoesNotFeedThrough) {
  const Bench at_once("discrete_transfer_function", {{"num", {0.1, 0.3}}, {"den", {1, -0.9}}, {"period", {1}}});
  const Bench later("discrete_transfer_function",
                    {{"num", {0.1, 0.3}}, {"den", {1, -0.9}}, {"direct", {1}}, {"period", {1}}});
  EXPECT_TRUE(at_once.sizes.feedthrough);
  EXPECT_FALSE(later.sizes.feedthrough);
  Numbers u;
  for (std::uint64_t k = 0; k < 30; ++k) u.push_back(random::normal(1, 0, k));
  const Numbers now = at_once.response(rows(u), 1), then = later.response(rows(u), 1);
  EXPECT_EQ(then[0], 0);
  for (std::size_t k = 1; k < u.size(); ++k) EXPECT_NEAR(then[k], now[k - 1], 1e-14);
}

TEST(DiscreteTransferFunctionBlock, StartsAtRestUnderTheInputBefore) {
  const Bench b("discrete_transfer_function",
                {{"num", {1, -0.3, 0.2}}, {"den", {2, -0.5, 0.1, 0.05}}, {"before", {3}}, {"period", {1}}});
  for (const double y : b.response(rows(Numbers(5, 3.0)), 1)) EXPECT_NEAR(y, 3 * 0.9 / 1.65, 1e-15);
}

TEST(DelayLineBlock, GivesEachSampleAfterItsCount) {
  for (const double n : {0.0, 1.0, 4.0}) {
    const Bench b("delay_line", {{"samples", {n}}, {"before", {-7}}, {"period", {1}}});
    EXPECT_EQ(b.sizes.feedthrough, n == 0);
    const Numbers y = b.response(rows({1, 2, 3, 4, 5, 6}), 1);
    for (int k = 0; k < 6; ++k) EXPECT_EQ(y[static_cast<std::size_t>(k)], k < n ? -7 : k + 1 - n);
  }
}

TEST(ConverterBlocks, HoldAndQuantize) {
  const Bench hold("sample_hold", {{"period", {1}}});
  EXPECT_EQ(hold.output(0, {0.123}), (Numbers{0.123}));
  const Bench adc("quantizer", {{"bits", {16}}, {"lower", {-10}}, {"upper", {10}}, {"period", {1}}});
  EXPECT_EQ(adc.output(0, {1.49 * 20 / 65536})[0], 20.0 / 65536);
}

TEST(Noise, IsAnotherOneInEveryBlockAndTheSameInEveryProgram) {
  // White noises that have nothing to do with each other: their correlation over n samples is about 1/sqrt(n).
  const int n = 2000;
  for (const std::string type : {"sampled_noise", "sensor_noise"}) {
    Diagram d;
    d.inputs["u"].unit = "V";
    for (const char* name : {"a", "b"}) {
      d.blocks[name].type = type;
      d.blocks[name].in = {{"", "u"}};
      d.blocks[name].parameters["rms"] = "1 V";
      d.blocks[name].parameters["period"] = "1 ms";
    }
    d.record = {"a", "b"};
    const auto trace_of = [&] {
      const auto program = compile(d, bench::registry());
      auto run = start(*program);
      bind_input(*program, run, "u", std::make_shared<const Series>(Series{{0}, {0}}));
      std::vector<double> t;
      for (int k = 0; k < n; ++k) t.push_back(1e-3 * (k + 0.5));
      return simulate(*program, run, {.instants = t}).values;
    };
    const auto first = trace_of();
    EXPECT_EQ(first, trace_of());
    double product = 0;
    for (std::size_t k = 0; k < first[0].size(); ++k) product += first[0][k] * first[1][k];
    EXPECT_LT(std::abs(product / n), 5 / std::sqrt(n)) << type;
    d.blocks["a"].parameters["seed"] = 2.0;
    const auto other = trace_of();
    EXPECT_NE(other[0], first[0]);
    EXPECT_EQ(other[1], first[1]);
  }
}

TEST(SampledNoiseBlock, DependsOnSeedAndInstantAlone) {
  Bench b("sampled_noise", {{"rms", {0.5}}, {"seed", {4}}, {"period", {1}}});
  b.hit = 17;
  EXPECT_EQ(b.output(0, {1})[0], 1 + 0.5 * random::normal(4, 2, 17));
  EXPECT_EQ(b.output(99, {1}), b.output(0, {1}));
}

// Thesis Tables 2.1, 2.2 in SI: V and m.
const Bench::Values jiles_atherton{
    {"p_s", {55.9973e-6}}, {"a", {48.5843}}, {"alpha", {0.2512e6}}, {"k", {3.8892}}, {"c", {0.6929}}};
const Bench::Values bouc_wen{{"alpha", {0.6187e-6}}, {"beta", {0.2418}}, {"gamma", {0.0237}}, {"d_p", {1.6126e-6}}};

TEST(SampledJilesAthertonInverseBlock, TakesTheScaleOfItsActuator) {
  // y = s p obeys the law with p_s s and alpha/s: the same command, to the 1e-10 of its way that both keep.
  auto scaled = jiles_atherton, other = jiles_atherton;
  const double s = 0.37;
  scaled["scale"] = {s};
  other["p_s"] = {jiles_atherton.at("p_s")[0] * s};
  other["alpha"] = {jiles_atherton.at("alpha")[0] / s};
  scaled["period"] = other["period"] = {1e-3};
  const Bench a("sampled_jiles_atherton_inverse", scaled), b("sampled_jiles_atherton_inverse", other);
  const std::vector<Numbers> wanted{{1e-6}, {2e-6}, {0.5e-6}};
  const Numbers u = a.response(wanted, 1e-3), v = b.response(wanted, 1e-3);
  for (std::size_t k = 0; k < u.size(); ++k) EXPECT_NEAR(u[k], v[k], 1e-9);
  EXPECT_GT(u[1], 3);  // V: 2 um of an actuator that makes 0.37 of the printed stroke
}

struct InverseCase {
  const char *type, *golden;
  const Bench::Values* law;
  double initial, origin;
};
class SampledInverse : public testing::TestWithParam<InverseCase> {};
TEST_P(SampledInverse, ReproducesTheGoldenCommandsInMetres) {
  const auto& c = GetParam();
  HYSTERON_NEEDS_GOLDEN(c.golden);
  const auto trace = golden::read(c.golden);
  auto values = *c.law;
  values["initial"] = {c.initial};
  values["origin"] = {c.origin};
  values["period"] = {2e-4};
  Numbers y;
  for (const double r : trace.at("yr [um]")) y.push_back(1e-6 * r);
  const Numbers u = Bench(c.type, values).response(rows(y), 2e-4);
  for (std::size_t k = 0; k < u.size(); ++k)  // ten digits of y and u, slope up to 1.5 V/um
    ASSERT_NEAR(u[k], trace.at("u [V]")[k], 1.5e-8) << "row " << k;
}
INSTANTIATE_TEST_SUITE_P(
    Traces, SampledInverse,
    testing::Values(InverseCase{"sampled_jiles_atherton_inverse", "ja_inverse_sine", &jiles_atherton, 0, 0},
                    InverseCase{"sampled_jiles_atherton_inverse", "ja_inverse_steady_triangle", &jiles_atherton, 0,
                                1.421802128e-6},
                    InverseCase{"sampled_bouc_wen_inverse", "bw_compensator_triangle", &bouc_wen, 0, 0},
                    InverseCase{"sampled_bouc_wen_inverse", "bw_compensator_steady_sine", &bouc_wen, -1.440072912e-6,
                                1.440072912e-6}),
    [](const auto& made) { return std::string(made.param.golden); });

TEST(PrandtlIshlinskiiInverseBlock, UndoesTheBlockOfTheSameParametersAndPast) {
  for (const double sides : {0.0, 1.0})
    for (const double before : {0.0, -1.3, 2.0}) {
      const Bench::Values values{{"thresholds", {0, 0.4, 1.1, 2}},
                                 {"weights", {0.7, 0.3, 0.2, -0.1}},
                                 {"sides", {sides}},
                                 {"before", {before}}};
      const Bench model("prandtl_ishlinskii", values), inverse("prandtl_ishlinskii_inverse", values);
      Numbers m = model.initial_memory(), w = inverse.initial_memory();
      for (std::uint64_t k = 0; k < 300; ++k) {
        const double u = 2 * random::normal(6, 0, k);
        m = model.advance(m, {u});
        const Numbers y = model.output(0, {u}, {}, m);
        w = inverse.advance(w, y);
        ASSERT_NEAR(inverse.output(0, y, {}, w)[0], u, 1e-13) << "move " << k;
      }
    }
}

}  // namespace
}  // namespace hysteron
