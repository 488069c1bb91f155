// How many further names a search may take.
#include "discover/search/room.h"

#include <gtest/gtest.h>

namespace hysteron {
namespace {

TEST(Room, ANameThatLeavesGivesItsPlaceBack) {
  Room room(0, 3, 12);
  for (const int names : {0, 1, 2}) {
    ASSERT_TRUE(room.left(names));
    room.took_a_name();
  }
  EXPECT_FALSE(room.left(3));
  // A limit on one axis, creep; then the limit on the other axis, beside which creep's substitute is needless.
  Room other(0, 3, 12);
  for (const int names : {0, 1, 2}) {
    ASSERT_TRUE(other.left(names));
    other.took_a_name();
  }
  EXPECT_TRUE(other.left(1));
  other.took_a_name();
  EXPECT_FALSE(other.left(2)) << "three were taken, one left and one came";
}

TEST(Room, TheSameNameOnAnotherAxisIsAStepToo) {
  Room room(0, 3, 12);
  for (int axis = 0; axis < 3; ++axis) {
    ASSERT_TRUE(room.left(std::min(axis, 1)));
    room.took_a_name();
  }
  EXPECT_FALSE(room.left(1)) << "nothing left, so nothing comes back";
}

TEST(Room, WhatTakesNoNameAndWhatComesAndGoesEnds) {
  Room same(1, 3, 4);
  int turns = 0;
  for (; same.left(1); same.took_no_name()) ++turns;
  EXPECT_EQ(turns, 4);
  Room coming(0, 3, 5);
  turns = 0;
  for (; coming.left(turns % 2); coming.took_a_name()) ++turns;
  EXPECT_EQ(turns, 5);
}

}  // namespace
}  // namespace hysteron
