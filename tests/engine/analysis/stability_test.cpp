// The count of unstable poles against closed forms, eigenvalues, and a spectral discretisation of the delay equation.
#include "engine/analysis/stability.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "engine/analysis/margins.h"
#include "tests/engine/linear_models.h"

namespace hysteron {
namespace {

using std::numbers::pi;
using tools::loop_of;
using tools::product;
using Complex = std::complex<double>;

TEST(Stability, AnIntegratorAndTwoLagsBearAGainBelowTwo) {
  const auto loop = loop_of({1}, {1, 2, 1, 0});  // 1/(s (s + 1)^2): Routh
  EXPECT_TRUE(unstable_when_closed(loop, 1.99).stable());
  EXPECT_EQ(unstable_when_closed(loop, 2.01).outside, 2);
  EXPECT_EQ(unstable_when_closed(loop, 2).outside, 0);
  EXPECT_EQ(unstable_when_closed(loop, 2).on_the_limit, 2) << "poles at +-j";
}

TEST(Stability, AnUnstablePlantNeedsAGainAboveItsPole) {
  const auto loop = loop_of({1}, {1, -1});
  EXPECT_EQ(unstable_when_closed(loop, 0.9).outside, 1);
  EXPECT_TRUE(unstable_when_closed(loop, 1.1).stable());
  const auto late = loop_of({1}, {1, -1}, 0.3);
  // With a dead time T < 1: stable between k = 1 and the gain at the phase -180 deg, where w = tan(w T).
  double w = 2;
  for (int i = 0; i < 60; ++i) w -= (std::atan(w) - 0.3 * w) / (1 / (1 + w * w) - 0.3);
  const double most = std::sqrt(1 + w * w);
  EXPECT_EQ(unstable_when_closed(late, 0.99).outside, 1);
  EXPECT_TRUE(unstable_when_closed(late, 1.01).stable());
  EXPECT_TRUE(unstable_when_closed(late, 0.999 * most).stable());
  EXPECT_EQ(unstable_when_closed(late, 1.001 * most).outside, 2);
}

TEST(Stability, ADeadTimeAroundAnIntegratorMakesOnePairAfterTheOther) {
  // s + k exp(-s T): pairs of roots pass the axis at k T = pi/2 + 2 pi m, all to the right.
  for (const double x : {0.1, 1.5, 1.6, 7.8, 7.9, 14.1, 14.2, 100.0, 1000.0}) {
    const int pairs = x < pi / 2 ? 0 : static_cast<int>(std::floor((x - pi / 2) / (2 * pi))) + 1;
    EXPECT_EQ(unstable_when_closed(loop_of({1}, {1, 0}, 1), x).outside, 2 * pairs) << x;
    EXPECT_EQ(unstable_when_closed(loop_of({1}, {1, 0}, x), 1).outside, 2 * pairs) << x;
  }
}

TEST(Stability, APairOnTheAxisIsOnTheLimit) {
  const auto count = unstable_when_closed(loop_of({1}, {1, 0}, 1), pi / 2);
  EXPECT_EQ(count.outside, 0);
  EXPECT_EQ(count.on_the_limit, 2);
}

TEST(Stability, ADeadTimeWithoutDynamicsBearsGainsBelowOne) {
  EXPECT_TRUE(unstable_when_closed(loop_of({1}, {1}, 0.01), 0.99).stable());
  EXPECT_TRUE(unstable_when_closed(loop_of({1}, {1}, 0.01), 1.01).endless);
  EXPECT_TRUE(unstable_when_closed(loop_of({1}, {1}, 0.01), -1.01).endless);
  // (s + 3)/(s + 1): 3 at rest, 1 far out.
  EXPECT_TRUE(unstable_when_closed(loop_of({1, 3}, {1, 1}, 0.5), 1.1).endless);
  EXPECT_GT(unstable_when_closed(loop_of({1, 3}, {1, 1}, 5), 0.9).outside, 0);
  EXPECT_TRUE(unstable_when_closed(loop_of({1, 3}, {1, 1}, 5), 0.3).stable());
}

TEST(Stability, TheLoopOfADampedModeBehindALagAndADeadTimeHasTwo) {
  // 0.9 exp(-1.6 s) / ((0.4 s + 1) (s^2/1.6^2 + 2 0.01 s/1.6 + 1))
  const auto loop = loop_of({2.304 / 0.4}, {1, 1.0128 / 0.4, 1.056 / 0.4, 2.56 / 0.4}, 1.6);
  EXPECT_EQ(unstable_when_closed(loop).outside, 2);
}

/// Modes of 1 rad/s side by side, and a dead time that moves none of them.
LinearModel modes(const std::vector<double>& dampings) {
  const std::size_t n = 2 * dampings.size();
  auto m = loop_of({0}, std::vector<double>(n + 1, 1.0), 3.0);
  m.inputs = m.outputs = 0;
  m.b = m.c = m.d = m.d_delayed = m.to_delays_from_inputs = {};
  m.a.assign(n * n, 0.0);
  for (std::size_t i = 0; i < dampings.size(); ++i) {
    m.a[2 * i * n + 2 * i + 1] = 1;
    m.a[(2 * i + 1) * n + 2 * i] = -1;
    m.a[(2 * i + 1) * n + 2 * i + 1] = -2 * dampings[i];
    m.to_delays[2 * i] = 1;
    m.to_delays[2 * i + 1] = 1;
  }
  return m;
}

TEST(Stability, EqualModesWithNextToNoDampingAreNotStriddenOver) {
  // Six roots within 1e-6 of the axis, whose turns add up to three whole ones.
  EXPECT_TRUE(unstable_poles(modes({1e-6, 1e-6, 1e-6})).stable());
  EXPECT_EQ(unstable_poles(modes({-1e-6, -1e-6, -1e-6})).outside, 6);
  EXPECT_EQ(unstable_poles(modes({1e-6, -1e-6})).outside, 2);
  const auto limit = unstable_poles(modes({0, 1e-6, -1e-6}));
  EXPECT_EQ(limit.outside, 2);
  EXPECT_EQ(limit.on_the_limit, 2);
}

std::vector<double> random_denominator(std::mt19937_64& random, int order) {
  std::uniform_real_distribution<double> u(0, 1);
  std::vector<double> den{1};
  for (int left = order; left > 0;) {
    const double w = std::pow(10.0, 3 * u(random) - 1);
    if (left >= 2 && u(random) < 0.6) {
      const double damping = u(random) < 0.15 ? -0.3 * u(random) : std::pow(10.0, -3 * u(random));
      den = product(den, {1, 2 * damping * w, w * w});
      left -= 2;
    } else {
      const double kind = u(random);
      den = product(den, {1, kind < 0.15 ? 0 : kind < 0.25 ? -w : w});
      left -= 1;
    }
  }
  return den;
}

struct RandomLoop {
  std::vector<double> num, den;
};
RandomLoop random_loop(std::mt19937_64& random) {
  std::uniform_real_distribution<double> u(0, 1);
  const int order = 1 + static_cast<int>(5 * u(random));
  RandomLoop l{{1}, random_denominator(random, order)};
  for (int i = 0; i < static_cast<int>(order * u(random)); ++i)
    l.num = product(l.num, {1, (u(random) < 0.2 ? -1 : 1) * std::pow(10.0, 3 * u(random) - 1)});
  // A gain that puts |L| near one somewhere.
  const double w = std::pow(10.0, 3 * u(random) - 1);
  const auto value = [&](const std::vector<double>& p) {
    Complex sum = 0;
    for (const double c : p) sum = sum * Complex(0, w) + c;
    return std::abs(sum);
  };
  const double gain = std::pow(10.0, u(random) - 0.5) * value(l.den) / value(l.num);
  for (double& c : l.num) c *= gain;
  return l;
}

TEST(Stability, TheCountAlongTheAxisIsThatOfTheEigenvalues) {
  // A dead time of 0 s makes the count walk along the axis, though the loop has eigenvalues.
  std::mt19937_64 random(46);
  int compared = 0, unstable = 0;
  for (int i = 0; i < 600; ++i) {
    const auto l = random_loop(random);
    const auto expected = unstable_when_closed(loop_of(l.num, l.den));
    if (expected.on_the_limit > 0) continue;
    const auto found = unstable_when_closed(loop_of(l.num, l.den, 0.0));
    EXPECT_EQ(found.outside, expected.outside) << "loop " << i;
    EXPECT_EQ(found.on_the_limit, 0) << "loop " << i;
    ++compared;
    unstable += expected.outside > 0 ? 1 : 0;
  }
  EXPECT_GT(compared, 580);
  EXPECT_GT(unstable, 150);
  EXPECT_LT(unstable, 550);
}

/// Unstable roots of x' = A x(t) + sum B_i x(t - tau_i) by Chebyshev collocation of its generator, with the smallest
/// distance of a root from the axis over its size. Source: Breda, Maset, Vermiglio, SIAM J. Sci. Comput. 27 (2005)
/// 482-495.
struct Collocation {
  int outside = 0;
  double nearest = 1e300;
};
Collocation collocated(const Eigen::MatrixXd& a, const std::vector<Eigen::MatrixXd>& b, const std::vector<double>& tau,
                       int nodes) {
  const Eigen::Index n = a.rows();
  const double longest = *std::max_element(tau.begin(), tau.end());
  std::vector<double> x, weight;
  for (int k = 0; k <= nodes; ++k) {
    x.push_back(longest / 2 * (std::cos(pi * k / nodes) - 1));  // 0 ... -longest
    weight.push_back((k % 2 == 0 ? 1 : -1) * (k == 0 || k == nodes ? 0.5 : 1));
  }
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  const auto basis = [&](double t) {  // barycentric
    std::vector<double> l(at(nodes) + 1, 0.0);
    double sum = 0;
    for (int k = 0; k <= nodes; ++k) {
      if (t == x[at(k)]) {
        std::fill(l.begin(), l.end(), 0.0);
        l[at(k)] = 1;
        return l;
      }
      l[at(k)] = weight[at(k)] / (t - x[at(k)]);
      sum += l[at(k)];
    }
    for (double& v : l) v /= sum;
    return l;
  };
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(n * (nodes + 1), n * (nodes + 1));
  g.topLeftCorner(n, n) = a;
  for (std::size_t i = 0; i < tau.size(); ++i) {
    const auto l = basis(-tau[i]);
    for (int k = 0; k <= nodes; ++k) g.block(0, k * n, n, n) += l[at(k)] * b[i];
  }
  for (int j = 1; j <= nodes; ++j) {
    double diagonal = 0;
    for (int k = 0; k <= nodes; ++k) {
      if (k == j) continue;
      const double d = weight[at(k)] / weight[at(j)] / (x[at(j)] - x[at(k)]);
      g.block(j * n, k * n, n, n).diagonal().setConstant(d);
      diagonal -= d;
    }
    g.block(j * n, j * n, n, n).diagonal().setConstant(diagonal);
  }
  Collocation result;
  for (const auto& p : g.eigenvalues()) {
    result.outside += p.real() > 0 ? 1 : 0;
    result.nearest = std::min(result.nearest, std::abs(p.real()) / (std::abs(p) + 1 / longest));
  }
  return result;
}

/// Counts of unstable poles beside those of the collocation, which takes most of a second for each loop.
void expect_counts_of_the_collocation(unsigned seed, int loops) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(0, 1);
  int compared = 0, unstable = 0;
  for (int i = 0; i < loops; ++i) {
    const auto l = random_loop(random);
    // Roots on the right lie below the last frequency at which |L| is one: dead times turn it by 12 rad at most, which
    // so many nodes resolve.
    const auto own = loop_of(l.num, l.den);
    double last = 0.1;
    for (double w = 0.01; w < 1e5; w *= 1.05)
      if (std::abs(own.response(w).front()) > 0.5) last = w;
    for (const auto& p : own.poles())
      if (std::abs(p.real()) < 0.2 * std::abs(p)) last = std::max(last, std::abs(p));
    auto loop = loop_of(l.num, l.den, 12 * u(random) / last);
    if (loop.to_delays_from_inputs.front() != 0) continue;  // retarded ones only
    const bool two = u(random) < 0.5;
    const auto n = static_cast<std::size_t>(loop.states);
    if (two) {  // a second way back, from the first state, with a dead time of its own
      loop.delays.push_back(6 * u(random) / last);
      loop.factors.push_back(1.0);
      loop.to_delays.insert(loop.to_delays.end(), n, 0.0);
      loop.to_delays[n] = 0.3 * u(random) * loop.to_delays[0];
      loop.to_delays_from_inputs.push_back(0);
      loop.b_delayed.assign(2 * n, 0.0);
      loop.d_delayed = {1, 1};
      loop.between_delays.assign(4, 0.0);
    }
    const auto closed = loop.closed();
    const auto size = static_cast<Eigen::Index>(n), k = static_cast<Eigen::Index>(closed.delays.size());
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Rows a = Eigen::Map<const Rows>(closed.a.data(), size, size),
               b = Eigen::Map<const Rows>(closed.b_delayed.data(), size, k),
               c = Eigen::Map<const Rows>(closed.to_delays.data(), k, size);
    std::vector<Eigen::MatrixXd> late;
    for (Eigen::Index q = 0; q < k; ++q) late.emplace_back(b.col(q) * c.row(q));
    const auto coarse = collocated(a, late, closed.delays, 24), fine = collocated(a, late, closed.delays, 32);
    // Where the reference itself does not know.
    if (coarse.outside != fine.outside || fine.nearest < 1e-4) continue;
    const auto found = unstable_poles(closed);
    EXPECT_EQ(found.outside, fine.outside) << "loop " << i;
    ++compared;
    unstable += fine.outside > 0 ? 1 : 0;
  }
  // Loops of both kinds are among them.
  EXPECT_GT(compared, loops / 2);
  EXPECT_GT(unstable, loops / 5);
  EXPECT_LT(unstable, compared - loops / 10);
}

TEST(Stability, TheCountWithDeadTimesIsThatOfTheCollocation) { expect_counts_of_the_collocation(784, 40); }

TEST(LongStability, TheCountWithDeadTimesIsThatOfTheCollocation) { expect_counts_of_the_collocation(785, 150); }

Margins margins_of(const LinearModel& loop) {
  const Response response = [&](double w) { return loop.response(w).front(); };
  double longest = 0;
  for (const double d : loop.delays) longest = std::max(longest, d);
  const Bode b = bode(response, widened(response, frequencies(loop.poles(), longest)), longest);
  std::vector<GainLimit> ends;
  const auto poles = loop.poles();
  if (std::find(poles.begin(), poles.end(), 0.0) == poles.end())
    if (const auto limit = gain_limit_at_end(response(0).real(), 0)) ends.push_back(*limit);
  return margins(
      response, b, [&](double gain) { return unstable_when_closed(loop, gain).stable(); }, ends);
}

TEST(Stability, TheDelayMarginIsTheSmallestOverAllCrossings) {
  // A mode behind an integrator: |L| is 1 at a low frequency with much phase, and on both sides of the mode with less
  // time.
  const auto loop = loop_of({5}, product({1, 0}, {1, 0.1, 100}));
  const auto m = margins_of(loop);
  ASSERT_TRUE(m.stable);
  ASSERT_TRUE(m.delay_margin);
  const auto late = [&](double delay) {
    return unstable_when_closed(loop_of({5}, product({1, 0}, {1, 0.1, 100}), delay));
  };
  EXPECT_TRUE(late(*m.delay_margin * 0.999).stable());
  EXPECT_GT(late(*m.delay_margin * 1.001).outside, 0);
}

TEST(Stability, MarginsOfRandomLoopsAreWhereTheCountChanges) {
  std::mt19937_64 random(961);
  int stable = 0, bounded = 0;
  for (int i = 0; i < 200; ++i) {
    const auto l = random_loop(random);
    if (l.num.size() >= l.den.size()) continue;
    const auto loop = loop_of(l.num, l.den);
    const auto now = unstable_when_closed(loop);
    if (now.on_the_limit > 0) continue;
    const auto m = margins_of(loop);
    EXPECT_EQ(m.stable, now.outside == 0);
    EXPECT_EQ(m.delay_margin.has_value(), m.stable && m.phase_margin.has_value()) << i;
    stable += m.stable ? 1 : 0;
    for (const auto& limit : {m.gain_from, m.gain_to}) {
      if (!limit) continue;
      ++bounded;
      const bool below = unstable_when_closed(loop, limit->factor * (1 - 1e-6)).outside == 0;
      const bool above = unstable_when_closed(loop, limit->factor * (1 + 1e-6)).outside == 0;
      EXPECT_NE(below, above) << "loop " << i << " at gain " << limit->factor;
    }
    if (m.delay_margin && *m.delay_margin > 0) {
      EXPECT_TRUE(unstable_when_closed(loop_of(l.num, l.den, *m.delay_margin * (1 - 1e-4))).stable()) << i;
      EXPECT_GT(unstable_when_closed(loop_of(l.num, l.den, *m.delay_margin * (1 + 1e-4))).outside, 0) << i;
    }
  }
  EXPECT_GT(stable, 40);
  EXPECT_GT(bounded, 60);
}

}  // namespace
}  // namespace hysteron
