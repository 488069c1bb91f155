// Decides which way a simulation goes: exactly, row by row; in steps of one length; or in steps that follow the error.
#include "engine/simulate/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "engine/events/rest.h"
#include "engine/program/loops.h"
#include "engine/simulate/adaptive_step.h"
#include "engine/simulate/choose_method.h"
#include "engine/simulate/exact_advance.h"
#include "engine/simulate/fixed_step.h"
#include "engine/simulate/output_instants.h"
#include "engine/simulate/simulate_parts.h"
#include "engine/simulate/step_tolerances.h"

namespace hysteron {
namespace {

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

Traces simulate(const Program& program, Run run, const SimulateOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  auto instants = output_instants(options);
  check_inputs(program, run);
  const auto held = held_tolerance(program, options);
  set_loop_accuracy(program, run, held.relative_tolerance, held.absolute_tolerance);
  const auto& signals = options.signals.empty() ? program.record_signals : options.signals;
  run.t = options.begin;
  std::optional<Traces> exact;
  if (!options.slopes_for.empty() && has_fixed_steps(options.method))
    fail("bad_value", "/simulate/solver/method", "slopes do not come with fixed steps",
         "choose auto, exact, bdf, adams or runge_kutta");
  if (advances_exactly(program, options)) {
    Phases phases;
    {
      const Stopwatch watch(phases.integrate);
      exact = simulate_exactly(program, run, options, instants, signals);
    }
    if (exact) exact->statistics.phases = phases;
  }
  Traces traces;
  if (exact) {
    traces = std::move(*exact);
  } else {
    if (options.at_rest) settle_at_rest(program, run, options.begin);
    if (has_fixed_steps(options.method)) {
      traces = simulate_in_fixed_steps(program, std::move(run), options, std::move(instants), signals);
    } else {
      auto how = held_tolerance(program, options);
      MethodChoice choice{options.method, ""};
      if (options.method == Method::automatic)
        choice = choose_method(program, run, options.begin, instants.back() - options.begin);
      how.method = choice.method;
      traces = simulate_in_adaptive_steps(program, std::move(run), std::move(how), std::move(instants), signals);
      traces.statistics.why = choice.why;
    }
  }
  traces.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return traces;
}

}  // namespace hysteron
