// The verb inspect: what a data set is good for, before any model is judged on it.
// Does not inspect itself (fit/inspect/inspection.h, discover/placement/visible.h).
#include <fmt/format.h>

#include <algorithm>

#include "app/cli/answer.h"
#include "app/cli/load.h"
#include "app/cli/shape.h"
#include "app/facts/fact_shapes.h"
#include "app/verbs/starter.h"
#include "engine/diagram/error.h"
#include "report/pages/curves.h"
#include "report/pages/inspection_page.h"
#include "report/pages/loops.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

constexpr char inspect_help[] =
    "Answers: what can these recordings show, and is anything wrong with them. Looks at units and ranges, the clock,\n"
    "lost and repeated rows, clipping of outputs and inputs, the finest step of each column, what the inputs excite\n"
    "(range, band, turns, holds), how well the measurement repeats where something was recorded twice, lines that no\n"
    "input makes, a shift in time - and says of every effect whether these data can show it, and what would.\n\n"
    "Examples:\n"
    "  hysteron inspect lab.csv\n"
    "  hysteron inspect dataset.json --diagram stage.json\n"
    "  hysteron inspect lab.csv --input volts --output disp --json\n\n"
    "With --diagram, a shift in time, interference and the way of an input between its samples are looked for in what\n"
    "the diagram leaves over, its free parameters fitted first, and effects at every place of it. Without, a gain and\n"
    "an offset stand for it, inputs and outputs are told by the columns (u*, y*, x*, T*, what they measure), and it says\n"
    "so.\n"
    "Recordings with the role \"test\" are not looked at: discover reads them once, at its end.\n\n"
    "Writes into the folder: result.json, traces/ (the recording that is shown first), report.html. With --json: prints\n"
    "the facts of result.json, writes nothing unless a folder is named.\n"
    "Exit codes: 0 done, whatever was found; 2 wrong input.";

/// The columns of one recording as a table, as `new` takes it.
CsvTable table_of(const DataSet& data, const Recording& recording) {
  CsvTable table;
  table.file = data.file.empty() ? recording.name : data.file;
  table.columns.push_back({"t", parse_unit("s"), recording.t});
  for (const auto& [name, si] : recording.columns) {
    if (name == column_of_cycles || name == column_of_start) continue;
    const auto unit = recording.units.find(name);
    CsvColumn column{name, unit == recording.units.end() ? Unit{} : unit->second, si};
    for (double& v : column.values) v = column.unit.from_si(v);
    table.columns.push_back(std::move(column));
  }
  return table;
}

/// A column gets the name that the diagram has for it.
void rename(DataSet& data, const std::string& from, const std::string& to) {
  if (from == to) return;
  const auto move = [&](auto& map) {
    if (auto node = map.extract(from)) {
      node.key() = to;
      map.insert(std::move(node));
    }
  };
  move(data.notes);
  if (data.notes.contains(to)) data.notes[to].to = to;
  for (auto& r : data.recordings) {
    move(r.columns);
    move(r.units);
  }
}

struct Subject {
  Diagram diagram;
  DataSet data;
  std::vector<std::string> assumed;
};

/// Gain and offset stand for the diagram that nobody named.
Subject without_diagram(const Arguments& arguments) {
  Subject subject;
  subject.data = read_dataset(arguments.text("data"), arguments.list("--allow"));
  const CsvTable table = table_of(subject.data, subject.data.recordings.front());
  StarterRoles given;
  for (const auto& written : arguments.list("--input")) given.add(given.inputs, "--input", written, table);
  for (const auto& written : arguments.list("--output")) given.add(given.outputs, "--output", written, table);
  std::vector<std::string> guessed;
  const StarterRoles roles = guess_roles(table, given, guessed);
  subject.diagram = make_starter({{&table, subject.data.recordings.front().name}}, roles).diagram;
  for (const auto* list : {&roles.inputs, &roles.outputs})
    for (const auto& name : *list) rename(subject.data, name, roles.name_of(name));
  subject.assumed.push_back(fmt::format(
      "No diagram was named: judged with a gain and an offset from {} to {}{}. Effects that need a block of the diagram (a mass, a hysteresis) were not considered, nor whether an output is a sample late or early, or an input held between its samples; name your diagram with --diagram.",
      fmt::join(roles.inputs, ", "), fmt::join(roles.outputs, ", "), guessed.empty() ? "" : " (told by the columns)"));
  return subject;
}

Subject with_diagram(Arguments arguments, const Watch& watch) {
  Subject subject;
  arguments.set("diagram", {arguments.text("--diagram")});
  arguments.set("--data", {arguments.text("data")});
  subject.diagram = load_diagram(arguments, watch);
  subject.data = load_data(arguments, *compile_file(subject.diagram));
  return subject;
}

/// The first screen: what was driven and what was measured in the recording that is driven furthest, and the loop.
void show_recording(const DataModel& model, Document& document) {
  const auto& inputs = model.program().input_names;
  int furthest = -1;
  double most = -1;
  for (const int r : judged_recordings(model)) {
    double span = 0;
    if (!inputs.empty()) {
      const auto u = model.input(r, 0);
      const auto [low, high] = std::minmax_element(u.begin(), u.end());
      if (low != u.end()) span = *high - *low;
    }
    if (span > most) most = span, furthest = r;
  }
  if (furthest < 0) return;
  const Recording& recording = model.recording(furthest);
  CsvTable table;
  table.file = trace_file(recording.name, document.traces);
  table.columns.push_back({"t", parse_unit("s"), recording.t});
  const auto add = [&](const std::string& name) {
    const auto found = recording.columns.find(name);
    if (found == recording.columns.end()) return false;
    const auto unit = recording.units.find(name);
    CsvColumn column{name, unit == recording.units.end() ? Unit{} : unit->second, found->second};
    for (double& v : column.values) v = column.unit.from_si(v);
    table.columns.push_back(std::move(column));
    return true;
  };
  std::vector<Figure> over_time;
  const auto show = [&](const std::string& name, const char* role) {
    if (!add(name)) return;
    Figure figure;
    figure.title = over_time.empty() ? fmt::format("{}, {}", name, recording.name) : name;
    figure.x_label = "t [s]";
    figure.y_label = axis_text(name, table.columns.back().unit);
    figure.curves.push_back(trace_curve(table, "t", name, name, "line", role));
    over_time.push_back(std::move(figure));
  };
  if (!inputs.empty()) show(inputs.front(), "");
  if (!model.outputs().empty()) show(model.outputs().front(), "measured");
  document.answer = std::move(over_time);
  if (!inputs.empty() && !model.outputs().empty()) {
    const auto &u = inputs.front(), &y = model.outputs().front();
    Figure loop = loop_figure(table, {u, u, u}, {y, y, y});
    if (!loop.curves.empty()) document.answer.push_back(std::move(loop));
  }
  document.traces.push_back(std::move(table));
}

Answer inspect_verb_acts(const Arguments& arguments, const Watch& watch) {
  const bool named = arguments.has("--diagram");
  if (named && (arguments.has("--input") || arguments.has("--output")))
    fail("bad_command_line", arguments.has("--input") ? "--input" : "--output",
         "the diagram says what its inputs and outputs are", "leave out --diagram or this option");
  const Subject subject = named ? with_diagram(arguments, watch) : without_diagram(arguments);
  DataModelOptions options;
  options.threads = 2;
  DataModel model(compile_file(subject.diagram), std::make_shared<const DataSet>(subject.data), options);
  const Inspected seen = inspect_data(subject.diagram, registry(), model, load_effects(arguments), {}, named);

  Facts facts = Facts::object({{"data", arguments.text("data")}});
  if (named) facts.set("diagram", arguments.text("--diagram"));
  facts.set("assumed", subject.assumed);
  facts.set("inspection", inspection_facts(seen));
  Answer answer;
  if (!arguments.json() || arguments.has("-o"))
    answer.folder = arguments.text("-o", stem_of(arguments.text("data")) + ".inspect");
  Document& document = answer.document;
  document.verb = "inspect";
  document.title = subject.data.title.empty() ? stem_of(arguments.text("data")) : subject.data.title;
  document.headline = inspection_headline(seen);
  document.sentences = inspection_sentences(seen);
  document.warnings = seen.data.faults;
  document.warnings.insert(document.warnings.end(), subject.assumed.begin(), subject.assumed.end());
  document.warnings.insert(document.warnings.end(), subject.data.remarks.begin(), subject.data.remarks.end());
  show_recording(model, document);
  document.sections.push_back(inspection_section(seen));
  document.facts = to_json(facts);
  answer.facts = std::move(facts);
  return answer;
}

std::vector<shape::Member> inspect_shape() {
  return shape::published({{"data", shape::text("the data set or the recording")},
                           {"diagram", shape::text("the model that they were judged for"), shape::sometimes},
                           {"assumed", shape::texts("what was guessed")},
                           {"inspection", shape::of_inspection()}},
                          shape::sometimes);
}

}  // namespace

Verb inspect_verb() {
  auto folder = options::output_folder();
  folder.meaning = "where the results go; default: named after the data, e.g. lab.inspect";
  return {"inspect",
          "what recordings can and cannot show, and what is wrong with them",
          inspect_help,
          {{"data", "DATA", "a data set (.json), or one recording (CSV, or a file of an instrument)", true, false},
           {"--diagram", "DIAGRAM.json", "the model that shall be judged on them", false, false},
           {"--input", "COLUMN", "this column drives (else guessed from the names)", false, true},
           {"--output", "COLUMN", "this column was measured (else guessed from the names)", false, true},
           options::effects(),
           folder,
           options::set(),
           options::choose(),
           options::allow()},
          inspect_verb_acts,
          inspect_shape};
}

}  // namespace hysteron
