#include "app/facts/program_facts.h"

#include <algorithm>
#include <functional>
#include <set>

#include "engine/diagram/index.h"
#include "engine/program/components.h"

namespace hysteron {
namespace {

bool depends_at_once(const BlockInstance& b) { return b.sizes.feedthrough && !b.kernel->is_sampled(); }

/// Per block: the blocks that read it.
std::vector<std::vector<int>> readers(const Program& program) {
  std::vector<std::vector<int>> list(program.blocks.size());
  for (std::size_t b = 0; b < program.blocks.size(); ++b)
    for (const int s : program.blocks[b].source) {
      auto& of = list[at(program.signals[at(s)].block)];
      if (of.empty() || of.back() != static_cast<int>(b)) of.push_back(static_cast<int>(b));
    }
  return list;
}

/// The shortest way from a block back to itself, which there is. `from`: one -1 for each block, and so again
/// afterwards.
std::vector<int> way_around(const std::vector<std::vector<int>>& next, int start, std::vector<int>& from) {
  std::vector<int> todo{start}, way;
  for (std::size_t k = 0; way.empty(); ++k)
    for (const int to : next[at(todo[k])]) {
      if (to == start) {
        for (int b = todo[k]; b != start; b = from[at(b)]) way.push_back(b);
        way.push_back(start);
        std::reverse(way.begin(), way.end());
        break;
      }
      if (from[at(to)] < 0) from[at(to)] = todo[k], todo.push_back(to);
    }
  for (const int b : todo) from[at(b)] = -1;
  return way;
}

/// Per block: the blocks that it reaches and that reach it, in so far as they read each other; empty where it is in no
/// loop.
std::vector<std::vector<int>> readers_in_loops(const std::vector<std::vector<int>>& next) {
  std::vector<int> knot(next.size());
  const auto components = strong_components(next);
  for (std::size_t c = 0; c < components.size(); ++c)
    for (const int b : components[c]) knot[at(b)] = static_cast<int>(c);
  std::vector<std::vector<int>> inside(next.size());
  for (std::size_t b = 0; b < next.size(); ++b)
    for (const int to : next[b])
      if (knot[at(to)] == knot[b]) inside[b].push_back(to);
  return inside;
}

}  // namespace

std::vector<FeedbackLoop> feedback_loops(const Program& program) {
  const auto next = readers_in_loops(readers(program));
  std::vector<FeedbackLoop> list;
  std::vector<bool> done(program.blocks.size(), false);
  std::vector<int> from(program.blocks.size(), -1), todo;
  for (std::size_t b = 0; b < program.blocks.size(); ++b) {
    if (done[b] || next[b].empty()) continue;
    FeedbackLoop loop;
    loop.blocks = way_around(next, static_cast<int>(b), from);
    for (const int k : loop.blocks)
      if (!depends_at_once(program.blocks[at(k)])) loop.opened_by.push_back(k);
    // The others that reach each other with this block belong to the same knot of loops.
    for (todo = {static_cast<int>(b)}; !todo.empty();) {
      const int k = todo.back();
      todo.pop_back();
      if (done[at(k)]) continue;
      done[at(k)] = true;
      todo.insert(todo.end(), next[at(k)].begin(), next[at(k)].end());
    }
    list.push_back(std::move(loop));
  }
  return list;
}

std::vector<NeededRate> needed_rates(const Program& program) {
  std::set<int> computed;  // blocks
  const std::function<void(const std::vector<Step>&)> look = [&](const std::vector<Step>& steps) {
    for (const auto& step : steps) {
      if (step.order == Order::rate) computed.insert(step.block);
      if (step.order == Order::loop) look(program.loops[at(step.block)].steps);
    }
  };
  look(program.derivative_steps);
  look(program.rate_steps);
  std::vector<std::vector<int>> readers_of(program.signals.size());
  for (std::size_t b = 0; b < program.blocks.size(); ++b)
    for (const int s : program.blocks[b].source)
      if (auto& of = readers_of[at(s)]; of.empty() || of.back() != static_cast<int>(b))
        of.push_back(static_cast<int>(b));
  std::vector<NeededRate> list;
  for (std::size_t s = 0; s < program.signals.size(); ++s) {
    if (!computed.contains(program.signals[s].block)) continue;
    NeededRate rate;
    rate.signal = static_cast<int>(s);
    for (const int b : readers_of[s]) {
      const auto& block = program.blocks[at(b)];
      if (block.kernel->derivative_wants_rate) rate.asked_by.push_back(block.path + " (its law is driven by the rate)");
      if (block.kernel->guard_wants_rate) rate.asked_by.push_back(block.path + " (its change of mode depends on it)");
      if (block.sizes.memory > 0) rate.asked_by.push_back(block.path + " (to locate reversals)");
      if (block.sizes.history) rate.asked_by.push_back(block.path + " (to remember slopes)");
      if (computed.contains(b) && depends_at_once(block)) rate.asked_by.push_back(block.path + " (for its own rate)");
    }
    if (!rate.asked_by.empty()) list.push_back(std::move(rate));
  }
  return list;
}

std::vector<ClockFacts> clock_facts(const Program& program) {
  std::vector<ClockFacts> list;
  for (const int b : program.sampled_blocks) {
    const auto& block = program.blocks[at(b)];
    const auto number = [&](const char* name) {
      const int i = block.kernel->declaration.parameter_index(name);
      return i < 0 ? 0.0 : program.p[at(block.p_begin + block.p_at[at(i)])];
    };
    const double period = number("period"), offset = number("offset");
    const auto same = [&](const ClockFacts& c) { return c.period == period && c.offset == offset; };
    auto clock = std::find_if(list.begin(), list.end(), same);
    if (clock == list.end()) clock = list.insert(list.end(), ClockFacts{period, offset, {}});
    clock->blocks.push_back(b);
  }
  return list;
}

std::string origin_text(const std::string& origin) {
  if (origin.empty()) return "default";
  if (origin.starts_with("--")) return origin.substr(0, origin.find(' '));
  const auto hash = origin.find('#');
  if (hash == std::string::npos) return "diagram " + origin;
  const std::string pointer = origin.substr(hash + 1);
  const bool diagram = pointer.starts_with("/blocks/") || pointer.starts_with("/parameters/");
  return (diagram ? "diagram " : "parameter set ") + origin.substr(0, hash) + " " + pointer;
}

}  // namespace hysteron
