// Feedback and columns. Wires that close a loop are found by a walk along the signals from the sources: a wire that
// leads back to a block on the way is feedback. Where a walk begins decides which wire of a loop that is; every source
// is tried as the first, and the one is kept whose feedback ends most often at a minus of a sum, as an engineer would
// draw it.
#include "draw/columns.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace hysteron::draw {
namespace {

constexpr std::size_t starts_tried = 32;  // a bound for large diagrams

using Indices = std::vector<std::vector<int>>;  ///< wires per item

Indices wires_from(const Sheet& sheet) {
  Indices list(sheet.items.size());
  for (std::size_t w = 0; w < sheet.wires.size(); ++w)
    list[static_cast<std::size_t>(sheet.wires[w].from)].push_back(static_cast<int>(w));
  return list;
}

class Walk {
 public:
  Walk(const Sheet& sheet, const Indices& out) : sheet_(sheet), out_(out), state_(sheet.items.size(), State::fresh) {}

  std::vector<bool> feedback(const std::vector<int>& starts) {
    std::vector<bool> back(sheet_.wires.size(), false);
    for (const int start : starts)
      if (state_[static_cast<std::size_t>(start)] == State::fresh) from(start, back);
    return back;
  }

 private:
  enum class State { fresh, on_the_way, done };
  struct Place {
    int item;
    std::size_t next;
  };

  void from(int start, std::vector<bool>& back) {
    std::vector<Place> way{{start, 0}};  // a list instead of recursion: a chain may have thousands of blocks
    state_[static_cast<std::size_t>(start)] = State::on_the_way;
    while (!way.empty()) {
      auto& [item, next] = way.back();
      const auto& wires = out_[static_cast<std::size_t>(item)];
      if (next == wires.size()) {
        state_[static_cast<std::size_t>(item)] = State::done;
        way.pop_back();
        continue;
      }
      const auto wire = static_cast<std::size_t>(wires[next++]);
      const int to = sheet_.wires[wire].to;
      auto& state = state_[static_cast<std::size_t>(to)];
      if (state == State::on_the_way) back[wire] = true;
      if (state != State::fresh) continue;
      state = State::on_the_way;
      way.push_back({to, 0});
    }
  }

  const Sheet& sheet_;
  const Indices& out_;
  std::vector<State> state_;
};

/// Feedback into a minus of a sum is what one expects; anything else is drawn only where nothing better is found.
int cost(const Sheet& sheet, const std::vector<bool>& back) {
  int total = 0;
  for (std::size_t w = 0; w < back.size(); ++w) {
    if (!back[w]) continue;
    const Wire& wire = sheet.wires[w];
    const std::string& signs = sheet.items[static_cast<std::size_t>(wire.to)].symbol.signs;
    const auto port = static_cast<std::size_t>(wire.in);
    total += signs.empty() ? 4 : port < signs.size() && signs[port] == '-' ? 1 : 3;
  }
  return total;
}

}  // namespace

void find_feedback(Sheet& sheet) {
  const Indices out = wires_from(sheet);
  std::vector<bool> has_input(sheet.items.size(), false);
  for (const auto& wire : sheet.wires) has_input[static_cast<std::size_t>(wire.to)] = true;
  std::vector<int> starts;
  for (std::size_t i = 0; i < sheet.items.size(); ++i)
    if (!has_input[i]) starts.push_back(static_cast<int>(i));
  const std::size_t sources = starts.size();
  for (std::size_t i = 0; i < sheet.items.size(); ++i)
    if (has_input[i]) starts.push_back(static_cast<int>(i));

  std::vector<bool> best;
  int least = std::numeric_limits<int>::max();
  // A diagram without sources is a ring: then every block is tried.
  const std::size_t tried = std::min(sources > 0 ? sources : starts.size(), starts_tried);
  for (std::size_t first = 0; first < std::max<std::size_t>(tried, 1) && first < starts.size(); ++first) {
    std::vector<int> order = starts;
    std::rotate(order.begin(), order.begin() + static_cast<long>(first), order.begin() + static_cast<long>(first) + 1);
    auto back = Walk(sheet, out).feedback(order);
    const int price = cost(sheet, back);
    if (price < least) least = price, best = std::move(back);
  }
  for (std::size_t w = 0; w < sheet.wires.size(); ++w) sheet.wires[w].feedback = best[w];
}

void assign_columns(Sheet& sheet) {
  const std::size_t n = sheet.items.size();
  const Indices out = wires_from(sheet);
  std::vector<int> waiting(n, 0);
  for (const auto& wire : sheet.wires)
    if (!wire.feedback) ++waiting[static_cast<std::size_t>(wire.to)];
  std::vector<int> inputs = waiting;
  std::vector<int> ready;
  for (std::size_t i = 0; i < n; ++i)
    if (waiting[i] == 0) ready.push_back(static_cast<int>(i));
  for (std::size_t at = 0; at < ready.size(); ++at) {  // longest way from the left
    const auto from = static_cast<std::size_t>(ready[at]);
    for (const int w : out[from]) {
      const Wire& wire = sheet.wires[static_cast<std::size_t>(w)];
      if (wire.feedback) continue;
      Item& to = sheet.items[static_cast<std::size_t>(wire.to)];
      to.column = std::max(to.column, sheet.items[from].column + 1);
      if (--waiting[static_cast<std::size_t>(wire.to)] == 0) ready.push_back(wire.to);
    }
  }
  // A source stands just before the first block that reads it; inputs stand at the left, outputs at the right.
  int last = 0;
  for (std::size_t i = 0; i < n; ++i) {
    Item& item = sheet.items[i];
    if (inputs[i] == 0 && item.type != "input") {
      int first = std::numeric_limits<int>::max();
      for (const int w : out[i]) {
        const Wire& wire = sheet.wires[static_cast<std::size_t>(w)];
        if (!wire.feedback) first = std::min(first, sheet.items[static_cast<std::size_t>(wire.to)].column);
      }
      if (first != std::numeric_limits<int>::max()) item.column = first - 1;
    }
    last = std::max(last, item.column);
  }
  for (auto& item : sheet.items)
    if (item.type == "output") item.column = last;
}

std::vector<Net> nets_of(const Sheet& sheet) {
  std::vector<Net> nets;
  for (std::size_t w = 0; w < sheet.wires.size(); ++w) {
    const Wire& wire = sheet.wires[w];
    const auto same = [&](const Net& net) { return net.item == wire.from && net.out == wire.out; };
    auto net = std::find_if(nets.begin(), nets.end(), same);
    if (net == nets.end()) net = nets.insert(nets.end(), Net{wire.from, wire.out, {}});
    net->wires.push_back(static_cast<int>(w));
  }
  return nets;
}

}  // namespace hysteron::draw
