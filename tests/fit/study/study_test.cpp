// Studies: what a shard computes, what is counted, and that the result depends on nothing but the job.
#include "fit/study/study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fit/signals/features.h"
#include "fit/study/study_problem.h"
#include "fit/study/study_runs.h"
#include "tests/fit/lab.h"

namespace hysteron {
namespace {

/// y = gain * limited lag of a sine of 3 V; the limit refuses an upper end that is not above the lower one.
ProgramPointer program() {
  Diagram d;
  Node& drive = d.blocks["drive"];
  drive.type = "sine";
  drive.parameters["amplitude"] = "3 V";
  drive.parameters["offset"] = "1 V";
  drive.parameters["frequency"] = "5 Hz";
  lab::add(d, "slow", "lag", "drive").parameters["times"] = NumberList{{10, "ms"}};
  Node& limit = lab::add(d, "limit", "saturation", "slow");
  limit.parameters["lower"] = "0 V";
  limit.parameters["upper"] = "3 V";
  lab::add(d, "stage", "gain", "limit").parameters["gain"] = "2 um/V";
  d.outputs["y"] = "stage";
  d.simulate.until = Number{0.4, "s"};
  d.simulate.every = Number{2, "ms"};
  return compile(d, lab::registry());
}

WrittenNumber number(double value, const char* unit = nullptr, const char* pointer = "/x") {
  return {{value, unit == nullptr ? std::nullopt : std::optional<std::string>(unit)}, pointer};
}

DrawnParameterWish drawn(const char* path, WrittenNumber from, WrittenNumber to) {
  DrawnParameterWish wish;
  wish.parameter = {path, std::string("/sample/parameters/") + path};
  wish.from = std::move(from);
  wish.to = std::move(to);
  return wish;
}

FeatureWish taken(const char* name, const char* take, const char* of) {
  FeatureWish f;
  f.name = name;
  f.pointer = std::string("/features/") + name;
  f.take = {take, f.pointer + "/take"};
  f.of = {of, f.pointer + "/of"};
  return f;
}

FeatureWish combined(const char* name, const char* how, std::vector<OperandWish> operands) {
  FeatureWish f;
  f.name = name;
  f.take = {how, ""};
  f.operands = std::move(operands);
  return f;
}

OperandWish named(const char* name) { return {{name, "/operand"}, {}}; }
OperandWish constant(double value, const char* unit = nullptr) { return {{"", "/operand"}, number(value, unit)}; }

ConditionWish above(const char* feature, WrittenNumber bound) {
  ConditionWish c;
  c.feature = {feature, "/filters/0/feature"};
  c.above = std::move(bound);
  return c;
}

/// Gain 1 ... 3 um/V and limit -1 ... 4 V, of which a fifth cannot be simulated; stroke, area over the drive, their
/// ratio.
StudyJob job(std::uint64_t draws = 60) {
  StudyJob j;
  j.method = {"uniform", ""};
  j.seed = 3;
  j.draws = draws;
  j.shards = 4;
  j.parameters = {drawn("stage.gain", number(1, "um/V"), number(3000, "nm/V")),
                  drawn("limit.upper", number(-1, "V"), number(4000, "mV"))};
  FeatureWish stroke = taken("stroke", "stroke", "y"), area = taken("area", "area", "y");
  stroke.between = area.between = {number(0.2, "s"), number(400, "ms")};
  area.over = WrittenText{"drive", "/over"};
  stroke.unit = WrittenText{"nm", "/unit"};
  j.features = {stroke, area, combined("shape", "ratio", {named("area"), named("stroke")}),
                combined("scaled", "product", {named("stage.gain"), constant(6, "V"), constant(2)})};
  return j;
}

TEST(Study, FeaturesAreThoseOfEachSimulationInTheUnitsOfTheirColumns) {
  const auto problem = study_of(job(), program());
  const Study& study = problem.study;
  ASSERT_EQ(study.columns.size(), 6U);
  EXPECT_EQ(study.columns[2].unit.text, "nm");
  EXPECT_EQ(study.columns[3].unit.text, "um V");
  EXPECT_EQ(study.columns[5].unit.text, "um/V V");
  EXPECT_EQ(study.columns[4].meaning, "ratio of area, stroke");
  const StudyTable table = compute_study(study, 1);
  EXPECT_EQ(table.counts.draws, 60U);
  ASSERT_GT(table.counts.accepted, 30U);
  for (const std::size_t i : {std::size_t{0}, std::size_t{7}, table.draw.size() - 1}) {
    auto run = start(*study.program);
    set_parameter(*study.program, run, "stage.gain", table.columns[0][i] * 1e-6);
    set_parameter(*study.program, run, "limit.upper", table.columns[1][i]);
    SimulateOptions options = study.options;
    const Traces traces = simulate(*study.program, run, options);
    const std::span<const double> y(traces.values[0]), u(traces.values[1]);
    // The values went through the units of their columns, which costs some roundings.
    EXPECT_NEAR(table.columns[2][i], features::stroke(y.subspan(100)) * 1e9, 1e-9 * table.columns[2][i]);
    EXPECT_NEAR(table.columns[3][i], features::loop_area(u.subspan(100), y.subspan(100)) * 1e6,
                1e-9 * table.columns[3][i]);
    EXPECT_NEAR(table.columns[4][i], table.columns[3][i] / table.columns[2][i], 1e-9 * table.columns[4][i]);
    EXPECT_NEAR(table.columns[5][i], table.columns[0][i] * 12, 1e-9);
  }
}

TEST(Study, FailingSamplesAreRejectedWithTheirReason) {
  const Study study = study_of(job(), program()).study;
  const StudyTable table = compute_study(study, 1);
  std::uint64_t failed = 0;
  for (const auto& [code, n] : table.counts.failed) failed += n;
  EXPECT_EQ(table.counts.accepted + failed, 60U);
  Sampler sampler = *study.sampler;
  std::uint64_t below = 0, first = 60;
  std::vector<double> values(2);
  for (std::uint64_t i = 0; i < 60; ++i) {
    sampler.draw(i, values);
    if (values[1] > 0) continue;
    ++below;
    first = std::min(first, i);
  }
  EXPECT_GT(below, 3U);
  EXPECT_EQ(failed, below);
  EXPECT_EQ(table.counts.failure_draw, first);
  EXPECT_NE(table.counts.failure.find("limit"), std::string::npos) << table.counts.failure;
}

TEST(Study, FiltersAreCountedAloneAndTogether) {
  StudyJob j = job();
  ConditionWish stiff = above("stroke", number(4, "um")), range = above("limit.upper", number(500, "mV"));
  range.at_most = number(3);
  j.filters = {stiff, range};
  j.keep_all = true;
  const Study study = study_of(j, program()).study;
  const StudyTable table = compute_study(study, 1);
  ASSERT_EQ(table.draw.size(), 60U);
  std::uint64_t first = 0, second = 0, both = 0;
  for (std::size_t i = 0; i < 60; ++i) {
    const bool a = table.columns[2][i] > 4000, b = table.columns[1][i] > 0.5 && table.columns[1][i] <= 3;
    first += a ? 1 : 0;
    second += b ? 1 : 0;
    both += a && b ? 1 : 0;
    EXPECT_EQ(table.accepted[i] != 0, a && b);
  }
  EXPECT_EQ(table.counts.passed, (std::vector<std::uint64_t>{first, second}));
  EXPECT_EQ(table.counts.accepted, both);
  EXPECT_GT(both, 3U);
  EXPECT_LT(both, first);
}

TEST(Study, ANumberThatIsNotFiniteRejectsItsSample) {
  StudyJob j = job(40);
  j.parameters.pop_back();
  j.features = {combined("wrong", "ratio", {constant(1), constant(0)}), taken("top", "max", "y")};
  const StudyTable table = compute_study(study_of(j, program()).study, 1);
  EXPECT_EQ(table.counts.accepted, 0U);
  EXPECT_EQ(table.counts.not_finite[1], 40U);
  EXPECT_EQ(table.counts.not_finite[2], 0U);
}

void expect_same(const StudyTable& a, const StudyTable& b) {
  EXPECT_EQ(a.draw, b.draw);
  EXPECT_EQ(a.columns, b.columns);
  EXPECT_EQ(a.accepted, b.accepted);
  EXPECT_EQ(a.counts.draws, b.counts.draws);
  EXPECT_EQ(a.counts.accepted, b.counts.accepted);
  EXPECT_EQ(a.counts.passed, b.counts.passed);
  EXPECT_EQ(a.counts.failed, b.counts.failed);
  EXPECT_EQ(a.counts.failure, b.counts.failure);
  EXPECT_EQ(a.counts.histograms, b.counts.histograms);
}

TEST(Study, WithAFixedNumberOfDrawsNothingDependsOnShardsAndThreads) {
  for (const char* method : {"uniform", "latin_hypercube", "sobol"}) {
    StudyJob j = job();
    j.method.text = method;
    j.filters = {above("stroke", number(4, "um"))};
    Study study = study_of(j, program()).study;
    study.shards = 1;
    const StudyTable one = compute_study(study, 1);
    for (const int shards : {2, 7, 60, 64}) {
      study.shards = shards;
      expect_same(compute_study(study, 2), one);
    }
  }
}

TEST(Study, UntilEnoughAreAcceptedEachShardTakesItsShareOfEveryNthDraw) {
  StudyJob j = job();
  j.draws.reset();
  j.accepted = 25;
  j.filters = {above("stroke", number(4, "um"))};
  const Study study = study_of(j, program()).study;
  const StudyTable table = compute_study(study, 2);
  EXPECT_EQ(table.counts.accepted, 25U);
  EXPECT_FALSE(table.counts.gave_up);
  std::size_t begin = 0;
  for (std::uint64_t k = 0; k < 4; ++k) {
    const std::size_t share = k == 0 ? 7 : 6;
    for (std::size_t i = begin; i < begin + share; ++i) {
      EXPECT_EQ(table.draw[i] % 4, k);
      EXPECT_TRUE(i == begin || table.draw[i] > table.draw[i - 1]);
    }
    begin += share;
  }
  expect_same(compute_study(study, 1), table);
}

TEST(Study, FiltersThatNothingPassesEnd) {
  StudyJob j = job();
  j.draws.reset();
  j.accepted = 10;
  j.give_up_after = 50;
  j.filters = {above("stroke", number(1, "m"))};
  const StudyTable table = compute_study(study_of(j, program()).study, 1);
  EXPECT_TRUE(table.counts.gave_up);
  EXPECT_EQ(table.counts.draws, 50U);
  EXPECT_EQ(table.counts.accepted, 0U);
}

TEST(Study, HistogramsOfAllDrawsAreCountedWhileTheyAreMade) {
  StudyJob j = job();
  StudyPlotWish plot;
  plot.x.feature = {"stage.gain", "/plots/0/x"};
  plot.bins = 5;
  plot.all = true;
  plot.where = {above("stage.gain", number(1.5))};
  j.plots = {plot};
  const auto problem = study_of(j, program());
  ASSERT_EQ(problem.plots.at(0).counted, 0);
  const StudyTable table = compute_study(problem.study, 1);
  std::vector<std::uint64_t> counted(5, 0);
  Sampler sampler = *problem.study.sampler;
  std::vector<double> values(2);
  for (std::uint64_t i = 0; i < 60; ++i) {
    sampler.draw(i, values);
    const double gain = values[0] * 1e6;
    if (gain > 1.5) ++counted[static_cast<std::size_t>((gain - 1) / 0.4)];
  }
  EXPECT_EQ(table.counts.histograms.at(0), counted);
}

TEST(Study, BinsIncludeBothEndsAndLeaveOutWhatLiesOutside) {
  const Bins even{0, 10, 5, false}, log{0.01, 100, 4, true};
  EXPECT_EQ(even.bin(0), 0);
  EXPECT_EQ(even.bin(10), 4);
  EXPECT_EQ(even.bin(4), 2);
  EXPECT_FALSE(even.bin(10.001));
  EXPECT_FALSE(even.bin(-1e-9));
  EXPECT_FALSE(even.bin(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(log.bin(0.5), 1);
  EXPECT_NEAR(log.edge(3), 10, 1e-12);
  EXPECT_FALSE(log.bin(0));
}

TEST(Study, ItsDescriptionChangesWithEverythingThatDecidesItsNumbers) {
  const auto text = [](const StudyJob& j) { return study_of(j, program()).study.description; };
  const std::string base = text(job());
  EXPECT_EQ(text(job()), base);
  std::vector<StudyJob> others(7, job());
  others[0].seed = 4;
  others[1].draws = 61;
  others[2].parameters[0].to = number(3.0001, "um/V");
  others[3].features[0].between.from = number(0.1, "s");
  others[4].filters = {above("stroke", number(4, "um"))};
  others[5].keep_all = true;
  others[6].until = number(0.5, "s");
  for (const auto& other : others) EXPECT_NE(text(other), base);
  StudyJob shards = job();
  shards.shards = 9;
  EXPECT_EQ(text(shards), base);
}

/// code and pointer of the first problem.
std::string problem(const StudyJob& j) {
  try {
    study_of(j, program());
  } catch (const Error& error) {
    for (const auto& p : error.problems) EXPECT_FALSE(p.cure.empty());
    return error.problems.front().code + " " + error.problems.front().path;
  }
  return "";
}

TEST(Study, WrongJobsAreToldWithTheirPlace) {
  const auto with = [](const auto& change) {
    StudyJob j = job();
    change(j);
    return problem(j);
  };
  EXPECT_EQ(with([](StudyJob&) {}), "");
  EXPECT_EQ(with([](StudyJob& j) { j.parameters[0].parameter.text = "stage.gian"; }),
            "unknown_parameter /sample/parameters/stage.gain");
  EXPECT_EQ(with([](StudyJob& j) { j.parameters[0].from = number(1, "N", "/from"); }), "wrong_unit /from");
  EXPECT_EQ(with([](StudyJob& j) { j.parameters[0].from = number(4, "um/V", "/from"); }), "bad_range /from");
  EXPECT_EQ(with([](StudyJob& j) { j.parameters[1].log = true; }), "bad_range /x");
  EXPECT_EQ(with([](StudyJob& j) { j.parameters[1] = j.parameters[0]; }), "varied_twice /sample/parameters/stage.gain");
  EXPECT_EQ(with([](StudyJob& j) { j.features[0].of.text = "z"; }), "unknown_signal /features/stroke/of");
  EXPECT_EQ(with([](StudyJob& j) { j.features[0].minus = WrittenText{"drive", "/minus"}; }), "wrong_unit /minus");
  EXPECT_EQ(with([](StudyJob& j) { j.features[0].between.to = j.features[0].between.from = number(3, "s"); }),
            "empty_window /x");
  EXPECT_EQ(with([](StudyJob& j) { j.features[0].unit = WrittenText{"V", "/unit"}; }), "wrong_unit /unit");
  EXPECT_EQ(with([](StudyJob& j) {
              j.features.push_back(combined("bad", "sum", {named("stroke"), named("area")}));
            }),
            "wrong_unit /operand");
  EXPECT_EQ(with([](StudyJob& j) { j.filters = {above("stroke", number(9, "V", "/bound"))}; }), "wrong_unit /bound");
  EXPECT_EQ(with([](StudyJob& j) { j.solver = WrittenText{"rk5", "/solver/method"}; }), "bad_value /solver/method");
  EXPECT_EQ(with([](StudyJob& j) {
              j.plots.emplace_back();
              j.plots[0].x.feature = {"stroke", "/plots/0/x"};
              j.plots[0].all = true;
            }),
            "missing_key /plots/0/x");
}

TEST(Study, ListsHaveOneValueOfEachParameterPerDraw) {
  StudyJob j = job();
  j.method.text = "list";
  j.draws.reset();
  for (auto& p : j.parameters) p.from.reset(), p.to.reset();
  j.parameters[0].values = {number(1, "um/V"), number(2, "um/V")};
  j.parameters[1].values = {number(1, "V")};
  EXPECT_EQ(problem(j), "bad_value /sample/parameters/limit.upper");
  j.parameters[1].values.push_back(number(7000, "mV"));
  const StudyTable table = compute_study(study_of(j, program()).study, 1);
  EXPECT_EQ(table.columns[0], (std::vector<double>{1, 2}));
  EXPECT_DOUBLE_EQ(table.columns[1][1], 7);
}

TEST(Study, AnInterruptedShardGivesNothing) {
  const Study study = study_of(job(), program()).study;
  int kept = 0;
  const auto counts = compute_shard(
      study, 0, 1, [&](const StudySample&) { ++kept; }, [](const StudyCounts& c) { return c.draws < 10; });
  EXPECT_FALSE(counts);
  EXPECT_LE(kept, 10);
}

}  // namespace
}  // namespace hysteron
