// Decides how a discovery is told: sections, figures, facts, and the files of its folder.
// Does not discover anything.
#include "report/pages/discover_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/narrate/words.h"
#include "io/diagram/diagram_file.h"
#include "io/diagram/text_diff.h"
#include "io/results/result_diagram.h"
#include "report/pages/discover_facts.h"
#include "report/pages/discover_fall.h"
#include "report/pages/discover_structure.h"
#include "report/pages/loops.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

/// What the sections need of the data: the models before and after on the same recordings.
struct Seen {
  const Discovery& found;
  const Registry& registry;
  const Stages& stages;
  const std::vector<Floor>& floors;
};

const char* use_of(Role role) {
  return role == Role::train ? "fitted" : role == Role::test ? "read once, at the end (test)" : "judged (validate)";
}

/// Over all outputs; of several dimensions the share alone.
std::string judged_error(const ModelError& error) {
  const bool judged = error.n_validate > 0;
  if (error.recordings.empty() || !of_one_dimension(error.recordings))
    return percent_text(judged ? error.nrmse_validate : error.nrmse_train);
  return difference_text(judged ? error.rms_validate : error.rms_train, error.recordings.front().unit);
}

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
    if (!c.plausible.empty()) section.text.push_back(fmt::format("Typical values for {}: {}.", c.effect, c.plausible));
  }
  Table table;
  table.columns = {"parameter", "value", "95 % interval", "start", "usual", "remark"};
  const auto add = [&](const FoundParameter& p) {
    const auto& e = p.estimate;
    const auto text = [&](double si) {
      const auto shown = [&](double x) { return e.difference ? e.unit.difference_from_si(x) : e.unit.from_si(x); };
      const int digits = e.low95 && e.high95 ? digits_within(shown(si), shown(*e.low95), shown(*e.high95)) : 5;
      return e.difference ? difference_text(si, e.unit, digits) : quantity_text(si, e.unit, digits);
    };
    const std::string interval = e.low95 && e.high95 ? text(*e.low95) + " .. " + text(*e.high95) : "-";
    table.rows.push_back({e.path, e.value ? text(*e.value) : "not determined by these data", interval, text(e.start),
                          p.usual.empty() ? "-" : p.usual, p.remark});
  };
  const auto& last = seen.found.steps.empty() ? seen.found.base_parameters : seen.found.steps.back().winner.found;
  for (const auto& p : last) add(p);
  if (table.rows.empty())
    section.text.emplace_back("No parameter was free.");
  else
    section.tables.push_back(std::move(table));
  return section;
}

/// Generic structures, as what they were counted from; their periods and levels stand in result.json.
Table structures_table(const Discovery& found) {
  Table table;
  table.title = "Structures that no effect describes";
  table.columns = {"structure", "over",   "output", "residual of", "judged on",
                   "chi2 fall", "needed", "share",  "named",       "why"};
  for (const auto& s : found.structures)
    table.rows.push_back({s.structure.kind, s.structure.variable, s.structure.output,
                          s.left_by == LeftBy::effects ? "the effects" : "the base model",
                          s.where == Where::all_recordings ? "all recordings" : "validate",
                          number_text(over(s.structure.fall, s.where)), s.needed ? number_text(*s.needed) : "-",
                          percent_text(s.structure.share_removed), s.told ? "yes" : "no", s.reason});
  return table;
}

Section candidates_section(const Seen& seen) {
  Section section;
  section.title = "What was tried";
  const auto& candidates = seen.found.candidates;
  // A search by whole models knows their scores alone.
  const bool with_falls = std::any_of(candidates.begin(), candidates.end(),
                                      [](const auto& c) { return c.fall_train != 0 || c.fall_validate != 0; });
  section.text.push_back(fmt::format(
      "Each candidate was fitted on the train recordings, together with all free parameters. {}The score is chi2 "
      "on train and validate plus p ln N; lower is better.",
      with_falls ? "The fall of chi2 is in units of the noise variance; chance alone reaches a few units. " : ""));
  Table table;
  table.columns = {"step", "effect", "law", "place", "p"};
  if (with_falls) table.columns.insert(table.columns.end(), {"chi2 fall, train", "chi2 fall, validate"});
  table.columns.insert(table.columns.end(), {"score", "error, validate", "why"});
  for (const auto& c : candidates) {
    std::vector<std::string> row{std::to_string(c.step), c.effect, c.law, c.place, std::to_string(c.parameters)};
    if (with_falls)
      for (const double fall : {c.fall_train, c.fall_validate}) row.push_back(c.failed ? "-" : number_text(fall));
    row.push_back(c.failed ? "-" : std::abs(c.score) < 1e4 ? number_text(c.score, 5) : fmt::format("{:.0f}", c.score));
    row.push_back(c.failed ? "-" : judged_error(c.error));
    row.push_back(c.reason);
    table.rows.push_back(std::move(row));
  }
  section.tables.push_back(std::move(table));
  if (!seen.found.structures.empty()) section.tables.push_back(structures_table(seen.found));
  if (!seen.found.limits.empty()) {
    Table limits;
    limits.title = "What was looked for and not found";
    limits.columns = {"effect", "place", "law", "at most (95 %)"};
    for (const auto& l : seen.found.limits) limits.rows.push_back({l.effect, l.place, l.law, l.at_most});
    section.tables.push_back(std::move(limits));
  }
  if (!seen.found.refused.empty()) {
    Table refused;
    refused.title = "What these data cannot show";
    refused.columns = {"effect", "place", "why"};
    for (const auto& r : seen.found.refused) refused.rows.push_back({r.effect, r.place, r.reason});
    section.tables.push_back(std::move(refused));
  }
  return section;
}

/// The error of the same recording and output as the user's diagram stands; null where that was not looked at.
const RecordingError* given_for(const Seen& seen, const RecordingError& after) {
  const auto& given = seen.found.as_given.recordings;
  const auto before = std::find_if(given.begin(), given.end(), [&](const auto& b) {
    return b.recording == after.recording && b.output == after.output;
  });
  return before == given.end() ? nullptr : &*before;
}

/// Recordings that were not used for the fit come first.
Section errors_section(const Seen& seen) {
  Section section;
  section.title = "Error on each recording";
  Table table;
  table.columns = {"recording", "used",         "output",      "rows",        "RMS before",
                   "RMS after", "NRMSE before", "NRMSE after", "chi2/N after"};
  const ModelError& error = seen.found.final_error;
  for (const Role role : {Role::validate, Role::test, Role::train})
    for (const auto& after : role == Role::test ? error.test : error.recordings) {
      if (after.role != role) continue;
      const RecordingError* before = given_for(seen, after);
      table.rows.push_back(
          {after.recording, use_of(role), after.output, std::to_string(after.rows),
           before != nullptr ? difference_text(before->rms, after.unit) : "-", difference_text(after.rms, after.unit),
           before != nullptr ? percent_text(before->nrmse) : "-", percent_text(after.nrmse),
           role == Role::test
               ? "-"
               : number_text(after.chi2 / static_cast<double>(std::max<std::size_t>(1, after.rows)), 3)});
    }
  if (error.nrmse_test) section.text.push_back(test_sentence(error));
  section.tables.push_back(std::move(table));
  return section;
}

Section residual_section(const Seen& seen, const std::string& title, const Comparison& comparison) {
  Section section;
  section.title = title;
  section.text.push_back(fmt::format("On {}.", judged_on(seen.found)));
  const Beside view{&seen.stages.model(), &comparison, nullptr, {}};
  add_residual_figures(section, view, seen.stages.unseen());
  add_split_figures(section, seen.stages.model(), comparison);
  return section;
}

Section data_section(const Discovery& found, const Inspected& inspected) {
  Section section = inspection_section(inspected);
  section.text.insert(section.text.end(), found.data_remarks.begin(), found.data_remarks.end());
  Table table;
  table.title = "Noise of the outputs";
  table.columns = {"output", "white noise, rms", "1/f share", "origin", "remark"};
  for (const auto& n : found.noise)
    table.rows.push_back(
        {n.output, difference_text(n.white, n.unit), number_text(n.one_over_f, 3), n.origin, n.remark});
  section.tables.push_back(std::move(table));
  return section;
}

Section change_section(Document& document, const Seen& seen) {
  const Discovery& found = seen.found;
  Section section;
  section.title = "The diagram, before and after";
  add_diagram_pictures(section, document, found, seen.registry);
  section.preformatted = text_diff(diagram_text(found.base_diagram), diagram_text(found.final_diagram));
  section.preformatted_title = "What changes from base.json to final.json";
  if (section.preformatted.empty()) section.text.emplace_back("Nothing was added.");
  return section;
}

Section next_section(const Discovery& found) {
  Section section;
  section.title = "What to record next";
  std::vector<std::string> untold;
  for (std::size_t i = 0; i < found.steps.size(); ++i)
    if (!found.steps[i].ties.empty() && !found.steps[i].experiment_would_tell)
      untold.push_back(names_of(found.steps, i));
  if (found.experiment)
    section.text.push_back(
        fmt::format("{}: {}{} It would tell {} apart by {} times the noise.{}", found.experiment->word,
                    found.experiment->text, found.experiment->text.ends_with('.') ? "" : ".", found.experiment->between,
                    number_text(found.experiment->separation, 3),
                    found.experiment->another_instrument ? " Without it no input signal does." : ""));
  for (const auto& names : untold)
    section.text.push_back(fmt::format("No simulated experiment tells {} apart.", names));
  for (const auto& s : found.steps)
    if (!s.winner.same_effects.empty())
      section.text.push_back(
          fmt::format("{} and {} look the same in these recordings; the step above names what tells them apart.",
                      s.winner.effect, fmt::join(s.winner.same_effects, ", ")));
  if (found.structure || found.verdict == Verdict::unexplained)
    section.text.push_back(what_to_record(found.structure ? &*found.structure : nullptr));
  if (section.text.empty())
    section.text.emplace_back("No further experiment is needed: nothing else explains these recordings as well.");
  return section;
}

/// Where the user's own diagram failed, as compare says it: three sentences, of several outputs some of each.
std::vector<std::string> where_it_failed(const Seen& seen) {
  constexpr std::size_t sentences = 3;
  std::vector<std::string> list;
  if (seen.found.verdict == Verdict::adequate) return list;
  const auto& outputs = seen.stages.model().outputs();
  const std::size_t each = std::max<std::size_t>(1, sentences / outputs.size());
  for (const auto& of_output : seen.stages.before_unseen().splits) {
    auto told = telling_sentences(of_output.splits);
    told.resize(std::min({told.size(), each, sentences - list.size()}));
    for (const auto& sentence : told)
      list.push_back(fmt::format("{}{}{}.", seen.found.steps.empty() ? "" : "Before: ",
                                 outputs.size() > 1 ? outputs[static_cast<std::size_t>(of_output.output)] + ": " : "",
                                 sentence));
  }
  return list;
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
    add_loop_figures(section, view, document.traces.back());
    mark_structure(section, seen.found, model.recording(r).name, document.traces.back());
    sections.push_back(std::move(section));
  }
  return sections;
}

/// Before and after on the recording, not used for the fit, on which the user's diagram was worst, and how the error of
/// that output fell; where nothing was found, measured and simulated alone.
std::vector<Figure> answer_of(const Document& document, const Seen& seen) {
  Beside view = seen.stages.beside();
  if (seen.found.steps.empty()) view = {view.model, view.now, nullptr, {}};
  auto figures = how_far_figures(view, judged_recordings(seen.stages.model()), document.traces);
  auto falls = waterfalls(seen.found, seen.stages.model(), seen.floors);
  if (figures.empty() || falls.empty()) return figures;
  const std::string output = figures.front().title.substr(0, figures.front().title.find(':'));
  auto fall =
      std::find_if(falls.begin(), falls.end(), [&](const Figure& f) { return f.title.starts_with(output + ":"); });
  if (fall == falls.end()) fall = falls.begin();
  fall->title = output + (seen.found.fitted_to_all ? ": error on recordings to judge" : ": error on unseen recordings");
  if (figures.size() > 2) figures.resize(2);  // over time
  figures.push_back(std::move(*fall));
  return figures;
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

/// What comes before all effects: rows that spoil whatever is found, or a column that is as many samples late at every
/// sample rate, which nothing in a device does. "" = there is no such thing, or it is little of the error.
std::string wrong_in_the_data(const Inspected& inspected) {
  if (const auto& list = inspected.data.spoiling; !list.empty()) return "First of all, " + list.front() + " ";
  constexpr double most = 0.5;  // of the squared error: what is left is less than what the clock of the file makes
  for (const auto& d : inspected.data.delays)
    if (d.kind == DelayKind::samples && d.fall > most) return "First of all, " + d.sentence + ". ";
  return "";
}

}  // namespace

Document discovery_document(const std::string& verb, const Discovery& found, const DataSet& data,
                            const Registry& registry, const Inspected& inspected, const DiscoveryFiles& files,
                            const Check* answer) {
  Document document;
  document.verb = verb;
  document.title = found.base_diagram.title;
  document.headline = wrong_in_the_data(inspected) + (answer != nullptr ? answer->sentence : found.headline);
  document.verdict = to_text(found.verdict);
  document.sentences = found.sentences;
  document.warnings = found.warnings;

  const Stages stages(found, std::make_shared<const DataSet>(data), registry);
  const auto floors = floors_of(found, stages.model(), inspected);
  const Seen seen{found, registry, stages, floors};
  // Behind what each step found, before what is left.
  const auto failed = where_it_failed(seen);
  document.sentences.insert(document.sentences.begin() + static_cast<std::ptrdiff_t>(found.steps.size()),
                            failed.begin(), failed.end());

  const auto recordings = recording_sections(document, seen);
  document.answer = answer_of(document, seen);
  document.sections.push_back(steps_section(document, seen));
  if (found.structure) document.sections.push_back(structure_section(document, found, stages.model(), stages.unseen()));
  document.sections.push_back(change_section(document, seen));
  document.sections.push_back(parameters_section(seen));
  document.sections.push_back(next_section(found));
  document.sections.push_back(data_section(found, inspected));
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
  Facts facts = discovery_facts(found, files.diagram_file, files.data_file);
  facts.set("splits_before", split_facts(stages.model(), stages.before_unseen()));
  if (!found.steps.empty()) facts.set("splits_after", split_facts(stages.model(), stages.after_unseen()));
  facts.set("floor", floor_facts(floors, stages.model()));
  facts.set("inspection", inspection_facts(inspected));
  if (answer != nullptr) facts.set("check", check_facts(*answer));
  document.facts = to_json(facts);
  return document;
}

}  // namespace hysteron
