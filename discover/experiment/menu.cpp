// Decides what is told of the experiments that competed for a tie. See menu.h.
#include "discover/experiment/menu.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace hysteron {
namespace {

bool same_item(const MenuItem& a, const MenuItem& b) {
  return a.word == b.word && a.drive == b.drive && a.slower == b.slower && a.part == b.part &&
         a.faster_rows == b.faster_rows && a.as_recorded == b.as_recorded && a.simulated() == b.simulated();
}

bool simulates(const Menu& menu, const std::string& word) {
  return std::any_of(menu.items.begin(), menu.items.end(),
                     [&](const MenuItem& item) { return item.word == word && item.simulated(); });
}

std::string why_chosen(const MenuItem& chosen, std::size_t pairs) {
  if (chosen.pairs_told == 0) return "none tells them apart by more than the noise; this one separates most";
  const bool all = chosen.pairs_told == static_cast<int>(pairs);
  const std::string whom = all ? (pairs == 1 ? "tells them apart" : "tells all apart")
                               : fmt::format("tells most apart, {} of {} pairs", chosen.pairs_told, pairs);
  if (chosen.as_recorded) return whom + ", and moves nothing faster than was recorded";
  return whom + (chosen.asked ? ", and is what these effects name for each other" : ", and separates most");
}

/// In the order of the rules by which one is chosen. Two menus that are sampled differently are compared by whom they
/// tell from the winner and how far.
std::string why_not(const MenuItem& item, const MenuItem& chosen) {
  const bool one_menu = item.faster_rows == chosen.faster_rows;
  if (item.rivals_told < chosen.rivals_told)
    return item.rivals_told == 0 ? "separates no other effect from the best one by more than the noise"
                                 : "tells fewer from the winner";
  if (one_menu && item.pairs_told < chosen.pairs_told) return "separates fewer of the others from each other";
  if (one_menu && chosen.asked && !item.asked) return "the one chosen is what these effects name for each other";
  if (item.separation < chosen.separation) return "separates less";
  if (one_menu && chosen.as_recorded && !item.as_recorded)
    return "may move faster than was recorded, and the one chosen tells as much";
  return one_menu ? "separates no more than the one chosen, which came before"
                  : "sampled otherwise than the one chosen";
}

}  // namespace

void give_reasons(Menu& menu) {
  const auto chosen =
      std::find_if(menu.items.begin(), menu.items.end(), [](const MenuItem& item) { return item.chosen; });
  if (chosen == menu.items.end()) return;
  for (auto& item : menu.items)
    if (item.separation >= 0 && !item.chosen) item.reason = why_not(item, *chosen);
  chosen->reason = why_chosen(*chosen, menu.pairs.size());
}

Menu without_choice(Menu menu) {
  for (auto& item : menu.items) item.chosen = false;
  return menu;
}

void add_items(Menu& menu, Menu further) {
  if (menu.pairs.empty()) menu.pairs = further.pairs;
  const auto is_chosen = [](const MenuItem& item) { return item.chosen; };
  if (std::any_of(further.items.begin(), further.items.end(), is_chosen)) menu = without_choice(std::move(menu));
  std::erase_if(menu.items, [&](const MenuItem& item) { return !item.simulated() && simulates(further, item.word); });
  std::erase_if(further.items, [&](const MenuItem& item) {
    return std::any_of(menu.items.begin(), menu.items.end(),
                       [&](const MenuItem& other) { return same_item(other, item); }) ||
           (!item.simulated() && simulates(menu, item.word));
  });
  std::move(further.items.begin(), further.items.end(), std::back_inserter(menu.items));
  give_reasons(menu);
}

}  // namespace hysteron
