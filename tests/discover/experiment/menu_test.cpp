// What is told of the experiments that competed for a tie, on menus of which only the numbers matter.
#include "discover/experiment/menu.h"

#include <gtest/gtest.h>

namespace hysteron {
namespace {

MenuItem item(const std::string& word, double separation, int told = 1) {
  MenuItem i;
  i.word = word;
  i.drive = "u";
  i.separations = {separation};
  i.separation = separation;
  i.rivals_told = i.pairs_told = told;
  return i;
}

MenuItem chosen(MenuItem i) {
  i.chosen = true;
  return i;
}

const std::string& reason_of(const Menu& menu, const std::string& word) {
  for (const auto& i : menu.items)
    if (i.word == word) return i.reason;
  static const std::string none = "not there";
  return none;
}

TEST(Menus, EachIsToldByTheFirstRuleByWhichItIsBehindTheOneChosen) {
  Menu menu{{"lag and delay"},
            {item("zero_run", 0.2, 0), item("triangle", 3), chosen(item("multisine", 7)), item("step_hold", 7)}};
  menu.items.push_back(item("precycle", -1, 0));
  menu.items.back().reason = "the models cannot follow it";
  give_reasons(menu);
  EXPECT_EQ(reason_of(menu, "zero_run"), "separates no other effect from the best one by more than the noise");
  EXPECT_EQ(reason_of(menu, "triangle"), "separates less");
  EXPECT_EQ(reason_of(menu, "multisine"), "tells them apart, and separates most");
  EXPECT_EQ(reason_of(menu, "step_hold"), "separates no more than the one chosen, which came before");
  EXPECT_EQ(reason_of(menu, "precycle"), "the models cannot follow it") << "known since it was simulated";
}

TEST(Menus, WhatWasAskedForIsNotSaidToSeparateMost) {
  Menu menu{{"a and b", "a and c", "b and c"}, {item("triangle", 9, 2), chosen(item("multisine", 4, 2))}};
  menu.items[1].asked = true;
  give_reasons(menu);
  EXPECT_EQ(menu.items[0].reason, "the one chosen is what these effects name for each other");
  EXPECT_EQ(menu.items[1].reason, "tells most apart, 2 of 3 pairs, and is what these effects name for each other");
}

TEST(Menus, WhereNobodyIsToldApartThatIsSaid) {
  Menu menu{{"lag and delay"}, {item("triangle", 0.3, 0), chosen(item("multisine", 0.8, 0))}};
  give_reasons(menu);
  EXPECT_EQ(menu.items[0].reason, "separates less");
  EXPECT_EQ(menu.items[1].reason, "none tells them apart by more than the noise; this one separates most");
}

TEST(Menus, AFurtherMenuAddsWhatIsNewAndItsChoiceGoesFirst) {
  Menu menu{{"lag and delay"}, {chosen(item("triangle", 2)), {}}};
  menu.items[1].word = "fast_steps";
  menu.items[1].reason = "not simulated";
  Menu further{{"lag and delay"}, {item("triangle", 2), chosen(item("fast_steps", 5))}};
  add_items(menu, without_choice(further));
  ASSERT_EQ(menu.items.size(), 2u) << "the same triangle once, and fast_steps was simulated now";
  EXPECT_TRUE(menu.items[0].chosen);
  EXPECT_TRUE(menu.items[1].simulated());

  further.items[0].faster_rows = further.items[1].faster_rows = 8;
  add_items(menu, further);
  ASSERT_EQ(menu.items.size(), 4u);
  EXPECT_FALSE(menu.items[0].chosen);
  EXPECT_TRUE(menu.items[3].chosen);
  EXPECT_EQ(menu.items[0].reason, "separates less");
}

}  // namespace
}  // namespace hysteron
