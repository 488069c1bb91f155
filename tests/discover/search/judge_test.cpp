// The rules of a claim on errors made by hand: what an imperfect law may have left, and where.
#include <gtest/gtest.h>

#include <cmath>

#include "discover/effects/all.h"
#include "discover/search/discover.h"
#include "discover/search/investigation.h"
#include "discover/search/search_state.h"

namespace hysteron {
namespace {

constexpr std::size_t judged_rows = 1000;

/// Two train and two validate recordings, slow and fast, with these chi2.
ModelError error(double train_slow, double train_fast, double validate_slow, double validate_fast) {
  ModelError e;
  for (const auto& [role, chi2] : {std::pair{Role::train, train_slow},
                                   {Role::train, train_fast},
                                   {Role::validate, validate_slow},
                                   {Role::validate, validate_fast}}) {
    RecordingError r;
    r.role = role;
    r.output = "y";
    r.rows = judged_rows;
    r.chi2 = r.evidence = chi2;
    r.plain = judged_rows;
    (role == Role::train ? e.chi2_train : e.chi2_validate) += chi2;
    (role == Role::train ? e.n_train : e.n_validate) += judged_rows;
    e.recordings.push_back(r);
  }
  e.evidence_train = e.chi2_train;
  e.evidence_validate = e.chi2_validate;
  e.effective_sample_size = 4 * judged_rows;
  return e;
}

class Judging : public ::testing::Test {
 protected:
  /// A candidate that leaves `after`, on top of laws that left `before` and may have left so much of their own.
  TriedEffect judged(const ModelError& before, const ModelError& after, const std::vector<double>& left,
                     const std::string& effect = "backlash", const std::string& on_top_of = "amplifier_lag") const {
    return judged_with(0, before, after, left, effect, on_top_of);
  }
  /// The same with that many numbers more than the model before has, and with a law of so many beginnings.
  TriedEffect judged_with(int numbers, const ModelError& before, const ModelError& after,
                          const std::vector<double>& left, const std::string& effect = "backlash",
                          const std::string& on_top_of = "amplifier_lag", std::size_t beginnings = 0) const {
    TriedEffect t;
    t.effect = effects.find(effect);
    t.laws.resize(1);
    if (beginnings > 0) t.laws.front().free.emplace_back().scan.resize(beginnings);
    t.candidate.ok = true;
    t.candidate.parameters = numbers;
    t.candidate.error_of = after;
    CandidateModel was;
    was.ok = true;
    was.error_of = before;
    was.placed.emplace_back().effect = effects.find(on_top_of);
    judge(t, was, left);
    return t;
  }
  Effects effects = all_effects();
};

TEST_F(Judging, WhatALawMayHaveLeftCountsWhereThatLawActs) {
  const ModelError before = error(1400, 1900, 1400, 1900);
  const ModelError in_the_slow = error(1000, 1850, 1000, 1850);
  const std::vector<double> of_the_fast{0, 900, 0, 900};  // a lag does nothing where nothing is fast
  const TriedEffect right = judged(before, in_the_slow, of_the_fast);
  EXPECT_TRUE(right.admitted) << right.reason;
  EXPECT_GT(right.share, 0.9) << "of what no other law can have left";
  // The same fall where the law that stands acts may be that law's own.
  const TriedEffect wrong = judged(before, error(1395, 1300, 1395, 1300), of_the_fast);
  EXPECT_FALSE(wrong.admitted);
  EXPECT_NE(wrong.reason.find("may have left of their own"), std::string::npos) << wrong.reason;
}

TEST_F(Judging, WhatALawLeavesIsSeenWhereTheCandidateIsAtRest) {
  const std::vector<double> acts_alike(4, 300);  // 1.5 % of 1.3e6
  // Noise alone in the slow recordings: the law leaves at most 0.8 % of its own effect, 90 of chi2.
  const TriedEffect right = judged(error(1000, 1180, 1000, 1180), error(1000, 1010, 1000, 1010), acts_alike);
  EXPECT_TRUE(right.admitted) << right.reason;
  // It leaves 1.2 % there, and may have left 190 in the fast ones.
  const TriedEffect wrong = judged(error(1100, 1130, 1100, 1130), error(1100, 1010, 1100, 1010), acts_alike);
  EXPECT_FALSE(wrong.admitted);
  EXPECT_NE(wrong.reason.find("may have left of their own"), std::string::npos) << wrong.reason;
  // Who acts in the fitted ones alone at rest is not seen by one that judges.
  const TriedEffect unseen = judged(error(1000, 1110, 1110, 1110), error(1000, 1010, 1010, 1010), acts_alike);
  EXPECT_FALSE(unseen.admitted);
  // Where the law hardly acts it shows nothing of what it leaves elsewhere.
  const TriedEffect elsewhere =
      judged(error(1000, 1180, 1000, 1180), error(1000, 1010, 1000, 1010), {100, 300, 100, 300});
  EXPECT_FALSE(elsewhere.admitted);
}

/// A mains that was looked for at 50 Hz, in rows of 1 s and 1 ms; `without` it this is left.
TriedEffect a_line(const Effects& effects, const ModelError& after, const ModelError& without) {
  TriedEffect t;
  t.effect = effects.find("mains_interference");
  Law law;
  law.free.emplace_back().path = "frequency";
  law.free.back().line_bands = {{49.5, 50.5}};
  t.laws = {law};
  t.candidate.ok = true;
  t.candidate.error_of = after;
  for (const std::size_t slow : {0u, 2u}) t.candidate.error_of.recordings[slow].step = 1;
  for (const std::size_t fast : {1u, 3u}) t.candidate.error_of.recordings[fast].step = 1e-3;
  auto& standing = t.candidate.placed.emplace_back();
  standing.effect = t.effect;
  standing.law = law;
  standing.name = "hum";
  auto& estimate = t.candidate.fit.estimates.emplace_back();
  estimate.path = parameter_path("hum", law, law.free.front());
  estimate.used = 50;
  t.without_line = without;
  return t;
}

TEST_F(Judging, WhatTheFitLostWhereItHadLessToGoByIsNoLoss) {
  TriedEffect t = a_line(effects, error(1000, 1000, 1000, 1000), error(1000, 1000, 1000, 1000));
  ASSERT_EQ(own_values(t).size(), 1u);
  t.fall_train = 100;  // its one value is known to a tenth, and a tenth off leaves a hundredth of 6500
  t.fall_validate = 6500;
  EXPECT_NEAR(lost_by_the_fit(t), 62, 1e-9);
  t.fall_validate = 300;
  EXPECT_EQ(lost_by_the_fit(t), 0) << "a usual split";
  t.fall_train = 5;
  t.fall_validate = 6500;
  EXPECT_EQ(lost_by_the_fit(t), 0) << "no more than chance says nothing of a value";
  t.fall_train = 11;
  EXPECT_NEAR(lost_by_the_fit(t), 130, 1e-9) << "two per cent at most";
}

TEST_F(Judging, ALineProvesItselfWhereRowsResolveIt) {
  CandidateModel was;
  was.ok = true;
  was.error_of = error(1900, 1900, 1900, 1900);
  // Everybody gains in the slow rows, and by what others found since then in the fast ones: without the line no less.
  TriedEffect patch = a_line(effects, error(1000, 1500, 1000, 1500), error(1000, 1504, 1000, 1504));
  judge(patch, was, {});
  EXPECT_FALSE(patch.admitted);
  EXPECT_NEAR(patch.fall_validate, 4, 1e-9);
  EXPECT_NE(patch.reason.find("no more than by chance"), std::string::npos) << patch.reason;
  TriedEffect mains = a_line(effects, error(1000, 1010, 1000, 1010), error(1000, 1900, 1000, 1900));
  judge(mains, was, {});
  EXPECT_TRUE(mains.admitted) << mains.reason;
  EXPECT_NEAR(mains.fall_validate, 890, 1e-9);
}

TEST_F(Judging, WhatTakesASmallShareOfAllIsAPatchWhereverItLies) {
  const TriedEffect t = judged(error(1100, 3900, 1100, 3900), error(1010, 3850, 1010, 3850), {0, 3000, 0, 3000});
  EXPECT_FALSE(t.admitted);
  EXPECT_NE(t.reason.find("not specific"), std::string::npos) << t.reason;
}

TEST_F(Judging, WhatTheFittedRecordingsDoNotShowIsNoFurtherEffect) {
  // 100 on recordings that judge, and 6 or 12 on those that its values were found on.
  const ModelError before = error(1000, 1012, 1000, 1200);
  EXPECT_TRUE(judged(before, error(1000, 1000, 1000, 1010), {0, 1, 0, 1}).admitted);
  const TriedEffect t = judged(before, error(1000, 1006, 1000, 1010), {0, 1, 0, 1});
  EXPECT_FALSE(t.admitted);
  EXPECT_NE(t.reason.find("on the recordings that were fitted"), std::string::npos) << t.reason;
  EXPECT_TRUE(judged(before, error(1000, 1006, 1000, 1010), {}).admitted) << "nothing stands that could do it";
}

TEST_F(Judging, NoiseIsNothingThatALawIsTakenDownTo) {
  // Noise before: that it is noise afterwards says nothing for the candidate.
  const TriedEffect t = judged(error(1000, 1080, 1000, 1080), error(1000, 1010, 1000, 1010), {0, 300, 0, 300});
  EXPECT_FALSE(t.admitted);
  EXPECT_NE(t.reason.find("may have left of their own"), std::string::npos) << t.reason;
  // Structure before, noise afterwards: no imperfect law is repaired so well by another effect's.
  const TriedEffect down = judged(error(1000, 1600, 1000, 1600), error(1000, 1010, 1000, 1010), {0, 900, 0, 900});
  EXPECT_TRUE(down.admitted) << down.reason;
}

TEST_F(Judging, WhoCanImitateAStandingLawTakesMoreThanThatMayHaveLeft) {
  // Friction took 2e6 of chi2 away of each fast recording: 450 is 1.5 % of that in rms, 20 000 a tenth.
  const std::vector<double> left{0, 450, 0, 450};
  const ModelError before = error(1000, 1900, 1000, 1900), after = error(1000, 1010, 1000, 1010);
  EXPECT_TRUE(judged(before, after, left, "backlash", "friction").admitted);
  const TriedEffect imitated = judged(before, after, left, "hysteresis", "friction");
  EXPECT_FALSE(imitated.admitted);
  EXPECT_NE(imitated.reason.find("may have left of their own"), std::string::npos) << imitated.reason;
  EXPECT_TRUE(judged(before, after, left, "hysteresis", "calibration").admitted) << "a straight line is exact";
  EXPECT_TRUE(judged(before, after, {0, 10, 0, 10}, "hysteresis", "friction").admitted) << "beyond a tenth";
}

TEST_F(Judging, WhatALawLeavesOfACurveIsNoFurtherCurve) {
  // As above: it takes 900 down to the noise, a tenth of the curve that stands would be 20 000.
  const std::vector<double> left{0, 450, 0, 450};
  const ModelError before = error(1000, 1900, 1000, 1900), after = error(1000, 1010, 1000, 1010);
  for (const auto& [curve, stands] : {std::pair{"sensor_nonlinearity", "asymmetry"},
                                      {"saturation", "asymmetry"},
                                      {"asymmetry", "sensor_nonlinearity"},
                                      {"saturation", "sensor_nonlinearity"},
                                      {"asymmetry", "saturation"},
                                      {"sensor_nonlinearity", "saturation"}}) {
    EXPECT_FALSE(judged(before, after, left, curve, stands).admitted) << curve;
    EXPECT_TRUE(judged(before, after, left, curve, "creep").admitted) << curve;
    EXPECT_TRUE(judged(before, after, {0, 10, 0, 10}, curve, stands).admitted) << curve << " beyond a tenth";
  }
}

TEST_F(Judging, WhatLooksLikeTheRestOfAStandingLawTakesMoreThanThat) {
  // Domains that switch unevenly bend the loops about their middle, as a curve does.
  const std::vector<double> left{0, 450, 0, 450};
  const ModelError before = error(1000, 1900, 1000, 1900), after = error(1000, 1010, 1000, 1010);
  for (const char* curve : {"asymmetry", "sensor_nonlinearity", "saturation", "stiffening", "friction"}) {
    EXPECT_FALSE(judged(before, after, left, curve, "hysteresis").admitted) << curve;
    EXPECT_TRUE(judged(before, after, left, curve, "creep").admitted) << curve;
    EXPECT_TRUE(judged(before, after, {0, 10, 0, 10}, curve, "hysteresis").admitted) << curve << " beyond a tenth";
  }
}

TEST_F(Judging, AChainOfRelaxationsLeavesALoopUseThatNobodyCountedAGainAndAPastAClamp) {
  const std::vector<double> left{0, 450, 0, 450};
  const ModelError before = error(1000, 1900, 1000, 1900), after = error(1000, 1010, 1000, 1010);
  for (const auto& [effect, stands] : {std::pair{"hysteresis", "creep"},
                                       {"backlash", "creep"},
                                       {"calibration", "ageing"},
                                       {"temperature_gain", "ageing"},
                                       {"saturation", "initial_remanence"}}) {
    EXPECT_FALSE(judged(before, after, left, effect, stands).admitted) << effect;
    EXPECT_TRUE(judged(before, after, left, effect, "dead_time").admitted) << effect;
    EXPECT_TRUE(judged(before, after, {0, 10, 0, 10}, effect, stands).admitted) << effect << " beyond a tenth";
  }
}

TEST_F(Judging, RecordingsThatProveAWeakEffectNeedOthersOnlyToAgree) {
  const ModelError before = error(1000, 1060, 1000, 1004), after = error(1000, 1020, 1000, 1000);
  const TriedEffect t = judged(before, after, {});
  EXPECT_TRUE(t.admitted) << t.reason;
  EXPECT_FALSE(judged(before, error(1000, 1020, 1000, 1003), {}).admitted) << "chance agrees by as much";
  EXPECT_FALSE(judged(before, error(1000, 1055, 1000, 1000), {}).admitted) << "9 in all are too few";
  EXPECT_FALSE(judged(before, after, {0, 1, 0, 1}).admitted) << "on top of laws each must prove it";
  EXPECT_FALSE(judged(error(1000, 1900, 1000, 1900), error(1000, 1000, 1000, 1896), {}).admitted)
      << "what stands above the noise can prove it there";
}

TEST(ByChance, IsWhatChiSquaredReachesOnceInTwoThousandTimes) {
  // Closed forms of the upper tail for 1, 2 and 4 degrees of freedom; a quarter of 1/2000 is 0.4 of chi2.
  const auto near = [](double tail) { return std::abs(tail * 2000 - 1) < 0.25; };
  const double one = rules::by_chance(1, 1), two = rules::by_chance(2, 1), four = rules::by_chance(4, 1);
  EXPECT_TRUE(near(std::erfc(std::sqrt(one / 2)))) << one;
  EXPECT_TRUE(near(std::exp(-two / 2))) << two;
  EXPECT_TRUE(near(std::exp(-four / 2) * (1 + four / 2))) << four;
  EXPECT_NEAR(20 * std::exp(-rules::by_chance(2, 20) / 2), std::exp(-two / 2), 1e-12) << "twenty chances";
}

TEST_F(Judging, AWeakSlowEffectPaysForItsNumbersWhatChanceTakesAway) {
  // 10 and 6 of chi2: two numbers take 15 away once in 2000 times, three 17.5; ln N of 4000 rows is 8.3 for each.
  const ModelError before = error(1000, 1010, 1000, 1006), after = error(1000, 1000, 1000, 1000);
  const TriedEffect two = judged_with(2, before, after, {});
  EXPECT_TRUE(two.admitted) << two.reason;
  EXPECT_FALSE(judged_with(3, before, after, {}).admitted);
  EXPECT_FALSE(judged_with(2, before, error(1000, 996, 1000, 1004.5), {}).admitted) << "others do not agree";
  EXPECT_FALSE(judged_with(2, before, after, {0, 1, 0, 1}).admitted) << "a law that stands may have left it";
  // The best of 20 beginnings has twenty chances: 6 more.
  EXPECT_FALSE(judged_with(2, before, after, {}, "backlash", "amplifier_lag", 20).admitted);
  EXPECT_TRUE(judged_with(2, error(1000, 1016, 1000, 1006), after, {}, "backlash", "amplifier_lag", 20).admitted);
  // What others prove is proved, whatever its numbers and beginnings; unless they take as much by chance.
  const ModelError proved = error(1000, 1004, 1000, 1014);
  EXPECT_TRUE(judged_with(3, proved, after, {}).admitted);
  EXPECT_TRUE(judged_with(3, proved, after, {}, "backlash", "amplifier_lag", 20).admitted);
  EXPECT_FALSE(judged_with(4, proved, after, {}).admitted);
}

TEST_F(Judging, WhatEveryRecordingShowsAboveTheNoiseIsTheNoise) {
  // A data sheet that says 7 % too little: 40 of 330 are a small share of what stands above it.
  const ModelError before = error(1150, 1180, 1150, 1180), after = error(1150, 1140, 1150, 1140);
  const TriedEffect weak = judged(before, after, {});
  EXPECT_TRUE(weak.admitted) << weak.reason;
  // Half of the recordings know better: what stands above the noise in the others is there.
  const TriedEffect patch = judged(error(1000, 1330, 1000, 1330), error(1000, 1290, 1000, 1290), {});
  EXPECT_FALSE(patch.admitted);
  EXPECT_TRUE(patch.patch) << patch.reason;
  // No sensor is as much noisier than it is said to be.
  EXPECT_FALSE(judged(error(1400, 1440, 1400, 1440), error(1400, 1400, 1400, 1400), {}).admitted);
}

TEST_F(Judging, WhoLeavesOnlyNoiseNeedNotTakeHalf) {
  // How large the noise is nobody knows to some per cent, so of 250 above 1000 rows half may be noise.
  EXPECT_TRUE(judged(error(1000, 1250, 1000, 1250), error(1000, 1150, 1000, 1150), {}).admitted);
  const TriedEffect little = judged(error(1000, 1250, 1000, 1250), error(1000, 1190, 1000, 1190), {});
  EXPECT_FALSE(little.admitted) << "a structure would have to take more";
  EXPECT_TRUE(little.patch);
  EXPECT_FALSE(judged(error(1000, 1650, 1000, 1650), error(1000, 1390, 1000, 1390), {}).admitted);
}

TEST_F(Judging, WhetherItIsAPatchAllRecordingsTell) {
  // Beside another effect that the judging recordings show: four fifths of all, two fifths of these.
  const ModelError before = error(1000, 5000, 1000, 2000);
  const TriedEffect t = judged(before, error(1000, 1500, 1000, 1600), {0, 1, 0, 1});
  EXPECT_TRUE(t.admitted) << t.reason;
  EXPECT_NEAR(t.share, 3900.0 / 5000, 1e-12);
  const TriedEffect fitted = judged(before, error(1000, 1100, 1000, 1800), {0, 1, 0, 1});
  EXPECT_FALSE(fitted.admitted) << "a fifth of what judges: it was fitted to the others";
  EXPECT_TRUE(fitted.patch);
}

TEST_F(Judging, WhereNobodyStatesTheNoiseAThirdOfTheRestIsEnough) {
  ModelError before = error(1000, 2000, 1000, 2000);
  const ModelError after = error(1000, 1600, 1000, 1600), little = error(1000, 1750, 1000, 1750);
  EXPECT_FALSE(judged(before, after, {0, 1, 0, 1}).admitted);
  before.noise_known = false;
  EXPECT_TRUE(judged(before, after, {0, 1, 0, 1}).admitted);
  EXPECT_FALSE(judged(before, little, {0, 1, 0, 1}).admitted);
  EXPECT_FALSE(judged(before, after, {}).admitted) << "the first effect takes half, as ever";
}

TEST_F(Judging, WhatLawsLeaveIsMeasuredBetweenAnyTwoModels) {
  CandidateModel before;
  before.error_of = error(1000, 1090, 1000, 1090);
  before.placed.emplace_back().effect = effects.find("hysteresis");
  const ModelError after = error(1000, 1050, 1000, 1050);
  const Effect &creep = effects.get("creep"), &friction = effects.get("friction");
  EXPECT_TRUE(more_than_laws_leave(creep, before, after, {}));
  EXPECT_TRUE(more_than_laws_leave(creep, before, after, {0, 30, 0, 30}));
  EXPECT_FALSE(more_than_laws_leave(creep, before, after, {0, 50, 0, 50}));
  EXPECT_TRUE(more_than_laws_leave(friction, before, after, {0, 0.5, 0, 0.5}));
  EXPECT_FALSE(more_than_laws_leave(friction, before, after, {0, 2, 0, 2})) << "elements that slip leave such";
  // In a fitted recording alone, too, but for what a fit takes away by itself.
  EXPECT_TRUE(more_than_laws_leave(creep, before, after, {50, 20, 50, 50}));
  EXPECT_FALSE(more_than_laws_leave(creep, before, after, {50, 35, 50, 50}));
  // Nor need it lie where the law acts most.
  EXPECT_TRUE(more_than_laws_leave(creep, before, after, {0, 0, 900, 0}));
  EXPECT_FALSE(more_than_laws_leave(friction, before, after, {0, 0, 2, 0}));
  // Structure before and noise behind it is no rest of a law, but what looks like one may be.
  before.error_of = error(1000, 1600, 1000, 1600);
  EXPECT_TRUE(more_than_laws_leave(creep, before, error(1000, 1010, 1000, 1010), {0, 900, 0, 900}));
  EXPECT_FALSE(more_than_laws_leave(friction, before, error(1000, 1010, 1000, 1010), {0, 900, 0, 900}));
}

TEST_F(Judging, ACurveIsWhatItTakesBeyondALine) {
  const Effect& curve = effects.get("sensor_nonlinearity");
  CandidateModel straight;
  straight.error_of = error(1000, 1090, 1000, 1090);
  straight.placed.emplace_back().effect = effects.find("creep");
  const ModelError after = error(1000, 1050, 1000, 1050);
  EXPECT_TRUE(more_than_a_line(curve, straight, after, {}));
  EXPECT_FALSE(more_than_a_line(curve, straight, error(1000, 1086, 1000, 1086), {})) << "no more than chance";
  EXPECT_TRUE(more_than_a_line(curve, straight, after, {0, 30, 0, 30}));
  EXPECT_FALSE(more_than_a_line(curve, straight, after, {0, 50, 0, 50})) << "no more than the creep may have left";
}

TEST_F(Judging, ARecordingTakenDownToTheNoiseIsOwnedByHalfOfIt) {
  // What the noise of a recording is nobody knows to some per cent: of 1200 over 1000 rows 1070 may be all noise.
  const std::vector<double> of_the_fast{0, 900, 0, 900};
  const TriedEffect t = judged(error(1200, 1900, 1180, 1900), error(1070, 1900, 1070, 1900), of_the_fast);
  EXPECT_TRUE(t.admitted) << t.reason;
  // The same share where structure stays is a patch.
  const TriedEffect patch = judged(error(1400, 1900, 1400, 1900), error(1150, 1900, 1150, 1900), of_the_fast);
  EXPECT_FALSE(patch.admitted);
  EXPECT_NE(patch.reason.find("not specific"), std::string::npos) << patch.reason;
}

TEST_F(Judging, OfTwoThatFitAlikeTheOneWithFewerNumbersIsTaken) {
  const auto of = [&](int numbers, double chi2) {
    TriedEffect t = judged(error(1400, 1900, 1400, 1900), error(1000, chi2, 1000, chi2), {0, 0, 0, 0});
    t.laws.resize(1);
    for (int i = 0; i < numbers; ++i) t.laws[0].free.push_back({.path = std::to_string(i)});
    t.candidate.parameters = 0;  // the score is the error alone
    return t;
  };
  EXPECT_EQ(best_admitted({of(4, 1000), of(2, 1000 + 0.4 * rules::alike)}), 1) << "0.8 of what is alike";
  EXPECT_EQ(best_admitted({of(4, 1000), of(2, 1000 + 0.6 * rules::alike)}), 0) << "the error decides";
  EXPECT_EQ(best_admitted({of(2, 1000), of(4, 1000)}), 0);
  TriedEffect barred = of(1, 1000);
  barred.admitted = false;
  EXPECT_EQ(best_admitted({of(4, 1000), barred}), 0);
}

}  // namespace
}  // namespace hysteron
