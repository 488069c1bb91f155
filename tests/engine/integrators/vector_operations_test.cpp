// SUNDIALS' vector operations, called as SUNDIALS calls them, against plain loops: the same bits.
#include "engine/integrators/vector_operations.h"

#include <gtest/gtest.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>

#include <array>
#include <cmath>
#include <vector>

namespace hysteron {
namespace {

using Numbers = std::vector<double>;

/// Lengths with loops of their own, the first without, multiples of the number of partial sums and not.
class EachLength : public testing::TestWithParam<int> {
 protected:
  EachLength() { SUNContext_Create(nullptr, &context_); }
  ~EachLength() override {
    for (N_Vector v : made_) N_VDestroy(v);
    SUNContext_Free(&context_);
  }
  N_Vector vector(double seed) {
    const N_Vector v = N_VNew_Serial(GetParam(), context_);
    use_own_operations(v);
    made_.push_back(N_VClone(v));  // a clone computes with the same operations
    N_VDestroy(v);
    for (int i = 0; i < GetParam(); ++i) NV_Ith_S(made_.back(), i) = std::sin(seed + 1.7 * i) * std::exp(0.01 * i);
    return made_.back();
  }
  static Numbers numbers(N_Vector v) { return {NV_DATA_S(v), NV_DATA_S(v) + NV_LENGTH_S(v)}; }
  template <class F>
  Numbers each(F f) const {
    Numbers n;
    for (int i = 0; i < GetParam(); ++i) n.push_back(f(static_cast<std::size_t>(i)));
    return n;
  }

 private:
  SUNContext context_ = nullptr;
  std::vector<N_Vector> made_;
};
INSTANTIATE_TEST_SUITE_P(VectorOperations, EachLength,
                         testing::Values(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 23, 1000));

TEST_P(EachLength, EveryOperationHasItsOwnFunction) {
  const N_Vector own = vector(1);
  SUNContext context = own->sunctx;
  const N_Vector stock = N_VNew_Serial(GetParam(), context);
  EXPECT_NE(own->ops->nvlinearsum, stock->ops->nvlinearsum);
  EXPECT_NE(own->ops->nvwrmsnorm, stock->ops->nvwrmsnorm);
  EXPECT_NE(own->ops->nvlinearcombination, stock->ops->nvlinearcombination);
  N_VDestroy(stock);
}

TEST_P(EachLength, ElementwiseOperations) {
  const N_Vector x = vector(1), y = vector(2), z = vector(3);
  const auto a = numbers(x), b = numbers(y);
  N_VLinearSum(2.5, x, -0.3, y, z);
  EXPECT_EQ(numbers(z), each([&](auto i) { return 2.5 * a[i] + -0.3 * b[i]; }));
  N_VConst(7, z);
  EXPECT_EQ(numbers(z), each([](auto) { return 7.0; }));
  N_VProd(x, y, z);
  EXPECT_EQ(numbers(z), each([&](auto i) { return a[i] * b[i]; }));
  N_VDiv(x, y, z);
  EXPECT_EQ(numbers(z), each([&](auto i) { return a[i] / b[i]; }));
  N_VScale(3, x, z);
  EXPECT_EQ(numbers(z), each([&](auto i) { return 3 * a[i]; }));
  N_VAbs(x, z);
  EXPECT_EQ(numbers(z), each([&](auto i) { return std::abs(a[i]); }));
  N_VInv(x, z);
  EXPECT_EQ(numbers(z), each([&](auto i) { return 1 / a[i]; }));
  N_VAddConst(x, 0.25, z);
  EXPECT_EQ(numbers(z), each([&](auto i) { return a[i] + 0.25; }));
  const Numbers absolute = each([](auto i) { return 1e-8 * (1.0 + static_cast<double>(i)); });
  error_weights(1e-6, absolute.data(), x, z);
  EXPECT_EQ(numbers(z), each([&](auto i) { return 1 / (1e-6 * std::abs(a[i]) + absolute[i]); }));
}

TEST_P(EachLength, TheResultMayReplaceAnOperand) {
  const N_Vector x = vector(1), y = vector(2);
  const auto a = numbers(x), b = numbers(y);
  N_VLinearSum(1, x, 1, y, y);
  EXPECT_EQ(numbers(y), each([&](auto i) { return a[i] + b[i]; }));
  const N_Vector z = vector(2);
  N_VLinearSum(2, z, -1, x, z);
  EXPECT_EQ(numbers(z), each([&](auto i) { return 2 * b[i] - a[i]; }));
  std::array<double, 3> c{0.5, 3, -2};
  std::array<N_Vector, 3> all{vector(4), vector(5), vector(6)};
  const auto p = numbers(all[0]), q = numbers(all[1]), r = numbers(all[2]);
  N_VLinearCombination(3, c.data(), all.data(), all[1]);
  EXPECT_EQ(numbers(all[1]), each([&](auto i) { return 0.5 * p[i] + 3 * q[i] + -2 * r[i]; }));
}

TEST_P(EachLength, SumsHaveAFixedOrder) {
  const N_Vector x = vector(1), y = vector(2);
  const auto a = numbers(x), b = numbers(y);
  const auto sum = [&](auto term) {
    if (GetParam() <= 10) {
      double s = 0;
      for (std::size_t i = 0; i < a.size(); ++i) s += term(i);
      return s;
    }
    std::array<double, 8> s{};
    for (std::size_t i = 0; i < a.size(); ++i) s[i % 8] += term(i);
    return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
  };
  EXPECT_EQ(N_VDotProd(x, y), sum([&](auto i) { return a[i] * b[i]; }));
  const double squares = sum([&](auto i) { return (a[i] * b[i]) * (a[i] * b[i]); });
  EXPECT_EQ(N_VWrmsNorm(x, y), std::sqrt(squares / GetParam()));
  double largest = 0;
  for (const double v : a) largest = std::max(largest, std::abs(v));
  EXPECT_EQ(N_VMaxNorm(x), largest);
}

TEST_P(EachLength, ArraysOfVectors) {
  std::array<N_Vector, 2> x{vector(1), vector(2)}, y{vector(3), vector(4)}, z{vector(5), vector(6)};
  const auto a = numbers(x[0]), b = numbers(x[1]), c = numbers(y[0]), d = numbers(y[1]);
  std::array<double, 2> factor{2, -3}, norm{};
  N_VScaleAddMulti(2, factor.data(), x[0], y.data(), z.data());
  EXPECT_EQ(numbers(z[1]), each([&](auto i) { return -3 * a[i] + d[i]; }));
  N_VLinearSumVectorArray(2, 2, x.data(), 0.5, y.data(), z.data());
  EXPECT_EQ(numbers(z[0]), each([&](auto i) { return 2 * a[i] + 0.5 * c[i]; }));
  EXPECT_EQ(numbers(z[1]), each([&](auto i) { return 2 * b[i] + 0.5 * d[i]; }));
  N_VScaleVectorArray(2, factor.data(), x.data(), z.data());
  EXPECT_EQ(numbers(z[1]), each([&](auto i) { return -3 * b[i]; }));
  N_VWrmsNormVectorArray(2, x.data(), y.data(), norm.data());
  EXPECT_EQ(norm[1], N_VWrmsNorm(x[1], y[1]));
  std::array<N_Vector*, 2> both{x.data(), y.data()};
  N_VLinearCombinationVectorArray(2, 2, factor.data(), both.data(), z.data());
  EXPECT_EQ(numbers(z[0]), each([&](auto i) { return 2 * a[i] + -3 * c[i]; }));
  EXPECT_EQ(numbers(z[1]), each([&](auto i) { return 2 * b[i] + -3 * d[i]; }));
  std::array<N_Vector, 2> w{vector(7), vector(8)};
  std::array<N_Vector*, 2> results{z.data(), w.data()};
  N_VScaleAddMultiVectorArray(2, 2, factor.data(), x.data(), both.data(), results.data());
  EXPECT_EQ(numbers(z[1]), each([&](auto i) { return 2 * b[i] + b[i]; }));
  EXPECT_EQ(numbers(w[0]), each([&](auto i) { return -3 * a[i] + c[i]; }));
  N_VConstVectorArray(2, 4, z.data());
  EXPECT_EQ(numbers(z[1]), each([](auto) { return 4.0; }));
}

}  // namespace
}  // namespace hysteron
