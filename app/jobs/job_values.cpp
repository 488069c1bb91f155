// What is taken from the rows of a run, and how values of a job combine.
#include "app/jobs/job_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/jobs/computed.h"
#include "engine/diagram/error.h"
#include "fit/signals/features.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

constexpr double settled = 0.02;  // of the step: the usual 2 %

double base_distance(std::span<const double> base) {
  return base.size() < 2 ? 0 : (base.back() - base.front()) / static_cast<double>(base.size() - 1);
}

/// Numbers of a run by the name of what is taken: "frequency" of the second pole is "frequency2".
std::string number_name(const ValueWish& wish) {
  if (wish.take.text == "parameter") return wish.figure.text;
  if (wish.take.text == "frequency" || wish.take.text == "damping")
    return wish.take.text + (wish.figure.text.empty() ? "1" : wish.figure.text);
  return wish.take.text;
}

Quantity number_of(const ValueWish& wish, const RunResult& result) {
  const std::string name = number_name(wish);
  if (const Quantity* q = result.number(name)) return *q;
  std::vector<std::string> known;
  for (const auto& [n, q] : result.numbers) known.push_back(n);
  fail("unknown_number", wish.figure.text.empty() ? wish.take.pointer : wish.figure.pointer,
       fmt::format("run \"{}\" gives no \"{}\"", wish.run.text, name),
       known.empty() ? "take it from a run that linearizes or fits" : did_you_mean(name, known));
}

/// All of one dimension; the unit is the first one's.
Quantity combined(const std::string& how, const std::vector<Quantity>& q, const std::string& pointer) {
  const auto same = [&](const Quantity& a) { return a.unit.dimension == q.front().unit.dimension; };
  const bool product_like = how == "product" || how == "ratio";
  if (q.empty()) fail("bad_value", pointer, "there are no values to combine", "name some");
  if (!product_like && !std::all_of(q.begin(), q.end(), same))
    fail("wrong_unit", pointer, "values of different units are combined", "take values of one unit");
  std::vector<double> v;
  for (const auto& one : q) v.push_back(one.si);
  const Unit unit = q.front().unit;
  if (how == "ratio") return {v[0] / v[1], quotient(without_offset(unit), without_offset(q[1].unit)), true};
  if (how == "product") {
    Quantity p = q.front();
    for (std::size_t i = 1; i < q.size(); ++i)
      p = {p.si * v[i], product(without_offset(p.unit), without_offset(q[i].unit)), true};
    return p;
  }
  if (how == "difference") return {v[0] - v[1], without_offset(unit), true};
  if (how == "largest") return {features::largest(v), unit, q.front().difference};
  if (how == "smallest") return {features::smallest(v), unit, q.front().difference};
  if (how == "spread") return {features::stroke(v) / features::largest(v), parse_unit(""), true};
  double sum = 0;
  for (const double x : v) sum += x;
  return {sum, unit, q.front().difference};
}

}  // namespace

features::Spectrum spectrum_of(const JobRunner::Rows& rows, const std::string& pointer) {
  const double dt = base_distance(rows.t);
  for (std::size_t i = 1; i < rows.t.size(); ++i)
    if (std::abs(rows.t[i] - rows.t[i - 1] - dt) > 1e-6 * dt)
      fail("uneven_rows", pointer, "a spectrum needs rows that stand evenly in time", "give the run an \"every\"");
  return features::spectrum(rows.y, dt);
}

std::pair<std::size_t, std::size_t> window_rows(std::span<const double> base, const Window& window) {
  if (!window.given()) return {0, base.size()};
  const double slack = 1e-6 * base_distance(base);
  const double from = JobRunner::seconds(*window.from), to = JobRunner::seconds(*window.to);
  const auto first = std::lower_bound(base.begin(), base.end(), from - slack);
  const auto last = std::upper_bound(base.begin(), base.end(), to + slack);
  if (first >= last)
    fail("empty_window", window.from->pointer, fmt::format("there are no rows from {} s to {} s", from, to),
         base.empty() ? "simulate longer" : fmt::format("the run goes from {} s to {} s", base.front(), base.back()));
  return {static_cast<std::size_t>(first - base.begin()), static_cast<std::size_t>(last - base.begin())};
}

const RunColumn& column_of(const RunResult& result, const WrittenText& signal) {
  if (const RunColumn* c = result.find(signal.text)) return *c;
  std::vector<std::string> known;
  for (const auto& c : result.columns) known.push_back(c.name);
  fail("unknown_signal", signal.pointer, fmt::format("the run has no signal \"{}\"", signal.text),
       did_you_mean(signal.text, known) +
           " A run of another job has what its diagram records and what that job asks for.");
}

std::string quantity_text(const Quantity& q, int digits) {
  return q.difference ? difference_text(q.si, q.unit, digits) : quantity_text(q.si, q.unit, digits);
}

std::vector<char> JobRunner::kept(const std::vector<RowCondition>& where, const RunResult& result) {
  std::vector<char> keep(result.columns.empty() ? 0 : result.columns.front().values.size(), 1);
  for (const auto& condition : where) {
    const Rows r = rows(condition.signal, result, {}, false);
    const double from = condition.from ? si(*condition.from, r.unit) : -std::numeric_limits<double>::infinity();
    const double to = condition.to ? si(*condition.to, r.unit) : std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < keep.size(); ++i)
      if (!(r.y[i] >= from && r.y[i] <= to)) keep[i] = 0;
  }
  return keep;
}

JobRunner::Rows JobRunner::rows(const SignalWish& wish, const RunResult& result, const Window& window, bool rezero,
                                const std::vector<RowCondition>& where) {
  if (result.columns.empty())
    fail("no_rows", wish.signal.pointer, "this run has numbers, and no rows", "name a run that simulates");
  const auto& base = result.columns.front().values;
  const RunColumn& column = column_of(result, wish.signal);
  const auto [first, last] = window_rows(base, window);
  Rows r;
  r.unit = column.unit;
  r.t.assign(base.begin() + static_cast<std::ptrdiff_t>(first), base.begin() + static_cast<std::ptrdiff_t>(last));
  r.y.assign(column.values.begin() + static_cast<std::ptrdiff_t>(first),
             column.values.begin() + static_cast<std::ptrdiff_t>(last));
  if (wish.minus) {
    const RunResult& other = wish.minus_run ? this->result(*wish.minus_run) : result;
    const RunColumn& less = column_of(other, *wish.minus);
    if (!(less.unit.dimension == column.unit.dimension))
      fail("wrong_unit", wish.minus->pointer,
           fmt::format("\"{}\" is in {}, \"{}\" in {}", wish.signal.text, unit_text(column.unit), wish.minus->text,
                       unit_text(less.unit)),
           "subtract a signal of the same unit");
    std::vector<double> other_y(r.y.size());
    for (std::size_t i = 0; i < r.y.size(); ++i)
      other_y[i] = wish.minus_run ? features::value_at(other.columns.front().values, less.values, r.t[i])
                                  : less.values[first + i];
    const double scale = wish.same_stroke ? features::stroke(other_y) / features::stroke(r.y) : 1;
    for (std::size_t i = 0; i < r.y.size(); ++i) r.y[i] = scale * r.y[i] - other_y[i];
    r.difference = true;
  }
  if (rezero) {
    const double zero = r.y.front();
    for (auto& v : r.y) v -= zero;
    r.difference = true;
  }
  if (r.difference) r.unit.offset = 0;
  if (!where.empty()) {
    const std::vector<char> keep = kept(where, result);
    std::size_t n = 0;
    for (std::size_t i = 0; i < r.y.size(); ++i) {
      if (keep[first + i] == 0) continue;
      r.t[n] = r.t[i];
      r.y[n++] = r.y[i];
    }
    r.t.resize(n);
    r.y.resize(n);
  }
  return r;
}

namespace {

/// Takes of rows as a set, whatever their order.
Quantity of_set(const ValueWish& wish, const JobRunner::Rows& r, const JobRunner::Rows& all) {
  const std::string& what = wish.take.text;
  const Unit number = parse_unit("");
  if (what == "rows") return {static_cast<double>(r.y.size()), number, true};
  if (r.y.empty()) fail("no_rows", wish.pointer, "no row fulfils what \"where\" asks for", "give wider conditions");
  if (what == "median") return {features::quantile(r.y, 0.5), r.unit, r.difference};
  if (what == "ks_distance") return {features::ks_distance(r.y, all.y), number, true};
  const double above = wish.above ? JobRunner::si(*wish.above, r.unit) : -std::numeric_limits<double>::infinity();
  const double below = wish.below ? JobRunner::si(*wish.below, r.unit) : std::numeric_limits<double>::infinity();
  const auto n = std::count_if(r.y.begin(), r.y.end(), [&](double y) { return y > above && y < below; });
  return {static_cast<double>(n) / static_cast<double>(r.y.size()), number, true};
}

}  // namespace

namespace {

/// How far the rows lie from the points at most; between rows on straight lines.
Quantity off_points(const ValueWish& wish, const RunResult& result, const JobRunner::Rows& r) {
  const Unit base = result.columns.front().unit;
  double furthest = 0;
  for (const auto& [where, value] : wish.points) {
    const double x = JobRunner::si(where, base);
    if (r.t.empty() || x < r.t.front() || x > r.t.back())
      fail("bad_value", where.pointer, fmt::format("there is no row at {} {}", base.from_si(x), base.text),
           "name a place between the first and the last row");
    const double off = std::abs(features::value_at(r.t, r.y, x) - JobRunner::si(value, r.unit));
    furthest = off > furthest || std::isnan(off) ? off : furthest;
  }
  return {furthest, without_offset(r.unit), true};
}

}  // namespace

Quantity JobRunner::take(const ValueWish& wish, const RunResult& result) {
  static const std::vector<std::string> numbers{"parameter",    "cost",        "dc_gain",   "bandwidth", "crossover",
                                                "phase_margin", "gain_margin", "frequency", "damping",   "peak"};
  const std::string& what = wish.take.text;
  if (std::find(numbers.begin(), numbers.end(), what) != numbers.end()) return number_of(wish, result);
  if (what == "at") {
    const Rows all = rows(wish.of, result, {}, wish.rezero);
    return {features::value_at(all.t, all.y, seconds(*wish.at)), all.unit, all.difference};
  }
  const Rows r = rows(wish.of, result, wish.between, wish.rezero, wish.where);
  if (what == "off_points") return off_points(wish, result, r);
  if (what == "share" || what == "median" || what == "rows" || what == "ks_distance")
    return of_set(wish, r, what == "ks_distance" ? rows(wish.of, result, wish.between, wish.rezero) : r);
  if (r.y.empty()) fail("no_rows", wish.pointer, "no row fulfils what \"where\" asks for", "give wider conditions");
  const Unit size = without_offset(r.unit);
  if (what == "first") return {r.y.front(), r.unit, r.difference};
  if (what == "last") return {r.y.back(), r.unit, r.difference};
  if (what == "min") return {features::smallest(r.y), r.unit, r.difference};
  if (what == "max") return {features::largest(r.y), r.unit, r.difference};
  if (what == "mean") return {features::mean(r.y), r.unit, r.difference};
  if (what == "stroke") return {features::stroke(r.y), size, true};
  if (what == "rms") return {features::rms(r.y), size, true};
  if (what == "deviation") return {features::deviation(r.y), size, true};
  if (what == "max_abs") return {features::largest_size(r.y), size, true};
  if (what == "sum_squares") return {features::sum_of_squares(r.y), squared(size), true};
  if (what == "overshoot") return {features::overshoot(r.y), parse_unit(""), true};
  if (what == "settling") return {features::settling(r.t, r.y, settled), parse_unit("s"), true};
  if (what == "remanence") return {features::remanence(r.y), parse_unit(""), true};
  if (what == "area") {
    const Rows x = rows({*wish.over, {}, {}}, result, wish.between, false, wish.where);
    return {features::loop_area(x.y, r.y), product(size, without_offset(x.unit)), true};
  }
  const double above = wish.above ? si(*wish.above, parse_unit("Hz")) : 0;
  const auto lines = spectrum_of(r, wish.take.pointer);
  return {what == "rss_above" ? features::size_above(lines, above) : features::line_above(lines, above), size, true};
}

const Quantity& JobRunner::value(const WrittenText& name) {
  {
    const std::lock_guard lock(values_mutex_);
    if (const auto found = values_.find(name.text); found != values_.end()) return found->second;
  }
  const auto wish =
      std::find_if(job_.values.begin(), job_.values.end(), [&](const auto& v) { return v.name == name.text; });
  const Quantity found = at(wish->pointer, [&] {
    if (!wish->over_values.empty()) {
      std::vector<Quantity> parts;
      for (const auto& part : wish->over_values) parts.push_back(value(part));
      return combined(wish->take.text, parts, wish->take.pointer);
    }
    if (wish->take.text == "computed") return computed(wish->figure);
    if (wish->constant) {
      const Unit unit = parse_unit(wish->constant->number.unit.value_or(""), wish->constant->pointer);
      return Quantity{unit.to_si(wish->constant->number.value), unit, unit.offset == 0};
    }
    return take(*wish, result(wish->run));
  });
  const std::lock_guard lock(values_mutex_);
  return values_.emplace(name.text, found).first->second;
}

}  // namespace hysteron
