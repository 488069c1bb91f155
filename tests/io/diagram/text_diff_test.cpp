#include "io/diagram/text_diff.h"

#include <gtest/gtest.h>

namespace hysteron {
namespace {

TEST(TextDiff, EqualTextsDifferNowhere) { EXPECT_EQ(text_diff("a\nb\n", "a\nb\n"), ""); }

TEST(TextDiff, ShowsWhatWentAndWhatCameWithThreeLinesAround) {
  EXPECT_EQ(text_diff("1\n2\n3\n4\n5\n6\n7\n8\n9\n", "1\n2\n3\n4\nfive\n6\n7\n8\n9\n"),
            " 2\n 3\n 4\n-5\n+five\n 6\n 7\n 8\n");
}

TEST(TextDiff, PlacesFarApartAreShownApart) {
  EXPECT_EQ(text_diff("a\n1\n2\n3\n4\n5\n6\n7\n8\nb\n", "A\n1\n2\n3\n4\n5\n6\n7\n8\nB\n"),
            "-a\n+A\n 1\n 2\n 3\n...\n 6\n 7\n 8\n-b\n+B\n");
}

TEST(TextDiff, InsertedAndRemovedLinesAreFoundAmongEqualOnes) {
  EXPECT_EQ(text_diff("a\nb\nc\n", "a\nx\nb\nc\n"), " a\n+x\n b\n c\n");
  EXPECT_EQ(text_diff("a\nb\nb\nc\n", "a\nb\nc\n"), " a\n b\n-b\n c\n");
  EXPECT_EQ(text_diff("", "a\n"), "+a\n");
  EXPECT_EQ(text_diff("a\n", ""), "-a\n");
}

}  // namespace
}  // namespace hysteron
