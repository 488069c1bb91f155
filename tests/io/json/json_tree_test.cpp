#include "io/json/json_tree.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "io/json/json_position.h"

namespace hysteron {
namespace {

const char* text =
    "{\n"                                  // 1
    "  \"a\": {\"b\": 1,\n"                // 2
    "         \"c/d\": [10,\n"             // 3
    "           {\"e\": \"x,]}\\\"\"},\n"  // 4
    "           30]},\n"                   // 5
    "  \"\\u0061b\": true\n"               // 6
    "}\n";

TEST(JsonTree, EveryPointerHasTheLineOfItsKeyOrElement) {
  const JsonTree tree(text);
  EXPECT_EQ(tree.line(""), 1);
  EXPECT_EQ(tree.line("/a"), 2);
  EXPECT_EQ(tree.line("/a/b"), 2);
  EXPECT_EQ(tree.line("/a/c~1d"), 3);
  EXPECT_EQ(tree.line("/a/c~1d/0"), 3);
  EXPECT_EQ(tree.line("/a/c~1d/1"), 4);
  EXPECT_EQ(tree.line("/a/c~1d/1/e"), 4);
  EXPECT_EQ(tree.line("/a/c~1d/2"), 5);
  EXPECT_EQ(tree.line("/ab"), 6);  // the escaped key is "ab"
}

TEST(JsonTree, APlaceThatIsNotThereHasTheLineOfItsNearestParent) {
  const JsonTree tree(text);
  EXPECT_EQ(tree.line("/a/c~1d/1/missing/deeper"), 4);
  EXPECT_EQ(tree.line("/a/c~1d/3"), 3);
  EXPECT_EQ(tree.line("/a/c~1d/x"), 3);
  EXPECT_EQ(tree.line("/nothing"), 1);
  EXPECT_NE(tree.at("/a/b"), JsonTree::none);
  EXPECT_EQ(tree.at("/a/x"), JsonTree::none);
}

TEST(JsonTree, KeysThatStandTwiceInOneObjectAreFoundAndOthersAreNot) {
  const JsonTree tree("{\"a\": {\"x\": 1},\n\"b\": {\"x\": 1,\n\"y\": 2,\n\"\\u0078\": 3}}");
  ASSERT_EQ(tree.duplicates().size(), 1U);
  EXPECT_EQ(tree.duplicates()[0].pointer, "/b/x");
  EXPECT_EQ(tree.duplicates()[0].line, 4);
  EXPECT_EQ(tree.duplicates()[0].first_line, 2);
}

TEST(JsonTree, KeysThatStandTwiceAreFoundInLargeObjectsTooInTheOrderOfTheText) {
  std::string large = "{";
  for (int i = 0; i < 1000; ++i) large += fmt::format("\"k{}\": {{\"a\": 1, \"a\": 2}},\n", i % 999);
  const JsonTree tree(large + "\"last\": 0}");
  ASSERT_EQ(tree.duplicates().size(), 1001U);
  EXPECT_EQ(tree.duplicates()[998].pointer, "/k998/a");
  EXPECT_EQ(tree.duplicates()[999].pointer, "/k0");
  EXPECT_EQ(tree.duplicates()[999].line, 1000);
  EXPECT_EQ(tree.duplicates()[999].first_line, 1);
  EXPECT_EQ(tree.duplicates()[1000].pointer, "/k0/a");
}

TEST(JsonTree, EmptyObjectsAndListsDoNotShiftWhatFollows) {
  const JsonTree tree("[[],\n{},\n[[]],\n5]");
  EXPECT_EQ(tree.line("/0"), 1);
  EXPECT_EQ(tree.line("/1"), 2);
  EXPECT_EQ(tree.line("/2/0"), 3);
  EXPECT_EQ(tree.line("/3"), 4);
}

TEST(JsonTree, ANumberBeforeTheEndOfALineStandsInThatLine) {
  const JsonTree tree("[1\n,2\n,[3\n],\n4\n]");
  EXPECT_EQ(tree.line("/0"), 1);
  EXPECT_EQ(tree.line("/1"), 2);
  EXPECT_EQ(tree.line("/2"), 3);
  EXPECT_EQ(tree.line("/2/0"), 3);
  EXPECT_EQ(tree.line("/3"), 5);
}

TEST(JsonTree, ValuesAreWhatTheTextSays) {
  const JsonTree tree(R"({"null": null, "true": true, "whole": -3, "natural": 18446744073709551615, "real": 2.5e-1,
                         "text": "a\"\u00e4", "empty": ""})");
  EXPECT_EQ(tree.kind(0), JsonTree::Kind::object);
  EXPECT_EQ(tree.size(0), 7U);
  EXPECT_EQ(tree.kind(tree.find(0, "null")), JsonTree::Kind::null);
  EXPECT_TRUE(tree.truth(tree.find(0, "true")));
  EXPECT_EQ(tree.number(tree.find(0, "whole")), -3.0);
  EXPECT_EQ(tree.number(tree.find(0, "natural")), 18446744073709551616.0);
  EXPECT_EQ(tree.number(tree.find(0, "real")), 0.25);
  EXPECT_EQ(tree.text(tree.find(0, "text")), "a\"\xc3\xa4");
  EXPECT_EQ(tree.text(tree.find(0, "empty")), "");
  EXPECT_EQ(tree.dump(tree.find(0, "natural")), "18446744073709551615");
  EXPECT_EQ(tree.dump(tree.find(0, "text")), "\"a\\\"\xc3\xa4\"");
  EXPECT_EQ(tree.find(0, "nothing"), JsonTree::none);
}

TEST(JsonTree, MembersKeepTheirOrderAndAreFoundHoweverManyThereAre) {
  constexpr int members = 100'000;  // searched from the front each time, some minutes
  std::string large = "{";
  for (int i = 0; i < members; ++i) large += fmt::format("{}\"k{}\": [{}]", i > 0 ? ",\n" : "", i, i);
  const JsonTree tree(large + "}");
  EXPECT_TRUE(tree.duplicates().empty());
  EXPECT_EQ(tree.size(0), static_cast<std::size_t>(members));
  int i = 0;
  for (auto member = tree.first(0); member != JsonTree::none; member = tree.next(member, 0), ++i) {
    const std::string key = fmt::format("k{}", i);
    ASSERT_EQ(tree.key(member), key);
    ASSERT_EQ(tree.find(0, key), member);
    ASSERT_EQ(tree.line("/" + key + "/0"), i + 1);
    ASSERT_EQ(tree.number(tree.first(member)), i);
  }
}

TEST(JsonTree, NestingBeyondAHundredLevelsIsTold) {
  EXPECT_EQ(JsonTree(std::string(100, '[') + std::string(100, ']')).too_deep_line(), 0);
  EXPECT_EQ(JsonTree("[\n" + std::string(100, '[') + std::string(100, ']') + "\n]").too_deep_line(), 2);
}

TEST(JsonPosition, LineAndColumnCountFromOne) {
  EXPECT_EQ(line_and_column("ab\ncd", 0), std::pair(1, 1));
  EXPECT_EQ(line_and_column("ab\ncd", 1), std::pair(1, 2));
  EXPECT_EQ(line_and_column("ab\ncd", 3), std::pair(2, 1));
  EXPECT_EQ(line_and_column("ab\ncd", 4), std::pair(2, 2));
}

}  // namespace
}  // namespace hysteron
