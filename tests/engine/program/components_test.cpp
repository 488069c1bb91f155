#include "engine/program/components.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hysteron {
namespace {

using Lists = std::vector<std::vector<int>>;

Lists sorted(Lists components) {
  for (auto& c : components) std::sort(c.begin(), c.end());
  return components;
}

TEST(StrongComponents, StandBehindWhatTheyNeed) {
  // 0 -> 1 -> 2 -> 1 (a loop of 1 and 2), 2 -> 3, 4 -> 0, 3 alone.
  EXPECT_EQ(sorted(strong_components({{1}, {2}, {1, 3}, {}, {0}})), (Lists{{3}, {1, 2}, {0}, {4}}));
}

TEST(StrongComponents, OfANodeThatNeedsItselfAreOne) { EXPECT_EQ(strong_components({{0, 0}}), (Lists{{0}})); }

TEST(StrongComponents, TwoLoopsThatShareANodeAreOne) {
  EXPECT_EQ(sorted(strong_components({{1}, {0, 2}, {3}, {1}})), (Lists{{0, 1, 2, 3}}));
}

TEST(StrongComponents, OfALongChainDoNotOverflowTheStack) {
  const int n = 200'000;
  Lists needs(n);
  for (int i = 0; i + 1 < n; ++i) needs[static_cast<std::size_t>(i)] = {i + 1};
  const auto components = strong_components(needs);
  ASSERT_EQ(components.size(), static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) EXPECT_EQ(components[static_cast<std::size_t>(i)].front(), n - 1 - i);
}

}  // namespace
}  // namespace hysteron
