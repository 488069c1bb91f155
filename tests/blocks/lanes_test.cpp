// The functions of every block in lanes, and rows of lanes at a time: the same numbers as its functions for one run.
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

/// Outputs from parameters and inputs alone, rows at a time.
bool is_static_with_rows(const Bench& b) {
  return b.kernel.rows != nullptr && b.states() == 0 && b.sizes.memory == 0 && b.n_u > 0;
}
class RowsOfStaticSamples : public testing::TestWithParam<bench::Sample> {};
INSTANTIATE_TEST_SUITE_P(Blocks, RowsOfStaticSamples, testing::ValuesIn(bench::samples_where(is_static_with_rows)));

TEST(RowsOfBlocks, MostStaticBlocksHaveThem) { EXPECT_GT(bench::samples_where(is_static_with_rows).size(), 25U); }

/// A block with numbers of its own: those of the sample, each larger by the same share, texts and counts as they are.
Bench larger(const Bench& b, double share) {
  Bench own = b;
  const auto& declared = b.kernel.declaration.parameters;
  for (std::size_t i = 0; i < declared.size(); ++i)
    if (declared[i].kind != ParameterKind::text && !declared[i].is_structural)
      for (int k = b.p_at[i]; k < b.p_at[i + 1]; ++k) own.p[static_cast<std::size_t>(k)] *= 1 + share;
  own.prepare();
  return own;
}

TEST_P(RowsOfStaticSamples, GiveWhatItsOutputGivesInAnyNumberOfLanes) {
  const Bench b(GetParam().type, GetParam().values, GetParam().inputs);
  const bool sized = b.kernel.lanes.output == nullptr;
  constexpr int count = 5;
  for (const int n :
       sized ? std::vector<int>{1, RowsView::most_lanes, 100, 128} : std::vector<int>{1, RowsView::most_lanes}) {
    std::vector<Bench> of;
    std::vector<View<double>> views;
    for (int l = 0; l < n; ++l) of.push_back(larger(b, 1e-3 * l));
    for (const Bench& own : of) {
      View<double> v;
      v.p = own.p.data();
      v.p_at = own.p_at.data();
      v.c = own.c.data();
      v.n_c = static_cast<int>(own.c.size());
      v.n_u = own.n_u;
      v.n_y = own.sizes.outputs;
      v.key = own.key;
      views.push_back(v);
    }
    const auto all = static_cast<std::size_t>(count * n), nu = static_cast<std::size_t>(b.n_u),
               ny = static_cast<std::size_t>(b.sizes.outputs);
    std::vector<Numbers> u(nu, Numbers(all)), y(ny, Numbers(all));
    for (std::size_t i = 0; i < nu; ++i)
      for (std::size_t k = 0; k < all; ++k) u[i][k] = random::normal(31, i, k);
    std::vector<const double*> in;
    std::vector<double*> out;
    for (const auto& column : u) in.push_back(column.data());
    for (auto& column : y) out.push_back(column.data());
    const Numbers h(count, 1e-3), t(count, 0.37);
    Numbers scratch(RowsView::scratch_size(b.n_u, 0, 0, b.sizes.outputs));
    RowsView r;
    r.lanes = n;
    r.count = count;
    r.views = views.data();
    r.u = in.data();
    r.y = out.data();
    r.h = h.data();
    if (b.kernel.uses_time) r.t = t.data();
    r.scratch = scratch.data();
    b.kernel.rows(r);
    for (std::size_t k = 0; k < all; ++k) {
      Numbers now;
      for (const auto& column : u) now.push_back(column[k]);
      const Numbers right = of[k % static_cast<std::size_t>(n)].output(0.37, now);
      for (std::size_t i = 0; i < ny; ++i)
        if (std::isfinite(right[i]))  // the same formula, some roundings in another order
          EXPECT_NEAR(y[i][k], right[i], 1e-14 * (1 + std::fabs(right[i]))) << n << " lanes, number " << k;
        else
          EXPECT_FALSE(std::isfinite(y[i][k])) << n << " lanes, number " << k;
    }
  }
}

}  // namespace
}  // namespace hysteron
