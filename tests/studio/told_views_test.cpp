// What of a view goes to the page: all of it, or what differs from the one that the page has.
#include "studio/told_views.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace hysteron::studio {
namespace {

using Json = nlohmann::ordered_json;

Json view_with(int number) {
  return {{"lines", {"{", "\"gain\": " + std::to_string(number), "}"}},
          {"sheet", {{"items", {{{"name", "a"}, {"caption", {number}}}, {{"name", "b"}, {"caption", {2}}}}}}}};
}

Json told(ToldViews& views, const Json& view, const std::string& had = "") {
  return Json::parse(views.tell(view, had));
}

TEST(ToldViews, TheFirstIsToldWhole) {
  ToldViews views;
  const Json reply = told(views, view_with(1));
  EXPECT_EQ(reply["view"], view_with(1));
  EXPECT_FALSE(reply.contains("patch"));
}

TEST(ToldViews, OfTheNextOnlyTheDifferenceIs) {
  ToldViews views;
  const std::string first = told(views, view_with(1))["id"];
  const Json reply = told(views, view_with(7), first);
  ASSERT_FALSE(reply.contains("view"));
  EXPECT_EQ(reply["of"], first);
  EXPECT_NE(reply["id"], first);
  EXPECT_EQ(reply["patch"].size(), 2U);  // its line of the text, and its caption
  EXPECT_EQ(view_with(1).patch(reply["patch"]), view_with(7));
  const Json same = told(views, view_with(7), reply["id"]);
  EXPECT_EQ(same["patch"], Json::array());
}

TEST(ToldViews, WhatIsNotKnownAnyMoreIsToldWhole) {
  ToldViews views, others;
  const std::string first = told(views, view_with(1))["id"];
  EXPECT_TRUE(told(others, view_with(2), first).contains("view")) << "another server knows it by the same name";
  EXPECT_TRUE(told(views, view_with(2), first).contains("patch"));
  for (int i = 0; i < 4; ++i) told(views, view_with(i));
  EXPECT_TRUE(told(views, view_with(2), first).contains("view"));
}

TEST(ToldViews, ADifferenceThatIsLongerThanTheViewIsNot) {
  Json before = Json::array(), after = Json::array();
  for (int i = 0; i < 10000; ++i) before.push_back(i), after.push_back(-i - 1);
  ToldViews views;
  const std::string first = told(views, before)["id"];
  EXPECT_EQ(told(views, after, first)["view"], after);
}

}  // namespace
}  // namespace hysteron::studio
