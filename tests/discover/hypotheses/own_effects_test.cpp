// Effects that a user writes as JSON: one that the library has too, ones that it has not, and files that are wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "blocks/register_all.h"
#include "discover/effects/all.h"
#include "discover/hypotheses/effect_file.h"
#include "discover/hypotheses/effect_quantity.h"
#include "discover/selection/discover.h"
#include "io/diagram/diagram_file.h"
#include "tests/discover/synthetic.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

using namespace testing;

/// The amplifier's lag of the library, one pole, said in JSON.
const char* const own_lag = R"json({
  "format": 1, "title": "A lag of my own", "source": "definition of a first-order lag",
  "parameters": {"tau": "1 ms"},
  "inputs": {"in": {}},
  "blocks": {"pole": {"type": "lag", "times": "$tau", "in": "in"}},
  "outputs": {"out": "pole"},
  "effect": {
    "id": "own_lag", "cause": "the output resistance", "equation": "tau*dv/dt = u - v", "enters_at": ["command"],
    "law": "one pole",
    "free": {"tau": {"meaning": "time constant", "start": "1 row", "lower": "1e-4 row", "upper": "1 recording",
                     "log_scale": true, "scan": {"from": "0.02 row", "to": "0.5 recording", "per_decade": 3}}},
    "needs": {"text": "quick motion"},
    "look_alikes": [{"effect": "dead_time", "experiment": "multisine", "decides": "the gain"}],
    "says": "{tau} late"}
})json";

std::string of_project(const std::string& name) {
  return std::string(HYSTERON_SOURCE_DIR) + "/diagrams/effects/" + name;
}

class OwnEffects : public ::testing::Test {
 protected:
  Effect read(const std::string& text) { return read_effect(folder.write("own.json", text), registry); }
  /// The problems of a text, as "code path line".
  std::string problems(const std::string& text) {
    try {
      (void)read(text);
    } catch (const Error& e) {
      std::string all;
      for (const auto& p : e.problems) {
        EXPECT_FALSE(p.cure.empty()) << p.what;
        EXPECT_NE(p.file.find("own.json"), std::string::npos) << p.what;
        all += p.code + " " + p.path + "\n";
      }
      return all;
    }
    return "none";
  }
  /// The same with one part of the lag's file replaced.
  std::string problems(const std::string& what, const std::string& by) {
    std::string text = own_lag;
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return problems(text.replace(at, what.size(), by));
  }
  static std::string tried(const Discovery& d) {
    std::string text = d.headline;
    for (const auto& c : d.candidates)
      text += "\n  " + c.effect + " at " + c.place + ": " + c.summary + "; " + c.reason;
    for (const auto& r : d.refused) text += "\n  refused " + r.effect + ": " + r.reason;
    return text;
  }
  TemporaryFolder folder;
  Registry registry = all_blocks();
};

/// y = law(t, u) plus noise, on steps, sines and a triangle.
template <class Law>
DataSet recordings(double white, double low, double high, Law law) {
  std::vector<Recording> list;
  std::uint64_t seed = 500;
  const auto add = [&](Role role, const std::vector<double>& t, std::vector<double> u) {
    for (auto& v : u) v = low + (high - low) * v;
    auto y = law(t, u);
    const auto n = noise(y.size(), white, 0.1 * white, seed);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += n[k];
    list.push_back(recording(std::to_string(seed++) + ".csv", role, t, u, y));
  };
  const auto t = rows(900, 0.02);
  add(Role::train, t, several_sines(t, 1, {0.2, 0.9, 3}));
  add(Role::train, t, decaying_triangle(t, 1, 6));
  add(Role::validate, t, several_sines(t, 0.9, {0.35, 1.7}));
  return data_set(list, white);
}

/// u behind a lag, exact for a signal that is straight between its rows.
std::vector<double> late(const std::vector<double>& t, const std::vector<double>& u, double tau) {
  std::vector<double> z{u.front()};
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double h = t[k] - t[k - 1], e = std::exp(-h / tau), slope = (u[k] - u[k - 1]) / h;
    z.push_back(u[k] - slope * tau + (z.back() - u[k - 1] + slope * tau) * e);
  }
  return z;
}

TEST_F(OwnEffects, ALagInJsonIsAsGoodAsThatOfTheLibrary) {
  const auto data = recordings(2e-3, 0, 1, [](const auto& t, const auto& u) { return late(t, u, 0.013); });
  const Effects library = all_effects();
  const Discovery theirs = diagnose(plain_gain(), data, registry, Effects({library.get("amplifier_lag")}));
  const Discovery ours = diagnose(plain_gain(), data, registry, Effects({read(own_lag)}));
  ASSERT_EQ(theirs.steps.size(), 1u) << tried(theirs);
  ASSERT_EQ(ours.steps.size(), 1u) << tried(ours);
  const auto& a = theirs.steps.front().winner;
  const auto& b = ours.steps.front().winner;
  ASSERT_EQ(a.law, "one pole");
  // One model and one search: what differs is the order of sums.
  EXPECT_NEAR(b.score, a.score, 1e-6 * std::abs(a.score));
  EXPECT_NEAR(ours.final_error.rms_validate, theirs.final_error.rms_validate, 1e-9);
  ASSERT_EQ(b.found.size(), 1u);
  EXPECT_EQ(b.found.front().estimate.path, "u_own_lag/tau[0]");
  EXPECT_NEAR(b.found.front().estimate.used, a.found.front().estimate.used, 1e-6 * 0.013);
  EXPECT_NEAR(b.found.front().estimate.used, 0.013, 1e-4);  // ten times what 2 mm over 900 rows leave
  EXPECT_EQ(b.summary.substr(b.summary.size() - 7), " s late") << b.summary;
}

TEST_F(OwnEffects, OneThatTheLibraryLacksIsNamedAndItsDiagramRunsFromItsFile) {
  // 8 % of the range at full stroke, behind 0.15 s: slow for 3 Hz, quick for 0.2 Hz.
  const auto data = recordings(2e-3, 0, 1, [](const auto& t, const auto& u) {
    const auto z = late(t, u, 0.15);
    std::vector<double> y;
    for (std::size_t k = 0; k < u.size(); ++k) y.push_back(u[k] + 0.08 * z[k] * z[k]);
    return y;
  });
  const Effects effects = with_own_effects(all_effects(), {of_project("quadratic_memory.json")}, registry);
  const Discovery d = diagnose(plain_gain(), data, registry, effects);
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  const auto& winner = d.steps.front().winner;
  ASSERT_EQ(winner.effect, "quadratic_memory") << tried(d);
  EXPECT_EQ(d.verdict, Verdict::missing_effect) << tried(d);
  EXPECT_NEAR(winner.found.at(0).estimate.used, 0.08, 0.002);  // 1/m; noise of 2 mm over 900 rows leaves a tenth of it
  EXPECT_NEAR(winner.found.at(1).estimate.used, 0.15, 0.015);
  EXPECT_NEAR(d.final_error.rms_validate, 2e-3, 2e-4);
  ASSERT_EQ(d.steps.front().change.parts.size(), 1u) << "the diagram names the effect's file";
  const std::string file = folder.write("final.json", diagram_text(d.final_diagram));
  const Diagram again = read_diagram(file, {of_project("")});
  EXPECT_NO_THROW((void)compile(again, registry));
  EXPECT_EQ(remove_effect(again, registry, "quadratic_memory").blocks.names(), plain_gain().blocks.names());
}

TEST_F(OwnEffects, AKneeOfTheirOwnIsTakenForAKneeAndNotWhereNothingIsHidden) {
  const auto knee = [](const auto&, const auto& u) {  // an exponential knee: no power of any order
    std::vector<double> y;
    for (const double v : u)
      y.push_back(std::copysign(1.2 * (1 - std::exp(-std::abs(v) / 1.2 * (1 + 0.4 * std::abs(v)))), v));
    return y;
  };
  const Effects effects = with_own_effects(all_effects(), {of_project("soft_limit.json")}, registry);
  const auto straight = [](const auto&, const auto& u) { return u; };
  const Discovery nothing = diagnose(plain_gain(), recordings(2e-3, -1, 1, straight), registry, effects);
  EXPECT_EQ(nothing.verdict, Verdict::adequate) << tried(nothing);
  const Discovery alone =
      diagnose(plain_gain(), recordings(2e-3, -1, 1, knee), registry, Effects({effects.get("soft_limit")}));
  ASSERT_FALSE(alone.steps.empty()) << tried(alone);
  EXPECT_LT(alone.final_error.rms_validate, 0.2 * alone.base.rms_validate);
}

TEST_F(OwnEffects, ASignalInAnotherUnitOrWithoutWhatItNeedsIsRefusedWithTheReason) {
  std::string text = own_lag;
  text.replace(text.find("\"in\": {}"), 8, "\"in\": {\"unit\": \"N\"}");
  const Effect force = read(text);
  Excitation at;
  at.unit = parse_unit("V");
  EXPECT_NE(force.unseen(at).find("V, the effect acts on a signal in N"), std::string::npos) << force.unseen(at);
  text = own_lag;
  text.replace(text.find("\"quick motion\""), 14, R"("holds", "hold": "10 s", "range": "2 V", "changes_sign": true)");
  const Effect holds = read(text);
  at.from_data = true;
  at.highest = 3;
  at.longest_hold = 2;
  EXPECT_EQ(holds.unseen(at), "longest hold 2 s, needs 10 s");
  at.longest_hold = 20;
  EXPECT_EQ(holds.unseen(at), "the signal does not change its sign");
  at.lowest = -3;
  EXPECT_EQ(holds.unseen(at), "");
  at.lowest = 2;
  EXPECT_NE(holds.unseen(at).find("spans 1 V, the effect needs 2 V"), std::string::npos) << holds.unseen(at);
}

TEST_F(OwnEffects, WhatIsWrongInAFileIsToldWithItsPlace) {
  EXPECT_EQ(problems(own_lag), "none");
  EXPECT_EQ(problems(R"("id": "own_lag", )", ""), "missing_key /effect\n");
  EXPECT_EQ(problems(R"("id": "own_lag")", R"("id": "Own lag")"), "bad_name /effect/id\n");
  EXPECT_EQ(problems(R"("in": {})", R"("u": {})"), "wrong_ports /inputs\n");
  EXPECT_EQ(problems(R"("out": "pole")", R"("y": "pole")"), "wrong_ports /outputs\n");
  EXPECT_EQ(problems(R"("times": "$tau")", R"("times": "1 ms")"), "unused_parameter /parameters/tau\n")
      << "a number that nothing reads cannot be fitted";
}

TEST_F(OwnEffects, WhatIsWrongInItsNumbersIsTold) {
  EXPECT_EQ(problems(R"("free": {"tau")", R"("free": {"tua")"),
            "unknown_parameter /effect/free/tua\n"
            "unknown_parameter /effect/says\n");
  EXPECT_EQ(problems(R"("start": "1 row")", R"("start": "1 rwo")"), "bad_unit /effect/free/tau/start\n");
  EXPECT_EQ(problems(R"("start": "1 row", "lower": "1e-4 row")", R"("start": "1 ms", "lower": "2 ms")"),
            "bad_value /effect/free/tau/lower\n");
  EXPECT_EQ(problems(R"("start": "1 row", "lower": "1e-4 row")", R"("start": "1 ms", "lower": "1 mV")"),
            "wrong_unit /effect/free/tau/lower\n");
  EXPECT_EQ(problems(R"("lower": "1e-4 row", )", ""), "missing_key /effect/free/tau\n") << "log_scale without a bound";
  EXPECT_EQ(problems(R"("enters_at": ["command"])", R"("enters_at": ["comand"])"), "bad_value /effect/enters_at/0\n");
  EXPECT_EQ(problems(R"("multisine")", R"("multi")"), "bad_value /effect/look_alikes/0/experiment\n");
  EXPECT_EQ(problems(R"("{tau} late")", R"("{lag} late")"), "unknown_parameter /effect/says\n");
  EXPECT_EQ(problems(R"("type": "lag")", R"("type": "lgg")"), "unknown_block /blocks/pole/type\n");
  EXPECT_EQ(problems(R"("start": "1 row", "lower": "1e-4 row", "upper": "1 recording")",
                     R"("start": "1 V", "lower": "1 mV")"),
            "wrong_unit /blocks/pole/times\n");
}

TEST_F(OwnEffects, AnIdThatIsTakenAndALookAlikeThatIsNoneAreRefused) {
  std::string text = own_lag;
  text.replace(text.find("own_lag"), 7, "creep");
  const std::string taken = folder.write("creep.json", text);
  const auto code = [&](const std::vector<std::string>& files) -> std::string {
    try {
      (void)with_own_effects(all_effects(), files, registry);
    } catch (const Error& e) {
      return e.problems.front().code;
    }
    return "none";
  };
  EXPECT_EQ(code({taken}), "effect_twice");
  text = own_lag;
  text.replace(text.find("dead_time"), 9, "dead_tyme");
  EXPECT_EQ(code({folder.write("alike.json", text)}), "unknown_effect");
  EXPECT_EQ(code({of_project("")}), "none") << "a folder stands for its files";
  EXPECT_EQ(code({folder.path("not_there.json")}), "no_file");
}

TEST(EffectQuantity, FollowsTheWire) {
  Excitation at;
  at.unit = parse_unit("um");
  at.lowest = -1e-6;
  at.highest = 3e-6;
  at.side_unit = parse_unit("degC");
  at.side_lowest = 293.15;
  at.side_highest = 303.15;
  at.shortest_step = 1e-3;
  const auto written = [&](const std::string& text) {
    const Number n = EffectQuantity(text, "").number(at);
    return std::to_string(n.value).substr(0, 6) + " " + n.unit.value_or("-");
  };
  EXPECT_EQ(written("0.5 range"), "2.0000 um");
  EXPECT_EQ(written("2/range"), "0.5000 1/um");
  EXPECT_EQ(written("1 range/row"), "4000.0 um/s");
  EXPECT_EQ(written("1 middle"), "1.0000 um");
  EXPECT_EQ(written("1 side_middle"), "25.000 degC") << "a level keeps its zero";
  EXPECT_EQ(written("1 side_range"), "10.000 K") << "a difference has none";
  EXPECT_EQ(written("3 mV"), "3.0000 mV");
  EXPECT_EQ(written("3"), "3.0000 -");
  EXPECT_DOUBLE_EQ(EffectQuantity("2/range", "").si(at), 0.5e6);
  EXPECT_NEAR(EffectQuantity("1 side_middle", "").si(at), 298.15, 1e-9);
  EXPECT_THROW(EffectQuantity("1 middle/s", ""), Error) << "a level is no factor";
  EXPECT_THROW(EffectQuantity("range", ""), Error) << "no number in front";
}

}  // namespace
}  // namespace hysteron
