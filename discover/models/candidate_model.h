// Decides what one model of a discovery is: the user's diagram with the effects put in so far, fitted to the train
// recordings. Does not choose between models. Internal to discover.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "discover/hypotheses/effect.h"
#include "discover/models/derivative_store.h"
#include "discover/models/evidence.h"
#include "discover/placement/add.h"
#include "fit/estimate/fit.h"

namespace hysteron {

/// An effect in a candidate's diagram.
struct PlacedEffect {
  const Effect* effect = nullptr;
  Law law;
  Place place;
  std::string name;                        ///< path of its choice
  std::vector<std::string> zeros;          ///< the user's constants that are found anew with it (Effect::moves_zero)
  std::vector<std::string> weights{};      ///< weights of operators that are (Law::reweighs)
  std::map<std::string, double> before{};  ///< of these, what they were without the effect [SI]
  std::shared_ptr<const Excitation> at{};  ///< what was known of the place when it was put there
};

/// A value of one recording alone: the amplitude of a line whose phase is another one in each.
struct RecordingValue {
  std::string path;  ///< "y_mains_interference.cosine[0]"
  int recording = -1;
  double value = 0;  ///< [SI]
};

/// The user's diagram with effects placed in it, fitted or to be fitted, and what it says of the recordings.
struct CandidateModel {
  bool ok = false;
  std::string error;     ///< why not ok
  bool stopped = false;  ///< not ok, for it was broken off before anything was found
  Diagram diagram;       ///< with fitted values
  std::vector<PlacedEffect> placed;
  Added change;  ///< of the last effect
  ProgramPointer program;
  FitResult fit;
  /// Of the rows of the last fit that saw these outputs: what stands needs them beside whatever is added.
  std::map<std::vector<std::string>, std::shared_ptr<const Cuts>> cuts;
  std::vector<RecordingValue> of_recordings;  ///< which no diagram can hold
  /// Where the recordings begin, as DataModel::start_of(), by the state: [recording]. A further effect begins there.
  std::vector<std::map<std::string, double>> starts;
  Prediction prediction;  ///< train and validate recordings
  /// The same before columns round it to their levels, where some do, and as near to what they read as half a level
  /// allows: what was rounded moves in jumps, and whoever happens to move one the right way explains nothing.
  std::optional<Prediction> before_rounding{};
  const Prediction& unrounded() const { return before_rounding ? *before_rounding : prediction; }
  ModelError error_of;  ///< filled in by whoever holds the evidence
  int parameters = 0;   ///< that the effects spend: of their laws, determined and not held at a bound
  long runs = 0;
};

/// Numbers that the user holds, where they are let go: 95 % are as near to what is written as this, and none is
/// further away than that - a device's data sheet and its maker's drawing, not another device.
constexpr double nominal_uncertainty = 0.03, at_most_off = 0.15;

/// How well numbers of the model are known that are let go, as factors of what is written.
struct KnownTo {
  double width = nominal_uncertainty;  ///< 95 % are nearer to one than this
  double least = 1 - at_most_off, most = 1 + at_most_off;
  /// Numbers that are known so many times better (below one) or worse than others, by path.
  std::map<std::string, double> times{};
};

/// What every fit of a discovery shares.
struct FitContext {
  const Registry* registry = nullptr;
  std::shared_ptr<const DataSet> data;
  std::vector<std::string> free_paths;  ///< of the user's, beside those that the diagram declares free
  /// Of these, numbers that the model holds: known roughly as they are written [SI].
  std::map<std::string, double> roughly{};
  KnownTo known_to{};
  /// By which outputs are weighed in a fit, as Evidence::model().outputs(); none: by the noise of the evidence.
  std::optional<NoiseModel> weights{};
  void free_nominal_parameters(const std::map<std::string, double>& numbers);
  const Evidence* evidence = nullptr;
  /// How far a simulated row may be off, as a share of the output's span: a small part of the noise. What is finer
  /// costs time and decides nothing.
  double row_tolerance = 1e-6;
  /// Steps that one simulation may take while candidates are searched: some tenths of a second where states are
  /// nonlinear.
  double simulation_steps = 4e6;
  bool bdf_otherwise = true;  ///< see DataModelOptions
  double looser = 1;          ///< than usual, for what is not simulated in fixed substeps
  Threads threads{};          ///< recordings side by side
  std::shared_ptr<DerivativeStore> derivatives = std::make_shared<DerivativeStore>();
};

/// `part` of the noise of the output that is measured best, as a share of its span.
double row_tolerance(const DataModel& model, const NoiseModel& noise, double part);

/// How much of a candidate is fitted.
enum class Effort {
  screen,  ///< the last effect's law, the user's linear parameters and a calibration; other effects keep their values
  full,    ///< everything
  final    ///< everything, with intervals
};

/// The user's diagram itself.
CandidateModel base_model(const FitContext& context, const Diagram& diagram, Effort effort);
/// `before` with one more effect.
CandidateModel with_effect(const FitContext& context, const CandidateModel& before, const Effect& effect,
                           const Law& law, const Place& place, const Excitation& at, Effort effort);
/// The same model fitted again with more effort, from where it stands.
CandidateModel refit(const FitContext& context, const CandidateModel& candidate, Effort effort);
/// The same model without one of its effects, with the values that were found together with it; not simulated. Not ok
/// where another one stands upon it.
CandidateModel without(const FitContext& context, const CandidateModel& candidate, std::size_t standing);

/// The effect is a straight line: its gain and zero are free whatever else is fitted.
bool calibrates(const PlacedEffect& standing);

/// What is free besides the laws' own parameters: the user's, and gain and zero of a calibration that stands. A gain or
/// zero that is free anyway is no law's.
std::vector<std::string> free_anyway(const FitContext& context, const CandidateModel& candidate);

/// What the candidate says of other recordings, those of the test: values of single recordings are found on them.
Prediction predicted(const FitContext& context, const CandidateModel& candidate, const std::vector<int>& recordings);
/// The same of its train and validate recordings, with the lines of the mains silent and nothing fitted.
Prediction without_lines(const FitContext& context, const CandidateModel& candidate);

/// The parameters of a candidate's effects (`standing` = index, or all of them with -1), with remarks for people.
struct ParameterOfEffect {
  const LawParameter* law = nullptr;
  const ParameterEstimate* estimate = nullptr;
};
std::vector<ParameterOfEffect> parameters_of(const CandidateModel& candidate, int standing = -1);
/// Values [SI] of the parameters of one effect that were estimated, in the order of its law.
std::vector<double> values_of(const CandidateModel& candidate, std::size_t standing);

}  // namespace hysteron
