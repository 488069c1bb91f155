// Comments that name a source name one that is there: a file that moved or went takes the sentences about it along.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>

#include "tests/app/source_files.h"

namespace {

namespace fs = std::filesystem;
using hysteron::sources::is_source;

const char* const folders[] = {"engine", "models", "blocks", "io",         "fit",  "discover",
                               "report", "draw",   "app",    "benchmarks", "tests"};

/// Sources that the comments of a text name: as a path, or the name alone.
std::set<std::string> named_in_comments(std::istream& text) {
  static const std::regex source(R"([A-Za-z_][\w/]*\.(h|cpp)\b)");
  std::set<std::string> named;
  for (std::string line; std::getline(text, line);) {
    const auto comment = line.find("// ");
    if (comment == std::string::npos) continue;
    const std::string words = line.substr(comment);
    for (std::sregex_iterator i(words.begin(), words.end(), source), end; i != end; ++i) named.insert(i->str());
  }
  return named;
}

TEST(Comments, NameSourcesThatAreThere) {
  const fs::path root = HYSTERON_SOURCE_DIR;
  std::set<std::string> there;
  for (const auto* folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(root / folder))
      if (is_source(entry.path())) there.insert(entry.path().filename().string());
  int named = 0;
  for (const auto* folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (!is_source(entry.path()) || entry.path().filename() == "comments_test.cpp") continue;
      std::ifstream in(entry.path());
      for (const auto& source : named_in_comments(in)) {
        ++named;
        const bool is_there =
            source.find('/') == std::string::npos ? there.contains(source) : fs::exists(root / source);
        EXPECT_TRUE(is_there) << entry.path() << " speaks of " << source << ", which is not there";
      }
    }
  EXPECT_GT(named, 100);
}

/// Documents by which the program was designed: what still holds of them stands in docs/ and where it is done.
TEST(Comments, NameNoDocumentThatIsNotInTheProject) {
  static const std::regex elsewhere(R"(\b(DESIGN|ENGINE|STYLE|EFFECTS|DISCOVERY) [0-9])");
  for (const auto* folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(HYSTERON_SOURCE_DIR) / folder)) {
      if (!is_source(entry.path())) continue;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);)
        EXPECT_FALSE(std::regex_search(line, elsewhere)) << entry.path() << ": " << line;
    }
}

}  // namespace
