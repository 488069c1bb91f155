// The verb fit: finds the free parameters of a diagram from recordings, with their uncertainty.
// Does not change the structure of the diagram.
#include "fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
#include "io/diagram_file.h"

namespace hysteron {
namespace {

constexpr char help[] =
    "Answers: which values of the free parameters fit the recordings, and how sure are they.\n"
    "Free is what the diagram marks (\"free\": true), the parameters of effects that were added, and what --free\n"
    "names. Only train recordings are fitted; validate recordings are judged with the result. Parameters that the\n"
    "data do not determine get no value.\n\n"
    "Examples:\n"
    "  hysteron fit next.json --data dataset.json\n"
    "  hysteron fit stage.json --data dataset.json --free core.weights --write fitted.json\n\n"
    "Writes into the folder: result.json, traces/*.csv, report.html, fitted.json (the diagram with its new\n"
    "values) and parameters.json (values, standard deviations, 95 % intervals). --write FILE.json writes the\n"
    "fitted diagram to a place of its own too.\n"
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

Table parameter_table(const FitResult& result) {
  Table table;
  table.columns = {"parameter", "value", "95 % interval", "start", "found by"};
  for (const auto& e : result.estimates)
    table.rows.push_back({e.path, e.value ? value_text_of(e, *e.value) : "not determined by these data",
                          interval_text(e), value_text_of(e, e.start), e.linear ? "linear least squares" : "search"});
  return table;
}

Facts estimate_facts(const FitResult& result) {
  Facts::List list;
  for (const auto& e : result.estimates) {
    const auto shown = [&](const std::optional<double>& si) -> std::optional<double> {
      if (!si) return {};
      return e.difference ? e.unit.difference_from_si(*si) : e.unit.from_si(*si);
    };
    list.push_back(
        Facts::object({{"parameter", e.path},
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
FitOptions fit_options(Progress& progress) {
  FitOptions settings;
  settings.progress = [&progress](const FitProgress& now) {
    progress.show(-1, fmt::format("{}: {}, chi2 {:.6g}", now.stage, count_text(now.runs, "simulation"), now.chi2));
    return !interrupted();
  };
  return settings;
}

struct Fitted {
  FitResult result;
  Comparison before, after;
  std::vector<DelayFinding> delays;
};

Fitted fit_and_compare(DataModel& model, const std::vector<FreeParameter>& free, bool quiet) {
  Progress progress(quiet);
  const DeferInterrupts defer;
  auto with_noise = fit_and_noise(model, free, fit_options(progress));
  progress.clear();
  FitResult& result = with_noise.result;
  if (!result.ok)
    fail_numerics("fit_failed", "fit", result.error, "start from other values, or give the parameters narrower bounds");
  const auto recordings = judged_recordings(model);
  const Judge judge(model, with_noise.noise);
  const Prediction start = model.predict({}, recordings);
  const Prediction end = model.predict(result.values, recordings);
  if (!end.ok) fail_numerics("fit_failed", "fit", end.error, "give the parameters narrower bounds");
  Comparison after = compare(model, judge, end, recordings);
  // A start that cannot be simulated is no obstacle to a fit; then there is nothing to show before it.
  Comparison before = start.ok ? compare(model, judge, start, recordings) : after;
  return {std::move(result), std::move(before), std::move(after), find_delays(model, judge, end)};
}

void add_sections(Document& document, const DataModel& model, const Fitted& fitted, const std::string& diff) {
  Section parameters;
  parameters.title = "Parameters";
  parameters.tables.push_back(parameter_table(fitted.result));
  for (const auto& line : strong_correlations(fitted.result)) parameters.text.push_back(line);
  parameters.text.push_back(fmt::format("Method: {}; {}; {}, {} failed.", fitted.result.method,
                                        fitted.result.convergence, count_text(fitted.result.runs, "simulation"),
                                        fitted.result.failed_runs));
  document.sections.push_back(std::move(parameters));

  Section errors;
  errors.title = "Error before and after";
  errors.tables.push_back(metrics_table(model, fitted.before));
  errors.tables.back().title = "before the fit";
  errors.tables.push_back(metrics_table(model, fitted.after));
  errors.tables.back().title = "after the fit";
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

int fit_verb_acts(const Arguments& arguments) {
  const Diagram diagram = load_diagram(arguments);
  const ProgramPointer program = compile_file(diagram);
  const auto data = std::make_shared<const DataSet>(load_data(arguments, *program));
  auto wanted = effect_parameters(diagram, *program, all_effects());
  for (const auto& path : arguments.list("--free")) wanted.push_back(path);
  const auto free = free_parameters(*program, wanted);
  if (free.empty())
    fail("nothing_free", arguments.text("diagram"), "no parameter of the diagram is free",
         "mark parameters of the diagram with \"free\": true, or name them with --free core.weights");
  DataModelOptions model_options;
  model_options.threads = 2;
  DataModel model(program, data, model_options);
  const Fitted fitted = fit_and_compare(model, free, arguments.quiet());
  const FitResult& result = fitted.result;
  const Diagram after = with_parameters(diagram, *program, result.values);

  const std::string folder = result_folder(arguments, "fit");
  Document document;
  document.verb = "fit";
  document.title = diagram.title;
  const std::string train = rms_text(model, fitted.before, fitted.after, Role::train);
  const std::string validate = rms_text(model, fitted.before, fitted.after, Role::validate);
  document.headline = fmt::format("{} fitted; {}", count_text(static_cast<long>(free.size()), "parameter"),
                                  validate.empty() ? train : validate);
  if (!validate.empty()) document.sentences.push_back(train);
  for (const auto& e : result.estimates)
    if (e.value)
      document.sentences.push_back(
          fmt::format("{} = {} (95 %: {})", e.path, value_text_of(e, *e.value), interval_text(e)));
  for (const auto& u : result.undetermined) document.warnings.push_back(u.sentence);
  for (const auto& delay : fitted.delays)
    if (!delay.sentence.empty()) document.warnings.push_back(delay.sentence);
  for (const auto& remark : result.remarks) document.warnings.push_back(remark);
  for (const auto& remark : data->remarks) document.warnings.push_back(remark);
  if (result.stopped) document.warnings.emplace_back("Interrupted: these are the best values found until then.");
  add_sections(document, model, fitted, text_diff(diagram_text(diagram), diagram_text(after)));
  document.facts = to_json(Facts::object({{"diagram", arguments.text("diagram")},
                                          {"data", arguments.text("--data")},
                                          {"parameters", estimate_facts(result)},
                                          {"correlation", correlation_facts(result)},
                                          {"before", metrics_facts(model, fitted.before)},
                                          {"after", metrics_facts(model, fitted.after)},
                                          {"simulations", result.runs},
                                          {"converged", result.converged},
                                          {"interrupted", result.stopped}}));
  document.files.emplace_back("fitted.json", text_in_folder(after, folder, "fitted.json"));
  document.files.emplace_back("parameters.json", parameter_file_text(result, *program, *data));
  publish(arguments, folder, document);
  if (arguments.has("--write")) write_diagram(arguments.text("--write"), after);
  if (!result.stopped) return exit_code::done;
  throw Interrupted("interrupted; the best values so far are in " + folder);
}

}  // namespace

Verb fit_verb() {
  return {"fit",
          "find parameters, with their uncertainty",
          help,
          {options::diagram(),
           options::data(true),
           {"--free", "PATH", "also find this parameter, e.g. core.weights (all its elements)", false, true},
           {"--write", "FILE.json", "write the fitted diagram there too", false, false},
           options::output_folder(),
           options::set(),
           options::choose(),
           options::allow()},
          fit_verb_acts};
}

}  // namespace hysteron
