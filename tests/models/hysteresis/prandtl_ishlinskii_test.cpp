#include "models/hysteresis/prandtl_ishlinskii.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/models/golden.h"

namespace hysteron::prandtl_ishlinskii {
namespace {

using Numbers = std::vector<double>;

// Thesis Table 2.3: weights in um/V, thresholds 0.6 i in V; threshold 0 is the linear part.
const Numbers weights{0.7521, 0.1381, 0.0775, 0.0651, 0.0658, 0.0522, 0.0506, 0.0523, 0.0520, 0.1169};
Numbers thresholds() {
  Numbers r;
  for (int i = 0; i < 10; ++i) r.push_back(0.6 * i);
  return r;
}

class Walk {
 public:
  explicit Walk(Numbers memory = Numbers(10, 0.0), play::Sides sides = play::Sides::one)
      : memory_(memory), sides_(sides) {}
  double operator()(double u) {
    Numbers after(memory_.size());
    advance<double>(sides_, r_, memory_, u, after.data());
    memory_ = after;
    return prandtl_ishlinskii::output<double>(weights, memory_);
  }
  const Numbers& memory() const { return memory_; }

 private:
  Numbers r_ = thresholds();
  Numbers memory_;
  play::Sides sides_;
};

TEST(PrandtlIshlinskiiModel, TopOfTheLoopIsTheThesisValue) {
  // SPEC 2.1: H(6) = 6.64536 um for Table 2.3, five decimals printed.
  Walk walk;
  EXPECT_NEAR(walk(6), 6.64536, 1e-12);
  EXPECT_NEAR(prandtl_ishlinskii::stroke<double>(thresholds(), weights, 6.0), 6.64536, 1e-12);
}

TEST(PrandtlIshlinskiiModel, LoopAreaIsTheClosedForm) {
  // SPEC 2.1: area 3.93516 um V = sum c_i r_i (U - r_i). The walked loop is piecewise linear with corners at multiples
  // of 0.6 V, so trapezoids of 0.1 V are exact.
  EXPECT_NEAR(prandtl_ishlinskii::loop_area<double>(thresholds(), weights, 6.0), 3.93516, 1e-12);
  Walk walk;
  double area = 0, before = walk(0);
  for (int k = 1; k <= 120; ++k) {
    const double u = k <= 60 ? 0.1 * k : 0.1 * (120 - k);
    const double y = walk(u);
    area += (k <= 60 ? -0.1 : 0.1) * (y + before) / 2;
    before = y;
  }
  EXPECT_NEAR(area, 3.93516, 1e-11);
}

TEST(PrandtlIshlinskiiModel, DescendingBranchMirrorsTheAscendingOne) {
  // SPEC 2.1: y(u) = H(U) - H(U - u) on the way down from U.
  Walk walk;
  walk(6);
  for (double u = 6; u >= 0; u -= 0.25)
    EXPECT_NEAR(walk(u),
                prandtl_ishlinskii::stroke<double>(thresholds(), weights, 6.0) -
                    prandtl_ishlinskii::stroke<double>(thresholds(), weights, 6.0 - u),
                1e-14);
}

TEST(PrandtlIshlinskiiModel, RemanenceAfterTheFirstCycleIsMinusTheWeightedInitialMemory) {
  // SPEC 2.1: with w0_i in [-r_i, 0], y(T) - y(0) = -sum c_i w0_i after 0 -> 6 -> 0.
  Numbers w0;
  double expected = 0;
  for (std::size_t i = 0; i < 10; ++i) {
    w0.push_back(-0.3 * thresholds()[i]);
    expected -= weights[i] * w0[i];
  }
  Walk walk(w0);
  const double first = walk(0);
  walk(6);
  EXPECT_NEAR(walk(0) - first, expected, 1e-14);
}

TEST(PrandtlIshlinskiiModel, FirstAndLaterLoopsFromRestCoincide) {
  Walk walk;
  Numbers first, second;
  for (int k = 0; k < 240; ++k)
    (k < 120 ? first : second).push_back(walk(6 * (k % 120 < 60 ? k % 120 : 120 - k % 120) / 60.0));
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_NEAR(first[i], second[i], 1e-14);
}

TEST(PrandtlIshlinskiiModel, TwoSidedOperatorsKeepHalfTheLoopWidthAsRemanence) {
  // From the top the memory of a two-sided play of radius r is U - r; back at 0 it is min(r, U - r).
  Walk walk(Numbers(10, 0.0), play::Sides::two);
  walk(6);
  walk(0);
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_NEAR(walk.memory()[i], std::min(thresholds()[i], 6 - thresholds()[i]), 1e-15);
}

// The golden columns are rounded to ten digits: below 5e-10 in u and in y, and y changes by at most 1.43 um per V.
constexpr double golden_tolerance = 5e-10 * (1 + 1.43) + 1e-12;

class GoldenForward : public testing::TestWithParam<const char*> {};
TEST_P(GoldenForward, TraceOfTheThesisModelIsReproduced) {
  HYSTERON_NEEDS_GOLDEN(GetParam());
  const auto trace = golden::read(GetParam());
  const auto& u = trace.at("u [V]");
  Walk walk;
  for (std::size_t k = 0; k < u.size(); ++k)
    ASSERT_NEAR(walk(u[k]), trace.at("y [um]")[k], golden_tolerance) << "row " << k;
}
INSTANTIATE_TEST_SUITE_P(Traces, GoldenForward,
                         testing::Values("pi_forward_sine", "pi_forward_triangle", "pi_minor_loops"),
                         [](const auto& made) { return std::string(made.param); });

TEST(PrandtlIshlinskiiModel, GoldenTraceFromAnInitialStateIsReproduced) {
  HYSTERON_NEEDS_GOLDEN("pi_initial_state_sine");
  const auto trace = golden::read("pi_initial_state_sine");
  Numbers w0;
  for (const double r : thresholds()) w0.push_back(-0.3 * r);
  Walk walk(w0);
  for (std::size_t k = 0; k < trace.at("u [V]").size(); ++k)
    ASSERT_NEAR(walk(trace.at("u [V]")[k]), trace.at("y [um]")[k], golden_tolerance) << "row " << k;
}

TEST(PrandtlIshlinskiiModel, ManyRowsAtOnceAreTheSameAndNobodySeesAnOperatorOfWeightZero) {
  // 40 operators, more than pass together at once, two of three without weight; then none with a weight.
  for (const auto sides : {play::Sides::one, play::Sides::two})
    for (const int keep : {1, 3, 100}) {
      Numbers r, c, w(40, 0.0), row_by_row(40, 0.0), moved(40), u, y(300);
      for (int i = 0; i < 40; ++i) {
        r.push_back(0.1 * i);
        c.push_back(i % keep == 0 && keep < 100 ? 0.01 * (i + 1) : 0.0);
      }
      for (int k = 0; k < 300; ++k) u.push_back((3 + 0.005 * k) * std::sin(0.13 * k));
      for (const int first : {0, 120})  // two chunks: what counts is remembered
        prandtl_ishlinskii::pass(sides, r, c, w.data(), u.data() + first, y.data() + first, 1, first == 0 ? 120 : 180);
      for (int k = 0; k < 300; ++k) {
        const auto i = static_cast<std::size_t>(k);
        prandtl_ishlinskii::advance(sides, std::span<const double>(r), std::span<const double>(row_by_row), u[i],
                                    moved.data());
        row_by_row = moved;
        const double one = prandtl_ishlinskii::output(std::span<const double>(c), std::span<const double>(row_by_row));
        EXPECT_NEAR(y[i], one, 1e-13) << k;  // the sum of 40 numbers below 1.5 in another order
      }
    }
}

}  // namespace
}  // namespace hysteron::prandtl_ishlinskii
