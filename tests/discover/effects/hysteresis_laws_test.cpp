// Hysteresis by another formula than plays: a Preisach density, whose loops are not those of plays of the drive.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "models/hysteresis/play.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

constexpr double sensor_noise = 2e-4;

/// Relays that switch up at a and down at b, 0 <= b <= a <= 1, of the density 1 + uneven (a + b) + apart (a - b) (a + b
/// - 1): of the triangle from b to a they give (a - b)^2/2 (1 + uneven (a + b) + apart/3 (a - b) (a + b - 1)).
/// Mayergoyz, IEEE Trans. Magn. 22 (1986) 603-608: each turn that was not wiped out is a corner of a staircase.
std::vector<double> relays(const std::vector<double>& u, double uneven, double apart = 0) {
  const auto triangle = [&](double a, double b) {
    return (a - b) * (a - b) / 2 * (1 + uneven * (a + b) + apart / 3 * (a - b) * (a + b - 1));
  };
  std::vector<double> turns{0.0}, y;  // from the lowest drive: minimum, maximum, minimum ...
  double last = 0;
  for (const double now : u) {
    const bool up = turns.size() % 2 == 1;
    if (up ? now < last : now > last) turns.push_back(last);
    last = now;
    const auto wiped = [&] {
      return turns.size() % 2 == 1 ? now >= turns[turns.size() - 2] : now <= turns[turns.size() - 2];
    };
    while (turns.size() >= 3 && wiped()) turns.resize(turns.size() - 2);
    double sum = 0;
    for (std::size_t i = 0; i < turns.size(); ++i) {
      const double next = i + 1 < turns.size() ? turns[i + 1] : now;
      sum += i % 2 == 0 ? triangle(next, turns[i]) : -triangle(turns[i], next);
    }
    y.push_back(sum);
  }
  return y;
}

class HysteresisLaws : public Discoveries {
 protected:
  static DataSet recorded(double amount, double uneven, double apart = 0) {
    std::vector<Recording> list;
    std::uint64_t seed = 200;
    for (const auto& [role, top, periods] :
         {std::tuple{Role::train, 1.0, 5}, {Role::train, 0.6, 8}, {Role::validate, 0.9, 7}}) {
      const auto t = rows(1500, 0.005);
      const auto u = decaying_triangle(t, top, periods);
      const auto loop = relays(u, uneven, apart);
      auto y = noise(t.size(), sensor_noise, 0.1 * sensor_noise, seed);
      for (std::size_t k = 0; k < y.size(); ++k) y[k] += u[k] + amount * (loop[k] - 0.8 * u[k]);
      list.push_back(recording(std::to_string(seed++) + ".csv", role, t, u, std::move(y)));
    }
    return data_set(std::move(list), sensor_noise);
  }
};

TEST_F(HysteresisLaws, RelaysOfAnEvenDensityFillTriangles) {
  // Half the square of the way, up to the top and back from it.
  const auto up = relays({0, 0.25, 0.5, 0.75, 1, 0.5}, 0);
  EXPECT_NEAR(up[4], 0.5, 1e-15);
  EXPECT_NEAR(up[5], 0.5 - 0.125, 1e-15);
}

/// u less what a drive about zero leaves behind, by small steps: Bouc-Wen, Wen, J. Eng. Mech. Div. 102 (1976) 249.
std::vector<double> held_back(const std::vector<double>& u, double amount) {
  std::vector<double> y{u.front()};
  double z = 0;
  for (std::size_t k = 1; k < u.size(); ++k) {
    for (int i = 0; i < 100; ++i) {
      const double d = (u[k] - u[k - 1]) / 100;
      z += 3 * d - 2 * std::abs(d) * z - 0.6 * d * std::abs(z);
    }
    y.push_back(u[k] - amount * z);
  }
  return y;
}

TEST_F(HysteresisLaws, ADriveAboutZeroSlipsEitherWayFromRest) {
  std::vector<Recording> list;
  std::uint64_t seed = 900;
  for (const auto& [role, top, hertz] :
       {std::tuple{Role::train, 1.0, 0.5}, {Role::train, 0.6, 0.8}, {Role::validate, 0.9, 0.7}}) {
    const auto t = rows(1200, 0.01);
    const auto u = sampled(t, [&, top = top, hertz = hertz](double x) {
      return top * (1 - 0.6 * x / t.back()) * std::sin(2 * std::numbers::pi * hertz * x);
    });
    auto y = noise(t.size(), 5e-3, 0, seed);
    const auto moved = held_back(u, 0.2);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += moved[k];
    list.push_back(recording(std::to_string(seed++) + ".csv", role, t, u, std::move(y)));
  }
  const auto d = discovered(plain_gain(), data_set(std::move(list), 5e-3, 0),
                            {"hysteresis", "backlash", "friction", "amplifier_lag", "creep"});
  ASSERT_EQ(winner(d), "hysteresis") << tried(d);
  EXPECT_TRUE(d.steps.front().winner.law.ends_with("two-sided plays")) << d.steps.front().winner.law;
  // Six plays of a law that is none: 0.2 of a z up to 1.15 within a twentieth.
  EXPECT_LT(d.final_error.rms_validate, std::hypot(5e-3, 0.2 * 1.15 / 20)) << tried(d);
}

TEST_F(HysteresisLaws, AnUnevenDensityIsHysteresisAndNoCurveBesides) {
  const auto d = discovered(plain_gain(), recorded(0.06, 1.5),
                            {"hysteresis", "asymmetry", "sensor_nonlinearity", "saturation", "friction", "backlash"});
  ASSERT_EQ(d.steps.size(), 1U) << tried(d);
  EXPECT_EQ(winner(d), "hysteresis") << tried(d);
  EXPECT_EQ(d.steps.front().winner.law, "10 one-sided plays of a bent drive") << tried(d);
  EXPECT_EQ(d.remainder, Remainder::noise) << tried(d);
  // Loops are wider where relays are dense: the drive is bent upwards.
  EXPECT_LT(value(d, "slope_at_lower"), value(d, "slope_at_upper")) << tried(d);
}

TEST_F(HysteresisLaws, RelaysOfAnyDensityAreHysteresisAndNoCurveBesides) {
  // Narrow ones at one end and wide ones at the other: what plays of a bent drive leave of that looks like a curve.
  const auto d = discovered(plain_gain(), recorded(0.03, 0, 3.5),
                            {"hysteresis", "asymmetry", "sensor_nonlinearity", "saturation", "friction", "backlash"});
  ASSERT_EQ(d.steps.size(), 1U) << tried(d);
  EXPECT_EQ(winner(d), "hysteresis") << tried(d);
  EXPECT_TRUE(d.steps.front().winner.law.starts_with("relays")) << tried(d);
  EXPECT_EQ(d.remainder, Remainder::noise) << tried(d);
}

TEST_F(HysteresisLaws, ACurveBeforePlaysIsNotSwallowedByALawThatCouldHoldBoth) {
  auto data = recorded(0, 0);
  std::uint64_t seed = 300;
  for (auto& r : data.recordings) {
    const auto& u = r.columns.at("u");
    auto y = noise(u.size(), sensor_noise, 0.1 * sensor_noise, seed++);
    double narrow = 0, wide = 0;
    for (std::size_t k = 0; k < u.size(); ++k) {
      const double bent = u[k] + 0.04 * u[k] * (u[k] - 1);
      narrow = play::follow_one_sided(0.162, narrow, bent);
      wide = play::follow_one_sided(0.406, wide, bent);
      y[k] += 0.98 * bent + 0.01 * narrow + 0.02 * wide;
    }
    r.columns.at("y") = std::move(y);
  }
  const auto d = discovered(plain_gain(), data, {"hysteresis", "asymmetry", "sensor_nonlinearity", "saturation"});
  ASSERT_EQ(d.steps.size(), 2U) << tried(d);
  EXPECT_TRUE(std::any_of(d.steps.begin(), d.steps.end(), [](const FoundStep& s) {
    return s.winner.effect == "asymmetry";
  })) << tried(d);
  EXPECT_TRUE(std::any_of(d.steps.begin(), d.steps.end(), [](const FoundStep& s) {
    return s.winner.effect == "hysteresis";
  })) << tried(d);
  EXPECT_EQ(d.remainder, Remainder::noise) << tried(d);
}

/// What forty plays pass on that are strong where the sine of their place is, and the less the wider they are: of no
/// parabola over the travel, and of no few widths.
std::vector<double> passed_on(const std::vector<double>& x) {
  std::vector<double> places(40, 0.0), sums;
  for (const double now : x) {
    double sum = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double radius = 0.01 * (static_cast<double>(i) + 0.5);
      places[i] = play::follow(radius, places[i], now);
      // The integral of 1 + 0.9 sin(5 w + 1).
      sum += std::exp(-4 * radius) * (places[i] - 0.18 * (std::cos(5 * places[i] + 1) - std::cos(1)));
    }
    sums.push_back(sum);
  }
  return sums;
}

TEST_F(HysteresisLaws, ASpringThatYieldsUnevenlyIsHysteresisAndNoCurveBesides) {
  // The force that leads along a given motion, 10 N/V; the motion is measured.
  std::vector<Recording> list;
  std::uint64_t seed = 400;
  for (const auto& [role, top, hertz] : {std::tuple{Role::train, 0.4, 0.5},
                                         {Role::train, 0.2, 0.7},
                                         {Role::validate, 0.36, 0.6},
                                         {Role::validate, 0.28, 0.4}}) {
    const auto t = rows(1600, 0.01);
    const double w = 2 * std::numbers::pi * hertz, end = t.back();
    std::vector<double> x, inertia;
    for (const double s : t) {  // from rest, larger and smaller: size(s) sin(w s)
      const double part = s / end, most = 6.75 * top, sine = std::sin(w * s), cosine = std::cos(w * s);
      const double size = most * part * part * (1 - part), grows = most * part * (2 - 3 * part) / end;
      const double bends = most * (2 - 6 * part) / (end * end);
      x.push_back(size * sine);
      inertia.push_back(bends * sine + 2 * grows * w * cosine - size * w * w * sine +
                        4 * (grows * sine + size * w * cosine));
    }
    const auto soft = passed_on(x);
    std::vector<double> u;
    for (std::size_t k = 0; k < t.size(); ++k) u.push_back((inertia[k] + 420 * x[k] - 1.5 * soft[k]) / 10);
    auto y = noise(t.size(), sensor_noise, 0.1 * sensor_noise, seed);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += x[k];
    list.push_back(recording(std::to_string(seed++) + ".csv", role, t, u, std::move(y)));
  }
  const auto d =
      discovered(mass_on_spring(), data_set(std::move(list), sensor_noise),
                 {"hysteresis", "friction", "stiffening", "asymmetry", "sensor_nonlinearity", "backlash"}, exact());
  ASSERT_EQ(d.steps.size(), 1U) << tried(d);
  EXPECT_EQ(winner(d), "hysteresis") << tried(d);
  EXPECT_EQ(d.steps.front().winner.law, "6 uneven plays in the spring") << tried(d);
  EXPECT_LT(d.final_error.rms_validate, 0.1 * d.base.rms_validate) << tried(d);
}

/// 1 kg under 10 N/V on 400 N/m, of which half remembers: Bouc-Wen's law with `beta` and `gamma` [1/m], by Kutta's
/// steps of 0.5 ms.
std::vector<double> on_a_bouc_wen_spring(const std::vector<double>& t, const std::function<double(double)>& drive,
                                         double beta, double gamma) {
  using State = std::array<double, 3>;  // position, velocity, what is held back
  const auto rates = [&](const State& s, double now) {
    return State{s[1], 10 * drive(now) - 4 * s[1] - 200 * s[0] - s[2],
                 200 * s[1] - beta * std::abs(s[1]) * s[2] - gamma * s[1] * std::abs(s[2])};
  };
  const auto moved = [](const State& s, const State& rate, double h) {
    return State{s[0] + h * rate[0], s[1] + h * rate[1], s[2] + h * rate[2]};
  };
  State s{};
  std::vector<double> x{0};
  for (std::size_t k = 1; k < t.size(); ++k) {
    const int n = 20;
    const double h = (t[k] - t[k - 1]) / n;
    for (int i = 0; i < n; ++i) {
      const double now = t[k - 1] + i * h;
      const State a = rates(s, now), b = rates(moved(s, a, h / 2), now + h / 2),
                  c = rates(moved(s, b, h / 2), now + h / 2), d = rates(moved(s, c, h), now + h);
      for (std::size_t j = 0; j < s.size(); ++j) s[j] += h / 6 * (a[j] + 2 * b[j] + 2 * c[j] + d[j]);
    }
    x.push_back(s[0]);
  }
  return x;
}

TEST_F(HysteresisLaws, ASpringWhoseLoopsHardenWithTheTravelIsHysteresis) {
  // As in the bench of Noel and Schoukens (2016): beta + gamma below zero, which no elements that yield can show.
  std::vector<Recording> list;
  std::uint64_t seed = 500;
  for (const auto& [role, top, hertz] :
       {std::tuple{Role::train, 0.5, 0.7}, {Role::train, 0.9, 1.9}, {Role::validate, 0.7, 1.3}}) {
    const auto t = rows(1500, 0.01);
    const auto drive = [top = top, hertz = hertz](double s) {
      const double w = 2 * std::numbers::pi * hertz;
      return top * (std::sin(w * s) + 0.6 * std::sin(2.3 * w * s) + 0.4 * std::sin(0.31 * w * s)) / 2;
    };
    auto y = noise(t.size(), sensor_noise, 0.1 * sensor_noise, seed);
    const auto x = on_a_bouc_wen_spring(t, drive, 40, -55);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += x[k];
    list.push_back(recording(std::to_string(seed++) + ".csv", role, t, sampled(t, drive), std::move(y)));
  }
  DataSet data = data_set(std::move(list), sensor_noise);
  data.notes["u"].between = Between::smooth;
  const auto d = discovered(mass_on_spring(), data, {"hysteresis", "friction", "stiffening", "quadratic_drag"});
  ASSERT_EQ(d.steps.size(), 1U) << tried(d);
  EXPECT_EQ(winner(d), "hysteresis") << tried(d);
  EXPECT_EQ(d.steps.front().winner.law, "Bouc-Wen in the spring") << tried(d);
  EXPECT_EQ(to_text(d.remainder), "noise") << tried(d);
  // Five standard deviations: the fit says 0.0018, 0.20 and 0.32 from 3000 rows with 0.2 mm of noise.
  EXPECT_NEAR(value(d, "hysteretic_share"), 0.5, 0.009);
  EXPECT_NEAR(value(d, "beta"), 40, 1);
  EXPECT_NEAR(value(d, "gamma"), -55, 1.6);
  EXPECT_NE(d.steps.front().winner.summary.find("% of the stiffness remembers"), std::string::npos)
      << d.steps.front().winner.summary;
}

TEST_F(HysteresisLaws, NoLawOfManyMoreNumbersIsTriedWhereAnotherEffectLeavesNoiseOnly) {
  const auto tries = [&](DataSet data) {
    const Discovery d = diagnosed(plain_gain(), data, {"asymmetry", "hysteresis"});
    long relays = 0;
    for (const auto& c : d.candidates)
      for (const auto& law : c.laws_tried) relays += law.law.starts_with("relays");
    return relays;
  };
  EXPECT_GT(tries(recorded(0.06, 1.5)), 0) << "a curve alone leaves more";
  auto curved = recorded(0, 0);
  for (auto& r : curved.recordings)
    for (std::size_t k = 0; k < r.t.size(); ++k) {
      const double u = r.columns.at("u")[k];
      r.columns.at("y")[k] += 0.02 * u * (1 - u);
    }
  EXPECT_EQ(tries(curved), 0);
}

TEST_F(HysteresisLaws, AMassOnNoSpringHasNoneThatRemembers) {
  const auto refused = [&](const std::string& stiffness) {
    std::vector<Recording> list;
    for (const Role role : {Role::train, Role::validate}) {
      const auto t = rows(200, 0.01);
      list.push_back(
          recording(to_text(role), role, t, several_sines(t, 1, {1.3}), noise(t.size(), sensor_noise, 0, 1)));
    }
    Diagram d = mass_on_spring();
    d.blocks["stage"].parameters["stiffness"] = Value(stiffness);
    DiscoverOptions options;
    options.only = {"hysteresis"};
    options.max_steps = 1;
    for (auto& r : list) r.at_rest = false;
    const Discovery found = discover(d, data_set(std::move(list), sensor_noise), registry, effects, options);
    return std::any_of(found.refused.begin(), found.refused.end(), [](const Refused& r) {
      return r.place == "stage" && r.reason.find("on no spring") != std::string::npos;
    });
  };
  EXPECT_TRUE(refused("0 N/m"));
  EXPECT_FALSE(refused("400 N/m"));
}

TEST_F(HysteresisLaws, ASpringHasATravelWhereNobodyLookedHowFarItMoves) {
  Excitation at;
  at.by = "mass_on_hysteretic_spring";
  for (const Law& law : effects.get("hysteresis").laws(at)) {
    Diagram d = mass_on_spring();
    Node& stage = d.blocks["stage"];
    const Node mass = stage;
    stage = law.block;
    stage.in = mass.in;
    for (const char* name : {"mass", "stiffness", "damping"}) stage.parameters[name] = *mass.parameters.find(name);
    EXPECT_NO_THROW(compile(d, registry)) << law.name;
  }
}

TEST_F(HysteresisLaws, ADriveIsBentWhereItLiesToOneSideOfZero) {
  const Effect& hysteresis = effects.get("hysteresis");
  const auto bends = [&](double lowest, double highest) {
    Excitation at;
    at.lowest = lowest;
    at.highest = highest;
    const auto laws = hysteresis.laws(at);
    return std::any_of(laws.begin(), laws.end(),
                       [](const Law& l) { return l.block.type == "generalized_prandtl_ishlinskii"; });
  };
  EXPECT_TRUE(bends(0, 100));
  EXPECT_TRUE(bends(-5, 100));
  EXPECT_FALSE(bends(-100, 100));
}

TEST_F(HysteresisLaws, ALoopWithinATenthOfTheStrokeIsLostMotion) {
  const Effect& hysteresis = effects.get("hysteresis");
  Excitation at;
  at.lowest = 0;
  at.highest = 1;
  at.unit = parse_unit("V");
  at.gain_is_free = true;  // six weights
  const Law law = hysteresis.laws(at).front();
  // Thresholds of 0.04, 0.162 ... 0.65 of the range: 0.04 w of the first, 0.162 w of the second.
  EXPECT_NE(hysteresis.implausible(law, {0.1, 0, 0, 0, 0, 0}, at), "");
  EXPECT_NE(hysteresis.implausible(law, {0.1, 0.001, 0, 0, 0, 0}, at), "") << "4 % of it lie beyond";
  EXPECT_EQ(hysteresis.implausible(law, {0.1, 0.002, 0, 0, 0, 0}, at), "") << "8 %";
}

TEST_F(HysteresisLaws, WithoutALoopOnlyAGainOrAStiffnessIsLeftOfIt) {
  const Effect& hysteresis = effects.get("hysteresis");
  Excitation at;
  at.lowest = 0;
  at.highest = 1;
  at.unit = parse_unit("V");
  const Law plays = hysteresis.laws(at).front();  // the first weight is the gain of the drive, found anew
  EXPECT_NE(hysteresis.implausible(plays, {1.02, 0, 0, 0, 0, 0, 0}, at).find("no loop"), std::string::npos);
  EXPECT_EQ(hysteresis.implausible(plays, {1, 0, 0, 0, 0, 1e-3, 0}, at), "");
  at.by = "mass_on_hysteretic_spring";
  at.travel_highest = 1e-5;
  for (const Law& law : hysteresis.laws(at)) {
    std::vector<double> values(law.free.size(), 0.0);
    values.back() = 400;  // its own spring
    EXPECT_NE(hysteresis.implausible(law, values, at).find("no loop"), std::string::npos) << law.name;
    for (double& v : values) v = 1;
    EXPECT_EQ(hysteresis.implausible(law, values, at), "") << law.name;
  }
}

}  // namespace
}  // namespace hysteron
