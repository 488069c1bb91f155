// The table of docs/from-simulink.md names types that are there.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <string>

#include "blocks/register_all.h"

namespace hysteron {
namespace {

TEST(FromSimulink, NamesTypesThatAreThere) {
  std::ifstream file(HYSTERON_SOURCE_DIR "/docs/from-simulink.md");
  const Registry registry = all_blocks();
  const std::regex quoted("`([a-z_]+)`");
  int rows = 0;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("| ") || line.starts_with("| Simulink")) continue;
    ++rows;
    const auto begin = line.find('|', 1);
    const std::string ours = line.substr(begin, line.find('|', begin + 1) - begin);
    for (std::sregex_iterator i(ours.begin(), ours.end(), quoted), end; i != end; ++i) {
      const std::string type = (*i)[1];
      EXPECT_TRUE(type == "diagram" || registry.find(type) != nullptr) << line;
    }
  }
  EXPECT_GT(rows, 50);
}

}  // namespace
}  // namespace hysteron
