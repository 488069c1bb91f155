// Effects that read a second signal or replace a block, each hidden by a formula of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/diagram/diagram_file.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;
using std::numbers::pi;

class MoreEffects : public Discoveries {
 protected:
  static const Refused* refusal(const Discovery& d, const std::string& effect) {
    for (const auto& r : d.refused)
      if (r.effect == effect) return &r;
    return nullptr;
  }
};

struct Made {
  Role role;
  std::vector<double> t, u;
};

/// A temperature [K] that wanders by `span`, differently in each recording.
std::vector<double> wandering(const std::vector<double>& t, double span, double phase) {
  return sampled(t, [&, T = t.back()](double x) {
    return 295 + span * (0.5 + 0.3 * std::sin(2 * pi * 1.3 * x / T + phase) + 0.2 * std::sin(2 * pi * 3.1 * x / T));
  });
}

std::vector<Made> drives() {
  return {{Role::train, rows(900, 0.05), levels(rows(900, 0.05), {0.4, 1, 0.2, 0.7})},
          {Role::train, rows(900, 0.02), several_sines(rows(900, 0.02), 1, {0.3, 0.8})},
          {Role::validate, rows(900, 0.04), several_sines(rows(900, 0.04), 1, {0.2, 0.5})}};
}

/// Recordings with column T in which y = law(t, u, T) plus noise.
template <class Law>
DataSet with_temperature(double span, double white, Law law) {
  std::vector<Recording> list;
  std::uint64_t seed = 300;
  for (auto& m : drives()) {
    const auto warm = wandering(m.t, span, static_cast<double>(seed));
    auto y = law(m.t, m.u, warm);
    const auto n = noise(y.size(), white, 0.1 * white, seed);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += n[k];
    list.push_back(recording(std::to_string(seed++) + ".csv", m.role, m.t, m.u, y));
    list.back().columns["T"] = warm;
    list.back().units["T"] = parse_unit("degC");
  }
  DataSet data = data_set(list, white);
  data.notes["T"].to = "T";
  return data;
}

/// A part that warms up with time constant 4 s and moves y, integrated by small Euler steps.
DataSet expanding(double span) {
  return with_temperature(span, 2e-3, [](const auto& t, const auto& u, const auto& warm) {
    std::vector<double> y;
    double w = warm.front();
    for (std::size_t k = 0; k < t.size(); ++k) {
      for (int i = 0; k > 0 && i < 50; ++i) w += (t[k] - t[k - 1]) / 50 * (warm[k] - w) / 4;
      y.push_back(u[k] + 0.02 * (w - 297));
    }
    return y;
  });
}

TEST_F(MoreEffects, ThermalExpansionIsNamedWithItsDelayAndBringsTheColumnIn) {
  const Discovery d = diagnosed(plain_gain(), expanding(6));
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  const auto& winner = d.steps.front().winner;
  ASSERT_EQ(winner.effect, "thermal_expansion") << tried(d);
  EXPECT_NEAR(d.final_error.rms_validate, 2e-3, 2e-4);
  EXPECT_EQ(winner.law, "one time constant");
  const auto value = [&](std::size_t i) { return winner.found.at(i).estimate.used; };
  EXPECT_NEAR(value(0), 0.02, 0.002);  // m/K; noise and 1/f of 0.2 mm over 900 rows leave less than a tenth
  EXPECT_NEAR(value(1), 4, 0.4);       // s
  EXPECT_NEAR(value(2), 297, 0.5);     // K: no constant of this diagram takes up the middle
  const auto* input = d.final_diagram.inputs.find("T");
  ASSERT_NE(input, nullptr);
  EXPECT_EQ(input->unit, "degC");
  const Diagram without = remove_effect(d.final_diagram, registry, "thermal_expansion");
  EXPECT_EQ(without.inputs.find("T"), nullptr) << "the column leaves with the effect";
  EXPECT_EQ(without.blocks.names(), plain_gain().blocks.names());
}

TEST_F(MoreEffects, AnExpansionThatOutlastsThreeRecordingsIsADrift) {
  Excitation at;
  at.longest_recording = 100;  // s
  const Effect& expansion = effects.get("thermal_expansion");
  for (const auto& law : expansion.laws(at)) {
    std::vector<double> values;
    for (const auto& p : law.free) values.push_back(p.start);
    EXPECT_EQ(expansion.implausible(law, values, at), "") << law.name;
    const std::size_t last = 2 * (values.size() / 2) - 1;  // coefficients, times [s], perhaps a reference
    values[last] = 301;
    EXPECT_NE(expansion.implausible(law, values, at), "") << law.name;
  }
}

TEST_F(MoreEffects, AGainThatFollowsTheTemperatureIsNoExpansion) {
  const auto data = with_temperature(12, 2e-3, [](const auto&, const auto& u, const auto& warm) {
    std::vector<double> y;
    for (std::size_t k = 0; k < u.size(); ++k) y.push_back(u[k] * (1 + 0.004 * (warm[k] - 300)));
    return y;
  });
  const Discovery d = diagnosed(plain_gain(), data);
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps.front().winner.effect, "temperature_gain") << tried(d);
  EXPECT_NEAR(d.steps.front().winner.found.front().estimate.used, 0.004, 4e-4);  // 1/K: noise and 1/f leave a tenth
}

TEST_F(MoreEffects, AGainMayBendWithTheTemperature) {
  const auto data = with_temperature(12, 2e-3, [](const auto&, const auto& u, const auto& warm) {
    std::vector<double> y;
    for (std::size_t k = 0; k < u.size(); ++k) {
      const double warmer = warm[k] - 300;
      y.push_back(u[k] * (1 + 0.004 * warmer + 2e-4 * warmer * warmer));
    }
    return y;
  });
  const Discovery d = diagnosed(plain_gain(), data);
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps.front().winner.effect, "temperature_gain") << tried(d);
  EXPECT_EQ(d.steps.front().winner.law, "bent in temperature") << tried(d);
  EXPECT_NEAR(value(d, "curvature"), 2e-4, 4e-5);  // 1/K^2: 0.1 % of the gain at 5 K, half of the noise
  EXPECT_LT(d.final_error.over_floor(), 1.2) << "chi2 of 900 rows is known to 5 %";
}

TEST_F(MoreEffects, AGainThatTurnsBackWithinTheTemperaturesIsImplausible) {
  const Effect& e = effects.get("temperature_gain");
  Excitation at;
  at.from_data = true;
  at.side_lowest = 290;
  at.side_highest = 300;
  const Law bent = e.laws(at).back();
  ASSERT_EQ(bent.free.size(), 3u);
  EXPECT_EQ(e.implausible(bent, {0.004, 290, 1e-4}, at), "") << "0.4 %/K where it is cold, 0.6 %/K where it is warm";
  EXPECT_NE(e.implausible(bent, {0.004, 290, -4e-4}, at).find("rises and falls"), std::string::npos)
      << "0.4 %/K where it is cold, -0.4 %/K where it is warm";
  EXPECT_EQ(e.implausible(e.laws(at).front(), {0.004, 290}, at), "");
}

TEST_F(MoreEffects, AnExpansionIsRefusedWhereNoTemperatureIsRecorded) {
  DataSet data = expanding(6);
  data.notes.erase("T");
  for (auto& r : data.recordings) r.columns.erase("T");
  const Discovery blind = diagnosed(plain_gain(), data);
  const auto* missing = refusal(blind, "thermal_expansion");
  ASSERT_NE(missing, nullptr) << tried(blind);
  EXPECT_NE(missing->reason.find("no column"), std::string::npos) << missing->reason;
}

/// 3 % of another drive, exactly as it comes through a lag (0 = at once) between rows that are joined by lines.
DataSet coupled(const std::vector<Made>& made, double tau) {
  std::vector<Recording> list;
  std::uint64_t seed = 500;
  for (const auto& m : made) {
    const auto other = sampled(m.t, [&, T = m.t.back()](double x) {
      return 0.5 * (1 - std::cos(2 * pi * 2.7 * x / T + static_cast<double>(seed)));
    });
    auto y = noise(m.t.size(), 1e-3, 1e-4, seed);
    double arrived = other.front();
    for (std::size_t k = 0; k < y.size(); ++k) {
      if (k > 0 && tau > 0) {
        const double h = m.t[k] - m.t[k - 1], slope = (other[k] - other[k - 1]) / h;
        arrived = other[k] - slope * tau + (arrived - other[k - 1] + slope * tau) * std::exp(-h / tau);
      }
      y[k] += m.u[k] + 0.03 * (tau > 0 ? arrived : other[k]);
    }
    list.push_back(recording(std::to_string(seed++) + ".csv", m.role, m.t, m.u, y));
    list.back().columns["u2"] = other;
    list.back().units["u2"] = parse_unit("V");
  }
  DataSet data = data_set(list, 1e-3);
  data.notes["u2"].to = "u2";
  return data;
}

TEST_F(MoreEffects, AnotherAxisIsNamedFromItsDrive) {
  const Discovery d = diagnosed(plain_gain(), coupled(drives(), 0));
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps.front().winner.effect, "cross_coupling") << tried(d);
  EXPECT_EQ(d.steps.front().winner.law, "static");
  EXPECT_NEAR(d.steps.front().winner.found.front().estimate.used, 0.03,
              1e-3);  // 1 mm of noise over 1800 rows of half a volt
}

TEST_F(MoreEffects, ACouplingThatComesLateIsFoundWithItsTime) {
  const double tau = drives().front().t.back() / 40;
  const Discovery d = diagnosed(plain_gain(), coupled(drives(), tau));
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps.front().winner.effect, "cross_coupling") << tried(d);
  EXPECT_EQ(d.steps.front().winner.law, "late");
  EXPECT_NEAR(value(d, "coefficient"), 0.03, 1e-3);
  // The part in quadrature, 2 pi 2.7/40 = 0.42 of 0.5*0.03 V or more, is known to 1e-3 sqrt(2/1800) V: 0.5 % of it.
  EXPECT_NEAR(value(d, "time"), tau, 0.05 * tau);
}

struct Ringing {
  double hertz, damping, share;
};
/// Its motion behind `u`: q'' + 2 z w q' + w^2 q = w^2 u by the central difference with 100 steps a row.
std::vector<double> motion_of(const Ringing& mode, const std::vector<double>& u, double step) {
  const double w = 2 * pi * mode.hertz, h = step / 100;
  std::vector<double> motion;
  double q = 0, v = 0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    for (int i = 0; k > 0 && i < 100; ++i) {
      const double drive = u[k - 1] + (u[k] - u[k - 1]) * (i + 0.5) / 100;
      v += h * (w * w * (drive - q) - 2 * mode.damping * w * v);
      q += h * v;
    }
    motion.push_back(q);
  }
  return motion;
}

/// y = u + sum share (q - u) of these modes.
DataSet with_modes(const std::vector<Ringing>& modes) {
  std::vector<Recording> list;
  std::uint64_t seed = 700;
  for (const auto& [role, step] : {std::pair{Role::train, 2e-3}, {Role::train, 3e-3}, {Role::validate, 2.5e-3}}) {
    const auto t = rows(1200, step);
    const auto u = levels(
        t, role == Role::train ? std::vector<double>{0.3, 1, 0.5, 0.8, 0.1} : std::vector<double>{0.9, 0.2, 0.6, 0});
    auto y = noise(t.size(), 1e-3, 1e-4, seed);
    for (std::size_t k = 0; k < t.size(); ++k) y[k] += u[k];
    for (const auto& mode : modes) {
      const auto q = motion_of(mode, u, step);
      for (std::size_t k = 0; k < t.size(); ++k) y[k] += mode.share * (q[k] - u[k]);
    }
    list.push_back(recording(std::to_string(seed++) + ".csv", role, t, u, y));
  }
  return data_set(list, 1e-3);
}

/// A twentieth of the motion is that of a mode of 37 Hz with this damping ratio.
DataSet with_a_mode(double z) { return with_modes({{37, z, 0.05}}); }

TEST_F(MoreEffects, AModeThatRingsIsNamedByItsFrequency) {
  const Discovery d = diagnosed(plain_gain(), with_a_mode(0.02));
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps.front().winner.effect, "structural_resonance") << tried(d);
  // A quarter of the width z f of the peak.
  EXPECT_NEAR(d.steps.front().winner.found.front().estimate.used, 37, 0.2);
}

TEST_F(MoreEffects, TwoModesThatRingAreOneFindingOfTwoFrequencies) {
  // The second one is sampled 3.3 times a period where rows are closest: enough beside the first.
  const Discovery d = diagnosed(plain_gain(), with_modes({{37, 0.02, 0.05}, {150, 0.015, 0.02}}));
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps.front().winner.effect, "structural_resonance") << tried(d);
  EXPECT_EQ(d.steps.front().winner.law, "two modes") << tried(d);
  // A quarter of the width z f of each peak.
  EXPECT_NEAR(value(d, "frequencies[0]"), 37, 0.2);
  EXPECT_NEAR(value(d, "frequencies[1]"), 150, 0.6);
  EXPECT_LT(d.final_error.over_floor(), 1.2) << "chi2 of 1200 rows each is known to 4 %; one mode leaves 2.7";
}

TEST_F(MoreEffects, AModeIsNotRefusedForASecondOneThatOnlyShiftsThePhase) {
  // What lags beside the mode is best described by a second one at the limit of damping: that is no refinement of it.
  const Discovery d =
      diagnosed(plain_gain(), with_modes({{37, 0.02, 0.05}, {60, 0.8, 0.15}}), {"structural_resonance"});
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps.front().winner.law, "one mode") << tried(d);
  // Beside what lags and is not described yet, within the half width z f of the peak.
  EXPECT_NEAR(d.steps.front().winner.found.front().estimate.used, 37, 0.7);
}

TEST_F(MoreEffects, WhatOnlyShiftsThePhaseIsNoResonance) {
  for (const double damping : {0.15, 0.8}) {
    const Discovery d = diagnosed(plain_gain(), with_a_mode(damping), {"structural_resonance"});
    EXPECT_TRUE(d.steps.empty()) << tried(d);
    EXPECT_TRUE(std::any_of(d.candidates.begin(), d.candidates.end(), [](const Candidate& c) {
      return c.reason.find("would shift the phase and not ring") != std::string::npos;
    })) << tried(d);
  }
}

TEST_F(MoreEffects, WhatNeverStopsRingingIsNoResonance) {
  const Effect& e = effects.get("structural_resonance");
  const Excitation at;
  const Law law = e.laws(at).front();
  EXPECT_NE(e.implausible(law, {40, 5e-4, 0.1, 0}, at).find("never stop"), std::string::npos);
  EXPECT_EQ(e.implausible(law, {40, 2e-3, 0.1, 0}, at), "") << "a flexure of titanium";
}

TEST_F(MoreEffects, AClampIsNamedWithItsLevel) {
  std::vector<Recording> list;
  std::uint64_t seed = 900;
  for (auto& m : drives()) {
    auto y = noise(m.t.size(), 1e-3, 1e-4, seed);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += std::min(m.u[k], 0.83);
    list.push_back(recording(std::to_string(seed++) + ".csv", m.role, m.t, m.u, y));
  }
  const Discovery d = diagnosed(plain_gain(), data_set(list, 1e-3));
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps.front().winner.effect, "saturation") << tried(d);
  EXPECT_NEAR(d.steps.front().winner.found.at(1).estimate.used, 0.83, 2e-3);  // twice the noise of a row
}

/// y = u behind an amplifier that moves by `up` and `down` a second at most, by small steps; all of it `slower`.
DataSet slewing(double up, double down, double to_judge = 1, double slower = 1) {
  std::vector<Recording> list;
  std::uint64_t seed = 1300;
  for (auto& m : drives()) {
    for (double& t : m.t) t *= slower;
    if (m.role == Role::validate)
      for (double& u : m.u) u *= to_judge;
    auto y = noise(m.t.size(), 1e-3, 1e-4, seed);
    double v = m.u.front();
    for (std::size_t k = 0; k < m.t.size(); ++k) {
      for (int i = 0; k > 0 && i < 200; ++i) {
        const double h = (m.t[k] - m.t[k - 1]) / 200, u = m.u[k - 1] + (m.u[k] - m.u[k - 1]) * (i + 1) / 200;
        v += std::clamp(u - v, -down * h / slower, up * h / slower);
      }
      y[k] += v;
    }
    list.push_back(recording(std::to_string(seed++) + ".csv", m.role, m.t, m.u, y));
  }
  return data_set(list, 1e-3);
}

TEST_F(MoreEffects, ALimitedRateIsNamedWithItsRate) {
  const Discovery d = diagnosed(plain_gain(), slewing(0.6, 0.6));
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps.front().winner.effect, "slew_limit") << tried(d);
  // V/s: some hundred limited rows tell a ramp of a volt to 1 mm/sqrt(100) each.
  EXPECT_NEAR(d.steps.front().winner.found.at(0).estimate.used, 0.6, 0.006);
  EXPECT_NEAR(d.final_error.rms_validate, 1e-3, 1e-4);
}

TEST_F(MoreEffects, TheMotorOfAValveTakesMinutes) {
  const Discovery d = diagnosed(plain_gain(), slewing(0.6, 0.6, 1, 200));  // 2 V and more in 11 minutes
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps.front().winner.effect, "slew_limit") << tried(d);
  EXPECT_NEAR(d.steps.front().winner.found.at(0).estimate.used, 0.6 / 200, 0.006 / 200);  // see above
}

TEST_F(MoreEffects, ALimitedRateThatIsAnotherDownwardsTakesTheRicherLaw) {
  const Discovery d = diagnosed(plain_gain(), slewing(0.7, 0.5));
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  const auto& winner = d.steps.front().winner;
  ASSERT_EQ(winner.effect, "slew_limit") << tried(d);
  ASSERT_EQ(winner.law, "one rate for each way");
  EXPECT_NEAR(winner.found.at(0).estimate.used, 0.7, 0.01);
  EXPECT_NEAR(winner.found.at(1).estimate.used, 0.5, 0.01);
}

TEST_F(MoreEffects, WhatTheFittedRecordingsDoNotReachLimitsNothingInTheOthers) {
  // Judged on what moves four times as far and as fast: a limit that was left at the end of what was fitted would cut
  // half of it off.
  const Discovery d = diagnosed(plain_gain(), slewing(1e3, 0.5, 4));
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  const auto& winner = d.steps.front().winner;
  ASSERT_EQ(winner.effect, "slew_limit") << tried(d);
  ASSERT_EQ(winner.law, "one rate for each way");
  EXPECT_GT(winner.found.at(0).estimate.used, 10 * winner.found.at(1).estimate.used) << "nothing limits the way up";
  EXPECT_NEAR(winner.found.at(1).estimate.used, 0.5, 0.01);
  EXPECT_NEAR(d.final_error.rms_validate, 1e-3, 1e-4);
}

/// The mass with a further force(x, v), by small steps of which the middle counts.
template <class Force>
DataSet moving_mass(Force force) {
  std::vector<Recording> list;
  std::uint64_t seed = 1100;
  for (auto& m : drives()) {
    auto y = noise(m.t.size(), 1e-5, 1e-6, seed);
    double x = 0, v = 0;
    Force f = force;
    for (std::size_t k = 0; k < m.t.size(); ++k) {
      for (int i = 0; k > 0 && i < 200; ++i) {
        const double h = (m.t[k] - m.t[k - 1]) / 200, u = m.u[k - 1] + (m.u[k] - m.u[k - 1]) * (i + 0.5) / 200;
        x += 0.5 * h * v;
        v += h * (10 * u - 400 * x - 4 * v - f(x, v, h));
        x += 0.5 * h * v;
      }
      y[k] += x;
    }
    list.push_back(recording(std::to_string(seed++) + ".csv", m.role, m.t, m.u, y));
  }
  return data_set(list, 1e-5);
}

TEST_F(MoreEffects, AStiffeningSpringIsNamedAndReplacesTheBlock) {
  const auto data = moving_mass([](double x, double, double) { return 8e4 * x * x * x; });
  const Discovery d = diagnosed(mass_on_spring(), data);
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps.front().winner.effect, "stiffening") << tried(d);
  EXPECT_NEAR(value(d, "stiffening"), 8e4,
              4e3)
      << tried(d);  // N/m^3: Euler steps of 0.1 ms leave less than a twentieth
  const Node* stage = d.final_diagram.blocks.find("stage");
  ASSERT_NE(stage, nullptr);
  ASSERT_NE(stage->from.find("on"), nullptr);
  EXPECT_EQ(stage->from.find("on")->type, "mass_on_stiffening_spring");
  EXPECT_EQ(stage->from.find("off")->type, "mass_spring_damper");
}

TEST_F(MoreEffects, AStiffeningSpringInAGuideWithFrictionIsTwoEffectsOfOneBlock) {
  // 1.2 N of cubic force and 0.4 N of dry friction, of 10 N; a contact of 2e4 N/m, its own law solved along each step.
  struct Both {
    double z = 0;
    double operator()(double x, double v, double h) {
      const double held = std::copysign(0.4 / 2e4, v);
      z = held + (z - held) * std::exp(-std::abs(v * h / held));
      return 2e4 * z + 8e4 * x * x * x;
    }
  };
  const Discovery d =
      discovered(mass_on_spring(), moving_mass(Both{}), {"friction", "stiffening", "sensor_nonlinearity"}, exact());
  ASSERT_EQ(d.steps.size(), 2u) << tried(d);
  std::vector<std::string> names{d.steps[0].winner.effect, d.steps[1].winner.effect};
  std::sort(names.begin(), names.end());
  ASSERT_EQ(names, (std::vector<std::string>{"friction", "stiffening"})) << tried(d);
  for (const auto& step : d.steps) {
    EXPECT_EQ(step.change.effect, step.winner.effect);
    EXPECT_EQ(step.change.name, "stage");
    EXPECT_EQ(step.winner.summary.find("cubic force") != std::string::npos, step.winner.effect == "stiffening")
        << step.winner.summary;
  }
  const auto value = [&](const char* path) {
    for (const auto& f : d.steps[1].winner.found)
      if (f.estimate.path == path) return f.estimate.used;
    return std::nan("");
  };
  // N/m^3 and N: steps of 0.1 ms leave less than a hundredth of either.
  EXPECT_NEAR(value("stage.stiffening"), 8e4, 8e2) << tried(d);
  EXPECT_NEAR(value("stage.contact_stiffness[0]") * value("stage.slip_distance[0]"), 0.4, 0.004);
  EXPECT_NEAR(d.final_error.rms_validate, 1e-5, 1e-6);
  EXPECT_EQ(effects_in(d.final_diagram).size(), 2u);
}

TEST_F(MoreEffects, FrictionOfAGuideIsNamedWithItsForce) {
  // LuGre's bristle with constant friction 0.4 N and stiffness 2e4 N/m [Canudas de Wit 1995, without viscous terms].
  struct Bristle {
    double z = 0;
    double operator()(double, double v, double h) {
      z += h * (v - 2e4 * std::abs(v) / 0.4 * z);
      return 2e4 * z;
    }
  };
  const Discovery d = diagnosed(mass_on_spring(), moving_mass(Bristle{}));
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps.front().winner.effect, "friction") << tried(d);
  const auto& f = d.steps.front().winner.found;
  EXPECT_NEAR(f.at(0).estimate.used * f.at(1).estimate.used, 0.4, 0.04);  // N: another law of friction, a tenth
}

TEST_F(MoreEffects, AContactThatIsDampedIsNoResonance) {
  // The same bristle, a hundredth as stiff (it gives way 1 mm), with LuGre's s1 = 20 N s/m: five times the damping of
  // the mass while it sticks, none while it slides. Without s1 its rest rings as the mass does, at 3.2 Hz.
  struct Bristle {
    double z = 0;
    double operator()(double, double v, double h) {
      const double rate = v - std::abs(v) / 1e-3 * z;
      z += h * rate;
      return 400 * z + 20 * rate;
    }
  };
  const auto d = discovered(mass_on_spring(), moving_mass(Bristle{}), {"friction", "structural_resonance"});
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(winner(d), "friction") << tried(d);
  EXPECT_NEAR(value(d, "contact_time"), 20.0 / 400, 0.005);  // a tenth: Euler steps, and noise of 1 % of the effect
  EXPECT_EQ(d.remainder, Remainder::noise);
}

/// 1 kg on 400 N/m with 1.3 N s/m under 10 N/V, in a guide by LuGre's equations: 0.14 N after 0.54 mm, 11 % more
/// below 0.19 m/s, a contact damped by 5.8 ms. Eighty of Kutta's steps to a row.
std::vector<double> in_a_damped_contact(const std::vector<double>& t, const std::vector<double>& u) {
  using State = std::array<double, 3>;  // place, speed, deflection
  const auto rate = [](const State& s, double volts) {
    const double level = 1 + 0.11 * std::exp(-std::pow(s[1] / 0.19, 2));
    const double bends = s[1] - std::abs(s[1]) * s[2] / (5.4e-4 * level);
    return State{s[1], 10 * volts - 1.3 * s[1] - 400 * s[0] - 260 * (s[2] + 5.8e-3 * bends), bends};
  };
  const auto plus = [](const State& s, const State& slope, double h) {
    return State{s[0] + h * slope[0], s[1] + h * slope[1], s[2] + h * slope[2]};
  };
  constexpr int n = 80;
  std::vector<double> y{0};
  State s{};
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double h = (t[k] - t[k - 1]) / n;
    for (int i = 0; i < n; ++i) {
      const auto drive = [&](double part) { return u[k - 1] + (u[k] - u[k - 1]) * (i + part) / n; };
      const State a = rate(s, drive(0)), b = rate(plus(s, a, h / 2), drive(0.5));
      const State c = rate(plus(s, b, h / 2), drive(0.5)), d = rate(plus(s, c, h), drive(1));
      for (std::size_t j = 0; j < 3; ++j) s[j] += h / 6 * (a[j] + 2 * b[j] + 2 * c[j] + d[j]);
    }
    y.push_back(s[0]);
  }
  return y;
}

/// Swings of these frequencies, fitted with turns of a slow triangle, judged on others.
DataSet guided_swings(const std::vector<double>& fitted, const std::vector<double>& judged) {
  constexpr double white = 6.6e-6;
  std::vector<Recording> list;
  std::uint64_t seed = 7100;
  const auto add = [&](Role role, const std::vector<double>& t, const std::vector<double>& u) {
    auto y = noise(t.size(), white, 1e-6, seed);
    const auto moved = in_a_damped_contact(t, u);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += moved[k];
    list.push_back(recording(std::to_string(seed++) + ".csv", role, t, u, y));
  };
  const auto t = rows(1000, 0.018), slow = rows(1000, 0.047);
  add(Role::train, t, several_sines(t, 1, fitted));
  add(Role::train, slow, decaying_triangle(slow, 1, 8));
  add(Role::validate, t, several_sines(t, 0.9, judged));
  return data_set(std::move(list), white);
}

TEST_F(MoreEffects, AnExcessIsSoughtAtSpeedsThatTheRecordingsHave) {
  Diagram plant = mass_on_spring();
  plant.blocks["stage"].parameters["damping"] = Value("1.3 N*s/m");
  const Discovery fast = diagnosed(plant, guided_swings({1.3, 2.6}, {1.1, 2.4}), {"friction"});
  ASSERT_EQ(winner(fast), "friction") << tried(fast);
  EXPECT_LT(fast.final_error.over_floor(), 1.15) << "chi2 of 1000 rows is known to 4 %\n" << tried(fast);
  EXPECT_NEAR(value(fast, "excess"), 0.11, 0.02);
  EXPECT_NEAR(value(fast, "stribeck_velocity"), 0.19, 0.03);
  EXPECT_NEAR(value(fast, "contact_time"), 5.8e-3, 3e-4);
  // An excess below all speeds is none, and fits better than a wrong one to begin with: no search begins there, nor
  // before the contact is known, for which it would stand.
  Excitation at;
  at.by = "mass_with_presliding";
  at.travel_highest = 1e-3;
  at.quickest = 10;
  const auto laws = effects.get("friction").laws(at);
  ASSERT_GE(laws.size(), 3u);
  EXPECT_EQ(laws[1].free.back().path, "contact_time");
  for (const auto& law : laws)
    for (const auto& p : law.free) {
      if (p.path != "stribeck_velocity") continue;
      for (const double speed : p.scan) EXPECT_GE(speed, 1e-3 * 1e-3 * 10) << "[m/s], of the largest";
    }
}

}  // namespace
}  // namespace hysteron
