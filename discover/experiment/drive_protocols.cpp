// Decides the experiments that move one drive: triangles, sines, multisines, steps. See experiment_menu.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "discover/experiment/experiment_menu.h"
#include "discover/hypotheses/effect_terms.h"

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

/// The protocols of one drive, one variant. `part` of the range: sines about its middle, all else from its lowest end.
class Maker {
 public:
  Maker(const Device& device, const Drive& drive, const Variant& variant)
      : device_(device),
        drive_(drive),
        variant_(variant),
        middle_((drive.lowest + drive.highest) / 2),
        half_(variant.part * (drive.highest - drive.lowest) / 2),
        step_(device.shortest_step),
        speed_(variant.as_recorded ? fastest_of(device, drive.name) : std::numeric_limits<double>::infinity()) {
    fastest_ = 0.1 / step_;  // ten rows per period still show its shape
    slowest_ = std::min(2 / device.longest_recording, fastest_ / 10);
  }

  Protocol make(const std::string& word) {
    p_.word = word;
    const double between = std::sqrt(fastest_ * slowest_);
    if (word == "triangle") triangle();
    if (word == "sine_amplitudes") small_and_large(between);
    // What is slow stays slower than what is fast: these words say which it is.
    if (word == "low_frequencies") {
      fastest_ = std::max(between, fastest_ / 20);
      sines({slowest_, std::sqrt(slowest_ * between), between}, {0.25, 1});
    }
    if (word == "high_frequencies") sines({fastest_ / 20, fastest_ / 4, fastest_}, {0.1, 0.5});
    if (word == "multisine") multisine();
    if (word == "step_hold")
      steps({0, 0.5, 1, 0.5, 0}, std::max(variant_.slower * device_.longest_recording / 4, 200 * step_));
    if (word == "fast_steps") steps({0, 0.1, 0, 0.5, 0, 1, 0}, variant_.slower * 200 * step_);
    if (word == "zero_run") zero_run();
    if (word == "precycle") precycle();
    p_.moves[drive_.name] = {p_.t, std::move(v_), Between::linear};
    return std::move(p_);
  }

 private:
  double level(double part) const { return drive_.lowest + part * 2 * half_; }
  /// A level; as good as nothing in the range is written as nothing.
  std::string value(double si) const {
    const double number = drive_.unit.from_si(si);
    const double range = std::abs(drive_.unit.difference_from_si(drive_.highest - drive_.lowest));
    return fmt::format("{:.3g} {}", std::abs(number) < 5e-4 * range ? 0.0 : number, drive_.unit.text);
  }
  std::string size(double si) const {
    return fmt::format("{:.3g} {}", drive_.unit.difference_from_si(si), drive_.unit.text);
  }
  void row(double t, double v) {
    p_.t.push_back(t);
    v_.push_back(v);
  }
  void tell(const std::string& text, double duration) {
    const std::string slowed =
        slowed_ ? fmt::format(", smaller or later where it would move faster than recorded ({}/s)", size(speed_)) : "";
    p_.text =
        fmt::format("{}{}{}; {} in all", which_moves(device_, drive_), text, slowed, time_text(rounded(duration)));
  }
  /// A time that leaves as much to a way [SI] at the speed allowed.
  double time_for(double way) const { return way / speed_; }
  /// A period that is long enough for what it needs.
  double period_for(double usual, double needed) {
    double period = rounded(usual);
    if (period < needed) slowed_ = true;
    while (period < needed) period = rounded(1.005 * std::max(period, needed));
    return period;
  }
  /// When it can be at a value that comes next: at `begin`, or later.
  double when_at(double value, double begin) {
    if (v_.empty()) return begin;
    const double later = p_.t.back() + time_for(std::abs(value - v_.back()));
    if (later <= begin + 1e-6 * step_) return begin;  // but for rounding of the times that were recorded
    slowed_ = true;
    return later;
  }
  /// Rows in so much time: no more than asked, and none nearer to each other than they can be recorded.
  int rows_in(double duration, int most) const {
    return static_cast<int>(std::clamp(std::round(duration / step_), 10.0, static_cast<double>(most)));
  }

  void triangle() {
    // Slow against everything that was recorded: one period takes a tenth of the longest recording.
    const double period =
        period_for(std::max(variant_.slower * device_.longest_recording / 10, 200 * step_), time_for(4 * half_));
    const int rows = rows_in(period, 100);
    double begin = 0;
    for (const double a : {1.0, 0.8, 0.6, 0.4, 0.2}) {
      for (int k = 0; k < rows; ++k) {
        const double phase = static_cast<double>(k) / rows;
        row(begin + phase * period, level(a * (phase < 0.5 ? 2 * phase : 2 - 2 * phase)));
      }
      begin += period;
    }
    tell(fmt::format("decaying triangle from {}: 100, 80, 60, 40, 20 % of {}, period {}, row every {}", value(level(0)),
                     size(2 * half_), time_text(period), time_text(rounded(period / rows))),
         begin);
  }

  static constexpr int periods = 3;  ///< of each sine

  /// Sines from `begin` on; the answer: where they end.
  double sines_from(double begin, double f, double amplitude, double about) {
    const int rows = rows_in(1 / f, 40);
    begin = when_at(about, begin);
    if (const double most = speed_ / (2 * pi * f); amplitude > most) {
      amplitude = most;
      slowed_ = true;
    }
    for (int k = 0; k < periods * rows; ++k)
      row(begin + k / (rows * f), about + amplitude * std::sin(2 * pi * k / rows));
    return begin + periods / f;
  }
  double frequency(double usual) const { return rounded(std::min(usual / variant_.slower, fastest_)); }

  void sines(const std::vector<double>& frequencies, const std::vector<double>& amplitudes) {
    double begin = 0;
    std::vector<std::string> hertz, sizes;
    for (const double a : amplitudes) sizes.push_back(size(a * half_));
    for (const double usual : frequencies) {
      const double f = frequency(usual);
      if (!hertz.empty() && hertz.back() == frequency_text(f)) continue;
      hertz.push_back(frequency_text(f));
      for (const double a : amplitudes) begin = sines_from(begin, f, a * half_, middle_);
    }
    tell(fmt::format("sines of {} around {} at {}, three periods each, 10 rows or more in a period",
                     fmt::join(sizes, ", "), value(middle_), fmt::join(hertz, ", ")),
         begin);
  }

  /// Small, middling and large ones about the middle, and the small one about other levels.
  void small_and_large(double usual) {
    const double f = frequency(usual), little = 0.05 * half_;
    double begin = 0;
    for (const double a : {0.05, 0.25, 1.0}) begin = sines_from(begin, f, a * half_, middle_);
    std::vector<std::string> about;
    for (const double bias : {-0.8, -0.4, 0.4, 0.8}) {
      about.push_back(value(middle_ + bias * half_));
      begin = sines_from(begin, f, little, middle_ + bias * half_);
    }
    tell(fmt::format("sines of {}, {}, {} around {}, then of {} around {}, all at {}, three periods each, 10 rows or "
                     "more in a period",
                     size(little), size(0.25 * half_), size(half_), value(middle_), size(little),
                     fmt::join(about, ", "), frequency_text(f)),
         begin);
  }

  /// One period of odd lines with one of four left out, its peak 1. Phases of a golden-angle sequence are as good as
  /// random and always the same.
  static std::vector<double> odd_lines(int rows, int realisation) {
    std::vector<double> sum(static_cast<std::size_t>(rows), 0.0);
    for (int j = 0; 2 * j + 1 <= rows / 10; ++j) {
      if (j % 4 == 3) continue;
      const double phase = 2.399963229728653 * (j * j + realisation * (2 * j + 1));
      for (int k = 0; k < rows; ++k)
        sum[static_cast<std::size_t>(k)] += std::cos(2 * pi * (2 * j + 1) * k / rows + phase);
    }
    double peak = 0;
    for (const double s : sum) peak = std::max(peak, std::abs(s));
    for (double& s : sum) s /= peak;
    return sum;
  }

  /// From row to row, once around.
  static double largest_change(const std::vector<double>& wave) {
    double largest = 0;
    for (std::size_t k = 0; k < wave.size(); ++k)
      largest = std::max(largest, std::abs(wave[(k + 1) % wave.size()] - wave[k]));
    return largest;
  }

  void multisine() {
    const int rows = 300;
    const double every = variant_.slower * step_, period = rows * every;
    double peak = 0.9 * half_, late = 0;
    for (int realisation = 0; realisation < 3; ++realisation)
      peak = std::min(peak, speed_ * every / largest_change(odd_lines(rows, realisation)));
    slowed_ = peak < 0.9 * half_;
    for (int realisation = 0; realisation < 3; ++realisation) {
      const auto wave = odd_lines(rows, realisation);
      const double begin = realisation * 2 * rows * every + late;
      late += when_at(middle_ + peak * wave[0], begin) - begin;
      for (int k = 0; k < 2 * rows; ++k)
        row((realisation * 2 * rows + k) * every + late, middle_ + peak * wave[static_cast<std::size_t>(k % rows)]);
    }
    tell(fmt::format("random-phase multisine around {}, peak {}, odd lines of {} up to {} with one of four left out, "
                     "row every {}, three realisations of two periods of {}",
                     value(middle_), size(peak), frequency_text(1 / period), frequency_text(0.1 / every),
                     time_text(every), time_text(period)),
         6 * period + late);
  }

  void steps(const std::vector<double>& levels, double exact_hold) {
    const double hold = rounded(exact_hold);
    const double ratio = std::pow(hold / step_, 1.0 / 40);
    double begin = 0;
    std::vector<std::string> told;
    row(0, level(levels.front()));
    for (const double part : levels) {
      told.push_back(value(level(part)));
      begin += ramp_to(level(part), begin);
      // Rows spaced by the logarithm of the time since the step: that is where the motion is.
      for (double t = step_; t < hold - step_; t = std::max(t + step_, t * ratio)) row(begin + t, level(part));
      row(begin + hold * (1 - 1e-9), level(part));
      begin += hold;
    }
    tell(fmt::format("levels {}, {} each, rows every {} at first, later spaced by log time", fmt::join(told, ", "),
                     time_text(hold), time_text(step_)),
         begin);
  }

  static constexpr int rows_of_ramp = 10;

  /// So much later than one row behind `begin` a step can be at its level: rows on the way there.
  double ramp_to(double level, double begin) {
    const double from = v_.back(), t = p_.t.back();
    const double late = when_at(level, begin + step_) - (begin + step_);
    const double way = late > 0 ? begin + step_ + late - t : 0;
    const int rows = std::min(rows_of_ramp, static_cast<int>(way / step_));
    for (int k = 1; k < rows; ++k) row(t + way * k / rows, from + (level - from) * k / rows);
    return late;
  }

  /// Nothing moves: what the output does is noise, drift or picked up.
  void zero_run() {
    const double duration = rounded(std::max(device_.longest_recording, 1800.0));
    const int fast = 100, slow = 300;
    for (int k = 0; k < fast; ++k) row(k * step_, middle_);
    for (int k = 1; k <= slow; ++k) row(fast * step_ + (duration - fast * step_) * k / slow, middle_);
    tell(fmt::format("{} held still, rows every {} at first, later every {}", value(middle_), time_text(step_),
                     time_text(rounded(duration / slow))),
         duration);
  }

  /// What the device remembers is wiped out before it is recorded.
  void precycle() {
    const int count = 20, rows = 40;
    // The envelope adds 1 % to the speed.
    const double period = period_for(std::max(rows * step_, device_.longest_recording / 40), time_for(6.4 * half_));
    for (int k = 0; k < count * rows; ++k)
      row(k * period / rows, middle_ + half_ * (1 - k / (1.0 * count * rows)) * std::sin(2 * pi * k / rows));
    const Series& recorded = device_.recorded.at(drive_.name);
    const double begin = when_at(recorded.v.front(), count * period), first = device_.recorded_times.front();
    // The others too begin as they are recorded.
    for (const auto& [name, series] : device_.recorded) {
      if (name == drive_.name) continue;
      Series later = series;
      for (double& t : later.t) t += begin - first;
      p_.moves[name] = std::move(later);
    }
    for (std::size_t k = 0; k < recorded.t.size(); ++k) row(begin + recorded.t[k] - first, recorded.v[k]);
    tell(fmt::format("a sine around {} that decays from {} to nothing in {} periods of {}, then the longest recording "
                     "again",
                     value(middle_), size(half_), count, time_text(period)),
         begin + device_.longest_recording);
  }

  const Device& device_;
  const Drive& drive_;
  Variant variant_;
  double middle_, half_, step_, speed_, fastest_ = 1, slowest_ = 1;
  bool slowed_ = false;  ///< the speed of the recordings bound it
  Protocol p_;
  std::vector<double> v_;
};

}  // namespace

const std::vector<std::string>& drive_words() {
  static const std::vector<std::string> words{"triangle",  "sine_amplitudes", "low_frequencies", "high_frequencies",
                                              "multisine", "step_hold",       "fast_steps",      "zero_run"};
  return words;
}

const std::vector<double>& paces(const std::string& word) {
  static const std::vector<double> faster{1, 1.0 / 3, 1.0 / 9}, slower{1, 3, 9}, either{1, 3, 1.0 / 3};
  static const std::vector<double> as_it_is{1};
  if (word == "zero_run" || word == "precycle") return as_it_is;
  if (word == "high_frequencies" || word == "multisine") return slower;
  return word == "sine_amplitudes" || word == "fast_steps" ? either : faster;
}

Protocol drive_protocol(const Device& device, const Drive& drive, const std::string& word, const Variant& variant) {
  return Maker(device, drive, variant).make(word);
}

}  // namespace hysteron
