#include "benchmarks/many_loops_by_hand.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numbers>

namespace hysteron::benchmarks {
namespace {

using Four = double __attribute__((vector_size(32)));
using FourInts = std::int64_t __attribute__((vector_size(32)));
constexpr std::size_t vectors = 4;  // side by side, so that a division of one hides behind sums of the others

/// e^y by a power series behind a reduction to |r| < ln(2)/2, to some 3e-16.
inline Four exponential(Four y) {
  const Four shifted = y * 1.4426950408889634 + 0x1.8p52, k = shifted - 0x1.8p52;
  const Four r = (y - k * 0x1.62e42fefa0000p-1) - k * 0x1.cf79abc9e3b3ap-40;
  FourInts bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  bits = (bits << 52) + 0x3ff0000000000000;
  Four power;
  std::memcpy(&power, &bits, sizeof power);
  const Four r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
  const Four a = 1 + r, b = 0.5 + r * (1.0 / 6), c = 1.0 / 24 + r * (1.0 / 120), d = 1.0 / 720 + r * (1.0 / 5040),
             e = 1.0 / 40320 + r * (1.0 / 362880), f = 1.0 / 3628800 + r * (1.0 / 39916800);
  return power * ((a + r2 * b) + r4 * (c + r2 * d) + r8 * (e + r2 * f));
}

struct Law {
  Four p_s, two_over_a, alpha, k, c, p;
};

/// dP/dE of a branch with one division: with e = exp(2 (E + alpha P)/a) the law's fractions have one denominator.
inline Four slope(const Law& law, Four p, double field, double direction) {
  const Four e = exponential((field + law.alpha * p) * law.two_over_a);
  const Four over = e - 1, under = e + 1, under2 = under * under;
  const Four q = law.p_s * over - p * under, held = 1 - law.c;
  const Four reversible = 4 * law.c * law.p_s * e * law.two_over_a;
  const Four g = direction * held * law.k * under - law.alpha * q;
  return (2 * held * q * under2 + reversible * g) / (g * (2 * under2 - law.alpha * reversible));
}

struct Input {
  std::vector<double> field, rate;  ///< at half steps; the rate times a step
  Input() {
    for (int i = 0; i <= 8000; ++i) {
      const double w = 2 * std::numbers::pi / 2000, x = w * i / 2;
      field.push_back(3 - 3 * std::cos(x));
      rate.push_back(3 * std::sin(x) * w);
    }
  }
};

template <class Step>
void run(std::span<const LoopNumbers> sets, std::span<LoopPoints> points, const Step& step) {
  constexpr std::size_t width = 4 * vectors;
  for (std::size_t first = 0; first + width <= sets.size(); first += width) {
    std::array<Law, vectors> laws{};
    for (std::size_t l = 0; l < width; ++l) {
      const auto& n = sets[first + l];
      Law& law = laws[l / 4];
      const auto lane = static_cast<int>(l % 4);
      law.p_s[lane] = n[0];
      law.two_over_a[lane] = 2 / n[1];
      law.alpha[lane] = n[2];
      law.k[lane] = n[3];
      law.c[lane] = n[4];
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < 4000; ++i) {
      step(laws, i);
      if (i + 1 != 2000 && i + 1 != 3000 && i + 1 != 4000) continue;
      for (std::size_t l = 0; l < width; ++l) points[first + l].p[kept] = laws[l / 4].p[static_cast<int>(l % 4)];
      ++kept;
    }
  }
}

const Input& input() {
  static const Input made;
  return made;
}

}  // namespace

void euler_by_hand(std::span<const LoopNumbers> sets, std::span<LoopPoints> points) {
  const Input& in = input();
  run(sets, points, [&](auto& laws, std::size_t i) {
    const double v = in.rate[2 * i], direction = v < 0 ? -1 : 1;
    for (auto& law : laws) law.p += v * slope(law, law.p, in.field[2 * i], direction);
  });
}

void rk4_by_hand(std::span<const LoopNumbers> sets, std::span<LoopPoints> points) {
  const Input& in = input();
  run(sets, points, [&](auto& laws, std::size_t i) {
    const double* e = in.field.data() + 2 * i;
    const double* v = in.rate.data() + 2 * i;
    const double d0 = v[0] < 0 ? -1 : 1, d1 = v[1] < 0 ? -1 : 1, d2 = v[2] < 0 ? -1 : 1;
    for (auto& law : laws) {
      const Four k1 = v[0] * slope(law, law.p, e[0], d0);
      const Four k2 = v[1] * slope(law, law.p + 0.5 * k1, e[1], d1);
      const Four k3 = v[1] * slope(law, law.p + 0.5 * k2, e[1], d1);
      const Four k4 = v[2] * slope(law, law.p + k3, e[2], d2);
      law.p += (k1 + 2 * (k2 + k3) + k4) * (1.0 / 6);
    }
  });
}

}  // namespace hysteron::benchmarks
