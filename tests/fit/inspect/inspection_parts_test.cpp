// What rows, a drive and a repetition say by themselves: found where it was put in, silent where it was not.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "fit/signals/excitation.h"
#include "fit/signals/interference.h"
#include "fit/signals/periodic_part.h"
#include "fit/signals/repeatability.h"
#include "fit/signals/row_checks.h"
#include "tests/fit/lab.h"

namespace hysteron {
namespace {

constexpr double pi = std::numbers::pi;

std::vector<double> rows(std::size_t n, const std::function<double(std::size_t)>& value) {
  std::vector<double> list;
  for (std::size_t i = 0; i < n; ++i) list.push_back(value(i));
  return list;
}
std::vector<double> noise(std::size_t n, double rms, unsigned seed) {
  lab::Noise random(seed);
  return rows(n, [&](std::size_t) { return rms * random(); });
}
std::vector<double> sine(std::size_t n, double cycles_per_row, double amplitude = 1) {
  return rows(n, [&](std::size_t i) { return amplitude * std::sin(2 * pi * cycles_per_row * static_cast<double>(i)); });
}
double quantized(double x, double step) { return step * std::round(x / step); }

// --- clock ------------------------------------------------------------------------------------------------------

TEST(ClockOfRows, CountsTheRowsThatAGapLacks) {
  auto t = rows(1000, [](std::size_t i) { return 1e-3 * static_cast<double>(i); });
  t.erase(t.begin() + 500, t.begin() + 503);
  t.erase(t.begin() + 100);
  const Clock c = clock_of(t);
  EXPECT_NEAR(c.step, 1e-3, 1e-12);
  ASSERT_EQ(c.gaps.size(), 2U);
  EXPECT_EQ(c.gaps[1].missing, 3);
  EXPECT_EQ(c.missing(), 4);
  EXPECT_TRUE(c.uniform);  // but for the gaps
}

TEST(ClockOfRows, IsUniformToTheDigitsWritten) {
  // 610.35 Hz with four decimals of a second: steps of 1.6 and 1.7 ms.
  const auto t = rows(1000, [](std::size_t i) { return quantized(static_cast<double>(i) / 610.35, 1e-4); });
  const Clock c = clock_of(t);
  EXPECT_TRUE(c.uniform);
  EXPECT_TRUE(c.gaps.empty());
}

TEST(ClockOfRows, KnowsJitterFromTimesThatFollowNoClock) {
  lab::Noise random(1);
  const auto jittered = rows(1000, [&](std::size_t i) { return static_cast<double>(i) + 0.02 * random.uniform(); });
  EXPECT_TRUE(clock_of(jittered).regular);
  EXPECT_FALSE(clock_of(jittered).uniform);
  EXPECT_NEAR(clock_of(jittered).jitter, 0.02, 0.005);  // the largest of a thousand triangular deviations
  const auto logarithmic = rows(200, [](std::size_t i) { return std::pow(10, 0.02 * static_cast<double>(i)); });
  EXPECT_FALSE(clock_of(logarithmic).regular);
  EXPECT_TRUE(clock_of(logarithmic).gaps.empty());
}

// --- finest step ------------------------------------------------------------------------------------------------

TEST(FinestStep, IsFoundThoughTheLevelsWereWrittenWithFewDigits) {
  // 16 bits over 16 um = 0.244141 nm, written with 0.01 nm.
  const auto clean = noise(5000, 3, 2);
  const auto y = rows(5000, [&](std::size_t i) { return quantized(quantized(clean[i], 0.244141), 0.01); });
  EXPECT_NEAR(finest_step(y), 0.244141, 1e-4);
}

TEST(FinestStep, SurvivesAJumpOverLevelsThatNobodyVisited) {
  const auto a = noise(500, 3, 3);
  const auto y = rows(
      1000, [&](std::size_t i) { return quantized(quantized(a[i % 500] + (i < 500 ? 0 : 6832.117), 0.244141), 0.01); });
  EXPECT_NEAR(finest_step(y), 0.244141, 1e-3);
}

TEST(FinestStep, OfNoiseThatNobodyQuantizedIsNone) { EXPECT_EQ(finest_step(noise(20000, 1, 4)), 0); }

// --- lost and repeated rows -------------------------------------------------------------------------------------

TEST(RepeatsInMotion, AreFoundInASmoothSignalAndNotAtItsTurns) {
  auto u = sine(2000, 0.005);
  EXPECT_TRUE(repeats_in_motion(u, 0).empty());
  u[1001] = u[1000];  // at a zero crossing: the reading was not fetched, the next one catches up
  EXPECT_EQ(repeats_in_motion(u, 0), std::vector<std::size_t>{1001});
}

TEST(RepeatsInMotion, AreNotSeenInStairsHoldsOrCoarseLevels) {
  const auto stairs = rows(2000, [](std::size_t i) { return static_cast<double>(i / 10); });
  EXPECT_TRUE(repeats_in_motion(stairs, 1).empty());
  const auto coarse = rows(2000, [](std::size_t i) { return quantized(0.9 * static_cast<double>(i), 1); });
  EXPECT_TRUE(repeats_in_motion(coarse, 1).empty());
}

TEST(LeapsInMotion, ShowARowThatWasLostWithoutATrace) {
  auto u = sine(2000, 0.005);
  EXPECT_TRUE(leaps_in_motion(u, 0).empty());
  u.erase(u.begin() + 1001);
  EXPECT_EQ(leaps_in_motion(u, 0), std::vector<std::size_t>{1001});
}

TEST(UnexplainedRepeats, AreCountedInNoiseWithLevelsAndWithout) {
  for (const double q : {0.0, 0.1}) {
    auto y = noise(20000, 1, 5);
    if (q > 0)
      for (double& v : y) v = quantized(v, q);
    EXPECT_EQ(unexplained_repeats(y, q), 0) << q;
    for (std::size_t i = 20; i < y.size(); i += 20) y[i] = y[i - 1];  // one reading of twenty: 999
    // Chance repeats, 3 % of the rows where there are levels, scatter by sqrt(560) = 24 and are estimated from as many.
    EXPECT_NEAR(static_cast<double>(unexplained_repeats(y, q)), 999, 120) << q;
  }
}

TEST(UnexplainedRepeats, AreNoneWhereTheLevelsAreUneven) {
  // A thermistor's converter: levels further apart the higher they lie.
  const auto clean = noise(5000, 0.5, 6);
  const auto y = rows(5000, [&](std::size_t i) { return std::exp(quantized(clean[i], 0.2)); });
  EXPECT_EQ(unexplained_repeats(y, 0), 0);
}

// --- clipping ---------------------------------------------------------------------------------------------------

TEST(RowsApart, AreSingleOnesFarOutsideOfAllOthers) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  std::vector<double> sine, noise;
  for (int k = 0; k < 1500; ++k) {
    sine.push_back(std::sin(0.02 * k));
    noise.push_back(normal(engine));
  }
  using Rows = std::vector<std::size_t>;
  EXPECT_EQ(rows_apart(sine), Rows{});
  EXPECT_EQ(rows_apart(noise), Rows{});
  auto hit = sine;
  hit[700] = -30;
  EXPECT_EQ(rows_apart(hit), Rows{700});
  hit[1499] = 2.5;
  EXPECT_EQ(rows_apart(hit), (Rows{700, 1499}));
  auto pulse = sine;  // a device that jumps there and back takes more than a row
  for (std::size_t k = 700; k < 703; ++k) pulse[k] = -30;
  EXPECT_EQ(rows_apart(pulse), Rows{});
  auto pulses = sine;
  for (std::size_t k = 50; k < 1500; k += 100) pulses[k] = 5;
  EXPECT_EQ(rows_apart(pulses), Rows{}) << "what comes again and again belongs to the signal";
}

TEST(Plateau, IsFoundAtTheEndThatClips) {
  auto y = noise(5000, 1, 7);
  for (std::size_t i = 1; i < y.size(); ++i) y[i] = 0.95 * y[i - 1] + 0.3 * y[i];  // slow enough to stay beyond the end
  for (double& v : y) v = quantized(std::min(v, 1.2), 1e-3);
  const Plateau top = plateau_at_top(y, 1e-3, {});
  EXPECT_TRUE(top.found);
  EXPECT_NEAR(top.level, 1.2, 1e-9);
  EXPECT_FALSE(plateau_at_bottom(y, 1e-3, {}).found);
}

TEST(Plateau, IsNoneAtTheTurnsOfASineNorOfOneThatRepeatsExactly) {
  const auto fine =
      rows(20000, [](std::size_t i) { return quantized(std::sin(2 * pi * 0.0031 * static_cast<double>(i)), 1e-4); });
  EXPECT_FALSE(plateau_at_top(fine, 1e-4, {}).found);
  EXPECT_FALSE(plateau_at_top(sine(20000, 0.01), 0, {}).found);
}

TEST(Plateau, IsNoneWhereTheDriveStandsStill) {
  const auto y = rows(2000, [](std::size_t i) { return i % 200 < 100 ? 0.01 * static_cast<double>(i % 200) : 1.0; });
  std::vector<bool> moving;
  for (std::size_t i = 0; i < y.size(); ++i) moving.push_back(i % 200 < 98);
  EXPECT_TRUE(plateau_at_top(y, 0, {}).found);
  EXPECT_FALSE(plateau_at_top(y, 0, moving).found);
}

// --- excitation -------------------------------------------------------------------------------------------------

TEST(Excitation, ACycleIsWhatGoesUpAndDownOnceAndItsMultiplesAreHarmonics) {
  std::vector<double> t, sine, triangle, two, chirp;
  for (int k = 0; k < 4000; ++k) {
    const double x = k * 1e-3, turn = 2 * std::numbers::pi * x;
    t.push_back(x);
    sine.push_back(std::sin(3.1 * turn));
    triangle.push_back(std::abs(std::remainder(2.5 * x, 1)));
    two.push_back(std::sin(turn) + std::sin(5 * turn));
    chirp.push_back(std::sin(turn * x));
  }
  EXPECT_NEAR(cycle_frequency(t, sine), 3.1, 0.01);
  EXPECT_NEAR(cycle_frequency(t, triangle), 2.5, 0.01);
  EXPECT_EQ(cycle_frequency(t, two), 0) << "it turns ten times on its way";
  EXPECT_EQ(cycle_frequency(t, chirp), 0);
  EXPECT_EQ(harmonic_order(9.004, std::vector<double>{3, 3}), 3);
  EXPECT_EQ(harmonic_order(3, std::vector<double>{3}), 0) << "that is the drive itself";
  EXPECT_EQ(harmonic_order(9.1, std::vector<double>{3}), 0);
  EXPECT_EQ(harmonic_order(9, std::vector<double>{3, 0}), 0) << "one drive is none such";
  EXPECT_EQ(harmonic_order(50, std::vector<double>{1}), 0) << "of so many multiples one is near anything";
  EXPECT_EQ(harmonic_order(9, {}), 0);
}

TEST(LongestHold, IsTheStayBehindAMove) {
  const auto t = rows(100, [](std::size_t i) { return 0.1 * static_cast<double>(i); });
  const auto u = rows(100, [](std::size_t i) { return i < 50 ? 0.0 : i < 55 ? 1.0 : i < 85 ? 2.0 : 3.0; });
  const Hold hold = longest_hold(t, u, 3);  // the rest before the first move is no hold
  EXPECT_NEAR(hold.begin, 5.5, 1e-9);
  EXPECT_NEAR(hold.length, 2.9, 1e-9);
}

TEST(BandOf, ReachesFromTheLowestToTheHighestLine) {
  const auto u = rows(4096, [](std::size_t i) {
    const double t = 0.01 * static_cast<double>(i);
    return std::sin(2 * pi * 0.5 * t) + 0.05 * std::sin(2 * pi * 12 * t);
  });
  const Band band = band_of(u, 0.01);
  // A windowed line is some 1 / (41 s) wide.
  EXPECT_NEAR(band.lowest, 0.5, 0.1);
  EXPECT_NEAR(band.highest, 12, 0.1);
}

TEST(PeriodOf, IsFoundWhereTheClockDoesNotDivideIt) {
  const auto u = sine(3000, 1 / 123.4);
  const Period p = period_of(u);
  EXPECT_NEAR(p.rows, 123.4, 0.05);
  EXPECT_GT(p.count(), 20);
}

TEST(PeriodOf, IsThatOfAMultisineAndNoneInNoise) {
  const auto once = noise(500, 1, 8);
  EXPECT_NEAR(period_of(rows(2600, [&](std::size_t i) { return once[i % 500]; })).rows, 500, 1e-6);
  EXPECT_FALSE(period_of(noise(20000, 1, 9)).found());
}

TEST(PeriodOf, IsNoneWhereEachSwingIsSmaller) {
  const auto u = rows(4000, [](std::size_t i) {
    return std::exp(-0.001 * static_cast<double>(i)) * std::sin(2 * pi * 0.01 * static_cast<double>(i));
  });
  EXPECT_FALSE(period_of(u).found());  // ten per cent less in each period
}

TEST(SwingSizes, AreCountedOncePerTenthOfTheRange) {
  std::vector<double> u;
  for (const double size : {1.0, 1.0, 0.6, 0.6, 0.3})
    for (int k = 0; k < 40; ++k) u.push_back(size * std::sin(2 * pi * k / 40.0));
  EXPECT_EQ(swing_sizes(u).size(), 5U);  // 0.6, 0.9, 1.2, 1.6, 2: those across a change are sizes of their own
}

TEST(SwingsOf, AreToldWithSizeMiddleAndSpeed) {
  // Triangles between 0 and 1 at 1/s, then between 1 and 0.5 at 2/s.
  const auto t = rows(601, [](std::size_t i) { return 0.01 * static_cast<double>(i); });
  const auto u = rows(601, [](std::size_t i) {
    const double x = 0.01 * static_cast<double>(i);
    return x < 3 ? 1 - std::abs(1 - std::fmod(x, 2)) : 1 - 2 * (0.25 - std::abs(0.25 - std::fmod(x - 3, 0.5)));
  });
  const auto swings = swings_of(t, u, 0.05);
  ASSERT_EQ(swings.size(), 13U);  // down, up; then six times down and up, the last one cut off
  EXPECT_NEAR(swings[0].size, 1, 1e-9);
  EXPECT_NEAR(swings[0].middle, 0.5, 1e-9);
  EXPECT_NEAR(swings[0].fastest, 1, 1e-9);
  EXPECT_NEAR(swings[5].size, 0.5, 1e-9);
  EXPECT_NEAR(swings[5].middle, 0.75, 1e-9);
  EXPECT_NEAR(swings[5].fastest, 2, 1e-9);
  const auto ramp = swings_of(t, t, 0.05);
  ASSERT_EQ(ramp.size(), 1U);
  EXPECT_NEAR(ramp[0].size, 6, 1e-9);
}

// --- repeatability ----------------------------------------------------------------------------------------------

TEST(Repeatability, BetweenPeriodsIsTheNoise) {
  const auto u = sine(4000, 1 / 123.4, 10);
  const auto n = noise(4000, 0.02, 10);
  const auto y = rows(4000, [&](std::size_t i) { return 3 * u[i] + n[i]; });
  const auto floor = between_periods(y, u, period_of(u));
  EXPECT_GT(floor.rows, 3000U);
  // sqrt(2 * 3600) independent numbers: 1.2 % each, and the shift by 0.4 rows adds (0.4 / 2)^2 * 2 = 8 % in variance.
  EXPECT_NEAR(floor.rms, 0.02, 0.002);
}

TEST(Repeatability, BetweenTakesKeepsTheOffsetApart) {
  const auto a = noise(10000, 1, 11);
  auto b = noise(10000, 1, 12);
  for (double& v : b) v += 2;
  const auto floor = between_takes(a, b);
  EXPECT_NEAR(floor.without_offset, 1, 0.03);                // 1 / sqrt(2 * 10000) = 0.7 %
  EXPECT_NEAR(floor.rms, std::sqrt(1 + 2 * 2 / 2.0), 0.05);  // half the squared offset besides
}

TEST(Repeatability, OnlyDrivesThatAreTheSameAreCompared) {
  const auto a = sine(1000, 0.01);
  auto b = a;
  EXPECT_TRUE(same_drive(a, b));
  for (double& v : b) v *= 1.01;
  EXPECT_FALSE(same_drive(a, b));
}

// --- lines ------------------------------------------------------------------------------------------------------

TEST(LinesOf, FindsTheMainsInNoiseWithFrequencyAndAmplitude) {
  auto y = noise(20000, 1, 13);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += 0.2 * std::sin(2 * pi * 50.03 * 1e-3 * static_cast<double>(i) + 1);
  const auto u = noise(20000, 1, 14);
  const auto lines = lines_of(y, {u}, 1e-3);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines[0].frequency, 50.03, 2e-3);  // a twentieth of 1 / 20 s
  EXPECT_NEAR(lines[0].amplitude, 0.2, 0.05);    // five times sqrt(2 / 20000)
}

TEST(LinesOf, IsSilentInNoise) {
  for (unsigned seed = 20; seed < 26; ++seed) EXPECT_TRUE(lines_of(noise(30000, 1, seed), {}, 1e-3).empty()) << seed;
}

TEST(LinesOf, LeavesTheDriveAndItsDistortionAlone) {
  const auto u = sine(8000, 0.00873);
  const auto n = noise(8000, 1e-3, 15);
  const auto y =
      rows(8000, [&](std::size_t i) { return u[i] + 0.2 * u[i] * u[i] * u[i] + 0.1 * std::abs(u[i]) + n[i]; });
  EXPECT_TRUE(lines_of(y, {u}, 1e-3).empty());
}

/// One period of a drive, phase 0 .. 1.
using Shape = double (*)(double);
double sine_shape(double phase) { return std::sin(2 * pi * phase); }
double triangle_shape(double phase) { return 4 * std::abs(phase - std::floor(phase + 0.5)) - 1; }
double square_shape(double phase) { return phase - std::floor(phase) < 0.5 ? 1 : -1; }
double sawtooth_shape(double phase) {  // back in a tenth of the period
  const double at = phase - std::floor(phase);
  return at < 0.9 ? at / 0.45 - 1 : 1 - (at - 0.9) / 0.05;
}
double multisine_shape(double phase) {  // Schroeder's phases keep its peaks low
  double sum = 0;
  for (int k = 1; k <= 80; ++k) sum += std::cos(2 * pi * k * phase - pi * k * (k - 1) / 80) / 80;
  return 5 * sum;
}
/// A drive of 1 Hz at 1 kHz, or of another frequency.
std::vector<double> periodic(std::size_t n, Shape shape, double frequency = 1) {
  return rows(n, [&](std::size_t i) { return 5 + 3 * shape(frequency * 1e-3 * static_cast<double>(i)); });
}
std::vector<double> lagged(const std::vector<double>& u, double rows_of_lag) {
  double at = u.front();
  return rows(u.size(), [&](std::size_t i) { return at += (u[i] - at) / rows_of_lag; });
}

TEST(LinesOf, FindsTheMainsAtAMultipleOfASine) {
  for (const std::size_t n : {4000, 10000, 40000})
    for (const double frequency : {50.0, 50.03}) {
      const auto u = periodic(n, sine_shape);
      const auto e = noise(n, 2e-3, 17);
      const auto y = rows(n, [&](std::size_t i) {
        const double t = 1e-3 * static_cast<double>(i);
        return 1.2 * u[i] + 0.02 * u[i] * u[i] * u[i] + e[i] + 0.1 * std::sin(2 * pi * frequency * t + 1);
      });
      const auto lines = lines_of(y, {u}, 1e-3);
      ASSERT_EQ(lines.size(), 1U) << n << " rows, " << frequency << " Hz";
      EXPECT_NEAR(lines[0].frequency, frequency, 50.0 / static_cast<double>(n));  // a twentieth of one over the time
      EXPECT_NEAR(lines[0].amplitude, 0.1, 0.01);
    }
}

TEST(LinesOf, LeavesWhatABendAHysteresisOrAResonanceMakesOfOneToneAlone) {
  using Device = std::function<std::vector<double>(const std::vector<double>&)>;
  const auto each = [](double (*f)(double)) -> Device {
    return [f](const std::vector<double>& u) { return rows(u.size(), [&](std::size_t i) { return f(u[i]); }); };
  };
  const auto play = [](const std::vector<double>& u) {
    double at = u.front();
    return rows(u.size(), [&](std::size_t i) { return at = std::max(u[i] - 1, std::min(u[i] + 1, at)); });
  };
  const auto rung_by = [&](const Device& device, double frequency, double q) -> Device {
    return [=](const std::vector<double>& u) {  // at one of the multiples
      const double w = 2 * pi * 1e-3 * frequency, z = 0.5 / q;
      const auto force = device(u);  // it is at rest in the beginning
      std::vector<double> y(force.size(),
                            0.1 * force[0] / (1 - 2 * std::exp(-z * w) * std::cos(w) + std::exp(-2 * z * w)));
      for (std::size_t i = 2; i < y.size(); ++i)
        y[i] = 2 * std::exp(-z * w) * std::cos(w) * y[i - 1] - std::exp(-2 * z * w) * y[i - 2] + 0.1 * force[i];
      return y;
    };
  };
  const std::vector<Device> devices{each([](double u) { return u + 0.1 * u * u * u; }),
                                    each([](double u) { return std::min(u, 6.5); }),
                                    each([](double u) { return std::abs(u - 4); }),
                                    each([](double u) { return std::round(u / 0.05) * 0.05; }),
                                    play,
                                    rung_by(play, 50, 100),
                                    rung_by(play, 13, 300),
                                    rung_by(each([](double u) { return std::abs(u - 4); }), 12, 300),
                                    rung_by(each([](double u) { return u; }), 20, 300)};
  for (const std::size_t n : {4000, 10000})
    for (const Shape shape : {sine_shape, triangle_shape, square_shape, sawtooth_shape, multisine_shape})
      for (std::size_t d = 0; d < devices.size(); ++d) {
        const auto u = periodic(n, shape);
        const auto e = noise(n, 1e-3, 18);
        auto y = devices[d](u);
        for (std::size_t i = 0; i < n; ++i) y[i] += e[i];
        const auto lines = lines_of(y, {u}, 1e-3);
        EXPECT_TRUE(lines.empty()) << "device " << d << ", shape " << shape(0.2) << ", " << n
                                   << " rows: " << lines[0].frequency << " Hz, " << lines[0].amplitude;
      }
}

TEST(LinesOf, FindsTheMainsBesideADriveThatHasAllHarmonics) {
  // 50 Hz is a multiple of 1 Hz; of 1.7 Hz it is none, nor is 50.03 Hz of 1 Hz, by a third of a cycle in 10 s.
  for (const Shape shape : {triangle_shape, sawtooth_shape, multisine_shape})
    for (const double drive : {1.0, 1.7})
      for (const double frequency : {50.0, 50.03}) {
        const std::size_t n = 10000;
        const auto u = periodic(n, shape, drive);
        const auto e = noise(n, 1e-3, 17);
        auto y = lagged(u, 10);
        for (std::size_t i = 0; i < n; ++i)
          y[i] += e[i] + 0.05 * std::sin(2 * pi * frequency * 1e-3 * static_cast<double>(i) + 1);
        const auto lines = lines_of(y, {u}, 1e-3);
        ASSERT_EQ(lines.size(), 1U) << drive << " Hz, " << frequency << " Hz";
        EXPECT_NEAR(lines[0].frequency, frequency, 0.005);  // a twentieth of 1 / 10 s
        EXPECT_NEAR(lines[0].amplitude, 0.05, 0.0025);      // what lies beside a multiple goes with the mean by 1 / 20
      }
}

TEST(LinesOf, IsSilentBesideADriveThatRepeats) {
  for (unsigned seed = 30; seed < 36; ++seed)
    for (const double drive : {1.0, 0.37, 3.3}) {
      const auto u = periodic(12000, sawtooth_shape, drive);
      const auto e = noise(u.size(), 1e-3, seed);
      auto y = lagged(u, 10);
      for (std::size_t i = 0; i < y.size(); ++i) y[i] += e[i] + 1e-5 * static_cast<double>(i);  // it drifts, too
      EXPECT_TRUE(lines_of(y, {u}, 1e-3).empty()) << seed << ", " << drive << " Hz";
    }
}

TEST(PeriodicPart, IsWhatComesAgainThoughNoRowDoes) {
  const double period = 123.4;
  const auto signal = [&](double row) {
    return 2 * std::cos(2 * pi * row / period + 0.3) + 0.5 * std::sin(2 * pi * 3 * row / period);
  };
  const auto u = rows(4000, [&](std::size_t i) { return signal(static_cast<double>(i)); });
  EXPECT_NEAR(sharp_period(u, 4).rows, period, 1e-3);
  EXPECT_FALSE(sharp_period(u, 40).found()) << "32 periods";
  const PeriodicPart part(u, period);
  // A cubic through samples of a cosine is off by at most 3/128 w^4; twice: into the period and out of it.
  const double off =
      2 * (2 * 3.0 / 128 * std::pow(2 * pi / period, 4) + 0.5 * 3.0 / 128 * std::pow(6 * pi / period, 4));
  for (const std::size_t i : {0, 7, 1000, 3999}) EXPECT_NEAR(part.at_row(i), u[i], off) << i;
  EXPECT_NEAR(std::abs(part.harmonic(1)), 2, 1e-3);
  EXPECT_NEAR(std::arg(part.harmonic(1)), 0.3, 1e-3);
  EXPECT_NEAR(std::abs(part.harmonic(3)), 0.5, 1e-3);
}

TEST(ForeignHarmonics, AreThoseThatDoNotGoOnFromTheOrdersBesideThem) {
  const std::size_t n = 8000;
  const auto u = periodic(n, sawtooth_shape);
  const auto part = [](const std::vector<double>& rows) { return PeriodicPart(rows, 1000); };
  auto y = lagged(u, 10);
  EXPECT_TRUE(foreign_harmonics(part(y), part(u)).empty());
  const auto with = [&](double order) {
    auto more = y;
    for (std::size_t i = 0; i < n; ++i) more[i] += 0.05 * std::cos(2 * pi * order * 1e-3 * static_cast<double>(i));
    return part(more);
  };
  for (const std::size_t order : {31, 50, 51}) {
    const auto found = foreign_harmonics(with(static_cast<double>(order)), part(u));
    ASSERT_EQ(found.size(), 1U) << order;
    EXPECT_EQ(found[0].order, order);
    // What a cubic through four orders misses must be less than a 32nd of the line for it to be told.
    EXPECT_NEAR(std::abs(found[0].expected - part(y).harmonic(order)), 0, 0.05 / 32);
  }
  EXPECT_TRUE(foreign_harmonics(with(3), part(u)).empty()) << "a bend makes that";
}

TEST(LinesOf, TakesNoResonanceForALine) {
  // A mass on a spring, damping 0.2 %, driven by noise: its peak is sharp, its phase wanders.
  const auto force = noise(20000, 1, 16);
  std::vector<double> y(force.size(), 0.0);
  const double w = 2 * pi * 0.08, z = 0.002;
  for (std::size_t i = 2; i < y.size(); ++i)
    y[i] = 2 * std::exp(-z * w) * std::cos(w) * y[i - 1] - std::exp(-2 * z * w) * y[i - 2] + force[i];
  EXPECT_TRUE(lines_of(y, {force}, 1e-3).empty());
}

}  // namespace
}  // namespace hysteron
