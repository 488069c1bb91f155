// Bridge, Maxwell resistive capacitor and collocation: closed forms, golden traces and what the printed forms would
// give.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "models/collocation.h"
#include "models/hysteresis/maxwell_capacitor.h"
#include "models/hysteresis/play.h"
#include "models/measurement/wheatstone_bridge.h"
#include "models/random.h"
#include "tests/models/golden.h"

namespace hysteron {
namespace {

namespace bridge = wheatstone_bridge;

TEST(WheatstoneBridge, GaugeIsRecoveredFromTheVoltage) {
  // Claim C3-01.
  for (const double strain : {-2e-3, 0.0, 1e-6, 1.36e-3}) {
    const double gauge = bridge::gauge_resistance(350.0, 2.1, strain);
    const double found = bridge::gauge_from_voltage(5.0, 350.0, bridge::voltage(5.0, 350.0, gauge));
    EXPECT_NEAR(found, gauge, 1e-12 * gauge);
    EXPECT_NEAR(bridge::strain_from_gauge(350.0, 2.1, found), strain, 1e-14);
  }
}

TEST(WheatstoneBridge, VoltageIsThatOfTwoDividers) {
  const double r = 350, g = 351.2, ac = 5;
  EXPECT_NEAR(bridge::voltage(ac, r, g), ac * (r / (g + r) - g / (r + g)), 1e-15);
}

TEST(WheatstoneBridge, PrintedFormsFail) {
  const double r = 350, g = 351.2, ac = 5;
  // E-20: with R_1 in place of R_4 both dividers are equal.
  EXPECT_EQ(ac * (r / (g + r) - r / (r + g)), 0);
  // E-21: 2 u_AC/u_BD - 1 for a bridge near balance is a huge resistance, -4.1e5 Ohm for a gauge of 351.2 Ohm.
  EXPECT_NEAR(r * (2 * ac / bridge::voltage(ac, r, g) - 1), -4.094e5, 100);
}

TEST(StackWafer, ThickensByAThousandth) {
  // Claim C3-02: 45 um of travel over 600 wafers of 0.055 mm.
  EXPECT_NEAR(45e-6 / 600, 75e-9, 1e-20);
  EXPECT_NEAR(45e-6 / 600 / 0.055e-3, 1.36e-3, 0.01e-3);
}

/// G1 of SPEC 5.4: ten elements.
struct Elements {
  std::vector<double> charges, elastances;
  Elements() {
    for (int i = 1; i <= 10; ++i) {
      charges.push_back(26e-6 * i);
      elastances.push_back(10 / 260e-6 * (1.5 - 0.1 * i));
    }
  }
};

TEST(MaxwellCapacitor, VirginBranchIsASumOfSaturatingElements) {
  const Elements e;
  std::vector<double> w(10, 0.0);
  for (int k = 0; k <= 60; ++k) {
    const double q = 5e-6 * k;
    double expected = 0;
    for (std::size_t i = 0; i < 10; ++i) {
      w[i] = play::follow(e.charges[i], w[i], q);
      expected += e.elastances[i] * std::min(q, e.charges[i]);
    }
    EXPECT_NEAR(maxwell_capacitor::voltage<double>(e.elastances, w, q), expected, 1e-12 * 60);
  }
}

TEST(MaxwellCapacitor, UnloadingFollowsMasingsRule) {
  // A branch behind a reversal is the virgin one at twice the scale.
  const Elements e;
  const auto virgin = [&](double q) {
    double u = 0;
    for (std::size_t i = 0; i < 10; ++i) u += e.elastances[i] * std::min(q, e.charges[i]);
    return u;
  };
  const double top = 300e-6;
  std::vector<double> w(10);
  for (std::size_t i = 0; i < 10; ++i) w[i] = play::follow(e.charges[i], 0.0, top);
  for (int k = 0; k <= 60; ++k) {
    const double q = top - 10e-6 * k;
    std::vector<double> now(10);
    for (std::size_t i = 0; i < 10; ++i) now[i] = play::follow(e.charges[i], w[i], q);
    EXPECT_NEAR(maxwell_capacitor::voltage<double>(e.elastances, now, q), virgin(top) - 2 * virgin((top - q) / 2),
                1e-10);
  }
}

TEST(MaxwellCapacitor, SmallSignalCapacitanceIsThatOfTheSeriesCircuit) {
  // E-40, on the numbers of G1: C_T = C + T_q T_F/k. Charge q takes u_T = q/C_T and u_H = S q.
  const double c = 2.6e-6, t_f = 5.4, t_q = 5.4, k = 45e6;
  const double c_t = c + t_q * t_f / k;
  double s = 0;
  for (const double x : Elements().elastances) s += x;
  const double q = 1e-6, u = q / c_t + s * q;
  EXPECT_NEAR(maxwell_capacitor::series_capacitance(c_t, s), q / u, 1e-12 * q / u);
  // Printed: C_T S/(C_T + S) is C_T itself as soon as S is large, as if H were not there; its unit is a square of
  // volts.
  const double printed = c_t * s / (c_t + s);
  EXPECT_NEAR(printed, c_t, 1e-10 * c_t);
  EXPECT_GT(printed, 1.9 * q / u);
}

TEST(MaxwellCapacitor, TakesMoreChargePerVoltWithEveryElementThatYields) {
  // E-41: the weights of a rising branch add up, dq/du = c_1 + c_2 + ..., because an element that has yielded is
  // shorted. Read as printed, capacitors in series that are switched on one after the other, dq/du would fall.
  const Elements e;
  const double c_t = 2.6e-6 + 5.4 * 5.4 / 45e6;
  const auto slope_at = [&](double q) {  // dq/du of the whole circuit on the virgin branch, by a step of 1 nC
    const auto voltage = [&](double charge) {
      std::vector<double> w(10);
      for (std::size_t i = 0; i < 10; ++i) w[i] = play::follow(e.charges[i], 0.0, charge);
      return charge / c_t + maxwell_capacitor::voltage<double>(e.elastances, w, charge);
    };
    return 1e-9 / (voltage(q + 1e-9) - voltage(q));
  };
  double stiff = 0;  // 1/C_i of the elements that still hold
  for (const double x : e.elastances) stiff += x;
  double before = 0, switched_on = HUGE_VAL;
  for (std::size_t i = 0; i < 10; ++i) {
    const double slope = slope_at(26e-6 * (static_cast<double>(i) + 0.5));
    EXPECT_NEAR(slope, maxwell_capacitor::series_capacitance(c_t, stiff), 1e-6 * slope);  // rounding of 1 nC in 250 uC
    EXPECT_GT(slope, before);
    double in_series = 0;
    for (std::size_t k = 0; k <= i; ++k) in_series += e.elastances[k];
    EXPECT_LT(maxwell_capacitor::series_capacitance(c_t, in_series), switched_on);
    switched_on = maxwell_capacitor::series_capacitance(c_t, in_series);
    before = slope;
    stiff -= e.elastances[i];
  }
}

TEST(TransducerCharge, IsWhatTheCapacitorLeaves) {
  // E-39: q = C u_T + q_T. The printed q - u_T/C subtracts V/F = V^2/C from a charge.
  const double c = 2.6e-6, u_t = 20, q_t = 6.5e-5, q = c * u_t + q_t;
  EXPECT_NEAR(q - c * u_t, q_t, 1e-18);
  EXPECT_LT(q - u_t / c, -1e6);
}

TEST(TransducerCharge, CountsTheChargeOfDomainsOnce) {
  // E-42: i = q_C' + q_T' (5.5) with q_C = C u_T + q_P. Adding q_P again, as 5.12 with the q_C of its text does, asks
  // for more charge than flows, by q_P itself. P_s is a charge density: times the area it is one.
  const double c = 2.6e-6, t_q = 5.4, k = 45e6, area = 0.0144, p_s = 2e-3, bend = 40;
  const auto domains = [&](double u) { return area * p_s * std::tanh(u / bend); };
  double q = 0;  // charge that flows while u_T rises to 80 V: the integral of the capacitance seen at the terminals
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double u = 80 * (i + 0.5) / n, h = std::tanh(u / bend);
    q += (c + area * p_s / bend * (1 - h * h) + t_q * 5.4 / k) * 80 / n;
  }
  const double q_c = c * 80 + domains(80), q_t = t_q * 5.4 * 80 / k;
  EXPECT_NEAR(q_c + q_t, q, 1e-9 * q);  // midpoint rule: (80/40/20000)^2/24
  EXPECT_NEAR(q_c + domains(80) + q_t - q, domains(80), 1e-9 * q);
}

TEST(Collocation, ReproducesTheGoldenPlates) {
  HYSTERON_NEEDS_GOLDEN("fpi_collocation");
  const auto trace = golden::read("fpi_collocation");
  for (std::size_t row = 0; row < trace.at("S1 [um]").size(); ++row) {
    const auto y = collocation::at_actuators(
        {trace.at("S1 [um]")[row], trace.at("S2 [um]")[row], trace.at("S3 [um]")[row]}, 20e-3, 25e-3);
    EXPECT_NEAR(y[0], trace.at("y1 [um]")[row], 2e-9);  // ten digits of up to 1 um, times factors up to 0.75
    EXPECT_NEAR(y[1], trace.at("y2 [um]")[row], 2e-9);
    EXPECT_NEAR(y[2], trace.at("y3 [um]")[row], 2e-9);
  }
}

TEST(Collocation, IsExactForATiltedPlate) {
  // Claim C5-07: z = p + tip x + tilt y. Sensor i at angle 120 i degrees, actuator i across the centre.
  for (std::uint64_t k = 0; k < 20; ++k) {
    const double p = random::normal(1, 0, 3 * k), tip = random::normal(1, 0, 3 * k + 1),
                 tilt = random::normal(1, 0, 3 * k + 2);
    std::array<double, 3> sensors{}, actuators{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double angle = 2 * std::acos(-1) / 3 * static_cast<double>(i);
      const auto height = [&](double r) { return p + r * (tip * std::cos(angle) + tilt * std::sin(angle)); };
      sensors[i] = height(0.020);
      actuators[i] = height(-0.025);
    }
    const auto y = collocation::at_actuators(sensors, 0.020, 0.025),
               s = collocation::at_sensors(actuators, 0.020, 0.025);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(y[i], actuators[i], 1e-14);
      EXPECT_NEAR(s[i], sensors[i], 1e-14);
    }
  }
}

}  // namespace
}  // namespace hysteron
