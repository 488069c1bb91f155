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
#include "fit/median.h"

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

  std::vector<Protocol> all(const std::vector<SideRead>& sides) {
    bool uncontrolled = false;
    for (const auto& side : sides) {
      if (side.kind == Side::temperature) {
        temperature_staircase(side.name);
        temperature_constant(side.name);
      }
      if (side.kind == Side::other_axis) axes_independent();
      if (is_use(side)) repeat_after_cycles(side.name);
      uncontrolled = uncontrolled || side.kind == Side::temperature || is_use(side);
    }
    if (!uncontrolled) drives();
    return std::move(list_);
  }

 private:
  void drives() {
    triangle();
    sines("sine_amplitudes", {std::sqrt(fastest_ * slowest_)}, {0.05, 0.25, 1});
    sines("low_frequencies",
          {slowest_, std::sqrt(slowest_ * std::sqrt(fastest_ * slowest_)), std::sqrt(fastest_ * slowest_)}, {0.25, 1});
    sines("high_frequencies", {fastest_ / 20, fastest_ / 4, fastest_}, {0.1, 0.5});
    multisine();
    steps("step_hold", {0, 0.5, 1, 0.5, 0}, std::max(d_.longest_recording / 4, 200 * d_.shortest_step));
    steps("fast_steps", {0, 0.1, 0, 0.5, 0, 1, 0}, 200 * d_.shortest_step);
  }

  double level(double part) const { return d_.lowest + part * (d_.highest - d_.lowest); }
  std::string value(double si) const { return fmt::format("{:.3g} {}", d_.unit.from_si(si), d_.unit.text); }
  std::string size(double si) const { return fmt::format("{:.3g} {}", d_.unit.difference_from_si(si), d_.unit.text); }

  void finish(const std::string& word, std::string text, std::vector<double> t, std::vector<double> v) {
    Protocol p;
    p.word = word;
    p.text = std::move(text);
    p.t = t;
    p.moves[d_.input] = {std::move(t), std::move(v), Between::linear};
    list_.push_back(std::move(p));
  }

  /// What the device had behind it when a recording began (a data set's cycles_before, start).
  static bool is_use(const SideRead& side) { return side.name == "cycles_before" || side.name == "start"; }

  void repeat_after_cycles(const std::string& use) {
    if (d_.recorded_times.empty()) return;
    const auto range = d_.ranges.find(use);
    const double most = range == d_.ranges.end() ? 0 : range->second.second;
    const bool cycles = use == "cycles_before";
    const double later = cycles ? 10 * most + 1e5 : 10 * most + 30 * 86400.0;
    Protocol p;
    p.word = "repeat_after_cycles";
    p.text = cycles ? fmt::format("the longest recording again after {:.2g} cycles", later)
                    : fmt::format("the longest recording again after {:.2g} days of use", later / 86400);
    p.t = d_.recorded_times;
    p.moves = d_.recorded;
    p.moves[use] = {{0.0}, {later}, Between::hold};
    list_.push_back(std::move(p));
  }

  double start_of(const std::string& signal) const {
    const auto found = d_.levels.find(signal);
    return found == d_.levels.end() ? 0 : found->second;
  }

  /// Three plateaus, from today's temperature up, or back to a usual room where today's is none; on each a sine over
  /// the whole range, then a hold.
  void temperature_staircase(const std::string& temperature) {
    const double from = start_of(temperature);
    const auto range = d_.ranges.find(temperature);
    const double to_room = effects::usual_room(from) - from;
    const double up = std::max(10.0, range == d_.ranges.end() ? 0 : 2 * (range->second.second - range->second.first));
    const double rise = std::abs(to_room) >= up / 3 ? to_room : up;
    const double plateau = rounded(d_.longest_recording / 2);
    Protocol p;
    p.word = "temperature_staircase";
    Series drive, warm;
    const int rows = 200;
    for (int k = 0; k < 3 * rows; ++k) {
      const int step = k / rows;
      const double part = static_cast<double>(k % rows) / rows;
      p.t.push_back((step + part) * plateau);
      drive.v.push_back(part < 0.5 ? level(0) + half_ * (1 - std::cos(8 * pi * part)) : level(0));
      warm.v.push_back(from + rise * step / 2);
    }
    drive.t = warm.t = p.t;
    p.moves = {{d_.input, std::move(drive)}, {temperature, std::move(warm)}};
    p.text = fmt::format(
        "temperature {0:.3g} K, {1:.3g} K {3} today's on plateaus of {2} or more; on each, and before, "
        "two sines over the whole range and a hold",
        std::abs(rise / 2), std::abs(rise), time_text(plateau), rise > 0 ? "above" : "below");
    list_.push_back(std::move(p));
  }

  void temperature_constant(const std::string& temperature) {
    if (d_.recorded_times.empty()) return;
    Protocol p;
    p.word = "temperature_constant";
    p.text = fmt::format("the longest recording ({}) again, the temperature held, or at another time of the day",
                         time_text(d_.longest_recording));
    p.t = d_.recorded_times;
    p.moves = d_.recorded;
    p.moves.erase(temperature);
    list_.push_back(std::move(p));
  }

  /// A drive that has stood still while this one moves, and the other way round.
  void axes_independent() {
    std::vector<std::string> axes{d_.input};
    for (const auto& [name, range] : d_.ranges)
      if (name != d_.input && std::find(d_.drives.begin(), d_.drives.end(), name) != d_.drives.end() &&
          range.second > range.first)
        axes.push_back(name);
    if (axes.size() < 2) return;
    Protocol p;
    p.word = "axes_independent";
    p.text = fmt::format("a triangle over the whole range of {} with the others still, one after the other",
                         fmt::join(axes, ", "));
    const double period = rounded(std::max(d_.longest_recording / 10, 200 * d_.shortest_step));
    const int rows = 200;
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
      for (int k = 0; k < rows; ++k)
        p.t.push_back((static_cast<double>(axis) + static_cast<double>(k) / rows) * period);
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
      Series s;
      s.t = p.t;
      const auto [low, high] = d_.ranges.at(axes[axis]);
      for (std::size_t k = 0; k < p.t.size(); ++k) {
        const double phase = static_cast<double>(k % rows) / rows;
        s.v.push_back(k / rows != axis ? low : low + (high - low) * (phase < 0.5 ? 2 * phase : 2 - 2 * phase));
      }
      p.moves[axes[axis]] = std::move(s);
    }
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

namespace {

void note_range(Device& d, const std::string& name, const std::vector<double>& v) {
  const auto [a, b] = std::minmax_element(v.begin(), v.end());
  const auto [at, is_new] = d.ranges.try_emplace(name, *a, *b);
  at->second = {std::min(at->second.first, *a), std::max(at->second.second, *b)};
  d.levels[name] = v.front();
}

/// Columns that a program may read: its inputs, and what it does not measure.
std::map<std::string, Series> moved_in(const Device& d, const Program& program, const DataSet& data,
                                       const Recording& r) {
  std::map<std::string, Series> list;
  for (const auto& name : d.drives) list[name] = *input_series(data, r, name);
  for (const auto& [name, column] : r.columns)
    if (!list.contains(name) &&
        std::find(program.output_names.begin(), program.output_names.end(), name) == program.output_names.end())
      list[name] = {r.t, column, Between::linear};
  return list;
}

}  // namespace

Device device_of(const Program& program, const DataSet& data) {
  Device d;
  d.shortest_step = std::numeric_limits<double>::infinity();
  d.longest_recording = 0;
  d.drives = program.input_names;
  for (const auto& r : data.recordings) {
    if (r.role == Role::test || r.last < 2) continue;
    d.shortest_step = std::min(d.shortest_step, median_step({r.t.begin(), r.t.begin() + static_cast<long>(r.last)}));
    auto moved = moved_in(d, program, data, r);
    for (const auto& [name, series] : moved) note_range(d, name, series.v);
    const double duration = r.t[r.last - 1] - r.t.front();
    if (duration <= d.longest_recording) continue;
    d.longest_recording = duration;
    d.recorded_times = r.t;
    d.recorded = std::move(moved);
  }
  // The first input that moves.
  for (std::size_t i = 0; i < d.drives.size(); ++i) {
    const auto [low, high] = d.ranges[d.drives[i]];
    if (i > 0 && (!(high > low) || d.highest > d.lowest)) continue;
    d.input = d.drives[i];
    d.unit = program.input_units[i];
    d.lowest = low;
    d.highest = high;
  }
  return d;
}

std::vector<Protocol> menu(const Device& device, const std::vector<SideRead>& sides) {
  if (device.input.empty() || !(device.highest > device.lowest)) return {};
  return Menu(device).all(sides);
}

namespace {

/// What the outputs of a program do in an experiment; what it does not move stays where recordings start.
std::vector<std::vector<double>> answer(const ProgramPointer& program, const Protocol& protocol, const Device& device,
                                        const std::vector<std::string>& outputs) {
  std::vector<int> signals;
  for (const auto& name : outputs)
    for (std::size_t o = 0; o < program->output_names.size(); ++o)
      if (program->output_names[o] == name) signals.push_back(program->output_signals[o]);
  std::vector<SeriesPointer> inputs;
  for (const auto& name : program->input_names) {
    const auto moves = protocol.moves.find(name);
    const auto level = device.levels.find(name);
    inputs.push_back(std::make_shared<const Series>(
        moves != protocol.moves.end()
            ? moves->second
            : Series{{0.0}, {level == device.levels.end() ? 0.0 : level->second}, Between::hold}));
  }
  return simulate_rows(program, inputs, protocol.t, signals, true);
}

}  // namespace

std::optional<Experiment> separate(const Rivals& rivals, const std::vector<std::string>& outputs, const Device& device,
                                   const std::vector<double>& noise, const std::vector<bool>& free_zero) {
  std::optional<Experiment> best, wanted;
  const auto offer = [&](const Protocol& protocol, const std::string& word, const std::string& text,
                         const ProgramPointer& a, const ProgramPointer& b) {
    Experiment e;
    e.word = word;
    e.text = text;
    e.rows = static_cast<double>(protocol.t.size());
    try {
      const auto ya = answer(a, protocol, device, outputs), yb = answer(b, protocol, device, outputs);
      for (std::size_t o = 0; o < ya.size(); ++o)
        e.separation = std::max(e.separation, rms_difference(ya[o], yb[o], free_zero[o]) / noise[o]);
    } catch (const Error&) {
      return;  // a model that cannot follow this drive says nothing about it
    }
    if (!std::isfinite(e.separation)) return;
    const bool asked = std::find(rivals.preferred.begin(), rivals.preferred.end(), e.word) != rivals.preferred.end();
    if (asked && e.separation >= 2 && (!wanted || e.separation > wanted->separation)) wanted = e;
    if (!best || e.separation > best->separation) best = e;
  };
  for (const auto& protocol : menu(device, rivals.sides)) {
    offer(protocol, protocol.word, protocol.text, rivals.a, rivals.b);
    if (protocol.word == "triangle" && rivals.motion_a && rivals.motion_b)
      offer(protocol, "reference_sensor", protocol.text + ", measured by a second, independent sensor besides",
            rivals.motion_a, rivals.motion_b);
  }
  return wanted ? wanted : best;
}

}  // namespace hysteron
