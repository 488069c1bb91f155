// Diagrams of ordinary drives and heaters, run as files, against traces that another program computed from their
// equations alone (reference.py beside this file).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <istream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "engine/diagram/units.h"
#include "tests/app/hysteron_process.h"

namespace hysteron {
namespace {

using process::Folder;
using process::Outcome;

/// Columns in SI by their names.
std::map<std::string, std::vector<double>> columns_of(std::istream& file) {
  std::string line, cell;
  std::getline(file, line);
  std::vector<std::pair<std::string, Unit>> header;
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) {
    const auto open = cell.find(" [");
    header.emplace_back(cell.substr(0, open),
                        open == cell.npos ? Unit{} : parse_unit(cell.substr(open + 2, cell.size() - open - 3)));
  }
  std::map<std::string, std::vector<double>> columns;
  while (std::getline(file, line)) {
    std::size_t i = 0;
    for (std::istringstream cells(line); std::getline(cells, cell, ','); ++i)
      columns[header.at(i).first].push_back(header[i].second.text.empty() ? std::stod(cell)
                                                                          : header[i].second.to_si(std::stod(cell)));
  }
  return columns;
}

/// Largest difference [SI] of a recorded signal at the rows of the reference.
std::map<std::string, double> differences(const std::string& name) {
  const std::string root = HYSTERON_SOURCE_DIR;
  const Folder folder;
  const Outcome outcome =
      process::hysteron(folder.path(), {"run", root + "/diagrams/motion/" + name + ".json", "-o", "out", "--quiet"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  std::istringstream rows(folder.read("out/traces/signals.csv"));
  const auto ours = columns_of(rows);
  std::ifstream file(root + "/tests/app/motion/" + name + ".csv");
  const auto reference = columns_of(file);
  const auto &t = ours.at("t"), &instants = reference.at("t");
  EXPECT_GT(instants.size(), 100u);
  std::map<std::string, double> worst;
  std::size_t k = 0;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    while (k + 1 < t.size() && t[k] < instants[i] - 1e-9) ++k;
    EXPECT_NEAR(t[k], instants[i], 1e-9);
    for (const auto& [column, values] : reference)
      if (column != "t") worst[column] = std::max(worst[column], std::fabs(ours.at(column)[k] - values[i]));
  }
  return worst;
}

TEST(MotionDiagrams, ABallScrewWithPlayIsMovedByItsCascade) {
  const auto off = differences("ball_screw_cascade");
  // The tolerance of the run is 1e-6 of a travel of 0.2 m, and of 377 rad/s; within the gap the table swings free, and
  // when it meets a flank again hangs on what came before.
  EXPECT_LT(off.at("move.position"), 2e-9);  // nine digits of the file
  EXPECT_LT(off.at("table.position"), 2e-7);
  EXPECT_LT(off.at("motor.velocity"), 2e-3);
  EXPECT_LT(off.at("speed"), 2e-3);  // [N m] of 10
}

TEST(MotionDiagrams, AHeaterReachesItsLimitsAndComesBack) {
  // Held commands, linear plants: exact row by row. Half of the last of nine digits of 353 K, and as many watts.
  const auto off = differences("heater");
  EXPECT_LT(off.at("of_plate"), 1e-6);
  EXPECT_LT(off.at("sensor"), 1e-6);
  EXPECT_LT(off.at("control"), 1e-5);
}

TEST(MotionDiagrams, ABeltDriveWithANotchCarriesItsCarriage) {
  // 1e-6 of 0.4 m, 53 rad/s, 63 N: a tenth of these is seen.
  const auto off = differences("belt_drive");
  EXPECT_LT(off.at("carriage.position"), 1e-7);
  EXPECT_LT(off.at("motor.velocity"), 5e-5);
  EXPECT_LT(off.at("speed"), 2e-5);
  EXPECT_LT(off.at("belt.force"), 1e-3);
}

}  // namespace
}  // namespace hysteron
