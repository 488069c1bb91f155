#include "app/verbs/explain_solver.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/diagram/error.h"
#include "engine/lanes/lanes.h"
#include "engine/program/breakpoints.h"
#include "engine/simulate/choose_method.h"
#include "engine/simulate/exact_advance.h"
#include "engine/simulate/fixed_step.h"
#include "engine/simulate/jacobian.h"
#include "engine/simulate/simulate.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

/// "" if the exact advance applies; else what stands in the way.
std::string why_not_exactly(const Program& program, SimulateOptions options) {
  options.method = Method::exact;
  try {
    advances_exactly(program, options);
    return "";
  } catch (const Error& error) {
    const std::string& what = error.problems.front().what;
    const auto colon = what.find(": ");
    return colon == std::string::npos ? what : what.substr(colon + 2);
  }
}

std::string exact_because(const Program& program) {
  return program.sampled_blocks.empty()
             ? "every source is a recording, and no block changes its mode"
             : "between instants only recordings drive blocks with memory, and no block changes its mode";
}

std::string from_diagram(bool given) { return given ? "as the diagram says" : "default"; }

std::pair<std::string, std::string> longest_step_and_why(const Program& program, const Run& run,
                                                         const SimulateOptions& options) {
  if (options.max_step > 0) return {time_words(options.max_step), "as the diagram says"};
  const double longest = longest_step(program, run, options.until - options.begin);
  if (!std::isfinite(longest)) return {"not limited", "no source reaches a memory, and there is no dead time"};
  for (std::size_t b = 0; b < program.blocks.size(); ++b) {
    const auto& one = program.blocks[b];
    if (one.kernel->shortest_period == nullptr || one.series_index >= 0) continue;
    if (one.kernel->shortest_period(view_of(program, run, static_cast<int>(b))) / 4 == longest)
      return {time_words(longest),
              fmt::format("a quarter of the shortest period of {}, which reaches a memory", one.path)};
  }
  return {time_words(longest), "the shortest dead time"};
}

void add_integrator_rows(std::vector<std::vector<std::string>>& rows, const Program& program, const Run& run,
                         const SimulateOptions& options) {
  const auto& given = program.simulate;
  if (has_fixed_steps(options.method)) {
    rows.push_back({"step", time_words(options.step), from_diagram(given.step.has_value())});
    return;
  }
  rows.push_back({"relative tolerance", number_text(options.relative_tolerance),
                  from_diagram(given.relative_tolerance.has_value())});
  rows.push_back({"absolute tolerance", number_text(options.absolute_tolerance),
                  from_diagram(given.absolute_tolerance.has_value()) +
                      "; times the relative one, times the nominal size of each state"});
  const auto [longest, why] = longest_step_and_why(program, run, options);
  rows.push_back({"longest step", longest, why});
  if (options.method == Method::bdf && program.n_x > 0) {
    const Jacobian jacobian(program);
    rows.push_back({"Jacobian", fmt::format("{} x {}", program.n_x, program.n_x),
                    fmt::format("exact slopes, {}", count_text(jacobian.colours(), "direction"))});
  }
}

}  // namespace

SolverWords solver_words(const Program& program, const Run& run) {
  SimulateOptions options = simulate_options(program);
  const std::string reason = why_not_exactly(program, options);
  const bool exact = reason.empty() && advances_exactly(program, options);
  SolverWords words;
  auto& rows = words.rows;
  const bool asked = options.method != Method::automatic;
  MethodChoice choice{options.method, "as the diagram says"};
  if (!asked && exact) choice = {Method::exact, exact_because(program)};
  if (!asked && !exact) choice = choose_method(program, run, options.begin, options.until - options.begin);
  words.method = method_name(choice.method);
  words.why = choice.why;
  rows.push_back({"method", words.method, words.why});
  rows.push_back({"exact row by row", reason.empty() ? "applies" : "does not apply", reason});
  const double until = options.until;
  rows.push_back({"until", program.simulate.until ? time_words(until) : "open",
                  program.simulate.until ? from_diagram(true) : "--until, or the recordings of --data"});
  rows.push_back({"output every", options.every > 0 ? time_words(options.every) : "a thousandth of the time",
                  from_diagram(program.simulate.every.has_value())});
  const std::string apart = why_not_in_lanes(program);
  rows.push_back(
      {"in lanes", apart.empty() ? "applies" : "does not apply",
       apart.empty()
           ? "many parameter sets side by side, with the methods euler and rk4; not where the corners of a source "
             "are varied"
           : apart});
  options.method = choice.method;
  if (!exact) add_integrator_rows(rows, program, run, options);
  return words;
}

std::string time_words(double seconds) {
  const double size = std::abs(seconds);
  const char* unit = size == 0 || size >= 1 ? "s" : size >= 0.999e-3 ? "ms" : size >= 0.999e-6 ? "us" : "ns";
  return quantity_text(seconds, parse_unit(unit), 6);
}

}  // namespace hysteron
