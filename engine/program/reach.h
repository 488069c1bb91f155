// Decides which nodes of a directed graph lie on a way from its inputs to its outputs. Does not know what nodes are.
#pragma once

#include <cstddef>
#include <vector>

namespace hysteron {

class Reach {
 public:
  explicit Reach(int nodes) : moves_(index(nodes)), moved_by_(index(nodes)) {}
  void add(int from, int to) {
    moves_[index(from)].push_back(to);
    moved_by_[index(to)].push_back(from);
  }
  void enters(int node) { entries_.push_back(node); }
  void leaves(int node) { exits_.push_back(node); }

  /// Per node: an input moves it and an output sees it.
  std::vector<bool> between() const {
    auto list = reached(entries_, moves_);
    const auto seen = reached(exits_, moved_by_);
    for (std::size_t i = 0; i < list.size(); ++i) list[i] = list[i] && seen[i];
    return list;
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  static std::vector<bool> reached(std::vector<int> todo, const std::vector<std::vector<int>>& next) {
    std::vector<bool> in(next.size(), false);
    while (!todo.empty()) {
      const int node = todo.back();
      todo.pop_back();
      if (in[index(node)]) continue;
      in[index(node)] = true;
      todo.insert(todo.end(), next[index(node)].begin(), next[index(node)].end());
    }
    return in;
  }

  std::vector<std::vector<int>> moves_, moved_by_;
  std::vector<int> entries_, exits_;
};

}  // namespace hysteron
