// Decides what a DataModel keeps between trials. Internal to fit/: model.cpp, recording_run.cpp and
// substeps.cpp define its functions.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/rowwise/advance.h"
#include "fit/model/model.h"

namespace hysteron {

/// Where the judged rows of one output stand among the instants.
class RowPlaces {
 public:
  RowPlaces() = default;
  /// Row i at instant i.
  explicit RowPlaces(std::size_t rows) : count_(rows) {}
  explicit RowPlaces(std::vector<std::size_t> places) : count_(places.size()), places_(std::move(places)) {}

  bool empty() const { return count_ == 0; }
  std::size_t size() const { return count_; }
  std::size_t operator[](std::size_t row) const { return places_.empty() ? row : places_[row]; }

 private:
  std::size_t count_ = 0;
  std::vector<std::size_t> places_;
};

/// Everything of one recording that does not change from trial to trial, and the workspaces that only it uses.
struct BoundRecording {
  Run run;                      ///< inputs bound, parameters as compiled
  Advance::Instants evaluated;  ///< where the model is evaluated: start of the recording, then all judged instants
  std::vector<RowPlaces> at;    ///< [output][judged row]: index into instants()
  // Where all rows of a recording are judged these are its own.
  std::vector<RowsPointer> measured;  ///< [output][judged row]
  RowsPointer times;
  Advance::Instants rows;          ///< the instants, as the advance knows them again, and what they are cut into
  std::vector<RowCut> pieces;      ///< per instant: how the way to it is cut; empty: nothing is
  std::vector<std::size_t> place;  ///< per instant: index into rows; empty: they are the instants
  int substeps = 1;                ///< of each of the rows
  double points_per_instant = 1;   ///< a run also passes the samples of inputs between the instants
  bool simulated = false;          ///< with these, at the values for which they were chosen
  std::vector<double> start;       ///< per free state: how far from equilibrium it begins [SI]; empty: in equilibrium
  Trial rest_of{};                 ///< of which values `rest` is the equilibrium
  std::optional<Run> rest{};       ///< found last: a prediction and its responses to other starts ask for it in turn
  std::optional<Advance> advance;
  std::vector<std::vector<double>> values;                    ///< workspace: [output][instant]
  std::vector<std::vector<std::vector<double>>> many_values;  ///< the same per trial

  const std::vector<double>& instants() const { return *evaluated; }
  void cut(std::vector<RowCut> into);
  /// What `pieces` would be without `substeps`: each part of a row cut into so many.
  std::vector<RowCut> all_pieces() const;
  /// Of what was computed in every row: the values at the instants.
  void keep_instants(std::vector<std::vector<double>>& computed) const;
};

/// What the choice of substeps found in one recording.
struct SubstepsFound {
  bool suffice = false;    ///< else max_substeps were too few
  bool simulated = false;  ///< at the end
  bool ran_away = false;   ///< some simulation was not finite
};

/// For what substeps were chosen, and what was said of it.
struct SubstepsChosen {
  Trial values;
  std::vector<double> noise;
  std::vector<std::string> remarks;
};

struct DataModel::Content {
  ProgramPointer program;
  std::shared_ptr<const DataSet> data;
  DataModelOptions options;
  std::vector<std::string> outputs;
  std::vector<int> signals;
  std::vector<Unit> units;
  std::vector<BoundRecording> bound;
  std::string not_exact;
  bool substeps_chosen = false;
  std::optional<SubstepsChosen> substeps_chosen_at;  ///< by the last choice that began at one
  int failed_choices = 0;                            ///< of substeps, at values where a recording cannot be simulated
  bool needs_substeps = false;
  std::vector<std::string> free_states, remarks;
  std::vector<std::size_t> free_state_index;
  std::vector<bool> free_state_is_linear;
  std::vector<double> start_sigma;  // [SI], see DataModel::hold_starts()
  std::vector<double> spans;
  std::atomic<long> runs{0}, failures{0};
  std::atomic<int> main_input{-2};  ///< -2: not known yet

  RowsPointer judged(int r, const std::vector<double>& column) const;

  void find_outputs();
  void bind(int r);
  void bind_rows(int r);
  void bind_late_rows(int r);
  bool judges_rows_as_they_are(const Recording& recording) const;
  void release(BoundRecording& b) const;
  void find_free_states();
  bool settles(int r) const;
  Run begun_at_start(int r, std::span<const ParameterValue> values);
  void move_start(const BoundRecording& b, Run& run) const;
  std::vector<std::vector<Rows>> rows_of_each(BoundRecording& b, std::vector<Run> begun);
  Run in_equilibrium(int r, std::span<const ParameterValue> values);
  Run prepared(int r, std::span<const ParameterValue> values) const;
  void set_start(const Recording& recording, Run& run, double t) const;
  bool from_rest(const Recording& recording) const;
  void simulate_into(BoundRecording& b, Run run, bool at_rest, int substeps, bool cvode) const;
  std::vector<Rows> rows_of(const BoundRecording& b, const std::vector<std::vector<double>>& values) const;
  SubstepsFound choose_substeps(int r, std::span<const ParameterValue> values, std::span<const double> tolerance,
                                bool begun_with_known);
  std::vector<RowCut> cuts_to_begin_with(int r) const;
  void grade(int r, std::span<const ParameterValue> values, const std::vector<Rows>& fine,
             std::span<const double> tolerance);
  std::vector<Rows> one(int r, std::span<const ParameterValue> values, int substeps, bool cvode);
  std::vector<Rows> finer_until_finite(int r, std::span<const ParameterValue> values);
  void predict_one(int r, std::span<const ParameterValue> values, bool with_initial, Prediction& prediction,
                   std::string& error);
  std::vector<std::string> predict_trials(int r, std::span<const Trial> trials, std::vector<Prediction>& predictions);
  void predict_initial(int r, std::span<const ParameterValue> values, Prediction& prediction);
  template <class Job>
  void side_by_side(std::span<const int> recordings, const Job& job) const;
};

}  // namespace hysteron
