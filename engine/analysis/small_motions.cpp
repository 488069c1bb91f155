#include "engine/analysis/small_motions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/analysis/sampled_model.h"
#include "engine/analysis/stability.h"

namespace hysteron {
namespace {

using std::numbers::pi;

constexpr int aliases_at_most = 16;   // of a pole over the common period, for the grid of frequencies
constexpr double nearly_real = 1e-9;  // of an end of the response

/// Limits of the gain at the ends of the axis.
std::vector<GainLimit> ends_of(const Response& response, bool integrates, double highest) {
  std::vector<GainLimit> list;
  const auto add = [&](std::complex<double> value, double at) {
    if (std::abs(value.imag()) > nearly_real * std::abs(value)) return;
    if (const auto limit = gain_limit_at_end(value.real(), at)) list.push_back(*limit);
  };
  if (!integrates) add(response(0), 0);
  if (highest > 0) add(response(highest), highest);
  return list;
}

bool has(std::span<const std::complex<double>> poles, std::complex<double> value) {
  return std::any_of(poles.begin(), poles.end(), [&](auto p) { return p == value; });
}

void judge_continuous(SmallMotions& m, const LinearModel& own) {
  const StableAt stable = [&](double gain) {
    return 1 + gain * own.d.front() != 0 && unstable_when_closed(own, gain).stable();
  };
  m.closed = 1 + own.d.front() != 0 ? unstable_when_closed(own) : PoleCount{0, 1, false};
  auto ends = ends_of(m.response, has(m.poles, 0), 0);
  if (own.delays.empty())
    if (const auto limit = gain_limit_at_end(own.d.front(), std::numeric_limits<double>::infinity()))
      ends.push_back(*limit);
  m.margins = margins(m.response, m.bode, stable, ends);
  // A gain of one and more at all high frequencies: there the shortest dead time turns it to -180 deg.
  if (m.margins->stable && m.bode.magnitude.back() >= 1) {
    m.margins->delay_margin = 0;
    m.margins->delay_margin_at = std::numeric_limits<double>::infinity();
  }
}

void continuous(SmallMotions& m, const Program& program, const Run& run, const LinearizeOptions& options, bool loop) {
  m.model = linearize(program, run, options);
  const auto own = std::make_shared<const LinearModel>(m.model.on_the_way());
  m.response = [own](double w) { return own->response(w).front(); };
  m.poles = own->poles();
  m.zeros = own->zeros();
  m.count = unstable_poles(*own);
  double longest = 0;
  for (const double delay : own->delays) longest = std::max(longest, delay);
  m.any_dead_time = longest > 0;
  m.bode = bode(m.response, widened(m.response, frequencies(m.poles, longest)), longest);
  if (loop) judge_continuous(m, *own);
}

/// As frequencies(), of poles s = log(z)/T and what they are taken for at higher ones, up to half the sampling rate.
std::vector<double> sampled_frequencies(const SampledModel& model, std::span<const std::complex<double>> poles) {
  const double highest = pi / model.sample();
  std::vector<std::complex<double>> marks;
  for (const auto& z : poles) {
    const auto s = std::log(z) / model.period();
    for (int k = 0; k <= std::min(model.looks() / 2, aliases_at_most); ++k)
      for (const double side : {-1.0, 1.0})
        marks.push_back(s + std::complex<double>(0, side * k * 2 * pi / model.period()));
  }
  marks.emplace_back(-highest / 100, 0);  // at least two decades below the highest
  auto w = frequencies(marks, 0);
  std::erase_if(w, [&](double at) { return at >= highest; });
  w.push_back(highest);
  return w;
}

void sampled(SmallMotions& m, const Program& program, const Run& run, const LinearizeOptions& options, bool loop) {
  const auto own = std::make_shared<const SampledModel>(program, run, options);
  m.sampled = SampledFacts{own->period(), own->sample(), own->looks(), own->acts_between()};
  m.response = [own](double w) { return own->response(w); };
  for (const auto& pole : own->poles()) m.poles.push_back(std::abs(pole.value - 1.0) <= pole.error ? 1.0 : pole.value);
  m.count = own->unstable();
  m.bode = bode(m.response, widened(m.response, sampled_frequencies(*own, m.poles), pi / own->sample()));
  if (!loop) return;
  m.closed = own->unstable_when_closed();
  const StableAt stable = [&](double gain) { return own->unstable_when_closed(gain).stable(); };
  if (own->looks() > 1) {
    m.margins = margins(m.response, m.bode, [&](double) { return m.closed->stable(); });
    search_gains(*m.margins, stable);
  } else {
    m.margins = margins(m.response, m.bode, stable, ends_of(m.response, has(m.poles, 1), m.bode.w.back()));
  }
  // Then dead times shorter than a sample tell nothing of whole ones.
  if (m.bode.magnitude.back() >= 1) m.margins->delay_margin.reset();
}

}  // namespace

SmallMotions small_motions(const Program& program, const Run& run, const LinearizeOptions& options, bool loop) {
  SmallMotions m;
  m.cuts = blocks_that_cut(program, run, options);
  if (is_sampled(program, run, options))
    sampled(m, program, run, options, loop);
  else
    continuous(m, program, run, options, loop);
  if (loop && m.closed->stable()) m.closed_loop = closed_loop(m.response, m.bode);
  return m;
}

}  // namespace hysteron
