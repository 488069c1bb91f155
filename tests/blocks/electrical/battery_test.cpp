// A cell under a constant current: closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/blocks/bench.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using bench::Bench;
using tools::block;

TEST(BatteryCellBlock, UnderAConstantCurrentFallsAsItsCurveAndPairsSay) {
  const auto cell = block("battery_cell",
                          {{"capacity", "100 C"},
                           {"resistance", "20 mohm"},
                           {"charges", tools::list({0, 0.2, 0.8, 1})},
                           {"open_circuit", tools::list({3.0, 3.5, 3.8, 4.2}, "V")},
                           {"resistances", tools::list({10, 30}, "mohm")},
                           {"times", tools::list({2, 15}, "s")},
                           {"initial", 0.9}},
                          {"i"});
  const auto program = tools::compiled(
      tools::diagram({{"i", block("constant", {{"value", "2 A"}})}, {"c", cell}}, {"c.voltage", "c.charge"}));
  SimulateOptions options;
  options.instants = {1, 5, 10, 20, 30, 40, 44};
  const auto traces = simulate(*program, start(*program), options);
  for (std::size_t k = 0; k < options.instants.size(); ++k) {
    const double t = options.instants[k], charge = 0.9 - 2 * t / 100;
    const double open = charge > 0.8   ? 3.8 + (charge - 0.8) / 0.2 * 0.4
                        : charge > 0.2 ? 3.5 + (charge - 0.2) / 0.6 * 0.3
                                       : 3.0 + charge / 0.2 * 0.5;
    const double drop = 2 * (0.02 + 0.01 * (1 - std::exp(-t / 2)) + 0.03 * (1 - std::exp(-t / 15)));
    EXPECT_NEAR(traces.values[0][k], open - drop, 1e-5) << t;  // relative tolerance 1e-6 of volts
    EXPECT_NEAR(traces.values[1][k], charge, 1e-6) << t;
  }
}

TEST(BatteryCellBlock, GoesOnStraightBeyondItsCurve) {
  const Bench b("battery_cell",
                {{"capacity", {100}}, {"resistance", {0}}, {"charges", {0, 0.5, 1}}, {"open_circuit", {3, 3.5, 4.2}}});
  EXPECT_NEAR(b.output(0, {0}, {-0.1})[0], 2.9, 1e-15);
  EXPECT_NEAR(b.output(0, {0}, {1.1})[0], 4.34, 1e-15);
  EXPECT_EQ(b.initial_states()[0], 1);
}

}  // namespace
}  // namespace hysteron
