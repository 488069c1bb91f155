#include "models/sampled/impedance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "models/hysteresis/jiles_atherton.h"
#include "tests/models/golden.h"

namespace hysteron {
namespace {

using Numbers = std::vector<double>;
using impedance::Phasor;

constexpr int samples = 200;     // of a window: one ripple of 50 Hz at 10 kHz
constexpr double period = 1e-4;  // s
constexpr double w = 2 * std::numbers::pi * 50;

Phasor<double> joint(const Numbers& x, std::size_t from, int n, int cycles) {
  Phasor<double> sum;
  for (int k = 0; k < n; ++k) {
    const auto share = impedance::share(k, n, cycles);
    sum.a += share.a * x[from + static_cast<std::size_t>(k)];
    sum.b += share.b * x[from + static_cast<std::size_t>(k)];
  }
  return sum;
}
/// What the thesis takes: the Fourier coefficient of the window.
Phasor<double> fourier(const Numbers& x, std::size_t from, int n, int cycles) {
  Phasor<double> sum;
  for (int k = 0; k < n; ++k) {
    const auto share = impedance::fourier_share(k, n, cycles);
    sum.a += share.a * x[from + static_cast<std::size_t>(k)];
    sum.b += share.b * x[from + static_cast<std::size_t>(k)];
  }
  return sum;
}

TEST(Impedance, PhasorOfARippleOnARampIsExact) {
  for (const int cycles : {1, 2, 7})
    for (const int n : {50, 51}) {
      Numbers x;
      for (int k = 0; k < n; ++k) {
        const double angle = 2 * std::numbers::pi * cycles / n * (k - (n - 1) / 2.0);
        x.push_back(12 + 0.3 * k + 0.7 * std::cos(angle) - 0.4 * std::sin(angle));
      }
      const auto found = joint(x, 0, n, cycles);
      EXPECT_NEAR(found.a, 0.7, 1e-13);  // rounding of 50 terms up to 27
      EXPECT_NEAR(found.b, 0.4, 1e-12);
    }
}

TEST(Impedance, FourierCoefficientTakesARampForARipple) {
  // E-24: a ramp of dV per window leaks dV/pi into the first coefficient; n = 200 stands in for the limit of many
  // samples, from which it differs by (pi/n)^2/6 < 1e-4.
  const double dv = 3;
  Numbers ramp;
  for (int k = 0; k < samples; ++k) ramp.push_back(dv * k / samples);
  const auto leaked = fourier(ramp, 0, samples, 1), none = joint(ramp, 0, samples, 1);
  EXPECT_NEAR(std::hypot(leaked.a, leaked.b), dv / std::numbers::pi, 1e-4 * dv);
  EXPECT_NEAR(std::hypot(none.a, none.b), 0, 1e-13);
}

TEST(Impedance, CapacitanceOfAnIdealCapacitorIsExact) {
  // Claim C3-03: i = C dv/dt of v = Re((a + i b) e^(i w t)) has the phasor i w C (a + i b).
  const double c = 4.47e-6;
  for (const double phase : {0.0, 0.4, 2.0, -1.5}) {
    const Phasor<double> v{2 * std::cos(phase), 2 * std::sin(phase)};
    const Phasor<double> i{-w * c * v.b, w * c * v.a};
    EXPECT_NEAR(impedance::capacitance(w, i, v), c, 1e-14 * c);
  }
}

// The stack and the plant P1 of SPEC section 3.
const impedance::Stack<double> stack{.layers = 600, .area = 5.0e-3 * 4.8e-3, .thickness = 0.055e-3};
const jiles_atherton::Params<double> plant{.p_s = 0.085, .a = 3.5e6, .alpha = 1.0e7, .k = 4.0e5, .c = 0.6};

/// Triangle 0..100 V of 0.1 Hz with a ripple of 50 Hz: voltage and current of the stack at 10 kHz.
struct Record {
  Numbers v, p, i;
  explicit Record(double seconds, double ripple) {
    const auto n = static_cast<std::size_t>(std::lround(seconds / period)) + 1;
    Numbers q;
    for (std::size_t k = 0; k < n; ++k) {
      const double t = period * static_cast<double>(k), turn = 0.1 * t;
      const double drive = 200 * std::fabs(turn - std::floor(turn + 0.5));
      v.push_back(drive + ripple * std::sin(w * t));
      const double field = v[k] / stack.thickness;
      p.push_back(k == 0 ? 0 : jiles_atherton::polarisation_after(plant, p.back(), v[k - 1] / stack.thickness, field));
      q.push_back(stack.layers * stack.area * (impedance::vacuum * field + p[k]));
    }
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t a = k == 0 ? 0 : k - 1, b = k + 1 == n ? k : k + 1;
      i.push_back((q[b] - q[a]) / (period * static_cast<double>(b - a)));
    }
  }
};

TEST(Impedance, GoldenCurrentOfTheStackIsReproduced) {
  HYSTERON_NEEDS_GOLDEN("polarisation_samples");
  const auto trace = golden::read("polarisation_samples");
  const Record record(0.21, 2);
  for (std::size_t k = 0; k < trace.at("V [V]").size(); ++k) {
    ASSERT_NEAR(record.v[k], trace.at("V [V]")[k], 1e-9) << k;              // ten digits
    ASSERT_NEAR(record.p[k], trace.at("P [C/m^2]")[k], 1e-10 * 0.01) << k;  // ten digits of up to 2e-3, and 1e-10 of
                                                                            // the way of each move
    if (k > 0) {
      ASSERT_NEAR(record.i[k], trace.at("I [A]")[k], 1e-9 * 0.01) << k;
    }
  }
}

TEST(Impedance, GoldenWindowsAreReproducedByFourierAndByTheJointFit) {
  HYSTERON_NEEDS_GOLDEN("polarisation_windows");
  const auto trace = golden::read("polarisation_windows");
  const std::size_t windows = 300;  // 6 s of 20: past the first reversal of the drive at 5 s
  const Record record(0.02 * windows + period, 2);
  for (std::size_t m = 0; m < windows; ++m) {
    const std::size_t at = m * samples;
    const double fft = impedance::capacitance(w, fourier(record.i, at, samples, 1), fourier(record.v, at, samples, 1));
    const double lsq = impedance::capacitance(w, joint(record.i, at, samples, 1), joint(record.v, at, samples, 1));
    double mean = 0;
    for (std::size_t k = at; k < at + samples; ++k) mean += record.v[k] / samples;
    // ten digits, and moves exact to 1e-10 of their way, from which the phasors come by differences
    ASSERT_NEAR(fft, trace.at("C fft [F]")[m], 1e-8 * 5e-6) << m;
    ASSERT_NEAR(lsq, trace.at("C lsq [F]")[m], 1e-8 * 5e-6) << m;
    ASSERT_NEAR(impedance::secant_polarisation(stack, lsq, mean), trace.at("P eq3.5 lsq [C/m^2]")[m], 1e-9) << m;
  }
}

TEST(Impedance, SecantFormulaHoldsForALinearMaterialOnly) {
  // E-22: of P = chi E the ripple tells chi, and chi E is P; of a saturating P = P_s tanh(E/a) it tells dP/dE, and
  // (dP/dE) E falls short of P, where the integral does not.
  const double chi = 2e-8, area = stack.layers * stack.area;
  const double linear = area * (impedance::vacuum + chi) / stack.thickness;
  EXPECT_NEAR(impedance::secant_polarisation(stack, linear, 100.0), chi * 100 / stack.thickness, 1e-14);
  const double p_s = 0.05, a = 1e6;
  const auto capacitance = [&](double v) {
    const double h = std::tanh(v / stack.thickness / a);
    return area * (impedance::vacuum + p_s / a * (1 - h * h)) / stack.thickness;
  };
  double p = 0;
  for (int k = 1; k <= 1000; ++k)
    p +=
        impedance::polarisation_growth(stack, capacitance(0.1 * (k - 1)), capacitance(0.1 * k), 0.1 * (k - 1), 0.1 * k);
  const double truth = p_s * std::tanh(100 / stack.thickness / a);
  EXPECT_NEAR(p, truth, 1e-6 * truth);  // trapezoids of 1000 steps over 1.8 bends: (0.0018)^2/12
  EXPECT_LT(impedance::secant_polarisation(stack, capacitance(100), 100.0), 0.5 * truth);
}

TEST(JilesAthertonByHand, PrintedEstimateOfAlphaIsAlwaysZero) {
  // E-23: with a = P_s/(3 chi) the printed alpha = (3 a chi - P_s)/(P_s chi) is zero for every material. The slope of
  // P_s tanh((E + alpha P)/a) at E = 0 is 1/(a/P_s - alpha): alpha = a/P_s - 1/chi for tanh, with no factor 3.
  for (const double p_s : {0.05, 0.3})
    for (const double chi : {1e-8, 4e-8}) {
      const double printed_a = p_s / (3 * chi);
      EXPECT_NEAR((3 * printed_a * chi - p_s) / (p_s * chi), 0, 1e-14 / chi);  // rounding of p_s over p_s chi
      const double a = 3 * p_s / chi, alpha = a / p_s - 1 / chi;
      const jiles_atherton::Params<double> p{.p_s = p_s, .a = a, .alpha = alpha};
      const double e = 1e-4 * a, want = chi * e;
      EXPECT_NEAR(jiles_atherton::anhysteretic(p, e, want), want, 1e-6 * want);  // tanh x = x (1 - x^2/3), x = 3e-4
    }
}

}  // namespace
}  // namespace hysteron
