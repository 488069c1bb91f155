// Decides what is left of the residual once the linear parameters are at their best (variable projection), and its
// derivatives by the others (projection_slopes.cpp). Internal to fit/.
//
//   y(z, theta) = y(z, ref) + sum_j (theta_j - ref_j) c_j(z)      exactly, for parameters proved jointly affine
//   r(z) = min over theta within bounds of |W (measured - y(z, theta))|
// c_j is the difference of two simulations. A parameter of one recording alone has zeros in the others, which are not
// simulated for it. A prior is one more row: (mean - value) / sigma. dr/dz is taken at fixed theta, and a step is
// searched in z and theta together (after Kaufman, BIT 15 (1975) 49, but with the bounds of theta): the gradient is
// exact, and a linearization costs one simulation per nonlinear parameter instead of one for each of the linear ones as
// well.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "fit/model/free_parameter.h"
#include "fit/model/model.h"
#include "fit/model/score.h"
#include "fit/numerics/dense.h"
#include "fit/numerics/levenberg_marquardt.h"
#include "fit/numerics/linear.h"

namespace hysteron {

/// What was found at one point of the nonlinear parameters.
struct ProjectedPoint {
  bool ok = false;
  std::string error;
  std::vector<double> z;             ///< nonlinear parameters, ln(value) where the scale is logarithmic
  std::vector<double> theta;         ///< linear parameters [SI]
  std::vector<Bound> bound;          ///< of the linear ones
  std::vector<double> residual;      ///< whitened, all recordings one behind the other, then one row per prior
  double chi2 = 0;                   ///< of all rows
  double prior_chi2 = 0;             ///< the priors' part of it
  Dense columns;                     ///< whitened responses to the linear parameters
  std::vector<double> triangle;      ///< R of R'R = columns' columns (NormalForm::r)
  std::vector<Dense> initial_basis;  ///< per recording: orthonormal columns of the free initial states
};
using PointPointer = std::shared_ptr<const ProjectedPoint>;

class Projection {
 public:
  /// `fixed`: values of other parameters, in all simulations.
  Projection(DataModel& model, const Judge& judge, const std::vector<FreeParameter>& free,
             const std::vector<bool>& affine, std::vector<int> recordings, Trial fixed = {});

  int n_linear() const { return static_cast<int>(linear_.size()); }
  int n_nonlinear() const { return static_cast<int>(nonlinear_.size()); }
  std::size_t rows() const { return rows_; }
  std::size_t data_rows() const { return data_rows_; }        ///< before the rows of the priors
  const std::vector<int>& linear() const { return linear_; }  ///< indices into the free parameters
  const std::vector<int>& nonlinear() const { return nonlinear_; }

  std::vector<double> start() const;  ///< z
  std::vector<double> lower() const, upper() const;
  /// How far one step of a search may go: a factor of two on a log scale (by four, the time constants of
  /// two relaxations change places), half of a finite box on a linear one.
  std::vector<double> largest_step() const;
  double to_z(int k, double value) const;
  double to_value(int k, double z) const;

  /// The last few points are remembered.
  PointPointer at(std::span<const double> z);
  /// Many at once, for what is simulated side by side; not remembered.
  std::vector<PointPointer> at_each(const std::vector<std::vector<double>>& points);
  void forget() {
    recent_.clear();
    searched_basis_.clear();
  }
  /// chi2 of all rows at points near `best`, linear parameters as given instead of at their best; infinite where the
  /// model cannot be simulated. A point is one simulation.
  struct Point {
    std::vector<double> z, theta;
  };
  std::vector<double> chi2_of(const std::vector<Point>& points, const ProjectedPoint& best);

  /// dr/dz (rows x n_nonlinear) at fixed theta. False: not to be had.
  bool jacobian(const ProjectedPoint& point, bool central, Dense& columns);
  /// The residual near a point, linear in theta and z: which bounds hold theta back may change on the way.
  bool linear_model(const ProjectedPoint& point, bool central, LinearizedResidual& model);
  /// The same by the derivatives of another projection of these rows and nonlinear parameters, which it is given first;
  /// what is of another size is none.
  void know(std::shared_ptr<const Dense> derivatives);
  bool knows() const { return known_ != nullptr; }
  bool known_linear_model(const ProjectedPoint& point, LinearizedResidual& model) const;
  /// What linear_model() found last; null before.
  std::shared_ptr<const Dense> derivatives() const { return found_; }

  /// All free parameters at a point, then the fixed ones, for DataModel::predict.
  std::vector<ParameterValue> values(std::span<const double> z, std::span<const double> theta) const;

 private:
  /// Columns are differences of simulations that are good to about 1e-13.
  static constexpr double dependent = 1e-10;

  /// A trial, and the recording that it changes (-1: all).
  struct Wanted {
    Trial trial;
    int recording = -1;
  };
  /// Which of what was wanted, the place in recordings_, and what the model says.
  using Use = std::function<void(std::size_t, std::size_t, const Prediction&)>;
  void simulate(std::span<const Wanted> wanted, const Use& use);
  void simulate_on(std::size_t begin, std::size_t end, int recording, std::span<const Wanted> wanted, const Use& use);
  bool touches_any(int recording) const;

  void linear_model_by(const ProjectedPoint& point, Dense jacobian_columns, LinearizedResidual& model) const;
  void evaluate(std::span<ProjectedPoint> points);
  void make_room(ProjectedPoint& point, std::vector<double>& residual);
  void remember(std::shared_ptr<ProjectedPoint> point);
  void responses(std::span<ProjectedPoint*> points, std::vector<std::vector<double>>& residuals);
  void solve(ProjectedPoint& point, std::vector<double>& residual);
  std::vector<Dense> initial_basis_at(std::span<const double> z, const std::vector<double>& theta);
  void clear_initial(ProjectedPoint& point, std::vector<double>& residual, const std::vector<double>& theta);
  void whiten_residual(const Prediction& prediction, std::size_t k, double* out);
  void prior_rows(std::span<const double> z, std::span<const double> theta, double* out) const;
  void clear(const ProjectedPoint& point, double* column) const;
  std::vector<double> reference() const;

  DataModel& model_;
  const Judge& judge_;
  const std::vector<FreeParameter>& free_;
  std::vector<int> recordings_;
  Trial fixed_;
  std::vector<std::size_t> begin_, size_;  ///< per entry of recordings_: its first row, its rows
  std::vector<Rows> difference_;           ///< workspace, per output
  std::vector<int> linear_, nonlinear_;
  std::vector<double> delta_;  ///< per linear parameter: step between the two simulations
  bool from_zero_ = true;      ///< reference: zero where the bounds allow it, else the start
  bool has_initial_ = false;
  /// Where starts are searched for (starts.h), the responses to them hold about one start only, and cost as much as all
  /// else: those of the first point stand for all until the next start.
  std::vector<Dense> searched_basis_;
  std::size_t rows_ = 0, data_rows_ = 0;
  struct PriorRow {
    int free = -1;           ///< index into the free parameters
    bool log_scale = false;  ///< mean and sigma are those of ln(value)
    double mean = 0, sigma = 1;
  };
  std::vector<PriorRow> priors_;
  std::vector<std::shared_ptr<ProjectedPoint>> recent_;
  std::shared_ptr<const Dense> known_, found_;
  // Of a point that nobody holds any more: its memory, which is tens of megabytes, is used again.
  std::vector<double> spare_columns_, spare_residual_;
};

}  // namespace hysteron
