// Decides what a program with sampled blocks is near an operating point, from one signal to another: the continuous
// part exactly over each interval between instants, sampled blocks at theirs, all over one period that is common to
// their clocks. Does not decide how the response is read (margins.h).
//
// Over the common period T the states behave as v(T) = Phi v(0): the poles are the eigenvalues of Phi, z over T, and
// the loop is stable where all lie inside the unit circle (Kalman, Bertram, J. Franklin Inst. 267 (1959) 405-436;
// Bittanti, Colaneri, Periodic Systems, 2009).
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "engine/analysis/linearize.h"

namespace hysteron {

class SampledModel {
 public:
  /// One signal in options.from, one in options.to. Throws Error "not_linear" for dead times and describing functions
  /// with a phase on the way, "no_common_clock" where the clocks have no common period that could be computed.
  SampledModel(const Program& program, const Run& run, const LinearizeOptions& options);

  double period() const { return period_; }  ///< [s] common to all clocks on the way
  /// Instants in one period at which the input counts. One: the response is that of one pulse transfer function.
  int looks() const { return static_cast<int>(looks_.size()); }
  double sample() const { return period_ / looks(); }  ///< [s] between them, on average
  /// The input acts between the instants too: it is taken as held there, the closed loop as closed at all times.
  bool acts_between() const { return acts_between_; }

  /// z over the common period, by falling size; without those of mere storage, which are 0.
  std::vector<Eigenvalue> poles() const;
  /// y/u at the angular frequency w [rad/s] up to pi/sample(), both at the instants at which the input counts; with
  /// several of them in a period the part of y that has the frequency of u.
  std::complex<double> response(double w) const;

  PoleCount unstable() const;
  /// With the loop closed by u = -gain y.
  PoleCount unstable_when_closed(double gain = 1) const;

 private:
  struct Interval {
    int hit = 0;        ///< index into instants_
    double length = 0;  ///< [s] until the next instant
    bool look = false;  ///< the input counts at the instant where it begins
  };
  struct Instant {
    Eigen::MatrixXd j, k;  ///< v = j v + k u, v = (z, m)
  };
  struct Step {                  ///< over one interval, its instant included
    Eigen::MatrixXd move, push;  ///< v' = move v + push u
    Eigen::RowVectorXd see;      ///< y behind the instant = see v + at_once u
    double at_once = 0;
  };
  void find_instants(const Program& program, const Run& run, const std::vector<int>& blocks);
  std::vector<Step> steps(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) const;
  Eigen::MatrixXd monodromy(double gain) const;

  double period_ = 0;
  bool acts_between_ = false;
  int z_ = 0;          ///< continuous states, the first of v
  Eigen::MatrixXd a_;  ///< dv/dt = a v + b u between instants
  Eigen::VectorXd b_;
  Eigen::RowVectorXd c_;  ///< y = c v + d u
  double d_ = 0;
  std::vector<Instant> instants_;  ///< every combination of blocks that run together
  std::vector<std::vector<bool>> due_;
  std::vector<Interval> intervals_;  ///< of one period
  std::vector<int> looks_;           ///< places in intervals_
  std::vector<Step> steps_;
  Eigen::MatrixXd phi_;  ///< over the common period, the loop as it is
};

}  // namespace hysteron
