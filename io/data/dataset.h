// Decides what a data set is: recordings with roles and circumstances (dataset_read.cpp), bound to the inputs and
// outputs of a diagram (dataset_bind.cpp). Does not simulate. Numbers are SI; units of the files are kept for display.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/diagram/series.h"
#include "engine/diagram/units.h"
#include "engine/program/program.h"

namespace hysteron {

enum class Role { train, validate, test };
std::string to_text(Role role);

/// What is known of the noise of a column [SI]. Absent = not said.
struct NoiseNote {
  std::optional<double> white;       ///< rms
  std::optional<double> resolution;  ///< smallest step (least significant bit)
  std::optional<double> one_over_f;  ///< share: rms of the 1/f part over the white rms
};

/// How a column is meant. A column that is bound to nothing stays available to effects.
struct ColumnNote {
  std::string to;  ///< input or output of the diagram, or the name under which effects find it
  Between between = Between::linear;
  NoiseNote noise;
  bool zero_per_recording = false;  ///< the sensor's zero is arbitrary in each recording
  double delay_seconds = 0;         ///< the column shows the past by this much [s] ...
  int delay_samples = 0;            ///< ... and by this many samples
  bool optional = false;
  std::optional<std::pair<double, double>> limits;  ///< [SI] at and beyond them the column shows no more than that
  bool find_limits = false;                         ///< they are where rows pile up
};

/// One recording, cut to skip..until. Everything in SI.
struct Recording {
  std::string name;  ///< file as listed, made unique: "02.csv", "02.csv (2)"
  std::string file;  ///< full path
  Role role = Role::train;
  double weight = 1;
  std::string remark;
  std::vector<double> t;            ///< [s] times of all rows in the file (the simulation runs through all of them)
  std::size_t first = 0, last = 0;  ///< rows [first, last) are judged (skip, until) ...
  std::vector<bool> left_out{};     ///< ... but for these (exclude, limits); empty: none
  std::map<std::string, std::vector<double>>
      columns;                                   ///< by ColumnNote::to (or file name of the column), one value per row
  std::map<std::string, Unit> units;             ///< of the columns, as in the file
  bool at_rest = true;                           ///< "initial": "rest", or nothing is said
  bool start_is_stated = false;                  ///< "initial" is given
  bool initial_per_recording = false;            ///< "initial": "per_recording"
  std::map<std::string, double> initial_values;  ///< "initial": {"stage.x": "1 um"}
  std::optional<double> start_hours;             ///< [h]
  std::optional<double> cycles_before;

  std::size_t count_judged() const;
  /// What stands in the rows that are judged, of a column or of t.
  std::vector<double> judged(const std::vector<double>& column) const;
};

/// What a data set says of the use before each recording stands there as columns too (one value in all rows), unless
/// the file has a column of that name: cycles, and the hour at which it began.
inline constexpr const char* column_of_cycles = "cycles_before";
inline constexpr const char* column_of_start = "start";

struct DataSet {
  std::string title, file;
  std::map<std::string, ColumnNote> notes;  ///< by ColumnNote::to
  std::vector<Recording> recordings;
  bool single = false;               ///< one recording, cut at 60 % of its time into train and validate
  std::string said_of_cut{};         ///< the remark on that, which means nothing where nobody fits
  std::vector<std::string> remarks;  ///< what the user must be told (e.g. how a single recording was cut)
};

/// Reads a data set file (JSON) or a single CSV. Paths must stay inside the project or in `allowed` folders.
/// A single CSV, and a data set that lists one recording with role train or none, is cut at 60 % of its time. skip and
/// until count from the first row. Rows at which a delayed column would show a time before the recording are not
/// judged. Throws Error: "missing_column", "decreasing_time", "bad_number", "empty_file", "unknown_key" ... naming
/// file, line and cure.
DataSet read_dataset(const std::string& file, const std::vector<std::string>& allowed = {});

/// Cuts one recording in time: its first 60 % train, the rest, as a further recording, validates. It is said in
/// remarks. Throws Error "too_few_rows".
void cut_in_time(DataSet& data, std::size_t recording);

/// Checks that the data set offers what the program's inputs need and at least one of its outputs, with fitting units.
/// Single CSVs bind by name; a time base that does not fit, a missing column, a wrong unit are errors with a cure.
void check_binding(const DataSet& data, const Program& program);

/// The series of one input of the program from a recording (all rows), delayed as its note says. Behind the last time
/// that a delayed input tells of, it holds its last value.
SeriesPointer input_series(const DataSet& data, const Recording& recording, const std::string& input);

/// Instants at which the model must be evaluated for an output of a recording: row times less the column's delay.
/// For rows before the first instant available the value is held (they are not judged).
std::vector<double> output_instants(const DataSet& data, const Recording& recording, const std::string& output);

}  // namespace hysteron
