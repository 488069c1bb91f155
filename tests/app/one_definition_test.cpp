// A name has one definition in the whole program (the one-definition rule). Two headers of rooms that do not know each
// other may each define a type of one name: no compiler and no linker says so, and the destructor of the one is called
// on objects of the other.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;

/// Types that a source defines at the level of a named namespace; those in an unnamed one are its own.
std::set<std::string> types_in(std::istream& text) {
  static const std::regex opens(R"(namespace ([\w:]+) \{)"), closes(R"(\}  // namespace [\w:]+)");
  static const std::regex type(
      R"((template <.*> )?(struct|class|enum class) (\[\[\w+\]\] |alignas\(\w+\) )?(\w+)( final)?( : [^;]*)? \{.*)");
  std::set<std::string> types;
  std::string spaces;
  bool unnamed = false;
  std::smatch found;
  for (std::string line; std::getline(text, line);) {
    if (line == "namespace {") unnamed = true;
    if (line == "}  // namespace") unnamed = false;
    if (std::regex_match(line, found, opens)) spaces += found[1].str() + "::";
    if (std::regex_match(line, closes)) spaces.erase(spaces.rfind(':', spaces.size() - 3) + 1);
    if (!unnamed && std::regex_match(line, found, type)) types.insert(spaces + found[4].str());
  }
  return types;
}

TEST(OneDefinition, OfEveryTypeOfTheProgram) {
  std::map<std::string, fs::path> where;
  for (const auto& room : fs::directory_iterator(HYSTERON_SOURCE_DIR)) {
    const std::string name = room.path().filename().string();
    if (!room.is_directory() || name.starts_with(".") || name.starts_with("build")) continue;
    for (const auto& entry : fs::recursive_directory_iterator(room.path())) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      std::ifstream in(entry.path());
      for (const auto& type : types_in(in)) {
        const auto [first, is_first] = where.emplace(type, entry.path());
        EXPECT_TRUE(is_first) << type << " is defined in " << first->second << " and in " << entry.path();
      }
    }
  }
  EXPECT_TRUE(where.contains("hysteron::Program"));
}

TEST(OneDefinition, IsReadFromSourcesAsTheyAreWritten) {
  std::istringstream text(
      "namespace hysteron {\nstruct One;\nstruct Two {\nnamespace {\nstruct Own {\n}  // namespace\n"
      "namespace features {\nclass Three final : public Two {\n}  // namespace features\nenum class Four { a, b };\n"
      "template <class T> struct Five {};\n}  // namespace hysteron\n");
  EXPECT_EQ(types_in(text),
            (std::set<std::string>{"hysteron::Two", "hysteron::features::Three", "hysteron::Four", "hysteron::Five"}));
}

}  // namespace
