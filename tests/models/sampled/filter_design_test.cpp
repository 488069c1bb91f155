// Digital filters by kind and corner: held against the squared amplitude in closed form at every frequency, and against
// responses that SciPy 1.10 computes (butter, cheby1, sosfilt).
#include "models/sampled/filter_design.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace hysteron::filter_design {
namespace {

constexpr double pi = std::numbers::pi;

double amplitude(const std::vector<sections::Section>& all, double f, double period) {
  const Complex d = std::exp(Complex(0, -2 * pi * f * period));
  Complex h = 1;
  for (const auto& s : all) h *= (s.b0 + d * (s.b1 + d * s.b2)) / (1.0 + d * (s.a1 + d * s.a2));
  return std::abs(h);
}

/// |H|^2 = 1/(1 + eps^2 T_n(x)^2), or 1/(1 + x^(2 n)): x the frequency of the prototype that f stands for.
double closed_form(const Wanted& w, double f) {
  const auto at = [&](double frequency) { return std::tan(pi * frequency * w.period); };
  const double s = at(f), low = at(w.corner), high = w.upper > 0 ? at(w.upper) : 0;
  double x = 0;
  switch (w.pass) {
    case Pass::low:
      x = s / low;
      break;
    case Pass::high:
      x = low / s;
      break;
    case Pass::band:
      x = (s * s - low * high) / (s * (high - low));
      break;
    case Pass::stop:
      x = s * (high - low) / (s * s - low * high);
      break;
  }
  if (w.family == Family::butterworth) return 1 / std::sqrt(1 + std::pow(x * x, w.order));
  const double a = std::abs(x), eps = std::sqrt(std::pow(10, w.ripple / 10) - 1);
  const double t = a <= 1 ? std::cos(w.order * std::acos(a)) : std::cosh(w.order * std::acosh(a));
  return 1 / std::hypot(1.0, eps * t);
}

TEST(FilterDesign, AmplitudesAreThoseOfTheClosedFormAtEveryFrequency) {
  for (const Family family : {Family::butterworth, Family::chebyshev})
    for (const Pass pass : {Pass::low, Pass::high, Pass::band, Pass::stop})
      for (int order = 1; order <= 9; ++order)
        for (const double corner : {3.0, 300.0, 3000.0}) {
          const Wanted w{family, pass, order, corner, 1.4 * corner, 0.7, 1e-4};
          const auto all = design(w);
          ASSERT_EQ(static_cast<int>(all.size()), sections(pass, order));
          // Roundings of the coefficients act as often as a period of the corner has samples, squared.
          const double rounding = 1e-14 * std::pow(1 / (corner * w.period), 2);
          for (double f = 1; f < 4990; f *= 1.37)
            EXPECT_NEAR(amplitude(all, f, w.period), closed_form(w, f), 1e-11 + rounding)
                << "family " << static_cast<int>(family) << ", pass " << static_cast<int>(pass) << ", order " << order
                << ", corner " << corner << " Hz, at " << f << " Hz";
        }
}

TEST(FilterDesign, CornersAreMetWhateverThePeriod) {
  for (const double period : {1e-5, 1e-4, 1e-3, 1.6e-3}) {
    const Wanted w{Family::butterworth, Pass::low, 3, 300, 0, 1, period};
    EXPECT_NEAR(amplitude(design(w), 300, period), std::sqrt(0.5), 1e-9);
  }
}

TEST(FilterDesign, AllPolesLieInsideTheUnitCircle) {
  for (const Pass pass : {Pass::low, Pass::high, Pass::band, Pass::stop})
    for (int order = 1; order <= 12; ++order)
      for (const auto& s : design({Family::chebyshev, pass, order, 200, 900, 2, 1e-4})) {
        EXPECT_LT(std::abs(s.a2), 1);
        EXPECT_LT(std::abs(s.a1), 1 + s.a2);  // Schur and Cohn, second order
      }
}

struct Known {
  Wanted wanted;
  std::vector<double> impulse;  ///< response to 1, 0, 0 ...
};

TEST(FilterDesign, ImpulseResponsesAreThoseOfSciPy) {
  const Known cases[] = {{{Family::butterworth, Pass::low, 5, 300, 0, 1, 1e-4},
                          {5.56030909572733e-06, 5.22128381343404e-05, 0.000241779123318517, 0.000750915327343736,
                           0.0017934186632332, 0.00356620893798808}},
                         {{Family::butterworth, Pass::high, 3, 300, 0, 1, 1e-4},
                          {0.827971295622377, -0.311688298419764, -0.250307247168652, -0.19560173974841,
                           -0.14746301501581, -0.105715542935009}},
                         {{Family::chebyshev, Pass::band, 4, 300, 1200, 0.5, 1e-4},
                          {0.0016765555519879, 0.0109635440274194, 0.0325853429520828, 0.057767507718389,
                           0.0641453082878335, 0.0327261558482876}},
                         {{Family::chebyshev, Pass::stop, 3, 300, 1200, 0.5, 1e-4},
                          {0.553986511924908, -0.581695964027185, -0.106525945332443, 0.12782049627914,
                           0.199486507460978, 0.165077111717944}}};
  for (const auto& known : cases) {
    const auto all = design(known.wanted);
    std::vector<double> w(2 * all.size(), 0.0);
    for (std::size_t k = 0; k < known.impulse.size(); ++k) {
      double u = k == 0 ? 1 : 0;
      for (std::size_t i = 0; i < all.size(); ++i) {
        double after[2];
        const double y = sections::output(all[i], &w[2 * i], u);
        sections::update(all[i], &w[2 * i], u, y, after);
        w[2 * i] = after[0];
        w[2 * i + 1] = after[1];
        u = y;
      }
      EXPECT_NEAR(u, known.impulse[k], 1e-13) << "sample " << k;  // SciPy's fifteen digits, sums of numbers below one
    }
  }
}

TEST(FilterSections, RestIsWhereAConstantInputLeavesThem) {
  for (const auto& s : design({Family::butterworth, Pass::low, 4, 300, 0, 1, 1e-4})) {
    double w[2], after[2];
    const double y = sections::rest(s, 3, w);
    EXPECT_NEAR(sections::output(s, w, 3.0), y, 1e-14);
    sections::update(s, w, 3.0, y, after);
    EXPECT_NEAR(after[0], w[0], 1e-14);
    EXPECT_NEAR(after[1], w[1], 1e-14);
  }
}

}  // namespace
}  // namespace hysteron::filter_design
