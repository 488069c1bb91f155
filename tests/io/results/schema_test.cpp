// The JSON Schemas against files that the reader takes and files that it refuses, by an independent validator
// (valijson).
#include "io/results/schema.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "blocks/register_all.h"
#include "io/data/dataset.h"
#include "io/diagram/diagram_file.h"
#include "io/diagram/text_diff.h"
#include "io/jobs/claims_file.h"
#include "io/jobs/job_file.h"
#include "io/results/result.h"
#include "tests/io/schema_validator.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

using Json = nlohmann::json;

const SchemaValidator& diagrams() {
  static const SchemaValidator schema(diagram_schema(all_blocks()));
  return schema;
}
const SchemaValidator& datasets() {
  static const SchemaValidator schema(dataset_schema());
  return schema;
}

std::string with_block(const std::string& block) { return "{\"format\": 1, \"blocks\": {\"a\": " + block + "}}"; }

const char* good_diagram = R"json({
  "$schema": "../schema/diagram.schema.json", "format": 1, "title": "t", "source": "s", "remark": "r",
  "parameters": {"amplitude": {"value": 3, "unit": "um", "bounds": [null, "10 um"], "free": true, "remark": "x"}, "kp": "1.2 V/um", "n": 5},
  "inputs": {"u": {"unit": "V"}},
  "blocks": {
    "reference": {"type": "sine", "amplitude": "$amplitude", "offset": {"value": 3, "unit": "um"}, "frequency": "5 Hz", "phase": "-90 deg"},
    "error": {"type": "sum", "signs": "+-", "in": ["reference", "y.displacement"]},
    "controller": {"type": "pi_controller", "kp": "$kp", "ki": "7009 V/(um s)", "in": {"e": "error"}},
    "creep": {"choose": "on", "effect": "creep", "in": "u",
              "from": {"off": {"type": "pass"}, "on": {"type": "creep", "amounts": [0.004, 0.01], "times": ["0.3 s", "3 s"]}}},
    "set": {"type": "bouc_wen", "parameters": "p.json", "in": "creep"},
    "y": {"type": "diagram", "file": "stage.json", "gain": 5, "controller.kp": "0.5 V/um", "in": "set"},
    "lab": {"type": "recorded", "file": "lab.csv", "column": "u", "between_samples": "hold"}
  },
  "outputs": {"y": "y.displacement"}, "record": ["reference", "error"], "places": {"command": "u", "measured": ["y", "set"]},
  "simulate": {"until": "1 s", "every": 0.001, "solver": {"method": "bdf", "relative_tolerance": 1e-8, "absolute_tolerance": 0.01, "max_step": "1 ms"},
               "loops": "solve", "guess": {"error": "1 um", "y/inner.out[0]": 2}}
})json";

TEST(DiagramSchema, AcceptsEveryPartOfTheFormat) { EXPECT_EQ(diagrams().refuses(good_diagram), ""); }

TEST(DiagramSchema, AcceptsWhatTheWriterWrites) {
  const TemporaryFolder folder;
  folder.write("p.json", "{}");
  folder.write("stage.json", "{\"format\": 1, \"blocks\": {}}");
  folder.write("lab.csv", "t [s],u [V]\n0,1\n1,2\n");
  const Diagram d = read_diagram(folder.write("d.json", good_diagram));
  EXPECT_EQ(diagrams().refuses(diagram_text(d)), "");
}

TEST(DiagramSchema, EveryBlockTypeIsKnownWithItsRequiredParameters) {
  const Registry registry = all_blocks();
  for (const auto& type : registry.types()) {
    const auto& d = registry.find(type)->declaration;
    if (d.group == "internal") continue;
    Json block{{"type", type}};
    if (d.is_series) block["file"] = "a.csv", block["column"] = "u";
    bool any_required = d.is_series;
    for (const auto& p : d.parameters) {
      if (p.default_text) continue;
      any_required = true;
      if (p.kind == ParameterKind::text)
        block[p.name] = p.choices.empty() ? "x" : p.choices.front();
      else if (p.kind == ParameterKind::list)
        block[p.name] = Json::array({1, "2 V"});
      else if (p.kind == ParameterKind::matrix)
        block[p.name] = Json::array({Json::array({1, "2 V"}), Json::array({0, 3})});
      else
        block[p.name] = "1 V";
    }
    EXPECT_EQ(diagrams().refuses(with_block(block.dump())), "") << type;
    if (any_required) {
      EXPECT_NE(diagrams().refuses(with_block("{\"type\": \"" + type + "\"}")), "") << type;
    }
    block["no_such_parameter"] = 1;
    const bool names_its_own = !d.names_from.empty();
    EXPECT_EQ(diagrams().refuses(with_block(block.dump())) == "", names_its_own) << type;
    block["no_such_parameter"] = true;
    EXPECT_NE(diagrams().refuses(with_block(block.dump())), "") << type;
  }
}

TEST(DiagramSchema, RefusesWhatTheReaderRefuses) {
  const char* wrong[] = {
      "[]",
      "{\"blocks\": {}}",
      "{\"format\": 1}",
      "{\"format\": 2, \"blocks\": {}}",
      "{\"format\": 1, \"blocks\": {}, \"recrod\": []}",
      "{\"format\": 1, \"blocks\": {\"Upper\": {\"type\": \"pass\"}}}",
      "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"no_such_type\"}}}",
      "{\"format\": 1, \"blocks\": {\"a\": {}}}",
      "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"input\"}}}",
      "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"gain\", \"gain\": null}}}",
      "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"gain\", \"gain\": \"many\"}}}",
      "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"gain\", \"gain\": {\"value\": 1, \"units\": \"V\"}}}}",
      "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"gain\", \"gain\": 1, \"in\": 5}}}",
      "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"diagram\"}}}",
      "{\"format\": 1, \"blocks\": {\"a\": {\"choose\": \"x\"}}}",
      "{\"format\": 1, \"blocks\": {\"a\": {\"choose\": \"x\", \"from\": {\"x\": {\"type\": \"pass\", \"in\": "
      "\"b\"}}}}}",
      "{\"format\": 1, \"blocks\": {\"a\": {\"choose\": \"x\", \"from\": {\"x\": {\"type\": \"pass\"}}, \"type\": "
      "\"gain\"}}}",
      "{\"format\": 1, \"blocks\": {}, \"parameters\": {\"k\": {\"value\": 1, \"bounds\": [0]}}}",
      "{\"format\": 1, \"blocks\": {}, \"parameters\": {\"k\": {\"value\": 1, \"free\": 1}}}",
      "{\"format\": 1, \"blocks\": {}, \"inputs\": {\"u\": \"V\"}}",
      "{\"format\": 1, \"blocks\": {}, \"places\": {\"comand\": \"a\"}}",
      "{\"format\": 1, \"blocks\": {}, \"simulate\": {\"solver\": {\"method\": \"heun\"}}}",
      "{\"format\": 1, \"blocks\": {}, \"simulate\": {\"until\": \"soon\"}}",
  };
  const TemporaryFolder folder;
  for (const auto* text : wrong) EXPECT_NE(diagrams().refuses(text), "") << text;
}

const char* good_dataset = R"({ "$schema": "../schema/dataset.schema.json", "format": 1, "title": "stage 3, May",
  "columns": {"u": {"to": "u", "between_samples": "linear"},
              "y": {"to": "y", "noise": {"white": "2 nm", "resolution": "0.1 nm"}, "zero": "per_recording", "delay": "1 sample"},
              "T": {"to": "temperature", "noise": "0.01 degC", "optional": true}},
  "recordings": [
    {"file": "01.csv", "role": "train", "start": "0.69 h", "cycles_before": 0, "initial": "rest"},
    {"file": "01.csv", "role": "test", "start": 0.7, "initial": {"stage.x": "1 um"}},
    {"file": "02.csv", "role": "validate", "start": "1.4 h", "cycles_before": 48580, "initial": "per_recording", "skip": "2 s", "until": "37 s", "weight": 1, "remark": "after lunch"} ] })";

TEST(DataSetSchema, AcceptsTheExampleOfTheFormatAndSoDoesTheReader) {
  EXPECT_EQ(datasets().refuses(good_dataset), "");
  const TemporaryFolder folder;
  for (const char* name : {"01.csv", "02.csv"}) folder.write(name, "t [s],u [V],y [um]\n0,1,2\n3,1,2\n4,1,2\n5,1,2\n");
  EXPECT_EQ(read_dataset(folder.write("d.json", good_dataset)).recordings.size(), 3U);
}

TEST(DataSetSchema, RefusesWhatTheReaderRefuses) {
  const char* wrong[] = {
      "{\"format\": 1}",
      "{\"format\": 1, \"recordings\": []}",
      "{\"format\": 1, \"recordings\": [{\"role\": \"train\"}]}",
      "{\"format\": 1, \"recordings\": [{\"file\": \"a.csv\", \"role\": \"training\"}]}",
      "{\"format\": 1, \"recordings\": [{\"file\": \"a.csv\", \"rol\": \"train\"}]}",
      "{\"format\": 1, \"recordings\": [{\"file\": \"a.csv\", \"initial\": \"restt\"}]}",
      "{\"format\": 1, \"recordings\": [{\"file\": \"a.csv\", \"weight\": 0}]}",
      "{\"format\": 1, \"recordings\": [{\"file\": \"a.csv\"}], \"columns\": {\"y\": {\"noise\": {\"pink\": 1}}}}",
      "{\"format\": 1, \"recordings\": [{\"file\": \"a.csv\"}], \"columns\": {\"y\": {\"zero\": \"each\"}}}",
      "{\"format\": 1, \"recordings\": [{\"file\": \"a.csv\"}], \"columns\": {\"y\": {\"between_samples\": "
      "\"cubic\"}}}",
  };
  for (const auto* text : wrong) EXPECT_NE(datasets().refuses(text), "") << text;
}

bool fits(const Json& json) {
  static const SchemaValidator schema(result_schema());
  return schema.refuses(json.dump()).empty();
}

Document full_document() {
  Document d;
  d.verb = "compare";
  d.title = "t";
  d.headline = "h";
  d.verdict = "missing_effect";
  d.sentences = {"s"};
  d.warnings = {"w"};
  d.facts = std::make_shared<Json>(Json{{"rms", "1 um"}});
  Section s;
  s.title = "Residual";
  s.text = {"a paragraph"};
  s.tables = {{"table", {"a", "b"}, {{"1", "2"}}}};
  Figure curves;
  curves.title = "curves";
  curves.curves = {{"measured", "line", "measured", "01.csv", "t", "y", {}, {}},
                   {"given", "points", "", "", "", "", {1, 2}, {3, std::nan("")}}};
  Figure bars;
  bars.title = "bars";
  bars.kind = "waterfall";
  bars.bars = {{"a", 1, "78 %", "before"}};
  bars.caption = "c";
  bars.log_y = true;
  s.figures = {curves, bars};
  s.preformatted = "diff";
  s.preformatted_title = "what changed";
  d.sections = {s};
  d.traces = {{"01.csv", {{"t", parse_unit("s"), {0, 1}}, {"y", parse_unit("um"), {0, 1}}}, {}}};
  d.files = {{"step1.json", "{}"}};
  return d;
}

TEST(JobSchema, AcceptsWhatTheReaderAcceptsAndRefusesWhatItRefuses) {
  const SchemaValidator jobs(job_schema());
  const std::string head = R"({"format": 1, "do": "fit", "diagram": "d.json", "data": "a.csv")";
  EXPECT_EQ(jobs.refuses(head + "}"), "");
  EXPECT_EQ(jobs.refuses(head + R"(, "free": ["core.weights", {"parameter": "k", "lower": "1 N/um", "upper": 9,
    "start": {"value": 2, "unit": "N/um"}, "scale": "log", "prior": [2, "3 N/um"], "scan": [1, 4], "per": "recording"}],
    "method": [{"name": "pso", "runs": 300, "then": "nothing"}, "search"], "seed": 7, "profile": ["k"], "set": {"a": 1},
    "choose": {"b": "none"}, "write": "out.json"})"),
            "");
  EXPECT_EQ(jobs.refuses(head + R"(, "method": {"name": "search", "starts": 30}})"), "");
  for (const char* wrong :
       {R"(, "fre": []})", R"(, "free": [{"lower": 1}]})", R"(, "free": [{"parameter": "k", "prior": [1]}]})",
        R"(, "method": "psso"})", R"(, "seed": -1})", R"(, "method": []})"})
    EXPECT_NE(jobs.refuses(head + wrong), "") << wrong;
}

TEST(JobSchema, JobsOfRunsAreAcceptedAndRefusedAsTheirReaderDoes) {
  const SchemaValidator jobs(job_schema());
  const std::string head = R"({"format": 1, "do": "runs", "diagram": "d.json")";
  EXPECT_EQ(jobs.refuses(head + "}"), "");
  EXPECT_EQ(jobs.refuses(head + R"(, "runs": {"a": {"set": {"g.gain": {"of": "v", "times": -1}}, "use": {"b": "model"}},
    "b": {"fit": "f.json", "free": "w", "data": {"run": "a", "columns": {"u": "s"}, "between": ["1 s", 2]}},
    "c": {"linearize": {"from": "e", "to": "y", "open": "e"}}, "d": {"table": "x.csv"}, "e": {"from": "fig1.json"}},
    "plots": [{"kind": "spectrum", "y": {"signal": "y", "minus": {"run": "a", "signal": "y"}, "from": 0, "to": "1 um"}}],
    "values": {"v": {"take": "stroke", "of": "y", "run": "a"}, "w": {"ratio": ["v", "v"]}},
    "claims": [{"id": "C1", "value": "w", "above": 5}, {"id": "C2", "order": ["v", "w"]}]})"),
            "");
  for (const char* wrong : {R"(, "run": {}})", R"(, "runs": {"A": {}}})", R"(, "runs": {"a": {"choos": {}}}})",
                            R"(, "plots": [{"kind": "pie"}]})", R"(, "values": {"v": {"take": "length"}}})",
                            R"(, "claims": [{"value": "v"}]})", R"(, "data": "a.csv"})"})
    EXPECT_NE(jobs.refuses(head + wrong), "") << wrong;
}

TEST(JobSchema, StudiesAreAcceptedAndRefusedAsTheirReaderDoes) {
  const SchemaValidator jobs(job_schema());
  const std::string head = R"({"format": 1, "do": "study", "diagram": "d.json")";
  const std::string sample =
      R"(, "sample": {"draws": 9, "parameters": {"law.k": {"from": "1 V", "to": 2, "scale": "log"}}})";
  const std::string features = R"(, "features": {"s": {"take": "stroke", "of": "y"}})";
  EXPECT_EQ(jobs.refuses(head + sample + features + "}"), "");
  EXPECT_EQ(
      jobs.refuses(head +
                   R"(, "sample": {"method": "grid", "seed": 2, "shards": 3, "parameters": {"a": {"from": 1, "to": 2,
    "points": 3}, "b": {"values": ["1 V"]}}}, "features": {"s": {"take": "area", "of": "y", "over": "u", "minus": {"file": "l.csv",
    "column": "y"}, "between": [1, "2 s"], "rezero": true, "unit": "um V"}, "r": {"ratio": ["s", 2]}}, "solver": {"method": "rk4"},
    "filters": [{"feature": "r", "above": 0, "at_most": "2 V"}], "keep": "all", "plots": [{"x": "r", "bins": 9, "samples": "all"},
    {"kind": "scatter", "x": {"feature": "s", "log": true}, "y": "r", "where": [{"feature": "s", "below": 3}]}]})"),
      "");
  EXPECT_NE(jobs.refuses(head + sample + "}"), "");
  for (const char* wrong : {R"(, "filter": []})", R"(, "keep": "some"})", R"(, "plots": [{"y": "s"}]})",
                            R"(, "runs": {}})", R"(, "filters": [{"above": 1}]})"})
    EXPECT_NE(jobs.refuses(head + sample + features + wrong), "") << wrong;
}

TEST(ResultSchema, AcceptsEverythingThatAResultMayHold) {
  EXPECT_TRUE(fits(Json::parse(result_text(full_document())))) << result_text(full_document());
  EXPECT_TRUE(fits(Json::parse(result_text(Document{}))));
}

TEST(ResultSchema, RefusesAnUnknownVerdictAnUnknownKeyAndAnotherFormat) {
  const auto good = Json::parse(result_text(full_document()));
  auto wrong = good;
  wrong["verdict"] = "perhaps";
  EXPECT_FALSE(fits(wrong));
  wrong = good;
  wrong["extra"] = 1;
  EXPECT_FALSE(fits(wrong));
  wrong = good;
  wrong["format"] = 2;
  EXPECT_FALSE(fits(wrong));
  wrong = good;
  wrong["sections"][0]["figures"][0]["kind"] = "pie";
  EXPECT_FALSE(fits(wrong));
}

TEST(SharedSchemas, ThoseInTheProjectAreWhatTheDeclarationsSay) {
  const auto expect_same = [](const std::string& name, const std::string& now) {
    const std::string there = TemporaryFolder::read(std::string(HYSTERON_SOURCE_DIR) + "/schema/" + name);
    EXPECT_TRUE(there == now) << name << " is out of date; write it anew: hysteron schema -o schema\n"
                              << text_diff(there, now);
  };
  expect_same("diagram.schema.json", diagram_schema(all_blocks()));
  expect_same("dataset.schema.json", dataset_schema());
  expect_same("job.schema.json", job_schema());
  expect_same("claims.schema.json", claims_schema());
  expect_same("result.schema.json", result_schema());
}

TEST(SharedSchemas, EveryDiagramDataSetAndJobOfTheProjectIsValid) {
  const SchemaValidator jobs(job_schema()), claims(claims_schema());
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::string(HYSTERON_SOURCE_DIR) + "/diagrams")) {
    if (entry.path().extension() != ".json") continue;
    const std::string text = TemporaryFolder::read(entry.path().string());
    if (text.find("diagram.schema.json") != text.npos) {
      EXPECT_EQ(diagrams().refuses(text), "") << entry.path();
    }
    if (text.find("dataset.schema.json") != text.npos) {
      EXPECT_EQ(datasets().refuses(text), "") << entry.path();
    }
    if (text.find("job.schema.json") != text.npos) {
      EXPECT_EQ(jobs.refuses(text), "") << entry.path();
    }
    if (text.find("claims.schema.json") != text.npos) {
      EXPECT_EQ(claims.refuses(text), "") << entry.path();
    }
  }
}

}  // namespace
}  // namespace hysteron
