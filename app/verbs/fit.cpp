// The verb fit: finds the free parameters of a diagram from recordings, with their uncertainty.
// Does not change the structure of the diagram.
#include "fit/estimate/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <limits>

#include "app/cli/answer.h"
#include "app/cli/interrupt.h"
#include "app/cli/load.h"
#include "app/cli/rewrite.h"
#include "app/cli/shape.h"
#include "app/cli/target.h"
#include "app/verbs/effect_parameters.h"
#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "fit/estimate/beginning.h"
#include "fit/estimate/thresholds.h"
#include "fit/inspect/delay.h"
#include "fit/thesis/problem.h"
#include "fit/thesis/thesis_methods.h"
#include "io/diagram/diagram_file.h"
#include "io/jobs/job_file.h"
#include "report/pages/curves.h"
#include "report/pages/fit_page.h"
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

/// Whoever watches sees where the fit stands, and may end it with the best so far.
void watch_fit(FitOptions& settings, const Watch& watch) {
  settings.progress = [&watch](const FitProgress& now) {
    const double over = std::sqrt(now.chi2 / std::max(1.0, now.rows));
    const bool paced = now.stage == "scan" || now.stage == "global";
    watch.show(paced ? now.fraction : -1,
               fmt::format("{}: best error {} of the noise, {}, {}", now.stage, percent_text(over),
                           count_text(now.candidates, "candidate"), count_text(now.runs, "simulation")));
    return !watch.stop();
  };
}

double rms_of(const FitResult& result, const DataModel& model) {
  double sum = 0, rows = 0;
  for (const auto& r : result.after.recordings) {
    if (r.role != Role::train || model.measured(r.recording, 0).empty()) continue;
    const auto n = static_cast<double>(model.measured(r.recording, 0).size());
    sum += n * r.rms[0] * r.rms[0];
    rows += n;
  }
  return rows > 0 ? std::sqrt(sum / rows) : 0;
}

/// The result of one method, whatever its kind.
FitResult result_of(DataModel& model, const NoiseModel& noise, const std::vector<FreeParameter>& free,
                    const FitMethod& method) {
  if (!method.of_thesis) return fit(model, noise, free, method.options);
  ThesisMethodOptions options;
  options.progress = method.options.progress;
  return fit_as_thesis(model, noise, method.name, options);
}

/// Each method from the same start against the same noise; the free parameters begin where the best of them ended,
/// which `best` is.
std::vector<Attempt> attempt_all(DataModel& model, FitProblem& problem, const Watch& watch, FitWithNoise& best) {
  std::vector<Attempt> attempts;
  best.noise = noise_before_fit(model);
  double least = std::numeric_limits<double>::infinity();
  for (auto method : problem.methods) {
    if (watch.stop()) break;
    method.options.intervals = false;
    method.options.profile.clear();
    watch_fit(method.options, watch);
    const FitResult found = result_of(model, best.noise, problem.free, method);
    if (!found.ok && found.stopped) break;
    Attempt a{found.ok ? found.method : method.name, found.ok, found.error};
    a.runs = found.runs;
    a.failed = found.failed_runs;
    a.seconds = found.seconds;
    if (found.ok) {
      a.rms = rms_of(found, model);
      a.chi2 = found.chi2;
      a.n = found.n;
      if (found.chi2 < least) {
        least = found.chi2;
        best.result = found;
      }
    }
    attempts.push_back(std::move(a));
  }
  for (auto& f : problem.free)
    for (const auto& value : best.result.values)
      if (value.parameter == f.parameter && value.recording == f.recording) {
        f.start = std::clamp(value.value, f.lower, f.upper);
        f.scan.clear();
      }
  return attempts;
}

/// The fit that was asked for; of several methods the best, and the search from there. Whoever watches may end it with
/// the best so far.
FitWithNoise search(DataModel& model, FitProblem& problem, const Watch& watch, std::vector<Attempt>& attempts) {
  const StopScope until_interrupted(watch.stop);
  FitOptions options = problem.methods.front().options;
  watch_fit(options, watch);
  FitWithNoise found;
  if (problem.methods.size() == 1 && problem.methods.front().of_thesis) {
    found.noise = noise_before_fit(model);
    problem.methods.front().options = options;
    found.result = result_of(model, found.noise, problem.free, problem.methods.front());
    return found;
  }
  if (problem.methods.size() > 1) {
    attempts = attempt_all(model, problem, watch, found);
    options.global.clear();
    options.starts = 0;
    found.result.stopped = true;  // where nothing follows
    if (watch.stop()) return found;
  }
  auto last = fit_and_noise(model, problem.free, options);
  return last.result.ok || !found.result.ok ? last : found;
}

Fitted fit_and_compare(DataModel& model, FitProblem problem, const Watch& watch) {
  watch.keep();
  const auto free = problem.free;  // with the starts that the user gave
  Trial start_values;
  for (const auto& f : free) start_values.push_back({f.parameter, f.start, f.recording});
  std::vector<Attempt> attempts;
  FitWithNoise with_noise = search(model, problem, watch, attempts);
  const bool of_thesis = problem.methods.size() == 1 && problem.methods.front().of_thesis;
  if (of_thesis) start_values.clear();
  FitResult& result = with_noise.result;
  if (!result.ok && result.stopped) throw_nothing_found();
  if (!result.ok)
    fail_numerics("fit_failed", "fit", result.error, "start from other values, or give the parameters narrower bounds");
  for (std::size_t i = 0; i < free.size() && !of_thesis; ++i) result.estimates[i].start = free[i].start;
  const auto recordings = judged_recordings(model);
  const Judge judge(model, with_noise.noise);
  const Prediction start = model.predict(start_values, recordings);
  const Prediction end = model.predict(result.values, recordings);
  if (!end.ok) fail_numerics("fit_failed", "fit", end.error, "give the parameters narrower bounds");
  Comparison after = compare(model, judge, end, recordings);
  // A start that cannot be simulated is no obstacle to a fit; then there is nothing to show before it.
  Comparison before = start.ok ? compare(model, judge, start, recordings) : after;
  const auto weighed = [&](const Prediction& prediction) {
    if (!prediction.ok) return std::numeric_limits<double>::infinity();
    const Score score = judge.score(model, prediction, recordings);
    return std::sqrt(score.chi2(Role::train) / std::max(1.0, score.n(Role::train)));
  };
  Fitted fitted;
  fitted.weighed_before = weighed(start);
  fitted.weighed_after = weighed(end);
  fitted.by_search = !of_thesis;
  if (!result.stopped) {
    fitted.delays = find_delays(model, judge, end);
    for (const auto& b : begin_elsewhere(model, with_noise.noise, end, result.values, recordings))
      result.remarks.push_back(to_text(model, b));
  }
  fitted.result = std::move(result);
  fitted.noise = std::move(with_noise.noise);
  fitted.before = std::move(before);
  fitted.after = std::move(after);
  fitted.attempts = std::move(attempts);
  return fitted;
}

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
      fail_numerics("fit_failed", wish.block.text, found.result.error, "begin with other thresholds and weights");
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

std::vector<shape::Member> fit_shape() {
  return shape::published(
      {{"facts", shape::open_object("parameters with their uncertainty, errors before and after: \"facts\" of "
                                    "result.json")}});
}

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
