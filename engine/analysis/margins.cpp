#include "engine/analysis/margins.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

namespace {

constexpr double fine_turn = 0.35, fine_growth = 0.35;  // [rad], of the logarithm: between neighbours
constexpr int refined_at_most = 14;                     // halvings of one interval
constexpr double dead_turn = 0.5;                       // [rad] that a dead time turns between neighbours
constexpr double small_gain = 0.02;                     // below it no margin is looked for
constexpr std::size_t points_at_most = 400'000;

struct Sample {
  double w;
  std::complex<double> value;
};

/// Between a and b, without their ends.
void refine(const Response& response, const Sample& a, const Sample& b, int depth, std::vector<Sample>& list) {
  if (depth == 0 || list.size() > points_at_most) return;
  const double small = std::min(std::abs(a.value), std::abs(b.value)),
               large = std::max(std::abs(a.value), std::abs(b.value));
  const bool turns = large > 0 && std::abs(std::arg(b.value * std::conj(a.value))) > fine_turn;
  if (!turns && large <= small * std::exp(fine_growth)) return;
  const double w = std::sqrt(a.w * b.w);
  if (!(w > a.w && w < b.w)) return;
  const Sample middle{w, response(w)};
  refine(response, a, middle, depth - 1, list);
  list.push_back(middle);
  refine(response, middle, b, depth - 1, list);
}

std::vector<Sample> sampled(const Response& response, std::span<const double> w, double delay) {
  std::vector<Sample> list;
  for (const double end : w) {
    const Sample last{end, response(end)};
    if (list.empty()) {
      list.push_back(last);
      continue;
    }
    const Sample before = list.back();
    const double turn =
        std::max(std::abs(before.value), std::abs(last.value)) > small_gain ? delay * (end - before.w) : 0;
    const int pieces = list.size() > points_at_most ? 1 : static_cast<int>(std::min(1e5, std::ceil(turn / dead_turn)));
    for (int i = 1; i < pieces; ++i) {
      const double inner = before.w + (end - before.w) * i / pieces;
      const Sample next{inner, response(inner)};
      const Sample previous = list.back();
      refine(response, previous, next, refined_at_most, list);
      list.push_back(next);
    }
    const Sample previous = list.back();
    refine(response, previous, last, refined_at_most, list);
    list.push_back(last);
  }
  return list;
}

}  // namespace

std::vector<double> widened(const Response& response, std::vector<double> w, double highest) {
  constexpr int most_decades = 15;
  constexpr double steep = 2;  // per decade: less is flat
  const auto size = [&](double at) { return std::abs(response(at)); };
  // Points of one decade from `end` on, times 10^sign, as long as |L| moves towards one and is not there.
  const auto beyond_end = [&](double end, int sign) {
    constexpr int points = 50;
    std::vector<double> list;
    const double first = size(end), next = size(end * std::pow(10.0, sign));
    const bool approaches = first < 1 ? next > steep * first : next < first / steep;
    if (first == 0 || !std::isfinite(first) || !approaches) return list;
    for (int decade = 0; decade < most_decades && (size(list.empty() ? end : list.back()) < 1) == (first < 1); ++decade)
      for (int i = 1; i <= points; ++i) {
        const double at = end * std::pow(10.0, sign * (decade + static_cast<double>(i) / points));
        if (at < highest) list.push_back(at);
      }
    return list;
  };
  const auto above = beyond_end(w.back(), 1);
  auto below = beyond_end(w.front(), -1);
  std::reverse(below.begin(), below.end());
  below.insert(below.end(), w.begin(), w.end());
  below.insert(below.end(), above.begin(), above.end());
  return below;
}

Bode bode(const Response& response, std::span<const double> w, double delay) {
  Bode result;
  double turns = 0;
  for (const auto& [frequency, value] : sampled(response, w, delay)) {
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

namespace {

/// Where the phase passes -180 deg (or an odd multiple): Im L changes its sign where Re L < 0.
std::vector<GainLimit> gain_limits(const Response& loop, const Bode& b) {
  std::vector<GainLimit> list;
  const auto imaginary = [&](double w) { return loop(w).imag(); };
  for (std::size_t i = 1; i < b.w.size(); ++i) {
    const bool turns = std::floor((b.phase[i - 1] + pi) / (2 * pi)) != std::floor((b.phase[i] + pi) / (2 * pi));
    if (!turns || std::cos(b.phase[i]) >= 0 || std::cos(b.phase[i - 1]) >= 0) continue;
    const double w = crossing(imaginary, b.w[i - 1], b.w[i]);
    list.push_back({1 / std::abs(loop(w)), w});
  }
  return list;
}

constexpr std::size_t limits_looked_at = 40;  // on each side of the gain as it is
constexpr double beyond = 10;                 // of the last limit: as good as any
constexpr double same_limit = 1e-9;           // two crossings at one gain

/// The limits of the gain from 1 on, upwards or downwards, nearest first.
std::vector<GainLimit> on_one_side(std::vector<GainLimit> list, bool up) {
  std::erase_if(list, [&](const GainLimit& l) { return !(up ? l.factor >= 1 : l.factor < 1) || l.factor == 0; });
  const auto distance = [](const GainLimit& l) { return std::abs(std::log(l.factor)); };
  std::stable_sort(list.begin(), list.end(), [&](const auto& x, const auto& y) { return distance(x) < distance(y); });
  list.erase(std::unique(list.begin(), list.end(),
                         [&](const auto& x, const auto& y) { return distance(y) - distance(x) <= same_limit; }),
             list.end());
  if (list.size() > limits_looked_at) list.resize(limits_looked_at);
  return list;
}

/// A gain behind limit i, before the next.
double behind(const std::vector<GainLimit>& side, std::size_t i, bool up) {
  if (i + 1 < side.size()) return std::sqrt(side[i].factor * side[i + 1].factor);
  return up ? side[i].factor * beyond : side[i].factor / beyond;
}

/// Of a stable loop: the first limit behind which it is not.
std::optional<GainLimit> first_unstable(const std::vector<GainLimit>& side, bool up, const StableAt& stable) {
  for (std::size_t i = 0; i < side.size(); ++i)
    if (!stable(behind(side, i, up))) return side[i];
  return std::nullopt;
}

struct StableRange {
  GainLimit near;
  std::optional<GainLimit> far;
};
/// Of an unstable loop: the nearest range of gains on one side with which it is stable.
std::optional<StableRange> first_stable(const std::vector<GainLimit>& side, bool up, const StableAt& stable) {
  for (std::size_t i = 0; i < side.size(); ++i) {
    if (!stable(behind(side, i, up))) continue;
    const std::vector<GainLimit> rest(side.begin() + static_cast<std::ptrdiff_t>(i) + 1, side.end());
    return StableRange{side[i], first_unstable(rest, up, stable)};
  }
  return std::nullopt;
}

void find_gains(Margins& m, const std::vector<GainLimit>& limits, const StableAt& stable) {
  const auto up = on_one_side(limits, true), down = on_one_side(limits, false);
  if (m.stable) {
    m.gain_to = first_unstable(up, true, stable);
    m.gain_from = first_unstable(down, false, stable);
    return;
  }
  const auto above = first_stable(up, true, stable), below = first_stable(down, false, stable);
  m.some_gain = above || below;
  const bool take_above = above && (!below || std::log(above->near.factor) < -std::log(below->near.factor));
  if (take_above) {
    m.gain_from = above->near;
    m.gain_to = above->far;
  } else if (below) {
    m.gain_to = below->near;
    m.gain_from = below->far;
  }
}

}  // namespace

void search_gains(Margins& m, const StableAt& stable) {
  constexpr double step = 1.05, most = 1e4;
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  // The first gain from `from` on, in steps of `factor`, that is not judged as `from` is.
  const auto change = [&](double from, double factor) -> std::optional<GainLimit> {
    const bool first = stable(from);
    for (double a = from; a < most && a > 1 / most; a *= factor) {
      if (stable(a * factor) == first) continue;
      double near = a, far = a * factor;
      for (int i = 0; i < refinements && std::abs(far - near) > 1e-9 * near; ++i) {
        const double middle = std::sqrt(near * far);
        (stable(middle) == first ? near : far) = middle;
      }
      return GainLimit{far, unknown};
    }
    return std::nullopt;
  };
  m.gain_from = m.gain_to = std::nullopt;
  if (m.stable) {
    m.gain_to = change(1, step);
    m.gain_from = change(1, 1 / step);
    return;
  }
  const auto above = change(1, step), below = change(1, 1 / step);
  m.some_gain = above || below;
  if (above && (!below || std::log(above->factor) < -std::log(below->factor))) {
    m.gain_from = above;
    m.gain_to = change(above->factor * (1 + 1e-6), step);
  } else if (below) {
    m.gain_to = below;
    m.gain_from = change(below->factor * (1 - 1e-6), 1 / step);
  }
}

std::optional<GainLimit> gain_limit_at_end(double response, double at) {
  if (!(response < 0) || !std::isfinite(response)) return std::nullopt;
  return GainLimit{-1 / response, at};
}

std::optional<GainLimit> Margins::gain_margin() const {
  if (!stable && !some_gain) return std::nullopt;
  if (!gain_from || !gain_to) return gain_from ? gain_from : gain_to;
  return std::abs(std::log(gain_from->factor)) < std::abs(std::log(gain_to->factor)) ? gain_from : gain_to;
}

Margins margins(const Response& loop, const Bode& b, const StableAt& stable, std::span<const GainLimit> ends) {
  Margins m;
  m.stable = stable(1);
  const auto size = [&](double w) { return std::abs(loop(w)) - 1; };
  for (std::size_t i = 1; i < b.w.size(); ++i) {
    if ((b.magnitude[i - 1] < 1) == (b.magnitude[i] < 1)) continue;
    const double w = crossing(size, b.w[i - 1], b.w[i]);
    const double margin = std::remainder(std::arg(loop(w)) - pi, 2 * pi);  // -pi ... pi: distance from -180 deg
    const bool counts = m.stable || margin < 0;
    if (counts && (!m.phase_margin || std::abs(margin) < std::abs(*m.phase_margin))) {
      m.phase_margin = margin;
      m.phase_margin_at = w;
    }
    const double delay = (margin < 0 ? margin + 2 * pi : margin) / w;
    if (m.stable && (!m.delay_margin || delay < *m.delay_margin)) {
      m.delay_margin = delay;
      m.delay_margin_at = w;
    }
  }
  auto limits = gain_limits(loop, b);
  limits.insert(limits.end(), ends.begin(), ends.end());
  find_gains(m, limits, stable);
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
