// The verb fit: finds the free parameters of a diagram from recordings, with their uncertainty.
// Does not change the structure of the diagram.
#include "fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <limits>

#include "app/curves.h"
#include "app/effect_parameters.h"
#include "app/interrupt.h"
#include "app/load.h"
#include "app/numbers.h"
#include "app/progress.h"
#include "app/publish.h"
#include "app/rewrite.h"
#include "app/verb.h"
#include "engine/error.h"
#include "fit/delay.h"
#include "fit/problem.h"
#include "fit/thesis_methods.h"
#include "fit/thresholds.h"
#include "io/diagram_file.h"
#include "io/job_file.h"

namespace hysteron {
namespace {

constexpr char help[] =
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

std::string interval_text(const ParameterEstimate& e) {
  if (!e.low95 || !e.high95) return e.at_lower ? "at its lower bound" : e.at_upper ? "at its upper bound" : "-";
  const auto text = [&](double si) {
    return number_text(e.difference ? e.unit.difference_from_si(si) : e.unit.from_si(si), 5);
  };
  return fmt::format("{} .. {}", text(*e.low95), text(*e.high95));
}

std::string value_text_of(const ParameterEstimate& e, double si) {
  return e.difference ? difference_text(si, e.unit, 5) : quantity_text(si, e.unit, 5);
}

/// The recording of a parameter that has one value in each; "all" else.
std::string recording_text(const DataModel& model, const ParameterEstimate& e) {
  return e.recording < 0 ? "all" : model.recording(e.recording).name;
}

std::string name_text(const DataModel& model, const ParameterEstimate& e) {
  return e.recording < 0 ? e.path : fmt::format("{} in {}", e.path, model.recording(e.recording).name);
}

Table parameter_table(const DataModel& model, const FitResult& result) {
  const bool recordings =
      std::any_of(result.estimates.begin(), result.estimates.end(), [](const auto& e) { return e.recording >= 0; });
  Table table;
  table.columns = {"parameter", "value", "95 % interval", "start", "found by"};
  if (recordings) table.columns.insert(table.columns.begin() + 1, "recording");
  for (const auto& e : result.estimates) {
    std::vector<std::string> row{e.path, e.value ? value_text_of(e, *e.value) : "not determined by these data",
                                 interval_text(e), value_text_of(e, e.start),
                                 e.linear ? "linear least squares" : "search"};
    if (recordings) row.insert(row.begin() + 1, recording_text(model, e));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Facts estimate_facts(const DataModel& model, const FitResult& result) {
  Facts::List list;
  for (const auto& e : result.estimates) {
    const auto shown = [&](const std::optional<double>& si) -> std::optional<double> {
      if (!si) return {};
      return e.difference ? e.unit.difference_from_si(*si) : e.unit.from_si(*si);
    };
    list.push_back(
        Facts::object({{"parameter", e.path},
                       {"recording", recording_text(model, e)},
                       {"unit", unit_text(e.unit)},
                       {"determined", e.determined},
                       {"value", shown(e.value)},
                       {"standard_deviation", e.sigma ? Facts(e.unit.difference_from_si(*e.sigma)) : Facts()},
                       {"low95", shown(e.low95)},
                       {"high95", shown(e.high95)},
                       {"start", shown(e.start)},
                       {"at_bound", e.at_lower || e.at_upper}}));
  }
  return list;
}

/// Correlations of at least 0.9: what a reader must not overlook; the whole matrix stands in result.json.
std::vector<std::string> strong_correlations(const FitResult& result) {
  std::vector<std::string> list;
  const std::size_t n = result.correlated.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i + 1; k < n; ++k) {
      const double c = result.correlation[i * n + k];
      if (std::abs(c) < 0.9) continue;
      list.push_back(fmt::format("{} and {} are correlated by {:.3f}.",
                                 result.estimates[static_cast<std::size_t>(result.correlated[i])].path,
                                 result.estimates[static_cast<std::size_t>(result.correlated[k])].path, c));
    }
  return list;
}

Facts correlation_facts(const FitResult& result) {
  std::vector<std::string> names;
  for (const int i : result.correlated) names.push_back(result.estimates[static_cast<std::size_t>(i)].path);
  return Facts::object({{"parameters", names}, {"matrix_row_by_row", result.correlation}});
}

/// "y RMS 0.093 um -> 0.0002 um (NRMSE 4.9 % -> 0.012 %)" of all outputs on the recordings of one role; "" without any.
std::string rms_text(const DataModel& model, const Comparison& before, const Comparison& after, Role role) {
  std::vector<std::string> parts;
  for (int y = 0; y < static_cast<int>(model.outputs().size()); ++y) {
    const Metrics* a = before.find(role, y);
    const Metrics* b = after.find(role, y);
    if (a == nullptr || b == nullptr) continue;
    const Unit unit = output_unit(model, y);
    parts.push_back(fmt::format("{} RMS {} -> {} (NRMSE {} -> {})", model.outputs()[static_cast<std::size_t>(y)],
                                difference_text(a->rms, unit), difference_text(b->rms, unit), percent_text(a->nrmse),
                                percent_text(b->nrmse)));
  }
  return parts.empty() ? "" : fmt::format("{}: {}", to_text(role), fmt::join(parts, "; "));
}

/// Ctrl-C during a fit ends it with the best so far.
void watch(FitOptions& settings, Progress& progress) {
  settings.progress = [&progress](const FitProgress& now) {
    const double over = std::sqrt(now.chi2 / std::max(1.0, now.rows));
    const bool paced = now.stage == "scan" || now.stage == "global";
    progress.show(paced ? now.fraction : -1,
                  fmt::format("{}: best error {} of the noise, {}, {}", now.stage, percent_text(over),
                              count_text(now.candidates, "candidate"), count_text(now.runs, "simulation")));
    return !interrupted();
  };
}

/// What one of several methods reached.
struct Attempt {
  std::string method;
  bool ok = false;
  std::string error{};
  double rms = 0;  ///< of the first output over the fitted recordings [SI]
  double chi2 = 0, n = 0;
  long runs = 0, failed = 0;
  double seconds = 0;
};

struct Fitted {
  FitResult result;
  NoiseModel noise;
  Comparison before, after;
  std::vector<DelayFinding> delays;
  std::vector<Attempt> attempts;
};

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

/// Each method from the same start against the same noise; the free parameters begin where the best of them ended.
std::vector<Attempt> attempt_all(DataModel& model, FitProblem& problem, Progress& progress) {
  std::vector<Attempt> attempts;
  const NoiseModel noise = noise_before_fit(model);
  std::vector<ParameterValue> best;
  double least = std::numeric_limits<double>::infinity();
  for (auto method : problem.methods) {
    if (interrupted()) break;
    method.options.intervals = false;
    method.options.profile.clear();
    watch(method.options, progress);
    const FitResult found = result_of(model, noise, problem.free, method);
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
        best = found.values;
      }
    }
    attempts.push_back(std::move(a));
  }
  for (auto& f : problem.free)
    for (const auto& value : best)
      if (value.parameter == f.parameter && value.recording == f.recording) {
        f.start = std::clamp(value.value, f.lower, f.upper);
        f.scan.clear();
      }
  return attempts;
}

Fitted fit_and_compare(DataModel& model, FitProblem problem, bool quiet) {
  Progress progress(quiet);
  const DeferInterrupts defer;
  const auto free = problem.free;  // with the starts that the user gave
  Trial start_values;
  for (const auto& f : free) start_values.push_back({f.parameter, f.start, f.recording});
  FitOptions options = problem.methods.front().options;
  std::vector<Attempt> attempts;
  if (problem.methods.size() > 1) {
    attempts = attempt_all(model, problem, progress);
    options.global.clear();
    options.starts = 0;
  }
  watch(options, progress);
  const bool of_thesis = problem.methods.size() == 1 && problem.methods.front().of_thesis;
  FitWithNoise with_noise;
  if (of_thesis) {
    with_noise.noise = noise_before_fit(model);
    problem.methods.front().options = options;
    with_noise.result = result_of(model, with_noise.noise, problem.free, problem.methods.front());
    start_values.clear();
  } else {
    with_noise = fit_and_noise(model, problem.free, options);
  }
  progress.clear();
  FitResult& result = with_noise.result;
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
  return {std::move(result), std::move(with_noise.noise),    std::move(before),
          std::move(after),  find_delays(model, judge, end), std::move(attempts)};
}

// --- the page
// ---------------------------------------------------------------------------------------------------------

Table noise_table(const DataModel& model, const NoiseModel& noise) {
  Table table;
  table.columns = {"output", "white rms", "1/f rms", "known from"};
  for (std::size_t o = 0; o < noise.outputs.size(); ++o) {
    const auto& n = noise.outputs[o];
    const Unit unit = output_unit(model, static_cast<int>(o));
    table.rows.push_back({model.outputs()[o], difference_text(n.white, unit),
                          difference_text(n.white * n.one_over_f, unit),
                          fmt::format("{}; share of 1/f {}", to_text(n.source),
                                      n.share_is_stated   ? "stated"
                                      : n.share_estimated ? "estimated from the residual"
                                                          : "assumed")});
  }
  return table;
}

Facts noise_facts(const DataModel& model, const NoiseModel& noise) {
  Facts::List list;
  for (std::size_t o = 0; o < noise.outputs.size(); ++o) {
    const auto& n = noise.outputs[o];
    const Unit unit = output_unit(model, static_cast<int>(o));
    list.push_back(Facts::object({{"output", model.outputs()[o]},
                                  {"unit", unit_text(unit)},
                                  {"white", unit.difference_from_si(n.white)},
                                  {"one_over_f", n.one_over_f},
                                  {"one_over_f_estimated", n.share_estimated},
                                  {"source", to_text(n.source)}}));
  }
  return list;
}

/// Of several methods: reached error against what it took. Seconds differ from run to run: not for files.
Table method_table(const DataModel& model, const std::vector<Attempt>& attempts, bool with_seconds) {
  Table table;
  table.title = "Methods, each from the same start";
  table.columns = {"method", "RMS", "error / noise", "simulations", "failed"};
  if (with_seconds) table.columns.emplace_back("seconds");
  for (const auto& a : attempts) {
    std::vector<std::string> row{a.method, a.ok ? difference_text(a.rms, output_unit(model, 0), 6) : a.error,
                                 a.ok ? number_text(std::sqrt(a.chi2 / std::max(1.0, a.n)), 6) : "-",
                                 std::to_string(a.runs), std::to_string(a.failed)};
    if (with_seconds) row.push_back(number_text(a.seconds, 3));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Columns as wide as their longest cell, for the terminal.
void print_table(const Table& table) {
  std::vector<std::size_t> width;
  for (const auto& name : table.columns) width.push_back(name.size());
  for (const auto& row : table.rows)
    for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], row[k].size());
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t k = 0; k < cells.size(); ++k) text += fmt::format("{:<{}}  ", cells[k], width[k]);
    while (!text.empty() && text.back() == ' ') text.pop_back();
    fmt::print("  {}\n", text);
  };
  line(table.columns);
  for (const auto& row : table.rows) line(row);
}

Table correlation_table(const DataModel& model, const FitResult& result) {
  Table table;
  table.title = "Correlation";
  table.columns = {""};
  const std::size_t n = result.correlated.size();
  const auto& e = result.estimates;
  for (const int i : result.correlated) table.columns.push_back(name_text(model, e[static_cast<std::size_t>(i)]));
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<std::string> row{table.columns[i + 1]};
    for (std::size_t k = 0; k < n; ++k) row.push_back(fmt::format("{:.3f}", result.correlation[i * n + k]));
    table.rows.push_back(std::move(row));
  }
  return table;
}

double shown_si(const ParameterEstimate& e, double si) {
  return e.difference ? e.unit.difference_from_si(si) : e.unit.from_si(si);
}

/// How sure, as pictures: the interval of each parameter relative to its value, and the profiles where asked.
Section profile_section(const DataModel& model, const FitResult& result) {
  Section section;
  section.title = "Profiles";
  section.text.emplace_back(
      "Each parameter held at values around the result, all others fitted again. Where chi2 has risen by 3.84 times "
      "its "
      "own scale the 95 % interval ends; a curve that does not reach it has an open end.");
  Table table;
  table.columns = {"parameter", "95 % by profile", "95 % by standard deviation"};
  for (const auto& p : result.profiles) {
    const auto& e = result.estimates[static_cast<std::size_t>(p.estimate)];
    const auto end = [&](const std::optional<double>& si) { return si ? number_text(shown_si(e, *si), 5) : "open"; };
    table.rows.push_back({name_text(model, e),
                          fmt::format("{} .. {} {}", end(p.low95), end(p.high95), unit_text(e.unit)),
                          interval_text(e)});
    Figure figure;
    figure.title = fmt::format("Profile of {}", name_text(model, e));
    figure.x_label = axis_text(e.path, e.unit);
    figure.y_label = "rise of chi2 [1]";
    Curve curve;
    curve.name = "rise";
    curve.style = "line";
    curve.role = "simulated";
    for (std::size_t i = 0; i < p.value.size(); ++i) {
      curve.x.push_back(shown_si(e, p.value[i]));
      curve.y.push_back(p.rise[i]);
    }
    Curve limit;
    limit.name = "95 %";
    limit.style = "line";
    limit.role = "before";
    limit.x = {curve.x.front(), curve.x.back()};
    limit.y = {3.841458820694124, 3.841458820694124};
    figure.curves = {std::move(curve), std::move(limit)};
    section.figures.push_back(std::move(figure));
  }
  section.tables.push_back(std::move(table));
  return section;
}

Facts profile_facts(const DataModel& model, const FitResult& result) {
  Facts::List list;
  for (const auto& p : result.profiles) {
    const auto& e = result.estimates[static_cast<std::size_t>(p.estimate)];
    std::vector<double> values;
    for (const double v : p.value) values.push_back(shown_si(e, v));
    const auto end = [&](const std::optional<double>& si) { return si ? Facts(shown_si(e, *si)) : Facts(); };
    list.push_back(Facts::object({{"parameter", e.path},
                                  {"recording", recording_text(model, e)},
                                  {"unit", unit_text(e.unit)},
                                  {"low95", end(p.low95)},
                                  {"high95", end(p.high95)},
                                  {"values", values},
                                  {"rise_of_chi2", p.rise}}));
  }
  return list;
}

void add_sections(Document& document, const DataModel& model, const Fitted& fitted, const std::string& diff) {
  Section parameters;
  parameters.title = "Parameters";
  parameters.tables.push_back(parameter_table(model, fitted.result));
  if (!fitted.attempts.empty()) parameters.tables.push_back(method_table(model, fitted.attempts, false));
  const std::size_t correlated = fitted.result.correlated.size();
  if (correlated > 1 && correlated <= 12) parameters.tables.push_back(correlation_table(model, fitted.result));
  for (const auto& line : strong_correlations(fitted.result)) parameters.text.push_back(line);
  parameters.text.push_back(fmt::format("Method: {}; {}; {}, {} failed.", fitted.result.method,
                                        fitted.result.convergence, count_text(fitted.result.runs, "simulation"),
                                        fitted.result.failed_runs));
  document.sections.push_back(std::move(parameters));
  if (!fitted.result.profiles.empty()) document.sections.push_back(profile_section(model, fitted.result));

  Section errors;
  errors.title = "Error before and after";
  errors.tables.push_back(metrics_table(model, fitted.before));
  errors.tables.back().title = "before the fit";
  errors.tables.push_back(metrics_table(model, fitted.after));
  errors.tables.back().title = "after the fit";
  errors.tables.push_back(noise_table(model, fitted.noise));
  errors.tables.back().title = "noise";
  errors.text.push_back(fmt::format(
      "chi2 {} over {} rows{}.", number_text(fitted.result.chi2, 6), number_text(fitted.result.n, 6),
      fitted.result.prior_chi2 > 0 ? fmt::format(", and {} from prior ranges", number_text(fitted.result.prior_chi2))
                                   : ""));
  document.sections.push_back(std::move(errors));

  const Beside view{&model, &fitted.after, &fitted.before};
  Section residuals;
  residuals.title = "What is left, against level, branch and rate";
  add_residual_figures(residuals, view, judged_recordings(model));
  add_split_figures(residuals, model, fitted.after);
  document.sections.push_back(std::move(residuals));

  for (const int r : judged_recordings(model)) {
    Section section;
    section.title = fmt::format("{} ({})", model.recording(r).name, to_text(model.recording(r).role));
    document.traces.push_back(recording_table(view, r, trace_file(model.recording(r).name, document.traces)));
    add_time_figures(section, view, document.traces.back());
    document.sections.push_back(std::move(section));
  }
  Section change;
  change.title = "The diagram's change";
  change.preformatted = diff;
  change.preformatted_title = "fitted.json";
  document.sections.push_back(std::move(change));
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
                             bool quiet) {
  const auto& wish = *job.thresholds;
  Progress progress(quiet);
  FitOptions options;
  watch(options, progress);
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

int fit_verb_acts(const Arguments& arguments) {
  const FitJob job = job_of(arguments);
  Diagram diagram = read_diagram(job.diagram, arguments.list("--allow"));
  with_lines_of_job(job, [&] { apply_settings(diagram, job.set, job.choose); });
  apply_overrides(diagram, arguments);
  ProgramPointer program = compile_file(diagram);
  const auto data = std::make_shared<const DataSet>(read_dataset(job.data, arguments.list("--allow")));
  check_binding(*data, *program);
  const Diagram as_read = diagram;
  std::vector<std::string> wanted;
  if (job.thresholds) {
    place_wanted_thresholds(job, data, diagram, arguments.quiet());
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
  const Fitted fitted = fit_and_compare(model, problem, arguments.quiet());
  const FitResult& result = fitted.result;
  const Diagram after = with_parameters(diagram, *program, result.values);

  const std::string folder = result_folder(arguments, "fit");
  Document document;
  document.verb = "fit";
  document.title = diagram.title;
  const std::string train = rms_text(model, fitted.before, fitted.after, Role::train);
  const std::string validate = rms_text(model, fitted.before, fitted.after, Role::validate);
  document.headline = fmt::format("{} fitted; {}", count_text(static_cast<long>(result.estimates.size()), "parameter"),
                                  validate.empty() ? train : validate);
  if (!validate.empty()) document.sentences.push_back(train);
  for (const auto& e : result.estimates)
    if (e.value) {
      const std::string interval = interval_text(e);
      document.sentences.push_back(fmt::format("{} = {}{}", name_text(model, e), value_text_of(e, *e.value),
                                               interval == "-" ? "" : fmt::format(" (95 %: {})", interval)));
    }
  for (const auto& u : result.undetermined) document.warnings.push_back(u.sentence);
  for (const auto& sentence : unusual_values(diagram, result, effects)) document.warnings.push_back(sentence);
  for (const auto& n : fitted.noise.outputs)
    if (!n.remark.empty()) document.warnings.push_back(n.remark);
  if (std::any_of(free.begin(), free.end(), [](const FreeParameter& f) { return f.recording >= 0; }))
    document.warnings.emplace_back(
        "A diagram knows no recordings: values of single recordings stand in parameters.json, fitted.json keeps its "
        "own.");
  for (const auto& delay : fitted.delays)
    if (!delay.sentence.empty()) document.warnings.push_back(delay.sentence);
  for (const auto& remark : result.remarks) document.warnings.push_back(remark);
  for (const auto& remark : data->remarks) document.warnings.push_back(remark);
  if (!result.converged && !result.stopped)
    document.warnings.push_back(
        fmt::format("The search did not end by itself ({}): there may be better values.", result.convergence));
  if (result.stopped) document.warnings.emplace_back("Interrupted: these are the best values found until then.");
  add_sections(document, model, fitted, text_diff(diagram_text(as_read), diagram_text(after)));
  document.facts = to_json(Facts::object({{"diagram", job.diagram},
                                          {"data", job.data},
                                          {"method", result.method},
                                          {"seed", static_cast<long>(job.seed)},
                                          {"parameters", estimate_facts(model, result)},
                                          {"noise", noise_facts(model, fitted.noise)},
                                          {"chi2", result.chi2},
                                          {"prior_chi2", result.prior_chi2},
                                          {"rows", result.n},
                                          {"profiles", profile_facts(model, result)},
                                          {"correlation", correlation_facts(result)},
                                          {"before", metrics_facts(model, fitted.before)},
                                          {"after", metrics_facts(model, fitted.after)},
                                          {"simulations", result.runs},
                                          {"converged", result.converged},
                                          {"interrupted", result.stopped}}));
  document.files.emplace_back("fitted.json", text_in_folder(after, folder, "fitted.json"));
  document.files.emplace_back(
      "parameters.json", parameter_file_text(result, *program, *data, {job.diagram, job.data, date_text(), job.seed}));
  if (!fitted.attempts.empty() && !arguments.quiet()) print_table(method_table(model, fitted.attempts, true));
  publish(arguments, folder, document);
  if (!job.write.empty()) write_diagram(job.write, after);
  if (!result.stopped) return exit_code::done;
  throw Interrupted("interrupted; the best values so far are in " + folder);
}

}  // namespace

Verb fit_verb() {
  return {
      "fit",
      "find parameters, with their uncertainty",
      help,
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
      fit_verb_acts};
}

}  // namespace hysteron
