// Decides what the model says at exactly the measured instants: a compiled program bound to a data set.
// Units of parameters: parameter_unit.cpp. Does not judge (score.h) and does not search parameters (fit.h).
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/program/program.h"
#include "fit/numerics/threads.h"
#include "io/data/dataset.h"

namespace hysteron {

/// One number of a program and the value that a simulation shall use [SI].
struct ParameterValue {
  int parameter = -1;  ///< index into Program::parameters
  double value = 0;    ///< [SI]
  int recording = -1;  ///< in this recording only; -1: in all

  bool operator==(const ParameterValue&) const = default;
};
/// What one simulation uses; of two values for the same number the later one counts.
using Trial = std::vector<ParameterValue>;

/// Rows of one output on one recording, or of one response; only judged rows [first, last).
using Rows = std::vector<double>;
using RowsPointer = std::shared_ptr<const Rows>;

/// What the model says. A simulation that fails is a value: the candidate is lost, never the fit.
struct Prediction {
  bool ok = true;
  std::string error{};                 ///< of the first recording that failed, with its name
  std::vector<std::vector<Rows>> y{};  ///< [recording][output] [SI]; empty for recordings that were not asked for
  /// [recording][initial state][output]: response to one unit of each initial state that is free per recording.
  std::vector<std::vector<std::vector<Rows>>> initial{};
  std::vector<double> initial_sigma{};  ///< of these states: DataModel::hold_starts()
};

/// How the way to a row is cut: into parts of one length, or, where `per_octave` is not 0, into so many to each
/// doubling of the time since the row before, the first as fine as if all were of one length.
struct RowCut {
  int into = 1;
  int per_octave = 0;
  int parts() const;
};
using Cuts = std::vector<std::vector<RowCut>>;  ///< [recording][instant]; empty: not cut

struct DataModelOptions {
  Threads threads{};                 ///< recordings side by side; the numbers do not depend on it
  int max_substeps = 64;             ///< per row, in the mean, where rows have to be split at all
  double substep_tolerance = 1e-6;   ///< of the output's span; see choose_substeps
  double substep_share = 0;          ///< of what the model leaves (rms about its mean): no finer than that either
  bool force_cvode = false;          ///< integrate with BDF even where the exact advance would do (cross-check)
  double relative_tolerance = 1e-7;  ///< of BDF
  bool keep_workspaces = true;       ///< else each prediction gives back what it worked with: for one or two of them
  bool bdf_otherwise = true;         ///< where max_substeps do not suffice; else the finest rows are taken as they are
  /// Of a model of the same recordings: where they suffice as they are, no substeps are chosen. A recording that has
  /// another number of rows begins uncut.
  std::shared_ptr<const Cuts> begin_with{};
};

/// A program bound to a data set. Holds everything that stays the same from trial to trial: series, instants, plans.
/// One DataModel per thread; predict() is not const because it reuses its workspaces.
class DataModel {
 public:
  /// Throws Error where the data set does not fit the program (check_binding).
  DataModel(ProgramPointer program, std::shared_ptr<const DataSet> data, DataModelOptions options = {});
  ~DataModel();
  DataModel(DataModel&&) noexcept;
  DataModel& operator=(DataModel&&) noexcept;

  const Program& program() const;
  ProgramPointer program_pointer() const;
  const DataSet& data() const;
  int threads() const;  ///< recordings that it simulates side by side
  int n_recordings() const;
  const Recording& recording(int r) const;
  /// Recordings of these roles, in the order of the data set.
  std::vector<int> recordings(std::span<const Role> roles) const;
  std::vector<int> recordings(Role role) const;

  /// Outputs of the program that the data set has measured; the index is used everywhere as [output].
  const std::vector<std::string>& outputs() const;
  int output_signal(int output) const;
  const Unit& output_unit(int output) const;  ///< in which people see it: as in the recordings
  bool zero_per_recording(int output) const;
  /// Measured values on the judged rows [SI]; empty where this recording lacks the column.
  const Rows& measured(int recording, int output) const;
  /// Times of the judged rows [s] as in the file.
  const Rows& times(int recording) const;
  /// An input of the program at the judged rows [SI].
  Rows input(int recording, int input) const;
  /// The same, without a copy where it is a column of the recording as it stands.
  RowsPointer shared_input(int recording, int input) const;
  /// The input that moves most, relative to its mean size: the one that splits speak of. -1 if there is none.
  int main_input() const;
  /// Largest minus smallest measured value over all recordings [SI].
  double span(int output) const;

  /// "" if the exact advance is used, else why BDF is used.
  const std::string& why_not_exact() const;

  /// Some states are not linear: each step of them costs tens of those that are.
  bool integrates() const;
  /// Some recordings are simulated instant by instant, not many rows at once (Advance::passes_rows).
  bool goes_by_points() const;

  /// Simulates the recordings with these values (all others as compiled). Never throws for a failing simulation.
  /// `with_initial` = false leaves out the responses to initial states that are free per recording.
  Prediction predict(std::span<const ParameterValue> values, std::span<const int> recordings, bool with_initial = true);

  /// The same recordings with each of these trials: one Prediction per trial, as predict() would give it without
  /// responses to initial states.
  std::vector<Prediction> predict_each(std::span<const Trial> trials, std::span<const int> recordings);

  /// Chooses the substeps of each recording at these values: doubled where rows change by more than
  /// max(noise[output] / 1000, substep_tolerance * span, substep_share * residual), until none does. Called by
  /// predict() at its first call with noise 0. `only_finer`: a row keeps its substeps where these values need fewer.
  /// Returns a text for each recording where max_substeps did not suffice.
  std::vector<std::string> choose_substeps(std::span<const ParameterValue> values, std::span<const double> noise = {},
                                           bool only_finer = false);
  int substeps(int recording) const;  ///< of the row that is cut into most
  long steps(int recording) const;    ///< of one simulation: the substeps of all its rows
  Cuts cuts() const;                  ///< that were chosen

  /// Largest difference between the exact advance and BDF on these recordings, per output, over its span. Once per fit.
  std::vector<double> cross_check(std::span<const ParameterValue> values, std::span<const int> recordings);

  /// Names of the states that start free in recordings with `"initial": "per_recording"`.
  const std::vector<std::string>& free_initial_states() const;
  /// The way from some of them to the outputs is not linear: their start is searched (starts.h).
  bool starts_are_searched() const;
  /// How far from equilibrium they begin in this recording [SI], one number each; empty: in equilibrium. What predict()
  /// says of the responses to initial states holds about there.
  const std::vector<double>& start_of(int recording) const;
  void begin_at(int recording, std::vector<double> start);
  /// How far from equilibrium each of the free initial states may be [SI], as one standard deviation; infinity:
  /// anywhere. Empty: all anywhere. Where starts are searched a fit holds them to where they were last found so far.
  void hold_starts(std::vector<double> sigma);
  const std::vector<double>& start_sigma() const;
  /// What the user must be told (a state whose start cannot be estimated linearly ...).
  const std::vector<std::string>& remarks() const;

  long runs() const;      ///< simulations of one recording so far
  long failures() const;  ///< of those, failed

  struct Content;

 private:
  std::unique_ptr<Content> content_;
};

/// Index of a parameter; throws Error "unknown_parameter" with the nearest name.
int parameter_index(const Program& program, const std::string& path);

/// The unit in which people see a parameter: as written; where none was written (a zero, a default) and the block
/// leaves its unit to the wires ("$b/$a"), the one that the wires give it.
Unit parameter_unit(const Program& program, const ParameterInfo& parameter);

}  // namespace hysteron
