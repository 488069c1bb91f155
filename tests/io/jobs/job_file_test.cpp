#include "io/jobs/job_file.h"

#include <gtest/gtest.h>

#include <functional>

#include "engine/diagram/error.h"
#include "io/diagram/diagram_file.h"
#include "io/diagram/job_command.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

constexpr char whole_fit_job[] = R"({
  "$schema": "x", "format": 1, "title": "stage", "do": "fit", "diagram": "stage.json", "data": "../lab.csv",
  "choose": {"compensator": "none"}, "set": {"controller.kp": "0.5 V/um", "gain": 2},
  "free": [
    "core.weights",
    {"parameter": "stage.k", "lower": "1 N/um", "upper": {"value": 9, "unit": "N/um"}, "start": 2, "scale": "log",
     "prior": ["2 N/um", "3 N/um"], "scan": ["1 N/um", "4 N/um"], "per": "recording", "remark": "by hand"}],
  "method": [{"name": "pso", "runs": 300, "then": "nothing"},
             {"name": "nmpso", "attractor": {"c": "core.c", "k": "core.k", "top": "10 V"}},
             "search"],
  "thresholds": {"block": "core", "count": 6, "place": "swing"},
  "seed": 7, "profile": ["stage.k"], "write": "fitted.json"
})";

/// code and pointer of the first problem, "" if there is none.
std::string problem_of_fit_job(const std::string& text, int* line = nullptr) {
  const TemporaryFolder folder;
  try {
    read_fit_job(folder.write("job.json", text));
  } catch (const Error& error) {
    for (const auto& p : error.problems) EXPECT_FALSE(p.cure.empty()) << p.code;
    if (line != nullptr) *line = error.problems.front().line;
    return error.problems.front().code + " " + error.problems.front().path;
  }
  return "";
}

std::string with(const std::string& members) {
  return "{\"format\": 1, \"do\": \"fit\", \"diagram\": \"d.json\", \"data\": \"a.csv\"" +
         (members.empty() ? "" : ",\n" + members) + "}";
}

TEST(JobFile, EveryPartOfTheFormatIsRead) {
  const TemporaryFolder folder;
  folder.write("hysteron.project", "");
  const auto job = read_fit_job(folder.write("jobs/job.json", whole_fit_job));
  EXPECT_EQ(job.title, "stage");
  EXPECT_TRUE(job.diagram.ends_with("jobs/stage.json")) << job.diagram;  // seen from the job
  EXPECT_TRUE(job.data.ends_with("lab.csv"));
  EXPECT_EQ(job.data.find("jobs"), std::string::npos) << job.data;
  ASSERT_EQ(job.set.size(), 2U);
  EXPECT_EQ(job.set[0].path, "controller.kp");
  EXPECT_EQ(job.set[0].value, "0.5 V/um");
  EXPECT_EQ(job.set[1].value, "2");
  EXPECT_EQ(job.choose[0].value, "none");
  ASSERT_EQ(job.free.size(), 2U);
  EXPECT_EQ(job.free[0].parameter.text, "core.weights");
  const auto& k = job.free[1];
  EXPECT_EQ(k.parameter.pointer, "/free/1/parameter");
  EXPECT_EQ(k.lower->number.value, 1);
  EXPECT_EQ(*k.lower->number.unit, "N/um");
  EXPECT_EQ(k.upper->number.value, 9);
  EXPECT_FALSE(k.start->number.unit);
  EXPECT_TRUE(*k.log_scale);
  EXPECT_TRUE(k.per_recording);
  EXPECT_EQ(k.prior.size(), 2U);
  EXPECT_EQ(k.scan[1].pointer, "/free/1/scan/1");
  ASSERT_EQ(job.methods.size(), 3U);
  EXPECT_EQ(*job.methods[0].runs, 300);
  EXPECT_FALSE(job.methods[0].then_search);
  EXPECT_EQ(job.methods[1].attractor->k.text, "core.k");
  EXPECT_EQ(job.methods[2].name.text, "search");
  EXPECT_EQ(job.seed, 7U);
  EXPECT_EQ(job.thresholds->block.text, "core");
  EXPECT_EQ(job.thresholds->count, 6);
  EXPECT_TRUE(job.thresholds->by_swing);
  EXPECT_EQ(job.profile[0].text, "stage.k");
  EXPECT_TRUE(job.write.ends_with("jobs/fitted.json"));
}

TEST(JobFile, WhatIsNotSaidIsASearchWithSeedOne) {
  const TemporaryFolder folder;
  const auto job = read_fit_job(folder.write("job.json", with("")));
  ASSERT_EQ(job.methods.size(), 1U);
  EXPECT_EQ(job.methods[0].name.text, "search");
  EXPECT_EQ(job.seed, 1U);
  EXPECT_TRUE(job.free.empty());
}

TEST(JobFile, IsKnownByItsDo) {
  const TemporaryFolder folder;
  EXPECT_TRUE(is_job(folder.write("job.json", with(""))));
  EXPECT_FALSE(is_job(folder.write("d.json", "{\"format\": 1, \"blocks\": {}}")));
}

TEST(JobFile, TheCommandThatRunsAnotherKindOfJobWorksAsPrinted) {
  EXPECT_EQ(job_command("study", "my jobs/tolerance.json"), "hysteron study 'my jobs/tolerance.json'");
  EXPECT_EQ(job_command("fit", "job.json"), "hysteron fit job.json");
  EXPECT_EQ(job_command("runs", "diagrams/chapter2/fig2_15.json"),
            "hysteron reproduce fig2_15 --from diagrams/chapter2");
  EXPECT_EQ(job_command("runs", "fig.json"), "hysteron reproduce fig --from .");
  const TemporaryFolder folder;
  const std::string file = folder.write("spread.json", "{\"format\": 1, \"do\": \"study\"}");
  const std::vector<std::function<void()>> readers{[&] { read_diagram(file); }, [&] { read_fit_job(file); }};
  for (const auto& read : readers) try {
      read();
      ADD_FAILURE() << "a study was read";
    } catch (const Error& error) {
      EXPECT_NE(error.problems.front().cure.find("\"hysteron study " + file + "\""), std::string::npos)
          << error.problems.front().cure;
    }
}

TEST(JobFile, OtherKindsOfJobsAreNoFits) {
  EXPECT_EQ(problem_of_fit_job("{\"format\": 1, \"do\": \"runs\", \"plots\": []}"), "other_job /do");
  EXPECT_EQ(problem_of_fit_job("{\"format\": 1, \"do\": \"study\"}"), "other_job /do");
  EXPECT_EQ(problem_of_fit_job("{\"format\": 1, \"do\": \"fitt\"}"), "bad_value /do");
  EXPECT_EQ(problem_of_fit_job("{\"format\": 1}"), "missing_key ");
}

TEST(JobFile, WrongInputIsToldWithItsPlace) {
  int line = 0;
  EXPECT_EQ(problem_of_fit_job(with("\"fre\": []"), &line), "unknown_key /fre");
  EXPECT_EQ(line, 2);
  EXPECT_EQ(problem_of_fit_job("{\"format\": 1, \"do\": \"fit\", \"data\": \"a.csv\"}"), "missing_key ");
  EXPECT_EQ(problem_of_fit_job("{\"format\": 1, \"do\": \"fit\", \"diagram\": \"d.json\"}"), "missing_key ");
  EXPECT_EQ(problem_of_fit_job("{\"format\": 2, \"do\": \"fit\"}"), "newer_format /format");
  EXPECT_EQ(problem_of_fit_job(with("\"free\": [{\"lower\": 1}]")), "missing_key /free/0");
  EXPECT_EQ(problem_of_fit_job(with("\"free\": [{\"parameter\": \"a\", \"lowr\": 1}]")), "unknown_key /free/0/lowr");
  EXPECT_EQ(problem_of_fit_job(with("\"free\": [{\"parameter\": \"a\", \"scale\": \"ln\"}]")),
            "bad_value /free/0/scale");
  EXPECT_EQ(problem_of_fit_job(with("\"free\": [{\"parameter\": \"a\", \"per\": \"file\"}]")), "bad_value /free/0/per");
  EXPECT_EQ(problem_of_fit_job(with("\"free\": [{\"parameter\": \"a\", \"prior\": [1]}]")), "wrong_type /free/0/prior");
  EXPECT_EQ(problem_of_fit_job(with("\"free\": [{\"parameter\": \"a\", \"start\": true}]")),
            "wrong_type /free/0/start");
  EXPECT_EQ(problem_of_fit_job(with("\"method\": {\"starts\": 5}")), "missing_key /method");
  EXPECT_EQ(problem_of_fit_job(with("\"method\": {\"name\": \"pso\", \"runs\": 1.5}")), "bad_value /method/runs");
  EXPECT_EQ(problem_of_fit_job(with("\"method\": {\"name\": \"pso\", \"runs\": -1}")), "bad_value /method/runs");
  EXPECT_EQ(problem_of_fit_job(with("\"method\": []")), "bad_value /method");
  EXPECT_EQ(problem_of_fit_job(with("\"seed\": -1")), "bad_value /seed");
  EXPECT_EQ(problem_of_fit_job(with("\"thresholds\": {\"count\": 5}")), "missing_key /thresholds");
  EXPECT_EQ(problem_of_fit_job(with("\"thresholds\": {\"block\": \"core\", \"count\": 1}")),
            "bad_value /thresholds/count");
  EXPECT_EQ(problem_of_fit_job(with("\"write\": \"../../out.json\"")), "outside_project /write");
  EXPECT_EQ(problem_of_fit_job("{\"format\": 1, \"do\": \"fit\", \"diagram\": \"/etc/d.json\", \"data\": \"a.csv\"}"),
            "outside_project /diagram");
}

TEST(JobFile, AnAttractorMayNameAnyParametersAndTheirCurves) {
  const TemporaryFolder folder;
  const auto job = read_fit_job(folder.write("job.json", with(R"("method": {"name": "nmpso", "attractor": [
        {"parameter": "core.c", "draw": [0.001, 0.999]},
        {"parameter": "core.k", "of": "core.c", "upper": [[0.112, 2.644], [2.644e-9, 21.74]], "lower": [[0.045, 1.989]], "scale": 6}]})")));
  const auto& all = job.methods[0].attractor->components;
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].draw[1].number.value, 0.999);
  EXPECT_FALSE(all[0].of.has_value());
  EXPECT_EQ(all[1].of->text, "core.c");
  EXPECT_EQ(all[1].upper, (std::vector<std::pair<double, double>>{{0.112, 2.644}, {2.644e-9, 21.74}}));
  EXPECT_EQ(all[1].scale, 6);
  const auto told = [](const std::string& attractor) {
    return problem_of_fit_job(with("\"method\": {\"name\": \"nmpso\", \"attractor\": " + attractor + "}"));
  };
  EXPECT_EQ(told("[]"), "bad_value /method/attractor");
  EXPECT_EQ(told(R"([{"parameter": "a"}])"), "bad_value /method/attractor/0");
  EXPECT_EQ(told(R"([{"parameter": "a", "draw": [1]}])"), "bad_value /method/attractor/0/draw");
  EXPECT_EQ(told(R"([{"parameter": "a", "of": "b", "upper": [[1, 2]]}])"), "missing_key /method/attractor/0");
  EXPECT_EQ(told(R"([{"parameter": "a", "of": "b", "upper": [1], "lower": [[1, 2]]}])"),
            "bad_value /method/attractor/0/upper/0");
}

}  // namespace
}  // namespace hysteron
