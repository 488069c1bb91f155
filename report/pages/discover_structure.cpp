#include "report/pages/discover_structure.h"

#include <fmt/format.h>

#include <algorithm>

#include "discover/narrate/words.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

using Intervals = std::vector<std::pair<double, double>>;

constexpr std::size_t times_told = 8;  // of one recording; all stand in result.json

const Intervals* intervals_in(const Structure& s, const std::string& recording) {
  for (const auto& [name, list] : s.intervals)
    if (name == recording && !list.empty()) return &list;
  return nullptr;
}

std::string times_text(const Structure& s, const Intervals& list) {
  std::vector<std::string> times;
  for (std::size_t i = 0; i < std::min(times_told, list.size()); ++i)
    times.push_back(s.kind == "jumps" ? number_text(list[i].second)
                                      : number_text(list[i].first) + " .. " + number_text(list[i].second));
  if (list.size() > times_told) times.push_back(fmt::format("and {} more", list.size() - times_told));
  return fmt::format("{}", fmt::join(times, ", "));
}

Table when_table(const Structure& s, const DataModel& model) {
  Table table;
  table.title = "When";
  table.columns = {"recording", "used", s.kind, "at [s]"};
  for (int r = 0; r < model.n_recordings(); ++r)
    if (const Intervals* list = intervals_in(s, model.recording(r).name))
      table.rows.push_back({model.recording(r).name,
                            model.recording(r).role == Role::train ? "fitted" : "judged (validate)",
                            std::to_string(list->size()), times_text(s, *list)});
  return table;
}

/// The rows of a residual within intervals, as points on its line.
Curve marks(const Structure& s, const Intervals& intervals, const CsvTable& table) {
  Curve curve;
  curve.name = s.kind;
  curve.style = "points";
  const CsvColumn *t = table.find("t"), *residual = table.find(s.output + "_residual");
  if (t == nullptr || residual == nullptr) return curve;
  for (const auto& [from, to] : intervals)
    for (auto row = std::lower_bound(t->values.begin(), t->values.end(), from); row != t->values.end() && *row <= to;
         ++row) {
      curve.x.push_back(*row);
      curve.y.push_back(residual->values[static_cast<std::size_t>(row - t->values.begin())]);
    }
  return curve;
}

bool shows_residual(const Figure& figure, const std::string& output) {
  return std::any_of(figure.curves.begin(), figure.curves.end(),
                     [&](const Curve& c) { return c.y_column == output + "_residual"; });
}

/// The residual of the recording that was not fitted and in which the structure is most often.
void add_residual(Section& section, const Document& document, const Structure& s, const DataModel& model,
                  const std::vector<int>& unseen) {
  const auto recordings = judged_recordings(model);
  std::size_t most = 0, best = recordings.size();
  for (std::size_t i = 0; i < recordings.size() && i < document.traces.size(); ++i) {
    const Intervals* list = intervals_in(s, model.recording(recordings[i]).name);
    const bool drawn = std::find(unseen.begin(), unseen.end(), recordings[i]) != unseen.end();
    if (drawn && list != nullptr && list->size() > most) most = list->size(), best = i;
  }
  if (best == recordings.size()) return;
  const std::string& name = model.recording(recordings[best]).name;
  const auto& outputs = model.outputs();
  const auto output = static_cast<int>(std::find(outputs.begin(), outputs.end(), s.output) - outputs.begin());
  Figure figure;
  figure.title = fmt::format("{}: residual of {}, {} marked", name, s.output, s.kind);
  figure.x_label = "t of " + name + " [s]";
  figure.y_label = axis_text("residual", unit_of_differences(output_unit(model, output)));
  figure.curves.push_back(
      trace_curve(document.traces[best], "t", s.output + "_residual", "residual", "line", "residual"));
  section.figures.push_back(std::move(figure));
  section.figures.back().curves.push_back(marks(s, *intervals_in(s, name), document.traces[best]));
}

}  // namespace

Section structure_section(const Document& document, const Discovery& found, const DataModel& model,
                          const std::vector<int>& unseen) {
  const Structure& s = *found.structure;
  Section section;
  section.title = found.steps.empty() ? "What no effect explains" : "What no effect explains of what is left";
  section.text.push_back(fmt::format("There is structure: {}.", s.sentence));
  for (auto& sentence : structure_sentences(s)) section.text.push_back(std::move(sentence));
  if (Table when = when_table(s, model); !when.rows.empty()) section.tables.push_back(std::move(when));
  add_residual(section, document, s, model, unseen);
  return section;
}

void mark_structure(Section& section, const Discovery& found, const std::string& recording, const CsvTable& table) {
  if (!found.structure) return;
  const Intervals* intervals = intervals_in(*found.structure, recording);
  if (intervals == nullptr) return;
  for (auto& figure : section.figures)
    if (shows_residual(figure, found.structure->output))
      figure.curves.push_back(marks(*found.structure, *intervals, table));
}

}  // namespace hysteron
