// The verb run: simulates a diagram and records its signals, over its own time or over the inputs of recordings.
// Does not compare with measurements.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <utility>

#include "app/cli/answer.h"
#include "app/cli/load.h"
#include "app/cli/shape.h"
#include "app/verbs/run_page.h"
#include "engine/compile/draft.h"
#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "io/data/dataset_bind.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

constexpr char run_help[] =
    "Answers: what does this diagram do. Simulates it and records the signals that \"record\" names\n"
    "(without \"record\": its outputs; without these: every signal).\n\n"
    "Examples:\n"
    "  hysteron run stage.json --until \"1 s\" --every \"0.1 ms\"\n"
    "  hysteron run stage.json --set controller.kp=\"0.5 V/um\" --choose compensator=none\n"
    "  hysteron run stage.json --record all       every signal, whatever the diagram names\n"
    "  hysteron run stage.json --data lab.csv     inputs move as in the recording; it needs no outputs\n\n"
    "Writes into the folder: result.json, traces/*.csv, report.html. Says where the time went. With --traces f64\n"
    "the traces are traces/*.f64, for millions of rows: numbers as memory holds them (docs/programs.md).\n"
    "Exit codes: 0 done, 2 the diagram or the data are wrong, 3 the simulation failed.";

constexpr double most_numbers = 1e8;  // recorded at once: 800 MB

/// --record all.
bool records_all(const Arguments& arguments) { return arguments.list("--record") == std::vector<std::string>{"all"}; }

std::vector<int> signals_to_record(const Arguments& arguments, const Program& program) {
  const bool all_of_them = records_all(arguments);
  if (!all_of_them && !program.record_signals.empty()) return program.record_signals;
  if (!all_of_them && !program.output_signals.empty()) return program.output_signals;
  std::vector<int> all(program.signals.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  return all;
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
  settings.signals = signals_to_record(arguments, program);
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
                  const std::string& type, Document& document, RunFacts& facts) {
  if (!program.input_names.empty())
    fail("unbound_input", "/inputs/" + program.input_names.front(),
         fmt::format("the diagram takes its {} from outside, and nothing drives it", program.input_names.front()),
         "give --data FILE with that column, or put a source block (sine, step ...) in its place");
  with_lines_of(diagram, [&] {
    SimulateOptions settings = own_time_options(arguments, diagram, program);
    settings.progress = shown(watch, 0, 1, fmt::format("of {} s", number_text(settings.until, 6)));
    Traces traces = simulate(program, start(program), settings);
    document.headline = fmt::format("{}: simulated {} s, {} recorded", document.title, number_text(settings.until, 6),
                                    count_text(static_cast<long>(settings.signals.size()), "signal"));
    add_traces(document, facts, program, std::move(traces), "signals", type);
  });
}

void run_recordings(const Arguments& arguments, const Watch& watch, const Diagram& diagram, const Program& program,
                    const std::string& type, Document& document, RunFacts& facts) {
  const DataSet data = read_dataset(arguments.text("--data"), arguments.list("--allow"));
  check_inputs(data, program);  // nothing is compared: a file that only drives will do
  for (const auto& remark : data.remarks)
    if (remark != data.said_of_cut) document.warnings.push_back(remark);  // roles are for those who fit
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
      settings.signals = signals_to_record(arguments, program);
      settings.at_rest = recording.at_rest || recording.initial_per_recording;
      settings.progress = shown(watch, index, count, recording.name);
      Traces traces = simulate(program, start_recording(program, data, recording), settings);
      add_traces(document, facts, program, std::move(traces), recording.name, type);
    });
  }
  document.headline = fmt::format("{}: simulated along {}", document.title,
                                  count_text(static_cast<long>(document.sections.size()), "recording"));
}

/// The file is judged as it is; then other signals may be recorded in place of its own, which leaves blocks that nobody
/// reads. Those of --record stand in no file: what is wrong with one is told of the option.
ProgramPointer compile_recording(const Arguments& arguments, Diagram& diagram) {
  ProgramPointer as_written = compile_file(diagram);
  if (!arguments.has("--record") || records_all(arguments)) return as_written;
  diagram.record = arguments.list("--record");
  DraftProgram draft = compile_draft(diagram, registry());
  for (auto& p : draft.problems) p.path = "--record";
  if (!draft.problems.empty()) throw Error(Fault::input, draft.problems);
  return draft.program;
}

Answer run(const Arguments& arguments, const Watch& watch) {
  const auto begin = std::chrono::steady_clock::now();
  const std::string type = trace_type(arguments);
  Diagram diagram = load_diagram(arguments, watch);
  const ProgramPointer program = compile_recording(arguments, diagram);
  const double loading = seconds_since(begin);
  Answer answer;
  answer.folder = result_folder(arguments, "run");
  Document& document = answer.document;
  document.verb = "run";
  document.title = diagram.title.empty() ? stem_of(arguments.text("diagram")) : diagram.title;
  RunFacts facts;
  const StopScope until_stopped(watch.stop);
  if (arguments.has("--data"))
    run_recordings(arguments, watch, diagram, *program, type, document, facts);
  else
    run_own_time(arguments, watch, diagram, *program, type, document, facts);
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
           options::traces(),
           {"--every", "TIME", "record every so often, e.g. \"0.1 ms\"", false, false},
           {"--record", "SIGNAL", "record this signal (and others: further --record) and no other; \"all\": every one",
            false, true},
           options::output_folder(),
           options::set(),
           options::choose(),
           options::allow()},
          run,
          run_shape};
}

}  // namespace hysteron
