// Work that is asked to stop ends at once, whatever simulates, and leaves what is used again as it was.
#include "engine/diagram/stop.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>

#include "engine/events/rest.h"
#include "engine/lanes/lanes.h"
#include "engine/rowwise/advance.h"
#include "engine/simulate/simulate.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

/// Says stop when it is asked for the so-many-th time, and counts.
struct AtTheCall {
  int call = 0;
  std::atomic<int> asked{0};
  StopScope::Asked stop() {
    return [this] { return ++asked >= call; };
  }
};

TEST(Stop, AScopeStopsWhatIsInsideItAndNothingElse) {
  EXPECT_NO_THROW(look_up());
  {
    const StopScope outer([] { return true; });
    EXPECT_TRUE(stop_asked());
    EXPECT_THROW(look_up(), Stopped);
    {
      const StopScope to_its_end(nullptr);
      EXPECT_FALSE(stop_asked());
      EXPECT_NO_THROW(look_up());
    }
    EXPECT_THROW(look_up(), Stopped);
    {
      const StopScope other([] { return false; });
      EXPECT_NO_THROW(look_up()) << "the inner scope asks in place of the outer one";
    }
    EXPECT_THROW(look_up(), Stopped);
  }
  EXPECT_NO_THROW(look_up());
}

TEST(Stop, ALoopOfShortStepsAsksNowAndThen) {
  AtTheCall third{3};
  const StopScope scope(third.stop());
  LookUp look_up;
  int steps = 0;
  EXPECT_THROW(for (; steps < 100'000; ++steps) look_up(), Stopped);
  EXPECT_LT(steps, 1000);
  EXPECT_EQ(third.asked, 3);
}

TEST(Stop, IsNotTakenForAFailure) {
  const StopScope scope([] { return true; });
  bool failed = false;
  const auto lost = [&] {
    try {
      look_up();
    } catch (const std::exception&) {
      failed = true;
    }
  };
  EXPECT_THROW(lost(), Stopped);
  EXPECT_FALSE(failed);
}

/// A run of so many steps that a test which does not end shows that nobody looks up.
struct Endless {
  std::string name;
  Diagram diagram;
  Method method = Method::automatic;
};

std::vector<Endless> endless() {
  const auto sine = block("sine", {{"amplitude", "1 V"}, {"frequency", "50 Hz"}});
  const auto relay = diagram(
      {{"wave", sine},
       {"relay", block("relay", {{"on_at", "0.2 V"}, {"off_at", "-0.2 V"}, {"on_value", "1 V"}, {"off_value", "-1 V"}},
                       {"wave"})}},
      {"relay"});
  const auto sampled =
      diagram({{"wave", sine}, {"held", block("sample_hold", {{"period", "1 ms"}}, {"wave"})}}, {"held"});
  return {{"bdf", bouc_wen_loop(), Method::bdf},
          {"adams", bouc_wen_loop(), Method::adams},
          {"runge_kutta", bouc_wen_loop(), Method::runge_kutta},
          {"rk4", bouc_wen_loop(), Method::rk4},
          {"euler", bouc_wen_loop(), Method::euler},
          {"events", relay, Method::bdf},
          {"samples", sampled, Method::bdf}};
}

TEST(Stop, EndsASimulationByEveryMethod) {
  for (const auto& run : endless()) {
    SCOPED_TRACE(run.name);
    const auto program = compiled(run.diagram);
    SimulateOptions options;
    options.until = 5e4;  // with fixed steps five thousand million, no more than a run may take
    options.instants = {0, 5e4};
    options.method = run.method;
    options.step = 1e-5;
    AtTheCall fifth{5};
    const StopScope scope(fifth.stop());
    EXPECT_THROW(simulate(*program, start(*program), options), Stopped);
    EXPECT_EQ(fifth.asked, 5);
  }
}

Diagram plays_before_a_lag(bool one_by_one) {
  std::vector<std::pair<std::string, Node>> blocks{{"core", thesis_operators("u")},
                                                   {"lag", block("lag", {{"times", list({0.01}, "s")}}, {"core"})}};
  if (one_by_one) blocks.push_back({"held", block("sample_hold", {{"period", "1 s"}}, {"u"})});
  std::vector<std::string> record{"lag"};
  if (one_by_one) record.emplace_back("held");
  return diagram(blocks, record, {{"u", "V"}});
}

TEST(Stop, EndsTheExactAdvanceWhichGoesOnAfterwardsAsIfItHadNotBegun) {
  for (const bool one_by_one : {false, true}) {
    SCOPED_TRACE(one_by_one ? "one row after the other" : "many rows at once");
    const auto program = compiled(plays_before_a_lag(one_by_one));
    const auto t = grid(0, 10, 20'000);
    std::vector<double> u;
    for (const double at : t) u.push_back(3 - 3 * std::cos(4 * at));
    auto run = start(*program);
    bind_input(*program, run, "u", series(t, u));
    Advance advance(program, program->record_signals);
    std::vector<std::vector<double>> undisturbed, after;
    advance(run, t, {}, undisturbed);
    {
      AtTheCall third{3};
      const StopScope scope(third.stop());
      EXPECT_THROW(advance(run, t, {}, after), Stopped);
    }
    advance(run, t, {}, after);
    EXPECT_EQ(after, undisturbed);
  }
}

TEST(Stop, EndsRunsInLanes) {
  const auto program = compiled(bouc_wen_loop());
  SimulateOptions options;
  options.method = Method::rk4;
  options.step = 1e-5;
  options.signals = program->record_signals;
  const std::vector<int> parameters{
      static_cast<int>(program->find_parameter("hysteresis.beta") - program->parameters.data())};
  options.until = 1;
  options.instants = {0, 1};
  Lanes lanes(program, start(*program), options, parameters, RefusedValues::end_the_run);
  AtTheCall fifth{5};
  const StopScope scope(fifth.stop());
  const std::vector<double> values{0.2e0, 0.3e0};
  EXPECT_THROW(lanes(values, [](long, double, const double*) {}), Stopped);
}

TEST(Stop, EndsTheSearchForAnEquilibrium) {
  const auto program = compiled(bouc_wen_loop());
  hysteron::Run run = start(*program);
  const StopScope scope([] { return true; });
  EXPECT_THROW(settle_at_rest(*program, run, 0), Stopped);
}

}  // namespace
}  // namespace hysteron
