// Decides what the parts of one discovery share: the user's model and data, the present model, what was found so far.
// Internal to discover; one file each: the start (fit_base.cpp), who is tried where (candidates.cpp), how they are
// compared (compare_candidates.cpp), ties (ties.cpp), claims (claim.cpp, other_outputs.cpp, axes_together.cpp,
// set_on_another_output.cpp, idle.cpp, nominal_parameters.cpp, zero_held.cpp, two_in_one.cpp, reconsider.cpp,
// another_beginning.cpp), the verdict (conclude.cpp), what is recorded of who lost (laws_tried.cpp, menu.cpp,
// structures_tried.cpp).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "discover/experiment/experiment.h"
#include "discover/models/evidence.h"
#include "discover/search/investigation.h"
#include "fit/model/model.h"

namespace hysteron {

struct SearchState {
  SearchState(const Diagram& diagram, const DataSet& data, const Registry& registry, const Effects& effects,
              const DiscoverOptions& options);

  /// Nothing new is begun: the search is over, or, once it is `closing`, all is.
  bool stopped() const { return (options.stop && options.stop()) || (!closing && options.enough && options.enough()); }
  /// Does what can be left out where the search is stopped, and is broken off then. True if it came to its end.
  bool unless_stopped(const std::function<void()>& work) const;
  void progress(const std::string& what, double done) const;  ///< by any thread
  /// Fits that do not need each other, several at a time: job(i, context) for each i in [0, n), begun in this order,
  /// until one answers true or the search is stopped: a job that is broken off leaves what it had not begun with.
  /// Returns the first that did, n if none; what later ones left does not count. What fits write down others find only
  /// after the last: then nothing depends on the number of threads.
  std::size_t side_by_side(std::size_t n,
                           const std::function<bool(std::size_t i, const FitContext& context)>& job) const;
  bool wanted(const Effect& effect) const;
  /// Noise from the residual of `best`; whoever is compared afterwards is compared in its units.
  void settle(CandidateModel& best);

  const Registry& registry;
  const Effects& effects;
  const DiscoverOptions& options;
  std::shared_ptr<const DataSet> data;
  const Diagram& user;
  FitContext context;
  std::unique_ptr<DataModel> base_model;
  std::unique_ptr<Evidence> evidence;
  CandidateModel base, current;
  std::optional<SmoothInput> smooth;            ///< found on the way: all begins anew with it
  std::map<std::string, double> other_numbers;  ///< likewise, with these numbers of the model free
  bool begins_anew() const { return smooth || !other_numbers.empty(); }
  std::vector<Resonance> own_resonances;  ///< of the base
  std::vector<TriedEffect> hidden;        ///< of the present step: cannot be seen here, may have acted all the same
  Prediction before_prediction;           ///< of the model before the present step; empty = the base
  bool by_score = false;                  ///< effects are claimed by a score of whole models
  /// By that score ahead of all effects: structures that were looked for, and by how much the best one is.
  std::optional<std::pair<StructureSearch, double>> ahead_of_effects;
  bool closing = false;  ///< what was found is looked at for the last time
  Discovery d;

 private:
  mutable std::mutex telling_;
};

/// What was found stays found where the search for more fails or is broken off: a model that was fitted may be one that
/// cannot be simulated where the next effect asks for it. The answer is then false, and a failure is told.
bool unless_it_fails(SearchState& state, const std::function<bool()>& search);

/// What was found so far, to go back to.
class Found {
 public:
  explicit Found(const SearchState& state);
  void restore(SearchState& state) const;

 private:
  CandidateModel current_;
  Prediction before_prediction_;
  std::vector<FoundStep> steps_;
  std::vector<Candidate> candidates_;
};

/// Fits the user's model and settles the noise. Throws Error where a role is missing or the model cannot be simulated.
void fit_base(SearchState& state);

/// One of its family stands in the present model.
bool standing(const SearchState& state, const Effect& effect);
/// One of its family stands in this model on the way to an output that the place moves: each axis has its own.
bool standing_before(const SearchState& state, const CandidateModel& model, const Effect& effect, const Place& place);
/// An effect that can be taken for one that stands: what there is of it, that one has taken up in its own values, and
/// with these held it would not be seen.
bool taken_up(const SearchState& state, const Effect& effect);
/// Every effect at every place where it may enter and could be seen; places that its law cannot tell apart once, or as
/// twins. What the recordings cannot show and may have acted all the same goes to `state.hidden`. `outputs`: only what
/// moves none but these, all if empty. `only`: these effects, all if empty.
std::vector<TriedEffect> list_candidates(SearchState& state, int step, const std::vector<std::string>& outputs = {},
                                         const std::vector<const Effect*>& only = {});
/// An effect by one of its laws at one of its places.
struct Choice {
  const Effect* effect = nullptr;
  Law law;
  Place place;
  Excitation at;
};
/// Every effect that `may` be taken and could be seen on `model`, at each place where none of its family stands, by
/// each of its `laws`.
std::vector<Choice> choices_on(const SearchState& state, const CandidateModel& model,
                               const std::function<bool(const Effect&)>& may,
                               const std::function<std::vector<Law>(const Effect&, const Excitation&)>& laws);
/// Outputs of a model, measured or not, to which a wire leads: a coupling that reads it beside another axis does not
/// put it on the way of that one. Empty where nobody knows.
std::vector<std::string> outputs_moved(const SearchState& state, const CandidateModel& model,
                                       const std::string& written);
/// The measured ones of them, as indices of DataModel::outputs().
std::vector<int> measured_moved(const SearchState& state, const CandidateModel& model, const std::string& written);
/// Outputs that no standing effect moves.
std::vector<std::string> untouched_outputs(const SearchState& state);
/// Outputs that nothing of this family that stands moves.
std::vector<std::string> outputs_without(const SearchState& state, const std::string& family);
/// Takes out what is not needed beside what was found later: what could be switched off without any loss, and, while
/// there is time, what the others explain as well once they are fitted again. Where the search came to its end,
/// reconsider() has done more than that already.
void leave_out_idle(SearchState& state);
/// A set does without this member: `rest`, the others fitted without it, gives back less than a claim has to take away,
/// or no more than what the laws of the others may have left.
bool is_needless(const SearchState& state, const Effect& member, const CandidateModel& rest);
/// Names of effects that stand, each once.
int found_effects(const SearchState& state);
/// The candidate of the same family whose law cannot tell its place from that of `t`; nullptr if there is none.
TriedEffect* same_finding(std::vector<TriedEffect>& kept, const TriedEffect& t);
/// Of twins the one behind stays, unless the other is better by more than the rows are accurate; it names both places.
void join_twins(std::vector<TriedEffect>& tried);
/// What rows that are off by a part of the noise can add to chi2 or take from it: their square, and their product with
/// the noise.
double blur(const CandidateModel& candidate);
/// Of chi2 on validation recordings, what a candidate may have lost there by the errors of its fit where these show it
/// more than those that were fitted: a value known to 11 % leaves 1 % of its effect. Least squares with as many numbers
/// p lose p times the ratio of the two on average; what that is in a usual split is not counted.
double lost_by_the_fit(const TriedEffect& tried);

void fit_candidates(SearchState& state, std::vector<TriedEffect>& tried, int step);

/// How a candidate is judged: as if it were the first effect, or on top of laws that may have left something.
enum class As { first, further };
/// What the laws that stand may have left of their own effects, by the recording, for an imperfect law leaves a part of
/// what it describes where that acts: of chi2 in each of ModelError::recordings. Empty if judged as a first one, and
/// where none stands.
std::vector<double> left_by_laws(const SearchState& state, As as);
/// The same for the laws of any model.
std::vector<double> left_by_laws_of(const SearchState& state, const CandidateModel& model);

/// Indices of candidates that could be fitted, best score first.
std::vector<std::size_t> ranking(const std::vector<TriedEffect>& tried);
/// The first of them that passes the rules of a claim, or who scores alike by fewer numbers; -1 = none.
int best_admitted(const std::vector<TriedEffect>& tried);
/// Noise by the best of them, then everybody's error in its units, then the rules.
void compare_all(SearchState& state, std::vector<TriedEffect>& tried, As as);
/// Further effects were screened with the earlier ones held: the best few are fitted together with them.
void refit_best(SearchState& state, std::vector<TriedEffect>& tried, As as, double progress);
/// A right effect with too simple a law invites wrong ones: richer laws of the best names come first. On top of an
/// effect that was found they are screened with that one held, and fitted together only where that brings something.
void enrich(SearchState& state, std::vector<TriedEffect>& tried, int step, As as, double progress);
/// The same of one that stands beside others: the laws that refine its own.
void refine(const SearchState& state, const FitContext& context, TriedEffect& t);
/// What these recordings cannot show may have acted in all of them alike. Where the winner looks like it, it is a
/// rival: that it was refused says nothing against it.
void try_hidden(SearchState& state, std::vector<TriedEffect>& tried, const Effect& winner, As as);

/// With spare numbers `t` is the winner itself: who explains no more is no rival of what it can imitate.
bool is_the_winner_and_more(const SearchState& state, const TriedEffect& t, const Effect& winner);
/// Candidates that explain the recordings as well as the winner, best first.
std::vector<int> ties_of(SearchState& state, const std::vector<TriedEffect>& tried, std::size_t winner);
/// Axes are built alike: of those that explain as much the one that stands on another axis already is taken, and the
/// winner becomes one of its ties. Indices of tried; changes both.
void as_on_another_axis(const SearchState& state, std::vector<TriedEffect>& tried, int& winner, std::vector<int>& ties);
/// Fits with the finest rows, once.
void sharpen(SearchState& state, TriedEffect& t);
/// Look-alikes that the accuracy of the search cannot tell apart are fitted again with finer rows.
void sharpen_rivals(SearchState& state, std::vector<TriedEffect>& tried, std::size_t winner);
/// The recording that would separate two candidates best, and all that were simulated.
Separation experiment_between(SearchState& state, const TriedEffect& a, const TriedEffect& b);
/// Rivals that all recordings could have told apart are tied by noise, and another recording must be far better than
/// they were. One that no recording could show needs only to be seen.
bool would_tell(const Experiment& experiment, bool hidden);

/// A rival of the step's winner, and the experiment that would tell the two apart. Both stand last in their models.
void add_tie(SearchState& state, int step, FoundStep& found, const TriedEffect& winner, const TriedEffect& rival);
/// Fits the candidate as it is claimed. Where it goes on to, it may no longer be itself (a resonance that rings no
/// more): then it is not admitted, and the answer false.
bool stays_itself(const SearchState& state, TriedEffect& t);
/// Takes the winner into the present model, with its ties and the experiment that would break them.
void claim(SearchState& state, int step, std::vector<TriedEffect>& tried, std::size_t winner,
           const std::vector<int>& ties, double progress);

/// Into the record of what was tried. `winner`, `ties`: indices of tried; -1 = nobody.
void keep_candidates(SearchState& state, const std::vector<TriedEffect>& tried, int step, int winner,
                     const std::vector<int>& ties);

/// What the recordings show at places of the model, with what is free anyway and how the user's model rings.
std::vector<Excitation> circumstances_on(const SearchState& state, const CandidateModel& model,
                                         const std::vector<Place>& places);

/// What a gain and a zero alone take away nearly all of is theirs first, whatever the winner's law holds besides:
/// index of the calibration, or `winner`.
int calibration_first(const std::vector<TriedEffect>& tried, int winner);

/// Of what explains as much as the winner the effect that is plainer goes first (Effect::plainer: a gain that is wrong
/// needs no story, one that changes with use does), though it may need a number more. Its index, or `winner`.
int plainer_first(const std::vector<TriedEffect>& tried, int winner);

/// Could the law describe this effect, or what looks like it, besides its own (Law::holds)?
bool could_hold(const SearchState& state, const Law& law, const Effect& e);
/// What an effect that the winner's law can hold besides its own takes nearly all of away alone is that one's first:
/// its index, or `winner`.
int held_one_first(const SearchState& state, const std::vector<TriedEffect>& tried, int winner);

/// The effect `id`, which stands, on the way to the outputs that it does not move yet: axes are built alike and stand
/// in one room. Each is claimed as a first effect would be there, unless another of those that were `tried` in its step
/// explains that output better, and told as a step of its own.
void on_other_outputs(SearchState& state, const std::string& id, const std::vector<TriedEffect>& tried,
                      double progress);

/// Of the laws of an effect that stands elsewhere the first, and that by which it stands; begun where it does, for one
/// room has one frequency of its mains.
std::vector<Law> laws_as_found(const SearchState& state, const Effect& effect, const std::vector<Law>& laws);

/// All effects that stand on the way to one output on that to another one, together, where none of them suffices alone:
/// if most of what stands above the noise there goes, and nothing of it is needless, each is told as a step of its own.
bool as_a_set_on_another_output(SearchState& state, double progress);

/// Where nobody was admitted in the `first` step and only noise is left: one effect on the ways to several outputs at
/// once, if the recordings speak for all of it together. Each output is told as a step of its own. False if there is
/// none.
bool on_axes_together(SearchState& state, const std::vector<TriedEffect>& first);

/// A law that found the user's zero anew (Effect::moves_zero) may have taken up another effect: every recording that
/// begins at rest has its zero from the sensor. Holds the zero where the user has it and asks for `one_more` effect; if
/// there is none, or only a calibration that the laws could be themselves, all is as before and the answer false.
bool with_the_zero_held(SearchState& state, const std::function<bool()>& one_more);

/// A calibration that was claimed beside another law may be no more than the zero of the curve that came in that law's
/// place. Leaves it to the curve, where that explains as much, and asks for `one_more` effect in its stead: one that
/// explains more than the calibration did; else all is as before and the answer false.
bool with_the_zero_of_a_curve(SearchState& state, const std::function<bool()>& one_more);

/// The fitted candidate becomes the present model, told as a step.
void take(SearchState& state, int step, TriedEffect& w, FoundStep found);
/// How the members of a set were found: each in a step of its own, or together.
enum class Came { one_by_one, at_once };
/// A set that was found one by one need not hold together: what another member has made needless is taken out, and what
/// a look-alike does better beside the others is replaced. The steps are then told anew. Members that came at once were
/// compared with nobody: each is asked, and look-alikes that explain the recordings as well in its place are ties.
/// `before`: the set as it was when it was last asked so; what came since says nothing about a member that shares no
/// output with it.
void reconsider(SearchState& state, double progress, Came came = Came::one_by_one,
                const CandidateModel* before = nullptr);
/// Axes are built alike: a member that stands on another one too is left for an effect that does not only where the
/// error in the outputs' units falls as well.
bool may_leave(const SearchState& state, const PlacedEffect& member, const TriedEffect& other);
/// A law was chosen while others were missing. Each member is tried by its other laws beside the rest; the first that
/// brings something on recordings not used for the fit is taken, and the set told anew. False: all are as they were.
bool refine_what_stands(SearchState& state, double progress);
/// A tie of a step was told while others were missing. Where the question is open in all steps, and only noise is left,
/// a rival that does not explain the recordings as well beside what came later is none any more.
void ties_beside_what_came_later(SearchState& state, double progress);
/// What is left of that where time has ended: a law that could hold another effect besides its own is slow, and beside
/// what came later that other one, alone, may be all of it.
void exchange_for_what_they_hold(SearchState& state, double progress);

/// Where the law that was claimed last can hold another effect's besides its own: a plainer law of the same effect on
/// `before`, and that other one or what looks like it, in its place, if they explain the recordings better.
bool in_two(SearchState& state, CandidateModel before, double progress);

/// Where structure is left: begins with the next best of the first step instead (where nothing was claimed, with the
/// best of those that were patches), one more effect on each, and takes the pair that explains the recordings better
/// than what stands. True if there is one.
bool another_beginning(SearchState& state, const std::vector<TriedEffect>& first);
/// Where structure is left and nobody was admitted in the `last` step: one of its patches and one more effect on it, if
/// both together leave only noise and neither would without the other. True if there are two.
bool two_more(SearchState& state, const std::vector<TriedEffect>& last);
/// Tells the steps of a set anew, from the user's model on. False, and nothing is changed, if a member cannot be had,
/// or is not itself in it.
bool tell_again(SearchState& state, const CandidateModel& set);

/// Where nobody was claimed: who was refused as a patch in the `first` step alone, though chance does not take so much,
/// where nothing is left unexplained that it could be a patch of. True if it is claimed now.
bool no_patch_of_anything(SearchState& state, const std::vector<TriedEffect>& first);
/// Would the verdict on the user's model as it stands, without any effect, be `unexplained`?
bool leaves_something_unexplained(const SearchState& state);

/// Verdict, remainder, words.
void conclude(SearchState& state);

}  // namespace hysteron
