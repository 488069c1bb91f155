// Decides what the recordings show at a place: range, reversals, holds, pace of the signal on the wire.
#include "discover/placement/excitation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>

#include "discover/placement/rows.h"
#include "discover/wiring/wiring.h"
#include "engine/diagram/index.h"
#include "engine/program/program.h"
#include "fit/inspect/inspection.h"
#include "fit/model/free_parameter.h"
#include "fit/model/noise.h"
#include "fit/numerics/median.h"
#include "fit/signals/branches.h"
#include "fit/signals/excitation.h"

namespace hysteron {
namespace {

std::vector<std::vector<double>> traces(const ProgramPointer& program, const DataSet& data, const Recording& recording,
                                        const std::vector<int>& signals) {
  std::vector<SeriesPointer> inputs;
  for (const auto& name : program->input_names) inputs.push_back(input_series(data, recording, name));
  return simulate_rows(program, inputs, recording.t, signals, recording.at_rest);
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double ma = 0, mb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ma += a[i] / static_cast<double>(a.size());
    mb += b[i] / static_cast<double>(b.size());
  }
  double aa = 0, ab = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - ma) * (a[i] - ma);
    ab += (a[i] - ma) * (b[i] - mb);
    bb += (b[i] - mb) * (b[i] - mb);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

/// The only signal that a block reads beside constants; -1 if there are several or none.
int moving_input(const Program& program, const BlockInstance& block) {
  int moving = -1;
  for (const int s : block.source) {
    const auto& from = program.blocks[static_cast<std::size_t>(program.signals[static_cast<std::size_t>(s)].block)];
    if (from.n_u == 0 && !from.kernel->uses_time && !from.kernel->declaration.is_series) continue;
    if (moving >= 0) return -1;
    moving = s;
  }
  return moving;
}

bool is_linear(const BlockInstance& block) {
  return block.kernel->declaration.is_linear || block.kernel->reach_back != nullptr;
}

/// Gains and offsets in the chain of linear blocks before and behind a signal.
class InSeries {
 public:
  InSeries(const Program& program, const std::vector<std::string>& free_paths) : program_(program) {
    for (const auto& f : free_parameters(program, free_paths))
      free_.push_back(&program.parameters[static_cast<std::size_t>(f.parameter)]);
  }

  void look(int signal, Excitation& c) const {
    for (int s = signal, depth = 0; s >= 0 && depth < 64; ++depth) s = behind(s, c);
    for (int s = signal, depth = 0; s >= 0 && depth < 64; ++depth) s = before(s, c);
  }

 private:
  const BlockInstance& block_of(int signal) const {
    return program_.blocks[static_cast<std::size_t>(program_.signals[static_cast<std::size_t>(signal)].block)];
  }
  bool is_free(const ParameterInfo& p) const { return std::find(free_.begin(), free_.end(), &p) != free_.end(); }

  /// Of several branches that move, the gain of one is in series with nothing; its zero is one.
  enum class Where { before, behind, branch };

  void note(int block, Excitation& c, Where where) const {
    const bool constant = program_.blocks[static_cast<std::size_t>(block)].n_u == 0;
    if (program_.blocks[static_cast<std::size_t>(block)].kernel->uses_time) return;  // a line of the mains is no zero
    for (const auto& p : program_.parameters) {
      if (!p.linear || p.block != block) continue;
      if (!p.offset && !constant) {
        c.gain_is_free = c.gain_is_free || (where != Where::branch && is_free(p));
      } else {
        c.offset_is_free = c.offset_is_free || is_free(p);
        if (where == Where::behind) c.zeros.push_back(p.path);
      }
    }
  }
  int behind(int signal, Excitation& c) const {
    int reader = -1;
    for (std::size_t b = 0; b < program_.blocks.size(); ++b)
      for (const int s : program_.blocks[b].source)
        if (s == signal) {
          if (reader >= 0 && reader != static_cast<int>(b)) return -1;
          reader = static_cast<int>(b);
        }
    if (reader < 0) return -1;
    const auto& block = program_.blocks[static_cast<std::size_t>(reader)];
    if (!is_linear(block) || moving_input(program_, block) != signal) return -1;
    note(reader, c, Where::behind);
    for (const int s : block.source)
      if (s != signal) note(program_.signals[static_cast<std::size_t>(s)].block, c, Where::behind);
    return block.y_begin;
  }
  int before(int signal, Excitation& c) const {
    const auto& block = block_of(signal);
    if (block.n_u == 0 || !is_linear(block)) return -1;
    note(program_.signals[static_cast<std::size_t>(signal)].block, c, Where::before);
    const int moving = moving_input(program_, block);
    for (const int s : block.source)
      if (s != moving)
        note(program_.signals[static_cast<std::size_t>(s)].block, c, moving < 0 ? Where::branch : Where::before);
    return moving;
  }

  const Program& program_;
  std::vector<const ParameterInfo*> free_;
};

/// Linear parameters of the blocks with memory that this signal moves.
std::vector<std::string> weights_behind(const Program& program, int signal) {
  std::vector<std::string> list;
  const auto below = program.downstream_of(program.signals[static_cast<std::size_t>(signal)].block);
  for (const auto& p : program.parameters) {
    const auto block = static_cast<std::size_t>(p.block);
    if (p.block >= 0 && below[block] && p.linear && !program.blocks[block].kernel->declaration.memory_port.empty())
      list.push_back(p.path);
  }
  return list;
}

/// Numbers of a block by their names [SI].
std::map<std::string, double> numbers_of(const Program& program, const std::string& block) {
  std::map<std::string, double> numbers;
  for (const auto& p : program.parameters)
    if (p.path.starts_with(block + ".")) numbers[p.path.substr(block.size() + 1)] = p.value;
  return numbers;
}

/// Name of the output that this signal is; "" = none.
std::string output_at(const Program& program, int signal) {
  const auto output = std::find(program.output_signals.begin(), program.output_signals.end(), signal);
  if (output == program.output_signals.end()) return "";
  return program.output_names[static_cast<std::size_t>(output - program.output_signals.begin())];
}

/// Step of the levels of the output that this signal is; 0 = none, or no output.
double resolution_at(const Program& program, const DataSet& data, int signal) {
  const std::string output = output_at(program, signal);
  return output.empty() ? 0 : finest_step(data, output);
}

/// The lowest level of the output that this signal is; 0 = no output.
double level_at(const Program& program, const DataSet& data, int signal) {
  const std::string output = output_at(program, signal);
  std::optional<double> lowest;
  for (const auto& r : data.recordings)
    if (const auto column = r.columns.find(output); column != r.columns.end() && r.role != Role::test)
      for (const double v : column->second)
        if (!std::isnan(v)) lowest = std::min(lowest.value_or(v), v);
  return lowest.value_or(0);
}

/// Noise of the output that this signal is, where it is smoothest; 0 = no output.
double roughness_at(const Program& program, const DataSet& data, int signal) {
  const std::string output = output_at(program, signal);
  double least = 0;
  for (const auto& r : data.recordings) {
    const auto column = r.columns.find(output);
    if (r.role == Role::test || column == r.columns.end() || r.last < 2) continue;
    const double noise = roughness(std::span(column->second).first(r.last));
    least = least > 0 ? std::min(least, noise) : noise;
  }
  return least;
}

/// Values that differ by more than `apart`.
int count_different(std::vector<double> values, double apart) {
  std::sort(values.begin(), values.end());
  int n = 0;
  double last = 0;
  for (const double v : values)
    if (n == 0 || v - last > apart) {
      ++n;
      last = v;
    }
  return n;
}

Swings told(const std::vector<Swing>& swings, double range) {
  if (swings.empty()) return {0, 1, 0, 1};
  std::vector<double> sizes, middles;
  double smallest = range, largest = 0, slowest = std::numeric_limits<double>::infinity(), fastest = 0;
  for (const auto& s : swings) {
    sizes.push_back(s.size);
    middles.push_back(s.middle);
    smallest = std::min(smallest, s.size);
    largest = std::max(largest, s.size);
    slowest = std::min(slowest, s.fastest);
    fastest = std::max(fastest, s.fastest);
  }
  return {count_different(sizes, 0.1 * range), largest / smallest, count_different(middles, 0.1 * range),
          slowest > 0 ? fastest / slowest : 1};
}

void look_at_row_times(const DataSet& data, Excitation& c) {
  c.shortest_step = std::numeric_limits<double>::infinity();
  c.longest_step = c.longest_recording = 0;
  for (const auto& r : data.recordings) {
    if (r.role == Role::test || r.last < 2) continue;
    const double duration = r.t[r.last - 1] - r.t.front();
    c.longest_recording = std::max(c.longest_recording, duration);
    const double step = median_step(r.t);
    c.shortest_step = std::min(c.shortest_step, step);
    c.longest_step = std::max(c.longest_step, step);
    ++c.recordings;
  }
}

/// What passes on the wires of some places while the recordings drive the diagram.
class Observer {
 public:
  Observer(const Diagram& diagram, const Registry& registry, const DataSet& data, const std::vector<Place>& places)
      : places_(places), data_(data), program_(compile(diagram, registry)) {
    find_signals(diagram, registry);
    for (const auto& r : data.recordings) {
      if (r.role == Role::test || r.last < 2) continue;
      Seen seen{&r, traces(program_, data, r, signals_)};
      for (auto& s : seen.rows) s.resize(r.last);
      recordings_.push_back(std::move(seen));
    }
  }

  std::vector<Excitation> operator()(const std::vector<std::string>& free_paths) const {
    const InSeries in_series(*program_, free_paths);
    std::vector<Excitation> result(places_.size(), common());
    for (std::size_t i = 0; i < places_.size(); ++i) {
      auto& c = result[i];
      const int signal = signals_[i];
      c.unit = program_->signals[static_cast<std::size_t>(signal)].unit;
      in_series.look(signal, c);
      c.weights = weights_behind(*program_, signal);
      c.resolution = resolution_at(*program_, data_, signal);
      if (c.resolution > 0) c.level = level_at(*program_, data_, signal);
      c.roughness = roughness_at(*program_, data_, signal);
      c.by = places_[i].by;
      c.damping = damping_behind(*program_, places_[i], c.unit);
      c.inertia = inertia_before(*program_, places_[i]);
      const std::string stiffness = places_[i].at + ".stiffness";
      const auto* spring = c.by.empty() ? nullptr : program_->find_parameter(stiffness);
      c.springless = spring != nullptr && spring->value == 0 && !spring->free &&
                     std::find(free_paths.begin(), free_paths.end(), stiffness) == free_paths.end();
      if (!c.by.empty()) c.own = numbers_of(*program_, places_[i].at);
      range_of(i, c.lowest, c.highest);
      if (travel_signal_[i] >= 0) {
        const auto travel = static_cast<std::size_t>(travel_signal_[i]);
        range_of(travel, c.travel_lowest, c.travel_highest);
      }
      look_at_moves(i, c);
      if (!places_[i].side.empty()) look_at_side(i, c);
    }
    return result;
  }

 private:
  struct Seen {
    const Recording* recording;
    std::vector<std::vector<double>> rows;  // [signal][row]
  };

  /// Wires of the places, then their side signals, what replaced blocks move, and the inputs.
  void find_signals(const Diagram& diagram, const Registry& registry) {
    for (const auto& p : places_) {
      const std::string wire = program_signal(diagram, registry, p.wire);
      const int first = program_->find_signal(wire + "[0]");  // of a vector the first element speaks for all
      signals_.push_back(first >= 0 ? first : program_->signal(wire));
    }
    const auto add = [&](int signal) {
      if (signal < 0) return -1;
      signals_.push_back(signal);
      return static_cast<int>(signals_.size()) - 1;
    };
    for (const auto& p : places_)
      side_signal_.push_back(
          add(p.side.empty() ? -1 : program_->find_signal(program_signal(diagram, registry, p.side))));
    for (const auto& p : places_) {
      int signal = -1;
      for (const auto& block : program_->blocks)
        if (!p.by.empty() && block.path == p.at) signal = block.y_begin;
      travel_signal_.push_back(add(signal));
    }
    drives_ = signals_.size();
    signals_.insert(signals_.end(), program_->input_signals.begin(), program_->input_signals.end());
  }

  /// What all places share.
  Excitation common() const {
    Excitation c;
    c.from_data = true;
    look_at_row_times(data_, c);
    c.drive_cycles = drive_cycles();
    for (const int b : program_->memory_blocks) {
      const auto& block = program_->blocks[static_cast<std::size_t>(b)];
      if (!block.kernel->declaration.memory_port.empty()) c.memory_blocks.push_back(block.path);
    }
    for (const auto& name : program_->output_names)
      if (const auto note = data_.notes.find(name); note != data_.notes.end() && note->second.zero_per_recording)
        c.offset_is_free = c.zero_of_recording = true;
    look_at_holds(c);
    return c;
  }

  /// Of each recording, empty where the inputs of one move otherwise.
  std::vector<double> drive_cycles() const {
    std::vector<double> list;
    for (const auto& seen : recordings_)
      for (std::size_t s = drives_; s < signals_.size(); ++s) {
        const auto [low, high] = std::minmax_element(seen.rows[s].begin(), seen.rows[s].end());
        if (!(*high > *low)) continue;
        list.push_back(cycle_frequency(std::span(seen.recording->t).first(seen.recording->last), seen.rows[s]));
        if (!(list.back() > 0)) return {};
      }
    return list;
  }

  void range_of(std::size_t signal, double& low, double& high) const {
    low = std::numeric_limits<double>::infinity();
    high = -low;
    for (const auto& seen : recordings_) widen(seen.rows[signal], low, high);
  }

  static void widen(const std::vector<double>& rows, double& low, double& high) {
    const auto [a, b] = std::minmax_element(rows.begin(), rows.end());
    low = std::min(low, *a);
    high = std::max(high, *b);
  }

  /// [1/s] over the range.
  static double quickest(const Seen& seen, std::size_t place, double range) {
    const auto& v = seen.rows[place];
    const auto& t = seen.recording->t;
    double most = 0;
    for (std::size_t k = 1; k < v.size(); ++k)
      if (range > 0 && t[k] > t[k - 1]) most = std::max(most, std::abs(v[k] - v[k - 1]) / (t[k] - t[k - 1]) / range);
    return most;
  }

  void look_at_moves(std::size_t place, Excitation& c) const {
    std::vector<Swing> swings;
    for (const auto& seen : recordings_) {
      const auto& v = seen.rows[place];
      const auto here = swings_of(seen.recording->t, v, 0.05 * c.range());
      swings.insert(swings.end(), here.begin(), here.end());
      if (c.range() > 0) c.reversals += static_cast<int>(turning_points(v, 0.02 * c.range()).size());
      c.starts_away_from_zero = c.starts_away_from_zero || std::abs(v.front()) > 0.02 * c.range();
      for (std::size_t k = 1; k < v.size(); ++k) c.largest_jump = std::max(c.largest_jump, std::abs(v[k] - v[k - 1]));
      c.quickest = std::max(c.quickest, quickest(seen, place, c.range()));
    }
    if (c.range() > 0) c.swings = told(swings, c.range());
  }

  /// A side signal is a wire of the diagram, or a column that the diagram does not read yet.
  std::span<const double> side_of(const Seen& seen, std::size_t place) const {
    if (side_signal_[place] >= 0) return seen.rows[static_cast<std::size_t>(side_signal_[place])];
    const auto found = seen.recording->columns.find(places_[place].side);
    if (found == seen.recording->columns.end()) return {};
    return std::span(found->second).first(seen.recording->last);
  }

  void look_at_side(std::size_t place, Excitation& c) const {
    c.side_unit = places_[place].side_unit;
    if (const int row = side_signal_[place]; row >= 0)
      c.side_unit = program_->signals[static_cast<std::size_t>(signals_[static_cast<std::size_t>(row)])].unit;
    std::vector<double> side, wire, first;
    for (const auto& seen : recordings_) {
      const auto column = side_of(seen, place);
      if (column.empty()) continue;
      side.insert(side.end(), column.begin(), column.end());
      wire.insert(wire.end(), seen.rows[place].begin(), seen.rows[place].end());
      first.push_back(column.front());
    }
    if (side.empty()) return;
    const auto [low, high] = std::minmax_element(side.begin(), side.end());
    c.side_lowest = *low;
    c.side_highest = *high;
    c.side_at_start = median(first);
    c.side_correlation = correlation(side, wire);
  }

  /// Holds are those of the drive: the signal behind a slow plant never stands still.
  void look_at_holds(Excitation& c) const {
    for (std::size_t s = drives_; s < signals_.size(); ++s) {
      double low = 0, high = 0;
      range_of(s, low, high);
      for (const auto& seen : recordings_) {
        if (high <= low) break;
        const std::span t = std::span(seen.recording->t).first(seen.recording->last);
        const double hold = longest_hold(t, seen.rows[s], high - low).length;
        const double step = median_step(seen.recording->t);
        // The longest one that shows two decades of time; where none does, the one that shows most.
        const bool shows = hold >= 100 * step;
        const bool shown = c.longest_hold >= 100 * c.step_at_longest_hold;
        if (shows != shown ? shows
            : shows        ? hold > c.longest_hold
                           : hold / step > c.longest_hold / c.step_at_longest_hold) {
          c.longest_hold = hold;
          c.step_at_longest_hold = step;
        }
      }
    }
  }

  const std::vector<Place>& places_;
  const DataSet& data_;
  ProgramPointer program_;
  std::vector<int> signals_;
  std::vector<int> side_signal_, travel_signal_;  // per place: a row among `signals_`, -1 = none
  std::size_t drives_ = 0;                        // first of the inputs among `signals_`
  std::vector<Seen> recordings_;                  // but those kept for the end
};

}  // namespace

std::optional<double> damping_behind(const Program& program, const Place& place, const Unit& of_wire) {
  const auto is = [&](const char* unit) {
    return dimension_factor(of_wire.dimension, parse_unit(unit).dimension) != 0;
  };
  if (place.kind != "damping" || !(is("m/s") || is("rad/s"))) return {};  // kg/s makes a mass flow of a plain number
  const auto* gain = program.find_parameter(place.reading + ".gain");
  return gain == nullptr ? std::nullopt : std::optional(gain->value);
}

std::optional<double> inertia_before(const Program& program, const Place& place) {
  const int wire = place.is_other ? program.find_signal(place.wire) : -1;
  if (wire < 0) return {};
  const BlockInstance& source = program.blocks[at(program.signals[at(wire)].block)];
  const auto* gain = program.find_parameter(source.path + ".gain");
  if (gain == nullptr || gain->value == 0 || source.source.size() != 1) return {};
  const Dimension of_input = program.signals[at(source.source.front())].unit.dimension;
  const bool drives = of_input == parse_unit("N").dimension || of_input == parse_unit("N m").dimension;
  return drives ? std::optional(1 / std::abs(gain->value)) : std::nullopt;
}

std::vector<Excitation> circumstances_at(const Diagram& diagram, const Registry& registry, const DataSet& data,
                                         const std::vector<Place>& places, const std::vector<std::string>& free_paths) {
  return Observer(diagram, registry, data, places)(free_paths);
}

Excitation circumstances_at(const Diagram& diagram, const Registry& registry, const DataSet& data, const Place& place,
                            const std::vector<std::string>& free_paths) {
  return circumstances_at(diagram, registry, data, std::vector<Place>{place}, free_paths).front();
}

}  // namespace hysteron
