// The exact advance, row by row.
//
// Blocks fall into sources (recorded inputs, constants), sampled blocks (sources that jump at their instants), linear
// blocks, and nonlinear ones without states (static blocks, memory, dead time). The nonlinear depth of a block is the
// largest number of nonlinear blocks on a path to it. Linear blocks of one depth that are wired together are one linear
// system (LinearPart): between them no nonlinear block can stand, so cascades and loops of linear blocks, algebraic
// ones too, are exact. A row is one pass over the depths: the linear systems step with their inputs moving linearly,
// then the nonlinear blocks of that depth follow. A signal behind a nonlinear block is taken as linear between
// substeps, which is the only approximation; the caller doubles the substeps until nothing changes. What stands still
// between the instants of sampled blocks stands still behind a nonlinear block, too: no substeps.
//
// At a point (a row, a sampling instant, an echo of one behind a dead time), in the order of events.h: step up to it;
// sources jump; sampled blocks that are due run (sampling.h); their jumps reach everything behind them at once.
#include "engine/advance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "engine/advance_graph.h"
#include "engine/advance_points.h"
#include "engine/corners.h"
#include "engine/linear_part.h"
#include "engine/path.h"
#include "engine/sampling.h"
#include "engine/steps.h"

namespace hysteron {

using steps::at;

std::string why_not_exact(const Program& program) { return advance_graph(program).why_not; }

struct Advance::Plan {
  struct Level {
    std::vector<LinearPart> linear;
    std::vector<int> nonlinear;  ///< in value order
    // Those that a jump of sampled blocks reaches at once.
    std::vector<int> linear_behind, nonlinear_behind;
  };

  ProgramPointer program;
  std::vector<int> signals;
  AdvanceGraph graph;
  std::vector<int> series, constants;            ///< sources
  std::vector<int> delays;                       ///< dead times that hand jumps of sampled blocks on
  std::vector<int> momentary, momentary_behind;  ///< in value order; those that read what sampled blocks hold
  std::vector<int> series_signals, sampled_signals;
  std::vector<Level> levels;
  bool no_substeps_needed = true;
  bool series_turn = false, sampled_turn = false;  ///< their jumps turn in front of memory: path.h
  bool needs_states = false;                       ///< sampling evaluates blocks with states
  long hits = 0;
  // Scratch of a run.
  Work work;
  std::vector<double>& y;
  std::vector<double> x, from, to;
  std::vector<bool> needed, curved, moves;

  Plan(ProgramPointer p, std::vector<int> wanted)
      : program(std::move(p)), signals(std::move(wanted)), graph(advance_graph(*program)), work(*program), y(work.y) {
    if (!graph.why_not.empty())
      fail("not_exact", graph.why_not, "this diagram cannot be advanced row by row exactly", "use the method \"bdf\"");
    find_needed();
    build_levels();
    find_curved();
    find_behind();
    x.resize(at(program->n_x));
  }

  const BlockInstance& block(int b) const { return program->blocks[at(b)]; }
  int block_of(int signal) const { return program->signals[at(signal)].block; }
  AdvanceRole role(int b) const { return graph.role[at(b)]; }

  void find_needed() {
    needed.assign(program->blocks.size(), false);
    std::vector<int> todo = program->sampled_blocks;
    for (const int s : signals) todo.push_back(block_of(s));
    while (!todo.empty()) {
      const int b = todo.back();
      todo.pop_back();
      if (needed[at(b)]) continue;
      needed[at(b)] = true;
      for (const int s : block(b).source) todo.push_back(block_of(s));
    }
  }

  std::vector<int> blocks_in_value_order() const {
    std::vector<int> order;
    for (const int b : program->value_order)
      if (needed[at(b)]) order.push_back(b);
    return order;
  }

  void build_levels() {
    const auto order = blocks_in_value_order();
    int deepest = 0;
    for (const int b : order) deepest = std::max(deepest, graph.depth[at(b)]);
    levels.resize(at(deepest) + 1);
    const auto add_signals = [&](int b, std::vector<int>& list) {
      for (int o = 0; o < block(b).sizes.outputs; ++o) list.push_back(block(b).y_begin + o);
    };
    const auto turns = turns_before_memory(*program);
    for (const int b : order) {
      switch (role(b)) {
        case AdvanceRole::source:
          (block(b).series_index >= 0 ? series : constants).push_back(b);
          if (block(b).series_index < 0) break;
          add_signals(b, series_signals);
          series_turn = series_turn || turns[at(b)];
          break;
        case AdvanceRole::sampled:
          add_signals(b, sampled_signals);
          sampled_turn = sampled_turn || turns[at(b)];
          break;
        case AdvanceRole::nonlinear:
          levels[at(graph.depth[at(b)])].nonlinear.push_back(b);
          if (!graph.echoes[at(b)]) break;
          delays.push_back(b);
          add_signals(b, series_signals);
          series_turn = series_turn || turns[at(b)];
          break;
        case AdvanceRole::momentary:
          momentary.push_back(b);
          break;
        case AdvanceRole::linear:
          break;
      }
    }
    for (int d = 0; d <= deepest; ++d) group_linear(d, order);
  }

  /// Linear blocks of one depth that are wired together become one part.
  void group_linear(int d, const std::vector<int>& order) {
    std::vector<int> parent(program->blocks.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int b) {
      while (parent[at(b)] != b) b = parent[at(b)];
      return b;
    };
    const auto here = [&](int b) { return needed[at(b)] && role(b) == AdvanceRole::linear && graph.depth[at(b)] == d; };
    for (const int b : order)
      if (here(b))
        for (const int s : block(b).source)
          if (here(block_of(s))) parent[at(root(b))] = root(block_of(s));
    std::vector<int> roots;
    for (const int b : order)
      if (here(b) && std::find(roots.begin(), roots.end(), root(b)) == roots.end()) roots.push_back(root(b));
    for (const int r : roots) {
      std::vector<int> members;
      for (const int b : order)
        if (here(b) && root(b) == r) members.push_back(b);
      levels[at(d)].linear.emplace_back(*program, members, outside_readers(members));
    }
  }

  std::vector<int> outside_readers(const std::vector<int>& members) const {
    std::vector<int> outputs;
    const auto inside = [&](int b) { return std::find(members.begin(), members.end(), b) != members.end(); };
    const auto add = [&](int s) {
      if (inside(block_of(s)) && std::find(outputs.begin(), outputs.end(), s) == outputs.end()) outputs.push_back(s);
    };
    for (const int s : signals) add(s);
    for (const int s : graph.hit_signals) add(s);
    for (std::size_t b = 0; b < program->blocks.size(); ++b)
      if (needed[b] && !inside(static_cast<int>(b)))
        for (const int s : program->blocks[b].source) add(s);
    return outputs;
  }

  bool any_source(int b, const std::vector<bool>& marked) const {
    return std::any_of(block(b).source.begin(), block(b).source.end(), [&](int s) { return marked[at(s)]; });
  }
  void mark(int b, std::vector<bool>& marked, bool value) const {
    for (int o = 0; o < block(b).sizes.outputs; ++o) marked[at(block(b).y_begin + o)] = value;
  }

  /// A signal moves between points if a recorded input or a state stands before it; it is curved there if a state or a
  /// delay does. Substeps matter where a curved or kinked signal drives states, or a curved one drives memory (an
  /// extreme inside a row).
  void find_curved() {
    curved.assign(program->signals.size(), false);
    moves = curved;
    std::vector<bool> kinked = curved;
    for (const int b : series) mark(b, moves, true);
    for (const auto& level : levels) {
      for (const auto& part : level.linear)
        if (part.has_states())
          for (const int s : part.input_signals())
            if (curved[at(s)] || kinked[at(s)]) no_substeps_needed = false;
      mark_linear(static_cast<int>(&level - levels.data()), kinked);
      for (const int b : level.nonlinear) {
        const bool any_curved = any_source(b, curved);
        if (any_curved && (block(b).sizes.memory > 0 || block(b).history_index >= 0)) no_substeps_needed = false;
        const bool any_moves = any_source(b, moves);
        mark(b, moves, any_moves);
        mark(b, kinked, any_moves);
        mark(b, curved, any_curved);
      }
    }
  }

  void mark_linear(int d, std::vector<bool>& kinked) {
    for (const int b : blocks_in_value_order()) {
      if (role(b) != AdvanceRole::linear || graph.depth[at(b)] != d) continue;
      const bool has_states = block(b).sizes.states > 0;
      mark(b, curved, has_states || any_source(b, curved));
      mark(b, moves, has_states || any_source(b, moves));
      mark(b, kinked, any_source(b, kinked));
    }
  }

  void find_behind() {
    for (auto& level : levels) {
      for (std::size_t i = 0; i < level.linear.size(); ++i) {
        const auto& inputs = level.linear[i].input_signals();
        if (std::any_of(inputs.begin(), inputs.end(), [&](int s) { return graph.jumps[at(s)]; }))
          level.linear_behind.push_back(static_cast<int>(i));
      }
      for (const int b : level.nonlinear)
        if (any_source(b, graph.jumps)) level.nonlinear_behind.push_back(b);
    }
    for (const int b : momentary)
      if (any_source(b, graph.jumps)) momentary_behind.push_back(b);
    for (const Step& step : graph.hit_steps) {
      if (step.order == Order::loop)
        for (const int b : program->loops[at(step.block)].blocks) needs_states |= block(b).sizes.states > 0;
      else
        needs_states |= block(step.block).sizes.states > 0;
    }
  }

  // --- a run --------------------------------------------------------------------------------------------------------

  /// What depends on the time, before anything is evaluated there.
  void at_time(Run& run, double t, double branch) {
    run.branch = branch;
    steps::begin(*program, run, work, t);
    for (const int b : series) y[at(block(b).y_begin)] = run.series[at(block(b).series_index)]->value(t, branch);
  }

  void evaluate(int b) { steps::value(*program, work, b, x.data()); }

  /// Nonlinear blocks follow their inputs; memory is committed at once: every point of the advance is an accepted one.
  void follow(Run& run, int b, double t) {
    const BlockInstance& n = block(b);
    if (n.history_index >= 0) {
      History& h = run.histories[at(n.history_index)];
      const double u = y[at(n.source.front())];
      if (h.t.empty()) h.before = u;
      h.t.push_back(t);
      h.u.push_back(u);
      h.rate.push_back(std::numeric_limits<double>::quiet_NaN());
      if (n.kernel->reach_back) steps::forget(h, t, n.kernel->reach_back(work.views[at(b)]));
    }
    evaluate(b);
    if (n.sizes.memory > 0) std::copy_n(work.m.begin() + n.m_begin, n.sizes.memory, run.m.begin() + n.m_begin);
  }

  /// Before the first instant: a dead time has its input always been, and nothing is remembered yet.
  void foresee(int b) {
    if (block(b).history_index >= 0)
      y[at(block(b).y_begin)] = y[at(block(b).source.front())];
    else
      evaluate(b);
  }

  void start(Run& run, const Points& points, double t, double branch, bool at_rest, Sampling& sampling) {
    at_time(run, t, branch);
    for (const int b : constants) evaluate(b);
    for (const int b : program->sampled_blocks) evaluate(b);  // what they hold
    const bool instant = !points.due().empty();
    for (auto& level : levels) {
      for (auto& part : level.linear) {
        part.bind(*program, run);
        part.start(*program, run, y, at_rest);
      }
      for (const int b : level.nonlinear) instant ? foresee(b) : follow(run, b, t);
    }
    for (const int b : momentary) evaluate(b);
    if (!instant) return;
    sample(run, points, t, sampling);
    for (auto& level : levels) {
      for (auto& part : level.linear) part.refresh(y);
      for (const int b : level.nonlinear) follow(run, b, t);
    }
    for (const int b : momentary_behind) evaluate(b);
  }

  void sample(Run& run, const Points& points, double t, Sampling& sampling) {
    if (needs_states)
      for (const auto& level : levels)
        for (const auto& part : level.linear) part.store(*program, x);
    hits += static_cast<long>(points.due().size());
    sampling(run, work, t, x.data(), points.due(), graph.hit_steps);
    for (const int b : program->sampled_blocks) evaluate(b);
  }

  void step(Run& run, double t, double h, double branch) {
    at_time(run, t, branch);
    const double rounding = rounding_of(t);
    for (auto& level : levels) {
      for (auto& part : level.linear) part.step(h, rounding, y);
      for (const int b : level.nonlinear) follow(run, b, t);
    }
  }

  /// Everything behind sources that have jumped; with_delays: dead times, too, whose own outputs may have jumped.
  void pass_on(Run& run, double t, bool with_delays) {
    for (auto& level : levels) {
      for (auto& part : level.linear) part.refresh(y);
      for (const int b : level.nonlinear)
        if (with_delays || block(b).history_index < 0) follow(run, b, t);
    }
  }
  void pass_on_samples(Run& run, double t, bool with_delays) {
    for (auto& level : levels) {
      for (const int i : level.linear_behind) level.linear[at(i)].refresh(y);
      for (const int b : level.nonlinear_behind)
        if (with_delays || block(b).history_index < 0) follow(run, b, t);
    }
  }

  /// Memory behind a bend follows the jump of `jumping` from `from` to their present values in pieces, but for the
  /// last.
  template <class PassOn>
  void walk(const std::vector<int>& jumping, PassOn pass) {
    to.clear();
    bool any = false;
    for (std::size_t i = 0; i < jumping.size(); ++i) {
      to.push_back(y[at(jumping[i])]);
      any = any || to[i] != from[i];
    }
    if (!any) return;
    for (int k = 1; k < jump_pieces; ++k) {
      for (std::size_t i = 0; i < jumping.size(); ++i)
        y[at(jumping[i])] = from[i] + (to[i] - from[i]) * k / jump_pieces;
      pass();
    }
    for (std::size_t i = 0; i < jumping.size(); ++i) y[at(jumping[i])] = to[i];
  }
  void remember_from(const std::vector<int>& jumping) {
    from.clear();
    for (const int s : jumping) from.push_back(y[at(s)]);
  }

  void jump(Run& run, double t, double branch) {
    if (series_turn) remember_from(series_signals);
    at_time(run, t, branch);
    if (series_turn) {
      for (const int b : delays) evaluate(b);
      walk(series_signals, [&] { pass_on(run, t, false); });
    }
    pass_on(run, t, true);
  }

  void hit(Run& run, const Points& points, double t, Sampling& sampling) {
    if (sampled_turn) remember_from(sampled_signals);
    sample(run, points, t, sampling);
    if (sampled_turn) walk(sampled_signals, [&] { pass_on_samples(run, t, false); });
    pass_on_samples(run, t, true);
  }

  bool sources_jump(const Run& run) const {
    return std::any_of(series.begin(), series.end(),
                       [&](int b) { return run.series[at(block(b).series_index)]->between == Between::hold; });
  }

  std::vector<double> delays_of(const Run& run) const {
    std::vector<double> list;
    for (const int b : delays)
      if (block(b).kernel->reach_back) list.push_back(block(b).kernel->reach_back(view_of(*program, run, b)));
    return list;
  }

  /// Functions of time with corners of their own.
  bool has_corners() const {
    return std::any_of(momentary.begin(), momentary.end(), [&](int b) { return block(b).kernel->next_corner; });
  }

  void check_finite(const std::vector<std::vector<double>>& values, std::span<const double> instants) const {
    for (std::size_t s = 0; s < values.size(); ++s)
      for (std::size_t i = 0; i < values[s].size(); ++i)
        if (!std::isfinite(values[s][i]))
          fail_numerics("diverged", program->signals[at(signals[s])].path,
                        fmt::format("signal \"{}\" is not finite at t = {} s", program->signals[at(signals[s])].path,
                                    instants[i]),
                        "check the parameters: a pole in the right half plane grows without bound");
  }

  /// Instants and the samples of all inputs between them, in order.
  std::vector<double> grid(const Run& run, std::span<const double> instants) const {
    std::vector<double> times(instants.begin(), instants.end());
    const double begin = instants.front();
    const double end = instants.back();
    for (const int b : series) {
      const auto& t = run.series[at(block(b).series_index)]->t;
      const auto first = std::upper_bound(t.begin(), t.end(), begin);
      const auto last = std::lower_bound(t.begin(), t.end(), end);
      if (first >= last) continue;
      std::vector<double> merged;
      merged.reserve(times.size() + static_cast<std::size_t>(last - first));
      std::set_union(times.begin(), times.end(), first, last, std::back_inserter(merged));
      times = std::move(merged);
    }
    return times;
  }
};

Advance::Advance(ProgramPointer program, std::vector<int> signals)
    : plan_(std::make_unique<Plan>(std::move(program), std::move(signals))) {}
Advance::~Advance() = default;
Advance::Advance(Advance&&) noexcept = default;
Advance& Advance::operator=(Advance&&) noexcept = default;

bool Advance::exact_without_substeps() const { return plan_->no_substeps_needed; }
long Advance::samples() const { return plan_->hits; }

void Advance::operator()(const Run& start_run, std::span<const double> instants, const AdvanceOptions& options,
                         std::vector<std::vector<double>>& values) {
  Plan& plan = *plan_;
  values.resize(plan.signals.size());
  for (auto& v : values) v.resize(instants.size());
  if (instants.empty()) return;
  for (std::size_t i = 0; i < start_run.series.size(); ++i)
    if (!start_run.series[i])
      fail("unbound_input", "/inputs", "an input of the diagram is bound to no recording",
           "bind every input before the run");
  Run run = start_run;
  const bool jumps = plan.sources_jump(run);
  Points points(*plan.program, run, plan.grid(run, instants), plan.delays_of(run));
  Sampling sampling(*plan.program);
  plan.hits = 0;
  std::optional<Corners> corners;
  if (plan.has_corners()) corners.emplace(*plan.program, run, instants.front());
  std::size_t next = 0;
  const auto due = [&](double t) { return next < instants.size() && instants[next] <= t; };
  const auto record = [&](double t) {
    for (; due(t); ++next)
      for (std::size_t s = 0; s < plan.signals.size(); ++s) values[s][next] = plan.y[at(plan.signals[s])];
  };
  // A time behind t that is inside the next piece of every source.
  const auto branch_behind = [&](double t, double otherwise) {
    double until = points.next();
    if (corners) {
      corners->pass(t);
      until = std::min(until, corners->next());
    }
    return std::isfinite(until) ? 0.5 * (t + until) : t + otherwise;
  };
  double t = instants.front();
  points.start(run);
  plan.start(run, points, t, branch_behind(t, 0), options.at_rest, sampling);
  record(t);
  const int substeps = std::max(1, options.substeps);
  while (!points.at_end()) {
    const double before = t;
    t = points.advance(before, run);
    const double h = t - before, branch = before + 0.5 * h;
    for (int i = 1; i <= substeps; ++i)
      plan.step(run, i == substeps ? t : before + h * i / substeps, h / substeps, branch);
    const double behind = branch_behind(t, 0.5 * h);
    if (jumps || points.is_echo()) plan.jump(run, t, behind);
    const double reached = t + same_row * h;
    const bool instant = !points.due().empty();
    if (!plan.momentary.empty() && (instant || due(reached))) {
      plan.at_time(run, t, behind);
      for (const int b : plan.momentary) plan.evaluate(b);
    }
    if (instant) {
      plan.hit(run, points, t, sampling);
      for (const int b : plan.momentary_behind) plan.evaluate(b);
    }
    record(reached);
  }
  plan.check_finite(values, instants);
}

}  // namespace hysteron
