// Runs in lanes: the same numbers as one after the other, whatever stands in the diagram; what cannot go in lanes is
// told by the block that stands in the way.
#include "engine/lanes/lanes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "models/random.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

/// A parameter and the range from which samples are drawn [SI].
struct Varied {
  std::string path;
  double from, to;
};

std::vector<int> places(const Program& p, const std::vector<Varied>& varied) {
  std::vector<int> list;
  for (const auto& v : varied) list.push_back(static_cast<int>(p.find_parameter(v.path) - p.parameters.data()));
  return list;
}
std::vector<double> drawn(const std::vector<Varied>& varied, int samples) {
  std::vector<double> values;
  for (int s = 0; s < samples; ++s)
    for (std::size_t i = 0; i < varied.size(); ++i)
      values.push_back(varied[i].from +
                       (varied[i].to - varied[i].from) * random::uniform(5, i, static_cast<std::uint64_t>(s)));
  return values;
}

using Columns = std::vector<std::vector<std::vector<double>>>;  // [sample][signal][row]

Columns in_lanes(ProgramPointer p, const Run& run, const SimulateOptions& options, const std::vector<int>& parameters,
                 const std::vector<double>& values, std::vector<std::optional<Problem>>* told = nullptr,
                 RefusedValues refused = RefusedValues::end_the_run) {
  Lanes lanes(p, run, options, parameters, refused);
  const std::size_t samples = values.size() / parameters.size(), signals = p->record_signals.size();
  Columns columns(samples, std::vector<std::vector<double>>(signals));
  const auto results = lanes(values, [&](long row, double, const double* y) {
    EXPECT_EQ(row, static_cast<long>(columns[0][0].size()));
    for (std::size_t s = 0; s < samples; ++s)
      for (std::size_t k = 0; k < signals; ++k) columns[s][k].push_back(y[k * Lanes::width + s]);
  });
  if (told != nullptr)
    *told = results;
  else
    for (const auto& r : results) EXPECT_FALSE(r) << r->what;
  return columns;
}

/// Some samples in lanes and each of them by simulate(): largest difference over the largest value of the signal.
void expect_the_same(const Diagram& d, const SimulateOptions& options, const std::vector<Varied>& varied,
                     const SeriesPointer& input = nullptr) {
  const auto p = compiled(d);
  Run run = start(*p);
  if (input) bind_input(*p, run, "u", input);
  const auto parameters = places(*p, varied);
  ASSERT_EQ(why_not_in_lanes(*p, run, options, parameters), "");
  constexpr int samples = 5;
  const auto values = drawn(varied, samples);
  const auto columns = in_lanes(p, run, options, parameters, values);
  for (std::size_t s = 0; s < samples; ++s) {
    Run one = run;
    for (std::size_t i = 0; i < varied.size(); ++i)
      set_parameter(*p, one, varied[i].path, values[s * varied.size() + i]);
    reset(*p, one);
    const auto traces = simulate(*p, one, options);
    for (std::size_t k = 0; k < traces.values.size(); ++k)
      // what issue asks: the same but for the rounding of sums in another order
      EXPECT_LT(distance(columns[s][k], trace(traces, k)), 1e-12 * largest(trace(traces, k))) << s << " " << k;
  }
}

SimulateOptions fixed(Method method, double step = 1e-4, double until = 0.1) {
  return {.until = until, .every = 1e-4, .method = method, .step = step};
}

Node thesis_jiles_atherton(const std::string& in) {
  return block("jiles_atherton", {{"p_s", "12.5 um"}, {"a", "6.3 V"}, {"alpha", "0.1 V/um"}, {"k", "2 V"}, {"c", 0.4}},
               {in});
}
const std::vector<Varied> five{
    {"law.p_s", 5e-6, 15e-6}, {"law.a", 4, 9}, {"law.alpha", 1e4, 1e5}, {"law.k", 0.5, 3}, {"law.c", 0.05, 0.6}};
Diagram loops() {
  return diagram(
      {{"u", block("sine", {{"amplitude", "3 V"}, {"offset", "3 V"}, {"frequency", "20 Hz"}, {"phase", "-90 deg"}})},
       {"law", thesis_jiles_atherton("u")}},
      {"law", "u"});
}

class LanesByMethod : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Fixed, LanesByMethod, testing::Values(Method::euler, Method::rk4),
                         [](const auto& i) { return method_name(i.param); });

TEST_P(LanesByMethod, JilesAthertonLoopsAreThoseOfSingleRuns) { expect_the_same(loops(), fixed(GetParam()), five); }

TEST_P(LanesByMethod, StepsMayBeShorterThanRows) { expect_the_same(loops(), fixed(GetParam(), 0.25e-4), five); }

TEST_P(LanesByMethod, AClosedLoopWithAPlantAndCreep) {
  // A source with corners, laws driven by rates, sized blocks (transfer function, creep, sum), feedback.
  expect_the_same(
      diagram({{"r", block("triangle", {{"amplitude", "3 um"}, {"offset", "3 um"}, {"frequency", "33 Hz"}})},
               {"e", block("sum", {{"signs", "+-"}}, {"r", "y"})},
               {"controller", thesis_controller(1, "e")},
               {"law", thesis_bouc_wen("controller")},
               {"plant", thesis_plant("law")},
               {"y", block("creep", {{"amounts", list({0.02, 0.01})}, {"times", list({0.01, 0.1}, "s")}}, {"plant"})}},
              {"y", "e", "r"}),
      fixed(GetParam(), 1e-5),
      {{"law.alpha", 0.5e-6, 0.7e-6}, {"law.gamma", 0.02, 0.03}, {"controller.kp", 0.5e6, 1.5e6}});
}

TEST_P(LanesByMethod, MemoryBehindASourceThatIsVariedItself) {
  expect_the_same(
      diagram({{"u", block("sine", {{"amplitude", "3 V"}, {"frequency", "20 Hz"}})},
               {"joint", block("backlash", {{"gap", "0.5 V"}}, {"u"})},
               {"operators", thesis_operators("joint")},
               {"late", block("lag", {{"times", list({0.003}, "s")}}, {"operators"})}},
              {"late", "operators", "joint"}),
      fixed(GetParam()),
      {{"u.amplitude", 1, 4}, {"u.frequency", 10, 30}, {"joint.gap", 0.1, 1}, {"operators.weights[2]", 0, 1e-6}});
}

TEST(Lanes, AStaticDiagramGoesFromRowToRow) {
  std::vector<double> v;
  const auto t = grid(0, 1, 200);
  for (std::size_t i = 0; i < t.size(); ++i) v.push_back(6 * random::uniform(3, 0, i));
  const auto d = diagram(
      {{"operators", thesis_operators("u")},
       {"y",
        block(
            "polynomial",
            {{"coefficients", list({0, 1, -0.02}, "um")}, {"reference", "6 um"}, {"lower", "0 um"}, {"upper", "6 um"}},
            {"operators"})}},
      {"y"}, {{"u", "V"}});
  expect_the_same(d, {.until = 1, .every = 0.005}, {{"operators.weights[0]", 1e-7, 1e-6}}, series(t, v));
  // rows between the samples: the samples are passed, too
  expect_the_same(d, {.until = 1, .every = 0.03}, {{"operators.weights[0]", 1e-7, 1e-6}}, series(t, v));
}

TEST(Lanes, LawsThatTheDiagramWritesAndTablesHaveNumbersOfTheirOwnInEveryLane) {
  const auto d = diagram(
      {{"u", block("ramp", {{"slope", "1 1/s"}})},
       {"law",
        block("expression", {{"y", "a*sin(b*u) + max(u - c, 0)*v"}, {"a", 1}, {"b", 1}, {"c", 0.3}}, {"u", "v"})},
       {"v", block("lookup", {{"at", list({0, 0.5, 1})}, {"values", list({1, 2, 4})}}, {"u"})}},
      {"law", "v"});
  const auto p = compiled(d);
  const auto parameters = places(*p, {{"law.a", 0, 0}, {"law.b", 0, 0}, {"v.values[1]", 0, 0}});
  std::vector<double> values;
  for (int s = 0; s < Lanes::width; ++s) values.insert(values.end(), {1 + 0.1 * s, 2 - 0.01 * s, 0.05 * s});
  const auto columns = in_lanes(p, start(*p), {.until = 1, .every = 0.05}, parameters, values);
  for (std::size_t s = 0; s < columns.size(); ++s)
    for (std::size_t k = 0; k < columns[s][0].size(); ++k) {
      const double u = 0.05 * static_cast<double>(k), *n = values.data() + 3 * s;
      const double v = u < 0.5 ? 1 + 2 * u * (n[2] - 1) : n[2] + 2 * (u - 0.5) * (4 - n[2]);
      // some roundings of numbers up to 14
      EXPECT_NEAR(columns[s][1][k], v, 1e-14) << s << " " << k;
      EXPECT_NEAR(columns[s][0][k], n[0] * std::sin(n[1] * u) + std::max(u - 0.3, 0.0) * v, 5e-14) << s << " " << k;
    }
}

TEST(Lanes, AStepIntoALinearPlant) {
  expect_the_same(diagram({{"u", block("step", {{"after", "2 V"}, {"time", "10.05 ms"}})},
                           {"y", block("mass_spring_damper",
                                       {{"mass", "0.1 kg"}, {"stiffness", "1e4 N/m"}, {"damping", "5 N s/m"}}, {"f"})},
                           {"f", block("gain", {{"gain", "3 N/V"}}, {"u"})}},
                          {"y.position"}),
                  fixed(Method::rk4), {{"y.stiffness", 0.5e4, 2e4}, {"f.gain", 1, 4}});
}

TEST(Lanes, ManyOrFewSamplesGiveTheSameBits) {
  const auto p = compiled(loops());
  const auto run = start(*p);
  const auto options = fixed(Method::rk4);
  const auto parameters = places(*p, five);
  const auto values = drawn(five, Lanes::width);
  const auto all = in_lanes(p, run, options, parameters, values);
  const std::vector<double> last(values.end() - 5, values.end());
  EXPECT_EQ(in_lanes(p, run, options, parameters, last)[0], all.back());
}

TEST(Lanes, ValuesThatABlockRefusesEndTheirLaneAlone) {
  const auto p = compiled(loops());
  const std::vector<Varied> varied{{"law.alpha", 0, 0}, {"law.c", 0, 0}};
  const std::vector<double> values{1e5, 0.4, 1e5, 1.0, 2e5, 0.4};  // c = 1: nothing to pin
  std::vector<std::optional<Problem>> told;
  const auto options = fixed(Method::rk4);
  const auto columns = in_lanes(p, start(*p), options, places(*p, varied), values, &told);
  EXPECT_FALSE(told[0]);
  ASSERT_TRUE(told[1]);
  EXPECT_NE(told[1]->what.find("\"law\": with c = 1 there is no irreversible part"), std::string::npos)
      << told[1]->what;
  EXPECT_FALSE(told[2]);
  EXPECT_NE(columns[0], columns[2]);
  // asked for all the same: not a number, which the end of the run tells
  in_lanes(p, start(*p), options, places(*p, varied), values, &told, RefusedValues::are_simulated);
  EXPECT_FALSE(told[0]);
  ASSERT_TRUE(told[1]);
  EXPECT_EQ(told[1]->code, "diverged");
}

/// What is told of one sample with this value.
std::optional<Problem> told_of(const Diagram& d, const SimulateOptions& options, const std::string& path, double value,
                               RefusedValues refused = RefusedValues::end_the_run) {
  const auto p = compiled(d);
  std::vector<std::optional<Problem>> told;
  in_lanes(p, start(*p), options, places(*p, {{path, 0, 0}}), {value}, &told, refused);
  return told[0];
}

TEST(Lanes, ValuesOutsideTheirRangeOrTheDiagramsBoundsAreRefusedInAnyCase) {
  const auto sine = block("sine", {{"amplitude", "3 V"}, {"frequency", "20 Hz"}});
  auto d = diagram({{"u", sine}, {"y", block("lag", {{"times", list({0.003}, "s")}}, {"u"})}}, {"y"});
  for (const auto refused : {RefusedValues::end_the_run, RefusedValues::are_simulated}) {
    const auto wrong = told_of(d, fixed(Method::rk4), "y.times[0]", -0.003, refused);
    ASSERT_TRUE(wrong);
    EXPECT_EQ(wrong->code, "bad_value");
    EXPECT_TRUE(told_of(d, fixed(Method::rk4), "y.times[0]", 0, refused));  // must be greater
    EXPECT_FALSE(told_of(d, fixed(Method::rk4), "y.times[0]", 0.002, refused));
  }
  d = diagram({{"u", sine},
               {"y", block("prandtl_ishlinskii",
                           {{"thresholds", list({0, 1, 2}, "V")}, {"weights", list({1, 1, 1}, "um/V")}}, {"u"})}},
              {"y"});
  EXPECT_TRUE(told_of(d, fixed(Method::rk4), "y.thresholds[1]", 2.5));
  EXPECT_TRUE(told_of(d, fixed(Method::rk4), "y.thresholds[1]", 0));
  EXPECT_FALSE(told_of(d, fixed(Method::rk4), "y.thresholds[1]", 1.5));
}

TEST(Lanes, ARecordedSignalThatIsNotFiniteEndsTheRunAsItDoesAlone) {
  // x stays finite; the product of gain and drive does not.
  const auto d = diagram({{"u", block("sine", {{"amplitude", "1e200 V"}, {"frequency", "20 Hz"}})},
                          {"g", block("gain", {{"gain", 1}}, {"u"})},
                          {"x", block("lag", {{"times", list({0.003}, "s")}}, {"u"})}},
                         {"g", "x"});
  EXPECT_FALSE(told_of(d, fixed(Method::rk4), "g.gain", 2));
  const auto wrong = told_of(d, fixed(Method::rk4), "g.gain", 1e200);
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->code, "diverged");
  EXPECT_NE(wrong->what.find("\"g\""), std::string::npos) << wrong->what;
}

TEST(Lanes, OneRowAloneIsTheStart) {
  const auto p = compiled(loops());
  const auto columns = in_lanes(p, start(*p), {.until = 0.1, .every = 1, .method = Method::rk4, .step = 1e-4},
                                places(*p, five), drawn(five, 2));
  ASSERT_EQ(columns[1][0].size(), 1U);
  EXPECT_EQ(columns[1][0][0], 0);
}

TEST(Lanes, StartingAtRestOrFromAPastIsThatOfSingleRuns) {
  auto d = diagram({{"u", block("sine", {{"amplitude", "3 V"}, {"offset", "3 V"}, {"frequency", "20 Hz"}})},
                    {"operators", thesis_operators("u")},
                    {"y", block("lag", {{"times", list({0.02}, "s")}}, {"operators"})}},
                   {"y", "operators"});
  d.simulate.past["operators"] = {{0.0, "V"}, {6.0, "V"}, {2.0, "V"}};
  auto options = fixed(Method::rk4);
  options.at_rest = true;
  expect_the_same(d, options, {{"operators.weights[2]", 0, 1e-6}, {"y.times[0]", 0.01, 0.1}});
}

std::string in_the_way(const std::vector<std::pair<std::string, Node>>& blocks) {
  return why_not_in_lanes(*compiled(diagram(blocks, {blocks.back().first})));
}

TEST(Lanes, TheBlockThatStandsInTheWayIsNamed) {
  const auto sine = block("sine", {{"amplitude", "3 V"}, {"frequency", "20 Hz"}});
  const auto expect = [](const std::string& why, const std::string& part) {
    EXPECT_NE(why.find(part), std::string::npos) << why;
  };
  expect(in_the_way({{"u", sine}, {"late", block("dead_time", {{"delay", "1 ms"}}, {"u"})}}), "dead_time \"late\"");
  expect(in_the_way({{"u", sine}, {"held", block("sample_hold", {{"period", "1 ms"}}, {"u"})}}),
         "sample_hold \"held\" runs at sampling instants");
  expect(in_the_way({{"u", sine},
                     {"e", block("sum", {{"signs", "+-"}}, {"u", "back"})},
                     {"back", block("saturation", {{"lower", "-1 V"}, {"upper", "1 V"}}, {"e"})}}),
         "algebraic loop");
  expect(in_the_way({{"u", block("step", {{"after", "2 V"}, {"time", "10 ms"}})},
                     {"law", block("play", {{"radius", "1 V"}}, {"u"})}}),
         "step \"u\" jumps, and \"law\"");
  const auto p = compiled(diagram({{"u", block("triangle", {{"amplitude", "3 V"}, {"frequency", "20 Hz"}})},
                                   {"y", block("lag", {{"times", list({0.003}, "s")}}, {"u"})}},
                                  {"y"}));
  expect(why_not_in_lanes(*p, start(*p), fixed(Method::rk4), places(*p, {{"u.frequency", 0, 0}})),
         "triangle \"u\" has corners");
  EXPECT_EQ(why_not_in_lanes(*p, start(*p), fixed(Method::rk4), places(*p, {{"y.times[0]", 0, 0}})), "");
  expect(why_not_in_lanes(*p, start(*p), {}, {}), "not one of fixed steps");
  try {
    Lanes lanes(p, start(*p), {}, {});
    FAIL() << "nothing refused";
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().code, "not_in_lanes");
  }
}

TEST(Lanes, RowsInsideStepsAndHeldInputsIntoMemoryStandInTheWay) {
  const auto p = compiled(loops());
  const SimulateOptions between{.until = 0.1, .every = 1e-4, .method = Method::rk4, .step = 3e-4};
  EXPECT_NE(why_not_in_lanes(*p, start(*p), between, {}).find("rows lie inside steps"), std::string::npos);
  EXPECT_THROW(Lanes(p, start(*p), between, places(*p, five)), Error);

  const auto held = compiled(diagram({{"y", block("play", {{"radius", "1 V"}}, {"u"})}}, {"y"}, {{"u", "V"}}));
  auto run = start(*held);
  bind_input(*held, run, "u", series({0, 0.1}, {0, 3}, Between::hold));
  EXPECT_NE(why_not_in_lanes(*held, run, fixed(Method::rk4), {}).find("jumps, and \"y\""), std::string::npos);
  bind_input(*held, run, "u", series({0, 0.1}, {0, 3}, Between::linear));
  EXPECT_EQ(why_not_in_lanes(*held, run, fixed(Method::rk4), {}), "");
}

}  // namespace
}  // namespace hysteron
