// Decides whether the columns of a data set fit the inputs and outputs of a program, and at which instants they are
// compared. Does not simulate.
#include "io/data/dataset_bind.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "engine/diagram/error.h"
#include "engine/diagram/name_list.h"
#include "engine/diagram/smooth_series.h"
#include "io/data/recording_file.h"

namespace hysteron {
namespace {

std::vector<std::string> column_names(const Recording& recording) {
  std::vector<std::string> names;
  for (const auto& [name, values] : recording.columns) names.push_back(name);
  return names;
}

std::string unit_name(const Unit& unit) { return unit.text.empty() ? "1" : unit.text; }

class Binder {
 public:
  Binder(const DataSet& data, const Program& program) : data_(data), program_(program) {}

  void check(bool with_outputs) {
    for (const auto& recording : data_.recordings) {
      // The parts of one file have the same columns: told once.
      if (std::find(seen_.begin(), seen_.end(), recording.file) != seen_.end()) continue;
      seen_.push_back(recording.file);
      inputs(recording);
      if (with_outputs) outputs(recording);
    }
    for (const auto& recording : data_.recordings) initial_values(recording);
    if (!problems_.empty()) throw Error(Fault::input, problems_);
  }

 private:
  void add(std::string code, std::string path, std::string what, std::string cure) {
    problems_.push_back({std::move(code), std::move(path), std::move(what), std::move(cure), data_.file, 0});
  }

  void inputs(const Recording& recording) {
    for (std::size_t i = 0; i < program_.input_names.size(); ++i) {
      const std::string& name = program_.input_names[i];
      if (!recording.columns.contains(name)) {
        const auto known = column_names(recording);
        add("missing_column", name,
            fmt::format("{} has no column for the input \"{}\" of the diagram", recording.name, name),
            did_you_mean(name, known) + bracket_hint(name, known) +
                fmt::format(
                    " A column of another name is bound in the data set: \"columns\": {{\"{}\": {{\"to\": \"{}\"}}}}",
                    known.empty() ? "x" : known.front(), name));
        continue;
      }
      fit(recording, name, "input", program_.input_units[i]);
    }
  }

  void outputs(const Recording& recording) {
    bool any = false;
    for (std::size_t i = 0; i < program_.output_names.size(); ++i) {
      const std::string& name = program_.output_names[i];
      if (!recording.columns.contains(name)) continue;
      any = true;
      const auto& signal = program_.signals[static_cast<std::size_t>(program_.output_signals[i])];
      Unit unit = signal.unit;
      if (unit.dimension != signal.dimension) unit = si_unit(signal.dimension);
      fit(recording, name, "output", unit);
    }
    if (any) return;
    if (program_.output_names.empty())
      return add("missing_output", "outputs", "the diagram has no outputs to compare with a measurement",
                 "write \"outputs\": {\"y\": \"stage.displacement\"} into the diagram");
    const std::string& first = program_.output_names.front();
    add("missing_column", first,
        fmt::format("{} has no column for any output of the diagram ({})", recording.name,
                    name_list(program_.output_names)),
        did_you_mean(first, column_names(recording)) + bracket_hint(first, column_names(recording)) +
            fmt::format(
                " A column of another name is bound in the data set: \"columns\": {{\"...\": {{\"to\": \"{}\"}}}}",
                first));
  }

  void fit(const Recording& recording, const std::string& name, const char* kind, const Unit& expected) {
    const Unit& unit = recording.units.at(name);
    if (unit.dimension == expected.dimension) return;
    add("wrong_unit", name,
        fmt::format("column \"{}\" of {} is in [{}], the {} of the diagram in [{}]", name, recording.name,
                    unit_name(unit), kind, unit_name(expected)),
        unit.text.empty()
            ? fmt::format("write the unit into the header of the file, such as {} [{}]", name, unit_name(expected))
            : "correct the unit in the header of the file or in the diagram, or bind another column");
  }

  void initial_values(const Recording& recording) {
    for (const auto& [path, value] : recording.initial_values)
      if (std::find(program_.state_names.begin(), program_.state_names.end(), path) == program_.state_names.end())
        add("unknown_state", path,
            fmt::format("{} gives an initial value to \"{}\", which is no state of the diagram", recording.name, path),
            did_you_mean(path, program_.state_names));
  }

  const DataSet& data_;
  const Program& program_;
  std::vector<std::string> seen_;
  std::vector<Problem> problems_;
};

const ColumnNote& note_of(const DataSet& data, const std::string& name) {
  static const ColumnNote plain;
  const auto found = data.notes.find(name);
  return found == data.notes.end() ? plain : found->second;
}

const std::vector<double>& column_of(const Recording& recording, const std::string& name) {
  const auto found = recording.columns.find(name);
  if (found == recording.columns.end())
    fail("missing_column", name, fmt::format("{} has no column \"{}\"", recording.name, name),
         did_you_mean(name, column_names(recording)));
  return found->second;
}

}  // namespace

void check_binding(const DataSet& data, const Program& program) { Binder(data, program).check(true); }

void check_inputs(const DataSet& data, const Program& program) { Binder(data, program).check(false); }

SeriesPointer input_series(const DataSet& data, const Recording& recording, const std::string& input) {
  const auto& values = column_of(recording, input);
  const ColumnNote& note = note_of(data, input);
  // Row i shows the input as it was `samples` rows and `delay_seconds` before.
  const auto samples = std::min(static_cast<std::size_t>(note.delay_samples), recording.t.size() - 1);
  Series series;
  series.between = note.between;
  series.t.assign(recording.t.begin(), recording.t.end() - static_cast<std::ptrdiff_t>(samples));
  for (double& t : series.t) t -= note.delay_seconds;
  series.v.assign(values.begin() + static_cast<std::ptrdiff_t>(samples), values.end());
  return std::make_shared<const Series>(in_straight_pieces(std::move(series)));
}

std::vector<double> output_instants(const DataSet& data, const Recording& recording, const std::string& output) {
  const ColumnNote& note = note_of(data, output);
  const auto& t = recording.t;
  const auto samples = static_cast<std::size_t>(note.delay_samples);
  std::vector<double> instants(t.size());
  for (std::size_t i = 0; i < t.size(); ++i)
    instants[i] = std::max(t.front(), t[i >= samples ? i - samples : 0] - note.delay_seconds);
  return instants;
}

}  // namespace hysteron
