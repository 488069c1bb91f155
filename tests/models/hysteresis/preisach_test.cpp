// Relays of a density that is even within cells, against relays that are switched one by one and against closed forms.
#include "models/hysteresis/preisach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "models/random.h"

namespace hysteron {
namespace {

using Numbers = std::vector<double>;

Numbers moved(const Numbers& levels, Numbers state, const Numbers& drive) {
  for (const double u : drive) preisach::advance<double>(levels, state, u, state.data());
  return state;
}

/// Of each kernel the part that is up, as follows from the switching level that it has reached.
Numbers parts(const Numbers& levels, const Numbers& state) {
  Numbers list;
  for (std::size_t i = 0; i + 1 < levels.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) list.push_back((state[list.size()] - levels[i]) / (levels[i + 1] - levels[i]));
  return list;
}

Numbers down(const Numbers& levels) {
  Numbers list;
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) list.insert(list.end(), i + 1, levels[i]);
  return list;
}

TEST(Preisach, TheFirstAndTheLastLevelSwitchNobodyAndAll) {
  const Numbers levels{0, 1, 3};
  EXPECT_EQ(preisach::kernels(levels.size()), 3U);
  EXPECT_EQ(parts(levels, moved(levels, down(levels), {0})), Numbers(3, 0.0));
  EXPECT_EQ(parts(levels, moved(levels, down(levels), {3})), Numbers(3, 1.0));
  EXPECT_EQ(parts(levels, moved(levels, down(levels), {5, 0})), Numbers(3, 0.0));
  const Numbers weights{1, 10, 100};
  EXPECT_EQ(preisach::output<double>(levels, weights, moved(levels, down(levels), {2})), 1 + 5 + 50);
}

TEST(Preisach, RelaysSwitchUpInOneCellAndDownInTheOther) {
  const Numbers levels{0, 1, 3};
  // Kernels (0, 0), (1, 0), (1, 1). Up to the middle of cell 1, then back to the middle of cell 0.
  EXPECT_EQ(parts(levels, moved(levels, down(levels), {2})), (Numbers{1, 0.5, 0.5}));
  EXPECT_EQ(parts(levels, moved(levels, down(levels), {2, 1})), (Numbers{1, 0.5, 0}))
      << "no relay of (1, 0) is down yet";
  EXPECT_EQ(parts(levels, moved(levels, down(levels), {2, 0.75})), (Numbers{0.75, 0.5, 0}))
      << "three quarters may stay up";
  EXPECT_EQ(parts(levels, moved(levels, down(levels), {2, 0.25})), (Numbers{0.25, 0.25, 0}));
}

TEST(Preisach, AKernelIsALineOfRelaysThatSwitchOneByOne) {
  // Relay k of n switches up at a + (k + 1/2)/n of cell i and down at the same part of cell j.
  const Numbers levels{-1, 0.5, 1, 2};
  constexpr int n = 4000;
  Numbers state = down(levels);
  std::vector<bool> up(n, false);
  for (std::uint64_t row = 0; row < 200; ++row) {
    const double u = 0.5 + 1.2 * random::normal(5, 0, row);
    preisach::advance<double>(levels, state, u, state.data());
    int count = 0;
    for (int k = 0; k < n; ++k) {
      const double part = (k + 0.5) / n;
      if (u >= 1 + part * 1) up[static_cast<std::size_t>(k)] = true;      // cell 2
      if (u <= -1 + part * 1.5) up[static_cast<std::size_t>(k)] = false;  // cell 0
      count += up[static_cast<std::size_t>(k)] ? 1 : 0;
    }
    ASSERT_NEAR(parts(levels, state)[3], count / double(n), 1.0 / n) << "kernel (2, 0), row " << row;
  }
}

TEST(Preisach, WipesOutAndReturns) {
  const Numbers levels{0, 0.5, 1, 1.5, 2};
  const Numbers rest = down(levels);
  const Numbers once = moved(levels, rest, {1.7, 0.3});
  EXPECT_EQ(moved(levels, once, {1.1, 0.6, 0.9, 0.3}), once) << "a minor loop closes";
  EXPECT_EQ(moved(levels, once, {1.2, 1.7, 0.3}), once) << "a larger swing wipes the smaller ones out";
}

TEST(Preisach, WithoutAHistoryEveryRelayAboutTheRestStandsInItsMiddle) {
  const Numbers levels{-2, -1, 0, 1, 2};
  Numbers state(preisach::kernels(levels.size()));
  preisach::demagnetize<double>(levels, 0.0, state.data());
  EXPECT_TRUE(preisach::can_stand(levels, state, 1e-12));
  const Numbers up = parts(levels, state);
  EXPECT_EQ(up[0], 1) << "(0, 0) lies below";
  EXPECT_EQ(up[9], 0) << "(3, 3) above";
  EXPECT_EQ(up[3], 1) << "(2, 0): up from 0, down below -1; its middle is -1";
  EXPECT_EQ(up[7], 0) << "(3, 1): its middle is 1";
  // A swing that dies away leaves the same but in the cells that its steps are coarser than.
  Numbers swung = down(levels);
  for (double top = 2; top > 1e-4; top *= 0.995) swung = moved(levels, swung, {top, -top});
  for (const std::size_t k : {0U, 1U, 3U, 5U, 7U, 8U, 9U}) EXPECT_NEAR(swung[k], state[k], 0.01) << k;
}

TEST(Preisach, KnowsWhatNoDriveLeaves) {
  const Numbers levels{0, 1, 2};  // of cell 1 one more is reached
  EXPECT_TRUE(preisach::can_stand(levels, Numbers{1, 1.5, 1.2}, 0));
  EXPECT_FALSE(preisach::can_stand(levels, Numbers{1, 1.2, 1.5}, 0)) << "(1, 1) goes down before (1, 0)";
  EXPECT_FALSE(preisach::can_stand(levels, Numbers{0.3, 1.5, 1.2}, 0)) << "(0, 0) goes up before (1, 0)";
  EXPECT_FALSE(preisach::can_stand(levels, Numbers{1.2, 1.5, 1.2}, 0));
  EXPECT_FALSE(preisach::can_stand(levels, Numbers{1, 1.5, 0.8}, 0));
}

}  // namespace
}  // namespace hysteron
