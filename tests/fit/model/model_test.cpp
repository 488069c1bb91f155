// What a model says for many trials at once, and what it does where rows cannot be split finely enough.
#include "fit/model/model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "engine/rowwise/advance.h"
#include "tests/fit/lab.h"

namespace hysteron {
namespace {

ProgramPointer hysteretic_stage() {
  Diagram d = lab::diagram("lag");
  auto& law = lab::add(d, "law", "bouc_wen", "u");
  law.parameters["alpha"] = "0.6 um/V";
  law.parameters["beta"] = "0.3 1/V";
  law.parameters["gamma"] = "0.05 1/V";
  law.parameters["d_p"] = "1.5 um/V";
  lab::add(d, "lag", "lag", "law").parameters["times"] = NumberList{{0.05, "s"}};
  return compile(d, lab::registry());
}

TEST(DataModel, ManyTrialsSayWhatEachSaysAlone) {
  const auto program = hysteretic_stage();
  DataModel together(program, lab::shared(lab::swings(0.01, 300))), alone(program, lab::shared(lab::swings(0.01, 300)));
  const int beta = parameter_index(*program, "law.beta"), tau = parameter_index(*program, "lag.times[0]");
  std::vector<Trial> trials{{}};
  for (int i = 1; i < 7; ++i) trials.push_back({{beta, 0.3 + 0.01 * i}, {tau, 0.05 + 0.003 * i}});
  trials[3][1].value = std::numeric_limits<double>::quiet_NaN();  // lost, alone
  const std::vector<int> both{0, 1};
  alone.choose_substeps({});
  const auto predictions = together.predict_each(trials, both);
  ASSERT_EQ(predictions.size(), trials.size());
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const auto one = alone.predict(trials[i], both, false);
    EXPECT_EQ(predictions[i].ok, i != 3);
    EXPECT_EQ(predictions[i].ok, one.ok);
    EXPECT_EQ(predictions[i].error, one.error);
    EXPECT_EQ(predictions[i].y, one.y) << i;
  }
  EXPECT_EQ(together.runs(), alone.runs());
  EXPECT_EQ(together.failures(), alone.failures());
  EXPECT_TRUE(together.predict_each({}, both).empty());
}

TEST(DataModel, WithoutWorkspacesThatAreKeptItSaysTheSame) {
  const auto program = hysteretic_stage();
  DataModelOptions options;
  options.keep_workspaces = false;
  DataModel kept(program, lab::shared(lab::swings(0.01, 300))),
      given_back(program, lab::shared(lab::swings(0.01, 300)), options);
  const std::vector<int> both{0, 1};
  const auto first = kept.predict({}, both), again = kept.predict({}, both);
  EXPECT_EQ(first.y, again.y);
  // To the last bit, also where they were given back before.
  EXPECT_EQ(given_back.predict({}, both).y, first.y);
  EXPECT_EQ(given_back.predict({}, both).y, first.y);
}

TEST(DataModel, RowsThatAreJudgedAsTheyStandAreNotCopied) {
  const auto program = hysteretic_stage();
  const auto data = lab::shared(lab::swings(0.01, 300));
  const DataModel model(program, data);
  for (int r = 0; r < 2; ++r) {
    const Recording& recording = data->recordings[static_cast<std::size_t>(r)];
    EXPECT_EQ(&model.times(r), &recording.t);
    EXPECT_EQ(&model.measured(r, 0), &recording.columns.at("y"));
    EXPECT_EQ(model.shared_input(r, 0).get(), &recording.columns.at("u"));
  }
}

/// An input or an output that comes late, or rows that are not judged: rows of its own, those that were asked for.
TEST(DataModel, RowsThatComeLateOrAreLeftOutAreItsOwn) {
  const auto program = hysteretic_stage();
  DataSet late = lab::swings(0.01, 300);
  late.notes["u"].delay_samples = 2;
  const DataModel of_late(program, lab::shared(late));
  const auto& u = of_late.data().recordings[0].columns.at("u");
  const Rows rows = *of_late.shared_input(0, 0);
  ASSERT_EQ(rows.size(), u.size());
  for (std::size_t i = 0; i + 2 < u.size(); ++i) ASSERT_EQ(rows[i], u[i + 2]) << i;
  DataSet cut = lab::swings(0.01, 300);
  cut.recordings[0].first = 10;
  const DataModel of_cut(program, lab::shared(cut));
  const auto& whole = of_cut.data().recordings[0];
  EXPECT_EQ(of_cut.times(0), Rows(whole.t.begin() + 10, whole.t.end()));
  const auto& drive = whole.columns.at("u");
  EXPECT_EQ(of_cut.input(0, 0), Rows(drive.begin() + 10, drive.end()));
  const auto& y = whole.columns.at("y");
  EXPECT_EQ(of_cut.measured(0, 0), Rows(y.begin() + 10, y.end()));
  // What the model says of the rows that are left is what it says of them in the whole recording.
  DataModel all(program, lab::shared(lab::swings(0.01, 300))), part(program, lab::shared(cut));
  const std::vector<int> one{0};
  const Rows of_all = all.predict({}, one).y[0][0], of_part = part.predict({}, one).y[0][0];
  ASSERT_EQ(of_part.size() + 10, of_all.size());
  // Substeps are chosen by the rows judged: both are within the tolerance of the choice, 1e-6 of the span.
  for (std::size_t i = 0; i < of_part.size(); ++i) ASSERT_NEAR(of_part[i], of_all[i + 10], 2e-6 * all.span(0)) << i;
}

TEST(DataModel, WhatIsTooStiffForRowsIsIntegrated) {
  // A loop with a limit and a time constant of 2 us; rows of 10 ms would need thousands of steps each.
  Diagram d = lab::diagram("y");
  auto& e = lab::add(d, "e", "sum", "u");
  e.parameters["signs"] = "+-";
  e.in.push_back({"", "x"});
  auto& limited = lab::add(d, "limited", "saturation", "e");
  limited.parameters["lower"] = "-10 V";
  limited.parameters["upper"] = "10 V";
  lab::add(d, "speed", "gain", "limited").parameters["gain"] = "5e5 1/s";
  lab::add(d, "x", "integrator", "speed");
  lab::add(d, "y", "gain", "x").parameters["gain"] = "1 um/V";
  const auto program = compile(d, lab::registry());
  ASSERT_EQ(why_not_exact(*program), "");
  DataModel model(program, lab::shared(lab::swings(0.01, 60)));
  const auto prediction = model.predict({}, std::vector<int>{0});
  ASSERT_TRUE(prediction.ok) << prediction.error;
  EXPECT_NE(model.why_not_exact().find("64 substeps per row do not suffice"), std::string::npos);
  // So fast a loop follows its input: u - x = u'/(5e5/s), at most 19 V/s of it.
  const auto& r = model.recording(0);
  for (std::size_t i = 0; i < r.t.size(); ++i)
    EXPECT_NEAR(prediction.y[0][0][i], 1e-6 * r.columns.at("u")[i], 5e-11) << r.t[i];
}

ProgramPointer stage_on_a_stiffening_spring(const std::string& stiffening) {
  Diagram d = lab::diagram("y");
  lab::add(d, "force", "gain", "u").parameters["gain"] = "1 N/V";
  auto& mass = lab::add(d, "mass", "mass_on_stiffening_spring", "force");
  mass.parameters["mass"] = "1 kg";
  mass.parameters["damping"] = "40 N*s/m";
  mass.parameters["stiffness"] = "1e3 N/m";
  mass.parameters["stiffening"] = stiffening;
  lab::add(d, "y", "gain", "mass.position").parameters["gain"] = "1";
  return compile(d, lab::registry());
}

TEST(DataModel, RowsAreCutWhereTheirErrorIsMade) {
  // A slow ramp with one step. The mass rings at 5 Hz for a tenth of a second, two rows; before and behind it follows.
  DataSet data;
  data.notes["u"].to = "u";
  data.notes["y"].to = "y";
  const auto slow = [](double t) { return 0.1 * t + (t >= 5 ? 4 : 0); };
  data.recordings.push_back(lab::recording("train", Role::train, 0.05, 200, slow));
  const auto program = stage_on_a_stiffening_spring("1e8 N/m^3");
  lab::measure(data, program, 0, 20);
  DataModel model(program, lab::shared(data));
  ASSERT_TRUE(model.predict({}, std::vector<int>{0}).ok);
  EXPECT_LT(2 * model.steps(0), 200L * model.substeps(0)) << "most rows need fewer than those at the step";
  EXPECT_LT(model.cross_check({}, std::vector<int>{0})[0], 5e-6);  // 1e-6 of the span was asked for; BDF at 1e-7 a step

  // What a result needs where it differs is added to what the start needed.
  const long before = model.steps(0);
  model.choose_substeps({}, std::vector<double>{1.0}, true);
  EXPECT_EQ(model.steps(0), before) << "a loose tolerance asks for nothing, and nothing is given back";
  model.choose_substeps({}, std::vector<double>{1.0});
  EXPECT_LT(model.steps(0), before);
}

TEST(DataModel, ARecordingThatComesLateTurnsWhereItIsKnownTo) {
  // Three eighths of a row late, before a plant: rows are cut where it turns, and nowhere else. Straight and held
  // between its samples.
  Diagram d = lab::diagram("y");
  lab::add(d, "late", "dead_time", "u").parameters["delay"] = "3.75 ms";
  auto& lag = lab::add(d, "plant", "lag", "late");
  lag.parameters["times"] = NumberList{{15, "ms"}, {4, "ms"}};
  lab::add(d, "y", "gain", "plant").parameters["gain"] = "1 um/V";
  const auto program = compile(d, lab::registry());
  for (const auto between : {Between::linear, Between::hold}) {
    DataSet data = lab::swings(0.01, 300);
    data.notes["u"].between = between;
    lab::measure(data, program, 0, 26);
    DataModelOptions options;
    options.relative_tolerance = 1e-9;
    DataModel model(program, lab::shared(data), options);
    const std::vector<int> both{0, 1};
    ASSERT_TRUE(model.predict({}, both).ok);
    EXPECT_EQ(model.why_not_exact(), "");
    EXPECT_FALSE(model.goes_by_points()) << "many rows pass at once";
    EXPECT_EQ(model.substeps(0), 1) << to_text(between);
    EXPECT_LT(model.cross_check({}, both)[0], 1e-7) << to_text(between);  // BDF at 1e-9 a step
  }
}

TEST(DataModel, ADelayThatIsFittedIsFoundWhereverItBegins) {
  // y = u(t - 3.75 ms) of a straight input is linear in pieces: shifted by hand.
  Diagram d = lab::diagram("y");
  lab::add(d, "late", "dead_time", "u").parameters["delay"] = "1 ms";
  lab::add(d, "y", "gain", "late").parameters["gain"] = "1 um/V";
  const auto program = compile(d, lab::registry());
  DataSet data = lab::swings(0.01, 300);
  for (auto& r : data.recordings) {
    const auto& u = r.columns.at("u");
    auto& y = r.columns["y"];
    y.assign(u.size(), 0.0);
    r.units["y"] = parse_unit("um");
    for (std::size_t k = 0; k < u.size(); ++k) y[k] = 1e-6 * (k == 0 ? u[0] : u[k] + (u[k - 1] - u[k]) * 0.375);
  }
  DataModel model(program, lab::shared(data));
  const int delay = parameter_index(*program, "late.delay");
  for (const double other : {0.0, 0.02, 3.75e-3}) {  // several in a row: nothing is kept of the one before
    const auto prediction = model.predict(Trial{{delay, other, -1}}, std::vector<int>{0});
    ASSERT_TRUE(prediction.ok) << prediction.error;
    const auto& y = model.recording(0).columns.at("y");
    double off = 0;
    for (std::size_t k = 0; k < y.size(); ++k) off = std::max(off, std::abs(prediction.y[0][0][k] - y[k]));
    if (other == 3.75e-3)
      EXPECT_LT(off, 1e-14);  // rounding of 6 um
    else
      EXPECT_GT(off, 1e-8);
  }
}

TEST(DataModel, APlayKeepsHowFarThePlantRangBetweenTwoRows) {
  // Of 200 Hz, damped by a tenth, in rows of 50 ms: at each of them it is at rest again, whether rows are halved or
  // not.
  constexpr double w = 2 * std::numbers::pi * 200, damping = 0.1, radius = 0.1, row = 0.05;
  Diagram d = lab::diagram("y");
  auto& plant = lab::add(d, "plant", "transfer_function", "u");
  plant.parameters["num"] = NumberList{{w * w, ""}};
  plant.parameters["den"] = NumberList{{1, ""}, {2 * damping * w, ""}, {w * w, ""}};
  lab::add(d, "play", "play", "plant").parameters["radius"] = "0.1 V";
  lab::add(d, "y", "gain", "play").parameters["gain"] = "1 um/V";
  DataSet data;
  data.notes["u"].to = "u";
  data.notes["y"].to = "y";
  const auto steps = [](double t) { return 2 * std::floor(t + 1e-9); };  // 40 V/s, each a row long
  data.recordings.push_back(lab::recording("train", Role::train, row, 400, steps));
  const auto program = compile(d, lab::registry());
  lab::measure(data, program, 0, 20);
  DataModel model(program, lab::shared(data));
  const auto p = model.predict({}, std::vector<int>{0});
  ASSERT_TRUE(p.ok);
  // Behind the end of a ramp it is late by 2 damping/w times the slope and goes on as fast: a free oscillation.
  double peak = 0;
  const double fast = w * std::sqrt(1 - damping * damping), slope = 2 / row, late = -2 * damping * slope / w;
  for (double t = 0; t < 0.01; t += 1e-7)
    peak = std::max(peak, std::exp(-damping * w * t) *
                              (late * std::cos(fast * t) + (slope + damping * w * late) / fast * std::sin(fast * t)));
  ASSERT_GT(peak, 0.02);
  for (const std::size_t k : {22, 42, 382})
    EXPECT_NEAR(1e6 * p.y[0][0][k], steps(row * static_cast<double>(k)) + peak - radius, 1e-4) << k;  // of a span of 38
}

/// A lag of a hundredth of a row before plays, driven by sines that turn anywhere: in each of the rows where the drive
/// turns, the lag overshoots by what it is late, within some hundredths.
struct QuickLagBeforePlays {
  QuickLagBeforePlays() {
    Diagram d = lab::diagram("stage");
    lab::add(d, "amplifier", "lag", "u").parameters["times"] = NumberList{{10, "us"}};
    auto& plays = lab::add(d, "stage", "prandtl_ishlinskii", "amplifier");
    plays.parameters["thresholds"] = NumberList{{0, "V"}, {0.5, "V"}, {1.5, "V"}, {3, "V"}};
    plays.parameters["weights"] = NumberList{{0.2, "um/V"}, {0.3, "um/V"}, {0.2, "um/V"}, {0.1, "um/V"}};
    program = compile(d, lab::registry());
    data.notes["u"].to = "u";
    data.notes["y"].to = "y";
    data.recordings.push_back(lab::recording("train", Role::train, 1e-3, 400, [](double t) {
      double u = 3;
      for (const double hertz : {33.0, 71.0, 113.0, 187.0, 243.0}) u += std::sin(2 * std::numbers::pi * hertz * t);
      return u;
    }));
    lab::measure(data, program, 0, 20);
  }
  static DataModelOptions finely() {
    DataModelOptions options;
    options.max_substeps = 1024;
    options.substep_tolerance = 2e-5;
    return options;
  }
  ProgramPointer program;
  DataSet data;
};

TEST(DataModel, PartsOfARowGrowWithTheTimeSinceAQuickLagBegan) {
  const QuickLagBeforePlays bench;
  DataModel model(bench.program, lab::shared(bench.data), QuickLagBeforePlays::finely());
  ASSERT_TRUE(model.predict({}, std::vector<int>{0}).ok);
  EXPECT_GE(model.substeps(0), 64) << "the first part of a row is no longer than the lag";
  EXPECT_LT(model.steps(0), 20000) << "parts of one length are 124680";
  EXPECT_LT(model.cross_check({}, std::vector<int>{0})[0], 1e-4);  // plays keep what some hundred turns were off by
}

TEST(DataModel, AChoiceOfSubstepsMayBeginWithWhatIsKnown) {
  const QuickLagBeforePlays bench;
  DataModelOptions options = QuickLagBeforePlays::finely();
  DataModel first(bench.program, lab::shared(bench.data), options);
  first.choose_substeps({});
  options.begin_with = std::make_shared<const Cuts>(first.cuts());
  DataModel second(bench.program, lab::shared(bench.data), options);
  second.choose_substeps({});
  EXPECT_NEAR(static_cast<double>(second.steps(0)), static_cast<double>(first.steps(0)), 10) << "but for a look";
  EXPECT_LT(3 * second.runs(), first.runs());
  EXPECT_LE(second.runs(), 3) << "as they are, halved, and a look where it bends";
  // Known rows that do not suffice are let go: more are chosen as if nothing were known.
  auto few = std::make_shared<Cuts>(Cuts{std::vector<RowCut>(400, RowCut{2, 0})});
  options.begin_with = few;
  DataModel fourth(bench.program, lab::shared(bench.data), options);
  fourth.choose_substeps({});
  EXPECT_EQ(fourth.steps(0), first.steps(0));
  // Of other recordings: nothing is known.
  auto shorter = std::make_shared<Cuts>(first.cuts());
  shorter->front().pop_back();
  options.begin_with = shorter;
  DataModel third(bench.program, lab::shared(bench.data), options);
  third.choose_substeps({});
  EXPECT_EQ(third.runs(), first.runs());
}

TEST(DataModel, WhatHappensWithinAHundredthOfSomeRowsCutsThoseAlone) {
  // A triangle with steps, through a lag of a hundredth of a row, turns within that hundredth, and plays that follow as
  // quickly keep where it turned: until pieces are as short, halving them changes nothing for the better.
  Diagram d = lab::diagram("y");
  lab::add(d, "amplifier", "lag", "u").parameters["times"] = NumberList{{10, "us"}};
  auto& plays = lab::add(d, "stage", "late_prandtl_ishlinskii", "amplifier");
  plays.parameters["time"] = "7 us";
  plays.parameters["ahead"] = -0.5;
  plays.parameters["spread"] = -0.85;
  plays.parameters["thresholds"] = NumberList{{0, "V"}, {0.5, "V"}, {1.5, "V"}, {3, "V"}};
  plays.parameters["weights"] = NumberList{{0.2, "um/V"}, {0.3, "um/V"}, {0.2, "um/V"}, {0.1, "um/V"}};
  lab::add(d, "y", "gain", "stage").parameters["gain"] = "1";
  const auto program = compile(d, lab::registry());
  DataSet data;
  data.notes["u"].to = "u";
  data.notes["y"].to = "y";
  data.recordings.push_back(lab::recording("train", Role::train, 1e-3, 1000, [](double t) {
    return 10 * std::abs(std::remainder(t, 0.2)) + 0.3 * std::floor(t / 0.25);  // turns at every hundredth row
  }));
  lab::measure(data, program, 0, 20);
  DataModelOptions options;
  options.max_substeps = 1024;
  options.substep_tolerance = 2e-5;
  options.max_substeps = 1024;
  DataModel model(program, lab::shared(data), options);
  ASSERT_TRUE(model.predict({}, std::vector<int>{0}).ok);
  EXPECT_LT(model.steps(0), 2 * 1000) << "4200 where all rows are halved, with those that have nothing to show";
  EXPECT_LT(model.cross_check({}, std::vector<int>{0})[0], 5e-5) << "1e-5 of the span was asked for";
}

/// A stiffening mass whose position was measured, and is asked for with `gain` times as much of it.
Diagram stiffening_mass(const char* gain) {
  Diagram d = lab::diagram("y");
  lab::add(d, "force", "gain", "u").parameters["gain"] = "1 N/V";
  auto& mass = lab::add(d, "mass", "mass_on_stiffening_spring", "force");
  mass.parameters["mass"] = "1 kg";
  mass.parameters["damping"] = "20 N*s/m";
  mass.parameters["stiffness"] = "1000 N/m";
  mass.parameters["stiffening"] = "1e7 N/m^3";
  lab::add(d, "lag", "lag", "mass.position").parameters["times"] = NumberList{{20, "ms"}};
  lab::add(d, "y", "gain", "lag").parameters["gain"] = gain;
  return d;
}

TEST(DataModel, OrdinaryConvergenceIsNotTakenForRinging) {
  // Behind a law that is not linear a signal is straight between substeps: every row converges with the square of its
  // length, and one that is cut into 64 shows 4/3 of what halving it shows. Where that lies below the tolerance by less
  // than this, rows that were cut to see if anything rings there showed more than it, and so did the next ones.
  const auto program = compile(stiffening_mass("1"), lab::registry());
  DataSet data = lab::swings(0.01, 400);
  lab::measure(data, program, 0, 24);
  std::vector<long> steps;
  for (int k = 0; k < 12; ++k) {  // over two octaves of the tolerance: one of substeps
    DataModelOptions options;
    options.max_substeps = 1024;
    options.substep_tolerance = 2e-5;
    DataModel model(program, lab::shared(data), options);
    model.choose_substeps({});
    ASSERT_EQ(model.why_not_exact(), "");
    steps.push_back(model.steps(0));
  }
  EXPECT_LE(*std::max_element(steps.begin(), steps.end()), 4 * *std::min_element(steps.begin(), steps.end()))
      << "an octave of substeps, and as much again for rows that were cut";
}

TEST(DataModel, RowsAreNoMoreExactThanAShareOfWhatTheModelLeaves) {
  const auto right = compile(stiffening_mass("1"), lab::registry()),
             wrong = compile(stiffening_mass("1.5"), lab::registry());
  DataSet data = lab::swings(0.01, 400);
  lab::measure(data, right, 0, 24);
  const auto steps_and_rows = [&](const ProgramPointer& program, double share) {
    DataModelOptions options;
    options.max_substeps = 1024;
    options.substep_tolerance = 2e-5;
    options.substep_share = share;
    DataModel model(program, lab::shared(data), options);
    model.choose_substeps({});
    EXPECT_EQ(model.why_not_exact(), "");
    EXPECT_TRUE(model.integrates());
    const std::vector<int> first{0};
    return std::pair(model.steps(0), model.predict({}, first).y[0][0]);
  };
  const double share = 0.01;
  const auto [fine_steps, fine] = steps_and_rows(wrong, 0);
  const auto [some_steps, some] = steps_and_rows(wrong, share);
  EXPECT_LT(2 * some_steps, fine_steps);
  // A third of the motion is left, over which the rms about the mean is less than half of its span.
  const auto [low, high] = std::minmax_element(fine.begin(), fine.end());
  double worst = 0;
  for (std::size_t i = 0; i < fine.size(); ++i) worst = std::max(worst, std::abs(fine[i] - some[i]));
  EXPECT_LT(worst, share * 0.5 * (*high - *low) / 3);
  EXPECT_GT(worst, 0);
  // What leaves nothing is simulated as finely as ever.
  EXPECT_EQ(steps_and_rows(right, share).first, steps_and_rows(right, 0).first);
}

TEST(DataModel, LinearStatesAreNoneThatCostMore) {
  Diagram d = lab::diagram("y");
  lab::add(d, "lag", "lag", "u").parameters["times"] = NumberList{{20, "ms"}};
  lab::add(d, "y", "gain", "lag").parameters["gain"] = "1 um/V";
  const auto program = compile(d, lab::registry());
  DataSet data = lab::swings(0.01, 50);
  lab::measure(data, program, 0, 24);
  EXPECT_FALSE(DataModel(program, lab::shared(data)).integrates());
}

TEST(DataModel, AnInputThatMovesSmoothlyHasItsOwnSteps) {
  Diagram d = lab::diagram("y");
  lab::add(d, "y", "gain", "u").parameters["gain"] = "1 um/V";
  const auto program = compile(d, lab::registry());
  DataSet data = lab::swings(0.05, 300);
  lab::measure(data, program, 0, 25);
  DataModel straight(program, lab::shared(data));
  data.notes["u"].between = Between::smooth;
  DataModel smooth(program, lab::shared(data));
  for (DataModel* model : {&straight, &smooth}) ASSERT_TRUE(model->predict({}, std::vector<int>{0}).ok);
  const auto passed = static_cast<long>(input_series(data, data.recordings[0], "u")->t.size());
  EXPECT_GT(passed, straight.steps(0));
  EXPECT_EQ(smooth.steps(0), passed);
}

TEST(DataModel, SubstepsThatCouldNotBeFoundAreSoughtFromOne) {
  // With no number for a mass nothing is simulated, and the most substeps that there may be are no beginning.
  const auto program = stage_on_a_stiffening_spring("1e8 N/m^3");
  DataSet data = lab::swings(0.05, 100);
  lab::measure(data, program, 0, 26);
  DataModel model(program, lab::shared(data));
  model.choose_substeps(Trial{{parameter_index(*program, "mass.mass"), std::nan("")}});
  model.choose_substeps({}, {}, true);
  EXPECT_EQ(model.why_not_exact(), "") << "what could be simulated was left to BDF";
  DataModel alone(program, lab::shared(data));
  alone.choose_substeps({});
  EXPECT_EQ(model.steps(0), alone.steps(0));
}

TEST(DataModel, ATrialThatRunsAwayGetsMoreSubsteps) {
  const auto program = stage_on_a_stiffening_spring("1 N/m^3");
  DataSet data = lab::swings(0.01, 300);
  lab::measure(data, program, 0, 21);
  DataModel model(program, lab::shared(data));
  const std::vector<int> both{0, 1};
  ASSERT_TRUE(model.predict({}, both).ok);
  ASSERT_EQ(model.why_not_exact(), "");
  const long chosen = model.steps(0);
  // At 6 N the spring of the trial is as stiff as 3 (6 N)^(2/3) (1e17 N/m^3)^(1/3) = 4.6e6 N/m: 2100 rad/s, of which an
  // explicit step of a few milliseconds makes infinity.
  const Trial stiff{{parameter_index(*program, "mass.stiffening"), 1e17}};
  ASSERT_GT(0.01 * 300 / static_cast<double>(chosen) * 2100, 2.8) << chosen;
  const auto one = model.predict(stiff, both);
  ASSERT_TRUE(one.ok) << one.error;
  const auto many = model.predict_each(std::vector<Trial>{stiff, {}}, both);
  ASSERT_TRUE(many[0].ok && many[1].ok) << many[0].error;
  EXPECT_EQ(many[0].y, one.y);
  EXPECT_EQ(model.steps(0), chosen) << "the others are simulated as before";
}

TEST(DataModel, WhatAlwaysRunsAwayIsNotAskedForItsSubstepsForEver) {
  // A spring that softens until it pushes, at ten times the force that it can hold.
  const auto program = stage_on_a_stiffening_spring("1 N/m^3");
  DataSet data = lab::swings(0.01, 300);
  lab::measure(data, program, 0, 23);
  DataModelOptions options;
  options.bdf_otherwise = false;
  DataModel model(program, lab::shared(data), options);
  const Trial lost{{parameter_index(*program, "mass.stiffening"), -1e12}};
  std::vector<long> runs;
  for (int i = 0; i < 5; ++i) {
    const long before = model.runs();
    EXPECT_FALSE(model.predict(lost, std::vector<int>{0, 1}).ok);
    runs.push_back(model.runs() - before);
  }
  EXPECT_EQ(runs[0], runs[2]) << "at other values it might be simulated";
  EXPECT_LT(3 * runs[3], runs[2]) << "three times were enough";
  EXPECT_EQ(runs[3], runs[4]);
}

}  // namespace
}  // namespace hysteron
