#include "fit/signals/whiten.h"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "engine/diagram/stop.h"

namespace hysteron {
namespace {

/// Plans of one length. FFTW_ESTIMATE: the same plan, hence the same rounding, on every call; FFTW_UNALIGNED: any
/// array.
struct Plans {
  fftw_plan forward = nullptr, backward = nullptr;
  Plans() = default;
  Plans(const Plans&) = delete;
  Plans& operator=(const Plans&) = delete;
  ~Plans() {
    fftw_destroy_plan(forward);
    fftw_destroy_plan(backward);
  }
};

const Plans& plans_for(std::size_t n) {
  static std::mutex mutex;  // only planning is not thread safe in FFTW, executing is
  static std::map<std::size_t, Plans> cache;
  const std::lock_guard lock(mutex);
  auto& plans = cache[n];
  if (plans.forward == nullptr) {
    std::vector<double> scratch(n);
    const unsigned flags = FFTW_ESTIMATE | FFTW_UNALIGNED;
    plans.forward = fftw_plan_r2r_1d(static_cast<int>(n), scratch.data(), scratch.data(), FFTW_REDFT10, flags);
    plans.backward = fftw_plan_r2r_1d(static_cast<int>(n), scratch.data(), scratch.data(), FFTW_REDFT01, flags);
  }
  return plans;
}

}  // namespace

void cosine_transform(std::span<double> rows) {
  if (rows.empty()) return;
  fftw_execute_r2r(plans_for(rows.size()).forward, rows.data(), rows.data());
  const auto n = static_cast<double>(rows.size());
  const double scale = std::sqrt(1 / (2 * n));  // FFTW's REDFT10 is 2 sum x cos(...)
  for (double& x : rows) x *= scale;
  rows[0] *= std::sqrt(0.5);
}

void inverse_cosine_transform(std::span<double> coefficients) {
  if (coefficients.empty()) return;
  const auto n = static_cast<double>(coefficients.size());
  const double scale = std::sqrt(1 / (2 * n));  // FFTW's REDFT01 is X0 + 2 sum X cos(...)
  coefficients[0] *= std::sqrt(2.0);
  for (double& x : coefficients) x *= scale;
  fftw_execute_r2r(plans_for(coefficients.size()).backward, coefficients.data(), coefficients.data());
}

double coloured(double k, std::size_t rows, double share) {
  const double a = share * share * static_cast<double>(rows) / 7.9;
  return 1 + (k == 0 ? 4 * a : a / (k + 0.5));
}

Whitener::Whitener(std::size_t rows, double white, double share, bool drop_zero, Order order)
    : weight_(rows), drop_zero_(drop_zero && rows > 0), in_time_(order == Order::any && share == 0) {
  for (std::size_t k = 0; k < rows; ++k)
    weight_[k] = 1 / (white * std::sqrt(coloured(static_cast<double>(k), rows, share)));
}

Whitener::Whitener(std::span<const double> rms_of_rows, bool drop_zero)
    : drop_zero_(drop_zero && !rms_of_rows.empty()), in_time_(true) {
  double squares = 0;
  for (const double rms : rms_of_rows) {
    weight_.push_back(1 / rms);
    squares += weight_.back() * weight_.back();
  }
  constant_ = weight_;
  for (double& c : constant_) c /= std::sqrt(squares);
}

void Whitener::apply(std::span<const double> rows, double* out) const {
  if (weight_.empty()) return;
  look_up();  // every search in a residual comes by here, column after column
  if (!constant_.empty()) return apply_by_rows(rows, out);
  if (in_time_) return apply_in_time(rows, out);
  if (!drop_zero_) {  // in the place of the result
    const std::span<double> in_place(out, weight_.size());
    std::copy(rows.begin(), rows.end(), out);
    cosine_transform(in_place);
    for (std::size_t k = 0; k < in_place.size(); ++k) in_place[k] *= weight_[k];
    return;
  }
  std::vector<double> coefficients(rows.begin(), rows.end());
  cosine_transform(coefficients);
  for (std::size_t k = drop_zero_ ? 1 : 0; k < weight_.size(); ++k) *out++ = coefficients[k] * weight_[k];
}

/// White noise is as white in time. The reflection that takes the constant to the first row leaves all that is not
/// constant in the others.
void Whitener::apply_in_time(std::span<const double> rows, double* out) const {
  const double weight = weight_.back();
  if (!drop_zero_) {
    for (const double x : rows) *out++ = x * weight;
    return;
  }
  const auto n = static_cast<double>(rows.size());
  const double root = std::sqrt(n);
  double sum = 0;
  for (const double x : rows) sum += x;
  // v = (1, ..., 1)/sqrt(n) - (1, 0, ..., 0); x - 2 v (v'x)/(v'v) with v'v = 2 - 2/sqrt(n)
  const double shift = rows.size() > 1 ? (sum / root - rows[0]) / (root - 1) : 0;
  for (std::size_t i = 1; i < rows.size(); ++i) *out++ = (rows[i] - shift) * weight;
}

/// The same reflection, of a constant whose rows are not all weighed alike: c = constant_, v = c - (1, 0, ..., 0).
void Whitener::apply_by_rows(std::span<const double> rows, double* out) const {
  if (!drop_zero_) {
    for (std::size_t i = 0; i < rows.size(); ++i) *out++ = rows[i] * weight_[i];
    return;
  }
  double along = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) along += constant_[i] * rows[i] * weight_[i];
  const double shift = rows.size() > 1 ? (along - rows[0] * weight_[0]) / (1 - constant_[0]) : 0;
  for (std::size_t i = 1; i < rows.size(); ++i) *out++ = rows[i] * weight_[i] - shift * constant_[i];
}

// In the cosine domain a constant is coefficient 0 alone: then it is the mean.
double Whitener::zero_of(std::span<const double> rows) const {
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double w = constant_.empty() ? 1 : constant_[i] * constant_[i];
    sum += w * rows[i];
    weights += w;
  }
  return weights > 0 ? sum / weights : 0;
}

std::size_t Whitener::upper_half() const { return weight_.size() / 2 - (drop_zero_ && weight_.size() > 1 ? 1 : 0); }

}  // namespace hysteron
