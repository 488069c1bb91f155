#include "app/jobs/job_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/cli/load.h"
#include "app/jobs/job_values.h"
#include "engine/diagram/error.h"
#include "engine/simulate/simulate.h"
#include "fit/model/model.h"
#include "io/data/table_file.h"
#include "io/diagram/diagram_file.h"

namespace hysteron {
namespace {

constexpr double most_rows = 2e7;

/// The name behind the last dot: "model.weights[2]" -> "weights[2]".
std::string last_name(const std::string& path) {
  const auto dot = path.rfind('.');
  return dot == std::string::npos ? path : path.substr(dot + 1);
}

void put(const Program& program, Run& run, const std::string& path, double si) {
  const auto& info = program.parameters[static_cast<std::size_t>(named_parameter(program, path))];
  for (const int slot : info.slots) run.p[static_cast<std::size_t>(slot)] = si;
}

void check_dimension(const Unit& found, const Unit& expected, const std::string& path, const std::string& what) {
  if (found.dimension == expected.dimension) return;
  const auto name = [](const Unit& u) { return u.text.empty() ? "a number without unit" : "\"" + u.text + "\""; };
  fail("wrong_unit", path, fmt::format("{} is in {}, this is in {}", what, name(expected), name(found)),
       fmt::format("give it in {}", name(expected)));
}

}  // namespace

const RunColumn* RunResult::find(const std::string& signal) const {
  for (const auto& c : columns)
    if (c.name == signal) return &c;
  for (const auto& c : columns)
    if (c.path == signal) return &c;
  return nullptr;
}

const Quantity* RunResult::number(const std::string& name) const {
  for (const auto& [n, q] : numbers)
    if (n == name) return &q;
  return nullptr;
}

// ---- the pool -------------------------------------------------------------------------------------------------------

JobPool::JobPool(std::vector<std::string> allowed, bool full) : allowed_(std::move(allowed)), full_(full) {}
JobPool::~JobPool() = default;

JobRunner& JobPool::job(const std::string& file) {
  const std::string identity = std::filesystem::weakly_canonical(file).string();
  const std::lock_guard lock(mutex_);
  if (const auto found = jobs_.find(identity); found != jobs_.end()) return *found->second;
  if (std::find(opening_.begin(), opening_.end(), identity) != opening_.end())
    fail("circular", file, "two jobs take runs from each other", "let one of them do the run itself");
  RunsJob job = read_runs_job(file, allowed_, full_);
  opening_.push_back(identity);
  for (const auto& run : job.runs)
    if (run.kind == RunKind::elsewhere) open(run, file);
  opening_.pop_back();
  return *jobs_.emplace(identity, std::make_unique<JobRunner>(*this, std::move(job))).first->second;
}

/// The job from which a run is taken; where it cannot be had, the place that names it is told.
void JobPool::open(const RunWish& run, const std::string& from) {
  try {
    job(run.file);
  } catch (Error& error) {
    for (auto& p : error.problems)
      if (p.line == 0) p.path = run.pointer;
    locate_problems(error, from);
    throw Error(error.fault, error.problems);
  }
}

// ---- one job --------------------------------------------------------------------------------------------------------

JobRunner::JobRunner(JobPool& pool, RunsJob job) : pool_(&pool), job_(std::move(job)) {
  for (const auto& run : job_.runs) slots_[run.name];
}

std::unique_ptr<JobRunner> JobRunner::with_result(const std::string& run, RunResult result) {
  auto other = std::make_unique<JobRunner>(*pool_, job_);
  const auto given = std::make_shared<const RunResult>(std::move(result));
  for (const auto& r : job_.runs)
    other->slots_.at(r.name).result = r.name == run ? given : shared_result({r.name, r.pointer});
  return other;
}

void JobRunner::blame(Error& error, const std::string& pointer) const {
  auto problems = error.problems;
  for (auto& p : problems)
    if (p.file.empty() && p.line == 0 && (p.path.empty() || p.path.front() != '/')) {
      if (!p.path.empty() && p.path != pointer && p.what.find(p.path) == std::string::npos)
        p.what = p.path + ": " + p.what;
      p.path = pointer;
    }
  Error located(error.fault, std::move(problems));
  locate_problems(located, job_.file);
  throw Error(located.fault, located.problems);
}

double JobRunner::si(const WrittenNumber& number, const Unit& expected) {
  if (!number.number.unit) return expected.to_si(number.number.value);
  const Unit unit = parse_unit(*number.number.unit, number.pointer);
  check_dimension(unit, expected, number.pointer, "what is meant");
  return unit.to_si(number.number.value);
}

double JobRunner::seconds(const WrittenNumber& number) { return si(number, parse_unit("s")); }

const RunWish& JobRunner::wish(const WrittenText& run) const {
  std::vector<std::string> known;
  for (const auto& r : job_.runs) {
    if (r.name == run.text) return r;
    known.push_back(r.name);
  }
  fail("unknown_run", run.pointer, fmt::format("{} has no run \"{}\"", job_.file, run.text),
       did_you_mean(run.text, known));
}

std::shared_ptr<const RunResult> JobRunner::shared_result(const WrittenText& run) {
  const RunWish& wanted = wish(run);
  Slot& slot = slots_.at(run.text);
  const std::lock_guard lock(slot.mutex);
  if (!slot.result) slot.result = at(wanted.pointer, [&] { return done(wanted); });
  return slot.result;
}

std::shared_ptr<const RunResult> JobRunner::done(const RunWish& run) {
  if (run.kind == RunKind::elsewhere) return pool_->job(run.file).shared_result(run.other_run);
  const auto made = [&]() -> RunResult {
    if (run.kind == RunKind::linearize) return linearized(run);
    if (run.kind == RunKind::fit) return fitted(run);
    if (run.kind == RunKind::table) return table(run);
    if (run.kind == RunKind::find) return sought(run);
    if (run.kind == RunKind::minimize) return minimized(run);
    if (run.kind == RunKind::study) return studied(run);
    if (run.kind == RunKind::select) return selected(run);
    if (run.kind == RunKind::rows) return made_of_values(run);
    if (run.kind == RunKind::computed) return of_formula(run);
    return simulated(run);
  };
  return std::make_shared<const RunResult>(made());
}

std::vector<WrittenText> JobRunner::wanted(const RunWish& run) const {
  std::vector<WrittenText> list;
  const auto add = [&](const WrittenText& signal) {
    if (!signal.text.empty()) list.push_back(signal);
  };
  const auto add_wish = [&](const SignalWish& s, bool of_this_run) {
    if (of_this_run) add(s.signal);
    if (s.minus && (s.minus_run ? s.minus_run->text == run.name : of_this_run)) add(*s.minus);
  };
  const auto add_value = [&](const ValueWish& v, bool of_this_run) {
    add_wish(v.of, of_this_run);
    if (v.over && of_this_run) add(*v.over);
    for (const auto& c : v.where) add_wish(c.signal, of_this_run);
  };
  for (const auto& v : job_.values) add_value(v, v.run.text == run.name);
  if (run.kind == RunKind::find || run.kind == RunKind::minimize) add_value(run.aim, true);
  for (const auto& other : job_.runs)
    if (other.data && other.data->run.text == run.name)
      for (const auto& [column, signal] : other.data->columns) add(signal);
  for (const auto& p : job_.plots) {
    const bool named = std::any_of(p.runs.begin(), p.runs.end(), [&](const auto& r) { return r.text == run.name; });
    for (const auto* axis : {&p.x, &p.y})
      for (const auto& s : axis->signals) add_wish(s, named);
    for (const auto& c : p.where) add_wish(c.signal, named);
  }
  for (const auto& other : job_.runs) {
    if (other.of_run && other.of_run->text == run.name)
      for (const auto& [argument, signal] : other.of) add(signal);
    if (other.kind == RunKind::select && other.other_run.text == run.name)
      for (const auto& c : other.where) add_wish(c.signal, true);
  }
  return list;
}

/// By name: what the diagram records, what the job asks of this run, and what plots ask of every run that has it.
std::vector<std::pair<std::string, int>> JobRunner::signals_of(const RunWish& run, const Diagram& diagram,
                                                               const Program& program) {
  std::vector<std::pair<std::string, int>> list;
  const auto add = [&](const std::string& name, int signal) {
    const bool known = std::any_of(list.begin(), list.end(), [&](const auto& one) { return one.first == name; });
    if (!known && signal >= 0 && name != "t") list.emplace_back(name, signal);
  };
  for (std::size_t i = 0; i < program.output_names.size(); ++i) add(program.output_names[i], program.output_signals[i]);
  for (const int s : program.record_signals) add(program.signals[static_cast<std::size_t>(s)].path, s);
  for (const auto& name : wanted(run))
    if (name.text != "t") at(name.pointer, [&] { add(name.text, named_signal(program, diagram, name.text)); });
  for (const auto& p : job_.plots)
    if (p.runs.empty())
      for (const auto* axis : {&p.x, &p.y})
        for (const auto& s : axis->signals) {
          add(s.signal.text, find_named_signal(program, diagram, s.signal.text));
          if (s.minus && !s.minus_run) add(s.minus->text, find_named_signal(program, diagram, s.minus->text));
        }
  return list;
}

SimulateOptions JobRunner::options_of(const RunWish& run, const Program& program) const {
  const std::string& pointer = run.pointer;
  SimulateOptions options = simulate_options(program);
  if (!run.until && !program.simulate.until)
    fail("no_end_time", pointer, "nothing says until when to simulate",
         "write \"until\": \"1 s\" here or in the diagram");
  if (run.until) options.until = seconds(*run.until);
  if (run.every) options.every = seconds(*run.every);
  if ((run.every && !(options.every > 0)) || !(options.until > 0) ||
      (options.every > 0 && options.until / options.every > most_rows))
    fail("bad_value", run.every ? run.every->pointer : pointer,
         fmt::format("{} s, every {} s, cannot be simulated", options.until, options.every),
         "give times above 0 s, and not more than twenty million rows");
  if (!program.input_names.empty())
    fail("unbound_input", pointer,
         fmt::format("the diagram takes its {} from outside, and nothing drives it", program.input_names.front()),
         "put a source block (sine, step ...) in its place, or name a diagram that has one");
  return options;
}

Run JobRunner::with_settings(const RunWish& run, const Program& program) {
  Run start_of = start(program);
  for (const auto& use : run.use) {
    const RunResult& from = at(use.run.pointer, [&]() -> const RunResult& { return result(use.run); });
    at(use.run.pointer, [&] {
      for (const auto& [path, q] : from.numbers)
        if (path != "cost" && path != "rms")
          put(program, start_of, use.prefix.empty() ? path : use.prefix + "." + last_name(path), q.si);
    });
  }
  for (const auto& set : run.set_of)
    at(set.path.pointer, [&] { put(program, start_of, set.path.text, set.times * value(set.value).si); });
  return start_of;
}

/// A run at its start.
Run JobRunner::started(const RunWish& run, const Program& program) {
  Run start_of = with_settings(run, program);
  prepare(program, start_of);
  reset(program, start_of);
  return start_of;
}

/// The diagram of a run with its settings, compiled. Problems of the settings belong to the job, others to the diagram.
std::pair<Diagram, ProgramPointer> JobRunner::program_of(const RunWish& run) const {
  Diagram diagram = read_diagram(run.file, pool_->allowed());
  apply_settings(diagram, run.set, run.choose);
  ProgramPointer program = compile_file(diagram);
  return {std::move(diagram), std::move(program)};
}

RunResult JobRunner::simulated(const RunWish& run) {
  const auto [diagram, program] = program_of(run);
  const SimulateOptions options = options_of(run, *program);
  Run start_of = started(run, *program);
  const auto asked = signals_of(run, diagram, *program);
  if (asked.empty())
    fail("nothing_recorded", run.pointer, "no plot and no value asks for a signal of this run",
         "name one, or take the run out");
  return traced(*program, std::move(start_of), options, asked);
}

RunResult JobRunner::traced(const Program& program, Run start_of, SimulateOptions options,
                            const std::vector<std::pair<std::string, int>>& asked) const {
  for (const auto& [name, signal] : asked)
    if (std::find(options.signals.begin(), options.signals.end(), signal) == options.signals.end())
      options.signals.push_back(signal);
  const Traces traces = simulate(program, std::move(start_of), options);
  RunResult r;
  r.columns.push_back({"t", "t", parse_unit("s"), traces.t});
  for (const auto& [name, signal] : asked) {
    const auto place = std::find(options.signals.begin(), options.signals.end(), signal) - options.signals.begin();
    const auto& info = program.signals[static_cast<std::size_t>(signal)];
    r.columns.push_back({name, info.path, info.unit, traces.values[static_cast<std::size_t>(place)]});
  }
  return r;
}

RunResult JobRunner::table(const RunWish& run) const {
  const CsvTable csv = read_table(run.file);
  RunResult r;
  for (const auto& column : csv.columns) {
    RunColumn c{column.name, column.name, column.unit, column.values};
    for (auto& v : c.values) v = column.unit.to_si(v);
    r.columns.push_back(std::move(c));
  }
  return r;
}

/// Secant steps that keep the sign change between them (Illinois), until the aim is met to a relative 1e-12 or the
/// parameter no longer changes.
RunResult JobRunner::sought(const RunWish& run) {
  const auto [diagram, compiled] = program_of(run);
  const ProgramPointer& program = compiled;
  const int place = at(run.parameter.pointer, [&] { return named_parameter(*program, run.parameter.text); });
  const ParameterInfo& info = program->parameters[static_cast<std::size_t>(place)];
  const Unit unit = parameter_unit(*program, info);
  double low = si(run.range[0], unit), high = si(run.range[1], unit), goal_size = 0;
  RunWish trial = run;
  trial.kind = RunKind::simulate;
  Unit aim_unit;
  const auto miss = [&](double x) {
    trial.set.push_back({run.parameter.text, fmt::format("{:.17g} {}", unit.from_si(x), unit.text)});
    const Quantity reached = take(run.aim, simulated(trial));
    trial.set.pop_back();
    aim_unit = reached.unit;
    const double goal = si(run.equals, reached.difference ? without_offset(reached.unit) : reached.unit);
    goal_size = std::max(std::abs(goal), std::abs(reached.si));
    return reached.si - goal;
  };
  double f_low = miss(low), f_high = miss(high);
  const double scale = std::max({std::abs(f_low), std::abs(f_high), goal_size});
  if ((f_low > 0) == (f_high > 0) && f_low != 0 && f_high != 0)
    fail_numerics("not_bracketed", run.range[0].pointer,
                  fmt::format("at both ends of the range the value lies on the same side ({:.4g} and {:.4g} {} off)",
                              aim_unit.difference_from_si(f_low), aim_unit.difference_from_si(f_high), aim_unit.text),
                  "give a wider range");
  double x = std::abs(f_low) < std::abs(f_high) ? low : high;
  for (int i = 0; i < 60 && f_low != f_high; ++i) {
    x = high - f_high * (high - low) / (f_high - f_low);
    const double f = miss(x);
    if (std::abs(f) <= 1e-12 * scale || x == low || x == high) break;
    if ((f > 0) != (f_high > 0)) {
      low = high;
      f_low = f_high;
    } else {
      f_low /= 2;
    }
    if (std::abs(x - high) <= 1e-13 * std::abs(x)) break;
    high = x;
    f_high = f;
  }
  RunResult r;
  r.numbers.emplace_back(run.parameter.text, Quantity{x, unit, info.difference});
  return r;
}

}  // namespace hysteron
