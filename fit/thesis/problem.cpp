#include "fit/thesis/problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/program/names.h"
#include "fit/thesis/thesis_methods.h"

namespace hysteron {
namespace {

class Reader {
 public:
  Reader(const FitJob& job, const Program& program, const DataSet& data) : job_(job), program_(program), data_(data) {}

  FitProblem read(const std::vector<std::string>& extra) {
    if (job_.free.empty())
      problem_.free = free_parameters(program_, extra);
    else
      for (const auto& wish : job_.free) add(wish);
    check_twice();
    problems_.throw_if_any();
    for (const auto& wish : job_.methods) add(wish);
    problems_.throw_if_any();
    return std::move(problem_);
  }

 private:
  /// Places of a path in the program: one, or all elements of a list.
  std::vector<int> places(const WrittenText& path) {
    try {
      return named_parameters(program_, path.text);
    } catch (const Error& error) {
      const auto& p = error.problems.front();
      problems_.add(p.code, pointer(path), p.what, p.cure);
      return {};
    }
  }

  /// Where it stands in the job; on the command line, what was written there.
  static std::string pointer(const WrittenText& path) { return path.pointer.empty() ? path.text : path.pointer; }

  /// A plain number is in the unit in which the diagram shows the parameter.
  std::optional<double> si(const WrittenNumber& written, const ParameterInfo& info) {
    const Unit own = parameter_unit(program_, info);
    Unit unit = own;
    try {
      if (written.number.unit) unit = parse_unit(*written.number.unit, written.pointer);
    } catch (const Error& error) {
      const auto& p = error.problems.front();
      problems_.add(p.code, written.pointer, p.what, p.cure);
      return {};
    }
    if (unit.dimension != own.dimension) {
      const auto name = [](const Unit& u) { return u.text.empty() ? std::string("a number without unit") : u.text; };
      problems_.add("wrong_unit", written.pointer,
                    fmt::format("{} does not fit: {} is in {}", name(unit), info.path, name(own)),
                    fmt::format("write it in {}", name(own)));
      return {};
    }
    return info.difference ? unit.difference_to_si(written.number.value) : unit.to_si(written.number.value);
  }

  std::string shown(const ParameterInfo& info, double value) const {
    const Unit unit = parameter_unit(program_, info);
    return fmt::format("{:.6g}{}{}", info.difference ? unit.difference_from_si(value) : unit.from_si(value),
                       unit.text.empty() ? "" : " ", unit.text);
  }

  void add(const FreeWish& wish) {
    for (const int place : places(wish.parameter)) {
      const auto& info = program_.parameters[static_cast<std::size_t>(place)];
      FreeParameter f = free_parameter(program_, info.path);
      if (wish.lower) f.lower = si(*wish.lower, info).value_or(f.lower);
      if (wish.upper) f.upper = si(*wish.upper, info).value_or(f.upper);
      if (wish.start) f.start = si(*wish.start, info).value_or(f.start);
      for (const auto& value : wish.scan)
        if (const auto v = si(value, info)) f.scan.push_back(*v);
      if (wish.prior.size() == 2) {
        const auto a = si(wish.prior[0], info), b = si(wish.prior[1], info);
        if (a && b) f.prior = {*a, *b};
      }
      // Between two positive bounds a factor says more than a difference, and valleys of products are straight.
      f.log_scale =
          wish.log_scale.value_or((f.log_scale || (f.lower > 0 && !info.linear)) && f.lower >= 0 && f.start > 0);
      check(wish, f, info);
      if (!wish.per_recording || data_.single) {
        problem_.free.push_back(std::move(f));
        origin_.push_back(pointer(wish.parameter));
        continue;
      }
      for (std::size_t r = 0; r < data_.recordings.size(); ++r) {
        if (data_.recordings[r].role == Role::test) continue;
        f.recording = static_cast<int>(r);
        problem_.free.push_back(f);
        origin_.push_back(pointer(wish.parameter));
      }
    }
  }

  void check(const FreeWish& wish, const FreeParameter& f, const ParameterInfo& info) {
    const auto at = [&](const std::optional<WrittenNumber>& number) {
      return number ? number->pointer : pointer(wish.parameter);
    };
    if (!(f.lower < f.upper))
      return problems_.add("bad_bounds", at(wish.lower ? wish.lower : wish.upper),
                           fmt::format("the lower bound of {} ({}) is not below the upper one ({})", info.path,
                                       shown(info, f.lower), shown(info, f.upper)),
                           "write the smaller one as \"lower\"");
    if (f.log_scale && !(f.start > 0))
      return problems_.add("start_outside", at(wish.start),
                           fmt::format("a logarithmic scale needs a start above zero, and {} starts at {}", info.path,
                                       shown(info, f.start)),
                           "give a positive \"start\", or \"scale\": \"linear\"");
    if (f.start < f.lower || f.start > f.upper)
      problems_.add("start_outside", at(wish.start),
                    fmt::format("{} starts at {}, outside its bounds {} .. {}", info.path, shown(info, f.start),
                                shown(info, f.lower), shown(info, f.upper)),
                    "give a \"start\" inside the bounds, or move the bounds");
    for (std::size_t i = 0; i < wish.scan.size() && wish.scan.size() == f.scan.size(); ++i)
      if (f.scan[i] < f.lower || f.scan[i] > f.upper)
        problems_.add("start_outside", wish.scan[i].pointer,
                      fmt::format("{} lies outside the bounds of {}", shown(info, f.scan[i]), info.path),
                      "take it out, or move the bounds");
    if (f.prior && (!(f.prior->first < f.prior->second) || (f.log_scale && !(f.prior->first > 0))))
      problems_.add("bad_prior", wish.prior.front().pointer,
                    fmt::format("{} .. {} is no range for {}", shown(info, f.prior->first),
                                shown(info, f.prior->second), info.path),
                    f.log_scale ? "write the smaller end first, both above zero" : "write the smaller end first");
  }

  void check_twice() {
    for (std::size_t i = 0; i < origin_.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const auto &a = problem_.free[i], &b = problem_.free[k];
        if (a.parameter != b.parameter || (a.recording >= 0 && b.recording >= 0 && a.recording != b.recording))
          continue;
        problems_.add("free_twice", origin_[i],
                      fmt::format("{} is free twice", program_.parameters[static_cast<std::size_t>(a.parameter)].path),
                      "name it once; \"core.weights\" names all its elements");
        return;
      }
  }

  int place_in_free(const WrittenText& path) {
    const auto list = places(path);
    for (std::size_t i = 0; i < problem_.free.size(); ++i)
      if (!list.empty() && problem_.free[i].parameter == list.front()) return static_cast<int>(i);
    if (!list.empty())
      problems_.add("not_free", pointer(path), fmt::format("\"{}\" is not free", path.text),
                    "name it in \"free\" too, or mark it \"free\": true in the diagram");
    return -1;
  }

  void add(const MethodWish& wish) {
    FitMethod method;
    method.name = wish.name.text;
    FitOptions& o = method.options;
    auto known = global_method_names();
    known.insert(known.begin(), "search");
    const auto& of_thesis = thesis_method_names();
    method.of_thesis = std::find(of_thesis.begin(), of_thesis.end(), method.name) != of_thesis.end();
    known.insert(known.end(), of_thesis.begin(), of_thesis.end());
    if (std::find(known.begin(), known.end(), method.name) == known.end())
      return problems_.add("unknown_method", pointer(wish.name), fmt::format("there is no method \"{}\"", method.name),
                           did_you_mean(method.name, known));
    o.seed = job_.seed;
    o.starts = wish.starts;
    if (wish.iterations) o.max_iterations = *wish.iterations;
    if (method.name != "search" && !method.of_thesis) {
      o.global = method.name;
      o.polish = wish.then_search;
      if (wish.runs) o.global_runs = *wish.runs;
    }
    if (wish.attractor) add(*wish.attractor, o);
    for (const auto& path : job_.profile)
      for (const int place : places(path)) {
        bool found = false;
        for (std::size_t i = 0; i < problem_.free.size(); ++i)
          if (problem_.free[i].parameter == place) {
            o.profile.push_back(static_cast<int>(i));
            found = true;
          }
        if (!found)
          problems_.add("not_free", pointer(path), fmt::format("\"{}\" is not free", path.text),
                        "name it in \"free\" too, or mark it \"free\": true in the diagram");
      }
    problem_.methods.push_back(std::move(method));
  }

  const ParameterInfo& info_of(int place) const {
    return program_.parameters[static_cast<std::size_t>(problem_.free[static_cast<std::size_t>(place)].parameter)];
  }

  void add(const AttractorComponentWish& wish, Attractor& to) {
    Attractor::Component c;
    c.component = place_in_free(wish.parameter);
    if (c.component < 0) return;
    if (!wish.of && wish.draw.size() != 2)
      return problems_.add("bad_value", pointer(wish.parameter), "a range has two ends", "write \"draw\": [low, high]");
    if (!wish.of) {
      const auto low = si(wish.draw[0], info_of(c.component)), high = si(wish.draw[1], info_of(c.component));
      if (!low || !high) return;
      c.low = *low;
      c.high = *high;
    } else {
      c.of = place_in_free(*wish.of);
      if (c.of < 0) return;
      // Curves are written in the units that people see.
      const double y = parameter_unit(program_, info_of(c.component)).scale;
      const double x = parameter_unit(program_, info_of(c.of)).scale;
      for (const auto& [factor, rate] : wish.upper) c.upper.push_back({y * factor, rate / x});
      for (const auto& [factor, rate] : wish.lower) c.lower.push_back({y * factor, rate / x});
      c.scale = wish.scale;
    }
    to.components.push_back(std::move(c));
  }

  void add(const AttractorWish& wish, FitOptions& o) {
    if (!wish.components.empty()) {
      o.attractor.emplace();
      for (const auto& component : wish.components) add(component, *o.attractor);
      return;
    }
    const int c = place_in_free(wish.c), k = place_in_free(wish.k);
    if (c < 0 || k < 0) return;
    const auto& info =
        program_.parameters[static_cast<std::size_t>(problem_.free[static_cast<std::size_t>(k)].parameter)];
    if (const auto top = si(wish.top, info)) o.attractor = piezo_attractor(c, k, *top);
  }

  const FitJob& job_;
  const Program& program_;
  const DataSet& data_;
  FitProblem problem_;
  std::vector<std::string> origin_;
  Problems problems_;
};

}  // namespace

FitProblem problem_of(const FitJob& job, const Program& program, const DataSet& data,
                      const std::vector<std::string>& extra) {
  return Reader(job, program, data).read(extra);
}

}  // namespace hysteron
