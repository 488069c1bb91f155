// FMUs as blocks: every diagram of the project, exported and imported, goes where it goes by itself; inputs, parameters
// and units; copies of a run; what is not trusted, damaged or of another kind is refused.
#include "io/fmi/imported_fmu.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>

#include "blocks/fmi/fmu_runs.h"
#include "blocks/register_all.h"
#include "engine/diagram/error.h"
#include "engine/simulate/simulate.h"
#include "io/diagram/diagram_file.h"
#include "io/diagram/packed_diagram.h"
#include "io/files/zip_archive.h"
#include "io/fmi/exported_description.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

const Registry& known_blocks() {
  static const Registry all = all_blocks();
  return all;
}

std::string fmu_of(const Diagram& diagram, int version) {
  const auto program = compile(diagram, known_blocks());
  const std::string packed = exported_program(diagram, all_blocks);
  const auto description = exported_description(*program, version, "exported", packed_token(packed));
  return zipped({{"modelDescription.xml", fmi_description_text(description)},
                 {"resources/program.json", packed},
                 {fmi_binary_name(description), TemporaryFolder::read(HYSTERON_FMU)}});
}

/// A diagram that is one block, which is the other diagram.
Diagram around(const Diagram& diagram, const Program& program, int version, double period,
               const TemporaryFolder& place) {
  const std::string packed = exported_program(diagram, all_blocks);
  const auto description = exported_description(program, version, "exported", packed_token(packed));
  place.write("resources/program.json", packed);
  ForeignInterface interface = interface_of(description, "exported.fmu");
  interface.binary = HYSTERON_FMU;
  interface.resources = place.path("resources");
  Diagram host;
  Node& node = host.blocks["x"];
  node.type = "fmu";
  node.parameters["file"].content = std::string("exported.fmu");
  node.parameters["interface"].content = foreign_interface_text(interface);
  node.parameters["period"] = Value(Number{period, "s"});
  for (const auto& v : interface.outputs) host.record.push_back("x." + v.port);
  return host;
}

void compare(const std::string& file) {
  constexpr int rows = 42;
  const Diagram diagram = read_diagram(file);
  const auto program = compile(diagram, known_blocks());
  SimulateOptions options = simulate_options(*program);
  if (!program->input_names.empty() || options.every <= 0) return;
  options.until = options.begin + rows * options.every;
  options.signals = program->output_signals.empty() ? program->record_signals : program->output_signals;
  const Traces run = simulate(*program, start(*program), options);
  const TemporaryFolder place;
  const auto host = compile(around(diagram, *program, 2, options.every, place), known_blocks());
  SimulateOptions of_host = options;
  of_host.signals = host->record_signals;
  of_host.method = Method::automatic;
  const Traces imported = simulate(*host, start(*host), of_host);
  ASSERT_EQ(imported.values.size(), run.values.size());
  std::map<std::string, double> size;
  const auto unit = [&](std::size_t s) {
    return program->signals[static_cast<std::size_t>(options.signals[s])].unit.text;
  };
  for (std::size_t s = 0; s < run.values.size(); ++s)
    for (const double v : run.values[s]) size[unit(s)] = std::max(size[unit(s)], std::abs(v));
  // Each is held to 1e-6 of what signals usually are, and some are rounding beside others of their unit.
  for (std::size_t s = 0; s < run.values.size(); ++s)
    for (std::size_t k = 0; k < run.t.size(); ++k)
      ASSERT_NEAR(imported.values[s][k], run.values[s][k], 1e-4 * size[unit(s)])
          << host->record_signals[s] << " row " << k;
}

TEST(ImportedFmu, EveryDiagramOfTheProjectComesBackAsABlock) {
  int seen = 0;
  for (const auto& entry : fs::recursive_directory_iterator(HYSTERON_SOURCE_DIR "/diagrams")) {
    const std::string file = entry.path().string();
    if (!file.ends_with(".json") || !is_diagram_file(file)) continue;
    SCOPED_TRACE(file);
    compare(file);
    ++seen;
  }
  EXPECT_GT(seen, 50);
}

class ImportedFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("lag.fmu", fmu_of(read_diagram(HYSTERON_SOURCE_DIR "/tests/interop/driven.json"), 3));
  }
  std::string host(const std::string& more = "") const {
    return folder_.write("host.json", R"({"format": 1, "title": "host", "simulate": {"until": "20 ms", "every": "1 ms"},
      "blocks": {"drive": {"type": "constant", "value": "2 V"},
                 "x": {"type": "fmu", "file": "lag.fmu", "period": "1 ms")" +
                                          more + R"(, "in": {"u": "drive"}}}, "record": ["x"]})");
  }
  double last(const std::string& file) const {
    const auto program = compile(read_diagram(file, {folder_.path("lag.fmu")}), known_blocks());
    return simulate(*program, start(*program), simulate_options(*program)).values[0].back();
  }
  std::string refused(const std::string& file, const std::vector<std::string>& allowed = {}) const {
    try {
      const auto program = compile(read_diagram(file, allowed), known_blocks());
      simulate(*program, start(*program), simulate_options(*program));
    } catch (const Error& e) {
      return to_text(e.problems);
    }
    return "";
  }

  const TemporaryFolder folder_;
};

TEST_F(ImportedFile, TakesInputsAndParametersInTheirUnits) {
  // 20 ms of a lag of 20 ms, whose gain is 1 um/V; the FMU holds 1e-9, and begins anew at no step.
  EXPECT_NEAR(last(host()), 2e-6 * (1 - std::exp(-1.0)), 2e-12);
  EXPECT_NEAR(last(host(R"(, "gain_gain": "3 nm/V")")), 6e-9 * (1 - std::exp(-1.0)), 6e-15);
}

TEST_F(ImportedFile, NativeCodeRunsOnlyWhereItIsTrusted) {
  const std::string file = host();
  EXPECT_NO_THROW(compile(read_diagram(file), known_blocks()));  // it can be read and drawn
  EXPECT_NE(refused(file).find("native code of somebody else"), std::string::npos) << refused(file);
  EXPECT_NE(refused(file).find("--allow lag.fmu"), std::string::npos);
  EXPECT_NE(refused(file, {folder_.path()}).find("native code"), std::string::npos) << "a folder is no trust";
  EXPECT_EQ(refused(file, {folder_.path("lag.fmu")}), "");
}

TEST_F(ImportedFile, ACopyOfARunGoesOnByItself) {
  const auto program = compile(read_diagram(host(), {folder_.path("lag.fmu")}), known_blocks());
  SimulateOptions half = simulate_options(*program);
  half.method = Method::runge_kutta;
  half.until = 0.0105;
  const Traces first = simulate(*program, start(*program), half);
  ASSERT_TRUE(first.end);
  SimulateOptions rest = half;
  rest.begin = half.until;
  rest.until = 0.02;
  const auto once = simulate(*program, *first.end, rest).values[0],
             again = simulate(*program, *first.end, rest).values[0];
  EXPECT_EQ(once, again);
  EXPECT_NEAR(once.back(), 2e-6 * (1 - std::exp(-0.95)), 2e-12);  // the last row is at 19.5 ms: 19 steps
}

// States of an FMU live in its process: of many runs those that nobody has asked for in a long while are forgotten.
TEST_F(ImportedFile, RunsOfLongAgoAreForgottenAndMayBeBegunAgain) {
  const auto begun = [&](int k) {
    const auto program =
        compile(read_diagram(host(R"(, "gain_gain": ")" + std::to_string(k) + R"( um/V")"), {folder_.path("lag.fmu")}),
                known_blocks());
    SimulateOptions options = simulate_options(*program);
    options.method = Method::runge_kutta;  // whose traces have the run at their end
    options.until = 4.9995;                // 5000 steps
    options.every = options.until;
    return std::pair(program, simulate(*program, start(*program), options));
  };
  const auto go_on = [](const auto& run) {
    SimulateOptions options = simulate_options(*run.first);
    options.method = Method::runge_kutta;
    options.begin = 4.9995;
    options.until = 5.01;
    return simulate(*run.first, *run.second.end, options).values[0].back();
  };
  const auto first = begun(1);
  EXPECT_NEAR(go_on(first), 2e-6, 1e-11);
  auto last = begun(2);
  for (int k = 3; k < 30; ++k) last = begun(k);
  EXPECT_NEAR(go_on(last), 58e-6, 1e-10);
  try {
    go_on(first);
    FAIL() << "30 runs of 5000 steps are more than are kept";
  } catch (const Error& error) {
    EXPECT_EQ(error.problems.front().code, "fmu_forgotten");
    EXPECT_NE(error.problems.front().cure.find("begin this run again"), std::string::npos);
  }
  const auto again = begun(1);
  EXPECT_EQ(again.second.values, first.second.values);
}

// What one thread begins again is used, too, before another one begins something new.
TEST_F(ImportedFile, ARunThatIsBegunAgainIsNotForgottenBeforeItsFirstStep) {
  const Diagram diagram = read_diagram(host(), {folder_.path("lag.fmu")});
  const Node& block = *diagram.blocks.find("x");
  auto& runs = blocks::FmuRuns::at_number(
      blocks::FmuRuns::number_of(std::get<std::string>(block.parameters.find("interface")->content)));
  const double held[] = {2.0};
  const auto begun = [&](int k) {  // each start is a run of its own, of 5000 steps; 20 of them are kept
    long node = runs.root(k, {});
    for (int step = 0; step < 5000; ++step) node = runs.advanced(node, held, k + step * 1e-3, 1e-3);
    return node;
  };
  std::vector<long> last;
  for (int k = 0; k < 21; ++k) last.push_back(begun(k));
  EXPECT_THROW(runs.outputs(last[0]), Error);
  const long again = runs.root(1, {});  // that of longest ago
  runs.root(100, {});
  EXPECT_NO_THROW(runs.advanced(again, held, 1, 1e-3));
  EXPECT_NO_THROW(runs.outputs(last[1]));
  EXPECT_THROW(runs.outputs(last[2]), Error);
}

TEST_F(ImportedFile, WhatIsWrongIsToldAtItsPlace) {
  EXPECT_NE(refused(host(R"(, "gain_gian": 3)")).find("gain_gain"), std::string::npos) << "the nearest name";
  EXPECT_NE(refused(host(R"(, "interface": "x")")).find("made from the file"), std::string::npos);
  folder_.write("lag.fmu", "no archive");
  EXPECT_NE(refused(host()).find("this FMU cannot be read"), std::string::npos);
  folder_.write("lag.fmu", zipped({{"modelDescription.xml",
                                    R"(<fmiModelDescription fmiVersion="2.0" modelName="m" guid="g"><ModelVariables>
    <ScalarVariable name="a" valueReference="1"><Real/></ScalarVariable></ModelVariables></fmiModelDescription>)"}}));
  EXPECT_NE(refused(host()).find("offers no co-simulation"), std::string::npos);
}

TEST_F(ImportedFile, TheDiagramIsWrittenAsItWas) {
  const std::string text = diagram_text(read_diagram(host()));
  EXPECT_NE(text.find("\"file\": \"lag.fmu\""), std::string::npos) << text;
  EXPECT_EQ(text.find("interface"), std::string::npos);
  const std::string moved = diagram_text(moved_diagram(read_diagram(host()), folder_.path("sub/next.json")));
  EXPECT_NE(moved.find("\"file\": \"../lag.fmu\""), std::string::npos) << moved;
}

}  // namespace
}  // namespace hysteron
