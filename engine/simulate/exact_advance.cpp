#include "engine/simulate/exact_advance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/rowwise/advance.h"
#include "engine/rowwise/advance_graph.h"
#include "engine/simulate/divergence.h"
#include "engine/simulate/forward_sensitivities.h"

namespace hysteron {
namespace {

constexpr int most_substeps = 4096;
constexpr double most_steps = 5e7;  // in all, where the integrator may do it instead

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

/// The advance has no step control, whose choices would be noise between neighbouring runs: central differences of runs
/// along the same steps lose no more than the square of their width.
void add_slopes(const Program& program, const Run& run, const std::vector<int>& parameters, Advance& advance,
                const Advance::Instants& rows, const AdvanceOptions& how, Traces& traces) {
  if (parameters.empty()) return;
  Run center = run;
  for (const int p : parameters)
    for (const int slot : program.parameters[static_cast<std::size_t>(p)].slots) center.varied.push_back(slot);
  const auto pairs = ForwardSensitivities(program, center, parameters).pairs(center);
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

void drop_first_row(Traces& traces) {
  for (auto& v : traces.values) v.erase(v.begin());
  for (auto& slopes : traces.slopes)
    for (auto& v : slopes) v.erase(v.begin());
}

/// Fails at the first value that is no number; `instants`: time of each row [s].
void check_finite(const Program& program, const Traces& traces, const std::vector<double>& instants) {
  for (std::size_t s = 0; s < traces.signals.size(); ++s) {
    const auto& v = traces.values[s];
    const auto bad = std::find_if(v.begin(), v.end(), [](double value) { return !std::isfinite(value); });
    if (bad == v.end()) continue;
    fail_numerics(
        "diverged", program.signals[static_cast<std::size_t>(traces.signals[s])].path,
        fmt::format("the signal is {} at t = {:.9g} s", *bad, instants[static_cast<std::size_t>(bad - v.begin())]),
        "check the parameters of the blocks before it");
  }
}

}  // namespace

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

std::optional<Traces> simulate_exactly(const Program& program, const Run& run, const SimulateOptions& options,
                                       std::vector<double>& instants, const std::vector<int>& signals) {
  const bool early = instants.front() > options.begin;
  const auto own_rows = std::make_shared<std::vector<double>>(std::move(instants));
  if (early) own_rows->insert(own_rows->begin(), options.begin);
  const Advance::Instants rows = own_rows;
  const auto give_back = [&] {  // nobody asks the advance any more
    instants = std::move(*own_rows);
    if (early) instants.erase(instants.begin());
  };
  // The advance keeps a pointer only while it is built and called; the program outlives both.
  Advance advance(ProgramPointer(ProgramPointer(), &program), signals);
  Traces traces;
  traces.signals = signals;
  AdvanceOptions how;
  how.at_rest = options.at_rest;
  const bool may_give_up = options.method == Method::automatic;
  const bool refines = !advance.exact_without_substeps();
  const auto can_be_finer = [&] {
    const auto steps = static_cast<double>(rows->size()) * 2 * how.substeps;
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
  if (!same && may_give_up) {
    give_back();
    return std::nullopt;
  }
  if (!same && advance.integrates())
    fail_numerics("not_fine_enough", "/simulate/solver",
                  fmt::format("rows split into {} steps do not give the nonlinear states to the tolerance asked for",
                              how.substeps),
                  "choose the method \"auto\" or \"bdf\", or more rows");
  traces.statistics.steps = static_cast<long>(rows->size()) * how.substeps;
  traces.statistics.samples = advance.samples();
  add_slopes(program, run, options.slopes_for, advance, rows, how, traces);
  give_back();
  if (early) drop_first_row(traces);
  if (!good) check_finite(program, traces, instants);  // else the advance has looked
  traces.t = std::move(instants);
  traces.statistics.method = "exact";
  return traces;
}

}  // namespace hysteron
