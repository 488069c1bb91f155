// Jobs of studies: what is read, and how wrong ones are told.
#include "io/jobs/study_job.h"

#include <gtest/gtest.h>

#include "engine/diagram/error.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

constexpr char whole_job[] = R"({
  "$schema": "x", "format": 1, "do": "study", "title": "t", "source": "s", "remark": "r", "diagram": "stage.json",
  "choose": {"compensator": "none"}, "set": {"drive.amplitude": "3 V", "n": 2}, "until": "0.4 s", "every": "1 ms",
  "solver": {"method": "rk4", "step": "0.1 ms"},
  "sample": {"method": "sobol", "seed": 7, "accepted": 100, "give_up_after": 5000, "shards": 3,
             "parameters": {"law.k": {"from": "0.01 V", "to": "10 V", "scale": "log"}, "law.c": {"from": 0, "to": 1}}},
  "features": {"stroke": {"take": "stroke", "of": "y", "between": ["0.2 s", "0.4 s"], "unit": "nm", "remark": "why"},
               "area": {"take": "area", "of": "y", "over": "u", "minus": "z", "rezero": true},
               "end": {"take": "at", "of": "y", "at": "0.1 s"},
               "error": {"take": "rms", "of": "y", "minus": {"file": "lab.csv", "column": "y"}},
               "gamma": {"ratio": ["area", "stroke"]},
               "scaled": {"product": ["gamma", "law.k", "0.5 V", 2]}},
  "filters": [{"feature": "gamma", "above": 0, "at_most": "2 V"}, {"feature": "law.c", "at_least": 0.1, "below": 0.9}],
  "keep": "all",
  "plots": [{"x": "law.k"}, {"title": "T", "kind": "scatter", "samples": "all", "x": {"feature": "law.c", "label": "c", "from": 0, "to": 1},
             "y": {"feature": "gamma", "log": true}, "where": [{"feature": "stroke", "above": "1 um"}], "caption": "C"},
            {"kind": "histogram", "x": {"feature": "stroke", "from": "0 um", "to": "9 um"}, "bins": 12}]
})";

TEST(StudyJob, EveryPartOfTheFormatIsRead) {
  const TemporaryFolder folder;
  const auto job = read_study_job(folder.write("tolerance.json", whole_job));
  EXPECT_EQ(job.name, "tolerance");
  EXPECT_TRUE(job.diagram.ends_with("stage.json"));
  EXPECT_EQ(job.choose.at(0).value, "none");
  EXPECT_EQ(job.set.at(1).value, "2");
  EXPECT_EQ(job.until->number.value, 0.4);
  EXPECT_EQ(job.solver->text, "rk4");
  EXPECT_EQ(*job.step->number.unit, "ms");
  EXPECT_EQ(job.method.text, "sobol");
  EXPECT_EQ(job.seed, 7U);
  EXPECT_FALSE(job.draws);
  EXPECT_EQ(*job.accepted, 100U);
  EXPECT_EQ(*job.give_up_after, 5000U);
  EXPECT_EQ(job.shards, 3);
  EXPECT_TRUE(job.keep_all);
  ASSERT_EQ(job.parameters.size(), 2U);
  EXPECT_TRUE(job.parameters[0].log);
  EXPECT_EQ(job.parameters[0].to->number.value, 10);
  ASSERT_EQ(job.features.size(), 6U);
  EXPECT_EQ(job.features[0].between.to->number.value, 0.4);
  EXPECT_EQ(job.features[0].unit->text, "nm");
  EXPECT_EQ(job.features[0].remark, "why");
  EXPECT_EQ(job.features[1].minus->text, "z");
  EXPECT_TRUE(job.features[1].rezero);
  EXPECT_EQ(job.features[2].at->number.value, 0.1);
  EXPECT_TRUE(job.features[3].minus_file.ends_with("lab.csv"));
  EXPECT_EQ(job.features[3].minus_column.text, "y");
  EXPECT_EQ(job.features[4].operands.at(1).name.text, "stroke");
  EXPECT_EQ(job.features[5].operands.at(1).name.text, "law.k");
  EXPECT_EQ(*job.features[5].operands.at(2).constant->number.unit, "V");
  EXPECT_EQ(job.features[5].operands.at(3).constant->number.value, 2);
  ASSERT_EQ(job.filters.size(), 2U);
  EXPECT_EQ(job.filters[0].at_most->number.value, 2);
  EXPECT_EQ(job.filters[1].feature.text, "law.c");
  ASSERT_EQ(job.plots.size(), 3U);
  EXPECT_EQ(job.plots[0].title, "law.k");
  EXPECT_FALSE(job.plots[0].y);
  EXPECT_TRUE(job.plots[1].all);
  EXPECT_TRUE(job.plots[1].y->log);
  EXPECT_EQ(job.plots[1].where.at(0).above->number.value, 1);
  EXPECT_EQ(job.plots[2].bins, 12);
}

TEST(StudyJob, GridsAndListsSayThemselvesHowManyDrawsThereAre) {
  const TemporaryFolder folder;
  const auto grid = read_study_job(folder.write("g.json", R"({"format": 1, "do": "study", "diagram": "d.json",
    "sample": {"method": "grid", "parameters": {"a": {"from": 1, "to": 2, "points": 5}, "b": {"values": ["1 V", "2 V"]}}},
    "features": {"s": {"take": "max", "of": "y"}}})"));
  EXPECT_EQ(grid.parameters[0].points, 5U);
  EXPECT_EQ(grid.parameters[1].values.size(), 2U);
  EXPECT_EQ(grid.shards, 16);
  const auto list = read_study_job(folder.write("l.json", R"({"format": 1, "do": "study", "diagram": "d.json",
    "sample": {"method": "list", "parameters": {"a": {"file": "s.csv", "column": "x"}, "b": {"file": "s.csv"}}},
    "features": {"s": {"take": "max", "of": "y"}}})"));
  EXPECT_TRUE(list.parameters[0].file.ends_with("s.csv"));
  EXPECT_EQ(list.parameters[0].column.text, "x");
  EXPECT_EQ(list.parameters[1].column.text, "b");
}

/// code, pointer and line of the first problem of a job in which `part` stands in place of what is right.
std::string problem(const std::string& sample, const std::string& features, const std::string& rest = "") {
  const TemporaryFolder folder;
  try {
    read_study_job(
        folder.write("job.json", "{\"format\": 1, \"do\": \"study\", \"diagram\": \"d.json\",\n\"sample\": " + sample +
                                     ",\n\"features\": " + features + rest + "}"));
  } catch (const Error& error) {
    for (const auto& p : error.problems) {
      EXPECT_FALSE(p.cure.empty()) << p.code;
      EXPECT_TRUE(p.file.ends_with("job.json")) << p.file;
    }
    const auto& p = error.problems.front();
    return p.code + " " + p.path + " " + std::to_string(p.line);
  }
  return "";
}

const std::string draws = R"({"draws": 10, "parameters": {"k": {"from": 1, "to": 2}}})";
const std::string max_y = R"({"top": {"take": "max", "of": "y"}})";

TEST(StudyJob, ProblemsAreToldWithTheirPlace) {
  EXPECT_EQ(problem(draws, max_y), "");
  const std::string range = R"("parameters": {"k": {"from": 1, "to": 2}}})";
  EXPECT_EQ(problem("{" + range, max_y), "bad_value /sample 2");
  EXPECT_EQ(problem(R"({"draws": 1, "accepted": 1, )" + range, max_y), "bad_value /sample 2");
  EXPECT_EQ(problem(R"({"draws": 1.5, )" + range, max_y), "bad_value /sample/draws 2");
  EXPECT_EQ(problem(R"({"draws": 0, )" + range, max_y), "bad_value /sample/draws 2");
  EXPECT_EQ(problem(R"({"draws": 9, "method": "random", )" + range, max_y), "bad_value /sample/method 2");
  EXPECT_EQ(problem(R"({"accepted": 9, "method": "latin_hypercube", )" + range, max_y), "bad_value /sample/accepted 2");
  EXPECT_EQ(problem(R"({"draws": 9, "give_up_after": 4, )" + range, max_y), "bad_value /sample/give_up_after 2");
  EXPECT_EQ(problem(R"({"draws": 9, "shards": 0, )" + range, max_y), "bad_value /sample/shards 2");
  EXPECT_EQ(problem(R"({"draws": 9, "parameters": {}})", max_y), "bad_value /sample/parameters 2");
  EXPECT_EQ(problem(R"({"draws": 9})", max_y), "missing_key /sample 2");
  EXPECT_EQ(problem(R"({"draws": 9, "parameters": {"k": {"from": 1}}})", max_y), "missing_key /sample/parameters/k 2");
  EXPECT_EQ(problem(R"({"draws": 9, "parameters": {"k": {"from": 1, "to": 2, "points": 3}}})", max_y),
            "unknown_key /sample/parameters/k/points 2");
  EXPECT_EQ(problem(R"({"method": "grid", "draws": 4, "parameters": {"k": {"values": [1]}}})", max_y),
            "bad_value /sample/draws 2");
  EXPECT_EQ(problem(R"({"method": "grid", "parameters": {"k": {"from": 1, "to": 2}}})", max_y),
            "missing_key /sample/parameters/k 2");
  EXPECT_EQ(problem(R"({"method": "list", "parameters": {"k": {}}})", max_y), "bad_value /sample/parameters/k 2");
  EXPECT_EQ(problem(R"({"method": "list", "parameters": {"k": {"file": "../../x.csv"}}})", max_y),
            "outside_project /sample/parameters/k/file 2");
  EXPECT_EQ(problem(draws, "{}"), "bad_value /features 3");
  EXPECT_EQ(problem(draws, R"({"k": {"take": "max", "of": "y"}})"), "bad_name /features/k 3");
  EXPECT_EQ(problem(draws, R"({"a": {"take": "spectrum", "of": "y"}})"), "bad_value /features/a/take 3");
  EXPECT_EQ(problem(draws, R"({"a": {"take": "max"}})"), "missing_key /features/a 3");
  EXPECT_EQ(problem(draws, R"({"a": {"take": "area", "of": "y"}})"), "missing_key /features/a 3");
  EXPECT_EQ(problem(draws, R"({"a": {"take": "at", "of": "y"}})"), "missing_key /features/a 3");
  EXPECT_EQ(problem(draws, R"({"a": {"ratio": ["b", "k"]}, "b": {"take": "max", "of": "y"}})"),
            "unknown_feature /features/a/ratio/0 3");
  EXPECT_EQ(problem(draws, R"({"a": {"ratio": ["k"]}})"), "bad_value /features/a/ratio 3");
  EXPECT_EQ(problem(draws, max_y, ", \"filters\":\n[{\"feature\": \"tip\", \"above\": 1}]"),
            "unknown_feature /filters/0/feature 4");
  EXPECT_EQ(problem(draws, max_y, ", \"filters\":\n[{\"feature\": \"top\"}]"), "missing_key /filters/0 4");
  EXPECT_EQ(problem(draws, max_y, ", \"plots\":\n[{\"x\": \"tip\"}]"), "unknown_feature /plots/0/x 4");
  EXPECT_EQ(problem(draws, max_y, ", \"plots\":\n[{\"x\": {\"feature\": \"top\", \"from\": 1}}]"),
            "bad_value /plots/0/x 4");
  EXPECT_EQ(problem(draws, max_y, ", \"plots\":\n[{\"x\": \"top\", \"kind\": \"scatter\"}]"),
            "bad_value /plots/0/kind 4");
  EXPECT_EQ(problem(draws, max_y, ", \"plots\":\n[{\"x\": \"top\", \"y\": \"k\", \"samples\": \"all\"}]"),
            "bad_value /plots/0/samples 4");
  EXPECT_EQ(problem(draws, max_y, ",\n\"keeps\": \"all\""), "unknown_key /keeps 4");
}

TEST(StudyJob, AnotherKindOfJobIsToldWhereToGo) {
  const TemporaryFolder folder;
  for (const auto& [what, code] : {std::pair{"fit", "other_job"}, {"runs", "other_job"}, {"stdy", "bad_value"}}) try {
      read_study_job(folder.write("job.json", std::string(R"({"format": 1, "do": ")") + what + "\"}"));
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.problems.at(0).code, code);
      EXPECT_EQ(error.problems.size(), 1U);
    }
}

}  // namespace
}  // namespace hysteron
