#include "fit/estimate/global.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/diagram/error.h"
#include "fit/estimate/swarm.h"

namespace hysteron {
namespace {

/// Square of the distance to (1, 2, 3), each way in units of its bound.
double bowl(const Point& x) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += std::pow(x[i] - static_cast<double>(i + 1), 2);
  return sum;
}
/// Many valleys: Rastrigin's function, 0 at the origin, local minima near all whole numbers.
double valleys(const Point& x) {
  double sum = 0;
  for (const double v : x) sum += v * v + 10 - 10 * std::cos(2 * std::numbers::pi * v);
  return sum;
}

GlobalProblem box(double (*cost)(const Point&), std::size_t n, double lower, double upper) {
  GlobalProblem p;
  p.lower.assign(n, lower);
  p.upper.assign(n, upper);
  p.cost = cost;
  return p;
}

Attractor anywhere() {
  Attractor a;
  a.components.resize(1);
  a.components[0] = {.component = 0, .low = 0, .high = 1};
  return a;
}

class EveryGlobalMethod : public testing::TestWithParam<std::string> {
 protected:
  static GlobalProblem problem(double (*cost)(const Point&), std::size_t n, double lower, double upper) {
    GlobalProblem p = box(cost, n, lower, upper);
    p.attractor = anywhere();
    return p;
  }
  static GlobalResult search(const GlobalProblem& p, long runs, std::uint64_t seed = 1) {
    GlobalSettings settings;
    settings.max_runs = runs;
    settings.seed = seed;
    return minimize_globally(p, GetParam(), settings);
  }
};

TEST_P(EveryGlobalMethod, ComesNearTheBottomOfABowl) {
  // A point drawn at random in 3000 trials lies within (1/3000)^(1/3) = 7 % of the box, here 0.7: cost 0.5. A method
  // that searches comes to a tenth of it.
  const auto r = search(problem(bowl, 3, -4, 6), 3000);
  EXPECT_LT(r.cost, 0.05);
  EXPECT_EQ(r.cost, bowl(r.best));
}

TEST_P(EveryGlobalMethod, StaysInsideTheBoundsAndTheBudget) {
  GlobalProblem p = problem(valleys, 4, -1.5, 5);
  p.upper[2] = -0.5;  // the minimum lies outside
  long asked = 0;
  p.cost = [&, lower = p.lower, upper = p.upper](const Point& x) {
    ++asked;
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_GE(x[i], lower[i]);
      EXPECT_LE(x[i], upper[i]);
    }
    return valleys(x);
  };
  const auto r = search(p, 400);
  EXPECT_EQ(r.runs, asked);
  EXPECT_LE(asked, 400);
  EXPECT_GT(asked, 300);  // the budget is used
  EXPECT_FALSE(r.stopped);
}

TEST_P(EveryGlobalMethod, SurvivesPointsThatCannotBeEvaluated) {
  GlobalProblem p = problem(bowl, 3, -4, 6);
  int turn = 0;
  p.cost = [&](const Point& x) {
    if (x[0] > x[1] + 1)  // a third of the box, the bottom not in it
      return ++turn % 2 == 0 ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
    return bowl(x);
  };
  const auto r = search(p, 3000);
  EXPECT_GT(r.failures, 0);
  EXPECT_LT(r.cost, 0.05);
}

TEST_P(EveryGlobalMethod, SaysSoWhereNothingCanBeEvaluated) {
  GlobalProblem p = problem(bowl, 3, -4, 6);
  p.cost = [](const Point&) { return std::numeric_limits<double>::quiet_NaN(); };
  const auto r = search(p, 200);
  EXPECT_TRUE(r.best.empty());
  EXPECT_TRUE(std::isinf(r.cost));
  EXPECT_EQ(r.failures, r.runs);
  EXPECT_GT(r.runs, 0);
}

TEST_P(EveryGlobalMethod, SameSeedSameSearch) {
  const auto a = search(problem(valleys, 3, -4, 5), 500, 7), b = search(problem(valleys, 3, -4, 5), 500, 7);
  EXPECT_EQ(a.best, b.best);
  EXPECT_EQ(a.history, b.history);
  const auto c = search(problem(valleys, 3, -4, 5), 500, 8);
  EXPECT_EQ(a.best == c.best, GetParam() == "direct");  // which draws nothing
}

TEST_P(EveryGlobalMethod, EndsWithTheBestSoFarWhenAskedTo) {
  GlobalSettings settings;
  settings.max_runs = 10000;
  settings.go_on = [](const GlobalProgress& p) { return p.runs < 50; };
  const auto r = minimize_globally(problem(valleys, 3, -4, 5), GetParam(), settings);
  EXPECT_TRUE(r.stopped);
  EXPECT_EQ(r.runs, 50);
  EXPECT_EQ(r.cost, valleys(r.best));
}

TEST_P(EveryGlobalMethod, HandsOnAnExceptionOfTheCost) {
  GlobalProblem p = problem(bowl, 3, -4, 6);
  int asked = 0;
  p.cost = [&](const Point& x) {
    if (++asked == 20) throw std::runtime_error("the twentieth");
    return bowl(x);
  };
  EXPECT_THROW(search(p, 200), std::runtime_error);
  EXPECT_EQ(asked, 20);
}

TEST_P(EveryGlobalMethod, HistoryFallsAndEndsAtTheResult) {
  const auto r = search(problem(valleys, 3, -4, 5), 500);
  ASSERT_FALSE(r.history.empty());
  for (std::size_t i = 1; i < r.history.size(); ++i) {
    EXPECT_LT(r.history[i].second, r.history[i - 1].second);
    EXPECT_GT(r.history[i].first, r.history[i - 1].first);
  }
  EXPECT_EQ(r.history.back().second, r.cost);
  EXPECT_EQ(r.cost_after(r.history.back().first), r.cost);
  EXPECT_TRUE(std::isinf(r.cost_after(0)));
  EXPECT_EQ(r.runs_until(r.cost), r.history.back().first);
  EXPECT_EQ(r.runs_until(r.cost / 2), -1);
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryGlobalMethod, testing::ValuesIn(global_method_names()),
                         [](const auto& made) { return made.param; });

TEST(Swarm, BeginsOnTheDiagonalOfTheBox) {
  // X_i(0) = lb + (i - 1/2)/5 (ub - lb), SPEC 4.3.
  GlobalProblem p = box(bowl, 2, 0, 10);
  p.upper[1] = 20;
  std::vector<Point> asked;
  p.cost = [&](const Point& x) {
    asked.push_back(x);
    return bowl(x);
  };
  GlobalSettings settings;
  settings.max_runs = 5;
  minimize_globally(p, "pso", settings);
  EXPECT_EQ(asked, (std::vector<Point>{{1, 2}, {3, 6}, {5, 10}, {7, 14}, {9, 18}}));
}

TEST(Swarm, LeavesTheDiagonalBecauseEveryComponentDrawsItsOwnNumbers) {
  // Erratum E-25: with one number per particle five collinear particles stay on their line for ever.
  GlobalProblem p = box(bowl, 3, 0, 10);
  double off = 0;
  p.cost = [&](const Point& x) {
    off = std::max(off, std::abs(x[0] - x[1]));
    return bowl(x);
  };
  minimize_globally(p, "pso");
  EXPECT_GT(off, 1);
}

TEST(Swarm, FirstMoveTowardsTheBestIsItsLawAndNothingElse) {
  // Behind the start V = 0 and p_B = X: X moves by c_2 r_2 (g_B - X), so between X and X + 1.494 (g_B - X), and the
  // best particle does not move.
  GlobalProblem p = box(bowl, 3, 0, 100);
  std::vector<Point> asked;
  p.cost = [&](const Point& x) {
    asked.push_back(x);
    return x[0] + x[1] + x[2];
  };
  GlobalSettings settings;
  settings.max_runs = 10;
  minimize_globally(p, "pso", settings);
  ASSERT_EQ(asked.size(), 10U);
  EXPECT_EQ(asked[5], asked[0]);
  for (std::size_t i = 1; i < 5; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double way = asked[0][j] - asked[i][j], moved = asked[5 + i][j] - asked[i][j];
      // at most 1.494 of the way; a particle that would pass the bound 0 is reflected there, 10 before the best
      EXPECT_LE(moved, 0);
      EXPECT_GE(moved, 1.494 * way);
      EXPECT_NE(moved, 0);
    }
}

TEST(Swarm, AttractorDrawsItsComponentsAndNoOther) {
  // Without pulls of its own and of the swarm only the attractor moves a particle: component 1 to 3 exp(2 x), scaled
  // by 2, halfway between equal curves, from the drawn x; component 2 not at all.
  GlobalProblem p = box(bowl, 3, 0, 100);
  Attractor a;
  a.components.resize(2);
  a.components[0] = {.component = 0, .low = 0.5, .high = 0.5};
  a.components[1] = {.component = 1, .of = 0, .upper = {{3, 2}}, .lower = {{3, 2}}, .scale = 2};
  p.attractor = a;
  std::vector<Point> asked;
  p.cost = [&](const Point& x) {
    asked.push_back(x);
    return 1.0;
  };
  GlobalSettings settings;
  settings.max_runs = 10;
  settings.own_pull = settings.swarm_pull = 0;
  settings.attractor_pull = 1e-9;  // so small a step shows its direction
  minimize_globally(p, "nmpso", settings);
  for (std::size_t i = 0; i < 5; ++i) {
    const double to_0 = (asked[5 + i][0] - asked[i][0]) / (0.5 - asked[i][0]) / 1e-9;
    const double to_1 = (asked[5 + i][1] - asked[i][1]) / (6 * std::exp(1.0) - asked[i][1]) / 1e-9;
    // shares of the way are r_3, between 0 and 1; 1e-4: rounding of 100 against steps of 1e-8
    EXPECT_GT(to_0, -1e-4);
    EXPECT_LT(to_0, 1 + 1e-4);
    EXPECT_GT(to_1, -1e-4);
    EXPECT_LT(to_1, 1 + 1e-4);
    EXPECT_EQ(asked[5 + i][2], asked[i][2]);
  }
  EXPECT_NE(asked[5][0], asked[0][0]);
}

TEST(Swarm, ThesisAttractorLiesOnTheCurvesThatEnclosePiezoLoops) {
  // SPEC 4.2: Table 2.2 scaled to an input of 1 V has c = 0.693, and the curves 0.179 and 0.709 there.
  const auto a = piezo_attractor(4, 3, 1);
  const auto curve = [](const auto& terms, double x) {
    double sum = 0;
    for (const auto& t : terms) sum += t.factor * std::exp(t.rate * x);
    return sum;
  };
  EXPECT_NEAR(curve(a.components[1].lower, 0.693), 0.179, 5e-4);
  EXPECT_NEAR(curve(a.components[1].upper, 0.693), 0.709, 5e-4);
}

TEST(Swarm, CostsOfManyAtOnceGiveTheSameSearch) {
  GlobalProblem one = box(valleys, 3, -4, 5), many = one;
  std::vector<std::size_t> sizes;
  many.cost_of_each = [&](const std::vector<Point>& points) {
    sizes.push_back(points.size());
    std::vector<double> costs(points.size());
    for (std::size_t i = points.size(); i-- > 0;) costs[i] = valleys(points[i]);  // in any order
    return costs;
  };
  GlobalSettings settings;
  settings.max_runs = 103;
  const auto a = minimize_globally(one, "pso", settings), b = minimize_globally(many, "pso", settings);
  EXPECT_EQ(a.history, b.history);
  EXPECT_EQ(a.best, b.best);
  EXPECT_EQ(sizes.front(), 5U);
  EXPECT_EQ(sizes.back(), 3U);  // what the budget leaves
}

TEST(Swarm, NormalisedMethodsSearchTheScaledCost) {
  GlobalProblem p = box(bowl, 3, -4, 6);
  p.attractor = anywhere();
  p.scaled_cost = [](const Point& x) { return bowl(x) + 1000; };
  for (const auto& method : global_method_names()) {
    const double cost = minimize_globally(p, method).cost;
    EXPECT_EQ(cost >= 1000, method == "npso" || method == "nmpso") << method;
  }
}

TEST(Global, RefusesAWrongQuestionWithACure) {
  const auto code_of = [](const GlobalProblem& p, const std::string& method, GlobalSettings settings = {}) {
    try {
      minimize_globally(p, method, settings);
    } catch (const Error& e) {
      EXPECT_FALSE(e.problems.front().cure.empty());
      return e.problems.front().code;
    }
    return std::string("none");
  };
  GlobalProblem p = box(bowl, 2, 0, 1);
  EXPECT_EQ(code_of(p, "nspo"), "unknown_method");
  EXPECT_EQ(code_of(p, "nmpso"), "no_attractor");
  p.attractor = anywhere();
  p.attractor->components[0].component = 2;
  EXPECT_EQ(code_of(p, "nmpso"), "bad_attractor");
  p.attractor->components[0] = {.component = 0, .of = 1, .upper = {{1, 1}}, .lower = {{1, 1}}};
  EXPECT_EQ(code_of(p, "nmpso"), "bad_attractor");  // 1 is not drawn
  p.upper[1] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(code_of(p, "pso"), "bad_bounds");
  p.upper[1] = 0;
  EXPECT_EQ(code_of(p, "crs2"), "bad_bounds");
  p.upper[1] = 1;
  EXPECT_EQ(code_of(p, "pso", {.max_runs = 0}), "bad_settings");
}

TEST(Swarm, AParticleBehindABoundComesBackAsFarBeforeItAndFliesTheOtherWay) {
  // Thesis Eq. 4.3, x' = x_b +- |x - x_b|; its velocity is turned round with it (E-26), else it flies out again.
  double x = 10.25, v = 0.5;
  reflect(0, 10, x, v);
  EXPECT_DOUBLE_EQ(x, 9.75);
  EXPECT_EQ(v, -0.5);
  x = -3, v = -4;
  reflect(0, 10, x, v);
  EXPECT_EQ(x, 3);
  EXPECT_EQ(v, 4);
  x = 23, v = 17;  // across both bounds: 23 -> -3 -> 3
  reflect(0, 10, x, v);
  EXPECT_EQ(x, 3);
  EXPECT_EQ(v, 17);
  x = 5, v = 1;
  reflect(0, 10, x, v);
  EXPECT_EQ(x, 5);
  EXPECT_EQ(v, 1);
}

TEST(Swarm, ThePiezoCurvesEncloseTable22) {
  // Thesis Eqs. 4.11 and 4.12 at c = 0.693, for 0 to 1 V: 0.179 and 0.709 V around k = 3.889/6 V.
  const Attractor a = piezo_attractor(0, 1, 6);
  const auto& k = a.components[1];
  EXPECT_NEAR(sum_of(k.lower, 0.693), 0.179, 5e-4);
  EXPECT_NEAR(sum_of(k.upper, 0.693), 0.709, 5e-4);
  EXPECT_EQ(k.scale, 6);
}

}  // namespace
}  // namespace hysteron
