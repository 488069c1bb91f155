// Blocks with modes, one by one: what follows an event may stay, and the modes are those of the models.
#include <gtest/gtest.h>

#include <cmath>

#include "models/continuous/rate_limiter.h"
#include "models/continuous/tank.h"
#include "models/mechanics/friction.h"
#include "models/mechanics/hard_stop.h"
#include "models/random.h"
#include "tests/blocks/samples.h"

namespace hysteron {
namespace {

using bench::Bench;
using bench::Numbers;

class ModeLaw : public testing::TestWithParam<bench::Sample> {};
TEST_P(ModeLaw, FromAnywhereTheModesSettleAndStay) {
  Bench b(GetParam().type, GetParam().values, GetParam().inputs);
  b.mode = b.initial_mode();
  Numbers x = b.initial_states();
  for (std::uint64_t k = 0; k < 500; ++k) {  // inputs and states jump about; settle() throws if a mode names itself
    const Numbers u{3 * random::normal(1, 0, k)};
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = 1.5 * random::normal(1, 1 + i, k);
    b.settle(u, x);
    ASSERT_GT(b.guard(u, x), 0);
    ASSERT_EQ(b.settle(u, x), 0) << "asking twice changes nothing";
  }
}
INSTANTIATE_TEST_SUITE_P(Blocks, ModeLaw,
                         testing::ValuesIn(bench::samples_where([](const Bench& b) { return b.kernel.has_modes(); })),
                         bench::sample_name);

TEST(RelayBlock, SwitchesWithHysteresisFromWhatItWasBefore) {
  Bench b("relay", {{"on_at", {1}}, {"off_at", {-1}}, {"on_value", {5}}, {"off_value", {2}}, {"initial", {1}}});
  b.mode = b.initial_mode();
  Numbers none;
  const double u[] = {0, -1.5, 0, 1.5, 0}, expected[] = {5, 2, 2, 5, 5};
  for (int k = 0; k < 5; ++k) {
    b.settle({u[k]}, none);
    EXPECT_EQ(b.output(0, {u[k]})[0], expected[k]) << k;
  }
  EXPECT_EQ(b.sizes.smoothness, Smoothness::jumps);
}

TEST(MassWithFrictionBlock, SticksSlidesAndTurnsAsItsForceSays) {
  Bench b("mass_with_friction", {{"mass", {0.5}}, {"coulomb", {2}}, {"breakaway", {3}}});
  b.mode = b.initial_mode();
  Numbers x{0.1, 0};
  b.settle({2.9}, x);
  EXPECT_EQ(b.mode, friction::stick);
  EXPECT_EQ(b.derivative({2.9}, x), (Numbers{0, 0}));
  b.settle({-3.5}, x);
  EXPECT_EQ(b.mode, friction::slide_down);
  EXPECT_EQ(b.derivative({-3.5}, x), (Numbers{0, -3}));  // (-3.5 + 2)/0.5
  x = {0.05, 2e-9};                                      // has come to rest and a little beyond
  b.settle({-1}, x);
  EXPECT_EQ(b.mode, friction::stick);
  EXPECT_EQ(x, (Numbers{0.05, 0}));
  EXPECT_FALSE(b.sizes.feedthrough);
}

TEST(MassWithFrictionBlock, BeginsSlidingWithAnInitialVelocity) {
  const Bench b("mass_with_friction",
                {{"mass", {1}}, {"coulomb", {1}}, {"breakaway", {1}}, {"initial_velocity", {-2}}});
  EXPECT_EQ(b.initial_mode(), friction::slide_down);
  EXPECT_EQ(b.initial_states(), (Numbers{0, -2}));
}

TEST(MassWithStopsBlock, BouncesAndComesToLie) {
  Bench b("mass_with_stops", {{"mass", {1}}, {"lower", {-1}}, {"upper", {1}}, {"restitution", {0.5}}});
  b.mode = b.initial_mode();
  Numbers x{1 + 1e-11, 4};
  EXPECT_EQ(b.settle({10}, x), 1);
  EXPECT_EQ(x, (Numbers{1, -2}));
  x = {1 + 1e-11, 1e-6};
  b.settle({10}, x);
  EXPECT_EQ(b.mode, hard_stop::at_upper);
  EXPECT_EQ(b.derivative({10}, x), (Numbers{0, 0}));
  b.settle({-1}, x);
  EXPECT_EQ(b.derivative({-1}, x), (Numbers{0, -1}));
}

TEST(CurrentLimitBlock, IsTheRateLimiterOfCurrentOverCapacitance) {
  // 60 mA into 2.6 uF: 23.1 V/ms.
  Bench current("current_limit", {{"source", {0.06}}, {"sink", {0.03}}, {"capacitance", {2.6e-6}}});
  Bench rate("rate_limiter", {{"rise", {0.06 / 2.6e-6}}, {"fall", {0.03 / 2.6e-6}}});
  for (int mode = 0; mode < 3; ++mode) {
    current.mode = rate.mode = mode;
    EXPECT_NEAR(current.derivative({100}, {20})[0], rate.derivative({100}, {20})[0], 1e-9);
  }
  rate.mode = rate_limiter::rising;
  EXPECT_NEAR(rate.derivative({100}, {20})[0], 23076.923, 1e-3);
  EXPECT_EQ(rate.rest({7}), (Numbers{7}));
}

TEST(TankBlock, FillsSpillsAndIsPumpedEmpty) {
  Bench b("tank", {{"area", {2}}, {"outlet", {0.5}}, {"reference", {1}}, {"brim", {4}}, {"law", {1}}});
  Numbers x{4 + 2e-9, 0.25};
  EXPECT_EQ(b.derivative({3}, {1, 0}), (Numbers{1.25, 0}));  // (3 - 0.5)/2
  b.settle({3}, x);
  EXPECT_EQ(b.mode, tank::full);
  EXPECT_EQ(x, (Numbers{4, 0.25}));
  EXPECT_EQ(b.derivative({3}, x), (Numbers{0, 2}));      // 3 - 0.5 sqrt(4) runs over
  EXPECT_EQ(b.output(0, {}, x), (Numbers{4, 1, 0.25}));  // level, outflow, spilled
  b.settle({0.5}, x);
  EXPECT_EQ(b.mode, tank::open);
  x = {-2e-9, 0.25};
  b.settle({-1}, x);
  EXPECT_EQ(b.mode, tank::empty);
  EXPECT_EQ(b.derivative({-1}, x), (Numbers{0, 0}));
  EXPECT_EQ(b.rest({1})[0], 4);  // (1/0.5)^2
  EXPECT_FALSE(b.sizes.feedthrough);
}

TEST(TankBlock, WithoutBrimNeverSpills) {
  Bench b("tank", {{"area", {2}}, {"outlet", {0.5}}, {"reference", {1}}});
  EXPECT_GT(b.guard({3}, {1e9, 0}), 0);
}

}  // namespace
}  // namespace hysteron
