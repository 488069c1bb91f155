// A signal that moves smoothly between its samples, as straight pieces.
#include "engine/diagram/smooth_series.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hysteron {
namespace {

double at(const Series& s, double t) { return s.value(t, t); }

/// Of straight pieces between their points.
double integral(const Series& s) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < s.t.size(); ++i) sum += 0.5 * (s.v[i] + s.v[i + 1]) * (s.t[i + 1] - s.t[i]);
  return sum;
}

TEST(SmoothSeries, IsTheSplineWithoutAKnotAtTheEnds) {
  const Series s = in_straight_pieces({{0, 1, 2.5, 3, 5}, {0, 2, 1, 1.5, -1}, Between::smooth});
  // scipy.interpolate.CubicSpline: 1.41194... with the second derivative 0.31307... in the middle of 1 ... 2.5, which
  // is cut into four: the points between lie h^2/(12 k (k - 1)) of it beside the curve.
  EXPECT_NEAR(at(s, 1.75), 1.4119471153846153 - 0.5 * (-2.832307692307693 + 3.458461538461539) * 1.5 * 1.5 / 144,
              1e-14);
  EXPECT_NEAR(at(s, 4), 2.464615384615384 - 0.5 * (0.8292307692307688 - 9.687692307692306) * 2 * 2 / 144, 1e-14);
  for (std::size_t i = 0; i < 5; ++i) {
    constexpr double t[] = {0, 1, 2.5, 3, 5}, v[] = {0, 2, 1, 1.5, -1};
    EXPECT_EQ(at(s, t[i]), v[i]);
  }
}

TEST(SmoothSeries, StraightPiecesEncloseWhatACubicEncloses) {
  Series cubic{{}, {}, Between::smooth}, straight;
  for (int k = 0; k <= 6; ++k) {
    cubic.t.push_back(k);
    cubic.v.push_back(k * k * k);
  }
  straight = cubic;
  straight.between = Between::linear;
  const double exact = std::pow(6, 4) / 4;
  EXPECT_NEAR(integral(straight) - exact, 6.0 * 6 / 2 / 2, 1e-12) << "h^2/12 times the slope's way, 108";
  EXPECT_NEAR(integral(in_straight_pieces(cubic)), exact, 0.01) << "the second derivative moves within a piece";
}

TEST(SmoothSeries, ASineOfSixSamplesAPeriodIsASineAgainForWhatFollowsSlowly) {
  Series samples{{}, {}, Between::smooth};
  const double w = 2 * std::numbers::pi / 6;
  for (int k = 0; k <= 120; ++k) {
    samples.t.push_back(k);
    samples.v.push_back(std::sin(w * k));
  }
  const Series smooth = in_straight_pieces(samples);
  EXPECT_EQ(smooth.between, Between::linear);
  samples.between = Between::linear;
  // The part of the sine in each, over whole periods away from the ends, by sums of 0.001.
  const auto part = [&](const Series& s) {
    double sum = 0;
    for (int k = 0; k < 96000; ++k) sum += at(s, 12 + 0.001 * (k + 0.5)) * std::sin(w * (12 + 0.001 * (k + 0.5)));
    return 2 * sum / 96000;
  };
  EXPECT_NEAR(part(samples), std::pow(std::sin(w / 2) / (w / 2), 2), 1e-5) << "sinc^2: 0.912";
  // A cubic spline through the samples: sinc^4 over (2 + cos w)/3 = 0.99766 (Unser, IEEE Signal Process. Mag. 16
  // (1999) 22-38); its straight pieces to the fourth power of a quarter: w^4/4^4/240 and less.
  EXPECT_NEAR(part(smooth), std::pow(std::sin(w / 2) / (w / 2), 4) / ((2 + std::cos(w)) / 3), 5e-4);
}

TEST(SmoothSeries, PassesThroughItsSamplesAndStraightPartsStayOnePiece) {
  const Series s = in_straight_pieces({{0, 1, 2, 3, 4, 5, 6, 7, 8}, {0, 1, 2, 3, 4, 5, 6, 7, 8}, Between::smooth});
  EXPECT_EQ(s.t.size(), 9u);
  const Series bent = in_straight_pieces({{0, 1, 2, 3}, {0, 1, 0, -2}, Between::smooth});
  EXPECT_GT(bent.t.size(), 4u);
  EXPECT_EQ(at(bent, 1), 1);
  EXPECT_EQ(at(bent, 2), 0);
  EXPECT_EQ(in_straight_pieces({{0, 1, 2}, {0, 1, 0}, Between::smooth}).t.size(), 3u) << "too few to bend";
}

TEST(SmoothSeries, OtherSignalsStayAsTheyAre) {
  for (const Between between : {Between::linear, Between::hold}) {
    const Series s = in_straight_pieces({{0, 1, 2}, {0, 1, 0}, between});
    EXPECT_EQ(s.t.size(), 3u);
    EXPECT_EQ(s.between, between);
    EXPECT_EQ(between_of(to_text(between)), between);
  }
  EXPECT_EQ(between_of(to_text(Between::smooth)), Between::smooth);
}

}  // namespace
}  // namespace hysteron
