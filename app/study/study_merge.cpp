#include "app/study/study_merge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iterator>
#include <memory>

#include "app/cli/interrupt.h"
#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "io/files/atomic_file.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

constexpr std::size_t rows_at_once = 4096;
constexpr std::uint64_t most_points = 4000;  // of a scatter plot

/// One row of a shard.
struct Row {
  std::span<const double> all;      ///< as it is written: draw, accepted where all are kept, the columns
  std::span<const double> columns;  ///< as Study::columns
  bool accepted = true;
};

/// Every row of every shard, in order.
void for_each_row(const StudyFolder& folder, const Study& study, const std::function<void(const Row&)>& action) {
  const std::size_t width = study_heads(study).size(), before = width - study.columns.size();
  std::vector<std::vector<double>> block(width, std::vector<double>(rows_at_once));
  std::vector<double> row(width);
  for (int k = 0; k < folder.shards(); ++k) {
    const ColumnReader file(folder.shard_file(k));
    for (std::uint64_t first = 0; first < file.rows(); first += rows_at_once) {
      if (stop_asked())
        throw Interrupted(fmt::format("interrupted; all {} shards are kept in {}, and the same command joins them",
                                      folder.shards(), folder.file("shards")));
      const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(rows_at_once, file.rows() - first));
      for (std::size_t c = 0; c < width; ++c) file.read(c, first, std::span(block[c]).first(count));
      for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t c = 0; c < width; ++c) row[c] = block[c][i];
        action({row, std::span(row).subspan(before), !study.keep_all || row[1] != 0});
      }
    }
  }
}

/// A CSV that grows row by row.
class CsvStream {
 public:
  CsvStream(const std::string& file, const std::vector<ColumnHead>& heads)
      : file_(file), stream_(std::fopen(file_.path().c_str(), "wb"), std::fclose) {
    std::vector<std::string> names;
    for (const auto& head : heads)
      names.push_back(head.unit.empty() ? head.name : fmt::format("{} [{}]", head.name, head.unit));
    put(fmt::format("{}\n", fmt::join(names, ",")));
  }
  void append(std::span<const double> row) {
    text_.clear();
    for (std::size_t i = 0; i < row.size(); ++i)
      fmt::format_to(std::back_inserter(text_), "{}{}", i == 0 ? "" : ",", row[i]);
    text_ += '\n';
    put(text_);
  }
  void finish() {
    if (std::fclose(stream_.release()) != 0) file_.fail_now();
    file_.finish();
  }

 private:
  void put(const std::string& text) {
    if (!stream_ || std::fwrite(text.data(), 1, text.size(), stream_.get()) != text.size()) file_.fail_now();
  }

  UnfinishedFile file_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream_;
  std::string text_;
};

/// Mean and deviation by one pass (Welford).
void add(ColumnSummary& s, double value) {
  if (!std::isfinite(value)) return;
  s.smallest = s.count == 0 ? value : std::min(s.smallest, value);
  s.largest = s.count == 0 ? value : std::max(s.largest, value);
  const double away = value - s.mean;
  s.mean += away / static_cast<double>(++s.count);
  s.deviation += away * (value - s.mean);  // until it is finished: the sum of squares
}

/// A plot while rows pass: first what it needs to know of all of them, then what it shows.
class PlotCounter {
 public:
  PlotCounter(const StudyPlot& plot, const Study& study) : plot_(plot), study_(study) {}

  void look(const Row& row) {
    if (!meets(row)) return;
    low_ = count_ == 0 ? x(row) : std::min(low_, x(row));
    high_ = count_ == 0 ? x(row) : std::max(high_, x(row));
    ++count_;
  }
  void begin() {
    bins_ = {plot_.x.from.value_or(low_), plot_.x.to.value_or(high_), plot_.bins,
             plot_.x.log && plot_.x.from.value_or(low_) > 0};
    counts_.assign(static_cast<std::size_t>(plot_.bins), 0);
    every_ = (count_ + most_points - 1) / most_points;
  }
  void show(const Row& row) {
    if (!meets(row)) return;
    if (!plot_.y) {
      if (const auto bin = bins_.bin(x(row))) ++counts_[static_cast<std::size_t>(*bin)];
    } else if (seen_++ % every_ == 0) {
      points_x_.push_back(x(row));
      points_y_.push_back(y(row));
    }
  }

  Figure figure(const StudyCounts& counts) {
    Figure f;
    f.title = plot_.title;
    f.caption = plot_.caption;
    f.log_x = plot_.y ? plot_.x.log : bins_.log;
    axis(plot_.x, f.x_label, f.x_range);
    Curve curve;
    curve.name = plot_.all ? "all draws" : "accepted";
    if (plot_.y) {
      f.log_y = plot_.y->log;
      axis(*plot_.y, f.y_label, f.y_range);
      curve.style = "points";
      curve.x = std::move(points_x_);
      curve.y = std::move(points_y_);
      note(f, every_ > 1 ? fmt::format("{} samples, of which one in {} is drawn", count_, every_)
                         : count_text(static_cast<long>(count_), "sample"));
    } else {
      if (plot_.counted >= 0) counts_ = counts.histograms[static_cast<std::size_t>(plot_.counted)];
      f.y_label = "samples per bin";
      curve.style = "steps";
      std::uint64_t all = 0;
      const auto corner = [&](int edge, std::uint64_t count) {
        curve.x.push_back(bins_.edge(edge));
        curve.y.push_back(static_cast<double>(count));
      };
      corner(0, 0);
      for (int i = 0; i < plot_.bins; ++i) {
        corner(i, counts_[static_cast<std::size_t>(i)]);
        all += counts_[static_cast<std::size_t>(i)];
      }
      corner(plot_.bins, 0);
      note(f, all == 0 ? "no sample meets this" : count_text(static_cast<long>(all), "sample"));
      if (plot_.x.log && !bins_.log) note(f, "values that are not above zero: bins of equal width");
    }
    f.curves.push_back(std::move(curve));
    return f;
  }
  bool needs_rows() const { return plot_.counted < 0; }

 private:
  double x(const Row& row) const { return row.columns[static_cast<std::size_t>(plot_.x.column)]; }
  double y(const Row& row) const { return row.columns[static_cast<std::size_t>(plot_.y->column)]; }
  bool meets(const Row& row) const {
    return (plot_.all || row.accepted) && std::isfinite(x(row)) && (!plot_.y || std::isfinite(y(row))) &&
           all_hold(plot_.where, row.columns);
  }
  void axis(const StudyAxis& a, std::string& label, std::vector<double>& range) const {
    label = axis_text(a.label, study_.columns[static_cast<std::size_t>(a.column)].unit);
    if (a.from) range = {*a.from, *a.to};
  }
  static void note(Figure& f, const std::string& text) { f.caption += (f.caption.empty() ? "" : " ") + text + "."; }

  const StudyPlot& plot_;
  const Study& study_;
  std::uint64_t count_ = 0, seen_ = 0, every_ = 1;
  double low_ = 0, high_ = 0;
  Bins bins_{};
  std::vector<std::uint64_t> counts_;
  std::vector<double> points_x_, points_y_;
};

/// "3, 7, 8 ... (12 in all)"
std::string numbers_text(const std::vector<int>& list) {
  constexpr std::size_t shown = 8;
  const std::vector<int> first(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(std::min(shown, list.size())));
  return fmt::format("{}{}", fmt::join(first, ", "),
                     list.size() > shown ? fmt::format(" ... ({} in all)", list.size()) : "");
}

/// Returns how many are there that do not show whether they have changed.
int need_all_shards(const StudyFolder& folder, const std::string& again) {
  std::vector<ShardState> states;
  for (int k = 0; k < folder.shards(); ++k) states.push_back(folder.state(k));
  Problems problems;
  const auto tell = [&](ShardState state, const char* code, const char* what) {
    std::vector<int> list;
    for (int k = 0; k < folder.shards(); ++k)
      if (states[static_cast<std::size_t>(k)] == state) list.push_back(k + 1);
    if (list.empty()) return;
    problems.add(code, folder.file("shards"),
                 fmt::format("of {} shards {}: {}", folder.shards(), what, numbers_text(list)),
                 fmt::format("make each with \"{} --shard {}/{}\", or all that are missing with \"{}\"", again,
                             list.front(), folder.shards(), again));
  };
  tell(ShardState::absent, "missing_shards", "these are missing");
  tell(ShardState::other_study, "foreign_shards",
       "these belong to another study, or to this one before its job or diagram was changed");
  tell(ShardState::damaged, "damaged_file", "these are damaged");
  problems.throw_if_any();
  return static_cast<int>(std::count(states.begin(), states.end(), ShardState::unsealed));
}

FileFacts facts_of(const StudyFolder& folder, const Study& study, const StudyCounts& counts, const std::string& title) {
  FileFacts facts{{"content", "study"}, {"format", std::int64_t{1}}, {"program", "hysteron"},
                  {"title", title},     {"job", folder.job()},       {"seed", static_cast<std::int64_t>(study.seed)}};
  if (study.draws == 0) facts.emplace_back("shards", std::int64_t{folder.shards()});  // else nothing depends on them
  add_counts(counts, facts);
  return facts;
}

}  // namespace

MergedStudy merge_shards(const StudyFolder& folder, const StudyProblem& problem, const std::string& title, bool csv,
                         const std::string& again, StagedResults& staged) {
  const Study& study = problem.study;
  MergedStudy merged;
  merged.unsealed = need_all_shards(folder, again);
  merged.files = {"study.h5"};
  if (csv) merged.files.emplace_back("study.csv");
  merged.counts = StudyCounts::of(study);
  for (int k = 0; k < folder.shards(); ++k) merged.counts.add(read_counts(study, ColumnReader(folder.shard_file(k))));
  merged.columns.resize(study.columns.size());
  std::vector<PlotCounter> plots;
  for (const auto& plot : problem.plots) plots.emplace_back(plot, study);

  const auto heads = study_heads(study);
  ColumnWriter writer(staged.place(merged.files.front()), heads);
  std::unique_ptr<CsvStream> text;
  if (csv) text = std::make_unique<CsvStream>(staged.place(merged.files.back()), heads);
  for_each_row(folder, study, [&](const Row& row) {
    writer.append(row.all);
    if (text) text->append(row.all);
    for (std::size_t c = 0; c < row.columns.size() && row.accepted; ++c) add(merged.columns[c], row.columns[c]);
    for (auto& plot : plots) plot.look(row);
  });
  for (auto& c : merged.columns)
    c.deviation = c.count > 1 ? std::sqrt(c.deviation / static_cast<double>(c.count - 1)) : 0;
  for (auto& plot : plots) plot.begin();
  if (std::any_of(plots.begin(), plots.end(), [](const PlotCounter& p) { return p.needs_rows(); }))
    for_each_row(folder, study, [&](const Row& row) {
      for (auto& plot : plots) plot.show(row);
    });
  for (auto& plot : plots) merged.figures.push_back(plot.figure(merged.counts));
  writer.finish(facts_of(folder, study, merged.counts, title));
  if (text) text->finish();
  return merged;
}

}  // namespace hysteron
