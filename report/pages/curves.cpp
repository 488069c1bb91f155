// Decides how measured and simulated rows become traces, tables and figures of a report.
// Does not simulate and does not judge (fit/compare/compare.h).
#include "report/pages/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/diagram/index.h"
#include "fit/signals/branches.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

/// Points of one residual figure over all recordings; more cannot be told apart on a screen.
constexpr std::size_t points_shown = 6000;

std::vector<double> converted(const Rows& si, const Unit& unit, bool difference) {
  std::vector<double> values(si.size());
  std::transform(si.begin(), si.end(), values.begin(),
                 [&](double v) { return difference ? unit.difference_from_si(v) : unit.from_si(v); });
  return values;
}

Unit rate_unit(const Unit& unit) {
  const Unit base = unit_of_differences(unit);
  return parse_unit(unit_text(base).empty() ? "1/s" : unit_text(base) + "/s");
}

/// Rate of the main input between rows [SI/s], as large as the row before where time ends.
Rows rate_of(const Rows& t, const Rows& u) {
  Rows rate(u.size());
  for (std::size_t i = 0; i + 1 < u.size(); ++i) rate[i] = (u[i + 1] - u[i]) / (t[i + 1] - t[i]);
  if (u.size() > 1) rate.back() = rate[u.size() - 2];
  return rate;
}

std::string input_name(const DataModel& model, int input) { return model.program().input_names[at(input)]; }

void add_column(CsvTable& table, const std::string& name, const Unit& unit, const Rows& si, bool difference = false) {
  const Unit written = difference ? unit_of_differences(unit) : unit;
  table.columns.push_back({name, written, converted(si, written, difference)});
}

Figure figure_of(const std::string& title, const std::string& x_label, const std::string& y_label) {
  Figure figure;
  figure.title = title;
  figure.x_label = x_label;
  figure.y_label = y_label;
  return figure;
}

double six_digits(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double scale = std::pow(10, 5 - std::floor(std::log10(std::abs(value))));
  return std::round(value * scale) / scale;
}

/// Points of the residual against something, one curve per branch of the main input.
class BranchCloud {
 public:
  void add(Branch branch, double x, double y) {
    auto& part = parts_[branch == Branch::rising ? 0U : branch == Branch::falling ? 1U : 2U];
    part.x.push_back(six_digits(x));
    part.y.push_back(six_digits(y));
  }
  void into(Figure& figure) const {
    constexpr const char* names[] = {"rising", "falling", "hold"};
    for (std::size_t k = 0; k < 3; ++k) {
      if (parts_[k].x.empty()) continue;
      Curve curve;
      curve.name = names[k];
      curve.style = "points";
      curve.x = parts_[k].x;
      curve.y = parts_[k].y;
      figure.curves.push_back(std::move(curve));
    }
  }

 private:
  struct Part {
    std::vector<double> x, y;
  };
  Part parts_[3];
};

std::size_t stride_for(const DataModel& model, const std::vector<int>& recordings, int output) {
  std::size_t rows = 0;
  for (const int r : recordings) rows += model.measured(r, output).size();
  return rows / points_shown + 1;
}

std::string role_text(const MetricsOf& m) { return m.all_roles ? "all recordings" : "all of " + to_text(m.role); }

std::string name_of(const DataModel& model, const MetricsOf& m) {
  return m.recording >= 0 ? model.recording(m.recording).name : role_text(m);
}

}  // namespace

Curve trace_curve(const CsvTable& table, const std::string& x, const std::string& y, const std::string& name,
                  const std::string& style, const std::string& role) {
  Curve curve;
  curve.name = name;
  curve.style = style;
  curve.role = role;
  curve.trace = table.file;
  curve.x_column = x;
  curve.y_column = y;
  return curve;
}

Unit unit_of_differences(const Unit& unit) { return unit.offset == 0 ? unit : si_unit(unit.dimension); }

std::string residual_column(const Beside& view, const std::string& output, std::size_t stage) {
  if (view.before == nullptr || stage > view.between.size()) return output + "_residual";
  return stage == 0 ? output + "_residual_before" : fmt::format("{}_residual_step{}", output, stage);
}

Unit output_unit(const DataModel& model, int output) {
  const std::string& name = model.outputs()[at(output)];
  for (int r = 0; r < model.n_recordings(); ++r)
    if (const auto found = model.recording(r).units.find(name); found != model.recording(r).units.end())
      return found->second;
  return model.program().signals[at(model.output_signal(output))].unit;
}

Unit input_unit(const DataModel& model, int input) {
  const std::string name = input_name(model, input);
  for (int r = 0; r < model.n_recordings(); ++r)
    if (const auto found = model.recording(r).units.find(name); found != model.recording(r).units.end())
      return found->second;
  return model.program().input_units[at(input)];
}

CsvTable recording_table(const Beside& view, int recording, const std::string& file) {
  const DataModel& model = *view.model;
  CsvTable table;
  table.file = file;
  const Rows& t = model.times(recording);
  add_column(table, "t", parse_unit("s"), t);
  for (int k = 0; k < static_cast<int>(model.program().input_names.size()); ++k) {
    const RowsPointer shared = model.shared_input(recording, k);
    const Rows& u = *shared;
    add_column(table, input_name(model, k), input_unit(model, k), u);
    if (k == model.main_input())
      add_column(table, input_name(model, k) + "_rate", rate_unit(input_unit(model, k)), rate_of(t, u));
  }
  for (int y = 0; y < static_cast<int>(model.outputs().size()); ++y) {
    if (model.measured(recording, y).empty()) continue;
    const std::string name = model.outputs()[at(y)];
    const Unit unit = output_unit(model, y);
    add_column(table, name + "_measured", unit, model.measured(recording, y));
    add_column(table, name + "_simulated", unit, view.now->predicted[at(recording)][at(y)]);
    add_column(table, name + "_residual", unit, view.now->residual[at(recording)][at(y)], true);
    if (view.before == nullptr) continue;
    add_column(table, name + "_simulated_before", unit, view.before->predicted[at(recording)][at(y)]);
    add_column(table, residual_column(view, name, 0), unit, view.before->residual[at(recording)][at(y)], true);
    for (std::size_t k = 0; k < view.between.size(); ++k)
      add_column(table, residual_column(view, name, k + 1), unit, view.between[k]->residual[at(recording)][at(y)],
                 true);
  }
  return table;
}

std::vector<Figure> time_figures(const Beside& view, const CsvTable& table, int output) {
  const std::string name = view.model->outputs()[at(output)];
  if (table.find(name + "_measured") == nullptr) return {};
  const bool after = view.before != nullptr;
  const Unit unit = output_unit(*view.model, output);
  Figure both = figure_of(name + ": measured and simulated", "t [s]", axis_text(name, unit));
  both.curves.push_back(trace_curve(table, "t", name + "_measured", "measured", "line", "measured"));
  if (after)
    both.curves.push_back(trace_curve(table, "t", name + "_simulated_before", "simulated before", "line", "before"));
  both.curves.push_back(trace_curve(table, "t", name + "_simulated", after ? "simulated after" : "simulated", "line",
                                    after ? "after" : "simulated"));
  Figure left = figure_of(name + ": residual (measured minus simulated)", "t [s]",
                          axis_text("residual", unit_of_differences(unit)));
  if (after) left.curves.push_back(trace_curve(table, "t", name + "_residual_before", "before", "line", "before"));
  left.curves.push_back(
      trace_curve(table, "t", name + "_residual", after ? "after" : "residual", "line", after ? "after" : "residual"));
  return {std::move(both), std::move(left)};
}

void add_time_figures(Section& section, const Beside& view, const CsvTable& table) {
  for (int y = 0; y < static_cast<int>(view.model->outputs().size()); ++y)
    for (auto& figure : time_figures(view, table, y)) section.figures.push_back(std::move(figure));
}

void add_residual_figures(Section& section, const Beside& view, const std::vector<int>& recordings) {
  const DataModel& model = *view.model;
  const int main = model.main_input();
  if (main < 0) return;
  const Unit u_unit = input_unit(model, main);
  const std::string u_name = input_name(model, main);
  for (int y = 0; y < static_cast<int>(model.outputs().size()); ++y) {
    const std::string name = model.outputs()[at(y)];
    const Unit unit = unit_of_differences(output_unit(model, y));
    const std::size_t stride = stride_for(model, recordings, y);
    BranchCloud by_level, by_rate;
    for (const int r : recordings) {
      const Rows& residual = view.now->residual[at(r)][at(y)];
      if (residual.empty()) continue;
      const RowsPointer shared = model.shared_input(r, main);
      const Rows& u = *shared;
      const Rows rate = rate_of(model.times(r), u);
      const auto branch = branches(u);
      for (std::size_t i = 0; i < residual.size(); i += stride) {
        const double e = unit.difference_from_si(residual[i]);
        by_level.add(branch[i], u_unit.from_si(u[i]), e);
        by_rate.add(branch[i], rate_unit(u_unit).from_si(rate[i]), e);
      }
    }
    const std::string rows = stride == 1 ? "Every row judged." : fmt::format("One of {} rows judged.", stride);
    Figure level =
        figure_of(name + ": residual against level and branch", axis_text(u_name, u_unit), axis_text("residual", unit));
    level.caption = rows + " A lens that opens between rising and falling is memory; one single curve is a static law.";
    by_level.into(level);
    Figure rate = figure_of(name + ": residual against rate", axis_text(u_name + " rate", rate_unit(u_unit)),
                            axis_text("residual", unit));
    rate.caption = rows + " A straight line through zero is a delay or a lag.";
    by_rate.into(rate);
    section.figures.push_back(std::move(level));
    section.figures.push_back(std::move(rate));
  }
}

void add_split_figures(Section& section, const DataModel& model, const Comparison& comparison) {
  for (const auto& of_output : comparison.splits)
    for (const auto& split : of_output.splits) {
      const std::string name = comparison.splits.size() > 1 ? model.outputs()[at(of_output.output)] + ", " : "";
      Figure figure = figure_of(fmt::format("{}{}", name, split.title), "share of the squared error [%]", "");
      figure.kind = "bars";
      figure.caption = split.sentence;
      for (const auto& part : split.parts) {
        Bar bar;
        bar.label = part.label;
        bar.value = 100 * part.error;
        bar.text = fmt::format("{} in {} of the {}, rms {}", percent_text(part.error), percent_text(part.rows),
                               split.variable == "frequency" ? "spectrum" : "samples",
                               difference_text(part.rms, unit_of_differences(output_unit(model, of_output.output)), 3));
        figure.bars.push_back(std::move(bar));
      }
      section.figures.push_back(std::move(figure));
    }
}

Table metrics_table(const DataModel& model, const Comparison& comparison) {
  Table table;
  const bool many = model.outputs().size() > 1;
  table.columns = {"recording", "role", "rows", "RMS", "peak", "NRMSE", "fit"};
  if (many) table.columns.insert(table.columns.begin() + 2, "output");
  for (const auto& m : comparison.metrics) {
    const Unit unit = unit_of_differences(output_unit(model, m.output));
    std::vector<std::string> row{name_of(model, m), m.recording >= 0 ? to_text(m.role) : ""};
    if (many) row.push_back(model.outputs()[at(m.output)]);
    row.push_back(std::to_string(m.metrics.rows));
    row.push_back(difference_text(m.metrics.rms, unit));
    row.push_back(difference_text(m.metrics.peak, unit));
    row.push_back(percent_text(m.metrics.nrmse));
    row.push_back(percent_text(m.metrics.fit / 100));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Facts metrics_facts(const DataModel& model, const Comparison& comparison) {
  Facts::List list;
  for (const auto& m : comparison.metrics) {
    const Unit unit = unit_of_differences(output_unit(model, m.output));
    list.push_back(Facts::object({{"recording", m.recording >= 0 ? model.recording(m.recording).name : "all"},
                                  {"role", m.all_roles ? "all" : to_text(m.role)},
                                  {"output", model.outputs()[at(m.output)]},
                                  {"unit", unit_text(unit)},
                                  {"rows", m.metrics.rows},
                                  {"rms", unit.difference_from_si(m.metrics.rms)},
                                  {"peak", unit.difference_from_si(m.metrics.peak)},
                                  {"nrmse", m.metrics.nrmse},
                                  {"fit_percent", m.metrics.fit}}));
  }
  return list;
}

namespace {

Facts span_facts(const SplitPart& part) {
  Facts::List list;
  for (const auto& in_recording : part.spans) {
    Facts::List spans;
    for (const auto& span : in_recording.spans) spans.push_back(std::vector<double>{span.from, span.to});
    list.push_back(Facts::object({{"recording", in_recording.recording}, {"seconds", spans}}));
  }
  return list;
}

}  // namespace

Facts split_facts(const DataModel& model, const Comparison& comparison) {
  Facts::List list;
  for (const auto& of_output : comparison.splits)
    for (const auto& split : of_output.splits) {
      Facts::List parts;
      for (const auto& part : split.parts)
        parts.push_back(Facts::object({{"label", part.label},
                                       {"share_of_squared_error", part.error},
                                       {"share_of_rows", part.rows},
                                       {"spans", span_facts(part)}}));
      list.push_back(Facts::object({{"output", model.outputs()[at(of_output.output)]},
                                    {"by", split.variable},
                                    {"sentence", split.sentence},
                                    {"parts", parts}}));
    }
  return list;
}

std::vector<int> judged_recordings(const DataModel& model) {
  constexpr Role roles[] = {Role::train, Role::validate};
  return model.recordings(roles);
}

}  // namespace hysteron
