// What a new file of a block or an effect needs elsewhere, and what the compiler does not miss: its line among those
// that are registered.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// First groups of all matches in the files of a folder with this extension.
std::set<std::string> found_in(const fs::path& folder, const std::string& extension, const std::regex& pattern) {
  std::set<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != extension) continue;
    const std::string text = text_of(entry.path());
    for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i) found.insert((*i)[1].str());
  }
  return found;
}

TEST(Registration, EveryBlockThatAHeaderDeclaresIsRegistered) {
  const fs::path folder = fs::path(HYSTERON_SOURCE_DIR) / "blocks";
  const auto declared = found_in(folder, ".h", std::regex("\\nKernel (\\w+)\\(\\);"));
  EXPECT_GT(declared.size(), 80U);
  const std::string list = text_of(folder / "register_all.cpp");
  for (const auto& block : declared)
    EXPECT_NE(list.find("blocks::" + block + "()"), std::string::npos)
        << block << " has no line in blocks/register_all.cpp";
}

TEST(Registration, EveryEffectOfAFileOfItsNameIsInTheLibrary) {
  const fs::path folder = fs::path(HYSTERON_SOURCE_DIR) / "discover" / "effects";
  const auto defined = found_in(folder, ".cpp", std::regex("\\nEffect (\\w+)\\(\\) \\{"));
  const std::string list = text_of(folder / "all.cpp");
  int effects = 0;
  for (const auto& effect : defined) {
    if (!fs::exists(folder / (effect + ".cpp"))) continue;  // what several of them share
    ++effects;
    EXPECT_NE(list.find(" " + effect + "(),"), std::string::npos)
        << effect << " has no line in discover/effects/all.cpp";
  }
  EXPECT_GT(effects, 25);
}

}  // namespace
