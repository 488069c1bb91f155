#include "report/pages/fit_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/signals/unit_words.h"
#include "report/pages/curves.h"
#include "report/pages/loops.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

double shown_si(const ParameterEstimate& e, double si) {
  return e.difference ? e.unit.difference_from_si(si) : e.unit.from_si(si);
}

/// As many digits of a value as its interval allows.
int digits_of(const ParameterEstimate& e, double si) {
  if (!e.low95 || !e.high95) return 5;
  return digits_within(shown_si(e, si), shown_si(e, *e.low95), shown_si(e, *e.high95));
}

std::string interval_text(const ParameterEstimate& e) {
  if (!e.low95 || !e.high95) return e.at_lower ? "at its lower bound" : e.at_upper ? "at its upper bound" : "-";
  const auto text = [&](double si) { return number_text(shown_si(e, si), digits_of(e, si)); };
  return fmt::format("{} .. {}", text(*e.low95), text(*e.high95));
}

std::string value_text_of(const ParameterEstimate& e, double si) {
  const int digits = digits_of(e, si);
  return e.difference ? difference_text(si, e.unit, digits) : quantity_text(si, e.unit, digits);
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

/// "y RMS 93 nm -> 0.2 nm (NRMSE 4.9 % -> 0.012 %)" of all outputs on the recordings of one role; "" without any.
std::string rms_text(const DataModel& model, const Comparison& before, const Comparison& after, Role role) {
  std::vector<std::string> parts;
  for (int y = 0; y < static_cast<int>(model.outputs().size()); ++y) {
    const Metrics* a = before.find(role, y);
    const Metrics* b = after.find(role, y);
    if (a == nullptr || b == nullptr) continue;
    const Unit unit = output_unit(model, y);
    parts.push_back(fmt::format("{} RMS {} (NRMSE {} -> {})", model.outputs()[static_cast<std::size_t>(y)],
                                fall_text(a->rms, b->rms, unit), percent_text(a->nrmse), percent_text(b->nrmse)));
  }
  return parts.empty() ? "" : fmt::format("{}: {}", to_text(role), fmt::join(parts, "; "));
}

/// Why an output ends with a larger rms on the train rows than it began with; "" if none does.
std::string risen_text(const DataModel& model, const Fitted& fitted) {
  constexpr double rounding = 1e-6;  // of the rms: less than is printed
  std::vector<std::string> risen;
  for (int y = 0; y < static_cast<int>(model.outputs().size()); ++y) {
    const Metrics* before = fitted.before.find(Role::train, y);
    const Metrics* after = fitted.after.find(Role::train, y);
    if (before == nullptr || after == nullptr || !(after->rms > before->rms * (1 + rounding))) continue;
    const Unit unit = output_unit(model, y);
    risen.push_back(fmt::format("{} from {} to {}", model.outputs()[static_cast<std::size_t>(y)],
                                difference_text(before->rms, unit), difference_text(after->rms, unit)));
  }
  if (risen.empty()) return "";
  const std::string what = fmt::format("The rms error of the train recordings has risen, {}", fmt::join(risen, ", "));
  if (!fitted.by_search)
    return fmt::format("{}: method {} does not minimize it. Compare with --method search.", what, fitted.result.method);
  if (!(fitted.weighed_after < fitted.weighed_before))
    return what +
           ", and so has the weighted error that the fit minimizes: the start was better. Try --starts 50, or other bounds.";
  std::string why = fmt::format(
      "{}. The fit minimizes another sum: each residual over its noise, where slow errors count less than fast ones as "
      "far as the noise is 1/f, and outputs count by their noise. That error fell from {} to {} of the noise.",
      what, percent_text(fitted.weighed_before), percent_text(fitted.weighed_after));
  return why + " To give every row the same weight, state the noise in the data set with \"one_over_f\": 0.";
}

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

/// How sure, as pictures: the interval of each parameter relative to its value, and the profiles where asked.
Section profile_section(const DataModel& model, const FitResult& result) {
  Section section;
  section.title = "Profiles";
  section.text.emplace_back(
      "Each parameter was held at values around the result and all others were fitted again. The 95 % interval ends where chi2 has risen by 3.84 times its scale; a curve that does not reach that has an open end.");
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

}  // namespace

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

void tell(Document& document, const DataModel& model, const Fitted& fitted) {
  const FitResult& result = fitted.result;
  const std::string train = rms_text(model, fitted.before, fitted.after, Role::train);
  const std::string validate = rms_text(model, fitted.before, fitted.after, Role::validate);
  document.headline = fmt::format("{} fitted; {}", count_text(static_cast<long>(result.estimates.size()), "parameter"),
                                  validate.empty() ? train : validate);
  if (!validate.empty()) document.sentences.push_back(train);
  if (auto risen = risen_text(model, fitted); !risen.empty()) document.warnings.push_back(std::move(risen));
  for (const auto& e : result.estimates)
    if (e.value) {
      const std::string interval = interval_text(e);
      document.sentences.push_back(fmt::format("{} = {}{}", name_text(model, e), value_text_of(e, *e.value),
                                               interval == "-" ? "" : fmt::format(" (95 %: {})", interval)));
    }
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
  residuals.title = "Residual against level, branch and rate";
  add_residual_figures(residuals, view, judged_recordings(model));
  add_split_figures(residuals, model, fitted.after);
  document.sections.push_back(std::move(residuals));

  for (const int r : judged_recordings(model)) {
    Section section;
    section.title = fmt::format("{} ({})", model.recording(r).name, to_text(model.recording(r).role));
    document.traces.push_back(recording_table(view, r, trace_file(model.recording(r).name, document.traces)));
    add_time_figures(section, view, document.traces.back());
    add_loop_figures(section, view, document.traces.back());
    document.sections.push_back(std::move(section));
  }
  document.answer = how_far_figures(view, judged_recordings(model), document.traces);
  Section change;
  change.title = "The diagram's change";
  change.preformatted = diff;
  change.preformatted_title = "fitted.json";
  document.sections.push_back(std::move(change));
}

Facts fit_facts(const FitJob& job, const DataModel& model, const Fitted& fitted) {
  const FitResult& result = fitted.result;
  return Facts::object({{"diagram", job.diagram},
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
                        {"interrupted", result.stopped}});
}

}  // namespace hysteron
