#include "discover/search/investigation.h"

#include <fmt/format.h>

#include <algorithm>

namespace hysteron {

std::string what_it_takes(const TriedEffect& tried, const std::string& on) {
  return fmt::format("explains {} of the error above the noise on {} (chi2 falls by {:.0f})",
                     percent(std::clamp(tried.share, 0.0, 1.0)), on, tried.fall_validate);
}

std::string why_implausible(const CandidateModel& fitted, std::size_t standing) {
  const PlacedEffect& s = fitted.placed[standing];
  if (!s.effect->implausible || s.at == nullptr) return "";
  const auto values = values_of(fitted, standing);
  return !values.empty() && values.size() == s.law.free.size() ? s.effect->implausible(s.law, values, *s.at) : "";
}

bool look_alike(const Effect& a, const Effect& b) {
  const auto names = [](const Effect& x, const Effect& y) {
    return std::any_of(x.look_alikes.begin(), x.look_alikes.end(),
                       [&](const LookAlike& l) { return l.effect == y.id; });
  };
  return names(a, b) || names(b, a);
}

std::vector<double> fall_by_recording(const ModelError& before, const ModelError& after) {
  std::vector<double> falls;
  for (std::size_t i = 0; i < before.recordings.size() && i < after.recordings.size(); ++i)
    falls.push_back(before.recordings[i].evidence - after.recordings[i].evidence);
  return falls;
}

}  // namespace hysteron
