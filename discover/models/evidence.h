// Decides what counts as evidence: how far a model is from each recording, in units of its noise, and how much a fall
// means. Does not fit and does not choose.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fit/model/model.h"
#include "fit/model/noise.h"
#include "fit/model/score.h"
#include "fit/signals/wander.h"

namespace hysteron {

namespace rules {
constexpr double floor_gate = 1.12;  ///< chi2/N on validation below which only noise is left: 6 % in rms
}  // namespace rules

/// How far one model is from one output of one recording (rows judged).
struct RecordingError {
  std::string recording;
  Role role = Role::train;
  std::string output;
  Unit unit;  ///< in which the output is told: that of its column
  std::size_t rows = 0;
  double step = 0;       ///< [s] between rows
  double rms = 0;        ///< [SI of the output]
  double deviation = 0;  ///< standard deviation of what was measured [SI of the output]
  double mean = 0;       ///< of what was measured [SI of the output]; 0 where its zero is found anew in each recording
  double nrmse = 0;      ///< rms over that
  double chi2 = 0;       ///< sum of squared whitened residuals, in units of the noise
  double evidence = 0;   ///< what falls are counted in: chi2 where the noise is known (see Evidence)
  double excess() const { return chi2 - static_cast<double>(rows); }
};

/// One model against all recordings. `rms` over several outputs is only given where they are of one dimension (else 0);
/// `nrmse` there is that of the summed squares, about an output's mean over all recordings as `compare` has it, else
/// the root of the mean square of the outputs' own.
struct ModelError {
  bool ok = true;
  std::vector<RecordingError> recordings;    ///< train and validate
  std::vector<RecordingError> test;          ///< only of the last model, read once at the end
  double chi2_train = 0, chi2_validate = 0;  ///< in units of the noise: about one per row if only noise is left
  double evidence_train = 0, evidence_validate = 0;
  double n_train = 0, n_validate = 0;
  double rms_train = 0, rms_validate = 0;  ///< [SI] over all rows and outputs of the role together
  double nrmse_train = 0, nrmse_validate = 0;
  std::optional<double> rms_test, nrmse_test;  ///< of `test`

  double chi2() const { return chi2_train + chi2_validate; }
  double evidence() const { return evidence_train + evidence_validate; }
  double n() const { return n_train + n_validate; }
  double excess_validate() const { return chi2_validate - n_validate; }
  double over_floor() const { return n_validate > 0 ? chi2_validate / n_validate : 0; }  ///< 1 = noise
};

/// One model against one output, over all recordings of a role.
struct OutputError {
  std::string output;
  Unit unit;       ///< in which it is told
  double rms = 0;  ///< [SI of the output]
  double nrmse = 0;
};
/// Outputs that recordings of this role measured, in the order of the recordings' outputs.
std::vector<OutputError> by_output(const ModelError& error, Role role);
/// Their outputs can be added up.
bool of_one_dimension(const std::vector<RecordingError>& recordings);

/// chi2 per row: 1 = noise.
struct OverFloor {
  double all = 0;  ///< on validation recordings together
  double one = 0;  ///< in one recording, less what chance makes there: an effect may show in one kind alone
};

/// The measure of a discovery. Residuals are whitened by one fixed filter (fit/signals/whiten.h). Then
/// - where a data sheet says how large the noise is: evidence = chi2;
/// - where nobody says, what the best model leaves is all that is known of noise and misfit. Its size is
///   chi2_best / N, and it counts for N_eff = 3 (sum w^2)^2 / sum w^4 independent witnesses (the degrees of freedom of
///   a sum of squares with that spectrum: N for white noise, 3 for a single line): evidence = chi2 * N_eff / chi2_best.
///   Ten thousand rows of a slow misfit are some dozen witnesses, not ten thousand.
class Evidence {
 public:
  /// `base`: any model of the data set; gives what was measured.
  explicit Evidence(const DataModel& base);
  /// Corrects the noise by the residual of the best model so far (always from the data sheet or first guess).
  void settle(const Prediction& best);
  /// Lines that a model has found and follows as steady ones, per output (as DataModel::outputs()): how they wander is
  /// no evidence, from the next settle() on. `without`: what that model predicts without them.
  void known_lines(std::vector<std::optional<WanderingLine>> lines, const std::function<Prediction()>& without = {});

  /// A line of the user's own model on this output: nobody knows its phase in a recording that was not there yet.
  LeftOut line_of_user(int output) const;

  ModelError error(const Prediction& prediction) const;
  /// Whitened residual of one recording, outputs one behind the other.
  std::vector<double> residual(const Prediction& prediction, int recording) const {
    return judge_->residual(base_, prediction, recording);
  }

  /// With as much 1/f noise as sensors usually have, or less where the residual says so: slow structure passes for
  /// noise until somebody tries an effect on it. Of several outputs the largest.
  OverFloor over_usual_floor(const Prediction& prediction) const;
  /// What a sensor would read with the best gain and zero of one output, over all judged recordings.
  Prediction calibrated(Prediction prediction, int output) const;
  /// rms on validation of what known lines leave by wandering, whitened rows times the white noise [SI of the output],
  /// per output; 0 where none is known.
  std::vector<double> wandering(const Prediction& prediction) const;

  const Judge& judge() const { return *judge_; }
  const NoiseModel& noise() const { return judge_->noise(); }
  const DataModel& model() const { return base_; }
  const std::vector<int>& recordings() const { return recordings_; }  ///< train and validate
  bool noise_known() const { return known_; }
  /// Adds how far the model is from the test recordings, which this prediction holds; nothing if there are none.
  void add_test(ModelError& error, const Prediction& prediction) const;

 private:
  /// Where the residual of one output lies in that of its recording (residual()): `size` coefficients from `begin`, one
  /// less than rows where a zero of its own is free.
  struct Slice {
    int output = 0;
    std::size_t begin = 0, size = 0;
    bool zero_is_free = false;
  };
  std::vector<Slice> slices(int recording) const;
  /// Names, rows, rms and NRMSE; nothing that is whitened.
  RecordingError plain_error(const Prediction& with_zeros, int recording, int output) const;
  /// What a line of this output may be in each recording; `without`: see known_lines, nullptr where it is not known.
  std::shared_ptr<const std::vector<LineSpan>> spans_of(const WanderingLine& line, int output,
                                                        const Prediction* without) const;

  const DataModel& base_;
  NoiseModel before_;
  std::optional<Judge> judge_;
  std::vector<int> recordings_;
  bool known_ = true;
  std::vector<std::optional<WanderingLine>> lines_;
  std::vector<std::shared_ptr<const std::vector<LineSpan>>> spans_;  ///< of these, by the recording
  double per_chi2_ = 1;                                              ///< evidence per unit of chi2
};

}  // namespace hysteron
