#include "fit/signals/cut_tops.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "fit/numerics/dense.h"
#include "fit/signals/branches.h"

namespace hysteron {
namespace {

using Shape = std::function<double(double)>;

/// Rows [first, last) at the end of the range.
struct Flat {
  std::size_t first = 0, last = 0;
};

/// The end of a range and what lies at it; bottoms are turned over before.
class End {
 public:
  End(std::vector<double> v, double band, double noise, double cycle)
      : v_(std::move(v)), band_(band), noise_(noise), cycle_(cycle) {
    const auto [low, high] = std::minmax_element(v_.begin(), v_.end());
    low_ = *low;
    high_ = *high;
  }

  CutTops cut() const {
    CutTops seen;
    std::size_t judged = 0;
    double level = 0;
    if (is_stairs()) return seen;
    for (const auto& flat : flats()) {
      ++judged;
      const double at = mean(flat);
      const auto summit = summit_of(flat, at);
      if (!summit) continue;
      ++seen.tops;
      level += at;
      seen.would_be = std::max(seen.tops == 1 ? *summit : seen.would_be, *summit);
    }
    seen.found = seen.tops >= fewest && 4 * seen.tops >= judged;
    if (seen.tops > 0) seen.level = level / static_cast<double>(seen.tops);
    return seen;
  }

 private:
  static constexpr std::size_t fewest = 3;  // tops, and rows of one

  bool at_top(std::size_t i) const { return v_[i] >= high_ - band_; }
  bool at_bottom(std::size_t i) const { return v_[i] <= low_ + band_; }
  double mean(const Flat& flat) const {
    double sum = 0;
    for (std::size_t i = flat.first; i < flat.last; ++i) sum += v_[i];
    return sum / static_cast<double>(flat.last - flat.first);
  }

  /// Those with rows on both sides.
  std::vector<Flat> flats() const {
    std::vector<Flat> list;
    for (std::size_t i = 0; i < v_.size(); ++i) {
      if (!at_top(i)) continue;
      Flat flat{i, i};
      while (flat.last < v_.size() && at_top(flat.last)) ++flat.last;
      if (flat.first > 0 && flat.last < v_.size() && flat.last - flat.first >= fewest) list.push_back(flat);
      i = flat.last;
    }
    return list;
  }
  /// A generator that holds each of its values, or a step between levels as coarse as that, makes flat tops as well.
  bool is_stairs() const {
    std::size_t between = 0, stays = 0;
    for (std::size_t i = 1; i < v_.size(); ++i) {
      if (at_top(i) || at_bottom(i)) continue;
      ++between;
      if (std::abs(v_[i] - v_[i - 1]) <= 1e-9 * (high_ - low_)) ++stays;
    }
    return 2 * stays > between;
  }

  struct Through {
    double rms = 0, summit = 0;
  };
  /// Least squares of a constant, a slope and the shape, through both flanks; x counts rows from the middle of the
  /// flat.
  Through through(const std::vector<std::size_t>& flanks, double middle, const Shape& shape) const {
    Dense a(flanks.size(), 3);
    std::vector<double> b;
    for (std::size_t k = 0; k < flanks.size(); ++k) {
      const double x = static_cast<double>(flanks[k]) - middle;
      a(k, 0) = 1;
      a(k, 1) = x;
      a(k, 2) = shape(x);
      b.push_back(v_[flanks[k]]);
    }
    const auto best = minimum_norm(a, b, 1e-12).x;
    Through t{0, best[0] + best[2] * shape(0)};
    for (std::size_t k = 0; k < flanks.size(); ++k)
      t.rms += std::pow(b[k] - best[0] * a(k, 0) - best[1] * a(k, 1) - best[2] * a(k, 2), 2);
    t.rms = std::sqrt(t.rms / static_cast<double>(flanks.size()));
    return t;
  }

  /// Where the flanks would have met, if they bend towards a summit.
  std::optional<double> summit_of(const Flat& flat, double level) const {
    if (flat.first < fewest || flat.last + fewest > v_.size()) return {};
    // Between the last row beside the flat and the first in it the flank crosses its level.
    const auto crossing = [&](std::size_t beside, std::size_t further) {
      const double slope = v_[beside] - v_[further];
      return slope > 0 ? std::min(1.0, (level - v_[beside]) / slope) : 1.0;
    };
    const double in = static_cast<double>(flat.first - 1) + crossing(flat.first - 1, flat.first - 2);
    const double out = static_cast<double>(flat.last) - crossing(flat.last, flat.last + 1);
    const double middle = (in + out) / 2, half = (out - in) / 2;
    const auto meets = [&](double far, const Shape& shape, double clearly) -> std::optional<double> {
      const auto flanks = flanks_of(flat, far);
      if (flanks.empty()) return {};
      const Through straight = through(flanks, middle, [](double x) { return std::abs(x); });
      const Through bent = through(flanks, middle, shape);
      const double excess = bent.summit - level;
      constexpr double bends = 1e-3;     // of the excess; a sine cut at half of its height: 3e-3
      constexpr double worth_it = 0.01;  // of the range
      const bool is = bent.rms < clearly * straight.rms && straight.rms > std::max(bends * excess, 2 * noise_) &&
                      excess > 3 * band_ && excess > worth_it * (high_ - low_);
      return is ? std::optional(bent.summit) : std::nullopt;
    };
    // What arcs that arrive gently leave of what straight flanks do: 0.6 as far away as the flat is wide to each side,
    // 0.8 half as far, where the top of a sine that is cut at 0.7 is still a parabola.
    constexpr double far_share = 0.35, near_share = 0.5;
    const Shape parabola = [](double x) { return x * x; };
    const Shape sine = [&](double x) { return std::cos(2 * std::numbers::pi * x / cycle_); };
    if (cycle_ > 2 * half)
      if (const auto summit = meets(0.45 * cycle_ - half, sine, far_share)) return summit;
    if (const auto summit = meets(half, parabola, far_share)) return summit;
    return meets(half / 2, parabola, near_share);
  }
  /// Rows on both sides as far as this, three at the least; none where another end comes first.
  std::vector<std::size_t> flanks_of(const Flat& flat, double far) const {
    const auto rows = std::max<std::size_t>(fewest, static_cast<std::size_t>(std::max(0.0, far)));
    std::vector<std::size_t> left, right;
    for (std::size_t i = flat.first; i-- > 0 && left.size() < rows && !at_top(i) && !at_bottom(i);) left.push_back(i);
    for (std::size_t i = flat.last; i < v_.size() && right.size() < rows && !at_top(i) && !at_bottom(i); ++i)
      right.push_back(i);
    if (left.size() < fewest || right.size() < fewest) return {};
    left.insert(left.end(), right.begin(), right.end());
    return left;
  }

  std::vector<double> v_;
  double band_, noise_, cycle_, low_ = 0, high_ = 0;
};

CutTops cut(std::span<const double> u, double finest, double cycle, double sign) {
  if (u.size() < 50) return {};
  std::vector<double> v(u.begin(), u.end());
  for (double& x : v) x *= sign;
  const auto [low, high] = std::minmax_element(v.begin(), v.end());
  if (!(*high > *low)) return {};
  // A converter at its end gives one value; an amplifier at its limit is as noisy as elsewhere.
  const double one_value = std::max(0.25 * finest, 1e-9 * (*high - *low));
  const double noise = std::hypot(roughness(u), finest / std::sqrt(12.0));
  CutTops seen = End(v, one_value, noise, cycle).cut();
  if (!seen.found) seen = End(v, one_value + 8 * noise, noise, cycle).cut();
  seen.level *= sign;
  seen.would_be *= sign;
  return seen;
}

}  // namespace

CutTops cut_at_top(std::span<const double> u, double finest, double cycle) { return cut(u, finest, cycle, 1); }
CutTops cut_at_bottom(std::span<const double> u, double finest, double cycle) { return cut(u, finest, cycle, -1); }

}  // namespace hysteron
