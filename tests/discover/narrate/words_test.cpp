// How a discovery is told: units, names, structures that nothing explains.
#include "discover/narrate/words.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "discover/effects/all.h"
#include "discover/search/investigation.h"

namespace hysteron {
namespace {

RecordingError error_of(const std::string& output, const std::string& unit, double rms, Role role = Role::validate) {
  RecordingError e;
  e.recording = "01.csv";
  e.role = role;
  e.output = output;
  e.unit = parse_unit(unit);
  e.rows = 100;
  e.rms = e.unit.difference_to_si(rms);
  e.deviation = e.unit.difference_to_si(1);
  e.nrmse = rms;
  return e;
}

ModelError errors_of(std::vector<RecordingError> recordings) {
  ModelError e;
  e.recordings = std::move(recordings);
  return e;
}

Candidate candidate(const std::string& effect, const std::string& place) {
  Candidate c;
  c.effect = effect;
  c.place = place;
  return c;
}

Discovery a_lag_was_missing() {
  Discovery d;
  d.verdict = Verdict::missing_effect;
  d.steps.emplace_back();
  d.steps.back().winner = candidate("amplifier_lag", "u");
  d.steps.back().sentence = "a lag";
  return d;
}

std::string all_of(const std::vector<std::string>& sentences) {
  std::string text;
  for (const auto& s : sentences) text += s + "\n";
  return text;
}

TEST(Words, OfEffectsThatWereNotAskedForNothingIsSaid) {
  Discovery d;
  d.verdict = Verdict::unexplained;
  d.refused.push_back({"mains_interference", "sensor", "no recording is sampled above 120 Hz"});
  d.refused.push_back({"creep", "stage", "no hold"});
  put_into_words(d, DataSet{});
  EXPECT_NE(d.headline.find("no known effect explains it"), std::string::npos) << d.headline;
  EXPECT_EQ(all_of(d.sentences).find("was not tried"), std::string::npos);
  d.asked_for = {"mains_interference"};
  d.sentences.clear();
  put_into_words(d, DataSet{});
  EXPECT_NE(d.headline.find("no known effect of those asked for (mains_interference) explains it"), std::string::npos)
      << d.headline;
  EXPECT_NE(
      all_of(d.sentences).find("mains_interference at sensor was not tried: no recording is sampled above 120 Hz."),
      std::string::npos)
      << all_of(d.sentences);
  EXPECT_EQ(all_of(d.sentences).find("creep"), std::string::npos);
}

TEST(Words, WhatWouldTellTwoPlacesApartIsSaidWithTheFinding) {
  const Effects effects = all_effects();
  const Effect& lag = effects.get("amplifier_lag");
  FoundStep step;
  step.winner.effect = "amplifier_lag";
  step.winner.place = "u";
  step.winner.summary = "time constant 2 ms";
  step.before = step.after = errors_of({error_of("y", "um", 0.03)});
  EXPECT_EQ(step_sentence(step, lag, judged_on(Discovery())).find("Lag of the amplifier at u: time constant 2 ms; "), 0u)
      << step_sentence(step, lag, judged_on(Discovery()));
  EXPECT_EQ(step_sentence(step, lag, judged_on(Discovery())).find("monitor"), std::string::npos) << "it is at one place alone";
  step.ties.resize(1);
  step.ties[0].effect = "dead_time";
  step.ties[0].place = "u";
  EXPECT_NE(step_sentence(step, lag, judged_on(Discovery())).find("explained as well by dead_time at u"), std::string::npos)
      << step_sentence(step, lag, judged_on(Discovery()));
  step.winner.same_effects = {"sensor_lag"};
  step.winner.same_places = {"y"};
  EXPECT_NE(step_sentence(step, lag, judged_on(Discovery())).find("\"monitor\" tells: the drive measured behind the amplifier decides"),
            std::string::npos)
      << step_sentence(step, lag, judged_on(Discovery()));
}

TEST(Words, EachOutputIsToldInItsOwnUnit) {
  Discovery d = a_lag_was_missing();
  d.base = errors_of({error_of("y", "um", 0.03), error_of("s", "mm/s", 0.06)});
  d.final_error = errors_of({error_of("y", "um", 0.01), error_of("s", "mm/s", 0.02)});
  put_into_words(d, {});
  EXPECT_NE(d.headline.find("(y: 0.03 um -> 0.01 um, s: 0.06 mm/s -> 0.02 mm/s)"), std::string::npos) << d.headline;
  EXPECT_NE(all_of(d.sentences).find("The remaining residual (y 0.01 um, s 0.02 mm/s, "), std::string::npos)
      << all_of(d.sentences);
}

TEST(Words, OneOutputIsToldWithoutItsNameAndManyWithoutSizes) {
  EXPECT_EQ(sizes_text(errors_of({error_of("y", "um", 0.03)}), Role::validate), "0.03 um");
  EXPECT_EQ(sizes_text(errors_of({error_of("y", "um", 0.03)}), Role::train), "");
  EXPECT_EQ(sizes_text(errors_of({error_of("a", "um", 1), error_of("b", "um", 1), error_of("c", "um", 1),
                                  error_of("d", "um", 1)}),
                       Role::validate),
            "");
}

TEST(Words, RecordingsOfOneOutputAreAddedInSquares) {
  // 3 and 4 um over as many rows each: sqrt((9 + 16)/2) = 3.54 um.
  EXPECT_EQ(sizes_text(errors_of({error_of("y", "um", 3), error_of("y", "um", 4)}), Role::validate), "3.54 um");
}

TEST(Words, WhatTheTestRecordingsSayIsTold) {
  Discovery d = a_lag_was_missing();
  d.final_error.test = {error_of("y", "um", 0.02, Role::test)};
  put_into_words(d, {});
  EXPECT_EQ(all_of(d.sentences).find("test recordings"), std::string::npos);
  d.sentences.clear();
  d.final_error.nrmse_test = 0.02;
  put_into_words(d, {});
  EXPECT_NE(all_of(d.sentences).find("On the test recordings, read once at the end: 2 % (0.02 um rms)."),
            std::string::npos)
      << all_of(d.sentences);
}

TEST(Words, WhatIsReadOfASignalIsToldAsAReading) {
  FoundStep step;
  step.winner = candidate("sensor_lag", "outputs.w");
  step.winner.summary = "time constant 2 ms";
  step.before = step.after = errors_of({error_of("w", "rad/s", 0.03)});
  const std::string told = step_sentence(step, all_effects().get("sensor_lag"), judged_on(Discovery()));
  EXPECT_NE(told.find("at the reading of w: time constant 2 ms"), std::string::npos) << told;
}

TEST(Words, ANameThatStandsAtSeveralPlacesIsToldOnce) {
  FoundStep step;
  step.winner = candidate("sensor_nonlinearity", "stage");
  step.ties = {candidate("asymmetry", "u"), candidate("asymmetry", "stage"), candidate("saturation", "u")};
  EXPECT_EQ(names_of({step}, 0), "sensor_nonlinearity or asymmetry (at u or at stage) or saturation");
  step.ties.pop_back();
  step.ties.pop_back();
  EXPECT_EQ(names_of({step}, 0), "sensor_nonlinearity or asymmetry");
}

TEST(Words, ANameInTwoStepsIsToldWithItsPlace) {
  std::vector<FoundStep> steps(2);
  steps[0].winner = candidate("structural_resonance", "load");
  steps[1].winner = candidate("structural_resonance", "motor");
  EXPECT_EQ(names_of(steps, 0), "structural_resonance at load");
  EXPECT_EQ(names_of(steps, 1), "structural_resonance at motor");
}

Structure jumps_at(const std::vector<double>& times) {
  Structure s;
  s.kind = "jumps";
  s.variable = "t";
  s.output = "y";
  s.unit = parse_unit("s");
  s.intervals.push_back({"07.csv", {{0.5, 0.51}}});
  s.intervals.push_back({"08.csv", {}});
  for (const double t : times) s.intervals.back().second.emplace_back(t, t + 0.01);
  s.sentence = "jumps of the residual";
  return s;
}

TEST(Words, OfJumpsItIsToldWhereMostAreAndHowPeriodicTheyAre) {
  const std::string regular = all_of(structure_sentences(jumps_at({1, 1.4, 1.8, 2.2, 2.6, 3, 3.4})));
  EXPECT_NE(regular.find("Of 8 jumps most are in 08.csv: 7, the first at 1 s, the last at 3.4 s."), std::string::npos);
  EXPECT_NE(regular.find("The jumps are periodic: half of the intervals between them are 0.4 .. 0.4 s"),
            std::string::npos)
      << regular;
  const std::string any = all_of(structure_sentences(jumps_at({1, 1.1, 1.4, 2.4, 2.6, 3.4, 5.4})));
  EXPECT_NE(any.find("The jumps are not periodic: the intervals between them are 0.1 .. 2 s"), std::string::npos)
      << any;
  EXPECT_EQ(all_of(structure_sentences(jumps_at({1, 2}))).find("periodic"), std::string::npos)
      << "one gap is no rhythm";
}

TEST(Words, WhatNothingExplainsIsToldInSentencesWithWhatToRecord) {
  Discovery d;
  d.verdict = Verdict::unexplained;
  d.final_error = d.base = errors_of({error_of("y", "um", 0.03)});
  put_into_words(d, {});
  EXPECT_NE(all_of(d.sentences).find("The residual on recordings not used for the fit is 0.03 um"), std::string::npos)
      << all_of(d.sentences);
  EXPECT_NE(all_of(d.sentences).find("Record longer"), std::string::npos) << all_of(d.sentences);
  d.sentences.clear();
  d.structure = jumps_at({1, 1.1, 1.4, 2.4, 2.6, 3.4, 5.4});
  put_into_words(d, {});
  EXPECT_NE(all_of(d.sentences).find("most are in 08.csv"), std::string::npos) << all_of(d.sentences);
  EXPECT_NE(all_of(d.sentences).find("Record once with every input held"), std::string::npos) << all_of(d.sentences);
  d.structure->kind = "kink_at_level";
  d.structure->variable = "u";
  d.structure->unit = parse_unit("V");
  d.structure->threshold = 2.5;
  d.structure->has_threshold = true;
  EXPECT_NE(what_to_record(&*d.structure).find("across u = 2.5 V"), std::string::npos);
}

}  // namespace
}  // namespace hysteron
