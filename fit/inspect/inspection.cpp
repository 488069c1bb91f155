#include "fit/inspect/inspection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "engine/diagram/time_text.h"
#include "fit/inspect/inspected_rows.h"
#include "fit/inspect/inspection_words.h"
#include "fit/inspect/row_faults.h"
#include "fit/model/score.h"
#include "fit/numerics/median.h"
#include "fit/signals/branches.h"
#include "fit/signals/cut_tops.h"
#include "fit/signals/unit_words.h"

namespace hysteron {
namespace {

/// By how much a drive must come back to have turned. Where it differs from row to row by a good part of its range,
/// that is its motion and no noise on it.
double threshold_of_drive(std::span<const double> u) {
  constexpr double good_part = 0.05;  // white noise: about a seventh
  return roughness(u) > good_part * range_of(u) ? 0.02 * range_of(u) : turning_threshold(u);
}

/// Times at which each gap of the clock takes one step: what was not recorded was not seen held.
std::vector<double> without_gaps(std::span<const double> t, const Clock& clock) {
  std::vector<double> seen(t.begin(), t.end());
  for (const auto& gap : clock.gaps)
    for (std::size_t i = gap.row; i < seen.size(); ++i) seen[i] -= static_cast<double>(gap.missing) * clock.step;
  return seen;
}

class Inspector {
 public:
  Inspector(DataModel& model, InspectionQuestion question)
      : model_(model), question_(std::move(question)), parts_(parts_of(model.data())) {}

  Inspection run() {
    columns();
    recordings();
    for (const auto& name : program().input_names)
      if (auto note = note_of_reach(seen_, name); !note.empty()) seen_.notes.push_back(std::move(note));
    against_the_diagram();
    rows();
    repeats();
    lines();
    seen_.sentences = sentences_of(seen_, program().input_names, model_.outputs());
    return std::move(seen_);
  }

 private:
  const Program& program() const { return model_.program(); }
  Unit unit_of(const std::string& column) const {
    for (const auto& part : parts_)
      if (const auto& units = model_.recording(part.recording).units; units.contains(column)) return units.at(column);
    return {};
  }
  std::string role_of(const std::string& column) const {
    const auto is_one_of = [&](const std::vector<std::string>& names) {
      return std::find(names.begin(), names.end(), column) != names.end();
    };
    return is_one_of(program().input_names) ? "input" : is_one_of(model_.outputs()) ? "output" : "auxiliary";
  }

  void columns() {
    std::set<std::string> names;
    for (const auto& part : parts_)
      for (const auto& [name, rows] : model_.recording(part.recording).columns) names.insert(name);
    for (const auto& role : {"input", "output", "auxiliary"})
      for (const auto& name : names) {
        if (role_of(name) != role || name == column_of_cycles || name == column_of_start) continue;
        InspectedColumn c{name, role, unit_of(name)};
        c.lowest = std::numeric_limits<double>::infinity();
        c.highest = -c.lowest;
        std::vector<double> rough;
        for (const auto& part : parts_) {
          const auto rows = rows_of(model_, part, name);
          if (rows.empty()) continue;
          // An input acts in every row; of what is measured rows that are left out say nothing.
          const auto shown =
              c.role == "input" ? std::vector(rows.begin(), rows.end()) : judged_of(model_.data(), part, name);
          if (shown.empty()) continue;
          const auto [low, high] = std::minmax_element(shown.begin(), shown.end());
          c.lowest = std::min(c.lowest, *low);
          c.highest = std::max(c.highest, *high);
          rough.push_back(roughness(rows));
        }
        c.roughness = median(rough);
        c.finest = finest_step(model_.data(), name);
        seen_.columns.push_back(std::move(c));
      }
  }
  const InspectedColumn* column(const std::string& name) const {
    for (const auto& c : seen_.columns)
      if (c.name == name) return &c;
    return nullptr;
  }

  void recordings() {
    for (const auto& part : parts_) {
      const auto t = times_of(model_, part);
      InspectedRecording r;
      r.name = part.name;
      r.role = model_.recording(part.recording).role;
      r.rows = t.size();
      r.duration = t.empty() ? 0 : t.back() - t.front();
      r.clock = clock_of(t);
      const auto seen_times = without_gaps(t, r.clock);
      for (const auto& [name, u] : drives_of(model_, part)) {
        InspectedDrive d;
        d.input = name;
        d.unit = unit_of(name);
        const auto [low, high] = std::minmax_element(u.begin(), u.end());
        d.lowest = *low;
        d.highest = *high;
        for (std::size_t i = 1; i < u.size(); ++i)
          if (t[i] > t[i - 1]) d.fastest = std::max(d.fastest, std::abs(u[i] - u[i - 1]) / (t[i] - t[i - 1]));
        if (r.clock.regular) d.band = band_of(u, r.clock.step);
        d.reversals = turning_points(u, threshold_of_drive(u)).size();
        d.swings = swing_sizes(u).size();
        d.hold = longest_hold(seen_times, u, range_of(u));
        if (r.clock.regular && r.clock.gaps.empty()) d.period = period_of(u);
        r.drives.push_back(std::move(d));
      }
      seen_.recordings.push_back(std::move(r));
    }
  }

  // --- what the diagram tells of the data -----------------------------------------------------------------------

  void against_the_diagram() {
    for (int r = 0; r < model_.n_recordings(); ++r)
      if (model_.recording(r).role != Role::test) judged_.push_back(r);
    const Judge judge(model_, noise_before_fit(model_));
    const auto free = free_parameters(program(), question_.free_paths);
    const auto best = best_beside_calibration(model_, judge, free, judged_);
    prediction_ = best.prediction;
    if (!prediction_.ok) {
      seen_.notes.push_back("The diagram cannot be simulated on these recordings (" + prediction_.error +
                            "): shift, lines and the way between samples were judged without it.");
      return;
    }
    if (!question_.diagram_is_meant) return;
    seen_.delays = find_delays(model_, judge, prediction_);
    for (const auto& d : seen_.delays)
      if (!d.sentence.empty()) (d.kind == DelayKind::samples ? seen_.faults : seen_.notes).push_back(d.sentence + ".");
    seen_.between = other_ways_between(model_, judge, judged_, free, best);
    for (const auto& b : seen_.between) {
      const BetweenWords words = words_of(b);
      (words.is_fault ? seen_.faults : seen_.notes).push_back(words.text);
    }
  }

  // --- rows -----------------------------------------------------------------------------------------------------

  /// Columns of the diagram that stay at one value in all recordings.
  void still() {
    for (const auto& c : seen_.columns) {
      if (c.role == "auxiliary" || moves(model_.data(), c.name)) continue;
      const std::string stays =
          fmt::format("{} never moves: it is {} in every row", c.name, level_text(c.lowest, c.unit));
      if (c.role == "output")
        seen_.faults.push_back(
            stays +
            ". Nothing can be judged by it: check that the sensor was connected and that this is the right column.");
      else
        seen_.notes.push_back(stays + ". Its influence cannot be found from these recordings.");
    }
  }

  void rows() {
    still();
    cut_inputs();
    find_row_faults(model_, parts_, seen_);
    units();
    for (const auto& c : seen_.columns) {
      // With fewer levels the noise is no longer white and the high band shows less than there is.
      constexpr double few_levels = 300;
      if (c.role == "output" && c.finest > 0 && (c.highest - c.lowest) / c.finest < few_levels &&
          c.roughness < c.finest)
        seen_.notes.push_back(fmt::format(
            "{} has only {} levels, {} apart: that is its resolution, and quantization adds at least {} rms of noise.",
            c.name, std::lround((c.highest - c.lowest) / c.finest) + 1, size_text(c.finest, c.unit),
            size_text(c.finest / std::sqrt(12.0), c.unit)));
    }
  }

  /// What an amplifier or a logger took off a drive is not in the column; what was meant to be flat is no such thing.
  void cut_inputs() {
    for (const auto& name : program().input_names)
      for (const bool at_top : {true, false}) {
        InspectedCut all{name, unit_of(name), at_top};
        for (std::size_t k = 0; k < parts_.size(); ++k) {
          const Clock& clock = seen_.recordings[k].clock;
          const auto u = rows_of(model_, parts_[k], name);
          if (!clock.regular || !clock.gaps.empty() || !(range_of(u) > 0)) continue;
          const double frequency = cycle_frequency(times_of(model_, parts_[k]), u);
          const double cycle = frequency > 0 ? 1 / (frequency * clock.step) : 0, finest = column(name)->finest;
          add_cut(all, at_top ? cut_at_top(u, finest, cycle) : cut_at_bottom(u, finest, cycle), parts_[k].name);
        }
        if (!all.recordings.empty()) seen_.cuts.push_back(std::move(all));
      }
    for (const auto& cut : seen_.cuts) seen_.notes.push_back(cut_sentence(cut));
  }
  static void add_cut(InspectedCut& all, const CutTops& seen, const std::string& recording) {
    if (!seen.found) return;
    const auto farther = [&](double a, double b) { return all.at_top ? a > b : a < b; };
    if (all.recordings.empty() || farther(seen.would_be, all.would_be)) all.would_be = seen.would_be;
    if (all.recordings.empty() || farther(seen.level, all.level)) all.level = seen.level;
    all.tops += seen.tops;
    all.recordings.push_back(recording);
  }

  void units() {
    std::vector<std::string> without;
    for (const auto& c : seen_.columns)
      if (c.unit.text.empty() && c.role != "auxiliary") without.push_back(c.name);
    if (!without.empty())
      seen_.notes.push_back(fmt::format("No unit is written for {}: taken as plain numbers.", list_text(without)));
  }

  // --- what repeats ---------------------------------------------------------------------------------------------

  void repeats() {
    for (const auto& output : model_.outputs()) {
      std::vector<InspectedRepeat> found;
      for (std::size_t k = 0; k < parts_.size(); ++k) {
        const auto y = rows_of(model_, parts_[k], output);
        const auto period = common_period(seen_.recordings[k]);
        if (y.empty() || !period.found()) continue;
        found.push_back(
            {output, fmt::format("{:.3g} periods in {}", period.count(), parts_[k].name), unit_of(output),
             between_periods(y, rows_of(model_, parts_[k], seen_.recordings[k].drives.front().input), period)});
      }
      for (std::size_t a = 0; a < parts_.size(); ++a)
        for (std::size_t b = a + 1; b < parts_.size(); ++b)
          if (driven_alike(parts_[a], parts_[b]))
            found.push_back({output, fmt::format("{} and {}, driven alike", parts_[a].name, parts_[b].name),
                             unit_of(output),
                             between_takes(rows_of(model_, parts_[a], output), rows_of(model_, parts_[b], output))});
      std::erase_if(found, [](const InspectedRepeat& r) { return !r.floor.found(); });
      std::stable_sort(found.begin(), found.end(),
                       [](const auto& a, const auto& b) { return a.floor.rms < b.floor.rms; });
      seen_.repeats.insert(seen_.repeats.end(), found.begin(), found.end());
    }
  }
  /// The period of the only drive that moves; several drives repeat together only where their periods are equal.
  static Period common_period(const InspectedRecording& r) {
    if (r.drives.empty()) return {};
    Period p = r.drives.front().period;
    for (const auto& d : r.drives) {
      if (!d.period.found() || std::abs(d.period.rows - p.rows) > 0.5) return {};
      p.first = std::max(p.first, d.period.first);
      p.last = std::min(p.last, d.period.last);
    }
    return p.last > p.first && p.count() >= 2 ? p : Period{};
  }
  bool driven_alike(const InspectedPart& a, const InspectedPart& b) const {
    const auto ta = times_of(model_, a), tb = times_of(model_, b);
    if (ta.size() != tb.size() || ta.size() < 2) return false;
    if (std::abs((ta.back() - ta.front()) - (tb.back() - tb.front())) > 1e-3 * (ta.back() - ta.front())) return false;
    const auto& names = program().input_names;
    return !drives_of(model_, a).empty() && std::all_of(names.begin(), names.end(), [&](const std::string& name) {
      if (name == column_of_cycles || name == column_of_start) return true;
      return same_drive(rows_of(model_, a, name), rows_of(model_, b, name));
    });
  }

  // --- lines ----------------------------------------------------------------------------------------------------

  void lines() {
    for (std::size_t o = 0; o < model_.outputs().size(); ++o) {
      const auto& output = model_.outputs()[o];
      std::vector<InspectedLine> found;
      std::size_t looked = 0;
      for (std::size_t k = 0; k < parts_.size(); ++k) {
        const Clock& clock = seen_.recordings[k].clock;
        if (!clock.regular || !clock.gaps.empty()) continue;
        const InspectedPart& part = parts_[k];
        const auto y = rows_of(model_, part, output);
        if (y.empty()) continue;
        ++looked;
        std::vector<std::span<const double>> drives;
        for (const auto& [name, u] : drives_of(model_, part)) drives.push_back(u);
        const auto residual = residual_of(part, o, y);
        // Rounding of a steady ramp makes a line of a step over pi.
        const double rounding = column(output)->finest / std::numbers::pi;
        for (const auto& line : lines_of(residual.empty() ? y : std::span<const double>(residual), drives, clock.step))
          if (line.amplitude > 1.05 * rounding)
            add_line(found, {output, unit_of(output), line.frequency, line.amplitude, {part.name}, !residual.empty()},
                     1 / seen_.recordings[k].duration);
      }
      // What is in the laboratory is in most of its recordings; a single sight must be the only one there could be.
      for (auto& line : found)
        if (line.recordings.size() >= std::min<std::size_t>(2, looked)) seen_.lines.push_back(std::move(line));
    }
    for (const auto& line : seen_.lines)
      seen_.notes.push_back(fmt::format(
          "{} has a spectral line at {:.6g} Hz with an amplitude of {} (in {}) that no input causes: interference, or its alias if it is above half the sample rate.",
          line.output, line.frequency, size_text(line.amplitude, line.unit), list_text(line.recordings)));
  }
  static void add_line(std::vector<InspectedLine>& found, const InspectedLine& line, double width) {
    for (auto& other : found)
      if (std::abs(other.frequency - line.frequency) < 2 * width) {
        other.amplitude = std::max(other.amplitude, line.amplitude);
        other.recordings.push_back(line.recordings.front());
        return;
      }
    found.push_back(line);
  }
  std::vector<double> residual_of(const InspectedPart& part, std::size_t o, std::span<const double> y) const {
    std::vector<double> rows;
    if (!prediction_.ok) return rows;
    // The parts of a recording that was cut follow each other.
    for (const int r : judged_)
      if (r == part.recording || model_.data().single) {
        const auto& predicted = prediction_.y[static_cast<std::size_t>(r)][o];
        rows.insert(rows.end(), predicted.begin(), predicted.end());
      }
    if (rows.size() != y.size()) return {};
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = y[i] - rows[i];
    return rows;
  }

  DataModel& model_;
  InspectionQuestion question_;
  std::vector<InspectedPart> parts_;
  std::vector<int> judged_;
  Prediction prediction_;
  Inspection seen_;
};

}  // namespace

double finest_step(const DataSet& data, const std::string& column) {
  double finest = 0;
  for (const auto& part : parts_of(data))
    if (const double q = finest_step(rows_of(data, part, column)); q > 0 && (finest == 0 || q < finest)) finest = q;
  return finest;
}

bool moves(const DataSet& data, const std::string& column) {
  // One value in each recording, but not the same one, is a movement: of a temperature from day to day, say.
  std::optional<double> first;
  for (const auto& part : parts_of(data))
    for (const double value : rows_of(data, part, column)) {
      if (!first) first = value;
      if (value != *first) return true;
    }
  return false;
}

Inspection inspect(DataModel& model, const InspectionQuestion& question) { return Inspector(model, question).run(); }

}  // namespace hysteron
