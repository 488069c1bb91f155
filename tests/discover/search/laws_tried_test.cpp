// What is recorded of the laws of a candidate: all that were tried, with what each takes away where, and why one was
// not taken.
#include "discover/search/laws_tried.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

/// A fit that leaves so much of chi2, with so many numbers of which each costs 5.
CandidateModel leaves(double chi2, int parameters) {
  CandidateModel c;
  c.ok = true;
  c.parameters = parameters;
  c.error_of.evidence_validate = chi2;
  c.error_of.effective_sample_size = std::exp(5.0);
  return c;
}

std::string why_not(const CandidateModel& richer, double for_the_same = 0) {
  Law plain;
  plain.name = "plain";
  return why_no_better(richer, leaves(100, 1), plain, for_the_same);
}

TEST(LawsTried, ALawIsNotTakenThatLeavesAsMuchOrCostsMore) {
  EXPECT_EQ(why_not(leaves(100, 2)), "explains no more than plain");
  EXPECT_EQ(why_not(leaves(97, 3)), "lowers chi2 by 3.0 more than plain, less than its further numbers cost (2)");
  EXPECT_EQ(why_not(leaves(94.5, 2), 1), "plain explains as much by fewer numbers");
  EXPECT_EQ(why_not(leaves(90, 2), 1), "");
}

TEST(LawsTried, OneThatIsTakenSaysWhyTheFormerIsNot) {
  TriedLaw plain{"plain", 1, 10, 5, {}, 50, true, false, ""}, richer{"richer", 2, 20, 9, {}, 42, true, false, ""};
  std::vector<TriedLaw> laws{plain};
  record(laws, richer);
  ASSERT_EQ(laws.size(), 2u);
  EXPECT_FALSE(laws[0].taken);
  EXPECT_EQ(laws[0].reason, "richer takes the score 8.0 further down");
  EXPECT_TRUE(laws[1].taken);
}

TEST(LawsTried, WhatCouldNotBeFittedSaysSoAndHasNoNumbers) {
  CandidateModel none;
  none.error = "the gap is wider than the range";
  Law law;
  law.name = "gap";
  const TriedLaw tried = tried_law(law, none, {});
  EXPECT_TRUE(tried.failed);
  EXPECT_TRUE(tried.fall_by_recording.empty());
  EXPECT_EQ(tried.reason, "could not be fitted: the gap is wider than the range");
}

class LawsTriedInRecordings : public Discoveries {
 protected:
  /// A sensor whose gain is 2 % low, and its zero 3 mm.
  static DataSet low_and_off_zero() {
    std::vector<Recording> list;
    for (const Role role : {Role::train, Role::train, Role::validate}) {
      const auto t = rows(400, 0.01);
      const auto u = several_sines(t, 1, {0.5, 0.9 + 0.2 * static_cast<double>(list.size())});
      auto y = noise(t.size(), 1e-3, 0, 30 + list.size());
      for (std::size_t k = 0; k < t.size(); ++k) y[k] += 0.98 * u[k] + 3e-3;
      list.push_back(recording(std::to_string(list.size()) + ".csv", role, t, u, y));
    }
    return data_set(std::move(list), 1e-3, 0);
  }
};

TEST_F(LawsTriedInRecordings, AllLawsOfACandidateStandInItAndEachRecordingHasItsShareOfTheFall) {
  const Discovery d = diagnosed(plain_gain(), low_and_off_zero(), {"calibration"});
  const auto c = std::find_if(d.candidates.begin(), d.candidates.end(), [](const auto& x) { return x.claimed; });
  ASSERT_NE(c, d.candidates.end()) << tried(d);
  ASSERT_GE(c->laws_tried.size(), 2u) << "a gain and a zero, and a zero alone";
  EXPECT_EQ(std::count_if(c->laws_tried.begin(), c->laws_tried.end(), [](const TriedLaw& l) { return l.taken; }), 1);
  for (const auto& law : c->laws_tried) {
    ASSERT_EQ(law.fall_by_recording.size(), c->error.recordings.size()) << law.law;
    double train = 0, validate = 0;
    for (std::size_t i = 0; i < law.fall_by_recording.size(); ++i)
      (c->error.recordings[i].role == Role::train ? train : validate) += law.fall_by_recording[i];
    EXPECT_NEAR(train, law.fall_train, 1e-9 * std::abs(law.fall_train)) << law.law;
    EXPECT_NEAR(validate, law.fall_validate, 1e-9 * std::abs(law.fall_validate)) << law.law;
    EXPECT_EQ(law.taken, law.law == c->law) << law.law;
    EXPECT_EQ(law.taken, law.reason.empty()) << law.law;
    if (law.taken) {
      EXPECT_GT(law.fall_validate, rules::claim_fall);
    }
  }
}

TEST_F(LawsTriedInRecordings, ACandidateOfOneLawHasThatOne) {
  const Discovery d = diagnosed(plain_gain(), low_and_off_zero(), {"dead_time"});
  ASSERT_FALSE(d.candidates.empty());
  for (const auto& c : d.candidates) {
    ASSERT_EQ(c.laws_tried.size(), 1u);
    const TriedLaw& law = c.laws_tried.front();
    EXPECT_EQ(law.law, c.law);
    EXPECT_EQ(law.fall_train, c.fall_train);
    EXPECT_EQ(law.score, c.score);
    EXPECT_NEAR(std::accumulate(law.fall_by_recording.begin(), law.fall_by_recording.end(), 0.0),
                c.fall_train + c.fall_validate, 1e-6);
  }
}

}  // namespace
}  // namespace hysteron
