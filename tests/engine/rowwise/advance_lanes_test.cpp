// Several runs side by side: the same numbers as one after the other, to the last bit.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/rowwise/advance.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;
using Values = std::vector<std::vector<double>>;

SeriesPointer wave(double frequency, Between between = Between::linear) {
  const auto t = grid(0, 0.7, 700);
  std::vector<double> v;
  for (const double s : t) v.push_back(3 - 3 * std::cos(2 * M_PI * frequency * s));
  return series(t, v, between);
}

/// Every kind of block: fixed and sized ones, memory, states linear and not, a dead time, a loop with an operator in
/// it, a function of time on top.
ProgramPointer everything() {
  return compiled(diagram(
      {{"law", thesis_bouc_wen("u")},
       {"core", thesis_operators("u")},
       {"both", block("sum", {}, {"law", "core"})},
       {"x", block("lag", {{"times", list({0.01, 0.003}, "s")}}, {"both"})},
       {"w", block("play", {{"radius", "0.2 um"}}, {"x"})},
       {"late", block("dead_time", {{"delay", "2.3 ms"}}, {"w"})},
       {"e", block("sum", {{"signs", "+-"}}, {"u", "y"})},
       {"limited", block("saturation", {{"lower", "-1 V"}, {"upper", "2 V"}}, {"e"})},
       {"speed", block("gain", {{"gain", "40 1/s"}}, {"limited"})},
       {"y", block("integrator", {}, {"speed"})},
       {"product", block("product", {}, {"w", "u"})},
       {"hum", block("mains_interference",
                     {{"frequency", "50 Hz"}, {"cosine", list({0.1, 0.02}, "um")}, {"sine", list({-0.3, 0.05}, "um")}},
                     {"w"})},
       {"loud", block("gain", {{"gain", 10}}, {"hum"})}},
      {"law", "core", "x", "w", "late", "y", "product", "hum", "loud", "u"}, {{"u", "V"}}));
}

hysteron::Run run_number(const Program& program, int i, const SeriesPointer& u) {
  auto run = start(program);
  bind_input(program, run, "u", u);
  set_parameter(program, run, "law.beta", 0.2418 * (1 + 0.01 * i));
  set_parameter(program, run, "law.alpha", 0.6187e-6 * (1 - 0.02 * i));
  set_parameter(program, run, "x.times[0]", 0.01 + 0.001 * i);
  set_parameter(program, run, "core.weights[4]", 1e-8 * i);
  set_parameter(program, run, "w.radius", 1e-7 * (1 + 0.1 * i));
  set_parameter(program, run, "late.delay", 0.0023 + 1e-4 * i);
  set_parameter(program, run, "limited.upper", 2 - 0.1 * i);
  set_parameter(program, run, "hum.frequency", 50 + 0.1 * i);
  run.x[0] += 1e-8 * i;
  return run;
}

/// Errors, values of all runs at once, and that they are those of each run alone.
std::vector<std::string> compare(const ProgramPointer& program, const std::vector<hysteron::Run>& runs,
                                 const AdvanceOptions& options, const std::string& what) {
  std::vector<const hysteron::Run*> list;
  for (const auto& run : runs) list.push_back(&run);
  const auto instants = std::make_shared<const std::vector<double>>(grid(0, 0.69, 651));
  Advance advance(program, program->record_signals);
  std::vector<Values> together;
  auto errors = advance.each(list, instants, options, together);
  EXPECT_EQ(errors.size(), runs.size());
  EXPECT_EQ(together.size(), runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Values alone;
    try {
      Advance(program, program->record_signals)(runs[i], instants, options, alone);
      EXPECT_EQ(errors[i], "") << what;
      EXPECT_EQ(together[i], alone) << what << " run " << i;
    } catch (const Error& error) {
      EXPECT_EQ(errors[i], error.what()) << what << " run " << i;
    }
  }
  return errors;
}

TEST(AdvanceLanes, ManyRunsAreEachTheSameAsAlone) {
  const auto program = everything();
  ASSERT_EQ(why_not_exact(*program), "");
  const auto u = wave(5);
  for (const std::size_t n : {1, 2, 3, 4, 5, 7, 9}) {
    std::vector<hysteron::Run> runs;
    for (std::size_t i = 0; i < n; ++i) runs.push_back(run_number(*program, static_cast<int>(i), u));
    for (const int substeps : {1, 2})
      for (const bool at_rest : {true, false})
        compare(program, runs, {.substeps = substeps, .at_rest = at_rest}, std::to_string(n));
  }
}

TEST(AdvanceLanes, LinearPartsOfEverySizeAreTheSameAsAlone) {
  // Two lists of amounts, some of them zero in some runs: states that no output sees there, and sizes that differ.
  for (const std::size_t n : {1, 2, 3, 5, 6, 8, 9, 10, 12, 13, 15}) {
    std::vector<double> amounts, times;
    for (std::size_t i = 0; i < n; ++i) {
      amounts.push_back(0.01 * (1 + static_cast<double>(i)));
      times.push_back(0.003 * std::pow(1.7, static_cast<double>(i)));
    }
    const auto program = compiled(
        diagram({{"creep", block("creep", {{"amounts", list(amounts, "")}, {"times", list(times, "s")}}, {"u"})},
                 {"x", block("lag", {{"times", list({0.01, 0.003}, "s")}}, {"creep"})}},
                {"creep", "x"}, {{"u", "V"}}));
    std::vector<hysteron::Run> runs;
    const auto u = wave(5);
    for (int i = 0; i < 7; ++i) {
      runs.push_back(start(*program));
      bind_input(*program, runs.back(), "u", u);
      for (std::size_t k = 0; k < n; ++k)
        if ((static_cast<int>(k) + i) % 3 != 0 || i == 6)
          set_parameter(*program, runs.back(), "creep.amounts[" + std::to_string(k) + "]", i == 6 ? 0 : 0.01 * i);
    }
    compare(program, runs, {}, std::to_string(n));
  }
}

TEST(AdvanceLanes, HeldInputsJumpInEachOfThem) {
  const auto program = compiled(diagram({{"law", thesis_bouc_wen("u")},
                                         {"x", block("lag", {{"times", list({0.01}, "s")}}, {"law"})},
                                         {"w", block("play", {{"radius", "0.1 um"}}, {"x"})}},
                                        {"law", "x", "w"}, {{"u", "V"}}));
  std::vector<hysteron::Run> runs;
  const auto u = wave(5, Between::hold);
  for (int i = 0; i < 4; ++i) {
    runs.push_back(start(*program));
    bind_input(*program, runs.back(), "u", u);
    set_parameter(*program, runs.back(), "law.beta", 0.2 + 0.01 * i);
  }
  compare(program, runs, {}, "held");
}

TEST(AdvanceLanes, OneThatFailsLeavesTheOthersAlone) {
  const auto program = compiled(diagram({{"e", block("sum", {}, {"u", "x"})},
                                         {"g", block("gain", {{"gain", 0.5}}, {"e"})},
                                         {"x", block("lag", {{"times", list({0.01}, "s")}}, {"g"})}},
                                        {"x"}, {{"u", "V"}}));
  std::vector<hysteron::Run> runs;
  const auto u = wave(5);
  for (const double gain : {0.5, 40.0, 0.3, 0.2, 0.1}) {
    runs.push_back(start(*program));
    bind_input(*program, runs.back(), "u", u);
    set_parameter(*program, runs.back(), "g.gain", gain);
  }
  const auto errors = compare(program, runs, {.at_rest = false}, "unstable");
  for (std::size_t i = 0; i < errors.size(); ++i) EXPECT_EQ(errors[i].empty(), i != 1) << errors[i];
  EXPECT_NE(errors[1].find("\"x\" is not finite"), std::string::npos) << errors[1];
}

TEST(AdvanceLanes, RunsOfDifferentRecordingsGoOneByOne) {
  const auto program = everything();
  const auto u = wave(5), other = wave(8);
  compare(program,
          {run_number(*program, 0, u), run_number(*program, 1, other), run_number(*program, 2, u),
           run_number(*program, 3, u)},
          {}, "two recordings");
  auto unbound = start(*program);
  std::vector<Values> values;
  const hysteron::Run* const list[] = {&unbound};
  const auto errors = Advance(program, program->record_signals)
                          .each(list, std::make_shared<const std::vector<double>>(grid(0, 1, 3)), {}, values);
  EXPECT_NE(errors[0].find("bound to no recording"), std::string::npos) << errors[0];
}

}  // namespace
}  // namespace hysteron
