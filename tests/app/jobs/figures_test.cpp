// Every curve that a figure of the project draws can fail: made flat, shifted, scaled or late, it breaks a claim of the
// job that draws it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <set>
#include <string>

#include "app/jobs/claims.h"
#include "app/jobs/job_figures.h"
#include "app/jobs/job_runs.h"
#include "app/jobs/job_values.h"
#include "engine/diagram/error.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

// Of the range that is drawn: less a reader of the picture does not see, more is no small mistake.
constexpr double shift = 0.2;
constexpr double factor = 1.25;
// Of the rows that are drawn; no simple share of the periods that windows hold.
constexpr double delay = 0.07;
// A change of less than this share of the range is not to be seen.
constexpr double visible = 0.05;

/// A signal of a run as a plot draws it.
struct Curve {
  std::string run;
  SignalWish signal;
  const PlotWish* plot = nullptr;
};

std::vector<Curve> curves_of(JobRunner& runner) {
  std::vector<Curve> list;
  std::set<std::string> seen;
  for (const auto& plot : runner.job().plots) {
    std::vector<SignalWish> signals = plot.y.signals;
    for (const auto& x : plot.x.signals)
      if (x.signal.text != "t") signals.push_back(x);
    if (plot.kind == "bode") signals = {{{"gain", plot.pointer}}, {{"phase", plot.pointer}}};
    for (const auto& run : runs_drawn(runner, plot))
      for (const auto& signal : signals)
        if (seen.insert(run.text + " " + signal.signal.text + (signal.minus ? " " + signal.minus->text : "")).second)
          list.push_back({run.text, signal, &plot});
  }
  return list;
}

struct Drawn {
  std::size_t first = 0, last = 0;  ///< rows of the run
  std::vector<double> y;            ///< of all rows of the run
  double low = 0, high = 0;         ///< of what is drawn
  double size = 0;                  ///< largest value in this run of what has its unit
  bool noisy = false;
  double range() const { return high - low; }
};

/// Half the mean square of its steps over its variance (von Neumann, Ann. Math. Stat. 12 (1941) 367): 1 of white noise,
/// near 0 of a smooth curve.
bool is_noisy(const std::vector<double>& y) {
  double mean = 0, steps = 0, variance = 0;
  for (const double v : y) mean += v / static_cast<double>(y.size());
  for (std::size_t i = 0; i < y.size(); ++i) {
    variance += (y[i] - mean) * (y[i] - mean);
    if (i > 0) steps += (y[i] - y[i - 1]) * (y[i] - y[i - 1]) / 2;
  }
  return steps > 0.02 * variance;
}

Drawn drawn(JobRunner& runner, const Curve& curve) {
  const RunResult& result = runner.result({curve.run, ""});
  Drawn d;
  std::tie(d.first, d.last) = window_rows(result.columns.front().values, curve.plot->between);
  d.y = runner.rows(curve.signal, result, {}, false).y;
  const auto shown = runner.rows(curve.signal, result, curve.plot->between, curve.plot->rezero, curve.plot->where).y;
  const auto [low, high] = std::minmax_element(shown.begin(), shown.end());
  d.low = *low;
  d.high = *high;
  const RunColumn& own = *result.find(curve.signal.signal.text);
  for (const auto& column : result.columns)
    if (column.unit.dimension == own.unit.dimension)
      for (const double v : column.values) d.size = std::max(d.size, std::abs(v));
  d.noisy = is_noisy(shown);
  return d;
}

using Values = std::vector<double>;
struct Change {
  const char* name;
  std::function<void(Values& y, double range)> make;
};

void scale(Values& y, double about, double by) {
  for (auto& v : y) v = about + by * (v - about);
}
double mean(const Values& y) {
  double sum = 0;
  for (const double v : y) sum += v;
  return sum / static_cast<double>(y.size());
}
void move_along(Values& y, bool later) {
  const auto rows = static_cast<std::ptrdiff_t>(std::max(1.0, delay * static_cast<double>(y.size())));
  std::rotate(y.begin(), later ? y.end() - rows : y.begin() + rows, y.end());
}

/// Of a curve that never moves only that it lies elsewhere can be told; of a set of samples not in which order they
/// come; of a spectrum neither a constant nor a delay; of what is drawn from its first row no constant; of noise no
/// delay.
std::vector<Change> changes_of(const PlotWish& plot, bool moves, bool noisy) {
  const bool is_set = plot.kind == "histogram" || plot.kind == "scatter" || plot.kind == "medians";
  std::vector<Change> list;
  if (plot.kind != "spectrum" && !plot.rezero) {
    list.push_back({"shifted up", [](Values& y, double range) {
                      for (auto& v : y) v += shift * range;
                    }});
    list.push_back({"shifted down", [](Values& y, double range) {
                      for (auto& v : y) v -= shift * range;
                    }});
  }
  if (!moves) return list;
  list.push_back({"flat at its mean", [](Values& y, double) { scale(y, mean(y), 0); }});
  list.push_back({"flat at its first value", [](Values& y, double) { scale(y, y.front(), 0); }});
  list.push_back({"scaled up", [](Values& y, double) { scale(y, 0, factor); }});
  list.push_back({"scaled down", [](Values& y, double) { scale(y, 0, 1 / factor); }});
  list.push_back({"stretched about its mean", [](Values& y, double) { scale(y, mean(y), factor); }});
  list.push_back({"squeezed about its mean", [](Values& y, double) { scale(y, mean(y), 1 / factor); }});
  if (plot.kind == "spectrum" || is_set || noisy) return list;
  list.push_back({"late", [](Values& y, double) { move_along(y, true); }});
  list.push_back({"early", [](Values& y, double) { move_along(y, false); }});
  return list;
}

/// The run with what is drawn of the curve changed. None where nobody could see it.
std::optional<RunResult> changed(JobRunner& runner, const Curve& curve, const Drawn& d, const Change& change,
                                 double range) {
  Values y(d.y.begin() + static_cast<std::ptrdiff_t>(d.first), d.y.begin() + static_cast<std::ptrdiff_t>(d.last));
  const Values before = y;
  change.make(y, range);
  double most = 0;
  for (std::size_t i = 0; i < y.size(); ++i) most = std::max(most, std::abs(y[i] - before[i]));
  if (most < visible * range) return {};
  RunResult result = runner.result({curve.run, ""});
  const std::string path = result.find(curve.signal.signal.text)->path;  // it may stand there by several names
  for (auto& column : result.columns)
    if (column.path == path)
      for (std::size_t i = 0; i < y.size(); ++i) column.values[d.first + i] += y[i] - before[i];
  return result;
}

bool holds(JobRunner& runner, const ClaimPart& part) {
  try {
    return judge(runner, part).holds;
  } catch (const Error&) {
    return false;  // what cannot be taken any more is noticed, too
  }
}

/// Appends a line for each change of a curve that no claim of its job notices.
void check_job(const std::string& file, JobPool& pool, std::vector<std::string>& unnoticed, int& tried) {
  JobRunner& runner = pool.job(file);
  std::vector<const ClaimPart*> claims;  // what differs anyway notices nothing
  for (const auto& claim : runner.job().claims)
    if (holds(runner, claim)) claims.push_back(&claim);
  const auto curves = curves_of(runner);
  std::vector<Drawn> all;
  for (const auto& curve : curves) all.push_back(drawn(runner, curve));
  for (std::size_t i = 0; i < curves.size(); ++i) {
    // What is left of nothing but rounding and the solver's error does not move: zero is what it shall be.
    constexpr double error = 2e-6, visible_from_zero = 0.01;
    const bool moves = all[i].range() > error * all[i].size;
    const double range = moves ? all[i].range() : std::max(visible_from_zero * all[i].size, 1e-12);
    std::string missing;
    for (const auto& change : changes_of(*curves[i].plot, moves, all[i].noisy)) {
      auto result = changed(runner, curves[i], all[i], change, range);
      if (!result) continue;
      ++tried;
      const auto other = runner.with_result(curves[i].run, std::move(*result));
      if (std::none_of(claims.begin(), claims.end(), [&](const ClaimPart* c) { return !holds(*other, *c); }))
        missing += std::string(missing.empty() ? "" : ", ") + change.name;
    }
    if (!missing.empty())
      unnoticed.push_back(runner.job().name + ": " + curves[i].run + " " + curves[i].signal.signal.text + ": " +
                          missing);
  }
}

void check_chapter(const std::string& chapter) {
  JobPool pool;
  std::vector<std::string> files, unnoticed;
  for (const auto& entry : fs::directory_iterator(std::string(HYSTERON_SOURCE_DIR) + "/diagrams/" + chapter))
    if (entry.path().extension() == ".json" && what_a_job_does(entry.path().string()) == "runs")
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  int tried = 0;
  for (const auto& file : files) check_job(file, pool, unnoticed, tried);
  EXPECT_FALSE(files.empty());
  EXPECT_GT(tried, 0);
  std::string text;
  for (const auto& line : unnoticed) text += line + "\n";
  EXPECT_EQ(text, "") << unnoticed.size() << " curves could be wrong and no claim of their job would say so (" << tried
                      << " changes tried)";
}

TEST(Figures, CurvesOfChapterOneCanFail) { check_chapter("chapter1"); }
TEST(Figures, CurvesOfChapterTwoCanFail) { check_chapter("chapter2"); }
TEST(Figures, CurvesOfChapterThreeCanFail) { check_chapter("chapter3"); }
// Not held yet for its histograms and searches: see docs/thesis.md, "What keeps the figures honest".
TEST(Figures, DISABLED_CurvesOfChapterFourCanFail) { check_chapter("chapter4"); }
TEST(Figures, CurvesOfChapterFiveCanFail) { check_chapter("chapter5"); }

}  // namespace
}  // namespace hysteron
