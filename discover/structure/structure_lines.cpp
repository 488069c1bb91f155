#include "discover/structure/structure_lines.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <span>

#include "discover/structure/residual_parts.h"
#include "fit/signals/excitation.h"

namespace hysteron {
namespace {

using Part = ResidualPart;

/// Fall of chi2 by a line of frequency f [Hz] in the recordings that can show it: not above the rows, one period at
/// least.
ByRole line_fall(const ResidualParts& parts, double f) {
  ByRole fall;
  for (const auto& p : parts.list()) {
    const double step = p.duration() / static_cast<double>(p.t.size() - 1);
    if (f * step > 0.45 || f * p.duration() < 1) continue;
    fall.of(p.train) +=
        parts.own_fall(p, [f](const Part& q) { return wave(q.t, q.t.front(), 2 * std::numbers::pi * f); });
  }
  return fall;
}

/// The strongest cosine coefficients of each recording, as frequencies [Hz] of at least two periods.
std::vector<double> strongest_frequencies(const ResidualParts& parts) {
  std::vector<double> list;
  for (const auto& p : parts.list()) {
    std::vector<std::size_t> order(static_cast<std::size_t>(p.w.size()));
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    const auto keep = static_cast<std::ptrdiff_t>(std::min<std::size_t>(4, order.size()));
    std::partial_sort(order.begin(), order.begin() + keep, order.end(), [&](std::size_t a, std::size_t b) {
      return std::abs(p.w[static_cast<Eigen::Index>(a)]) > std::abs(p.w[static_cast<Eigen::Index>(b)]);
    });
    for (auto k = order.begin(); k != order.begin() + keep; ++k)
      if (*k >= 4) list.push_back(static_cast<double>(*k) / (2 * p.duration()));
  }
  return list;
}

/// Climbs from x in steps of `width`, halved until `least`; x and fall are those of the top.
void climb(double& x, double& fall, double width, double least, const std::function<double(double)>& fall_at) {
  for (; width > least; width /= 2)
    for (const double at : {x - width, x + width})
      if (const double f = fall_at(at); f > fall) x = at, fall = f;
}

/// Rows less the straight line over x that fits them best: a trend would stand above every ripple.
Rows without_trend(const Rows& rows, const Rows& x) {
  const double n = static_cast<double>(rows.size());
  double mean_x = 0, mean = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) mean_x += x[i] / n, mean += rows[i] / n;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (rows[i] - mean);
  }
  Rows left(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) left[i] = rows[i] - mean - (xx > 0 ? xy / xx * (x[i] - mean_x) : 0);
  return left;
}

/// The residual over a level, train recordings only, each without its trend, added up in `bins` of the level's span;
/// and how many rows.
struct OverLevel {
  static constexpr std::size_t bins = 8192;  // 20 to a period of the finest ripple that is sought
  Rows sums = Rows(bins, 0.0);
  double rows = 0;
};

OverLevel over_level(const ResidualParts& parts, std::size_t level) {
  const Level& over = parts.levels()[level];
  OverLevel o;
  for (const auto& p : parts.list()) {
    if (!p.train) continue;
    const Rows e = without_trend(p.e, p.levels[level]);
    for (std::size_t i = 0; i < e.size(); ++i) {
      const double place = (p.levels[level][i] - over.lowest) / over.span() * OverLevel::bins;
      o.sums[std::min(static_cast<std::size_t>(std::max(place, 0.0)), OverLevel::bins - 1)] += e[i];
    }
    o.rows += static_cast<double>(p.e.size());
  }
  return o;
}

/// Squared amplitude of a ripple with so many lines over the level.
double ripple_power(const OverLevel& residual, double lines) {
  const std::complex<double> turn = std::polar(1.0, 2 * std::numbers::pi * lines / OverLevel::bins);
  std::complex<double> phase = 1, sum = 0;
  for (const double e : residual.sums) {
    sum += e * phase;
    phase *= turn;
  }
  return residual.rows > 0 ? std::norm(sum) / residual.rows : 0;
}

/// Fall of chi2, about, by lines of these frequencies [Hz] with white noise: its rows are uniform, or a line is
/// smeared. Eight at once, for one alone waits for its own turning.
void add_line_powers(const Part& p, double white, std::span<const double> f, std::span<double> powers) {
  using Eight = Eigen::Array<double, 8, 1>;
  const double step = p.duration() / static_cast<double>(p.t.size() - 1);
  const double unit = 2 / static_cast<double>(p.e.size()) / (white * white);
  for (std::size_t begin = 0; begin < f.size(); begin += 8) {
    const std::size_t n = std::min<std::size_t>(8, f.size() - begin);
    Eight angle = Eight::Zero();
    for (std::size_t i = 0; i < n; ++i)
      angle[static_cast<Eigen::Index>(i)] = 2 * std::numbers::pi * f[begin + i] * step;
    const Eight turn_c = angle.cos(), turn_s = angle.sin();
    Eight c = Eight::Ones(), s = Eight::Zero(), sum_c = Eight::Zero(), sum_s = Eight::Zero();
    for (const double e : p.e) {
      sum_c += e * c;
      sum_s += e * s;
      const Eight next = c * turn_c - s * turn_s;
      s = c * turn_s + s * turn_c;
      c = next;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      powers[begin + i] += unit * (sum_c[k] * sum_c[k] + sum_s[k] * sum_s[k]);
    }
  }
}

struct Peak {
  double f = 0, power = 0;
};

/// The highest peaks that stand apart from each other by `apart` [Hz].
std::vector<Peak> highest(std::vector<Peak> all, double apart, std::size_t most) {
  std::sort(all.begin(), all.end(), [](const Peak& a, const Peak& b) { return a.power > b.power; });
  std::vector<Peak> kept;
  for (const auto& p : all) {
    if (kept.size() == most) break;
    if (std::none_of(kept.begin(), kept.end(), [&](const Peak& k) { return std::abs(k.f - p.f) < apart; }))
      kept.push_back(p);
  }
  return kept;
}

}  // namespace

std::vector<Rows> wave(const Rows& x, double origin, double k) {
  Rows c(x.size()), s(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    c[i] = std::cos(k * (x[i] - origin));
    s[i] = std::sin(k * (x[i] - origin));
  }
  return {c, s};
}

std::vector<double> strongest_lines(const ResidualParts& parts, const std::vector<std::pair<double, double>>& bands,
                                    std::size_t most) {
  std::vector<const Part*> by_duration;
  for (const auto& p : parts.list()) by_duration.push_back(&p);
  std::stable_sort(by_duration.begin(), by_duration.end(),
                   [](const Part* a, const Part* b) { return a->duration() < b->duration(); });
  constexpr std::size_t followed = 12;
  std::vector<Peak> peaks;
  std::vector<const Part*> seen;
  double apart = 0;
  for (const Part* p : by_duration) {
    seen.push_back(p);
    const double step = 0.2 / p->duration();
    std::vector<std::pair<double, double>> around = bands;
    if (apart > 0) {
      around.clear();
      for (const auto& peak : peaks) around.emplace_back(peak.f - 0.6 * apart, peak.f + 0.6 * apart);
    }
    std::vector<double> f;
    for (const auto& [low, high] : around)
      for (double at = low; at <= high; at += step) f.push_back(at);
    std::vector<double> powers(f.size(), 0.0);
    for (const Part* q : seen) add_line_powers(*q, parts.white(), f, powers);
    std::vector<Peak> finer;
    for (std::size_t i = 0; i < f.size(); ++i) finer.push_back({f[i], powers[i]});
    apart = 1 / p->duration();
    peaks = highest(std::move(finer), apart, followed);
  }
  std::vector<double> list;
  for (const auto& peak : highest(std::move(peaks), apart, most)) list.push_back(peak.f);
  return list;
}

std::vector<double> strongest_ripples(const ResidualParts& parts, std::size_t level, double shortest, double longest,
                                      std::size_t most) {
  constexpr double step = 0.25;  // periods over the span: one apart they can be told
  const double span = parts.levels()[level].span();
  const OverLevel residual = over_level(parts, level);
  std::vector<Peak> ripples;
  for (double lines = span / longest; lines <= span / shortest; lines += step)
    ripples.push_back({lines, ripple_power(residual, lines)});
  std::vector<double> periods;
  for (const auto& ripple : highest(std::move(ripples), 1, most)) periods.push_back(span / ripple.f);
  return periods;
}

std::optional<Structure> line_in_time(const ResidualParts& parts) {
  const auto fall_at = [&](double frequency) { return line_fall(parts, frequency).all(); };
  double f = 0, fall = 0, longest = 0;
  for (const double candidate : strongest_frequencies(parts))
    if (const double now = fall_at(candidate); now > fall) f = candidate, fall = now;
  if (f <= 0) return std::nullopt;
  // The longest recording resolves 1/T: from half of that the climb begins, or it would pass by.
  for (const auto& p : parts.list())
    if (f * p.duration() < 0.45 * static_cast<double>(p.t.size())) longest = std::max(longest, p.duration());
  for (const double width : {0.02 * f, 1 / longest}) climb(f, fall, width, std::min(1e-5 * f, 1e-3 / longest), fall_at);
  Structure s;
  s.kind = "line_in_time";
  s.variable = "t";
  s.period = 1 / f;
  s.unit = parse_unit("s");
  s.fall = line_fall(parts, f);
  std::size_t rows = 2;
  for (const auto& p : parts.list()) {
    s.fall.of(p.train) -= 4;  // two numbers per recording
    rows = std::max(rows, p.t.size());
  }
  // The best of as many frequencies as a recording tells apart; whatever role it has, it may be chance that stands
  // there.
  const double chosen = 2 * std::log(static_cast<double>(rows) / 2);
  s.fall.train -= chosen;
  s.fall.validate -= chosen;
  std::vector<double> cycles;
  for (const auto& p : parts.list()) cycles.push_back(p.drive.empty() ? 0 : cycle_frequency(p.t, p.drive));
  s.harmonic = harmonic_order(f, cycles);
  return s;
}

std::optional<Structure> line_in_level(const ResidualParts& parts, std::size_t level) {
  const Level& over = parts.levels()[level];
  const auto wave_number = [&](double lines) { return 2 * std::numbers::pi * lines / over.span(); };
  const auto falls_at = [&](double lines) {
    return parts.judged([&](const Part& p) { return wave(p.levels[level], over.lowest, wave_number(lines)); });
  };
  const auto fall_at = [&](double lines) { return falls_at(lines).validate; };
  // Screened on plain rows over the level, where a trial costs next to nothing; the best few are judged whitened.
  constexpr std::ptrdiff_t judged = 6;
  std::vector<std::pair<double, double>> screened;
  const OverLevel residual = over_level(parts, level);
  for (double lines = 3; lines <= 130; lines += 0.5) screened.emplace_back(ripple_power(residual, lines), lines);
  std::partial_sort(screened.begin(), screened.begin() + judged, screened.end(), std::greater<>());
  double best = 0, fall = 0;
  for (auto s = screened.begin(); s != screened.begin() + judged; ++s)
    if (const double f = fall_at(s->second); f > fall) best = s->second, fall = f;
  if (best <= 0) return std::nullopt;
  climb(best, fall, 0.25, 0.01, fall_at);
  Structure s;
  s.kind = "line_in_level";
  s.variable = over.name;
  s.period = over.span() / best;
  s.unit = over.unit;
  s.fall = falls_at(best);
  return s;
}

}  // namespace hysteron
