// The exact advance, row by row.
//
// Blocks fall into sources (recorded inputs, constants), linear blocks, and nonlinear ones without states (static
// blocks, memory, dead time). The nonlinear depth of a block is the largest number of nonlinear blocks on a path to it.
// Linear blocks of one depth that are wired together are one linear system (LinearPart): between them no nonlinear
// block can stand, so cascades and loops of linear blocks, algebraic ones too, are exact. A row is one pass over the
// depths: the linear systems step with their inputs moving linearly, then the nonlinear blocks of that depth follow. A
// signal behind a nonlinear block is taken as linear between substeps, which is the only approximation; the caller
// doubles the substeps until nothing changes.
#include "engine/advance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/linear_part.h"

namespace hysteron {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

bool is_source(const BlockInstance& b) { return b.n_u == 0; }
bool is_linear(const BlockInstance& b) { return b.kernel->declaration.is_linear && !is_source(b); }

/// Strongly connected components of the blocks over all wires, sources first.
std::vector<std::vector<int>> components(const Program& program) {
  const int n = static_cast<int>(program.blocks.size());
  std::vector<int> index(at(n), -1), low(at(n), 0), stack;
  std::vector<bool> on_stack(at(n), false);
  std::vector<std::vector<int>> result;
  struct Frame {
    int block;
    std::size_t next;
  };
  int counter = 0;
  for (int root = 0; root < n; ++root) {
    if (index[at(root)] >= 0) continue;
    std::vector<Frame> frames{{root, 0}};
    while (!frames.empty()) {
      Frame& f = frames.back();
      const auto v = at(f.block);
      if (f.next == 0) {
        index[v] = low[v] = counter++;
        stack.push_back(f.block);
        on_stack[v] = true;
      }
      const auto& sources = program.blocks[v].source;
      if (f.next < sources.size()) {
        const int to = program.signals[at(sources[f.next++])].block;
        if (index[at(to)] < 0)
          frames.push_back({to, 0});
        else if (on_stack[at(to)])
          low[v] = std::min(low[v], index[at(to)]);
        continue;
      }
      if (low[v] == index[v]) {
        result.emplace_back();
        for (int b = -1; b != f.block;) {
          b = stack.back();
          stack.pop_back();
          on_stack[at(b)] = false;
          result.back().push_back(b);
        }
      }
      const int done = f.block;
      frames.pop_back();
      if (!frames.empty()) low[at(frames.back().block)] = std::min(low[at(frames.back().block)], low[at(done)]);
    }
  }
  return result;
}

std::string why_not_block(const BlockInstance& b) {
  const auto& type = b.kernel->declaration.type;
  if (b.kernel->uses_time && !b.kernel->declaration.is_series && !b.sizes.history)
    return fmt::format("source {} \"{}\" is a function of time, not a recording", type, b.path);
  if (b.kernel->is_sampled()) return fmt::format("{} \"{}\" is sampled", type, b.path);
  if (b.kernel->has_modes()) return fmt::format("{} \"{}\" changes its mode at events", type, b.path);
  if (b.sizes.smoothness == Smoothness::no_rate) return fmt::format("{} \"{}\" draws random numbers", type, b.path);
  if (b.sizes.states > 0 && !b.kernel->declaration.is_linear)
    return fmt::format("{} \"{}\" has nonlinear states", type, b.path);
  return "";
}

}  // namespace

std::string why_not_exact(const Program& program) {
  for (const auto& b : program.blocks)
    if (auto why = why_not_block(b); !why.empty()) return why;
  const auto reads_itself = [&](int block) {
    const auto& sources = program.blocks[at(block)].source;
    return std::any_of(sources.begin(), sources.end(), [&](int s) { return program.signals[at(s)].block == block; });
  };
  for (const auto& component : components(program))
    if (component.size() > 1 || reads_itself(component.front()))
      for (const int b : component)
        if (!is_linear(program.blocks[at(b)]))
          return fmt::format("{} \"{}\" is nonlinear and stands in a feedback loop",
                             program.blocks[at(b)].kernel->declaration.type, program.blocks[at(b)].path);
  return "";
}

struct Advance::Plan {
  struct Level {
    std::vector<LinearPart> linear;
    std::vector<int> nonlinear;  ///< in value order
  };

  ProgramPointer program;
  std::vector<int> signals;
  std::vector<int> sources;
  std::vector<Level> levels;
  bool no_substeps_needed = true;
  // Scratch of a run.
  std::vector<double> y, inputs, memory_out;
  std::vector<int> depth;
  std::vector<bool> needed, curved;

  Plan(ProgramPointer p, std::vector<int> wanted) : program(std::move(p)), signals(std::move(wanted)) {
    if (auto why = why_not_exact(*program); !why.empty())
      fail("not_exact", why, "this diagram cannot be advanced row by row exactly", "use the method \"bdf\"");
    find_needed();
    find_depths();
    build_levels();
    find_curved();
    y.assign(program->signals.size(), 0.0);
    std::size_t widest = 1, memory = 1;
    for (const auto& b : program->blocks) {
      widest = std::max(widest, at(b.n_u));
      memory = std::max(memory, at(b.sizes.memory));
    }
    inputs.resize(widest);
    memory_out.resize(memory);
  }

  const BlockInstance& block(int b) const { return program->blocks[at(b)]; }
  int block_of(int signal) const { return program->signals[at(signal)].block; }

  void find_needed() {
    needed.assign(program->blocks.size(), false);
    std::vector<int> todo;
    for (const int s : signals) todo.push_back(block_of(s));
    while (!todo.empty()) {
      const int b = todo.back();
      todo.pop_back();
      if (needed[at(b)]) continue;
      needed[at(b)] = true;
      for (const int s : block(b).source) todo.push_back(block_of(s));
    }
  }

  void find_depths() {
    depth.assign(program->blocks.size(), 0);
    for (const auto& component : components(*program)) {  // sources first
      int d = 0;
      for (const int b : component)
        for (const int s : block(b).source) {
          const int from = block_of(s);
          if (std::find(component.begin(), component.end(), from) != component.end()) continue;
          const bool behind_nonlinear = !is_linear(block(from)) && !is_source(block(from));
          d = std::max(d, depth[at(from)] + (behind_nonlinear ? 1 : 0));
        }
      for (const int b : component) depth[at(b)] = d;
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
    for (const int b : order) deepest = std::max(deepest, depth[at(b)]);
    levels.resize(at(deepest) + 1);
    for (const int b : order) {
      if (is_source(block(b)))
        sources.push_back(b);
      else if (!is_linear(block(b)))
        levels[at(depth[at(b)])].nonlinear.push_back(b);
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
    const auto here = [&](int b) { return needed[at(b)] && is_linear(block(b)) && depth[at(b)] == d; };
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
    for (std::size_t b = 0; b < program->blocks.size(); ++b)
      if (needed[b] && !inside(static_cast<int>(b)))
        for (const int s : program->blocks[b].source) add(s);
    return outputs;
  }

  /// A signal is curved between rows if a state or a delay stands before it. Substeps matter where a curved or kinked
  /// signal drives states, or a curved one drives memory (an extreme inside a row).
  void find_curved() {
    curved.assign(program->signals.size(), false);
    std::vector<bool> kinked(program->signals.size(), false);
    for (const auto& level : levels) {
      for (const auto& part : level.linear)
        if (part.has_states())
          for (const int s : part.input_signals())
            if (curved[at(s)] || kinked[at(s)]) no_substeps_needed = false;
      mark_linear(level, kinked);
      for (const int b : level.nonlinear) {
        bool any_curved = false;
        for (const int s : block(b).source) any_curved = any_curved || curved[at(s)];
        if (any_curved && (block(b).sizes.memory > 0 || block(b).history_index >= 0)) no_substeps_needed = false;
        for (int o = 0; o < block(b).sizes.outputs; ++o) {
          kinked[at(block(b).y_begin + o)] = true;
          curved[at(block(b).y_begin + o)] = any_curved;
        }
      }
    }
  }

  void mark_linear(const Level& level, std::vector<bool>& kinked) {
    const int d = static_cast<int>(&level - levels.data());
    for (const int b : blocks_in_value_order()) {
      if (!is_linear(block(b)) || depth[at(b)] != d) continue;
      bool is_curved = block(b).sizes.states > 0, is_kinked = false;
      for (const int s : block(b).source) {
        is_curved = is_curved || curved[at(s)];
        is_kinked = is_kinked || kinked[at(s)];
      }
      for (int o = 0; o < block(b).sizes.outputs; ++o) {
        curved[at(block(b).y_begin + o)] = is_curved;
        kinked[at(block(b).y_begin + o)] = is_kinked;
      }
    }
  }

  // --- a run --------------------------------------------------------------------------------------------------------

  void evaluate_sources(Run& run, double t, double branch) {
    run.branch = branch;
    for (const int b : sources) {
      const BlockInstance& source = block(b);
      if (source.series_index >= 0) {
        const auto& series = run.series[at(source.series_index)];
        y[at(source.y_begin)] = series->value(t, branch);
        continue;
      }
      View<double> v = view_of(*program, run, b);
      v.t = t;
      v.out = y.data() + source.y_begin;
      source.kernel->output(v);
    }
  }

  /// Nonlinear blocks follow their inputs; memory is committed at once: every point of the advance is an accepted one.
  void follow(Run& run, int b, double t) {
    const BlockInstance& n = block(b);
    for (int i = 0; i < n.n_u; ++i) inputs[at(i)] = y[at(n.source[at(i)])];
    View<double> v = view_of(*program, run, b);
    v.u = inputs.data();
    v.t = t;
    if (n.sizes.memory > 0) {
      v.out = memory_out.data();
      n.kernel->advance(v);
      std::copy_n(memory_out.data(), n.sizes.memory, run.m.data() + n.m_begin);
    }
    if (n.history_index >= 0) {
      History& h = run.histories[at(n.history_index)];
      if (h.t.empty()) h.before = inputs[0];
      h.t.push_back(t);
      h.u.push_back(inputs[0]);
      h.rate.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    v.out = y.data() + n.y_begin;
    n.kernel->output(v);
  }

  void start(Run& run, double t, double branch, bool at_rest) {
    evaluate_sources(run, t, branch);
    for (auto& level : levels) {
      for (auto& part : level.linear) {
        part.bind(*program, run);
        part.start(*program, run, y, at_rest);
        part.refresh(y);
      }
      for (const int b : level.nonlinear) follow(run, b, t);
    }
  }

  void step(Run& run, double t, double h, double branch) {
    evaluate_sources(run, t, branch);
    for (auto& level : levels) {
      for (auto& part : level.linear) part.step(h, y);
      for (const int b : level.nonlinear) follow(run, b, t);
    }
  }

  void jump(Run& run, double t, double branch) {
    evaluate_sources(run, t, branch);
    for (auto& level : levels) {
      for (auto& part : level.linear) part.refresh(y);
      for (const int b : level.nonlinear) follow(run, b, t);
    }
  }

  bool sources_jump(const Run& run) const {
    for (const int b : sources)
      if (block(b).series_index >= 0 && run.series[at(block(b).series_index)]->between == Between::hold) return true;
    return false;
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
    for (const int b : sources) {
      if (block(b).series_index < 0) continue;
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
  const auto times = plan.grid(run, instants);
  const double tolerance = 1e-9;  // instants and samples that differ by rounding only are one point
  const bool jumps = plan.sources_jump(run);
  std::size_t next = 0;
  const auto record = [&](double t) {
    while (next < instants.size() && instants[next] <= t) {
      for (std::size_t s = 0; s < plan.signals.size(); ++s) values[s][next] = plan.y[at(plan.signals[s])];
      ++next;
    }
  };
  const double first_branch = times.size() > 1 ? 0.5 * (times[0] + times[1]) : times[0];
  plan.start(run, times[0], first_branch, options.at_rest);
  record(times[0]);
  const int substeps = std::max(1, options.substeps);
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double before = times[k - 1];
    const double h = times[k] - before;
    const double branch = before + 0.5 * h;
    if (k + 1 < times.size() && h < tolerance * (times[k + 1] - before)) {
      plan.jump(run, times[k], times[k] + 0.5 * (times[k + 1] - times[k]));  // a point twice, but for rounding
      record(times[k]);
      continue;
    }
    for (int i = 1; i <= substeps; ++i)
      plan.step(run, i == substeps ? times[k] : before + h * i / substeps, h / substeps, branch);
    if (jumps) plan.jump(run, times[k], k + 1 < times.size() ? 0.5 * (times[k] + times[k + 1]) : times[k] + 0.5 * h);
    record(times[k]);
  }
  plan.check_finite(values, instants);
}

}  // namespace hysteron
