// What counts as evidence, on residuals whose chi2 is known.
#include "discover/evidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "blocks/register_all.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

constexpr double white = 1e-3;

class EvidenceOf : public ::testing::Test {
 protected:
  /// Three recordings of a gain of one, noise of 1 mm and `added` to it.
  DataModel measured(const std::function<double(double t, double u)>& added, double noisy = 1) {
    std::vector<Recording> list;
    for (int r = 0; r < 3; ++r) {
      const auto t = rows(4000, 0.01);
      const auto u = several_sines(t, 1, {0.1 + 0.02 * r});
      auto y = noise(t.size(), noisy * white, 0, 20 + static_cast<std::uint64_t>(r));
      for (std::size_t k = 0; k < t.size(); ++k) y[k] += u[k] + added(t[k], u[k]);
      list.push_back(recording(std::to_string(r) + ".csv", r < 2 ? Role::train : Role::validate, t, u, std::move(y)));
    }
    return {compile(plain_gain(), registry_), std::make_shared<const DataSet>(data_set(std::move(list), white, 0))};
  }
  static OverFloor over(DataModel model) {
    const Evidence evidence(model);
    return evidence.over_usual_floor(model.predict({}, evidence.recordings()));
  }

 private:
  Registry registry_ = all_blocks();
};

TEST_F(EvidenceOf, WhatIsInFewCosinesStandsOutInItsOctave) {
  // A slow sine of 0.25 of the noise: 0.031 of chi2 in each of 12000 rows, 375 in all, in the octave
  // of 32 to 63 half periods of 40 s, where there are 96 coefficients: 375/sqrt(192) = 27 deviations, with four of
  // chance.
  const auto slow = [](double t, double) { return 0.25 * white * std::sin(2 * std::numbers::pi * 0.55 * t); };
  const OverFloor with = over(measured(slow)), without = over(measured([](double, double) { return 0.0; }));
  EXPECT_NEAR(with.octave, 27, 4);
  EXPECT_LT(with.all, 1.12);
  // The highest of twelve octaves of chance, the first of three coefficients only.
  EXPECT_LT(without.octave, 4);
}

TEST_F(EvidenceOf, TheBestLineOfASensorIsFoundOverAllRecordings) {
  DataModel model = measured([](double, double u) { return 0.03 * u - 0.2; }, 0);
  const Evidence evidence(model);
  const Prediction read = evidence.calibrated(model.predict({}, evidence.recordings()), 0);
  for (const int r : evidence.recordings())
    for (std::size_t k = 0; k < read.y[static_cast<std::size_t>(r)][0].size(); ++k)
      // Values are about one; the squares of a least-squares line round to 1e-12.
      ASSERT_NEAR(read.y[static_cast<std::size_t>(r)][0][k], model.measured(r, 0)[k], 1e-9);
}

}  // namespace
}  // namespace hysteron
