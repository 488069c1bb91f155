#include "engine/lanes/lanes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/diagram/index.h"
#include "engine/diagram/stop.h"
#include "engine/events/rest.h"
#include "engine/lanes/lane_arithmetic.h"
#include "engine/lanes/lane_evaluation.h"
#include "engine/lanes/lane_grid.h"
#include "engine/program/needed.h"
#include "engine/simulate/fixed_step.h"
#include "engine/simulate/output_instants.h"
#include "engine/simulate/simulate_parts.h"

namespace hysteron {
class Lanes::Advance {
 public:
  Advance(ProgramPointer program, const Run& run, const SimulateOptions& options, std::vector<int> parameters,
          RefusedValues refused);
  std::vector<std::optional<Problem>> operator()(std::span<const double> values, const Sink& sink);
  long rows = 0;

 private:
  std::optional<Problem> load(std::span<const double> values, int lane);
  void take_step(const LanePoint& point, double from);
  void arrive(std::size_t point, const Sink& sink);
  void tell_runaways(std::vector<std::optional<Problem>>& results);

  ProgramPointer program_;
  SimulateOptions options_;
  std::vector<int> parameters_, signals_;
  RefusedValues refused_;
  Run run_;  // of one lane while it is loaded
  std::vector<double> instants_;
  std::vector<LanePoint> points_;
  LaneEvaluation evaluation_;
  LaneNumbers x_, trial_, k1_, k2_, k3_, recorded_, watched_;
  std::optional<LaneEvaluation::List> derivatives_, values_;
  long row_ = 0;
};

Lanes::Advance::Advance(ProgramPointer program, const Run& run, const SimulateOptions& options,
                        std::vector<int> parameters, RefusedValues refused)
    : program_(std::move(program)),
      options_(options),
      parameters_(std::move(parameters)),
      signals_(options.signals.empty() ? program_->record_signals : options.signals),
      refused_(refused),
      run_(run),
      instants_(output_instants(options)),
      evaluation_(program_, run_, shared_blocks(*program_, parameters_)),
      x_(program_->n_x),
      trial_(program_->n_x),
      k1_(program_->n_x),
      k2_(program_->n_x),
      k3_(program_->n_x),
      recorded_(static_cast<int>(signals_.size())),
      watched_(static_cast<int>(signals_.size())) {
  if (const auto why = why_not_in_lanes(*program_, run, options, parameters_); !why.empty())
    fail("not_in_lanes", "/simulate", "runs cannot go side by side: " + why, "run them one after the other");
  check_inputs(*program_, run);
  if (has_fixed_steps(options.method)) check_step(options, instants_.back());
  points_ = lane_points(*program_, run_, options_, instants_);
  rows = static_cast<long>(instants_.size());
  std::vector<SharedNumbers::Instant> stages, ends;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const LanePoint& point = points_[i];
    ends.push_back({point.t, point.branch});
    if (i == 0) continue;
    const double from = points_[i - 1].t;
    stages.push_back({from, point.branch_before});
    if (options_.method != Method::rk4) continue;
    stages.push_back({from + point.h / 2, point.branch_before});
    stages.push_back({point.t, point.branch_before});
  }
  if (program_->n_x > 0 && points_.size() > 1)
    derivatives_ = evaluation_.make_list(run_, program_->derivative_steps, {}, std::move(stages));
  values_ = evaluation_.make_list(run_, program_->n_m > 0 ? program_->all_values : steps_for(*program_, signals_),
                                  signals_, std::move(ends));
  // What is not varied is the same in all lanes; a lane that is not used, or whose values are refused, goes on as it
  // is.
  for (int lane = 0; lane < width; ++lane) evaluation_.place(run_, lane, x_);
}

/// Values of one sample, and states and memory at the start, to its lane.
std::optional<Problem> Lanes::Advance::load(std::span<const double> values, int lane) {
  try {
    set_parameters(*program_, run_, parameters_, values, refused_);
    run_.t = options_.begin;
    reset(*program_, run_);
    if (options_.at_rest) settle_at_rest(*program_, run_, options_.begin);
  } catch (const Error& error) {
    return error.problems.front();
  }
  evaluation_.place(run_, lane, x_);
  return {};
}

void Lanes::Advance::take_step(const LanePoint& point, double from) {
  const double h = point.h, middle = from + h / 2;
  LaneNumbers& dx = evaluation_.dx();
  const std::size_t stages = options_.method == Method::rk4 ? 3 : 1;
  const std::size_t stage = static_cast<std::size_t>(&point - points_.data() - 1) * stages;
  const auto derivative = [&](std::size_t which, double t, LaneNumbers& x, LaneNumbers& k) {
    evaluation_.evaluate(*derivatives_, stage + which, t, point.branch_before, x.data());
    if (&k != &dx) std::copy_n(dx.data(), dx.size(), k.data());
  };
  if (options_.method == Method::euler) {
    derivative(0, from, x_, dx);
    return lane_move({x_.data(), x_.data(), dx.data(), h, x_.size()});
  }
  derivative(0, from, x_, k1_);
  lane_move({trial_.data(), x_.data(), k1_.data(), h / 2, x_.size()});
  derivative(1, middle, trial_, k2_);
  lane_move({trial_.data(), x_.data(), k2_.data(), h / 2, x_.size()});
  derivative(1, middle, trial_, k3_);
  lane_move({trial_.data(), x_.data(), k3_.data(), h, x_.size()});
  derivative(2, point.t, trial_, dx);
  lane_combine({x_.data(), k1_.data(), k2_.data(), k3_.data(), dx.data(), h, x_.size()});
}

/// Memory is accepted, and rows are handed on.
void Lanes::Advance::arrive(std::size_t point, const Sink& sink) {
  const LanePoint& here = points_[point];
  if (program_->n_m == 0 && here.rows == 0) return;
  evaluation_.evaluate(*values_, point, here.t, here.branch, x_.data());
  evaluation_.commit();
  if (here.rows == 0) return;
  for (std::size_t s = 0; s < signals_.size(); ++s)
    std::copy_n(evaluation_.y(signals_[s]), width, recorded_.row(static_cast<int>(s)));
  lane_watch({watched_.data(), recorded_.data(), recorded_.size()});
  for (int i = 0; i < here.rows; ++i, ++row_) sink(row_, instants_[at(static_cast<int>(row_))], recorded_.data());
}

std::vector<std::optional<Problem>> Lanes::Advance::operator()(std::span<const double> values, const Sink& sink) {
  const std::size_t n = parameters_.size(), samples = n == 0 ? 1 : values.size() / n;
  std::vector<std::optional<Problem>> results(samples);
  for (std::size_t s = 0; s < samples; ++s) results[s] = load(values.subspan(s * n, n), static_cast<int>(s));
  if (derivatives_) evaluation_.begin(*derivatives_);
  evaluation_.begin(*values_);
  row_ = 0;
  std::fill_n(watched_.data(), watched_.size(), 0.0);
  LookUp look_up;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    look_up();
    if (i > 0 && program_->n_x > 0) take_step(points_[i], points_[i - 1].t);
    arrive(i, sink);
  }
  tell_runaways(results);
  return results;
}

void Lanes::Advance::tell_runaways(std::vector<std::optional<Problem>>& results) {
  const auto tell = [](const std::string& path, const std::string& what) {
    return Problem{"diverged", path, what, "check the parameters, and gain and sign of the loop around it", "", 0};
  };
  for (std::size_t k = 0; k < signals_.size(); ++k)
    for (std::size_t s = 0; s < results.size(); ++s)
      if (const auto& path = program_->signals[at(signals_[k])].path;
          !results[s] && !(watched_.row(static_cast<int>(k))[s] == 0))
        results[s] = tell(path, fmt::format("\"{}\" is not finite in a row", path));
  for (const BlockInstance& b : program_->blocks)
    for (std::size_t s = 0; s < results.size(); ++s)
      for (int i = 0; i < b.sizes.states && !results[s]; ++i)
        if (!std::isfinite(LaneEvaluation::state(b, x_, i, static_cast<int>(s))))
          results[s] = tell(b.path, fmt::format("{} \"{}\" runs away: a state of it is not finite at the end",
                                                b.kernel->declaration.type, b.path));
}

Lanes::Lanes(ProgramPointer program, const Run& run, const SimulateOptions& options, std::vector<int> parameters,
             RefusedValues refused)
    : advance_(std::make_unique<Advance>(std::move(program), run, options, std::move(parameters), refused)) {}
Lanes::~Lanes() = default;
Lanes::Lanes(Lanes&&) noexcept = default;
Lanes& Lanes::operator=(Lanes&&) noexcept = default;
std::vector<std::optional<Problem>> Lanes::operator()(std::span<const double> values, const Sink& sink) {
  return (*advance_)(values, sink);
}
long Lanes::rows() const { return advance_->rows; }

}  // namespace hysteron
