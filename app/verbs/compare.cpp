// The verb compare: how far is the model from the measurement, and where does it fail; of two files of traces, where
// they differ (compare_traces.h).
// Does not fit and does not name effects.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "app/cli/answer.h"
#include "app/cli/load.h"
#include "app/cli/shape.h"
#include "app/facts/fact_shapes.h"
#include "app/verbs/compare_traces.h"
#include "engine/diagram/error.h"
#include "fit/estimate/beginning.h"
#include "fit/estimate/starts.h"
#include "fit/inspect/delay.h"
#include "report/pages/curves.h"
#include "report/pages/loops.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

constexpr char compare_help[] =
    "Answers: how far is the model from the measurement, and WHERE does it fail - when, at which level,\n"
    "on which branch, at which rate. Evaluated at exactly the measured instants; nothing is fitted.\n"
    "Of two files of traces: where do their traces differ by more than a tolerance (docs/compare.md).\n\n"
    "Examples:\n"
    "  hysteron compare stage.json --data lab.csv\n"
    "  hysteron compare stage.json --data dataset.json --set gain=\"11.9 um/V\"\n"
    "  hysteron compare stage.json --data dataset.json --tolerance 5% --tolerance \"0.2 um\"\n"
    "  hysteron compare reference.csv out/traces/signals.csv --tolerance \"y: 2 nm + 0.1 %, 0.1 ms\"\n"
    "  hysteron compare digitized.csv out/traces/signals.csv --over u --pair y=stage --tolerance \"y: 20 nm, 50 "
    "mV\"\n\n"
    "--tolerance makes it a question with a yes or no, judged on the validate recordings together (where\n"
    "there are none, on those that train): a share bounds the NRMSE (rms of the residual over the standard deviation "
    "of the\n"
    "measurement), a quantity bounds the RMS. Of two files: absolute and relative part per point, and how far beside\n"
    "it in time the other may be.\n"
    "Recordings with the role \"test\" are not looked at: discover reads them once, at its end.\n\n"
    "Writes into the folder: result.json, traces/*.csv (one per recording), report.html.\n"
    "Exit codes: 0 done (and within the tolerances), 1 outside a tolerance, 2 wrong input, 3 the simulation failed.";

struct Tolerance {
  std::string written;
  bool is_share = true;  ///< of NRMSE; else RMS [SI]
  double limit = 0;
  Unit unit{};
};

std::vector<Tolerance> read_tolerances(const Arguments& arguments) {
  std::vector<Tolerance> list;
  for (const auto& written : arguments.list("--tolerance")) {
    Tolerance tolerance{written, true, 0, {}};
    std::string unit;
    if (!split_quantity(written, tolerance.limit, unit) || !(tolerance.limit >= 0))
      fail("bad_command_line", "--tolerance", "\"" + written + "\" is no tolerance",
           "write a share of NRMSE such as 5%, or an RMS such as \"0.2 um\"");
    tolerance.unit = parse_unit(unit, "--tolerance");
    tolerance.is_share = tolerance.unit.dimension.none();
    tolerance.limit = tolerance.unit.difference_to_si(tolerance.limit);
    if (unit.empty() && tolerance.limit > 1)
      fail("bad_command_line", "--tolerance",
           fmt::format("\"{}\" would be {:.0f} % of NRMSE, more than the whole signal", written, 100 * tolerance.limit),
           fmt::format("write --tolerance={}% for a share, or an RMS with its unit", written));
    list.push_back(tolerance);
  }
  return list;
}

/// The figures that a tolerance is held against: of the validate recordings, else of those that train; null where no
/// recording that is looked at has measured the output.
const Metrics* judged_metrics(const Comparison& comparison, int output) {
  const Metrics* validate = comparison.find(Role::validate, output);
  return validate != nullptr ? validate : comparison.find(Role::train, output);
}

/// Nothing to judge is no agreement.
void need_something_to_judge(const std::string& data, const DataModel& model, const Comparison& comparison) {
  for (int y = 0; y < static_cast<int>(model.outputs().size()); ++y)
    if (judged_metrics(comparison, y) != nullptr) return;
  const auto& recordings = model.data().recordings;
  const bool only_test =
      std::all_of(recordings.begin(), recordings.end(), [](const Recording& r) { return r.role == Role::test; });
  fail("nothing_to_judge", data,
       only_test ? fmt::format("{} of the role \"test\", which compare does not look at, and none of the roles "
                               "\"train\" and \"validate\"",
                               count_text(static_cast<long>(recordings.size()), "recording"))
                 : fmt::format("no recording of the roles \"train\" and \"validate\" has a column for {}",
                               fmt::join(model.outputs(), " or ")),
       "give a recording that is to be judged the role \"validate\"");
}

/// Sentences on the tolerances; `within` becomes false where one is exceeded.
std::vector<std::string> judge_tolerances(const std::vector<Tolerance>& tolerances, const DataModel& model,
                                          const Comparison& comparison, bool& within) {
  std::vector<std::string> sentences;
  for (const auto& tolerance : tolerances) {
    bool used = false;
    for (int y = 0; y < static_cast<int>(model.outputs().size()); ++y) {
      const Metrics* m = judged_metrics(comparison, y);
      const Unit unit = output_unit(model, y);
      if (m == nullptr || (!tolerance.is_share && !(tolerance.unit.dimension == unit.dimension))) continue;
      used = true;
      const double found = tolerance.is_share ? m->nrmse : m->rms;
      const bool good = found <= tolerance.limit;
      within = within && good;
      sentences.push_back(fmt::format(
          "{}: {} of {} is {} the tolerance of {}.", model.outputs()[static_cast<std::size_t>(y)],
          tolerance.is_share ? "NRMSE" : "RMS", tolerance.is_share ? percent_text(found) : difference_text(found, unit),
          good ? "within" : "OUTSIDE", tolerance.written));
    }
    if (!used)
      fail("wrong_unit", "--tolerance", fmt::format("\"{}\" has the unit of no measured output", tolerance.written),
           fmt::format("write it in {}, or as a share of NRMSE such as 5%", unit_text(output_unit(model, 0))));
  }
  return sentences;
}

std::string headline(const DataModel& model, const Comparison& comparison) {
  std::vector<std::string> parts;
  bool validate = false;
  for (int y = 0; y < static_cast<int>(model.outputs().size()); ++y) {
    const Metrics* m = judged_metrics(comparison, y);
    if (m == nullptr) continue;
    validate = validate || m == comparison.find(Role::validate, y);
    parts.push_back(fmt::format("{} by {} rms (NRMSE {}, fit {})", model.outputs()[static_cast<std::size_t>(y)],
                                difference_text(m->rms, output_unit(model, y), 3), percent_text(m->nrmse),
                                percent_text(m->fit / 100)));
  }
  return fmt::format("On the {} recordings the model misses {}", validate ? "validate" : "train",
                     fmt::join(parts, ", "));
}

Document document_of(const Diagram& diagram, const DataModel& model, const Comparison& comparison,
                     const std::string& type) {
  Document document;
  document.verb = "compare";
  document.title = diagram.title;
  document.headline = headline(model, comparison);
  document.warnings = model.data().remarks;
  for (const auto& remark : model.remarks()) document.warnings.push_back(remark);
  const auto recordings = judged_recordings(model);
  const Beside view{&model, &comparison, nullptr};

  Section figures;
  figures.title = "Overall error";
  figures.tables.push_back(metrics_table(model, comparison));
  document.sections.push_back(std::move(figures));

  Section where;
  where.title = "Where the squared error lies";
  where.text.emplace_back(
      "Over all recordings, train and validate together. The shares of each split add up to 100 %.");
  add_split_figures(where, model, comparison);
  document.sections.push_back(std::move(where));

  Section residuals;
  residuals.title = "Residual against level, branch and rate";
  add_residual_figures(residuals, view, recordings);
  document.sections.push_back(std::move(residuals));

  for (const int r : recordings) {
    Section section;
    section.title = fmt::format("{} ({})", model.recording(r).name, to_text(model.recording(r).role));
    document.traces.push_back(recording_table(view, r, trace_file(model.recording(r).name, document.traces, type)));
    add_time_figures(section, view, document.traces.back());
    add_loop_figures(section, view, document.traces.back());
    document.sections.push_back(std::move(section));
  }
  document.answer = how_far_figures(view, recordings, document.traces);
  return document;
}

/// True where two files of traces are meant; fails where the words fit neither use.
bool names_two_files(const Arguments& arguments) {
  const auto is = [](const std::string& file, const char* type) { return file.ends_with(type); };
  const std::string first = arguments.text("diagram"), second = arguments.text("other");
  if (second.empty() && (is(first, ".csv") || is(first, ".f64")))
    fail("bad_command_line", "compare", fmt::format("only one file is named: {}", first),
         "name a second file of traces, or a diagram and its recordings: hysteron compare stage.json --data lab.csv");
  if (!second.empty() && (is(first, ".json") || is(second, ".json")))
    fail("bad_command_line", "compare", fmt::format("{} and {} are no two files of traces", first, second),
         "hold a diagram against recordings with --data: hysteron compare stage.json --data lab.csv");
  if (!second.empty()) return true;
  if (!arguments.has("--data"))
    fail("bad_command_line", "compare", "--data is required where a diagram is named", "see hysteron compare --help");
  for (const char* option : {"--over", "--pair"})
    if (arguments.has(option))
      fail("bad_command_line", option, "it is for two files of traces", "leave it out, or name two files of traces");
  return false;
}

Answer compare_verb_acts(const Arguments& arguments, const Watch& watch) {
  if (names_two_files(arguments)) return compare_traces(arguments);
  const auto tolerances = read_tolerances(arguments);
  const std::string type = trace_type(arguments);
  const Diagram diagram = load_diagram(arguments, watch);
  const ProgramPointer program = compile_file(diagram);
  const auto data = std::make_shared<const DataSet>(load_data(arguments, *program));
  DataModelOptions model_options;
  model_options.threads = 2;
  model_options.keep_workspaces = false;
  DataModel model(program, data, model_options);
  const auto recordings = judged_recordings(model);
  std::optional<Judge> judge(std::in_place, model, noise_before_fit(model));
  improve_starts(model, *judge, {}, recordings);
  Prediction prediction = model.predict({}, recordings);
  if (!prediction.ok)
    fail_numerics("simulation_failed", arguments.text("diagram"), prediction.error,
                  "run it alone with \"hysteron run\" to see where it diverges");
  std::vector<std::string> behind;  // warnings
  for (const auto& beginning : begin_elsewhere(model, judge->noise(), prediction, {}, recordings))
    behind.push_back(to_text(model, beginning));
  const auto delays = find_delays(model, *judge, prediction);
  const Comparison comparison = compare(model, *judge, std::move(prediction), recordings);
  judge.reset();  // a number a row, of no use to the tables that are made now
  need_something_to_judge(arguments.text("--data"), model, comparison);

  Answer answer;
  answer.folder = result_folder(arguments, "compare");
  answer.document = document_of(diagram, model, comparison, type);
  Document& document = answer.document;
  bool within = true;
  document.sentences = judge_tolerances(tolerances, model, comparison, within);
  for (const auto& sentence : comparison.sentences)
    if (std::find(document.sentences.begin(), document.sentences.end(), sentence) == document.sentences.end())
      document.sentences.push_back(sentence);  // two splits may say the same
  Facts facts = Facts::object({{"diagram", arguments.text("diagram")},
                               {"data", arguments.text("--data")},
                               {"metrics", metrics_facts(model, comparison)},
                               {"splits", split_facts(model, comparison)}});
  if (!tolerances.empty()) facts.set("within_tolerance", within);
  Facts::List late;
  for (const auto& delay : delays)
    if (!delay.sentence.empty()) {
      behind.push_back(delay.sentence);
      late.push_back(Facts::object({{"output", model.outputs()[static_cast<std::size_t>(delay.output)]},
                                    {"samples", delay.samples},
                                    {"seconds", delay.seconds},
                                    {"sentence", delay.sentence}}));
    }
  document.warnings.insert(document.warnings.end(), behind.begin(), behind.end());
  facts.set("delays", late);
  document.facts = to_json(facts);
  answer.exit_code = within ? exit_code::done : exit_code::no;
  return answer;
}

/// Of a diagram and its data, and of two files of traces.
std::vector<shape::Member> compare_shape() {
  using namespace shape;
  const Facts delay = object("an output that is late", {{"output", text("its name")},
                                                        {"samples", number("by so many")},
                                                        {"seconds", number("by so much [s]")},
                                                        {"sentence", text("the same in words")}});
  const Facts signal = object("two columns", {{"first", text("its name in the first file")},
                                              {"second", text("its name in the second file")},
                                              {"unit", text("of what follows")},
                                              {"points", whole("at which they were compared")},
                                              {"left_out", whole("outside the common range")},
                                              {"largest", number("difference")},
                                              {"largest_at", number("where")},
                                              {"rms", number("of the differences")},
                                              {"tolerance", text("as it was written"), sometimes},
                                              {"outside", whole("points beyond the tolerance"), sometimes},
                                              {"within", flag("none"), sometimes},
                                              {"furthest_beyond", number("the tolerance"), sometimes},
                                              {"furthest_at", number("where"), sometimes}});
  const Facts facts = object("how far, where", {{"diagram", text("its file"), sometimes},
                                                {"data", text("its recordings"), sometimes},
                                                {"metrics", metrics(), sometimes},
                                                {"splits", splits(), sometimes},
                                                {"delays", list("found in what is left over", delay), sometimes},
                                                {"first", text("file of traces"), sometimes},
                                                {"second", text("file of traces"), sometimes},
                                                {"over", text("column of both"), sometimes},
                                                {"over_unit", text("its unit"), sometimes},
                                                {"signals", list("of two files of traces", signal), sometimes},
                                                {"within_tolerance", flag("where one was given"), sometimes}});
  return published({{"facts", facts}});
}

}  // namespace

Verb compare_verb() {
  return {
      "compare",
      "how far is the model from the measurement, and where does it fail",
      compare_help,
      {{"diagram", "FILE", "diagram file (JSON), or traces (CSV, f64)", true, false},
       {"other", "FILE", "traces (CSV, f64) to hold against those of the first file", false, false},
       options::data(false),
       {"--tolerance", "LIMIT",
        "exit with 1 if NRMSE (5%) or RMS (\"0.2 um\") is larger; of traces \"y: 2 nm + 0.1 %, 0.1 ms\"", false, true},
       {"--over", "COLUMN", "traces: compare over this column in place of the time, as of a loop", false, false},
       {"--pair", "A=B", "traces: compare column A of the first file with column B of the second, and no others", false,
        true},
       options::traces(),
       options::output_folder(),
       options::set(),
       options::choose(),
       options::allow()},
      compare_verb_acts,
      compare_shape};
}

}  // namespace hysteron
