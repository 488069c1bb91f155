// The reference itself, held against closed forms: what judges the program must be right on its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <regex>

#include "tests/io/temporary_folder.h"
#include "tests/reference/reference.h"

namespace reference {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;

Result result_of(const std::string& blocks, const std::string& record, const std::string& name, double disturbed = 0) {
  const hysteron::TemporaryFolder folder;
  const fs::path file = folder.path(name + ".json");
  std::ofstream(file) << R"({"format": 1, "blocks": {)" << blocks << R"(}, "record": [)" << record
                      << R"(], "simulate": {"until": "3 s", "every": "10 ms"}})";
  Settings settings;
  settings.disturbed = disturbed;
  return simulate(read_flat(file.string()), settings);
}

TEST(Reference, ARelayOnASineIsOnHalfOfTheTime) {
  const Result r = result_of(
      R"("s": {"type": "sine", "amplitude": 1, "frequency": "1 Hz"},
         "r": {"type": "relay", "on_at": 0.5, "off_at": -0.5, "on_value": "1 1/s", "off_value": "0 1/s", "in": "s"},
         "i": {"type": "integrator", "in": "r"})",
      R"("i")", "relay");
  EXPECT_NEAR(r.values[0].back(), 1.5, 1e-12);  // switched at 1/12 s and 7/12 s of each second, located to rounding
}

TEST(Reference, AHalfWaveIsIntegratedWithItsCorners) {
  const Result r = result_of(
      R"("s": {"type": "sine", "amplitude": 1, "frequency": "1 Hz"},
         "p": {"type": "rectifier", "mix": 0.5, "in": "s"},
         "g": {"type": "gain", "gain": "1 1/s", "in": "p"},
         "q": {"type": "integrator", "in": "g"})",
      R"("q")", "half_wave");
  EXPECT_NEAR(r.values[0].back(), 3 / pi, 1e-11);  // 1/pi in each period
}

TEST(Reference, ADeadTimeIsTheSineAsItWas) {
  const Result r = result_of(
      R"("s": {"type": "sine", "amplitude": 1.6, "frequency": "0.8 Hz"},
         "d": {"type": "dead_time", "delay": "0.2513 s", "in": "s"})",
      R"("d")", "dead_time");
  for (std::size_t k = 0; k < r.t.size(); ++k) {
    const double past = r.t[k] - 0.2513;  // a cubic over 1e-4 s is good to 1e-15
    EXPECT_NEAR(r.values[0][k], past < 0 ? 0 : 1.6 * std::sin(2 * pi * 0.8 * past), 1e-11) << r.t[k];
  }
}

TEST(Reference, BoucWenIsItsExponentials) {
  // On a rising line from 0: z = alpha/(beta + gamma) (1 - exp(-(beta + gamma) u)).
  const Result r = result_of(
      R"("s": {"type": "triangle", "amplitude": 3, "offset": 3, "frequency": "0.1 Hz", "phase": "-90 deg"},
         "b": {"type": "bouc_wen", "alpha": 0.6187, "beta": 0.2418, "gamma": 0.0237, "d_p": 1.6126, "in": "s"})",
      R"("s", "b")", "bouc_wen");
  const double u = r.values[0].back(), rate = 0.2418 + 0.0237;
  EXPECT_NEAR(u, 3.6, 1e-12);
  EXPECT_NEAR(r.values[1].back(), 1.6126 * u - 0.6187 / rate * (1 - std::exp(-rate * u)), 1e-11);
}

TEST(Reference, JilesAthertonIsThePublishedLoop) {
  // Specification of the thesis, Table 2.2: the virgin curve reaches 3.572624 at 3 V.
  const Result r = result_of(
      R"("s": {"type": "triangle", "amplitude": 1.5, "offset": 1.5, "frequency": "0.166666666666667 Hz", "phase": "-90 deg"},
         "j": {"type": "jiles_atherton", "p_s": 55.9973, "a": 48.5843, "alpha": 0.2512, "k": 3.8892, "c": 0.6929, "in": "s"})",
      R"("j")", "jiles_atherton");
  EXPECT_NEAR(r.values[0].back(), 3.572624, 1e-6);  // its last printed digit
}

TEST(Reference, AMassBreaksAwayAtThePush) {
  // 1.2 N constant, breakaway 1 N, coulomb 0.8 N on 1 kg: it slides from the start at 0.4 m/s^2.
  const Result r = result_of(
      R"("f": {"type": "constant", "value": "1.2 N"},
         "m": {"type": "mass_with_friction", "mass": "1 kg", "coulomb": "0.8 N", "breakaway": "1 N", "in": "f"})",
      R"("m.position", "m.velocity")", "breakaway");
  EXPECT_NEAR(r.values[1].back(), 1.2, 1e-10);
  EXPECT_NEAR(r.values[0].back(), 1.8, 1e-10);
}

TEST(Reference, ABallLosesItsSpeedAtEachImpact) {
  // From 0.5 m without speed under 9.81 N on 1 kg onto a stop at 0: impact at sqrt(2 0.5/9.81) s, then half the speed,
  // so that the next flight lasts as long as the fall did and rises to an eighth of a metre.
  const Result r = result_of(
      R"("f": {"type": "constant", "value": "-9.81 N"},
         "m": {"type": "mass_with_stops", "mass": "1 kg", "lower": "0 m", "upper": "1 m", "restitution": 0.5,
               "initial_position": "0.5 m", "in": "f"})",
      R"("m.position")", "ball");
  const double fall = std::sqrt(1 / 9.81), speed = 9.81 * fall / 2;
  const double since = 0.4 - fall;
  EXPECT_NEAR(r.values[0][40], speed * since - 9.81 / 2 * since * since, 1e-10);
  EXPECT_NEAR(r.values[0].back(), 0, 1e-12);  // the series of impacts is over after 3 falls
}

TEST(Reference, ASampleReadsWhatIsThereAtItsInstant) {
  const Result r = result_of(
      R"("s": {"type": "step", "after": 1, "time": "0.1 s"},
         "r": {"type": "relay", "on_at": 0.5, "off_at": 0.2, "on_value": 3, "off_value": 0, "in": "s"},
         "h": {"type": "sample_hold", "period": "0.1 s", "in": "r"},
         "d": {"type": "delay_line", "period": "0.1 s", "samples": 1, "in": "h"})",
      R"("h", "d")", "sample");
  EXPECT_EQ(r.values[0][9], 0);
  EXPECT_EQ(r.values[0][10], 3);
  EXPECT_EQ(r.values[1][19], 0);
  EXPECT_EQ(r.values[1][20], 3);
}

TEST(Reference, NoLineOfTheProgramIsInIt) {
  const std::regex include("#include \"([a-z_]+)/([a-z_]*)");
  int looked_at = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(HYSTERON_SOURCE_DIR) / "tests/reference")) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("judge") || name.ends_with("_test.cpp") || name == "CMakeLists.txt") continue;
    ++looked_at;
    std::ifstream in(entry.path());
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    for (std::sregex_iterator i(text.begin(), text.end(), include), end; i != end; ++i)
      EXPECT_EQ((*i)[1].str() + "/" + (*i)[2].str(), "tests/reference") << name;
  }
  EXPECT_GT(looked_at, 10);
}

}  // namespace
}  // namespace reference
