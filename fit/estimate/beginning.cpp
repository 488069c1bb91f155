#include "fit/estimate/beginning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "engine/diagram/time_text.h"
#include "fit/numerics/dense.h"
#include "fit/numerics/linear.h"
#include "fit/signals/unit_words.h"

namespace hysteron {
namespace {

constexpr std::size_t most_rows = 20'000;
constexpr double decayed = 0.01;
constexpr double deviations = 6, times_elsewhere = 4;
constexpr double undetermined = 1e-6;
constexpr double most_motion = 2;         // of the drive at the start, over that in the liveliest window later on
constexpr std::size_t least_windows = 3;  // behind the first: with fewer, nothing is known of elsewhere

/// The first rows of one recording alone, with its start free.
DataSet first_rows(const DataSet& data, int r) {
  const Recording& from = data.recordings[static_cast<std::size_t>(r)];
  DataSet one;
  one.notes = data.notes;
  Recording& to = one.recordings.emplace_back();
  to.name = from.name;
  to.units = from.units;
  const std::size_t rows = std::min(from.t.size(), most_rows);
  const auto beginning = [&](const std::vector<double>& all) {
    return std::vector<double>(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(rows));
  };
  to.t = beginning(from.t);
  for (const auto& [name, column] : from.columns) to.columns[name] = beginning(column);
  to.last = std::min(from.last, rows);
  to.at_rest = false;
  to.initial_per_recording = true;
  return one;
}

/// Answers of the outputs to the states, over the noise: [state][output][row].
using Answers = std::vector<std::vector<Rows>>;

Answers answers_of(const DataModel& model, const NoiseModel& noise, std::span<const ParameterValue> values, int r) {
  Trial here;
  for (auto v : values) {
    if (v.recording >= 0 && v.recording != r) continue;
    v.recording = -1;
    here.push_back(v);
  }
  DataModel short_one(model.program_pointer(), std::make_shared<const DataSet>(first_rows(model.data(), r)));
  std::vector<double> white;
  for (const auto& name : short_one.outputs())
    for (std::size_t o = 0; o < model.outputs().size(); ++o)
      if (model.outputs()[o] == name) white.push_back(noise.outputs[o].white);
  short_one.choose_substeps(here, white);
  const int only = 0;
  Prediction p = short_one.predict(here, std::span<const int>(&only, 1), true);
  if (!p.ok || p.initial.front().empty()) return {};
  Answers answers;
  for (auto& of_state : p.initial.front()) {
    std::vector<Rows> all(model.outputs().size());
    for (std::size_t i = 0; i < of_state.size(); ++i) {
      const auto& names = model.outputs();
      const auto o =
          static_cast<std::size_t>(std::find(names.begin(), names.end(), short_one.outputs()[i]) - names.begin());
      all[o] = std::move(of_state[i]);
      for (double& y : all[o]) y /= noise.outputs[o].white;
    }
    answers.push_back(std::move(all));
  }
  return answers;
}

double at(const Answers& answers, std::size_t state, std::size_t output, std::size_t row) {
  const Rows& rows = answers[state][output];
  return row < rows.size() ? rows[row] : 0.0;
}

/// Rows until every answer has decayed to a hundredth of its largest value; 0: none moves anything.
std::size_t rows_until_decayed(const Answers& answers) {
  std::size_t rows = 0;
  for (const auto& of_state : answers) {
    double most = 0;
    for (const auto& y : of_state)
      for (const double v : y) most = std::max(most, std::abs(v));
    for (const auto& y : of_state)
      for (std::size_t i = y.size(); i-- > rows;)
        if (std::abs(y[i]) > decayed * most) {
          rows = i + 1;
          break;
        }
  }
  return rows;
}

/// What is left over the noise in each output of one recording.
std::vector<Rows> left_of(const DataModel& model, const NoiseModel& noise, const Prediction& prediction, int r) {
  std::vector<Rows> left;
  for (int o = 0; o < static_cast<int>(model.outputs().size()); ++o) {
    left.push_back(residual_rows(model, prediction, r, o));
    double mean = 0;  // a zero that is found in each recording is none of the start
    if (model.zero_per_recording(o))
      for (const double v : left.back()) mean += v / static_cast<double>(left.back().size());
    for (double& v : left.back()) v = (v - mean) / noise.outputs[static_cast<std::size_t>(o)].white;
  }
  return left;
}

/// The answers laid over the residual from `first` on.
struct Window {
  double fall = 0;
  int rank = 0;
  std::vector<double> amounts;  ///< of each answer
};

Window laid_over(const Answers& answers, const std::vector<Rows>& left, std::size_t first, std::size_t rows) {
  NormalForm normal(static_cast<int>(answers.size()));
  for (std::size_t o = 0; o < left.size(); ++o) {
    const std::size_t n = first < left[o].size() ? std::min(rows, left[o].size() - first) : 0;
    Dense columns(n, answers.size());
    for (std::size_t k = 0; k < answers.size(); ++k)
      for (std::size_t i = 0; i < n; ++i) columns(i, k) = at(answers, k, o, i);
    normal.add(columns.a, std::span(left[o]).subspan(n == 0 ? 0 : first, n));
  }
  Dense triangle(answers.size(), answers.size());
  triangle.a = normal.r;
  for (std::size_t k = 0; k < answers.size(); ++k) {  // states have units of their own
    const double l = length(triangle.col(k), answers.size());
    for (std::size_t i = 0; i < answers.size() && l > 0; ++i) triangle(i, k) /= l;
  }
  Window window;
  const auto best = minimum_norm(triangle, normal.d, undetermined);
  window.rank = best.rank;
  window.amounts = best.x;
  double still = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    double reached = 0;
    for (std::size_t k = 0; k < answers.size(); ++k) reached += triangle(i, k) * best.x[k];
    window.fall += normal.d[i] * normal.d[i];
    still += (normal.d[i] - reached) * (normal.d[i] - reached);
  }
  window.fall -= still;
  for (std::size_t k = 0; k < answers.size(); ++k) {
    const double l = length(normal.r.data() + k * answers.size(), answers.size());
    window.amounts[k] = l > 0 ? window.amounts[k] / l : 0;
  }
  return window;
}

/// One input of a recording and its whole range.
struct Drive {
  Rows rows;
  double range = 0;
};

/// The inputs that move at all.
std::vector<Drive> drives_of(const DataModel& model, int r) {
  std::vector<Drive> drives;
  for (int i = 0; i < static_cast<int>(model.program().input_names.size()); ++i) {
    Rows rows = model.input(r, i);
    if (rows.empty()) continue;
    const auto [low, high] = std::minmax_element(rows.begin(), rows.end());
    if (const double range = *high - *low; range > 0) drives.push_back({std::move(rows), range});
  }
  return drives;
}

/// How far the inputs move within `rows` rows from `first` on, each as a share of its whole range.
double motion(const std::vector<Drive>& drives, std::size_t first, std::size_t rows) {
  double sum = 0;
  for (const auto& [u, range] : drives) {
    if (first >= u.size()) continue;
    const auto part = std::span(u).subspan(first, std::min(rows, u.size() - first));
    const auto [least, most] = std::minmax_element(part.begin(), part.end());
    sum += (*most - *least) / range;
  }
  return sum;
}

/// The output that the start moves most over its noise, and by how much.
void tell_size(const DataModel& model, const NoiseModel& noise, const Answers& answers, const Window& start,
               std::size_t rows, Beginning& b) {
  double most = -1;
  for (std::size_t o = 0; o < model.outputs().size(); ++o) {
    double squares = 0;
    for (std::size_t i = 0; i < rows; ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < answers.size(); ++k) sum += start.amounts[k] * at(answers, k, o, i);
      squares += sum * sum;
    }
    if (squares <= most) continue;
    most = squares;
    b.output = static_cast<int>(o);
    b.rms = std::sqrt(squares / static_cast<double>(rows)) * noise.outputs[o].white;
  }
}

}  // namespace

std::vector<Beginning> begin_elsewhere(const DataModel& model, const NoiseModel& noise, const Prediction& prediction,
                                       std::span<const ParameterValue> values, std::span<const int> recordings) {
  std::vector<Beginning> told;
  for (const int r : recordings) {
    const auto k = static_cast<std::size_t>(r);
    const Recording& recording = model.recording(r);
    if (!recording.at_rest || recording.first > 0 || k >= prediction.y.size() || prediction.y[k].empty()) continue;
    Answers answers;
    try {
      answers = answers_of(model, noise, values, r);
    } catch (const Error&) {  // it cannot be started anywhere else
    }
    const std::size_t rows = rows_until_decayed(answers);
    const auto left = left_of(model, noise, prediction, r);
    std::size_t all = 0;
    for (const auto& y : left) all = std::max(all, y.size());
    if (rows == 0 || all < rows * (least_windows + 1)) continue;
    const auto drives = drives_of(model, r);
    const Window start = laid_over(answers, left, 0, rows);
    Beginning b{r, start.fall, 0, start.rank};
    double moved_elsewhere = 0;
    for (std::size_t first = rows; first + rows <= all; first += rows) {
      look_up();
      b.elsewhere = std::max(b.elsewhere, laid_over(answers, left, first, rows).fall);
      moved_elsewhere = std::max(moved_elsewhere, motion(drives, first, rows));
    }
    // Where the drive moves at the start and hardly anywhere else, a wrong answer to that looks the same.
    if (motion(drives, 0, rows) > most_motion * moved_elsewhere) continue;
    const double chance = b.states + deviations * std::sqrt(2.0 * b.states);
    if (!(b.fall > chance) || !(b.fall > times_elsewhere * b.elsewhere)) continue;
    const auto& t = model.times(r);
    b.lasts = t[std::min(rows, t.size()) - 1] - t.front();
    tell_size(model, noise, answers, start, rows, b);
    told.push_back(b);
  }
  return told;
}

std::string to_text(const DataModel& model, const Beginning& b) {
  return fmt::format(
      "{} does not begin at rest, as the simulation does: the residual of {} in its first {} is a free response of the model from other initial states, {} rms, which explains {:.0f} of chi2 there (in no other window of that length more than {:.0f}). Write \"initial\": \"per_recording\" at this recording in the data set, or \"skip\" its first {}",
      model.recording(b.recording).name, model.outputs()[static_cast<std::size_t>(b.output)], time_text(b.lasts),
      size_text(b.rms, model.output_unit(b.output)), b.fall, b.elsewhere, time_text(b.lasts));
}

}  // namespace hysteron
