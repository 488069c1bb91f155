#include "discover/selection/joint_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "discover/models/fit_candidate_model.h"
#include "discover/selection/seen.h"
#include "engine/diagram/error.h"

namespace hysteron {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();
constexpr double twice = 2;  // what one step brings to first order: further ones may bring as much again

class JointStep {
 public:
  JointStep(const FitSetting& setting, const FitContext& context, const TableModel& of)
      : setting_(setting),
        of_(of),
        weights_(weights_of(setting, of)),
        seen_(context_for(setting, context, weights_, Numbers::written), of.model, of.model.diagram, 1) {}

  /// What is left after that step, and what its numbers cost; nothing where that cannot be told.
  struct Step {
    LeftSums left;
    double moved = 0;
  };
  std::optional<Step> step(const FitContext& context, Numbers numbers) {
    auto left = seen_.left({});
    if (!left) return std::nullopt;
    left_ = std::move(*left);
    if (numbers == Numbers::let_go)
      for (const auto& [path, written] : setting_.numbers) add(path, 0, false, written);
    for (const auto& f : free_parameters(seen_.program(), context.free_paths))
      add(seen_.program().parameters[static_cast<std::size_t>(f.parameter)].path, 0, false);
    for (const auto& p : parameters_of(of_.model))
      if (p.estimate != nullptr && !p.law->per_recording && !p.law->read_off_column)
        add(p.estimate->path, std::isnan(p.law->start) ? 0 : std::abs(p.law->start), p.estimate->at_upper);
    if (moving_.empty()) return std::nullopt;
    const LinearFit fit = fit_linearly(moving_, left_);
    Step step{of_.left, 0};
    for (std::size_t i = 0; i < moving_.size(); ++i) {
      step.moved += moving_[i].known * std::pow(moving_[i].off + fit.value[i], 2);
      for (std::size_t k = 0; k < left_.size(); ++k) left_[k] -= fit.value[i] * moving_[i].takes_away[k];
    }
    put_squares(step.left);
    return step;
  }

 private:
  void add(const std::string& path, double least, bool down, double written = 0) {
    const ParameterInfo* info = seen_.program().find_parameter(path);
    if (info == nullptr || !done_.insert(path).second) return;
    double by = a_little * std::max(std::abs(info->value), least);
    if (!(by > 0)) return;
    if (down) by = -by;
    const auto moved = seen_.left({{parameter_index(seen_.program(), path), info->value + by, -1}});
    if (!moved) return;
    Moving one{per_unit(left_, *moved, by)};
    if (written != 0) one.known = 1 / std::pow(setting_.known_to(path) * written, 2), one.off = info->value - written;
    moving_.push_back(std::move(one));
  }

  /// Whitened rows stand recording by recording, in these output by output.
  void put_squares(LeftSums& sums) const {
    std::size_t row = 0;
    const auto judged = train_and_validate(*setting_.all);
    for (const int r : judged)
      for (int o = 0; o < static_cast<int>(seen_.model().outputs().size()); ++o) {
        const std::size_t rows = seen_.rows(r, o);
        const auto here = std::find_if(sums.begin(), sums.end(),
                                       [&](const PieceSums& l) { return l.recording == r && l.output == o; });
        if (rows == 0 || here == sums.end()) continue;
        const auto& rms = weights_.outputs[static_cast<std::size_t>(o)].pieces[static_cast<std::size_t>(r)];
        std::fill(here->squares.begin(), here->squares.end(), 0.0);
        for (std::size_t k = 0; k < rows; ++k, ++row) {
          const std::size_t piece = k * here->squares.size() / rows;
          here->squares[piece] += std::pow(left_[row] * rms[piece], 2) / seen_.model().recording(r).weight;
        }
      }
  }

  const FitSetting& setting_;
  const TableModel& of_;
  const NoiseModel weights_;
  Seen seen_;
  Column left_;
  std::vector<Moving> moving_;
  std::set<std::string> done_;
};

}  // namespace

double most_by_joint_fit(const FitSetting& setting, const FitContext& context, const TableModel& fitted,
                         Numbers numbers) {
  if (!setting.score) return unknown;
  try {
    const auto step = JointStep(setting, context, fitted).step(context, numbers);
    const double now = score_of(*setting.score, fitted);
    if (!step) return numbers == Numbers::let_go ? unknown : now;
    TableModel then = fitted;
    then.left = step->left;
    if (numbers == Numbers::let_go) then.moved = step->moved;
    return now + twice * std::max(0.0, score_of(*setting.score, then) - now);
  } catch (const Error&) {
    return unknown;
  }
}

bool may_reach(const FitSetting& setting, const FitContext& context, const TableModel& fitted, Numbers numbers,
               double more_than, double tie_score) {
  const double most = most_by_joint_fit(setting, context, fitted, numbers);
  if (most == unknown) return true;
  const double as_tie = most - score_of(*setting.score, fitted) + tie_score_of(*setting.score, fitted);
  return most > more_than && as_tie > tie_score - rules::tie;
}

}  // namespace hysteron
