#include "io/jobs/runs_names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace hysteron {
namespace {

/// Every run and value that is named somewhere is there.
class Names {
 public:
  Names(JsonFile& file, const RunsJob& job) : file_(file), job_(job) {}

  void run() {
    for (const auto& r : job_.runs) {
      for (const auto& u : r.use) check_run(u.run);
      for (const auto& s : r.set_of) check_value(s.value);
      if (r.data) check_run(r.data->run);
      if (r.of_run) check_run(*r.of_run);
      if (r.kind == RunKind::select) check_run(r.other_run);
      check_conditions(r.where);
      for (const auto& column : r.rows)
        for (const auto& cell : column.cells) check_value(cell.value);
      if (r.kind == RunKind::find || r.kind == RunKind::minimize) check_value_wish(r.aim);
    }
    for (const auto& v : job_.values) check_value_wish(v);
    for (const auto& p : job_.plots) {
      for (const auto& name : p.runs) check_run(name);
      for (const auto& s : p.y.signals)
        if (s.minus_run) check_run(*s.minus_run);
      check_conditions(p.where);
    }
    for (const auto& c : job_.claims) {
      check_value(c.value);
      for (const auto& name : c.order) check_value(name);
    }
  }

 private:
  /// `what`: "run" or "value".
  template <class Named>
  void check_one_of(const std::vector<Named>& list, const char* what, const WrittenText& name) {
    if (name.text.empty()) return;
    std::vector<std::string> known;
    for (const auto& one : list) known.push_back(one.name);
    if (std::find(known.begin(), known.end(), name.text) == known.end())
      file_.add(fmt::format("unknown_{}", what), name.pointer, fmt::format("there is no {} \"{}\"", what, name.text),
                did_you_mean(name.text, known));
  }
  void check_run(const WrittenText& name) { check_one_of(job_.runs, "run", name); }
  void check_value(const WrittenText& name) { check_one_of(job_.values, "value", name); }
  void check_value_wish(const ValueWish& v) {
    check_run(v.run);
    if (v.of.minus_run) check_run(*v.of.minus_run);
    check_conditions(v.where);
    for (const auto& name : v.over_values) check_value(name);
  }

  void check_conditions(const std::vector<RowCondition>& where) {
    for (const auto& c : where)
      if (c.signal.minus_run) check_run(*c.signal.minus_run);
  }

  JsonFile& file_;
  const RunsJob& job_;
};

/// No run and no value needs itself.
class Circles {
 public:
  Circles(JsonFile& file, const RunsJob& job) : file_(file), job_(job) {}

  void run() {
    std::vector<std::string> seen;
    const auto check = [&](const std::string& what, const std::string& pointer) {
      std::vector<std::string> way;
      const auto circle = circle_from(what, way, seen);
      if (circle.empty()) return false;
      file_.add("circular", pointer, fmt::format("{} needs itself: {}", circle.front(), fmt::join(circle, " -> ")),
                "take one of them from something else");
      return true;
    };
    for (const auto& r : job_.runs)
      if (check("run " + r.name, r.pointer)) return;
    for (const auto& v : job_.values)
      if (check("value " + v.name, v.pointer)) return;
  }

 private:
  static void add_needs_of(const ValueWish& v, bool with_run, std::vector<std::string>& needs) {
    for (const auto& name : v.over_values) needs.push_back("value " + name.text);
    if (with_run && !v.run.text.empty()) needs.push_back("run " + v.run.text);
    if (v.of.minus_run) needs.push_back("run " + v.of.minus_run->text);
    for (const auto& c : v.where)
      if (c.signal.minus_run) needs.push_back("run " + c.signal.minus_run->text);
  }

  /// What a run or a value ("run none", "value stroke") must have before it can be worked out.
  std::vector<std::string> needs_of(const std::string& what) const {
    std::vector<std::string> needs;
    for (const auto& r : job_.runs) {
      if ("run " + r.name != what) continue;
      for (const auto& u : r.use) needs.push_back("run " + u.run.text);
      for (const auto& s : r.set_of) needs.push_back("value " + s.value.text);
      if (r.data) needs.push_back("run " + r.data->run.text);
      if (r.of_run) needs.push_back("run " + r.of_run->text);
      if (r.kind == RunKind::select) needs.push_back("run " + r.other_run.text);
      for (const auto& c : r.where)
        if (c.signal.minus_run) needs.push_back("run " + c.signal.minus_run->text);
      for (const auto& column : r.rows)
        for (const auto& cell : column.cells)
          if (!cell.value.text.empty()) needs.push_back("value " + cell.value.text);
      if (r.kind == RunKind::find || r.kind == RunKind::minimize) add_needs_of(r.aim, false, needs);
    }
    for (const auto& v : job_.values)
      if ("value " + v.name == what) add_needs_of(v, true, needs);
    return needs;
  }

  /// Depth first; `way` leads to `what`, `seen` is known to be free of circles. Returns the circle, or nothing.
  std::vector<std::string> circle_from(const std::string& what, std::vector<std::string>& way,
                                       std::vector<std::string>& seen) const {
    if (std::find(seen.begin(), seen.end(), what) != seen.end()) return {};
    if (const auto begin = std::find(way.begin(), way.end(), what); begin != way.end()) {
      std::vector<std::string> circle(begin, way.end());
      circle.push_back(what);
      return circle;
    }
    way.push_back(what);
    for (const auto& need : needs_of(what))
      if (auto circle = circle_from(need, way, seen); !circle.empty()) return circle;
    way.pop_back();
    seen.push_back(what);
    return {};
  }

  JsonFile& file_;
  const RunsJob& job_;
};

}  // namespace

void check_names(JsonFile& file, const RunsJob& job) { Names(file, job).run(); }

void check_circles(JsonFile& file, const RunsJob& job) { Circles(file, job).run(); }

}  // namespace hysteron
