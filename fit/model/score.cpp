#include "fit/model/score.h"

#include <cmath>

#include "fit/numerics/dense.h"

namespace hysteron {
namespace {

constexpr double dependent = 1e-10;  // initial states of which the outputs show only a combination

/// Whitened responses to the initial states that are free in this recording, one column each.
Dense initial_columns(const Judge& judge, const Prediction& prediction, int recording) {
  const auto& initial = prediction.initial[static_cast<std::size_t>(recording)];
  Dense columns(judge.size(recording), initial.size());
  for (std::size_t k = 0; k < initial.size(); ++k) judge.whiten(recording, initial[k], columns.col(k));
  return columns;
}

std::vector<Rows> differences(const DataModel& model, const Prediction& prediction, int recording) {
  std::vector<Rows> rows;
  for (int o = 0; o < static_cast<int>(model.outputs().size()); ++o)
    rows.push_back(residual_rows(model, prediction, recording, o));
  return rows;
}

/// How known lines wander in this recording, as they do beside what is predicted.
void add_wandering(const DataModel& model, const NoiseModel& noise, int recording, std::vector<Rows>& y) {
  Rows rows;
  for (std::size_t o = 0; o < y.size(); ++o) {
    const LeftOut& line = noise.outputs[o].left_out;
    const Rows& measured = model.measured(recording, static_cast<int>(o));
    if (!line.any() || measured.empty()) continue;
    rows.resize(measured.size());
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = measured[i] - y[o][i];
    line.take_out(static_cast<std::size_t>(recording), rows);
    for (std::size_t i = 0; i < rows.size(); ++i) y[o][i] = measured[i] - rows[i];
  }
}

/// One rms for each row.
Rows of_rows(const std::vector<double>& pieces, std::size_t rows) {
  Rows rms(rows);
  for (std::size_t i = 0; i < rows; ++i) rms[i] = pieces[i * pieces.size() / rows];
  return rms;
}

}  // namespace

double Score::chi2() const {
  double sum = 0;
  for (const auto& r : recordings) sum += r.chi2;
  return sum;
}
double Score::n() const {
  double sum = 0;
  for (const auto& r : recordings) sum += r.n;
  return sum;
}
double Score::chi2(Role role) const {
  double sum = 0;
  for (const auto& r : recordings) sum += r.role == role ? r.chi2 : 0;
  return sum;
}
double Score::n(Role role) const {
  double sum = 0;
  for (const auto& r : recordings) sum += r.role == role ? r.n : 0;
  return sum;
}
const RecordingScore* Score::find(int recording) const {
  for (const auto& r : recordings)
    if (r.recording == recording) return &r;
  return nullptr;
}

Judge::Judge(const DataModel& model, const NoiseModel& noise, Whitener::Order order) : noise_(noise) {
  for (int r = 0; r < model.n_recordings(); ++r) {
    std::vector<Whitener> list;
    for (int o = 0; o < static_cast<int>(model.outputs().size()); ++o) {
      const auto& n = noise.outputs[static_cast<std::size_t>(o)];
      const std::size_t rows = model.measured(r, o).size();
      if (!n.pieces.empty() && !n.pieces[static_cast<std::size_t>(r)].empty())
        list.emplace_back(of_rows(n.pieces[static_cast<std::size_t>(r)], rows), model.zero_per_recording(o));
      else
        list.emplace_back(rows, n.white, n.one_over_f, model.zero_per_recording(o), order);
    }
    whiteners_.push_back(std::move(list));
    root_weight_.push_back(std::sqrt(model.recording(r).weight));
  }
}

std::size_t Judge::size(int recording) const {
  std::size_t n = 0;
  for (const auto& w : whiteners_[static_cast<std::size_t>(recording)]) n += w.size();
  return n;
}

void Judge::whiten(int recording, const std::vector<Rows>& rows, double* out) const {
  const auto& list = whiteners_[static_cast<std::size_t>(recording)];
  const double weight = root_weight_[static_cast<std::size_t>(recording)];
  for (std::size_t o = 0; o < list.size(); ++o) {
    const std::size_t n = list[o].size();
    if (const LeftOut& left_out = noise_.outputs[o].left_out; left_out.any()) {
      Rows cleared = rows[o];
      left_out.take_out(static_cast<std::size_t>(recording), cleared);
      list[o].apply(cleared, out);
    } else {
      list[o].apply(rows[o], out);
    }
    for (std::size_t i = 0; i < n && weight != 1; ++i) out[i] *= weight;
    out += n;
  }
}

double Judge::zero_of(int recording, int output, const Rows& rows) const {
  return whiteners_[static_cast<std::size_t>(recording)][static_cast<std::size_t>(output)].zero_of(rows);
}

std::vector<double> Judge::residual(const DataModel& model, const Prediction& prediction, int recording) const {
  std::vector<double> w(size(recording));
  whiten(recording, differences(model, prediction, recording), w.data());
  if (!prediction.initial[static_cast<std::size_t>(recording)].empty())
    clear_of(held_basis(initial_columns(*this, prediction, recording), prediction.initial_sigma, dependent), w.data());
  return w;
}

Score Judge::score(const DataModel& model, const Prediction& prediction, std::span<const int> recordings) const {
  Score score;
  score.ok = prediction.ok;
  score.error = prediction.error;
  if (!score.ok) return score;
  Prediction with_zeros = prediction;
  const auto zeros = add_zeros(model, *this, with_zeros);
  for (const int r : recordings) {
    const auto k = static_cast<std::size_t>(r);
    RecordingScore s;
    s.recording = r;
    s.role = model.recording(r).role;
    const double weight = root_weight_[k] * root_weight_[k];
    for (const double w : residual(model, prediction, r)) s.chi2 += w * w;
    s.n = weight * (static_cast<double>(size(r)) - static_cast<double>(prediction.initial[k].size()));
    for (int o = 0; o < static_cast<int>(model.outputs().size()); ++o)
      s.rms.push_back(rms(model, with_zeros, std::span<const int>(&r, 1), o));
    s.zero = zeros[k];
    score.recordings.push_back(std::move(s));
  }
  return score;
}

namespace {

/// Of each free initial state how much of its response lies in what this recording leaves.
std::vector<double> amounts_of_initial(const DataModel& model, const Judge& judge, const Prediction& prediction,
                                       int recording) {
  std::vector<double> w(judge.size(recording));
  judge.whiten(recording, differences(model, prediction, recording), w.data());
  return held_solution(initial_columns(judge, prediction, recording), prediction.initial_sigma, w, dependent);
}

}  // namespace

std::vector<std::vector<double>> starts_of(const DataModel& model, const Judge& judge, const Prediction& prediction) {
  std::vector<std::vector<double>> starts(prediction.y.size());
  for (std::size_t r = 0; r < prediction.y.size(); ++r) {
    if (prediction.y[r].empty() || prediction.initial[r].empty()) continue;
    const int recording = static_cast<int>(r);
    starts[r] = amounts_of_initial(model, judge, prediction, recording);
    const auto& begun = model.start_of(recording);
    for (std::size_t k = 0; k < begun.size(); ++k) starts[r][k] += begun[k];
  }
  return starts;
}

std::vector<std::vector<double>> add_zeros(const DataModel& model, const Judge& judge, Prediction& prediction) {
  std::vector<std::vector<double>> zeros(prediction.y.size(), std::vector<double>(model.outputs().size(), 0.0));
  for (std::size_t r = 0; r < prediction.y.size(); ++r) {
    auto& y = prediction.y[r];
    if (y.empty()) continue;
    const int recording = static_cast<int>(r);
    if (const auto& initial = prediction.initial[r]; !initial.empty()) {
      const auto start = amounts_of_initial(model, judge, prediction, recording);
      for (std::size_t k = 0; k < initial.size(); ++k)
        for (std::size_t o = 0; o < y.size(); ++o)
          for (std::size_t i = 0; i < y[o].size(); ++i) y[o][i] += start[k] * initial[k][o][i];
    }
    for (std::size_t o = 0; o < y.size(); ++o) {
      if (!model.zero_per_recording(static_cast<int>(o))) continue;
      const int output = static_cast<int>(o);
      zeros[r][o] = judge.zero_of(recording, output, residual_rows(model, prediction, recording, output));
      for (double& value : y[o]) value += zeros[r][o];
    }
    add_wandering(model, judge.noise(), recording, y);
  }
  return zeros;
}

Rows residual_rows(const DataModel& model, const Prediction& prediction, int recording, int output) {
  Rows rows;
  residual_rows(model, prediction, recording, output, rows);
  return rows;
}

void residual_rows(const DataModel& model, const Prediction& prediction, int recording, int output, Rows& rows) {
  const Rows& measured = model.measured(recording, output);
  rows.resize(measured.size());
  if (rows.empty()) return;
  const double* y = prediction.y[static_cast<std::size_t>(recording)][static_cast<std::size_t>(output)].data();
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = measured[i] - y[i];
}

double rms(const DataModel& model, const Prediction& prediction, std::span<const int> recordings, int output) {
  double sum = 0, n = 0;
  for (const int r : recordings)
    for (const double e : residual_rows(model, prediction, r, output)) {
      sum += e * e;
      n += 1;
    }
  return n > 0 ? std::sqrt(sum / n) : 0;
}

}  // namespace hysteron
