#include "engine/rowwise/schedule.h"

#include <algorithm>
#include <cmath>
#include <cstring>
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

/// Times of the samples behind the first instant and before the last.
std::span<const double> samples_between(const Series& series, std::span<const double> instants) {
  const auto first = std::upper_bound(series.t.begin(), series.t.end(), instants.front());
  const auto last = std::lower_bound(series.t.begin(), series.t.end(), instants.back());
  return first < last ? std::span<const double>(first, last) : std::span<const double>();
}

/// They are all of `times` but the first and the last: most often the instants are the samples.
bool are_within(std::span<const double> samples, std::span<const double> times) {
  return samples.size() + 2 == times.size() && std::equal(samples.begin(), samples.end(), times.begin() + 1);
}

}  // namespace

std::vector<double> rows_between(std::span<const double> instants, std::span<const SeriesPointer> series) {
  std::vector<double> times(instants.begin(), instants.end());
  for (const auto& s : series) {
    const auto between = samples_between(*s, instants);
    if (between.empty() || are_within(between, times)) continue;
    std::vector<double> merged;
    merged.reserve(times.size() + between.size());
    std::set_union(times.begin(), times.end(), between.begin(), between.end(), std::back_inserter(merged));
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
    : instants(std::move(all)), series(std::move(inputs)), values(series.size()), own_values_(series.size()) {
  if (inputs_are_plain() && take_instants())
    for (std::size_t s = 0; s < series.size(); ++s) take_samples(s);
  else
    lay_out();
}

/// No input jumps, and no sample of one lies between the instants.
bool Schedule::inputs_are_plain() const {
  return instants->size() > 1 && std::all_of(series.begin(), series.end(), [&](const auto& s) {
           const auto between = samples_between(*s, *instants);
           return s->between != Between::hold && (between.empty() || are_within(between, *instants));
         });
}

/// The instants are the points, where each is so far behind the one before that no sum of times takes both for one.
bool Schedule::take_instants() {
  const std::vector<double>& all = *instants;
  h.resize(all.size());
  kind.resize(all.size(), -1);
  Lengths known(lengths);
  for (std::size_t i = 1; i < all.size(); ++i) {
    const double step = all[i] - all[i - 1], rounding = rounding_of(all[i]);
    if (!(step > std::max(rounding, same_row * h[i - 1]))) {
      for (auto* list : {&h, &lengths}) list->clear();
      kind.clear();
      return false;
    }
    h[i] = step;
    kind[i] = known.kind(step, rounding);
  }
  t = all;
  one_to_one = true;
  start_branch = 0.5 * (t[0] + t[1]);
  return true;
}

/// The values of an input at the instants. At a sample it is that sample, on the piece before it; the first instant has
/// none before it.
void Schedule::take_samples(std::size_t input) {
  const Series& s = *series[input];
  SeriesCursor cursor(s);
  const double first = cursor.value(t[0], start_branch);
  // With as many samples as instants all between the ends are the same (inputs_are_plain).
  if (s.t.size() == t.size() && s.t.front() == t.front() && s.t.back() == t.back() &&
      std::memcmp(&first, s.v.data(), sizeof(double)) == 0) {
    values[input] = s.v;
    return;
  }
  auto& own = own_values_[input];
  own.reserve(t.size());
  own.push_back(first);
  for (std::size_t i = 1; i < t.size(); ++i) own.push_back(cursor.value(t[i], t[i - 1] + 0.5 * h[i]));
  values[input] = own;
}

void Schedule::lay_out() {
  const auto rows = rows_between(*instants, series);
  const bool held =
      std::any_of(series.begin(), series.end(), [](const auto& s) { return s->between == Between::hold; });
  Lengths known(lengths);
  std::vector<SeriesCursor> cursors;
  for (const auto& s : series) cursors.emplace_back(*s);
  for (auto* list : {&own_t_, &h}) list->reserve(rows.size());
  for (auto& list : own_values_) list.reserve(rows.size());
  kind.reserve(rows.size());
  point_.reserve(instants->size());
  const auto add = [&](double time, double step, double branch) {
    const double rounding = rounding_of(time);
    const bool moves = step > rounding;
    own_t_.push_back(time);
    h.push_back(moves ? step : 0);
    kind.push_back(moves ? known.kind(step, rounding) : -1);
    for (std::size_t s = 0; s < series.size(); ++s) own_values_[s].push_back(cursors[s].value(time, branch));
  };
  const auto record = [&](double reached) {
    while (point_.size() < instants->size() && (*instants)[point_.size()] <= reached)
      point_.push_back(own_t_.size() - 1);
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
        jumps = jumps || cursors[s].value(now, branch) != own_values_[s].back();
      if (jumps) add(now, 0, branch);
    }
    record(now + same_row * step);
  }
  one_to_one = point_.size() == own_t_.size();
  for (std::size_t i = 0; i < point_.size(); ++i) one_to_one = one_to_one && point_[i] == i;
  t = own_t_;
  for (std::size_t s = 0; s < series.size(); ++s) values[s] = own_values_[s];
}

bool Schedule::is_for(const Instants& other, std::span<const SeriesPointer> others) const {
  return other == instants && std::equal(series.begin(), series.end(), others.begin(), others.end());
}

}  // namespace hysteron
