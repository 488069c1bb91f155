#include "fit/model/noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/signals/row_checks.h"
#include "tests/fit/lab.h"

namespace hysteron {
namespace {

ProgramPointer gain_program() {
  Diagram d = lab::diagram("g");
  lab::add(d, "g", "gain", "u").parameters["gain"] = "1 um/V";
  return compile(d, lab::registry());
}

DataSet noisy(double noise, unsigned seed, std::size_t rows = 3000) {
  DataSet data;
  data.notes["y"].to = "y";
  data.recordings = {lab::recording("a", Role::train, 0.001, rows, [](double t) { return 3 * std::sin(5 * t); })};
  lab::measure(data, gain_program(), noise, seed);
  return data;
}

TEST(Noise, TheDataSheetIsTakenWithTheQuantisationOnTop) {
  DataSet data = noisy(1e-9, 1);
  data.notes["y"].noise.white = 3e-9;
  data.notes["y"].noise.resolution = 4e-9 * std::sqrt(12.0);
  DataModel model(gain_program(), lab::shared(data));
  const auto n = noise_before_fit(model).outputs[0];
  EXPECT_NEAR(n.white, 5e-9, 1e-18);  // 3, 4, 5
  EXPECT_EQ(n.source, NoiseSource::data_sheet);
}

TEST(Noise, ADataSheetIsCorrectedWithinItsTrustOnly) {
  for (const auto& [truth, expected] : {std::pair{1.1e-9, 1.1e-9}, std::pair{3e-9, std::sqrt(1.35) * 1e-9}}) {
    DataSet data = noisy(truth, 2);
    data.notes["y"].noise.white = 1e-9;
    data.notes["y"].noise.one_over_f = 0.0;
    DataModel model(gain_program(), lab::shared(data));
    const std::vector<int> all{0};
    const auto n = noise_from_residual(model, noise_before_fit(model), model.predict({}, all), all).outputs[0];
    EXPECT_NEAR(n.white, expected, 0.08e-9);
    EXPECT_EQ(n.source, NoiseSource::corrected);
  }
}

/// 1/f noise of rms one made by relaxing processes, each four times slower than the one before.
Rows slow_noise(std::size_t rows, unsigned seed) {
  lab::Noise random(seed);
  Rows sum(rows, 0.0);
  for (double slow = 1; slow < 2 * static_cast<double>(rows); slow *= 4) {
    const double keep = std::exp(-1 / slow), kick = std::sqrt(1 - keep * keep);
    double x = random();
    for (double& y : sum) y += x = keep * x + kick * random();
  }
  double squares = 0;
  for (const double y : sum) squares += y * y;
  for (double& y : sum) y *= std::sqrt(static_cast<double>(rows) / squares);
  return sum;
}

/// What a residual says of the share of 1/f noise, its white part being stated. `line`: a sine in it, in deviations.
double share_of(double share, double line, std::optional<double> stated = {}) {
  DataSet data = noisy(1e-9, 8);
  data.notes["y"].noise.white = 1e-9;
  data.notes["y"].noise.one_over_f = stated;
  auto& y = data.recordings[0].columns["y"];
  const auto slow = slow_noise(y.size(), 9);
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] += 1e-9 * (share * slow[i] + line * std::sin(0.05 * static_cast<double>(i)));
  DataModel model(gain_program(), lab::shared(data));
  const std::vector<int> all{0};
  return noise_from_residual(model, noise_before_fit(model), model.predict({}, all), all).outputs[0].one_over_f;
}

TEST(Noise, TheShareOfOneOverFIsReadOffTheResidualWhereNobodyStatesIt) {
  // One recording of some thousand rows tells it to a third or so, the prior draws it towards 0.3, and what of it is as
  // fast as the rows counts as white.
  EXPECT_GT(share_of(0.8, 0), 0.4);
  EXPECT_LT(share_of(0, 0), 0.15);
  EXPECT_LE(share_of(5, 0), 1.0) << "more is no sensor's noise";
  EXPECT_EQ(share_of(0.8, 0, 0.5), 0.5) << "as stated";
}

TEST(Noise, ALineInTheResidualIsNoSlowNoise) { EXPECT_LT(share_of(0, 2), 0.25); }

TEST(Noise, WithoutANoteItIsGuessedFromTheRowsAndSaidSo) {
  DataSet data = noisy(5e-9, 3);
  DataModel model(gain_program(), lab::shared(data));
  const auto n = noise_before_fit(model).outputs[0];
  EXPECT_EQ(n.source, NoiseSource::guessed);
  EXPECT_NEAR(n.white, 5e-9, 0.5e-9);
  EXPECT_NE(n.remark.find("does not say"), std::string::npos);
}

TEST(Noise, AQuantisedColumnIsNeverBetterThanItsStep) {
  DataSet data = noisy(0, 4);
  for (double& y : data.recordings[0].columns["y"]) y = 1e-7 * std::round(y / 1e-7);
  DataModel model(gain_program(), lab::shared(data));
  EXPECT_NEAR(finest_step(data.recordings[0].columns["y"]), 1e-7, 1e-12);
  EXPECT_GE(noise_before_fit(model).outputs[0].white, 1e-7 / std::sqrt(12.0) * (1 - 1e-9));
}

TEST(Noise, ContinuousValuesHaveNoResolution) {
  DataSet data = noisy(5e-9, 5);
  EXPECT_EQ(finest_step(data.recordings[0].columns["y"]), 0);
}

TEST(Noise, ARecordingSmootherThanItsSamplingIsSaidToBe) {
  // A running mean of eight rows takes the high band away: the estimate is a lower bound and must say so.
  DataSet data = noisy(5e-9, 6);
  const auto clean = noisy(0, 6).recordings[0].columns["y"];
  auto& y = data.recordings[0].columns["y"];
  Rows e(y.size());
  for (std::size_t i = 0; i < y.size(); ++i) e[i] = y[i] - clean[i];
  for (std::size_t i = 8; i < y.size(); ++i) {
    double mean = 0;
    for (std::size_t k = 0; k < 8; ++k) mean += e[i - k] / 8;
    y[i] = clean[i] + mean;
  }
  lab::Noise random(7);
  DataModel model(gain_program(), lab::shared(data));
  const std::vector<int> all{0};
  const auto n = noise_from_residual(model, noise_before_fit(model), model.predict({}, all), all).outputs[0];
  EXPECT_LT(n.white, 3e-9);
  EXPECT_NE(n.remark.find("smoother than its sampling"), std::string::npos) << n.remark;
}

}  // namespace
}  // namespace hysteron
