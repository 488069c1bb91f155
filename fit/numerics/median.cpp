#include "fit/numerics/median.h"

#include <algorithm>

namespace hysteron {

double median(std::vector<double> values) { return median_of(values); }

double median_of(std::span<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double median_step(std::span<const double> t) {
  std::vector<double> steps;
  steps.reserve(t.size());
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  return median_of(steps);
}

}  // namespace hysteron
