// Decides how the loop of a selection goes: the null, all first effects, further ones, what can be left out or
// exchanged (exchange.cpp). Internal to discover.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "discover/selection/addition.h"
#include "discover/selection/null_model.h"

namespace hysteron {

namespace rules {
constexpr double by_score = 10;  ///< a model claims what it adds where its score is so much higher
/// rms over the noise below which nothing is left that another effect could take away.
constexpr double near_noise = 1.1;
}  // namespace rules

/// What was asked on top of one model.
struct Round {
  TableModel on;                 ///< the model that all of them stand on
  std::vector<Addition> rivals;  ///< best score first
  bool broken_off = false;       ///< somebody was not asked
};

/// Indices of a model's standing effects, those of one name together: what enters like places at once is one term.
std::vector<std::vector<std::size_t>> terms_of(const CandidateModel& model);

class Selection {
 public:
  Selection(SearchState& state, std::map<std::string, double> numbers);
  /// Finds the model. Throws Stopped where it is broken off: best() is what was found until then. `is_over` is asked of
  /// the best model after each term; true: what would be found from there on is of no use.
  void run(const std::function<bool(const TableModel&)>& is_over);

  const Nulls& nulls() const { return nulls_; }
  const TableModel& best() const { return best_; }
  const std::vector<Round>& rounds() const { return rounds_; }
  /// Was somebody not asked, for time was short?
  bool left_some_out() const { return left_some_out_; }
  const BlockScore& score() const { return *setting_.score; }
  const FitSetting& setting() const { return setting_; }
  double score_of(const TableModel& f) const { return hysteron::score_of(score(), f); }
  /// What something else leaves that competes with these models: noise is no larger than what it shows.
  void count_in(const LeftSums& left);
  /// One term of the best model (see terms_of) and what looks like it in its place, each last in its model and fitted
  /// with the rest; that term first, the others by their score. Among them, as `hidden`, what these recordings cannot
  /// show and may have acted all the same: a gain that follows a temperature, at one temperature.
  std::vector<Addition> in_place_of(const std::vector<std::size_t>& term);
  /// Does this model explain enough more than what stood before? broken_off: not everybody has been asked.
  bool may_be_claimed(const TableModel& f, const TableModel& before, bool broken_off) const;
  /// Takes the best of what was asked last on the best model, if it is claimed by the score of all models that have
  /// been fitted. False, and nothing moves, where that has been claimed already.
  bool claim_of_last_round();
  /// This term of the best model (see terms_of) leaves it. False, and it stays, where the rest cannot be fitted.
  bool leave(const std::vector<std::size_t>& term);
  /// The best model without a term of it, fitted from where it stands with it.
  TableModel rest_without(const std::vector<std::size_t>& term);
  /// Those that are hidden, in place of an effect that stands alone.
  std::vector<Addition> hidden_in_place_of(const Effect& effect);

 private:
  bool add_one(int step);
  bool add_two(int step);
  void fit(std::vector<Addition>& rivals, int step);
  void fit_first_laws(std::vector<Addition>& rivals, int step);
  void fit_richer_laws(std::vector<Addition>& rivals);
  /// Who is fitted together with the user's numbers.
  struct WhoIsAsked {
    std::size_t most = std::numeric_limits<std::size_t>::max();   ///< of all, the likeliest
    std::size_t first = std::numeric_limits<std::size_t>::max();  ///< of these so many,
    double more_than = std::numeric_limits<double>::infinity();   ///< and those that explain more than this
    std::size_t at_least = 0;  ///< so many also where a step to first order says that they cannot win
    double ahead = -std::numeric_limits<double>::infinity();  ///< tie_score_of() others that have been fitted so
  };
  void fit_with_numbers(std::vector<Addition>& rivals, const WhoIsAsked& who);
  bool may_win(const TableModel& f, const FitContext& context, Numbers numbers, double ahead) const;
  void settle_best(std::vector<Addition>& rivals);
  void sort(std::vector<Addition>& rivals) const;
  TableModel others_as_they_are(const std::vector<std::size_t>& term) const;
  std::vector<Addition> take_hidden(const Effect& effect);
  void fit_on(const TableModel& rest, std::vector<Addition>& rivals);
  bool leave_out();
  std::vector<Addition> by_laws(const TableModel& on, const std::function<bool(const Addition&, const Law&)>& takes);
  std::vector<Addition> by_other_laws(const std::vector<std::size_t>& term);
  bool in_two();
  bool exchange();
  struct FitOfRival {
    std::size_t rival = 0, law = 0;
    TableModel fitted;
  };
  using FitsOfRival = std::vector<FitOfRival>;
  void take_up(std::vector<Addition>& rivals, std::vector<FitsOfRival> answers);
  bool is_better(const Addition& rival, const FitOfRival& other) const;
  void remember(const TableModel& fitted);
  void measure();
  std::vector<Addition> everywhere(int step);
  std::vector<Addition> list(int step);
  bool is_itself(const Addition& rival) const;
  const Addition& plainest_like(const Addition& rival, const std::vector<Addition>& rivals) const;

  SearchState& state_;
  FitSetting setting_;
  Nulls nulls_;
  TableModel best_;
  std::vector<LeftSums> left_;  ///< by all models that were fitted
  std::vector<Round> rounds_;
  bool left_some_out_ = false;
  bool unclaimed_ = false;  ///< the last round stands on the best model, and nothing of it was taken
};

}  // namespace hysteron
