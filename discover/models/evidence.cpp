// Decides what counts as evidence. See evidence.h.
#include "discover/models/evidence.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>

#include "fit/numerics/dense.h"
#include "fit/numerics/median.h"
#include "fit/signals/whiten.h"

namespace hysteron {
namespace {

constexpr double deviations_of_chance = 4;  // once in tens of thousands of recordings

double mean_of(const Rows& rows) {
  double sum = 0;
  for (const double v : rows) sum += v;
  return sum / static_cast<double>(std::max<std::size_t>(rows.size(), 1));
}

double deviation(const Rows& rows) {
  const double mean = mean_of(rows);
  double sum = 0;
  for (const double v : rows) sum += (v - mean) * (v - mean);
  return rows.empty() ? 0 : std::sqrt(sum / static_cast<double>(rows.size()));
}

/// Squares of one output about its mean over several recordings, added up one by one (Chan, Golub, LeVeque 1979).
struct AboutMean {
  double rows = 0, mean = 0, squares = 0;
  void add(const RecordingError& e) {
    const auto n = static_cast<double>(e.rows);
    const double off = e.mean - mean;
    squares += n * e.deviation * e.deviation + off * off * rows * n / (rows + n);
    mean += off * n / (rows + n);
    rows += n;
  }
};

/// Sums over several outputs; squares may be added up only where these are of one dimension, shares always.
struct Pool {
  double squares = 0, rows = 0, shares = 0, moving_rows = 0;
  std::map<std::string, AboutMean> measured;  ///< by output
  void add(const RecordingError& e) {
    const auto n = static_cast<double>(e.rows);
    squares += n * e.rms * e.rms;
    rows += n;
    if (e.rows > 0) measured[e.output].add(e);
    if (!(e.deviation > 0)) return;
    shares += n * e.nrmse * e.nrmse;
    moving_rows += n;
  }
  double rms() const { return rows > 0 ? std::sqrt(squares / rows) : 0; }
  double nrmse(bool one_dimension) const {
    double variance = 0;
    for (const auto& [output, about] : measured) variance += about.squares;
    if (one_dimension) return variance > 0 ? std::sqrt(squares / variance) : 0;
    return moving_rows > 0 ? std::sqrt(shares / moving_rows) : 0;
  }
};

/// As the data file has it; what no file says, as the diagram.
Unit unit_of_output(const DataModel& model, int output) {
  for (int r = 0; r < model.n_recordings(); ++r) {
    const auto& units = model.recording(r).units;
    if (const auto found = units.find(model.outputs()[static_cast<std::size_t>(output)]); found != units.end())
      return found->second;
  }
  return model.output_unit(output);
}

bool one_dimension(const DataModel& model) {
  const auto& signals = model.program().signals;
  for (int o = 1; o < static_cast<int>(model.outputs().size()); ++o)
    if (!(signals[static_cast<std::size_t>(model.output_signal(o))].dimension ==
          signals[static_cast<std::size_t>(model.output_signal(0))].dimension))
      return false;
  return true;
}

}  // namespace

Evidence::Evidence(const DataModel& base) : base_(base), before_(noise_before_fit(base)) {
  for (const auto& o : before_.outputs) known_ = known_ && o.source == NoiseSource::data_sheet;
  judge_.emplace(base_, before_);
  for (int r = 0; r < base_.n_recordings(); ++r)
    if (base_.recording(r).role != Role::test) recordings_.push_back(r);
}

std::shared_ptr<const std::vector<LineSpan>> Evidence::spans_of(const WanderingLine& line, int output,
                                                                const Prediction* without) const {
  const double white = noise().outputs[static_cast<std::size_t>(output)].white;
  std::vector<Rows> shown(static_cast<std::size_t>(base_.n_recordings()));
  double known = 0;  // of the line's frequency
  for (int r = 0; r < base_.n_recordings(); ++r) {
    const auto i = static_cast<std::size_t>(r);
    if (without == nullptr || base_.measured(r, output).empty() || without->y[i].empty()) continue;
    shown[i] = residual_rows(base_, *without, r, output);
    known += known_frequency(base_.times(r), shown[i], line.frequency, white);
  }
  const double astray = mains_astray + (known > 0 ? 3 / std::sqrt(known) : 0);
  auto spans = std::make_shared<std::vector<LineSpan>>();
  for (int r = 0; r < base_.n_recordings(); ++r) {
    const ShownLine beside{shown[static_cast<std::size_t>(r)], white, astray};
    spans->push_back(base_.measured(r, output).empty() ? LineSpan() : LineSpan(base_.times(r), line, beside));
  }
  return spans;
}

void Evidence::known_lines(std::vector<std::optional<WanderingLine>> lines,
                           const std::function<Prediction()>& without) {
  lines.resize(base_.outputs().size());
  std::optional<Prediction> silent;
  lines_.resize(lines.size());
  spans_.resize(lines.size());
  for (std::size_t o = 0; o < lines.size(); ++o) {
    if (lines[o] == lines_[o]) continue;
    spans_[o].reset();
    if (!lines[o]) continue;
    if (without && !silent) silent = without();
    spans_[o] = spans_of(*lines[o], static_cast<int>(o), silent && silent->ok ? &*silent : nullptr);
  }
  lines_ = std::move(lines);
}

LeftOut Evidence::line_of_user(int output) const {
  const auto o = static_cast<std::size_t>(output);
  const bool is_known = o < lines_.size() && lines_[o] && lines_[o]->by_user;
  return is_known ? LeftOut(spans_[o], LineSpan::Part::all) : LeftOut();
}

void Evidence::settle(const Prediction& best) {
  Prediction with_zeros = best;
  add_zeros(base_, *judge_, with_zeros);
  NoiseModel noise = noise_from_residual(base_, before_, with_zeros, recordings_);
  for (std::size_t o = 0; o < lines_.size(); ++o)
    if (lines_[o])
      noise.outputs[o].left_out = {spans_[o], lines_[o]->by_user ? LineSpan::Part::all : LineSpan::Part::wandering};
  judge_.emplace(base_, std::move(noise));
  double n = 0, squares = 0, fourth = 0;
  for (const int r : recordings_)
    for (const double w : residual(best, r)) {
      n += 1;
      squares += w * w;
      fourth += w * w * w * w;
    }
  per_chi2_ = 1;
  if (known_ || !(squares > 0)) return;
  per_chi2_ = std::clamp(3 * squares * squares / fourth, 3.0, n) / squares;
}

std::vector<Evidence::Slice> Evidence::slices(int recording) const {
  std::vector<Slice> list;
  std::size_t begin = 0;
  for (int o = 0; o < static_cast<int>(base_.outputs().size()); ++o) {
    const std::size_t rows = base_.measured(recording, o).size();
    if (rows == 0) continue;
    const bool zero_is_free = base_.zero_per_recording(o);
    list.push_back({o, begin, rows - (zero_is_free ? 1 : 0), zero_is_free});
    begin += list.back().size;
  }
  return list;
}

RecordingError Evidence::plain_error(const Prediction& with_zeros, int recording, int output) const {
  const Rows& measured = base_.measured(recording, output);
  RecordingError one;
  one.recording = base_.recording(recording).name;
  one.role = base_.recording(recording).role;
  one.output = base_.outputs()[static_cast<std::size_t>(output)];
  one.unit = unit_of_output(base_, output);
  one.rows = measured.size();
  one.rms = rms(base_, with_zeros, std::span<const int>(&recording, 1), output);
  one.deviation = deviation(measured);
  one.mean = base_.zero_per_recording(output) ? 0 : mean_of(measured);
  one.nrmse = one.deviation > 0 ? one.rms / one.deviation : 0;
  return one;
}

ModelError Evidence::error(const Prediction& prediction) const {
  ModelError e;
  e.ok = prediction.ok;
  if (!prediction.ok) return e;
  Prediction with_zeros = prediction;
  add_zeros(base_, *judge_, with_zeros);
  Pool train, validate;
  for (const int r : recordings_) {
    if (prediction.y[static_cast<std::size_t>(r)].empty()) continue;
    const auto w = residual(prediction, r);
    const bool is_train = base_.recording(r).role == Role::train;
    const double step = median_step(base_.times(r));
    for (const auto& [o, begin, size, zero_is_free] : slices(r)) {
      RecordingError one = plain_error(with_zeros, r, o);
      one.step = step;
      one.chi2 = dot(w.data() + begin, w.data() + begin, size);
      one.evidence = one.chi2 * per_chi2_;
      (is_train ? e.chi2_train : e.chi2_validate) += one.chi2;
      (is_train ? e.evidence_train : e.evidence_validate) += one.evidence;
      (is_train ? e.n_train : e.n_validate) += static_cast<double>(size);
      (is_train ? train : validate).add(one);
      e.recordings.push_back(std::move(one));
    }
  }
  const bool one_sum = one_dimension(base_);
  e.nrmse_train = train.nrmse(one_sum);
  e.nrmse_validate = validate.nrmse(one_sum);
  if (one_sum) {
    e.rms_train = train.rms();
    e.rms_validate = validate.rms();
  }
  return e;
}

OverFloor Evidence::over_usual_floor(const Prediction& prediction) const {
  NoiseModel usual = noise();
  for (std::size_t o = 0; o < usual.outputs.size(); ++o)
    usual.outputs[o].one_over_f = std::min(usual.outputs[o].one_over_f, before_.outputs[o].one_over_f);
  const Judge judge(base_, usual, Whitener::Order::by_frequency);
  std::vector<double> chi2(base_.outputs().size(), 0.0), n(base_.outputs().size(), 0.0);
  OverFloor over;
  for (const int r : recordings_) {
    if (prediction.y[static_cast<std::size_t>(r)].empty()) continue;
    const auto w = judge.residual(base_, prediction, r);
    for (const auto& slice : slices(r)) {
      const auto o = static_cast<std::size_t>(slice.output);
      const auto rows = static_cast<double>(slice.size);
      const double here = dot(w.data() + slice.begin, w.data() + slice.begin, slice.size);
      // An effect may show in one kind of recording alone, where chance is larger, for the rows are fewer.
      const double chance = deviations_of_chance * std::sqrt(2 / rows);
      over.one = std::max(over.one, here / rows - chance);
      if (base_.recording(r).role == Role::train) continue;
      chi2[o] += here;
      n[o] += rows;
    }
  }
  for (std::size_t o = 0; o < chi2.size(); ++o)
    if (n[o] > 0) over.all = std::max(over.all, chi2[o] / n[o]);
  return over;
}

Prediction Evidence::calibrated(Prediction prediction, int output) const {
  const auto o = static_cast<std::size_t>(output);
  std::size_t size = 0;
  for (const int r : recordings_) size += judge_->size(r);
  Dense line(size, 2);  // of one, and of what is predicted
  std::vector<double> left;
  for (const int r : recordings_) {
    const auto& predicted = prediction.y[static_cast<std::size_t>(r)];
    if (predicted.empty()) continue;
    std::vector<Rows> rows;
    for (const auto& y : predicted) rows.emplace_back(y.size(), 0.0);
    rows[o].assign(rows[o].size(), 1.0);
    judge_->whiten(r, rows, line.col(0) + left.size());
    rows[o] = predicted[o];
    judge_->whiten(r, rows, line.col(1) + left.size());
    const auto w = residual(prediction, r);
    left.insert(left.end(), w.begin(), w.end());
  }
  left.resize(size);
  const auto best = minimum_norm(line, left, 1e-10);
  for (const int r : recordings_)
    if (auto& y = prediction.y[static_cast<std::size_t>(r)]; !y.empty())
      for (double& v : y[o]) v += best.x[0] + best.x[1] * v;
  return prediction;
}

std::vector<double> Evidence::wandering(const Prediction& prediction) const {
  if (std::none_of(lines_.begin(), lines_.end(), [](const auto& line) { return line.has_value(); }))
    return std::vector<double>(base_.outputs().size(), 0.0);
  NoiseModel all = noise();
  for (auto& o : all.outputs) o.left_out = {};
  const Judge with_it(base_, all);
  std::vector<double> squares(all.outputs.size(), 0.0), n(all.outputs.size(), 0.0);
  for (const int r : recordings_) {
    if (base_.recording(r).role != Role::validate || prediction.y[static_cast<std::size_t>(r)].empty()) continue;
    const auto before = with_it.residual(base_, prediction, r), after = judge_->residual(base_, prediction, r);
    for (const auto& slice : slices(r)) {
      const auto o = static_cast<std::size_t>(slice.output);
      n[o] += static_cast<double>(slice.size);
      squares[o] += dot(before.data() + slice.begin, before.data() + slice.begin, slice.size) -
                    dot(after.data() + slice.begin, after.data() + slice.begin, slice.size);
    }
  }
  std::vector<double> rms;
  for (std::size_t o = 0; o < squares.size(); ++o)
    rms.push_back(n[o] > 0 ? all.outputs[o].white * std::sqrt(std::max(0.0, squares[o] / n[o])) : 0);
  return rms;
}

void Evidence::add_test(ModelError& error, const Prediction& prediction) const {
  Prediction with_zeros = prediction;
  add_zeros(base_, *judge_, with_zeros);
  Pool pool;
  for (int r = 0; r < base_.n_recordings(); ++r) {
    if (base_.recording(r).role != Role::test || prediction.y[static_cast<std::size_t>(r)].empty()) continue;
    for (int o = 0; o < static_cast<int>(base_.outputs().size()); ++o) {
      if (base_.measured(r, o).empty()) continue;
      error.test.push_back(plain_error(with_zeros, r, o));
      pool.add(error.test.back());
    }
  }
  if (error.test.empty()) return;
  error.nrmse_test = pool.nrmse(one_dimension(base_));
  if (one_dimension(base_)) error.rms_test = pool.rms();
}

std::vector<OutputError> by_output(const ModelError& error, Role role) {
  std::vector<OutputError> list;
  std::vector<Pool> pools;
  for (const auto& r : role == Role::test ? error.test : error.recordings) {
    if (r.role != role) continue;
    const auto known =
        std::find_if(list.begin(), list.end(), [&](const OutputError& o) { return o.output == r.output; });
    const auto at = static_cast<std::size_t>(known - list.begin());
    if (known == list.end()) {
      list.push_back({r.output, r.unit});
      pools.emplace_back();
    }
    pools[at].add(r);
  }
  for (std::size_t o = 0; o < list.size(); ++o) {
    list[o].rms = pools[o].rms();
    list[o].nrmse = pools[o].nrmse(true);
  }
  return list;
}

bool of_one_dimension(const std::vector<RecordingError>& recordings) {
  return std::all_of(recordings.begin(), recordings.end(),
                     [&](const RecordingError& r) { return r.unit.dimension == recordings.front().unit.dimension; });
}

}  // namespace hysteron
