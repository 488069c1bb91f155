#include "app/facts/program_facts.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <set>

#include "engine/diagram/index.h"

namespace hysteron {
namespace {

bool depends_at_once(const BlockInstance& b) { return b.sizes.feedthrough && !b.kernel->is_sampled(); }

/// Per block: the blocks that read it.
std::vector<std::vector<int>> readers(const Program& program) {
  std::vector<std::vector<int>> list(program.blocks.size());
  for (std::size_t b = 0; b < program.blocks.size(); ++b)
    for (const int s : program.blocks[b].source) {
      auto& of = list[at(program.signals[at(s)].block)];
      if (std::find(of.begin(), of.end(), static_cast<int>(b)) == of.end()) of.push_back(static_cast<int>(b));
    }
  return list;
}

std::vector<bool> reached_from(const std::vector<std::vector<int>>& next, int start) {
  std::vector<bool> seen(next.size(), false);
  std::vector<int> todo{start};
  while (!todo.empty()) {
    const int b = todo.back();
    todo.pop_back();
    for (const int to : next[at(b)])
      if (!seen[at(to)]) seen[at(to)] = true, todo.push_back(to);
  }
  return seen;
}

/// The shortest way from a block back to itself.
std::vector<int> way_around(const std::vector<std::vector<int>>& next, int start) {
  std::vector<int> from(next.size(), -1);
  std::deque<int> todo{start};
  while (!todo.empty()) {
    const int b = todo.front();
    todo.pop_front();
    for (const int to : next[at(b)]) {
      if (to == start) {
        std::vector<int> way;
        for (int k = b; k != start; k = from[at(k)]) way.push_back(k);
        way.push_back(start);
        std::reverse(way.begin(), way.end());
        return way;
      }
      if (from[at(to)] < 0) from[at(to)] = b, todo.push_back(to);
    }
  }
  return {};
}

}  // namespace

std::vector<FeedbackLoop> feedback_loops(const Program& program) {
  const auto next = readers(program);
  std::vector<FeedbackLoop> list;
  std::vector<bool> done(program.blocks.size(), false);
  for (std::size_t b = 0; b < program.blocks.size(); ++b) {
    if (done[b] || next[b].empty()) continue;
    const auto ahead = reached_from(next, static_cast<int>(b));
    if (!ahead[b]) continue;
    FeedbackLoop loop;
    loop.blocks = way_around(next, static_cast<int>(b));
    for (const int k : loop.blocks)
      if (!depends_at_once(program.blocks[at(k)])) loop.opened_by.push_back(k);
    // The others that reach each other with this block belong to the same knot of loops.
    for (std::size_t k = 0; k < program.blocks.size(); ++k)
      if (ahead[k] && !done[k] && reached_from(next, static_cast<int>(k))[b]) done[k] = true;
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
  std::vector<NeededRate> list;
  for (std::size_t s = 0; s < program.signals.size(); ++s) {
    if (!computed.contains(program.signals[s].block)) continue;
    NeededRate rate;
    rate.signal = static_cast<int>(s);
    for (std::size_t b = 0; b < program.blocks.size(); ++b) {
      const auto& block = program.blocks[b];
      if (std::find(block.source.begin(), block.source.end(), static_cast<int>(s)) == block.source.end()) continue;
      if (block.kernel->derivative_wants_rate) rate.asked_by.push_back(block.path + " (its law is driven by the rate)");
      if (block.kernel->guard_wants_rate) rate.asked_by.push_back(block.path + " (its change of mode depends on it)");
      if (block.sizes.memory > 0) rate.asked_by.push_back(block.path + " (to locate reversals)");
      if (block.sizes.history) rate.asked_by.push_back(block.path + " (to remember slopes)");
      if (computed.contains(static_cast<int>(b)) && depends_at_once(block))
        rate.asked_by.push_back(block.path + " (for its own rate)");
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
