// An error that comes again at the same positions, hidden by its formula.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;
using std::numbers::pi;

class PeriodicErrors : public Discoveries {};

constexpr double pitch = 0.25;  // [m] of a way of 5 m

/// What a scale tells of a position, all [m].
double read(double position, double once, double twice) {
  return position + once * std::sin(2 * pi * position / pitch) + twice * std::cos(4 * pi * position / pitch);
}

/// Sweeps there and back at three speeds, with an error [m] once and twice a pitch and noise of 1 mm. The scale of each
/// begins somewhere else by `apart` [m] more, and reads so much more.
DataSet sweeps(double once, double twice, double apart = 0) {
  std::vector<Recording> list;
  std::uint64_t seed = 4100;
  for (const auto& [role, periods] : {std::pair{Role::train, 1}, {Role::train, 3}, {Role::validate, 2}}) {
    const auto t = rows(1500, 0.01);
    const auto u = decaying_triangle(t, 5, periods);
    auto y = noise(t.size(), 1e-3, 0, seed);
    for (std::size_t k = 0; k < y.size(); ++k)
      y[k] += read(u[k] + apart * static_cast<double>(list.size()), once, twice);
    list.push_back(recording(std::to_string(seed++) + ".csv", role, t, u, y));
  }
  return data_set(list, 1e-3, 0);
}

TEST_F(PeriodicErrors, AreNamedWithTheirPeriodAndBothHarmonics) {
  const Discovery d = diagnosed(plain_gain(), sweeps(0.02, 0.008));
  ASSERT_EQ(winner(d), "periodic_error") << tried(d);
  // 3000 rows with noise of 1 mm tell an amplitude to 1 mm sqrt(2/3000) = 0.026 mm and the phase of 20 mm to 1.3e-3
  // rad. Over a way with an rms of 6 periods about its middle that is 1.3e-3/(2 pi 6) of the period: five times each,
  // for the gain is free beside them, and 0.2 mm.
  EXPECT_NEAR(value(d, "period"), pitch, 5 * pitch * 1.3e-3 / (2 * pi * 6));
  EXPECT_NEAR(value(d, "sine"), 0.02, 2e-4);
  EXPECT_NEAR(value(d, "second_cosine"), 0.008, 2e-4);
}

TEST_F(PeriodicErrors, HaveAPhaseOfTheirOwnWhereEachRecordingHasAZeroOfItsOwn) {
  // 1.3 m are 5.2 periods; the constant is a thousand times the noise.
  DataSet data = sweeps(0.02, 0.008, 1.3);
  data.notes["y"].zero_per_recording = true;
  const Discovery d = diagnosed(plain_gain(), data);
  ASSERT_EQ(winner(d), "periodic_error") << tried(d);
  EXPECT_NEAR(value(d, "period"), pitch, 5 * pitch * 1.3e-3 / (2 * pi * 6));  // as above
}

TEST_F(PeriodicErrors, OfNoSizeAreNotClaimed) {
  const Discovery d = diagnosed(plain_gain(), sweeps(0, 0));
  EXPECT_TRUE(d.steps.empty()) << tried(d);
}

}  // namespace
}  // namespace hysteron
