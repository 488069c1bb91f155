#include "io/jobs/runs_schema.h"

#include "io/jobs/runs_job.h"
#include "io/json/schema_parts.h"

namespace hysteron::schema {
namespace {

Json names(const char* meaning) {
  return {{"description", meaning}, {"anyOf", Json::array({text("one"), list_of("several", {{"type", "string"}})})}};
}

Json window() {
  Json w = list_of("from when to when, both ends included", {{"$ref", "#/definitions/quantity"}});
  w["minItems"] = w["maxItems"] = 2;
  return w;
}

Json minus() {
  return {
      {"description", "a signal that is subtracted: of the same run, or of another one at the same instants"},
      {"anyOf", Json::array({text("of the same run"),
                             object("of another run", {{"run", text("")}, {"signal", text("")}}, {"run", "signal"})})}};
}

void add_settings(Json& properties) {
  properties["choose"] = {{"type", "object"},
                          {"description", "candidates of choices: {\"compensator\": \"none\"}"},
                          {"additionalProperties", {{"type", "string"}}}};
  const Json of =
      object("a value of this job", {{"of", text("its name")}, {"times", number("factor; default 1")}}, {"of"});
  properties["set"] = {
      {"type", "object"},
      {"description",
       "other values of parameters: {\"controller.kp\": \"0.5 V/um\", \"model.origin\": {\"of\": \"bottom\"}}"},
      {"additionalProperties", {{"anyOf", Json::array({{{"type", {"string", "number"}}}, of})}}}};
}

void add_times(Json& properties) {
  properties["until"] = quantity("until when it is simulated; default: as the diagram says", false);
  properties["every"] = quantity("how often a row is recorded; default: as the diagram says", false);
}

Json where() {
  return list_of("rows alone for which all of this holds", object("both ends included; either may be left out",
                                                                  {{"signal", text("")},
                                                                   {"minus", minus()},
                                                                   {"from", {{"$ref", "#/definitions/quantity"}}},
                                                                   {"to", {{"$ref", "#/definitions/quantity"}}}},
                                                                  {"signal"}));
}

Json points() {
  Json point = list_of("a place along the run, and the value there", {{"$ref", "#/definitions/quantity"}});
  point["minItems"] = point["maxItems"] = 2;
  return list_of("of off_points: [[\"0.1 s\", \"2 um\"], ...]", std::move(point));
}

Json value(bool with_run) {
  Json properties{{"take", choice_of("what is taken", takes())},
                  {"of", text("the signal")},
                  {"minus", minus()},
                  {"same_stroke", flag("scaled to the stroke of what is subtracted before it is")},
                  {"over", text("of an area: the signal along x")},
                  {"between", window()},
                  {"rezero", flag("less the value at the first row")},
                  {"at", quantity("of at: when", false)},
                  {"where", where()},
                  {"above", quantity("of rss_above and line_above: frequency; of share: counted above it", false)},
                  {"below", quantity("of share: counted below it", false)},
                  {"points", points()},
                  {"parameter", text("of parameter: its path in the fit")},
                  {"figure", text("of frequency and damping: 1, 2 ... by rising frequency; of computed: the formula")},
                  {"remark", text("what a reader should know")}};
  if (with_run) properties["run"] = text("the run");
  Json measured = object("measured on a run", std::move(properties), {"take"});
  if (!with_run) return measured;
  Json combined = Json::array();
  combined.push_back(object("a number as it stands",
                            {{"constant", {{"$ref", "#/definitions/quantity"}}}, {"remark", text("")}}, {"constant"}));
  for (const auto& how : combinations())
    combined.push_back(object(how + " of values", {{how, names("values of this job")}, {"remark", text("")}}, {how}));
  combined.insert(combined.begin(), std::move(measured));
  return {{"anyOf", std::move(combined)}};
}

/// A search in place of a simulation.
Json minimize() {
  Json range = list_of("two values between which it lies", {{"$ref", "#/definitions/quantity"}});
  range["minItems"] = range["maxItems"] = 2;
  return object(
      "parameters at which a value of this run is smallest, sought by a global method; gives a row per seed and "
      "iteration",
      {{"value", value(false)},
       {"parameters",
        {{"type", "object"}, {"description", "path -> range"}, {"additionalProperties", std::move(range)}}},
       {"method", text("a global method of docs/fit.md; default pso")},
       {"runs", number("budget of simulations of each search; default 505")},
       {"seeds", number("searches, with the seeds 1, 2 ...; default 1")},
       {"attractor", object("of nmpso: which parameters are c and k of Jiles-Atherton, and the largest input",
                            {{"c", text("")}, {"k", text("")}, {"top", quantity("", false)}}, {"c", "k", "top"})},
       {"full", object("other sizes with --full", {{"seeds", number("")}, {"runs", number("")}})}},
      {"value", "parameters"});
}

Json run() {
  Json properties;
  properties["title"] = text("its name in legends");
  properties["remark"] = text("what a reader should know");
  properties["diagram"] = text("its diagram; default: that of the job, with the job's choose and set");
  add_settings(properties);
  add_times(properties);
  properties["use"] = {
      {"description",
       "parameters that another run found: \"fitted\", or {\"fitted\": \"compensator\"}, which sets "
       "compensator.alpha to its alpha"},
      {"anyOf", Json::array({text("one run"), list_of("several", {{"type", "string"}}),
                             Json{{"type", "object"}, {"additionalProperties", {{"type", "string"}}}}})}};
  properties["linearize"] =
      object("gain and phase over frequency in place of a simulation",
             {{"from", text("where the small motion enters")},
              {"to", text("where it is looked at")},
              {"open", names("the loop is opened there")},
              {"at", quantity("operating point: where a simulation is then; default: the equilibrium", false)}},
             {"from", "to"});
  properties["fit"] = text("a fit in place of a simulation: its job, or the diagram whose free parameters are sought");
  properties["method"] = text("of fit: search (default), slopes, tapi, or a global method of docs/fit.md");
  properties["free"] = names("parameters that are free too: core.weights");
  properties["data"] = object("of a fit: the rows of another run, from rest",
                              {{"run", text("")},
                               {"columns",
                                {{"type", "object"},
                                 {"description", "input or output of the diagram -> signal of the run"},
                                 {"additionalProperties", {{"type", "string"}}}}},
                               {"between", window()},
                               {"rezero", names("columns less their value at the first row of the window")}},
                              {"run", "columns"});
  properties["table"] = text("a CSV in place of a simulation");
  properties["minimize"] = minimize();
  properties["study"] = text("a study in place of a simulation: its job; gives its accepted samples as rows");
  properties["record"] = names("of study: parameters and features that become signals; default all");
  properties["draws"] = number("of study: so many draws, instead of what its job says");
  properties["accepted"] = number("of study: as many draws as so many accepted ones take");
  properties["step"] = quantity("of study: of a fixed-step solver", false);
  properties["full"] = object(
      "of study: its size with --full",
      {{"draws", number("")}, {"accepted", number("")}, {"every", quantity("", false)}, {"step", quantity("", false)}});
  properties["select"] = text("rows of another run, those for which where holds");
  properties["where"] = where();
  properties["rows"] = {
      {"type", "object"},
      {"description", "rows made of values of this job and of numbers: {\"f\": [\"10 Hz\"], \"area\": [\"area_10\"]}"},
      {"additionalProperties", list_of("values by name, or numbers", {{"type", {"string", "number"}}})}};
  properties["computed"] = choice_of("rows of a formula", computed_rows());
  properties["of"] = {{"type", "object"},
                      {"description", "of computed: the run, and which of its signals is which argument"},
                      {"additionalProperties", {{"type", "string"}}}};
  properties["top"] = quantity("of computed: largest input", false);
  properties["from"] = text("another job, whose run this is");
  properties["run"] = text("of from: its name there; default: the same");
  Json range = list_of("two values between which it lies", {{"$ref", "#/definitions/quantity"}});
  range["minItems"] = range["maxItems"] = 2;
  properties["find"] = object(
      "the value of a parameter at which this run gives what is wanted",
      {{"parameter", text("")}, {"range", std::move(range)}, {"value", value(false)}, {"equals", quantity("", false)}},
      {"parameter", "range", "value", "equals"});
  return object("one run", std::move(properties));
}

Json axis() {
  return object("what is drawn along an axis", {{"signal", text("a signal; t is the time")},
                                                {"signals", names("several signals of each run")},
                                                {"minus", minus()},
                                                {"label", text("")},
                                                {"unit", text("")},
                                                {"from", quantity("where the axis begins", false)},
                                                {"to", quantity("where it ends", false)},
                                                {"log", flag("logarithmic")}});
}

Json plot() {
  return object("a figure",
                {{"title", text("")},
                 {"kind", choice_of("default curve", {"curve", "spectrum", "histogram", "scatter", "medians", "bode"})},
                 {"x", axis()},
                 {"y", axis()},
                 {"runs", names("default: all that have the signals")},
                 {"between", window()},
                 {"rezero", flag("less the value at the first row")},
                 {"where", where()},
                 {"bins", number("of a histogram; default 30")},
                 {"caption", text("")},
                 {"remark", text("")}});
}

Json claim() {
  const auto written = [](const char* meaning) {
    return Json{{"type", {"string", "number"}}, {"description", meaning}};
  };
  return object("a condition by which this job settles a claim, or a part of it",
                {{"id", text("as in claims.json")},
                 {"value", text("a value of this job")},
                 {"expected", written("\"6.6 um\"")},
                 {"tolerance", written("\"1 %\" or \"1e-6 um\"")},
                 {"above", written("the value lies above")},
                 {"below", written("the value lies below")},
                 {"order", list_of("values that increase in this order", {{"type", "string"}})},
                 {"must", choice_of("differ: the value must lie outside the tolerance", {"agree", "differ"})},
                 {"thesis", text("what the published work says")},
                 {"remark", text("why it differs, where it does")}},
                {"id"});
}

}  // namespace

Json runs_job() {
  Json properties;
  add_head_members(properties);
  properties["do"] = choice_of("runs: simulate, draw figures and settle claims", {"runs"});
  properties["surrogate"] = text("what stands in for a measurement; printed wherever its output appears");
  properties["assumed"] = text("numbers that the published work does not give");
  properties["shows"] = text("what the figure must show");
  properties["learnt"] = text("what was learnt about the printed equations");
  properties["diagram"] = text("the diagram of runs that name none");
  add_settings(properties);
  add_times(properties);
  properties["draw"] = {{"type", "object"},
                        {"description", "block diagrams that the page shows: caption -> diagram"},
                        {"additionalProperties", {{"type", "string"}}}};
  properties["runs"] = named("the runs", run());
  properties["plots"] = list_of("the figures", plot());
  properties["values"] = named("what is measured on them", value(true));
  properties["claims"] = list_of("what they settle", claim());
  return object("runs of diagrams, figures and claims", std::move(properties), {"format", "do"});
}

}  // namespace hysteron::schema
