// A state machine: what its texts say, when it changes its state, what it refuses.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/diagram/error.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using tools::block;

Traces machine_run(const Diagram& d, double until, Method method = Method::automatic) {
  const auto program = tools::compiled(d);
  SimulateOptions options;
  options.until = until;
  options.method = method;
  return simulate(*program, start(*program), options);
}
Diagram machine(const tools::Parameters& parameters, const std::vector<std::string>& record = {"m.state"}) {
  return tools::diagram({{"u", block("sine", {{"amplitude", "1 V"}, {"frequency", "1 Hz"}})},
                         {"m", block("state_machine", parameters, {"u"})}},
                        record);
}
std::string machine_problem(const tools::Parameters& parameters) {
  try {
    tools::compiled(machine(parameters));
  } catch (const Error& e) {
    std::string all;
    for (const auto& p : e.problems) all += p.path + ": " + p.what + "\n";
    return all;
  }
  return "none";
}

TEST(StateMachine, GoesWhereItsConditionsLead) {
  // up at sin = 0.5 (t = 1/12), back 0.2 s later, wait until the sine is negative (t = 0.5), and again
  const tools::Parameters p{{"states", "low, high, wait"},
                            {"transitions", "low -> high: u > level; high -> wait: time >= hold; wait -> low: u < 0"},
                            {"level", "0.5 V"},
                            {"hold", "0.2 s"},
                            {"outputs", "v"},
                            {"v", tools::list({0, 1, 0}, "m/s")}};
  auto d = machine(p, {"x", "m.state"});
  d.blocks["x"] = block("integrator", {}, {"m.v"});
  for (const Method method : {Method::bdf, Method::adams, Method::runge_kutta}) {
    const auto traces = machine_run(d, 3.2, method);
    // three whole pulses of 0.2 s, and from 3 + 1/12 on the fourth
    EXPECT_NEAR(tools::trace(traces, 0).back(), 0.6 + 0.2 - 1.0 / 12, 1e-6) << method_name(method);
    EXPECT_EQ(tools::trace(traces, 1).back(), 1);
  }
  EXPECT_EQ(tools::trace(machine_run(d, 0.4), 1).back(), 2);
  EXPECT_EQ(tools::trace(machine_run(d, 0.6), 1).back(), 0);
}

TEST(StateMachine, TakesTheFirstConditionThatHoldsAndPassesThroughStates) {
  EXPECT_EQ(tools::trace(
                machine_run(
                    machine({{"states", "a, b, c, d"},
                             {"transitions", "a -> b: time >= t; a -> c: time >= t; b -> d: 1 > 0; c -> a: u < -2*u0"},
                             {"t", "0.1 s"},
                             {"u0", "1 V"}}),
                    0.2))
                .back(),
            3);
  EXPECT_EQ(tools::trace(machine_run(machine({{"states", "a, b, stop"},
                                              {"transitions", "* -> stop: u > 0.9*one; a -> b: time > t"},
                                              {"t", "0.01 s"},
                                              {"one", "1 V"}}),
                                     1))
                .back(),
            2);
}

TEST(StateMachine, SaysWhatItRefusesAndWhere) {
  EXPECT_EQ(machine_problem({{"states", "a, b"}, {"transitions", "a -> b: u > 0; b -> c: u < 0"}}),
            "/blocks/m/transitions: \"transitions\": there is no state \"c\" at character 21\n");
  EXPECT_NE(
      machine_problem({{"states", "a, b"}, {"transitions", "a -> b: u >"}}).find("ends too early at character 12"),
      std::string::npos);
  EXPECT_NE(machine_problem({{"states", "a, b"}, {"transitions", "a: u > 0"}})
                .find("a transition has no arrow at character 1"),
            std::string::npos);
  EXPECT_NE(machine_problem({{"states", "a, b"}, {"transitions", "a -> b u > 0"}})
                .find("a transition has no condition at character 1"),
            std::string::npos);
  EXPECT_NE(machine_problem({{"states", "a, b"}, {"transitions", "a -> a: u > 0"}})
                .find("a transition leads nowhere at character 1"),
            std::string::npos);
  EXPECT_NE(
      machine_problem({{"states", "a, a"}, {"transitions", "a -> b: u > 0"}}).find("\"a\" stands twice at character 4"),
      std::string::npos);
  EXPECT_NE(machine_problem({{"states", ""}, {"transitions", ""}}).find("there is no state"), std::string::npos);
  EXPECT_NE(machine_problem({{"states", "a, b"}, {"transitions", "a -> b: u > l; b -> a: u < 0"}, {"l", "1 m"}})
                .find("cannot compare m and V at character 11"),
            std::string::npos);
  EXPECT_NE(machine_problem(
                {{"states", "a, b"}, {"transitions", "a -> b: u > 0"}, {"outputs", "v"}, {"v", tools::list({1, 2, 3})}})
                .find("\"v\" has 3 values for 2 states"),
            std::string::npos);
  EXPECT_NE(machine_problem({{"states", "a, b"}, {"transitions", "a -> b: u > 0"}, {"outputs", "v"}})
                .find("needs a parameter \"v\""),
            std::string::npos);
  EXPECT_NE(
      machine_problem({{"states", "a, b"}, {"transitions", "a -> b: u > 0"}, {"w", 2}}).find("has no parameter \"w\""),
      std::string::npos);
}

}  // namespace
}  // namespace hysteron
