#include "engine/program/tear.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include "engine/diagram/index.h"

namespace hysteron {
namespace {

class Tearing {
 public:
  Tearing(std::vector<std::vector<int>> needs, const std::vector<int>& cost, const std::vector<bool>& preferred)
      : needs_(std::move(needs)),
        cost_(cost),
        preferred_(preferred),
        n_(static_cast<int>(needs_.size())),
        readers_(needs_.size()) {
    for (auto& list : needs_) drop_repeated(list);
    for (int i = 0; i < n_; ++i)
      for (const int j : needs_[at(i)]) readers_[at(j)].push_back(i);
  }

  Torn operator()() {
    cut_ = preferred_;
    active_.assign(at(n_), true);
    for (int i = 0; i < n_; ++i)
      if (cut_[at(i)]) active_[at(i)] = false;
    for (;;) {
      strip();
      const int next = choose();
      if (next < 0) break;
      cut_[at(next)] = true;
      active_[at(next)] = false;
    }
    for (int i = 0; i < n_; ++i) {
      if (!cut_[at(i)] || preferred_[at(i)]) continue;
      cut_[at(i)] = false;
      cut_[at(i)] = sorted().size() + count_cuts() < at(n_);
    }
    Torn torn;
    torn.order = sorted();
    for (int i = 0; i < n_; ++i)
      if (cut_[at(i)]) torn.tears.push_back(i);
    torn.order.insert(torn.order.end(), torn.tears.begin(), torn.tears.end());
    return torn;
  }

 private:
  std::size_t count_cuts() const { return static_cast<std::size_t>(std::count(cut_.begin(), cut_.end(), true)); }

  long active_of(const std::vector<int>& nodes) const {
    return std::count_if(nodes.begin(), nodes.end(), [&](int j) { return active_[at(j)]; });
  }
  static void drop_repeated(std::vector<int>& nodes) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }

  /// A node that nothing active needs, or that needs nothing active, stands in no cycle.
  void strip() {
    std::vector<int> todo;
    for (int i = 0; i < n_; ++i) todo.push_back(i);
    while (!todo.empty()) {
      const int i = todo.back();
      todo.pop_back();
      if (!active_[at(i)] || (active_of(needs_[at(i)]) > 0 && active_of(readers_[at(i)]) > 0)) continue;
      active_[at(i)] = false;
      todo.insert(todo.end(), needs_[at(i)].begin(), needs_[at(i)].end());
      todo.insert(todo.end(), readers_[at(i)].begin(), readers_[at(i)].end());
    }
  }

  int choose() const {
    int best = -1;
    double most = -1;
    for (int i = 0; i < n_; ++i) {
      if (!active_[at(i)]) continue;
      const auto& own = needs_[at(i)];
      if (std::find(own.begin(), own.end(), i) != own.end()) return i;  // no other cut would open this cycle
      const double ways = static_cast<double>(active_of(own) * active_of(readers_[at(i)])) / cost_[at(i)];
      if (ways > most) most = ways, best = i;
    }
    return best;
  }

  /// The nodes that are not cut, each behind what it needs; those in a cycle are missing.
  std::vector<int> sorted() const {
    std::vector<int> waiting(at(n_), 0), order;
    std::priority_queue<int, std::vector<int>, std::greater<>> ready;
    for (int i = 0; i < n_; ++i) {
      for (const int j : needs_[at(i)]) waiting[at(i)] += cut_[at(j)] ? 0 : 1;
      if (!cut_[at(i)] && waiting[at(i)] == 0) ready.push(i);
    }
    while (!ready.empty()) {
      const int i = ready.top();
      ready.pop();
      order.push_back(i);
      for (const int reader : readers_[at(i)])
        if (--waiting[at(reader)] == 0 && !cut_[at(reader)]) ready.push(reader);
    }
    return order;
  }

  std::vector<std::vector<int>> needs_;
  const std::vector<int>& cost_;
  const std::vector<bool>& preferred_;
  int n_;
  std::vector<std::vector<int>> readers_;
  std::vector<bool> cut_, active_;
};

}  // namespace

Torn tear(const std::vector<std::vector<int>>& needs, const std::vector<int>& cost,
          const std::vector<bool>& preferred) {
  return Tearing(needs, cost, preferred)();
}

}  // namespace hysteron
