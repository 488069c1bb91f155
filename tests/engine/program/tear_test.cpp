// Where cycles are cut, on graphs whose smallest set of cuts is known.
#include "engine/program/tear.h"

#include <gtest/gtest.h>

namespace hysteron {
namespace {

using Graph = std::vector<std::vector<int>>;

Torn torn(const Graph& needs, std::vector<int> cost = {}, std::vector<bool> preferred = {}) {
  cost.resize(needs.size(), 1);
  preferred.resize(needs.size(), false);
  return tear(needs, cost, preferred);
}

/// Every node once, and none before what it needs unless that is torn.
void expect_in_order(const Graph& needs, const Torn& t) {
  ASSERT_EQ(t.order.size(), needs.size());
  std::vector<bool> done(needs.size(), false);
  for (const int tear : t.tears) done[static_cast<std::size_t>(tear)] = true;
  for (const int i : t.order) {
    for (const int j : needs[static_cast<std::size_t>(i)])
      EXPECT_TRUE(done[static_cast<std::size_t>(j)]) << i << " stands before " << j;
    done[static_cast<std::size_t>(i)] = true;
  }
}

TEST(Tear, ARingIsCutOnce) {
  const Graph ring{{4}, {0}, {1}, {2}, {3}};
  const auto t = torn(ring);
  EXPECT_EQ(t.tears.size(), 1U);
  EXPECT_EQ(t.order.back(), t.tears.front());
  expect_in_order(ring, t);
}

TEST(Tear, RingsThroughOneNodeAreCutThere) {
  // Ten blocks that all read node 0 and are read by it, as play operators behind one another's sum.
  Graph star{{}};
  for (int i = 1; i <= 10; ++i) star.push_back({0}), star[0].push_back(i);
  const auto t = torn(star);
  EXPECT_EQ(t.tears, std::vector<int>{0});
  expect_in_order(star, t);
}

TEST(Tear, ANodeThatNeedsItselfIsCutThere) {
  const Graph graph{{1, 0}, {0}};
  const auto t = torn(graph);
  EXPECT_EQ(t.tears, std::vector<int>{0});
  expect_in_order(graph, t);
}

TEST(Tear, TwoRingsWithoutACommonNodeAreCutTwice) {
  const Graph graph{{1, 3}, {0}, {3, 1}, {2}};
  const auto t = torn(graph);
  EXPECT_EQ(t.tears.size(), 2U);
  expect_in_order(graph, t);
}

TEST(Tear, CheaperNodesAndTheUsersWishDecide) {
  const Graph ring{{2}, {0}, {1}};
  EXPECT_EQ(torn(ring, {3, 1, 2}).tears, std::vector<int>{1});
  EXPECT_EQ(torn(ring, {3, 1, 2}, {false, false, true}).tears, std::vector<int>{2});
}

TEST(Tear, ACutThatALaterOneMakesNeedlessIsTakenBack) {
  // Complete graph of four: three cuts are needed, not four.
  Graph all(4);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (i != j) all[static_cast<std::size_t>(i)].push_back(j);
  const auto t = torn(all);
  EXPECT_EQ(t.tears.size(), 3U);
  expect_in_order(all, t);
}

}  // namespace
}  // namespace hysteron
