#include "fit/compare/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/signals/unit_words.h"

namespace hysteron {
namespace {

/// Sums of several recordings; a zero per recording takes each recording's own mean out of the measured deviation.
struct Pool {
  std::size_t rows = 0;
  double squared = 0, peak = 0;
  double sum = 0, sum_squares = 0, shift = 0, within = 0;

  void add(const Rows& measured, const Rows& residual) {
    if (rows == 0 && !measured.empty()) shift = measured.front();  // keeps the sums of squares well conditioned
    double mean = 0;
    for (const double y : measured) mean += y;
    mean /= std::max<double>(1, static_cast<double>(measured.size()));
    for (std::size_t i = 0; i < residual.size(); ++i) {
      squared += residual[i] * residual[i];
      peak = std::max(peak, std::abs(residual[i]));
      sum += measured[i] - shift;
      sum_squares += (measured[i] - shift) * (measured[i] - shift);
      within += (measured[i] - mean) * (measured[i] - mean);
    }
    rows += residual.size();
  }

  Metrics metrics(bool own_means) const {
    Metrics m;
    m.rows = rows;
    if (rows == 0) return m;
    const auto n = static_cast<double>(rows);
    m.rms = std::sqrt(squared / n);
    m.peak = peak;
    m.deviation = std::sqrt(std::max(0.0, own_means ? within / n : sum_squares / n - (sum / n) * (sum / n)));
    m.nrmse = m.deviation > 0 ? m.rms / m.deviation : (m.rms > 0 ? std::numeric_limits<double>::infinity() : 0);
    m.fit = 100 * (1 - m.nrmse);
    return m;
  }
};

std::string headline(const DataModel& model, const Comparison& c, int output) {
  const Unit& unit = model.output_unit(output);
  const auto& name = model.outputs()[static_cast<std::size_t>(output)];
  std::vector<std::string> parts;
  for (const Role role : {Role::train, Role::validate, Role::test})
    if (const Metrics* m = c.find(role, output); m != nullptr && m->rows > 0)
      parts.push_back(fmt::format("{} rms = {:.3g} % NRMSE (fit {:.1f} %) on {}", size_text(m->rms, unit),
                                  100 * m->nrmse, m->fit, to_text(role)));
  return fmt::format("{}: {}", name, fmt::join(parts, ", "));
}

/// Inputs beside the main one, and columns that are bound to nothing, where all these recordings have them.
std::vector<SplitSignal> signals_besides(const DataModel& model, const std::vector<int>& recordings) {
  std::vector<SplitSignal> list;
  const auto& names = model.program().input_names;
  for (int k = 0; k < static_cast<int>(names.size()); ++k) {
    if (k == model.main_input()) continue;
    SplitSignal signal{
        names[static_cast<std::size_t>(k)], model.program().input_units[static_cast<std::size_t>(k)], {}};
    for (const int r : recordings) signal.rows.push_back(model.input(r, k));
    list.push_back(std::move(signal));
  }
  if (recordings.empty()) return list;
  for (const auto& [name, values] : model.recording(recordings.front()).columns) {
    const auto& outputs = model.program().output_names;
    const bool bound = std::find(names.begin(), names.end(), name) != names.end() ||
                       std::find(outputs.begin(), outputs.end(), name) != outputs.end();
    if (bound || name == column_of_cycles || name == column_of_start) continue;  // use: one value in each recording
    SplitSignal signal{name, {}, {}};
    for (const int r : recordings) {
      const Recording& recording = model.recording(r);
      const auto column = recording.columns.find(name);
      if (column == recording.columns.end()) break;
      if (const auto unit = recording.units.find(name); unit != recording.units.end()) signal.unit = unit->second;
      signal.rows.push_back(recording.judged(column->second));
    }
    if (signal.rows.size() == recordings.size()) list.push_back(std::move(signal));
  }
  if (list.empty()) return list;
  std::vector<Rows> main;
  if (model.main_input() >= 0)
    for (const int r : recordings) main.push_back(model.input(r, model.main_input()));
  return telling_signals(std::move(list), main);
}

}  // namespace

std::vector<std::string> telling_sentences(const std::vector<Split>& splits) {
  constexpr double spread = 0.02;  // information below which the error is spread as the rows are
  std::vector<std::string> list;
  for (const auto& split : splits)
    if (list.size() < 3 && split.tells && split.information > spread &&
        std::find(list.begin(), list.end(), split.sentence) == list.end())
      list.push_back(split.sentence);
  return list;
}

Metrics metrics_of(const Rows& measured, const Rows& residual) {
  Pool pool;
  pool.add(measured, residual);
  return pool.metrics(true);
}

const Metrics* Comparison::find(int recording, int output) const {
  for (const auto& m : metrics)
    if (m.recording == recording && m.output == output && recording >= 0) return &m.metrics;
  return nullptr;
}

const Metrics* Comparison::find(Role role, int output) const {
  for (const auto& m : metrics)
    if (m.recording < 0 && !m.all_roles && m.role == role && m.output == output) return &m.metrics;
  return nullptr;
}

Comparison compare(const DataModel& model, const Judge& judge, Prediction prediction, std::vector<int> recordings) {
  if (recordings.empty())
    for (int r = 0; r < model.n_recordings(); ++r)
      if (!prediction.y[static_cast<std::size_t>(r)].empty()) recordings.push_back(r);
  Comparison c;
  c.zeros = add_zeros(model, judge, prediction);
  c.residual.resize(prediction.y.size());
  const int n_outputs = static_cast<int>(model.outputs().size());
  for (const int r : recordings)
    for (int o = 0; o < n_outputs; ++o)
      c.residual[static_cast<std::size_t>(r)].push_back(residual_rows(model, prediction, r, o));

  const int input = model.main_input();
  for (int o = 0; o < n_outputs; ++o) {
    const bool own = model.zero_per_recording(o);
    Pool all;
    for (const Role role : {Role::train, Role::validate, Role::test}) {
      Pool pool;
      for (const int r : recordings) {
        const Rows& residual = c.residual[static_cast<std::size_t>(r)][static_cast<std::size_t>(o)];
        if (model.recording(r).role != role || residual.empty()) continue;
        c.metrics.push_back({r, false, role, o, metrics_of(model.measured(r, o), residual)});
        pool.add(model.measured(r, o), residual);
        all.add(model.measured(r, o), residual);
      }
      if (pool.rows > 0) c.metrics.push_back({-1, false, role, o, pool.metrics(own)});
    }
    c.metrics.push_back({-1, true, Role::train, o, all.metrics(own)});

    std::vector<RowsPointer> inputs(recordings.size());
    std::vector<SplitInput> parts;
    std::vector<int> split;
    for (std::size_t k = 0; k < recordings.size(); ++k) {
      const int r = recordings[k];
      const Rows& residual = c.residual[static_cast<std::size_t>(r)][static_cast<std::size_t>(o)];
      if (residual.empty()) continue;
      if (input >= 0) inputs[k] = model.shared_input(r, input);
      parts.push_back({&model.times(r), inputs[k].get(), &residual, model.recording(r).name});
      split.push_back(r);
    }
    const auto besides = signals_besides(model, split);
    OutputSplits splits;
    splits.output = o;
    splits.splits = input >= 0 ? splits_of(parts, model.program().input_names[static_cast<std::size_t>(input)],
                                           model.program().input_units[static_cast<std::size_t>(input)], besides)
                               : splits_of(parts, "", Unit{}, besides);
    if (all.rows > 0) c.sentences.push_back(headline(model, c, o));
    for (auto& sentence : telling_sentences(splits.splits)) c.sentences.push_back(std::move(sentence));
    c.splits.push_back(std::move(splits));
  }
  c.predicted = std::move(prediction.y);
  return c;
}

}  // namespace hysteron
