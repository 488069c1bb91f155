// All versions of a loop over lanes give the same bits. Compiled as the program is (CMakeLists.txt): without
// optimization there is one version only.
#include "engine/block/simd_dispatch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "blocks/hysteresis/jiles_atherton.h"
#include "engine/block/block_lanes.h"
#include "models/random.h"

namespace hysteron {
namespace {

constexpr int lanes = 64;

std::vector<double> drawn(std::size_t n, std::uint64_t stream, double scale) {
  std::vector<double> v;
  for (std::size_t i = 0; i < n; ++i) v.push_back(scale * random::normal(3, stream, i));
  return v;
}

/// A law of an actuator, with tanh, quotients and a choice by sign.
TEST(SimdDispatch, VersionsOfALawGiveTheSameBits) {
  using Loop = block_detail::OverLanes<block_detail::DerivativeOfLanes<blocks::JilesAtherton>>;
  constexpr std::size_t numbers = sizeof(blocks::JilesAtherton::Params<double>) / sizeof(double);
  const auto p = drawn(numbers * lanes, 1, 1), x = drawn(lanes, 2, 3), u = drawn(lanes, 3, 5), du = drawn(lanes, 4, 1);
  const double *in = u.data(), *rate = du.data();
  std::vector<std::vector<double>> results;
  for (const auto version : SimdDispatch<Loop>::versions()) {
    results.emplace_back(lanes);
    LanesView v;
    v.lanes = lanes;
    v.p = p.data();
    v.x = x.data();
    v.u = &in;
    v.du = &rate;
    v.out = results.back().data();
    version(v);
    EXPECT_EQ(std::memcmp(results.back().data(), results.front().data(), lanes * sizeof(double)), 0) << results.size();
  }
}

struct Functions {
  struct Arguments {
    const double* x;
    double* y;
  };
  static void run(const Arguments& a) {
    for (int l = 0; l < lanes; ++l) {
      const Lane x(a.x[l]);
      a.y[l] = (exp(x) + tanh(x) * log(abs(x)) + pow(abs(x), 1.7)).v;
    }
  }
};

TEST(SimdDispatch, VersionsOfTheFunctionsGiveTheSameBits) {
  for (const double scale : {1e-3, 1.0, 100.0}) {
    const auto x = drawn(lanes, 5, scale);
    std::vector<std::vector<double>> results;
    for (const auto version : SimdDispatch<Functions>::versions()) {
      results.emplace_back(lanes);
      version({x.data(), results.back().data()});
      EXPECT_EQ(std::memcmp(results.back().data(), results.front().data(), lanes * sizeof(double)), 0);
    }
  }
}

TEST(SimdDispatch, ThisTestSeesMoreThanOneVersionWhereTheProcessorHasThem) {
#if defined(__x86_64__)
  EXPECT_EQ(SimdDispatch<Functions>::versions().size() > 1,
            __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"));
#else
  EXPECT_EQ(SimdDispatch<Functions>::versions().size(), 1U);
#endif
}

}  // namespace
}  // namespace hysteron
