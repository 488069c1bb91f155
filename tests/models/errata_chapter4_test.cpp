// Errata of chapter 4 of the thesis that concern a computation: the printed form fails, the corrected one holds. Those
// of the swarms (E-25, E-26) stand in tests/fit/estimate/global_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "models/hysteresis/jiles_atherton.h"
#include "models/hysteresis/prandtl_ishlinskii.h"
#include "tests/models/golden.h"
#include "tests/models/thesis_tables.h"

namespace hysteron::errata_chapter4 {
namespace {

using Numbers = std::vector<double>;
using thesis::thresholds;
using thesis::weights;

constexpr double classic_stroke = 6.63472393757;  // of its steady loop on 0 to 6 V, golden/README.md
constexpr double top = 6;

/// Stroke of the steady loop on 0 to 6 V: twenty cycles of Runge-Kutta steps of 0.01 V, 1/400 of k.
template <class Slope>
double steady_stroke(const Slope& slope) {
  double p = 0, high = 0;
  for (int cycle = 0; cycle < 20; ++cycle)
    for (const int d : {1, -1}) {
      for (int i = 0; i < 600; ++i) {
        const double h = 0.01 * d, e = d > 0 ? 0.01 * i : 6 - 0.01 * i;
        const double k1 = slope(e, p, d), k2 = slope(e + h / 2, p + h / 2 * k1, d);
        const double k3 = slope(e + h / 2, p + h / 2 * k2, d), k4 = slope(e + h, p + h * k3, d);
        p += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      }
      if (d > 0) high = p;
    }
  return high - p;
}

TEST(ErrataOfChapter4, E27TheNormalisedLawTakesTheClassicPolarisation) {
  const double s = 1 / classic_stroke;
  const auto printed = [&](double e, double p, int d) { return s * jiles_atherton::slope(thesis::table_2_2, e, p, d); };
  const auto corrected = [&](double e, double p, int d) {
    return s * jiles_atherton::slope(thesis::table_2_2, e, p / s, d);
  };
  EXPECT_NEAR(steady_stroke(printed), 1.207, 5e-4);  // SPEC, four digits
  EXPECT_NEAR(steady_stroke(corrected), 1, 1e-8);    // Runge-Kutta of h/k = 1/400
}

TEST(ErrataOfChapter4, E28TheNormalisedInverseScalesItsArgumentAndItsRate) {
  // References 0 to 0.9 of the stroke: what the normalised model then gives.
  const double s = 1 / classic_stroke, step = 1e-4;
  double printed = 0, corrected = 0;
  for (double r = 0; r < 0.9 - step / 2; r += step) {
    printed += step / jiles_atherton::slope(thesis::table_2_2, printed / s, r, 1);  // F((L_m/L_p) P', E)
    corrected = jiles_atherton::field_after(thesis::table_2_2, corrected, r / s, (r + step) / s);
  }
  const auto reached = [&](double field) {
    return s * jiles_atherton::polarisation_after(thesis::table_2_2, 0.0, 0.0, field);
  };
  EXPECT_GT(std::fabs(reached(printed) - 0.9), 0.5);  // SPEC: off by 0.83 of a range of 0.9
  EXPECT_NEAR(reached(corrected), 0.9, 1e-8);
}

TEST(ErrataOfChapter4, E29AnIntegralOverTimeOfTheNormalisedOutputTellsLoopsNotApart) {
  // Eq. 4.9 as printed over a cycle of 0.2 s: a loop without hysteresis, y = u, gives T/2, and so does nearly any
  // other.
  constexpr int rows = 2000;
  double straight = 0, hysteretic = 0, y = 0, before = 0;
  std::vector<double> loop;
  for (int i = 1; i <= 2 * rows; ++i) {
    const double u = 3 - 3 * std::cos(2 * std::numbers::pi * i / rows);
    y = jiles_atherton::polarisation_after(thesis::table_2_2, y, before, u);
    before = u;
    if (i > rows) loop.push_back(y);
    if (i > rows) straight += u / 6 * 0.2 / rows;
  }
  const double highest = *std::max_element(loop.begin(), loop.end());
  for (const double v : loop) hysteretic += v / highest * 0.2 / rows;
  EXPECT_NEAR(straight, 0.1, 1e-9);
  EXPECT_NEAR(hysteretic, 0.1188, 0.001);  // SPEC: .1188 on the steady loop, where the area tells 0 from 0.2228
}

struct Loop {
  double height = 0, area = 0;
};
/// From rest over 0 to 6 V: sum c_i (U - r_i) and sum c_i r_i (U - r_i).
Loop loop_of(const Numbers& c) {
  Loop loop;
  for (std::size_t i = 0; i < c.size(); ++i) {
    loop.height += c[i] * (top - thresholds[i]);
    loop.area += c[i] * thresholds[i] * (top - thresholds[i]);
  }
  return loop;
}
Numbers added(double extra, double factor = 1) {
  Numbers c = weights;
  c[0] += extra;
  for (double& x : c) x *= factor;
  return c;
}

TEST(ErrataOfChapter4, E33ToE36HeightAndAreaOfARescaledModel) {
  const Loop old = loop_of(weights);
  const double extra = 0.1, n = 9, r1 = 0.6;
  const Loop more = loop_of(added(extra));
  EXPECT_NEAR(more.height, old.height + extra * top, 1e-12);
  EXPECT_NEAR(old.height + n * extra * r1, 7.18536, 1e-9);  // Eq. 4.20 as printed; 7.24536 is right
  EXPECT_NEAR(more.area, old.area, 1e-12);                  // a linear term has no area
  double under = 0, squares = 0;                            // Eqs. 4.21 and 4.22 as printed
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double right = i + 1 < weights.size() ? thresholds[i + 1] : top;
    double y0 = 0, y1 = 0;
    for (std::size_t j = 0; j <= i; ++j) {
      y0 += weights[j] * (thresholds[i] - thresholds[j]);
      y1 += weights[j] * (right - thresholds[j]);
    }
    under += (right - thresholds[i]) * (y0 + y1);
    squares += right * right - thresholds[i] * thresholds[i];
  }
  const double printed = under - top * old.height;
  EXPECT_NEAR(printed, -old.area, 1e-9);
  const double printed_more = printed + n * extra * r1 * top - extra * squares;
  EXPECT_NEAR(printed_more, -4.295, 5e-4);  // SPEC
  EXPECT_NEAR(std::fabs(printed_more) * old.height / (old.height + n * extra * r1), 3.972, 5e-4);
  const Loop rescaled = loop_of(added(extra, old.height / more.height));
  EXPECT_NEAR(rescaled.height, old.height, 1e-12);
  EXPECT_NEAR(rescaled.area, 3.609283, 1e-6);
}

TEST(PrandtlIshlinskiiRescaled, GoldenAreasAreReachedAtTheOldHeight) {
  // a = (H/u_max)(A_0/A_wanted - 1). The golden file has ten digits.
  HYSTERON_NEEDS_GOLDEN("pi_rescale");
  const auto trace = golden::read("pi_rescale");
  const Loop old = loop_of(weights);
  for (std::size_t k = 0; k < trace.at("alpha [um/V]").size(); ++k) {
    const double wanted = trace.at("target area ratio [-]")[k];
    const double extra = old.height / top * (1 / wanted - 1);
    EXPECT_NEAR(extra, trace.at("alpha [um/V]")[k], 1e-9);
    const double factor = old.height / (old.height + extra * top);
    EXPECT_NEAR(old.height + extra * top, trace.at("H_alpha(umax) [um]")[k], 1e-8);
    EXPECT_NEAR(factor, trace.at("scale factor [-]")[k], 1e-9);
    const Loop rescaled = loop_of(added(extra, factor));
    EXPECT_NEAR(rescaled.area, trace.at("rescaled area [um*V]")[k], 1e-8);
    EXPECT_NEAR(rescaled.height, old.height, 1e-12);
  }
}

}  // namespace
}  // namespace hysteron::errata_chapter4
