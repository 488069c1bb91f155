#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/rowwise/advance.h"
#include "engine/rowwise/advance_graph.h"
#include "engine/simulate/divergence.h"
#include "engine/simulate/forward_sensitivities.h"
#include "engine/simulate/simulate.h"
#include "engine/simulate/simulate_parts.h"

namespace hysteron {
namespace {

constexpr int default_points = 1000;
constexpr std::size_t most_instants = 50'000'000;
constexpr int most_substeps = 4096;
constexpr double most_steps = 5e7;  // in all, where the integrator may do it instead

double seconds(const Number& number, const char* key, Problems& problems) {
  const std::string path = std::string("/simulate/") + key;
  if (!number.unit) return number.value;
  const Unit unit = parse_unit(*number.unit, path);
  if (!(unit.dimension == parse_unit("s").dimension))
    problems.add("wrong_unit", path, fmt::format("{} {} is not a time", number.value, *number.unit),
                 "give a time, such as \"0.1 ms\"");
  return unit.to_si(number.value);
}

/// What a file says of times must lie above zero: nothing is taken as not written. "inf s" is no end and no step.
double positive_seconds(const Number& number, const char* key, const char* what, Problems& problems) {
  const double value = seconds(number, key, problems);
  if (!(value > 0) || !std::isfinite(value))
    problems.add("bad_value", std::string("/simulate/") + key, fmt::format("{} of {} s is not possible", what, value),
                 "give a time above 0 s, or leave it out where there is a default");
  return value;
}

/// Largest difference over the largest value, over all signals.
double change(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
  double worst = 0;
  for (std::size_t s = 0; s < a.size(); ++s) {
    double size = 0, difference = 0;
    for (std::size_t k = 0; k < a[s].size(); ++k) {
      size = std::max(size, std::abs(b[s][k]));
      difference = std::max(difference, std::abs(a[s][k] - b[s][k]));
    }
    if (size > 0) worst = std::max(worst, difference / size);
  }
  return worst;
}

}  // namespace

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names{"auto", "exact", "bdf", "adams", "runge_kutta", "euler", "rk4"};
  return names;
}
const std::string& method_name(Method method) { return method_names()[static_cast<std::size_t>(method)]; }

SimulateOptions simulate_options(const Program& program, SimulateOptions options) {
  const auto& given = program.simulate;
  Problems problems;
  if (given.until) options.until = positive_seconds(*given.until, "until", "an end", problems);
  if (given.every) options.every = positive_seconds(*given.every, "every", "an output step", problems);
  if (given.step) options.step = positive_seconds(*given.step, "solver/step", "a step", problems);
  if (given.max_step)
    options.max_step = positive_seconds(*given.max_step, "solver/max_step", "a longest step", problems);
  if (given.relative_tolerance) options.relative_tolerance = *given.relative_tolerance;
  if (given.absolute_tolerance) options.absolute_tolerance = *given.absolute_tolerance;
  if (given.start) {
    options.at_rest = *given.start == "steady";
    if (*given.start != "steady" && *given.start != "given")
      problems.add("bad_value", "/simulate/start", fmt::format("a run cannot start \"{}\"", *given.start),
                   did_you_mean(*given.start, {"given", "steady"}));
  }
  if (given.method) {
    const auto& names = method_names();
    const auto found = std::find(names.begin(), names.end(), *given.method);
    if (found == names.end())
      problems.add("bad_value", "/simulate/solver/method", fmt::format("there is no method \"{}\"", *given.method),
                   did_you_mean(*given.method, names));
    else
      options.method = static_cast<Method>(found - names.begin());
  }
  problems.throw_if_any();
  return options;
}

std::vector<double> output_instants(const SimulateOptions& o) {
  Problems problems;
  const auto bad = [&](const char* key, const std::string& what, const char* cure) {
    problems.add("bad_value", std::string("/simulate/") + key, what, cure);
  };
  if (!(o.relative_tolerance > 0 && o.relative_tolerance < 1))
    bad("solver/relative_tolerance", fmt::format("a relative tolerance of {} is not possible", o.relative_tolerance),
        "choose it between 1e-12 and 1e-3");
  if (!(o.absolute_tolerance > 0) || !std::isfinite(o.absolute_tolerance))
    bad("solver/absolute_tolerance", fmt::format("an absolute tolerance of {} is not possible", o.absolute_tolerance),
        "choose a positive number (a multiple of relative_tolerance times each state's nominal size)");
  if (!(o.max_step >= 0) || !std::isfinite(o.max_step))
    bad("solver/max_step", fmt::format("a step of {} s is not possible", o.max_step), "choose a positive time");
  if (!o.instants.empty()) {
    for (std::size_t i = 0; i < o.instants.size(); ++i) {
      if (std::isfinite(o.instants[i]) && (i == 0 ? o.instants[0] >= o.begin : o.instants[i] > o.instants[i - 1]))
        continue;
      bad("instants",
          fmt::format("output time {} ({} s) is not behind the one before or the start ({} s)", i, o.instants[i],
                      o.begin),
          "give increasing times, none before the start");
      break;
    }
    problems.throw_if_any();
    return o.instants;
  }
  if (!(o.until > o.begin) || !std::isfinite(o.until))
    bad("until", fmt::format("the end ({} s) is not behind the start ({} s)", o.until, o.begin), "give a later end");
  if (!(o.every >= 0) || !std::isfinite(o.every))
    bad("every", fmt::format("an output step of {} s is not possible", o.every), "choose a positive time");
  problems.throw_if_any();
  const double span = o.until - o.begin;
  const double every = o.every > 0 ? o.every : span / default_points;
  // One part in 1e9 forgives 0.3 / 0.1 being less than 3.
  const double steps = std::floor(span / every * (1 + 1e-9));
  if (steps >= static_cast<double>(most_instants))
    fail("bad_value", "/simulate/every", fmt::format("{:.3g} output times are more than can be kept", steps),
         "choose a longer output step");
  std::vector<double> instants(static_cast<std::size_t>(steps) + 1);
  for (std::size_t k = 0; k < instants.size(); ++k) instants[k] = o.begin + static_cast<double>(k) * every;
  if (o.until - instants.back() < 1e-6 * every) instants.back() = o.until;
  return instants;
}

void check_inputs(const Program& program, const Run& run) {
  Problems problems;
  for (std::size_t i = 0; i < program.input_names.size(); ++i)
    if (!run.series[i] || run.series[i]->t.empty())
      problems.add("unbound_input", "/inputs/" + program.input_names[i],
                   fmt::format("nothing drives the input \"{}\" of the diagram", program.input_names[i]),
                   "bind a recording to it (--data), or replace the input by a source block");
  problems.throw_if_any();
}

bool advances_exactly(const Program& program, const SimulateOptions& options) {
  if (options.method != Method::automatic && options.method != Method::exact) return false;
  auto graph = advance_graph(program);
  // Some blocks with modes can be advanced row by row; but only an integrator finds when they change.
  if (graph.why_not.empty() && !program.modal_blocks.empty()) {
    const auto& b = program.blocks[static_cast<std::size_t>(program.modal_blocks.front())];
    graph.why_not = changes_mode(b);
    graph.in_the_way = b.path;
  }
  // A free choice leaves loops with nonlinear blocks to the integrators: they see where these switch.
  if (options.method == Method::automatic) return graph.why_not.empty() && graph.loops.empty();
  if (graph.why_not.empty()) return true;
  fail("not_exact", graph.in_the_way, "the diagram cannot be advanced exactly: " + graph.why_not,
       "choose the method \"auto\" or \"bdf\"");
}

namespace {

/// The advance has no step control, whose choices would be noise between neighbouring runs: central differences of runs
/// along the same steps lose no more than the square of their width.
void add_slopes(const Program& program, const Run& run, const std::vector<int>& parameters, Advance& advance,
                const Advance::Instants& rows, const AdvanceOptions& how, Traces& traces) {
  if (parameters.empty()) return;
  const auto pairs = ForwardSensitivities(program, run, parameters).pairs(run);
  std::vector<const Run*> runs;
  for (const auto& pair : pairs) runs.insert(runs.end(), {&pair.up, &pair.down});
  std::vector<std::vector<std::vector<double>>> values;
  const auto errors = advance.each(runs, rows, how, values);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    for (const std::size_t side : {2 * k, 2 * k + 1})
      if (!errors[side].empty())
        fail_numerics("diverged", program.parameters[static_cast<std::size_t>(parameters[k])].path,
                      "beside the value given, where its slope is taken: " + errors[side],
                      "take another value of the parameter, or leave its slope out");
    auto& slopes = traces.slopes.emplace_back(std::move(values[2 * k]));
    for (std::size_t s = 0; s < slopes.size(); ++s)
      for (std::size_t i = 0; i < slopes[s].size(); ++i)
        slopes[s][i] = (slopes[s][i] - values[2 * k + 1][s][i]) / (2 * pairs[k].h);
  }
}

/// Where a run of the advance has failed: the same again, of what has states, tells which grew and since when.
void explain_rows(const Program& program, const Run& run, const Advance::Instants& rows, const AdvanceOptions& how) {
  const auto signals = signals_of_states(program);
  if (signals.empty()) return;
  std::vector<std::vector<double>> values;
  try {
    Advance(ProgramPointer(ProgramPointer(), &program), signals)(run, rows, how, values);
  } catch (const Error&) {  // known already
  }
  if (values.size() == signals.size()) throw_if_rows_grow(program, run, signals, *rows, values);
}

}  // namespace

std::optional<Traces> simulate_exactly(const Program& program, const Run& run, const SimulateOptions& options,
                                       std::vector<double> instants, const std::vector<int>& signals) {
  const bool early = instants.front() > options.begin;
  if (early) instants.insert(instants.begin(), options.begin);
  const auto rows = std::make_shared<const std::vector<double>>(instants);
  // The advance keeps a pointer only while it is built and called; the program outlives both.
  Advance advance(ProgramPointer(ProgramPointer(), &program), signals);
  Traces traces;
  traces.signals = signals;
  AdvanceOptions how;
  how.at_rest = options.at_rest;
  const bool may_give_up = options.method == Method::automatic;
  const bool refines = !advance.exact_without_substeps();
  const auto can_be_finer = [&] {
    const auto steps = static_cast<double>(instants.size()) * 2 * how.substeps;
    return refines && how.substeps < most_substeps && (!may_give_up || steps <= most_steps);
  };
  // Steps that are too long for nonlinear states let them run away: shorter ones may not. True: here are the values.
  const auto try_advance = [&](std::vector<std::vector<double>>& values) {
    try {
      advance(run, rows, how, values);
      return true;
    } catch (const Error& error) {
      const bool ran_away = error.problems.front().code == "diverged";
      if (ran_away && (can_be_finer() || (refines && may_give_up))) return false;
      if (ran_away) explain_rows(program, run, rows, how);
      throw;
    }
  };
  bool good = try_advance(traces.values);
  // Rows are halved until the result stays; the last change bounds what is left (the error falls with the second
  // power).
  bool same = !refines;
  while (!same && can_be_finer()) {
    how.substeps *= 2;
    auto finer = traces.values;
    const bool good_too = try_advance(finer);
    same = good && good_too && change(traces.values, finer) <= options.relative_tolerance;
    good = good_too;
    traces.values = std::move(finer);
  }
  if (!same && may_give_up) return std::nullopt;
  if (!same && advance.integrates())
    fail_numerics("not_fine_enough", "/simulate/solver",
                  fmt::format("rows split into {} steps do not give the nonlinear states to the tolerance asked for",
                              how.substeps),
                  "choose the method \"auto\" or \"bdf\", or more rows");
  traces.statistics.steps = static_cast<long>(instants.size()) * how.substeps;
  traces.statistics.samples = advance.samples();
  add_slopes(program, run, options.slopes_for, advance, rows, how, traces);
  if (early) {
    instants.erase(instants.begin());
    for (auto& v : traces.values) v.erase(v.begin());
    for (auto& slopes : traces.slopes)
      for (auto& v : slopes) v.erase(v.begin());
  }
  for (std::size_t s = 0; s < signals.size(); ++s) {
    const auto& v = traces.values[s];
    const auto bad = std::find_if(v.begin(), v.end(), [](double value) { return !std::isfinite(value); });
    if (bad == v.end()) continue;
    fail_numerics(
        "diverged", program.signals[static_cast<std::size_t>(signals[s])].path,
        fmt::format("the signal is {} at t = {:.9g} s", *bad, instants[static_cast<std::size_t>(bad - v.begin())]),
        "check the parameters of the blocks before it");
  }
  traces.t = std::move(instants);
  traces.statistics.method = "exact";
  return traces;
}

}  // namespace hysteron
