// How an input moves between its samples is found from the recordings, not sold as an effect.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

using SmoothDrive = std::function<double(double t)>;

/// As `several_sines`, at any time.
SmoothDrive sines(double top, std::vector<double> hertz) {
  return [=](double t) {
    double sum = 0;
    for (const double f : hertz) sum += 0.5 * (1 - std::cos(2 * std::numbers::pi * f * t));
    return top * sum / static_cast<double>(hertz.size());
  };
}

class SmoothInputs : public Discoveries {
 protected:
  /// 1 kg on 400 N/m + cubic x^2 with 4 N s/m under 10 N/V, sampled at 25 Hz.
  /// The drive moves as it does, or along straight lines between the samples.
  DataSet measured(double cubic, bool straight) const {
    return measured({{Role::train, sines(0.7, {0.5, 0.9, 1.5, 2.1})},
                     {Role::train, sines(1, {0.7, 1.2, 1.9})},
                     {Role::validate, sines(0.9, {0.6, 1.1, 1.7, 2.0})}},
                    cubic, straight, 1);
  }
  /// The same by these drives; the sensor reads so many times the motion.
  DataSet measured(const std::vector<std::pair<Role, SmoothDrive>>& drives, double cubic, bool straight,
                   double sensor_gain) const {
    std::vector<Recording> list;
    std::uint64_t seed = 5200;
    const double step = 0.04;
    for (const auto& [role, drive] : drives) {
      const auto t = rows(1000, step);
      const auto u = sampled(t, drive);
      auto y = noise(t.size(), 1e-5, 1e-6, seed);
      double x = 0, v = 0;
      for (std::size_t k = 1; k < t.size(); ++k) {
        const auto force = [&](double part) {
          return 10 * (straight ? u[k - 1] + (u[k] - u[k - 1]) * part : drive(t[k - 1] + part * step));
        };
        const auto gain = [&](double place, double speed, double part) {
          return force(part) - 400 * place - 4 * speed - cubic * place * place * place;
        };
        const int n = 8;
        for (int i = 0; i < n; ++i) {  // Kutta's step: of 5 ms at 3 Hz right to 1e-6
          const double h = step / n, from = static_cast<double>(i) / n, half = (i + 0.5) / n, to = (i + 1.0) / n;
          const double v1 = v, a1 = gain(x, v, from);
          const double v2 = v + h / 2 * a1, a2 = gain(x + h / 2 * v1, v2, half);
          const double v3 = v + h / 2 * a2, a3 = gain(x + h / 2 * v2, v3, half);
          const double v4 = v + h * a3, a4 = gain(x + h * v3, v4, to);
          x += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
          v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        }
        y[k] += sensor_gain * x;
      }
      list.push_back(recording(std::to_string(seed++) + ".csv", role, t, u, y));
    }
    return data_set(list, 1e-5);  // of twelve samples a period the spline leaves 1e-4
  }
  Discovery found(double cubic, bool straight) {
    return discovered(mass_on_spring(), measured(cubic, straight),
                      {"stiffening", "structural_resonance", "amplifier_lag", "dead_time", "sensor_lag"});
  }
};

TEST_F(SmoothInputs, WhatStraightLinesLeaveIsNoEffect) {
  const Discovery d = found(0, false);
  EXPECT_EQ(to_text(d.verdict), "adequate") << tried(d);
  ASSERT_EQ(d.smooth_inputs.size(), 1u) << tried(d);
  EXPECT_EQ(d.smooth_inputs[0].input, "u");
  EXPECT_LT(d.smooth_inputs[0].after, 0.15 * d.smooth_inputs[0].before) << "1e-5 of noise on 5 mm";
  EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(), [](const std::string& w) {
    return w.starts_with("u moves smoothly between its samples") &&
           w.find("write \"between_samples\": \"smooth\"") != w.npos;
  }));
}

TEST_F(SmoothInputs, BehindAStrongEffectItIsFoundOnceThatIsKnown) {
  const Discovery d = found(8e4, false);
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps[0].winner.effect, "stiffening") << tried(d);
  EXPECT_EQ(to_text(d.remainder), "noise") << tried(d);
  ASSERT_EQ(d.smooth_inputs.size(), 1u) << tried(d);
  // The figures are of the data set with that: the user finds them again once it says so.
  DataSet said = measured(8e4, false);
  said.notes["u"].between = Between::smooth;
  const Discovery again = discovered(
      mass_on_spring(), said, {"stiffening", "structural_resonance", "amplifier_lag", "dead_time", "sensor_lag"});
  EXPECT_TRUE(again.smooth_inputs.empty());
  EXPECT_EQ(again.base.rms_validate, d.base.rms_validate);
  EXPECT_EQ(again.final_error.rms_validate, d.final_error.rms_validate);
  const DataSet taken = as_found(measured(8e4, false), d);
  EXPECT_EQ(taken.notes.at("u").between, Between::smooth);
}

TEST_F(SmoothInputs, WhatWasFoundIsKeptWhereTheSearchWithItIsBrokenOff) {
  bool anew = false;
  DiscoverOptions options;
  options.progress = [&](const std::string& what, double) { anew = anew || what.starts_with("anew: u"); };
  options.stop = [&] { return anew; };
  const Discovery d = discovered(mass_on_spring(), measured(8e4, false), {"stiffening"}, options);
  ASSERT_TRUE(anew);
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps[0].winner.effect, "stiffening");
  EXPECT_TRUE(d.smooth_inputs.empty()) << "its figures are along straight lines";
  EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(), [](const std::string& w) {
    return w.starts_with("u moves smoothly between its samples, it seems");
  }));
}

TEST_F(SmoothInputs, AWrongGainIsNoBendOfTheInput) {
  // Straight lines through 25 samples a second of 2 Hz are 2 % too small, (2 pi f h)^2 / 12, and so is such a sensor.
  const DataSet data = measured({{Role::train, sines(0.7, {1.9, 2.0})},
                                 {Role::train, sines(1, {1.95, 2.1})},
                                 {Role::validate, sines(0.9, {1.9, 2.05})}},
                                0, true, 1.02);
  const Discovery d = discovered(mass_on_spring(), data, {"calibration", "structural_resonance"}, exact());
  EXPECT_TRUE(d.smooth_inputs.empty()) << tried(d);
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps[0].winner.effect, "calibration") << tried(d);
}

TEST_F(SmoothInputs, StraightLinesThatAreStraightStayStraight) {
  const Discovery d = found(8e4, true);
  EXPECT_TRUE(d.smooth_inputs.empty()) << tried(d);
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps[0].winner.effect, "stiffening") << tried(d);
}

}  // namespace
}  // namespace hysteron
