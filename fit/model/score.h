// Decides how far a prediction is from the measurement: whitened residuals, chi2, and plain rms, per recording.
// Does not search parameters (fit.h) and does not say where the error lies (compare.h).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fit/model/model.h"
#include "fit/model/noise.h"
#include "fit/signals/whiten.h"

namespace hysteron {

struct RecordingScore {
  int recording = -1;
  Role role = Role::train;
  double chi2 = 0;           ///< weight * sum of squared whitened residuals
  double n = 0;              ///< weight * number of whitened residuals
  std::vector<double> rms;   ///< per output [SI], zero per recording taken off where the column says so
  std::vector<double> zero;  ///< per output [SI]: estimated zero of this recording (0 where shared)
};

struct Score {
  bool ok = true;
  std::string error{};
  std::vector<RecordingScore> recordings{};

  double chi2() const;
  double n() const;
  double chi2(Role role) const;
  double n(Role role) const;
  const RecordingScore* find(int recording) const;  ///< nullptr if it was not judged
};

/// The whitening filters of a data model with one noise model. Made once per fit, used for every trial.
class Judge {
 public:
  Judge(const DataModel& model, const NoiseModel& noise, Whitener::Order order = Whitener::Order::any);

  const NoiseModel& noise() const { return noise_; }
  /// Whitened, weighted rows of all outputs of a recording, one behind the other.
  std::size_t size(int recording) const;
  /// Whitens rows given per output (a residual, a response) into out[0 .. size(recording)).
  void whiten(int recording, const std::vector<Rows>& rows, double* out) const;
  /// The zero [SI] that leaves least of these rows of an output.
  double zero_of(int recording, int output, const Rows& rows) const;
  /// Measured minus predicted, whitened; initial states that are free in this recording are taken out.
  std::vector<double> residual(const DataModel& model, const Prediction& prediction, int recording) const;
  Score score(const DataModel& model, const Prediction& prediction, std::span<const int> recordings) const;

 private:
  NoiseModel noise_;
  std::vector<std::vector<Whitener>> whiteners_;  ///< [recording][output]
  std::vector<double> root_weight_;
};

/// Adds what may be estimated per recording (zero of a sensor, initial states, how the amplitude and phase of a known
/// line move: NoiseOfOutput::left_out) to the prediction, in closed form.
/// Returns the zeros [recording][output] [SI]. Afterwards measured - y is the residual that people see.
std::vector<std::vector<double>> add_zeros(const DataModel& model, const Judge& judge, Prediction& prediction);

/// Where the recordings begin, as far from equilibrium as DataModel::start_of(): what the simulations began with, and
/// what the free initial states of this prediction add to it. [recording][state]; empty where none is free.
std::vector<std::vector<double>> starts_of(const DataModel& model, const Judge& judge, const Prediction& prediction);

/// Measured minus predicted on the judged rows [SI].
Rows residual_rows(const DataModel& model, const Prediction& prediction, int recording, int output);
/// The same into `rows`, whose memory is used again.
void residual_rows(const DataModel& model, const Prediction& prediction, int recording, int output, Rows& rows);

/// rms of measured minus predicted over the judged rows of these recordings [SI], all rows counted alike.
double rms(const DataModel& model, const Prediction& prediction, std::span<const int> recordings, int output);

}  // namespace hysteron
