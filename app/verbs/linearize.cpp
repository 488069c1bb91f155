// The verb linearize: what a diagram is near an operating point, as poles, Bode data and margins.
// Does not compute (engine/analysis/small_motions.h).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/cli/answer.h"
#include "app/cli/load.h"
#include "app/cli/shape.h"
#include "app/facts/fact_shapes.h"
#include "engine/analysis/small_motions.h"
#include "engine/diagram/error.h"
#include "engine/events/rest.h"
#include "engine/program/names.h"
#include "engine/simulate/simulate.h"
#include "report/pages/facts.h"
#include "report/pages/motion_words.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

using std::numbers::pi;

constexpr char linearize_help[] =
    "Answers: how does the diagram respond to small motions around an operating point. Prints DC gain, bandwidth,\n"
    "poles and zeros from one signal to another; with --open, whether the loop is stable when it is closed, its gain "
    "and\n"
    "phase margin, where its gain is -3 dB, and what the closed loop makes of it: bandwidth, largest |T|, largest "
    "|S|.\n\n"
    "Examples:\n"
    "  hysteron linearize loop.json --from reference --to stage\n"
    "  hysteron linearize loop.json --from error --to stage --open error      the open loop, with its margins\n"
    "  hysteron linearize loop.json --at \"0.2 s\" --from drive --to stage      where a simulation is after 0.2 s\n"
    "  hysteron linearize loop.json --amplitude play=\"1 um\"                  a play, moved by 1 um at its input\n\n"
    "The operating point is the equilibrium for the sources as they are at t = 0 and inputs at zero; --at takes the\n"
    "point that a simulation has reached. Memory and modes are held there: a play operator inside its gap passes\n"
    "nothing, and is named; --amplitude takes its describing function instead.\n"
    "--from adds to the signal; where the loop is opened at the same signal, its readers see only what is added.\n"
    "Stability is counted first, dead times included; margins are those of the loop closed with the sign -1. An\n"
    "unstable one is called so and gets neither bandwidth nor a dead time that it bears; its gain margin is the share\n"
    "of its gain with which it would be stable. Poles are those without dead times.\n"
    "Sampled blocks on the way: exact at their instants, poles in z over the period that is common to their clocks,\n"
    "dead time counted in samples too.\n\n"
    "Writes into the folder: result.json (state space in SI, poles, margins), traces/bode.csv, report.html.\n"
    "Exit codes: 0 done, 2 the diagram or the signals are wrong, 3 there is no equilibrium.";

/// A run at the operating point, inputs of the diagram at zero.
Run operating_point(const Arguments& arguments, const Program& program) {
  Run run = start(program);
  const auto zero = std::make_shared<const Series>(Series{{0.0}, {0.0}, Between::linear});
  for (const auto& input : program.input_names) bind_input(program, run, input, zero);
  if (!arguments.has("--at")) {
    settle_at_rest(program, run, 0);
    return run;
  }
  SimulateOptions settings = simulate_options(program);
  settings.until = arguments.seconds("--at", 0);
  settings.instants = {settings.until};
  if (settings.method == Method::automatic || settings.method == Method::exact) settings.method = Method::bdf;
  return *simulate(program, std::move(run), settings).end;
}

int signal_of(const Arguments& arguments, const char* option, const Diagram& diagram, const Program& program,
              const std::vector<int>& otherwise) {
  if (arguments.has(option)) return named_signal(program, diagram, arguments.text(option));
  if (otherwise.size() == 1) return otherwise.front();
  fail(
      "bad_command_line", option,
      fmt::format("the diagram has {} {}",
                  count_text(static_cast<long>(otherwise.size()), option == std::string("--from") ? "input" : "output"),
                  "from outside"),
      fmt::format("name a signal: {} drive", option));
}

double degrees(double radians) { return radians * 180 / pi; }

/// "um/V"; a quotient or product below the line stands in brackets: "um/(V/um)".
std::string ratio_unit(const Unit& to, const Unit& from) {
  if (to.text == from.text) return "";
  if (from.text.empty()) return to.text;
  const bool compound = from.text.find_first_of("/ *.") != std::string::npos;
  return (to.text.empty() ? "1" : to.text) + "/" + (compound ? "(" + from.text + ")" : from.text);
}

CsvTable bode_table(const Bode& b, const Unit& unit, double scale) {
  CsvTable table;
  table.file = "bode.csv";
  table.columns = {{"f", parse_unit("Hz"), {}}, {"magnitude", unit, {}}, {"phase", parse_unit("deg"), {}}};
  for (std::size_t i = 0; i < b.w.size(); ++i) {
    table.columns[0].values.push_back(b.w[i] / (2 * pi));
    table.columns[1].values.push_back(b.magnitude[i] * scale);
    table.columns[2].values.push_back(degrees(b.phase[i]));
  }
  return table;
}

void draw_bode(Document& document, const std::string& unit) {
  Section section;
  section.title = "Bode diagram";
  for (const char* column : {"magnitude", "phase"}) {
    Figure figure;
    figure.title = column;
    figure.x_label = "f [Hz]";
    const bool magnitude = column == std::string("magnitude");
    figure.y_label = magnitude ? (unit.empty() ? "magnitude [1]" : "magnitude [" + unit + "]") : "phase [deg]";
    figure.log_x = true;
    figure.log_y = magnitude;
    Curve curve;
    curve.name = column;
    curve.style = "line";
    curve.trace = "bode.csv";
    curve.x_column = "f";
    curve.y_column = column;
    figure.curves.push_back(std::move(curve));
    section.figures.push_back(std::move(figure));
  }
  document.sections.push_back(std::move(section));
}

Facts matrix_facts(const std::vector<double>& numbers, int rows) {
  Facts::List list;
  const std::size_t columns = rows == 0 ? 0 : numbers.size() / static_cast<std::size_t>(rows);
  for (int i = 0; i < rows; ++i) {
    const auto from = numbers.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(i) * columns);
    list.emplace_back(std::vector<double>(from, from + static_cast<std::ptrdiff_t>(columns)));
  }
  return list;
}

/// "BLOCK=1 um": amplitudes at the inputs of blocks. A value alone counts for every block that passes nothing on.
std::vector<AboutAmplitude> amplitudes(const Arguments& arguments, const Program& program, const Run& run,
                                       const LinearizeOptions& wanted) {
  std::vector<AboutAmplitude> list;
  for (const auto& written : arguments.list("--amplitude")) {
    const auto equals = written.find('=');
    const std::string text = equals == std::string::npos ? written : written.substr(equals + 1);
    double value = 0;
    std::string unit;
    if (!split_quantity(text, value, unit) || !(value > 0) || !std::isfinite(value))
      fail("bad_command_line", "--amplitude", "\"" + written + "\" is no amplitude",
           "write a block and the amplitude at its input: --amplitude play=\"1 um\"");
    std::vector<int> blocks;
    if (equals != std::string::npos) {
      blocks = {program.block_index(written.substr(0, equals))};
    } else {
      for (const int b : blocks_that_cut(program, run, wanted))
        if (has_describing_function(program, b)) blocks.push_back(b);
    }
    if (blocks.empty())
      fail("bad_command_line", "--amplitude",
           "every block passes small motions on here: none needs a describing function",
           "name the block: --amplitude play=\"1 um\"");
    for (const int b : blocks) {
      if (b < 0) {
        std::vector<std::string> names;
        for (const auto& block : program.blocks) names.push_back(block.path);
        fail("bad_command_line", "--amplitude", "there is no block \"" + written.substr(0, equals) + "\"",
             did_you_mean(written.substr(0, equals), names));
      }
      const auto& block = program.blocks[static_cast<std::size_t>(b)];
      const Unit read = parse_unit(unit, "--amplitude");
      const auto& source =
          block.source.empty() ? SignalInfo{} : program.signals[static_cast<std::size_t>(block.source.front())];
      if (dimension_factor(read.dimension, source.dimension) == 0)
        fail("wrong_unit", "--amplitude",
             fmt::format("\"{}\" is no amplitude of \"{}\", the input of {}", text, source.path, block.path),
             fmt::format("write it in {}", unit_text(source.unit)));
      list.push_back({b, read.difference_to_si(value)});
    }
  }
  return list;
}

/// "gain 0.9 um/V at low frequencies". Absent number: without bound.
std::optional<double> low_gain(const SmallMotions& m) {
  const Bode& b = m.bode;
  const double zero = m.sampled ? 1 : 0;
  const bool integrator = std::any_of(m.poles.begin(), m.poles.end(), [&](auto p) { return p == zero; });
  // A pole at zero that the way from input to output sees: |G| falls with the frequency from the start.
  if (integrator && std::log(b.magnitude[0] / b.magnitude[1]) > 0.5 * std::log(b.w[1] / b.w[0])) return std::nullopt;
  // Without a pole at zero the response at w = 0 is a number; with one that the output does not see it is not.
  return integrator ? b.magnitude.front() : std::abs(m.response(0));
}

/// The numbers of the linear model; what is told of it is added to them.
Facts facts_of(const SmallMotions& motions, const std::string& diagram, const SignalInfo& from, const SignalInfo& to,
               const std::string& unit, std::optional<double> lowest, double t) {
  const LinearModel& model = motions.model;
  return Facts::object({{"diagram", diagram},
                        {"from", from.path},
                        {"to", to.path},
                        {"unit", unit},
                        {"gain_at_low_frequencies", lowest},
                        {"operating_point_s", t},
                        {"states", model.state_names},
                        {"a", matrix_facts(model.a, model.states)},
                        {"b", matrix_facts(model.b, model.states)},
                        {"c", matrix_facts(model.c, model.outputs)},
                        {"d", matrix_facts(model.d, model.outputs)},
                        {"dead_times_s", model.delays}});
}

/// Why there are no margins: nothing passes, or what was opened is no loop.
void warn_of_no_loop(Document& document, const SmallMotions& motions, const SignalInfo& from, const SignalInfo& to,
                     bool nothing_passes) {
  document.warnings.push_back(
      nothing_passes
          ? fmt::format("no small motion passes from {} to {}{}", from.path, to.path,
                        motions.cuts.empty() ? ": an opened loop stands between, or no wire leads there" : "")
          : fmt::format("no margins: from {} in {} to {} in {} is no loop gain; name the signal that comes back to "
                        "where the loop is opened, in its unit",
                        from.path, unit_text(from.unit), to.path, unit_text(to.unit)));
}

Answer linearize_verb_act(const Arguments& arguments, const Watch& watch) {
  const Diagram diagram = load_diagram(arguments, watch);
  const ProgramPointer program = compile_file(diagram);
  LinearizeOptions wanted;
  wanted.from = {signal_of(arguments, "--from", diagram, *program, program->input_signals)};
  wanted.to = {signal_of(arguments, "--to", diagram, *program, program->output_signals)};
  for (const auto& name : arguments.list("--open")) wanted.open.push_back(named_signal(*program, diagram, name));
  const auto& from = program->signals[static_cast<std::size_t>(wanted.from.front())];
  const auto& to = program->signals[static_cast<std::size_t>(wanted.to.front())];
  const bool opened = !wanted.open.empty();
  const bool loop = opened && from.unit.dimension == to.unit.dimension;

  Answer answer;
  answer.folder = result_folder(arguments, "linearize");
  Document& document = answer.document;
  document.verb = "linearize";
  document.title = diagram.title.empty() ? stem_of(arguments.text("diagram")) : diagram.title;
  with_lines_of(diagram, [&] {
    const Run run = operating_point(arguments, *program);
    wanted.amplitudes = amplitudes(arguments, *program, run, wanted);
    const SmallMotions motions = small_motions(*program, run, wanted, loop);
    const std::string unit = ratio_unit(to.unit, from.unit);
    const double scale = from.unit.difference_to_si(1) / to.unit.difference_to_si(1);

    Section first;
    first.title = fmt::format("From {} to {}", from.path, to.path);
    document.sections.push_back(std::move(first));
    std::optional<double> lowest = low_gain(motions);
    if (lowest) *lowest *= scale;
    const std::string gain =
        lowest ? "gain " + number_text(*lowest) + (unit.empty() ? "" : " " + unit) + " at low frequencies"
               : "integrating (infinite gain at low frequencies)";
    document.headline =
        fmt::format("{} to {}{}: {}{}", from.path, to.path, opened ? ", loop open" : "", stability_head(motions), gain);
    Facts facts = facts_of(motions, arguments.text("diagram"), from, to, unit, lowest, run.t);
    const PoleCount& judged = motions.closed ? *motions.closed : motions.count;
    const bool unstable = judged.outside > 0 || judged.endless;
    if (const auto width = lowest && !unstable ? bandwidth(motions.response, motions.bode) : std::nullopt) {
      document.sentences.push_back(fmt::format("Bandwidth (-3 dB) {}.", frequency_text(*width)));
      facts.set("bandwidth_hz", *width / (2 * pi));
    }
    tell_poles(document, facts, motions);
    const auto& sizes = motions.bode.magnitude;
    const bool nothing_passes = *std::max_element(sizes.begin(), sizes.end()) == 0;
    if (nothing_passes)
      document.headline = fmt::format("{} does not move {} at this operating point", from.path, to.path);
    if (loop && !nothing_passes)
      tell_margins(document, facts, motions);
    else if (opened || nothing_passes)
      warn_of_no_loop(document, motions, from, to, nothing_passes);
    tell_cuts(document, facts, *program, motions);
    if (motions.any_dead_time)
      document.warnings.push_back(
          "dead times are in the response, in the count of unstable poles and in the margins, not in poles and "
          "matrices");
    for (const auto& about : wanted.amplitudes)
      document.warnings.push_back(
          fmt::format("{} stands for its describing function: right for sines of that amplitude at its input",
                      program->blocks[static_cast<std::size_t>(about.block)].path));
    document.traces.push_back(bode_table(motions.bode, unit.empty() ? Unit{} : parse_unit(unit), scale));
    draw_bode(document, unit);
    document.facts = to_json(facts);
  });
  return answer;
}

std::vector<shape::Member> linearize_shape() { return shape::published({{"facts", shape::of_small_motions()}}); }

}  // namespace

Verb linearize_verb() {
  return {
      "linearize",
      "poles, Bode data, bandwidth and margins at an operating point",
      linearize_help,
      {options::diagram(),
       {"--from", "SIGNAL", "where the small motion enters; default: the diagram's only input", false, false},
       {"--to", "SIGNAL", "where it is looked at; default: the diagram's only output", false, false},
       {"--open", "SIGNAL", "open the loop at this signal", false, true},
       {"--amplitude", "BLOCK=VALUE",
        "describing function of a block, for a sine of this amplitude at its input; a value alone: of all blocks that "
        "pass "
        "nothing on",
        false, true},
       {"--at", "TIME", "operating point: where a simulation is at this time; default: the equilibrium", false, false},
       options::output_folder(),
       options::set(),
       options::choose(),
       options::allow()},
      linearize_verb_act,
      linearize_shape};
}

}  // namespace hysteron
