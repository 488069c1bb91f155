// Decides in which order values, rates and derivatives are computed.
//
// Each block has up to three nodes: its value, its rate (only if somebody reads it) and its derivative (only with
// states):
//   value(b)      <- value(sources)           if b feeds through
//   derivative(b) <- value(sources), and rate(sources) if the derivative wants the rate
//   rate(b)       <- value(b), rate(sources) if b feeds through, derivative(b) if b has states
// Tarjan's algorithm on this graph gives the schedule and every loop, loops among rates included. A loop is, for now,
// an error that prints its path block by block. Between its instants a sampled block holds what it put out: there it is
// a source. At its instants its inputs feed through, so values have a second order for these.
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "engine/graph.h"

namespace hysteron {
namespace {

class Scheduler {
 public:
  Scheduler(const Graph& graph, Program& program)
      : graph_(graph),
        program_(program),
        n_(static_cast<int>(graph.blocks.size())),
        edges_(static_cast<std::size_t>(3 * n_)),
        needed_(static_cast<std::size_t>(3 * n_), false) {}

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
    tarjan();
    problems_.throw_if_any();
    wish_rates();
    tarjan();  // a wished rate is left out where it would close a loop
    write_steps();
    order_hits();
  }

 private:
  const GraphBlock& block(int b) const { return graph_.blocks[static_cast<std::size_t>(b)]; }
  int value(int b) const { return b; }
  int rate(int b) const { return n_ + b; }
  int derivative(int b) const { return 2 * n_ + b; }
  int block_of(int node) const { return node % n_; }
  int source_block(int signal) const { return graph_.signals[static_cast<std::size_t>(signal)].block; }
  bool stateful(int b) const { return block(b).sizes.states > 0; }
  bool sampled(int b) const { return block(b).kernel->is_sampled(); }
  /// Do the outputs depend on the inputs at the same instant: at sampling instants (hits_), or between.
  bool feeds_through(int b) const { return block(b).sizes.feedthrough && (hits_ || !sampled(b)); }

  // --- smoothness ---------------------------------------------------------------------------------------------------

  std::vector<Smoothness> own_smoothness() const {
    std::vector<Smoothness> list;
    for (const auto& b : graph_.blocks) {
      const bool held = (b.series && b.series->between == Between::hold) || b.kernel->is_sampled();
      list.push_back(held ? Smoothness::jumps : b.sizes.smoothness);
    }
    return list;
  }

  /// A block that feeds through passes on what its inputs do; a dead time passes on jumps too, later.
  void spread(std::vector<Smoothness>& smooth) const {
    for (bool changed = true; changed;) {
      changed = false;
      for (int b = 0; b < n_; ++b) {
        if (!feeds_through(b) && !block(b).sizes.history) continue;
        for (const int s : block(b).source) {
          const auto from = smooth[static_cast<std::size_t>(source_block(s))];
          if (from > smooth[static_cast<std::size_t>(b)]) {
            smooth[static_cast<std::size_t>(b)] = from;
            changed = true;
          }
        }
      }
    }
  }

  void check_rates() {
    for (int b = 0; b < n_; ++b) {
      if (!wants_rate(b)) continue;
      for (const int s : block(b).source) {
        const auto smooth = smoothness_[static_cast<std::size_t>(source_block(s))];
        const std::string from = graph_.signals[static_cast<std::size_t>(s)].path;
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

  std::string origin_of(int signal, Smoothness kind) const {
    const auto own = own_smoothness();
    std::vector<bool> seen(static_cast<std::size_t>(n_), false);
    std::function<std::string(int)> search = [&](int b) -> std::string {
      if (seen[static_cast<std::size_t>(b)]) return "";
      seen[static_cast<std::size_t>(b)] = true;
      if (own[static_cast<std::size_t>(b)] == kind)
        return fmt::format("{} \"{}\"", block(b).kernel->declaration.type, block(b).path);
      if (!feeds_through(b) && !block(b).sizes.history) return "";
      for (const int s : block(b).source)
        if (auto found = search(source_block(s)); !found.empty()) return found;
      return "";
    };
    return search(source_block(signal));
  }

  /// How an input of the diagram moves is known only when it is bound: remember whom its jumps would reach.
  void check_input_jumps() {
    for (const auto& [name, signal] : graph_.inputs) {
      auto smooth = own_smoothness();
      smooth[static_cast<std::size_t>(source_block(signal))] = Smoothness::jumps;
      spread(smooth);
      std::string reached;
      for (int b = 0; b < n_ && reached.empty(); ++b)
        if (wants_rate(b) && !follows_jumps(b))
          for (const int s : block(b).source)
            if (smooth[static_cast<std::size_t>(source_block(s))] != Smoothness::smooth) reached = block(b).path;
      program_.input_jump_reaches.push_back(reached);
    }
  }

  // --- nodes --------------------------------------------------------------------------------------------------------

  void need(int node) {
    if (needed_[static_cast<std::size_t>(node)]) return;
    needed_[static_cast<std::size_t>(node)] = true;
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
    for (const int next : std::vector<int>(edges)) need(next);
  }

  /// Memory and dead time wish the rate of their inputs (to locate reversals, to remember slopes); they run without it
  /// too.
  void wish_rates() {
    demanded_ = needed_;
    for (int b = 0; b < n_; ++b)
      if (block(b).sizes.memory > 0 || block(b).sizes.history)
        for (const int s : block(b).source)
          if (smoothness_[static_cast<std::size_t>(source_block(s))] != Smoothness::no_rate)
            need(rate(source_block(s)));
  }

  // --- loops and order ----------------------------------------------------------------------------------------------

  void tarjan() {
    order_.clear();
    in_loop_.assign(static_cast<std::size_t>(3 * n_), false);
    std::vector<int> index(static_cast<std::size_t>(3 * n_), -1), low(index), stack;
    std::vector<bool> on_stack(static_cast<std::size_t>(3 * n_), false);
    int counter = 0;
    struct Frame {
      int node;
      std::size_t next;
    };
    for (int root = 0; root < 3 * n_; ++root) {
      if (!needed_[static_cast<std::size_t>(root)] || index[static_cast<std::size_t>(root)] >= 0) continue;
      std::vector<Frame> frames{{root, 0}};
      while (!frames.empty()) {  // iterative: a chain of 100 000 blocks must not overflow the stack
        auto& f = frames.back();
        const auto v = static_cast<std::size_t>(f.node);
        if (f.next == 0) {
          index[v] = low[v] = counter++;
          stack.push_back(f.node);
          on_stack[v] = true;
        }
        if (f.next < edges_[v].size()) {
          const int to = edges_[v][f.next++];
          const auto w = static_cast<std::size_t>(to);
          if (index[w] < 0)
            frames.push_back({to, 0});
          else if (on_stack[w])
            low[v] = std::min(low[v], index[w]);
          continue;
        }
        if (low[v] == index[v]) emit_component(f.node, stack, on_stack);
        frames.pop_back();
        if (!frames.empty()) {
          const auto parent = static_cast<std::size_t>(frames.back().node);
          low[parent] = std::min(low[parent], low[v]);
        }
      }
    }
  }

  void emit_component(int root, std::vector<int>& stack, std::vector<bool>& on_stack) {
    std::vector<int> component;
    for (int node = -1; node != root;) {
      node = stack.back();
      stack.pop_back();
      on_stack[static_cast<std::size_t>(node)] = false;
      component.push_back(node);
    }
    const auto& self = edges_[static_cast<std::size_t>(root)];
    const bool loop = component.size() > 1 || std::find(self.begin(), self.end(), root) != self.end();
    if (loop) {
      for (const int node : component) in_loop_[static_cast<std::size_t>(node)] = true;
      if (demanded_.empty()) report_loop(component);
    }
    order_.insert(order_.end(), component.begin(), component.end());
  }

  void report_loop(const std::vector<int>& component) {
    // Follow edges inside the component until a node repeats, then print that cycle in the direction of the signals.
    std::vector<int> path{component.back()};
    const auto inside = [&](int node) {
      return std::find(component.begin(), component.end(), node) != component.end();
    };
    for (;;) {
      int next = -1;
      for (const int to : edges_[static_cast<std::size_t>(path.back())])
        if (inside(to)) next = to;
      const auto seen = std::find(path.begin(), path.end(), next);
      if (seen != path.end()) {
        path.erase(path.begin(), seen);
        break;
      }
      path.push_back(next);
    }
    std::reverse(path.begin(), path.end());
    path.push_back(path.front());
    std::string text;
    bool rates = false;
    for (const int node : path) {
      if (!text.empty()) text += " -> ";
      text += block(block_of(node)).path;
      if (node >= n_) text += node < 2 * n_ ? " (rate)" : " (derivative)";
      rates = rates || node >= n_;
    }
    const bool at_hits = hits_;
    problems_.add(
        "algebraic_loop", block(block_of(path.front())).origin,
        fmt::format("these blocks need each other's {} at the same {}instant: {}", rates ? "rate" : "value",
                    at_hits ? "sampling " : "", text),
        at_hits
            ? "put a unit delay into the loop (a delay_line of one sample), as the computation takes time in any case"
            : "put a block with a state into the loop (a lag, the amplifier's or sensor's dynamics), or use an "
              "inverse in closed form");
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

  std::vector<Step> steps(const std::vector<bool>& wanted) const {
    std::vector<Step> list;
    for (const int node : order_)
      if (wanted[static_cast<std::size_t>(node)])
        list.push_back({node < n_ ? Order::value : node < 2 * n_ ? Order::rate : Order::derivative, block_of(node)});
    return list;
  }

  void write_steps() {
    std::vector<int> derivatives, values, rates;
    for (int b = 0; b < n_; ++b) {
      values.push_back(value(b));
      if (stateful(b)) derivatives.push_back(derivative(b));
    }
    const std::vector<bool> all(static_cast<std::size_t>(3 * n_), true);
    const auto for_derivatives = closure(derivatives, all);
    program_.derivative_steps = steps(for_derivatives);
    program_.all_values = steps(closure(values, all));
    program_.has_rate.assign(graph_.signals.size(), false);
    const auto usable = usable_rates();
    for (int b = 0; b < n_; ++b)
      if (usable[static_cast<std::size_t>(rate(b))]) {
        rates.push_back(rate(b));
        for (std::size_t o = 0; o < block(b).output.size(); ++o)
          program_.has_rate[static_cast<std::size_t>(block(b).first_signal) + o] = true;
      }
    auto wanted = closure(rates, all);
    for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = wanted[i] && !for_derivatives[i];
    program_.rate_steps = steps(wanted);
    for (std::size_t s = 0; s < program_.signals.size(); ++s)
      program_.signals[s].smoothness = smoothness_[static_cast<std::size_t>(graph_.signals[s].block)];
  }

  /// The order of values at sampling instants, in which inputs of sampled blocks feed through. What is a loop there is
  /// none between the instants, and has no meaning: every block in it would have to be the first.
  void order_hits() {
    program_.hit_values = program_.all_values;
    if (program_.sampled_blocks.empty()) return;
    hits_ = true;
    demanded_.clear();
    for (auto& edges : edges_) edges.clear();
    needed_.assign(needed_.size(), false);
    for (int b = 0; b < n_; ++b) need(value(b));
    tarjan();
    problems_.throw_if_any();
    program_.hit_values = steps(needed_);
  }

  /// Rates that were needed and neither stand in a loop themselves nor hang on one.
  std::vector<bool> usable_rates() const {
    std::vector<bool> usable(static_cast<std::size_t>(3 * n_), false);
    for (const int node : order_) {  // dependencies come first
      bool ok = !in_loop_[static_cast<std::size_t>(node)];
      for (const int to : edges_[static_cast<std::size_t>(node)]) ok = ok && usable[static_cast<std::size_t>(to)];
      usable[static_cast<std::size_t>(node)] = ok;
    }
    return usable;
  }

  const Graph& graph_;
  Program& program_;
  int n_;
  std::vector<std::vector<int>> edges_;
  std::vector<bool> needed_, demanded_, in_loop_;
  std::vector<Smoothness> smoothness_;
  std::vector<int> order_;
  Problems problems_;
  bool hits_ = false;  // ordering for sampling instants
};

}  // namespace

void order_steps(const Graph& graph, Program& program) { Scheduler(graph, program).run(); }

}  // namespace hysteron
