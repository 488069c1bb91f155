// Decides where the laws that stand begin when another one joins them. A law that was fitted alone went where it took
// most of what others did: beside them it begins anew.
#include <fmt/format.h>

#include <algorithm>

#include "discover/books.h"

namespace hysteron {
namespace {

constexpr std::size_t asked = 3;  ///< candidates beside which the others begin anew

/// The law can be at several places of its own, of which a search from one sees that one only.
bool has_beginnings(const Standing& s) {
  return std::any_of(s.law.free.begin(), s.law.free.end(), [](const LawParameter& p) {
    return p.scan.size() > 1 && p.line_bands.empty() && !p.per_recording;
  });
}

}  // namespace

Contender begun_anew(const Books& books, const Workshop& shop, Contender c) {
  for (std::size_t i = 0; i + 1 < c.standing.size() && !books.stopped(); ++i) {
    if (books.evidence->over_usual_floor(c.prediction).all <= rules::floor_gate) break;
    if (!has_beginnings(c.standing[i])) continue;
    Contender again = refit(shop, c, Effort::full, static_cast<int>(i));
    if (again.ok && again.score() < c.score() - rules::alike) c = std::move(again);
  }
  return c;
}

void let_others_begin_anew(Books& books, std::vector<Tried>& tried, double bar) {
  auto order = ranking(tried);
  std::erase_if(order, [&](std::size_t i) { return !(tried[i].contender.score() < books.current.score()); });
  order.resize(std::min(order.size(), asked));
  books.side_by_side(order.size(), [&](std::size_t k, const Workshop& shop) {
    Tried& t = tried[order[k]];
    books.progress(fmt::format("the others anew beside {}", t.effect->id), bar);
    t.contender = begun_anew(books, shop, std::move(t.contender));
    return false;
  });
}

}  // namespace hysteron
