#include "engine/program/loop_plan.h"

#include <algorithm>
#include <numeric>

#include "engine/diagram/index.h"
#include "engine/program/tear.h"

namespace hysteron {
namespace {

class Planner {
 public:
  Planner(const Program& program, const std::vector<Step>& members, const std::vector<std::vector<int>>& needs,
          const std::vector<int>& wanted)
      : program_(program), wanted_(wanted) {
    // By name, so that the result is the same in whatever order the file lists the blocks. Where several signals come
    // together first, best in a sum: the error of a loop is the number that people know, and with a high gain it is the
    // small one, from which the others follow without cancellation.
    std::vector<int> sorted(members.size()), rank(members.size());
    const auto sources = [&](int b) {
      auto list = block(b).source;
      std::sort(list.begin(), list.end());
      return std::unique(list.begin(), list.end()) - list.begin();
    };
    std::iota(sorted.begin(), sorted.end(), 0);
    std::sort(sorted.begin(), sorted.end(), [&](int a, int b) {
      const auto& [order_a, block_a] = members[at(a)];
      const auto& [order_b, block_b] = members[at(b)];
      if (sources(block_a) != sources(block_b)) return sources(block_a) > sources(block_b);
      if (is_linear(block_a) != is_linear(block_b)) return is_linear(block_a);
      if (block_a != block_b) return block(block_a).path < block(block_b).path;
      return order_a < order_b;
    });
    for (std::size_t i = 0; i < sorted.size(); ++i) rank[at(sorted[i])] = static_cast<int>(i);
    for (const int i : sorted) {
      members_.push_back(members[at(i)]);
      needs_.emplace_back();
      for (const int j : needs[at(i)]) needs_.back().push_back(rank[at(j)]);
      std::sort(needs_.back().begin(), needs_.back().end());
    }
  }

  Loop operator()() {
    std::vector<int> cost;
    std::vector<bool> preferred;
    for (const auto& member : members_) {
      const auto slots = read_inside(member);
      cost.push_back(std::max(1, static_cast<int>(slots.size())));
      preferred.push_back(std::any_of(slots.begin(), slots.end(), [&](const Slot& s) {
        return s.order == Order::value && std::find(wanted_.begin(), wanted_.end(), s.index) != wanted_.end();
      }));
    }
    const Torn torn = tear(needs_, cost, preferred);
    Loop loop;
    for (const int i : torn.order) loop.steps.push_back(members_[at(i)]);
    for (const int i : torn.tears)
      for (const auto& slot : read_inside(members_[at(i)])) loop.tears.push_back(slot);
    for (const auto& member : members_) {
      if (std::find(loop.blocks.begin(), loop.blocks.end(), member.block) == loop.blocks.end())
        loop.blocks.push_back(member.block);
      add_outside(member, loop);
    }
    loop.path = path_around(members_, needs_, torn.tears.front());
    return loop;
  }

 private:
  const BlockInstance& block(int b) const { return program_.blocks[at(b)]; }
  bool is_linear(int b) const { return block(b).kernel->declaration.is_linear; }
  bool made_inside(Order order, int b) const {
    return std::any_of(members_.begin(), members_.end(),
                       [&](const Step& m) { return m.order == order && m.block == b; });
  }

  /// The numbers of a member that other members read.
  std::vector<Slot> read_inside(const Step& member) const {
    const BlockInstance& b = block(member.block);
    std::vector<Slot> slots;
    if (member.order == Order::derivative) {  // its own rate reads them
      for (int i = 0; i < b.sizes.states; ++i) slots.push_back({Order::derivative, b.x_begin + i});
      return slots;
    }
    for (int s = b.y_begin; s < b.y_begin + b.sizes.outputs; ++s)
      for (const auto& reader : members_) {
        const auto& sources = block(reader.block).source;
        if (std::find(sources.begin(), sources.end(), s) == sources.end()) continue;
        slots.push_back({member.order, s});
        break;
      }
    return slots;
  }

  void add_outside(const Step& member, Loop& loop) const {
    const BlockInstance& b = block(member.block);
    const auto add = [&](Order order, int owner, int index) {
      if (made_inside(order, owner)) return;
      const auto same = [&](const Slot& s) { return s.order == order && s.index == index; };
      if (std::none_of(loop.outside.begin(), loop.outside.end(), same)) loop.outside.push_back({order, index});
    };
    const bool derivative = member.order == Order::derivative;
    if (derivative || b.sizes.feedthrough)
      for (const int s : b.source) {
        const int from = program_.signals[at(s)].block;
        add(Order::value, from, s);
        if (derivative ? b.kernel->derivative_wants_rate : member.order == Order::rate) add(Order::rate, from, s);
      }
    if (member.order == Order::rate)
      for (int i = 0; i < b.sizes.states; ++i) add(Order::derivative, member.block, b.x_begin + i);
  }

  const Program& program_;
  const std::vector<int>& wanted_;
  std::vector<Step> members_;
  std::vector<std::vector<int>> needs_;
};

}  // namespace

Loop plan_loop(const Program& program, const std::vector<Step>& members, const std::vector<std::vector<int>>& needs,
               const std::vector<int>& wanted_tears) {
  return Planner(program, members, needs, wanted_tears)();
}

std::vector<Step> path_around(const std::vector<Step>& members, const std::vector<std::vector<int>>& needs, int first) {
  // Breadth first against the direction of the signals, so the way around is a shortest one.
  std::vector<int> towards(members.size(), -1), queue{first};
  for (std::size_t k = 0; k < queue.size(); ++k)
    for (const int from : needs[at(queue[k])]) {
      if (towards[at(from)] >= 0) continue;
      towards[at(from)] = queue[k];
      if (from == first) {
        std::vector<Step> path{members[at(first)]};
        for (int i = towards[at(first)]; i != first; i = towards[at(i)]) path.push_back(members[at(i)]);
        path.push_back(members[at(first)]);
        return path;
      }
      queue.push_back(from);
    }
  return {members[at(first)]};
}

std::string to_text(const Program& program, const std::vector<Step>& path) {
  std::string text;
  for (const auto& step : path) {
    if (!text.empty()) text += " -> ";
    text += program.blocks[at(step.block)].path;
    if (step.order == Order::rate) text += " (rate)";
    if (step.order == Order::derivative) text += " (derivative)";
  }
  return text;
}

}  // namespace hysteron
