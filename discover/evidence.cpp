// Decides what counts as evidence. See evidence.h.
#include "discover/evidence.h"

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

/// Bands hold at least this many coefficients: a mean of eight squares scatters by a factor of two, of one by any
/// factor.
constexpr std::size_t smallest_band = 8;

double deviation(const Rows& rows) {
  double mean = 0;
  for (const double v : rows) mean += v;
  mean /= static_cast<double>(std::max<std::size_t>(rows.size(), 1));
  double sum = 0;
  for (const double v : rows) sum += (v - mean) * (v - mean);
  return rows.empty() ? 0 : std::sqrt(sum / static_cast<double>(rows.size()));
}

/// Sums over several outputs; they may be added up only where they are of one dimension.
struct Pool {
  double squares = 0, variance = 0, rows = 0;
  void add(double rms, double dev, std::size_t n) {
    squares += rms * rms * static_cast<double>(n);
    variance += dev * dev * static_cast<double>(n);
    rows += static_cast<double>(n);
  }
  double rms() const { return rows > 0 ? std::sqrt(squares / rows) : 0; }
  double nrmse() const { return variance > 0 ? std::sqrt(squares / variance) : 0; }
};

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

void Evidence::settle(const Prediction& best) {
  Prediction with_zeros = best;
  add_zeros(base_, *judge_, with_zeros);
  judge_.emplace(base_, noise_from_residual(base_, before_, with_zeros, recordings_));
}

double Evidence::evidence_of(const std::vector<double>& w, std::size_t begin, std::size_t end) const {
  double sum = 0;
  if (known_) {
    for (std::size_t k = begin; k < end; ++k) sum += w[k] * w[k];
    return sum;
  }
  for (std::size_t from = begin, size = smallest_band; from < end;) {
    std::size_t to = std::min(from + size, end);
    if (end - to < smallest_band) to = end;
    double chi2 = 0;
    for (std::size_t k = from; k < to; ++k) chi2 += w[k] * w[k];
    const double n = static_cast<double>(to - from);
    sum += n * (1 + std::log(std::max(chi2 / n, 1e-3)));
    if (from > begin) size *= 2;
    from = to;
  }
  return sum;
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
    std::size_t begin = 0;
    for (int o = 0; o < static_cast<int>(base_.outputs().size()); ++o) {
      const Rows& measured = base_.measured(r, o);
      if (measured.empty()) continue;
      const std::size_t size = measured.size() - (base_.zero_per_recording(o) ? 1 : 0);
      RecordingError one;
      one.recording = base_.recording(r).name;
      one.role = base_.recording(r).role;
      one.output = base_.outputs()[static_cast<std::size_t>(o)];
      one.rows = measured.size();
      one.rms = rms(base_, with_zeros, std::span<const int>(&r, 1), o);
      const double dev = deviation(measured);
      one.nrmse = dev > 0 ? one.rms / dev : 0;
      for (std::size_t k = begin; k < begin + size; ++k) one.chi2 += w[k] * w[k];
      one.evidence = evidence_of(w, begin, begin + size);
      begin += size;
      (is_train ? e.chi2_train : e.chi2_validate) += one.chi2;
      (is_train ? e.evidence_train : e.evidence_validate) += one.evidence;
      (is_train ? e.n_train : e.n_validate) += static_cast<double>(size);
      (is_train ? train : validate).add(one.rms, dev, one.rows);
      e.recordings.push_back(std::move(one));
    }
  }
  e.nrmse_train = train.nrmse();
  e.nrmse_validate = validate.nrmse();
  if (one_dimension(base_)) {
    e.rms_train = train.rms();
    e.rms_validate = validate.rms();
  }
  return e;
}

std::optional<std::pair<double, double>> Evidence::test_error(const Prediction& prediction) const {
  Prediction with_zeros = prediction;
  add_zeros(base_, *judge_, with_zeros);
  Pool pool;
  for (int r = 0; r < base_.n_recordings(); ++r)
    if (base_.recording(r).role == Role::test && !prediction.y[static_cast<std::size_t>(r)].empty())
      for (int o = 0; o < static_cast<int>(base_.outputs().size()); ++o)
        pool.add(rms(base_, with_zeros, std::span<const int>(&r, 1), o), deviation(base_.measured(r, o)),
                 base_.measured(r, o).size());
  if (pool.rows == 0) return std::nullopt;
  return std::pair{pool.rms(), pool.nrmse()};
}

}  // namespace hysteron
