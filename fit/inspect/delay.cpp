#include "fit/inspect/delay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/diagram/time_text.h"
#include "fit/numerics/median.h"

namespace hysteron {
namespace {

/// One recording: chi2 over the grid of shifts, on the rows that all shifts have.
struct Shifted {
  RecordingDelay delay;
  double chi2_zero = 0, chi2_best = 0;
  double weight = 0;  ///< information on `samples`
};

Shifted shifted(const DataModel& model, const Judge& judge, const Prediction& prediction, int r, int output,
                int reach) {
  Shifted s;
  s.delay.recording = r;
  s.delay.step = median_step(model.times(r));
  const Rows& measured = model.measured(r, output);
  const Rows& y = prediction.y[static_cast<std::size_t>(r)][static_cast<std::size_t>(output)];
  const auto n = static_cast<long>(measured.size());
  const auto& noise = judge.noise().outputs[static_cast<std::size_t>(output)];
  const Whitener whitener(static_cast<std::size_t>(n - 2 * reach), noise.white, noise.one_over_f,
                          model.zero_per_recording(output), Whitener::Order::any);
  std::vector<double> chi2, w(whitener.size());
  Rows rows(whitener.rows());
  for (int k = -reach; k <= reach; ++k) {
    for (long i = reach; i < n - reach; ++i)
      rows[static_cast<std::size_t>(i - reach)] =
          measured[static_cast<std::size_t>(i)] - y[static_cast<std::size_t>(i - k)];
    whitener.apply(rows, w.data());
    double sum = 0;
    for (const double x : w) sum += x * x;
    chi2.push_back(sum);
  }
  const auto best = std::min_element(chi2.begin(), chi2.end()) - chi2.begin();
  s.chi2_zero = chi2[static_cast<std::size_t>(reach)];
  s.chi2_best = chi2[static_cast<std::size_t>(best)];
  s.delay.samples = static_cast<double>(best - reach);
  s.delay.at_edge = best == 0 || best == 2 * reach;
  if (!s.delay.at_edge) {
    const auto b = static_cast<std::size_t>(best);
    const double slope = (chi2[b + 1] - chi2[b - 1]) / 2, bend = chi2[b + 1] - 2 * chi2[b] + chi2[b - 1];
    if (bend > 0) {
      s.delay.samples -= slope / bend;
      s.chi2_best -= slope * slope / (2 * bend);
      s.chi2_best = std::max(0.0, s.chi2_best);
      const double floor = std::max(s.chi2_best / static_cast<double>(whitener.size()), 1e-300);
      s.delay.sigma = std::sqrt(2 * floor / bend);
      s.weight = 1 / (s.delay.sigma * s.delay.sigma);
    }
  }
  s.delay.seconds = s.delay.samples * s.delay.step;
  s.delay.fall = s.chi2_zero > 0 ? 1 - s.chi2_best / s.chi2_zero : 0;
  return s;
}

struct Agreement {
  double mean = 0, spread = 0;  ///< spread relative to the mean
};

Agreement agreement(const std::vector<Shifted>& list, bool seconds) {
  double w = 0, sum = 0;
  for (const auto& s : list) {
    w += s.weight;
    sum += s.weight * (seconds ? s.delay.seconds : s.delay.samples);
  }
  Agreement a;
  if (!(w > 0)) return a;
  a.mean = sum / w;
  // Each recording counts once here: an agreement must not rest on the one that is sharpest.
  double squares = 0, n = 0;
  for (const auto& s : list) {
    if (!(s.weight > 0)) continue;
    const double d = (seconds ? s.delay.seconds : s.delay.samples) - a.mean;
    const double unsure = s.delay.sigma * (seconds ? s.delay.step : 1.0);
    squares += std::max(0.0, d * d - 4 * unsure * unsure);
    n += 1;
  }
  a.spread = a.mean != 0 ? std::sqrt(squares / std::max(1.0, n)) / std::abs(a.mean) : 0;
  return a;
}

DelayKind kind_of(const std::vector<Shifted>& list, DelayFinding& f) {
  const auto samples = agreement(list, false), seconds = agreement(list, true);
  f.samples = samples.mean;
  f.seconds = seconds.mean;
  double shortest = list.front().delay.step, longest = shortest;
  for (const auto& s : list) {
    shortest = std::min(shortest, s.delay.step);
    longest = std::max(longest, s.delay.step);
    if (s.delay.at_edge) return DelayKind::unclear;
  }
  constexpr double agree =
      0.25;  // a sampling fact is a whole number, a dead time one number: both are sharper than that
  if (longest < 1.2 * shortest) return samples.spread < agree ? DelayKind::tie : DelayKind::unclear;
  if (samples.spread < agree && samples.spread < seconds.spread / 2) return DelayKind::samples;
  if (seconds.spread < agree && seconds.spread < samples.spread / 2) return DelayKind::seconds;
  return DelayKind::unclear;
}

std::string samples_text(double samples) {
  const std::string number = fmt::format("{:.2g}", std::abs(samples));
  return number + (number == "1" ? " sample" : " samples");
}

std::string sentence_of(const DelayFinding& f, const std::string& name) {
  const char* late = f.samples > 0 ? "late" : "early";
  const std::string fall = fmt::format("this removes {:.0f} % of the squared error", 100 * f.fall);
  switch (f.kind) {
    case DelayKind::none:
      return "";
    case DelayKind::samples:
      return fmt::format(
          "{} comes {} {} at every sample rate ({}): a fact of the data; write \"delay\": \"{:.0f} "
          "sample{}\" at its column",
          name, samples_text(f.samples), late, fall, f.samples, std::abs(std::round(f.samples)) == 1 ? "" : "s");
    case DelayKind::seconds:
      return fmt::format(
          "{} comes {} {} at every sample rate ({}): a dead time of the device; try the effect dead_time", name,
          time_text(std::abs(f.seconds)), late, fall);
    case DelayKind::tie:
      return fmt::format(
          "{} comes {} = {} {} ({}); with one sample rate a delay of the column, a dead time and a lag "
          "cannot be told apart: if the data are known to be late, write \"delay\" at the column",
          name, samples_text(f.samples), time_text(std::abs(f.seconds)), late, fall);
    case DelayKind::unclear:
      for (const auto& r : f.recordings)
        if (r.at_edge && r.fall > 0.1)
          return fmt::format(
              "shifting {} by {:.0f} samples and more lowers the error ({}): the recording is not shifted in time; this "
              "points to hysteresis or a lag",
              name, std::abs(r.samples), fall);
      return fmt::format(
          "shifting {} in time would lower the error ({}), but by different amounts in different recordings: no delay",
          name, fall);
  }
  return "";
}

}  // namespace

std::vector<DelayFinding> find_delays(const DataModel& model, const Judge& judge, const Prediction& prediction,
                                      int reach) {
  std::vector<DelayFinding> findings;
  for (int o = 0; o < static_cast<int>(model.outputs().size()); ++o) {
    DelayFinding f;
    f.output = o;
    std::vector<Shifted> strong;
    double zero = 0, best = 0;
    for (int r = 0; r < model.n_recordings(); ++r) {
      const auto& y = prediction.y[static_cast<std::size_t>(r)];
      if (y.empty() || model.measured(r, o).size() < static_cast<std::size_t>(8 * reach)) continue;
      const auto s = shifted(model, judge, prediction, r, o, reach);
      zero += s.chi2_zero;
      best += s.chi2_best;
      f.recordings.push_back(s.delay);
      // Worth a word: a tenth of the squared error, more than chance, and more than the jitter of a clock.
      const double floor = s.chi2_best / static_cast<double>(model.measured(r, o).size());
      if (s.delay.fall > 0.1 && s.chi2_zero - s.chi2_best > 25 * std::max(1.0, floor) &&
          std::abs(s.delay.samples) > 0.25)
        strong.push_back(s);
    }
    f.fall = zero > 0 ? 1 - best / zero : 0;
    if (f.fall > 0.1 && !strong.empty()) f.kind = kind_of(strong, f);
    f.sentence = sentence_of(f, model.outputs()[static_cast<std::size_t>(o)]);
    findings.push_back(std::move(f));
  }
  return findings;
}

}  // namespace hysteron
