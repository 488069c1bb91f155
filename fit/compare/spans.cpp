#include "fit/compare/spans.h"

#include <algorithm>
#include <numeric>

namespace hysteron {
namespace {

/// The widest gaps stay.
void close_gaps(std::vector<TimeSpan>& spans) {
  if (spans.size() <= most_spans) return;
  std::vector<std::size_t> gaps(spans.size() - 1);  // gap g lies behind span g
  std::iota(gaps.begin(), gaps.end(), std::size_t{0});
  std::stable_sort(gaps.begin(), gaps.end(), [&](std::size_t a, std::size_t b) {
    return spans[a + 1].from - spans[a].to > spans[b + 1].from - spans[b].to;
  });
  gaps.resize(most_spans - 1);
  std::sort(gaps.begin(), gaps.end());
  std::vector<TimeSpan> closed;
  double from = spans.front().from;
  for (const std::size_t g : gaps) {
    closed.push_back({from, spans[g].to});
    from = spans[g + 1].from;
  }
  closed.push_back({from, spans.back().to});
  spans = std::move(closed);
}

}  // namespace

std::vector<std::vector<TimeSpan>> spans_of(const std::vector<double>& t, const std::vector<int>& part,
                                            std::size_t parts) {
  std::vector<std::vector<TimeSpan>> spans(parts);
  for (std::size_t i = 0; i < part.size(); ++i) {
    auto& own = spans[static_cast<std::size_t>(part[i])];
    if (i > 0 && part[i] == part[i - 1])
      own.back().to = t[i];
    else
      own.push_back({t[i], t[i]});
  }
  for (auto& own : spans) close_gaps(own);
  return spans;
}

}  // namespace hysteron
