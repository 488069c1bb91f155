// Decides what is kept of each step of a discovery: what was tried, at which places, with what result.
// Internal to discover; the words are in words.cpp.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "discover/models/candidate_model.h"
#include "discover/search/discovery.h"

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
  double fall_train = 0, fall_validate = 0;  ///< of the evidence, against the model before
  double score = 0;                          ///< of the whole model, above that of the model before
  double share = 0;                    ///< of the excess on validation that it removes, of the outputs that it can move
  bool hidden = false;                 ///< cannot be seen here, may have acted all the same
  std::vector<TriedLaw> laws_tried{};  ///< empty where no second one was
  std::vector<double> fall_by_recording{};  ///< of the evidence, in each of ModelError::recordings
  std::string reason;
};

namespace rules {
constexpr double claim_fall = 10;  ///< of chi2 on validation recordings: less is chance
constexpr double tie = 7;          ///< of a score
constexpr double exchange = 6;     ///< of a score, for which a look-alike is taken instead
/// chi2/N up to which what no structure explains may be noise: as much 1/f noise as white.
constexpr double slow_noise = 2;
constexpr double share_of_rest = 0.6;   ///< of what stands above the noise, that how an input moves has to explain
constexpr double experiment_tells = 1;  ///< rms difference over noise above which an experiment separates two models
constexpr double of_noise = 0.1;   ///< rows of a candidate may be off by this part of the noise while it is searched
constexpr int few_recordings = 4;  ///< so few of one kind may just have been too slow
}  // namespace rules

/// Of the evidence, in each of ModelError::recordings.
std::vector<double> fall_by_recording(const ModelError& before, const ModelError& after);

/// More than a claim needs goes in recordings of both roles.
inline bool falls_in_both_roles(const ModelError& now, const ModelError& was) {
  return was.evidence_train - now.evidence_train > rules::claim_fall &&
         was.evidence_validate - now.evidence_validate > rules::claim_fall;
}

/// Why it is claimed: what it takes away on the recordings to judge (judged_on()).
std::string what_it_takes(const TriedEffect& tried, const std::string& judged_on);

/// Why the effect that stands at this index is not itself, though it may fit (Effect::implausible); "" = it is.
std::string why_implausible(const CandidateModel& fitted, std::size_t standing);

/// True if `a` and `b` are effects that can be taken for each other (either names the other).
bool look_alike(const Effect& a, const Effect& b);

std::string percent(double share);
std::vector<FoundParameter> found_parameters(const CandidateModel& c, const Excitation& at);
Candidate candidate_of(const TriedEffect& tried, int step);
/// "hysteresis behind u: a loop of about 14 % ...; error on validation 18.3 % -> 3.5 %"; each output in its own unit.
std::string step_sentence(const FoundStep& step, const Effect& effect, const std::string& judged_on);
/// Of the effect that stands at this index, with the values of the whole model; "" where its law says nothing.
std::string summary_of(const CandidateModel& c, std::size_t standing, const Excitation& at);
/// Headline, sentences, warnings of the finished discovery.
void put_into_words(Discovery& d, const DataSet& data);

}  // namespace hysteron
