// What a simulation that cannot go on, or should not begin, says: code, place and cure.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/block/block.h"
#include "engine/diagram/error.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

template <class Action>
Problem problem_of(Action action) {
  try {
    action();
  } catch (const Error& e) {
    return e.problems.front();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

bool says(const Problem& p, const std::string& text) { return p.what.find(text) != std::string::npos; }

TEST(SimulateErrors, AnUnstableLoopNamesBlockTimeAndState) {
  // x' = x^2 with x(0) = 1 1/s: infinite at t = 1 s.
  const auto program = compiled(diagram(
      {{"square", block("product", {}, {"x", "x"})}, {"x", block("integrator", {{"initial", "1 1/s"}}, {"square"})}},
      {"x"}));
  const auto p = problem_of([&] { simulate(*program, start(*program), {.until = 2}); });
  EXPECT_EQ(p.code, "diverged") << p.what;
  EXPECT_EQ(p.path, "x");
  EXPECT_TRUE(says(p, "t = 0.99") || says(p, "t = 1")) << p.what;
  EXPECT_TRUE(says(p, "x.x")) << p.what;
  EXPECT_FALSE(p.cure.empty());
}

TEST(SimulateErrors, ALinearLoopThatGrowsBeyondAllNumbersNamesItsBlock) {
  const auto program = compiled(diagram({{"rate", block("gain", {{"gain", "1e4 1/s"}}, {"x"})},
                                         {"x", block("integrator", {{"initial", "1 V"}}, {"rate"})}},
                                        {"x"}));
  const auto p = problem_of([&] { simulate(*program, start(*program), {.until = 2, .method = Method::bdf}); });
  EXPECT_EQ(p.code, "diverged") << p.what;
  EXPECT_TRUE(p.path == "rate" || p.path == "x") << p.path;
  EXPECT_TRUE(says(p, "t = 0.07")) << p.what;  // exp(1e4 t) passes 1e308 at t = 0.0709 s
  EXPECT_TRUE(says(p, "x.x")) << p.what;
}

/// The sign of its input, which no solver can hold at zero.
struct Sign {
  template <class T>
  struct Params {};
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Sign>& spec) {
    spec.name("sign_without_kink", "for this test");
    spec.input(&In<double>::u, "u", "s", "the signal");
    spec.output(&Out<double>::y, "y", "", "its sign");
  }
  template <class T>
  static Out<T> output(const Params<T>&, const In<T>& in) {
    return {in.u > T{0.0} ? T{1.0} : T{-1.0}};
  }
};

TEST(SimulateErrors, AStateThatChattersIsNamedInsteadOfTakingForEver) {
  auto all = all_blocks();
  all.add(kernel<Sign>());
  const auto program = compile(diagram({{"sign", block("sign_without_kink", {}, {"x"})},
                                        {"back", block("gain", {{"gain", -1.0}}, {"sign"})},
                                        {"x", block("integrator", {{"initial", "0.1 s"}}, {"back"})}},
                                       {"x"}),
                               all);
  const auto p = problem_of([&] { simulate(*program, start(*program), {.until = 1, .relative_tolerance = 1e-10}); });
  EXPECT_TRUE(p.code == "step_too_small" || p.code == "solver_failed") << p.code;
  EXPECT_TRUE(says(p, "t = 0.1") || says(p, "t = 0.0999")) << p.what;
  EXPECT_TRUE(says(p, "x.x")) << p.what;
  EXPECT_FALSE(p.cure.empty());
}

TEST(SimulateErrors, ALawThatEndsIsNamedByEveryMethod) {
  // The displacement of these numbers has no slope of its sign beyond |z| = 0.17: explicit steps never see it, they
  // come to rest before.
  const auto d = tools::diagram(
      {{"wish", block("sine", {{"amplitude", 0.5312}, {"frequency", "1.856 Hz"}, {"phase", "142.8 deg"}})},
       {"drive",
        block("bouc_wen_inverse", {{"alpha", 0.6545}, {"beta", 4.611}, {"gamma", -0.8659}, {"d_p", 1.116}}, {"wish"})}},
      {"drive"});
  const auto program = tools::compiled(d);
  for (const Method method : {Method::bdf, Method::adams, Method::runge_kutta}) {
    SimulateOptions options;
    options.until = 3;
    options.method = method;
    try {
      simulate(*program, start(*program), options);
      ADD_FAILURE() << method_name(method);
    } catch (const Error& error) {
      EXPECT_EQ(error.problems.front().code, "diverged") << method_name(method) << error.problems.front().what;
      EXPECT_EQ(error.problems.front().path, "drive");
    }
  }
}

TEST(SimulateErrors, AnInputThatNothingDrivesIsNamed) {
  const auto program =
      compiled(diagram({{"y", block("lag", {{"times", list({1}, "s")}}, {"u"})}}, {"y"}, {{"u", "V"}}));
  for (const auto method : {Method::automatic, Method::bdf}) {
    const auto p = problem_of([&] { simulate(*program, start(*program), {.until = 2, .method = method}); });
    EXPECT_EQ(p.code, "unbound_input");
    EXPECT_EQ(p.path, "/inputs/u");
    EXPECT_FALSE(p.cure.empty());
  }
}

TEST(SimulateErrors, OptionsThatMakeNoSenseAreRefused) {
  const auto program = compiled(play_loop());
  const auto path_of = [&](SimulateOptions options) {
    const auto p = problem_of([&] { simulate(*program, start(*program), options); });
    EXPECT_EQ(p.code, "bad_value");
    EXPECT_FALSE(p.cure.empty());
    return p.path;
  };
  EXPECT_EQ(path_of({.begin = 1, .until = 1}), "/simulate/until");
  EXPECT_EQ(path_of({.until = std::nan("")}), "/simulate/until");
  EXPECT_EQ(path_of({.until = 1, .every = -1}), "/simulate/every");
  EXPECT_EQ(path_of({.until = 1, .every = 1e-12}), "/simulate/every");
  EXPECT_EQ(path_of({.relative_tolerance = 0}), "/simulate/solver/relative_tolerance");
  EXPECT_EQ(path_of({.absolute_tolerance = -1}), "/simulate/solver/absolute_tolerance");
  EXPECT_EQ(path_of({.max_step = -1}), "/simulate/solver/max_step");
  EXPECT_EQ(path_of({.instants = {0.1, 0.1}}), "/simulate/instants");
  EXPECT_EQ(path_of({.begin = 0, .instants = {-0.1, 0.1}}), "/simulate/instants");
}

TEST(SimulateErrors, TheExactMethodRefusesWhatMovesBetweenRows) {
  const auto program = compiled(diagram({{"u", block("sine", {{"amplitude", "1 V"}, {"frequency", "3 Hz"}})},
                                         {"y", block("lag", {{"times", list({1}, "s")}}, {"u"})}},
                                        {"y"}));
  const auto p = problem_of([&] { simulate(*program, start(*program), {.method = Method::exact}); });
  EXPECT_EQ(p.code, "not_exact");
  EXPECT_EQ(p.path, "u");
  EXPECT_FALSE(p.cure.empty());
}

TEST(SimulateOptionsOfADiagram, AreReadInTheirUnits) {
  auto d = play_loop();
  d.simulate.until = Number{250, "ms"};
  d.simulate.every = Number{0.1, {}};
  d.simulate.method = "adams";
  d.simulate.relative_tolerance = 1e-7;
  const auto options = simulate_options(*compiled(d), {.absolute_tolerance = 0.5});
  EXPECT_DOUBLE_EQ(options.until, 0.25);
  EXPECT_DOUBLE_EQ(options.every, 0.1);
  EXPECT_EQ(options.method, Method::adams);
  EXPECT_EQ(options.relative_tolerance, 1e-7);
  EXPECT_EQ(options.absolute_tolerance, 0.5);  // not said: as in the defaults
}

TEST(SimulateOptionsOfADiagram, AWrongUnitAndAnUnknownMethodAreNamed) {
  auto d = play_loop();
  d.simulate.until = Number{250, "V"};
  d.simulate.method = "bfd";
  try {
    simulate_options(*compiled(d));
    FAIL();
  } catch (const Error& e) {
    ASSERT_EQ(e.problems.size(), 2U);
    EXPECT_EQ(e.problems[0].code, "wrong_unit");
    EXPECT_EQ(e.problems[0].path, "/simulate/until");
    EXPECT_EQ(e.problems[1].code, "bad_value");
    EXPECT_NE(e.problems[1].cure.find("bdf"), std::string::npos);
  }
}

/// A source whose next corner stays behind.
struct Stuck {
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Stuck>& spec) {
    spec.name("test_stuck", "names one corner for ever");
    spec.output(&Out<double>::y, "y", "", "");
  }
  template <class T>
  static Out<T> output(const Nothing&, const Time<T>& time) {
    return {time.t};
  }
  static double next_breakpoint(const Nothing&, double) { return 0.25; }
};

TEST(SimulateErrors, ASourceWhoseNextCornerIsNotAheadIsNamedInsteadOfAskedForEver) {
  auto blocks = all_blocks();
  blocks.add(kernel<Stuck>());
  const auto p = compile(diagram({{"u", block("test_stuck", {})}}, {"u"}), blocks);
  try {
    simulate(*p, start(*p), {.until = 1, .every = 0.1, .method = Method::rk4, .step = 0.01});
    FAIL() << "it came to an end";
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().path, "u");
    EXPECT_NE(e.problems.front().what.find("next corner"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace hysteron
