// Blocks of stacks and of several axes in SI, and the circuit that is made of them: held against golden traces, their
// laws and closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models/sampled/impedance.h"
#include "tests/blocks/bench.h"
#include "tests/engine/simulate_tools.h"
#include "tests/models/golden.h"

namespace hysteron {
namespace {

using bench::Bench;
using bench::Numbers;

TEST(WheatstoneBridgeBlocks, UndoEachOther) {
  const Bench::Values gauges{{"supply", {5}}, {"resistance", {350}}, {"gauge_factor", {2.1}}};
  const Bench bridge("wheatstone_bridge", gauges), inverse("wheatstone_bridge_inverse", gauges);
  for (const double strain : {0.0, 1.36e-3, -4e-4}) {
    const Numbers read = bridge.output(0, {strain});
    const Numbers back = inverse.output(0, {read[0]});
    EXPECT_NEAR(back[0], strain, 1e-14);             // rounding of 1 + strain
    EXPECT_NEAR(back[1], read[1], 1e-12 * read[1]);  // claim C3-01
    EXPECT_NEAR(read[1], 350 * (1 + 2.1 * strain), 1e-12);
  }
  EXPECT_LT(bridge.output(0, {1e-3})[0], 0) << "stretched gauges lower the voltage";
}

const Bench::Values stack{
    {"samples", {200}}, {"layers", {600}}, {"area", {24e-6}}, {"thickness", {0.055e-3}}, {"period", {1e-4}}};

/// Outputs of the estimator at each sample.
std::vector<Numbers> estimates(Bench b, const Numbers& voltage, const Numbers& current) {
  Numbers x = b.initial_states();
  std::vector<Numbers> out;
  for (std::size_t k = 0; k < voltage.size(); ++k) {
    b.hit = static_cast<long>(k);
    out.push_back(b.output(0, {voltage[k], current[k]}, x));
    x = b.update({voltage[k], current[k]}, x);
  }
  return out;
}

TEST(ImpedanceEstimatorBlock, FindsAnIdealCapacitorUnderARampExactly) {
  // Claim C3-03: i = C dv/dt, 1e-9 of C. P grows by (C d/(N A) - eps_0)/d per volt.
  const double c = 4.47e-6, w = 2 * std::numbers::pi * 50;
  Numbers v, i;
  for (int k = 0; k <= 1000; ++k) {
    const double t = 1e-4 * k;
    v.push_back(30 * t + 2 * std::sin(w * t + 0.3));
    i.push_back(c * (30 + 2 * w * std::cos(w * t + 0.3)));
  }
  const auto out = estimates(Bench("impedance_estimator", stack), v, i);
  EXPECT_EQ(out[199], Numbers({0, 0, 0, 0})) << "nothing is told before the first window is full";
  for (std::size_t window = 1; window <= 5; ++window) {
    const Numbers& told = out[200 * window];
    const double mean = 30 * 1e-4 * (200 * static_cast<double>(window) - 100.5);
    const double per_volt = (c * 0.055e-3 / (600 * 24e-6) - impedance::vacuum) / 0.055e-3;
    EXPECT_NEAR(told[0], c, 1e-9 * c);
    EXPECT_NEAR(told[1], mean, 1e-12);
    EXPECT_NEAR(told[2], per_volt * mean, 1e-9 * per_volt);
    EXPECT_NEAR(told[3], per_volt * (mean - 30 * 1e-4 * 99.5), 1e-9 * per_volt);
    EXPECT_EQ(told, out[200 * window - (window == 5 ? 0 : -150)]) << "held until the next window is full";
  }
}

TEST(ImpedanceEstimatorBlock, ReproducesTheGoldenWindowsFromTheGoldenSamples) {
  HYSTERON_NEEDS_GOLDEN("polarisation_windows");
  const auto windows = golden::read("polarisation_windows"), samples = golden::read("polarisation_samples");
  const auto out = estimates(Bench("impedance_estimator", stack), samples.at("V [V]"), samples.at("I [A]"));
  auto by_fourier = stack;
  by_fourier["phasors"] = {1};
  const auto fourier = estimates(Bench("impedance_estimator", by_fourier), samples.at("V [V]"), samples.at("I [A]"));
  for (std::size_t m = 0; m + 1 < 10; ++m) {
    EXPECT_NEAR(fourier[200 * (m + 1)][0], windows.at("C fft [F]")[m], 1e-9 * 4.8e-6) << m;
    // The first current of the trace is one-sided; ten digits of 0.003 A, averaged, of a ripple of 0.003 A.
    EXPECT_NEAR(out[200 * (m + 1)][0], windows.at("C lsq [F]")[m], 1e-9 * 4.5e-6) << m;
    EXPECT_NEAR(out[200 * (m + 1)][1], windows.at("V mean [V]")[m], 1e-9) << m;
    EXPECT_NEAR(out[200 * (m + 1)][2], windows.at("P eq3.5 lsq [C/m^2]")[m], 1e-12) << m;
  }
}

/// The reference set of the Fabry-Perot stage (SPEC 5.3) in SI.
Bench::Values fabry_perot() {
  const double cd[3][3] = {{.62, -.055, .040}, {.048, .57, -.060}, {-.045, .052, .66}};
  const double sh[9] = {1, .22, .13, .10, .09, .08, .07, .07, .07};
  const double ps[3][3] = {{.9, -.07, .06}, {.06, .8, -.08}, {-.05, .07, 1.0}};
  const double be[3][3] = {{1.8, 1.6, 1.7}, {1.7, 1.9, 1.6}, {1.6, 1.7, 1.8}};
  Bench::Values v{{"t_c", {623}}, {"weights columns", {9}}};
  for (const char* name : {"p_s columns", "beta columns", "a columns"}) v[name] = {3};
  for (int k = 0; k < 9; ++k) v["thresholds"].push_back(0.8 * k);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 9; ++k) v["weights"].push_back(1e-6 * cd[i][j] * sh[k]);
      v["p_s"].push_back(3e-6 * ps[i][j]);
      v["beta"].push_back(be[i][j]);
      v["a"].push_back(0.0170);
    }
  return v;
}

TEST(CoupledTapiBlocks, ReproduceTheGoldenTracesInMetres) {
  HYSTERON_NEEDS_GOLDEN("fpi_open_T30");
  const auto open = golden::read("fpi_open_T30"), closed = golden::read("fpi_compensator_T30");
  const Bench model("coupled_tapi", fabry_perot(), 4);
  auto sampled = fabry_perot();
  sampled["period"] = {0.02};
  const Bench inverse("sampled_coupled_tapi_inverse", sampled, 4);
  Numbers memory = model.initial_memory(), states = inverse.initial_states();
  for (std::size_t k = 0; k < open.at("u_i [V]").size(); ++k) {
    const Numbers u{0, open.at("u_i [V]")[k], 0, 303.15};
    memory = model.advance(memory, u);
    const Numbers y = model.output(0, u, {}, memory);
    for (int j = 0; j < 3; ++j)  // ten digits of u up to 8 V times 1.6 um/V
      ASSERT_NEAR(y[static_cast<std::size_t>(j)], 1e-6 * open.at(fmt::format("y{}(u2) [um]", j + 1))[k], 2e-14) << k;
    const Numbers wanted{0, 0, 1e-6 * closed.at("yd3 [um]")[k], 303.15};
    const Numbers command = inverse.output(0, wanted, states);
    states = inverse.update(wanted, states);
    for (int i = 0; i < 3; ++i)
      ASSERT_NEAR(command[static_cast<std::size_t>(i)], closed.at(fmt::format("u{} for yd3 [V]", i + 1))[k], 2e-8) << k;
  }
}

TEST(SampledTapiInverseBlock, TakesAsManyStepsOfTheIterationAsItIsTold) {
  Bench::Values values{{"thresholds", {0, 0.4, 1.1}},
                       {"weights", {1, 0.3, 0.2}},
                       {"p_s", {1.3}},
                       {"t_c", {4}},
                       {"beta", {0.5}},
                       {"a", {2.5}},
                       {"period", {0.1}}};
  const Numbers in{0.9, 1};
  const Bench solved("sampled_tapi_inverse", values);
  const double answer = solved.output(0, in, solved.initial_states())[0];
  double before = 1;
  for (const double steps : {1.0, 4.0, 16.0}) {
    values["iterations"] = {steps};
    const Bench b("sampled_tapi_inverse", values);
    const double miss = std::fabs(b.output(0, in, b.initial_states())[0] - answer);
    EXPECT_LT(miss, before / 3) << steps;  // the contraction is 1.3 sqrt(3/4)/2.5 = 0.45 per step
    EXPECT_GT(miss, 0) << steps;
    before = miss;
  }
}

TEST(AsymmetricPrandtlIshlinskiiBlocks, AreTheTapiBlocksAtOneTemperature) {
  const double t = 300, p_s = 1.3, t_c = 600, beta = 0.5, a = 0.01;
  const Bench::Values shared{{"thresholds", {0, 0.4, 1.1}}, {"weights", {1, 0.3, 0.2}}};
  auto hot = shared, fixed = shared;
  hot.insert({{"p_s", {p_s}}, {"t_c", {t_c}}, {"beta", {beta}}, {"a", {a}}});
  fixed.insert({{"saturation", {p_s * std::sqrt(0.5)}}, {"bend", {a * t}}});
  const Bench tapi("tapi", hot), asymmetric("asymmetric_prandtl_ishlinskii", fixed);
  fixed["period"] = {1};
  const Bench inverse("sampled_asymmetric_inverse", fixed);
  Numbers m = tapi.initial_memory(), n = asymmetric.initial_memory(), x = inverse.initial_states();
  for (const double u : {0.0, 2.0, 0.7, 1.6, 0.1, 3.0}) {
    m = tapi.advance(m, {u, t});
    n = asymmetric.advance(n, {u});
    const Numbers y = asymmetric.output(0, {u}, {}, n);
    EXPECT_NEAR(y[0], tapi.output(0, {u, t}, {}, m)[0], 1e-15 * 10);
    EXPECT_NEAR(inverse.output(0, y, x)[0], u, 1e-14);
    x = inverse.update(y, x);
  }
}

}  // namespace
}  // namespace hysteron
