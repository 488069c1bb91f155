// Decides in which order values, rates and derivatives are computed.
//
// Each block has up to three nodes: its value, its rate (only if somebody reads it) and its derivative (only with
// states):
//   value(b)      <- value(sources)           if b feeds through
//   derivative(b) <- value(sources), and rate(sources) if the derivative wants the rate
//   rate(b)       <- value(b), rate(sources) if b feeds through, derivative(b) if b has states
// Tarjan's algorithm on this graph gives the schedule and every loop, loops among rates included. A loop becomes one
// step that solves it (loop_plan.h, loops.h), unless the diagram forbids loops: then it is an error that prints its
// path block by block. What goes round by blocks though no number depends on itself (entries of D that are zero) is no
// algebraic loop, and solved by one step of Newton exactly. Between its instants a sampled block holds what it put out:
// there it is a source. At its instants its inputs feed through, so values have a second order for these.
#include "engine/compile/order.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/program/components.h"
#include "engine/program/feedthrough.h"
#include "engine/program/loop_plan.h"

namespace hysteron {
namespace {

class Scheduler {
 public:
  Scheduler(const Graph& graph, const LoopWishes& wishes, Program& program)
      : graph_(graph),
        wishes_(wishes),
        program_(program),
        n_(static_cast<int>(graph.blocks.size())),
        edges_(static_cast<std::size_t>(3 * n_)),
        needed_(static_cast<std::size_t>(3 * n_), false),
        loop_of_(static_cast<std::size_t>(3 * n_), -1),
        readers_(static_cast<std::size_t>(n_)) {
    for (int b = 0; b < n_; ++b)
      for (const int s : block(b).source) readers_[static_cast<std::size_t>(source_block(s))].push_back(b);
  }

  void run() {
    smoothness_ = own_smoothness();
    spread(smoothness_);
    check_rates();
    check_input_jumps();
    for (int b = 0; b < n_; ++b) {
      need(value(b));
      if (stateful(b)) need(derivative(b));
      if (block(b).kernel->guard_wants_rate)
        for (const int s : block(b).source) need(rate(source_block(s)));
    }
    demanded_ = needed_;
    wish_rates();
    find_order();
    problems_.throw_if_any();
    write_steps();
    order_hits();
  }

 private:
  const GraphBlock& block(int b) const { return graph_.blocks[static_cast<std::size_t>(b)]; }
  int value(int b) const { return b; }
  int rate(int b) const { return n_ + b; }
  int derivative(int b) const { return 2 * n_ + b; }
  int block_of(int node) const { return node % n_; }
  int source_block(int signal) const { return program_.signals[static_cast<std::size_t>(signal)].block; }
  bool stateful(int b) const { return block(b).sizes.states > 0; }
  bool sampled(int b) const { return block(b).kernel->is_sampled(); }
  /// Do the outputs depend on the inputs at the same instant: at sampling instants (hits_), or between.
  bool feeds_through(int b) const { return block(b).sizes.feedthrough && (hits_ || !sampled(b)); }

  // --- smoothness ---------------------------------------------------------------------------------------------------

  std::vector<Smoothness> own_smoothness() const {
    std::vector<Smoothness> list;
    for (const auto& b : graph_.blocks) {
      const bool held = (b.series && b.series->between == Between::hold) || b.kernel->is_sampled() || b.enabling >= 0;
      list.push_back(held ? Smoothness::jumps : b.sizes.smoothness);
    }
    return list;
  }

  /// Does what its inputs do come out: through a block that feeds through, or a dead time, later.
  bool passes_on(int b) const { return feeds_through(b) || block(b).sizes.history; }

  /// A block passes on what its inputs do; a dead time passes on jumps too, later.
  void spread(std::vector<Smoothness>& smooth) const {
    std::vector<int> todo;
    for (int b = n_ - 1; b >= 0; --b)
      if (smooth[static_cast<std::size_t>(b)] != Smoothness::smooth) todo.push_back(b);
    while (!todo.empty()) {
      const int from = todo.back();
      todo.pop_back();
      for (const int b : readers_[static_cast<std::size_t>(from)]) {
        if (!passes_on(b) || smooth[static_cast<std::size_t>(b)] >= smooth[static_cast<std::size_t>(from)]) continue;
        smooth[static_cast<std::size_t>(b)] = smooth[static_cast<std::size_t>(from)];
        todo.push_back(b);
      }
    }
  }

  void check_rates() {
    for (int b = 0; b < n_; ++b) {
      if (!wants_rate(b)) continue;
      for (const int s : block(b).source) {
        const auto smooth = smoothness_[static_cast<std::size_t>(source_block(s))];
        const std::string from = program_.signals[static_cast<std::size_t>(s)].path;
        if (smooth == Smoothness::jumps && !follows_jumps(b))
          problems_.add(
              "jump_into_rate", block(b).origin,
              fmt::format("{} \"{}\" is driven by the rate of its input, but \"{}\" jumps (it comes from {})",
                          block(b).kernel->declaration.type, block(b).path, from, origin_of(s, Smoothness::jumps)),
              "put the amplifier's dynamics between them (a lag), which usually is the true physics, or let the input "
              "move linearly between its samples");
        if (smooth == Smoothness::no_rate)
          problems_.add(
              "rate_of_nondifferentiable", block(b).origin,
              fmt::format("{} \"{}\" is driven by the rate of its input, but \"{}\" has no rate (it comes from {})",
                          block(b).kernel->declaration.type, block(b).path, from, origin_of(s, Smoothness::no_rate)),
              "put a lag between them: it has an exact rate");
      }
    }
  }

  bool wants_rate(int b) const { return block(b).kernel->derivative_wants_rate || block(b).kernel->guard_wants_rate; }
  /// A rate-independent law follows a jump as the path of a fast ramp (path.h).
  bool follows_jumps(int b) const { return block(b).kernel->declaration.is_rate_independent; }

  /// The block that the signal has it from: the first that is found against the direction of the signals, depth first.
  std::string origin_of(int signal, Smoothness kind) const {
    const auto own = own_smoothness();
    std::vector<bool> seen(static_cast<std::size_t>(n_), false);
    std::vector<int> todo{source_block(signal)};
    while (!todo.empty()) {
      const int b = todo.back();
      todo.pop_back();
      if (seen[static_cast<std::size_t>(b)]) continue;
      seen[static_cast<std::size_t>(b)] = true;
      if (own[static_cast<std::size_t>(b)] == kind)
        return fmt::format("{} \"{}\"", block(b).kernel->declaration.type, block(b).path);
      if (!passes_on(b)) continue;
      for (auto s = block(b).source.rbegin(); s != block(b).source.rend(); ++s) todo.push_back(source_block(*s));
    }
    return "";
  }

  /// How an input of the diagram moves is known only when it is bound: remember whom its jumps would reach first.
  void check_input_jumps() {
    // Of what each block passes on: the first block that wants a rate and would read it, n_ for none.
    std::vector<int> first(static_cast<std::size_t>(n_), n_);
    int anyway = n_;  // what reads a signal that is not smooth, however the inputs move
    for (int b = 0; b < n_; ++b) {
      if (!wants_rate(b) || follows_jumps(b)) continue;
      for (const int s : block(b).source) {
        if (smoothness_[static_cast<std::size_t>(source_block(s))] != Smoothness::smooth) anyway = std::min(anyway, b);
        std::vector<int> todo{source_block(s)};
        while (!todo.empty()) {
          const int from = todo.back();
          todo.pop_back();
          if (first[static_cast<std::size_t>(from)] <= b) continue;
          first[static_cast<std::size_t>(from)] = b;
          if (passes_on(from))
            for (const int source : block(from).source) todo.push_back(source_block(source));
        }
      }
    }
    for (const auto& [name, signal] : graph_.inputs) {
      const int reached = std::min(anyway, first[static_cast<std::size_t>(source_block(signal))]);
      program_.input_jump_reaches.push_back(reached < n_ ? block(reached).path : "");
    }
  }

  // --- nodes --------------------------------------------------------------------------------------------------------

  void need(int wanted) {
    std::vector<int> todo{wanted};
    while (!todo.empty()) {
      const int node = todo.back();
      todo.pop_back();
      if (needed_[static_cast<std::size_t>(node)]) continue;
      needed_[static_cast<std::size_t>(node)] = true;
      list_edges(node);
      const auto& edges = edges_[static_cast<std::size_t>(node)];
      todo.insert(todo.end(), edges.begin(), edges.end());
    }
  }

  void list_edges(int node) {
    const int b = block_of(node);
    auto& edges = edges_[static_cast<std::size_t>(node)];
    if (node < n_) {
      if (feeds_through(b))
        for (const int s : block(b).source) edges.push_back(value(source_block(s)));
    } else if (node < 2 * n_) {
      edges.push_back(value(b));
      if (feeds_through(b))
        for (const int s : block(b).source) edges.push_back(rate(source_block(s)));
      if (stateful(b)) edges.push_back(derivative(b));
    } else {
      for (const int s : block(b).source) {
        edges.push_back(value(source_block(s)));
        if (block(b).kernel->derivative_wants_rate) edges.push_back(rate(source_block(s)));
      }
    }
  }

  /// Memory and dead time wish the rate of their inputs (to locate reversals, to remember slopes); they run without it
  /// too.
  void wish_rates() {
    for (int b = 0; b < n_; ++b)
      if (block(b).sizes.memory > 0 || block(b).sizes.history)
        for (const int s : block(b).source)
          if (smoothness_[static_cast<std::size_t>(source_block(s))] != Smoothness::no_rate)
            need(rate(source_block(s)));
  }

  // --- loops and order ----------------------------------------------------------------------------------------------

  void find_order() {
    order_.clear();
    for (const auto& component : strong_components(edges_)) {
      if (!needed_[static_cast<std::size_t>(component.front())]) continue;
      const int any = component.front();
      const auto& self = edges_[static_cast<std::size_t>(any)];
      if (component.size() > 1 || std::find(self.begin(), self.end(), any) != self.end()) add_loop(component);
      order_.insert(order_.end(), component.begin(), component.end());
    }
  }

  Step step_of(int node) const {
    return {node < n_ ? Order::value : node < 2 * n_ ? Order::rate : Order::derivative, block_of(node)};
  }

  void add_loop(const std::vector<int>& component) {
    std::vector<Step> members;
    std::vector<std::vector<int>> needs;
    std::map<int, int> index;
    for (const int node : component) index.emplace(node, static_cast<int>(index.size()));
    bool through_sampled = false;
    for (const int node : component) {
      members.push_back(step_of(node));
      through_sampled = through_sampled || sampled(block_of(node));
      needs.emplace_back();
      for (const int to : edges_[static_cast<std::size_t>(node)])
        if (const auto inside = index.find(to); inside != index.end()) needs.back().push_back(inside->second);
    }
    if (hits_) {  // else the same as between the instants
      if (through_sampled) report_loop(members, needs);
      return;
    }
    Loop loop = plan_loop(program_, members, needs, wishes_.guessed_signals());
    if (wishes_.forbidden && is_algebraic(program_, loop)) return report_loop(members, needs);
    loop.needed = demanded_[static_cast<std::size_t>(component.front())];
    for (const int node : component) loop_of_[static_cast<std::size_t>(node)] = static_cast<int>(program_.loops.size());
    program_.loops.push_back(std::move(loop));
  }

  void report_loop(const std::vector<Step>& members, const std::vector<std::vector<int>>& needs) {
    const auto path = path_around(members, needs, static_cast<int>(members.size()) - 1);
    problems_.add(
        "algebraic_loop", block(path.front().block).origin,
        fmt::format("these blocks need each other's {} at the same {}instant: {}",
                    path.front().order == Order::value ? "value" : "rate", hits_ ? "sampling " : "",
                    to_text(program_, path)),
        hits_
            ? "put a unit delay into the loop (a delay_line of one sample), as the computation takes time in any case"
            : "allow it (\"simulate\": {\"loops\": \"solve\"}); or put a block with a state into the loop (a lag, the "
              "amplifier's or sensor's dynamics), or use an inverse in closed form");
  }

  // --- steps --------------------------------------------------------------------------------------------------------

  std::vector<bool> closure(const std::vector<int>& roots, const std::vector<bool>& allowed) const {
    std::vector<bool> in(static_cast<std::size_t>(3 * n_), false);
    std::vector<int> todo(roots);
    while (!todo.empty()) {
      const int node = todo.back();
      todo.pop_back();
      if (in[static_cast<std::size_t>(node)] || !allowed[static_cast<std::size_t>(node)]) continue;
      in[static_cast<std::size_t>(node)] = true;
      for (const int to : edges_[static_cast<std::size_t>(node)]) todo.push_back(to);
    }
    return in;
  }

  /// The wanted nodes in order; the nodes of a loop, which stand together, become one step.
  std::vector<Step> steps(const std::vector<bool>& wanted) const {
    std::vector<Step> list;
    for (const int node : order_) {
      if (!wanted[static_cast<std::size_t>(node)]) continue;
      const int loop = loop_of_[static_cast<std::size_t>(node)];
      if (loop < 0)
        list.push_back(step_of(node));
      else if (list.empty() || list.back().order != Order::loop || list.back().block != loop)
        list.push_back({Order::loop, loop});
    }
    return list;
  }

  /// Every block in the order of its value.
  std::vector<int> blocks_in_order() const {
    std::vector<int> list;
    for (const Step& step : program_.all_values) {
      if (step.order != Order::loop) {
        list.push_back(step.block);
        continue;
      }
      for (const Step& inner : program_.loops[static_cast<std::size_t>(step.block)].steps) list.push_back(inner.block);
    }
    return list;
  }

  /// Where the loops find their numbers in Run::warm, and where they begin.
  void place_warm_starts() {
    std::vector<bool> used(wishes_.guesses.size(), false);
    std::multimap<int, std::size_t> guess_of;  // a signal
    for (std::size_t i = 0; i < used.size(); ++i) guess_of.emplace(wishes_.guesses[i].first, i);
    for (Loop& loop : program_.loops) {
      loop.warm_begin = static_cast<int>(program_.guess.size());
      for (const Slot& tear : loop.tears) {
        program_.guess.push_back(0.0);
        if (tear.order != Order::value) continue;
        const auto [begin, end] = guess_of.equal_range(tear.index);
        for (auto i = begin; i != end; ++i) {
          program_.guess.back() = wishes_.guesses[i->second].second;
          used[i->second] = true;
        }
      }
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (used[i]) continue;
      const std::string& path = program_.signals[static_cast<std::size_t>(wishes_.guesses[i].first)].path;
      std::string torn;
      for (const Loop& loop : program_.loops)
        if (loop.of_values()) torn += (torn.empty() ? "" : "; ") + to_text(program_, loop.path);
      problems_.add(
          "unused_guess", place_of_guess(path),
          fmt::format("\"{}\" is not solved for: it stands in no algebraic loop", path),
          torn.empty() ? "take the guess out: the diagram has no algebraic loop" : "guess a signal of a loop: " + torn);
    }
    problems_.throw_if_any();
  }

  /// Where both the value and the rate of a source are needed, the step of the rate makes both.
  std::vector<Step> sources_once(const std::vector<Step>& list) const {
    std::vector<bool> rated(static_cast<std::size_t>(n_), false), done(static_cast<std::size_t>(n_), false);
    for (const Step& step : list)
      if (step.order == Order::rate && is_source_of_time(program_.blocks[static_cast<std::size_t>(step.block)]))
        rated[static_cast<std::size_t>(step.block)] = true;
    std::vector<Step> shorter;
    for (Step step : list) {
      if (step.order != Order::loop && rated[static_cast<std::size_t>(step.block)]) {
        if (done[static_cast<std::size_t>(step.block)]) continue;
        done[static_cast<std::size_t>(step.block)] = true;
        step.order = Order::rate;
      }
      shorter.push_back(step);
    }
    return shorter;
  }

  void write_steps() {
    std::vector<int> derivatives, values, rates;
    for (int b = 0; b < n_; ++b) {
      values.push_back(value(b));
      if (stateful(b)) derivatives.push_back(derivative(b));
    }
    const std::vector<bool> all(static_cast<std::size_t>(3 * n_), true);
    const auto for_derivatives = closure(derivatives, all);
    program_.derivative_steps = sources_once(steps(for_derivatives));
    program_.all_values = steps(closure(values, all));
    program_.value_order = blocks_in_order();
    place_warm_starts();
    program_.has_rate.assign(program_.signals.size(), false);
    for (int b = 0; b < n_; ++b)
      if (needed_[static_cast<std::size_t>(rate(b))]) {
        rates.push_back(rate(b));
        for (std::size_t o = 0; o < block(b).output.size(); ++o)
          program_.has_rate[static_cast<std::size_t>(block(b).first_signal) + o] = true;
      }
    auto wanted = closure(rates, all);
    for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = wanted[i] && !for_derivatives[i];
    program_.rate_steps = steps(wanted);
    for (std::size_t s = 0; s < program_.signals.size(); ++s)
      program_.signals[s].smoothness = smoothness_[static_cast<std::size_t>(program_.signals[s].block)];
  }

  /// The order of values at sampling instants, in which inputs of sampled blocks feed through. What is a loop there is
  /// none between the instants, and has no meaning: every block in it would have to be the first.
  void order_hits() {
    program_.hit_values = program_.all_values;
    if (program_.sampled_blocks.empty()) return;
    hits_ = true;
    for (auto& edges : edges_) edges.clear();
    needed_.assign(needed_.size(), false);
    for (int b = 0; b < n_; ++b) need(value(b));
    find_order();
    problems_.throw_if_any();
    program_.hit_values = steps(needed_);
  }

  const Graph& graph_;
  const LoopWishes& wishes_;
  Program& program_;
  int n_;
  std::vector<std::vector<int>> edges_;
  std::vector<bool> needed_, demanded_;    // needed: demanded, or wished
  std::vector<int> loop_of_;               // per node: index into Program::loops, -1 = in none
  std::vector<std::vector<int>> readers_;  // per block: of its signals
  std::vector<Smoothness> smoothness_;
  std::vector<int> order_;
  Problems problems_;
  bool hits_ = false;  // ordering for sampling instants
};

}  // namespace

void order_steps(const Graph& graph, const LoopWishes& wishes, Program& program) {
  Scheduler(graph, wishes, program).run();
}

}  // namespace hysteron
