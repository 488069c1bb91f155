// Decides how a discovery is told: sections, figures, facts, and the files of its folder.
// Does not discover anything.
#include "app/discover_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/discover_facts.h"
#include "app/discover_fall.h"
#include "app/numbers.h"
#include "app/publish.h"
#include "app/rewrite.h"
#include "io/diagram_file.h"

namespace hysteron {
namespace {

/// What the sections need of the data: the models before and after on the same recordings.
struct Seen {
  const Discovery& found;
  const Stages& stages;
  const std::vector<Floor>& floors;
  Unit unit;  ///< of the first output: in which errors over all outputs are shown
};

Section steps_section(const Document& document, const Seen& seen) {
  Section section;
  section.title = seen.found.steps.empty() ? "The error" : "The error, step by step";
  section.figures = waterfalls(seen.found, seen.stages.model(), seen.floors);
  if (seen.found.noise_guessed)
    section.text.emplace_back("The noise is not in the data set: it was estimated from the residual itself.");
  for (const auto& step : seen.found.steps) section.text.push_back(step.sentence);
  add_fall_figures(section, document, seen.found, seen.stages);
  return section;
}

Section parameters_section(const Seen& seen) {
  Section section;
  section.title = "Parameters";
  for (const auto& step : seen.found.steps) {
    const Candidate& c = step.winner;
    if (!c.summary.empty()) section.text.push_back(fmt::format("{}: {}.", c.effect, c.summary));
    if (!c.plausible.empty()) section.text.push_back(fmt::format("What is usual of {}: {}.", c.effect, c.plausible));
  }
  Table table;
  table.columns = {"parameter", "value", "95 % interval", "start", "usual", "remark"};
  const auto add = [&](const FoundParameter& p) {
    const auto& e = p.estimate;
    const auto text = [&](double si) {
      return e.difference ? difference_text(si, e.unit, 5) : quantity_text(si, e.unit, 5);
    };
    const std::string interval = e.low95 && e.high95 ? text(*e.low95) + " .. " + text(*e.high95) : "-";
    table.rows.push_back({e.path, e.value ? text(*e.value) : "not determined by these data", interval, text(e.start),
                          p.usual.empty() ? "-" : p.usual, p.remark});
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

/// Recordings that were not used for the fit come first.
Section errors_section(const Seen& seen) {
  Section section;
  section.title = "Error on each recording";
  Table table;
  table.columns = {"recording", "used",         "output",      "rows",        "RMS before",
                   "RMS after", "NRMSE before", "NRMSE after", "chi2/N after"};
  const auto unit = [&](const std::string& output) {
    const auto& outputs = seen.stages.model().outputs();
    return output_unit(seen.stages.model(),
                       static_cast<int>(std::find(outputs.begin(), outputs.end(), output) - outputs.begin()));
  };
  for (const Role role : {Role::validate, Role::train})
    for (const auto& after : seen.found.final_error.recordings) {
      if (after.role != role) continue;
      const auto& given = seen.found.as_given.recordings;
      const auto before = std::find_if(given.begin(), given.end(), [&](const auto& b) {
        return b.recording == after.recording && b.output == after.output;
      });
      const bool known = before != given.end();
      const Unit u = unit(after.output);
      table.rows.push_back({after.recording, role == Role::train ? "fitted" : "judged (validate)", after.output,
                            std::to_string(after.rows), known ? difference_text(before->rms, u) : "-",
                            difference_text(after.rms, u), known ? percent_text(before->nrmse) : "-",
                            percent_text(after.nrmse),
                            number_text(after.chi2 / static_cast<double>(std::max<std::size_t>(1, after.rows)), 3)});
    }
  section.tables.push_back(std::move(table));
  return section;
}

Section residual_section(const Seen& seen, const std::string& title, const Comparison& comparison) {
  Section section;
  section.title = title;
  section.text.emplace_back("On recordings that were not used for the fit.");
  const Beside view{&seen.stages.model(), &comparison, nullptr, {}};
  add_residual_figures(section, view, seen.stages.unseen());
  add_split_figures(section, seen.stages.model(), comparison);
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

Section change_section(Document& document, const Discovery& found) {
  Section section;
  section.title = "The diagram, before and after";
  add_diagram_pictures(section, document, found);
  section.preformatted = text_diff(diagram_text(found.base_diagram), diagram_text(found.final_diagram));
  section.preformatted_title = "What changes from base.json to final.json";
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

/// The traces of all recordings go into the document, in their order; a section per recording only of those that were
/// not used for the fit.
std::vector<Section> recording_sections(Document& document, const Seen& seen) {
  std::vector<Section> sections;
  const DataModel& model = seen.stages.model();
  const Beside view = seen.stages.beside();
  for (const int r : judged_recordings(model)) {
    document.traces.push_back(recording_table(view, r, trace_file(model.recording(r).name, document.traces)));
    const auto& unseen = seen.stages.unseen();
    if (std::find(unseen.begin(), unseen.end(), r) == unseen.end()) continue;
    Section section;
    section.title = fmt::format("{} ({})", model.recording(r).name, to_text(model.recording(r).role));
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

  const Stages stages(found, std::make_shared<const DataSet>(data));
  const auto floors = floors_of(found, stages.model(), inspected);
  const Seen seen{found, stages, floors, output_unit(stages.model(), 0)};

  const auto recordings = recording_sections(document, seen);
  document.sections.push_back(data_section(found, inspected));
  document.sections.push_back(steps_section(document, seen));
  document.sections.push_back(change_section(document, found));
  document.sections.push_back(parameters_section(seen));
  document.sections.push_back(next_section(found));
  document.sections.push_back(errors_section(seen));
  document.sections.push_back(
      residual_section(seen, "Residual before: where the base model fails", stages.before_unseen()));
  if (!found.steps.empty())
    document.sections.push_back(residual_section(seen, "Residual after: what is left", stages.after_unseen()));
  document.sections.push_back(candidates_section(seen));
  document.sections.insert(document.sections.end(), recordings.begin(), recordings.end());
  add_diagrams(document, found, files.folder);
  const auto& faults = inspected.data.faults;
  document.warnings.insert(document.warnings.end(), faults.begin(), faults.end());
  Facts facts = discovery_facts(found, seen.unit, files.diagram_file, files.data_file);
  facts.set("floor", floor_facts(floors, stages.model()));
  facts.set("inspection", inspection_facts(inspected));
  if (answer != nullptr) facts.set("check", check_facts(*answer));
  document.facts = to_json(facts);
  return document;
}

}  // namespace hysteron
