#include "io/data/same_rows.h"

#include <fmt/format.h>

#include <algorithm>

namespace hysteron {
namespace {

/// Rows that both judge; a few of them at a cut do no harm.
bool overlap(const Recording& a, const Recording& b) {
  const std::size_t first = std::max(a.first, b.first), last = std::min(a.last, b.last);
  return last > first && last - first > (b.last - b.first) / 10;
}

bool same_rows(const Recording& a, const Recording& b) {
  return overlap(a, b) && (a.file == b.file || (a.t == b.t && a.columns == b.columns));
}

}  // namespace

std::vector<std::string> warnings_of_same_rows(const DataSet& data) {
  std::vector<std::string> warnings;
  for (const auto& judge : data.recordings) {
    if (judge.role == Role::train) continue;
    const auto train = std::find_if(data.recordings.begin(), data.recordings.end(),
                                    [&](const Recording& r) { return r.role == Role::train && same_rows(r, judge); });
    if (train != data.recordings.end())
      warnings.push_back(
          fmt::format("{} ({}) has the same rows as {}, which trains: it judges the model by what it was fitted to.",
                      judge.name, to_text(judge.role), train->name));
  }
  return warnings;
}

}  // namespace hysteron
