// The table of docs/from-simulink.md names types that are there, and the program says of each name what the table says.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "blocks/other_names.h"
#include "blocks/register_all.h"

namespace hysteron {
namespace {

struct Row {
  std::string names, ours;
};

std::vector<Row> rows_of_the_table() {
  std::ifstream file(HYSTERON_SOURCE_DIR "/docs/from-simulink.md");
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("| ") || line.starts_with("| Simulink")) continue;
    const auto begin = line.find('|', 1);
    rows.push_back({line.substr(2, begin - 2), line.substr(begin, line.find('|', begin + 1) - begin)});
  }
  return rows;
}

std::set<std::string> all_matches(const std::string& text, const char* pattern) {
  std::set<std::string> found;
  const std::regex of(pattern);
  for (std::sregex_iterator i(text.begin(), text.end(), of), end; i != end; ++i) found.insert((*i)[1]);
  return found;
}

/// "Simscape: Mass, Lookup Table (1-D, n-D), Detect Change ..." are Mass, Lookup Table, Detect Change.
std::vector<std::string> single_names(std::string names) {
  names = std::regex_replace(names, std::regex(R"(^Simscape: | \([^)]*\)| \.\.\.| $)"), "");
  std::vector<std::string> list;
  for (std::size_t begin = 0; begin < names.size();) {
    const std::size_t end = std::min(names.find(", ", begin), names.size());
    list.push_back(names.substr(begin, end - begin));
    begin = end + 2;
  }
  return list;
}

TEST(FromSimulink, NamesTypesThatAreThere) {
  const Registry registry = all_blocks();
  const auto rows = rows_of_the_table();
  for (const auto& row : rows)
    for (const auto& type : all_matches(row.ours, "`([a-z_]+)`"))
      EXPECT_TRUE(type == "diagram" || registry.find(type) != nullptr) << row.names;
  EXPECT_GT(rows.size(), 50U);
}

TEST(FromSimulink, EveryNameLeadsToWhatTheTableSays) {
  const Registry registry = all_blocks();
  for (const auto& row : rows_of_the_table()) {
    const auto ours = all_matches(row.ours, "`([a-z_]+)`");
    for (const auto& name : single_names(row.names)) {
      const std::string told = instead_of_other_name(name);
      auto leads_to = all_matches(told, "\"([a-z_]+)\"");
      for (const auto& type : registry.types())
        if (plain_name(type) == plain_name(name)) leads_to.insert(type);
      // a port of the diagram is no block
      const bool port = leads_to.contains("inputs") || leads_to.contains("outputs");
      const bool same =
          std::any_of(ours.begin(), ours.end(), [&](const auto& type) { return leads_to.contains(type); });
      EXPECT_TRUE(same || (port && (ours.empty() || name == "Inport"))) << name << ": " << told;
    }
  }
}

}  // namespace
}  // namespace hysteron
