// The diagrams of diagrams/motion, each against a trace that a program of its own has computed: tests/io/motion holds
// the trace, NAME.csv in SI, and the script that made it, NAME.py.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "blocks/register_all.h"
#include "engine/program/program.h"
#include "engine/simulate/simulate.h"
#include "io/diagram/diagram_file.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

const fs::path source = HYSTERON_SOURCE_DIR;

struct Trace {
  std::vector<std::string> names;            ///< t, then signals
  std::vector<std::vector<double>> columns;  ///< SI
};
Trace read_trace(const fs::path& file) {
  std::ifstream in(file);
  Trace trace;
  std::string line, cell;
  std::getline(in, line);
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) trace.names.push_back(cell);
  trace.columns.resize(trace.names.size());
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    for (auto& column : trace.columns) {
      std::getline(cells, cell, ',');
      column.push_back(std::stod(cell));
    }
  }
  return trace;
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(source / "tests/io/motion"))
    if (entry.path().extension() == ".csv") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

class MotionDiagram : public testing::TestWithParam<std::string> {};

TEST_P(MotionDiagram, AgreesWithItsIndependentTrace) {
  const Trace wanted = read_trace(source / "tests/io/motion" / (GetParam() + ".csv"));
  ASSERT_GT(wanted.columns.at(0).size(), 20u);
  Diagram diagram = read_diagram((source / "diagrams/motion" / (GetParam() + ".json")).string());
  diagram.record.assign(wanted.names.begin() + 1, wanted.names.end());
  const Registry registry = all_blocks();
  const auto program = compile(diagram, registry);
  SimulateOptions options;
  options.instants = wanted.columns[0];
  options.relative_tolerance = 1e-7;
  const auto traces = simulate(*program, start(*program), options);
  for (std::size_t i = 1; i < wanted.names.size(); ++i) {
    const auto& column = wanted.columns[i];
    double size = 0;
    for (const double x : column) size = std::max(size, std::abs(x));
    // A hundred times the tolerance of the result: kinks and edges add up over the run. The trace has ten digits.
    for (std::size_t k = 0; k < column.size(); ++k)
      ASSERT_NEAR(traces.values[i - 1][k], column[k], 1e-5 * size)
          << wanted.names[i] << " at " << wanted.columns[0][k] << " s";
  }
}
TEST(MotionDiagrams, EachHasATraceOfItsOwn) {
  for (const auto& entry : fs::directory_iterator(source / "diagrams/motion")) {
    const std::string trace = entry.path().stem().string() + ".csv";
    EXPECT_TRUE(fs::exists(source / "tests/io/motion" / trace) || fs::exists(source / "tests/app/motion" / trace))
        << entry.path();
  }
}

INSTANTIATE_TEST_SUITE_P(All, MotionDiagram, testing::ValuesIn(all_names()),
                         [](const auto& made) { return made.param; });

}  // namespace
}  // namespace hysteron
