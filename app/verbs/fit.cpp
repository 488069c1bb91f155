// The verb fit: finds the free parameters of a diagram from recordings, with their uncertainty.
// Does not change the structure of the diagram.
#include "fit/estimate/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>

#include "app/cli/answer.h"
#include "app/cli/load.h"
#include "app/cli/rewrite.h"
#include "app/cli/shape.h"
#include "app/cli/target.h"
#include "app/facts/fact_shapes.h"
#include "app/verbs/effect_parameters.h"
#include "app/verbs/fit_search.h"
#include "engine/diagram/error.h"
#include "fit/estimate/thresholds.h"
#include "io/diagram/diagram_file.h"
#include "io/diagram/text_diff.h"
#include "io/jobs/job_file.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

constexpr char fit_help[] =
    "Answers: which values of the free parameters fit the recordings, and how sure are they.\n"
    "Free is what the diagram marks (\"free\": true), the parameters of effects that were added, and what --free\n"
    "names; a job file says it all in one place (bounds, scale, prior ranges, one value per recording, method).\n"
    "Only train recordings are fitted; validate recordings are judged with the result. Parameters that the\n"
    "data do not determine get no value.\n\n"
    "Examples:\n"
    "  hysteron fit next.json --data dataset.json\n"
    "  hysteron fit stage.json --data dataset.json --free core.weights --write fitted.json\n"
    "  hysteron fit stage.json --data lab.csv --profile stage.k --starts 50\n"
    "  hysteron fit job.json\n\n"
    "Methods: search (bounded Levenberg-Marquardt, from the best of the starts); pso, npso, nmpso (particle\n"
    "swarms), crs2, isres, esch, direct (NLopt) look all over the bounds first, then the search follows.\n"
    "What is linear is found by least squares beside any of them.\n\n"
    "Writes into the folder: result.json, traces/*.csv, report.html, fitted.json (the diagram with its new\n"
    "values) and parameters.json (values, standard deviations, 95 % intervals; a block can name it as its\n"
    "\"parameters\" where all of them are its own). --write FILE.json writes the fitted diagram to a place of\n"
    "its own too.\n"
    "Ctrl-C ends with the best values so far, and says so.\n"
    "Exit codes: 0 done, 2 wrong input, 3 the model cannot be simulated, 130 interrupted.";

/// Columns as wide as their longest cell, for the terminal.
std::string columns_text(const Table& table) {
  std::vector<std::size_t> width;
  for (const auto& name : table.columns) width.push_back(name.size());
  for (const auto& row : table.rows)
    for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], row[k].size());
  std::string all;
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t k = 0; k < cells.size(); ++k) text += fmt::format("{:<{}}  ", cells[k], width[k]);
    while (!text.empty() && text.back() == ' ') text.pop_back();
    all += "  " + text + "\n";
  };
  line(table.columns);
  for (const auto& row : table.rows) line(row);
  return all;
}

/// The job of the arguments: its file, or what the options say.
FitJob job_of(const Arguments& arguments) {
  const std::string named = arguments.text("diagram");
  FitJob job;
  if (is_job(named)) {
    job = read_fit_job(named, arguments.list("--allow"));
  } else {
    job.diagram = named;
    job.methods.emplace_back();
    if (!arguments.has("--data"))
      fail("bad_command_line", "--data", "there are no recordings to fit",
           "name them with --data dataset.json, or name a job file (\"do\": \"fit\") in place of the diagram");
  }
  if (arguments.has("--data")) job.data = arguments.text("--data");
  if (arguments.has("--write")) job.write = arguments.text("--write");
  const auto whole = [&](const char* option, double otherwise) {
    const double value = arguments.number(option, otherwise);
    if (value < 0 || value != std::floor(value) || value > 1e9)
      fail("bad_command_line", option, fmt::format("{} is no whole number", value), "write 0, 1, 2 ...");
    return value;
  };
  job.seed = static_cast<std::uint64_t>(whole("--seed", static_cast<double>(job.seed)));
  if (arguments.has("--method")) {
    job.methods.clear();
    for (const auto& name : arguments.list("--method")) job.methods.push_back({.name = {name, ""}});
  }
  for (auto& method : job.methods) {
    if (arguments.has("--starts")) method.starts = static_cast<int>(whole("--starts", 0));
    if (arguments.has("--runs")) method.runs = static_cast<long>(std::max(1.0, whole("--runs", 1)));
  }
  for (const auto& path : arguments.list("--profile")) job.profile.push_back({path, ""});
  return job;
}

/// Runs `action`; an Error that it throws gets the file and line of the job, where there is one.
template <class Action>
auto with_lines_of_job(const FitJob& job, const Action& action) {
  try {
    return action();
  } catch (Error& error) {
    if (job.file.empty()) throw;
    locate_problems(error, job.file);
    throw Error(error.fault, error.problems);
  }
}

/// Now, or when the caller of reproducible builds says (SOURCE_DATE_EPOCH).
std::string date_text() {
  std::time_t now = std::time(nullptr);
  if (const char* fixed = std::getenv("SOURCE_DATE_EPOCH")) now = static_cast<std::time_t>(std::atoll(fixed));
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

/// Puts the thresholds and weights that the job asks for into the diagram.
void place_wanted_thresholds(const FitJob& job, const std::shared_ptr<const DataSet>& data, Diagram& diagram,
                             const Watch& watch) {
  const auto& wish = *job.thresholds;
  FitOptions options;
  watch_fit(options, watch);
  try {
    const auto found = fit_thresholds(diagram, registry(), data, wish.block.text, wish.count,
                                      wish.by_swing ? Placement::by_swing : Placement::even, options);
    if (!found.result.ok)
      fail_numerics("fit_failed", wish.block.text, found.result.error,
                    "write other thresholds and weights into the diagram to start from");
    diagram = found.diagram;
  } catch (Error& error) {
    for (auto& p : error.problems)
      if (p.path == wish.block.text) p.path = wish.block.pointer;
    if (!job.file.empty()) locate_problems(error, job.file);
    throw Error(error.fault, error.problems);
  }
}

/// What the reader of a fit must not overlook.
std::vector<std::string> warnings_of(const Fitted& fitted, const std::vector<FreeParameter>& free,
                                     const std::vector<std::string>& unusual, const DataSet& data) {
  const FitResult& result = fitted.result;
  std::vector<std::string> list;
  for (const auto& u : result.undetermined) list.push_back(u.sentence);
  list.insert(list.end(), unusual.begin(), unusual.end());
  for (const auto& n : fitted.noise.outputs)
    if (!n.remark.empty()) list.push_back(n.remark);
  if (std::any_of(free.begin(), free.end(), [](const FreeParameter& f) { return f.recording >= 0; }))
    list.emplace_back(
        "A diagram knows no recordings: values of single recordings stand in parameters.json, fitted.json keeps its "
        "own.");
  for (const auto& delay : fitted.delays)
    if (!delay.sentence.empty()) list.push_back(delay.sentence);
  list.insert(list.end(), result.remarks.begin(), result.remarks.end());
  list.insert(list.end(), data.remarks.begin(), data.remarks.end());
  if (!result.converged && !result.stopped)
    list.push_back(
        fmt::format("The search did not end by itself ({}): there may be better values.", result.convergence));
  if (result.stopped) list.emplace_back("Interrupted: these are the best values found until then.");
  return list;
}

Answer fit_verb_acts(const Arguments& arguments, const Watch& watch) {
  const FitJob job = job_of(arguments);
  Diagram diagram = read_diagram(job.diagram, arguments.list("--allow"));
  const std::string write_option = arguments.has("--write") ? "--write" : "/write";
  if (!job.write.empty()) with_lines_of_job(job, [&] { check_diagram_target(write_option, job.write, diagram); });
  with_lines_of_job(job, [&] { apply_settings(diagram, job.set, job.choose); });
  apply_overrides(diagram, arguments, watch);
  ProgramPointer program = compile_file(diagram);
  const auto data = std::make_shared<const DataSet>(read_dataset(job.data, arguments.list("--allow")));
  check_binding(*data, *program);
  need_moving_outputs(*data, *program);
  const Diagram as_read = diagram;
  std::vector<std::string> wanted;
  if (job.thresholds) {
    place_wanted_thresholds(job, data, diagram, watch);
    program = compile_file(diagram);
    wanted.push_back(job.thresholds->block.text + ".weights");
  }
  const Effects effects = load_effects(arguments);
  for (const auto& path : effect_parameters(diagram, *program, effects)) wanted.push_back(path);
  for (const auto& path : arguments.list("--free")) wanted.push_back(path);
  const FitProblem problem = with_lines_of_job(job, [&] { return problem_of(job, *program, *data, wanted); });
  const auto& free = problem.free;
  if (free.empty() && !(problem.methods.size() == 1 && problem.methods.front().of_thesis))
    fail("nothing_free", job.diagram, "no parameter of the diagram is free",
         "mark parameters of the diagram with \"free\": true, or name them with --free core.weights");
  DataModelOptions model_options;
  model_options.threads = 2;
  DataModel model(program, data, model_options);
  const Fitted fitted = fit_and_compare(model, problem, watch);
  const FitResult& result = fitted.result;
  const Diagram after = with_parameters(diagram, *program, result.values);

  Answer answer;
  answer.folder = result_folder(arguments, "fit");
  Document& document = answer.document;
  document.verb = "fit";
  document.title = diagram.title;
  tell(document, model, fitted);
  for (auto& warning : warnings_of(fitted, free, unusual_values(diagram, result, effects), *data))
    document.warnings.push_back(std::move(warning));
  add_sections(document, model, fitted, text_diff(diagram_text(as_read), diagram_text(after)));
  document.facts = to_json(fit_facts(job, model, fitted));
  document.files.emplace_back("fitted.json", text_in_folder(after, answer.folder, "fitted.json"));
  document.files.emplace_back(
      "parameters.json", parameter_file_text(result, *program, *data, {job.diagram, job.data, date_text(), job.seed}));
  if (!fitted.attempts.empty() && !arguments.quiet())
    answer.text = columns_text(method_table(model, fitted.attempts, true));
  if (!job.write.empty()) answer.files.push_back(diagram_file(job.write, after));
  if (!result.stopped) return answer;
  answer.exit_code = exit_code::interrupted;
  answer.interrupted = "interrupted; the best values so far are in " + answer.folder;
  return answer;
}

std::vector<shape::Member> fit_shape() { return shape::published({{"facts", shape::of_fit()}}); }

}  // namespace

Verb fit_verb() {
  return {
      "fit",
      "find parameters, with their uncertainty",
      fit_help,
      {{"diagram", "FILE.json", "the diagram, or a job (\"do\": \"fit\") that names it", true, false},
       options::data(false),
       options::effects(),
       {"--free", "PATH", "also find this parameter, e.g. core.weights (all its elements)", false, true},
       {"--method", "NAME", "search (default), a global method before it, or slopes, tapi; several are compared", false,
        true},
       {"--starts", "N", "spread so many further starts over the bounds", false, false},
       {"--runs", "N", "how many points a global method may try; default 505", false, false},
       {"--seed", "N", "of everything random; default 1", false, false},
       {"--profile", "PATH", "also follow this parameter away from the result, the others fitted again", false, true},
       {"--write", "FILE.json", "write the fitted diagram there too", false, false},
       options::output_folder(),
       options::set(),
       options::choose(),
       options::allow()},
      fit_verb_acts,
      fit_shape};
}

}  // namespace hysteron
