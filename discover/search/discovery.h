// Decides what the user is told: which effect is missing, on what evidence, what is left, and what cannot be told.
// Does not read files nor draw: it takes values and returns a value in which every decision can
// be traced.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "discover/experiment/experiment.h"
#include "discover/hypotheses/effect.h"
#include "discover/models/evidence.h"
#include "discover/placement/add.h"
#include "discover/structure/structure.h"
#include "engine/block/kernel.h"
#include "engine/diagram/diagram.h"
#include "fit/estimate/fit.h"
#include "io/data/dataset.h"

namespace hysteron {

enum class Verdict {
  adequate,             ///< no candidate improves other recordings by more than chance, and no structure remains
  missing_effect,       ///< named, with evidence
  not_distinguishable,  ///< something is missing; several effects explain it equally well, and an experiment would tell
  unexplained           ///< structure remains that no known effect takes away
};
enum class Remainder { noise, structured };
std::string to_text(Verdict verdict);      ///< as in result.json: "missing_effect"
std::string to_text(Remainder remainder);  ///< "noise", "structured"

/// A fitted parameter (fit/estimate/fit.h) with what people must know of it.
struct FoundParameter {
  ParameterEstimate estimate;  ///< value, interval, unit; no value where the data do not determine it
  std::string remark;          ///< "more than 0.5 ms, which is unusual", "held at its bound" ... or ""
  std::string usual{};         ///< "8 us .. 0.5 ms", "at most 0.5 ms", or "" where nothing is known to be unusual
};

/// One law of a candidate, in units of the noise as it was known when its laws were compared.
struct TriedLaw {
  std::string law;
  int parameters = 0;                        ///< as Candidate::parameters
  double fall_train = 0, fall_validate = 0;  ///< of chi2 against the model before
  std::vector<double> fall_by_recording;     ///< the same in each of ModelError::recordings
  double score = 0;                          ///< as Candidate::score
  bool taken = false, failed = false;
  std::string reason;  ///< why it was not taken; "" if it was
};

/// One effect tried at one place with one law, refitted together with what the user left free and with the effects
/// found before.
struct Candidate {
  std::string effect, title, law, place;  ///< place as for --at
  std::vector<std::string> also_at{};     ///< like places where it acts, too
  std::vector<std::string> same_places;   ///< further places that no experiment can tell from this one
  std::vector<std::string>
      same_effects;    ///< further effects that are the same there ("sensor_lag" for "amplifier_lag")
  int step = 1;        ///< 1 = tried on the base, 2 = on top of the first finding ...
  int parameters = 0;  ///< free parameters that it spends (those not at a bound)
  double fall_train = 0, fall_validate = 0;  ///< of chi2 against the model before, in units of the noise
  double score = 0;                          ///< above that of the model before (selection/block_score.h)
  double share_removed = 0;                  ///< of the validation excess over the noise
  ModelError error;
  std::vector<FoundParameter> found;
  std::vector<TriedLaw> laws_tried;  ///< all of them, the simplest first
  bool claimed = false, failed = false;
  std::string summary;    ///< what the fitted law says: "1.5 % of the move per decade ..."
  std::string plausible;  ///< what its numbers usually are, with the source: one sentence per parameter
  std::string reason;     ///< why it was claimed, or why not, in a sentence
  long model_runs = 0;
};

/// An effect that this data cannot show, or that has no place.
struct Refused {
  std::string effect, place;
  std::string reason;  ///< "longest hold 2 s, creep needs 10 s"
};

/// What was claimed in one step.
struct FoundStep {
  Candidate winner;
  std::vector<Candidate> ties;           ///< others that explain the same as well
  bool experiment_would_tell = false;    ///< of the tie
  std::optional<Experiment> experiment;  ///< the one that would separate them best
  Menu menu;                             ///< among which it was chosen
  Added change;                          ///< the diagram after the step, with fitted values
  ModelError before, after;
  std::string sentence;
};

/// Noise of one output, as used for judging.
struct JudgedNoise {
  std::string output;
  Unit unit;
  double white = 0;       ///< [SI] rms
  double one_over_f = 0;  ///< share
  std::string origin;     ///< "data sheet", "estimated from the high band of the residual", ...
  std::string remark;     ///< what the user must be told of it, or ""
};

/// In whose residual a structure was looked for.
enum class LeftBy { base, effects };

/// A generic structure that was looked for, and whether it counted.
struct TriedStructure {
  Structure structure;  ///< without its intervals
  LeftBy left_by = LeftBy::base;
  Where where = Where::validation;  ///< recordings in which it was looked for
  std::optional<double> needed{};   ///< fall of chi2 there that it has to pass; none where another reason decided
  bool told = false;                ///< it is Discovery::structure
  std::string reason;               ///< why it counted, or why not
};

/// An input that moves smoothly between its samples, where the data set says along straight lines.
struct SmoothInput {
  std::string input;
  double before = 0, after = 0;  ///< NRMSE on validation of the model that told it, without and with that
};

/// A number of the user's model that is not what is written there.
struct OtherNumber {
  std::string path;
  Unit unit;
  bool difference = false;
  double written = 0, found = 0, sigma = 0;  ///< [SI]
};

/// How large an effect can be that was looked for and not found, at the place where the recordings allow most of it.
struct EffectLimit {
  std::string effect, place, law;
  std::string parameter;  ///< of that law: "gap"; of several the first
  Unit unit;
  bool difference = false;
  double value = 0;     ///< of the parameter: at most so much, in 95 of 100 cases [SI]
  std::string at_most;  ///< what the law says there
  double sizes = 0;     ///< the same, in sizes with which the law begins
};

/// What a model of a search by models leaves of one column of one recording, as its score reads it (block_score.h).
struct LeftOfColumn {
  std::string recording, output;
  std::size_t rows = 0;
  double scatter = 0;           ///< [SI squared]
  double correlation = 1;       ///< [rows]
  double stated_variance = 0;   ///< of the noise, where the data set says it [SI squared]
  double least_variance = 0;    ///< no instrument is better [SI squared]
  std::vector<double> squares;  ///< sums over as many pieces of equal length [SI squared]
};

/// A row of the table of models that were fitted: all that a score needs, so that others can be tried on it.
struct FittedModel {
  int step = 1;                    ///< of whose round
  std::string effect, place, law;  ///< that it adds to what stood; empty: what stood
  bool numbers_let_go = false;
  bool chosen = false;
  int parameters = 0;
  double ln_tried = 0;  ///< of all that stands
  double moved = 0;     ///< squares of the user's numbers over what is known of them
  std::vector<LeftOfColumn> left;
};

/// Everything that was found.
struct Discovery {
  Verdict verdict = Verdict::adequate;
  Remainder remainder = Remainder::noise;
  std::string headline;                   ///< the answer in one sentence
  std::vector<std::string> sentences;     ///< what matters, most important first
  std::vector<std::string> warnings;      ///< e.g. a single recording: weak evidence
  std::vector<std::string> data_remarks;  ///< what the data checks found
  ModelError as_given;                    ///< the user's diagram as written
  ModelError base;                        ///< after the fit of the user's own free parameters
  std::vector<FoundParameter> base_parameters;
  std::vector<FoundStep> steps;
  std::vector<Candidate> candidates;  ///< everything tried, in order
  std::vector<Refused> refused;
  std::optional<Structure> structure;      ///< strongest structure left, if any stands out
  std::vector<TriedStructure> structures;  ///< all that competed; none where only noise was left
  std::vector<JudgedNoise> noise;
  bool noise_guessed = false;              ///< no data sheet: taken from the residual
  std::optional<Experiment> experiment;    ///< what to record next
  bool broken_off = false;                 ///< by DiscoverOptions::stop: not everything was tried
  std::vector<std::string> asked_for;      ///< DiscoverOptions::only
  std::vector<SmoothInput> smooth_inputs;  ///< all figures are with these (see as_found)
  std::vector<OtherNumber> other_numbers;  ///< the furthest from what is written first; all figures are with these
  std::vector<std::string> found_starts;  ///< recordings that do not begin at rest, by name; all figures are with these
  /// Recordings to fit to do not determine the numbers of what was found, so they were fitted to those to judge, too.
  bool fitted_to_all = false;
  std::vector<EffectLimit> limits;  ///< of what was not found, where only noise is left
  std::vector<FittedModel> table;   ///< where DiscoverOptions::keeps_table asks for it
  Diagram base_diagram, final_diagram;
  ModelError final_error;
  Prediction final_prediction;  ///< of the final model on train and validate recordings, with what is found in each
                                ///< (add_zeros)
  long model_runs = 0;
};

/// On which recordings the error is told: "recordings not used for the fit", where nothing was fitted to these.
std::string judged_on(const Discovery& found);

struct DiscoverOptions {
  int max_steps = 3;                    ///< 1 = diagnose: name the missing effect, do not go on
  std::vector<std::string> only;        ///< effect ids to consider; empty = all
  std::vector<std::string> free_paths;  ///< parameters free beside those that the diagram declares free
  /// What the diagram does not leave free is exact: nobody asks whether other numbers would do.
  bool numbers_are_exact = false;
  /// Candidates are simulated so many times looser (tighter below one) than usual: no answer may hang on it.
  double looser = 1;
  std::function<void(const std::string& what, double done)> progress;  ///< done in 0..1, rough
  bool keeps_table = false;  ///< see Discovery::table; of a search by models only
  /// Asked often, by any thread, once the user's model is simulated; true = end with what was found so far, at once. A
  /// further effect is claimed only where all that could be it were asked.
  std::function<bool()> stop;
  /// Asked likewise: the share of the time to search that is over. From one on nothing new is begun: whether all that
  /// was found is still needed is looked at until `stop`. A fit that takes more than its part of what is left is broken
  /// off there, with what it has found.
  std::function<double()> spent;
  static constexpr double to_search = 0.8;  ///< of a limit of time
  Threads threads{};                        ///< candidates side by side; no answer depends on it
};

/// The data set that the figures of a discovery hold for: as given, but for how inputs move between samples and where
/// recordings begin.
DataSet as_found(DataSet data, const Discovery& found);

}  // namespace hysteron
