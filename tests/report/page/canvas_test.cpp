// Places in a picture: scales, and texts that fit where they stand.
#include "report/page/canvas.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hysteron {
namespace {

using Lines = std::vector<std::string>;

TEST(Wrap, BreaksAtSpacesAndBehindUnderscores) {
  EXPECT_EQ(wrap("creep behind drive", 80, 3), (Lines{"creep behind", "drive"}));  // 12 letters of 6.6 px fit 80 px
  EXPECT_EQ(wrap("initial_remanence", 80, 3), (Lines{"initial_", "remanence"}));
  EXPECT_EQ(wrap("sensor_lag", 80, 3), (Lines{"sensor_lag"}));
}

TEST(Wrap, EndsInAnEllipsisWhereLinesRunOut) {
  const auto lines = wrap("one two three four five six", 40, 2);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_TRUE(lines.back().ends_with("…"));
  for (const auto& line : lines) EXPECT_LE(text_width(line), 40 + 6.6);
}

TEST(Wrap, CutsBetweenLettersNeverInsideOne) {
  // Each µ has two bytes; half of one would be broken text.
  const auto line = wrap("µµµµµµµµµµ", 40, 1).front();
  EXPECT_TRUE(line.ends_with("…"));
  for (std::size_t i = 0; i + 3 < line.size(); i += 2) EXPECT_EQ(line.substr(i, 2), "µ");
}

TEST(Scale, MapsItsEndsToTheFrame) {
  const Scale linear{{-2, 3}, false, 10, 110};
  EXPECT_DOUBLE_EQ(linear(-2), 10);
  EXPECT_DOUBLE_EQ(linear(3), 110);
  EXPECT_DOUBLE_EQ(linear(0.5), 60);
  const Scale decades{{0.01, 100}, true, 0, 100};
  EXPECT_NEAR(decades(1), 50, 1e-12);  // the middle decade; a few roundings of log10
}

TEST(Canvas, MakesRoomForLongNumbers) {
  PreparedFigure f;
  f.x = {0, 1};
  f.y = {1.00001, 1.00002};
  const Canvas wide = canvas_of(f);
  f.y = {1, 2};
  EXPECT_GT(wide.left, canvas_of(f).left);
}

TEST(Pixels, AreShortAndNeverNan) {
  EXPECT_EQ(px(12.34), "12.3");
  EXPECT_EQ(px(12.0), "12");
  EXPECT_EQ(px(-0.01), "0");
  EXPECT_EQ(px(std::nan("")), "0");
}

}  // namespace
}  // namespace hysteron
