// The verb run: simulates a diagram and records its signals, over its own time or over the inputs of recordings.
// Does not compare with measurements.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>

#include "app/cli/answer.h"
#include "app/cli/load.h"
#include "app/cli/shape.h"
#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "engine/program/feedthrough.h"
#include "engine/simulate/simulate.h"
#include "io/results/result.h"
#include "report/pages/facts.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

constexpr char run_help[] =
    "Answers: what does this diagram do. Simulates it and records the signals that \"record\" names\n"
    "(without \"record\": its outputs; without these: every signal).\n\n"
    "Examples:\n"
    "  hysteron run stage.json --until \"1 s\" --every \"0.1 ms\"\n"
    "  hysteron run stage.json --set controller.kp=\"0.5 V/um\" --choose compensator=none\n"
    "  hysteron run stage.json --data lab.csv     the diagram's inputs move as in the recording\n\n"
    "Writes into the folder: result.json, traces/*.csv, report.html. Says where the time went.\n"
    "Exit codes: 0 done, 2 the diagram or the data are wrong, 3 the simulation failed.";

constexpr double most_numbers = 1e8;  // recorded at once: 800 MB

std::vector<int> signals_to_record(const Program& program) {
  if (!program.record_signals.empty()) return program.record_signals;
  if (!program.output_signals.empty()) return program.output_signals;
  std::vector<int> all(program.signals.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  return all;
}

/// The name under which a signal is recorded: an output by its own name, anything else by its path.
std::string signal_name(const Program& program, int signal) {
  if (program.record_signals.empty())
    for (std::size_t i = 0; i < program.output_signals.size(); ++i)
      if (program.output_signals[i] == signal) return program.output_names[i];
  return program.signals[static_cast<std::size_t>(signal)].path;
}

CsvTable table_of(const Program& program, const Traces& traces, const std::string& file) {
  CsvTable table;
  table.file = file;
  table.columns.push_back({"t", parse_unit("s"), traces.t});
  for (std::size_t i = 0; i < traces.signals.size(); ++i) {
    const Unit& unit = program.signals[static_cast<std::size_t>(traces.signals[i])].unit;
    CsvColumn column{signal_name(program, traces.signals[i]), unit, traces.values[i]};
    for (auto& value : column.values) value = unit.from_si(value);
    table.columns.push_back(std::move(column));
  }
  return table;
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
    std::vector<std::string> names;
    for (const auto& curve : figure.curves) names.push_back(curve.name);
    figure.title = fmt::format("{}", fmt::join(names, ", "));
  }
}

/// Smallest, largest and last value of each signal: for the reader, and as facts for programs.
Facts add_ranges(Section& section, const CsvTable& table) {
  Table ranges;
  ranges.columns = {"signal", "smallest", "largest", "last"};
  Facts entries;
  for (std::size_t i = 1; i < table.columns.size(); ++i) {
    const auto& column = table.columns[i];
    if (column.values.empty()) continue;
    const auto [low, high] = std::minmax_element(column.values.begin(), column.values.end());
    const auto text = [&](double value) {
      const std::string unit = unit_text(column.unit);
      return number_text(value, 6) + (unit.empty() ? "" : " " + unit);
    };
    ranges.rows.push_back({column.name, text(*low), text(*high), text(column.values.back())});
    entries.set(column.name, Facts::object({{"unit", unit_text(column.unit)},
                                            {"smallest", *low},
                                            {"largest", *high},
                                            {"last", column.values.back()}}));
  }
  section.tables.push_back(std::move(ranges));
  return entries;
}

/// What result.json says of each trace, and what it does not say: where the time went.
struct RunFacts {
  Facts traces, statistics;
  Phases phases{};
  double seconds = 0;
};

/// "time: load and compile 3.1 ms, set up 0.2 ms, steps 10 ms, events 0.5 ms, output 1.2 ms"
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

/// "100 runs of sampled blocks; changes of mode: relay 12." or "".
std::string events_text(const Statistics& s) {
  std::vector<std::string> parts;
  if (s.samples > 0) parts.push_back(count_text(s.samples, "run") + " of sampled blocks");
  if (s.paths > 0) parts.push_back(count_text(s.paths, "jump") + " followed along the path");
  std::vector<std::string> changes;
  for (const auto& [block, count] : s.mode_changes) changes.push_back(fmt::format("{} {}", block, count));
  if (!changes.empty()) parts.push_back(fmt::format("changes of mode: {}", fmt::join(changes, ", ")));
  return parts.empty() ? "" : fmt::format("{}.", fmt::join(parts, "; "));
}

void add_traces(Document& document, RunFacts& facts, const Program& program, const Traces& traces,
                const std::string& name) {
  document.traces.push_back(table_of(program, traces, trace_file(name, document.traces)));
  const auto& table = document.traces.back();
  Section section;
  section.title = name == "signals" ? "Signals over time" : name;
  add_figures(section, table);
  facts.traces.set(table.file, add_ranges(section, table));
  const auto& s = traces.statistics;
  section.text.push_back(fmt::format(
      "{}; method {}, {}, {} rejected, {} evaluations, {}.", count_text(static_cast<long>(traces.t.size()), "row"),
      s.method, count_text(s.steps, "step"), s.rejected, s.evaluations, count_text(s.reversals, "reversal")));
  document.warnings.insert(document.warnings.end(), s.warnings.begin(), s.warnings.end());
  if (!s.why.empty()) section.text.push_back(fmt::format("Method {}: {}.", s.method, s.why));
  if (const std::string events = events_text(s); !events.empty()) section.text.push_back(events);
  for (auto& text : loop_texts(program, s)) section.text.push_back(std::move(text));
  facts.seconds += s.seconds;
  facts.phases.integrate += s.phases.integrate;
  facts.phases.events += s.phases.events;
  facts.phases.output += s.phases.output;
  Facts changes = Facts::object({});
  for (const auto& [block, count] : s.mode_changes) changes.set(block, count);
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

/// A time of the command line, above zero; `otherwise` where it is not given.
double positive_seconds(const Arguments& arguments, const std::string& name, double otherwise) {
  const double value = arguments.seconds(name, otherwise);
  if (arguments.has(name) && !(value > 0))
    fail("bad_value", name, fmt::format("{} s is not possible", value), "give a time above 0 s");
  return value;
}

SimulateOptions own_time_options(const Arguments& arguments, const Diagram& diagram, const Program& program) {
  if (!arguments.has("--until") && !diagram.simulate.until)
    fail("no_end_time", "/simulate/until", "nothing says until when to simulate",
         "write \"simulate\": {\"until\": \"1 s\"} into the diagram, or give --until \"1 s\"");
  SimulateOptions settings = simulate_options(program);
  settings.until = positive_seconds(arguments, "--until", settings.until);
  settings.every = positive_seconds(arguments, "--every", settings.every);
  settings.signals = signals_to_record(program);
  if (settings.every > 0 &&
      (settings.until / settings.every) * static_cast<double>(settings.signals.size() + 1) > most_numbers)
    fail("too_many_rows", arguments.has("--every") ? "--every" : "/simulate/every",
         fmt::format("{:.3g} rows of {} would be recorded: every {:.4g} s until {:.4g} s",
                     settings.until / settings.every, count_text(static_cast<long>(settings.signals.size()), "signal"),
                     settings.every, settings.until),
         "record less often, end earlier, or name fewer signals in \"record\"");
  return settings;
}

/// How far one of several simulations is.
std::function<void(double)> shown(const Watch& watch, std::size_t which, std::size_t of, const std::string& what) {
  const auto all = static_cast<double>(of);
  const double before = static_cast<double>(which) / all;
  return [&watch, before, all, what](double fraction) { watch.show(before + fraction / all, what); };
}

void run_own_time(const Arguments& arguments, const Watch& watch, const Diagram& diagram, const Program& program,
                  Document& document, RunFacts& facts) {
  if (!program.input_names.empty())
    fail("unbound_input", "/inputs/" + program.input_names.front(),
         fmt::format("the diagram takes its {} from outside, and nothing drives it", program.input_names.front()),
         "give --data FILE with that column, or put a source block (sine, step ...) in its place");
  with_lines_of(diagram, [&] {
    SimulateOptions settings = own_time_options(arguments, diagram, program);
    settings.progress = shown(watch, 0, 1, fmt::format("of {} s", number_text(settings.until, 6)));
    const Traces traces = simulate(program, start(program), settings);
    document.headline = fmt::format("{}: simulated {} s, {} recorded", document.title, number_text(settings.until, 6),
                                    count_text(static_cast<long>(settings.signals.size()), "signal"));
    add_traces(document, facts, program, traces, "signals");
  });
}

void run_recordings(const Arguments& arguments, const Watch& watch, const Diagram& diagram, const Program& program,
                    Document& document, RunFacts& facts) {
  const DataSet data = load_data(arguments, program);
  document.warnings = data.remarks;
  std::string seen;
  const std::size_t count = data.recordings.size();
  for (const auto& recording : data.recordings) {
    if (data.single && recording.file == seen) continue;  // its two parts are one simulation
    const auto index = static_cast<std::size_t>(&recording - data.recordings.data());
    seen = recording.file;
    with_lines_of(diagram, [&] {
      SimulateOptions settings = simulate_options(program);
      settings.instants = recording.t;
      settings.begin = recording.t.front();
      settings.until = recording.t.back();
      settings.signals = signals_to_record(program);
      settings.at_rest = recording.at_rest || recording.initial_per_recording;
      settings.progress = shown(watch, index, count, recording.name);
      const Traces traces = simulate(program, start_recording(program, data, recording), settings);
      add_traces(document, facts, program, traces, recording.name);
    });
  }
  document.headline = fmt::format("{}: simulated along {}", document.title,
                                  count_text(static_cast<long>(document.sections.size()), "recording"));
}

Answer run(const Arguments& arguments, const Watch& watch) {
  const auto begin = std::chrono::steady_clock::now();
  const Diagram diagram = load_diagram(arguments, watch);
  const ProgramPointer program = compile_file(diagram);
  const double loading = seconds_since(begin);
  Answer answer;
  answer.folder = result_folder(arguments, "run");
  Document& document = answer.document;
  document.verb = "run";
  document.title = diagram.title.empty() ? stem_of(arguments.text("diagram")) : diagram.title;
  RunFacts facts;
  const StopScope until_stopped(watch.stop);
  if (arguments.has("--data"))
    run_recordings(arguments, watch, diagram, *program, document, facts);
  else
    run_own_time(arguments, watch, diagram, *program, document, facts);
  document.facts = to_json(Facts::object(
      {{"diagram", arguments.text("diagram")}, {"traces", facts.traces}, {"statistics", facts.statistics}}));
  answer.asides = {times_text(loading, facts)};
  return answer;
}

std::vector<shape::Member> run_shape() {
  using namespace shape;
  const Facts range = object("a signal", {{"unit", text("of the values")},
                                          {"smallest", number("value")},
                                          {"largest", number("value")},
                                          {"last", number("value")}});
  const Facts facts =
      object("what was simulated", {{"diagram", text("its file")},
                                    {"traces", named("by file in traces/", named("by signal", range))},
                                    {"statistics", named("by file in traces/", open_object("steps, events, loops"))}});
  return published({{"facts", facts}});
}

}  // namespace

Verb run_verb() {
  return {"run",
          "simulate a diagram, record its signals",
          run_help,
          {options::diagram(),
           options::data(false),
           {"--until", "TIME", "until when, e.g. \"1 s\"; default: as the diagram says", false, false},
           {"--every", "TIME", "record every so often, e.g. \"0.1 ms\"", false, false},
           options::output_folder(),
           options::set(),
           options::choose(),
           options::allow()},
          run,
          run_shape};
}

}  // namespace hysteron
