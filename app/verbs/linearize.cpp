// The verb linearize: what a diagram is near an operating point, as poles, Bode data and margins.
// Does not compute (engine/analysis/linearize.h, engine/analysis/margins.h).
#include "engine/analysis/linearize.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/cli/load.h"
#include "app/cli/publish.h"
#include "app/cli/verb.h"
#include "engine/analysis/margins.h"
#include "engine/diagram/error.h"
#include "engine/events/rest.h"
#include "engine/simulate/simulate.h"
#include "report/pages/facts.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

using std::numbers::pi;

constexpr char linearize_help[] =
    "Answers: how does the diagram respond to small motions around an operating point. Prints DC gain, bandwidth\n"
    "and poles from one signal to another; with --open, the loop's gain and phase margin, where its gain is 1 and -3 "
    "dB,\n"
    "and what the closed loop makes of it: bandwidth and largest |T|, largest |S|.\n\n"
    "Examples:\n"
    "  hysteron linearize loop.json --from reference --to stage\n"
    "  hysteron linearize loop.json --from error --to stage --open error      the open loop, with its margins\n"
    "  hysteron linearize loop.json --at \"0.2 s\" --from drive --to stage      where a simulation is after 0.2 s\n\n"
    "The operating point is the equilibrium for the sources as they are at t = 0 and inputs at zero; --at takes the "
    "point\n"
    "that a simulation has reached. Memory and modes are held there: a play operator inside its gap passes nothing.\n"
    "--from adds to the signal; where the loop is opened at the same signal, its readers see only what is added.\n"
    "Margins are those of the loop closed with the sign -1. Dead times count exactly; poles are those without them.\n\n"
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

int signal_of(const Arguments& arguments, const char* option, const Program& program,
              const std::vector<int>& otherwise) {
  if (arguments.has(option)) return program.signal(arguments.text(option));
  if (otherwise.size() == 1) return otherwise.front();
  fail(
      "bad_command_line", option,
      fmt::format("the diagram has {} {}",
                  count_text(static_cast<long>(otherwise.size()), option == std::string("--from") ? "input" : "output"),
                  "from outside"),
      fmt::format("name a signal: {} drive", option));
}

std::string frequency_text(double w) { return number_text(w / (2 * pi), 4) + " Hz"; }
std::string delay_text(double seconds) {
  return seconds < 1e-3 ? number_text(seconds * 1e6) + " us"
         : seconds < 1  ? number_text(seconds * 1e3) + " ms"
                        : number_text(seconds) + " s";
}
double degrees(double radians) { return radians * 180 / pi; }

/// "um/V"; a quotient or product below the line stands in brackets: "um/(V/um)".
std::string ratio_unit(const Unit& to, const Unit& from) {
  if (to.text == from.text) return "";
  if (from.text.empty()) return to.text;
  const bool compound = from.text.find_first_of("/ *.") != std::string::npos;
  return (to.text.empty() ? "1" : to.text) + "/" + (compound ? "(" + from.text + ")" : from.text);
}

std::string pole_text(std::complex<double> p) {
  const double size = std::abs(p);
  if (p == 0.0) return "0 (an integrator)";
  if (p.imag() == 0) return fmt::format("{} rad/s", number_text(p.real(), 5));
  return fmt::format("{} +- {}j rad/s ({}, damping {})", number_text(p.real(), 5), number_text(std::abs(p.imag()), 5),
                     frequency_text(size), number_text(-p.real() / size, 3));
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

void add_poles(Document& document, Facts& facts, const LinearModel& model) {
  Facts::List list;
  Table table;
  table.title = "Poles";
  table.columns = {"pole"};
  for (const auto& p : model.poles()) {
    list.emplace_back(std::vector<double>{p.real(), p.imag()});
    if (p.imag() >= 0) table.rows.push_back({pole_text(p)});
    if (p.real() > 0) document.warnings.push_back(fmt::format("unstable: pole at {}", pole_text(p)));
  }
  facts.set("poles_rad_per_s", list);
  if (!table.rows.empty()) document.sections.front().tables.push_back(std::move(table));
}

void add_margins(Document& document, Facts& facts, const Response& loop, const Bode& b) {
  const Margins m = margins(loop, b);
  Facts given;
  if (m.phase_margin) {
    document.sentences.push_back(fmt::format("Phase margin {} deg at {}; a further dead time of {} would take it away.",
                                             number_text(degrees(*m.phase_margin)), frequency_text(m.phase_margin_at),
                                             delay_text(m.delay_margin)));
    given.set("phase_margin_deg", degrees(*m.phase_margin));
    given.set("phase_margin_at_hz", m.phase_margin_at / (2 * pi));
    given.set("delay_margin_s", m.delay_margin);
  } else {
    document.sentences.push_back("The loop's gain never is 1: no phase margin.");
  }
  if (m.gain_margin) {
    document.sentences.push_back(fmt::format("Gain margin {} ({} dB) at {}.", number_text(*m.gain_margin),
                                             number_text(20 * std::log10(*m.gain_margin)),
                                             frequency_text(m.gain_margin_at)));
    given.set("gain_margin", *m.gain_margin);
    given.set("gain_margin_at_hz", m.gain_margin_at / (2 * pi));
  } else {
    document.sentences.push_back("The phase never passes -180 deg: no limit to the gain.");
  }
  facts.set("margins", given);
}

/// What the closed loop will be. Only of a loop gain, which has no unit.
void add_closed_loop(Document& document, Facts& facts, const Response& loop, const Bode& b) {
  const ClosedLoop c = closed_loop(loop, b);
  Facts given;
  const auto frequency = [&](const char* name, const std::optional<double>& w) {
    if (w) given.set(name, *w / (2 * pi));
    return w ? frequency_text(*w) : std::string("nowhere");
  };
  document.sentences.push_back(fmt::format("The loop's gain is -3 dB at {}.", frequency("open_3db_hz", c.open_half)));
  document.sentences.push_back(fmt::format(
      "Closed: T = L/(1 + L) is -3 dB at {}, at most {} at {}; S = 1/(1 + L) is -3 dB at {}, at most {} at {}.",
      frequency("closed_3db_hz", c.closed_half), number_text(c.closed.magnitude),
      frequency("closed_peak_at_hz", c.closed.at), frequency("sensitivity_3db_hz", c.sensitivity_half),
      number_text(c.sensitivity.magnitude), frequency("sensitivity_peak_at_hz", c.sensitivity.at)));
  given.set("closed_peak", c.closed.magnitude);
  given.set("sensitivity_peak", c.sensitivity.magnitude);
  facts.set("closed_loop", given);
}

int linearize_verb_act(const Arguments& arguments) {
  const Diagram diagram = load_diagram(arguments);
  const ProgramPointer program = compile_file(diagram);
  LinearizeOptions wanted;
  wanted.from = {signal_of(arguments, "--from", *program, program->input_signals)};
  wanted.to = {signal_of(arguments, "--to", *program, program->output_signals)};
  for (const auto& name : arguments.list("--open")) wanted.open.push_back(program->signal(name));
  const auto& from = program->signals[static_cast<std::size_t>(wanted.from.front())];
  const auto& to = program->signals[static_cast<std::size_t>(wanted.to.front())];

  Document document;
  document.verb = "linearize";
  document.title = diagram.title.empty() ? stem_of(arguments.text("diagram")) : diagram.title;
  with_lines_of(diagram, [&] {
    const Run run = operating_point(arguments, *program);
    const LinearModel model = linearize(*program, run, wanted);
    const Response response = [&](double w) { return model.response(w).front(); };
    const auto poles = model.poles();
    double longest = 0;
    for (const double delay : model.delays) longest = std::max(longest, delay);
    const Bode b = bode(response, frequencies(poles, longest));
    const std::string unit = ratio_unit(to.unit, from.unit);
    const double scale = from.unit.difference_to_si(1) / to.unit.difference_to_si(1);

    Section first;
    first.title = fmt::format("From {} to {}", from.path, to.path);
    document.sections.push_back(std::move(first));
    // A pole at zero that the way from input to output sees: |G| falls with the frequency from the start.
    const bool integrates = std::any_of(poles.begin(), poles.end(), [](auto p) { return p == 0.0; }) &&
                            std::log(b.magnitude[0] / b.magnitude[1]) > 0.5 * std::log(b.w[1] / b.w[0]);
    // Without a pole at zero the response at w = 0 is a number; with one that the output does not see it is not.
    const bool at_rest = std::none_of(poles.begin(), poles.end(), [](auto p) { return p == 0.0; });
    const double lowest = (at_rest ? std::abs(response(0)) : b.magnitude.front()) * scale;
    const std::string gain = integrates
                                 ? "without bound at low frequencies"
                                 : number_text(lowest) + (unit.empty() ? "" : " " + unit) + " at low frequencies";
    document.headline =
        fmt::format("{} to {}{}: gain {}", from.path, to.path, wanted.open.empty() ? "" : ", loop open", gain);
    Facts facts = Facts::object({{"diagram", arguments.text("diagram")},
                                 {"from", from.path},
                                 {"to", to.path},
                                 {"unit", unit},
                                 {"gain_at_low_frequencies", integrates ? std::optional<double>{} : lowest},
                                 {"operating_point_s", run.t},
                                 {"states", model.state_names},
                                 {"a", matrix_facts(model.a, model.states)},
                                 {"b", matrix_facts(model.b, model.states)},
                                 {"c", matrix_facts(model.c, model.outputs)},
                                 {"d", matrix_facts(model.d, model.outputs)},
                                 {"dead_times_s", model.delays}});
    if (const auto width = integrates ? std::nullopt : bandwidth(response, b)) {
      document.sentences.push_back(fmt::format("Bandwidth (-3 dB) {}.", frequency_text(*width)));
      facts.set("bandwidth_hz", *width / (2 * pi));
    }
    if (*std::max_element(b.magnitude.begin(), b.magnitude.end()) == 0)
      document.warnings.push_back(fmt::format(
          "nothing passes from {} to {} here: a saturation at its limit, a play operator inside its gap or an opened "
          "loop stands between; --at takes another operating point",
          from.path, to.path));
    else if (!wanted.open.empty()) {
      add_margins(document, facts, response, b);
      if (from.unit.dimension == to.unit.dimension) add_closed_loop(document, facts, response, b);
    }
    add_poles(document, facts, model);
    if (!model.delays.empty())
      document.warnings.push_back("dead times are in the response and in the margins, not in poles and matrices");
    document.traces.push_back(bode_table(b, unit.empty() ? Unit{} : parse_unit(unit), scale));
    draw_bode(document, unit);
    document.facts = to_json(facts);
  });
  publish(arguments, result_folder(arguments, "linearize"), document);
  return exit_code::done;
}

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
       {"--at", "TIME", "operating point: where a simulation is at this time; default: the equilibrium", false, false},
       options::output_folder(),
       options::set(),
       options::choose(),
       options::allow()},
      linearize_verb_act};
}

}  // namespace hysteron
