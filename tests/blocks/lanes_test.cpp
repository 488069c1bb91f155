// The functions of every block in lanes: the same numbers as its functions for one run.
#include <gtest/gtest.h>

#include <cmath>

#include "models/random.h"
#include "tests/blocks/samples.h"

namespace hysteron {
namespace {

using bench::Bench;
using bench::Numbers;

constexpr int lanes = 16;

/// Numbers of each lane, and the same laid out for lanes: number i of lane l at [i * lanes + l].
struct Drawn {
  std::vector<Numbers> of;
  Numbers side_by_side;
  std::vector<const double*> rows;
  Drawn(std::size_t n, std::uint64_t stream, double scale = 1, const Numbers& around = {})
      : side_by_side(n * lanes), rows(n) {
    for (std::size_t l = 0; l < lanes; ++l) {
      Numbers own;
      for (std::size_t i = 0; i < n; ++i) {
        const double drawn = random::normal(29, stream, i * lanes + l);
        own.push_back(around.empty() ? scale * drawn : around[i] * (1 + scale * drawn));
        side_by_side[i * lanes + l] = own[i];
      }
      of.push_back(own);
    }
    for (std::size_t i = 0; i < n; ++i) rows[i] = side_by_side.data() + i * lanes;
  }
};

class LanesOfEverySample : public testing::TestWithParam<bench::Sample> {};
/// Samples of blocks of fixed size that neither run at instants nor have modes.
std::vector<bench::Sample> side_by_side() {
  std::vector<bench::Sample> list;
  for (const auto& sample : bench::samples())
    if (bench::kernel_of(sample.type).lanes.output != nullptr) list.push_back(sample);
  return list;
}
INSTANTIATE_TEST_SUITE_P(Blocks, LanesOfEverySample, testing::ValuesIn(side_by_side()));

TEST(LanesOfBlocks, MostBlocksOfFixedSizeHaveThem) { EXPECT_GT(side_by_side().size(), 25U); }

TEST_P(LanesOfEverySample, GiveWhatItsFunctionsGiveOneByOne) {
  Bench b(GetParam().type, GetParam().values, GetParam().inputs);
  const auto nu = static_cast<std::size_t>(b.n_u), nx = static_cast<std::size_t>(b.states()),
             nm = static_cast<std::size_t>(b.sizes.memory), ny = static_cast<std::size_t>(b.sizes.outputs);
  const Numbers numbers = b.p;
  for (std::uint64_t trial = 0; trial < 10; ++trial) {
    const Drawn p(numbers.size(), 10 * trial, 0.02, numbers), u(nu, 10 * trial + 1), x(nx, 10 * trial + 2),
        m(nm, 10 * trial + 3), du(nu, 10 * trial + 4), dx(nx, 10 * trial + 5);
    Numbers y(ny * lanes), rate(ny * lanes), values(ny * lanes), advanced(nm * lanes), slope(nx * lanes);
    LanesView v;
    v.lanes = lanes;
    v.p = p.side_by_side.data();
    v.x = x.side_by_side.data();
    v.dx = dx.side_by_side.data();
    v.m = m.side_by_side.data();
    v.u = u.rows.data();
    v.du = du.rows.data();
    v.t = v.branch = 0.37;
    v.advanced = advanced.data();
    v.values = values.data();
    v.out = y.data();
    b.kernel.lanes.output(v);
    v.out = rate.data();
    b.kernel.lanes.output_rate(v);
    v.out = slope.data();
    if (nx > 0) b.kernel.lanes.derivative(v);
    for (std::size_t l = 0; l < lanes; ++l) {
      b.p = p.of[l];
      // 1e-13: a few roundings, and functions that differ from the C library's by some 1e-15 of themselves
      const auto expect = [&](const Numbers& got, const Numbers& right, const char* what) {
        for (std::size_t i = 0; i < right.size(); ++i)
          if (std::isfinite(right[i]))
            EXPECT_NEAR(got[i * lanes + l], right[i], 1e-13 * (1 + std::fabs(right[i]))) << what << " " << i;
          else
            EXPECT_FALSE(std::isfinite(got[i * lanes + l])) << what << " " << i;
      };
      Numbers memory = m.of[l];
      bench::Duals dual_memory = bench::dual(memory);
      const auto duals = bench::dual(u.of[l], du.of[l]);
      if (nm > 0) {
        memory = b.advance(m.of[l], u.of[l]);
        expect(advanced, memory, "advance");
        dual_memory = b.advance_rate(dual_memory, duals);
      }
      expect(y, b.output(0.37, u.of[l], x.of[l], memory), "output");
      expect(rate, bench::rates(b.output_rate(0.37, 0.37, duals, bench::dual(x.of[l], dx.of[l]), dual_memory)), "rate");
      if (nx > 0) expect(slope, b.derivative(u.of[l], x.of[l], du.of[l]), "derivative");
    }
  }
}

}  // namespace
}  // namespace hysteron
