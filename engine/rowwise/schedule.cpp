#include "engine/rowwise/schedule.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "engine/diagram/series_cursor.h"
#include "engine/rowwise/advance_points.h"

namespace hysteron {
namespace {

/// Tells steps of one length, but for the last digits that times lose when they are written and read.
class Lengths {
 public:
  explicit Lengths(std::vector<double>& lengths) : lengths_(lengths) {}

  int kind(double h, double rounding) {
    const double same = std::max(1e-9 * h, rounding);
    if (last_ >= 0 && std::abs(lengths_[static_cast<std::size_t>(last_)] - h) <= same) return last_;
    const auto from = known_.lower_bound(h - same);
    if (from != known_.end() && from->first <= h + same) return last_ = from->second;
    last_ = static_cast<int>(lengths_.size());
    known_.emplace(h, last_);
    lengths_.push_back(h);
    return last_;
  }

 private:
  std::vector<double>& lengths_;
  std::map<double, int> known_;
  int last_ = -1;
};

}  // namespace

std::vector<double> rows_between(std::span<const double> instants, std::span<const SeriesPointer> series) {
  std::vector<double> times(instants.begin(), instants.end());
  for (const auto& s : series) {
    const auto first = std::upper_bound(s->t.begin(), s->t.end(), instants.front());
    const auto last = std::lower_bound(s->t.begin(), s->t.end(), instants.back());
    const bool known = last - first + 2 == static_cast<std::ptrdiff_t>(times.size()) &&
                       std::equal(first, last, times.begin() + 1);  // the instants are the samples: most often
    if (first >= last || known) continue;
    std::vector<double> merged;
    merged.reserve(times.size() + static_cast<std::size_t>(last - first));
    std::set_union(times.begin(), times.end(), first, last, std::back_inserter(merged));
    times = std::move(merged);
  }
  return times;
}

SeriesPointer later(const Series& series, double by, double start) {
  auto late = std::make_shared<Series>();
  late->between = series.between;
  late->t.push_back(start + by);
  late->v.push_back(series.value(start, start));
  for (auto i = static_cast<std::size_t>(series.piece(start) + 1); i < series.t.size(); ++i) {
    late->t.push_back(series.t[i] + by);
    late->v.push_back(series.v[i]);
  }
  return late;
}

double next_sample(std::span<const SeriesPointer> series, double t) {
  double next = std::numeric_limits<double>::infinity();
  for (const auto& s : series) next = std::min(next, s->next_breakpoint(t));
  return next;
}

Schedule::Schedule(Instants all, std::vector<SeriesPointer> inputs)
    : instants(std::move(all)), series(std::move(inputs)), values(series.size()) {
  const auto rows = rows_between(*instants, series);
  const bool held =
      std::any_of(series.begin(), series.end(), [](const auto& s) { return s->between == Between::hold; });
  Lengths known(lengths);
  std::vector<SeriesCursor> cursors;
  for (const auto& s : series) cursors.emplace_back(*s);
  for (auto* list : {&t, &h}) list->reserve(rows.size());
  for (auto& list : values) list.reserve(rows.size());
  kind.reserve(rows.size());
  point.reserve(instants->size());
  const auto add = [&](double time, double step, double branch) {
    const double rounding = rounding_of(time);
    const bool moves = step > rounding;
    t.push_back(time);
    h.push_back(moves ? step : 0);
    kind.push_back(moves ? known.kind(step, rounding) : -1);
    for (std::size_t s = 0; s < series.size(); ++s) values[s].push_back(cursors[s].value(time, branch));
  };
  const auto record = [&](double reached) {
    while (point.size() < instants->size() && (*instants)[point.size()] <= reached) point.push_back(t.size() - 1);
  };
  std::size_t row = 0;
  // A time inside the next piece of every input.
  const auto behind = [&](double time, double step) {
    const double until = row < rows.size() ? rows[row] : next_sample(series, time + same_row * step);
    return std::isfinite(until) ? 0.5 * (time + until) : time + 0.5 * step;
  };
  double now = rows[row++];
  start_branch = behind(now, 0);
  add(now, 0, start_branch);
  record(now);
  while (row < rows.size()) {
    const double before = now;
    now = rows[row];
    const double step = now - before;
    while (row < rows.size() && rows[row] <= now + same_row * step) ++row;
    add(now, step, before + 0.5 * step);
    if (held) {
      const double branch = behind(now, step);
      bool jumps = false;
      for (std::size_t s = 0; s < series.size(); ++s)
        jumps = jumps || cursors[s].value(now, branch) != values[s].back();
      if (jumps) add(now, 0, branch);
    }
    record(now + same_row * step);
  }
  one_to_one = point.size() == t.size();
  for (std::size_t i = 0; i < point.size(); ++i) one_to_one = one_to_one && point[i] == i;
}

bool Schedule::is_for(const Instants& other, std::span<const SeriesPointer> others) const {
  return other == instants && std::equal(series.begin(), series.end(), others.begin(), others.end());
}

}  // namespace hysteron
