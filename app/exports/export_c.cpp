#include "app/exports/export_c.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/cli/load.h"
#include "app/cli/target.h"
#include "engine/diagram/error.h"
#include "engine/diagram/time_text.h"
#include "engine/program/names.h"
#include "engine/simulate/simulate.h"
#include "export/c/c_page.h"
#include "export/c/c_rows.h"
#include "export/c/c_test.h"
#include "export/c/cut.h"
#include "export/c/inverse.h"
#include "export/c/sampled_form.h"
#include "io/data/dataset_bind.h"
#include "io/diagram/diagram_file.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

constexpr std::size_t row_count = 1000;

constexpr char export_c_help[] =
    "C99 of a compensator or a controller: the state in a struct that the caller owns, constants in const tables, no "
    "heap,\n"
    "bounded loops, named after the blocks. Static blocks, blocks with memory and sampled blocks as they are; linear\n"
    "blocks with continuous states as matrices from step to step; the continuous inverses of hysteresis as their sampled\n"
    "forms, with the difference told. Anything else is refused by name.\n\n"
    "  hysteron export c controller.json -o out\n"
    "  hysteron export c loop.json --from command --from measured --to drive -o out --name loop\n"
    "  hysteron export c out/discover/final.json --inverse --rate \"1 kHz\" --check lab.csv -o out\n"
    "  hysteron export c stage.json --to pi --rate \"10 kHz\" --number float32 -o out\n\n"
    "--from makes signals the inputs of the code, so that a controller can be taken out of its loop; --to says what the\n"
    "code is to work out. Without them these are the diagram's own inputs and outputs.\n"
    "--inverse writes the compensator of a model, such as the final.json of discover: hysteresis, creep, gains and "
    "offsets\n"
    "are undone from the output back to the input.\n"
    "Writes NAME.h, NAME.c, NAME_test.c (1000 rows of the engine: in double the same bits, in float the deviation is "
    "told),\n"
    "NAME.md, and NAME.json, the diagram that the code is.";

/// [s] of "10 kHz" or "0.1 ms"; 0: nothing is said.
double period_of(const Arguments& arguments) {
  if (!arguments.has("--rate")) return 0;
  const std::string text = arguments.text("--rate");
  double number = 0;
  std::string unit;
  const auto bad = [&] {
    fail("bad_command_line", "--rate", fmt::format("\"{}\" is no rate", text), "write --rate \"10 kHz\" or \"0.1 ms\"");
  };
  if (!split_quantity(text, number, unit) || unit.empty()) bad();
  const Unit read = parse_unit(unit, "--rate");
  const double si = read.to_si(number);
  if (!(si > 0) || !std::isfinite(si)) bad();
  if (read.dimension == parse_unit("s").dimension) return si;
  if (read.dimension != parse_unit("Hz").dimension && read.dimension != parse_unit("1/s").dimension) bad();
  return 1 / si;
}

CWish wish_of(const Arguments& arguments) {
  CWish wish;
  wish.name = arguments.text("--name", "comp");
  if (wish.name.empty() || c_text::identifier(wish.name) != wish.name || wish.name.front() == '_')
    fail("bad_command_line", "--name", fmt::format("\"{}\" is no name in C", wish.name),
         "write letters, digits and underscores, e.g. --name comp");
  const std::string number = arguments.text("--number", "float64");
  if (number != "float64" && number != "float32")
    fail("bad_command_line", "--number", fmt::format("\"{}\" is neither float64 nor float32", number),
         "write --number float64 or --number float32");
  wish.real = number == "float64" ? c_text::Real::float64 : c_text::Real::float32;
  const std::string file = arguments.text("diagram");
  wish.from = file.substr(file.find_last_of('/') + 1);
  return wish;
}

/// What the code is, and how far its diagram is from the one that was given.
struct Coded {
  Diagram diagram;  ///< of the code
  ProgramPointer continuous, program;
  std::vector<std::string> replaced;
};

bool is_loop(const Error& error) {
  return std::all_of(error.problems.begin(), error.problems.end(),
                     [](const Problem& problem) { return problem.code == "algebraic_loop"; });
}

/// With straight inputs between the steps, or, where that makes a loop at one instant, with held ones.
Coded coded(const CutDiagram& cut, double rate) {
  Coded made{cut.diagram, compile_file(cut.diagram), nullptr, {}};
  const double period = rate > 0 ? rate : shortest_period(*made.continuous);
  made.program = made.continuous;
  if (period <= 0 || made.continuous->n_x == 0) return made;
  for (const auto between : {BetweenSteps::straight, BetweenSteps::held}) {
    SampledForm form = sampled_form(cut.diagram, *made.continuous, registry(), period, between);
    try {
      made.program = compile_file(form.diagram);
    } catch (const Error& error) {
      if (between == BetweenSteps::held || !is_loop(error)) throw;
      continue;
    }
    made.diagram = std::move(form.diagram);
    made.replaced = std::move(form.replaced);
    const auto& loops = made.program->loops;
    if (std::none_of(loops.begin(), loops.end(), [](const Loop& loop) { return loop.of_values(); })) break;
  }
  return made;
}

/// The input of the code is the wanted output of the part, and its output what the part's input has to be.
CutDiagram inverse_of(const CutDiagram& part, const Arguments& arguments, double rate, std::vector<std::string>& told) {
  const ProgramPointer model = compile_file(part.diagram);
  const auto from = arguments.list("--from");
  std::string input = from.size() == 1 ? from.front() : "";
  for (std::size_t i = 0; i < part.inputs.size(); ++i)
    if (part.inputs[i] == input) input = part.diagram.inputs.names()[i];
  InverseDiagram inverse = inverse_diagram(part.diagram, *model, registry(), input, rate);
  told = std::move(inverse.told);
  for (auto& name : inverse.inputs) {
    if (const std::string* output = part.diagram.outputs.find(name)) name = *output;
    const auto names = part.diagram.inputs.names();
    const auto known = std::find(names.begin(), names.end(), name);
    if (known != names.end()) name = part.inputs[static_cast<std::size_t>(known - names.begin())];
  }
  return {std::move(inverse.diagram), std::move(inverse.inputs)};
}

/// How far the model is from what is wanted when the code drives it, [SI], from the second half of the rows on.
double missed_by(const CutDiagram& part, const CutDiagram& inverse, const std::vector<double>& times,
                 const SignalRows& wanted, const SignalRows& command) {
  const ProgramPointer model = compile_file(part.diagram);
  SignalRows inputs;
  for (const auto& name : model->input_names) {
    const auto names = inverse.diagram.inputs.names();
    const auto other = std::find(names.begin() + 1, names.end(), name) - names.begin();
    inputs.push_back(static_cast<std::size_t>(other) < names.size() ? wanted[static_cast<std::size_t>(other)]
                                                                    : command.front());
  }
  const SignalRows reached = continuous_outputs(*model, times, inputs);
  double most = 0;
  for (std::size_t k = times.size() / 2; k < times.size(); ++k)
    most = std::max(most, std::fabs(reached.front()[k] - wanted.front()[k]));
  return most;
}

/// Signals that go in [SI], and where they are from.
struct Given {
  SignalRows inputs;
  std::vector<double> times;
  std::string from;
};

double row_period(const CPlan& plan, const SimulateOptions& whole, double span) {
  if (plan.period > 0) return plan.period;
  if (span > 0) return span / static_cast<double>(row_count - 1);
  return whole.every > 0 ? whole.every : 1e-3;
}

/// The signals of the whole diagram that the code gets, as a simulation of it gives them at these times.
SignalRows signals_of_whole(const Program& whole, const Diagram& diagram, const std::vector<std::string>& names,
                            Run run, SimulateOptions options) {
  options.signals.clear();
  for (const auto& name : names) {
    const std::string known = program_name(diagram, name);
    if (const int one = find_named_signal(whole, known); one >= 0) {
      options.signals.push_back(one);
      continue;
    }
    for (int k = 0; find_named_signal(whole, fmt::format("{}[{}]", known, k)) >= 0; ++k)
      options.signals.push_back(find_named_signal(whole, fmt::format("{}[{}]", known, k)));
  }
  return simulate(whole, std::move(run), options).values;
}

Given from_recording(const Arguments& arguments, const Diagram& diagram, const Program& whole, const CutDiagram& cut,
                     const CPlan& plan) {
  const DataSet data = read_dataset(arguments.text("--check"), arguments.list("--allow"));
  check_inputs(data, whole);
  const Recording& recording = data.recordings.front();
  const double begin = recording.t.front(), span = recording.t.back() - begin;
  SimulateOptions options = simulate_options(whole);
  const double period = row_period(plan, options, span);
  const auto most = static_cast<std::size_t>(std::floor(span / period * (1 + 1e-12))) + 1;
  Given given;
  given.times = step_times(period, std::min(row_count, std::max<std::size_t>(most, 2)));
  options.begin = begin;
  for (const double t : given.times) options.instants.push_back(std::min(begin + t, recording.t.back()));
  options.until = options.instants.back();
  options.at_rest = recording.at_rest || recording.initial_per_recording;
  given.inputs =
      signals_of_whole(whole, diagram, cut.inputs, start_recording(whole, data, recording), std::move(options));
  given.from = "those of the recording " + recording.name;
  return given;
}

Given rows_for(const Arguments& arguments, const Diagram& diagram, const Program& whole, const CutDiagram& cut,
               const Coded& made, const CPlan& plan) {
  if (arguments.has("--check")) return from_recording(arguments, diagram, whole, cut, plan);
  Given given;
  SimulateOptions options = simulate_options(whole);
  const bool runs = whole.input_names.empty() && !cut.inputs.empty();
  const double period = row_period(plan, options, runs && diagram.simulate.until ? options.until : 0);
  given.times = step_times(period, row_count);
  if (runs) {
    options.instants = given.times;
    options.until = given.times.back();
    given.inputs = signals_of_whole(whole, diagram, cut.inputs, start(whole), std::move(options));
    given.from = "those of the diagram itself";
    return given;
  }
  for (std::size_t i = 0; i < made.program->input_names.size(); ++i)
    given.inputs.push_back(tried_input(made.program->input_units[i].to_si(1), i, row_count));
  given.from = "turns that shrink and grow, between 0 and 1 of each input's unit (--check FILE takes a recording)";
  return given;
}

/// Largest differences per output [SI].
std::vector<double> differences(const SignalRows& a, const SignalRows& b) {
  std::vector<double> largest;
  for (std::size_t i = 0; i < a.size(); ++i) {
    double most = 0;
    for (std::size_t k = 0; k < a[i].size(); ++k) most = std::max(most, std::fabs(a[i][k] - b[i][k]));
    largest.push_back(most);
  }
  return largest;
}

Facts ports_facts(const std::vector<CPort>& ports) {
  Facts::List list;
  for (const auto& p : ports)
    list.emplace_back(
        Facts::object({{"member", p.name}, {"signal", p.signal}, {"si_unit", p.si_unit}, {"unit", p.unit.text}}));
  return list;
}

void tell_missed(Answer& answer, double missed, const CSource& source) {
  const CPort& wanted = source.inputs.front();
  answer.text +=
      fmt::format("  driven by it, the model misses {} by at most {:.3g} {} in the second half of the rows\n",
                  wanted.name, wanted.unit.difference_from_si(missed), wanted.unit.text);
}

Answer export_c_act(const Arguments& arguments, const Watch& watch) {
  const CWish wish = wish_of(arguments);
  const double rate = period_of(arguments);
  const Diagram diagram = load_diagram(arguments, watch);
  const ProgramPointer whole = compile_file(diagram);
  Answer answer;
  with_lines_of(diagram, [&] {
    const CutDiagram part = cut_diagram(diagram, *whole, arguments.list("--from"), arguments.list("--to"));
    std::vector<std::string> told;
    const CutDiagram cut = arguments.has("--inverse") ? inverse_of(part, arguments, rate, told) : part;
    Coded made = coded(cut, rate);
    const CPlan plan = plan_c(made.program, rate);
    const CSource source = c_source(plan, wish);
    const Given given = rows_for(arguments, diagram, *whole, cut, made, plan);
    const SignalRows expected = stepped_outputs(*made.program, given.times, given.inputs);
    CFindings findings{made.replaced, {}, given.from, given.times.size()};
    if (!made.replaced.empty())
      findings.off = differences(expected, continuous_outputs(*made.continuous, given.times, given.inputs));

    const double missed = arguments.has("--inverse") ? missed_by(part, cut, given.times, given.inputs, expected) : 0;
    findings.replaced.insert(findings.replaced.end(), told.begin(), told.end());

    const std::string folder = arguments.text("-o", stem_of(arguments.text("diagram")) + ".c_code");
    make_folder(folder, "name another folder: -o out");
    const std::string stem = folder + "/" + wish.name;
    made.diagram.title = made.program->title;
    const std::string test = c_test_source(source, wish, given.inputs, expected);
    answer.files = {{stem + ".h", source.header},
                    {stem + ".c", source.source},
                    {stem + "_test.c", test},
                    {stem + ".md", c_page(plan, source, wish, findings)},
                    {stem + ".json", diagram_text(moved_diagram(made.diagram, stem + ".json"))}};
    answer.text =
        fmt::format("{} in C{}, {} remembered, {}\n", count_text(static_cast<long>(plan.blocks.size()), "block"),
                    plan.period > 0 ? ", one step every " + time_text(plan.period) : "",
                    count_text(source.state_numbers, "number"), count_text(source.constants, "constant"));
    for (const auto& line : made.replaced) answer.text += "  " + line + "\n";
    for (const auto& line : told) answer.text += "  " + line + "\n";
    if (arguments.has("--inverse")) tell_missed(answer, missed, source);
    for (std::size_t i = 0; i < findings.off.size(); ++i)
      answer.text += "  from the continuous diagram, " + deviation_text(source.outputs[i], findings.off[i]) + "\n";
    answer.closing = fmt::format("wrote {0}.h, {0}.c, {0}_test.c, {0}.md, {0}.json\n", stem);
    Facts::List off;
    for (std::size_t i = 0; i < findings.off.size(); ++i)
      off.emplace_back(source.outputs[i].unit.difference_from_si(findings.off[i]));
    answer.facts = Facts::object({{"inputs", ports_facts(source.inputs)},
                                  {"outputs", ports_facts(source.outputs)},
                                  {"period_s", plan.period > 0 ? Facts(plan.period) : Facts()},
                                  {"blocks", static_cast<long>(plan.blocks.size())},
                                  {"state_numbers", source.state_numbers},
                                  {"constants", source.constants},
                                  {"rows", static_cast<long>(given.times.size())},
                                  {"replaced", made.replaced},
                                  {"off", std::move(off)}});
  });
  return answer;
}

std::vector<shape::Member> c_shape() {
  using namespace shape;
  const Facts port = object("one number", {{"member", text("of the struct in C")},
                                           {"signal", text("in the diagram")},
                                           {"si_unit", text("in which the code has it")},
                                           {"unit", text("in which people read it")}});
  return {
      {"inputs", list("what the code gets", port)},
      {"outputs", list("what it works out", port)},
      {"period_s", number("from step to step [s]; null: the code knows no time")},
      {"blocks", whole("blocks that were written")},
      {"state_numbers", whole("floating-point numbers that are remembered")},
      {"constants", whole("floating-point numbers in tables")},
      {"rows", whole("of the engine in the test")},
      {"replaced", texts("blocks with continuous states, and what stands for them")},
      {"off", list("per output, in its unit: largest difference from the continuous diagram", number("difference"))}};
}

}  // namespace

ExportKind export_c() {
  return {"c",
          "C99 of a compensator or controller",
          export_c_help,
          {{"--from", "SIGNAL", "make this signal an input of the code", false, true},
           {"--to", "SIGNAL", "work out this signal; default: the diagram's outputs", false, true},
           {"--name", "NAME", "of files, functions and types (default comp)", false, false},
           {"--number", "FORM", "float64 (default) or float32", false, false},
           {"--rate", "RATE", "how often the code runs: \"10 kHz\" or \"0.1 ms\"; default: as the sampled blocks do",
            false, false},
           {"--inverse", "", "write what undoes the diagram: from the wanted output to the input", false, false},
           {"--check", "FILE", "take the inputs of the test from this recording or data set", false, false}},
          export_c_act,
          c_shape};
}

}  // namespace hysteron
