// What the build finds by itself, so that a block, an effect or a verb is a file that no other names: all that the
// sources declare are known to the program, in the order that is written down, and a file that does not follow is told.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "app/cli/verb.h"
#include "blocks/register_all.h"
#include "discover/effects/all.h"
#include "tests/app/hysteron_process.h"
#include "tests/app/source_files.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using process::Folder;
using sources::text_of;

using Names = std::vector<std::string>;

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

Names ids_of_effects() { return all_effects().ids(); }
Names names_of_verbs() {
  Names names;
  for (const auto make : verb_functions()) names.push_back(make().name);
  return names;
}

struct Kind {
  std::string folder, extension, function;
  Names (*known)();
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.folder; }

class Registration : public testing::TestWithParam<Kind> {
 protected:
  fs::path folder() const { return fs::path(HYSTERON_SOURCE_DIR) / GetParam().folder; }
};

TEST_P(Registration, KnowsAllThatSourcesDeclareUnderTheNamesOfTheirFunctions) {
  const auto declared = found_in(folder(), GetParam().extension, std::regex(GetParam().function));
  const auto known = GetParam().known();
  EXPECT_EQ(std::set<std::string>(known.begin(), known.end()), declared);
}

TEST_P(Registration, KeepsTheOrderThatIsWrittenDown) {
  std::ifstream file(folder() / "order.txt");
  Names order;
  for (std::string line; std::getline(file, line);)
    if (!line.starts_with("#")) order.push_back(line);
  ASSERT_GT(order.size(), 10U);
  const auto known = GetParam().known();
  ASSERT_GE(known.size(), order.size());
  EXPECT_EQ(Names(known.begin(), known.begin() + std::ssize(order)), order);
}

INSTANTIATE_TEST_SUITE_P(
    Of, Registration,
    testing::Values(Kind{"blocks", ".h", "\nKernel (\\w+)_block\\(\\)", [] { return all_blocks().types(); }},
                    Kind{"discover/effects", ".cpp", "\nEffect (?!static_curve\\()(\\w+)\\(\\) \\{", ids_of_effects},
                    Kind{"app/verbs", ".cpp", "\nVerb (\\w+)_verb\\(\\) \\{", names_of_verbs}),
    [](const auto& made) { return fs::path(made.param.folder).filename().string(); });

/// The build's search, on files of the test: things are functions `Thing name_thing();`.
class ListFunctions : public testing::Test {
 protected:
  ListFunctions() {
    (void)folder_.write("order.txt", "# order\nlast\nfirst\n");
    (void)folder_.write("a.h", "Thing first_thing();\nint other();\n");
    (void)folder_.write("b.h", "Thing last_thing();\nThing unnamed_thing();\n");
    (void)folder_.write("look.cmake", "cmake_minimum_required(VERSION 3.25)\ninclude(" HYSTERON_SOURCE_DIR
                                      R"(/cmake/list_functions.cmake)
file(GLOB files RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} *.h)
hysteron_list_functions(things TYPE Thing SUFFIX _thing ENDING ";" NAMESPACE n HEADER thing.h ORDER order.txt
  FILES ${files} CURE "Write \"Thing name_thing();\".")
)");
  }
  /// Exit code 0 with the list, or what is told, its lines joined.
  process::Outcome look() const {
    process::Outcome outcome = process::shell(folder_.path(), std::string(HYSTERON_CMAKE) + " -P look.cmake");
    outcome.err = std::regex_replace(outcome.err, std::regex("\\s+"), " ");
    return outcome;
  }
  Folder folder_;
};

TEST_F(ListFunctions, WritesThoseWithAPlaceInTheOrderBeforeTheOthers) {
  ASSERT_EQ(look().code, 0) << look().err;
  const std::string list = folder_.read("things.cpp");
  EXPECT_NE(list.find("    last_thing,\n    first_thing,\n    unnamed_thing,\n  };"), std::string::npos) << list;
  EXPECT_NE(list.find("#include \"thing.h\""), std::string::npos);
  EXPECT_NE(list.find("namespace n {\n\nThing last_thing();\n"), std::string::npos);
}

TEST_F(ListFunctions, TellsWhichFileDoesNotFollowAndWhatToDo) {
  (void)folder_.write("c.h", "Thing forgotten();\n");
  const auto outcome = look();
  EXPECT_NE(outcome.code, 0);
  EXPECT_NE(outcome.err.find("/c.h: no line \"Thing name_thing();\". Write \"Thing name_thing();\"."),
            std::string::npos)
      << outcome.err;
}

TEST_F(ListFunctions, TellsANameThatIsThereTwice) {
  (void)folder_.write("c.h", "Thing last_thing();\n");
  const auto outcome = look();
  EXPECT_NE(outcome.code, 0);
  EXPECT_NE(outcome.err.find("/c.h: \"last\" is there already, in b.h; choose another name."), std::string::npos)
      << outcome.err;
}

TEST_F(ListFunctions, TellsANameOfTheOrderThatNoFileHas) {
  (void)folder_.write("order.txt", "last\nlost\n");
  const auto outcome = look();
  EXPECT_NE(outcome.code, 0);
  EXPECT_NE(outcome.err.find("/order.txt: there is no \"Thing lost_thing()\"; remove the name \"lost\""),
            std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace hysteron
