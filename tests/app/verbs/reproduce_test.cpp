// The verb reproduce on a small published work of its own: runs, values, claims, pages, baseline, and wrong input.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/app/hysteron_process.h"
#include "tests/app/schema_check.h"

namespace hysteron {
namespace {

using nlohmann::json;
using process::Folder;
using process::hysteron;
using process::Outcome;

constexpr char stage[] = R"({
  "format": 1, "title": "Stage",
  "blocks": {
    "drive": {"type": "triangle", "amplitude": "3 V", "offset": "3 V", "frequency": "5 Hz", "phase": "-90 deg"},
    "comp":  {"choose": "none", "in": "drive", "from": {"none": {"type": "gain", "gain": 1}, "half": {"type": "gain", "gain": 0.5}}},
    "model": {"type": "prandtl_ishlinskii", "thresholds": {"value": [0, 3], "unit": "V"},
              "weights": {"value": [1, 0.5], "unit": "um/V"}, "in": "comp"}
  },
  "outputs": {"y": "model"}, "record": ["drive"], "simulate": {"until": "0.4 s", "every": "1 ms"}
})";

/// One claim that agrees, one that differs, one in two jobs, one that was tuned, one that cannot be checked.
constexpr char claims[] = R"({"format": 1, "claims": {
  "C2-01": {"says": "stroke and area"}, "C2-02": {"says": "a wrong one"}, "C2-03": {"says": "order", "calibrated": "made so"},
  "C2-04": {"says": "a measurement", "cannot": "nobody has it"}, "C3-01": {"says": "of another chapter"}}})";

// From rest over 0..6 V: y(6) = 6 + 0.5 * 3 = 7.5 um; the area is sum c r (U - r) = 0.5 * 3 * 3 = 4.5 um V; with half
// the drive only the linear part moves: 3 um, no area.
constexpr char figure1[] = R"({
  "format": 1, "do": "runs", "title": "Loops", "surrogate": "A stand-in.", "shows": "two loops", "diagram": "stage.json",
  "runs": {"full": {"title": "Full"}, "half": {"choose": {"comp": "half"}}},
  "plots": [{"title": "Loop", "x": {"signal": "drive", "unit": "V", "from": 0, "to": 6}, "y": {"signal": "y", "unit": "nm"}, "between": ["0 s", "0.2 s"]},
            {"title": "Spectrum", "kind": "spectrum", "y": {"signal": "y"}, "between": ["0.2 s", "0.399 s"]}],
  "values": {"stroke": {"take": "stroke", "of": "y", "run": "full"},
             "area":   {"take": "area", "of": "y", "over": "drive", "run": "full", "between": ["0.2 s", "0.399 s"]},
             "half":   {"take": "max", "of": "y", "run": "half"},
             "ratio":  {"ratio": ["stroke", "half"]}},
  "claims": [{"id": "C2-01", "value": "stroke", "expected": "7.5 um", "tolerance": "1e-9 um"},
             {"id": "C2-01", "value": "area", "expected": "4.5 um V", "tolerance": "1e-9 um V"},
             {"id": "C2-01", "value": "ratio", "expected": 2.5, "tolerance": "1e-9"},
             {"id": "C2-02", "value": "stroke", "expected": "7 um", "tolerance": "1 %", "remark": "because it is wrong"},
             {"id": "C2-03", "order": ["half", "stroke"]},
             {"id": "C2-03", "value": "stroke", "expected": "7000 nm", "tolerance": "1 %", "must": "differ"}]
})";

// What fig2_1 gave, taken from there; a fit to it finds the weights again, a search the drive that gives 4.5 um.
constexpr char figure2[] = R"({
  "format": 1, "do": "runs", "title": "Fits", "diagram": "stage.json",
  "runs": {"loop":   {"from": "fig2_1.json", "run": "full"},
           "fitted": {"fit": "model.json", "free": "model.weights",
                      "data": {"run": "loop", "columns": {"u": "drive", "y": "y"}}},
           "again":  {"use": {"fitted": "model"}},
           "found":  {"find": {"parameter": "drive.offset", "range": ["1 V", "4 V"], "value": {"take": "max", "of": "drive"}, "equals": "5 V"}},
           "less":   {"use": "found"}},
  "values": {"weight": {"take": "parameter", "parameter": "model.weights[1]", "run": "fitted"},
             "error":  {"take": "max_abs", "of": "y", "minus": {"run": "loop", "signal": "y"}, "run": "again"},
             "top":    {"take": "max", "of": "drive", "run": "less"}},
  "claims": [{"id": "C2-05", "value": "weight", "expected": "0.5 um/V", "tolerance": "1e-6 um/V"},
             {"id": "C2-05", "value": "error", "below": "1e-6 um"},
             {"id": "C2-05", "value": "top", "expected": "5 V", "tolerance": "1e-9 V"},
             {"id": "C2-03", "value": "top", "above": "4 V"}]
})";

constexpr char model[] = R"({
  "format": 1, "title": "Model", "inputs": {"u": {"unit": "V"}},
  "blocks": {"model": {"type": "prandtl_ishlinskii", "thresholds": {"value": [0, 3], "unit": "V"},
                       "weights": {"value": [0.7, 0.1], "unit": "um/V"}, "in": "u"}},
  "outputs": {"y": "model"}
})";

// A lag of 1 ms and gain 2: -3 dB at 1/(2 pi 1 ms) = 159.155 Hz, against the gain at a hundredth of that, which is 1e-4
// low. A table of two rows, held against a run.
constexpr char figure3[] = R"({
  "format": 1, "do": "runs", "title": "Kinds", "diagram": "lag.json",
  "runs": {"lag":   {"linearize": {"from": "drive", "to": "y"}},
           "step":  {},
           "table": {"table": "points.csv"}},
  "plots": [{"title": "Bode", "kind": "bode", "runs": ["lag"]},
            {"title": "Counts", "kind": "histogram", "y": {"signal": "y"}, "runs": ["step"], "bins": 4},
            {"title": "Points", "kind": "scatter", "x": {"signal": "t", "unit": "ms"}, "y": {"signal": "y"}, "runs": ["table", "step"]}],
  "values": {"gain":    {"take": "dc_gain", "run": "lag"},
             "corner":  {"take": "bandwidth", "run": "lag"},
             "pole":    {"take": "frequency", "run": "lag"},
             "late":    {"take": "at", "of": "y", "at": "1 ms", "run": "step"},
             "off":     {"take": "max_abs", "of": "y", "minus": {"run": "step", "signal": "y"}, "run": "table"},
             "all":     {"largest": ["late", "off"]},
             "figure":  {"take": "computed", "figure": "prandtl_ishlinskii_inverse_threshold_1"}},
  "claims": [{"id": "C3-02", "value": "gain", "expected": 2, "tolerance": 1e-9},
             {"id": "C3-02", "value": "corner", "expected": "159.155 Hz", "tolerance": "0.02 Hz"},
             {"id": "C3-02", "value": "pole", "expected": "159.1549431 Hz", "tolerance": "1e-6 Hz"},
             {"id": "C3-02", "value": "late", "expected": "1.264241118 V", "tolerance": "1e-6 V"},
             {"id": "C3-02", "value": "off", "below": "1e-6 V"},
             {"id": "C3-02", "value": "all", "above": "1 V"},
             {"id": "C3-02", "value": "figure", "expected": "0.45126 um", "tolerance": "1e-9 um"}]
})";
constexpr char lag[] = R"({
  "format": 1, "title": "Lag",
  "blocks": {"drive": {"type": "constant", "value": "1 V"}, "double": {"type": "gain", "gain": 2, "in": "drive"},
             "lag": {"type": "lag", "times": ["1 ms"], "in": "double"}},
  "outputs": {"y": "lag"}, "simulate": {"until": "5 ms", "every": "0.5 ms"}
})";

// Searches from two seeds (three with --full) for the weight with which half the stage was made, rows made of values, a
// formula, and rows with conditions. Half the drive leaves the linear part alone: y is a triangle, whatever its size.
constexpr char figure4[] = R"({
  "format": 1, "do": "runs", "title": "Searches", "diagram": "stage.json", "set": {"drive.frequency": "10 Hz"},
  "runs": {"wanted": {},
           "half":   {"choose": {"comp": "half"}},
           "small":  {"choose": {"comp": "half"}, "set": {"drive.amplitude": "1 V", "drive.offset": "1 V"}},
           "sought": {"minimize": {"method": "pso", "seeds": 2, "runs": 60, "full": {"seeds": 3},
                       "value": {"take": "sum_squares", "of": "y", "minus": {"run": "wanted", "signal": "y"}},
                       "parameters": {"model.weights[1]": ["0 um/V", "2 um/V"]}}},
           "again":  {"use": "sought"},
           "made":   {"rows": {"f": ["10 Hz", "20 Hz"], "y": ["top", "top"]}},
           "band":   {"computed": "piezo_lower", "top": "1 V"},
           "part":   {"select": "wanted", "where": [{"signal": "drive", "from": "2.9999 V"}]},
           "inside": {"computed": "piezo_band", "top": "1 V", "of": {"run": "pairs", "c": "c", "k": "k"}},
           "pairs":  {"table": "pairs.csv"}},
  "plots": [{"title": "Convergence", "kind": "medians", "x": {"signal": "iteration"}, "y": {"signal": "cost", "unit": "um2"}, "runs": ["sought"]},
            {"title": "Made", "x": {"signal": "f"}, "y": {"signal": "y"}, "runs": ["made"]},
            {"title": "Rows above 3 V", "kind": "scatter", "x": {"signal": "drive"}, "y": {"signal": "y"}, "runs": ["wanted"],
             "where": [{"signal": "drive", "from": "2.9999 V"}]}],
  "values": {"weight":   {"take": "parameter", "parameter": "model.weights[1]", "run": "sought"},
             "seeds":    {"take": "max", "of": "seed", "run": "sought"},
             "rows":     {"take": "rows", "of": "cost", "run": "sought", "where": [{"signal": "seed", "from": 1, "to": 1}]},
             "last":     {"take": "min", "of": "cost", "run": "sought", "where": [{"signal": "iteration", "from": 11, "to": 11}]},
             "first":    {"take": "median", "of": "cost", "run": "sought", "where": [{"signal": "iteration", "from": 0, "to": 0}]},
             "better":   {"take": "share", "of": "cost", "run": "sought", "below": "1e-9 um2"},
             "top":      {"take": "max", "of": "y", "run": "wanted"},
             "shape":    {"take": "max_abs", "of": "y", "minus": {"run": "small", "signal": "y"}, "same_stroke": true, "run": "half"},
             "high":     {"take": "share", "of": "drive", "run": "wanted", "above": "3.0001 V", "between": ["0 s", "0.099 s"]},
             "apart":    {"take": "ks_distance", "of": "drive", "run": "wanted", "between": ["0 s", "0.099 s"], "where": [{"signal": "drive", "from": "2.9999 V"}]},
             "selected": {"take": "min", "of": "drive", "run": "part"},
             "least":    {"take": "min", "of": "inside", "run": "inside"},
             "most":     {"take": "max", "of": "inside", "run": "inside"},
             "k_0":      {"take": "first", "of": "k", "run": "band"},
             "number":   {"constant": "2 um"},
             "twice":    {"sum": ["number", "number"]}},
  "claims": [{"id": "C4-01", "value": "weight", "expected": "0.5 um/V", "tolerance": "0.01 um/V"},
             {"id": "C4-01", "order": ["last", "first"]},
             {"id": "C4-02", "value": "rows", "expected": 12, "tolerance": 1e-9},
             {"id": "C4-03", "value": "shape", "below": "1e-9 um"},
             {"id": "C4-04", "value": "high", "expected": 0.49, "tolerance": 1e-9},
             {"id": "C4-04", "value": "apart", "expected": 0.49, "tolerance": 1e-9},
             {"id": "C4-04", "value": "selected", "expected": "3 V", "tolerance": "1e-9 V"},
             {"id": "C4-05", "value": "least", "expected": "-0.579 V", "tolerance": "0.001 V"},
             {"id": "C4-05", "value": "most", "expected": "0.061 V", "tolerance": "0.001 V"},
             {"id": "C4-05", "value": "k_0", "expected": "0.04526 V", "tolerance": "1e-5 V"},
             {"id": "C4-06", "value": "twice", "expected": "4 um", "tolerance": "1e-12 um"},
             {"id": "C4-07", "value": "seeds", "expected": 2, "tolerance": 1e-9}]
})";

class Reproduce : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("diagrams/claims.json", claims);
    folder_.write("diagrams/chapter2/stage.json", stage);
    folder_.write("diagrams/chapter2/model.json", model);
    folder_.write("diagrams/chapter2/fig2_1.json", figure1);
    folder_.write("diagrams/chapter2/fig2_2.json", figure2);
  }
  json result(const std::string& folder) { return json::parse(folder_.read(folder + "/result.json")); }
  /// Exit code 2, and this on standard error, where the figure is changed so.
  void refused(std::string text, const std::string& what, const std::string& instead, const std::string& message) {
    const auto at = text.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    text.replace(at, what.size(), instead);
    folder_.write("diagrams/chapter2/fig2_1.json", text);
    const Outcome outcome = hysteron(folder_.path(), {"reproduce", "fig2_1"});
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(".json:"), std::string::npos) << outcome.err;
  }
  const Folder folder_;
};

TEST_F(Reproduce, EachClaimGetsItsOutcome) {
  const Outcome outcome = hysteron(folder_.path(), {"reproduce", "chapter2", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json found = result("out")["facts"]["claims"];
  EXPECT_EQ(found["C2-01"]["outcome"], "agrees") << found.dump(1);
  EXPECT_EQ(found["C2-02"]["outcome"], "differs");
  EXPECT_EQ(found["C2-03"]["outcome"], "calibrated");
  EXPECT_EQ(found["C2-04"]["outcome"], "cannot be checked");
  EXPECT_EQ(found["C2-04"]["reason"], "nobody has it");
  EXPECT_NE(outcome.out.find("note: A stand-in."), std::string::npos) << outcome.out;
  EXPECT_EQ(found["C2-05"]["outcome"], "agrees") << found.dump(1);  // that no claims.json tells
  EXPECT_FALSE(found.contains("C3-01"));                            // of another chapter
  EXPECT_NE(outcome.out.find("because it is wrong"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("2 figures redrawn; claims: 2 agree, 1 calibrated, 1 differs, 1 cannot be checked"),
            std::string::npos)
      << outcome.out;
  EXPECT_EQ(schema::refuses("result", folder_.read("out/result.json")), "");
}

TEST_F(Reproduce, ThePageOfAChapterShowsEveryFigureAndSaysWhatIsASurrogate) {
  ASSERT_EQ(hysteron(folder_.path(), {"reproduce", "all", "-o", "out"}).code, 0);
  const std::string page = folder_.read("out/chapter2.html");
  for (const char* text :
       {"Fig. 2.1: Loops", "Fig. 2.2: Fits", "A stand-in.", "two loops", "because it is wrong", "y [nm]"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_TRUE(folder_.has("out/traces/fig2_1-1-full.csv"));
  EXPECT_TRUE(folder_.has("out/traces/fig2_1-2-half.csv"));
  EXPECT_TRUE(folder_.read("out/fig2_1-1.svg").starts_with("<svg "));
  EXPECT_TRUE(folder_.read("out/traces/fig2_1-1-full.csv").starts_with("drive [V],y [nm]"))
      << folder_.read("out/traces/fig2_1-1-full.csv").substr(0, 60);
}

TEST_F(Reproduce, ItsPageTellsAllThatIsMeasuredAlsoWhatNoClaimIsAbout) {
  ASSERT_EQ(hysteron(folder_.path(), {"reproduce", "fig2_1", "-o", "out"}).code, 0);
  const json sections = result("out")["sections"];
  const json tables = sections.back()["tables"];
  ASSERT_EQ(tables.size(), 2U) << tables.dump(1);  // measured, combined
  EXPECT_EQ(tables[0]["columns"], json({"run", "stroke of y", "area of y over drive", "max of y"}));
  EXPECT_EQ(tables[0]["rows"][0], json({"Full", "7.5 um", "4.5 um V", ""}));
  EXPECT_EQ(tables[0]["rows"][1], json({"half", "", "", "3 um"}));
  EXPECT_EQ(sections.front()["tables"][0]["columns"][0], "claim") << "the claims of one figure stand at the top alone";
  EXPECT_EQ(tables[1]["rows"][0], json({"ratio", "ratio of stroke, half", "2.5"}));
}

TEST_F(Reproduce, AFigureOrAClaimAloneRunsOnlyWhatItNeeds) {
  ASSERT_EQ(hysteron(folder_.path(), {"reproduce", "C2-05", "-o", "out"}).code, 0);
  EXPECT_FALSE(folder_.has("out/traces/fig2_1-1-full.csv"));
  EXPECT_EQ(result("out")["facts"]["claims"].size(), 1U);
  ASSERT_EQ(hysteron(folder_.path(), {"reproduce", "fig2_1", "-o", "one"}).code, 0);
  const json one = result("one")["facts"]["claims"];
  EXPECT_EQ(one.size(), 3U);
  EXPECT_NE(one["C2-03"]["reason"].get<std::string>().find("fig2_2"), std::string::npos) << one.dump(1);
  EXPECT_EQ(one["C2-01"]["reason"], "");
}

TEST_F(Reproduce, ABaselineIsKeptFirstAndThenAnswersWithTheExitCode) {
  ASSERT_EQ(hysteron(folder_.path(), {"reproduce", "--baseline", "kept"}).code, 0);
  EXPECT_TRUE(folder_.has("kept/baseline.json"));
  const Outcome same = hysteron(folder_.path(), {"reproduce", "--baseline", "kept"});
  EXPECT_EQ(same.code, 0);
  EXPECT_NE(same.out.find("Nothing differs from the baseline"), std::string::npos) << same.out;
  std::string changed = stage;
  changed.replace(changed.find("[1, 0.5]"), 8, "[1, 0.6]");
  folder_.write("diagrams/chapter2/stage.json", changed);
  const Outcome worse = hysteron(folder_.path(), {"reproduce", "--baseline", "kept"});
  EXPECT_EQ(worse.code, 1) << worse.out;
  EXPECT_NE(worse.out.find("C2-01 held in the baseline and does not any more"), std::string::npos) << worse.out;
  EXPECT_NE(worse.out.find("fig2_1-1-full.csv: y differs by up to 300 nm"), std::string::npos) << worse.out;
}

TEST_F(Reproduce, ABaselineThatBeganWithOneFigureTakesTheOthersInAndKnowsWhatIsGone) {
  ASSERT_EQ(hysteron(folder_.path(), {"reproduce", "fig2_1", "--baseline", "kept", "-o", "a"}).code, 0);
  const Outcome more = hysteron(folder_.path(), {"reproduce", "all", "--baseline", "kept", "-o", "b"});
  EXPECT_EQ(more.code, 0) << more.out;
  EXPECT_NE(more.out.find("Added to the baseline"), std::string::npos) << more.out;
  const Outcome again = hysteron(folder_.path(), {"reproduce", "all", "--baseline", "kept", "-o", "c"});
  EXPECT_EQ(again.out.find("Added to the baseline"), std::string::npos) << again.out;
  // A claim that held and that nobody makes any more.
  folder_.write("kept/baseline.json", R"({"format": 1, "outcomes": {"C2-99": "agrees"}})");
  const Outcome gone = hysteron(folder_.path(), {"reproduce", "all", "--baseline", "kept", "-o", "d"});
  EXPECT_EQ(gone.code, 1) << gone.out;
  EXPECT_NE(gone.out.find("C2-99"), std::string::npos) << gone.out;
}

TEST_F(Reproduce, ASpectrumOfUnevenRowsIsRefusedWhereItIsDrawn) {
  folder_.write("diagrams/chapter3/points.csv", "t [s],y [V]\n0,0\n1,1\n3,0\n");
  folder_.write("diagrams/chapter3/fig3_9.json",
                R"({"format": 1, "do": "runs", "runs": {"points": {"table": "points.csv"}},
  "plots": [{"title": "Spectrum", "kind": "spectrum", "y": {"signal": "y"}}]})");
  const Outcome outcome = hysteron(folder_.path(), {"reproduce", "fig3_9", "-o", "out"});
  EXPECT_EQ(outcome.code, 2) << outcome.out;
  EXPECT_NE(outcome.err.find("evenly"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("fig3_9.json:2"), std::string::npos) << outcome.err;
}

TEST_F(Reproduce, AFolderWithoutJobsIsWrongInput) {
  folder_.write("empty/notes.json", "{}");
  const Outcome outcome = hysteron(folder_.path(), {"reproduce", "--from", "empty"});
  EXPECT_EQ(outcome.code, 2) << outcome.out;
  EXPECT_NE(outcome.err.find("empty"), std::string::npos) << outcome.err;
}

TEST_F(Reproduce, LinearizationsTablesAndEveryKindOfPlot) {
  folder_.write("diagrams/chapter3/lag.json", lag);
  folder_.write("diagrams/chapter3/points.csv", "t [ms],y [mV]\n0,0\n1,1264.241118\n");
  folder_.write("diagrams/chapter3/fig3_1.json", figure3);
  const Outcome outcome = hysteron(folder_.path(), {"reproduce", "fig3_1", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(result("out")["facts"]["claims"]["C3-02"]["outcome"], "agrees") << outcome.out;
  EXPECT_TRUE(folder_.read("out/traces/fig3_1-1-gain-lag.csv").starts_with("f [Hz],gain\n"));
  EXPECT_TRUE(folder_.read("out/traces/fig3_1-3-table.csv").starts_with("t [ms],y [mV]\n0,0\n1,1264.24"));
  // Eleven rows from 0 to 1.987 V in four bins of 0.497 V: 0 | 0.787 | 1.264 | the others.
  const std::string counts = folder_.read("out/traces/fig3_1-2-step.csv");
  EXPECT_TRUE(counts.starts_with("y [V],count\n") && counts.ends_with(",8\n")) << counts;
}

TEST_F(Reproduce, SearchesFromSeveralSeedsRowsOfValuesFormulasAndConditions) {
  // Thesis Table 2.2 on 0 to 1 V: c = 0.693, k = 0.648, between 0.179 and 0.709 V; and a point outside.
  folder_.write("diagrams/chapter2/pairs.csv", "row,c,k [V]\n0,0.693,0.648\n1,0.693,1.288\n");
  folder_.write("diagrams/chapter2/fig2_4.json", figure4);
  const Outcome outcome = hysteron(folder_.path(), {"reproduce", "fig2_4", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json found = result("out")["facts"]["claims"];
  for (const char* id : {"C4-01", "C4-02", "C4-03", "C4-04", "C4-05", "C4-06", "C4-07"})
    EXPECT_EQ(found[id]["outcome"], "agrees") << id << found[id].dump(1);
  const std::string made = folder_.read("out/traces/fig2_4-2-made.csv");
  EXPECT_TRUE(made.starts_with("f [Hz],y [um]\n10,7.") && std::count(made.begin(), made.end(), '\n') == 3) << made;
  // Twelve iterations, the start included.
  const std::string medians = folder_.read("out/traces/fig2_4-1-sought.csv");
  EXPECT_EQ(std::count(medians.begin(), medians.end(), '\n'), 13) << medians;
  const Outcome full = hysteron(folder_.path(), {"reproduce", "fig2_4", "--full", "-o", "full"});
  ASSERT_EQ(full.code, 0) << full.err;
  EXPECT_NE(full.out.find("differs: fig2_4: seeds 3; expected 2"), std::string::npos) << full.out;
}

// Draws of the second weight between 0 and 2 um/V: the height is 6 + 3 w, and every draw above 9 um is kept. A share of
// 400 draws is known to 0.025.
constexpr char figure5[] = R"({
  "format": 1, "do": "runs", "title": "Draws",
  "runs": {"samples": {"study": "draws.json", "draws": 400, "record": ["model.weights[1]", "height"], "full": {"accepted": 50}},
           "low": {"select": "samples", "where": [{"signal": "height", "to": "10 um"}]}},
  "plots": [{"kind": "histogram", "bins": 4, "runs": ["low"], "y": {"signal": "height"}}],
  "values": {"draws":    {"take": "parameter", "parameter": "draws", "run": "samples"},
             "accepted": {"take": "parameter", "parameter": "accepted", "run": "samples"},
             "passed":   {"take": "parameter", "parameter": "passed.height", "run": "samples"},
             "least":    {"take": "min", "of": "model.weights[1]", "run": "samples"},
             "rows":     {"take": "rows", "of": "height", "run": "samples"},
             "most":     {"take": "max", "of": "height", "run": "low"}},
  "claims": [{"id": "C4-01", "value": "draws", "expected": 400, "tolerance": 1e-9},
             {"id": "C4-02", "value": "accepted", "expected": 0.5, "tolerance": 0.075},
             {"id": "C4-02", "value": "passed", "expected": 0.5, "tolerance": 0.075},
             {"id": "C4-03", "value": "least", "expected": "1 um/V", "tolerance": "0.05 um/V"},
             {"id": "C4-04", "value": "most", "expected": "10 um", "tolerance": "0.1 um"},
             {"id": "C4-05", "value": "rows", "above": 50.5}]
})";
constexpr char draws[] = R"({
  "format": 1, "do": "study", "diagram": "stage.json",
  "sample": {"method": "uniform", "draws": 7, "shards": 3, "parameters": {"model.weights[1]": {"from": "0 um/V", "to": "2 um/V"}}},
  "features": {"height": {"take": "max", "of": "y"}},
  "filters": [{"feature": "height", "above": "9 um"}]
})";

TEST_F(Reproduce, SamplesOfAStudyAreRowsOfARun) {
  folder_.write("diagrams/chapter2/draws.json", draws);
  folder_.write("diagrams/chapter2/fig2_5.json", figure5);
  const Outcome outcome = hysteron(folder_.path(), {"reproduce", "fig2_5", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json found = result("out")["facts"]["claims"];
  for (const char* id : {"C4-01", "C4-02", "C4-03", "C4-04", "C4-05"})
    EXPECT_EQ(found[id]["outcome"], "agrees") << id << found[id].dump(1);
  const Outcome full = hysteron(folder_.path(), {"reproduce", "fig2_5", "--full", "-o", "full"});
  EXPECT_NE(full.out.find("differs: fig2_5: rows 50; expected above 50.5"), std::string::npos) << full.out << full.err;
  std::string wrong = figure5;
  wrong.replace(wrong.find("\"height\"], \"full\""), 17, "\"heigth\"], \"full\"");
  folder_.write("diagrams/chapter2/fig2_5.json", wrong);
  const Outcome refusal = hysteron(folder_.path(), {"reproduce", "fig2_5"});
  EXPECT_EQ(refusal.code, 2);
  EXPECT_NE(refusal.err.find("Did you mean \"height\"?"), std::string::npos) << refusal.err;
}

TEST_F(Reproduce, AWrongSearchIsToldAtItsPlace) {
  const std::string start = figure4;
  folder_.write("diagrams/chapter2/pairs.csv", "row,c,k [V]\n0,0.693,0.648\n");
  refused(start, "\"model.weights[1]\": [", "\"model.weigths[1]\": [", "Did you mean \"model.weights");
  refused(start, "[\"0 um/V\", \"2 um/V\"]", "[\"0 um/V\", \"2 V\"]", "this is in");
  refused(start, "\"method\": \"pso\"", "\"method\": \"psoo\"", "\"pso\"");
  refused(start, "\"sum_squares\", \"of\": \"y\"", "\"sum_squares\", \"of\": \"z\"", "\"z\"");
  refused(start, "\"y\": [\"top\", \"top\"]", "\"y\": [\"top\"]", "give every column as many");
  refused(start, "[\"top\", \"top\"]", "[\"top\", \"tap\"]", "Did you mean \"top\"");
  refused(start, "\"from\": 11, \"to\": 11", "\"from\": 1100", "no row fulfils");
  refused(start, "\"computed\": \"piezo_lower\", \"top\": \"1 V\"}", "\"computed\": \"piezo_lowr\"}", "piezo_lower");
}

TEST_F(Reproduce, ADamagedBaselineIsRefused) {
  folder_.write("kept/baseline.json", "{\"outcomes\": 3}");
  const Outcome outcome = hysteron(folder_.path(), {"reproduce", "--baseline", "kept"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("baseline.json"), std::string::npos) << outcome.err;
}

TEST_F(Reproduce, ARunThatFailsCostsItsOwnFigureAlone) {
  std::string text = figure2;  // no offset up to 4 V makes the drive end at 50 V
  text.replace(text.find("\"5 V\"}}"), 7, "\"50 V\"}}");
  folder_.write("diagrams/chapter2/fig2_2.json", text);
  const Outcome outcome = hysteron(folder_.path(), {"reproduce", "-o", "out"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_NE(outcome.out.find("fig2_2 failed"), std::string::npos) << outcome.out;
  EXPECT_EQ(result("out")["facts"]["claims"]["C2-05"]["outcome"], "differs");
  EXPECT_EQ(result("out")["facts"]["claims"]["C2-01"]["outcome"], "agrees");
}

TEST_F(Reproduce, ResultsDoNotHangOnHowManyRunAtOnce) {
  ASSERT_EQ(process::shell(folder_.path(), "taskset -c 0 hysteron reproduce -o a").code,
            0);  // one processor: one thread
  ASSERT_EQ(hysteron(folder_.path(), {"reproduce", "-o", "b"}).code, 0);
  EXPECT_EQ(folder_.read("a/result.json"), folder_.read("b/result.json"));
  EXPECT_EQ(folder_.read("a/traces/fig2_1-1-full.csv"), folder_.read("b/traces/fig2_1-1-full.csv"));
}

TEST_F(Reproduce, WrongInputIsToldWithFileLineAndNearestName) {
  refused(figure1, "{\"signal\": \"drive\", \"unit\"", "{\"signal\": \"driv\", \"unit\"", "Did you mean \"drive\"?");
  refused(figure1, "\"unit\": \"nm\"", "\"unit\": \"V\"", "the axis in V");
  refused(figure1, "\"expected\": \"7.5 um\"", "\"expected\": \"7.5 V\"", "the value is in um");
  refused(figure1, "\"comp\": \"half\"", "\"comp\": \"halve\"", "half");
  refused(figure1, "[\"0 s\", \"0.2 s\"]", "[\"5 s\", \"6 s\"]", "there are no rows");
  refused(figure1, "\"over\": \"drive\"", "\"over\": \"driv\"", "Did you mean \"drive\"?");
}

TEST_F(Reproduce, JobsAndValuesThatNeedThemselvesAreToldSo) {
  refused(figure1, "\"half\": {\"choose\": {\"comp\": \"half\"}}",
          "\"half\": {\"from\": \"fig2_2.json\", \"run\": \"loop\"}", "jobs take runs from each other");
  refused(figure1, "\"full\": {\"title\": \"Full\"}", "\"full\": {\"set\": {\"drive.offset\": {\"of\": \"stroke\"}}}",
          "needs itself");
}

TEST_F(Reproduce, UnknownFiguresAreToldWithTheNearestName) {
  const Outcome outcome = hysteron(folder_.path(), {"reproduce", "fig2_11"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("fig2_1"), std::string::npos) << outcome.err;
  EXPECT_EQ(hysteron(folder_.path(), {"reproduce", "--from", "nowhere"}).code, 2);
}

}  // namespace
}  // namespace hysteron
