// Decides how a discovery is told: sections, figures, facts, and the files of its folder.
// Does not discover anything.
#include "app/discover_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/curves.h"
#include "app/discover_facts.h"
#include "app/load.h"
#include "app/numbers.h"
#include "app/publish.h"
#include "app/rewrite.h"
#include "io/diagram_file.h"

namespace hysteron {
namespace {

/// What the sections need of the data: the models before and after on the same recordings.
struct Seen {
  const Discovery& found;
  const DataModel& model;  ///< bound to the final diagram
  const Comparison& after;
  const Comparison& before;
  Unit unit;  ///< of the first output: in which errors over all outputs are shown
};

std::string step_name(const FoundStep& step) {
  std::string name = step.winner.effect;
  for (const auto& same : step.winner.same_effects) name += " / " + same;
  for (const auto& tie : step.ties) name += " or " + tie.effect;
  return name;
}

/// Validation error where there are validate recordings, else what there is.
double judged_rms(const ModelError& error) { return error.n_validate > 0 ? error.rms_validate : error.rms_train; }
double judged_nrmse(const ModelError& error) { return error.n_validate > 0 ? error.nrmse_validate : error.nrmse_train; }

Figure waterfall(const Seen& seen) {
  Figure figure;
  figure.kind = "waterfall";
  figure.title = "Error on recordings that were not fitted, step by step";
  figure.y_label = axis_text("RMS", seen.unit);
  const auto bar = [&](const std::string& label, const ModelError& error, const std::string& role) {
    const double rms = judged_rms(error);
    figure.bars.push_back({label, seen.unit.difference_from_si(rms),
                           fmt::format("{} ({})", difference_text(rms, seen.unit), percent_text(judged_nrmse(error))),
                           role});
  };
  const Discovery& found = seen.found;
  bar("as given", found.as_given, "before");
  // A refit of the user's own parameters is a step of its own only where there were any.
  if (!found.base_parameters.empty()) bar("own parameters fitted", found.base, "");
  for (const auto& step : found.steps) bar("+ " + step_name(step), step.after, "");
  if (figure.bars.size() > 1) figure.bars.back().role = "after";
  double floor = 0;
  for (const auto& noise : found.noise) floor += noise.white * noise.white * (1 + noise.one_over_f * noise.one_over_f);
  floor = found.noise.empty() ? 0 : std::sqrt(floor / static_cast<double>(found.noise.size()));
  if (floor > 0)
    figure.bars.push_back(
        {"noise of the sensor", seen.unit.difference_from_si(floor), difference_text(floor, seen.unit), "floor"});
  figure.log_y = judged_rms(found.as_given) > 20 * judged_rms(found.final_error);
  if (found.noise_guessed)
    figure.caption = "The noise is not in the data set: it was estimated from the residual itself.";
  return figure;
}

/// The recording on which the base model was worst, among those that no fit has seen where there are such.
int most_telling(const Seen& seen) {
  int best = -1;
  double largest = -1;
  const auto validate = seen.model.recordings(Role::validate);
  for (const int r : validate.empty() ? judged_recordings(seen.model) : validate) {
    const Metrics* m = seen.before.find(r, 0);
    if (m != nullptr && m->rms > largest) {
      largest = m->rms;
      best = r;
    }
  }
  return best;
}

/// Before and after on the same axes, on the most telling recording; the others stand further down.
void add_telling_figures(Section& section, const Document& document, const Seen& seen) {
  const int r = most_telling(seen);
  const auto recordings = judged_recordings(seen.model);
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    if (recordings[i] != r || seen.found.steps.empty()) continue;
    Section figures;
    add_time_figures(figures, {&seen.model, &seen.after, &seen.before}, document.traces[i]);
    for (auto& figure : figures.figures) {
      figure.title += ", " + seen.model.recording(r).name;
      section.figures.push_back(std::move(figure));
    }
  }
}

Section steps_section(const Document& document, const Seen& seen) {
  Section section;
  section.title = seen.found.steps.empty() ? "The error" : "The error, step by step";
  section.figures.push_back(waterfall(seen));
  for (const auto& step : seen.found.steps) section.text.push_back(step.sentence);
  add_telling_figures(section, document, seen);
  return section;
}

Section parameters_section(const Seen& seen) {
  Section section;
  section.title = "Parameters";
  for (const auto& step : seen.found.steps)
    if (!step.winner.summary.empty())
      section.text.push_back(fmt::format("{}: {}.", step.winner.effect, step.winner.summary));
  Table table;
  table.columns = {"parameter", "value", "95 % interval", "start", "remark"};
  const auto add = [&](const FoundParameter& p) {
    const auto& e = p.estimate;
    const auto text = [&](double si) {
      return e.difference ? difference_text(si, e.unit, 5) : quantity_text(si, e.unit, 5);
    };
    const std::string interval = e.low95 && e.high95 ? text(*e.low95) + " .. " + text(*e.high95) : "-";
    table.rows.push_back(
        {e.path, e.value ? text(*e.value) : "not determined by these data", interval, text(e.start), p.remark});
  };
  const auto& last = seen.found.steps.empty() ? seen.found.base_parameters : seen.found.steps.back().winner.found;
  for (const auto& p : last) add(p);
  if (table.rows.empty())
    section.text.emplace_back("Nothing was free.");
  else
    section.tables.push_back(std::move(table));
  return section;
}

Section candidates_section(const Seen& seen) {
  Section section;
  section.title = "What was tried";
  section.text.emplace_back(
      "Each candidate was fitted, together with everything that was free, on the train recordings. The fall of chi2 is "
      "counted "
      "in units of the noise: chance alone reaches a few. The score is chi2 on train and validate plus p ln N; lower "
      "is better.");
  Table table;
  table.columns = {"step",  "effect",        "law", "place", "p", "chi2 fall, train", "chi2 fall, validate",
                   "score", "RMS, validate", "why"};
  for (const auto& c : seen.found.candidates)
    table.rows.push_back({std::to_string(c.step), c.effect, c.law, c.place, std::to_string(c.parameters),
                          c.failed ? "-" : number_text(c.fall_train), c.failed ? "-" : number_text(c.fall_validate),
                          c.failed ? "-" : number_text(c.score, 6),
                          c.failed ? "-" : difference_text(judged_rms(c.error), seen.unit), c.reason});
  section.tables.push_back(std::move(table));
  if (!seen.found.refused.empty()) {
    Table refused;
    refused.title = "What these data cannot show";
    refused.columns = {"effect", "place", "why"};
    for (const auto& r : seen.found.refused) refused.rows.push_back({r.effect, r.place, r.reason});
    section.tables.push_back(std::move(refused));
  }
  return section;
}

Section errors_section(const Seen& seen) {
  Section section;
  section.title = "Error on each recording";
  Table table;
  table.columns = {"recording", "role",         "output",      "rows",        "RMS before",
                   "RMS after", "NRMSE before", "NRMSE after", "chi2/N after"};
  for (const auto& after : seen.found.final_error.recordings) {
    const auto before =
        std::find_if(seen.found.as_given.recordings.begin(), seen.found.as_given.recordings.end(),
                     [&](const auto& b) { return b.recording == after.recording && b.output == after.output; });
    const bool known = before != seen.found.as_given.recordings.end();
    table.rows.push_back({after.recording, to_text(after.role), after.output, std::to_string(after.rows),
                          known ? difference_text(before->rms, seen.unit) : "-", difference_text(after.rms, seen.unit),
                          known ? percent_text(before->nrmse) : "-", percent_text(after.nrmse),
                          number_text(after.chi2 / static_cast<double>(std::max<std::size_t>(1, after.rows)), 3)});
  }
  section.tables.push_back(std::move(table));
  return section;
}

Section residual_section(const Seen& seen, const std::string& title, const Comparison& comparison) {
  Section section;
  section.title = title;
  const Beside view{&seen.model, &comparison, nullptr};
  add_residual_figures(section, view, judged_recordings(seen.model));
  add_split_figures(section, seen.model, comparison);
  return section;
}

Section data_section(const Discovery& found, const Inspected& inspected) {
  Section section = inspection_section(inspected);
  section.text.insert(section.text.end(), found.data_remarks.begin(), found.data_remarks.end());
  Table table;
  table.title = "Noise, as it was judged";
  table.columns = {"output", "white noise, rms", "1/f share", "from", "remark"};
  for (const auto& n : found.noise)
    table.rows.push_back(
        {n.output, difference_text(n.white, n.unit), number_text(n.one_over_f, 3), n.origin, n.remark});
  section.tables.push_back(std::move(table));
  return section;
}

Section change_section(const Discovery& found) {
  Section section;
  section.title = "The diagram's change";
  section.preformatted = text_diff(diagram_text(found.base_diagram), diagram_text(found.final_diagram));
  section.preformatted_title = "final.json";
  if (section.preformatted.empty()) section.text.emplace_back("Nothing was added.");
  return section;
}

Section next_section(const Discovery& found) {
  Section section;
  section.title = "What to record next";
  const auto say = [&](const Experiment& e) {
    section.text.push_back(fmt::format("{}: {} It would set {} apart by {} times the noise.", e.word, e.text, e.between,
                                       number_text(e.separation, 3)));
  };
  if (found.experiment)
    say(*found.experiment);
  else
    section.text.emplace_back("No experiment is needed to separate what was found.");
  return section;
}

/// One section per recording; their traces go into the document at once, in the order of the recordings.
std::vector<Section> recording_sections(Document& document, const Seen& seen) {
  std::vector<Section> sections;
  const Beside view{&seen.model, &seen.after, &seen.before};
  for (const int r : judged_recordings(seen.model)) {
    Section section;
    section.title = fmt::format("{} ({})", seen.model.recording(r).name, to_text(seen.model.recording(r).role));
    document.traces.push_back(recording_table(view, r, trace_file(seen.model.recording(r).name, document.traces)));
    add_time_figures(section, view, document.traces.back());
    sections.push_back(std::move(section));
  }
  return sections;
}

/// Every step's diagram, and the last one as final.json, as seen from the folder of results.
void add_diagrams(Document& document, const Discovery& found, const std::string& folder) {
  NestedDiagrams nested;  // those that changed, of all steps
  document.files.emplace_back("base.json", text_in_folder(found.base_diagram, folder, "base.json"));
  for (std::size_t i = 0; i < found.steps.size(); ++i) {
    const auto& change = found.steps[i].change;
    nested.insert(nested.end(), change.nested.begin(), change.nested.end());
    for (const auto& part : change.parts)  // an effect that enters twice is one file
      if (std::none_of(nested.begin(), nested.end(), [&](const auto& n) { return n.first == part.first; }))
        nested.push_back(part);
    const std::string name = fmt::format("step{}_{}.json", i + 1, change.effect);
    document.files.emplace_back(name, text_in_folder(change.diagram, folder, name, nested));
  }
  document.files.emplace_back("final.json", text_in_folder(found.final_diagram, folder, "final.json", nested));
  for (const auto& [written, content] : nested)
    document.files.emplace_back(name_in_folder(written),
                                text_in_folder(content, folder, name_in_folder(written), nested));
}

Comparison comparison_of(const Diagram& diagram, const std::shared_ptr<const DataSet>& data, DataModel*& kept,
                         std::vector<std::unique_ptr<DataModel>>& models) {
  models.push_back(std::make_unique<DataModel>(compile_file(diagram), data));
  kept = models.back().get();
  const auto recordings = judged_recordings(*kept);
  const Judge judge(*kept, noise_before_fit(*kept));
  return compare(*kept, judge, kept->predict({}, recordings), recordings);
}

}  // namespace

Document discovery_document(const std::string& verb, const Discovery& found, const DataSet& data,
                            const Inspected& inspected, const DiscoveryFiles& files, const Check* answer) {
  Document document;
  document.verb = verb;
  document.title = found.base_diagram.title;
  document.headline = answer != nullptr ? answer->sentence : found.headline;
  document.verdict = to_text(found.verdict);
  document.sentences = found.sentences;
  document.warnings = found.warnings;

  const auto shared = std::make_shared<const DataSet>(data);
  std::vector<std::unique_ptr<DataModel>> models;
  DataModel *base = nullptr, *final_model = nullptr;
  const Comparison before = comparison_of(found.base_diagram, shared, base, models);
  const Comparison after = comparison_of(found.final_diagram, shared, final_model, models);
  const Seen seen{found, *final_model, after, before, output_unit(*final_model, 0)};

  const auto recordings = recording_sections(document, seen);
  document.sections.push_back(data_section(found, inspected));
  document.sections.push_back(steps_section(document, seen));
  document.sections.push_back(errors_section(seen));
  document.sections.push_back(residual_section(seen, "Residual before: where the base model fails", before));
  if (!found.steps.empty()) document.sections.push_back(residual_section(seen, "Residual after: what is left", after));
  document.sections.push_back(parameters_section(seen));
  document.sections.push_back(next_section(found));
  document.sections.push_back(change_section(found));
  document.sections.push_back(candidates_section(seen));
  document.sections.insert(document.sections.end(), recordings.begin(), recordings.end());
  add_diagrams(document, found, files.folder);
  const auto& faults = inspected.data.faults;
  document.warnings.insert(document.warnings.end(), faults.begin(), faults.end());
  Facts facts = discovery_facts(found, seen.unit, files.diagram_file, files.data_file);
  facts.set("inspection", inspection_facts(inspected));
  if (answer != nullptr) facts.set("check", check_facts(*answer));
  document.facts = to_json(facts);
  return document;
}

}  // namespace hysteron
