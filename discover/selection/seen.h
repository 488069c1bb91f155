// Decides how a model of the recordings is seen by the weights of a fit: rows of all recordings, and how they change
// with one of its numbers. Does not fit. Internal to discover.
#pragma once

#include <optional>
#include <vector>

#include "discover/models/candidate_model.h"
#include "fit/model/model.h"
#include "fit/model/score.h"

namespace hysteron {

using Column = std::vector<double>;  ///< whitened rows of all recordings, one behind the other

/// Of a number, for derivatives.
inline constexpr double a_little = 1e-3;

/// A model of the recordings, seen through the weights of the context. Rows are multiplied by `scale`.
class Seen {
 public:
  /// `of`: where its recordings begin, what it has for single ones, and what rounds columns, which is silent;
  /// `diagram`: its own, or with something more.
  Seen(const FitContext& context, const CandidateModel& of, const Diagram& diagram, double scale);

  const Program& program() const { return model_.program(); }
  const DataModel& model() const { return model_; }
  /// Of one output in left(): fewer by one than are measured where a recording's zero is at its best.
  std::size_t rows(int recording, int output) const;
  /// Measured minus predicted with these values besides the diagram's, zeros and free starts at their best. Nothing
  /// where it cannot be simulated.
  std::optional<Column> left(const Trial& values);

 private:
  DataModel model_;
  Judge judge_;
  std::vector<int> recordings_;
  double scale_;
  Trial fixed_;
};

/// What one unit more takes away, from what is left `before` and `after` so many units.
Column per_unit(const Column& before, const Column& after, double by);

/// A number that moves with others.
struct Moving {
  Column takes_away;  ///< per unit
  double known = 0;   ///< 1/sigma^2 of what is known of it
  double off = 0;     ///< how far it is from that
};

/// Changes of the numbers that leave least of `left`, what is known of them weighed in; of several ways the shortest.
struct LinearFit {
  std::vector<double> value, sigma;  ///< one each; a number that moves nothing: 0, 0
  double fall = 0;                   ///< of the squares
};
LinearFit fit_linearly(const std::vector<Moving>& numbers, const Column& left);

}  // namespace hysteron
