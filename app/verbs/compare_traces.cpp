#include "app/verbs/compare_traces.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/cli/load.h"
#include "engine/diagram/error.h"
#include "fit/compare/trace_files.h"
#include "io/data/table_file.h"
#include "report/pages/curves.h"
#include "report/pages/facts.h"
#include "report/pages/numbers.h"
#include "report/pages/text_plot.h"

namespace hysteron {
namespace {

TraceWishes wishes_of(const Arguments& arguments) {
  TraceWishes wishes;
  wishes.over = arguments.text("--over");
  for (const auto& written : arguments.list("--tolerance")) wishes.tolerances.push_back(read_trace_tolerance(written));
  for (const auto& written : arguments.list("--pair")) {
    const auto equals = written.find('=');
    if (equals == 0 || equals + 1 == written.size())
      fail("bad_command_line", "--pair", fmt::format("\"{}\" names no two columns", written),
           "write FIRST=SECOND: --pair y=stage; one name is for a column that both files have");
    wishes.pairs.emplace_back(written.substr(0, equals),
                              equals == std::string::npos ? written : written.substr(equals + 1));
  }
  return wishes;
}

std::string name_of(const TracePair& pair) {
  return pair.first == pair.second ? pair.first : fmt::format("{} and {}", pair.first, pair.second);
}

std::string place_text(const TraceComparison& c, double x) {
  return fmt::format("{} = {}", c.axis, quantity_text(x, c.axis_unit, 6));
}

/// "y: outside "2 nm" in 12 of 100 points, furthest at t = 0.1 s, by 3 nm."
std::string sentence_of(const TraceComparison& c, const TracePair& pair) {
  const TraceDistance& d = pair.distance;
  const auto points = static_cast<long>(d.x.size());
  const std::string how_far =
      fmt::format("largest difference {} at {}, RMS {}, {}", difference_text(d.largest, pair.unit),
                  place_text(c, d.x[d.largest_at]), difference_text(d.rms, pair.unit), count_text(points, "point")) +
      (d.left_out == 0 ? "" : fmt::format(" ({} more outside the common range)", d.left_out));
  if (!pair.written) return fmt::format("{}: {}.", name_of(pair), how_far);
  if (d.outside == 0) return fmt::format("{}: within \"{}\"; {}.", name_of(pair), pair.written->written, how_far);
  return fmt::format("{}: OUTSIDE \"{}\" in {} of {}, furthest at {}, {} beyond it; {}.", name_of(pair),
                     pair.written->written, d.outside, count_text(points, "point"), place_text(c, d.x[d.worst_at]),
                     difference_text(d.beyond[d.worst_at], pair.unit), how_far);
}

void add_column(CsvTable& table, const std::string& name, const Unit& unit, const std::vector<double>& si,
                bool difference = false) {
  const Unit shown = difference ? unit_of_differences(unit) : unit;
  std::vector<double> values;
  for (const double v : si) values.push_back(difference ? shown.difference_from_si(v) : shown.from_si(v));
  table.columns.push_back({name, shown, std::move(values)});
}

/// One curve as it was read, in its order.
CsvTable line_table(const TraceComparison& c, const TracePair& pair, const TraceLine& line, const std::string& file) {
  CsvTable table;
  table.file = file;
  add_column(table, c.axis, c.axis_unit, line.x);
  add_column(table, pair.first, pair.unit, line.y);
  return table;
}

CsvTable difference_table(const TraceComparison& c, const TracePair& pair, const std::string& file) {
  const TraceDistance& d = pair.distance;
  std::vector<double> difference, below;
  for (std::size_t i = 0; i < d.x.size(); ++i) {
    difference.push_back(d.second[i] - d.first[i]);
    below.push_back(-d.allowed[i]);
  }
  CsvTable table;
  table.file = file;
  add_column(table, c.axis, c.axis_unit, d.x);
  add_column(table, "first", pair.unit, d.first);
  add_column(table, "second", pair.unit, d.second);
  add_column(table, "difference", pair.unit, difference, true);
  add_column(table, "allowed", pair.unit, d.allowed, true);
  add_column(table, "allowed_below", pair.unit, below, true);
  add_column(table, "beyond", pair.unit, d.beyond, true);
  return table;
}

/// The points outside the tolerance, at `values` (SI) of the pair.
Curve outside_curve(const TraceComparison& c, const TracePair& pair, const std::vector<double>& values,
                    const Unit& unit) {
  Curve curve;
  curve.name = "outside the tolerance";
  curve.style = "points";
  curve.role = "residual";
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(pair.distance.beyond[i] > 0)) continue;
    curve.x.push_back(c.axis_unit.from_si(pair.distance.x[i]));
    curve.y.push_back(unit.from_si(values[i]));
  }
  return curve;
}

Figure figure_of(const std::string& title, const TraceComparison& c, const std::string& y_label) {
  Figure figure;
  figure.title = title;
  figure.x_label = axis_text(c.axis, c.axis_unit);
  figure.y_label = y_label;
  return figure;
}

Figure both_curves(const TraceComparison& c, const TracePair& pair, const CsvTable& first, const CsvTable& second) {
  Figure figure = figure_of(name_of(pair), c, axis_text(pair.first, pair.unit));
  const bool points = pair.distance.points_of_first;
  const auto style = [](const TraceLine& line, const TraceLine& other) {
    return 2 * line.x.size() < other.x.size() ? "points" : "line";  // the few points of a digitized figure
  };
  figure.curves.push_back(
      trace_curve(first, c.axis, pair.first, "first", style(pair.first_line, pair.second_line), "measured"));
  figure.curves.push_back(
      trace_curve(second, c.axis, pair.first, "second", style(pair.second_line, pair.first_line), "simulated"));
  if (pair.written && pair.distance.outside > 0)
    figure.curves.push_back(outside_curve(c, pair, points ? pair.distance.first : pair.distance.second, pair.unit));
  return figure;
}

Figure differences(const TraceComparison& c, const TracePair& pair, const CsvTable& table) {
  const Unit unit = unit_of_differences(pair.unit);
  Figure figure = figure_of("second minus first", c, axis_text("difference", unit));
  const char* style = c.course == TraceCourse::rising ? "line" : "points";
  figure.curves.push_back(trace_curve(table, c.axis, "difference", "difference", style, "residual"));
  if (!pair.written) return figure;
  if (pair.written->along) figure.caption = "The difference at the same place; the tolerance also looks beside it.";
  if (c.course == TraceCourse::rising)
    for (const char* side : {"allowed", "allowed_below"})
      figure.curves.push_back(trace_curve(table, c.axis, side, "tolerance", "line", "before"));
  std::vector<double> difference;
  for (std::size_t i = 0; i < pair.distance.x.size(); ++i) difference.push_back(unit.to_si(table.columns[3].values[i]));
  if (pair.distance.outside > 0) figure.curves.push_back(outside_curve(c, pair, difference, unit));
  return figure;
}

void add_pair(Document& document, const TraceComparison& c, const TracePair& pair, const std::string& type) {
  const auto add = [&](CsvTable table) { document.traces.push_back(std::move(table)); };
  add(line_table(c, pair, pair.first_line, trace_file(pair.first + " first", document.traces, type)));
  add(line_table(c, pair, pair.second_line, trace_file(pair.first + " second", document.traces, type)));
  add(difference_table(c, pair, trace_file(pair.first + " difference", document.traces, type)));
  const std::size_t n = document.traces.size();
  Section section;
  section.title = name_of(pair);
  section.text.push_back(sentence_of(c, pair));
  section.figures.push_back(both_curves(c, pair, document.traces[n - 3], document.traces[n - 2]));
  section.figures.push_back(differences(c, pair, document.traces[n - 1]));
  document.sections.push_back(std::move(section));
}

Table distances_table(const TraceComparison& c) {
  Table table;
  table.title = "Overall error";
  table.columns = {"signal", "points", "left out", "largest difference", "at", "RMS", "tolerance", "outside"};
  for (const auto& pair : c.pairs) {
    const TraceDistance& d = pair.distance;
    table.rows.push_back({name_of(pair), std::to_string(d.x.size()), std::to_string(d.left_out),
                          difference_text(d.largest, pair.unit), place_text(c, d.x[d.largest_at]),
                          difference_text(d.rms, pair.unit), pair.written ? pair.written->written : "none",
                          pair.written ? std::to_string(d.outside) : ""});
  }
  return table;
}

Facts pair_facts(const TraceComparison& c, const TracePair& pair) {
  const TraceDistance& d = pair.distance;
  const Unit unit = unit_of_differences(pair.unit);
  Facts facts = Facts::object({{"first", pair.first},
                               {"second", pair.second},
                               {"unit", unit.text},
                               {"points", d.x.size()},
                               {"left_out", d.left_out},
                               {"largest", unit.difference_from_si(d.largest)},
                               {"largest_at", c.axis_unit.from_si(d.x[d.largest_at])},
                               {"rms", unit.difference_from_si(d.rms)}});
  if (!pair.written) return facts;
  facts.set("tolerance", pair.written->written);
  facts.set("outside", d.outside);
  facts.set("within", d.outside == 0);
  facts.set("furthest_beyond", unit.difference_from_si(d.beyond[d.worst_at]));
  facts.set("furthest_at", c.axis_unit.from_si(d.x[d.worst_at]));
  return facts;
}

Document document_of(const Arguments& arguments, const TraceComparison& c) {
  Document document;
  document.verb = "compare";
  const std::string first = arguments.text("diagram"), second = arguments.text("other");
  document.title = fmt::format("{} and {}", first, second);
  std::size_t judged = 0, good = 0;
  Facts::List pairs;
  for (const auto& pair : c.pairs) {
    document.sentences.push_back(sentence_of(c, pair));
    pairs.push_back(pair_facts(c, pair));
    judged += pair.written ? 1 : 0;
    good += pair.written && pair.distance.outside == 0 ? 1 : 0;
  }
  document.headline =
      judged == 0 ? fmt::format("{} compared", count_text(static_cast<long>(c.pairs.size()), "signal"))
                  : fmt::format("{} of {} within the tolerance", good, count_text(static_cast<long>(judged), "signal"));
  document.warnings = c.remarks;
  Section figures;
  figures.title = "Overall error";
  figures.tables.push_back(distances_table(c));
  document.sections.push_back(std::move(figures));
  const std::string type = trace_type(arguments);
  for (const auto& pair : c.pairs) add_pair(document, c, pair, type);
  Facts facts = Facts::object(
      {{"first", first}, {"second", second}, {"over", c.axis}, {"over_unit", c.axis_unit.text}, {"signals", pairs}});
  if (judged > 0) facts.set("within_tolerance", c.within());
  document.facts = to_json(facts);
  return document;
}

/// Where the signal that is furthest beyond its tolerance lies outside it.
std::string plot_of_where(const TraceComparison& c) {
  const TracePair* worst = nullptr;
  const auto share = [](const TracePair& p) { return p.distance.outside / static_cast<double>(p.distance.x.size()); };
  for (const auto& pair : c.pairs)
    if (pair.written && pair.distance.outside > 0 && (worst == nullptr || share(pair) > share(*worst))) worst = &pair;
  if (worst == nullptr) return "";
  const Unit unit = unit_of_differences(worst->unit);
  TextCurve within{"within", '.', {}, {}}, outside{"OUTSIDE", '#', {}, {}};
  for (std::size_t i = 0; i < worst->distance.x.size(); ++i) {
    TextCurve& curve = worst->distance.beyond[i] > 0 ? outside : within;
    curve.x.push_back(c.axis_unit.from_si(worst->distance.x[i]));
    curve.y.push_back(unit.difference_from_si(worst->distance.second[i] - worst->distance.first[i]));
  }
  return text_plot({within, outside}, axis_text(c.axis, c.axis_unit),
                   axis_text("second minus first of " + name_of(*worst), unit));
}

}  // namespace

Answer compare_traces(const Arguments& arguments) {
  for (const char* option : {"--data", "--set", "--choose"})
    if (arguments.has(option))
      fail("bad_command_line", option, "two files of traces were named, and no diagram",
           "leave it out, or name a diagram and its recordings: hysteron compare stage.json --data lab.csv");
  const TraceWishes wishes = wishes_of(arguments);
  const TraceComparison comparison =
      compare_trace_files(read_table(arguments.text("diagram")), read_table(arguments.text("other")), wishes);
  Answer answer;
  if (!arguments.quiet()) answer.text = plot_of_where(comparison);
  answer.folder = result_folder(arguments, "compare");
  answer.document = document_of(arguments, comparison);
  answer.exit_code = comparison.within() ? exit_code::done : exit_code::no;
  return answer;
}

}  // namespace hysteron
