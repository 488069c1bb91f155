// Does a model still explain a recording as it stands: yes for its own output with noise, no with the name of what is
// new.
#include "discover/selection/check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "blocks/register_all.h"
#include "discover/effects/all.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

constexpr double noise_of_stroke = 1e-3;  // [m] of a stroke of 1 m

/// tau y' = u - y for u straight between rows, exactly; y = u at the start.
std::vector<double> lagged(const std::vector<double>& t, const std::vector<double>& u, double tau) {
  std::vector<double> y{u.front()};
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double slope = (u[k] - u[k - 1]) / (t[k] - t[k - 1]);
    y.push_back(u[k] - slope * tau + (y[k - 1] - u[k - 1] + slope * tau) * std::exp(-(t[k] - t[k - 1]) / tau));
  }
  return y;
}

/// A gain before a lag; creep by `creep` of the move per decade of time, as relaxations two per decade.
struct Plant {
  double gain = 1, tau = 0.05, creep = 0;

  std::vector<double> operator()(const std::vector<double>& t, const std::vector<double>& u) const {
    const auto moved = lagged(t, u, tau);
    std::vector<double> y;
    for (const double x : moved) y.push_back(gain * x);
    for (double slow = 0.1; slow < 1000; slow *= std::sqrt(10.0)) {
      const auto part = lagged(t, moved, slow);
      for (std::size_t k = 0; k < y.size(); ++k) y[k] += gain * creep / 2 * part[k];
    }
    return y;
  }
};

/// The model of the plant without creep; gain and time constant may be free.
Diagram model(bool free) {
  Diagram d = plain_gain();
  d.parameters["gain"].value = Value("1 m/V");
  d.parameters["gain"].free = free;
  d.blocks["stage"].parameters["gain"] = Value(Reference{"gain"});
  d.parameters["time"].value = Value("50 ms");
  d.parameters["time"].free = free;
  Node& lag = d.blocks["lag"];
  lag.type = "lag";
  lag.parameters["times"] = Value(Reference{"time"});
  lag.in = {{"", "stage"}};
  d.outputs["y"] = "lag";
  return d;
}

/// Steps with holds, and sines, each in one role; recorded with noise and a zero of `zero`.
DataSet recorded(const Plant& plant, std::uint64_t seed, double zero = 0, bool one_role = false) {
  std::vector<Recording> list;
  for (const Role role : {Role::train, Role::validate}) {
    for (const bool steps : {true, false}) {
      const auto t = rows(600, steps ? 0.05 : 0.01);
      const auto u = steps ? levels(t, {0.5, 1, 0.2, 0.7}) : several_sines(t, 1, {0.4, 1.7});
      auto y = plant(t, u);
      const auto n = noise(t.size(), noise_of_stroke, 0, ++seed);
      for (std::size_t k = 0; k < y.size(); ++k) y[k] += n[k] + zero * static_cast<double>(list.size());
      list.push_back(
          recording(std::to_string(list.size()) + ".csv", one_role ? Role::validate : role, t, u, std::move(y)));
    }
  }
  return data_set(std::move(list), noise_of_stroke, 0);
}

class Checks : public ::testing::Test {
 protected:
  Check checked(const Diagram& d, const DataSet& data) { return check(d, with_both_roles(data), registry, effects); }
  Registry registry = all_blocks();
  Effects effects = all_effects();
};

TEST_F(Checks, TheModelsOwnOutputWithNoiseIsExplainedForTwentySeeds) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Check c = checked(model(true), recorded({}, 1000 * seed));
    EXPECT_TRUE(c.explained) << "seed " << seed << ": " << c.sentence;
    EXPECT_TRUE(c.named.empty());
  }
}

TEST_F(Checks, TheMainsOfTheModelHasAnotherPhaseInEachRecording) {
  Diagram with_mains = plain_gain();
  Node& mains = with_mains.blocks["mains"];
  mains.type = "mains_interference";
  mains.parameters["frequency"] = Value("50 Hz");
  for (const char* part : {"cosine", "sine"}) mains.parameters[part] = Value(NumberList{Number{0, "m"}});
  mains.in = {{"", "stage"}};
  with_mains.outputs["y"] = "mains";
  std::vector<Recording> list;
  for (int r = 0; r < 4; ++r) {
    const auto t = rows(2000, 1e-3);
    const auto u = several_sines(t, 1, {1 + 0.3 * r, 3.1});
    auto y = noise(t.size(), noise_of_stroke, 0, 70 + static_cast<std::uint64_t>(r));
    for (std::size_t k = 0; k < t.size(); ++k) y[k] += u[k] + 5e-3 * std::sin(2 * std::numbers::pi * 50 * t[k] + r);
    list.push_back(recording(std::to_string(r) + ".csv", r < 2 ? Role::train : Role::validate, t, u, y));
  }
  const DataSet data = data_set(std::move(list), noise_of_stroke, 0);
  const Check with = checked(with_mains, data), without = checked(plain_gain(), data);
  EXPECT_TRUE(with.explained) << with.sentence;
  EXPECT_EQ(without.named, std::vector<std::string>{"mains_interference"}) << without.sentence;
}

TEST_F(Checks, CreepThatWasNotThereBeforeIsNamed) {
  for (const bool free : {false, true}) {
    const Check c = checked(model(free), recorded({.creep = 0.015}, 1));
    EXPECT_FALSE(c.explained) << c.sentence;
    EXPECT_FALSE(c.moved) << c.sentence;
    EXPECT_EQ(c.named, std::vector<std::string>{"creep"}) << c.sentence;
  }
}

TEST_F(Checks, AGainThatMovedIsACalibrationWhereItIsHeldAndAParameterWhereItIsFree) {
  const DataSet data = recorded({.gain = 1.05}, 2);
  const Check held = checked(model(false), data);
  EXPECT_FALSE(held.explained);
  EXPECT_EQ(held.named, std::vector<std::string>{"calibration"}) << held.sentence;
  const Check free = checked(model(true), data);
  EXPECT_FALSE(free.explained) << "it is not refitted and then called explained: " << free.sentence;
  EXPECT_TRUE(free.moved);
  EXPECT_EQ(free.named, std::vector<std::string>{"parameters"});
  EXPECT_NE(free.sentence.find("gain 1.05 (was 1)"), std::string::npos) << free.sentence;
}

TEST_F(Checks, ATimeConstantThatMovedIsAParameterAndNoEffect) {
  const Check c = checked(model(true), recorded({.tau = 0.0525}, 3));
  EXPECT_FALSE(c.explained);
  EXPECT_EQ(c.named, std::vector<std::string>{"parameters"}) << c.sentence;
  EXPECT_NE(c.sentence.find("time[0] 52."), std::string::npos) << c.sentence;
}

TEST_F(Checks, AZeroOfEachRecordingIsNotTheModels) {
  DataSet data = recorded({}, 4, 0.1);
  EXPECT_FALSE(checked(model(true), data).explained) << "a hundred times the noise";
  data.notes["y"].zero_per_recording = true;
  const Check c = checked(model(true), data);
  EXPECT_TRUE(c.explained) << c.sentence;
}

TEST_F(Checks, NewRecordingsOfOneRoleAreCutInTime) {
  const DataSet cut = with_both_roles(recorded({}, 5, 0, true));
  ASSERT_EQ(cut.recordings.size(), 8u);
  for (std::size_t r = 0; r < 4; ++r) {
    EXPECT_EQ(cut.recordings[r].role, Role::train);
    EXPECT_EQ(cut.recordings[r + 4].role, Role::validate);
    EXPECT_EQ(cut.recordings[r].last, cut.recordings[r + 4].first) << "each row is in one of the two";
    EXPECT_NEAR(static_cast<double>(cut.recordings[r].last), 360, 1) << "60 % of 600 rows";
  }
  EXPECT_EQ(cut.remarks.size(), 4u) << "and that is said";
  EXPECT_TRUE(checked(model(true), recorded({}, 5, 0, true)).explained);
  // The second half of one staircase judges what the first half taught: the name is certain, its law less so.
  const Check creep = checked(model(true), recorded({.creep = 0.015}, 6, 0, true));
  ASSERT_FALSE(creep.named.empty()) << creep.sentence;
  EXPECT_EQ(creep.named.front(), "creep") << creep.sentence;
}

}  // namespace
}  // namespace hysteron
