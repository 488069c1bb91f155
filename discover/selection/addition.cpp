#include "discover/selection/addition.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "discover/wiring/wiring.h"

namespace hysteron {
namespace {

/// Type of the block that the effect varies there; "" where it stands on a wire.
std::string varied_type(const SearchState& state, const TriedEffect& t) {
  if (t.effect->way != Way::vary && t.place.by.empty()) return "";
  const Node* body = Wiring(state.current.diagram, state.registry).body(t.place.at);
  return body == nullptr ? "" : body->type;
}

}  // namespace

double ln_tried(const std::vector<Addition>& rivals, const Effect& effect) {
  double n = 0;
  for (const auto& r : rivals)
    if (r.tried.effect == &effect) n += static_cast<double>(std::max<std::size_t>(r.tried.laws.size(), 1));
  return std::log(std::max(n, 1.0));
}

std::vector<Choice> term_of(const Addition& rival, std::size_t law) {
  std::vector<Choice> term{{rival.tried.effect, rival.tried.laws[law], rival.tried.place, rival.tried.excitation}};
  for (const auto& t : rival.also)
    term.push_back({t.effect, t.laws[std::min(law, t.laws.size() - 1)], t.place, t.excitation});
  return term;
}

std::vector<Choice> richer_term_of(const Addition& rival, std::size_t law) {
  auto term = term_of(rival, law);
  const CandidateModel& from = rival.fitted.model;
  for (std::size_t k = 0; k < term.size(); ++k) {
    if (term[k].law.apart) continue;
    for (const auto& p : parameters_of(from, static_cast<int>(from.placed.size() - term.size() + k))) {
      if (p.estimate == nullptr || p.estimate->linear) continue;
      for (auto& q : term[k].law.free)
        if (q.path == p.law->path) {
          q.start = p.estimate->used;
          q.scan = {p.estimate->used, p.estimate->used / 2};
        }
    }
  }
  return term;
}

std::vector<Addition> at_like_places(const SearchState& state, const std::vector<Addition>& alone) {
  std::map<std::pair<std::string, std::string>, Addition> groups;  // effect, type
  for (const auto& a : alone) {
    const std::string type = varied_type(state, a.tried);
    if (type.empty()) continue;
    const auto [group, is_new] = groups.try_emplace({a.tried.effect->id, type}, a);
    if (!is_new) group->second.also.push_back(a.tried);
  }
  std::vector<Addition> at_all;
  for (auto& [key, group] : groups)
    if (!group.also.empty()) at_all.push_back(std::move(group));
  return at_all;
}

std::set<const Effect*> names_of(const CandidateModel& model) {
  std::set<const Effect*> names;
  for (const auto& standing : model.placed) names.insert(standing.effect);
  return names;
}

bool is_plainer(const Effect& one, const Effect& other) {
  const auto lists = [&](const std::vector<std::string>& ids) {
    return std::find(ids.begin(), ids.end(), one.id) != ids.end();
  };
  return lists(other.plainer) || (one.straight && lists(other.contains));
}

std::string why_not_itself(const TableModel& fitted) {
  return fitted.model.placed.empty() ? "" : why_implausible(fitted.model, fitted.model.placed.size() - 1);
}

}  // namespace hysteron
