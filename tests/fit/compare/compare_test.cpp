#include "fit/compare/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/inspect/delay.h"
#include "tests/fit/lab.h"

namespace hysteron {
namespace {

double drive(double t) { return 5 - 5 * std::cos(2 * std::numbers::pi * 0.7 * t + 0.3 * t * t); }

ProgramPointer gain_program() {
  Diagram d = lab::diagram("g");
  lab::add(d, "g", "gain", "u").parameters["gain"] = "1 um/V";
  return compile(d, lab::registry());
}

DataSet recordings(const std::vector<double>& steps) {
  DataSet data;
  data.notes["y"].to = "y";
  data.notes["y"].noise.white = 1e-9;
  data.notes["y"].noise.one_over_f = 0.0;
  for (std::size_t k = 0; k < steps.size(); ++k)
    data.recordings.push_back(lab::recording("r" + std::to_string(k), k == 0 ? Role::train : Role::validate, steps[k],
                                             static_cast<std::size_t>(6 / steps[k]), drive));
  return data;
}

Prediction predict_all(DataModel& model) {
  std::vector<int> all;
  for (int r = 0; r < model.n_recordings(); ++r) all.push_back(r);
  return model.predict({}, all);
}

TEST(Compare, IsDoneOnExactlyTheJudgedRows) {
  DataSet data = recordings({0.01});
  const auto program = gain_program();
  lab::measure(data, program, 0, 1);
  auto& r = data.recordings[0];
  r.first = 100;
  r.last = 300;
  for (std::size_t i = 0; i < r.t.size(); ++i)
    r.columns["y"][i] += i < 100 || i >= 300 ? 1.0 : 2e-9;  // far off where nobody judges
  DataModel model(program, lab::shared(data));
  const Judge judge(model, noise_before_fit(model));
  const auto c = compare(model, judge, predict_all(model));
  ASSERT_NE(c.find(0, 0), nullptr);
  EXPECT_EQ(c.find(0, 0)->rows, 200U);
  EXPECT_NEAR(c.find(0, 0)->rms, 2e-9, 1e-15);
}

TEST(Compare, SplitsByATemperatureThatTheRecordingsHave) {
  DataSet data = recordings({0.01});
  const auto program = gain_program();
  lab::measure(data, program, 0, 1);
  auto& r = data.recordings[0];
  r.first = 100;  // a column is cut as the residual is
  for (std::size_t i = 0; i < r.t.size(); ++i) {
    r.columns["room"].push_back(i < 400 ? 293.15 : 298.15);
    r.columns["idle"].push_back(1.0);
    r.columns["y"][i] += i < 400 ? 0 : 1e-7;
  }
  r.units["room"] = parse_unit("degC");
  DataModel model(program, lab::shared(data));
  const Judge judge(model, noise_before_fit(model));
  const auto c = compare(model, judge, predict_all(model));
  int found = 0;
  for (const auto& split : c.splits.at(0).splits) {
    EXPECT_EQ(split.title.find("idle"), std::string::npos);
    if (split.variable != "temperature") continue;
    ++found;
    EXPECT_NEAR(split.parts.back().error, 1, 1e-12);
    EXPECT_NEAR(split.parts.back().rows, 0.4, 1e-12);  // 200 of 500 judged rows
  }
  EXPECT_EQ(found, 1);
  for (std::size_t i = 1; i < c.sentences.size(); ++i)
    for (std::size_t k = i + 1; k < c.sentences.size(); ++k) EXPECT_NE(c.sentences[i], c.sentences[k]);
}

TEST(Compare, TheTotalOfSeveralRecordingsWeighsEveryRowAlike) {
  DataSet data = recordings({0.01, 0.02});
  const auto program = gain_program();
  lab::measure(data, program, 0, 2);
  for (double& y : data.recordings[0].columns["y"]) y += 3e-9;
  for (double& y : data.recordings[1].columns["y"]) y += 6e-9;
  data.recordings[1].role = Role::train;
  DataModel model(program, lab::shared(data));
  const Judge judge(model, noise_before_fit(model));
  const auto c = compare(model, judge, predict_all(model));
  // 600 rows of 3 nm and 300 of 6 nm.
  EXPECT_NEAR(c.find(Role::train, 0)->rms, std::sqrt((600 * 9 + 300 * 36) / 900.0) * 1e-9, 1e-15);
  EXPECT_EQ(c.find(Role::train, 0)->rows, 900U);
  EXPECT_EQ(c.find(Role::validate, 0), nullptr);
}

TEST(Compare, AZeroPerRecordingIsShownAndTakenOff) {
  DataSet data = recordings({0.01, 0.02});
  data.notes["y"].zero_per_recording = true;
  const auto program = gain_program();
  lab::measure(data, program, 1e-9, 3);
  for (double& y : data.recordings[1].columns["y"]) y += 6e-6;
  DataModel model(program, lab::shared(data));
  const Judge judge(model, noise_before_fit(model));
  const auto c = compare(model, judge, predict_all(model));
  EXPECT_NEAR(c.zeros[1][0], 6e-6, 1e-9);
  EXPECT_NEAR(c.find(1, 0)->rms, 1e-9, 2e-10);
}

TEST(Compare, ADelayThatIsNotedIsNoError) {
  DataSet data = recordings({0.01});
  const auto program = gain_program();
  lab::measure(data, program, 0, 4);
  auto& y = data.recordings[0].columns["y"];
  const double first = y.front();
  y.insert(y.begin(), 2, first);  // two rows late
  y.resize(data.recordings[0].t.size());
  data.notes["y"].delay_samples = 2;
  DataModel model(program, lab::shared(data));
  const Judge judge(model, noise_before_fit(model));
  EXPECT_NEAR(compare(model, judge, predict_all(model)).find(0, 0)->rms, 0, 1e-18);
}

TEST(Compare, ANotedDelayInSecondsReadsTheModelBetweenTheRows) {
  DataSet data = recordings({0.01});
  const auto program = gain_program();
  auto& r = data.recordings[0];
  // The drive is the straight line between its rows, so the value 4 ms earlier is 0.6 of this row and 0.4 of the one
  // before.
  const auto& u = r.columns["u"];
  for (std::size_t i = 0; i < u.size(); ++i) r.columns["y"][i] = 1e-6 * (i == 0 ? u[0] : 0.6 * u[i] + 0.4 * u[i - 1]);
  data.notes["y"].delay_seconds = 0.004;
  DataModel model(program, lab::shared(data));
  const Judge judge(model, noise_before_fit(model));
  EXPECT_LT(compare(model, judge, predict_all(model)).find(0, 0)->peak, 1e-18);
}

/// A copy of the data whose y is late by `seconds` plus `samples` rows.
DataSet late(DataSet data, double seconds, double samples) {
  for (auto& r : data.recordings) {
    const double step = r.t[1] - r.t[0];
    for (std::size_t i = 0; i < r.t.size(); ++i)
      r.columns["y"][i] = 1e-6 * drive(std::max(0.0, r.t[i] - seconds - samples * step));
    lab::Noise random(9);
    for (double& y : r.columns["y"]) y += 1e-9 * random();
    r.first = 10;
  }
  return data;
}

DelayFinding delay_of(const DataSet& data) {
  DataModel model(gain_program(), lab::shared(data));
  const Judge judge(model, noise_before_fit(model));
  return find_delays(model, judge, predict_all(model)).front();
}

TEST(Delay, TheSameNumberOfSamplesAtDifferentRatesIsAFactOfTheData) {
  const auto f = delay_of(late(recordings({0.01, 0.004}), 0, 1));
  EXPECT_EQ(f.kind, DelayKind::samples);
  EXPECT_NEAR(f.samples, 1, 0.02);
  EXPECT_NE(f.sentence.find("\"delay\": \"1 sample\""), std::string::npos) << f.sentence;
}

TEST(Delay, TheSameTimeAtDifferentRatesIsADeadTime) {
  const auto f = delay_of(late(recordings({0.01, 0.004}), 0.01, 0));
  EXPECT_EQ(f.kind, DelayKind::seconds);
  EXPECT_NEAR(f.seconds, 0.01, 3e-4);
  EXPECT_NE(f.sentence.find("dead time"), std::string::npos) << f.sentence;
}

TEST(Delay, WithOneRateItIsATie) {
  const auto f = delay_of(late(recordings({0.01, 0.01}), 0.01, 0));
  EXPECT_EQ(f.kind, DelayKind::tie);
  EXPECT_NEAR(f.samples, 1, 0.02);
}

TEST(Delay, NoneIsFoundWhereThereIsNone) {
  const auto f = delay_of(late(recordings({0.01, 0.004}), 0, 0));
  EXPECT_EQ(f.kind, DelayKind::none);
  EXPECT_EQ(f.sentence, "");
}

TEST(Delay, AWrongGainIsNotADelay) {
  DataSet data = late(recordings({0.01, 0.004}), 0, 0);
  for (auto& r : data.recordings)
    for (double& y : r.columns["y"]) y *= 1.2;
  EXPECT_EQ(delay_of(data).kind, DelayKind::none);
}

}  // namespace
}  // namespace hysteron
