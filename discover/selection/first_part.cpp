#include "discover/selection/first_part.h"

#include <algorithm>
#include <vector>

namespace hysteron {
namespace {

constexpr double of_range = 0.75;
constexpr std::size_t shorter = 4;  // times: else the part is not worth a second fit

bool moves_as_in_all(const std::vector<double>& column, std::size_t rows) {
  const auto range = [&](std::size_t n) {
    const auto [low, high] = std::minmax_element(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(n));
    return *high - *low;
  };
  return column.empty() || range(std::min(rows, column.size())) >= of_range * range(column.size());
}

bool moves_as_in_all(const Recording& r, std::size_t rows) {
  return std::all_of(r.columns.begin(), r.columns.end(),
                     [&](const auto& c) { return moves_as_in_all(c.second, rows); });
}

Recording with_rows(const Recording& r, std::size_t first, std::size_t last) {
  Recording part = r;
  const auto keep = [last](auto& list) {
    list.resize(std::min(list.size(), last));
    list.shrink_to_fit();
  };
  keep(part.t);
  keep(part.left_out);
  for (auto& [name, column] : part.columns) keep(column);
  part.first = first;
  part.last = last;
  return part;
}

/// The rest of the recording that stands before it, which was cut in time.
bool goes_on(const Recording& before, const Recording& r) {
  return before.file == r.file && before.last == r.first && before.t.size() == r.t.size();
}

/// Rows of a recording, or of one that was cut together with its rest, at which its part ends.
std::optional<std::size_t> end_of_part(const Recording& r, std::size_t last, std::size_t rows) {
  for (std::size_t end = r.first + rows; shorter * end <= last; end = r.first + 2 * (end - r.first))
    if (moves_as_in_all(r, end)) return end;
  return std::nullopt;
}

}  // namespace

std::optional<DataSet> first_part(const DataSet& data, std::size_t rows) {
  const auto& all = data.recordings;
  std::vector<Recording> parts;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Recording& r = all[i];
    if (r.role == Role::test) {
      parts.push_back(r);
      continue;
    }
    const Recording* rest = i + 1 < all.size() && goes_on(r, all[i + 1]) ? &all[i + 1] : nullptr;
    const std::size_t last = rest == nullptr ? r.last : rest->last;
    const auto end = end_of_part(r, last, rest == nullptr ? rows : 2 * rows);
    if (!end) return std::nullopt;
    const double share = static_cast<double>(r.last - r.first) / static_cast<double>(last - r.first);
    const std::size_t cut =
        rest == nullptr ? *end : r.first + static_cast<std::size_t>(share * static_cast<double>(*end - r.first));
    parts.push_back(with_rows(r, r.first, cut));
    if (rest == nullptr) continue;
    parts.push_back(with_rows(*rest, cut, *end));
    ++i;
  }
  DataSet part;
  part.title = data.title;
  part.file = data.file;
  part.notes = data.notes;
  part.single = data.single;
  part.remarks = data.remarks;
  part.recordings = std::move(parts);
  return part;
}

}  // namespace hysteron
