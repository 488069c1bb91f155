#include "engine/diagram/name_index.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/diagram/diagram.h"
#include "engine/diagram/error.h"

namespace hysteron {
namespace {

TEST(NameIndex, ANameAmongManyIsFoundWithoutLookingAtTheOthers) {
  constexpr std::size_t many = 100'000;
  std::vector<std::string> names;
  std::size_t looked_at = 0;
  const auto name_at = [&](std::size_t place) {
    ++looked_at;
    return std::string_view(names[place]);
  };
  NameIndex index;
  for (std::size_t i = 0; i < many; ++i) {
    names.push_back(fmt::format("block{}", i));
    index.added(names.size(), name_at);
  }
  // A table at most half full: 2.5 slots are looked at for a name that is not there (Knuth, The Art of Computer
  // Programming 3, 6.4, linear probing at 1/2), and growing looks at each name again, some 3 times over all.
  EXPECT_LT(looked_at, 10 * many);
  looked_at = 0;
  for (std::size_t i = 0; i < many; ++i) ASSERT_EQ(index.find(names[i], many, name_at), static_cast<std::ptrdiff_t>(i));
  EXPECT_LT(looked_at, 3 * many);
  looked_at = 0;
  for (std::size_t i = 0; i < many; ++i) ASSERT_EQ(index.find(fmt::format("other{}", i), many, name_at), -1);
  EXPECT_LT(looked_at, 3 * many);
}

TEST(NameIndex, NoTableIsSoFullThatLookingLastsWhateverItsSize) {
  // Half full at most, looking is over after 2.5 names on average, none of them far (Knuth, as above); of few names the
  // average scatters. Each size up to 300 has had tables of every filling.
  std::vector<std::string> names;
  std::size_t looked_at = 0, lookups = 0;
  const auto name_at = [&](std::size_t place) {
    ++looked_at;
    return std::string_view(names[place]);
  };
  for (const int last : {300, 31'000}) {
    NameIndex index;
    names.clear();
    looked_at = lookups = 0;
    for (int i = last; i > 0; --i) {
      names.push_back(fmt::format("g{}", i));
      index.added(names.size(), name_at);
      for (int k = 0; k < 20 && names.size() > 12; ++k, ++lookups)
        ASSERT_EQ(index.find(fmt::format("h{}", 20 * i + k), names.size(), name_at), -1);
    }
    EXPECT_LT(static_cast<double>(looked_at), 2.0 * static_cast<double>(lookups)) << last;
  }
}

TEST(NameIndex, OfNamesThatStandTwiceTheFirstIsFound) {
  for (const int different : {5, 50}) {
    std::vector<std::string> names;
    for (int i = 0; i < 2 * different; ++i) names.push_back(fmt::format("n{}", i % different));
    const auto name_at = [&](std::size_t place) { return std::string_view(names[place]); };
    NameIndex index;
    index.rebuild(names.size(), name_at);
    for (int i = 0; i < different; ++i)
      EXPECT_EQ(index.find(names[static_cast<std::size_t>(i)], names.size(), name_at), i);
  }
}

TEST(Ordered, KeepsItsOrderAndFindsEveryNameWhateverIsInsertedAndErased) {
  for (const int size : {5, 100}) {  // compared one by one, and by hash
    Ordered<int> list;
    std::vector<std::string> expected;
    for (int i = 0; i < size; ++i) {
      list[fmt::format("n{}", i)] = i;
      expected.push_back(fmt::format("n{}", i));
    }
    EXPECT_TRUE(list.erase("n1"));
    EXPECT_FALSE(list.erase("n1"));
    expected.erase(expected.begin() + 1);
    list.insert_after("n0", "first", -1);
    expected.insert(expected.begin() + 1, "first");
    list.insert_after("nothing", "last", -2);
    expected.push_back("last");
    EXPECT_EQ(list.names(), expected);
    Ordered<int> copy = list;
    list["n0"] = 77;  // the copy has its own
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(copy.place(expected[i]), static_cast<std::ptrdiff_t>(i));
      ASSERT_NE(copy.find(expected[i]), nullptr);
    }
    EXPECT_EQ(*copy.find("n0"), 0);
    EXPECT_EQ(*list.find("n0"), 77);
    EXPECT_EQ(*copy.find("first"), -1);
    EXPECT_EQ(copy.find("n1"), nullptr);
    EXPECT_EQ(copy.place("n1"), -1);
  }
}

TEST(Problems, WhatIsToldTwiceIsKeptOnceHoweverMuchIsTold) {
  Problems problems;
  for (int round = 0; round < 2; ++round)
    for (int i = 0; i < 50'000; ++i) problems.add("code", fmt::format("/blocks/b{}", i), "what", "cure");
  problems.add("code", "/blocks/b", "0what", "cure");
  EXPECT_EQ(problems.list().size(), 50'001U);
  EXPECT_EQ(problems.list()[7].path, "/blocks/b7");
}

}  // namespace
}  // namespace hysteron
