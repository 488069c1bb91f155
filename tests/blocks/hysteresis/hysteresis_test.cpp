#include <gtest/gtest.h>

#include <cmath>

#include "models/random.h"
#include "tests/blocks/samples.h"
#include "tests/models/golden.h"

namespace hysteron {
namespace {

using bench::Bench;
using bench::Numbers;

// Thesis Table 2.3 in SI: V and m/V.
Bench thesis_model(double before = 0) {
  Numbers weights{0.7521, 0.1381, 0.0775, 0.0651, 0.0658, 0.0522, 0.0506, 0.0523, 0.0520, 0.1169}, thresholds;
  for (double& w : weights) w *= 1e-6;
  for (int i = 0; i < 10; ++i) thresholds.push_back(0.6 * i);
  return Bench("prandtl_ishlinskii", {{"thresholds", thresholds}, {"weights", weights}, {"before", {before}}});
}

class MemoryLaw : public testing::TestWithParam<bench::Sample> {
 protected:
  /// The drive; what else a block reads (a temperature) stays as it is.
  static Numbers inputs(const Bench& b, double drive) {
    Numbers u(static_cast<std::size_t>(b.n_u), 1.5);
    u[0] = drive;
    return u;
  }
};
TEST_P(MemoryLaw, AcceptingAPointChangesNoSignalThere) {
  const Bench b(GetParam().type, GetParam().values, GetParam().inputs);
  Numbers m = b.initial_memory();
  for (std::uint64_t k = 0; k < 300; ++k) {
    const Numbers u = inputs(b, 2 * random::normal(1, 0, k));
    const Numbers once = b.advance(m, u), twice = b.advance(once, u);
    const Numbers x(static_cast<std::size_t>(b.states()), 0.7);
    ASSERT_EQ(b.output(0, u, x, twice)[0], b.output(0, u, x, once)[0]);
    ASSERT_EQ(once, twice);
    m = once;
  }
}
TEST_P(MemoryLaw, AMonotoneMoveMayBeCutAnywhere) {
  const Bench b(GetParam().type, GetParam().values, GetParam().inputs);
  Numbers m = b.advance(b.initial_memory(), inputs(b, 0));
  double u = 0;
  for (std::uint64_t k = 0; k < 300; ++k) {
    const double next = 2 * random::normal(2, 0, k), halfway = u + 0.37 * (next - u);
    const Numbers at_once = b.advance(m, inputs(b, next));
    ASSERT_EQ(b.advance(b.advance(m, inputs(b, halfway)), inputs(b, next)), at_once);
    m = at_once;
    u = next;
  }
}
INSTANTIATE_TEST_SUITE_P(Blocks, MemoryLaw,
                         testing::ValuesIn(bench::samples_where([](const Bench& b) { return b.sizes.memory > 0; })),
                         bench::sample_name);

TEST(GeneralizedPrandtlIshlinskiiBlock, WithAStraightCurveIsThePlainOne) {
  for (const double sides : {0.0, 1.0}) {
    const Bench::Values operators{{"thresholds", {0, 0.3, 0.8}}, {"weights", {1.2, 0.4, 0.3}}, {"sides", {sides}}};
    auto with_curve = operators;
    with_curve["lower"] = {-1};
    with_curve["upper"] = {2};
    with_curve["slope_at_lower"] = with_curve["slope_at_upper"] = {1};
    const Bench plain("prandtl_ishlinskii", operators), bent("generalized_prandtl_ishlinskii", with_curve);
    Numbers a = plain.initial_memory(), b = bent.initial_memory();
    for (std::uint64_t k = 0; k < 100; ++k) {
      const Numbers u{2 * random::normal(3, 0, k)};
      a = plain.advance(a, u);
      b = bent.advance(b, u);
      ASSERT_NEAR(bent.output(0, u, {}, b)[0], plain.output(0, u, {}, a)[0], 1e-14) << k;
    }
  }
}

TEST(GeneralizedPrandtlIshlinskiiBlock, ItsLoopsFollowTheCurveAndItsLinearPartTheDrive) {
  const Bench b("generalized_prandtl_ishlinskii", {{"thresholds", {0, 0.5}},
                                                   {"weights", {2, 3}},
                                                   {"lower", {0}},
                                                   {"upper", {2}},
                                                   {"slope_at_lower", {0}},
                                                   {"slope_at_upper", {1.5}}});
  // In its middle the curve stands at half the range, less an eighth of the difference of the slopes times it.
  const double middle = 1 - 2 * 1.5 / 8;
  Numbers m = b.advance(b.initial_memory(), {1});
  EXPECT_NEAR(b.output(0, {1}, {}, m)[0], 2 * 1 + 3 * (middle - 0.5), 1e-15);
  m = b.advance(m, {2});
  EXPECT_NEAR(b.output(0, {2}, {}, m)[0], 2 * 2 + 3 * (2 - 0.5), 1e-15);
  m = b.advance(m, {1});  // back by more than the threshold along the curve: it follows
  EXPECT_NEAR(b.output(0, {1}, {}, m)[0], 2 * 1 + 3 * middle, 1e-15);
}

TEST(PrandtlIshlinskiiBlock, ReproducesTheGoldenTraceInMetres) {
  HYSTERON_NEEDS_GOLDEN("pi_forward_sine");
  const auto trace = golden::read("pi_forward_sine");
  const Bench b = thesis_model();
  const Bench drive("sine", {{"amplitude", {3}}, {"offset", {3}}, {"frequency", {5}}, {"phase", {-M_PI / 2}}});
  Numbers m = b.initial_memory();
  for (std::size_t k = 0; k < trace.at("t [s]").size(); ++k) {
    const Numbers u = drive.output(trace.at("t [s]")[k]);
    m = b.advance(m, u);
    // ten digits of numbers up to 6.6 um: 5e-10 um; the times are short decimals
    ASSERT_NEAR(b.output(0, u, {}, m)[0], 1e-6 * trace.at("y [um]")[k], 6e-16) << "row " << k;
  }
}

TEST(PrandtlIshlinskiiBlock, AnInputVisitedBeforeTheStartLeavesARemanenceThatTheFirstCycleTakesAway) {
  // Visiting -1 V leaves w_i = max(-r_i, -1) at u = 0, so y(T) - y(0) = -sum c_i w_i (SPEC 2.1).
  const Bench b = thesis_model(-1);
  double expected = 0;
  for (int i = 1; i < 10; ++i) expected += b.p[static_cast<std::size_t>(10 + i)] * std::min(0.6 * i, 1.0);
  Numbers m = b.advance(b.initial_memory(), {0});
  const double first = b.output(0, {0}, {}, m)[0];
  m = b.advance(m, {6});
  m = b.advance(m, {0});
  EXPECT_NEAR(b.output(0, {0}, {}, m)[0] - first, expected, 1e-20);
}

TEST(PrandtlIshlinskiiBlock, OneSidedOperatorsForgetAPositivePastAtZero) {
  const Bench fresh = thesis_model(0), used = thesis_model(5);
  EXPECT_EQ(fresh.advance(fresh.initial_memory(), {0}), used.advance(used.initial_memory(), {0}));
}

TEST(PrandtlIshlinskiiBlock, ThresholdZeroIsTheLinearPart) {
  for (const double sides : {0.0, 1.0}) {
    const Bench b("prandtl_ishlinskii", {{"thresholds", {0}}, {"weights", {2.5}}, {"sides", {sides}}});
    for (const double u : {3.0, -4.0, 1.0}) EXPECT_EQ(b.output(0, {u}, {}, b.advance({0.7}, {u}))[0], 2.5 * u);
  }
}

TEST(PlayBlock, IsTheSingleOperatorOfPrandtlIshlinskii) {
  const Bench one("play", {{"radius", {0.4}}, {"sides", {1}}}), two("play", {{"radius", {0.4}}});
  const Bench many_one("prandtl_ishlinskii", {{"thresholds", {0.4}}, {"weights", {1}}});
  const Bench many_two("prandtl_ishlinskii", {{"thresholds", {0.4}}, {"weights", {1}}, {"sides", {1}}});
  Numbers m1{0}, m2{0}, n1{0}, n2{0};
  for (std::uint64_t k = 0; k < 100; ++k) {
    const Numbers u{random::normal(4, 0, k)};
    m1 = one.advance(m1, u);
    m2 = two.advance(m2, u);
    n1 = many_one.advance(n1, u);
    n2 = many_two.advance(n2, u);
    ASSERT_EQ(m1, n1);
    ASSERT_EQ(m2, n2);
  }
}

TEST(PlayBlock, StartsFromZeroByWayOfTheInputVisitedBefore) {
  EXPECT_EQ(Bench("play", {{"radius", {1}}, {"before", {5}}}).initial_memory()[0], 4);
  EXPECT_EQ(Bench("play", {{"radius", {1}}, {"before", {-5}}}).initial_memory()[0], -4);
  EXPECT_EQ(Bench("play", {{"radius", {1}}}).initial_memory()[0], 0);
}

TEST(BoucWenBlock, IsDrivenByTheRateOfItsInput) {
  const Bench b("bouc_wen", {{"alpha", {1}}, {"beta", {3}}, {"gamma", {1}}, {"d_p", {2}}});
  EXPECT_TRUE(b.kernel.derivative_wants_rate);
  EXPECT_TRUE(b.kernel.declaration.is_rate_independent);
  EXPECT_EQ(b.derivative({7}, {0.1}, {0})[0], 0);
  EXPECT_NEAR(b.derivative({7}, {0.25}, {5})[0], 0, 1e-15);  // z = alpha/(beta + gamma)
  EXPECT_EQ(b.derivative({7}, {0.1}, {6})[0], 3 * b.derivative({7}, {0.1}, {2})[0]);
  EXPECT_EQ(b.output(0, {7}, {0.1})[0], 2 * 7 - 0.1);
}

TEST(BoucWenBlock, ParametersInMicrometresAndInMetresDescribeOneLoop) {
  // n = 2, z in um with scale 1 um, must be the same law as all in metres with beta referred to the same scale.
  const Bench um(
      "bouc_wen",
      {{"alpha", {0.6}}, {"beta", {0.24}}, {"gamma", {0.02}}, {"d_p", {1.6}}, {"exponent", {2}}, {"scale", {1}}});
  const Bench m("bouc_wen", {{"alpha", {0.6e-6}},
                             {"beta", {0.24}},
                             {"gamma", {0.02}},
                             {"d_p", {1.6e-6}},
                             {"exponent", {2}},
                             {"scale", {1e-6}}});
  for (const double z : {-0.8, 0.3})
    EXPECT_NEAR(m.derivative({0}, {1e-6 * z}, {1.3})[0], 1e-6 * um.derivative({0}, {z}, {1.3})[0], 1e-21);
}

}  // namespace
}  // namespace hysteron
