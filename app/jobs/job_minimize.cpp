// The runs of a job that search: parameters of a diagram at which a value of its simulation is smallest, from several
// seeds, each with its history.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/jobs/job_runs.h"
#include "app/jobs/job_values.h"
#include "engine/diagram/error.h"
#include "fit/estimate/global.h"
#include "fit/model/model.h"

namespace hysteron {
namespace {

/// A parameter that is sought, and where its number stands in a run.
struct Sought {
  const ParameterInfo* info;
  Unit unit;
  double low, high;
};

const ParameterInfo& parameter_named(const Program& program, const WrittenText& name) {
  try {
    return program.parameters[static_cast<std::size_t>(named_parameter(program, name.text))];
  } catch (Error& error) {
    for (auto& p : error.problems) p.path = name.pointer;
    throw Error(error.fault, error.problems);
  }
}

std::vector<Sought> sought_in(const Program& program, const SearchWish& wish) {
  std::vector<Sought> list;
  for (const auto& range : wish.parameters) {
    const ParameterInfo& info = parameter_named(program, range.parameter);
    const Unit unit = parameter_unit(program, info);
    list.push_back({&info, unit, JobRunner::si(range.low, unit), JobRunner::si(range.high, unit)});
    if (!(list.back().low < list.back().high))
      fail("bad_bounds", range.parameter.pointer, "this range is empty", "give its lower end first");
  }
  return list;
}

Attractor attractor_of(const AttractorWish& wish, const SearchWish& search) {
  const auto place = [&](const WrittenText& name) {
    for (std::size_t i = 0; i < search.parameters.size(); ++i)
      if (search.parameters[i].parameter.text == name.text) return static_cast<int>(i);
    std::vector<std::string> names;
    for (const auto& p : search.parameters) names.push_back(p.parameter.text);
    fail("bad_attractor", name.pointer, fmt::format("\"{}\" is none of the parameters sought", name.text),
         did_you_mean(name.text, names));
  };
  return piezo_attractor(place(wish.c), place(wish.k), JobRunner::si(wish.top, parse_unit("V")));
}

/// The signals of the run itself on which a value rests; what else the job takes from a search are its own columns.
std::vector<std::pair<std::string, int>> signals_under(const ValueWish& aim, const Diagram& diagram,
                                                       const Program& program) {
  std::vector<std::pair<std::string, int>> list;
  const auto add = [&](const WrittenText& name) {
    if (name.text.empty() || name.text == "t") return;
    list.emplace_back(name.text, named_signal(program, diagram, name.text));
  };
  const auto add_wish = [&](const SignalWish& s) {
    add(s.signal);
    if (s.minus && !s.minus_run) add(*s.minus);
  };
  add_wish(aim.of);
  if (aim.over) add(*aim.over);
  for (const auto& c : aim.where) add_wish(c.signal);
  return list;
}

/// One row per seed and as many runs as the swarm has particles: seed, iteration, runs, best cost so far.
void add_history(RunResult& r, int seed, const GlobalResult& found, const GlobalSettings& settings) {
  for (long runs = settings.particles; runs <= settings.max_runs; runs += settings.particles) {
    const double cost = found.cost_after(runs);
    if (!std::isfinite(cost)) continue;
    const long generation = runs / settings.particles - 1;
    const std::array<double, 5> row{
        static_cast<double>(seed) * static_cast<double>(settings.max_runs + 1) + static_cast<double>(runs),
        static_cast<double>(seed), static_cast<double>(generation), static_cast<double>(runs), cost};
    for (std::size_t i = 0; i < row.size(); ++i) r.columns[i].values.push_back(row[i]);
  }
}

}  // namespace

RunResult JobRunner::minimized(const RunWish& run) {
  const SearchWish& search = *run.search;
  const auto [diagram, compiled] = program_of(run);
  const Program* const program = compiled.get();
  const SimulateOptions options = options_of(run, *program);
  const auto asked = at(run.aim.pointer, [&] { return signals_under(run.aim, diagram, *program); });
  const std::vector<Sought> sought = sought_in(*program, search);
  const Run base = with_settings(run, *program);
  Quantity kind;  // unit of the cost
  const auto cost_at = [&](const Point* point) {
    Run trial = base;
    for (std::size_t i = 0; point != nullptr && i < sought.size(); ++i)
      for (const int slot : sought[i].info->slots) trial.p[static_cast<std::size_t>(slot)] = (*point)[i];
    prepare(*program, trial);
    reset(*program, trial);
    return take(run.aim, traced(*program, std::move(trial), options, asked));
  };
  kind = cost_at(nullptr);  // as the diagram stands: wrong input is told here, and not taken for a lost candidate
  GlobalProblem problem;
  for (const auto& s : sought) {
    problem.lower.push_back(s.low);
    problem.upper.push_back(s.high);
  }
  problem.cost = [&](const Point& point) {
    try {
      return cost_at(&point).si;
    } catch (const Error&) {
      return std::numeric_limits<double>::infinity();
    }
  };
  if (search.attractor) problem.attractor = attractor_of(*search.attractor, search);
  RunResult r;
  for (const char* name : {"row", "seed", "iteration", "runs"}) r.columns.push_back({name, name, parse_unit(""), {}});
  r.columns.push_back({"cost", "cost", kind.unit, {}});
  GlobalSettings settings;
  settings.max_runs = search.runs;
  GlobalResult best;
  best.cost = std::numeric_limits<double>::infinity();
  for (int seed = 1; seed <= search.seeds; ++seed) {
    settings.seed = static_cast<std::uint64_t>(seed);
    const GlobalResult found =
        at(search.method.pointer, [&] { return minimize_globally(problem, search.method.text, settings); });
    add_history(r, seed, found, settings);
    if (found.cost < best.cost) best = found;
  }
  if (best.best.empty())
    fail_numerics("nothing_found", run.pointer, "at no point that was tried could the diagram be simulated",
                  "give narrower ranges");
  for (std::size_t i = 0; i < sought.size(); ++i)
    r.numbers.emplace_back(sought[i].info->path, Quantity{best.best[i], sought[i].unit, sought[i].info->difference});
  r.numbers.emplace_back("cost", Quantity{best.cost, kind.unit, kind.difference});
  return r;
}

}  // namespace hysteron
