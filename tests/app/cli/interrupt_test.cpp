// A verb that is told to end (SIGTERM, Ctrl-C) ends, whatever it is at, with code 130 and whole files or none. The work
// of these tests would last for hours: that they end is what is tested.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "tests/app/lab_test.h"

namespace hysteron {
namespace {

using process::Folder;
using process::hysteron_terminated;
using process::Outcome;
using Words = std::vector<std::string>;

/// A loop through hysteresis at 50 Hz, and recordings of it in which twenty minutes lie between two rows.
void write_endless(const Folder& folder) {
  folder.write("loop.json", R"({"format": 1, "title": "loop", "inputs": {"u": {"unit": "V"}}, "blocks": {
    "wave": {"type": "sine", "amplitude": "3 V", "frequency": "50 Hz"},
    "both": {"type": "sum", "in": ["u", "wave"]},
    "error": {"type": "sum", "signs": "+-", "in": ["both", "back"]},
    "law": {"type": "bouc_wen", "alpha": "0.6 um/V", "beta": "0.24 1/V", "gamma": "0.02 1/V", "d_p": "1.6 um/V",
            "in": "error"},
    "stage": {"type": "lag", "times": {"value": [1], "unit": "ms"}, "in": "law"},
    "back": {"type": "gain", "gain": "0.5 V/um", "in": "stage"}},
    "outputs": {"y": "stage"}, "record": ["stage"], "simulate": {"until": "5e4 s", "every": "1e3 s"}})");
  folder.write("alone.json", R"({"format": 1, "title": "alone", "blocks": {
    "wave": {"type": "sine", "amplitude": "3 V", "frequency": "50 Hz"},
    "law": {"type": "bouc_wen", "alpha": "0.6 um/V", "beta": "0.24 1/V", "gamma": "0.02 1/V", "d_p": "1.6 um/V",
            "in": "wave"}},
    "outputs": {"y": "law"}, "record": ["law"], "simulate": {"until": "5e4 s", "every": "1e3 s"}})");
  std::string rows = "t [s],u [V],y [um]\n";
  for (int k = 0; k < 40; ++k)
    rows += std::to_string(1200 * k) + "," + std::to_string(k % 3) + "," + std::to_string(k % 5) + "\n";
  folder.write("a.csv", rows);
  folder.write("b.csv", rows);
  folder.write("dataset.json", R"({"format": 1, "title": "hours", "columns": {"u": {"to": "u"},
    "y": {"to": "y", "noise": {"white": "10 nm"}}},
    "recordings": [{"file": "a.csv", "role": "train"}, {"file": "b.csv", "role": "validate"}]})");
  folder.write("job.json", R"({"format": 1, "do": "study", "title": "stage", "diagram": "alone.json",
    "until": "5e4 s", "every": "1e3 s",
    "sample": {"method": "uniform", "seed": 5, "draws": 100, "shards": 4,
               "parameters": {"law.alpha": {"from": "0.4 um/V", "to": "0.8 um/V"}}},
    "features": {"stroke": {"take": "stroke", "of": "law"}}})");
}

const std::vector<Words>& long_runs() {
  static const std::vector<Words> all{
      {"run", "alone.json", "-o", "out"},
      {"compare", "loop.json", "--data", "dataset.json", "-o", "out"},
      {"fit", "loop.json", "--data", "dataset.json", "--free", "law.alpha", "-o", "out"},
      {"diagnose", "loop.json", "--data", "dataset.json", "-o", "out"},
      {"discover", "loop.json", "--data", "dataset.json", "-o", "out"},
      {"discover", "loop.json", "--data", "dataset.json", "--check", "-o", "out"},
      {"inspect", "dataset.json", "--diagram", "loop.json", "-o", "out"},
      {"linearize", "alone.json", "--at", "5e4 s", "--from", "wave", "--to", "law"},
      {"study", "job.json", "-o", "out"},
      {"reproduce", "all", "--from", HYSTERON_SOURCE_DIR "/diagrams", "-o", "out"}};
  return all;
}

void expect_whole_or_absent(const Folder& folder) {
  if (!folder.has("out") || folder.has("out/shards/study.txt")) return;  // a study goes on from there
  EXPECT_TRUE(folder.has("out/result.json"));
  EXPECT_TRUE(folder.has("out/report.html"));
}

TEST(Interrupt, EveryVerbEndsWhenItIsToldTo) {
  for (const auto& words : long_runs()) {
    SCOPED_TRACE(words.front());
    const Folder folder;
    write_endless(folder);
    const Outcome outcome = hysteron_terminated(folder.path(), words, 700);
    EXPECT_EQ(outcome.code, 130) << outcome.out << outcome.err;
    EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
    expect_whole_or_absent(folder);
  }
}

class InterruptInALab : public LabTest {};

/// What is told of a search: at first that nothing was found, then what was.
TEST_F(InterruptInALab, AFitThatIsInterruptedEarlySaysSoAndNothingOfTheModel) {
  record(1);
  folder_.write("stage.json", R"({"format": 1, "inputs": {"u": {"unit": "V"}}, "blocks": {
    "lag": {"type": "lag", "times": {"value": [5], "unit": "ms"}, "in": "u"},
    "sensor": {"type": "calibration", "gain": "1.5 um/V", "offset": "0.2 um", "in": "lag"}},
    "outputs": {"y": "sensor"}})");
  for (int after = 10; after <= 250; after += 12) {
    const Outcome outcome = hysteron_terminated(folder_.path(),
                                                {"fit", "stage.json", "--data", "dataset.json", "--free", "lag.times",
                                                 "--free", "sensor.gain", "--starts", "400", "-o", "out"},
                                                after);
    // 143: before the program had begun to watch for signals.
    EXPECT_TRUE(outcome.code == 130 || outcome.code == 0 || outcome.code == 143) << outcome.code << outcome.err;
    EXPECT_EQ(outcome.err.find("no start"), std::string::npos) << outcome.err;
  }
}

/// At random instants: worst time to end is printed, for people.
TEST(LongInterrupt, EveryVerbEndsAtWhateverInstantItIsToldTo) {
  std::mt19937 random(11);
  double worst = 0;
  for (int round = 0; round < 20; ++round)
    for (const auto& words : long_runs()) {
      const Folder folder;
      write_endless(folder);
      const int after = std::uniform_int_distribution(30, 3000)(random);
      const auto begun = std::chrono::steady_clock::now();
      const Outcome outcome = hysteron_terminated(folder.path(), words, after);
      const double ended =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count() - 1e-3 * after;
      if (ended > worst) {
        worst = ended;
        std::printf("%s ended %.2f s after SIGTERM at %d ms\n", words.front().c_str(), ended, after);
      }
      EXPECT_TRUE(outcome.code == 130 || outcome.code == 143) << words.front() << outcome.code << outcome.err;
      expect_whole_or_absent(folder);
    }
}

}  // namespace
}  // namespace hysteron
