#include "io/jobs/study_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "io/diagram/job_command.h"
#include "io/files/project_path.h"
#include "io/jobs/job_parts.h"
#include "io/json/file_kind.h"
#include "io/json/json_reader.h"
#include "io/json/value_text.h"

namespace hysteron {
namespace {

using namespace job_parts;

constexpr double most_draws = 1e13;
constexpr int most_shards = 100'000;

/// "5 V", "-3": what cannot be a name.
bool begins_as_number(const std::string& text) {
  return !text.empty() &&
         (std::isdigit(static_cast<unsigned char>(text[0])) != 0 || text[0] == '-' || text[0] == '+' || text[0] == '.');
}

class StudyReader {
 public:
  StudyReader(const std::string& file, const std::vector<std::string>& allowed) : file_(file), paths_(file, allowed) {}

  StudyJob read() {
    const JsonPlace root = file_.root();
    if (!root.expect_object(
            "{\"format\": 1, \"do\": \"study\", \"diagram\": \"stage.json\", \"sample\": {...}, \"features\": {...}}"))
      file_.throw_if_any();
    check_kind(root, FileKind::job);
    check_format(root, "job");
    what(root);
    file_.throw_if_any();  // of another kind of job every key would be wrong
    root.only({"$schema", "format", "do", "title", "source", "remark", "diagram", "choose", "set", "until", "every",
               "solver", "sample", "features", "filters", "refused", "keep", "plots"});
    head(root);
    if (const auto at = root.need(
            "sample",
            "say what is varied: \"sample\": {\"method\": \"uniform\", \"draws\": 1000, \"parameters\": {...}}"))
      sample(*at);
    if (const auto at = root.need("features",
                                  "say what is taken from each simulation: \"features\": {\"stroke\": {\"take\": "
                                  "\"stroke\", \"of\": \"y\"}}"))
      features(*at);
    if (root.find("filters")) job_.filters = conditions(root, "filters");
    if (const auto refused = one_of(root, "refused", {"rejected", "simulated"}))
      job_.simulate_refused = *refused == "simulated";
    if (const auto keep = one_of(root, "keep", {"accepted", "all"})) job_.keep_all = *keep == "all";
    if (const auto plots = root.find("plots"); plots && plots->expect_array("[{\"x\": \"stroke\", \"bins\": 40}]"))
      for (const auto& place : plots->elements()) plot(place);
    file_.throw_if_any();
    return std::move(job_);
  }

 private:
  static void what(const JsonPlace& root) {
    const auto place = root.need("do", "write \"do\": \"study\"");
    const auto text = place ? place->text() : std::nullopt;
    if (!text || *text == "study") return;
    if (*text == "fit" || *text == "runs")
      place->add("other_job", fmt::format("this job does \"{}\", no study", *text),
                 fmt::format("run it with \"{}\"", job_command(*text, root.file().file())));
    else
      place->add("bad_value", fmt::format("\"do\" cannot be {}", json_quoted(*text)),
                 did_you_mean(*text, {"study", "fit", "runs"}));
  }

  void head(const JsonPlace& root) {
    job_.file = file_.file();
    job_.name = std::filesystem::path(job_.file).stem().string();
    text_member(root, "$schema");
    job_.title = text_member(root, "title");
    job_.source = text_member(root, "source");
    job_.remark = text_member(root, "remark");
    if (const auto at = root.need("diagram", "write \"diagram\": \"stage.json\"")) job_.diagram = path(*at);
    job_.choose = settings_of(root, "choose");
    job_.set = settings_of(root, "set");
    job_.until = number_of(root, "until");
    job_.every = number_of(root, "every");
    const auto solver = root.find("solver");
    if (!solver || !solver->expect_object("{\"method\": \"rk4\", \"step\": \"0.1 ms\"}")) return;
    solver->only({"method", "step"});
    job_.solver = text_of(*solver, "method");
    job_.step = number_of(*solver, "step");
  }

  std::string path(const JsonPlace& place) {
    const auto written = place.text();
    if (!written) return "";
    if (const auto found = paths_.resolve(file_.file(), *written)) return *found;
    place.add("outside_project", fmt::format("\"{}\" lies outside the project {}", *written, paths_.project()),
              outside_cure(*written));
    return "";
  }

  // ---- sampling -----------------------------------------------------------------------------------------------------

  void sample(const JsonPlace& at) {
    if (!at.expect_object("{\"method\": \"uniform\", \"seed\": 1, \"draws\": 1000, \"parameters\": {...}}")) return;
    at.only({"method", "seed", "draws", "accepted", "give_up_after", "shards", "parameters", "remark"});
    text_member(at, "remark");
    const auto method = one_of(at, "method", study_sampling_methods());
    job_.method = {method.value_or("uniform"), at.pointer()};
    if (const auto seed = at.find("seed"))
      if (const auto value = whole_at(*seed, 0, 9007199254740992.0)) job_.seed = static_cast<std::uint64_t>(*value);
    job_.draws = count(at, "draws");
    job_.accepted = count(at, "accepted");
    job_.give_up_after = count(at, "give_up_after");
    if (const auto shards = at.find("shards"))
      if (const auto value = whole_at(*shards, 1, most_shards)) job_.shards = static_cast<int>(*value);
    check_counts(at);
    const auto list = at.need(
        "parameters", "say what is varied: \"parameters\": {\"stage.k\": {\"from\": \"1 N/um\", \"to\": \"3 N/um\"}}");
    if (!list || !list->expect_object("{\"stage.k\": {\"from\": \"1 N/um\", \"to\": \"3 N/um\"}}")) return;
    for (const auto& [name, place] : list->members()) parameter(name, place);
    if (list->members().empty())
      list->add("bad_value", "no parameter is varied",
                "name one: {\"stage.k\": {\"from\": \"1 N/um\", \"to\": \"3 N/um\"}}");
  }

  static std::optional<std::uint64_t> count(const JsonPlace& at, const char* key) {
    const auto place = at.find(key);
    const auto value = place ? whole_at(*place, 1, most_draws) : std::nullopt;
    return value ? std::optional(static_cast<std::uint64_t>(*value)) : std::nullopt;
  }

  void check_counts(const JsonPlace& at) const {
    const bool counted = job_.method.text == "grid" || job_.method.text == "list";
    if (counted && (at.find("draws") || at.find("accepted")))
      at.find(at.find("draws") ? "draws" : "accepted")
          ->add("bad_value", fmt::format("a {} says itself how many draws there are", job_.method.text),
                "leave this out");
    if (!counted && at.find("draws").has_value() == at.find("accepted").has_value())
      at.add("bad_value", "nothing says how many samples there shall be, or two things do",
             "write \"draws\": 1000, or \"accepted\": 1000 to draw until so many pass the filters");
    if (job_.method.text == "latin_hypercube" && at.find("accepted"))
      at.find("accepted")
          ->add("bad_value", "a Latin hypercube must know how many draws there are before the first one",
                "write \"draws\", or take \"method\": \"sobol\"");
    if (at.find("give_up_after") && !at.find("accepted"))
      at.find("give_up_after")
          ->add("bad_value", "it bounds the draws until so many are accepted", "leave it out, or write \"accepted\"");
  }

  void parameter(const std::string& name, const JsonPlace& place) {
    const bool grid = job_.method.text == "grid", list = job_.method.text == "list";
    if (!place.expect_object("{\"from\": \"1 N/um\", \"to\": \"3 N/um\", \"scale\": \"log\"}")) return;
    std::vector<std::string> known{"remark"};
    if (!list) known.insert(known.end(), {"from", "to", "scale"});
    if (grid) known.insert(known.end(), {"points", "values"});
    if (list) known.insert(known.end(), {"values", "file", "column"});
    place.only(known);
    text_member(place, "remark");
    DrawnParameterWish wish;
    wish.parameter = {name, place.pointer()};
    wish.from = number_of(place, "from");
    wish.to = number_of(place, "to");
    if (const auto scale = one_of(place, "scale", {"linear", "log"})) wish.log = *scale == "log";
    if (const auto points = place.find("points"))
      if (const auto n = whole_at(*points, 1, 1e9)) wish.points = static_cast<std::uint64_t>(*n);
    if (const auto values = place.find("values"); values && values->expect_array("[\"1 V\", \"2 V\"]")) {
      for (const auto& one : values->elements())
        if (const auto number = read_number(one)) wish.values.push_back({*number, one.pointer()});
      if (values->elements().empty()) values->add("bad_value", "there are no values", "write [\"1 V\", \"2 V\"]");
    }
    if (const auto file = place.find("file")) wish.file = path(*file);
    wish.column = text_of(place, "column").value_or(WrittenText{name, place.pointer()});
    check_range(place, grid, list);
    job_.parameters.push_back(std::move(wish));
  }

  static void check_range(const JsonPlace& place, bool grid, bool list) {
    if (list) {
      if (place.find("values").has_value() == place.find("file").has_value())
        place.add("bad_value", "the values of a list stand here or in a CSV",
                  "write \"values\": [\"1 V\", \"2 V\"], or \"file\": \"samples.csv\"");
      return;
    }
    const bool range = place.find("from") && place.find("to");
    if (grid && range == place.find("values").has_value())
      place.add("bad_value", "a parameter of a grid has a range with points, or values",
                "write \"from\", \"to\" and \"points\", or \"values\": [\"1 V\", \"2 V\"]");
    if (grid && range && !place.find("points"))
      place.add("missing_key", "nothing says how many points the grid has here", "write \"points\": 11");
    if (!grid && !range)
      place.add("missing_key", "nothing says between which values it is drawn", "write \"from\" and \"to\"");
  }

  // ---- features -----------------------------------------------------------------------------------------------------

  std::vector<std::string> known_names() const {
    std::vector<std::string> names;
    for (const auto& f : job_.features) names.push_back(f.name);
    for (const auto& p : job_.parameters) names.push_back(p.parameter.text);
    return names;
  }
  void check_name_known(const WrittenText& name, const char* otherwise = "") {
    const auto names = known_names();
    if (name.text.empty() || std::find(names.begin(), names.end(), name.text) != names.end()) return;
    file_.add("unknown_feature", name.pointer,
              fmt::format("there is no feature and no varied parameter \"{}\"{}", name.text, otherwise),
              did_you_mean(name.text, names));
  }

  void features(const JsonPlace& list) {
    if (!list.expect_object("{\"stroke\": {\"take\": \"stroke\", \"of\": \"y\"}}")) return;
    for (const auto& [name, place] : list.members())
      if (check_name(place, name, "feature")) {
        const auto names = known_names();
        if (name == "draw" || name == "accepted")
          place.add("bad_name", fmt::format("the samples have a column \"{}\" of their own", name),
                    "give the feature another name");
        if (std::find(names.begin(), names.end(), name) != names.end())
          place.add("bad_name", fmt::format("a varied parameter is called \"{}\", too", name),
                    "give the feature another name");
        if (place.expect_object("{\"take\": \"stroke\", \"of\": \"y\"}")) job_.features.push_back(feature(name, place));
      }
    if (list.members().empty())
      list.add("bad_value", "nothing is taken from the simulations",
               "write {\"stroke\": {\"take\": \"stroke\", \"of\": \"y\"}}");
  }

  FeatureWish feature(const std::string& name, const JsonPlace& place) {
    FeatureWish f;
    f.name = name;
    f.pointer = place.pointer();
    f.remark = text_member(place, "remark");
    f.unit = text_of(place, "unit");
    for (const auto& combination : combinations())
      if (const auto at = place.find(combination)) {
        place.only({combination, "unit", "remark"});
        f.take = {combination, at->pointer()};
        f.operands = operands(*at, combination);
        return f;
      }
    place.only({"take", "of", "minus", "over", "between", "rezero", "at", "unit", "remark"});
    if (const auto take = place.need("take", "say what is taken: \"stroke\", \"rms\", \"area\" ..."))
      f.take = text_at(*take);
    if (!f.take.text.empty() &&
        std::find(study_takes().begin(), study_takes().end(), f.take.text) == study_takes().end())
      place.find("take")->add("bad_value",
                              fmt::format("{} cannot be taken while a study runs", json_quoted(f.take.text)),
                              did_you_mean(f.take.text, study_takes()));
    if (const auto of = place.need("of", "name the signal: \"of\": \"stage\"")) f.of = text_at(*of);
    minus(place, f);
    f.over = text_of(place, "over");
    if (f.take.text == "area") place.need("over", "an area is of one signal over another: write \"over\": \"drive\"");
    if (f.take.text == "at") place.need("at", "say when: \"at\": \"0.2 s\"");
    f.between = window_of(place);
    if (f.take.text == "at" && f.between.given())
      place.find("between")->add("bad_value", "an instant needs no window", "leave it out");
    f.rezero = truth_of(place, "rezero");
    f.at = number_of(place, "at");
    return f;
  }

  /// "minus": "reference", or {"file": "lab.csv", "column": "y"}.
  void minus(const JsonPlace& place, FeatureWish& f) {
    const auto at = place.find("minus");
    if (!at) return;
    if (!at->is_object()) {
      f.minus = text_at(*at);
      return;
    }
    at->only({"file", "column"});
    if (const auto file = at->need("file", "name the CSV whose column is subtracted")) f.minus_file = path(*file);
    if (const auto column = at->need("column", "name the column that is subtracted")) f.minus_column = text_at(*column);
  }

  std::vector<OperandWish> operands(const JsonPlace& at, const std::string& how) {
    std::vector<OperandWish> list;
    if (!at.expect_array("[\"area\", \"stroke\", \"0.5 V\"]")) return list;
    for (const auto& place : at.elements()) {
      OperandWish operand{{"", place.pointer()}, {}};
      if (place.is_number() || (place.is_text() && begins_as_number(*place.text()))) {
        if (const auto number = read_number(place)) operand.constant = WrittenNumber{*number, place.pointer()};
      } else {
        operand.name = text_at(place);
        check_name_known(operand.name, " before this one");
      }
      list.push_back(std::move(operand));
    }
    if ((how == "ratio" || how == "difference") && list.size() != 2)
      at.add("bad_value", fmt::format("a {} is of two numbers", how), "write [\"first\", \"second\"]");
    if (list.empty()) at.add("bad_value", "there is nothing to combine", "name features, parameters or numbers");
    return list;
  }

  // ---- filters and plots --------------------------------------------------------------------------------------------

  std::vector<ConditionWish> conditions(const JsonPlace& object, const char* key) {
    std::vector<ConditionWish> list;
    const auto at = object.find(key);
    if (!at || !at->expect_array("[{\"feature\": \"stroke\", \"above\": \"1 um\"}]")) return list;
    for (const auto& place : at->elements()) {
      if (!place.expect_object("{\"feature\": \"stroke\", \"above\": \"1 um\"}")) continue;
      place.only({"feature", "above", "at_least", "below", "at_most", "remark"});
      text_member(place, "remark");
      ConditionWish c;
      c.pointer = place.pointer();
      if (const auto feature = place.need("feature", "name a feature or a varied parameter"))
        c.feature = text_at(*feature);
      check_name_known(c.feature);
      c.above = number_of(place, "above");
      c.at_least = number_of(place, "at_least");
      c.below = number_of(place, "below");
      c.at_most = number_of(place, "at_most");
      if (!c.above && !c.at_least && !c.below && !c.at_most)
        place.add("missing_key", "the condition has no bound",
                  "write \"above\", \"at_least\", \"below\" or \"at_most\"");
      list.push_back(std::move(c));
    }
    return list;
  }

  /// "gamma", or {"feature": "gamma", "from": 0, "to": 1, "log": true, "label": "area"}.
  StudyAxisWish axis(const JsonPlace& place) {
    StudyAxisWish a;
    if (place.is_text()) {
      a.feature = text_at(place);
    } else if (place.expect_object("{\"feature\": \"stroke\", \"from\": \"0 um\", \"to\": \"9 um\"}")) {
      place.only({"feature", "label", "from", "to", "log"});
      if (const auto feature = place.need("feature", "name a feature or a varied parameter"))
        a.feature = text_at(*feature);
      a.label = text_member(place, "label");
      a.from = number_of(place, "from");
      a.to = number_of(place, "to");
      a.log = truth_of(place, "log");
      if (a.from.has_value() != a.to.has_value())
        place.add("bad_value", "an axis has two ends, or none", "write \"from\" and \"to\"");
    }
    check_name_known(a.feature);
    return a;
  }

  void plot(const JsonPlace& place) {
    if (!place.expect_object("{\"x\": \"stroke\", \"bins\": 40}")) return;
    place.only({"title", "kind", "x", "y", "bins", "samples", "where", "caption", "remark"});
    text_member(place, "remark");
    StudyPlotWish p;
    p.pointer = place.pointer();
    p.title = text_member(place, "title");
    p.caption = text_member(place, "caption");
    if (const auto x = place.need("x", "say what is drawn: \"x\": \"stroke\"")) p.x = axis(*x);
    if (const auto y = place.find("y")) p.y = axis(*y);
    if (const auto kind = one_of(place, "kind", {"histogram", "scatter"});
        kind && (*kind == "scatter") != p.y.has_value())
      place.find("kind")->add("bad_value", "a histogram has x alone, a scatter plot x and y",
                              *kind == "scatter" ? "write \"y\": \"stroke\"" : "leave \"y\" out");
    if (const auto bins = place.find("bins"))
      if (const auto n = whole_at(*bins, 2, 1000)) p.bins = static_cast<int>(*n);
    if (const auto samples = one_of(place, "samples", {"accepted", "all"})) p.all = *samples == "all";
    if (p.all && p.y && !job_.keep_all)
      place.find("samples")->add("bad_value", "rejected draws are not kept, so they cannot be drawn one by one",
                                 "write \"keep\": \"all\" into the job, or leave this out");
    p.where = conditions(place, "where");
    if (p.title.empty())
      p.title = p.y ? fmt::format("{} over {}", p.y->feature.text, p.x.feature.text) : p.x.feature.text;
    job_.plots.push_back(std::move(p));
  }

  JsonFile file_;
  ProjectPaths paths_;
  StudyJob job_;
};

}  // namespace

const std::vector<std::string>& study_takes() {
  static const std::vector<std::string> names{"at",          "first", "last",      "min",       "max",
                                              "stroke",      "mean",  "rms",       "deviation", "max_abs",
                                              "sum_squares", "area",  "remanence", "overshoot"};
  return names;
}

const std::vector<std::string>& study_sampling_methods() {
  static const std::vector<std::string> names{"uniform", "latin_hypercube", "sobol", "grid", "list"};
  return names;
}

StudyJob read_study_job(const std::string& file, const std::vector<std::string>& allowed) {
  return StudyReader(file, allowed).read();
}

}  // namespace hysteron
