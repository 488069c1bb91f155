#include "engine/rowwise/advance_graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "engine/diagram/index.h"
#include "engine/program/components.h"

namespace hysteron {
namespace {

bool is_function_of_time(const BlockInstance& b) {
  const bool of_time = b.kernel->uses_time && !b.kernel->declaration.is_series && !b.sizes.history;
  return !b.kernel->is_sampled() && (of_time || b.sizes.smoothness == Smoothness::no_rate);
}
bool remembers(const BlockInstance& b) { return b.sizes.states > 0 || b.sizes.memory > 0 || b.sizes.history; }
const std::string& type_of(const BlockInstance& b) { return b.kernel->declaration.type; }

class Builder {
 public:
  Builder(const Program& program, const std::vector<bool>& linear_too) : program_(program), linear_too_(linear_too) {}

  AdvanceGraph operator()() {
    give_roles();
    if (graph_.why_not.empty()) find_depths();
    if (!graph_.why_not.empty()) return {.why_not = graph_.why_not, .in_the_way = graph_.in_the_way};
    find_jumps();
    find_hit_steps();
    return std::move(graph_);
  }

 private:
  const BlockInstance& block(int b) const { return program_.blocks[at(b)]; }
  int block_of(int signal) const { return program_.signals[at(signal)].block; }
  AdvanceRole& role(int b) { return graph_.role[at(b)]; }

  bool is_linear(const BlockInstance& b) const {
    return b.kernel->declaration.is_linear ||
           (!linear_too_.empty() && linear_too_[static_cast<std::size_t>(&b - program_.blocks.data())]);
  }

  /// Between the instants: sampled blocks read nothing.
  const std::vector<int>& reads(int b) const {
    static const std::vector<int> nothing;
    return block(b).kernel->is_sampled() ? nothing : block(b).source;
  }

  std::string why_not_block(const BlockInstance& b) const {
    if (b.kernel->is_sampled()) return "";
    // What adds a function of time to a signal is computed at the instants, if nothing that remembers follows.
    const bool adds = b.n_u > 0 && b.sizes.smoothness != Smoothness::no_rate;
    if (is_function_of_time(b) && !adds && program_.sampled_blocks.empty())
      return b.n_u == 0 ? fmt::format("source {} \"{}\" is a function of time, not a recording", type_of(b), b.path)
                        : fmt::format(
                              "{} \"{}\" {}", type_of(b), b.path,
                              b.sizes.smoothness == Smoothness::no_rate ? "draws random numbers" : "changes with time");
    if (b.kernel->has_modes() && b.kernel->rows == nullptr) return changes_mode(b);
    if (b.history_index >= 0 && b.sizes.feedthrough)
      return fmt::format("{} \"{}\" adds what its input was to what it is", type_of(b), b.path);
    if (b.n_u > 0 && b.kernel->rows == nullptr)
      return fmt::format("{} \"{}\" has no functions that rows could be passed by", type_of(b), b.path);
    return "";
  }

  /// The first refusal counts.
  void refuse(const BlockInstance& b, std::string why) {
    if (why.empty() || !graph_.why_not.empty()) return;
    graph_.why_not = std::move(why);
    graph_.in_the_way = b.path;
  }

  /// What comes late of a recording is a recording: where it turns is known. Sampled blocks hand their jumps on at
  /// points of their own.
  int recording_of(const BlockInstance& b) const {
    if (b.kernel->reach_back == nullptr || b.sizes.feedthrough || b.source.size() != 1 ||
        !program_.sampled_blocks.empty())
      return -1;
    const int from = block_of(b.source.front());
    return block(from).series_index >= 0 ? from : -1;
  }

  void give_roles() {
    for (const auto& b : program_.blocks) {
      refuse(b, why_not_block(b));
      graph_.linear.push_back(is_linear(b));
      graph_.late_of.push_back(recording_of(b));
      graph_.role.push_back(graph_.late_of.back() >= 0 ? AdvanceRole::source
                            : b.kernel->is_sampled()   ? AdvanceRole::sampled
                            : is_function_of_time(b)   ? AdvanceRole::momentary
                            : b.n_u == 0               ? AdvanceRole::source
                            : is_linear(b)             ? AdvanceRole::linear
                                                       : AdvanceRole::nonlinear);
    }
    for (const int b : program_.value_order) {
      if (role(b) != AdvanceRole::momentary && role(b) != AdvanceRole::sampled)
        for (const int s : reads(b))
          if (role(block_of(s)) == AdvanceRole::momentary) role(b) = AdvanceRole::momentary;
      if (role(b) == AdvanceRole::momentary && remembers(block(b))) return refuse_source_of(b);
    }
  }

  /// Names the function of time that reaches block `to`, which remembers what happens between instants.
  void refuse_source_of(int to) {
    int from = to;
    while (!is_function_of_time(block(from))) {
      int next = -1;
      for (const int s : reads(from))
        if (next < 0 && role(block_of(s)) == AdvanceRole::momentary) next = block_of(s);
      from = next;
    }
    refuse(block(from), fmt::format("{} \"{}\" is a function of time and moves {} \"{}\" between the rows and instants",
                                    type_of(block(from)), block(from).path, type_of(block(to)), block(to).path));
  }

  /// Blocks that feed each other over the wires that are read between instants, sources first.
  std::vector<std::vector<int>> components() const {
    std::vector<std::vector<int>> needs(program_.blocks.size());
    for (std::size_t b = 0; b < needs.size(); ++b)
      for (const int s : reads(static_cast<int>(b))) needs[b].push_back(block_of(s));
    return strong_components(needs);
  }

  void find_depths() {
    graph_.depth.assign(program_.blocks.size(), 0);
    for (const auto& component : components()) {  // sources first
      const bool loop = component.size() > 1 || reads_itself(component.front());
      int d = 0;
      if (loop &&
          std::any_of(component.begin(), component.end(), [&](int b) { return role(b) != AdvanceRole::linear; })) {
        for (const int b : component) refuse(block(b), why_not_looped(b, component));
        for (const int b : component) role(b) = AdvanceRole::looped;
        graph_.loops.push_back(component);
      }
      for (const int b : component) {
        for (const int s : reads(b)) {
          const int from = block_of(s);
          if (std::find(component.begin(), component.end(), from) == component.end())
            d = std::max(d, graph_.depth[at(from)] + (is_bent(from) ? 1 : 0));
        }
      }
      for (const int b : component) graph_.depth[at(b)] = d;
    }
  }

  bool is_bent(int b) { return role(b) == AdvanceRole::nonlinear || role(b) == AdvanceRole::looped; }

  /// What jumps with a mode moves rate-independent states along a path; a loop follows those of its inputs only.
  bool jumps_move_states(const std::vector<int>& loop) const {
    return std::any_of(loop.begin(), loop.end(), [&](int b) {
      return block(b).sizes.states > 0 && block(b).kernel->declaration.is_rate_independent;
    });
  }

  std::string why_not_looped(int b, const std::vector<int>& component) {
    const auto in_loop = [&](const char* what) {
      return fmt::format("{} \"{}\" {} and stands in a feedback loop", type_of(block(b)), block(b).path, what);
    };
    if (role(b) == AdvanceRole::momentary) return in_loop("follows a function of time");
    if (block(b).kernel->has_modes() && (block(b).kernel->guard_wants_rate || jumps_move_states(component)))
      return in_loop("changes its mode at events");
    if (block(b).history_index >= 0) return in_loop("is a dead time");
    for (const Loop& loop : program_.loops)
      if (std::find(loop.blocks.begin(), loop.blocks.end(), b) != loop.blocks.end())
        return fmt::format("{} \"{}\" stands in a feedback loop with nonlinear blocks that is an algebraic loop",
                           type_of(block(b)), block(b).path);
    return "";
  }

  bool reads_itself(int b) const {
    return std::any_of(reads(b).begin(), reads(b).end(), [&](int s) { return block_of(s) == b; });
  }

  bool reads_jumps(int b, const std::vector<bool>& jumps) const {
    return std::any_of(reads(b).begin(), reads(b).end(), [&](int s) { return jumps[at(s)]; });
  }

  /// Marks the outputs of sampled blocks and all that follows at once, the states of rate-independent laws included;
  /// with_delays: also what follows later.
  std::vector<bool> jumping(bool with_delays) const {
    std::vector<bool> jumps(program_.signals.size(), false);
    for (bool changed = true; changed;) {
      changed = false;
      for (int b = 0; b < static_cast<int>(program_.blocks.size()); ++b) {
        const auto& sizes = block(b).sizes;
        const bool moves_states = sizes.states > 0 && block(b).kernel->declaration.is_rate_independent;
        const bool passes = sizes.feedthrough || moves_states || (with_delays && sizes.history);
        if (!block(b).kernel->is_sampled() && !(passes && reads_jumps(b, jumps))) continue;
        for (int s = block(b).y_begin; s < block(b).y_begin + sizes.outputs; ++s)
          if (!jumps[at(s)]) jumps[at(s)] = changed = true;
      }
    }
    return jumps;
  }

  void find_jumps() {
    graph_.jumps = jumping(false);
    const auto later = jumping(true);
    for (int b = 0; b < static_cast<int>(program_.blocks.size()); ++b)
      graph_.delayed.push_back(block(b).history_index >= 0 && reads_jumps(b, later));
  }

  /// Between sampled blocks stands what jumps with one and is read by another at the same instant.
  void find_hit_steps() {
    const auto n = program_.blocks.size();
    std::vector<bool> taken(n, false);
    std::vector<int> todo = program_.sampled_blocks;
    while (!todo.empty()) {
      const int b = todo.back();
      todo.pop_back();
      if (taken[at(b)]) continue;
      taken[at(b)] = true;
      if (!block(b).kernel->is_sampled() && !block(b).sizes.feedthrough) continue;
      for (const int s : block(b).source)
        if (graph_.jumps[at(s)] && role(block_of(s)) != AdvanceRole::sampled) todo.push_back(block_of(s));
    }
    for (const Step& step : program_.hit_values) {
      if (step.order != Order::loop) {
        if (taken[at(step.block)]) take(step, {step.block});
        continue;
      }
      const Loop& loop = program_.loops[at(step.block)];
      if (std::none_of(loop.blocks.begin(), loop.blocks.end(), [&](int b) { return taken[at(b)]; })) continue;
      take(step, loop.blocks);
    }
  }

  void take(const Step& step, const std::vector<int>& blocks) {
    graph_.hit_steps.push_back(step);
    for (const int b : blocks)
      graph_.hit_signals.insert(graph_.hit_signals.end(), block(b).source.begin(), block(b).source.end());
  }

  const Program& program_;
  const std::vector<bool>& linear_too_;
  AdvanceGraph graph_;
};

}  // namespace

AdvanceGraph advance_graph(const Program& program, const std::vector<bool>& linear_too) {
  return Builder(program, linear_too)();
}

namespace {

/// What a kernel says of the numbers of this run, whatever those are that vary.
bool is_so(const Program& program, const Run& run, int b, bool (*says)(const View<double>&)) {
  if (says == nullptr) return false;
  const BlockInstance& block = program.blocks[at(b)];
  auto view = view_of(program, run, b);
  const auto count = block.p_at.back();
  std::vector<double> numbers(view.p, view.p + count);
  for (const int place : run.varied)
    if (place >= block.p_begin && place < block.p_begin + count)
      numbers[at(place - block.p_begin)] = std::numeric_limits<double>::quiet_NaN();
  view.p = numbers.data();
  return says(view);
}

}  // namespace

std::vector<bool> linear_at(const Program& program, const Run& run) {
  std::vector<bool> linear;
  for (std::size_t b = 0; b < program.blocks.size(); ++b) {
    if (!is_so(program, run, static_cast<int>(b), program.blocks[b].kernel->is_linear_at)) continue;
    linear.resize(program.blocks.size(), false);
    linear[b] = true;
  }
  return linear;
}

bool affine_in_modes(const Program& program, const Run& run, int block) {
  return is_so(program, run, block, program.blocks[at(block)].kernel->is_affine_in_modes);
}

std::string changes_mode(const BlockInstance& block) {
  return fmt::format("{} \"{}\" changes its mode at events", type_of(block), block.path);
}

}  // namespace hysteron
