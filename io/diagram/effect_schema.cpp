// Decides the JSON Schema of an effect file: that of a diagram, and the member "effect".
#include "io/diagram/diagram_file.h"
#include "io/diagram/place_kinds.h"
#include "io/json/schema_parts.h"

namespace hysteron {
namespace {

using namespace schema;

/// A number, or one that depends on the wire.
Json quantity_of_wire(const std::string& description) {
  return {{"description", description + ": 5, \"0.2 ms\", or of the wire: \"0.1 range\", \"1 row\", \"0.2 recording\""},
          {"type", Json::array({"number", "string"})}};
}

Json truth(const std::string& description) { return {{"type", "boolean"}, {"description", description}}; }

Json count(const std::string& description) {
  return {{"type", "integer"}, {"minimum", 0}, {"description", description}};
}

Json free_number() {
  Json scan{
      {"description", "values at which a fit begins"},
      {"anyOf", Json::array({list_of("", quantity_of_wire("a value")), object("evenly over the decades",
                                                                              {{"from", quantity_of_wire("first")},
                                                                               {"to", quantity_of_wire("last")},
                                                                               {"per_decade", number("default 3")}},
                                                                              {"from", "to"})})}};
  Json usual = list_of("from and to; outside is possible, but said to be unusual", quantity_of_wire("an end"));
  usual["minItems"] = 2;
  usual["maxItems"] = 2;
  return object("a number that a fit finds",
                {{"meaning", text("what it is, for people")},
                 {"start", quantity_of_wire("where a fit begins")},
                 {"lower", quantity_of_wire("smallest value")},
                 {"upper", quantity_of_wire("largest value")},
                 {"scan", std::move(scan)},
                 {"log_scale", truth("searched on a logarithmic scale; needs a lower bound above zero")},
                 {"usual", std::move(usual)},
                 {"usual_source", text("where the usual range is known from")},
                 {"per_recording", truth("another value in each recording")}},
                {"meaning", "start"});
}

Json effect_member() {
  const Json kind = choice_of("a kind of place", place_kinds);
  Json at = list_of("kinds of place where it may enter", kind);
  at["minItems"] = 1;
  Json free{{"type", "object"},
            {"description", "parameters of the diagram that a fit finds: \"tau\", or an element \"times[0]\""},
            {"minProperties", 1},
            {"additionalProperties", free_number()}};
  Json fixed{{"type", "object"},
             {"description", "parameters of the diagram that follow from the wire: {\"reference\": \"1 side_middle\"}"},
             {"additionalProperties", quantity_of_wire("value")}};
  Json needs = object("what recordings must have to show it",
                      {{"text", text("for people")},
                       {"range", quantity_of_wire("the signal spans at least this")},
                       {"hold", quantity_of_wire("longest time at one level")},
                       {"side_range", quantity_of_wire("the side signal spans at least this")},
                       {"reversals", count("turning points")},
                       {"recordings", count("train recordings")},
                       {"changes_sign", truth("the signal is on both sides of zero")}},
                      {"text"});
  Json alike = object("an effect that can be taken for this one",
                      {{"effect", text("its id")},
                       {"experiment", text("the experiment that separates them: triangle, step_hold, multisine ...")},
                       {"decides", text("what decides")}},
                      {"effect", "experiment", "decides"});
  Json id = text("its name in results and on the command line");
  id["pattern"] = "^[a-z][a-z0-9_]*$";
  return object(
      "what the diagram means as an effect; without it (\"off\") the wire is as it was",
      {{"id", std::move(id)},
       {"cause", text("why it is there, physically")},
       {"equation", text("the law")},
       {"residual", text("what a model without it leaves")},
       {"enters_at", std::move(at)},
       {"behind_core", truth("at the core only behind it")},
       {"moves_zero", truth("it shifts the middle of the signal: a zero of the sensor is found anew with it")},
       {"law", text("name of this form of the law")},
       {"free", std::move(free)},
       {"fixed", std::move(fixed)},
       {"needs", std::move(needs)},
       {"look_alikes", list_of("what is easily taken for it", std::move(alike))},
       {"contains", list_of("effects that it can imitate: no rivals of theirs", text("an effect"))},
       {"says", text("a fitted law in one phrase: \"limit {limit}\"")}},
      {"id", "cause", "equation", "enters_at", "free", "needs", "look_alikes"});
}

}  // namespace

std::string effect_schema(const Registry& registry) {
  Json json = Json::parse(diagram_schema(registry));
  json["title"] = "hysteron effect";
  json["description"] =
      "A diagram with the input \"in\" and the output \"out\" that is put on a wire, and what it means as an effect.";
  json["properties"]["effect"] = effect_member();
  json["required"] = {"format", "title", "source", "inputs", "blocks", "outputs", "effect"};
  return schema::to_text(json);
}

}  // namespace hysteron
