// What "hysteron export c" says and refuses; random diagrams; float; another processor.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "tests/export/c/in_c.h"
#include "tests/export/c/random_diagram.h"

namespace hysteron {
namespace {

using process::Folder;
using process::Outcome;

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

constexpr char compensator[] = R"({
  "format": 1, "title": "compensator", "inputs": {"wanted": {"unit": "um"}},
  "blocks": {"inverse": {"type": "prandtl_ishlinskii_inverse", "in": "wanted",
                         "thresholds": ["0 V", "1 V", "2.5 V"], "weights": {"value": [0.8, 0.1, 0.2], "unit": "um/V"}},
             "within": {"type": "saturation", "lower": "-1 V", "upper": "9 V", "in": "inverse"}},
  "outputs": {"drive": "within"}})";

TEST(ExportC, WritesWhatItSaysNamedAfterTheBlocksWithUnits) {
  const Folder folder;
  folder.write("d.json", compensator);
  const Outcome outcome = in_c::exported(folder, {"d.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(holds(outcome.out, "2 blocks in C, 3 numbers remembered")) << outcome.out;
  const std::string header = folder.read("out/comp.h"), source = folder.read("out/comp.c");
  EXPECT_TRUE(holds(header, "double wanted; /* [m] */")) << header;
  EXPECT_TRUE(holds(source, "static const double inverse_thresholds[3]")) << source;
  EXPECT_TRUE(holds(source, "within_upper = 9.0; /* [V]")) << source;
  EXPECT_FALSE(holds(source, "malloc"));
  EXPECT_EQ(in_c::tried(folder).code, 0);
  // The closed form: u = wanted/0.8 on the virgin branch up to the second threshold of the inverse, 0.8 um.
  folder.write("out/one.c",
               "#include \"comp.h\"\n#include <stdio.h>\nint main(void)\n{\n    comp_state s;\n    comp_input in = "
               "{0.4e-6};\n    comp_output out;\n    comp_start(&s);\n    comp_step(&s, &in, &out);\n    "
               "printf(\"%.12f\\n\", out.drive);\n    return 0;\n}\n");
  const Outcome one = process::shell(folder.path(), "cd out && cc -std=c99 -o one one.c comp.c -lm && ./one");
  EXPECT_EQ(one.out, "0.500000000000\n") << one.err;
}

TEST(ExportC, InFloatItTellsTheDeviationInTheUnitOfTheSignal) {
  const Folder folder;
  folder.write("d.json", compensator);
  ASSERT_EQ(in_c::exported(folder, {"d.json", "--number", "float32"}).code, 0);
  EXPECT_FALSE(holds(folder.read("out/comp.c"), "double"));
  const Outcome run = in_c::tried(folder);
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  EXPECT_TRUE(holds(run.out, "drive: largest deviation ") && holds(run.out, " V of ")) << run.out;
}

TEST(ExportC, RefusesEverythingThatItCannotWriteAtOnceByName) {
  const Folder folder;
  folder.write("d.json", R"({"format": 1, "title": "t", "inputs": {"u": {"unit": "V"}}, "blocks": {
    "late": {"type": "dead_time", "delay": "1 ms", "in": "u"},
    "tone": {"type": "sine", "amplitude": "1 V", "frequency": "5 Hz"},
    "stage": {"type": "mass_spring_damper", "mass": "1 kg", "stiffness": "1 N/m", "damping": "1 N s/m", "in": "force"},
    "force": {"type": "gain", "gain": "1 N/V", "in": "all"},
    "all": {"type": "sum", "in": ["late", "tone"]}}, "outputs": {"x": "stage.position", "v": "all"}})");
  const Outcome outcome = in_c::exported(folder, {"d.json", "--rate", "1 kHz"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(holds(outcome.err, "late (dead_time) remembers the past of its input")) << outcome.err;
  EXPECT_TRUE(holds(outcome.err, "tone (sine) is a signal of time")) << outcome.err;
  EXPECT_TRUE(holds(outcome.err, "--from tone")) << outcome.err;
  EXPECT_FALSE(folder.has("out/comp.c"));
}

TEST(ExportC, AWrongWordIsAnsweredWithTheRightOne) {
  const Folder folder;
  folder.write("d.json", compensator);
  const auto says = [&](const std::vector<std::string>& words, const std::string& part) {
    const Outcome outcome = in_c::exported(folder, words);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_TRUE(holds(outcome.err, part)) << outcome.err;
  };
  says({"d.json", "--to", "invers"}, "inverse");
  says({"d.json", "--rate", "10 V"}, "--rate \"10 kHz\"");
  says({"d.json", "--name", "my comp"}, "no name in C");
  says({"d.json", "--number", "int"}, "float64 nor float32");
  const Outcome kind = process::hysteron(folder.path(), {"export", "d", "d.json"});
  EXPECT_TRUE(kind.code == 2 && holds(kind.err, "nothing is exported as")) << kind.err;
}

TEST(ExportC, LinearPartsAreMatricesFromStepToStep) {
  const Folder folder;
  folder.write("d.json", R"({"format": 1, "title": "pi", "inputs": {"e": {"unit": "um"}}, "blocks": {
    "pi": {"type": "pi_controller", "kp": "0.2 V/um", "ki": "300 V/um/s", "in": "e"},
    "filter": {"type": "lag", "times": ["2 ms"], "in": "e"}}, "outputs": {"u": "pi", "f": "filter"}})");
  const Outcome outcome = in_c::exported(folder, {"d.json", "--rate", "10 kHz"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Outcome run = in_c::tried(folder);
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  const std::string page = folder.read("out/comp.md");
  EXPECT_TRUE(holds(page, "pi: pi_controller as matrices from step to step, its input straight")) << page;
}

// Each element has states of its own, and for a ramp comes out where the closed form does.
TEST(ExportC, LinearPartsOnVectorsAreMatricesOfTheirElements) {
  const Folder folder;
  folder.write("d.json",
               R"({"format": 1, "title": "two axes", "inputs": {"e": {"unit": "mrad", "length": 2}}, "blocks": {
    "filter": {"type": "lag", "times": ["2 ms", "5 ms"], "in": "e"},
    "pi": {"type": "pi_controller", "kp": "3 V/mrad", "ki": "40 V/mrad/s", "in": "e"},
    "only": {"type": "lag", "times": ["2 ms", "5 ms"], "in": "e[1]"}},
    "outputs": {"filter": "filter", "pi": "pi", "only": "only"}})");
  const Outcome outcome = in_c::exported(folder, {"d.json", "--rate", "10 kHz"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Outcome run = in_c::tried(folder);
  EXPECT_TRUE(run.code == 0 && holds(run.out, in_c::same_bits)) << run.out << run.err;
  folder.write("out/two.c", R"(#include "comp.h"
#include <stdio.h>
int main(void)
{
    comp_state s;
    comp_input in = {0.0, 0.0};
    comp_output out;
    int k, same = 1;
    comp_start(&s);
    for (k = 0; k < 50; ++k) {
        in.e_0 = 1e-3 * k;
        in.e_1 = -2e-3 * (k % 7);
        comp_step(&s, &in, &out);
        same = same && out.filter_1 == out.only;
    }
    printf("%d %.9f %.6f\n", same, out.filter_0, out.pi_0);
    return 0;
}
)");
  const Outcome two = process::shell(folder.path(), "cd out && cc -std=c99 -o two two.c comp.c -lm && ./two");
  // A ramp r t [rad] behind two lags is r (t - T1 - T2 + (T1^2 e^(-t/T1) - T2^2 e^(-t/T2)) / (T1 - T2)).
  const double r = 10, t = 4.9e-3, t1 = 2e-3, t2 = 5e-3;
  const double lagged = r * (t - t1 - t2 + (t1 * t1 * std::exp(-t / t1) - t2 * t2 * std::exp(-t / t2)) / (t1 - t2));
  EXPECT_EQ(two.out, fmt::format("1 {:.9f} {:.6f}\n", lagged, 3e3 * r * t + 40e3 * r * t * t / 2)) << two.err;
}

// Straight inputs would make a loop at one instant of it: a controller and its plant, each with matrices of its own.
TEST(ExportC, ALoopOfLinearPartsIsWrittenWithHeldInputs) {
  const Folder folder;
  folder.write("d.json", R"({"format": 1, "title": "loop", "inputs": {"w": {"unit": "um"}}, "blocks": {
    "error": {"type": "sum", "signs": "+-", "in": ["w", "stage"]},
    "pi": {"type": "pi_controller", "kp": "0.2 V/um", "ki": "300 V/um/s", "in": "error"},
    "amplifier": {"type": "lag", "times": ["2 ms"], "in": "pi"},
    "stage": {"type": "gain", "gain": "1.2 um/V", "in": "amplifier"}}, "outputs": {"y": "stage"}})");
  const Outcome outcome = in_c::exported(folder, {"d.json", "--rate", "10 kHz"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(holds(outcome.out, "amplifier: lag as matrices from step to step, its input held")) << outcome.out;
  const Outcome run = in_c::tried(folder);
  EXPECT_TRUE(run.code == 0 && holds(run.out, in_c::same_bits)) << run.out << run.err;
}

TEST(ExportC, SumsOfSamplesHaveTheBitsOfTheEngine) {
  const Folder folder;
  folder.write("d.json", R"({"format": 1, "title": "sums", "inputs": {"v": {"unit": "um/s"}}, "blocks": {
    "forward": {"type": "discrete_integrator", "rule": "forward", "period": "1 ms", "in": "v"},
    "backward": {"type": "discrete_integrator", "rule": "backward", "period": "2 ms", "in": "v"},
    "trapezoidal": {"type": "discrete_integrator", "rule": "trapezoidal", "period": "1 ms", "in": "v"}},
    "outputs": {"a": "forward", "b": "backward", "c": "trapezoidal"}})");
  ASSERT_EQ(in_c::exported(folder, {"d.json"}).code, 0);
  const Outcome run = in_c::tried(folder);
  EXPECT_TRUE(run.code == 0 && holds(run.out, in_c::same_bits)) << run.out << run.err;
}

/// A diagram in which memory follows a jump that turns is refused; another one that begins with the same part is tried.
void expect_the_bits_of_the_engine(unsigned seed) {
  const Folder folder;
  std::string diagram;
  Outcome outcome;
  for (unsigned other = 0; other < 20 && outcome.code != 0; ++other) {
    diagram = in_c::random_diagram(seed + 10000 * other * in_c::random_kinds()).json;
    folder.write("d.json", diagram);
    outcome = in_c::exported(folder, {"d.json", "--rate", "1 kHz"});
    if (outcome.code != 0) {
      ASSERT_TRUE(holds(outcome.err, "remembers every value on the way of a jump")) << diagram << outcome.err;
    }
  }
  ASSERT_EQ(outcome.code, 0) << diagram << outcome.err;
  const Outcome run = in_c::tried(folder);
  EXPECT_EQ(run.code, 0) << diagram << run.out << run.err;
  EXPECT_TRUE(holds(run.out, in_c::same_bits)) << diagram << run.out;
}

TEST(ExportC, RandomDiagramsHaveTheBitsOfTheEngine) {
  for (unsigned seed = 0; seed < in_c::random_kinds(); ++seed) expect_the_bits_of_the_engine(seed);
}
TEST(ExportC, MemoryBehindAJumpThatTurnsIsRefusedWithTheSampledSignalAsItsCure) {
  const Folder folder;
  const auto write = [&](const std::string& between) {
    folder.write("d.json", R"({"format": 1, "title": "t", "inputs": {"u": {}}, "blocks": {
      "held": {"type": "sample_hold", "period": "1 ms", "in": "u"},
      "between": {)" + between +
                               R"(, "in": "held"},
      "core": {"type": "preisach", "levels": [-1, -0.2, 0.1, 0.8], "weights": [0.1, 0.2, 0.1, 0.3, 0.05, 0.2],
               "gain": 0.5, "in": "between"}}, "outputs": {"y": "core"}})");
  };
  write(R"("type": "wrap", "period": 0.7)");
  const Outcome turns = in_c::exported(folder, {"d.json", "--rate", "1 kHz"});
  EXPECT_EQ(turns.code, 2);
  EXPECT_TRUE(holds(turns.err, "core (preisach) remembers every value on the way of a jump")) << turns.err;
  EXPECT_TRUE(holds(turns.err, "between (wrap) may turn") && holds(turns.err, "--from held")) << turns.err;
  const auto has_the_bits = [&](const std::vector<std::string>& words) {
    const Outcome outcome = in_c::exported(folder, words);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Outcome run = in_c::tried(folder);
    EXPECT_TRUE(run.code == 0 && holds(run.out, in_c::same_bits)) << run.out << run.err;
  };
  has_the_bits({"d.json", "--from", "held", "--rate", "1 kHz"});
  write(R"("type": "saturation", "lower": 0.2, "upper": 0.7)");  // rises only
  has_the_bits({"d.json", "--rate", "1 kHz"});
}
// What a sampled block gives is held while u moves on, and then jumps: memory of u - y turns there if the jump goes
// back. Play of radius r, by hand: z = max(u - r, min(u + r, z)), first at the last sample, then at the new one.
TEST(ExportC, MemoryTurnsWhereAMovementEndsAndAJumpBegins) {
  const Folder folder;
  folder.write("d.json", R"({"format": 1, "title": "t", "inputs": {"u": {}}, "blocks": {
    "held": {"type": "sample_hold", "period": "1 ms", "in": "u"},
    "left": {"type": "sum", "signs": "+-", "in": ["u", "held"]},
    "slack": {"type": "play", "radius": 0.1, "in": "left"},
    "core": {"type": "preisach", "levels": [-0.3, -0.1, 0.1, 0.3], "weights": [0.1, 0.2, 0.1, 0.3, 0.05, 0.2],
             "gain": 0.5, "in": "left"}},
    "outputs": {"slack": "slack", "core": "core"}})");
  const Outcome outcome = in_c::exported(folder, {"d.json", "--rate", "1 kHz"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Outcome run = in_c::tried(folder);
  EXPECT_TRUE(run.code == 0 && holds(run.out, in_c::same_bits)) << run.out << run.err;
  folder.write("out/four.c", R"(#include "comp.h"
#include <stdio.h>
int main(void)
{
    static const double u[4] = {0.5, 1.0, 0.75, 0.7};
    comp_state s;
    comp_input in;
    comp_output out;
    int k;
    comp_start(&s);
    for (k = 0; k < 4; ++k) {
        in.u = u[k];
        comp_step(&s, &in, &out);
        printf("%.2f ", out.slack);
    }
    return 0;
}
)");
  const Outcome four = process::shell(folder.path(), "cd out && cc -std=c99 -o four four.c comp.c -lm && ./four");
  // u - held goes 0; 0.5 and back to 0; -0.25 and back; -0.05 and back.
  EXPECT_EQ(four.out, "0.00 0.10 -0.10 -0.10 ") << four.err;
}
TEST(LongExportC, ManyRandomDiagramsHaveTheBitsOfTheEngine) {
  for (unsigned seed = 1000; seed < 1400; ++seed) expect_the_bits_of_the_engine(seed);
}

TEST(LongExportC, AnotherProcessorComesToTheSameBits) {
  const char* const compiler = "arm-linux-gnueabihf-gcc";
  const Folder folder;
  if (process::shell(folder.path(), fmt::format("command -v {} && command -v qemu-arm", compiler)).code != 0)
    GTEST_SKIP() << "needs gcc-arm-linux-gnueabihf and qemu-user (scripts/packages.txt, group arm)";
  // No function of libm: its last bits may be others there.
  folder.write("d.json", compensator);
  for (const std::string number : {"float64", "float32"}) {
    ASSERT_EQ(in_c::exported(folder, {"d.json", "--number", number}).code, 0);
    const Outcome run = in_c::tried(folder, compiler, "qemu-arm -L /usr/arm-linux-gnueabihf");
    EXPECT_EQ(run.code, 0) << run.out << run.err;
    if (number == "float64") {
      EXPECT_TRUE(holds(run.out, in_c::same_bits)) << run.out;
    }
  }
}

constexpr char stage[] = R"({
  "format": 1, "title": "stage", "inputs": {"u": {"unit": "V"}},
  "blocks": {"stack": {"type": "prandtl_ishlinskii", "in": "u", "thresholds": ["0 V", "1 V", "2.5 V"],
                       "weights": {"value": [0.8, 0.1, 0.2], "unit": "um/V"}},
             "creep": {"type": "creep", "in": "stack", "amounts": [0.03, 0.02], "times": ["0.05 s", "1 s"]},
             "sensor": {"type": "calibration", "gain": 1.02, "offset": "0.3 um", "in": "creep"}},
  "outputs": {"y": "sensor"}})";

TEST(ExportC, TheInverseOfAModelMakesItFollow) {
  const Folder folder;
  folder.write("stage.json", stage);
  const Outcome outcome = in_c::exported(folder, {"stage.json", "--inverse", "--rate", "1 kHz"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(holds(outcome.out, "driven by it, the model misses y by at most")) << outcome.out;
  const Outcome run = in_c::tried(folder);
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  // Undone exactly but for the way between the steps: far below a nanometre of a stroke of a micrometre.
  folder.write("check.json", R"({"format": 1, "title": "check", "blocks": {
    "wanted": {"type": "sine", "amplitude": "3 um", "offset": "3.3 um", "frequency": "1 Hz", "phase": "-90 deg"},
    "inverse": {"type": "diagram", "file": "out/comp.json", "in": "wanted"},
    "stage": {"type": "diagram", "file": "stage.json", "in": "inverse.u"},
    "error": {"type": "sum", "signs": "+-", "in": ["stage.y", "wanted"]}},
    "record": ["error", "wanted"], "simulate": {"until": "2 s", "every": "1 ms"}})");
  const Outcome check = process::hysteron(folder.path(), {"run", "check.json", "-o", "check"});
  EXPECT_EQ(check.code, 0) << check.err;
  double most = 0, highest = 0;  // [um], as the columns are: time, error, wanted
  std::istringstream rows(folder.read("check/traces/signals.csv"));
  std::string line;
  std::getline(rows, line);
  while (std::getline(rows, line)) {
    double t = 0, error = 0, wanted = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &t, &error, &wanted), 3) << line;
    most = std::max(most, std::fabs(error));
    highest = std::max(highest, wanted);
  }
  EXPECT_NEAR(highest, 6.3, 1e-3);
  EXPECT_LT(most, 1e-3);
}

TEST(ExportC, WhatHasNoInverseIsNamed) {
  const Folder folder;
  folder.write("stage.json", R"({"format": 1, "title": "t", "inputs": {"u": {"unit": "V"}}, "blocks": {
    "bent": {"type": "polynomial", "coefficients": {"value": [0, 1], "unit": "um"}, "reference": "1 V", "lower": "-9 V", "upper": "9 V", "in": "u"},
    "direct": {"type": "gain", "gain": "1 um/V", "in": "u"},
    "both": {"type": "sum", "in": ["bent", "direct"]}}, "outputs": {"y": "both"}})");
  const Outcome two_ways = in_c::exported(folder, {"stage.json", "--inverse"});
  EXPECT_TRUE(two_ways.code == 2 && holds(two_ways.err, "both (sum) sees the input \"u\" on more than one way"))
      << two_ways.err;
  const Outcome bent = in_c::exported(folder, {"stage.json", "--inverse", "--to", "bent"});
  EXPECT_TRUE(bent.code == 2 && holds(bent.err, "bent (polynomial) has no inverse here")) << bent.err;
}

}  // namespace
}  // namespace hysteron
