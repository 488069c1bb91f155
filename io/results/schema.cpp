#include "io/results/schema.h"

#include "io/json/schema_parts.h"

namespace hysteron {
namespace {

using namespace schema;

Json column() {
  const Json noise_object =
      object("what is known of the noise", {{"white", quantity("rms", false)},
                                            {"resolution", quantity("smallest step of the converter", false)},
                                            {"one_over_f", quantity("rms of the 1/f part over the white rms", false)}});
  return object(
      "how a column is meant",
      {{"to",
        text("input or output of the diagram, or the name under which effects find the column; default: its own name")},
       {"unit", text("the unit of its numbers, whatever its header says: um, rpm, or 1 for plain numbers")},
       {"between_samples", choice_of("how it moves between samples; default linear", {"linear", "hold", "smooth"})},
       {"noise",
        {{"description", "rms of white noise, or white, resolution and one_over_f"},
         {"anyOf", Json::array({{{"$ref", "#/definitions/quantity"}}, noise_object})}}},
       {"zero", choice_of("per_recording: the sensor's zero is arbitrary each time; default shared",
                          {"shared", "per_recording"})},
       {"delay",
        {{"type", {"string", "integer"}},
         {"description", "the column shows the past by this much: \"1 sample\", \"5 ms\""}}},
       {"limits",
        {{"description", "ends of its range: rows at or beyond them are not judged; or find, for where rows pile up"},
         {"anyOf", Json::array({choice_of("", {"find"}), list_of("", {{"$ref", "#/definitions/quantity"}})})}}},
       {"optional", {{"type", "boolean"}, {"description", "some recordings may lack it"}}},
       {"remark", text("what a reader should know")}});
}

Json recording() {
  const Json values{{"type", "object"}, {"additionalProperties", {{"$ref", "#/definitions/quantity"}}}};
  Json weight = number("how much it counts in a fit; default 1");
  weight["exclusiveMinimum"] = 0;
  return object(
      "one measured file, or a part of it",
      {{"file", text("CSV with a header such as t [s],u [V],y [um], or a file of an instrument (docs/recordings.md)")},
       {"role", choice_of("train fits, validate judges and chooses, test is read once, at the end",
                          {"train", "validate", "test"})},
       {"start", quantity("when it began [h], for ageing and drift", false)},
       {"cycles_before", number("cycles of the device before it, for ageing")},
       {"initial",
        {{"description",
          "rest: equilibrium and virgin memory (default); per_recording: estimated; or states with their values"},
         {"anyOf", Json::array({choice_of("", {"rest", "per_recording"}), values})}}},
       {"skip", quantity("not judged at its beginning [s]", false)},
       {"until", quantity("judged until so long after its beginning [s]", false)},
       {"exclude", list_of("spans that are not judged, counted from the first row: [[\"2 s\", \"3.5 s\"]]",
                           list_of("begin and end", {{"$ref", "#/definitions/quantity"}}))},
       {"weight", std::move(weight)},
       {"remark", text("what a reader should know")}},
      {"file"});
}

Json curve() {
  const Json axis{{"anyOf", Json::array({text("a column of the trace"),
                                         list_of("numbers; null is a gap", {{"type", {"number", "null"}}})})}};
  return object("two columns of a trace, or numbers",
                {{"name", text("")},
                 {"style", text("line, points or steps")},
                 {"role", text("measured, simulated, residual, before, after")},
                 {"trace", text("file in traces/")},
                 {"x", axis},
                 {"y", axis},
                 {"colour", text("time: runs through a scale from the first point to the last")}},
                {"name", "x", "y"});
}

Json figure() {
  const Json bar = object(
      "", {{"label", text("")}, {"value", {{"type", {"number", "null"}}}}, {"text", text("")}, {"role", text("")}},
      {"label", "value"});
  return object("a figure of the report",
                {{"title", text("")},
                 {"kind", choice_of("", {"curves", "bars", "waterfall", "picture"})},
                 {"x_label", text("quantity and unit")},
                 {"y_label", text("quantity and unit")},
                 {"log_x", {{"type", "boolean"}}},
                 {"log_y", {{"type", "boolean"}}},
                 {"x_range", list_of("ends of the axis where they are given", {{"type", "number"}})},
                 {"y_range", list_of("ends of the axis where they are given", {{"type", "number"}})},
                 {"curves", list_of("", curve())},
                 {"bars", list_of("", bar)},
                 {"picture", text("an SVG beside this file")},
                 {"caption", text("")}},
                {"title", "kind"});
}

Json section() {
  const Json texts = list_of("", {{"type", "string"}});
  const Json table =
      object("", {{"title", text("")}, {"columns", texts}, {"rows", list_of("", texts)}}, {"columns", "rows"});
  return object("a section of the report",
                {{"title", text("")},
                 {"text", list_of("paragraphs", {{"type", "string"}})},
                 {"tables", list_of("", table)},
                 {"figures", list_of("", figure())},
                 {"preformatted", object("a diff, a diagram", {{"title", text("")}, {"text", text("")}})}},
                {"title"});
}

}  // namespace

std::string dataset_schema() {
  Json json = head("hysteron data set",
                   "Recordings bound to the inputs and outputs of a diagram, with their roles and circumstances.");
  Json properties;
  add_head_members(properties);
  properties["columns"] = {{"type", "object"},
                           {"description", "columns of the files, by the name in their header"},
                           {"additionalProperties", column()}};
  properties["recordings"] = list_of("the measured files", recording());
  properties["recordings"]["minItems"] = 1;
  json.update(object("Recordings bound to the inputs and outputs of a diagram, with their roles and circumstances.",
                     std::move(properties), {"format", "recordings"}));
  return to_text(json);
}

std::string result_schema() {
  Json json = head("hysteron result", "What one verb found: for programs. report.html shows the same to people.");
  json.erase("definitions");
  Json properties;
  add_head_members(properties);
  properties.erase("source");
  properties.erase("remark");
  properties["program"] = {{"const", "hysteron"}};
  properties["version"] = text("version of hysteron that wrote it");
  properties["verb"] = text("what was asked: compare, discover ...");
  properties["headline"] = text("the answer in one sentence");
  properties["verdict"] = choice_of("empty where the verb gives none",
                                    {"", "adequate", "missing_effect", "not_distinguishable", "unexplained"});
  properties["sentences"] = list_of("what matters, most important first", {{"type", "string"}});
  properties["warnings"] = list_of("what must not be overlooked", {{"type", "string"}});
  properties["facts"] = {{"type", "object"},
                         {"description", "numbers and names, by verb; units stand in the names or beside the values"}};
  properties["answer"] = list_of("figures that show the headline, on the first screen of the report", figure());
  properties["sections"] = list_of("what the report shows", section());
  properties["traces"] = list_of("files in traces/", {{"type", "string"}});
  properties["files"] = list_of("further files of the folder", {{"type", "string"}});
  properties["data"] = list_of("large files of numbers in the folder", {{"type", "string"}});
  json.update(object(
      "What one verb found: for programs. report.html shows the same to people.", std::move(properties),
      {"format", "program", "version", "verb", "headline", "verdict", "sentences", "warnings", "facts", "sections"}));
  return to_text(json);
}

}  // namespace hysteron
