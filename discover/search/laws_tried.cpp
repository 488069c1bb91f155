// Decides what is recorded of the laws of a candidate while they compete. See laws_tried.h.
#include "discover/search/laws_tried.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace hysteron {

TriedLaw tried_law(const Law& law, const CandidateModel& fitted, const ModelError& before) {
  TriedLaw tried;
  tried.law = law.name;
  tried.failed = !fitted.ok;
  if (!fitted.ok) {
    tried.reason = "could not be fitted: " + fitted.error;
    return tried;
  }
  tried.parameters = fitted.parameters;
  tried.fall_train = before.evidence_train - fitted.error_of.evidence_train;
  tried.fall_validate = before.evidence_validate - fitted.error_of.evidence_validate;
  tried.fall_by_recording = fall_by_recording(before, fitted.error_of);
  tried.score = fitted.score();
  return tried;
}

void record_present(TriedEffect& t, const ModelError& before) {
  TriedLaw present = tried_law(t.laws[t.law], t.candidate, before);
  present.taken = !present.failed;
  const auto known =
      std::find_if(t.laws_tried.begin(), t.laws_tried.end(), [](const TriedLaw& law) { return law.taken; });
  if (known != t.laws_tried.end())
    *known = std::move(present);
  else
    t.laws_tried.push_back(std::move(present));
}

void record(std::vector<TriedLaw>& laws, TriedLaw tried) {
  for (auto& law : laws)
    if (law.taken && tried.taken) {
      law.taken = false;
      law.reason = fmt::format("{} takes the score {:.1f} further down", tried.law, law.score - tried.score);
    }
  laws.push_back(std::move(tried));
}

std::string why_no_better(const CandidateModel& fitted, const CandidateModel& present, const Law& present_law,
                          double for_the_same) {
  if (fitted.score() < present.score() - for_the_same) return "";
  const double more = present.error_of.evidence() - fitted.error_of.evidence();
  if (!(more > 0)) return fmt::format("explains no more than {}", present_law.name);
  if (fitted.score() < present.score()) return fmt::format("{} explains as much by fewer numbers", present_law.name);
  return fmt::format("lowers chi2 by {:.1f} more than {}, less than its further numbers cost ({})", more,
                     present_law.name, fitted.parameters - present.parameters);
}

}  // namespace hysteron
