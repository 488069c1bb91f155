#include "fit/thesis/problem.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/diagram/error.h"
#include "tests/fit/lab.h"

namespace hysteron {
namespace {

Diagram diagram() {
  Diagram d = lab::diagram("g");
  lab::add(d, "amplifier", "lag", "u").parameters["times"] = NumberList{{50, "ms"}, {5, "ms"}};
  lab::add(d, "g", "gain", "amplifier").parameters["gain"] = "1 um/V";
  return d;
}

DataSet data(std::size_t recordings) {
  DataSet set;
  for (std::size_t r = 0; r < recordings; ++r) {
    set.recordings.push_back(
        lab::recording("r" + std::to_string(r), Role::train, 0.01, 10, [](double t) { return t; }));
    if (r == 2) set.recordings.back().role = Role::test;
  }
  return set;
}

WrittenNumber written(double value, const char* unit, const char* pointer = "/free/0/start") {
  WrittenNumber number;
  number.number.value = value;
  if (unit != nullptr) number.number.unit = unit;
  number.pointer = pointer;
  return number;
}

FitJob job_with(const FreeWish& wish) {
  FitJob job;
  job.free = {wish};
  job.methods.emplace_back();
  return job;
}

FreeWish wish_for(const char* path) {
  FreeWish wish;
  wish.parameter = {path, "/free/0/parameter"};
  return wish;
}

/// code and path of the first problem.
std::string problem_with(const FitJob& job) {
  const auto program = compile(diagram(), lab::registry());
  try {
    problem_of(job, *program, data(2), {});
  } catch (const Error& error) {
    EXPECT_FALSE(error.problems.front().cure.empty());
    return error.problems.front().code + " " + error.problems.front().path;
  }
  return "";
}

TEST(FitProblem, NumbersBecomeSiByTheirOwnUnitOrThatOfTheDiagram) {
  const auto program = compile(diagram(), lab::registry());
  auto wish = wish_for("g.gain");
  wish.lower = written(0.5, nullptr);  // um/V, as the diagram writes it
  wish.upper = written(2000, "nm/V");
  wish.start = written(1.5, "um/V");
  wish.prior = {written(1, nullptr), written(2, nullptr)};
  const auto problem = problem_of(job_with(wish), *program, data(2), {});
  ASSERT_EQ(problem.free.size(), 1U);
  const auto& f = problem.free[0];
  EXPECT_NEAR(f.lower, 0.5e-6, 1e-18);  // rounding of a double near 1e-6
  EXPECT_NEAR(f.upper, 2e-6, 1e-18);
  EXPECT_NEAR(f.start, 1.5e-6, 1e-18);
  EXPECT_NEAR(f.prior->second, 2e-6, 1e-18);
}

TEST(FitProblem, AListStandsForAllItsElementsAndPerRecordingForAllButTestRecordings) {
  const auto program = compile(diagram(), lab::registry());
  auto wish = wish_for("amplifier.times");
  EXPECT_EQ(problem_of(job_with(wish), *program, data(1), {}).free.size(), 2U);
  wish.per_recording = true;
  const auto problem = problem_of(job_with(wish), *program, data(3), {});
  ASSERT_EQ(problem.free.size(), 4U);
  EXPECT_EQ(problem.free[0].recording, 0);
  EXPECT_EQ(problem.free[1].recording, 1);
  EXPECT_EQ(problem.free[0].parameter, problem.free[1].parameter);
}

TEST(FitProblem, BetweenPositiveBoundsTheScaleIsLogarithmicUnlessSaid) {
  const auto program = compile(diagram(), lab::registry());
  auto wish = wish_for("amplifier.times[0]");
  wish.lower = written(1, "ms");
  wish.upper = written(1, "s");
  EXPECT_TRUE(problem_of(job_with(wish), *program, data(1), {}).free[0].log_scale);
  wish.log_scale = false;
  EXPECT_FALSE(problem_of(job_with(wish), *program, data(1), {}).free[0].log_scale);
}

TEST(FitProblem, MethodsBecomeOptions) {
  const auto program = compile(diagram(), lab::registry());
  auto job = job_with(wish_for("amplifier.times"));
  job.seed = 5;
  job.methods[0].starts = 30;
  job.methods.push_back({.name = {"pso", ""}, .runs = 77, .then_search = false});
  job.profile = {{"amplifier.times[1]", "/profile/0"}};
  const auto problem = problem_of(job, *program, data(1), {});
  ASSERT_EQ(problem.methods.size(), 2U);
  EXPECT_TRUE(problem.methods[0].options.global.empty());
  EXPECT_EQ(problem.methods[0].options.starts, 30);
  EXPECT_EQ(problem.methods[0].options.profile, std::vector<int>{1});
  EXPECT_EQ(problem.methods[1].options.global, "pso");
  EXPECT_EQ(problem.methods[1].options.global_runs, 77);
  EXPECT_FALSE(problem.methods[1].options.polish);
  EXPECT_EQ(problem.methods[1].options.seed, 5U);
}

TEST(FitProblem, WrongWishesAreToldWithTheirPlaceInTheJob) {
  EXPECT_EQ(problem_with(job_with(wish_for("g.gian"))), "unknown_parameter /free/0/parameter");
  auto wish = wish_for("g.gain");
  wish.start = written(1, "kg");
  EXPECT_EQ(problem_with(job_with(wish)), "wrong_unit /free/0/start");
  wish.start = written(1, "blob");
  EXPECT_EQ(problem_with(job_with(wish)).substr(0, 9), "bad_unit ");
  wish.start = written(3, "um/V");
  wish.upper = written(2, "um/V", "/free/0/upper");
  EXPECT_EQ(problem_with(job_with(wish)), "start_outside /free/0/start");
  wish.start.reset();
  wish.lower = written(2.5, "um/V", "/free/0/lower");
  EXPECT_EQ(problem_with(job_with(wish)), "bad_bounds /free/0/lower");
  wish = wish_for("g.gain");
  wish.prior = {written(2, nullptr, "/free/0/prior/0"), written(1, nullptr)};
  EXPECT_EQ(problem_with(job_with(wish)), "bad_prior /free/0/prior/0");
  auto job = job_with(wish_for("g.gain"));
  job.free.push_back(job.free[0]);
  EXPECT_EQ(problem_with(job), "free_twice /free/0/parameter");
  job = job_with(wish_for("g.gain"));
  job.methods[0].name = {"psso", "/method/name"};
  EXPECT_EQ(problem_with(job), "unknown_method /method/name");
  job = job_with(wish_for("g.gain"));
  job.profile = {{"amplifier.times[0]", "/profile/0"}};
  EXPECT_EQ(problem_with(job), "not_free /profile/0");
}

TEST(FitProblem, AnAttractorOfAnyParametersIsReadInTheUnitsThatPeopleSee) {
  // Time constants shown in ms, gain in um/V: 3 exp(0.2 x) with x in ms is 3e-6 exp(200 x) m/V with x in s.
  FitJob job;
  for (const char* path : {"amplifier.times[0]", "g.gain"}) {
    FreeWish wish = wish_for(path);
    wish.lower = written(0.1, nullptr);
    wish.upper = written(100, nullptr);
    job.free.push_back(wish);
  }
  MethodWish method;
  method.name = {"nmpso", ""};
  method.attractor.emplace();
  method.attractor->components = {
      {.parameter = {"amplifier.times[0]", ""}, .draw = {written(1, nullptr), written(0.02, "s")}},
      {.parameter = {"g.gain", ""},
       .of = WrittenText{"amplifier.times[0]", ""},
       .upper = {{3, 0.2}},
       .lower = {{1, 0}, {2, -0.1}},
       .scale = 5}};
  job.methods = {method};
  const auto program = compile(diagram(), lab::registry());
  const auto problem = problem_of(job, *program, data(2), {});
  const auto& all = problem.methods.front().options.attractor->components;
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].component, 0);
  EXPECT_NEAR(all[0].low, 1e-3, 1e-18);
  EXPECT_NEAR(all[0].high, 0.02, 1e-17);
  EXPECT_EQ(all[1].of, 0);
  EXPECT_NEAR(all[1].upper[0].factor, 3e-6, 1e-20);
  EXPECT_NEAR(all[1].upper[0].rate, 200, 1e-12);
  EXPECT_NEAR(all[1].lower[1].rate, -100, 1e-12);
  EXPECT_EQ(all[1].scale, 5);
}

}  // namespace
}  // namespace hysteron
