// Decides what the recordings show at a place: range, reversals, holds, pace of the signal on the wire.
#include "discover/circumstances.h"

#include <algorithm>
#include <cmath>

#include "discover/rows.h"
#include "discover/wiring.h"
#include "engine/program.h"
#include "fit/branches.h"
#include "fit/excitation.h"
#include "fit/free_parameter.h"
#include "fit/median.h"
#include "fit/noise.h"

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

  void look(int signal, Circumstances& c) const {
    for (int s = signal, depth = 0; s >= 0 && depth < 64; ++depth) s = behind(s, c);
    for (int s = signal, depth = 0; s >= 0 && depth < 64; ++depth) s = before(s, c);
  }

 private:
  const BlockInstance& block_of(int signal) const {
    return program_.blocks[static_cast<std::size_t>(program_.signals[static_cast<std::size_t>(signal)].block)];
  }
  bool is_free(const ParameterInfo& p) const { return std::find(free_.begin(), free_.end(), &p) != free_.end(); }

  void note(int block, Circumstances& c, bool behind_place) const {
    const bool constant = program_.blocks[static_cast<std::size_t>(block)].n_u == 0;
    if (program_.blocks[static_cast<std::size_t>(block)].kernel->uses_time) return;  // a line of the mains is no zero
    for (const auto& p : program_.parameters) {
      if (!p.linear || p.block != block) continue;
      if (!p.offset && !constant) {
        c.gain_is_free = c.gain_is_free || is_free(p);
      } else {
        c.offset_is_free = c.offset_is_free || is_free(p);
        if (behind_place) c.zeros.push_back(p.path);
      }
    }
  }
  int behind(int signal, Circumstances& c) const {
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
    note(reader, c, true);
    for (const int s : block.source)
      if (s != signal) note(program_.signals[static_cast<std::size_t>(s)].block, c, true);
    return block.y_begin;
  }
  int before(int signal, Circumstances& c) const {
    const auto& block = block_of(signal);
    if (block.n_u == 0 || !is_linear(block)) return -1;
    note(program_.signals[static_cast<std::size_t>(signal)].block, c, false);
    const int moving = moving_input(program_, block);
    for (const int s : block.source)
      if (s != moving) note(program_.signals[static_cast<std::size_t>(s)].block, c, false);
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

/// Step of the levels of the output that this signal is, where all train recordings have one; 0 = none.
double resolution_at(const Program& program, const DataSet& data, int signal) {
  const auto output = std::find(program.output_signals.begin(), program.output_signals.end(), signal);
  if (output == program.output_signals.end()) return 0;
  const std::string& name = program.output_names[static_cast<std::size_t>(output - program.output_signals.begin())];
  double step = 0;
  for (const auto& r : data.recordings) {
    const auto column = r.columns.find(name);
    if (r.role != Role::train || column == r.columns.end()) continue;
    const double own = resolution_of(column->second);
    if (own <= 0) return 0;
    step = step > 0 ? std::min(step, own) : own;
  }
  return step;
}

void look_at_row_times(const DataSet& data, Circumstances& c) {
  c.shortest_step = std::numeric_limits<double>::infinity();
  c.longest_step = c.longest_recording = 0;
  for (const auto& r : data.recordings) {
    if (r.role == Role::test || r.last < 2) continue;
    const double duration = r.t[r.last - 1] - r.t.front();
    c.longest_recording = std::max(c.longest_recording, duration);
    if (r.role != Role::train) continue;
    const double step = median_step(r.t);
    c.shortest_step = std::min(c.shortest_step, step);
    c.longest_step = std::max(c.longest_step, step);
    ++c.recordings;
  }
}

}  // namespace

std::vector<Circumstances> circumstances_at(const Diagram& diagram, const Registry& registry, const DataSet& data,
                                            const std::vector<Place>& places,
                                            const std::vector<std::string>& free_paths) {
  const auto program = compile(diagram, registry);
  Circumstances common;
  common.from_data = true;
  look_at_row_times(data, common);
  for (const int b : program->memory_blocks) {
    const auto& block = program->blocks[static_cast<std::size_t>(b)];
    if (!block.kernel->declaration.memory_port.empty()) common.memory_blocks.push_back(block.path);
  }
  bool free_zero = false;
  for (const auto& name : program->output_names)
    if (const auto note = data.notes.find(name); note != data.notes.end() && note->second.zero_per_recording)
      free_zero = true;

  std::vector<int> signals;
  for (const auto& p : places) {
    const std::string wire = program_signal(diagram, registry, p.wire);
    const int first = program->find_signal(wire + "[0]");  // of a vector the first element speaks for all
    signals.push_back(first >= 0 ? first : program->signal(wire));
  }
  const std::size_t n = signals.size();
  std::vector<int> side_signal;  // per place: its row among `signals`, -1 = none
  for (const auto& p : places) {
    const int signal = p.side.empty() ? -1 : program->find_signal(program_signal(diagram, registry, p.side));
    side_signal.push_back(signal < 0 ? -1 : static_cast<int>(signals.size()));
    if (signal >= 0) signals.push_back(signal);
  }
  std::vector<int> travel_signal;  // per place: the row of what a replaced block moves, -1 = none
  for (const auto& p : places) {
    int signal = -1;
    for (const auto& block : program->blocks)
      if (!p.by.empty() && block.path == p.at) signal = block.y_begin;
    travel_signal.push_back(signal < 0 ? -1 : static_cast<int>(signals.size()));
    if (signal >= 0) signals.push_back(signal);
  }
  const std::size_t drives = signals.size();
  signals.insert(signals.end(), program->input_signals.begin(), program->input_signals.end());
  std::vector<std::vector<std::vector<double>>> rows;  // [train recording][signal][row]
  std::vector<const Recording*> trains;
  for (const auto& r : data.recordings) {
    if (r.role != Role::train || r.last < 2) continue;
    trains.push_back(&r);
    rows.push_back(traces(program, data, r, signals));
    for (auto& s : rows.back()) s.resize(r.last);
  }

  // A side signal is a wire of the diagram, or a column that the diagram does not read yet.
  const auto side_rows = [&](std::size_t r, std::size_t i) -> const std::vector<double>* {
    if (side_signal[i] >= 0) return &rows[r][static_cast<std::size_t>(side_signal[i])];
    const auto found = trains[r]->columns.find(places[i].side);
    return found == trains[r]->columns.end() ? nullptr : &found->second;
  };
  const InSeries in_series(*program, free_paths);
  std::vector<Circumstances> result(n, common);
  const auto span = [&](std::size_t s, double& low, double& high) {
    low = std::numeric_limits<double>::infinity();
    high = -low;
    for (const auto& r : rows) {
      const auto [a, b] = std::minmax_element(r[s].begin(), r[s].end());
      low = std::min(low, *a);
      high = std::max(high, *b);
    }
  };
  for (std::size_t i = 0; i < n; ++i) {
    auto& c = result[i];
    c.unit = program->signals[static_cast<std::size_t>(signals[i])].unit;
    c.offset_is_free = free_zero;
    in_series.look(signals[i], c);
    c.weights = weights_behind(*program, signals[i]);
    span(i, c.lowest, c.highest);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const auto& v = rows[r][i];
      const auto& t = trains[r]->t;
      if (c.range() > 0) c.reversals += static_cast<int>(turning_points(v, 0.02 * c.range()).size());
      c.starts_away_from_zero = c.starts_away_from_zero || std::abs(v.front()) > 0.02 * c.range();
      for (std::size_t k = 1; k < v.size(); ++k) {
        c.largest_jump = std::max(c.largest_jump, std::abs(v[k] - v[k - 1]));
        if (c.range() > 0 && t[k] > t[k - 1])
          c.quickest = std::max(c.quickest, std::abs(v[k] - v[k - 1]) / (t[k] - t[k - 1]) / c.range());
      }
    }
    c.resolution = resolution_at(*program, data, signals[i]);
    c.by = places[i].by;
    if (travel_signal[i] >= 0) span(static_cast<std::size_t>(travel_signal[i]), c.travel_lowest, c.travel_highest);
    if (!places[i].side.empty()) {
      c.side_unit = places[i].side_unit;
      if (side_signal[i] >= 0)
        c.side_unit =
            program->signals[static_cast<std::size_t>(signals[static_cast<std::size_t>(side_signal[i])])].unit;
      std::vector<double> side, wire, first;
      for (std::size_t r = 0; r < rows.size(); ++r)
        if (const auto* column = side_rows(r, i)) {
          side.insert(side.end(), column->begin(), column->begin() + static_cast<std::ptrdiff_t>(trains[r]->last));
          wire.insert(wire.end(), rows[r][i].begin(), rows[r][i].end());
          first.push_back(column->front());
        }
      if (!side.empty()) {
        const auto [low, high] = std::minmax_element(side.begin(), side.end());
        c.side_lowest = *low;
        c.side_highest = *high;
        c.side_at_start = median(first);
        c.side_correlation = correlation(side, wire);
      }
    }
    // Holds are those of the drive: the signal behind a slow plant never stands still.
    for (std::size_t s = drives; s < signals.size(); ++s) {
      double low = 0;
      double high = 0;
      span(s, low, high);
      for (std::size_t r = 0; r < rows.size() && high > low; ++r) {
        const std::vector<double> t(trains[r]->t.begin(),
                                    trains[r]->t.begin() + static_cast<std::ptrdiff_t>(trains[r]->last));
        const double hold = longest_hold(t, rows[r][s], high - low).length;
        const double step = median_step(t);
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
  return result;
}

Circumstances circumstances_at(const Diagram& diagram, const Registry& registry, const DataSet& data,
                               const Place& place, const std::vector<std::string>& free_paths) {
  return circumstances_at(diagram, registry, data, std::vector<Place>{place}, free_paths).front();
}

}  // namespace hysteron
