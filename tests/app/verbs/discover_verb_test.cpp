// `hysteron discover`: the test for machines, and what its errors are held against.
#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/app/hysteron_process.h"
#include "tests/app/lab.h"
#include "tests/app/lab_test.h"

namespace hysteron {
namespace {

using nlohmann::json;
using process::hysteron;
using process::Outcome;

class DiscoverVerb : public LabTest {
 protected:
  json looked_for_a_lag() const {
    const Outcome out = hysteron(folder_.path(), {"discover", "diagram.json", "--data", "dataset.json", "--only",
                                                  "amplifier_lag", "-o", "out"});
    EXPECT_EQ(out.code, 0) << out.err;
    return result("out");
  }
};

/// What the lines of the waterfalls are.
std::set<std::string> floor_labels(const json& all) {
  std::set<std::string> labels;
  for (const auto& s : all["sections"])
    for (const auto& f : s.value("figures", json::array()))
      for (const auto& b : f.value("bars", json::array()))
        if (b["role"] == "floor") labels.insert(b["label"]);
  return labels;
}

TEST_F(DiscoverVerb, DiscoverCheckAnswersYesForAModelThatLacksNothingAndNoForOneThatDoes) {
  const std::vector<std::string> words{"discover", "diagram.json", "--data", "dataset.json", "--check", "-o", "out"};
  record(1);
  const Outcome adequate = hysteron(folder_.path(), words);
  EXPECT_EQ(adequate.code, 0) << adequate.out << adequate.err;
  EXPECT_NE(adequate.out.find("report: out/report.html\n"), std::string::npos) << adequate.out;

  record(3, 0.02);  // 20 ms at a period of 0.5 s: a hundred times the noise
  const Outcome missing = hysteron(folder_.path(), words);
  EXPECT_EQ(missing.code, 1) << missing.out << missing.err;
  EXPECT_NE(missing.out.find("lag"), std::string::npos) << missing.out;
  EXPECT_NE(folder_.read("out/result.json").find("\"explained\": false"), std::string::npos);
}

TEST_F(DiscoverVerb, EveryLawThatWasTriedStandsInItsCandidateWithItsGainInEachRecording) {
  record(3, 0.02);
  for (const auto& c : looked_for_a_lag()["facts"]["candidates"]) {
    ASSERT_FALSE(c["laws"].empty()) << c["effect"];
    int taken = 0;
    for (const auto& law : c["laws"]) {
      EXPECT_EQ(law["fall_by_recording"].size(), c["error"]["recordings"].size()) << law["law"];
      EXPECT_EQ(law["taken"], law["law"] == c["law"]) << law["law"];
      EXPECT_EQ(law["taken"], !law.contains("reason")) << law["law"];
      taken += law["taken"].get<bool>() ? 1 : 0;
    }
    EXPECT_EQ(taken, 1) << c["effect"];
  }
}

TEST_F(DiscoverVerb, ATieHasTheMenuAmongWhichItsExperimentWasChosen) {
  record(3, 0.0005);  // a tenth of a row: a delay does the same
  const Outcome out = hysteron(folder_.path(), {"discover", "diagram.json", "--data", "dataset.json", "--only",
                                                "amplifier_lag,dead_time", "-o", "out"});
  ASSERT_EQ(out.code, 0) << out.err;
  const json step = result("out")["facts"]["steps"].at(0);
  ASSERT_EQ(step["ties"].size(), 1u) << step["sentence"];
  const json& menu = step["menu"];
  ASSERT_EQ(menu["pairs"].size(), 1u);
  int chosen = 0;
  for (const auto& e : menu["experiments"]) {
    EXPECT_FALSE(e["reason"].get<std::string>().empty()) << e["word"];
    if (!e["chosen"]) continue;
    ++chosen;
    EXPECT_EQ(e["word"], step["experiment"]["word"]);
    EXPECT_EQ(e["separation_over_noise"], step["experiment"]["separation_over_noise"]);
  }
  EXPECT_EQ(chosen, 1);
  EXPECT_GT(menu["experiments"].size(), 3u);
}

/// Columns of a CSV without its comments, by the name in front of the unit.
std::map<std::string, std::vector<double>> columns_of(const std::string& text) {
  std::map<std::string, std::vector<double>> columns;
  std::vector<std::string> names;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream cells(line);
    std::size_t i = 0;
    const bool head = names.empty();
    for (std::string cell; std::getline(cells, cell, ','); ++i)
      if (head)
        names.push_back(cell.substr(0, cell.find(' ')));
      else
        columns[names.at(i)].push_back(std::stod(cell));
  }
  return columns;
}

double fastest(const std::vector<double>& t, const std::vector<double>& v) {
  double most = 0;
  for (std::size_t k = 1; k < t.size(); ++k) most = std::max(most, std::abs(v[k] - v[k - 1]) / (t[k] - t[k - 1]));
  return most;
}

TEST_F(DiscoverVerb, TheExperimentIsAFileThatDrivesTheRivalsAsFarApartAsIsTold) {
  record(3, 0.0005);  // a tenth of a row: a delay does the same
  const auto found = [&](const char* only, const std::string& folder) {
    const Outcome out = hysteron(folder_.path(), {"discover", "diagram.json", "--data", "dataset.json", "--only", only,
                                                  "--experiment", folder + ".csv", "--json", "-o", folder});
    EXPECT_EQ(out.code, 0) << out.err;
    return json::parse(out.out);
  };
  const json e = found("amplifier_lag,dead_time", "both").at("experiment");
  EXPECT_EQ(e["file"], "both.csv");
  EXPECT_EQ(e["measure"], json({"y"}));
  const auto drive = columns_of(folder_.read("both.csv"));
  EXPECT_EQ(drive.at("t").size(), e["rows"]);

  // Within what was recorded: how far, how fast, how often.
  double low = 0, high = 0, speed = 0;
  for (const char* file : {"a.csv", "b.csv"}) {
    const auto recorded = columns_of(folder_.read(file));
    for (const double u : recorded.at("u")) low = std::min(low, u), high = std::max(high, u);
    speed = std::max(speed, fastest(recorded.at("t"), recorded.at("u")));
  }
  for (const double u : drive.at("u")) {
    ASSERT_GE(u, low - 1e-9);
    ASSERT_LE(u, high + 1e-9);
  }
  // On straight lines a lag and a delay of the same size do the same: what is no faster than the triangle that was
  // recorded tells them at corners only, by less than the noise. So it is faster, and says so.
  const double faster = fastest(drive.at("t"), drive.at("u"));
  EXPECT_GT(faster, speed);
  ASSERT_EQ(e["faster_than_recorded"].size(), 1U);
  std::ostringstream told;
  told << std::setprecision(3) << "u moves by up to " << faster << " V/s, in the recordings by " << speed;
  EXPECT_EQ(e["faster_than_recorded"][0], told.str());
  EXPECT_NE(folder_.read("both.csv").find("# Faster than recorded: " + told.str()), std::string::npos);
  EXPECT_LE(e["shortest_step"], 0.005 * (1 + 1e-9));  // rows of a and b are 5 ms apart

  // Each rival alone, fitted once more: a lag of 0.5 ms is 6 nm of a triangle of 12 um/s, known from 600 rows of 5 nm
  // to 3 %, and so is how far the two are apart. (To the digits: TheRowsOfAnExperimentAreThoseThatWereSimulated.)
  for (const char* effect : {"amplifier_lag", "dead_time"}) {
    const json alone = found(effect, effect);
    EXPECT_FALSE(alone.contains("experiment")) << "nothing to be told apart";
    EXPECT_FALSE(folder_.has(std::string(effect) + ".csv"));
    const Outcome out = hysteron(folder_.path(), {"run", std::string(effect) + "/final.json", "--data", "both.csv",
                                                  "-o", std::string(effect) + ".run"});
    EXPECT_EQ(out.code, 0) << out.err;
  }
  const auto trace = [&](const char* effect) {
    return columns_of(folder_.read(std::string(effect) + ".run/traces/both.csv")).at("sensor");
  };
  const auto lag = trace("amplifier_lag"), delay = trace("dead_time");
  ASSERT_EQ(lag.size(), delay.size());
  double sum = 0;
  for (std::size_t k = 0; k < lag.size(); ++k) sum += std::pow(lag[k] - delay[k], 2);
  const double noise = result("both")["facts"]["noise"].at(0)["white_rms"].get<double>();  // [um]
  EXPECT_NEAR(noise, 0.005, 5e-4);
  const double apart = std::sqrt(sum / static_cast<double>(lag.size())) / noise;
  EXPECT_NEAR(apart / e["separation"].get<double>(), 1, 0.1);
}

TEST_F(DiscoverVerb, AnExperimentThatCannotBeWrittenIsToldBeforeTheSearch) {
  const auto refused = [&](const std::string& file) {
    const Outcome out = hysteron(
        folder_.path(), {"discover", "diagram.json", "--data", "dataset.json", "--experiment", file, "-o", "out"});
    EXPECT_EQ(out.code, 2) << out.out;
    EXPECT_FALSE(folder_.has("out")) << file;
    return out.err;
  };
  EXPECT_NE(refused("nowhere/drive.csv").find("there is no folder nowhere"), std::string::npos);
  EXPECT_NE(refused("drive.txt").find("does not end in .csv"), std::string::npos);
  const std::string recording = folder_.read("a.csv");
  EXPECT_NE(refused("a.csv").find("holds no experiment"), std::string::npos);
  EXPECT_EQ(folder_.read("a.csv"), recording);
}

TEST_F(DiscoverVerb, WhereNoExperimentIsAskedForNoneIsWritten) {
  record(1);
  const Outcome out = hysteron(folder_.path(), {"diagnose", "diagram.json", "--data", "dataset.json", "--only",
                                                "amplifier_lag", "--experiment", "drive.csv", "-o", "out"});
  EXPECT_EQ(out.code, 0) << out.err;
  EXPECT_NE(out.out.find("No experiment is asked for: drive.csv was not written."), std::string::npos) << out.out;
  EXPECT_FALSE(folder_.has("drive.csv"));
}

TEST_F(DiscoverVerb, KeepsTheModelsThatWereFittedAndWritesOverNothingElse) {
  record(3, 0.02);
  const auto kept = [&](const std::string& file) {
    return hysteron(folder_.path(), {"discover", "diagram.json", "--data", "dataset.json", "--only", "amplifier_lag",
                                     "--keep-table", file, "-o", "out"});
  };
  const std::string data = folder_.read("dataset.json");
  const Outcome over = kept("dataset.json");
  EXPECT_EQ(over.code, 2);
  EXPECT_NE(over.err.find("holds no table of models"), std::string::npos) << over.err;
  EXPECT_EQ(folder_.read("dataset.json"), data);
  for (int twice = 0; twice < 2; ++twice) ASSERT_EQ(kept("table.json").code, 0);
  int chosen = 0, nulls = 0;
  const json table = json::parse(folder_.read("table.json"));
  for (const auto& m : table.at("models")) {
    chosen += m["chosen"].get<bool>();
    nulls += m["effect"] == "" && m["step"] == 1;
    for (const auto& l : m["left"]) {
      // Half the mean square of the change from row to row is no more than twice the mean square: |a - b|^2 / 2 of any
      // two is at most a^2 + b^2, and each row stands in two.
      double sum = 0;
      for (const double s : l["squares"]) sum += s;
      EXPECT_LE(l["scatter"].get<double>() * (l["rows"].get<double>() - 1), 2 * sum);
      EXPECT_GT(sum, 0);
    }
  }
  EXPECT_EQ(chosen, 1);
  EXPECT_GE(nulls, 1);
}

TEST_F(DiscoverVerb, StructuresThatCompetedSayWhatTheyTakeAwayAndWhyTheyDoNotCount) {
  record(3, 0.02);
  const json structures = looked_for_a_lag()["facts"]["structures"];
  ASSERT_FALSE(structures.empty());
  for (const auto& s : structures) {
    EXPECT_FALSE(s["told"]) << s["kind"];
    EXPECT_FALSE(s["reason"].get<std::string>().empty()) << s["kind"];
    EXPECT_TRUE(s["fall_validate"].is_number()) << s["kind"];
    EXPECT_EQ(s["left_by"], "base") << s["kind"];
  }
  record(1);
  EXPECT_TRUE(looked_for_a_lag()["facts"]["structures"].empty()) << "only noise is left: none is looked for";
}

TEST_F(DiscoverVerb, DiscoverSaysFirstOfAllThatARowIsFarFromAllOthers) {
  record(1);
  std::string rows;
  int row = 0;
  std::istringstream file(folder_.read("a.csv"));
  for (std::string line; std::getline(file, line); ++row)
    rows += (row == 100 ? line.substr(0, line.rfind(',')) + ",-32768" : line) + "\n";
  ASSERT_GT(row, 200);
  folder_.write("a.csv", rows);
  looked_for_a_lag();
  const std::string headline = result("out")["headline"];
  EXPECT_TRUE(headline.starts_with("First of all, a.csv: 1 row of ")) << headline;
  EXPECT_NE(headline.find("Remove it from the file"), std::string::npos) << headline;
}

TEST_F(DiscoverVerb, WhoeverWasTriedSaysByHowMuchItsScoreIsAboveOrBelow) {
  record(3, 0.02);
  const auto searched = [&](const std::string& verb, std::vector<std::string> words) {
    std::vector<std::string> all{verb, "diagram.json", "--data", "dataset.json", "-o", verb + ".out"};
    all.insert(all.end(), words.begin(), words.end());
    return hysteron(folder_.path(), all);
  };
  for (const char* verb : {"discover", "diagnose"}) {
    const Outcome found = searched(verb, {"--only", "amplifier_lag,calibration"});
    ASSERT_EQ(found.code, 0) << found.err;
    const json facts = result(verb + std::string(".out"))["facts"];
    EXPECT_EQ(facts["effects"].at(0), "amplifier_lag") << verb;
    const json& first = facts["candidates"].at(0);
    EXPECT_NE(first["reason"].get<std::string>().find("score"), std::string::npos) << verb;
    EXPECT_GT(first["score"].get<double>(), 10) << verb;
    EXPECT_GT(first["fall_validate"].get<double>(), 10) << verb;
  }
  const Outcome cut = searched("discover", {"--within", "1 us"});
  EXPECT_EQ(cut.code, 0) << cut.err;
  EXPECT_TRUE(result("discover.out")["facts"]["effects"].empty()) << "nobody was asked";
}

TEST_F(DiscoverVerb, DiscoverEndsWithinTheTimeThatItIsGivenAndSaysSo) {
  record(3, 0.02);
  const auto discovered = [&](const std::string& within) {
    return hysteron(folder_.path(),
                    {"discover", "diagram.json", "--data", "dataset.json", "--within", within, "-o", "out"});
  };
  const Outcome cut = discovered("1 us");
  EXPECT_EQ(cut.code, 0) << cut.err;
  EXPECT_NE(cut.out.find("Ended by --within 1 us"), std::string::npos) << cut.out;
  const std::string headline = result("out").at("headline");
  EXPECT_NE(headline.find("before the search was stopped"), std::string::npos) << headline;
  EXPECT_TRUE(result("out").at("facts").at("effects").empty());
  const auto find_lag = discovered("10 min");
  EXPECT_EQ(find_lag.code, 0) << find_lag.err;
  EXPECT_FALSE(result("out").at("facts").at("effects").empty()) << "there is something to be found";
  EXPECT_EQ(find_lag.out.find("Ended by"), std::string::npos) << find_lag.out;
  EXPECT_EQ(find_lag.out.find("search was stopped"), std::string::npos) << find_lag.out;
  const Outcome wrong = discovered("3 V");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("is no time"), std::string::npos) << wrong.err;
  const Outcome check = hysteron(folder_.path(), {"discover", "diagram.json", "--data", "dataset.json", "--check",
                                                  "--within", "1 min", "-o", "out"});
  EXPECT_EQ(check.code, 2);
  EXPECT_NE(check.err.find("leave out --within"), std::string::npos) << check.err;
}

TEST_F(DiscoverVerb, DiscoverCheckHoldsWhatIsFreeAndSaysItToPrograms) {
  record(1);
  // 5 % less than the recordings have, though free: a plain discovery fits it, a check does not.
  const std::vector<std::string> words{"discover", "diagram.json", "--data",          "dataset.json", "--check",
                                       "--json",   "--set",        "gain=1.425 um/V", "-o",           "out"};
  const Outcome moved = hysteron(folder_.path(), words);
  EXPECT_EQ(moved.code, 1) << moved.out << moved.err;
  EXPECT_TRUE(moved.out.starts_with("{")) << moved.out;
  for (const char* said : {"\"explained\": false", "\"parameters_moved\": true", "\"parameters\"", "(was 1.425)"})
    EXPECT_NE(moved.out.find(said), std::string::npos) << said << " in " << moved.out;
  EXPECT_TRUE(folder_.has("out/result.json"));
}

TEST_F(DiscoverVerb, DiscoverSaysWhoElseItMayBeToProgramsAndWhichEffectsItHeld) {
  record(3, 0.02);
  const Outcome added = hysteron(folder_.path(), {"add", "creep", "diagram.json", "-o", "with_creep.json"});
  ASSERT_EQ(added.code, 0) << added.err;
  const std::vector<std::string> words{"discover", "with_creep.json",         "--data", "dataset.json",
                                       "--only",   "amplifier_lag,dead_time", "--json", "-o",
                                       "out"};
  const Outcome out = hysteron(folder_.path(), words);
  ASSERT_EQ(out.code, 0) << out.err;
  const json answer = json::parse(out.out);
  ASSERT_EQ(answer["ties"].size(), answer["effects"].size()) << out.out;
  std::set<std::string> held;
  for (const auto& w : answer["warnings"])
    if (const auto text = w.get<std::string>(); text.find("creep stands in the diagram") != std::string::npos)
      held.insert(text);
  EXPECT_EQ(held.size(), 1U) << out.out;
  EXPECT_NE(held.begin()->find("--free"), std::string::npos);
}

TEST_F(DiscoverVerb, DiscoverHoldsTheErrorAgainstWhatTheDeviceRepeatsTo) {
  record(5, 0.02);
  const json all = looked_for_a_lag();
  const json& floor = all["facts"]["floor"][0];
  // Six periods of a law that repeats exactly: what differs is the noise of 5 nm. The least of two recordings with some
  // 400 rows each: a standard deviation is good to 1/sqrt(2 * 400) = 3.5 %, three of these.
  EXPECT_NEAR(floor["repeatability_rms"].get<double>(), 0.005, 0.1 * 0.005) << floor;
  EXPECT_NE(floor["repeats"].get<std::string>().find("periods in"), std::string::npos);
  EXPECT_TRUE(floor_labels(all).contains("repeatability"));
}

TEST_F(DiscoverVerb, DiscoverHoldsTheErrorAgainstTheNoiseWhereNothingWasRecordedTwice) {
  record(5, 0.02);
  std::string data = folder_.read("dataset.json");
  data.replace(data.find("\"train\""), 7, R"("train", "until": "0.48 s")");  // a period lasts 0.5 s
  data.replace(data.find("\"validate\""), 10, R"("validate", "until": "0.4 s")");
  folder_.write("dataset.json", data);
  const json all = looked_for_a_lag();
  EXPECT_EQ(floor_labels(all), std::set<std::string>{"noise of the sensor"});
  EXPECT_FALSE(all["facts"]["floor"][0].contains("repeatability_rms"));
  EXPECT_NE(folder_.read("out/report.html").find("Nothing was recorded twice"), std::string::npos);
}

TEST_F(DiscoverVerb, DiscoverGivesEachOutputInItsOwnUnit) {
  record(3, 0.02);
  // The same law read as a speed: alike but for the unit and the noise.
  for (const char* file : {"a.csv", "b.csv"}) {
    std::istringstream y(folder_.read(file)), s(lab::noisy_recording(file[0] == 'a' ? 11 : 12, 0.02));
    std::string text, row, other;
    while (std::getline(y, row) && std::getline(s, other))
      text += row + (text.empty() ? ",s [mm/s]" : other.substr(other.rfind(','))) + "\n";
    folder_.write(file, text);
  }
  folder_.write("diagram.json",
                R"json({"format": 1, "title": "Stage and speed", "inputs": {"u": {"unit": "V"}}, "blocks": {
    "actuator": {"type": "gain", "gain": "1.5 um/V", "in": "u"},
    "sensor":   {"type": "calibration", "gain": 1, "offset": "0.2 um", "in": "actuator"},
    "speed":    {"type": "gain", "gain": "1.5 mm/(s V)", "in": "u"},
    "meter":    {"type": "calibration", "gain": 1, "offset": "0.2 mm/s", "in": "speed"}},
    "outputs": {"y": "sensor", "s": "meter"}})json");
  folder_.write("dataset.json", R"({"format": 1, "title": "two outputs", "columns": {"u": {"to": "u"},
    "y": {"to": "y", "noise": "5 nm"}, "s": {"to": "s", "noise": "0.005 mm/s"}},
    "recordings": [{"file": "a.csv", "role": "train"}, {"file": "b.csv", "role": "validate"}]})");
  const json all = looked_for_a_lag();
  const json &given = all["facts"]["as_given"], &last = all["facts"]["final"];
  EXPECT_FALSE(given.contains("rms_validate")) << "um and mm/s have no rms in common";
  std::map<std::string, json> of;
  for (const auto& o : given["outputs"])
    if (o["role"] == "validate") of[o["output"]] = o;
  EXPECT_EQ(of["y"]["unit"], "um");
  EXPECT_EQ(of["s"]["unit"], "mm/s");
  // 1.5 um/V * 8 V/s * 20 ms = 0.24 um behind on the slopes, less at the turns.
  EXPECT_NEAR(of["y"]["rms"].get<double>(), of["s"]["rms"].get<double>(), 0.005);
  EXPECT_GT(of["s"]["rms"].get<double>(), 0.1);
  for (const auto& r : last["recordings"]) EXPECT_EQ(r["unit"], r["output"] == "s" ? "mm/s" : "um") << r;
  const std::string headline = all["headline"];
  EXPECT_NE(headline.find(" nm, s: "), std::string::npos) << headline;
  EXPECT_NE(headline.find(" um/s)."), std::string::npos) << headline;
  EXPECT_EQ(headline.find("(0 um"), std::string::npos) << headline;
}

TEST_F(DiscoverVerb, DiscoverTellsWhatTheTestRecordingsSay) {
  record(5, 0.02);
  folder_.write("c.csv", lab::noisy_recording(9, 0.02));
  std::string data = folder_.read("dataset.json");
  data.replace(data.find("\"validate\"}"), 11, R"("validate"}, {"file": "c.csv", "role": "test"})");
  folder_.write("dataset.json", data);
  const json all = looked_for_a_lag();
  // What is left is the noise of 5 nm; 600 rows tell it to 1/sqrt(1200) = 3 %, four of these.
  EXPECT_NEAR(all["facts"]["final"]["rms_test"].get<double>(), 0.005, 0.12 * 0.005);
  std::string said;
  for (const auto& s : all["sentences"]) said += s.get<std::string>() + "\n";
  EXPECT_NE(said.find("On the test recordings, read once at the end: "), std::string::npos) << said;
  EXPECT_NE(folder_.read("out/report.html").find("read once, at the end (test)"), std::string::npos);
  record(5, 0.02);
  const json without = looked_for_a_lag();
  for (const auto& s : without["sentences"])
    EXPECT_EQ(s.get<std::string>().find("test recordings"), std::string::npos) << "there are none";
}

TEST_F(DiscoverVerb, DiscoverShowsWhenWhatNoEffectExplainsIsThere) {
  record(1);
  // Levels of +- 50 nm that change at times of their own.
  const std::set<int> at{31, 77, 92, 170, 201, 290, 333, 341, 420, 487, 555};
  for (const char* file : {"a.csv", "b.csv"}) {
    std::istringstream in(folder_.read(file));
    std::string text, row;
    std::getline(in, text);
    text += "\n";
    double level = 0.05;
    for (int k = 0; std::getline(in, row); ++k) {
      if (at.contains(k + (file[0] == 'a' ? 7 : 0))) level = -level;
      const auto comma = row.rfind(',') + 1;
      text += row.substr(0, comma) + std::to_string(std::stod(row.substr(comma)) + level) + "\n";
    }
    folder_.write(file, text);
  }
  const json all = looked_for_a_lag();
  ASSERT_EQ(all["verdict"], "unexplained") << all["headline"];
  EXPECT_GE(all["sentences"].size(), 3U);
  json shown, next;
  for (const auto& s : all["sections"]) {
    if (s["title"] == "What no effect explains") shown = s;
    if (s["title"] == "What to record next") next = s;
  }
  ASSERT_FALSE(shown.is_null());
  EXPECT_EQ(shown["tables"][0]["columns"], json({"recording", "used", "jumps", "at [s]"}));
  EXPECT_EQ(shown["tables"][0]["rows"][1][0], "b.csv");
  EXPECT_EQ(shown["tables"][0]["rows"][1][2], "11");
  EXPECT_TRUE(shown["tables"][0]["rows"][1][3].get<std::string>().starts_with("0.155, 0.385, 0.46, "));  // 5 ms a row
  EXPECT_EQ(shown["figures"][0]["curves"][1]["name"], "jumps");
  EXPECT_EQ(shown["figures"][0]["curves"][1]["x"].size(), 22U) << "the rows before and behind each";
  EXPECT_EQ(next["text"].dump().find("No further experiment is needed"), std::string::npos) << next["text"];
  EXPECT_NE(next["text"].dump().find("every input held"), std::string::npos) << next["text"];
}

}  // namespace
}  // namespace hysteron
