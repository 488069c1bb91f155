// The swarms of the thesis on the loop of the surrogate, held against what an independent program found there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fit/estimate/global.h"
#include "models/hysteresis/jiles_atherton.h"
#include "tests/fit/surrogate.h"

namespace hysteron {
namespace {

/// Fitness of SPEC 4.3 [um^2], told for N = 2000: second cycle from rest, zero at the bottom.
class Fitness {
 public:
  Fitness() {
    std::vector<double> instants;
    for (std::size_t k = 0; k < rows; ++k) instants.push_back(1 + 0.2 * static_cast<double>(k) / rows);
    const Traces traces = surrogate::open_loop("sine", instants);
    u_ = traces.values[0];
    for (const double y : traces.values[2]) y_.push_back(1e6 * (y - traces.values[2][0]));
  }
  double operator()(const Point& x, bool scaled) const {
    const jiles_atherton::Params<double> p{x[0], x[1], x[2], x[3], x[4]};
    double at = move(p, move(p, 0, u_[0], u_[rows / 2]), u_[rows / 2], u_[0]);
    std::vector<double> loop{at};
    for (std::size_t k = 1; k < rows; ++k) loop.push_back(at = move(p, at, u_[k - 1], u_[k]));
    const double scale = scaled ? stroke(y_) / stroke(loop) : 1;
    double sum = 0;
    for (std::size_t k = 0; k < rows; ++k) sum += std::pow(scale * (loop[k] - loop[0]) - y_[k], 2);
    return sum * 2000 / rows;
  }

 private:
  static constexpr std::size_t rows = 100;
  static double move(const jiles_atherton::Params<double>& p, double at, double from, double to) {
    return jiles_atherton::polarisation_after(p, at, from, to, 1e-6);
  }
  static double stroke(const std::vector<double>& y) {
    const auto [low, high] = std::minmax_element(y.begin(), y.end());
    return *high - *low;
  }
  std::vector<double> u_, y_;
};

double middle(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

TEST(SwarmOnTheSurrogate, ReachesTheMediansOfAnIndependentProgramAndTheOrderingOfTheThesis) {
  const Fitness fitness;
  GlobalProblem problem;
  problem.lower = {1, 1, 0.005, 0.01, 0.001};  // thesis Table 4.1: P_s, a, alpha, k, c
  problem.upper = {100, 100, 0.5, 10, 0.999};
  problem.cost = [&](const Point& x) { return fitness(x, false); };
  problem.scaled_cost = [&](const Point& x) { return fitness(x, true); };
  problem.attractor = piezo_attractor(4, 3, 6);
  constexpr int seeds = 10;
  constexpr long fifty = 5 + 5 * 50, hundred = 505;  // runs after that many iterations
  int below = 0;
  std::vector<double> npso_50, npso_100, nmpso_100;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    GlobalSettings settings;
    settings.seed = seed;
    const auto pso = minimize_globally(problem, "pso", settings);
    const auto npso = minimize_globally(problem, "npso", settings);
    const auto nmpso = minimize_globally(problem, "nmpso", settings);
    below += npso.cost_after(hundred) < pso.cost_after(hundred) ? 1 : 0;
    npso_50.push_back(npso.cost_after(fifty));
    npso_100.push_back(npso.cost_after(hundred));
    nmpso_100.push_back(nmpso.cost_after(hundred));
    EXPECT_GT(npso.cost, 0.97);  // the optimum by least squares: 4.87 for N = 10000
  }
  // Claims C4-09 and C4-10, SPEC 4.3: NPSO below PSO in 90 % of 30 seeds, at least 75 % asked for; both ends alike.
  EXPECT_GE(below, 0.75 * seeds);
  // Medians 1.45 after 50, 1.396 and 1.398 after 100. Quartiles of 30 seeds lie within 5 % (50) and 2 % (100), the
  // median of ten a third of that further out.
  EXPECT_NEAR(middle(npso_50), 1.45, 0.07 * 1.45);
  EXPECT_NEAR(middle(npso_100), 1.396, 0.03 * 1.396);
  EXPECT_NEAR(middle(nmpso_100), 1.398, 0.03 * 1.398);
}

}  // namespace
}  // namespace hysteron
