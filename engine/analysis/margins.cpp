#include "engine/analysis/margins.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hysteron {
namespace {

using std::numbers::pi;
constexpr double far_below = 1e-6;  // of the lowest frequency: what a slow integrator makes of it is then 1 - 1e-6
constexpr int refinements = 80;     // halvings: more than the digits of a double between two points of the grid

/// Where `f` changes its sign between a and b, by bisection on the logarithm.
double crossing(const std::function<double(double)>& f, double a, double b) {
  double fa = f(a);
  const double fb = f(b);
  if ((fa < 0) == (fb < 0))
    return std::abs(fa) < std::abs(fb) ? a : b;  // a point of the grid lies on it, but for rounding
  for (int i = 0; i < refinements; ++i) {
    const double middle = std::sqrt(a * b), fm = f(middle);
    if ((fa < 0) == (fm < 0))
      a = middle, fa = fm;
    else
      b = middle;
  }
  return std::sqrt(a * b);
}

}  // namespace

std::vector<double> frequencies(std::span<const std::complex<double>> poles, double delay, int per_decade) {
  double low = 0, high = 0;
  for (const auto& p : poles) {
    const double size = std::abs(p);
    if (size == 0) continue;
    low = low == 0 ? size : std::min(low, size);
    high = std::max(high, size);
  }
  if (delay > 0) {
    low = low == 0 ? 1 / delay : std::min(low, 1 / delay);
    high = std::max(high, 1 / delay);
  }
  if (low == 0) low = high = 1;
  // An integrator's pole near zero, made by rounding, would stretch the grid without end.
  low = std::max(low, high * 1e-9) / 100;
  high *= 100;
  std::vector<double> w;
  const int n = static_cast<int>(std::ceil(std::log10(high / low) * per_decade));
  for (int i = 0; i <= n; ++i) w.push_back(low * std::pow(high / low, static_cast<double>(i) / n));
  for (const auto& p : poles) {
    const double resonance = std::abs(p.imag()), width = std::abs(p.real());
    if (resonance == 0 || width > 0.2 * resonance) continue;
    for (int i = -40; i <= 40; ++i) {
      const double at = resonance + 0.25 * i * width;
      if (at > low && at < high) w.push_back(at);
    }
  }
  std::sort(w.begin(), w.end());
  w.erase(std::unique(w.begin(), w.end()), w.end());
  return w;
}

Bode bode(const Response& response, std::span<const double> w) {
  Bode result;
  double turns = 0;
  for (const double frequency : w) {
    const auto value = response(frequency);
    double phase = std::arg(value) + turns;
    if (!result.phase.empty()) {
      const double jump = std::round((result.phase.back() - phase) / (2 * pi)) * 2 * pi;
      turns += jump;
      phase += jump;
    }
    result.w.push_back(frequency);
    result.magnitude.push_back(std::abs(value));
    result.phase.push_back(phase);
  }
  return result;
}

Margins margins(const Response& loop, const Bode& b) {
  Margins m;
  const auto size = [&](double w) { return std::abs(loop(w)) - 1; };
  // Im L changes sign where Re L < 0: the phase passes -180 deg (or an odd multiple).
  const auto imaginary = [&](double w) { return loop(w).imag(); };
  for (std::size_t i = 1; i < b.w.size(); ++i) {
    if ((b.magnitude[i - 1] < 1) != (b.magnitude[i] < 1)) {
      const double w = crossing(size, b.w[i - 1], b.w[i]);
      const double margin = std::remainder(std::arg(loop(w)) - pi, 2 * pi);  // -pi ... pi: distance from -180 deg
      if (!m.phase_margin || std::abs(margin) < std::abs(*m.phase_margin)) {
        m.phase_margin = margin;
        m.phase_margin_at = w;
        m.delay_margin = (margin < 0 ? margin + 2 * pi : margin) / w;
      }
    }
    const bool turns = std::floor((b.phase[i - 1] + pi) / (2 * pi)) != std::floor((b.phase[i] + pi) / (2 * pi));
    if (turns && std::cos(b.phase[i]) < 0 && std::cos(b.phase[i - 1]) < 0) {
      const double w = crossing(imaginary, b.w[i - 1], b.w[i]);
      const double margin = 1 / std::abs(loop(w));
      if (!m.gain_margin || std::abs(std::log(margin)) < std::abs(std::log(*m.gain_margin))) {
        m.gain_margin = margin;
        m.gain_margin_at = w;
      }
    }
  }
  return m;
}

std::optional<double> bandwidth(const Response& response, const Bode& b) {
  if (b.w.empty()) return std::nullopt;
  return passes(response, b, b.magnitude.front() / std::numbers::sqrt2, Crossing::falling);
}

std::optional<double> passes(const Response& response, const Bode& b, double level, Crossing direction) {
  const auto below = [&](std::size_t i) { return b.magnitude[i] < level; };
  for (std::size_t i = 1; i < b.w.size(); ++i)
    if (below(i) == (direction == Crossing::falling) && below(i - 1) != below(i))
      return crossing([&](double w) { return std::abs(response(w)) - level; }, b.w[i - 1], b.w[i]);
  return std::nullopt;
}

Peak largest(const Response& response, const Bode& b) {
  if (b.w.empty()) return {};
  const auto top =
      static_cast<std::size_t>(std::max_element(b.magnitude.begin(), b.magnitude.end()) - b.magnitude.begin());
  if (top == 0 || top + 1 == b.w.size()) return {b.magnitude[top], b.w[top]};
  double low = b.w[top - 1], high = b.w[top + 1];
  for (int i = 0; i < refinements; ++i) {  // golden section: flat to rounding long before the end
    const double left = high - (high - low) / std::numbers::phi, right = low + (high - low) / std::numbers::phi;
    if (std::abs(response(left)) < std::abs(response(right)))
      low = left;
    else
      high = right;
  }
  const double at = (low + high) / 2;
  return {std::abs(response(at)), at};
}

ClosedLoop closed_loop(const Response& loop, const Bode& b) {
  const Response t = [&](double w) {
    const auto l = loop(w);
    return l / (1.0 + l);
  };
  const Response s = [&](double w) { return 1.0 / (1.0 + loop(w)); };
  const Bode of_t = bode(t, b.w), of_s = bode(s, b.w);
  constexpr double half = 1 / std::numbers::sqrt2;
  const double low = std::abs(t(b.w.front() * far_below));
  const Peak top = largest(t, of_t);
  return {passes(loop, b, half, Crossing::falling), passes(t, of_t, low * half, Crossing::falling),
          passes(s, of_s, half, Crossing::rising), top.magnitude > low ? top : Peak{low, 0}, largest(s, of_s)};
}

}  // namespace hysteron
