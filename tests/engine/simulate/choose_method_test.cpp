// Which integrator "auto" takes, and that the results do not depend on it.
#include "engine/simulate/choose_method.h"

#include <gtest/gtest.h>

#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

/// A digital controller around a plant of two nearly equal poles, which bends the drive of its hysteresis a little: a
/// continuous loop through what is not linear, which no exact advance knows.
Diagram loop_with(const std::string& period, double milliseconds) {
  return diagram(
      {{"reference", block("sine", {{"amplitude", "1 V"}, {"frequency", "5 Hz"}})},
       {"error", block("sum", {{"signs", "+-"}}, {"reference", "plant"})},
       {"controller",
        block("sampled_pid",
              {{"kp", 0.2}, {"ki", "50 1/s"}, {"lower", "-inf V"}, {"upper", "inf V"}, {"period", period}}, {"error"})},
       {"drive", block("sum", {{"signs", "+-"}}, {"controller", "bent"})},
       {"bent", block("gain", {{"gain", 0.01}}, {"plant"})},
       {"hysteresis", block("prandtl_ishlinskii",
                            {{"thresholds", list({0, 0.1, 0.3}, "V")}, {"weights", list({1, 0.2, 0.1})}}, {"drive"})},
       {"plant", block("lag", {{"times", list({milliseconds, milliseconds}, "ms")}}, {"hysteresis"})}},
      {"plant"});
}

MethodChoice choice_for(const Diagram& d, double span = 1) {
  const auto p = compiled(d);
  return choose_method(*p, start(*p), 0, span);
}

TEST(ChooseMethod, FrequentJumpsIntoWhatIsNotStiffTakeRungeKutta) {
  const auto choice = choice_for(loop_with("0.1 ms", 1));
  EXPECT_EQ(choice.method, Method::runge_kutta);
  EXPECT_TRUE(
      choice.why.starts_with("\"controller\" jumps every 100 us, and the fastest time constant at the start is 99"))
      << choice.why;  // of poles (-1 +- 0.1 i)/ms
  EXPECT_TRUE(choice.why.ends_with(": restarts are frequent and nothing is stiff")) << choice.why;
}

TEST(ChooseMethod, AStiffDiagramTakesBackwardDifferences) {
  // 1 us against 0.1 ms between jumps: an explicit formula is stable up to 3.3 us.
  const auto choice = choice_for(loop_with("0.1 ms", 1e-3));
  EXPECT_EQ(choice.method, Method::bdf);
  EXPECT_NE(choice.why.find("stiff"), std::string::npos) << choice.why;
}

TEST(ChooseMethod, AFewJumpsChangeNothing) {
  EXPECT_EQ(choice_for(loop_with("0.1 s", 10)).method, Method::bdf);              // ten jumps
  EXPECT_EQ(choice_for(loop_with("0.1 s", 10), 10).method, Method::runge_kutta);  // a hundred
}

TEST(ChooseMethod, AHeldRecordingJumpsTooALinearOneDoesNot) {
  const auto p =
      compiled(diagram({{"y", block("mass_on_stiffening_spring",
                                    {{"mass", "1 kg"}, {"stiffness", "100 N/m"}, {"stiffening", "1 N/m^3"}}, {"f"})}},
                       {"y.position"}, {{"f", "N"}}));
  std::vector<double> v;
  const auto t = grid(0, 1, 1000);
  for (const double at : t) v.push_back(std::sin(20 * at));
  for (const Between between : {Between::hold, Between::linear}) {
    auto run = start(*p);
    bind_input(*p, run, "f", series(t, v, between));
    const auto choice = choose_method(*p, run, 0, 1);
    EXPECT_EQ(choice.method, between == Between::hold ? Method::runge_kutta : Method::bdf) << choice.why;
  }
  EXPECT_EQ(choose_method(*p, start(*p), 0, 1).method, Method::bdf);  // unbound
}

TEST(ChooseMethod, JumpsThatOnlySampledBlocksReadDoNotCount) {
  auto d = diagram({{"u", block("sine", {{"amplitude", "1 V"}, {"frequency", "5 Hz"}})},
                    {"y", block("rate_limiter", {{"rise", "5 V/s"}, {"fall", "5 V/s"}, {"time", "1 ms"}}, {"u"})},
                    {"held", block("sample_hold", {{"period", "0.1 ms"}}, {"y"})},
                    {"late", block("delay_line", {{"period", "0.1 ms"}, {"samples", 1.0}}, {"held"})}},
                   {"late"});
  EXPECT_EQ(choice_for(d).method, Method::bdf);
  EXPECT_EQ(choice_for(d).why, "few discontinuities reach the states");
}

TEST(ChooseMethod, AutoSaysWhatItTookAndGivesTheSameTraces) {
  const auto p = compiled(loop_with("1 ms", 5));
  const auto automatic = simulate(*p, start(*p), {.until = 0.4, .every = 1e-3});
  EXPECT_EQ(automatic.statistics.method, "runge_kutta");
  EXPECT_NE(automatic.statistics.why.find("controller"), std::string::npos);
  const auto bdf = simulate(*p, start(*p), {.until = 0.4, .every = 1e-3, .method = Method::bdf});
  EXPECT_EQ(bdf.statistics.why, "");
  // Both hold the default tolerance of 1e-6, errors within ten times.
  EXPECT_LT(distance(trace(automatic), trace(bdf)), 1e-5 * largest(trace(bdf)));
}

}  // namespace
}  // namespace hysteron
