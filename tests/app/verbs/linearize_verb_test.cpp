// What the verb linearize says of loops: of unstable ones, of cut ones, of sampled ones.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/hysteron_process.h"

namespace hysteron {
namespace {

using nlohmann::json;
using process::Outcome;

class LinearizeVerb : public testing::Test {
 protected:
  Outcome run(std::vector<std::string> words) const {
    words.insert(words.begin(), "linearize");
    words.insert(words.end(), {"-o", "out"});
    const Outcome outcome = process::hysteron(folder_.path(), words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome;
  }
  json facts() const { return json::parse(folder_.read("out/result.json")).at("facts"); }
  static bool says(const Outcome& outcome, const std::string& text) {
    return outcome.out.find(text) != std::string::npos;
  }
  static std::string first_line(const Outcome& outcome) { return outcome.out.substr(0, outcome.out.find('\n')); }
  const process::Folder folder_;
};

/// y = G e (and a dead time), e = r - y.
std::string loop_of(const std::string& num, const std::string& den, const std::string& delay) {
  const std::string last = delay.empty() ? R"("y": {"type": "pass", "in": "p"})"
                                         : R"("y": {"type": "dead_time", "delay": ")" + delay + R"(", "in": "p"})";
  return R"({"format": 1, "title": "loop", "blocks": {
    "r": {"type": "step", "after": 1},
    "e": {"type": "sum", "in": ["r", "y"], "signs": "+-"},
    "p": {"type": "transfer_function", "num": )" +
         num + R"(, "den": )" + den + R"(, "in": "e"}, )" + last + R"(}, "record": ["y"]})";
}

void expect_nothing_of_a_stable_loop(const Outcome& outcome, const json& facts) {
  for (const char* word : {"would take it away", "Bandwidth", "-3 dB"})
    EXPECT_EQ(outcome.out.find(word), std::string::npos) << word << " in " << outcome.out;
  EXPECT_FALSE(facts.contains("bandwidth_hz"));
  EXPECT_FALSE(facts.contains("closed_loop"));
  EXPECT_FALSE(facts.at("margins").contains("delay_margin_s"));
}

TEST_F(LinearizeVerb, AnUnstableLoopIsCalledSoInTheFirstLine) {
  // 50/(5 s^3 + 10.25 s^2 + 6.25 s + 1): Routh, 10.25 * 6.25 = 64 < 5 * 51.
  folder_.write("d.json", loop_of("[50]", "[5, 10.25, 6.25, 1]", ""));
  const Outcome outcome = run({"d.json", "--from", "e", "--to", "y", "--open", "e"});
  EXPECT_NE(first_line(outcome).find("the closed loop is unstable (2 poles in the right half plane)"),
            std::string::npos)
      << outcome.out;
  EXPECT_TRUE(says(outcome, "Phase margin -35.06 deg at 0.3219 Hz")) << outcome.out;
  EXPECT_TRUE(says(outcome, "Gain margin 0.2363")) << outcome.out;
  EXPECT_TRUE(says(outcome, "Poles: -0.25")) << outcome.out;
  expect_nothing_of_a_stable_loop(outcome, facts());
  EXPECT_EQ(facts().at("stability_closed").at("unstable_poles"), 2);
}

TEST_F(LinearizeVerb, AnUnstableLoopWithADeadTimeIsCalledSoThoughItsLastMarginsLookFine) {
  // 0.9 exp(-1.6 s), a lag of 0.4 s, a mode at 1.6 rad/s with damping 0.01: two poles on the right.
  folder_.write("d.json", loop_of("[2.304]", "[0.4, 1.0128, 1.056, 2.56]", "1.6 s"));
  const Outcome outcome = run({"d.json", "--from", "e", "--to", "y", "--open", "e"});
  EXPECT_NE(first_line(outcome).find("the closed loop is unstable (2 poles in the right half plane)"),
            std::string::npos)
      << outcome.out;
  expect_nothing_of_a_stable_loop(outcome, facts());
  EXPECT_LT(facts().at("margins").at("gain_margin").get<double>(), 1);
  const Outcome closed = run({"d.json", "--from", "r", "--to", "y"});
  EXPECT_NE(first_line(closed).find("unstable (2 poles in the right half plane)"), std::string::npos) << closed.out;
  EXPECT_FALSE(facts().contains("bandwidth_hz"));
}

TEST_F(LinearizeVerb, AnUnstablePlantThatIsHeldHasALowerLimitOfItsGain) {
  // 4/((s - 1)(s/10 + 1)): stable for gains from 1/4 of it, and any above.
  folder_.write("d.json", loop_of("[40]", "[1, 9, -10]", ""));
  const Outcome outcome = run({"d.json", "--from", "e", "--to", "y", "--open", "e"});
  EXPECT_EQ(outcome.out.find("the closed loop is unstable"), std::string::npos) << outcome.out;
  EXPECT_TRUE(says(outcome, "The loop as opened is unstable (1 pole in the right half plane)")) << outcome.out;
  EXPECT_NEAR(facts().at("margins").at("gain_from").get<double>(), 0.25, 1e-9);
  EXPECT_FALSE(facts().at("margins").contains("gain_to"));
  EXPECT_TRUE(facts().at("margins").contains("delay_margin_s"));
}

const char pi_on_bouc_wen[] = R"({"format": 1, "title": "pi", "blocks": {
 "reference": {"type": "sine", "amplitude": 1, "frequency": "5 Hz"},
 "error": {"type": "sum", "signs": "+-", "in": ["reference", "plant"]},
 "c": {"type": "pi_controller", "kp": 2, "ki": "10 1/s", "in": "error"},
 "plant": {"type": "lag", "times": ["0.1 s"], "in": "h"},
 "h": {"type": "bouc_wen", "alpha": 0.3, "beta": 0.2, "gamma": 0.02, "d_p": 1.6, "in": "c"}},
 "outputs": {"y": "plant"}, "simulate": {"until": "3 s", "every": "10 ms"}})";

TEST_F(LinearizeVerb, TheReferenceAndTheErrorHaveOneTransferFunction) {
  folder_.write("loop.json", pi_on_bouc_wen);
  std::vector<double> gains;
  for (const char* from : {"reference", "error"}) {
    run({"loop.json", "--from", from, "--to", "plant", "--at", "0.12 s"});
    gains.push_back(facts().at("gain_at_low_frequencies").get<double>());
  }
  EXPECT_NEAR(gains[0], 1, 1e-6) << "the integrator sees to that";
  EXPECT_NEAR(gains[1], gains[0], 1e-9);
}

TEST_F(LinearizeVerb, APlayInItsGapIsNamedAndTakenAboutAnAmplitudeOnRequest) {
  folder_.write("d.json", R"({"format": 1, "title": "play", "inputs": {"r": {"unit": "um"}}, "blocks": {
    "e": {"type": "sum", "in": ["r", "y"], "signs": "+-"},
    "gap": {"type": "play", "radius": "1 um", "in": "e"},
    "y": {"type": "lag", "times": ["10 ms"], "in": "gap"}}, "outputs": {"y": "y"}})");
  const Outcome cut = run({"d.json"});
  EXPECT_TRUE(says(cut, "play \"gap\" passes no small motion on")) << cut.out;
  EXPECT_EQ(cut.out.rfind("r does not move y at this operating point", 0), 0U) << cut.out;
  EXPECT_EQ(facts().at("cut_by"), json::array({"gap"}));
  const Outcome about = run({"d.json", "--amplitude", "gap=1 mm"});
  EXPECT_FALSE(says(about, "passes no small motion")) << about.out;
  EXPECT_NEAR(facts().at("gain_at_low_frequencies").get<double>(), 0.5, 2e-3) << "N = 1 - O((1 um/1 mm)^1.5)";
  run({"d.json", "--amplitude", "1 mm"});
  EXPECT_NEAR(facts().at("gain_at_low_frequencies").get<double>(), 0.5, 2e-3);
  const Outcome wrong = process::hysteron(folder_.path(), {"linearize", "d.json", "--amplitude", "gap=1 V"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("um"), std::string::npos) << wrong.err;
}

TEST_F(LinearizeVerb, ASampledLoopIsToldInZAndInSamples) {
  // L(z) = 3 (1 - a)/(z - a), a = exp(-0.2).
  folder_.write("d.json", R"({"format": 1, "title": "sampled", "inputs": {"r": {"unit": "V"}}, "blocks": {
    "e": {"type": "sum", "in": ["r", "y"], "signs": "+-"},
    "held": {"type": "sample_hold", "period": "0.1 s", "in": "e"},
    "u": {"type": "gain", "gain": 3, "in": "held"},
    "y": {"type": "lag", "times": ["0.5 s"], "in": "u"}}, "outputs": {"y": "y"}})");
  const Outcome outcome = run({"d.json", "--from", "e", "--to", "y", "--open", "e"});
  EXPECT_TRUE(says(outcome, "Poles in z over that period: 0.81873.")) << outcome.out;
  const json margins = facts().at("margins");
  const double a = std::exp(-0.2);
  EXPECT_NEAR(margins.at("gain_margin").get<double>(), (1 + a) / (1 - a) / 3, 1e-9);
  EXPECT_NEAR(margins.at("delay_margin_samples").get<double>(), margins.at("delay_margin_s").get<double>() / 0.1, 1e-9);
  EXPECT_TRUE(says(outcome, "samples of 100 ms")) << outcome.out;
  folder_.write("d.json", R"({"format": 1, "title": "sampled", "inputs": {"r": {"unit": "V"}}, "blocks": {
    "e": {"type": "sum", "in": ["r", "y"], "signs": "+-"},
    "held": {"type": "sample_hold", "period": "0.1 s", "in": "e"},
    "u": {"type": "gain", "gain": 15, "in": "held"},
    "y": {"type": "lag", "times": ["0.5 s"], "in": "u"}}, "outputs": {"y": "y"}})");
  const Outcome unstable = run({"d.json", "--from", "e", "--to", "y", "--open", "e"});
  EXPECT_NE(first_line(unstable).find("the closed loop is unstable (1 pole outside the unit circle)"),
            std::string::npos)
      << unstable.out;
  expect_nothing_of_a_stable_loop(unstable, facts());
}

TEST_F(LinearizeVerb, WhatIsNoLoopGainHasNoMargins) {
  folder_.write("d.json", R"({"format": 1, "title": "units", "inputs": {"r": {"unit": "V"}}, "blocks": {
    "y": {"type": "gain", "gain": "2 um/V", "in": "r"}}, "outputs": {"y": "y"}})");
  const Outcome outcome = run({"d.json", "--open", "r"});
  EXPECT_TRUE(says(outcome, "is no loop gain")) << outcome.out;
  EXPECT_FALSE(facts().contains("margins"));
}

}  // namespace
}  // namespace hysteron
