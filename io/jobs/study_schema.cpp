#include "io/jobs/study_schema.h"

#include "io/jobs/study_job.h"
#include "io/json/schema_parts.h"

namespace hysteron::schema {
namespace {

Json whole(const char* meaning, int least) {
  return {{"type", "integer"}, {"minimum", least}, {"description", meaning}};
}

Json parameter() {
  const Json values = list_of("of a grid or a list", {{"$ref", "#/definitions/quantity"}});
  return object("how it is drawn",
                {{"from", quantity("lowest value", false)},
                 {"to", quantity("highest value", false)},
                 {"scale", choice_of("log: evenly in the logarithm; default linear", {"linear", "log"})},
                 {"points", whole("of a grid: how many, both ends included", 1)},
                 {"values", values},
                 {"file", text("of a list: a CSV that holds the values")},
                 {"column", text("of file: the column; default: the name of the parameter")},
                 {"remark", text("what a reader should know")}});
}

Json sample() {
  Json parameters{{"type", "object"},
                  {"description", "what is varied: path in the diagram -> how"},
                  {"minProperties", 1},
                  {"additionalProperties", parameter()}};
  return object("the draws; draw i is a function of seed and i alone",
                {{"method", choice_of("default uniform", study_sampling_methods())},
                 {"seed", whole("of everything random; default 1", 0)},
                 {"draws", whole("how many", 1)},
                 {"accepted", whole("in place of draws: until so many pass the filters", 1)},
                 {"give_up_after", whole("of accepted: at most so many draws; default 1000 for each", 1)},
                 {"shards", whole("parts that are computed and kept one by one; default 16", 1)},
                 {"parameters", std::move(parameters)},
                 {"remark", text("what a reader should know")}},
                {"parameters"});
}

Json feature() {
  Json window = list_of("from when to when, both ends included", {{"$ref", "#/definitions/quantity"}});
  window["minItems"] = window["maxItems"] = 2;
  const Json minus{
      {"description", "what is subtracted at the same instants: a signal, or a column of a CSV with a column t"},
      {"anyOf", Json::array({text("a signal"),
                             object("a column", {{"file", text("")}, {"column", text("")}}, {"file", "column"})})}};
  Json any = Json::array({object("taken from the simulation",
                                 {{"take", choice_of("what is taken", study_takes())},
                                  {"of", text("the signal")},
                                  {"minus", minus},
                                  {"over", text("of an area: the signal along x")},
                                  {"between", std::move(window)},
                                  {"rezero", flag("less the value at the first row")},
                                  {"at", quantity("of at: when", false)},
                                  {"unit", text("in which it is kept; default: that of the signal")},
                                  {"remark", text("what a reader should know")}},
                                 {"take", "of"})});
  const Json operand{{"type", {"string", "number"}}};
  for (const auto& how : combinations())
    any.push_back(object(how + " of features that stand before, parameters, and numbers such as \"0.5 V\"",
                         {{how, list_of("", operand)}, {"unit", text("")}, {"remark", text("")}}, {how}));
  return {{"anyOf", std::move(any)}};
}

Json conditions(const char* meaning) {
  return list_of(meaning, object("a bound on a feature or a varied parameter",
                                 {{"feature", text("its name")},
                                  {"above", quantity("greater than", false)},
                                  {"at_least", quantity("greater than or equal to", false)},
                                  {"below", quantity("less than", false)},
                                  {"at_most", quantity("less than or equal to", false)},
                                  {"remark", text("")}},
                                 {"feature"}));
}

Json study_axis() {
  return {{"anyOf", Json::array({text("a feature or a varied parameter"),
                                 object("the same with its axis",
                                        {{"feature", text("")},
                                         {"label", text("")},
                                         {"from", quantity("where the axis begins", false)},
                                         {"to", quantity("where it ends", false)},
                                         {"log", flag("logarithmic")}},
                                        {"feature"})})}};
}

Json study_plot() {
  return object("a figure of the report",
                {{"title", text("")},
                 {"kind", choice_of("default: scatter where there is a y", {"histogram", "scatter"})},
                 {"x", study_axis()},
                 {"y", study_axis()},
                 {"bins", whole("of a histogram; default 30", 2)},
                 {"samples", choice_of("default accepted", {"accepted", "all"})},
                 {"where", conditions("only samples that meet these")},
                 {"caption", text("")},
                 {"remark", text("")}},
                {"x"});
}

}  // namespace

Json study_job() {
  Json properties;
  add_head_members(properties);
  properties["do"] = choice_of("study: many parameter sets of one diagram", {"study"});
  properties["diagram"] = text("the diagram, seen from the folder of this file");
  properties["choose"] = {{"type", "object"},
                          {"description", "candidates of choices: {\"compensator\": \"none\"}"},
                          {"additionalProperties", {{"type", "string"}}}};
  properties["set"] = {{"type", "object"},
                       {"description", "other values of parameters: {\"controller.kp\": \"0.5 V/um\"}"},
                       {"additionalProperties", {{"type", {"string", "number"}}}}};
  properties["until"] = quantity("until when it is simulated; default: as the diagram says", false);
  properties["every"] = quantity("how often a row is looked at; default: as the diagram says", false);
  properties["solver"] =
      object("default: as the diagram says", {{"method", text("as in a diagram: euler, rk4, auto ...")},
                                              {"step", quantity("of the methods with fixed steps", false)}});
  properties["sample"] = sample();
  properties["features"] = named("what is taken from each simulation", feature());
  properties["filters"] = conditions("what a sample must meet to be accepted");
  properties["refused"] = choice_of(
      "parameter values that a block refuses (outside the range of its law): rejected (default), or simulated all the "
      "same",
      {"rejected", "simulated"});
  properties["keep"] = choice_of("all: rejected samples, too; default accepted", {"accepted", "all"});
  properties["plots"] = list_of("the figures", study_plot());
  return object("a study", std::move(properties), {"format", "do", "diagram", "sample", "features"});
}

}  // namespace hysteron::schema
