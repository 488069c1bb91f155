// Many runs of one program side by side: the same numbers as one by one, to the last bit.
#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <ostream>
#include <random>
#include <thread>

#include "engine/rowwise/advance.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

/// One way of simulating that must not share anything between runs.
struct ThreadsCase {
  std::string name;
  Diagram diagram;
  std::string parameter;  ///< differs from run to run, by factors around one
  SimulateOptions options;
  bool driven = false;  ///< by a recording, its own in each run
};

void PrintTo(const ThreadsCase& c, std::ostream* out) { *out << c.name; }

ThreadsCase sampled_control() {
  auto d = bouc_wen_loop();
  d.blocks["controller"] = block(
      "sampled_pid",
      {{"kp", "0.5265 V/um"}, {"ki", "1521 V/(um s)"}, {"lower", "-20 V"}, {"upper", "20 V"}, {"period", "0.5 ms"}},
      {"error"});
  return {"SampledControl", d, "controller.kp", {.until = 0.1, .method = Method::runge_kutta}};
}

ThreadsCase loop_through_plays() {
  return {"LoopThroughPlays",
          diagram({{"lack", block("sum", {{"signs", "+-"}}, {"u", "curved"})},
                   {"command", block("gain", {{"gain", 1.3}}, {"lack"})},
                   {"curved",
                    block("prandtl_ishlinskii",
                          {{"thresholds", list({0.1, 0.5, 1}, "V")}, {"weights", list({0.3, 0.2, 0.4})}}, {"command"})},
                   {"y", block("lag", {{"times", list({0.02}, "s")}}, {"command"})}},
                  {"y", "command"}, {{"u", "V"}}),
          "command.gain",
          {.until = 1, .method = Method::bdf},
          true};
}

ThreadsCase events() {
  return {
      "Events",
      diagram({{"force", block("sine", {{"amplitude", "4 N"}, {"frequency", "3 Hz"}})},
               {"mass", block("mass_with_friction",
                              {{"mass", "0.2 kg"}, {"stiffness", "50 N/m"}, {"coulomb", "1 N"}, {"breakaway", "1.5 N"}},
                              {"force"})},
               {"switch",
                block("relay", {{"on_at", "1 cm"}, {"off_at", "-1 cm"}, {"on_value", "1 V"}, {"off_value", "-1 V"}},
                      {"mass.position"})},
               {"y", block("lag", {{"times", list({0.02}, "s")}}, {"switch"})}},
              {"mass.position", "y"}),
      "mass.coulomb",
      {.until = 2, .method = Method::bdf}};
}

ThreadsCase jumps() {
  return {"Jumps",
          diagram({{"u", block("staircase", {{"levels", list({0, 3, 1, 5, 0}, "V")}, {"duration", "0.1 s"}})},
                   {"y", thesis_bouc_wen("u")},
                   {"late", block("dead_time", {{"delay", "7 ms"}}, {"y"})},
                   {"end", block("lag", {{"times", list({0.01}, "s")}}, {"late"})}},
                  {"y", "end"}),
          "y.alpha",
          {.until = 0.5, .method = Method::adams}};
}

ThreadsCase exact() {
  return {"ExactAdvance",
          diagram({{"y", thesis_operators("u")},
                   {"creeping", block("creep", {{"amounts", list({0.1})}, {"times", list({0.3}, "s")}}, {"y"})},
                   {"stage", thesis_plant("creeping")}},
                  {"stage"}, {{"u", "V"}}),
          "y.weights[2]",
          {.until = 1, .method = Method::exact},
          true};
}

ThreadsCase slopes() {
  auto d = play_loop();
  return {"Slopes", d, "amplifier.gain", {.until = 0.2, .method = Method::bdf, .slopes_for = {0, 1}}};
}

ThreadsCase fixed_steps() {
  return {"FixedSteps", bouc_wen_loop(), "controller.ki", {.until = 0.1, .method = Method::rk4, .step = 2e-5}};
}

class Threads : public testing::TestWithParam<ThreadsCase> {
 protected:
  static constexpr int runs = 32;

  static std::vector<hysteron::Run> runs_of(const Program& program, const ThreadsCase& c) {
    std::vector<hysteron::Run> list;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> factor(0.8, 1.2);
    for (int i = 0; i < runs; ++i) {
      auto run = start(program);
      const ParameterInfo* info = program.find_parameter(c.parameter);
      if (info == nullptr) throw std::logic_error("no parameter " + c.parameter);
      set_parameter(program, run, *info, info->value * factor(random));
      reset(program, run);
      if (c.driven) {
        std::vector<double> t, v;
        for (int k = 0; k <= 200; ++k) {
          t.push_back(0.005 * k);
          v.push_back(3 * std::sin(0.1 * k) * factor(random));
        }
        bind_input(program, run, "u", series(t, v));
      }
      list.push_back(std::move(run));
    }
    return list;
  }

  static bool same_bits(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
      if (a[i].size() != b[i].size() || std::memcmp(a[i].data(), b[i].data(), a[i].size() * sizeof(double)) != 0)
        return false;
    return true;
  }
};

TEST_P(Threads, GiveTheBitsOfRunsOneByOne) {
  const ThreadsCase& c = GetParam();
  const auto program = compiled(c.diagram);
  const auto list = runs_of(*program, c);
  std::vector<Traces> serial;
  for (const auto& run : list) serial.push_back(simulate(*program, run, c.options));
  EXPECT_FALSE(same_bits(serial[0].values, serial[1].values)) << "the runs do not differ";
  for (const int threads : {2, 3, 4}) {
    std::vector<Traces> parallel(list.size());
    std::atomic<int> next{0};
    {
      std::vector<std::jthread> workers;
      for (int w = 0; w < threads; ++w)
        workers.emplace_back([&] {
          for (int i = next++; i < runs; i = next++)
            parallel[static_cast<std::size_t>(i)] = simulate(*program, list[static_cast<std::size_t>(i)], c.options);
        });
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      EXPECT_TRUE(same_bits(parallel[i].values, serial[i].values)) << "run " << i << " with " << threads << " threads";
      ASSERT_EQ(parallel[i].slopes.size(), serial[i].slopes.size());
      for (std::size_t k = 0; k < serial[i].slopes.size(); ++k)
        EXPECT_TRUE(same_bits(parallel[i].slopes[k], serial[i].slopes[k])) << "run " << i;
      EXPECT_EQ(parallel[i].statistics.steps, serial[i].statistics.steps);
      EXPECT_EQ(parallel[i].statistics.evaluations, serial[i].statistics.evaluations);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, Threads,
                         testing::Values(sampled_control(), loop_through_plays(), events(), jumps(), exact(), slopes(),
                                         fixed_steps()),
                         [](const auto& tested) { return tested.param.name; });

TEST(ThreadsCompile, ProgramsCanBeMadeSideBySide) {
  // Units, registry and compilation hold no state that threads could disturb.
  std::vector<ProgramPointer> made(8);
  made[0] =
      compiled(bouc_wen_loop());  // what is made once in a process is there: tools that watch threads do not see how
  {
    std::vector<std::jthread> workers;
    for (auto& program : made) workers.emplace_back([&program] { program = compiled(bouc_wen_loop()); });
  }
  const auto reference = simulate(*made[0], start(*made[0]), {.until = 0.01});
  for (const auto& program : made)
    EXPECT_EQ(simulate(*program, start(*program), {.until = 0.01}).values, reference.values);
}

}  // namespace
}  // namespace hysteron
