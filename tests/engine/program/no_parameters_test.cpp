// A program whose blocks have no parameters, constants, memory or past is evaluated like any other: there is no array
// of the run by which the views could be told to point there already.
#include <gtest/gtest.h>

#include <memory>

#include "engine/rowwise/advance.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

ProgramPointer square() {
  Diagram d;
  d.inputs["u"] = {};
  d.blocks["p"] = tools::block("product", {}, {"u", "u"});
  d.outputs["y"] = "p";
  d.record = {"p"};
  return tools::compiled(d);
}

TEST(NoParameters, AProgramWithoutAnyIsSimulated) {
  const auto program = square();
  ASSERT_TRUE(start(*program).p.empty());
  auto run = start(*program);
  bind_input(*program, run, "u", tools::series({0, 1}, {0, 3}));
  SimulateOptions options;
  options.instants = {0, 0.5, 1};
  const auto traces = simulate(*program, run, options);
  EXPECT_EQ(traces.values[0], (std::vector<double>{0, 2.25, 9}));
}

TEST(NoParameters, AProgramWithoutAnyIsAdvanced) {
  const auto program = square();
  auto run = start(*program);
  bind_input(*program, run, "u", tools::series({0, 1}, {0, 3}));
  Advance advance(program, program->output_signals);
  std::vector<std::vector<double>> values;
  advance(run, std::make_shared<const std::vector<double>>(std::vector<double>{0, 0.5, 1}), {.at_rest = false}, values);
  EXPECT_EQ(values[0], (std::vector<double>{0, 2.25, 9}));
}

}  // namespace
}  // namespace hysteron
