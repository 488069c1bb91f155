// Decides what generic structures are sought in: the whitened residual of one output, recording by recording, less the
// best common gain and offset, with the levels that it may follow. Does not decide which structure stands out.
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <string>
#include <vector>

#include "discover/models/evidence.h"
#include "discover/structure/structure.h"
#include "fit/signals/whiten.h"

namespace hysteron {

/// A signal over whose value a structure may repeat or break: the simulated output, an input, a recorded side signal.
struct Level {
  std::string name;  ///< of an output, an input or a column
  Unit unit;
  double lowest = 0, highest = 0;  ///< [SI] over all recordings
  double span() const { return highest - lowest; }
};

/// What is looked at of one recording.
struct ResidualPart {
  int recording = 0;
  bool train = false;
  Rows t, e;                 ///< [s]; [SI] residual less the best common gain and offset
  std::vector<Rows> levels;  ///< [SI] as ResidualParts::levels(); the measured output contains the noise, which would
                             ///< then explain itself, so level 0 is the simulated one
  Rows drive;                ///< [SI] the main input; empty if there is none
  Eigen::VectorXd w;         ///< e, whitened
  double duration() const { return t.back() - t.front(); }
};

class ResidualParts {
 public:
  using Columns = std::function<std::vector<Rows>(const ResidualPart&)>;

  /// Recordings with fewer than 16 rows are left out.
  ResidualParts(const Evidence& evidence, const Prediction& prediction, int output);

  const std::vector<ResidualPart>& list() const { return parts_; }
  const std::vector<Level>& levels() const { return levels_; }
  const DataModel& model() const { return model_; }
  double white() const { return white_; }  ///< [SI] rms of the white noise
  /// chi2: as the model leaves it, without the best gain and offset, of noise alone.
  const ByRole& before() const { return before_; }
  const ByRole& beyond() const { return beyond_; }
  const ByRole& floor() const { return floor_; }

  Eigen::VectorXd whitened(const ResidualPart& part, const Rows& rows) const;
  /// The whitened residual as rows in time, of unit variance where there is only noise.
  Rows whitened_in_time(const ResidualPart& part) const;
  /// Fall of chi2 in this part by columns with weights of its own.
  double own_fall(const ResidualPart& part, const Columns& columns) const;
  /// The columns of every part, whitened.
  using WhitenedColumns = std::vector<Eigen::MatrixXd>;
  WhitenedColumns whitened(const Columns& columns) const;
  /// Fall of chi2 by columns with common weights, found on train; beside those of `fixed`, which are the same in many
  /// trials, if it is not empty. 0 without train recordings.
  ByRole judged(const Columns& columns, const WhitenedColumns& fixed = {}) const;

 private:
  void read_levels(const std::vector<int>& recordings, const Prediction& with_zeros);
  void take_off_gain_and_offset();
  bool has_train() const;
  Eigen::VectorXd solve_on_train(const WhitenedColumns& columns) const;
  Eigen::MatrixXd column_matrix(const ResidualPart& part, const Columns& columns) const;
  std::size_t index(const ResidualPart& p) const { return static_cast<std::size_t>(&p - parts_.data()); }

  const DataModel& model_;
  int output_;
  double white_ = 0;
  ByRole before_{}, beyond_{}, floor_{};
  std::vector<Whitener> filters_;
  std::vector<ResidualPart> parts_;
  std::vector<Level> levels_;
};

}  // namespace hysteron
