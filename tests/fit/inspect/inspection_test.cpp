// A data set inspected against a diagram: what was spoilt is told, what is sound is not suspected.
#include "fit/inspect/inspection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fit/lab.h"

namespace hysteron {
namespace {

ProgramPointer program_of(const std::string& type) {
  Diagram d = lab::diagram("g");
  lab::add(d, type == "gain" ? "g" : "lag", type == "gain" ? "gain" : "lag", "u");
  if (type == "gain") {
    d.blocks["g"].parameters["gain"] = "1 um/V";
  } else {
    d.blocks["lag"].parameters["times"] = NumberList{Number{5, "ms"}};
    lab::add(d, "g", "gain", "lag").parameters["gain"] = "1 um/V";
  }
  return compile(d, lab::registry());
}

/// Noise through a filter of some rows: a broad drive that never repeats.
lab::Signal broad(unsigned seed, double step, std::size_t rows) {
  auto values = std::make_shared<std::vector<double>>();
  lab::Noise random(seed);
  double u = 0;
  for (std::size_t i = 0; i <= rows; ++i) values->push_back(u = 0.9 * u + random());
  return [values, step](double t) { return (*values)[static_cast<std::size_t>(std::lround(t / step))]; };
}

DataSet data_set(const ProgramPointer& program, std::size_t rows, const std::vector<lab::Signal>& drives,
                 Between between = Between::linear) {
  DataSet data;
  data.notes["u"].to = "u";
  data.notes["u"].between = between;
  data.notes["y"].to = "y";
  for (std::size_t k = 0; k < drives.size(); ++k)
    data.recordings.push_back(
        lab::recording("r" + std::to_string(k), k == 0 ? Role::train : Role::validate, 1e-3, rows, drives[k]));
  lab::measure(data, program, 2e-9, 7);
  return data;
}

Inspection inspected(const ProgramPointer& program, const DataSet& data) {
  DataModel model(program, lab::shared(data));
  return inspect(model);
}

bool tells(const std::vector<std::string>& list, const std::string& words) {
  return std::any_of(list.begin(), list.end(), [&](const auto& s) { return s.find(words) != std::string::npos; });
}

class Inspecting : public testing::Test {
 protected:
  ProgramPointer gain_ = program_of("gain");
  DataSet data_ = data_set(gain_, 5000, {broad(1, 1e-3, 5000), broad(2, 1e-3, 5000)});
  Rows& y(std::size_t r) { return data_.recordings[r].columns["y"]; }
};

TEST_F(Inspecting, WhatIsJudgedBeyondAllThatIsFittedIsTold) {
  const auto sine = [](double top) {
    return [top](double t) { return top * (1 - std::cos(2 * std::numbers::pi * 3 * t)) / 2; };
  };
  const std::string note = "r1 moves u over 0 .. 6 V, the train recordings only over 0 .. 5 V";
  EXPECT_TRUE(tells(inspected(gain_, data_set(gain_, 1000, {sine(5), sine(6), sine(5.2)})).notes, note));
  EXPECT_FALSE(tells(inspected(gain_, data_set(gain_, 1000, {sine(6), sine(5)})).notes, "extrapolated"));
  EXPECT_FALSE(tells(inspected(gain_, data_set(gain_, 1000, {sine(5), sine(5.4)})).notes, "extrapolated"))
      << "8 % further is no other place";
}

TEST_F(Inspecting, AHundredThousandSoundRowsRaiseNoSuspicion) {
  const auto data = data_set(gain_, 100000, {broad(3, 1e-3, 100000)});
  const Inspection seen = inspected(gain_, data);
  EXPECT_TRUE(seen.faults.empty()) << seen.faults.front();
  EXPECT_TRUE(seen.notes.empty()) << seen.notes.front();
  EXPECT_TRUE(tells(seen.sentences, "Nothing was recorded twice"));
}

TEST_F(Inspecting, SaysWhatTheColumnsAre) {
  const Inspection seen = inspected(gain_, data_);
  ASSERT_EQ(seen.columns.size(), 2U);
  EXPECT_EQ(seen.columns[0].role, "input");
  EXPECT_EQ(seen.columns[1].role, "output");
  EXPECT_EQ(seen.columns[1].unit.text, "um");
  ASSERT_EQ(seen.recordings.size(), 2U);
  ASSERT_EQ(seen.recordings[0].drives.size(), 1U);
  EXPECT_GT(seen.recordings[0].drives[0].band.highest, 400);  // up to half of 1 kHz
  EXPECT_GT(seen.recordings[0].drives[0].reversals, 200U);    // one in some ten rows, but for those too small
}

TEST_F(Inspecting, WhatWasNotRecordedIsNoHold) {
  auto& first = data_.recordings[0];
  for (std::size_t i = 2000; i < first.t.size(); ++i) first.t[i] += 3;  // the recorder stood still for 3 s
  first.columns["u"][2000] = first.columns["u"][1999];                  // and the drive was back where it had been
  const Inspection seen = inspected(gain_, data_);
  EXPECT_TRUE(tells(seen.faults, "3000 rows missing, in 1 gap"));
  EXPECT_LT(seen.recordings[0].drives[0].hold.length, 0.1);
  EXPECT_FALSE(tells(seen.sentences, "hold 3 s")) << seen.sentences[1];
}

TEST_F(Inspecting, WhiteNoiseTurnsAtTwoRowsOfThree) {
  lab::Noise random(9);
  std::vector<double> values(4001);
  for (double& v : values) v = random();
  const auto white = [&](double t) { return values[static_cast<std::size_t>(std::lround(1000 * t))]; };
  const Inspection seen = inspected(gain_, data_set(gain_, 4000, {white}));
  // Each third row is a turn of each kind; some come back by less than 2 % of the range.
  EXPECT_NEAR(static_cast<double>(seen.recordings[0].drives[0].reversals), 2.0 / 3 * 4000, 300);
}

TEST_F(Inspecting, TellsRowsThatAreMissingRepeatedOrClipped) {
  auto& first = data_.recordings[0];
  const auto take_out = [&](auto& rows) { rows.erase(rows.begin() + 1000, rows.begin() + 1004); };
  take_out(first.t);
  for (auto& [name, rows] : first.columns) take_out(rows);
  first.last = first.t.size();
  for (double& v : y(1)) v = std::min(v, 2e-6);
  for (std::size_t i = 10; i < 4000; i += 40) y(0)[i] = y(0)[i - 1];
  const Inspection seen = inspected(gain_, data_);
  EXPECT_TRUE(tells(seen.faults, "r0: 4 rows missing, in 1 gap of its clock; the first at 1 s"));
  EXPECT_TRUE(tells(seen.faults, "y repeats the value before exactly"));
  EXPECT_TRUE(tells(seen.faults, "r1: y stays at its highest value 2 um"));
  EXPECT_EQ(seen.faults.size(), 3U);
}

TEST_F(Inspecting, TellsAnInputThatIsCutAndNoneThatIsFlatByDesign) {
  const auto sine = [](double t) { return 5 + 4 * std::sin(2 * std::numbers::pi * 8 * t); };
  const auto trapezoid = [](double t) { return std::clamp(20 * std::abs(2 * t - std::floor(2 * t + 0.5)), 0.0, 8.0); };
  const Inspection seen =
      inspected(gain_, data_set(gain_, 4000, {[&](double t) { return std::min(sine(t), 8.0); }, trapezoid}));
  ASSERT_EQ(seen.cuts.size(), 1U);
  EXPECT_EQ(seen.cuts[0].tops, 32U);  // 8 Hz for 4 s
  EXPECT_EQ(seen.cuts[0].recordings, std::vector<std::string>{"r0"});
  EXPECT_TRUE(tells(seen.notes,
                    "u may be cut at 8 V: 32 tops are flat there (in r0), though their flanks bend towards a "
                    "summit and would reach 9 V"))
      << seen.notes.front();
  EXPECT_TRUE(seen.faults.empty()) << seen.faults.front();
  EXPECT_TRUE(inspected(gain_, data_set(gain_, 4000, {sine, trapezoid})).cuts.empty());
}

TEST_F(Inspecting, TellsAnOutputThatIsOneSampleLate) {
  for (auto& r : data_.recordings) {
    auto& rows = r.columns["y"];
    rows.insert(rows.begin(), rows.front());
    rows.pop_back();
  }
  const Inspection seen = inspected(gain_, data_);
  ASSERT_EQ(seen.delays.size(), 1U);
  EXPECT_EQ(seen.delays[0].kind, DelayKind::tie);  // one rate: samples and seconds are the same
  EXPECT_NEAR(seen.delays[0].samples, 1, 0.01);
  EXPECT_TRUE(tells(seen.notes, "y comes 1 sample "));
}

TEST_F(Inspecting, TellsALineThatNoInputMakesInTheRecordingsThatHaveIt) {
  for (std::size_t r = 0; r < 2; ++r)
    for (std::size_t i = 0; i < y(r).size(); ++i)
      y(r)[i] += 1e-9 * std::sin(2 * std::numbers::pi * 0.05 * static_cast<double>(i) + static_cast<double>(r));
  const Inspection seen = inspected(gain_, data_);
  ASSERT_EQ(seen.lines.size(), 1U);
  EXPECT_NEAR(seen.lines[0].frequency, 50, 0.02);
  EXPECT_NEAR(seen.lines[0].amplitude, 1e-9, 0.2e-9);  // five times 2 nm sqrt(2 / 5000)
  EXPECT_EQ(seen.lines[0].recordings.size(), 2U);
}

TEST_F(Inspecting, ALineInOneRecordingOfTwoIsNotTold) {
  for (std::size_t i = 0; i < y(0).size(); ++i)
    y(0)[i] += 1e-9 * std::sin(2 * std::numbers::pi * 0.05 * static_cast<double>(i));
  EXPECT_TRUE(inspected(gain_, data_).lines.empty());
}

TEST_F(Inspecting, TheLineThatRoundingMakesOfARampIsNotTold) {
  const auto triangle = [](double t) { return 5 + 3 * (4 * std::abs(0.37 * t - std::floor(0.37 * t + 0.5)) - 1); };
  auto data = data_set(gain_, 4000, {triangle});
  auto& first = data.recordings[0];
  const double step = 3e-9;  // of a sensor without noise; 4.44 um/s over 3 nm: 1480 Hz and its multiples, as aliases
  for (std::size_t i = 0; i < first.t.size(); ++i)
    first.columns["y"][i] = step * std::round(1e-6 * first.columns["u"][i] / step);
  const Inspection seen = inspected(gain_, data);
  EXPECT_TRUE(seen.lines.empty()) << seen.lines[0].frequency << " Hz, " << seen.lines[0].amplitude;
}

TEST_F(Inspecting, ReadsTheFloorFromRecordingsThatWereDrivenAlike) {
  const auto data = data_set(gain_, 5000, {broad(4, 1e-3, 5000), broad(4, 1e-3, 5000)});
  const Inspection seen = inspected(gain_, data);
  ASSERT_EQ(seen.repeats.size(), 1U);
  EXPECT_EQ(seen.repeats[0].what, "r0 and r1, driven alike");
  EXPECT_NEAR(seen.repeats[0].floor.rms, 2e-9, 0.1e-9);  // 1 / sqrt(2 * 5000) = 1 %
}

TEST_F(Inspecting, KnowsAnInputThatIsSaidToBeHeldAndIsNot) {
  const auto lag = program_of("lag");
  auto data = data_set(lag, 5000, {broad(5, 1e-3, 5000), broad(6, 1e-3, 5000)});
  EXPECT_TRUE(inspected(lag, data).between.empty());
  data.notes["u"].between = Between::hold;
  const Inspection seen = inspected(lag, data);
  ASSERT_EQ(seen.between.size(), 1U);
  EXPECT_EQ(seen.between[0].given, Between::hold);
  EXPECT_EQ(seen.between[0].better, Between::linear) << "what moves smoothly is as near, and no nearer";
  EXPECT_TRUE(tells(seen.faults, "write \"between_samples\": \"linear\""));
}

TEST_F(Inspecting, KnowsAnInputThatMovesSmoothlyBetweenItsSamples) {
  const auto lag = program_of("lag");
  auto data = data_set(lag, 5000, {broad(5, 1e-3, 5000), broad(6, 1e-3, 5000)}, Between::smooth);
  EXPECT_TRUE(inspected(lag, data).between.empty());
  for (const Between said : {Between::linear, Between::hold}) {
    data.notes["u"].between = said;
    const Inspection seen = inspected(lag, data);
    ASSERT_EQ(seen.between.size(), 1U);
    EXPECT_EQ(seen.between[0].given, said);
    EXPECT_EQ(seen.between[0].better, Between::smooth);
    EXPECT_TRUE(tells(said == Between::hold ? seen.faults : seen.notes, "write \"between_samples\": \"smooth\""));
  }
}

constexpr double true_damping = 40;  // [N s/m], 5 % of the critical one

/// A mass on a spring that rings at 60 Hz, its damping free and said to be four times what it is.
ProgramPointer wrong_guess() {
  Diagram d = lab::diagram("sensor");
  lab::add(d, "drive", "gain", "u").parameters["gain"] = "1 N/V";
  auto& body = lab::add(d, "body", "mass_spring_damper", "drive").parameters;
  body["mass"] = "1 kg";
  body["stiffness"] = Value(Number{std::pow(2 * std::numbers::pi * 60, 2), "N/m"});
  DiagramParameter damping;
  damping.value = Value(Number{4 * true_damping, "N*s/m"});
  damping.lower = Number{1, "N*s/m"};
  damping.upper = Number{1e4, "N*s/m"};
  damping.free = true;
  d.parameters["damping"] = damping;
  body["damping"] = Value(Reference{"damping"});
  lab::add(d, "sensor", "gain", "body.position").parameters["gain"] = "1";
  return compile(d, lab::registry());
}

TEST_F(Inspecting, AValueThatTheUserLeftOpenSaysNothingOfTheWayBetweenSamples) {
  const auto stage = wrong_guess();
  for (const Between truth : {Between::linear, Between::hold}) {
    auto data = data_set(stage, 5000, {broad(5, 1e-3, 5000), broad(6, 1e-3, 5000)}, truth);
    lab::measure(data, stage, 2e-9, 7, {{parameter_index(*stage, "damping"), true_damping}});
    const Inspection sound = inspected(stage, data);
    EXPECT_TRUE(sound.between.empty());
    EXPECT_TRUE(sound.notes.empty()) << sound.notes.front();
    const Between other = truth == Between::hold ? Between::linear : Between::hold;
    data.notes["u"].between = other;
    const Inspection seen = inspected(stage, data);
    ASSERT_EQ(seen.between.size(), 1U);
    EXPECT_EQ(seen.between[0].better, truth);
    EXPECT_GT(seen.between[0].fall, 0.9);  // nothing but noise is left
    if (truth == Between::linear) {
      EXPECT_TRUE(tells(seen.faults, "Between samples u moves linearly"));
    }
  }
}

TEST_F(Inspecting, AtOneFrequencyAFreeLagIsWhateverHalfASampleIs) {
  const auto lag = program_of("lag");
  const auto sine = [](double t) { return std::sin(2 * std::numbers::pi * 20 * t); };
  auto data = data_set(lag, 5000, {sine, sine});
  for (auto& r : data.recordings) r.first = 100;  // how it sets in shows the lag itself
  data.notes["u"].between = Between::hold;
  // Held, the sine is later by 0.063 rad, 13 nm rms of 0.6 um, beside noise of 2 nm.
  EXPECT_EQ(inspected(lag, data).between.size(), 1U);
  DataModel model(lag, lab::shared(data));
  EXPECT_TRUE(inspect(model, {{"lag.times"}}).between.empty()) << "a lag of less than 5 ms and another gain do it, too";
}

TEST_F(Inspecting, AWrongGainIsNoFaultOfTheData) {
  for (std::size_t r = 0; r < 2; ++r)
    for (double& v : y(r)) v = 1.3 * v + 1e-6;
  const Inspection seen = inspected(gain_, data_);
  EXPECT_TRUE(seen.faults.empty());
  EXPECT_TRUE(seen.notes.empty()) << seen.notes.front();
}

TEST_F(Inspecting, DoesNotLookAtTestRecordings) {
  data_.recordings[1].role = Role::test;
  for (double& v : y(1)) v = std::min(v, 2e-6);
  const Inspection seen = inspected(gain_, data_);
  EXPECT_EQ(seen.recordings.size(), 1U);
  EXPECT_TRUE(seen.faults.empty());
}

TEST_F(Inspecting, TheFinestStepIsThatOfTheRecordingThatShowsIt) {
  for (std::size_t r = 0; r < 2; ++r)
    for (double& v : y(r)) v = 1e-8 * std::round(v / 1e-8);
  for (double& v : y(1)) v = 1e-7 * std::round(v / 1e-7);  // rests on every tenth level
  EXPECT_NEAR(finest_step(data_, "y"), 1e-8, 1e-12);
  data_.recordings[0].role = Role::test;
  EXPECT_NEAR(finest_step(data_, "y"), 1e-7, 1e-11) << "test recordings are not read";
  EXPECT_EQ(finest_step(data_, "z"), 0);
}

}  // namespace
}  // namespace hysteron
