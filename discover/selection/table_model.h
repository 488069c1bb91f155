// Decides what a row of the model table is: one model, fitted, and what it leaves. And how a model is fitted for it:
// weights renewed until they follow what the model leaves, numbers of the user as written or let go.
// Internal to discover.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "discover/search/search_state.h"
#include "discover/selection/block_score.h"

namespace hysteron {

/// Numbers of the user's model, as written or let go.
enum class Numbers { written, let_go };

/// What a model left when the levels of a column were found in it, by what is rounded and by TableModel::left: the
/// score of a model with levels is by that above the one of its `left`.
struct LevelsFound {
  LeftSums rounded, left;
};

/// One row of the model table.
struct TableModel {
  CandidateModel model;
  Numbers numbers = Numbers::written;
  NoiseModel weights;  ///< it was fitted by these
  LeftSums left;       ///< before columns round it: see CandidateModel::before_rounding
  /// By what it predicts, where columns round it to their levels.
  std::optional<LeftSums> rounded{};
  const LeftSums& left_at_last() const { return rounded ? *rounded : left; }
  std::shared_ptr<const LevelsFound> levels{};  ///< of the model in which they were first told from noise; null: none
  int parameters = 0;                           ///< all free numbers of the laws
  /// Of each of its effects, by id: ln(places times laws that were tried of it).
  std::map<std::string, double> tried{};
  double moved = 0;  ///< sum of ((x - x0)/(0.1 x0))^2 over the user's numbers
  bool ok() const { return model.ok; }
};

/// An effect by one of its laws at one of its places.
struct Choice {
  const Effect* effect = nullptr;
  Law law;
  Place place;
  Excitation at;
};

/// What all fits of one selection share.
struct FitSetting {
  FitSetting(const SearchState& state, std::map<std::string, double> numbers);
  FitSetting with(std::map<std::string, double> other_numbers) const;
  /// One standard deviation of the logarithm of what is written there.
  double known_to(const std::string& path) const;

  const SearchState& state;
  std::map<std::string, double> numbers;  ///< that may be let go, as written [SI]
  std::map<std::string, double> known;    ///< of these, how well, where the diagram says it
  /// The data set with all recordings to fit to: what acts in one recording only is found wherever that stands, and a
  /// score that pays for each number needs none that were not seen. What is told at the end is fitted to those meant
  /// for it.
  std::shared_ptr<const DataSet> all;
  /// By all models that have been fitted; null: before there are any, each is weighed by what it leaves itself.
  std::shared_ptr<const BlockScore> score{};
};

/// One standard deviation of the logarithm of what a user writes, where nothing is said of it: 10 %.
inline constexpr double usually_known_to = 0.1;

/// Weights of one model are renewed at most so often: each time from where it came to.
inline constexpr int most_renewals = 12;

double score_of(const BlockScore& score, const TableModel& fitted);
/// The same of a model whose numbers cost no more than what chance takes with them: one each. For ties.
double tie_score_of(const BlockScore& score, const TableModel& fitted);

/// What is left, and what it cost, of a model that was fitted. Of `tried` what stands in it counts.
TableModel measured(const FitSetting& setting, CandidateModel model, Numbers numbers, NoiseModel weights,
                    const std::map<std::string, double>& tried);

/// A workshop that weighs outputs by these weights, with the user's numbers let go or not.
FitContext context_for(const FitSetting& setting, const FitContext& context, const NoiseModel& weights,
                       Numbers numbers);
/// By what the model leaves itself: see BlockScore::weights().
NoiseModel weights_of(const FitSetting& setting, const TableModel& model);

/// Squares of what is left by these weights.
double squares_by(const NoiseModel& weights, const LeftSums& left);

/// Fits again from where the model stands, by what it leaves itself, until that changes by less than 5 %: far from the
/// truth all weights are wrong, and the user's numbers are held too firmly by what is written. At most `renewals`
/// times.
TableModel refitted(const FitSetting& setting, const FitContext& context, const TableModel& from, Numbers numbers,
                    int renewals = most_renewals);

/// `from` with one more effect, at one place or at several like ones. The user's numbers stay as `from` has them.
/// `ln_tried`: see TableModel::tried.
TableModel with_term(const FitSetting& setting, const FitContext& context, const TableModel& from,
                     const std::vector<Choice>& term, double ln_tried, Effort effort);

/// `from` without the effects that stand at these places of its list, fitted with all else as it is.
TableModel without_term(const FitSetting& setting, const FitContext& context, const TableModel& from,
                        const std::vector<std::size_t>& term);

/// Of a number that was fitted by weights that count witnesses: one standard deviation [SI], not scaled by what the
/// rows leave, for that scale takes their correlation for smallness.
double sigma_by_witnesses(const ParameterEstimate& estimate);

/// Takes those numbers back to what is written that bring less than 6 + ln n_eff of chi2 alone, the least first, and
/// fits again with the others. `kept`: the others, as written.
TableModel with_fewest_numbers(const FitSetting& setting, const FitContext& context, const BlockScore& score,
                               const TableModel& let_go, std::map<std::string, double>& kept);

}  // namespace hysteron
