// Decides which experiment would separate two fitted models of one device. See experiment.h.
#include "discover/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "discover/effects/library.h"
#include "discover/rows.h"
#include "engine/error.h"

namespace hysteron {
namespace {

using effects::rounded;
using effects::time_text;

constexpr double pi = std::numbers::pi;

std::string frequency_text(double hertz) {
  if (hertz >= 1000) return fmt::format("{:.3g} kHz", hertz / 1000);
  if (hertz >= 0.1) return fmt::format("{:.3g} Hz", hertz);
  return fmt::format("{:.3g} mHz", hertz * 1000);
}

class Menu {
 public:
  explicit Menu(const Device& d) : d_(d), middle_((d.lowest + d.highest) / 2), half_((d.highest - d.lowest) / 2) {
    fastest_ = 0.1 / d.shortest_step;  // ten rows per period still show its shape
    slowest_ = std::min(2 / d.longest_recording, fastest_ / 10);
  }

  std::vector<Protocol> all() {
    triangle();
    sines("sine_amplitudes", {std::sqrt(fastest_ * slowest_)}, {0.05, 0.25, 1});
    sines("low_frequencies",
          {slowest_, std::sqrt(slowest_ * std::sqrt(fastest_ * slowest_)), std::sqrt(fastest_ * slowest_)}, {0.25, 1});
    sines("high_frequencies", {fastest_ / 20, fastest_ / 4, fastest_}, {0.1, 0.5});
    multisine();
    steps("step_hold", {0, 0.5, 1, 0.5, 0}, std::max(d_.longest_recording / 4, 200 * d_.shortest_step));
    steps("fast_steps", {0, 0.1, 0, 0.5, 0, 1, 0}, 200 * d_.shortest_step);
    return std::move(list_);
  }

 private:
  double level(double part) const { return d_.lowest + part * (d_.highest - d_.lowest); }
  std::string value(double si) const { return fmt::format("{:.3g} {}", d_.unit.from_si(si), d_.unit.text); }
  std::string size(double si) const { return fmt::format("{:.3g} {}", d_.unit.difference_from_si(si), d_.unit.text); }

  void finish(const std::string& word, std::string text, std::vector<double> t, std::vector<double> v) {
    Protocol p;
    p.word = word;
    p.text = std::move(text);
    p.t = t;
    p.drive.t = std::move(t);
    p.drive.v = std::move(v);
    list_.push_back(std::move(p));
  }

  void triangle() {
    // Slow against everything that was recorded: one period takes a tenth of the longest recording.
    const double period = rounded(std::max(d_.longest_recording / 10, 200 * d_.shortest_step));
    std::vector<double> t, v;
    const int rows = 200;
    double begin = 0;
    for (const double a : {1.0, 0.8, 0.6, 0.4, 0.2}) {
      for (int k = 0; k < rows; ++k) {
        const double phase = static_cast<double>(k) / rows;
        t.push_back(begin + phase * period);
        v.push_back(level(0) + a * 2 * half_ * (phase < 0.5 ? 2 * phase : 2 - 2 * phase));
      }
      begin += period;
    }
    finish("triangle",
           fmt::format("decaying triangle from {}: 100, 80, 60, 40, 20 % of {}, period {}", value(level(0)),
                       size(2 * half_), time_text(period)),
           std::move(t), std::move(v));
  }

  void sines(const char* word, const std::vector<double>& frequencies, const std::vector<double>& amplitudes) {
    std::vector<double> t, v;
    double begin = 0;
    std::vector<std::string> hertz, sizes;
    for (const double a : amplitudes) sizes.push_back(size(a * half_));
    for (const double exact : frequencies) {
      const double f = rounded(exact);
      hertz.push_back(frequency_text(f));
      for (const double a : amplitudes) {
        const int rows = static_cast<int>(std::clamp(1 / (f * d_.shortest_step), 10.0, 100.0));
        for (int k = 0; k < 3 * rows; ++k) {
          t.push_back(begin + k / (rows * f));
          v.push_back(middle_ + a * half_ * std::sin(2 * pi * k / rows));
        }
        begin += 3 / f;
      }
    }
    finish(word,
           fmt::format("sines of {} around {} at {}, three periods each", fmt::join(sizes, ", "), value(middle_),
                       fmt::join(hertz, ", ")),
           std::move(t), std::move(v));
  }

  void multisine() {
    const int rows = 2000;
    const double duration = rows * d_.shortest_step;
    const int lines = 50;
    std::vector<double> t(rows), v(rows, middle_);
    for (int k = 0; k < rows; ++k) t[static_cast<std::size_t>(k)] = k * d_.shortest_step;
    // Odd lines with one of four left out; phases of a golden-angle sequence are as good as random and always the same.
    double peak = 0;
    std::vector<double> sum(rows, 0.0);
    for (int j = 0; j < lines; ++j) {
      if (j % 4 == 3) continue;
      const int line = 1 + 2 * static_cast<int>(std::lround(j * (0.1 * rows - 1) / (2.0 * lines)));
      const double phase = 2.399963229728653 * j * j;
      for (int k = 0; k < rows; ++k) sum[static_cast<std::size_t>(k)] += std::cos(2 * pi * line * k / rows + phase);
    }
    for (const double s : sum) peak = std::max(peak, std::abs(s));
    for (int k = 0; k < rows; ++k)
      v[static_cast<std::size_t>(k)] = middle_ + 0.9 * half_ * sum[static_cast<std::size_t>(k)] / peak;
    finish("multisine",
           fmt::format("random-phase multisine around {}, peak {}, odd lines of {} up to {} with one of four left out, "
                       "{} long, row every {}, three realisations of two periods",
                       value(middle_), size(0.9 * half_), frequency_text(1 / duration), frequency_text(fastest_),
                       time_text(duration), time_text(d_.shortest_step)),
           std::move(t), std::move(v));
  }

  void steps(const char* word, const std::vector<double>& levels, double hold) {
    hold = rounded(hold);
    std::vector<double> t, v;
    double begin = 0;
    std::vector<std::string> told;
    for (const double part : levels) {
      told.push_back(value(level(part)));
      // Rows spaced by the logarithm of the time since the step: that is where the motion is.
      const double first = d_.shortest_step;
      for (int k = 0; k < 200; ++k) {
        t.push_back(begin + first * std::pow(hold / first, k / 199.0) * (1 - 1e-9));
        v.push_back(level(part));
      }
      begin += hold;
    }
    t.insert(t.begin(), 0.0);
    v.insert(v.begin(), level(levels.front()));
    finish(word,
           fmt::format("levels {}, {} each, rows every {} at first, later spaced by log time", fmt::join(told, ", "),
                       time_text(hold), time_text(d_.shortest_step)),
           std::move(t), std::move(v));
  }

  const Device& d_;
  double middle_, half_, fastest_ = 1, slowest_ = 1;
  std::vector<Protocol> list_;
};

double rms_difference(std::vector<double> a, const std::vector<double>& b, bool free_zero) {
  double mean = 0;
  for (std::size_t k = 0; k < a.size(); ++k) a[k] -= b[k];
  if (free_zero) {
    for (const double d : a) mean += d;
    mean /= static_cast<double>(std::max<std::size_t>(a.size(), 1));
  }
  double sum = 0;
  for (const double d : a) sum += (d - mean) * (d - mean);
  return a.empty() ? 0 : std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

Device device_of(const Program& program, const DataSet& data) {
  Device d;
  d.shortest_step = std::numeric_limits<double>::infinity();
  d.longest_recording = 0;
  std::vector<double> low(program.input_names.size(), std::numeric_limits<double>::infinity());
  std::vector<double> high(program.input_names.size(), -std::numeric_limits<double>::infinity());
  d.others.assign(program.input_names.size(), 0.0);
  for (const auto& r : data.recordings) {
    if (r.role == Role::test || r.last < 2) continue;
    std::vector<double> dt;
    for (std::size_t k = 1; k < r.last; ++k) dt.push_back(r.t[k] - r.t[k - 1]);
    std::nth_element(dt.begin(), dt.begin() + static_cast<std::ptrdiff_t>(dt.size() / 2), dt.end());
    d.shortest_step = std::min(d.shortest_step, dt[dt.size() / 2]);
    d.longest_recording = std::max(d.longest_recording, r.t[r.last - 1] - r.t.front());
    for (std::size_t i = 0; i < low.size(); ++i) {
      const auto series = input_series(data, r, program.input_names[i]);
      const auto [a, b] = std::minmax_element(series->v.begin(), series->v.end());
      low[i] = std::min(low[i], *a);
      high[i] = std::max(high[i], *b);
      d.others[i] = series->v.front();
    }
  }
  for (std::size_t i = 0; i < low.size(); ++i)
    if (i == 0 || high[i] - low[i] > 0) {
      const bool moves_first = i == 0 || d.highest <= d.lowest;
      if (!moves_first) continue;
      d.input = program.input_names[i];
      d.input_index = static_cast<int>(i);
      d.unit = program.input_units[i];
      d.lowest = low[i];
      d.highest = high[i];
    }
  return d;
}

std::vector<Protocol> menu(const Device& device) {
  if (device.input.empty() || !(device.highest > device.lowest)) return {};
  return Menu(device).all();
}

std::optional<Experiment> separate(const ProgramPointer& a, const ProgramPointer& b,
                                   const std::vector<std::string>& outputs, const Device& device,
                                   const std::vector<double>& noise, const std::vector<bool>& free_zero,
                                   const std::vector<std::string>& preferred) {
  const auto signals_of = [&](const Program& p) {
    std::vector<int> list;
    for (const auto& name : outputs)
      for (std::size_t o = 0; o < p.output_names.size(); ++o)
        if (p.output_names[o] == name) list.push_back(p.output_signals[o]);
    return list;
  };
  std::optional<Experiment> best, wanted;
  for (auto& protocol : menu(device)) {
    std::vector<SeriesPointer> inputs;
    for (const double level : device.others)
      inputs.push_back(std::make_shared<const Series>(Series{{0.0}, {level}, Between::hold}));
    // A drive that starts away from its lowest level starts at rest there.
    inputs[static_cast<std::size_t>(device.input_index)] = std::make_shared<const Series>(protocol.drive);
    Experiment e;
    e.word = protocol.word;
    e.text = protocol.text;
    try {
      const auto ya = simulate_rows(a, inputs, protocol.t, signals_of(*a), true);
      const auto yb = simulate_rows(b, inputs, protocol.t, signals_of(*b), true);
      for (std::size_t o = 0; o < ya.size(); ++o)
        e.separation = std::max(e.separation, rms_difference(ya[o], yb[o], free_zero[o]) / noise[o]);
    } catch (const Error&) {
      continue;  // a model that cannot follow this drive says nothing about it
    }
    if (!std::isfinite(e.separation)) continue;
    const bool asked = std::find(preferred.begin(), preferred.end(), e.word) != preferred.end();
    if (asked && e.separation >= 2 && (!wanted || e.separation > wanted->separation)) wanted = e;
    if (!best || e.separation > best->separation) best = e;
  }
  return wanted ? wanted : best;
}

}  // namespace hysteron
