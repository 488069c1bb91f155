#include "app/jobs/job_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/cli/load.h"
#include "app/jobs/job_measured.h"
#include "app/jobs/job_values.h"
#include "draw/drawing.h"
#include "fit/signals/features.h"
#include "io/diagram/diagram_file.h"
#include "report/page/figure_file.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

/// The unit in which an axis is drawn.
Unit axis_unit(const AxisWish& axis, const Unit& own, bool difference) {
  if (!axis.unit) return own;
  Unit unit = parse_unit(axis.unit->text, axis.unit->pointer);
  if (!(unit.dimension == own.dimension))
    fail("wrong_unit", axis.unit->pointer,
         fmt::format("what is drawn is in {}, the axis in {}", unit_text(own), unit_text(unit)),
         fmt::format("write the axis in {}", unit_text(own)));
  if (difference) unit.offset = 0;
  return unit;
}

void to_unit(std::vector<double>& values, const Unit& unit) {
  for (auto& v : values) v = unit.from_si(v);
}

std::string label(const AxisWish& axis, const std::string& otherwise, const Unit& unit) {
  return axis_text(axis.label.empty() ? otherwise : axis.label, unit);
}

class Plotter {
 public:
  Plotter(JobRunner& runner, JobPage& page) : runner_(runner), page_(page) {}

  void draw(const PlotWish& plot) {
    ++number_;
    if (plot.kind == "bode") {
      for (const char* what : {"gain", "phase"}) bode(plot, what);
      return;
    }
    Figure figure = empty(plot);
    for (const auto& run : runs_drawn(runner_, plot)) runner_.at(plot.pointer, [&] { add_run(plot, run, figure); });
    ranges(plot, figure);
    page_.section.figures.push_back(std::move(figure));
  }

 private:
  Figure empty(const PlotWish& plot) const {
    Figure figure;
    figure.title = plot.title;
    figure.caption = plot.caption;
    figure.log_x = plot.x.log;
    figure.log_y = plot.y.log;
    return figure;
  }

  std::string title_of(const std::string& run) const {
    for (const auto& r : runner_.job().runs)
      if (r.name == run) return r.title;
    return run;
  }

  void add_run(const PlotWish& plot, const WrittenText& run, Figure& figure) {
    const RunResult& result = runner_.result(run);
    const bool several = plot.y.signals.size() > 1;
    if (plot.kind == "medians") return add_medians(plot, run, result, figure);
    for (const auto& signal : plot.y.signals) {
      auto [x, y] = points(plot, signal, result);
      figure.x_label = label(plot.x, x.name, x.unit);
      figure.y_label = label(plot.y, y.name, y.unit);
      std::string name = several ? signal.signal.text : title_of(run.text);
      if (several && plot.runs.size() != 1) name += " " + title_of(run.text);
      add_curve(figure, name, style_of(plot.kind), run.text + (several ? "-" + signal.signal.text : ""), std::move(x),
                std::move(y));
    }
  }

  /// Median of y among the rows with the same x.
  void add_medians(const PlotWish& plot, const WrittenText& run, const RunResult& result, Figure& figure) {
    auto [x, y] = points(plot, plot.y.signals.front(), result);
    figure.x_label = label(plot.x, x.name, x.unit);
    figure.y_label = label(plot.y, y.name, y.unit);
    auto medians = features::medians(x.values, y.values);
    add_curve(figure, title_of(run.text), "line", run.text, {x.name, x.unit, std::move(medians.x)},
              {y.name, y.unit, std::move(medians.y)});
  }

  static const char* style_of(const std::string& kind) {
    return kind == "scatter" ? "points" : kind == "histogram" ? "steps" : "line";
  }

  /// One signal of one run as it is drawn: what stands along x and along y, in the units of the axes.
  std::pair<CsvColumn, CsvColumn> points(const PlotWish& plot, const SignalWish& signal, const RunResult& result) {
    JobRunner::Rows rows = runner_.rows(signal, result, plot.between, plot.rezero, plot.where);
    CsvColumn x{result.columns.front().name, result.columns.front().unit, rows.t};
    CsvColumn y{signal.signal.text, axis_unit(plot.y, rows.unit, rows.difference), rows.y};
    if (!plot.x.signals.empty()) {
      JobRunner::Rows along = runner_.rows(plot.x.signals.front(), result, plot.between, false, plot.where);
      x = {plot.x.signals.front().signal.text, along.unit, std::move(along.y)};
    }
    if (plot.kind == "spectrum") {
      auto lines = spectrum_of(rows, plot.pointer);
      x = {"f", parse_unit("Hz"), std::move(lines.frequency)};
      y = {y.name, without_offset(y.unit), std::move(lines.amplitude)};
    } else if (plot.kind == "histogram") {
      auto bars = features::histogram(y.values, plot.bins);
      x = {y.name, y.unit, std::move(bars.middle)};
      y = {"count", parse_unit(""), std::move(bars.count)};
    }
    if (plot.kind == "scatter") thin_out(x.values, y.values);
    x.unit = axis_unit(plot.x, x.unit, false);
    to_unit(x.values, x.unit);
    to_unit(y.values, y.unit);
    return {std::move(x), std::move(y)};
  }

  /// Of very many points every n-th: more of them would cover each other, and fill the page.
  static void thin_out(std::vector<double>& x, std::vector<double>& y) {
    constexpr std::size_t most = 5000;
    const std::size_t n = (x.size() + most - 1) / most;
    if (n < 2) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < x.size(); i += n, ++kept) {
      x[kept] = x[i];
      y[kept] = y[i];
    }
    x.resize(kept);
    y.resize(kept);
  }

  void bode(const PlotWish& plot, const std::string& what) {
    Figure figure = empty(plot);
    figure.title = plot.title.empty() ? what : plot.title + ": " + what;
    figure.log_x = true;
    figure.log_y = what == "gain";
    for (const auto& run : runs_drawn(runner_, plot))
      runner_.at(run.pointer, [&] {
        const RunResult& result = runner_.result(run);
        const RunColumn& f = column_of(result, {"f", run.pointer});
        const RunColumn& y = column_of(result, {what, run.pointer});
        auto x_values = f.values, y_values = y.values;
        to_unit(y_values, y.unit);
        figure.x_label = label(plot.x, "f", f.unit);
        figure.y_label = axis_text(what, y.unit);
        add_curve(figure, title_of(run.text), "line", what + "-" + run.text, {"f", f.unit, std::move(x_values)},
                  {what, y.unit, std::move(y_values)});
      });
    if (plot.x.from && plot.x.to)
      figure.x_range = {JobRunner::si(*plot.x.from, parse_unit("Hz")), JobRunner::si(*plot.x.to, parse_unit("Hz"))};
    page_.section.figures.push_back(std::move(figure));
  }

  void add_curve(Figure& figure, const std::string& name, const std::string& style, const std::string& file,
                 CsvColumn x, CsvColumn y) {
    if (x.name == y.name) y.name += "_y";
    CsvTable table;
    table.file = fmt::format("{}-{}-{}", runner_.job().name, number_, trace_file_name(file));
    Curve curve;
    curve.name = name;
    curve.style = style;
    curve.trace = table.file;
    curve.x_column = x.name;
    curve.y_column = y.name;
    table.columns = {std::move(x), std::move(y)};
    figure.curves.push_back(std::move(curve));
    page_.traces.push_back(std::move(table));
  }

  /// Ends of the axes as the job gives them: plain numbers are in the axis' unit.
  void ranges(const PlotWish& plot, Figure& figure) const {
    const auto range = [](const AxisWish& axis, const Unit& unit, std::vector<double>& to) {
      if (!axis.from || !axis.to) return;
      to = {unit.from_si(JobRunner::si(*axis.from, unit)), unit.from_si(JobRunner::si(*axis.to, unit))};
    };
    if (figure.curves.empty()) return;
    const auto& table = page_.traces.back();
    range(plot.x, table.columns[0].unit, figure.x_range);
    range(plot.y, table.columns[1].unit, figure.y_range);
  }

  JobRunner& runner_;
  JobPage& page_;
  int number_ = 0;
};

void add_drawings(const RunsJob& job, const std::vector<std::string>& allowed, JobPage& page) {
  int number = 0;
  for (const auto& [caption, file] : job.draw) {
    const Diagram diagram = read_diagram(file, allowed);
    const ProgramPointer program = compile_file(diagram);
    Figure figure;
    figure.kind = "picture";
    figure.title = caption;
    figure.picture = fmt::format("{}-drawing{}.svg", job.name, ++number);
    try {
      page.files.emplace_back(figure.picture, diagram_svg(diagram, *program, registry(), {}));
      page.section.figures.push_back(std::move(figure));
    } catch (const Error& error) {
      if (error.problems.front().code != "no_graphviz") throw;
      page.section.text.push_back(fmt::format("{}: not drawn, {}.", caption, error.problems.front().what));
    }
  }
}

/// The figure with the rows inside its range alone: nobody can move a picture to see the others.
Figure cut_to_range(Figure figure, const std::vector<CsvTable>& traces) {
  if (figure.x_range.size() != 2) return figure;
  for (auto& curve : figure.curves) {
    const auto table =
        std::find_if(traces.begin(), traces.end(), [&](const CsvTable& t) { return t.file == curve.trace; });
    if (table == traces.end() || table->find(curve.x_column) == nullptr || table->find(curve.y_column) == nullptr)
      continue;
    const auto &x = table->find(curve.x_column)->values, &y = table->find(curve.y_column)->values;
    curve.trace.clear();
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (x[i] < figure.x_range[0] || x[i] > figure.x_range[1]) continue;
      curve.x.push_back(x[i]);
      curve.y.push_back(y[i]);
    }
  }
  return figure;
}

/// Each figure as a picture file too, for papers and texts.
void add_pictures(const RunsJob& job, JobPage& page) {
  constexpr std::size_t points = 1600;
  Document document;
  document.traces = page.traces;
  int number = 0;
  for (const auto& figure : page.section.figures)
    if (figure.kind == "curves")
      page.files.emplace_back(fmt::format("{}-{}.svg", job.name, ++number),
                              figure_file(document, cut_to_range(figure, page.traces), points));
}

}  // namespace

std::string figure_name(const std::string& job) {
  if (!job.starts_with("fig")) return job;
  std::string name = "Fig. " + job.substr(3);
  std::replace(name.begin(), name.end(), '_', '.');
  return name;
}

std::vector<WrittenText> runs_drawn(JobRunner& runner, const PlotWish& plot) {
  if (!plot.runs.empty()) return plot.runs;
  std::vector<WrittenText> list;
  std::string first;
  for (const auto& run : runner.job().runs) {
    if (plot.kind == "bode") {
      if (run.kind == RunKind::linearize) list.push_back({run.name, run.pointer});
      continue;
    }
    const RunResult& result = runner.result({run.name, run.pointer});
    const auto has = [&](const SignalWish& s) { return result.find(s.signal.text) != nullptr; };
    if (!result.columns.empty() && std::all_of(plot.y.signals.begin(), plot.y.signals.end(), has) &&
        std::all_of(plot.x.signals.begin(), plot.x.signals.end(), has))
      list.push_back({run.name, run.pointer});
    else if (!result.columns.empty() && first.empty())
      first = run.name;
  }
  if (list.empty() && !first.empty()) list.push_back({first, plot.pointer});  // says which signal it lacks
  return list;
}

JobPage page_of(JobRunner& runner, const std::vector<std::string>& allowed) {
  const RunsJob& job = runner.job();
  JobPage page;
  page.section.title = fmt::format("{}: {}", figure_name(job.name), job.title);
  const auto say = [&](const char* what, const std::string& text) {
    if (!text.empty()) page.section.text.push_back(what + text);
  };
  say("", job.surrogate);
  say("Assumed: ", job.assumed);
  say("To be seen: ", job.shows);
  say("Learnt: ", job.learnt);
  say("", job.remark);
  say("", fmt::format("Again: `hysteron reproduce {}`", job.name));
  add_drawings(job, allowed, page);
  Plotter plotter(runner, page);
  for (const auto& plot : job.plots) plotter.draw(plot);
  page.section.tables = measured_tables(runner);
  add_pictures(job, page);
  return page;
}

Table claim_table(const std::vector<ClaimOutcome>& claims) {
  Table table;
  table.columns = {"claim", "what it says", "what came out", "expected", "outcome"};
  for (const auto& c : claims) {
    bool first = true;
    for (const auto& part : c.parts) {
      std::string outcome = part.holds ? (c.claim.calibrated.empty() ? "agrees" : "calibrated") : "differs";
      if (!part.holds && !part.remark.empty()) outcome += ": " + part.remark;
      table.rows.push_back({first ? c.claim.id : "", first ? c.claim.says : "",
                            fmt::format("{}: {}", figure_name(part.job), part.came_out), part.expected, outcome});
      if (first && !c.claim.remark.empty()) table.rows.back()[1] += fmt::format(" ({})", c.claim.remark);
      first = false;
    }
    if (c.parts.empty())
      table.rows.push_back({c.claim.id, c.claim.says, "-", "-", fmt::format("{}: {}", c.outcome, c.reason)});
  }
  return table;
}

}  // namespace hysteron
