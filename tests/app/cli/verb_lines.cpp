#include "tests/app/cli/verb_lines.h"

#include <stdexcept>

#include "tests/app/lab.h"
#include "tests/app/small_study.h"

namespace hysteron::verb_lines {
namespace {

constexpr char lag[] = R"({
  "format": 1, "title": "lag", "simulate": {"until": "0.2 s", "every": "1 ms"},
  "parameters": {"k": 2}, "inputs": {"u": {"unit": "V"}},
  "blocks": {"first": {"type": "gain", "gain": "$k", "in": "u"}, "second": {"type": "gain", "gain": "$k", "in": "first"},
             "lag": {"type": "lag", "times": ["10 ms"], "in": "second"}},
  "outputs": {"y": "lag"}})";
constexpr char published_job[] = R"({
  "format": 1, "do": "runs", "title": "Loop", "diagram": "stage.json",
  "runs": {"one": {"title": "One"}},
  "plots": [{"title": "Loop", "x": {"signal": "drive"}, "y": {"signal": "law"}}],
  "values": {"stroke": {"take": "stroke", "of": "drive", "run": "one"}},
  "claims": [{"id": "C1-01", "value": "stroke", "expected": "6 V", "tolerance": "1 %"}]})";
constexpr char published_diagram[] = R"({
  "format": 1, "title": "drive", "simulate": {"until": "0.4 s", "every": "1 ms"},
  "blocks": {"drive": {"type": "sine", "amplitude": "3 V", "frequency": "5 Hz"}, "law": {"type": "gain", "gain": 2, "in": "drive"}},
  "record": ["drive", "law"]})";

}  // namespace

const std::map<std::string, std::vector<Words>>& all() {
  static const std::string chapter2 = HYSTERON_SOURCE_DIR "/diagrams/chapter2/";
  static const Words traces{"a.csv", "b.csv", "--tolerance", "y: 1 nm"};
  static const std::map<std::string, std::vector<Words>> lines{
      {"new", {{"--from", "a.csv", "-o", "lab"}}},
      {"run", {{"stage.json", "--until", "0.2 s"}, {"diagram.json", "--data", "dataset.json"}}},
      {"check", {{"diagram.json"}, {"diagram.json", "--data", "dataset.json"}}},
      {"explain", {{"stage.json"}, {"diagram.json", "-o", "explained"}}},
      {"draw", {{"diagram.json"}}},
      {"linearize",
       {{"lag.json"},
        {chapter2 + "feedback_continuous.json", "--from", "error", "--to", "stage", "--open", "error"},
        {chapter2 + "feedback_sampled.json", "--from", "error", "--to", "measured", "--open", "error", "--choose",
         "converter=ideal", "--choose", "sensor=ideal", "--choose", "stage=linear", "-o", "sampled"}}},
      {"inspect", {{"a.csv"}, {"dataset.json", "--diagram", "diagram.json", "-o", "inspected"}}},
      {"compare", {{"diagram.json", "--data", "dataset.json"}, traces}},
      {"diagnose", {{"diagram.json", "--data", "dataset.json", "--only", "creep"}}},
      {"add", {{"creep", "diagram.json"}, {"creep", "diagram.json", "-o", "next.json"}}},
      {"remove", {{"creep", "with_creep.json", "-o", "without.json"}}},
      {"fit",
       {{"diagram.json", "--data", "dataset.json", "--write", "fitted.json"},
        {"diagram.json", "--data", "dataset.json", "--free", "sensor.offset", "--profile", "gain", "-o", "profile"}}},
      {"discover",
       {{"diagram.json", "--data", "dataset.json", "--only", "creep"},
        {"diagram.json", "--data", "dataset.json", "--only", "creep", "--check", "-o", "checked"}}},
      {"study", {{"job.json", "--shard", "1/4"}, {"job.json", "--slurm-dry-run"}, {"job.json", "--csv"}}},
      {"export",
       {{"fmu", "lag.json"},
        {"fmu", "lag.json", "--fmi", "3", "-o", "three.fmu"},
        {"c", "lag.json", "--rate", "1 kHz", "-o", "code"}}},
      {"reproduce", {{"all", "--from", "jobs"}}},
      {"blocks", {{}, {"tank"}, {"play"}}},
      {"effects", {{}, {"creep", "-o", "creep.svg"}}},
      {"schema", {{}}},
      {"manual", {{"compare"}, {"-o", "share"}}}};
  return lines;
}

void furnish(const process::Folder& folder) {
  lab::furnish(folder);
  small_study::write(folder, "", 40);
  folder.write("lag.json", lag);
  folder.write("jobs/fig1_1.json", published_job);
  folder.write("jobs/stage.json", published_diagram);
  const process::Outcome outcome =
      process::hysteron(folder.path(), {"add", "creep", "diagram.json", "-o", "with_creep.json"});
  if (outcome.code != 0) throw std::runtime_error(outcome.err);
}

}  // namespace hysteron::verb_lines
