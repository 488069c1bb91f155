// Jobs of runs and files of claims: what is read, and how wrong ones are told.
#include "io/jobs/runs_job.h"

#include <gtest/gtest.h>

#include "engine/diagram/error.h"
#include "io/jobs/claims_file.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

constexpr char whole_runs_job[] = R"({
  "$schema": "x", "format": 1, "do": "runs", "title": "stage", "surrogate": "a stand-in", "diagram": "stage.json",
  "choose": {"drive": "sine"}, "set": {"a.gain": 2}, "until": "1 s", "every": "1 ms",
  "draw": {"The loop": "loop.json"},
  "runs": {
    "plain":  {},
    "other":  {"title": "Other", "diagram": "other.json", "set": {"b.gain": {"of": "stroke", "times": -1}}, "use": {"fitted": "model"}},
    "fitted": {"fit": "fit.json", "free": ["w"], "data": {"run": "plain", "columns": {"u": "drive"}, "between": ["0.2 s", "1 s"], "rezero": "y"}},
    "loop":   {"linearize": {"from": "e", "to": "y", "open": ["e"]}},
    "file":   {"table": "trace.csv"},
    "theirs": {"from": "fig1.json", "run": "plain"},
    "found":  {"find": {"parameter": "drive.amplitude", "range": [1, "2 V"], "value": {"take": "stroke", "of": "y"}, "equals": "6 um"}}
  },
  "plots": [{"title": "P", "kind": "curve", "x": {"signal": "drive", "unit": "V", "from": 0, "to": 6},
             "y": {"signals": ["y", "z"]}, "runs": ["plain"], "between": ["0 s", "1 s"], "rezero": true}],
  "values": {"stroke": {"take": "stroke", "of": "y", "minus": {"run": "file", "signal": "y"}, "run": "plain"},
             "twice": {"sum": ["stroke", "stroke"]}},
  "claims": [{"id": "C1", "value": "twice", "expected": "6 um", "tolerance": "1 %"}, {"id": "C2", "value": "twice", "above": 5},
             {"id": "C3", "order": ["stroke", "twice"]}]
})";

/// code and pointer of the first problem, "" if there is none.
std::string problem_of_runs_job(const std::string& members, int* line = nullptr, std::string* cure = nullptr) {
  const TemporaryFolder folder;
  try {
    read_runs_job(
        folder.write("job.json", "{\"format\": 1, \"do\": \"runs\", \"diagram\": \"d.json\",\n" + members + "}"));
  } catch (const Error& error) {
    for (const auto& p : error.problems) EXPECT_FALSE(p.cure.empty()) << p.code;
    if (line != nullptr) *line = error.problems.front().line;
    if (cure != nullptr) *cure = error.problems.front().cure;
    return error.problems.front().code + " " + error.problems.front().path;
  }
  return "";
}

TEST(RunsJob, EveryPartOfTheFormatIsRead) {
  const TemporaryFolder folder;
  const auto job = read_runs_job(folder.write("fig2_15.json", whole_runs_job));
  EXPECT_EQ(job.name, "fig2_15");
  EXPECT_EQ(job.surrogate, "a stand-in");
  ASSERT_EQ(job.runs.size(), 7U);
  const auto& plain = job.runs[0];
  EXPECT_TRUE(plain.file.ends_with("stage.json"));
  EXPECT_EQ(plain.title, "plain");
  EXPECT_EQ(plain.choose.at(0).value, "sine");
  EXPECT_EQ(plain.set.at(0).value, "2");
  EXPECT_EQ(plain.until->number.value, 1);
  const auto& other = job.runs[1];
  EXPECT_TRUE(other.file.ends_with("other.json"));
  EXPECT_TRUE(other.choose.empty());  // those of the job belong to the job's diagram
  EXPECT_EQ(other.set_of.at(0).times, -1);
  EXPECT_EQ(other.use.at(0).prefix, "model");
  EXPECT_EQ(job.runs[2].kind, RunKind::fit);
  EXPECT_EQ(job.runs[2].data->columns.at(0).second.text, "drive");
  EXPECT_EQ(job.runs[3].kind, RunKind::linearize);
  EXPECT_EQ(job.runs[3].open.at(0).text, "e");
  EXPECT_EQ(job.runs[4].kind, RunKind::table);
  EXPECT_EQ(job.runs[5].kind, RunKind::elsewhere);
  EXPECT_EQ(job.runs[5].other_run.text, "plain");
  EXPECT_EQ(job.runs[6].aim.take.text, "stroke");
  EXPECT_EQ(job.plots.at(0).y.signals.size(), 2U);
  EXPECT_EQ(job.values.at(0).of.minus_run->text, "file");
  EXPECT_EQ(job.claims.at(1).above->text, "5");
  EXPECT_EQ(job.draw.at(0).first, "The loop");
}

TEST(RunsJob, NamesThatTheJobDoesNotGiveAreToldWithTheNearestOne) {
  const std::string run = "\"runs\": {\"plain\": {}},\n";
  int line = 0;
  std::string cure;
  EXPECT_EQ(problem_of_runs_job(run + R"("plots": [{"y": {"signal": "y"}, "runs": ["plian"]}])", &line, &cure),
            "unknown_run /plots/0/runs/0");
  EXPECT_EQ(line, 3);
  EXPECT_NE(cure.find("Did you mean \"plain\"?"), std::string::npos) << cure;
  EXPECT_EQ(problem_of_runs_job(run + R"("values": {"v": {"take": "strok", "of": "y", "run": "plain"}})", &line, &cure),
            "bad_value /values/v/take");
  EXPECT_NE(cure.find("\"stroke\""), std::string::npos) << cure;
  EXPECT_EQ(problem_of_runs_job(R"("values": {"v": {"ratio": ["v", "w"]}})"), "unknown_value /values/v/ratio/1");
  EXPECT_EQ(problem_of_runs_job(R"("claims": [{"id": "C1", "value": "v", "above": 1}])"),
            "unknown_value /claims/0/value");
}

TEST(RunsJob, WrongInputIsToldWithItsPlace) {
  EXPECT_EQ(problem_of_runs_job("\"run\": {}"), "unknown_key /run");
  EXPECT_EQ(problem_of_runs_job(R"("runs": {"a": {"choos": {}}})"), "unknown_key /runs/a/choos");
  EXPECT_EQ(problem_of_runs_job(R"("runs": {"A": {}})"), "bad_name /runs/A");
  EXPECT_EQ(problem_of_runs_job(R"("runs": {"a": {"diagram": "../../outside.json"}})"),
            "outside_project /runs/a/diagram");
  EXPECT_EQ(problem_of_runs_job(R"("plots": [{"y": {"signal": "y"}, "kind": "pie"}])"), "bad_value /plots/0/kind");
  EXPECT_EQ(problem_of_runs_job(R"("plots": [{"y": {"signal": "y"}, "between": ["1 s"]}])"),
            "bad_value /plots/0/between");
  EXPECT_EQ(problem_of_runs_job(R"("values": {"v": {"take": "area", "of": "y", "run": "a"}}, "runs": {"a": {}})"),
            "missing_key /values/v");
  EXPECT_EQ(problem_of_runs_job(R"("values": {"v": {"take": "rms", "of": "y", "run": "a"}}, "runs": {"a": {}},
    "claims": [{"id": "C1", "value": "v", "expected": "1 um"}])"),
            "missing_key /claims/0");
}

TEST(RunsJob, SizesUnderFullCountWhereTheyAreAskedFor) {
  const TemporaryFolder folder;
  const std::string file = folder.write("job.json", R"({"format": 1, "do": "runs", "diagram": "d.json",
    "runs": {"a": {"minimize": {"value": {"take": "rms", "of": "y"}, "parameters": {"g.gain": [1, 2]}, "method": "npso",
                                "seeds": 3, "runs": 50, "full": {"seeds": 30}}}}})");
  const auto job = read_runs_job(file), full = read_runs_job(file, {}, true);
  EXPECT_EQ(job.runs.at(0).search->seeds, 3);
  EXPECT_EQ(full.runs.at(0).search->seeds, 30);
  EXPECT_EQ(full.runs.at(0).search->runs, 50);
  EXPECT_EQ(job.runs.at(0).search->method.text, "npso");
  EXPECT_EQ(job.runs.at(0).search->parameters.at(0).high.number.value, 2);
}

TEST(RunsJob, AStudyMayBeSmallerOrLargerThanItsJobSays) {
  const TemporaryFolder folder;
  const std::string file = folder.write("job.json", R"({"format": 1, "do": "runs",
    "runs": {"a": {"study": "mc.json", "draws": 100, "every": "1 ms", "step": "0.5 ms", "record": ["c", "k"],
                   "full": {"accepted": 5000}},
             "b": {"select": "a", "where": [{"signal": "c", "to": 0.5}]}}})");
  const auto small = read_runs_job(file).runs.at(0), full = read_runs_job(file, {}, true).runs.at(0);
  EXPECT_EQ(small.kind, RunKind::study);
  EXPECT_EQ(small.size->draws, 100U);
  EXPECT_FALSE(small.size->accepted);
  EXPECT_EQ(small.step->number.value, 0.5);
  EXPECT_EQ(small.record.at(1).text, "k");
  EXPECT_EQ(full.size->accepted, 5000U);
  EXPECT_FALSE(full.size->draws);
  EXPECT_FALSE(full.every);
  EXPECT_EQ(read_runs_job(file).runs.at(1).other_run.text, "a");
  EXPECT_EQ(problem_of_runs_job(R"("runs": {"a": {"study": "mc.json", "draws": 1, "accepted": 1}})"),
            "bad_value /runs/a");
  EXPECT_EQ(problem_of_runs_job(R"("runs": {"a": {"study": "mc.json", "draws": 1.5}})"), "bad_value /runs/a/draws");
  EXPECT_EQ(problem_of_runs_job(R"("runs": {"a": {"select": "b"}})"), "unknown_run /runs/a/select");
  EXPECT_EQ(problem_of_runs_job(R"("runs": {"a": {"select": "b"}, "b": {"select": "a"}})"), "circular /runs/a");
}

TEST(RunsJob, ConditionsAndSearchesThatSayTooLittleAreToldSo) {
  const std::string run = "\"runs\": {\"a\": {}},\n";
  const auto value = [&](const std::string& more) {
    return problem_of_runs_job(run + R"("values": {"v": {"of": "y", "run": "a", )" + more + "}}");
  };
  EXPECT_EQ(value(R"("take": "rms", "where": [{"signal": "y"}])"), "missing_key /values/v/where/0");
  EXPECT_EQ(value(R"("take": "rms", "where": [{"from": 1}])"), "missing_key /values/v/where/0");
  EXPECT_EQ(value(R"("take": "share")"), "missing_key /values/v");
  EXPECT_EQ(value(R"("take": "rms", "same_stroke": true)"), "missing_key /values/v");
  EXPECT_EQ(value(R"("take": "rms", "where": [{"signal": "y", "minus": {"run": "b", "signal": "y"}, "to": 1}])"),
            "unknown_run /values/v/where/0/minus/run");
  EXPECT_EQ(problem_of_runs_job(R"("runs": {"a": {"minimize": {"parameters": {}}}})"), "missing_key /runs/a/minimize");
  EXPECT_EQ(
      problem_of_runs_job(R"("runs": {"a": {"minimize": {"value": {"take": "rms"}, "parameters": {"g.k": [1]}}}})"),
      "bad_value /runs/a/minimize/parameters/g.k");
  EXPECT_EQ(problem_of_runs_job(R"("runs": {"a": {"rows": {}}})"), "bad_value /runs/a/rows");
  EXPECT_EQ(problem_of_runs_job(R"("runs": {"a": {"computed": "nothing"}})"), "bad_value /runs/a");
  EXPECT_EQ(problem_of_runs_job(R"("plots": [{"kind": "medians", "y": {"signal": "y"}}])"), "missing_key /plots/0");
}

TEST(RunsJob, RunsAndValuesThatNeedThemselvesAreRefused) {
  EXPECT_EQ(problem_of_runs_job(R"("runs": {"a": {"use": "b"}, "b": {"set": {"g.gain": {"of": "v"}}}},
    "values": {"v": {"take": "max", "of": "y", "run": "a"}})"),
            "circular /runs/a");
  EXPECT_EQ(problem_of_runs_job(R"("values": {"v": {"ratio": ["v", "v"]}})"), "circular /values/v");
  EXPECT_EQ(problem_of_runs_job(R"("runs": {"a": {"use": "c"}, "b": {"use": "c"}, "c": {}})"), "");
}

TEST(Claims, AreReadInTheOrderOfTheFile) {
  const TemporaryFolder folder;
  const auto claims = read_claims(folder.write("claims.json", R"({"format": 1, "claims": {
    "C2-10": {"says": "a", "calibrated": "tuned"}, "C2-09": {"says": "b", "cannot": "no data"}}})"));
  ASSERT_EQ(claims.size(), 2U);
  EXPECT_EQ(claims[0].id, "C2-10");
  EXPECT_EQ(claims[0].calibrated, "tuned");
  EXPECT_EQ(claims[1].cannot, "no data");
  EXPECT_THROW(read_claims(folder.write("bad.json", R"({"format": 1, "claims": {"C1": {"say": "a"}}})")), Error);
}

}  // namespace
}  // namespace hysteron
