// Decides what the parts of one discovery share: the user's model and data, the present model, what was found so far.
// Internal to discover; one file each: the start (fit_base.cpp), who is tried where (candidates.cpp), ties (ties.h),
// the verdict (conclude.cpp), what is recorded of structures that competed (structures_tried.h).
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "discover/experiment/experiment.h"
#include "discover/models/evidence.h"
#include "discover/search/investigation.h"
#include "discover/search/structures_tried.h"
#include "fit/model/model.h"

namespace hysteron {

struct SearchState {
  SearchState(const Diagram& diagram, const DataSet& data, const Registry& registry, const Effects& effects,
              const DiscoverOptions& options);

  /// Nothing new is begun: the search is over, or, once it is `closing`, all is.
  bool stopped() const { return (options.stop && options.stop()) || (!closing && spent() >= 1); }
  double spent() const { return options.spent ? options.spent() : 0; }  ///< of the time to search
  /// Does what can be left out where the search is stopped, and is broken off then. True if it came to its end.
  bool unless_stopped(const std::function<void()>& work) const { return unless_stopped(work, whole_time); }
  static constexpr double whole_time = 1;                     ///< of that to search
  void progress(const std::string& what, double done) const;  ///< by any thread
  /// Fits that do not need each other, several at a time: job(i, context) for each i in [0, n), begun in this order,
  /// until one answers true or the search is stopped: a job that is broken off leaves what it had not begun with.
  /// Returns the first that did, n if none; what later ones left does not count. What fits write down others find only
  /// after the last: then nothing depends on the number of threads. `until`: the point of spent() at which they should
  /// have ended; one that takes more than its part of what is left until then is broken off.
  std::size_t side_by_side(std::size_t n, const std::function<bool(std::size_t i, const FitContext& context)>& job,
                           double until = whole_time) const;
  /// The point of spent() at which so much of what is left now is over.
  double after(double share) const { return spent() + share * std::max(0.0, 1 - spent()); }
  bool wanted(const Effect& effect) const;
  /// Noise from the residual of `best`; whoever is compared afterwards is compared in its units. How lines of the mains
  /// that stand in it wander is no evidence.
  void settle(CandidateModel& best);
  /// The same with the lines that stand in another model.
  void settle(const Prediction& best, const CandidateModel& with_lines);

  const Registry& registry;
  const Effects& effects;
  const DiscoverOptions& options;
  std::shared_ptr<const DataSet> data;
  const Diagram& user;
  FitContext context;
  std::unique_ptr<DataModel> base_model;
  std::unique_ptr<Evidence> evidence;
  CandidateModel base, current;
  std::vector<Resonance> own_resonances;  ///< of the base
  std::vector<TriedEffect> hidden;        ///< of the present step: cannot be seen here, may have acted all the same
  std::optional<CompetingStructure> structure;  ///< where effects were selected
  bool closing = false;                         ///< what was found is looked at for the last time
  Discovery d;

 private:
  bool unless_stopped(const std::function<void()>& work, double until) const;

  mutable std::mutex telling_;
};

/// What was found stays found where a search for what else explains it fails or is broken off: a model that was fitted
/// may be one that cannot be simulated with another effect. A failure is told.
void unless_it_fails(SearchState& state, const std::function<void()>& work);

/// Fits the user's model and settles the noise. Throws Error where a role is missing or the model cannot be simulated.
void fit_base(SearchState& state);

/// Every effect at every place where it may enter and could be seen; places that its law cannot tell apart once, or as
/// twins. What the recordings cannot show and may have acted all the same goes to `state.hidden`.
std::vector<TriedEffect> list_candidates(SearchState& state, int step);
/// Outputs of a model, measured or not, to which a wire leads: a coupling that reads it beside another axis does not
/// put it on the way of that one. Empty where nobody knows.
std::vector<std::string> outputs_moved(const SearchState& state, const CandidateModel& model,
                                       const std::string& written);
/// The measured ones of them, as indices of DataModel::outputs().
std::vector<int> measured_moved(const SearchState& state, const CandidateModel& model, const std::string& written);
/// What the recordings show at places of the model, with what is free anyway and how the user's model rings.
std::vector<Excitation> circumstances_on(const SearchState& state, const CandidateModel& model,
                                         const std::vector<Place>& places);

/// Verdict, remainder, words.
void conclude(SearchState& state);

}  // namespace hysteron
