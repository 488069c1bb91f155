// How C++ code builds and runs a diagram without a file: the example that docs/diagrams.md names, compiled and run.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "blocks/register_all.h"
#include "engine/diagram/diagram.h"
#include "engine/program/program.h"
#include "engine/simulate/simulate.h"

namespace hysteron {
namespace {

TEST(FromCpp, ADiagramIsBuiltRunAndChangedWithoutAFile) {
  // A sine through a lag: "5 Hz" and "2 ms" are read as in a file, plain numbers are in the declared unit.
  Diagram diagram;
  diagram.blocks["drive"].type = "sine";
  diagram.blocks["drive"].parameters["amplitude"] = "3 V";
  diagram.blocks["drive"].parameters["frequency"] = "5 Hz";
  diagram.blocks["amplifier"].type = "lag";
  diagram.blocks["amplifier"].parameters["times"] = NumberList{{2, "ms"}};
  diagram.blocks["amplifier"].in = {{"", "drive"}};
  diagram.record = {"drive", "amplifier"};

  // Compiled once; the program is immutable and may be shared by threads, each with its own Run.
  const Registry blocks = all_blocks();  // must live as long as the program
  const ProgramPointer program = compile(diagram, blocks);
  hysteron::Run run = start(*program);
  SimulateOptions settings;
  settings.until = 1;     // s
  settings.every = 1e-4;  // s
  const Traces traces = simulate(*program, run, settings);
  ASSERT_EQ(traces.values.size(), 2U);

  // After the first periods the amplitude is 3 V / sqrt(1 + (w tau)^2); 1e-5 relative: the tolerance 1e-6 over some
  // steps.
  const auto amplitude = [](const Traces& t) {
    double peak = 0;
    for (std::size_t i = 8000; i < t.t.size(); ++i) peak = std::max(peak, std::abs(t.values[1][i]));
    return peak;
  };
  const double w_tau = 2 * std::numbers::pi * 5 * 2e-3;
  EXPECT_NEAR(amplitude(traces), 3 / std::sqrt(1 + w_tau * w_tau), 3e-5);

  // Another value is another run of the same program: nothing is compiled again.
  set_parameter(*program, run, "drive.amplitude", 1);
  prepare(*program, run);
  EXPECT_NEAR(amplitude(simulate(*program, run, settings)), 1 / std::sqrt(1 + w_tau * w_tau), 1e-5);
}

}  // namespace
}  // namespace hysteron
