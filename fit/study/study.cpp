#include "fit/study/study.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "fit/numerics/threads.h"
#include "fit/study/study_runs.h"

namespace hysteron {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
/// A shard none of whose first draws is accepted ends: its filters cannot be passed, or hardly.
constexpr std::uint64_t hopeless = 100'000;

/// True if no draw is needed behind those that are counted.
bool enough(const StudyCounts& counts, std::uint64_t wanted) {
  return wanted > 0 && (counts.accepted >= wanted || (counts.accepted == 0 && counts.draws >= hopeless));
}

/// In SI.
double combined(const Combination& c, std::span<const double> row) {
  const auto number = [&](const Combination::Operand& o) {
    return o.column < 0 ? o.constant : row[static_cast<std::size_t>(o.column)];
  };
  double value = number(c.of.front()), low = value, high = value;
  for (std::size_t i = 1; i < c.of.size(); ++i) {
    const double next = number(c.of[i]);
    low = std::isnan(next) || next < low ? next : low;
    high = std::isnan(next) || next > high ? next : high;
    if (c.how == "ratio") value /= next;
    if (c.how == "difference") value -= next;
    if (c.how == "sum") value += next;
    if (c.how == "product") value *= next;
  }
  if (c.how == "largest") return high;
  if (c.how == "smallest") return low;
  if (c.how == "spread") return (high - low) / high;
  return value;
}

/// Rows of one batch become features; then each sample is judged, in order.
class ShardSink : public RowSink {
 public:
  ShardSink(const Study& study, StudyCounts& counts, const std::function<void(const StudySample&)>& keep)
      : study_(study), counts_(counts), keep_(keep) {}

  /// The draws of the next call, and how many accepted ones are still wanted (0 = all).
  void next(std::vector<std::uint64_t> draws, std::span<const double> values, std::uint64_t wanted) {
    draws_ = std::move(draws);
    values_ = values;
    wanted_ = wanted;
  }

  void begin(std::size_t first, int used, int width) override {
    first_ = first;
    used_ = used;
    if (!reducers_ || width != width_) reducers_.emplace(study_.traces, study_.instants, width);
    width_ = width;
    failures_.assign(static_cast<std::size_t>(width), {});
  }
  void row(long k, double, const double* signals) override { reducers_->row(k, signals); }
  void fail(int lane, const Problem& problem) override { failures_[static_cast<std::size_t>(lane)] = problem; }
  void end() override {
    traced_.resize(study_.traces.size() * static_cast<std::size_t>(width_));
    reducers_->values(traced_.data());
    for (int lane = 0; lane < used_; ++lane) judge(lane);
  }

 private:
  void judge(int lane) {
    if (enough(counts_, wanted_)) return;  // that samples were computed beside the last one changes nothing
    const std::size_t sample = first_ + static_cast<std::size_t>(lane);
    ++counts_.draws;
    const auto& failure = failures_[static_cast<std::size_t>(lane)];
    if (failure) note_failure(*failure, draws_[sample]);
    fill(lane, sample, failure.has_value());
    const bool accepted = count(failure.has_value());
    if (accepted) ++counts_.accepted;
    if (accepted || study_.keep_all) keep_({draws_[sample], accepted, row_});
  }

  void note_failure(const Problem& problem, std::uint64_t draw) {
    ++counts_.failed[problem.code];
    if (!counts_.failure.empty() && counts_.failure_draw < draw) return;
    counts_.failure = problem.path.empty() ? problem.what : problem.path + ": " + problem.what;
    counts_.failure_draw = draw;
  }

  /// Parameters and features, in SI and in the units of their columns.
  void fill(int lane, std::size_t sample, bool failed) {
    const std::size_t n = study_.parameters.size();
    si_.assign(study_.columns.size(), nothing);
    row_.assign(study_.columns.size(), nothing);
    std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(sample * n), n, si_.begin());
    for (std::size_t f = 0; f < study_.features.size() && !failed; ++f) {
      const auto& feature = study_.features[f];
      si_[n + f] = feature.trace >= 0 ? traced_[static_cast<std::size_t>(feature.trace * width_ + lane)]
                                      : combined(feature.combination, si_);
    }
    for (std::size_t c = 0; c < row_.size(); ++c) row_[c] = study_.columns[c].shown(si_[c]);
  }

  bool count(bool failed) {
    bool accepted = !failed;
    for (std::size_t i = 0; i < study_.filters.size(); ++i) {
      const bool holds = study_.filters[i].holds(row_);
      counts_.passed[i] += holds ? 1 : 0;
      accepted = accepted && holds;
    }
    const auto bad = std::find_if(row_.begin(), row_.end(), [](double v) { return !std::isfinite(v); });
    if (!failed && bad != row_.end()) ++counts_.not_finite[static_cast<std::size_t>(bad - row_.begin())];
    for (std::size_t h = 0; h < study_.histograms.size(); ++h) {
      const auto& histogram = study_.histograms[h];
      const auto bin = histogram.bins.bin(row_[static_cast<std::size_t>(histogram.column)]);
      if (bin && all_hold(histogram.where, row_)) ++counts_.histograms[h][static_cast<std::size_t>(*bin)];
    }
    return accepted && bad == row_.end();
  }

  const Study& study_;
  StudyCounts& counts_;
  const std::function<void(const StudySample&)>& keep_;
  std::vector<std::uint64_t> draws_;
  std::span<const double> values_;
  std::uint64_t wanted_ = 0;
  std::optional<Reducers> reducers_;
  std::vector<std::optional<Problem>> failures_;
  std::vector<double> traced_, si_, row_;
  std::size_t first_ = 0;
  int used_ = 0, width_ = 0;
};

}  // namespace

bool Condition::holds(std::span<const double> row) const {
  const double v = row[static_cast<std::size_t>(column)];
  return std::isfinite(v) && (!above || v > *above) && (!at_least || v >= *at_least) && (!below || v < *below) &&
         (!at_most || v <= *at_most);
}

bool all_hold(const std::vector<Condition>& conditions, std::span<const double> row) {
  return std::all_of(conditions.begin(), conditions.end(), [&](const Condition& c) { return c.holds(row); });
}

double Bins::edge(int i) const {
  if (i == count) return to;
  const double share = static_cast<double>(i) / count;
  return log ? from * std::pow(to / from, share) : from + share * (to - from);
}

std::optional<int> Bins::bin(double value) const {
  if (!(value >= from && value <= to)) return {};
  const double share = log ? std::log(value / from) / std::log(to / from) : (value - from) / (to - from);
  return to > from ? std::clamp(static_cast<int>(share * count), 0, count - 1) : 0;
}

StudyCounts StudyCounts::of(const Study& study) {
  StudyCounts counts;
  counts.passed.assign(study.filters.size(), 0);
  counts.not_finite.assign(study.columns.size(), 0);
  for (const auto& h : study.histograms) counts.histograms.emplace_back(static_cast<std::size_t>(h.bins.count), 0);
  return counts;
}

void StudyCounts::add(const StudyCounts& other) {
  const auto add_list = [](std::vector<std::uint64_t>& to, const std::vector<std::uint64_t>& from) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += from[i];
  };
  draws += other.draws;
  accepted += other.accepted;
  add_list(passed, other.passed);
  add_list(not_finite, other.not_finite);
  for (std::size_t h = 0; h < histograms.size(); ++h) add_list(histograms[h], other.histograms[h]);
  for (const auto& [code, n] : other.failed) failed[code] += n;
  if (!other.failure.empty() && (failure.empty() || other.failure_draw < failure_draw)) {
    failure = other.failure;
    failure_draw = other.failure_draw;
  }
  gave_up = gave_up || other.gave_up;
}

ShardDraws shard_draws(const Study& study, int shard, int shards) {
  const auto k = static_cast<std::uint64_t>(shard), n = static_cast<std::uint64_t>(shards);
  const auto part = [&](std::uint64_t all) { return all / n + (k < all % n ? 1 : 0); };
  ShardDraws d;
  if (study.draws > 0) {
    d.first = study.draws / n * k + std::min(k, study.draws % n);
    d.count = part(study.draws);
    return d;
  }
  d.first = k;
  d.step = n;
  d.wanted = part(study.accepted);
  d.most = part(study.give_up_after);
  return d;
}

std::optional<StudyCounts> compute_shard(const Study& study, int shard, int shards,
                                         const std::function<void(const StudySample&)>& keep,
                                         const std::function<bool(const StudyCounts&)>& go_on) {
  StudyCounts counts = StudyCounts::of(study);
  const ShardDraws d = shard_draws(study, shard, shards);
  Sampler sampler = *study.sampler;
  SampleRuns runs(study.program, study.base, study.options, study.parameters,
                  study.simulate_refused ? RefusedValues::are_simulated : RefusedValues::end_the_run);
  ShardSink sink(study, counts, keep);
  const std::size_t n = study.parameters.size();
  std::vector<double> values;
  const std::uint64_t most = d.wanted > 0 ? d.most : d.count;
  for (std::uint64_t j = 0; j < most;) {
    if (enough(counts, d.wanted)) break;
    if (go_on && !go_on(counts)) return {};
    const auto batch = std::min(static_cast<std::uint64_t>(runs.width()), most - j);
    std::vector<std::uint64_t> draws;
    values.resize(batch * n);
    for (std::uint64_t b = 0; b < batch; ++b, ++j) {
      draws.push_back(d.first + d.step * j);
      sampler.draw(draws.back(), std::span(values).subspan(b * n, n));
    }
    sink.next(std::move(draws), values, d.wanted);
    runs(values, sink);
  }
  if (go_on) go_on(counts);
  counts.gave_up = counts.accepted < d.wanted;
  return counts;
}

namespace {

/// The samples of one shard in memory.
StudyTable table_of_shard(const Study& study, int shard, int shards, const std::vector<std::size_t>& wanted) {
  StudyTable table;
  table.columns.resize(wanted.size());
  table.counts = *compute_shard(study, shard, shards, [&](const StudySample& sample) {
    table.draw.push_back(sample.draw);
    table.accepted.push_back(sample.accepted ? 1 : 0);
    for (std::size_t c = 0; c < wanted.size(); ++c) table.columns[c].push_back(sample.row[wanted[c]]);
  });
  return table;
}

/// Behind `to`; what has been appended needs no room of its own any more.
template <class T>
void append(std::vector<T>& to, std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
  std::vector<T>().swap(from);
}

}  // namespace

StudyTable compute_study(const Study& study, int threads, std::vector<std::size_t> wanted) {
  if (wanted.empty()) {
    wanted.resize(study.columns.size());
    std::iota(wanted.begin(), wanted.end(), std::size_t{0});
  }
  const int shards = std::max(1, study.shards);
  std::vector<StudyTable> parts(static_cast<std::size_t>(shards));
  Threads(threads).each(parts.size(),
                        [&](std::size_t k) { parts[k] = table_of_shard(study, static_cast<int>(k), shards, wanted); });

  StudyTable all;
  all.columns.resize(wanted.size());
  all.counts = StudyCounts::of(study);
  for (auto& part : parts) {
    append(all.draw, part.draw);
    append(all.accepted, part.accepted);
    for (std::size_t c = 0; c < all.columns.size(); ++c) append(all.columns[c], part.columns[c]);
    all.counts.add(part.counts);
  }
  return all;
}

}  // namespace hysteron
