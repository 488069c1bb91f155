// Decides how a discovery answers a case of hidden effects. See hidden_answer.h.
#include "benchmarks/hidden_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/diagram/diagram_file.h"
#include "io/files/atomic_file.h"

namespace hysteron {
namespace {

using nlohmann::json;

void add_name(std::vector<std::string>& list, const std::string& name) {
  if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
}

/// As the recordings have it.
Unit file_unit(const DataSet& data, const std::string& column) {
  for (const auto& r : data.recordings)
    if (const auto found = r.units.find(column); found != r.units.end()) return found->second;
  return {};
}

/// Recordings are listed by their full paths; the answer names files.
std::string file_name(const std::string& recording) { return std::filesystem::path(recording).filename().string(); }

/// The README's letters: axes are not told apart ("y2" is "y").
std::string letter(const std::string& variable) { return variable.substr(0, 1); }

json location_of(const Structure& s, const DataSet& data) {
  json location;
  location["variable"] = letter(s.variable);
  const Unit unit = s.variable == "t" ? parse_unit("s") : file_unit(data, s.variable);
  if (s.period > 0) location["period"] = unit.difference_from_si(s.period);
  if (s.has_threshold) location["threshold"] = unit.from_si(s.threshold);
  if (!s.has_threshold)
    for (const auto& [recording, list] : s.intervals) location["intervals"][file_name(recording)] = list;
  return location;
}

/// One CSV per validate recording; returns the rms over all rows and outputs, in the unit of the recordings.
double write_predicted(const HiddenCase& hidden, const DataSet& data, const Discovery& found,
                       const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  double squares = 0, rows = 0;
  const auto names = hidden.diagram.outputs.names();
  for (std::size_t r = 0; r < data.recordings.size(); ++r) {
    const Recording& recording = data.recordings[r];
    if (recording.role != Role::validate) continue;
    std::string text = fmt::format("t [s],{}\n", fmt::join(hidden.outputs, ","));
    for (std::size_t k = recording.first; k < recording.last; ++k) {
      text += fmt::format("{:.9g}", recording.t[k]);
      for (std::size_t o = 0; o < names.size(); ++o) {
        const Unit unit = file_unit(data, names[o]);
        const double predicted = unit.from_si(found.final_prediction.y.at(r).at(o).at(k - recording.first));
        const double measured = unit.from_si(recording.columns.at(names[o])[k]);
        squares += (measured - predicted) * (measured - predicted);
        rows += 1;
        text += fmt::format(",{:.10g}", predicted);
      }
      text += "\n";
    }
    write_file((folder / file_name(recording.name)).string(), text);
  }
  return rows > 0 ? std::sqrt(squares / rows) : 0;
}

}  // namespace

std::vector<std::string> ranked_effects(const Discovery& found) {
  std::vector<std::string> names;
  for (const auto& s : found.steps) add_name(names, s.winner.effect);
  for (const auto& s : found.steps)
    for (const auto& t : s.ties) add_name(names, t.effect);
  std::vector<const Candidate*> rest;
  for (const auto& c : found.candidates)
    if (c.step == 1 && !c.failed) rest.push_back(&c);
  std::stable_sort(rest.begin(), rest.end(),
                   [](const Candidate* a, const Candidate* b) { return a->score < b->score; });
  for (const Candidate* c : rest) add_name(names, c->effect);
  return names;
}

void write_hidden_answer(const HiddenCase& hidden, const DataSet& data, const Discovery& found, double seconds,
                         const std::string& results) {
  const std::filesystem::path folder(results);
  const auto names = hidden.diagram.outputs.names();
  const Unit unit = file_unit(data, names.front());
  json answer;
  answer["verdict"] = to_text(found.verdict);
  const bool names_effects = found.verdict == Verdict::missing_effect || found.verdict == Verdict::not_distinguishable;
  answer["effects"] = names_effects ? ranked_effects(found) : std::vector<std::string>{};
  // An effect at two places (each axis couples into the other) is one name.
  std::vector<std::string> claimed;
  for (const auto& step : found.steps) add_name(claimed, step.winner.effect);
  answer["claimed"] = names_effects ? claimed.size() : 0;
  if (found.verdict == Verdict::unexplained && found.structure)
    answer["location"] = location_of(*found.structure, data);
  if (found.verdict == Verdict::not_distinguishable && found.experiment)
    answer["next_experiment"] = found.experiment->word;
  answer["validation_rms_before"] = unit.difference_from_si(found.as_given.rms_validate);
  answer["validation_rms_after"] = write_predicted(hidden, data, found, folder / (hidden.id + ".predicted"));
  answer["predicted"] = hidden.id + ".predicted";
  answer["diagram"] = hidden.id + ".diagram.json";
  answer["headline"] = found.headline;
  answer["seconds"] = seconds;
  write_diagram((folder / (hidden.id + ".diagram.json")).string(), found.final_diagram);
  write_file((folder / (hidden.id + ".json")).string(), answer.dump(1) + "\n");
  if (found.smooth_inputs.empty()) return;
  auto told = json::parse(hidden.data_text);
  for (const auto& s : found.smooth_inputs) told["columns"][s.input]["between_samples"] = to_text(Between::smooth);
  write_file((folder / (hidden.id + ".data.json")).string(), told.dump(1) + "\n");
}

}  // namespace hysteron
