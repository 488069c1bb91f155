#include "models/linear/linear_system.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "tests/models/golden.h"

namespace hysteron {
namespace {

using Complex = std::complex<double>;
using Numbers = std::vector<double>;
using linear_system::Chain;

// Thesis Eq. 2.47.
const Numbers plant_num{1.377e16};
const Numbers plant_den{1, 2.813e4, 5.403e8, 4.981e12, 1.822e16};

struct System {
  Numbers numbers;
  int n;
  System(const Numbers& num, const Numbers& den)
      : numbers(static_cast<std::size_t>(linear_system::chain_size(static_cast<int>(den.size()) - 1))),
        n(static_cast<int>(den.size()) - 1) {
    linear_system::realise(num, den, linear_system::chain_at(numbers.data(), n));
  }
  Chain<const double> chain() const { return linear_system::chain_at(numbers.data(), n); }
  Eigen::MatrixXd a() const {
    Eigen::MatrixXd m(n, n);
    for (int k = 0; k < n; ++k) {
      Eigen::VectorXd x = Eigen::VectorXd::Unit(n, k), dx(n);
      linear_system::derivative(chain(), x.data(), 0.0, dx.data());
      m.col(k) = dx;
    }
    return m;
  }
  Eigen::VectorXd b() const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(n), dx(n);
    linear_system::derivative(chain(), x.data(), 1.0, dx.data());
    return dx;
  }
  Complex response(Complex s) const {  // c (s - A)^-1 b + d
    const Eigen::MatrixXcd m = s * Eigen::MatrixXcd::Identity(n, n) - a().cast<Complex>();
    const Eigen::VectorXcd x = m.partialPivLu().solve(b().cast<Complex>());
    Complex y = *chain().d;
    for (int k = 0; k < n; ++k) y += chain().c[static_cast<std::size_t>(k)] * x[k];
    return y;
  }
};

Complex polynomial(const Numbers& c, Complex s) {
  Complex sum = 0;
  for (const double a : c) sum = sum * s + a;
  return sum;
}

TEST(LinearSystemModel, PlantOfTheThesisHasItsDcGainAndPoles) {
  // SPEC 2.4: DC gain 0.755763; poles -7402.0 +- 3303.0i and -6663.0 +- 15261.9i (printed to 0.1).
  const System g(plant_num, plant_den);
  EXPECT_NEAR(g.response(0).real(), 0.755763, 5e-7);
  const Eigen::VectorXcd poles = g.a().eigenvalues();
  for (const Complex expected : {Complex{-7402.0, 3303.0}, Complex{-6663.0, 15261.9}})
    for (const Complex p : {expected, std::conj(expected)}) {
      double nearest = 1e300;
      for (const Complex& pole : poles) nearest = std::min(nearest, std::abs(pole - p));
      EXPECT_LT(nearest, 0.1);
    }
}

TEST(LinearSystemModel, StatesOfThePlantAreOfTheSizeOfItsInput) {
  // At DC x_1 = u and the others are zero; on a sweep up to the bandwidth no state leaves the size of u by a decade.
  const System g(plant_num, plant_den);
  for (const double f : {10.0, 1000.0, 2650.0}) {
    const Eigen::MatrixXcd m = Complex(0, 2 * M_PI * f) * Eigen::MatrixXcd::Identity(4, 4) - g.a().cast<Complex>();
    const Eigen::VectorXcd x = m.partialPivLu().solve(g.b().cast<Complex>());
    EXPECT_LT(x.cwiseAbs().maxCoeff(), 10) << f << " Hz";
    EXPECT_GT(x.cwiseAbs().maxCoeff(), 0.1) << f << " Hz";
  }
  EXPECT_LT(g.a().cwiseAbs().maxCoeff(), 1e5);  // the plain companion form has entries up to 1.8e16
}

struct Case {
  const char* name;
  Numbers num, den;
};
class Realisation : public testing::TestWithParam<Case> {};
TEST_P(Realisation, HasTheFrequencyResponseOfTheRatio) {
  const auto& [name, num, den] = GetParam();
  const System g(num, den);
  const double w = linear_system::natural_rate(den);
  for (double ratio = 1e-3; ratio <= 1e3; ratio *= 3.7) {
    const Complex s(0, ratio * w);
    const Complex expected = polynomial(num, s) / polynomial(den, s);
    // a few roundings of an order-8 solve; relative to the larger of the value and its direct path
    EXPECT_LT(std::abs(g.response(s) - expected), 1e-11 * (std::abs(expected) + std::abs(*g.chain().d) + 1e-300))
        << name << " at " << ratio;
  }
}
INSTANTIATE_TEST_SUITE_P(
    Shapes, Realisation,
    testing::Values(Case{"plant", plant_num, plant_den}, Case{"one_pole", {3}, {0.01, 1}},
                    Case{"lead", {2, 1}, {0.5, 1}}, Case{"notch", {1, 0, 1e6}, {1, 2e3, 1e6}},
                    Case{"integrating", {5}, {1, 20, 0}}, Case{"double_integrator", {7}, {1, 0, 0}},
                    Case{"leading_zeros", {0, 0, 1}, {1, 3, 2}}, Case{"spread_poles", {1e6}, {1, 1e6 + 1, 1e6}},
                    Case{"negative_scale", {-4}, {-2, -3, -1}}, Case{"order_8", {1}, {1, 8, 28, 56, 70, 56, 28, 8, 1}},
                    Case{"unstable", {1}, {1, 0, -4}}),
    [](const auto& made) { return std::string(made.param.name); });

TEST(LinearSystemModel, PlainNumberHasNoStates) {
  const System g({6}, {4});
  EXPECT_EQ(g.n, 0);
  EXPECT_EQ(linear_system::output(g.chain(), static_cast<const double*>(nullptr), 3.0), 4.5);
}

TEST(LinearSystemModel, GoldenBodeDataOfThePlantAreReproduced) {
  HYSTERON_NEEDS_GOLDEN("plant_bode");
  const auto data = golden::read("plant_bode");
  const System g(plant_num, plant_den);
  for (std::size_t k = 0; k < data.at("f [Hz]").size(); ++k) {
    const Complex y = g.response(Complex(0, 2 * M_PI * data.at("f [Hz]")[k]));
    // ten digits of f (5e-10 relative, up to 80 dB per decade: 2e-8 dB), of dB (5e-9 at 50 dB) and of degrees (5e-8 at
    // 300)
    EXPECT_NEAR(20 * std::log10(std::abs(y)), data.at("|G| [dB]")[k], 1e-7);
    EXPECT_NEAR(std::remainder(std::arg(y) * 180 / M_PI - data.at("arg G [deg]")[k], 360), 0, 5e-7);
  }
}

TEST(LinearSystemModel, GoldenStepResponseOfThePlantIsReproduced) {
  HYSTERON_NEEDS_GOLDEN("plant_step");
  const auto data = golden::read("plant_step");
  const System g(plant_num, plant_den);
  const auto& t = data.at("t [s]");
  Eigen::VectorXd x = Eigen::VectorXd::Zero(4);
  const auto rate = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd dx(4);
    linear_system::derivative(g.chain(), at.data(), 1.0, dx.data());
    return dx;
  };
  for (std::size_t k = 0; k < t.size(); ++k) {
    ASSERT_NEAR(linear_system::output(g.chain(), x.data(), 1.0), data.at("y [um]")[k], 1e-9) << "row " << k;
    if (k + 1 == t.size()) break;
    const double h = (t[k + 1] - t[k]) / 4;  // h |pole| = 0.008: Runge-Kutta error 3e-11 per unit of angle
    for (int i = 0; i < 4; ++i) {
      const Eigen::VectorXd k1 = rate(x), k2 = rate(x + h / 2 * k1), k3 = rate(x + h / 2 * k2), k4 = rate(x + h * k3);
      x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
  }
}

}  // namespace
}  // namespace hysteron
