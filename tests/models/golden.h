// Decides how the golden traces of the thesis (computed by an independent program) are read for tests.
// Does not decide tolerances: each test gives its reason.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace hysteron::golden {

inline std::filesystem::path path(const std::string& name) {
  return std::filesystem::path(HYSTERON_SHARED_DIR) / "thesis" / "golden" / (name + ".csv");
}
inline bool present(const std::string& name) { return std::filesystem::exists(path(name)); }

/// Columns by their header ("u [V]").
inline std::map<std::string, std::vector<double>> read(const std::string& name) {
  std::ifstream file(path(name));
  std::string line, cell;
  std::getline(file, line);
  std::vector<std::string> header;
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) header.push_back(cell);
  std::map<std::string, std::vector<double>> columns;
  while (std::getline(file, line)) {
    std::size_t i = 0;
    for (std::istringstream cells(line); std::getline(cells, cell, ',');)
      columns[header.at(i++)].push_back(std::stod(cell));
  }
  if (columns.empty() || columns.begin()->second.size() < 10)
    throw std::runtime_error("golden trace " + name + " has no rows");
  return columns;
}

}  // namespace hysteron::golden

/// Skips a test, visibly, where the golden traces are not at hand.
#define HYSTERON_NEEDS_GOLDEN(name) \
  if (!hysteron::golden::present(name)) GTEST_SKIP() << "no golden traces at " << hysteron::golden::path(name)
