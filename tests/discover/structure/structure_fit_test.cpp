// Structures of which it is known what they take away, and by how many numbers.
#include "discover/structure/structure_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "blocks/register_all.h"
#include "discover/structure/residual_parts.h"
#include "engine/program/program.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

constexpr double rounding = 1e-9;  // of rows of 1: normal equations lose half of 16 digits

/// Rows of two recordings without noise, u from 0 to 1 V, and what is left of them.
class StructureFits : public ::testing::Test {
 protected:
  using Hidden = std::function<double(double t, double u, int recording)>;

  StructureFit fitted(const Structure& s, const Hidden& hidden, bool with_gain = false) {
    std::vector<Recording> list;
    for (int r = 0; r < 2; ++r) {
      const auto t = rows(300 + 100 * r, 0.01);
      const auto u = several_sines(t, 1, {0.4 + 0.1 * r, 0.9});
      std::vector<double> y = u;
      for (std::size_t k = 0; k < t.size(); ++k) y[k] += hidden(t[k], u[k], r);
      list.push_back(recording(std::to_string(r) + ".csv", r < 1 ? Role::train : Role::validate, t, u, y));
    }
    const auto data = std::make_shared<const DataSet>(data_set(list, 1e-3, 0));
    DataModel model(compile(plain_gain(), registry), data);
    const Evidence evidence(model);
    const Prediction p = model.predict({}, evidence.recordings());
    const ResidualParts parts(evidence, p, 0);
    std::vector<Rows> rows_left, weights;
    for (const auto& part : parts.list()) {
      Rows e;
      for (std::size_t k = 0; k < part.t.size(); ++k)
        e.push_back(hidden(part.t[k], list[static_cast<std::size_t>(part.recording)].columns["u"][k], part.recording));
      rows_left.push_back(std::move(e));
      weights.emplace_back(part.t.size(), 1.0);
    }
    return fit_structure(s, parts, rows_left, weights, with_gain);
  }
  static Structure structure(const std::string& kind, const std::string& variable) {
    Structure s;
    s.kind = kind;
    s.variable = variable;
    s.output = "y";
    return s;
  }
  static double largest(const StructureFit& fit) {
    double most = 0;
    for (const auto& rows : fit.left)
      for (const double v : rows) most = std::max(most, std::abs(v));
    return most;
  }
  Registry registry = all_blocks();
};

TEST_F(StructureFits, ALineHasAnAmplitudeAndAPhaseInEachRecording) {
  Structure s = structure("line_in_time", "t");
  s.period = 0.07;
  const auto line = [](double t, double, int r) {
    return (1 + r) * std::sin(2 * std::numbers::pi * t / 0.07 + 0.4 * r);
  };
  const StructureFit fit = fitted(s, line);
  EXPECT_LT(largest(fit), rounding);
  EXPECT_EQ(fit.numbers, 3 + 2 * 2);
}

TEST_F(StructureFits, AStepThatLeansIsThatAtALevel) {
  Structure s = structure("kink_at_level", "u");
  s.threshold = 0.5;
  s.has_threshold = true;
  const auto bump = [](double, double u, int) { return u > 0.5 ? 0.2 + 0.7 * (u - 0.5) : 0.0; };
  const StructureFit fit = fitted(s, bump);
  EXPECT_LT(largest(fit), rounding);
  EXPECT_EQ(fit.numbers, 2 + 2);
}

TEST_F(StructureFits, BesideAGainAndAnOffset) {
  Structure s = structure("line_in_level", "u");
  s.period = 0.13;
  const auto ripple = [](double, double u, int) {
    return 0.1 * u - 0.3 + 0.2 * std::cos(2 * std::numbers::pi * u / 0.13 + 1) +
           0.05 * std::sin(4 * std::numbers::pi * u / 0.13);
  };
  EXPECT_GT(largest(fitted(s, ripple)), 0.1);
  const StructureFit fit = fitted(s, ripple, true);
  EXPECT_LT(largest(fit), rounding);
  EXPECT_EQ(fit.numbers, 3 + 4 + 2);  // with its second harmonic
}

TEST_F(StructureFits, BetweenJumpsItIsLevel) {
  Structure s = structure("jumps", "t");
  s.intervals = {{"0.csv", {{0.99, 1.0}, {1.99, 2.0}}}, {"1.csv", {{2.99, 3.0}}}};
  const auto levels = [](double t, double, int r) {
    if (r == 1) return t < 2.995 ? 0.5 : -0.25;
    return t < 0.995 ? 0.0 : t < 1.995 ? 1.0 : 3.0;
  };
  const StructureFit fit = fitted(s, levels);
  EXPECT_LT(largest(fit), rounding);
  EXPECT_EQ(fit.numbers, 3 + 2 + 2 * 3);  // a height between any two jumps, and where each is
}

TEST_F(StructureFits, BurstsExplainNothing) {
  const StructureFit fit = fitted(structure("bursts", "t"), [](double, double, int) { return 1.0; });
  EXPECT_EQ(fit.numbers, 0);
  EXPECT_EQ(largest(fit), 1.0);
}

}  // namespace
}  // namespace hysteron
