// Who is a rival of whom: an effect whose law holds another one's with numbers to spare is none. On two candidates of
// which only the names, the laws and the falls matter.
#include <gtest/gtest.h>

#include "discover/search/search_state.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

/// Two candidates that explain the same, on recordings that a gain explains.
class Rivals : public Discoveries {
 protected:
  Rivals() : state_(diagram_, data_, registry, effects, options_), tried_(2) {
    fit_base(state_);
    for (auto& t : tried_) {
      t.candidate.ok = t.admitted = true;
      t.laws.resize(1);
    }
  }
  void are(const char* winner, const char* other) {
    tried_[0].effect = &effects.get(winner);
    tried_[1].effect = &effects.get(other);
  }
  std::vector<int> ties(const char* winner, const char* other) {
    are(winner, other);
    return ties_of(state_, tried_, 0);
  }
  static DataSet sines() {
    const auto t = rows(400, 0.005);
    const auto u = several_sines(t, 1, {1.1, 3.7});
    return data_set({recording("a.csv", Role::train, t, u, u), recording("b.csv", Role::validate, t, u, u)}, 1e-3);
  }
  const Diagram diagram_ = plain_gain();
  const DataSet data_ = sines();
  const DiscoverOptions options_;
  SearchState state_;
  std::vector<TriedEffect> tried_;
};

TEST_F(Rivals, WhatACurveAloneTakesAwayIsNoLawsThatCouldHoldIt) {
  tried_[0].fall_train = tried_[0].fall_validate = 1000;
  tried_[1].fall_train = tried_[1].fall_validate = 950;
  const auto first = [&](const char* winner, const char* other) {
    are(winner, other);
    return held_one_first(state_, tried_, 0);
  };
  EXPECT_EQ(first("hysteresis", "asymmetry"), 0) << "plays of a straight drive hold no curve";
  tried_[0].laws[0].holds = {"asymmetry"};
  EXPECT_EQ(first("hysteresis", "asymmetry"), 1);
  EXPECT_EQ(first("hysteresis", "saturation"), 1) << "it looks like an asymmetry";
  EXPECT_EQ(first("hysteresis", "creep"), 0);
  tried_[0].laws[0].holds = {"stiffening"};
  EXPECT_EQ(first("hysteresis", "friction"), 0) << "it looks like a stiffening spring, and remembers, as none does";
  tried_[0].laws[0].holds = {"asymmetry"};
  tried_[1].fall_validate = 850;
  EXPECT_EQ(first("hysteresis", "asymmetry"), 0) << "less than nine tenths on recordings not used for the fit";
}

TEST_F(Rivals, WhoCouldHoldTheWinnerAndExplainsNoMoreIsNone) {
  EXPECT_EQ(ties("stiffening", "hysteresis"), std::vector<int>{1});
  EXPECT_EQ(ties("ageing", "asymmetry"), std::vector<int>{1});
  EXPECT_TRUE(ties("calibration", "asymmetry").empty()) << "a curve without bend is a gain and a zero";
  EXPECT_TRUE(ties("calibration", "sensor_nonlinearity").empty());
  tried_[1].laws[0].holds = {"stiffening"};
  EXPECT_TRUE(ties("stiffening", "hysteresis").empty()) << "a spring that remembers little is a stiffening one";
  EXPECT_EQ(ties("creep", "hysteresis"), std::vector<int>{1});
}

}  // namespace
}  // namespace hysteron
