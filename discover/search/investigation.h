// Decides what is kept of each step of a discovery: what was tried, at which places, with what result.
// Internal to discover; the rules of judging are in judge_step.cpp, the loop in discover.cpp, the words in words.cpp.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "discover/models/candidate_model.h"
#include "discover/search/discover.h"

namespace hysteron {

/// An effect at a place, with the best law tried there.
struct TriedEffect {
  const Effect* effect = nullptr;
  Place place;
  Excitation excitation;
  std::vector<Law> laws;
  std::size_t law = 0;  ///< of laws: the one in `candidate`
  std::vector<std::string> same_places, same_effects;
  int twin = -1;  ///< the same finding, fitted at the other end of its places: index in the list; -1 = none
  std::vector<std::string> outputs;  ///< that the place moves; empty = all
  CandidateModel candidate;
  std::optional<CandidateModel> finished;    ///< with the finest rows and intervals, as it is claimed
  std::optional<ModelError> without_line{};  ///< of CandidateModel::without_line
  double fall_train = 0, fall_validate = 0;  ///< of the evidence, against the model before
  double share = 0;       ///< of the excess on validation that it removes, of the outputs that it can move
  bool admitted = false;  ///< passes the rules of a claim
  bool patch = false;     ///< refused only because it takes too small a share of what stands above the noise
  bool sharp = false;     ///< fitted with the finest rows
  bool hidden = false;    ///< cannot be seen here, may have acted all the same
  std::vector<TriedLaw> laws_tried{};       ///< empty where no second one was
  std::vector<double> fall_by_recording{};  ///< of the evidence, in each of ModelError::recordings
  std::string reason;
};

/// Rules of a claim.
namespace rules {
constexpr double claim_fall =
    10;  ///< validation evidence must fall by this: nothing-hidden cases reached 1.8, true ones start at 14.5
/// Of a weak effect whose score falls by claim_fall in all recordings together: 48 cases with nothing hidden stayed at
/// -4 there, wherever this fell.
constexpr double agreed_fall = 2;
/// Chance takes as much away with that many numbers once in 2000 times: quantiles of chi2 for 1 to 4 of them, to 0.4.
/// The best of n beginnings (frequencies of a mode) has n times as many chances, for 2 ln n more.
inline double by_chance(int numbers, double beginnings) {
  return claim_fall + 2.5 * numbers + 2 * std::log(beginnings);
}
constexpr double moved = 3;  ///< standard deviations from what is written that are told
constexpr double tie = 7;    ///< in evidence + 2p
/// How much more the recordings that judge may show than those that were fitted: what a fit loses then is in `tie`.
constexpr double usual_split = 3;
constexpr double lost_at_most = 0.02;  ///< of its fall, that a candidate is believed to have lost by the fit
constexpr double pieces_tell = 2;      ///< standard deviations: with structure left, less is a tie (Vuong)
constexpr double far_more = 4;         ///< times the squared error above the noise: twice the error is no tie
/// Of the score: who needs fewer numbers for the same goes first, also where a spare one is held at a bound and not
/// counted (a second pole of a lag beside a dead time).
constexpr double alike = 1;
constexpr double idle = 1;      ///< rise of chi2 below which an effect can be switched off without any loss
constexpr double exchange = 6;  ///< fall of the score for which a look-alike is taken instead
/// Standard deviations of chance in one octave of all recordings together, above which a further effect is looked for:
/// 1/f noise of another shape than the whitener's reached 5 in cases with nothing left.
constexpr double octave_gate = 6;
constexpr double data_sheet_wrong =
    1.2;  ///< chi2/N of noise a tenth larger than its data sheet says: as good are these
constexpr double slow_noise =
    2;  ///< chi2/N up to which what no structure explains may be noise: as much 1/f noise as white
constexpr double own_law_left = 0.015;  ///< share of its own effect that a simple law leaves, in rms
/// Change of chi2 per row, of the largest, up to which a candidate does not act in a recording.
constexpr double at_rest = 0.25;
/// The same for a candidate whose law can imitate a standing one's: what that one leaves of its own looks just like it.
constexpr double imitated_left = 0.1;
constexpr double screened_part =
    0.2;  ///< of the least fall of a claim: below, a candidate is not fitted with the others
constexpr double share_of_first =
    0.5;  ///< the first effect removes this share of the excess: listed ones alone 79-100 %, in unlisted cases 0-47 %
/// A straight line takes 97 % of the squares of a parabola over its range away, and less of other curves: who leaves
/// less than a hundredth to a curve is no curve.
constexpr double straight_share = 0.99;
/// A law that can hold a curve besides its loops gets only what the curve alone leaves, where that takes this share:
/// loops of less than a third of the curve, in rms.
constexpr double held_share = 0.9;
/// Part of an uneven density (rms) that plays of a straight drive leave: 14 % of random ones, up to 40 %
/// (benchmarks/hysteresis_laws.py).
constexpr double plain_left = 0.3;
constexpr double share_of_rest = 0.6;  ///< a further effect removes this share of the excess ...
/// What the laws that were found may have left of their own is not counted, where a candidate takes this share of all:
/// as much as a structure must take away to be told.
constexpr double share_of_all = 0.3;
constexpr double share_of_own = 0.75;   ///< ... or this share of it in one train and one validate recording ...
constexpr double share_to_noise = 0.5;  ///< ... where only noise is left behind it, this
constexpr double hardly_shown = 0.1;    ///< of what a structure takes away in all recordings, in those that judge
constexpr double experiment_tells = 1;  ///< rms difference over noise above which an experiment separates two models
constexpr double of_noise = 0.1;   ///< rows of a candidate may be off by this part of the noise while it is searched
constexpr int few_recordings = 4;  ///< with so few, look-alikes get a free gain and offset before they are compared
constexpr double decided =
    0.9;                     ///< share of the excess beyond which only look-alikes are tried by laws that refine none
constexpr int enriched = 3;  ///< names whose richer laws are tried
/// By so many more numbers a law does not come near another effect's that leaves noise only: n of them cost 2n and take
/// away n by chance, sqrt(2n) up or down; to come within a tie of 7 they would need one and a half times that.
constexpr std::size_t too_many_numbers = 15;
}  // namespace rules

/// Of the evidence, in each of ModelError::recordings.
std::vector<double> fall_by_recording(const ModelError& before, const ModelError& after);

/// More than a claim needs goes in recordings of both roles.
inline bool falls_in_both_roles(const ModelError& now, const ModelError& was) {
  return was.evidence_train - now.evidence_train > rules::claim_fall &&
         was.evidence_validate - now.evidence_validate > rules::claim_fall;
}

/// Fills falls, share, admitted and reason. `left_by_laws`: of chi2 in each of ModelError::recordings, what the laws
/// that stand may have left of their own effects; empty = judged as the first effect.
void judge(TriedEffect& tried, const CandidateModel& before, const std::vector<double>& left_by_laws);
/// With what is left without the line that its law looks for (CandidateModel::without_line).
void judge(const Evidence& evidence, TriedEffect& tried, const CandidateModel& before,
           const std::vector<double>& left_by_laws);

/// Is what `effect` takes away of what `before` leaves more than the laws of that one may have left of their own
/// effects?
bool more_than_laws_leave(const Effect& effect, const CandidateModel& before, const ModelError& after,
                          const std::vector<double>& left_by_laws);

/// Does an effect whose law holds a gain and a zero besides its own take more away than these alone, which leave
/// `straight`, and more than the laws that stand may have left?
bool more_than_a_line(const Effect& effect, const CandidateModel& straight, const ModelError& after,
                      const std::vector<double>& left_by_laws);

/// From how many beginnings a law is fitted, the best of which is kept.
double beginnings_of(const Law& law);

/// Fitted values [SI] of the law's free parameters, in their order; shorter if one is not known.
std::vector<double> own_values(const TriedEffect& tried);

/// Why it is claimed: what it takes away on recordings not used for the fit.
std::string what_it_takes(const TriedEffect& tried);

/// Why the effect that was fitted last, by this law, is not itself, though it may fit (Effect::implausible); "" = it
/// is.
std::string why_implausible(const Effect& effect, const Law& law, const CandidateModel& fitted, const Excitation& at);

/// True if `a` and `b` are effects that can be taken for each other (either names the other).
bool look_alike(const Effect& a, const Effect& b);

std::string percent(double share);
std::vector<FoundParameter> found_parameters(const CandidateModel& c, const Excitation& at);
Candidate candidate_of(const TriedEffect& tried, int step);
/// "hysteresis behind u: a loop of about 14 % ...; error on validation 18.3 % -> 3.5 %"; each output in its own unit.
std::string step_sentence(const FoundStep& step, const Effect& effect);
/// Of the effect that stands at this index, with the values of the whole model; "" where its law says nothing.
std::string summary_of(const CandidateModel& c, std::size_t standing, const Excitation& at);
/// Headline, sentences, warnings of the finished discovery.
void put_into_words(Discovery& d, const DataSet& data);

}  // namespace hysteron
