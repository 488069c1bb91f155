#include "io/json/json_position.h"

#include <gtest/gtest.h>

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

TEST(JsonPositions, EveryPointerHasTheLineOfItsKeyOrElement) {
  const JsonPositions positions(text);
  EXPECT_EQ(positions.line(""), 1);
  EXPECT_EQ(positions.line("/a"), 2);
  EXPECT_EQ(positions.line("/a/b"), 2);
  EXPECT_EQ(positions.line("/a/c~1d"), 3);
  EXPECT_EQ(positions.line("/a/c~1d/0"), 3);
  EXPECT_EQ(positions.line("/a/c~1d/1"), 4);
  EXPECT_EQ(positions.line("/a/c~1d/1/e"), 4);
  EXPECT_EQ(positions.line("/a/c~1d/2"), 5);
  EXPECT_EQ(positions.line("/ab"), 6);  // the escaped key is "ab"
}

TEST(JsonPositions, APlaceThatIsNotThereHasTheLineOfItsNearestParent) {
  const JsonPositions positions(text);
  EXPECT_EQ(positions.line("/a/c~1d/1/missing/deeper"), 4);
  EXPECT_EQ(positions.line("/nothing"), 1);
  EXPECT_TRUE(positions.has("/a/b"));
  EXPECT_FALSE(positions.has("/a/x"));
}

TEST(JsonPositions, KeysThatStandTwiceInOneObjectAreFoundAndOthersAreNot) {
  const JsonPositions positions("{\"a\": {\"x\": 1},\n\"b\": {\"x\": 1,\n\"y\": 2,\n\"\\u0078\": 3}}");
  ASSERT_EQ(positions.duplicates().size(), 1U);
  EXPECT_EQ(positions.duplicates()[0].pointer, "/b/x");
  EXPECT_EQ(positions.duplicates()[0].line, 4);
  EXPECT_EQ(positions.duplicates()[0].first_line, 2);
}

TEST(JsonPositions, EmptyObjectsAndListsDoNotShiftWhatFollows) {
  const JsonPositions positions("[[],\n{},\n[[]],\n5]");
  EXPECT_EQ(positions.line("/0"), 1);
  EXPECT_EQ(positions.line("/1"), 2);
  EXPECT_EQ(positions.line("/2/0"), 3);
  EXPECT_EQ(positions.line("/3"), 4);
}

TEST(JsonPositions, LineAndColumnCountFromOne) {
  EXPECT_EQ(line_and_column("ab\ncd", 0), std::pair(1, 1));
  EXPECT_EQ(line_and_column("ab\ncd", 1), std::pair(1, 2));
  EXPECT_EQ(line_and_column("ab\ncd", 3), std::pair(2, 1));
  EXPECT_EQ(line_and_column("ab\ncd", 4), std::pair(2, 2));
}

}  // namespace
}  // namespace hysteron
