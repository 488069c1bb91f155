// Decides the stages of one fit and what they hand on: scan, global search, local search (fit.cpp), then estimates,
// intervals, profiles and what waits for single recordings (fit_result.cpp). Internal to fit/.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fit/estimate/determined.h"
#include "fit/estimate/fit.h"
#include "fit/estimate/profile.h"
#include "fit/estimate/projection.h"

namespace hysteron {

/// One fit from start to result; the members are what its stages hand on.
class Fitting {
 public:
  Fitting(DataModel& model, const NoiseModel& noise, const std::vector<FreeParameter>& free, const FitOptions& options);
  FitResult run();

 private:
  static bool contains(const std::vector<int>& list, int x) {
    return std::find(list.begin(), list.end(), x) != list.end();
  }
  std::vector<bool> affine_of(const std::vector<FreeParameter>& free) const;
  void check() const;
  void prepare_result();
  Trial start_values() const;
  std::vector<PointPointer> scan();
  void try_points(const std::vector<std::vector<double>>& z, std::vector<PointPointer>& points);
  std::vector<std::vector<double>> grid(const std::vector<std::vector<double>>& values) const;
  void scan_one_by_one(const std::vector<std::vector<double>>& values, std::vector<PointPointer>& points);
  std::vector<std::vector<double>> spread() const;
  void search_globally(std::vector<PointPointer>& starts);
  std::vector<bool> place_components(Attractor& attractor) const;
  void search(const std::vector<PointPointer>& starts);
  bool search_from(const std::vector<double>& start);
  void refine_substeps();
  void refine_starts();
  double steps_of_all() const;  ///< of one simulation of each recording that is fitted
  void finish();
  void write_estimates();
  struct Column;
  std::vector<Column> columns_at_result() const;
  void find_intervals();
  bool intervals_by_rows(const std::vector<Column>& columns, const std::vector<Sensitive>& of, bool exact);
  ProfileTask profile_task();
  const Profile& profile(int which, double fraction);
  void find_profiles();
  double steps_of_profiles(std::size_t profiles) const;
  void bend_intervals();
  void take_interval(int which, const Profile& from);
  void fit_the_waiting();
  void put_in_order();
  bool go_on(const char* stage, double fraction = -1);
  void until_stopped(const std::function<void()>& work);
  void keep(const PointPointer& point) {
    if (point->ok && (!best_ || point->chi2 < best_->chi2)) best_ = point;
    if (!point->ok && first_error_.empty()) first_error_ = point->error;
  }
  double tolerance() const { return model_.why_not_exact().empty() ? 1e-9 : 1e-7; }

  DataModel& model_;
  Judge judge_;
  const std::vector<FreeParameter>& all_;
  std::vector<FreeParameter> free_;  ///< those fitted together
  std::vector<std::size_t> place_;   ///< of these in all_
  std::vector<bool> affine_;
  const FitOptions& options_;
  std::vector<int> fitted_, judged_;
  std::unique_ptr<Projection> projection_;
  PointPointer best_;
  std::string first_error_;
  long runs_before_ = 0, failures_before_ = 0, candidates_ = 0;
  std::map<int, Profile> profiles_;  ///< by place in free_
  FitResult result_;
};

/// As a fit begins with it: the start, the bounds, the unit.
ParameterEstimate estimate_at_start(const DataModel& model, const FreeParameter& f);

}  // namespace hysteron
