#include "models/compensators/prandtl_ishlinskii_inverse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/block/dual.h"
#include "models/hysteresis/prandtl_ishlinskii.h"
#include "models/random.h"
#include "tests/models/golden.h"

namespace hysteron {
namespace {

using Numbers = std::vector<double>;
using play::Sides;

// Thesis Table 2.3.
const Numbers weights{0.7521, 0.1381, 0.0775, 0.0651, 0.0658, 0.0522, 0.0506, 0.0523, 0.0520, 0.1169};
Numbers thresholds() {
  Numbers r;
  for (int i = 0; i < 10; ++i) r.push_back(0.6 * i);
  return r;
}

struct Model {
  Sides sides;
  Numbers r, c, w;
  double operator()(double u) {
    Numbers after(w.size());
    prandtl_ishlinskii::advance<double>(sides, r, w, u, after.data());
    w = after;
    return prandtl_ishlinskii::output<double>(c, w);
  }
};
Model inverse_of(const Model& m) {
  const std::size_t n = m.r.size();
  Model inverse{m.sides, Numbers(n), Numbers(n), Numbers(n)};
  prandtl_ishlinskii::inverse_thresholds<double>(m.r, m.c, inverse.r.data());
  prandtl_ishlinskii::inverse_weights<double>(m.c, inverse.c.data());
  prandtl_ishlinskii::inverse_memory<double>(m.c, m.w, inverse.w.data());
  return inverse;
}

TEST(PrandtlIshlinskiiInverse, ParametersAreThoseOfTheCorrectedThesis) {
  // Claim C2-03, five digits.
  const Model inverse = inverse_of({Sides::one, thresholds(), weights, Numbers(10, 0.0)});
  EXPECT_NEAR(inverse.r[1], 0.45126, 1e-12);
  EXPECT_NEAR(inverse.r[9], 5.7918, 1e-12);
  EXPECT_NEAR(inverse.c[0], 1.32961, 1e-5);
  EXPECT_NEAR(inverse.c[9], -0.06293, 1e-5);
}

TEST(PrandtlIshlinskiiInverse, GoldenParametersAreReproduced) {
  HYSTERON_NEEDS_GOLDEN("pi_inverse_parameters");
  const auto rows = golden::read("pi_inverse_parameters");
  const Model inverse = inverse_of({Sides::one, thresholds(), weights, Numbers(10, 0.0)});
  for (std::size_t j = 0; j < 10; ++j) {  // ten digits
    EXPECT_NEAR(inverse.r[j], rows.at("r' [um]")[j], 3e-9);
    EXPECT_NEAR(inverse.c[j], rows.at("c' [V/um]")[j], 1e-9);
  }
}

TEST(PrandtlIshlinskiiInverse, InverseOfTheInverseIsTheModel) {
  const Model model{Sides::two, thresholds(), weights, Numbers(10, 0.0)};
  const Model twice = inverse_of(inverse_of(model));
  for (std::size_t j = 0; j < 10; ++j) {
    EXPECT_NEAR(twice.r[j], model.r[j], 1e-14);
    EXPECT_NEAR(twice.c[j], model.c[j], 1e-14);
  }
}

TEST(PrandtlIshlinskiiInverse, UndoesRandomMinorLoopsFromAnyMemoryThatAnInputLeft) {
  // Claim C2-02: P^-1(P(u)) = u within 1e-12 V.
  for (const Sides sides : {Sides::one, Sides::two}) {
    Model model{sides, thresholds(), weights, Numbers(10, 0.0)};
    for (const double u : {-4.0, 2.5, -1.0}) model(u);  // the past, unknown to the inverse but for the memory
    Model inverse = inverse_of(model);
    for (std::uint64_t k = 0; k < 1000; ++k) {
      const double u = 6 * random::uniform(3, 0, k) - 2;
      ASSERT_NEAR(inverse(model(u)), u, 1e-12) << "move " << k;
    }
  }
}

TEST(PrandtlIshlinskiiInverse, MemoryLeftOutIsAnErrorAsLargeAsTheThesisWarns) {
  // Erratum E-07: zero inverse states for w0 = -0.3 r leave an error of 0.16 V.
  Numbers w0;
  for (const double r : thresholds()) w0.push_back(-0.3 * r);
  Model model{Sides::one, thresholds(), weights, w0};
  Model inverse = inverse_of({Sides::one, thresholds(), weights, Numbers(10, 0.0)});
  double furthest = 0;
  for (int k = 0; k <= 1200; ++k) {
    const double u = k <= 600 ? k * 0.01 : (1200 - k) * 0.01;
    furthest = std::fmax(furthest, std::fabs(inverse(model(u)) - u));
  }
  EXPECT_GT(furthest, 0.1);
}

TEST(PrandtlIshlinskiiInverse, OutputFromTheModelsWeightsIsTheSumOverTheInverseOnes) {
  const Model inverse = inverse_of({Sides::one, thresholds(), weights, Numbers(10, 0.0)});
  Numbers w;
  for (std::uint64_t j = 0; j < 10; ++j) w.push_back(random::normal(4, 0, j));
  EXPECT_NEAR(prandtl_ishlinskii::inverse_output<double>(weights, w), prandtl_ishlinskii::output<double>(inverse.c, w),
              1e-14);
}

TEST(PrandtlIshlinskiiInverse, SlopesThatStopRisingAreCounted) {
  EXPECT_EQ(prandtl_ishlinskii::rising_slopes<double>(weights), 10u);
  EXPECT_EQ(prandtl_ishlinskii::rising_slopes<double>(Numbers{1, -0.5, -0.6, 3}), 2u);
  EXPECT_EQ(prandtl_ishlinskii::rising_slopes<double>(Numbers{0, 1}), 0u);
}

TEST(PrandtlIshlinskiiInverse, DualCarriesTheDerivativeByAWeight) {
  // r'_1 = c_0 r_1, c'_0 = 1/c_0, c'_1 = 1/(c_0 + c_1) - 1/c_0.
  const std::vector<Dual> r{0.0, 1.0}, c{{2.0, 1.0}, 3.0};
  std::vector<Dual> inverse(2);
  prandtl_ishlinskii::inverse_thresholds<Dual>(r, c, inverse.data());
  EXPECT_EQ(inverse[1].rate, 1);
  prandtl_ishlinskii::inverse_weights<Dual>(c, inverse.data());
  EXPECT_NEAR(inverse[0].rate, -0.25, 1e-16);
  EXPECT_NEAR(inverse[1].rate, -1.0 / 25 + 0.25, 1e-16);
}

class GoldenInverse : public testing::TestWithParam<const char*> {};
TEST_P(GoldenInverse, TraceIsReproduced) {
  HYSTERON_NEEDS_GOLDEN(GetParam());
  const auto trace = golden::read(GetParam());
  Model inverse = inverse_of({Sides::one, thresholds(), weights, Numbers(10, 0.0)});
  for (std::size_t k = 0; k < trace.at("u [V]").size(); ++k)  // ten digits of y (slope 1.33 V/um) and of u
    ASSERT_NEAR(inverse(trace.at("yr [um]")[k]), trace.at("u [V]")[k], 1.2e-9) << "row " << k;
}
INSTANTIATE_TEST_SUITE_P(Traces, GoldenInverse, testing::Values("pi_inverse_sine", "pi_inverse_triangle"),
                         [](const auto& made) { return std::string(made.param); });

TEST(PrandtlIshlinskiiInverse, GoldenTraceFromAnInitialStateIsUndone) {
  HYSTERON_NEEDS_GOLDEN("pi_initial_state_sine");
  const auto trace = golden::read("pi_initial_state_sine");
  Numbers w0;
  for (const double r : thresholds()) w0.push_back(-0.3 * r);
  Model inverse = inverse_of({Sides::one, thresholds(), weights, w0});
  for (std::size_t k = 0; k < trace.at("u [V]").size(); ++k)
    ASSERT_NEAR(inverse(trace.at("y [um]")[k]), trace.at("P^-1(y) [V]")[k], 5e-9) << "row " << k;
}

}  // namespace
}  // namespace hysteron
