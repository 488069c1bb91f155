// Rules that two effects at once need: a wrong zero beside a law that moves it, the same effect on both axes, friction
// of a guide without a mass.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "discover/models/parts.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;
using std::numbers::pi;

constexpr double white = 2e-4;

/// A gain of 1 m/V and a sensor behind it.
Diagram with_sensor(const std::string& number = "") {
  Diagram d;
  d.inputs["u" + number].unit = "V";
  Node& stage = d.blocks["stage" + number];
  stage.type = "gain";
  stage.parameters["gain"] = Value("1 m/V");
  stage.in = {{"", "u" + number}};
  Node& sensor = d.blocks["sensor" + number];
  sensor.type = "calibration";
  sensor.parameters["gain"] = Value(1.0);
  sensor.parameters["offset"] = Value("0 m");
  sensor.in = {{"", "stage" + number}};
  d.outputs["y" + number] = "sensor" + number;
  return d;
}

Diagram two_axes() {
  Diagram d = with_sensor();
  const Diagram second = with_sensor("2");
  d.inputs["u2"] = *second.inputs.find("u2");
  for (const auto& [name, node] : second.blocks) d.blocks[name] = node;
  d.outputs["y2"] = "sensor2";
  return d;
}

/// What the recordings of one device are made by: y from t, u and the temperature.
using Law = std::function<double(double t, double u, double warmer)>;

std::vector<double> by(const Law& law, const std::vector<double>& t, const std::vector<double>& u,
                       const std::vector<double>& temperature, std::uint64_t seed) {
  auto y = noise(t.size(), white, 0.1 * white, seed);
  for (std::size_t k = 0; k < y.size(); ++k) y[k] += law(t[k], u[k], temperature[k] - 295);
  return y;
}

/// Two recordings at room temperature, and one of either role over 12 K.
DataSet measured(const Law& first, const Law& second) {
  std::vector<Recording> list;
  std::uint64_t seed = 60;
  for (const auto& [role, kelvin, hertz] : {std::tuple{Role::train, 0.0, 1.1},
                                            {Role::train, 12.0, 1.7},
                                            {Role::validate, 0.0, 2.3},
                                            {Role::validate, 12.0, 0.9}}) {
    const auto t = rows(1000, 0.005);
    const auto u = several_sines(t, 1, {hertz, 3.1 * hertz});
    const auto u2 = several_sines(t, 0.9, {1.3 * hertz, 4.4 * hertz});
    const auto warm = sampled(t, [k = kelvin](double x) { return 295 + k * x / 5; });
    Recording r = recording(std::to_string(seed) + ".csv", role, t, u, by(first, t, u, warm, seed));
    r.columns["u2"] = u2;
    r.columns["y2"] = by(second, t, u2, warm, seed + 100);
    r.columns["T"] = warm;
    r.units["u2"] = parse_unit("V");
    r.units["y2"] = parse_unit("m");
    r.units["T"] = parse_unit("K");
    list.push_back(std::move(r));
    ++seed;
  }
  DataSet d = data_set(std::move(list), white);
  d.notes["u2"].to = "u2";
  d.notes["y2"] = d.notes["y"];
  d.notes["y2"].to = "y2";
  d.notes["T"].to = "T";
  return d;
}

/// The same laws on one axis alone.
DataSet one_axis(DataSet d) {
  for (const char* name : {"u2", "y2"}) {
    d.notes.erase(name);
    for (auto& r : d.recordings) {
      r.columns.erase(name);
      r.units.erase(name);
    }
  }
  return d;
}

/// How the recordings of one device were made: of each its role and the number by which its drive differs.
using Runs = std::vector<std::pair<Role, double>>;
using Drive = std::function<std::vector<double>(const std::vector<double>& t, double number)>;
using Answer = std::function<std::vector<double>(const std::vector<double>& u)>;

/// Rows of 5 ms, with noise of one seed after the other from `seed` on.
DataSet one_device(const Runs& runs, std::size_t count, const Drive& drive, const Answer& answer, std::uint64_t seed) {
  std::vector<Recording> list;
  for (const auto& [role, number] : runs) {
    const auto t = rows(count, 0.005);
    const auto u = drive(t, number);
    auto y = answer(u);
    const auto n = noise(t.size(), white, 0.1 * white, seed);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += n[k];
    list.push_back(recording(std::to_string(seed++) + ".csv", role, t, u, std::move(y)));
  }
  return data_set(std::move(list), white);
}

std::vector<double> swinging(const std::vector<double>& t, double top) { return decaying_triangle(t, top, 6); }

class Pairs : public Discoveries {
 protected:
  static std::set<std::string> names(const Discovery& d) {
    std::set<std::string> list;
    for (const auto& s : d.steps) list.insert(s.winner.effect);
    return list;
  }
};

using Names = std::set<std::string>;

TEST_F(Pairs, WhatActsOnBothAxesIsOneFindingAndLeavesRoomForAnother) {
  // Temperature on both axes and a curve on both: four places, two effects.
  const Law law = [](double, double u, double warmer) { return u * (1 + 0.002 * warmer) + 0.004 * u * (1 - u); };
  const std::vector<std::string> only{"temperature_gain", "sensor_nonlinearity", "thermal_expansion", "ageing"};
  const auto d = discovered(two_axes(), measured(law, law), only);
  EXPECT_EQ(names(d), (Names{"temperature_gain", "sensor_nonlinearity"})) << tried(d);
  ASSERT_EQ(d.steps.size(), 2u) << tried(d);
  for (const auto& step : d.steps) EXPECT_EQ(step.winner.also_at.size(), 1u) << tried(d);
  EXPECT_EQ(d.remainder, Remainder::noise);
}

TEST_F(Pairs, NothingDependsOnTheNumberOfThreads) {
  const Law law = [](double, double u, double warmer) { return u * (1 + 0.002 * warmer) + 0.004 * u * (1 - u); };
  const DataSet data = measured(law, law);
  const std::vector<std::string> only{"temperature_gain", "sensor_nonlinearity", "thermal_expansion", "ageing",
                                      "calibration"};
  DiscoverOptions alone, together;
  together.threads = 3;
  const auto one = discovered(two_axes(), data, only, alone), three = discovered(two_axes(), data, only, together);
  EXPECT_EQ(tried(one), tried(three));
  EXPECT_EQ(one.model_runs, three.model_runs);
  ASSERT_EQ(one.candidates.size(), three.candidates.size());
  for (std::size_t i = 0; i < one.candidates.size(); ++i)
    EXPECT_EQ(one.candidates[i].score, three.candidates[i].score) << one.candidates[i].effect;
}

TEST_F(Pairs, AnEffectOfOneAxisIsNotTakenToTheOther) {
  const Law warm = [](double, double u, double warmer) { return u * (1 + 0.002 * warmer); };
  const Law curved = [](double, double u, double) { return u + 0.02 * u * (1 - u); };
  const auto d =
      discovered(two_axes(), measured(warm, curved), {"temperature_gain", "sensor_nonlinearity", "calibration"});
  EXPECT_EQ(names(d), (Names{"temperature_gain", "sensor_nonlinearity"})) << tried(d);
  EXPECT_EQ(d.steps.size(), 2u) << tried(d);
}

TEST_F(Pairs, WhatOneAxisAloneSaysALittleIsNotClaimedOnBoth) {
  const Law law = [](double, double u, double warmer) { return u * (1 + 1e-5 * warmer); };
  const Law none = [](double, double u, double) { return u; };
  const auto d = discovered(two_axes(), measured(law, none), {"temperature_gain", "creep", "amplifier_lag"});
  EXPECT_EQ(d.verdict, Verdict::adequate) << tried(d);
}

TEST_F(Pairs, AnotherDaysTemperatureIsNoWrongZero) {
  // The model's zero was found at 293 K.
  const Law law = [](double, double u, double warmer) { return u + 0.001 * (warmer + 2); };
  const auto d = discovered(with_sensor(), one_axis(measured(law, law)), {"thermal_expansion", "calibration", "creep"});
  EXPECT_EQ(names(d), (Names{"thermal_expansion"})) << tried(d);
}

TEST_F(Pairs, AWrongZeroIsSeenBesideWhatLeavesOnlyNoise) {
  // One standard deviation of the noise in every row is one coefficient in each recording: chi2 per row is about one.
  const Law law = [](double, double u, double warmer) { return u * (1 + 0.002 * warmer) + 1.5 * white; };
  const auto d = discovered(with_sensor(), one_axis(measured(law, law)), {"temperature_gain", "calibration"});
  EXPECT_EQ(names(d), (Names{"temperature_gain", "calibration"})) << tried(d);
}

TEST_F(Pairs, WhatIsSlowIsLookedForThoughItIsAFewCoefficientsOnly) {
  // Steps that are held for 5 s behind a wrong gain; what follows them with 1.5 s leaves 0.9 times the noise beside it,
  // in the slowest cosines alone: chi2 per row stays below the gate.
  const Drive steps = [](const auto& t, double top) {
    return sampled(t, [top](double x) { return x < 0.5 ? 0 : x < 5.5 ? top : 0.3 * top; });
  };
  const Answer slow = [](const std::vector<double>& u) {
    std::vector<double> y;
    double late = 0;
    for (std::size_t k = 0; k < u.size(); ++k) {
      if (k > 0) late += (u[k] - late) * (1 - std::exp(-0.005 / 1.5));
      y.push_back(1.02 * u[k] + 4 * white * late);
    }
    return y;
  };
  const auto data = one_device({{Role::train, 1.0}, {Role::train, 0.7}, {Role::validate, 0.9}}, 2000, steps, slow, 70);
  const auto d = discovered(with_sensor(), data, {"calibration", "creep", "hysteresis", "asymmetry"}, exact());
  EXPECT_TRUE(names(d).contains("creep")) << tried(d);
  EXPECT_EQ(names(d).size(), 2u) << "and a gain, or a curve that bends by what the logarithm of time is not: "
                                 << tried(d);
  EXPECT_LT(d.final_error.rms_validate, 1.1 * white) << tried(d);
}

/// A guide with Coulomb friction holds `level` back, and takes `way` to slide: bristles by closed form between rows,
/// the motion that balances them by halving. It holds `excess` more before it slides fast, by the speed of the motion,
/// a row long, over `fast` per row.
std::vector<double> guided(const std::vector<double>& u, double level, double way, double excess = 0, double fast = 1) {
  std::vector<double> y{u.front()};
  double z = 0;
  for (std::size_t k = 1; k < u.size(); ++k) {
    const double end = u[k] > u[k - 1] ? 1 : -1;
    const auto bristles = [&](double step) {
      const double most = 1 + excess * std::exp(-step * step / (fast * fast));
      return end * most + (z - end * most) * std::exp(-step / (way * most));
    };
    double low = 0, high = std::abs(u[k] - u[k - 1]) + 2 * level;
    for (int i = 0; i < 60; ++i) {
      const double mid = (low + high) / 2;
      (end * (y.back() - u[k]) + mid + end * level * bristles(mid) > 0 ? high : low) = mid;
    }
    z = bristles(low);
    y.push_back(y.back() + end * low);
  }
  return y;
}

TEST_F(Pairs, FrictionOfAGuideNeedsNoMass) {
  const Answer guide = [](const auto& u) { return guided(u, 0.003, 0.02); };
  const auto data =
      one_device({{Role::train, 1.0}, {Role::train, 0.4}, {Role::validate, 0.7}}, 1500, swinging, guide, 90);
  const auto d = discovered(with_sensor(), data, {"friction", "hysteresis", "backlash", "creep", "asymmetry"});
  EXPECT_EQ(names(d), (Names{"friction"})) << tried(d);
  // Of 15 sigma of level half a sigma per turn is left; the way is known from its 30 rows per turn.
  EXPECT_NEAR(value(d, "level"), 0.003, 1e-4);
  EXPECT_NEAR(value(d, "slip_distance"), 0.02, 0.002);
}

TEST_F(Pairs, AStickyGuideHoldsMoreBeforeItSlidesFast) {
  const Drive sine = [](const auto& t, double hertz) {
    return sampled(t, [hertz](double x) { return std::sin(2 * pi * hertz * x); });
  };
  // 2 m/s: as fast as the middle one of the three.
  const Answer guide = [](const auto& u) { return guided(u, 0.01, 0.02, 0.4, 0.01); };
  const auto data = one_device({{Role::train, 0.2}, {Role::train, 2.0}, {Role::validate, 0.7}}, 1500, sine, guide, 95);
  const auto d = discovered(with_sensor(), data, {"friction", "hysteresis", "backlash", "creep", "asymmetry"});
  EXPECT_EQ(names(d), (Names{"friction"})) << tried(d);
  EXPECT_EQ(d.remainder, Remainder::noise) << tried(d);
  // The law goes by the speed of the free motion, the data by that of the motion: the same while it slides.
  EXPECT_NEAR(value(d, "level"), 0.01, 5e-4);
  EXPECT_NEAR(value(d, "excess"), 0.4, 0.06);
}

TEST_F(Pairs, FrictionOfAGuideShowsInStepsThatAreHeld) {
  // A staircase up and down, held between its rows: each of its jumps is a ramp too fast for any excess.
  const Drive stairs = [](const auto& t, double top) {
    return sampled(t, [top](double x) { return top / 6 * std::floor(6 * std::sin(2 * pi * 0.4 * x) + 0.5); });
  };
  const Answer guide = [](const auto& u) { return guided(u, 0.01, 0.05); };
  auto data = one_device({{Role::train, 1.0}, {Role::train, 0.5}, {Role::validate, 0.7}}, 1500, stairs, guide, 130);
  data.notes["u"].between = Between::hold;
  const auto d = discovered(with_sensor(), data, {"friction", "hysteresis", "backlash", "asymmetry"});
  EXPECT_EQ(names(d), (Names{"friction"})) << tried(d);
  EXPECT_NEAR(value(d, "level"), 0.01, 5e-4);
}

TEST_F(Pairs, LostMotionWithSoftFlanksStaysLostMotionBesideACurve) {
  // Five flanks that touch one after the other: bristles that slip at once fit them better than one gap does.
  const Answer flanks = [](const std::vector<double>& u) {
    std::vector<double> w(5, 0.0), y;
    for (const double x : u) {
      double sum = 0;
      for (std::size_t i = 0; i < w.size(); ++i) {
        const double half = 0.005 * (0.9 + 0.05 * static_cast<double>(i));
        w[i] = std::max(x - half, std::min(x + half, w[i]));
        sum += w[i] / 5;
      }
      y.push_back(sum + 0.004 * sum * (1 - sum));
    }
    return y;
  };
  const auto data =
      one_device({{Role::train, 1.0}, {Role::train, 0.5}, {Role::validate, 0.8}}, 1500, swinging, flanks, 120);
  const auto d = discovered(with_sensor(), data, {"friction", "hysteresis", "backlash", "sensor_nonlinearity"});
  EXPECT_EQ(names(d), (Names{"backlash", "sensor_nonlinearity"})) << tried(d);
}

TEST(PartsOfAModel, AxesWithNothingBetweenThemAreFittedApart) {
  const Registry registry = all_blocks();
  CandidateModel c;
  c.diagram = two_axes();
  c.program = compile(c.diagram, registry);
  ASSERT_EQ(parts_of(c, {}).size(), 2u);
  EXPECT_EQ(parts_of(c, {})[1].outputs, std::vector<std::string>{"y2"});
  EXPECT_EQ(parts_of(c, {"stage.gain"}).size(), 2u) << "a free gain of one axis couples nothing";
  c.diagram.blocks["stage2"].in = {{"", "u"}};
  c.diagram.blocks["sensor2"].in = {{"", "stage"}};
  c.diagram.blocks.erase("stage2");
  c.diagram.inputs.erase("u2");
  c.program = compile(c.diagram, registry);
  EXPECT_EQ(parts_of(c, {}).size(), 2u) << "one drive does not couple what nobody fits";
  EXPECT_EQ(parts_of(c, {"stage.gain"}).size(), 1u) << "a free gain before both does";
  const auto seen = compile(seen_at(c.diagram, {"y2"}), registry);
  EXPECT_EQ(seen->output_names, std::vector<std::string>{"y2"});
  EXPECT_EQ(seen->parameters.size(), c.program->parameters.size()) << "values of one hold for the other";
}

/// The same with y and y2 under the names of the elements of one output.
DataSet as_elements_of_y(DataSet d) {
  for (const auto& [name, element] : {std::pair{"y", "y[0]"}, {"y2", "y[1]"}}) {
    auto note = d.notes.extract(name);
    note.key() = note.mapped().to = element;
    d.notes.insert(std::move(note));
    for (auto& r : d.recordings) {
      r.columns[element] = std::move(r.columns.at(name));
      r.units[element] = r.units.at(name);
      r.columns.erase(name);
      r.units.erase(name);
    }
  }
  return d;
}

TEST_F(Pairs, OutputsThatAreElementsOfOneSignalAreJudgedAsAnyOther) {
  Diagram d = two_axes();
  Node& both = d.blocks["both"];
  both.type = "mux";
  both.in = {{"", "sensor"}, {"", "sensor2"}};
  d.outputs = {};
  d.outputs["y"] = "both";
  DataSet data = measured([](double, double u, double warmer) { return u * (1 + 0.002 * warmer); },
                          [](double, double u, double) { return u + 0.004 * u * (1 - u); });
  const auto found =
      discovered(d, as_elements_of_y(std::move(data)), {"temperature_gain", "sensor_nonlinearity", "ageing"});
  EXPECT_EQ(names(found), (Names{"temperature_gain", "sensor_nonlinearity"})) << tried(found);
}

TEST_F(Pairs, AnOutputThatNobodyMeasuredIsInNobodysWay) {
  const Diagram axes = two_axes();
  Diagram d = axes;
  d.outputs = {};
  d.outputs["drive"] = "u2";  // before those that were measured
  d.outputs["moved"] = "stage";
  for (const auto& [name, from] : axes.outputs) d.outputs[name] = from;
  const Law warm = [](double, double u, double warmer) { return u * (1 + 0.002 * warmer); };
  const Law curved = [](double, double u, double) { return u + 0.02 * u * (1 - u); };
  const std::vector<std::string> only{"temperature_gain", "sensor_nonlinearity", "calibration"};
  const auto found = discovered(d, measured(warm, curved), only);
  EXPECT_EQ(names(found), (Names{"temperature_gain", "sensor_nonlinearity"})) << tried(found);
  EXPECT_EQ(found.steps.size(), 2u) << tried(found);
}

/// Ten recordings of one axis, of which one of either role is warm.
DataSet one_warm_of_five(const Law& law) {
  std::vector<Recording> list;
  for (int k = 0; k < 10; ++k) {
    const auto t = rows(1000, 0.005);
    const auto u = several_sines(t, 1, {7 + 0.2 * k, 29 + 0.3 * k});
    const auto warm = sampled(t, [k](double x) { return 295 + (k % 5 == 4 ? 12 * x / 5 : 0.0); });
    const auto seed = static_cast<std::uint64_t>(300 + k);
    Recording r =
        recording(std::to_string(k) + ".csv", k < 5 ? Role::train : Role::validate, t, u, by(law, t, u, warm, seed));
    r.columns["T"] = warm;
    r.units["T"] = parse_unit("K");
    list.push_back(std::move(r));
  }
  DataSet d = data_set(std::move(list), white);
  d.notes["T"].to = "T";
  return d;
}

TEST_F(Pairs, WhatShowsInOneKindOfRecordingAloneIsLookedFor) {
  // The gain by temperature is as large as the noise in the warm recordings, none in the others: chi2 is 1.09 per
  // row of all, which passes for noise, and 1.5 in the warm ones.
  const Law law = [](double, double u, double warmer) { return u * (1 + 9e-5 * warmer) + 0.004 * u * (1 - u); };
  const auto d = discovered(with_sensor(), one_warm_of_five(law),
                            {"temperature_gain", "sensor_nonlinearity", "asymmetry", "calibration"});
  EXPECT_TRUE(names(d).contains("temperature_gain")) << tried(d);
  EXPECT_EQ(names(d).size(), 2u) << tried(d);
}

/// Warmth raises the gain, use lowers it, and recordings of both kinds hide one behind the other. `lost`: half of the
/// motion that a joint loses besides.
DataSet warm_and_worn(double lost = 0) {
  std::vector<Recording> list;
  for (int k = 0; k < 8; ++k) {
    const double warmer = std::array{0.0, 10.0, 5.0, 0.0}.at(static_cast<std::size_t>(k % 4));
    const double cycles = std::array{0.0, 9900.0, 0.0, 900.0}.at(static_cast<std::size_t>(k % 4));
    const auto t = rows(600, 0.002);
    const double hertz = 1.5 + 0.1 * k;
    const auto u = several_sines(t, 1, {hertz});
    auto y = noise(t.size(), white, 0.1 * white, static_cast<std::uint64_t>(410 + k));
    double driven = u.front();
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double n = cycles + std::floor(2 * hertz * t[i]) / 2;
      driven = std::max(u[i] - lost, std::min(u[i] + lost, driven));
      y[i] += driven * (1 + 0.002 * warmer - 0.01 * std::log10(1 + n / 100));
    }
    Recording r = recording(std::to_string(k) + ".csv", k < 4 ? Role::train : Role::validate, t, u, std::move(y));
    r.columns["T"].assign(t.size(), 295 + warmer);
    r.units["T"] = parse_unit("K");
    r.columns["cycles_before"].assign(t.size(), cycles);
    r.units["cycles_before"] = parse_unit("");
    list.push_back(std::move(r));
  }
  DataSet d = data_set(std::move(list), white);
  d.notes["T"].to = "T";
  d.notes["cycles_before"].to = "cycles_before";
  return d;
}

TEST_F(Pairs, TwoThatAreEachAPatchAloneAreFoundTogether) {
  const DataSet data = warm_and_worn();
  const Names both{"temperature_gain", "ageing"};
  for (const auto& alone : both) {
    const auto d = discovered(with_sensor(), data, {alone});
    EXPECT_TRUE(names(d).empty()) << alone << " takes a tenth away, by squares: " << tried(d);
  }
  const auto d = discovered(with_sensor(), data, {"temperature_gain", "ageing"});
  EXPECT_EQ(names(d), both) << tried(d);
  EXPECT_NEAR(d.final_error.rms_validate, white, 0.1 * white) << tried(d);
}

/// Both axes move alike: what the one cannot tell the other cannot tell either.
TEST_F(Pairs, AGainOfEachOfTwoAxesIsOneFinding) {
  DataSet d = measured([](double, double u, double) { return 1.01 * u; }, [](double, double, double) { return 0.0; });
  for (std::size_t k = 0; k < d.recordings.size(); ++k) {
    Recording& r = d.recordings[k];
    r.columns["u2"] = r.columns["u"];
    r.columns["y2"] = noise(r.t.size(), white, 0.1 * white, 500 + k);
    for (std::size_t i = 0; i < r.t.size(); ++i) r.columns["y2"][i] += 1.01 * r.columns["u"][i];
  }
  const auto found = discovered(two_axes(), d, {"calibration", "cross_coupling"}, exact());
  ASSERT_EQ(found.steps.size(), 1u) << tried(found);
  EXPECT_EQ(found.steps[0].winner.also_at.size(), 1u) << tried(found);
  EXPECT_EQ(found.remainder, Remainder::noise) << tried(found);
}

}  // namespace
}  // namespace hysteron
