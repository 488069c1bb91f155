// What a fit ends at need not be the effect, though it may fit.
#include <gtest/gtest.h>

#include "tests/discover/discoveries.h"

namespace hysteron {
namespace {

using namespace testing;

class Implausible : public Discoveries {
 protected:
  std::string why(const char* id, const std::vector<double>& values, std::size_t law = 0) {
    const Effect& e = effects.get(id);
    return e.implausible(e.laws(at).at(law), values, at);
  }
  Excitation at;
};

TEST_F(Implausible, APlayWithoutLostMotionIsOnlyAZero) {
  at.lowest = 0;
  at.highest = 2e-6;
  EXPECT_EQ(why("backlash", {1e-9}), "") << "half a thousandth of the range";
  EXPECT_NE(why("backlash", {0}).find("only a zero"), std::string::npos);
}

TEST_F(Implausible, AHysteresisWhoseSmallMotionIsLateTooIsALag) {
  EXPECT_EQ(why("rate_dependence", {1e-3, 0}), "") << "the operators are late";
  EXPECT_EQ(why("rate_dependence", {1e-3, 1}), "") << "their gap is";
  EXPECT_NE(why("rate_dependence", {1e-3, -0.5}).find("behind a lag"), std::string::npos);
}

TEST_F(Implausible, AModeThatIsNotSeenToRingIsNone) {
  at.shortest_step = 1e-3;  // 250 Hz are sampled four times a period
  at.longest_recording = 2;
  constexpr std::size_t two = 1;  // modes
  EXPECT_EQ(why("structural_resonance", {200, 0.03, 0.5, 0}), "");
  EXPECT_NE(why("structural_resonance", {250, 0.03, 0.5, 0}).find("four times a period"), std::string::npos);
  // One more beside it refines the shape, and may be quicker; not where it is most of the motion.
  EXPECT_EQ(why("structural_resonance", {200, 0.03, 0.5, 0, 420, 0.03, 0.2, 0}, two), "");
  EXPECT_NE(why("structural_resonance", {200, 0.03, 0.5, 0, 420, 0.03, 1.3, 0}, two).find("at 420 Hz"),
            std::string::npos);
}

TEST_F(Implausible, ALagAsSlowAsTheRecordingsIntegrates) {
  at.shortest_step = 1e-3;
  at.longest_recording = 3;
  EXPECT_EQ(why("amplifier_lag", {2}), "");
  EXPECT_NE(why("amplifier_lag", {3}).find("it integrates"), std::string::npos);
  constexpr std::size_t two = 1;  // poles
  EXPECT_NE(why("sensor_lag", {0.1, 3}, two).find("it integrates"), std::string::npos);
}

TEST_F(Implausible, AModeAtAMultipleOfTheDriveIsAHarmonic) {
  at.shortest_step = 1e-3;
  at.longest_recording = 10;
  EXPECT_EQ(why("structural_resonance", {9.004, 0.001, 0.5, 0}), "") << "nobody says how the drive moves";
  at.drive_cycles = {3, 3};
  EXPECT_NE(why("structural_resonance", {9.004, 0.001, 0.5, 0}).find("3 times the frequency of the drive"),
            std::string::npos);
  EXPECT_EQ(why("structural_resonance", {9.4, 0.001, 0.5, 0}), "");
  at.drive_cycles = {3, 2};
  EXPECT_EQ(why("structural_resonance", {9.004, 0.001, 0.5, 0}), "") << "of the other drive it is none";
}

TEST_F(Implausible, AGainThatIsTheModelsFarFromAllThatWasRecordedIsAWrongGain) {
  at.from_data = true;
  at.side_lowest = 295;
  at.side_highest = 340;
  EXPECT_EQ(why("temperature_gain", {1e-4, 300}), "");
  EXPECT_EQ(why("temperature_gain", {1e-4, 350}), "") << "10 K beyond: another season";
  EXPECT_NE(why("temperature_gain", {1e-4, 355}).find("right 15 K beyond"), std::string::npos);
  EXPECT_NE(why("temperature_gain", {1e-4, 280}).find("wrong gain"), std::string::npos);
}

}  // namespace
}  // namespace hysteron
