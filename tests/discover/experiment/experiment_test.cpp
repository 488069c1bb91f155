// The experiment that a tie asks for: which input moves, how fast, how far, and whom it tells from whom.
#include "discover/experiment/experiment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "discover/placement/rows.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;
using std::numbers::pi;

bool by_more_than_noise(const Experiment& e, bool) { return e.separation > 1; }

/// One drive of -1 .. 1 V, rows every `step`, recordings of `longest`.
Device driven(double step, double longest) {
  Device d;
  d.drives = {{"u", parse_unit("V"), -1, 1}};
  d.inputs = {"u"};
  d.shortest_step = step;
  d.longest_recording = longest;
  d.levels = {{"u", 0.0}};
  return d;
}

class Experiments : public Discoveries {
 protected:
  /// u -> gain 1 m/V -> a block -> y.
  ProgramPointer gain_then(const char* type, std::vector<std::pair<std::string, Value>> parameters) {
    Diagram d = plain_gain();
    Node& last = d.blocks["last"];
    last.type = type;
    for (auto& [name, value] : parameters) last.parameters[name] = std::move(value);
    last.in = {{"", "stage"}};
    d.outputs["y"] = "last";
    return compile(d, registry);
  }
  ProgramPointer plain() { return compile(plain_gain(), registry); }
  ProgramPointer clamped(const char* level) {
    return gain_then("saturation", {{"lower", Value(std::string("-") + level)}, {"upper", Value(level)}});
  }
  ProgramPointer late(const char* delay) { return gain_then("dead_time", {{"delay", Value(delay)}}); }
  ProgramPointer on_spring(const char* damping) {
    Diagram d = mass_on_spring();
    d.blocks["stage"].parameters["damping"] = Value(damping);
    return compile(d, registry);
  }

  static Separation separated(std::vector<Rival> models, const Device& device, double noise = 1e-3) {
    return separate({std::move(models), by_more_than_noise}, device, {{"y"}, {noise}, {false}});
  }
  static std::optional<Experiment> chosen(std::vector<Rival> models, const Device& device, double noise = 1e-3) {
    return separated(std::move(models), device, noise).best;
  }
  static Rival rival(const char* effect, ProgramPointer program) {
    Rival r;
    r.effect = effect;
    r.program = std::move(program);
    return r;
  }
  /// The first, to be told from `other` by `word`.
  static Rival asking(Rival r, const char* other, const char* word) {
    r.look_alikes.push_back({other, word, ""});
    return r;
  }
};

// --- what is told is what was simulated

TEST_F(Experiments, TheMultisineHasThreeRealisationsOfTwoPeriods) {
  const Device d = driven(1e-3, 10);
  const Protocol p = drive_protocol(d, d.drives[0], "multisine");
  EXPECT_NE(p.text.find("row every 1 ms, three realisations of two periods of 300 ms; 1.8 s in all"), std::string::npos)
      << p.text;
  const auto& v = p.moves.at("u").v;
  ASSERT_EQ(v.size(), 3u * 2 * 300);
  for (std::size_t k = 0; k < v.size(); ++k) EXPECT_EQ(v[k], v[k % 600 < 300 ? k + 300 : k]) << k;
  EXPECT_NE(v[10], v[610]);
  EXPECT_NE(v[610], v[1210]);
  EXPECT_NE(v[10], v[1210]);
}

TEST_F(Experiments, ALevelOfTheSizeOfRoundingIsWrittenAsNothing) {
  Device d = driven(1e-3, 10);
  d.drives[0].lowest = -1 + 13e-6;  // the middle is 6.5e-06 V
  for (const auto& word : drive_words()) {
    const std::string text = drive_protocol(d, d.drives[0], word).text;
    EXPECT_EQ(text.find("e-0"), std::string::npos) << text;
  }
  EXPECT_NE(drive_protocol(d, d.drives[0], "step_hold").text.find("levels -1 V, 0 V, 1 V, 0 V, -1 V"),
            std::string::npos);
}

TEST_F(Experiments, EveryVariantStaysInsideTheRangeAndTheSampling) {
  const Device d = driven(1e-3, 10);
  for (const auto& word : drive_words())
    for (const double slower : paces(word))
      for (const double part : {1.0, 0.25}) {
        const Protocol p = drive_protocol(d, d.drives[0], word, {slower, part});
        const auto& s = p.moves.at("u");
        const auto [low, high] = std::minmax_element(s.v.begin(), s.v.end());
        EXPECT_GE(*low, -1 - 1e-12) << p.text;
        EXPECT_LE(*high - *low, 2 * part + 1e-12) << p.text;
        EXPECT_LE(*high, 1 + 1e-12) << p.text;
        for (std::size_t k = 1; k < p.t.size(); ++k)
          ASSERT_GT(p.t[k] - p.t[k - 1], 0.49e-3) << p.text << " at " << p.t[k];
      }
}

TEST_F(Experiments, WhatIsSlowStaysSlowInShortRecordings) {
  const Device d = driven(1e-3, 1);
  for (const double slower : paces("triangle")) {
    const std::string text = drive_protocol(d, d.drives[0], "triangle", {slower, 1}).text;
    EXPECT_NE(text.find("period 200 ms"), std::string::npos) << text;
  }
  // Between 2 and 100 Hz: the middle is 14 Hz.
  for (const double slower : paces("low_frequencies")) {
    const std::string text = drive_protocol(d, d.drives[0], "low_frequencies", {slower, 1}).text;
    EXPECT_NE(text.find("14.1 Hz, three"), std::string::npos) << text;
  }
}

/// Values and times carry rounding of some parts in 10^16, of steps as small as a thousandth of the whole.
double fastest_in(const Series& s) {
  double fastest = 0;
  for (std::size_t k = 1; k < s.v.size(); ++k)
    fastest = std::max(fastest, std::abs(s.v[k] - s.v[k - 1]) / (s.t[k] - s.t[k - 1]));
  return fastest;
}

TEST_F(Experiments, NothingMovesFasterThanItWasRecorded) {
  // 20 V/s: the usual sines of 100 Hz would have 628 V/s, and a step of a row 2000 V/s.
  for (const double most : {20.0, 0.5}) {
    Device d = driven(1e-3, 10);
    d.drives.push_back({"u2", parse_unit("V"), -1, 1});
    d.inputs = {"u", "u2"};
    d.fastest = {{"u", most}, {"u2", most}};
    d.recorded_times = {0, 1, 2};
    for (const char* u : {"u", "u2"}) d.recorded[u] = {{0, 1, 2}, {1, 0.75, 0.5}, Between::linear};
    auto words = drive_words();
    words.emplace_back("precycle");
    for (const auto& word : words)
      for (const double slower : paces(word))
        for (const double part : {1.0, 0.25}) {
          const Protocol p = drive_protocol(d, d.drives[0], word, {slower, part, true});
          const Series& s = p.moves.at("u");
          EXPECT_LE(fastest_in(s), most * (1 + 1e-9)) << p.text;
          EXPECT_EQ(fastest_in(s) > 0, word != "zero_run") << p.text;
          for (const double v : s.v) ASSERT_LE(std::abs(v), 1 + 1e-12) << p.text;
          for (std::size_t k = 1; k < p.t.size(); ++k)
            ASSERT_GT(p.t[k] - p.t[k - 1], 0.49e-3) << p.text << " at " << p.t[k];
        }
    for (const auto& p : side_protocols(d, d.drives[0], {{"u2", Side::other_axis}, {"room", Side::temperature}}))
      for (const char* u : {"u", "u2"})
        EXPECT_LE(p.moves.contains(u) ? fastest_in(p.moves.at(u)) : 0, most * (1 + 1e-9)) << p.text;
  }
}

TEST_F(Experiments, WhereTheRecordingsWereFastEnoughNothingIsSlower) {
  Device bound = driven(1e-3, 10);
  bound.fastest = {{"u", 2000.0}};  // the whole range in a row
  const Device d = driven(1e-3, 10);
  for (const auto& word : drive_words()) {
    const Protocol a = drive_protocol(d, d.drives[0], word), b = drive_protocol(bound, d.drives[0], word, {1, 1, true});
    EXPECT_EQ(a.text, b.text);
    EXPECT_EQ(a.t, b.t) << word;
    EXPECT_EQ(a.moves.at("u").v, b.moves.at("u").v) << word;
  }
}

TEST_F(Experiments, HowFastAnInputMovedIsReadFromTheRecordings) {
  const DataSet data = data_set({recording("1.csv", Role::train, rows(4, 0.1), {0, 1, 3, 3}, {0, 1, 3, 3}),
                                 recording("2.csv", Role::validate, rows(4, 0.5), {0, -4, 0, 0}, {0, 1, 2, 3})},
                                1e-3);
  // 2 V in 0.1 s; the other one moves further, and slower.
  EXPECT_NEAR(device_of(*plain(), data).fastest.at("u"), 20, 1e-12);
}

TEST_F(Experiments, WhatTellsAsMuchWithinTheSpeedOfTheRecordingsIsAskedFor) {
  // A delay of 2 ms moves what goes at 20 V/s by 40 mm, forty times the noise; recordings of 0.5 V/s by one noise.
  Device d = driven(1e-3, 10);
  for (const double most : {20.0, 0.5}) {
    d.fastest = {{"u", most}};
    const auto e = chosen({rival("plain", plain()), rival("delay", late("2 ms"))}, d);
    ASSERT_TRUE(e && e->drive);
    const DrivenInput& u = e->drive->inputs[0];
    EXPECT_EQ(u.recorded, most);
    EXPECT_NEAR(u.fastest, fastest_in({e->drive->t, u.values}), 1e-9);
    if (most > 1)
      EXPECT_LE(u.fastest, most * (1 + 1e-6)) << e->text;
    else
      EXPECT_GT(u.fastest, most) << "nothing as slow tells: " << e->text;
    EXPECT_EQ(e->rivals_told, 1);
  }
}

TEST_F(Experiments, TheRowsOfAnExperimentAreThoseThatWereSimulated) {
  Device d = driven(1e-3, 10);
  const ProgramPointer late_one = late("2 ms");
  const auto e = chosen({rival("plain", plain()), rival("delay", late_one)}, d);
  ASSERT_TRUE(e && e->drive);
  const DriveRows& rows = *e->drive;
  ASSERT_EQ(rows.inputs.size(), 1u);
  EXPECT_TRUE(rows.inputs[0].moves);
  EXPECT_EQ(rows.outputs, std::vector<std::string>{"y"});
  EXPECT_EQ(rows.shortest_step, 1e-3);
  EXPECT_EQ(static_cast<double>(rows.t.size()), e->rows);
  const std::vector<SeriesPointer> u{
      std::make_shared<const Series>(Series{rows.t, rows.inputs[0].values, Between::linear})};
  const auto there = [&](const ProgramPointer& p) {
    return simulate_rows(p, u, rows.t, {p->output_signals[0]}, true)[0];
  };
  const auto a = there(plain()), b = there(late_one);
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  EXPECT_NEAR(std::sqrt(sum / static_cast<double>(a.size())) / 1e-3, e->separation, 1e-9 * e->separation);
}

// --- how fast, how far

TEST_F(Experiments, TheFrequencyIsTheOneAtWhichTheModelsDiffer) {
  // A mode at 3.18 Hz, damped by 4 or 6 N s/m. Rows allow 9.55 Hz: usual are that, a fourth and a twentieth of it, and
  // the mode is at a third.
  const double step = 0.1 / (3 * 20 / (2 * pi));
  const Device d = driven(step, 100);
  const auto e =
      chosen({asking(rival("a", on_spring("4 N s/m")), "b", "high_frequencies"), rival("b", on_spring("6 N s/m"))}, d);
  ASSERT_TRUE(e);
  EXPECT_EQ(e->word, "high_frequencies");
  EXPECT_NE(e->text.find("3.18 Hz"), std::string::npos) << e->text;
  EXPECT_NE(e->text.find(" in all"), std::string::npos) << e->text;
}

TEST_F(Experiments, TheAmplitudeIsTheOneAtWhichTheModelsDiffer) {
  // Gains of 1 and 1.5 that both end at 0.1 m: most of a large motion is the same for both.
  Diagram steep = plain_gain();
  steep.blocks["stage"].parameters["gain"] = Value("1.5 m/V");
  Node& last = steep.blocks["last"];
  last.type = "saturation";
  last.parameters["lower"] = Value("-0.1 m");
  last.parameters["upper"] = Value("0.1 m");
  last.in = {{"", "stage"}};
  steep.outputs["y"] = "last";
  const auto e = chosen({asking(rival("a", clamped("0.1 m")), "b", "multisine"), rival("b", compile(steep, registry))},
                        driven(1e-3, 10));
  ASSERT_TRUE(e);
  EXPECT_EQ(e->word, "multisine");
  EXPECT_NE(e->text.find("peak 0.225 V"), std::string::npos) << e->text;
}

TEST_F(Experiments, ADriftIsToldFromNothingWhereNothingMoves) {
  // 5 um/s: 9 mm in half an hour, against noise of 1 mm.
  const auto drifting = gain_then("sensor_drift", {{"rate", Value("0.005 mm/s")}});
  const auto e =
      chosen({asking(rival("sensor_drift", drifting), "none", "zero_run"), rival("none", plain())}, driven(1, 1000));
  ASSERT_TRUE(e);
  EXPECT_EQ(e->word, "zero_run");
  EXPECT_NE(e->text.find("0 V held still"), std::string::npos) << e->text;
  EXPECT_NE(e->text.find("30 min in all"), std::string::npos) << e->text;
  // A ramp to 9 mm has rms 5.2 mm; a hundred of the 400 rows lie in its first 100 s.
  EXPECT_NEAR(e->separation, 4.6, 0.1);
}

TEST_F(Experiments, ABiasMovesTheSmallSineToWhereTheSlopeIsAnotherOne) {
  const Device d = driven(1e-3, 10);
  const Protocol p = drive_protocol(d, d.drives[0], "sine_amplitudes");
  EXPECT_NE(p.text.find("then of 0.05 V around -0.8 V, -0.4 V, 0.4 V, 0.8 V"), std::string::npos) << p.text;
  const auto& v = p.moves.at("u").v;
  EXPECT_NEAR(*std::max_element(v.end() - 30, v.end()), 0.85, 1e-3);
  EXPECT_NEAR(*std::min_element(v.end() - 30, v.end()), 0.75, 1e-3);
}

TEST_F(Experiments, WhatTheDeviceRemembersIsWipedOutByADecayingSine) {
  // Two-sided plays that start as after -1 V, or not: in the recording they differ until all of them have been
  // carried along; behind the decaying sine they do not.
  Device d = driven(0.01, 4);
  d.recorded_times = rows(400, 0.01);
  d.recorded["u"] = {d.recorded_times, sampled(d.recorded_times, [](double x) { return 0.5 * std::sin(x); }),
                     Between::linear};
  const Protocol p = drive_protocol(d, d.drives[0], "precycle");
  EXPECT_NE(p.text.find("decays from 1 V to nothing in 20 periods of 400 ms"), std::string::npos) << p.text;
  const auto plays = [&](const char* before, double weight) {
    return gain_then("prandtl_ishlinskii", {{"thresholds", Value(NumberList{{0, "m"}, {0.3, "m"}})},
                                            {"weights", Value(NumberList{{1, ""}, {weight, ""}})},
                                            {"sides", Value("two")},
                                            {"before", Value(before)}});
  };
  const auto a = plays("-1 m", 0.5), b = plays("0 m", 0.5);
  const auto answer = [&](const ProgramPointer& program) {
    const auto u = std::make_shared<const Series>(p.moves.at("u"));
    return simulate_rows(program, {u}, p.t, program->output_signals, true).front();
  };
  const auto with = answer(a), without = answer(b);
  EXPECT_GT(std::abs(with.front() - without.front()), 0.1) << "they differ where they start";
  for (std::size_t k = p.t.size() - 400; k < p.t.size(); ++k)
    EXPECT_NEAR(with[k], without[k], 1e-12) << "and not behind the sine, but for rounding";
  // Who asks for it gets it where it tells.
  const auto e = chosen(
      {asking(rival("initial_remanence", a), "hysteresis", "precycle"), rival("hysteresis", plays("0 m", 0.6))}, d);
  ASSERT_TRUE(e);
  EXPECT_EQ(e->word, "precycle");
}

// --- which input

struct Moved {
  std::vector<double> t, u, y;
};

/// A lag of 5 ms under triangles of one speed: a distance to the drive that is the same for a delay and for lost
/// motion.
Moved triangles_of_one_speed(std::uint64_t seed) {
  Moved m;
  m.t = rows(600, 0.05);
  m.u = sampled(m.t, [](double x) { return 1 - std::abs(1 - std::fmod(x / 5, 2)); });
  m.y = noise(m.t.size(), 5e-4, 5e-5, seed);
  for (std::size_t k = 1; k < m.t.size(); ++k)  // 0.2 V/s for 5 ms; a row later it has settled
    m.y[k] += m.u[k] - (m.u[k] > m.u[k - 1] ? 1 : -1) * 1e-3;
  return m;
}

DataSet on_one_axis() {
  std::vector<Recording> list;
  for (const Role role : {Role::train, Role::validate}) {
    const Moved m = triangles_of_one_speed(list.size() + 1);
    list.push_back(recording(list.empty() ? "1.csv" : "2.csv", role, m.t, m.u, m.y));
  }
  return data_set(list, 5e-4);
}

/// The same on one axis, while the other one follows at once.
DataSet on_two_axes(bool late_is_second) {
  DataSet data = on_one_axis();
  std::uint64_t seed = 3;
  for (auto& r : data.recordings) {
    r.columns["u2"] = sampled(r.t, [](double x) { return 0.5 - 0.5 * std::cos(2 * pi * 0.3 * x); });
    r.columns["y2"] = noise(r.t.size(), 5e-4, 5e-5, seed++);
    for (std::size_t k = 0; k < r.t.size(); ++k) r.columns["y2"][k] += r.columns["u2"][k];
    r.units["u2"] = r.units["u"];
    r.units["y2"] = r.units["y"];
    if (!late_is_second) continue;
    std::swap(r.columns["u"], r.columns["u2"]);
    std::swap(r.columns["y"], r.columns["y2"]);
  }
  data.notes["u2"].to = "u2";
  data.notes["y2"].to = "y2";
  data.notes["y2"].noise = data.notes["y"].noise;
  return data;
}

TEST_F(Experiments, ATieOnTheSecondAxisMovesTheSecondInputAndAnswersAsOnTheFirst) {
  const std::vector<std::string> lags{"amplifier_lag", "dead_time"};
  const Discovery on_first = discovered(two_plain_axes(), on_two_axes(false), lags),
                  on_second = discovered(two_plain_axes(), on_two_axes(true), lags);
  for (const auto* d : {&on_first, &on_second}) {
    EXPECT_EQ(to_text(d->verdict), "not_distinguishable") << tried(*d);
    ASSERT_TRUE(d->experiment) << d->headline;
    EXPECT_GT(d->experiment->separation, 1);
  }
  EXPECT_EQ(on_second.experiment->word, on_first.experiment->word);
  EXPECT_NEAR(on_second.experiment->separation, on_first.experiment->separation, 1e-6);
  EXPECT_EQ(on_first.experiment->text.rfind("move u, hold the other inputs: ", 0), 0u) << on_first.experiment->text;
  EXPECT_EQ(on_second.experiment->text.rfind("move u2, hold the other inputs: ", 0), 0u) << on_second.experiment->text;
}

TEST_F(Experiments, ATemperatureIsNotDrivenWhereAnotherInputMoves) {
  Diagram d = plain_gain();
  d.inputs["room"].unit = "degC";
  Node& rod = d.blocks["rod"];
  rod.type = "gain";
  rod.parameters["gain"] = Value("1 m/K");
  rod.in = {{"", "room"}};
  d.outputs["z"] = "rod";
  Recording r = recording("1.csv", Role::train, rows(3, 0.1), {0, 1, 2}, {0, 1, 2});
  r.columns["room"] = {293, 294, 295};
  r.units["room"] = parse_unit("degC");
  DataSet data = data_set({r}, 1e-3);
  data.notes["room"].to = "room";
  const Device device = device_of(*compile(d, registry), data);
  ASSERT_EQ(device.drives.size(), 1u);
  EXPECT_EQ(device.drives[0].name, "u");
}

// --- all that were simulated

TEST_F(Experiments, TheMenuHoldsEveryVariantThatWasSimulatedAndWhyOneWasChosen) {
  const auto [best, menu] = separated({rival("plain", plain()), rival("delay", late("2 ms"))}, driven(1e-3, 10));
  ASSERT_TRUE(best);
  EXPECT_EQ(menu.pairs, std::vector<std::string>{"plain and delay"});
  const MenuItem* chosen = nullptr;
  for (const auto& item : menu.items) {
    ASSERT_EQ(item.separations.size(), 1u) << item.word;
    EXPECT_FALSE(item.reason.empty()) << item.word;
    EXPECT_LE(item.separation, best->separation) << item.word << ": " << item.reason;
    if (item.chosen) chosen = &item;
  }
  ASSERT_NE(chosen, nullptr);
  EXPECT_EQ(chosen->word, best->word);
  EXPECT_EQ(chosen->separation, best->separation);
  EXPECT_EQ(chosen->drive, "u");
  for (const auto& word : drive_words()) {
    const auto of_word = [&](const MenuItem& item) { return item.word == word; };
    EXPECT_GE(std::count_if(menu.items.begin(), menu.items.end(), of_word), static_cast<long>(paces(word).size()))
        << word << ": each pace of it";
  }
}

TEST_F(Experiments, WhatNeedNotBeSimulatedIsInTheMenuWithoutADistance) {
  const Rival asked = asking(rival("plain", plain()), "clamp", "triangle");
  const auto [best, menu] = separated({asked, rival("clamp", clamped("0.5 m"))}, driven(1e-3, 10));
  ASSERT_TRUE(best);
  ASSERT_EQ(best->word, "triangle");
  for (const auto& word : drive_words()) {
    const auto item =
        std::find_if(menu.items.begin(), menu.items.end(), [&](const MenuItem& i) { return i.word == word; });
    ASSERT_NE(item, menu.items.end()) << word;
    EXPECT_EQ(item->simulated(), word == "triangle") << word;
    EXPECT_FALSE(item->reason.empty()) << word;
  }
}

TEST_F(Experiments, WhatLeavesTheTemperatureToItselfIsNotAdmissibleForWhoReadsOne) {
  Rival warm = rival("expansion", plain());
  warm.side = {"T", Side::temperature};
  Device d = driven(1e-3, 10);
  d.levels["T"] = 295;
  d.ranges["T"] = {293, 297};
  const Menu menu = separated({warm, rival("clamp", clamped("0.5 m"))}, d).menu;
  const auto triangle =
      std::find_if(menu.items.begin(), menu.items.end(), [](const MenuItem& i) { return i.word == "triangle"; });
  ASSERT_NE(triangle, menu.items.end());
  EXPECT_FALSE(triangle->simulated());
  EXPECT_EQ(triangle->reason, "does not excite the signal that they need");
  EXPECT_TRUE(std::any_of(menu.items.begin(), menu.items.end(),
                          [](const MenuItem& i) { return i.word == "temperature_staircase" && i.simulated(); }));
}

// --- three and more

TEST_F(Experiments, OfThreeInATieItTellsAllApartThoughAnotherIsAskedForBetweenTwo) {
  // A triangle is slow against a delay of 1 ms, and tells the clamp only. Fast steps tell both.
  const Device d = driven(1e-3, 100);
  const Rival first = asking(rival("plain", plain()), "clamp", "triangle");
  const auto two = chosen({first, rival("clamp", clamped("0.9 m"))}, d, 5e-3);
  ASSERT_TRUE(two);
  EXPECT_EQ(two->word, "triangle");
  EXPECT_EQ(two->between, "plain and clamp");
  const auto three = chosen({first, rival("clamp", clamped("0.9 m")), rival("delay", late("1 ms"))}, d, 5e-3);
  ASSERT_TRUE(three);
  EXPECT_EQ(three->rivals_told, 2);
  EXPECT_NE(three->word, "triangle") << three->text;
  EXPECT_EQ(three->between, "plain, clamp and delay");
  EXPECT_EQ(three->text.find("not separate"), std::string::npos) << three->text;
}

TEST_F(Experiments, WhomItLeavesTiedIsSaid) {
  const auto e = chosen({rival("plain", plain()), rival("clamp", clamped("0.5 m")), rival("knee", clamped("0.5 m"))},
                        driven(1e-3, 10));
  ASSERT_TRUE(e);
  EXPECT_EQ(e->rivals_told, 2);
  EXPECT_EQ(e->between, "plain and clamp, plain and knee");
  EXPECT_NE(e->text.find("; it would not separate clamp and knee"), std::string::npos) << e->text;
}

TEST_F(Experiments, ATieOfThreeFoundInRecordingsAsksForOneExperimentForAll) {
  const Discovery d = discovered(plain_gain(), on_one_axis(), {"amplifier_lag", "dead_time", "backlash"});
  ASSERT_FALSE(d.steps.empty()) << tried(d);
  const FoundStep& step = d.steps.front();
  ASSERT_EQ(step.ties.size(), 2u) << tried(d);
  EXPECT_EQ(step.menu.pairs.size(), 3u) << "the menu in which all three were simulated";
  EXPECT_EQ(std::count_if(step.menu.items.begin(), step.menu.items.end(), [](const MenuItem& i) { return i.chosen; }),
            1);
  EXPECT_TRUE(step.experiment_would_tell);
  ASSERT_TRUE(step.experiment) << tried(d);
  EXPECT_EQ(step.experiment->rivals_told, 2) << step.experiment->word << ": " << step.experiment->text;
  for (const char* one : {"amplifier_lag", "dead_time", "backlash"})
    EXPECT_NE(step.experiment->between.find(one), std::string::npos) << step.experiment->between;
}

}  // namespace
}  // namespace hysteron
