#include "app/verbs/run_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

#include "engine/program/feedthrough.h"
#include "report/pages/loops.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

/// Takes the rows out of `traces`.
CsvTable table_of(const Program& program, Traces& traces, const std::string& file) {
  // An output stands under its own name, anything else under its path.
  std::map<int, std::string> output_names;
  for (std::size_t i = 0; i < program.output_signals.size() && program.record_signals.empty(); ++i)
    output_names.emplace(program.output_signals[i], program.output_names[i]);
  CsvTable table;
  table.file = file;
  table.columns.push_back({"t", parse_unit("s"), std::move(traces.t)});
  for (std::size_t i = 0; i < traces.signals.size(); ++i) {
    const SignalInfo& signal = program.signals[static_cast<std::size_t>(traces.signals[i])];
    const Unit& unit = signal.unit;
    const auto output = output_names.find(traces.signals[i]);
    CsvColumn column{output == output_names.end() ? signal.path : output->second, unit, std::move(traces.values[i])};
    for (auto& value : column.values) value = unit.from_si(value);
    table.columns.push_back(std::move(column));
  }
  return table;
}

/// "stage" of "stage[2]".
std::string name_of_vector(const std::string& signal) {
  return signal.ends_with(']') ? signal.substr(0, signal.find('[')) : signal;
}

/// One figure per unit, so that curves of one figure share an axis.
void add_figures(Section& section, const CsvTable& table) {
  std::vector<std::string> units;
  for (std::size_t i = 1; i < table.columns.size(); ++i) {
    const auto& column = table.columns[i];
    const std::string unit = unit_text(column.unit);
    auto at = std::find(units.begin(), units.end(), unit);
    if (at == units.end()) {
      units.push_back(unit);
      at = units.end() - 1;
      Figure figure;
      figure.x_label = "t [s]";
      figure.y_label = unit.empty() ? "[1]" : "[" + unit + "]";
      section.figures.push_back(std::move(figure));
    }
    Curve curve;
    curve.name = column.name;
    curve.style = "line";
    curve.trace = table.file;
    curve.x_column = "t";
    curve.y_column = column.name;
    section.figures[static_cast<std::size_t>(at - units.begin())].curves.push_back(std::move(curve));
  }
  for (auto& figure : section.figures) {
    std::vector<std::string> names;  // a vector stands there once, its legend names the elements
    for (const auto& curve : figure.curves)
      if (std::string name = name_of_vector(curve.name); names.empty() || names.back() != name)
        names.push_back(figure.curves.size() == 1 ? curve.name : std::move(name));
    if (names.size() == 1) figure.y_label = names.front() + " " + figure.y_label;
    figure.title = fmt::format("{}", fmt::join(names, ", "));
  }
}

/// The column of the table that drives: an input of the diagram, or what a source makes; none = nullptr.
const CsvColumn* driving_column(const Program& program, const std::vector<int>& signals, const CsvTable& table) {
  for (std::size_t i = 0; i < signals.size(); ++i) {
    const int block = program.signals[static_cast<std::size_t>(signals[i])].block;
    if (block < 0 || is_source_of_time(program.blocks[static_cast<std::size_t>(block)])) return &table.columns[i + 1];
  }
  return nullptr;
}

struct Loops {
  std::vector<Figure> over_drive;  ///< other signals over the one that drives, where it turns
  std::vector<Figure> planes;      ///< phase planes
};

Loops loops_of(const Program& program, const std::vector<int>& signals, const CsvTable& table) {
  constexpr std::size_t most = 6;
  Loops loops;
  std::vector<Plotted> all;
  const CsvColumn* drive = driving_column(program, signals, table);
  for (std::size_t i = 1; i < table.columns.size(); ++i) {
    const std::string& name = table.columns[i].name;
    all.push_back({name, name, name});
    if (drive == nullptr || drive == &table.columns[i] || loops.over_drive.size() >= most) continue;
    Figure figure = loop_figure(table, {drive->name, drive->name, drive->name}, all.back());
    if (!figure.curves.empty()) loops.over_drive.push_back(std::move(figure));
  }
  loops.planes = phase_planes(table, all, most);
  return loops;
}

/// The first screen: the first signals over time, the loop of what lies furthest from the drive, and a phase plane.
std::vector<Figure> answer_of(const std::vector<Figure>& over_time, const Loops& loops) {
  std::vector<Figure> figures(over_time.begin(),
                              over_time.begin() + std::min<std::ptrdiff_t>(2, std::ssize(over_time)));
  if (!loops.over_drive.empty()) figures.push_back(loops.over_drive.back());
  if (!loops.planes.empty()) figures.push_back(loops.planes.front());
  return figures;
}

/// Smallest, largest and last value of each signal: for the reader, and as facts for programs.
Facts add_ranges(Section& section, const CsvTable& table) {
  Table ranges;
  ranges.columns = {"signal", "smallest", "largest", "last"};
  Facts::Members entries;  // of columns, which have different names
  for (std::size_t i = 1; i < table.columns.size(); ++i) {
    const auto& column = table.columns[i];
    if (column.values.empty()) continue;
    const auto [low, high] = std::minmax_element(column.values.begin(), column.values.end());
    const auto text = [&](double value) {
      const std::string unit = unit_text(column.unit);
      return number_text(value, 6) + (unit.empty() ? "" : " " + unit);
    };
    ranges.rows.push_back({column.name, text(*low), text(*high), text(column.values.back())});
    entries.push_back({column.name, Facts::object({{"unit", unit_text(column.unit)},
                                                   {"smallest", *low},
                                                   {"largest", *high},
                                                   {"last", column.values.back()}})});
  }
  section.tables.push_back(std::move(ranges));
  return entries;
}

/// One sentence for each algebraic loop.
std::vector<std::string> loop_texts(const Program& program, const Statistics& s) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < s.loops.size(); ++i) {
    const auto& loop = s.loops[i];
    if (loop.solved + loop.failed == 0 || !is_algebraic(program, program.loops[i])) continue;
    texts.push_back(fmt::format(
        "Algebraic loop {}: solved {} times, {:.1f} evaluations each, at most {}; {} by bracketing; relative residual "
        "at "
        "most {:.1g}{}.",
        loop.path, loop.solved, static_cast<double>(loop.evaluations) / static_cast<double>(loop.solved + loop.failed),
        loop.most_evaluations, loop.bracketed, loop.worst_residual,
        loop.failed > 0 ? fmt::format("; {} trials without a solution", loop.failed) : ""));
  }
  return texts;
}

Facts loop_facts(const Statistics& s) {
  Facts::List list;
  for (const auto& loop : s.loops)
    list.push_back(Facts::object({{"path", loop.path},
                                  {"solved", loop.solved},
                                  {"failed", loop.failed},
                                  {"evaluations", loop.evaluations},
                                  {"most_evaluations", loop.most_evaluations},
                                  {"bracketed", loop.bracketed},
                                  {"worst_residual", loop.worst_residual}}));
  return list;
}

/// "100 runs of sampled blocks; switches: relay 12." or "".
std::string events_text(const Statistics& s) {
  std::vector<std::string> parts;
  if (s.samples > 0) parts.push_back(count_text(s.samples, "run") + " of sampled blocks");
  if (s.paths > 0) parts.push_back(count_text(s.paths, "jump") + " followed along the path");
  std::vector<std::string> changes;
  for (const auto& [block, count] : s.mode_changes) changes.push_back(fmt::format("{} {}", block, count));
  if (!changes.empty()) parts.push_back(fmt::format("switches: {}", fmt::join(changes, ", ")));
  return parts.empty() ? "" : fmt::format("{}.", fmt::join(parts, "; "));
}

}  // namespace

std::string times_text(double loading, const RunFacts& facts) {
  const Phases& p = facts.phases;
  const double setting_up = std::max(0.0, facts.seconds - p.integrate - p.events - p.output);
  std::vector<std::string> parts;
  for (const auto& [name, seconds] : {std::pair<const char*, double>{"load and compile", loading},
                                      {"set up", setting_up},
                                      {"steps", p.integrate},
                                      {"events", p.events},
                                      {"output", p.output}})
    parts.push_back(seconds < 1 ? fmt::format("{} {} ms", name, number_text(1e3 * seconds, 2))
                                : fmt::format("{} {} s", name, number_text(seconds, 3)));
  return fmt::format("time: {}", fmt::join(parts, ", "));
}

void add_traces(Document& document, RunFacts& facts, const Program& program, Traces traces, const std::string& name,
                const std::string& type) {
  document.traces.push_back(table_of(program, traces, trace_file(name, document.traces, type)));
  const auto& table = document.traces.back();
  Section section;
  section.title = name == "signals" ? "Signals over time" : name;
  add_figures(section, table);
  const Loops loops = loops_of(program, traces.signals, table);
  if (document.answer.empty()) document.answer = answer_of(section.figures, loops);
  for (const auto* figures : {&loops.over_drive, &loops.planes})
    section.figures.insert(section.figures.end(), figures->begin(), figures->end());
  facts.traces.set(table.file, add_ranges(section, table));
  const auto& s = traces.statistics;
  section.text.push_back(fmt::format(
      "{}; method {}, {}, {} rejected, {} evaluations, {}.", count_text(static_cast<long>(table.rows()), "row"),
      s.method, count_text(s.steps, "step"), s.rejected, s.evaluations, count_text(s.reversals, "reversal")));
  document.warnings.insert(document.warnings.end(), s.warnings.begin(), s.warnings.end());
  if (!s.why.empty()) section.text.push_back(fmt::format("Method {}: {}.", s.method, s.why));
  if (const std::string events = events_text(s); !events.empty()) section.text.push_back(events);
  for (auto& text : loop_texts(program, s)) section.text.push_back(std::move(text));
  facts.seconds += s.seconds;
  facts.phases.integrate += s.phases.integrate;
  facts.phases.events += s.phases.events;
  facts.phases.output += s.phases.output;
  Facts::Members changes;
  for (const auto& [block, count] : s.mode_changes) changes.push_back({block, count});
  facts.statistics.set(table.file, Facts::object({{"method", s.method},
                                                  {"why", s.why},
                                                  {"steps", s.steps},
                                                  {"rejected", s.rejected},
                                                  {"evaluations", s.evaluations},
                                                  {"jacobians", s.jacobians},
                                                  {"reversals", s.reversals},
                                                  {"restarts", s.restarts},
                                                  {"samples", s.samples},
                                                  {"jump_paths", s.paths},
                                                  {"mode_changes", changes},
                                                  {"loops", loop_facts(s)}}));
  document.sections.push_back(std::move(section));
}

}  // namespace hysteron
