#include "fit/study/study_problem.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "engine/program/names.h"
#include "engine/simulate/output_instants.h"
#include "fit/model/model.h"
#include "fit/signals/features.h"
#include "fit/study/unit_algebra.h"
#include "io/data/table_file.h"

namespace hysteron {
namespace {

constexpr double most_grid = 1e13;
constexpr std::uint64_t draws_per_accepted = 1000;
constexpr std::size_t most_rows = 20'000'000;

std::string name_of(const Unit& u) { return u.text.empty() ? std::string("a number without unit") : u.text; }

void need_dimension(const Unit& found, const Unit& expected, const std::string& pointer, const std::string& what) {
  if (found.dimension == expected.dimension) return;
  fail("wrong_unit", pointer, fmt::format("{} does not fit: {} is in {}", name_of(found), what, name_of(expected)),
       fmt::format("write it in {}", name_of(expected)));
}

/// A number as SI; a plain one is in `own`.
double si_of(const WrittenNumber& written, const Unit& own, bool difference, const std::string& what) {
  Unit unit = own;
  if (written.number.unit) unit = parse_unit(*written.number.unit, written.pointer);
  need_dimension(unit, own, written.pointer, what);
  return difference ? unit.difference_to_si(written.number.value) : unit.to_si(written.number.value);
}

double seconds(const WrittenNumber& written) { return si_of(written, parse_unit("s"), false, "a time"); }

class Builder {
 public:
  Builder(const StudyJob& job, ProgramPointer program) : job_(job) {
    study_.program = std::move(program);
    study_.base = start(*study_.program);
  }

  StudyProblem build() {
    options();
    // One step after the other, but every wrong parameter and every wrong feature is told at once.
    for (const auto& wish : job_.parameters) tried([&] { parameter(wish); });
    problems_.throw_if_any();
    sampling();
    for (const auto& wish : job_.features) tried([&] { feature(wish); });
    problems_.throw_if_any();
    for (const auto& wish : job_.filters) tried([&] { study_.filters.push_back(condition(wish)); });
    for (const auto& wish : job_.plots) tried([&] { plot(wish); });
    problems_.throw_if_any();
    study_.seed = job_.seed;
    study_.shards = job_.shards;
    study_.keep_all = job_.keep_all;
    study_.simulate_refused = job_.simulate_refused;
    study_.description = description_of(study_);
    return {std::move(study_), std::move(plots_)};
  }

 private:
  template <class Action>
  void tried(const Action& action) {
    try {
      action();
    } catch (const Error& error) {
      for (const auto& p : error.problems) problems_.add(p.code, p.path, p.what, p.cure);
    }
  }
  const Program& program() const { return *study_.program; }
  /// Runs `action`; problems of an Error get `pointer` of the job.
  template <class Action>
  static auto at(const std::string& pointer, const Action& action) -> decltype(action()) {
    try {
      return action();
    } catch (Error& error) {
      for (auto& p : error.problems) p.path = pointer;
      throw Error(error.fault, error.problems);
    }
  }

  // ---- simulation ---------------------------------------------------------------------------------------------------

  void options() {
    SimulateOptions& o = study_.options;
    o = simulate_options(program());
    if (!job_.until && !program().simulate.until)
      fail("no_end_time", "/diagram", "nothing says until when to simulate",
           "write \"until\": \"1 s\" into the job or the diagram");
    if (!program().input_names.empty())
      fail("unbound_input", "/diagram",
           fmt::format("the diagram takes its {} from outside, and nothing drives it", program().input_names.front()),
           "put a source block (sine, step, recorded ...) in its place, or name a diagram that has one");
    if (job_.until) o.until = seconds(*job_.until);
    if (job_.every) o.every = seconds(*job_.every);
    if (job_.step) o.step = seconds(*job_.step);
    if (job_.solver) {
      const auto& names = method_names();
      const auto found = std::find(names.begin(), names.end(), job_.solver->text);
      if (found == names.end())
        fail("bad_value", job_.solver->pointer, fmt::format("there is no method \"{}\"", job_.solver->text),
             did_you_mean(job_.solver->text, names));
      o.method = static_cast<Method>(found - names.begin());
    }
    if (!(o.until > o.begin) || o.every < 0 || (o.every > 0 && (o.until - o.begin) / o.every > most_rows))
      fail("bad_value",
           job_.every   ? job_.every->pointer
           : job_.until ? job_.until->pointer
                        : "/diagram",
           fmt::format("{} s, every {} s, cannot be simulated", o.until, o.every),
           "give times above 0 s, and not more than twenty million rows");
    study_.instants = output_instants(o);
  }

  // ---- parameters ---------------------------------------------------------------------------------------------------

  void parameter(const DrawnParameterWish& wish) {
    const int place = at(wish.parameter.pointer, [&] { return parameter_index(program(), wish.parameter.text); });
    const ParameterInfo& info = program().parameters[static_cast<std::size_t>(place)];
    for (const int other : study_.parameters)
      if (program().parameters[static_cast<std::size_t>(other)].slots == info.slots)
        fail("varied_twice", wish.parameter.pointer, fmt::format("{} is varied twice", info.path), "name it once");
    const Unit unit = parameter_unit(program(), info);
    const auto si = [&](const WrittenNumber& number) { return si_of(number, unit, info.difference, info.path); };
    SampledRange range;
    if (wish.from) range.lower = si(*wish.from);
    if (wish.to) range.upper = si(*wish.to);
    range.log = wish.log;
    range.points = wish.points;
    for (const auto& value : wish.values) range.values.push_back(si(value));
    if (!wish.file.empty()) range.values = column_of(wish, unit, info);
    check(wish, range, info.path);
    study_.parameters.push_back(place);
    study_.columns.push_back({wish.parameter.text, fmt::format("parameter {}", info.path), "", unit, info.difference});
    ranges_.push_back(std::move(range));
  }

  static void check(const DrawnParameterWish& wish, const SampledRange& range, const std::string& path) {
    if (!wish.from) return;
    if (!(range.lower < range.upper) && !(range.points == 1 && range.lower == range.upper))
      fail("bad_range", wish.from->pointer, fmt::format("the range of {} ends where it begins, or before", path),
           "write the smaller value as \"from\"");
    if (range.log && !(range.lower > 0))
      fail("bad_range", wish.from->pointer, fmt::format("{} cannot be drawn in its logarithm from zero or below", path),
           "begin above zero, or take \"scale\": \"linear\"");
  }

  static std::vector<double> column_of(const DrawnParameterWish& wish, const Unit& unit, const ParameterInfo& info) {
    const CsvTable table = read_table(wish.file);
    const CsvColumn& column = csv_column(table, wish.column);
    need_dimension(column.unit, unit, wish.column.pointer, info.path);
    std::vector<double> values = column.values;
    for (auto& v : values) v = info.difference ? column.unit.difference_to_si(v) : column.unit.to_si(v);
    return values;
  }

  static const CsvColumn& csv_column(const CsvTable& table, const WrittenText& name) {
    if (const CsvColumn* column = table.find(name.text)) return *column;
    std::vector<std::string> known;
    for (const auto& c : table.columns) known.push_back(c.name);
    fail("unknown_column", name.pointer, fmt::format("{} has no column \"{}\"", table.file, name.text),
         did_you_mean(name.text, known));
  }

  void sampling() {
    const auto& names = sampling_methods();
    const auto method =
        static_cast<SamplingMethod>(std::find(names.begin(), names.end(), job_.method.text) - names.begin());
    if (method == SamplingMethod::list)
      for (std::size_t i = 1; i < ranges_.size(); ++i)
        if (ranges_[i].values.size() != ranges_[0].values.size())
          fail("bad_value", job_.parameters[i].parameter.pointer,
               fmt::format("{} has {} values, {} has {}", job_.parameters[i].parameter.text, ranges_[i].values.size(),
                           job_.parameters[0].parameter.text, ranges_[0].values.size()),
               "give every parameter of a list as many values");
    double grid = 1;
    for (const auto& r : ranges_) grid *= static_cast<double>(r.values.empty() ? r.points : r.values.size());
    if (method == SamplingMethod::grid && grid > most_grid)
      fail("bad_value", "/sample/parameters", fmt::format("the grid has {:.3g} points", grid),
           "take fewer points, or draw with \"method\": \"sobol\"");
    if (method == SamplingMethod::sobol && ranges_.size() > most_sobol_parameters)
      fail("bad_value", "/sample/parameters",
           fmt::format("a Sobol sequence has at most {} parameters", most_sobol_parameters),
           "take \"method\": \"uniform\" or \"latin_hypercube\"");
    study_.sampler.emplace(method, job_.seed, job_.draws.value_or(0), ranges_);
    study_.draws = study_.sampler->size() > 0 ? study_.sampler->size() : job_.draws.value_or(0);
    study_.accepted = job_.accepted.value_or(0);
    if (study_.accepted > 0) study_.give_up_after = job_.give_up_after.value_or(study_.accepted * draws_per_accepted);
  }

  // ---- features -----------------------------------------------------------------------------------------------------

  /// Place of a signal in the rows.
  int recorded(const WrittenText& name) {
    const int signal = at(name.pointer, [&] { return named_signal(program(), name.text); });
    auto& list = study_.options.signals;
    const auto found = std::find(list.begin(), list.end(), signal);
    if (found != list.end()) return static_cast<int>(found - list.begin());
    list.push_back(signal);
    return static_cast<int>(list.size()) - 1;
  }
  const Unit& unit_of(int recorded) const {
    return program().signals[static_cast<std::size_t>(study_.options.signals[static_cast<std::size_t>(recorded)])].unit;
  }

  void feature(const FeatureWish& wish) {
    StudyColumn column;
    StudyFeature feature;
    if (wish.operands.empty()) {
      feature.trace = static_cast<int>(study_.traces.size());
      study_.traces.push_back(trace(wish, column));
    } else {
      combination(wish, feature.combination, column);
    }
    column.name = wish.name;
    column.remark = wish.remark;
    if (wish.unit) {
      Unit unit = parse_unit(wish.unit->text, wish.unit->pointer);
      need_dimension(unit, column.unit, wish.unit->pointer, wish.name);
      column.unit = column.difference ? without_offset(unit) : unit;
    }
    study_.columns.push_back(std::move(column));
    study_.features.push_back(std::move(feature));
  }

  TraceFeature trace(const FeatureWish& wish, StudyColumn& column) {
    TraceFeature f;
    const auto& takes = trace_takes();
    f.take = static_cast<Take>(std::find(takes.begin(), takes.end(), wish.take.text) - takes.begin());
    f.signal = recorded(wish.of);
    Unit unit = unit_of(f.signal);
    f.rezero = wish.rezero;
    if (wish.at) f.at = seconds(*wish.at);
    if (wish.at) need_inside(f.at, wish.at->pointer);
    window(wish, f);
    std::string of = wish.of.text;
    if (wish.minus) {
      f.minus = recorded(*wish.minus);
      need_dimension(unit_of(f.minus), unit, wish.minus->pointer, wish.of.text);
      of += " less " + wish.minus->text;
    }
    if (!wish.minus_file.empty()) {
      f.less = subtracted(wish, unit, f);
      of += " less the column " + wish.minus_column.text;
    }
    const bool difference = wish.minus || !f.less.empty() || f.rezero;
    if (wish.over) f.over = recorded(*wish.over);
    column.meaning = fmt::format("{} of {}", wish.take.text, of);
    if (f.take == Take::area) column.meaning += " over " + wish.over->text;
    unit_of_take(f, difference ? without_offset(unit) : unit, difference, column);
    return f;
  }

  void unit_of_take(const TraceFeature& f, const Unit& unit, bool difference, StudyColumn& column) const {
    const Unit size = without_offset(unit);
    column.difference = true;
    switch (f.take) {
      case Take::at:
      case Take::first:
      case Take::last:
      case Take::min:
      case Take::max:
      case Take::mean:
        column.unit = unit;
        column.difference = difference;
        return;
      case Take::sum_squares:
        column.unit = squared(size);
        return;
      case Take::area:
        column.unit = product(size, without_offset(unit_of(f.over)));
        return;
      case Take::remanence:
      case Take::overshoot:
        column.unit = parse_unit("");
        return;
      default:
        column.unit = size;
    }
  }

  /// A millionth of a row's distance.
  double slack() const {
    const auto& t = study_.instants;
    return t.size() < 2 ? 0 : 1e-6 * (t.back() - t.front()) / static_cast<double>(t.size() - 1);
  }
  void need_inside(double seconds, const std::string& pointer) const {
    const auto& t = study_.instants;
    if (seconds >= t.front() - slack() && seconds <= t.back() + slack()) return;
    fail("bad_value", pointer, fmt::format("{} s lies outside the simulation", seconds),
         fmt::format("the simulation goes from {} s to {} s", t.front(), t.back()));
  }

  /// Both ends included, up to a millionth of a row's distance.
  void window(const FeatureWish& wish, TraceFeature& f) const {
    const auto& t = study_.instants;
    f.last = static_cast<long>(t.size());
    if (!wish.between.given()) return;
    const double from = seconds(*wish.between.from), to = seconds(*wish.between.to);
    f.first = std::lower_bound(t.begin(), t.end(), from - slack()) - t.begin();
    f.last = std::upper_bound(t.begin(), t.end(), to + slack()) - t.begin();
    if (f.first >= f.last)
      fail("empty_window", wish.between.from->pointer, fmt::format("there are no rows from {} s to {} s", from, to),
           fmt::format("the simulation goes from {} s to {} s", t.front(), t.back()));
    need_inside(from, wish.between.from->pointer);
    need_inside(to, wish.between.to->pointer);
  }

  /// The column of a recording at the rows of the study.
  std::vector<double> subtracted(const FeatureWish& wish, const Unit& unit, const TraceFeature& f) const {
    const CsvTable table = read_table(wish.minus_file);
    const CsvColumn& column = csv_column(table, wish.minus_column);
    const CsvColumn& time = table.find("t") != nullptr ? *table.find("t") : table.columns.front();
    const std::string& pointer = wish.minus_column.pointer;
    need_dimension(column.unit, unit, pointer, wish.of.text);
    need_dimension(time.unit, parse_unit("s"), pointer, fmt::format("the time of {}", table.file));
    std::vector<double> t = time.values, y = column.values, less;
    for (auto& v : t) v = time.unit.to_si(v);
    for (auto& v : y) v = column.unit.to_si(v);
    const auto first = study_.instants[static_cast<std::size_t>(f.first)],
               last = study_.instants[static_cast<std::size_t>(f.last - 1)];
    const double slack = 1e-6 * (last - first);
    if (t.empty() || t.front() > first + slack || t.back() < last - slack || !std::is_sorted(t.begin(), t.end()))
      fail("empty_window", pointer,
           t.empty() ? fmt::format("{} has no rows", table.file)
                     : fmt::format("{} goes from {} s to {} s, what is taken from {} s to {} s", table.file, t.front(),
                                   t.back(), first, last),
           "give \"between\", or simulate no longer than it was recorded");
    for (const double at : study_.instants) less.push_back(features::value_at(t, y, at));
    return less;
  }

  // ---- combinations -------------------------------------------------------------------------------------------------

  int column(const WrittenText& name) const {
    for (std::size_t i = 0; i < study_.columns.size(); ++i)
      if (study_.columns[i].name == name.text) return static_cast<int>(i);
    std::vector<std::string> known;
    for (const auto& c : study_.columns) known.push_back(c.name);
    fail("unknown_feature", name.pointer, fmt::format("there is no \"{}\" here", name.text),
         did_you_mean(name.text, known));
  }

  struct Part {
    Unit unit;
    bool difference;
    std::string name, pointer;
  };

  Part operand(const OperandWish& wish, Combination& combination) const {
    if (!wish.constant) {
      const int place = column(wish.name);
      const auto& c = study_.columns[static_cast<std::size_t>(place)];
      combination.of.push_back({place, 0});
      return {c.unit, c.difference, c.name, wish.name.pointer};
    }
    const auto& number = wish.constant->number;
    const Unit unit = number.unit ? parse_unit(*number.unit, wish.constant->pointer) : parse_unit("");
    combination.of.push_back({-1, unit.to_si(number.value)});
    return {unit, false, fmt::format("{}{}{}", number.value, number.unit ? " " : "", number.unit.value_or("")),
            wish.constant->pointer};
  }

  void combination(const FeatureWish& wish, Combination& combination, StudyColumn& column) const {
    combination.how = wish.take.text;
    const std::string& how = combination.how;
    std::vector<Part> parts;
    for (const auto& o : wish.operands) parts.push_back(operand(o, combination));
    std::vector<std::string> names;
    for (const auto& p : parts) names.push_back(p.name);
    column.meaning = fmt::format("{} of {}", how, fmt::join(names, ", "));
    Unit unit = without_offset(parts.front().unit);
    column.difference = true;
    if (how == "ratio" || how == "product") {
      for (std::size_t i = 1; i < parts.size(); ++i)
        unit = how == "ratio" ? quotient(unit, without_offset(parts[i].unit))
                              : product(unit, without_offset(parts[i].unit));
    } else {
      for (const auto& p : parts) need_dimension(p.unit, unit, p.pointer, names.front());
      if (how == "spread") unit = parse_unit("");
      if ((how == "largest" || how == "smallest" || how == "sum") && !parts.front().difference) {
        unit = parts.front().unit;
        column.difference = false;
      }
    }
    column.unit = unit;
  }

  // ---- filters and plots --------------------------------------------------------------------------------------------

  /// A number in the unit of a column.
  std::optional<double> shown(const std::optional<WrittenNumber>& written, int place) const {
    if (!written) return {};
    const auto& c = study_.columns[static_cast<std::size_t>(place)];
    if (!written->number.unit || *written->number.unit == c.unit.text) return written->number.value;
    return c.shown(si_of(*written, c.unit, c.difference, c.name));
  }

  Condition condition(const ConditionWish& wish) const {
    Condition c;
    c.column = column(wish.feature);
    c.above = shown(wish.above, c.column);
    c.at_least = shown(wish.at_least, c.column);
    c.below = shown(wish.below, c.column);
    c.at_most = shown(wish.at_most, c.column);
    return c;
  }

  /// A varied parameter is drawn over its range where the job does not say another.
  StudyAxis axis(const StudyAxisWish& wish) const {
    StudyAxis a;
    a.column = column(wish.feature);
    a.label = wish.label.empty() ? wish.feature.text : wish.label;
    a.log = wish.log;
    a.from = shown(wish.from, a.column);
    a.to = shown(wish.to, a.column);
    const auto place = static_cast<std::size_t>(a.column);
    if (!a.from && place < ranges_.size() && ranges_[place].lower < ranges_[place].upper) {
      a.from = study_.columns[place].shown(ranges_[place].lower);
      a.to = study_.columns[place].shown(ranges_[place].upper);
    }
    if (a.from && !(*a.from < *a.to))
      fail("bad_range", wish.from ? wish.from->pointer : wish.feature.pointer,
           "the axis ends where it begins, or before", "write the smaller value as \"from\"");
    if (a.log && a.from && !(*a.from > 0))
      fail("bad_range", wish.from ? wish.from->pointer : wish.feature.pointer, "a logarithmic axis begins above zero",
           "write a \"from\" above zero, or leave \"log\" out");
    return a;
  }

  void plot(const StudyPlotWish& wish) {
    StudyPlot p;
    p.title = wish.title;
    p.caption = wish.caption;
    p.pointer = wish.pointer;
    p.x = axis(wish.x);
    if (wish.y) p.y = axis(*wish.y);
    p.bins = wish.bins;
    p.all = wish.all;
    for (const auto& c : wish.where) p.where.push_back(condition(c));
    if (p.all && !p.y) {
      if (!p.x.from)
        fail("missing_key", wish.x.feature.pointer,
             fmt::format("{} of all draws is counted while they are made, so its axis must be known before",
                         wish.x.feature.text),
             "write {\"feature\": ..., \"from\": ..., \"to\": ...}");
      p.counted = static_cast<int>(study_.histograms.size());
      study_.histograms.push_back({p.x.column, {*p.x.from, *p.x.to, p.bins, p.x.log}, p.where});
    }
    plots_.push_back(std::move(p));
  }

  const StudyJob& job_;
  Study study_;
  std::vector<SampledRange> ranges_;
  std::vector<StudyPlot> plots_;
  Problems problems_;
};

}  // namespace

StudyProblem study_of(const StudyJob& job, ProgramPointer program) { return Builder(job, std::move(program)).build(); }

}  // namespace hysteron
