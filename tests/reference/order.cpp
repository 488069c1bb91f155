#include "tests/reference/order.h"

#include <algorithm>
#include <map>

namespace reference {
namespace {

class Order {
 public:
  explicit Order(const std::vector<LawPointer>& laws) : needs(laws.size()), reaches(laws.size()) {
    std::map<int, int> writer;
    for (std::size_t b = 0; b < laws.size(); ++b)
      for (std::size_t i = 0; i < laws[b]->outputs().size(); ++i)
        writer[laws[b]->out + static_cast<int>(i)] = static_cast<int>(b);
    for (std::size_t b = 0; b < laws.size(); ++b)
      if (laws[b]->direct())
        for (const int i : laws[b]->in) needs[b].push_back(writer.at(i));
    for (std::size_t b = 0; b < laws.size(); ++b) reaches[b] = reached(static_cast<int>(b));
  }

  std::vector<Group> groups() {
    std::vector<Group> order;
    std::vector<bool> done(needs.size(), false);
    for (std::size_t placed = 0; placed < needs.size();) {
      for (std::size_t b = 0; b < needs.size(); ++b) {
        if (done[b] || !ready(static_cast<int>(b), done)) continue;
        order.push_back(group_of(static_cast<int>(b)));
        for (const int member : order.back().laws) done[member] = true;
        placed += order.back().laws.size();
      }
    }
    return order;
  }

 private:
  std::vector<bool> reached(int from) const {
    std::vector<bool> seen(needs.size(), false);
    std::vector<int> open = needs[from];
    while (!open.empty()) {
      const int b = open.back();
      open.pop_back();
      if (seen[b]) continue;
      seen[b] = true;
      open.insert(open.end(), needs[b].begin(), needs[b].end());
    }
    return seen;
  }

  bool together(int a, int b) const { return a == b || (reaches[a][b] && reaches[b][a]); }

  /// Is everything done that the loop of b needs from outside of it?
  bool ready(int b, const std::vector<bool>& done) const {
    for (std::size_t other = 0; other < needs.size(); ++other)
      if (reaches[b][other] && !done[other] && !together(b, static_cast<int>(other))) return false;
    return true;
  }

  Group group_of(int b) const {
    Group group;
    if (!reaches[b][b]) {
      group.laws = {b};
      return group;
    }
    std::vector<int> members;
    for (std::size_t other = 0; other < needs.size(); ++other)
      if (together(b, static_cast<int>(other))) members.push_back(static_cast<int>(other));
    for (const int tear : members)
      if (chain(members, tear, group.laws)) {
        group.tear = tear;
        return group;
      }
    throw Unknown("a loop in which one torn signal is not enough");
  }

  /// The members in order when the tear's output is given; false if they still need each other.
  bool chain(std::vector<int> members, int tear, std::vector<int>& order) const {
    order.clear();
    while (!members.empty()) {
      const auto next = std::find_if(members.begin(), members.end(), [&](int b) {
        return (b != tear || members.size() == 1) && std::all_of(needs[b].begin(), needs[b].end(), [&](int n) {
                 return n == tear || std::find(members.begin(), members.end(), n) == members.end();
               });
      });
      if (next == members.end()) return false;
      order.push_back(*next);
      members.erase(next);
    }
    return true;
  }

  std::vector<std::vector<int>> needs;
  std::vector<std::vector<bool>> reaches;
};

}  // namespace

std::vector<Group> evaluation_order(const std::vector<LawPointer>& laws) { return Order(laws).groups(); }

}  // namespace reference
