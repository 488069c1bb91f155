#include "engine/program/components.h"

#include <algorithm>

namespace hysteron {

std::vector<std::vector<int>> strong_components(const std::vector<std::vector<int>>& needs) {
  std::vector<int> index(needs.size(), -1), low(needs.size(), -1), stack;
  std::vector<bool> on_stack(needs.size(), false);
  std::vector<std::vector<int>> components;
  struct Frame {
    int node;
    std::size_t next;  // of its needs
  };
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  int counter = 0;
  for (int root = 0; root < static_cast<int>(needs.size()); ++root) {
    if (index[at(root)] >= 0) continue;
    std::vector<Frame> frames{{root, 0}};
    while (!frames.empty()) {
      Frame& frame = frames.back();
      const int node = frame.node;
      if (frame.next == 0) {
        index[at(node)] = low[at(node)] = counter++;
        stack.push_back(node);
        on_stack[at(node)] = true;
      }
      if (frame.next < needs[at(node)].size()) {
        const int to = needs[at(node)][frame.next++];
        if (index[at(to)] < 0)
          frames.push_back({to, 0});
        else if (on_stack[at(to)])
          low[at(node)] = std::min(low[at(node)], index[at(to)]);
        continue;
      }
      if (low[at(node)] == index[at(node)]) {
        components.emplace_back();
        for (int member = -1; member != node;) {
          member = stack.back();
          stack.pop_back();
          on_stack[at(member)] = false;
          components.back().push_back(member);
        }
      }
      frames.pop_back();
      if (!frames.empty()) low[at(frames.back().node)] = std::min(low[at(frames.back().node)], low[at(node)]);
    }
  }
  return components;
}

}  // namespace hysteron
