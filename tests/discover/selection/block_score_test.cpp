// The score of whole models, held against its formula and closed forms.
#include "discover/selection/block_score.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "blocks/register_all.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

Rows first_order(std::size_t n, double a, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Rows rows(n);
  double state = normal(engine) / std::sqrt(1 - a * a);
  for (double& v : rows) v = state = a * state + normal(engine);
  return rows;
}

/// 1 + 2 sum of a^k up to the first that is 0.05 or less.
double correlation_of_first_order(double a) {
  double tau = 1;
  for (double rho = a; rho > 0.05; rho *= a) tau += 2 * rho;
  return tau;
}

TEST(CorrelationRows, AreOneWhereRowsAreIndependent) { EXPECT_EQ(correlation_rows(first_order(4000, 0, 1)), 1); }

// A sample's autocorrelation at lag k is known to about sqrt(tau/N): of each set 5 % here, one in ten of the sum.
TEST(CorrelationRows, AreThoseOfAFirstOrderProcess) {
  EXPECT_NEAR(correlation_rows(first_order(200'000, 0.9, 2)) / correlation_of_first_order(0.9), 1, 0.1);
  EXPECT_NEAR(correlation_rows(first_order(1'000'000, 0.99, 3)) / correlation_of_first_order(0.99), 1, 0.1);
}

TEST(CorrelationRows, OfRowsThatAreAllZeroIsOne) { EXPECT_EQ(correlation_rows(Rows(100, 0.0)), 1); }

constexpr double sensor_noise = 1e-3;

class ScoreOf : public ::testing::Test {
 protected:
  ScoreOf() {
    std::vector<Recording> list;
    for (int r = 0; r < 3; ++r) {
      const auto t = rows(4000, 0.01);
      const auto u = several_sines(t, 1, {0.1 + 0.02 * r});
      auto y = noise(t.size(), sensor_noise, 0, 20 + static_cast<std::uint64_t>(r));
      for (std::size_t k = 0; k < t.size(); ++k) y[k] += u[k];
      list.push_back(recording(std::to_string(r) + ".csv", r < 2 ? Role::train : Role::validate, t, u, std::move(y)));
    }
    model_.emplace(compile(plain_gain(), registry_),
                   std::make_shared<const DataSet>(data_set(std::move(list), sensor_noise)));
    evidence_.emplace(*model_);
    best_ = left_rows(*evidence_, model_->predict({}, evidence_->recordings()), evidence_->noise());
  }
  /// What is left with `added` to it.
  std::vector<LeftRows> with(const std::function<double(int recording, std::size_t row)>& added) const {
    auto left = best_;
    for (auto& l : left)
      for (std::size_t i = 0; i < l.rows.size(); ++i) l.rows[i] += added(l.recording, i);
    return left;
  }
  /// By the formula: sixteen blocks of 250 rows in each recording, every row a witness.
  static double by_formula(const std::vector<LeftRows>& left) {
    double score = 0;
    for (const auto& l : left)
      for (std::size_t b = 0; b < 16; ++b) {
        double rss = 0;
        for (std::size_t i = 250 * b; i < 250 * (b + 1); ++i) rss += l.rows[i] * l.rows[i];
        score -= 0.5 * 250 * std::log(sensor_noise * sensor_noise + rss / 250);
      }
    return score;
  }
  Registry registry_ = all_blocks();
  std::optional<DataModel> model_;
  std::optional<Evidence> evidence_;
  std::vector<LeftRows> best_;
};

// Pieces are whole rows: 4000 rows in 48 pieces and 16 blocks leave a block up to a row longer than 250.
TEST_F(ScoreOf, IsTheSumOverBlocks) {
  const BlockScore score(*evidence_, {left_sums(best_)});
  EXPECT_NEAR(score.n_eff(), 12'000, 1e-6);
  EXPECT_NEAR(score.n_eff(1), 4'000, 1e-6);
  EXPECT_NEAR(score.price(2), std::log(12'000), 1e-9);
  const auto off = with([](int r, std::size_t i) { return r == 1 && i >= 2000 ? 0.01 : 0.0; });
  const double fall = score.fit_of(left_sums(best_)) - score.fit_of(left_sums(off));
  EXPECT_NEAR(fall / (by_formula(best_) - by_formula(off)), 1, 2e-3);
  EXPECT_NEAR(score.fit_of(left_sums(off), 0), score.fit_of(left_sums(best_), 0), 1e-9) << "another recording";
}

// Far from the truth only ratios count: all that is left made twice as large costs n/2 ln 4.
TEST_F(ScoreOf, CountsRatiosFarFromTheNoise) {
  const BlockScore score(*evidence_, {left_sums(best_)});
  const auto far = with([](int, std::size_t i) { return std::sin(0.1 * static_cast<double>(i)); });
  const auto twice = with([](int, std::size_t i) { return 2 * std::sin(0.1 * static_cast<double>(i)); });
  EXPECT_NEAR(score.fit_of(left_sums(far)) - score.fit_of(left_sums(twice)), 12'000 / 2.0 * std::log(4.0),
              12'000 * 1e-4);
}

TEST_F(ScoreOf, OverNoiseIsOneWhereOnlyNoiseIsLeft) {
  const BlockScore score(*evidence_, {left_sums(best_)});
  EXPECT_NEAR(score.over_noise(left_sums(best_)), 1, 0.03);  // rms of 12000 rows: 0.6 %, and its stated size
}

TEST_F(ScoreOf, LittleIsLeftWhereThatIsATenthOfWhatIsExplained) {
  const BlockScore score(*evidence_, {left_sums(best_)});
  const auto beside = [&](double size) {  // independent of the noise: squares add up
    return left_sums(with([&](int, std::size_t i) { return size * std::sin(0.1 * static_cast<double>(i)); }));
  };
  const auto before = beside(100 * sensor_noise);
  EXPECT_TRUE(score.leaves_little(left_sums(best_), before));
  EXPECT_TRUE(score.leaves_little(beside(9 * sensor_noise), before));
  EXPECT_FALSE(score.leaves_little(beside(11 * sensor_noise), before));
  EXPECT_FALSE(score.leaves_little(before, before));
}

double chi2_by(const NoiseModel& weights, const LeftSums& left) {
  double chi2 = 0;
  for (const auto& l : left) {
    const auto& rms = weights.outputs[0].pieces[static_cast<std::size_t>(l.recording)];
    for (std::size_t i = 0; i < l.squares.size(); ++i) chi2 += l.squares[i] / (rms[i] * rms[i]);
  }
  return chi2;
}

// A logarithm lies below its tangents: where chi2/2 falls by some amount the score rises by as much or more. What is
// left after the first model is drawn for each block over six decades, and what the second makes of it about as large.
TEST_F(ScoreOf, RisesByWhatItsWeightsTakeFromChi2) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> decades(-6, 0);
  std::normal_distribution<double> change(-0.2, 0.5);
  const auto left = [&](const std::vector<double>& size) {
    return left_sums(with([&](int r, std::size_t i) { return size[static_cast<std::size_t>(r) * 16 + i / 250]; }));
  };
  const BlockScore score(*evidence_, {left_sums(best_)});
  int fell = 0;
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<double> size(3 * 16);
    for (double& s : size) s = std::pow(10, decades(engine));
    const LeftSums before = left(size);
    for (double& s : size) s *= std::exp(change(engine));
    const LeftSums after = left(size);
    const NoiseModel weights = score.weights(*evidence_, before);
    const double fall = chi2_by(weights, before) - chi2_by(weights, after);
    const double rise = score.fit_of(after) - score.fit_of(before);
    EXPECT_GE(rise, fall / 2 - 1e-9 * std::abs(rise)) << trial;
    fell += fall > 0;
  }
  EXPECT_GT(fell, 10) << "otherwise little was seen";
}

// At its own weights chi2 counts witnesses less the share that is noise: V/(s^2 + V) of each block.
TEST_F(ScoreOf, WeightsMakeChi2TheNumberOfWitnesses) {
  auto left = best_;
  for (auto& l : left) {
    l.rows = first_order(4000, 0.9, 40 + static_cast<std::uint64_t>(l.recording));
    for (double& v : l.rows) v *= 1e3;  // the noise is nothing beside that
  }
  const LeftSums sums = left_sums(left);
  double witnesses = 0;
  for (const auto& l : left) witnesses += static_cast<double>(l.rows.size()) / correlation_rows(l.rows);
  const NoiseModel weights = BlockScore(*evidence_, {sums}).weights(*evidence_, sums);
  EXPECT_NEAR(chi2_by(weights, sums), witnesses, 1e-6 * witnesses);
  EXPECT_EQ(weights.outputs[0].one_over_f, 0);
}

// What one model leaves is slow and large; another that leaves white noise shows that this is no noise.
TEST_F(ScoreOf, NoiseIsWhatTheModelShowsThatLeavesLeast) {
  const auto slow = with([](int, std::size_t i) { return std::sin(0.01 * static_cast<double>(i)); });
  const BlockScore alone(*evidence_, {left_sums(slow)});
  const BlockScore both(*evidence_, {left_sums(slow), left_sums(best_)});
  EXPECT_LT(alone.n_eff(), 12'000 / 50.0) << "a period of 628 rows is a witness or two";
  EXPECT_NEAR(both.n_eff(), 12'000, 1e-6);
}

}  // namespace
}  // namespace hysteron
