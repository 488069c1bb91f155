#include "io/jobs/job_file.h"

#include <fmt/format.h>

#include "io/diagram/job_command.h"
#include "io/files/project_path.h"
#include "io/jobs/job_parts.h"
#include "io/jobs/runs_schema.h"
#include "io/jobs/study_schema.h"
#include "io/json/json_reader.h"
#include "io/json/schema_parts.h"
#include "io/json/value_text.h"

namespace hysteron {
namespace {

using namespace job_parts;

const std::vector<std::string> what_can_be_done{"fit", "runs", "study"};

class JobReader {
 public:
  JobReader(const std::string& file, const std::vector<std::string>& allowed) : file_(file), paths_(file, allowed) {}

  FitJob read() {
    const JsonPlace root = file_.root();
    if (!root.expect_object("{\"format\": 1, \"do\": \"fit\", \"diagram\": \"stage.json\", \"data\": \"lab.json\"}"))
      file_.throw_if_any();
    check_format(root, "job");
    what(root);
    file_.throw_if_any();  // of another kind of job every key would be wrong
    root.only({"$schema", "format", "title", "source", "remark", "do", "diagram", "data", "choose", "set", "free",
               "thresholds", "method", "seed", "profile", "write"});
    job_.file = file_.file();
    text_member(root, "$schema");
    text_member(root, "source");
    text_member(root, "remark");
    job_.title = text_member(root, "title");
    job_.diagram = path(root, "diagram", "write \"diagram\": \"stage.json\"", true);
    job_.data = path(root, "data", "write \"data\": \"dataset.json\", or a CSV", true);
    job_.write = path(root, "write", "", false);
    job_.choose = settings_of(root, "choose");
    job_.set = settings_of(root, "set");
    if (const auto list = root.find("free"); list && list->expect_array("[{\"parameter\": \"stage.k\"}]"))
      for (const auto& place : list->elements()) free(place);
    if (const auto place = root.find("thresholds");
        place && place->expect_object("{\"block\": \"core\", \"count\": 10}"))
      job_.thresholds = thresholds(*place);
    methods(root);
    if (const auto seed = root.find("seed"))
      if (const auto value = whole_at(*seed, 0, 9007199254740992.0)) job_.seed = static_cast<std::uint64_t>(*value);
    if (const auto list = root.find("profile"); list && list->expect_array("[\"stage.k\"]"))
      for (const auto& place : list->elements())
        if (const auto name = place.text()) job_.profile.push_back({*name, place.pointer()});
    file_.throw_if_any();
    return std::move(job_);
  }

 private:
  void what(const JsonPlace& root) {
    const auto place = root.need("do", "write \"do\": \"fit\"");
    const auto text = place ? place->text() : std::nullopt;
    if (!text || *text == "fit") return;
    if (*text == "runs" || *text == "study")
      place->add("other_job", *text == "runs" ? "this is a job of runs, no fit" : "this is a study, no fit",
                 fmt::format("run it with \"{}\"", job_command(*text, root.file().file())));
    else
      place->add("bad_value", fmt::format("\"do\" cannot be {}", json_quoted(*text)),
                 did_you_mean(*text, what_can_be_done));
  }

  std::string path(const JsonPlace& root, const char* key, const char* cure, bool needed) {
    const auto place = needed ? root.need(key, cure) : root.find(key);
    const auto written = place ? place->text() : std::nullopt;
    if (!written) return "";
    if (const auto found = paths_.resolve(file_.file(), *written)) return *found;
    place->add("outside_project", fmt::format("\"{}\" lies outside the project {}", *written, paths_.project()),
               outside_cure(*written));
    return "";
  }

  static std::optional<WrittenNumber> number(const JsonPlace& object, const char* key) {
    const auto place = object.find(key);
    return place ? number_at(*place) : std::nullopt;
  }
  static std::optional<WrittenNumber> number_at(const JsonPlace& place) {
    const auto read = read_number(place);
    return read ? std::optional(WrittenNumber{*read, place.pointer()}) : std::nullopt;
  }

  void free(const JsonPlace& place) {
    FreeWish wish;
    if (place.is_text()) {
      wish.parameter = {*place.text(), place.pointer()};
      job_.free.push_back(std::move(wish));
      return;
    }
    if (!place.expect_object("{\"parameter\": \"stage.k\", \"lower\": \"1 N/um\", \"upper\": \"9 N/um\"}")) return;
    place.only({"parameter", "lower", "upper", "start", "scale", "prior", "scan", "per", "remark"});
    text_member(place, "remark");
    const auto name = place.need("parameter", "write \"parameter\": \"stage.k\"");
    if (name) wish.parameter = {name->text().value_or(""), name->pointer()};
    wish.lower = number(place, "lower");
    wish.upper = number(place, "upper");
    wish.start = number(place, "start");
    if (const auto scale = one_of(place, "scale", {"log", "linear"})) wish.log_scale = *scale == "log";
    if (const auto per = one_of(place, "per", {"recording", "all"})) wish.per_recording = *per == "recording";
    if (const auto prior = place.find("prior"); prior && prior->expect_array("[\"2 N/um\", \"3 N/um\"]")) {
      for (const auto& end : prior->elements())
        if (const auto value = number_at(end)) wish.prior.push_back(*value);
      if (prior->elements().size() != 2)
        prior->add_wrong_type("two numbers such as [\"2 N/um\", \"3 N/um\"]: the range that holds it with 95 %");
    }
    if (const auto scan = place.find("scan"); scan && scan->expect_array("[\"1 ms\", \"10 ms\", \"100 ms\"]"))
      for (const auto& element : scan->elements())
        if (const auto value = number_at(element)) wish.scan.push_back(*value);
    job_.free.push_back(std::move(wish));
  }

  static ThresholdWish thresholds(const JsonPlace& place) {
    ThresholdWish wish;
    place.only({"block", "count", "place", "remark"});
    text_member(place, "remark");
    if (const auto block = place.need("block", "write \"block\": \"core\", a block of type prandtl_ishlinskii"))
      wish.block = {block->text().value_or(""), block->pointer()};
    if (const auto count = place.need("count", "write \"count\": 10"))
      if (const auto n = whole_at(*count, 2, 200)) wish.count = static_cast<int>(*n);
    if (const auto where = one_of(place, "place", {"even", "swing"})) wish.by_swing = *where == "swing";
    return wish;
  }

  /// "pso", {"name": "pso", "runs": 500}, or a list of these to be compared.
  void methods(const JsonPlace& root) {
    if (const auto place = root.find("method")) {
      if (place->is_array())
        for (const auto& one : place->elements()) method(one);
      else
        method(*place);
      if (place->is_array() && place->elements().empty())
        place->add("bad_value", "there is no method in the list", "write \"method\": \"search\", or leave it out");
    }
    if (job_.methods.empty()) job_.methods.emplace_back();
  }

  void method(const JsonPlace& place) {
    MethodWish wish;
    if (place.is_text()) {
      wish.name = {*place.text(), place.pointer()};
      job_.methods.push_back(std::move(wish));
      return;
    }
    if (!place.expect_object("{\"name\": \"search\", \"starts\": 50}")) return;
    place.only({"name", "starts", "runs", "iterations", "then", "attractor", "remark"});
    text_member(place, "remark");
    const auto name = place.need("name", "write \"name\": \"search\", or a global method such as \"pso\"");
    if (name) wish.name = {name->text().value_or(""), name->pointer()};
    if (const auto at = place.find("starts"))
      if (const auto n = whole_at(*at, 0, 1e6)) wish.starts = static_cast<int>(*n);
    if (const auto at = place.find("runs"))
      if (const auto n = whole_at(*at, 1, 1e9)) wish.runs = static_cast<long>(*n);
    if (const auto at = place.find("iterations"))
      if (const auto n = whole_at(*at, 1, 1e6)) wish.iterations = static_cast<int>(*n);
    if (const auto then = one_of(place, "then", {"search", "nothing"})) wish.then_search = *then == "search";
    if (const auto at = place.find("attractor")) {
      if (at->is_array()) {
        wish.attractor.emplace();
        for (const auto& one : at->elements()) component(one, wish.attractor->components);
        if (at->elements().empty()) at->add("bad_value", "the attractor names no parameter", "leave it out");
      } else if (at->expect_object("{\"c\": \"core.c\", \"k\": \"core.k\", \"top\": \"10 V\"}")) {
        wish.attractor = attractor(*at);
      }
    }
    job_.methods.push_back(std::move(wish));
  }

  /// {"parameter": "core.c", "draw": [0.1, 0.9]}, or {"parameter": "core.k", "of": "core.c", "upper": [[0.1, 2.6]],
  /// ...}
  static void component(const JsonPlace& place, std::vector<AttractorComponentWish>& to) {
    if (!place.expect_object("{\"parameter\": \"core.c\", \"draw\": [0.1, 0.9]}")) return;
    place.only({"parameter", "draw", "of", "upper", "lower", "scale"});
    AttractorComponentWish wish;
    if (const auto at = place.need("parameter", "name the parameter by its path"))
      wish.parameter = {at->text().value_or(""), at->pointer()};
    const auto draw = place.find("draw"), of = place.find("of");
    if (draw.has_value() == of.has_value())
      place.add("bad_value", "a parameter of an attractor is either drawn or found from a drawn one",
                "give one of \"draw\": [low, high] and \"of\": \"path\" with \"upper\" and \"lower\"");
    if (draw && draw->expect_array("[0.1, 0.9]")) {
      for (const auto& end : draw->elements())
        if (const auto value = number_at(end)) wish.draw.push_back(*value);
      if (wish.draw.size() != 2) draw->add("bad_value", "a range has two ends", "write \"draw\": [low, high]");
    }
    if (of) wish.of = WrittenText{of->text().value_or(""), of->pointer()};
    for (const char* key : {"upper", "lower"}) {
      const auto at = of ? place.need(key, "write the curve as [[factor, rate], ...]") : place.find(key);
      if (!at || !at->expect_array("[[0.112, 2.644]]")) continue;
      for (const auto& term : at->elements()) {
        const auto pair = term.is_array() ? term.elements() : std::vector<JsonPlace>{};
        if (pair.size() != 2) {
          term.add("bad_value", "a term of a curve is factor * exp(rate x), found " + term.found(),
                   "write [factor, rate]");
          continue;
        }
        const auto factor = pair[0].number(), rate = pair[1].number();
        if (factor && rate) (*key == 'u' ? wish.upper : wish.lower).emplace_back(*factor, *rate);
      }
    }
    if (const auto scale = number_member(place, "scale")) wish.scale = *scale;
    to.push_back(std::move(wish));
  }

  static AttractorWish attractor(const JsonPlace& place) {
    AttractorWish wish;
    place.only({"c", "k", "top"});
    const auto path_of = [&](const char* key, const char* cure) {
      const auto at = place.need(key, cure);
      return at ? WrittenText{at->text().value_or(""), at->pointer()} : WrittenText{};
    };
    wish.c = path_of("c", "write \"c\": \"core.c\", the parameter c of the Jiles-Atherton block");
    wish.k = path_of("k", "write \"k\": \"core.k\", the parameter k of the Jiles-Atherton block");
    const auto top = place.need("top", "write \"top\": \"10 V\", the largest input of the recording");
    if (top)
      if (const auto value = number_at(*top)) wish.top = *value;
    return wish;
  }

  JsonFile file_;
  ProjectPaths paths_;
  FitJob job_;
};

}  // namespace

bool is_job(const std::string& file) {
  JsonFile json(file);
  const auto root = json.root();
  return root.is_object() && root.find("do").has_value();
}

FitJob read_fit_job(const std::string& file, const std::vector<std::string>& allowed) {
  return JobReader(file, allowed).read();
}

namespace {

using namespace schema;

Json free_entry() {
  Json pair = list_of("the range that holds it with 95 %", {{"$ref", "#/definitions/quantity"}});
  pair["minItems"] = pair["maxItems"] = 2;
  Json entry =
      object("a parameter that may change; what is not said comes from the diagram",
             {{"parameter",
               text("path in the diagram: \"stage.k\", \"core.weights\" (all its elements), \"core.weights[2]\"")},
              {"lower", quantity("lower bound", false)},
              {"upper", quantity("upper bound", false)},
              {"start", quantity("where the search begins", false)},
              {"scale", choice_of("log: searched in its logarithm, for what spans decades", {"log", "linear"})},
              {"prior", std::move(pair)},
              {"scan", list_of("further values at which the search may begin", {{"$ref", "#/definitions/quantity"}})},
              {"per", choice_of("recording: one value in each recording; default all", {"recording", "all"})},
              {"remark", text("what a reader should know")}},
             {"parameter"});
  return {{"anyOf", Json::array({text("its path alone"), std::move(entry)})}};
}

Json attractor_of_jiles_atherton() {
  return object("of nmpso: towards what the data of a Jiles-Atherton loop suggest",
                {{"c", text("path of the parameter c")},
                 {"k", text("path of the parameter k")},
                 {"top", quantity("largest input", false)}},
                {"c", "k", "top"});
}

Json attractor_of_any() {
  Json pair = list_of("lowest and highest value drawn", {{"$ref", "#/definitions/quantity"}});
  pair["minItems"] = pair["maxItems"] = 2;
  Json term = list_of("factor and rate of factor * exp(rate x)", {{"type", "number"}});
  term["minItems"] = term["maxItems"] = 2;
  Json curve =
      list_of("sum of exponentials of the drawn parameter, in the units in which the diagram shows both", term);
  Json scale{{"type", "number"}, {"description", "factor on the middle of both curves; default 1"}};
  return list_of("of nmpso: towards points that the data suggest",
                 object("a parameter that is drawn, or found halfway between two curves of a drawn one",
                        {{"parameter", text("its path")},
                         {"draw", pair},
                         {"of", text("path of the drawn parameter")},
                         {"upper", curve},
                         {"lower", curve},
                         {"scale", scale}},
                        {"parameter"}));
}

Json method_entry() {
  const Json name = choice_of(
      "search: bounded Levenberg-Marquardt; the others look for a start all over the box first: particle swarms of the "
      "thesis (pso, npso, nmpso), methods of NLopt (crs2, isres, esch, direct). slopes and tapi read the parameters of "
      "a "
      "prandtl_ishlinskii or tapi block as the thesis does, without a search and without intervals",
      {"search", "pso", "npso", "nmpso", "crs2", "isres", "esch", "direct", "slopes", "tapi"});
  Json whole{{"type", "integer"}, {"minimum", 0}};
  const auto count = [&](const char* meaning) {
    Json n = whole;
    n["description"] = meaning;
    return n;
  };
  Json entry = object("a method and its budget",
                      {{"name", name},
                       {"starts", count("points spread over the box; the search begins at the best two of all")},
                       {"runs", count("how many points a global method may try; default 505")},
                       {"iterations", count("trials of a search from one start; default 40")},
                       {"then", choice_of("what follows a global method; default search", {"search", "nothing"})},
                       {"attractor", {{"anyOf", Json::array({attractor_of_jiles_atherton(), attractor_of_any()})}}},
                       {"remark", text("what a reader should know")}},
                      {"name"});
  return {{"anyOf", Json::array({name, std::move(entry)})}};
}

}  // namespace

std::string job_schema() {
  const char* about = "What to do with diagrams and data: runs with figures and claims, a fit, or a study.";
  Json json = head("hysteron job", about);
  Json properties;
  add_head_members(properties);
  properties["do"] = choice_of("fit: find parameters from recordings", {"fit"});
  properties["diagram"] = text("the diagram, seen from the folder of this file");
  properties["data"] = text("the data set (.json) or one recording (.csv), seen from the folder of this file");
  properties["choose"] = {{"type", "object"},
                          {"description", "candidates of choices: {\"compensator\": \"none\"}"},
                          {"additionalProperties", {{"type", "string"}}}};
  properties["set"] = {{"type", "object"},
                       {"description", "other values of parameters: {\"controller.kp\": \"0.5 V/um\"}"},
                       {"additionalProperties", {{"type", {"string", "number"}}}}};
  properties["free"] = list_of("parameters that may change; default: those that the diagram marks", free_entry());
  properties["thresholds"] = object(
      "thresholds of a Prandtl-Ishlinskii block, placed and refined before the fit",
      {{"block", text("the block, of type prandtl_ishlinskii")},
       {"count", {{"type", "integer"}, {"minimum", 2}, {"maximum", 200}, {"description", "how many operators"}}},
       {"place", choice_of("even: over the largest swing; swing: dense where the input turns often; default even",
                           {"even", "swing"})},
       {"remark", text("what a reader should know")}},
      {"block", "count"});
  Json method = method_entry();
  Json several = list_of("several: all are run and compared, the best result is kept", method);
  several["minItems"] = 1;
  method["anyOf"].push_back(std::move(several));
  properties["method"] = std::move(method);
  properties["seed"] = {{"type", "integer"}, {"minimum", 0}, {"description", "of everything random; default 1"}};
  properties["profile"] =
      list_of("parameters whose profile is wanted: held at values around the result, all others fitted again",
              {{"type", "string"}});
  properties["write"] = text("where the fitted diagram is written too");
  json["type"] = "object";
  json["if"] = {{"properties", {{"do", {{"const", "runs"}}}}}};
  json["then"] = runs_job();
  Json otherwise;
  otherwise["if"] = {{"properties", {{"do", {{"const", "study"}}}}}};
  otherwise["then"] = study_job();
  otherwise["else"] = object("a fit", std::move(properties), {"format", "do", "diagram", "data"});
  json["else"] = std::move(otherwise);
  return to_text(json);
}

}  // namespace hysteron
