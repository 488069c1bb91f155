// The exact advance, row by row.
//
// Blocks fall into sources (recorded inputs, what a dead time makes of one, constants), sampled blocks (sources that
// jump at their instants), linear blocks, and nonlinear ones (static blocks, memory, dead time, states of their own).
// The nonlinear depth of a block is the largest number of nonlinear blocks on a path to it. Linear blocks of one depth
// that are wired together are one linear system (LinearPart): between them no nonlinear block can stand, so cascades
// and loops of linear blocks, algebraic ones too, are exact. A row is one pass over the depths: the linear systems step
// with their inputs moving linearly, then the nonlinear blocks of that depth follow, their states by the Runge-Kutta
// formula of order four (rows.h). Feedback loops with nonlinear blocks move as a whole, by the same formula along the
// program's own steps, what decays in a mode taken exactly, cut where one of them changes its mode, and count as one
// nonlinear block. A signal behind a
// nonlinear block is taken as linear between substeps, which, with that formula, is the only approximation; the caller
// doubles the substeps until nothing changes. What stands still between the instants of sampled blocks stands still
// behind a nonlinear block, too: no substeps.
//
// At a point (a row, a sampling instant, an echo of one behind a dead time), in the order of events.h: step up to it;
// sources jump; sampled blocks that are due run (sampling.h); their jumps reach everything behind them at once, and
// rate-independent states follow them as paths (path.h).
//
// Runs without sampled blocks see nothing but rows: there every block passes many rows before the next one does
// (advance_rows.h).
#include "engine/rowwise/advance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/diagram/index.h"
#include "engine/diagram/stop.h"
#include "engine/events/sampling.h"
#include "engine/program/breakpoints.h"
#include "engine/rowwise/advance_graph.h"
#include "engine/rowwise/advance_plan.h"
#include "engine/rowwise/advance_points.h"
#include "engine/rowwise/advance_rows.h"
#include "engine/rowwise/advance_state.h"
#include "engine/rowwise/schedule.h"

namespace hysteron {
namespace {

// Runge-Kutta steps along a jump, per substep of a row: a jump may be as long as many rows.
constexpr int path_steps = 4;

/// Zero times a number is zero but for those that are none; eight sums side by side.
bool all_finite(const std::vector<double>& values) {
  std::array<double, 8> sum{};
  const std::size_t whole = values.size() - values.size() % sum.size();
  for (std::size_t i = 0; i < whole; i += sum.size())
    for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += 0.0 * values[i + j];
  for (std::size_t i = whole; i < values.size(); ++i) sum[0] += 0.0 * values[i];
  return std::all_of(sum.begin(), sum.end(), [](double s) { return s == 0; });
}

bool are_linear_alike(const Program& program, std::span<const Run* const> runs) {
  const auto first = linear_at(program, *runs.front());
  return std::all_of(runs.begin() + 1, runs.end(), [&](const Run* r) { return linear_at(program, *r) == first; });
}

template <class Work>
std::string text_of_failure(const Work& work) {
  try {
    work();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

}  // namespace

std::string why_not_exact(const Program& program) { return advance_graph(program).why_not; }

struct Advance::Content {
  using Values = std::vector<std::vector<double>>;

  AdvancePlan plan;
  AdvanceState state;
  AdvanceRows rows;
  Sampling sampling;
  std::optional<Schedule> schedule;
  struct Late {
    SeriesPointer of{};
    double by = 0, start = 0;  ///< [s]
    SeriesPointer made{};
  };
  std::vector<Late> late;  ///< per place in AdvancePlan::series
  // Made when several runs come at once.
  std::vector<std::unique_ptr<AdvanceState>> beside;
  std::optional<AdvanceRows> wide;

  Content(ProgramPointer program, std::vector<int> signals, const std::vector<bool>& linear_too = {})
      : plan(std::move(program), std::move(signals), linear_too), state(plan), rows(plan, 1), sampling(*plan.program) {}

  /// The sources of a run that starts then; what came as late in the last one is the same.
  std::vector<SeriesPointer> series_of(const Run& run, double start) {
    std::vector<SeriesPointer> list;
    late.resize(plan.series.size());
    for (std::size_t s = 0; s < plan.series.size(); ++s) {
      const int b = plan.series[s];
      const SeriesPointer& recorded = plan.recording(run, b);
      if (plan.graph.late_of[at(b)] < 0) {
        list.push_back(recorded);
        continue;
      }
      const double by = plan.lateness(run, b);
      Late& known = late[s];
      if (known.of != recorded || known.by != by || known.start != start)
        known = {recorded, by, start, later(*recorded, by, start)};
      list.push_back(known.made);
    }
    return list;
  }

  void check_bound(const Run& run) const {
    for (const auto& series : run.series)
      if (!series)
        fail("unbound_input", "/inputs", "an input of the diagram is bound to no recording",
             "bind every input before the run");
  }

  void check_finite(const Values& values, std::span<const double> instants) const {
    for (std::size_t s = 0; s < values.size(); ++s) {
      if (all_finite(values[s])) continue;
      const auto bad = std::find_if(values[s].begin(), values[s].end(), [](double v) { return !std::isfinite(v); });
      const auto& path = plan.program->signals[at(plan.signals[s])].path;
      fail_numerics("diverged", path,
                    fmt::format("signal \"{}\" is not finite at t = {} s", path,
                                instants[static_cast<std::size_t>(bad - values[s].begin())]),
                    "check the parameters: a pole in the right half plane grows without bound");
    }
  }

  void keep_schedule(const Run& run, const Instants& instants) {
    auto series = series_of(run, instants->front());
    if (!schedule || !schedule->is_for(instants, series)) schedule.emplace(instants, std::move(series));
  }

  void start_rows(AdvanceState& s, const Run& run, const AdvanceOptions& options) {
    s.take(run, schedule->series, path_steps * std::max(1, options.substeps));
    s.start({}, schedule->t.front(), schedule->start_branch, options.at_rest, sampling);
  }

  void advance_rows(const Run& run, const Instants& instants, const AdvanceOptions& options, Values& values) {
    keep_schedule(run, instants);
    const int substeps = std::max(1, options.substeps);
    start_rows(state, run, options);
    AdvanceState* const states[] = {&state};
    Values* const lanes[] = {&values};
    rows(states, *schedule, substeps, lanes);
  }

  void size(Values& values, const Instants& instants) const {
    values.resize(plan.signals.size());
    for (auto& v : values) v.resize(instants->size());
  }

  void one(const Run& run, const Instants& instants, const AdvanceOptions& options, Values& values) {
    size(values, instants);
    if (instants->empty()) return;
    check_bound(run);
    if (plan.is_plain(run))
      advance_rows(run, instants, options, values);
    else
      advance_points(run, *instants, options, values);
    check_finite(values, *instants);
  }

  bool can_go_side_by_side(std::span<const Run* const> runs) const;
  void side_by_side(std::span<const Run* const> runs, const Instants& instants, const AdvanceOptions& options,
                    std::span<Values> values, std::span<std::string> errors);

  void advance_points(const Run& start, std::span<const double> instants, const AdvanceOptions& options,
                      Values& values);
};

void Advance::Content::advance_points(const Run& start, std::span<const double> instants, const AdvanceOptions& options,
                                      Values& values) {
  const int substeps = std::max(1, options.substeps);
  const auto series = series_of(start, instants.front());
  state.take(start, series, path_steps * substeps);
  Run& run = state.run;
  const bool jumps = plan.sources_jump(run);
  Points points(*plan.program, run, rows_between(instants, series), plan.delays_of(run));
  std::optional<Breakpoints> breakpoints;
  if (plan.has_breakpoints()) breakpoints.emplace(*plan.program, run, instants.front());
  std::size_t next = 0;
  const auto due = [&](double t) { return next < instants.size() && instants[next] <= t; };
  const auto record = [&](double t) {
    for (; due(t); ++next)
      for (std::size_t s = 0; s < plan.signals.size(); ++s) values[s][next] = state.y[at(plan.signals[s])];
  };
  // A time behind t that is inside the next piece of every source.
  const auto branch_behind = [&](double t, double step) {
    double until = points.next();
    if (points.at_end()) until = std::min(until, next_sample(series, t + same_row * step));
    if (breakpoints) {
      breakpoints->pass(t);
      until = std::min(until, breakpoints->next());
    }
    return std::isfinite(until) ? 0.5 * (t + until) : t + 0.5 * step;
  };
  double t = instants.front();
  points.start(run);
  state.start(points.due(), t, branch_behind(t, 0), options.at_rest, sampling);
  record(t);
  LookUp look_up;
  while (!points.at_end()) {
    look_up();
    const double before = t;
    t = points.advance(before, run);
    const double h = t - before, branch = before + 0.5 * h;
    for (int i = 1; i <= substeps; ++i) state.step(i == substeps ? t : before + h * i / substeps, h / substeps, branch);
    const double behind = branch_behind(t, h);
    if (jumps || points.is_delayed()) state.jump(t, behind);
    const double reached = t + same_row * h;
    const bool instant = !points.due().empty();
    if (!plan.momentary.empty() && (instant || due(reached))) {
      state.at_time(t, behind);
      for (const int b : plan.momentary) state.evaluate(b);
    }
    if (instant) {
      state.hit(points.due(), t, sampling);
      for (const int b : plan.momentary_behind) state.evaluate(b);
    }
    record(reached);
  }
}

bool Advance::Content::can_go_side_by_side(std::span<const Run* const> runs) const {
  const Run& first = *runs.front();
  const auto bound = [](const SeriesPointer& s) { return s != nullptr; };
  return std::all_of(first.series.begin(), first.series.end(), bound) && plan.is_plain(first) &&
         std::all_of(runs.begin(), runs.end(), [&](const Run* run) {
           return run->series == first.series && std::all_of(plan.series.begin(), plan.series.end(), [&](int b) {
                    return plan.lateness(*run, b) == plan.lateness(first, b);
                  });
         });
}

/// As many runs as there are lanes, or fewer: the lanes that are left carry the numbers of the first.
void Advance::Content::side_by_side(std::span<const Run* const> runs, const Instants& instants,
                                    const AdvanceOptions& options, std::span<Values> values,
                                    std::span<std::string> errors) {
  if (!wide) {
    wide.emplace(plan, RowsView::most_lanes);
    for (int l = 1; l < RowsView::most_lanes; ++l) beside.push_back(std::make_unique<AdvanceState>(plan));
  }
  keep_schedule(*runs.front(), instants);
  std::array<AdvanceState*, RowsView::most_lanes> states{};
  std::array<Values*, RowsView::most_lanes> lanes{};
  std::array<std::size_t, RowsView::most_lanes> run_of{};
  std::size_t n = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    states[n] = n == 0 ? &state : beside[n - 1].get();
    lanes[n] = &values[i];
    run_of[n] = i;
    size(values[i], instants);
    errors[i] = text_of_failure([&] {
      start_rows(*states[n], *runs[i], options);
      ++n;
    });
  }
  if (n == 0) return;
  (*wide)(std::span(states).first(n), *schedule, std::max(1, options.substeps), std::span(lanes).first(n));
  for (std::size_t l = 0; l < n; ++l) errors[run_of[l]] = text_of_failure([&] { check_finite(*lanes[l], *instants); });
}

Advance::Advance(ProgramPointer program, std::vector<int> signals)
    : content_(std::make_unique<Content>(std::move(program), std::move(signals))), last_(content_.get()) {}
Advance::~Advance() = default;
Advance::Advance(Advance&&) noexcept = default;
Advance& Advance::operator=(Advance&&) noexcept = default;

bool Advance::exact_without_substeps() const { return content_->plan.no_substeps_needed; }
bool Advance::integrates() const { return last_->plan.integrates; }
bool Advance::passes_rows(const Run& run) const { return content_->plan.is_plain(run); }
long Advance::samples() const { return last_->state.hits; }

/// The plan for the numbers of this run.
Advance::Content& Advance::content_of(const Run& run) {
  auto linear = linear_at(*content_->plan.program, run);
  Content* of = content_.get();
  if (!linear.empty()) {
    if (!with_linear_ || linear != linear_) {
      with_linear_ = std::make_unique<Content>(content_->plan.program, content_->plan.signals, linear);
      linear_ = std::move(linear);
    }
    of = with_linear_.get();
  }
  last_ = of;
  return *of;
}

void Advance::operator()(const Run& run, const Instants& instants, const AdvanceOptions& options,
                         std::vector<std::vector<double>>& values) {
  content_of(run).one(run, instants, options, values);
}

void Advance::operator()(const Run& run, std::span<const double> instants, const AdvanceOptions& options,
                         std::vector<std::vector<double>>& values) {
  const auto& known = content_of(run).schedule;
  const bool same =
      known && std::equal(instants.begin(), instants.end(), known->instants->begin(), known->instants->end());
  (*this)(run, same ? known->instants : std::make_shared<const std::vector<double>>(instants.begin(), instants.end()),
          options, values);
}

std::vector<std::string> Advance::each(std::span<const Run* const> runs, const Instants& instants,
                                       const AdvanceOptions& options,
                                       std::vector<std::vector<std::vector<double>>>& values) {
  constexpr std::size_t lanes = RowsView::most_lanes;
  values.resize(runs.size());
  std::vector<std::string> errors(runs.size());
  for (std::size_t first = 0; first < runs.size();) {
    const std::size_t n = std::min(lanes, runs.size() - first);
    const auto some = runs.subspan(first, n);
    Content& c = content_of(*some.front());
    // Two runs take less time one after the other than four lanes.
    if (n + 1 >= lanes && !instants->empty() && c.can_go_side_by_side(some) &&
        are_linear_alike(*content_->plan.program, some))
      c.side_by_side(some, instants, options, std::span(values).subspan(first, n), std::span(errors).subspan(first, n));
    else
      for (std::size_t i = first; i < first + n; ++i)
        errors[i] = text_of_failure([&] { (*this)(*runs[i], instants, options, values[i]); });
    first += n;
  }
  return errors;
}

}  // namespace hysteron
