// Decides what is recorded of the generic structures that competed. See structures_tried.h.
#include "discover/search/structures_tried.h"

#include <fmt/format.h>

#include <utility>

namespace hysteron {
namespace {

std::string why_not_the_best(const Structure& s, const Structure* best, Where where) {
  if (over(s.fall, where) <= 0) return "takes nothing away that its own numbers do not cost";
  if (best == nullptr) return "takes nothing away";
  if (over(best->fall, where) <= over(s.fall, where))
    return fmt::format("{} over {} takes as much away, and more in all recordings", best->kind, best->variable);
  return fmt::format("{} over {} in {} takes {:.0f} of chi2 away", best->kind, best->variable, best->output,
                     over(best->fall, where));
}

}  // namespace

void keep_structures(Discovery& d, const JudgedSearch& judged, LeftBy left_by, const std::string& why_told) {
  const Structure* best = judged.search.winner();
  for (const Structure& s : judged.search.list) {
    TriedStructure tried;
    tried.structure = s;
    tried.structure.intervals.clear();
    tried.left_by = left_by;
    tried.where = judged.where;
    if (&s == best) {
      tried.needed = judged.requirement.needed;
      tried.told = !why_told.empty();
      tried.reason = tried.told ? why_told : judged.requirement.why_not;
    } else {
      tried.reason = why_not_the_best(s, best, judged.where);
    }
    d.structures.push_back(std::move(tried));
  }
}

}  // namespace hysteron
