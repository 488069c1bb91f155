// Who may include whom, read from the #include lines of every source file: docs/architecture.md draws the same picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/source_files.h"

namespace {

namespace fs = std::filesystem;
using hysteron::sources::is_source;
using hysteron::sources::text_of;

const std::map<std::string, std::set<std::string>> may_include = {
    {"engine", {}},
    {"models", {}},
    {"blocks", {"engine", "models"}},
    {"export", {"engine", "blocks"}},
    {"io", {"engine"}},
    {"fit", {"engine", "io"}},
    {"discover", {"engine", "io", "fit"}},
    {"report", {"io", "engine", "fit", "discover", "draw"}},
    {"draw", {"engine"}},
    {"studio", {"engine", "io", "draw"}},
    {"app", {"engine", "models", "blocks", "io", "fit", "discover", "report", "draw", "studio", "export"}},
    {"interop", {"engine", "blocks", "io", "report", "app"}},
};

/// The rooms of each folder, from the ground up: a room includes only what stands before it. "" are the files that lie
/// in no room.
const std::map<std::string, std::vector<std::string>> storeys = {
    {"engine",
     {"diagram", "block", "matrices", "program", "compile", "integrators", "events", "rowwise", "simulate", "analysis",
      "lanes"}},
    {"models",
     {"", "sources", "math", "logic", "linear", "continuous", "hysteresis", "compensators", "mechanics", "electrical",
      "sampled", "disturbances", "measurement"}},
    {"blocks",
     {"sources", "math", "logic", "vectors", "linear", "continuous", "hysteresis", "compensators", "mechanics",
      "electrical", "sampled", "temperature", "disturbances", "measurement", "fmi", ""}},
    {"io", {"files", "json", "formats", "data", "fmi", "diagram", "jobs", "results"}},
    {"export", {"c"}},
    {"fit", {"numerics", "signals", "model", "estimate", "inspect", "compare", "study", "thesis"}},
    {"discover",
     {"wiring", "hypotheses", "effects", "placement", "demonstration", "experiment", "models", "structure", "search",
      "selection", "narrate"}},
    {"report", {"page", "pages"}},
    {"draw", {""}},
    {"studio", {""}},
    {"app", {"cli", "facts", "jobs", "cluster", "study", "manual", "exports", "verbs", ""}},
    {"interop", {"fmi", "c"}},
};

/// Rooms that a text includes from.
std::set<std::string> rooms_in(const std::string& text) {
  static const std::regex include("(^|\n)[ \t]*#[ \t]*include[ \t]*[\"<]([a-z_]+)/");
  std::set<std::string> rooms;
  for (std::sregex_iterator i(text.begin(), text.end(), include), end; i != end; ++i)
    if (may_include.contains((*i)[2].str()) || (*i)[2].str() == "tests") rooms.insert((*i)[2].str());
  return rooms;
}

TEST(Architecture, RoomsIncludeOnlyTheRoomsThatTheyMay) {
  for (const auto& [room, allowed] : may_include) {
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(HYSTERON_SOURCE_DIR) / room)) {
      if (!is_source(entry.path())) continue;
      ++files;
      for (const auto& other : rooms_in(text_of(entry.path())))
        EXPECT_TRUE(other == room || allowed.contains(other)) << entry.path() << " includes from " << other;
    }
    EXPECT_GT(files, 0U) << room << " was not looked at";
  }
}

TEST(Architecture, TheTestItselfSeesAForbiddenInclude) {
  const auto rooms =
      rooms_in("// x\n#include <vector>\n#include \"blocks/math/gain.h\"\n  # include \"engine/diagram/error.h\"\n");
  EXPECT_EQ(rooms, (std::set<std::string>{"blocks", "engine"}));
}

std::string in_project(const fs::path& file) { return fs::relative(file, HYSTERON_SOURCE_DIR).generic_string(); }

/// Every source file of every room.
template <class Action>
void for_each_source(const Action& action) {
  for (const auto& [room, allowed] : may_include)
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(HYSTERON_SOURCE_DIR) / room))
      if (is_source(entry.path())) action(room, entry.path(), text_of(entry.path()));
}

/// "simulate" of "engine/simulate/simulate.h", "" of a source beside the rooms.
std::string room_of(const std::string& folder, const std::string& path) {
  const std::string inside = path.substr(folder.size() + 1);
  const auto slash = inside.find('/');
  return slash == std::string::npos ? "" : inside.substr(0, slash);
}

/// What a text includes from its own folder.
std::vector<std::string> own_includes(const std::string& folder, const std::string& text) {
  const std::regex include("(^|\n)[ \t]*#[ \t]*include[ \t]*\"(" + folder + "/[^\"]+)\"");
  std::vector<std::string> list;
  for (std::sregex_iterator i(text.begin(), text.end(), include), end; i != end; ++i) list.push_back((*i)[2].str());
  return list;
}

TEST(Architecture, RoomsOfAFolderStandOnEachOther) {
  for_each_source([](const std::string& folder, const fs::path& file, const std::string& text) {
    const auto& rooms = storeys.at(folder);
    const auto storey = [&](const std::string& path) {
      return std::find(rooms.begin(), rooms.end(), room_of(folder, path)) - rooms.begin();
    };
    const std::string own = in_project(file);
    ASSERT_LT(storey(own), std::ssize(rooms)) << own << " lies in a room that storeys does not name";
    for (const auto& other : own_includes(folder, text))
      EXPECT_LE(storey(other), storey(own)) << own << " includes " << other << ", which stands above it";
  });
}

TEST(Architecture, RoomsAreNoWarehouses) {
  std::map<fs::path, int> files;
  for_each_source([&](const std::string&, const fs::path& file, const std::string&) { ++files[file.parent_path()]; });
  for (const auto& [room, count] : files)
    EXPECT_LE(count, 40) << room << " holds " << count << " files: which of them have an idea of their own?";
}

TEST(Architecture, HeadersAreReadOnceAndOpenWithWhatTheyDecide) {
  for_each_source([](const std::string&, const fs::path& file, const std::string& text) {
    if (file.extension() != ".h") return;
    EXPECT_NE(text.find("#pragma once"), std::string::npos) << file;
    EXPECT_TRUE(text.starts_with("//")) << file << " does not open with what it decides";
  });
}

// A verb gives an answer; app/cli prints it and puts its results in place.
TEST(Architecture, OnlyTheCommandLinePrintsAndPublishes) {
  for_each_source([](const std::string& folder, const fs::path& file, const std::string& text) {
    const std::string own = in_project(file);
    if (own.starts_with("app/cli/")) return;
    for (const char* door : {"fmt::print(", "printf(stdout", "printf(stderr", "std::printf", "std::fputs", "std::cout",
                             "std::cerr", "publish_folder(", "publish_files(", "perform("})
      EXPECT_EQ(text.find(door), std::string::npos) << own << " calls " << door;
    if (folder != "app") return;
    for (const char* door : {"write_result(", "finish_result(", "interrupted()", "isatty("})
      EXPECT_EQ(text.find(door), std::string::npos) << own << " calls " << door;
  });
}

// A header that costs seconds to read may be included by sources and by headers that no other room sees.
TEST(Architecture, NoRoomReadsAHeavyHeaderThroughAnother) {
  std::set<std::string> heavy;  // "engine/rowwise/linear_part.h"
  for_each_source([&](const std::string& room, const fs::path& file, const std::string& text) {
    if (file.extension() != ".h") return;
    for (const char* costly : {"<nlohmann/json.hpp>", "<Eigen/", "<CLI/", "<boost/", "<hdf5.h>"})
      if (text.find(costly) != std::string::npos)
        heavy.insert(room + "/" + fs::relative(file, fs::path(HYSTERON_SOURCE_DIR) / room).generic_string());
  });
  for_each_source([&](const std::string& room, const fs::path& file, const std::string& text) {
    for (const auto& header : heavy) {
      if (!header.starts_with(room + "/") || file.extension() == ".h") {
        EXPECT_EQ(text.find("\"" + header + "\""), std::string::npos) << file << " includes " << header;
      }
    }
  });
}

/// "fit/model" of "fit/model/model.h", as seen from the project.
std::string folder_of(const std::string& path) { return path.substr(0, path.rfind('/')); }

TEST(Architecture, FilesHaveOneIdea) {
  for_each_source([](const std::string&, const fs::path& file, const std::string& text) {
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 500) << file << ": which part has an idea of its own?";
  });
}

/// What is longer than a screen, and why: tables are read line by line.
const std::set<std::string> long_functions = {
    "draw/pictogram.cpp",              // a table: pictures
    "draw/symbol.cpp",                 // a table: which type has which picture
    "blocks/other_names.cpp",          // a table: names in other programs
    "engine/block/rows.h",             // one loop over rows, whose numbers stay in registers
};

/// Lines of the longest function of a namespace or a class, from its name to its end: clang-format closes it with a
/// brace alone, in the column in which it begins.
std::size_t longest_function(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  std::size_t longest = 0;
  for (std::size_t end = 0; end < lines.size(); ++end) {
    const auto column = lines[end].find('}');
    if (lines[end] != "}" && lines[end] != "  }") continue;
    std::size_t begin = end;
    while (begin > 0 && (begin == end || lines[begin].find_first_not_of(' ') != column || lines[begin][0] == '#'))
      --begin;
    longest = std::max(longest, end - begin + 1);
  }
  return longest;
}

TEST(Architecture, FunctionsFitAScreen) {
  EXPECT_EQ(longest_function("int f(int a,\n      int b) {\n#ifdef X\n  if (a) {\n    b();\n  }\n\n  return a;\n}\n"),
            9U);
  for_each_source([](const std::string&, const fs::path& file, const std::string& text) {
    const std::string own = in_project(file);
    const bool effect = own.starts_with("discover/effects/");  // each function is the description of one effect
    if (effect || long_functions.contains(own)) return;
    EXPECT_LE(longest_function(text), 70U) << file << ": which part has a name of its own?";
  });
  for (const auto& file : long_functions)
    EXPECT_GT(longest_function(text_of(fs::path(HYSTERON_SOURCE_DIR) / file)), 70U) << file << " needs no exception";
}

// Where a name is declared tells where it is defined: in the source of that name, or in one that the header names. What
// the build finds by itself (effects, verbs, laws of blocks in C) needs no header.
TEST(Architecture, ASourceHasTheHeaderOfItsNameOrIsNamedInOne) {
  std::map<std::string, std::string> headers;  // of a folder: all texts
  std::set<std::string> names;
  std::vector<fs::path> sources;
  for_each_source([&](const std::string&, const fs::path& file, const std::string& text) {
    const std::string own = in_project(file);
    if (file.extension() == ".h") {
      headers[folder_of(own)] += text;
      names.insert(own.substr(0, own.size() - 2));
    } else if (folder_of(own) != "app/verbs" && folder_of(own) != "discover/effects" && own != "app/main.cpp" &&
               !own.ends_with("_in_c.cpp")) {
      sources.push_back(file);
    }
  });
  for (const auto& file : sources) {
    const std::string own = in_project(file);
    if (names.contains(own.substr(0, own.size() - 4))) continue;
    EXPECT_NE(headers[folder_of(own)].find(file.filename().string()), std::string::npos)
        << own << " has no header of its name, and none of " << folder_of(own) << " says what stands in it";
  }
}

/// Rooms that are tested through others: facts, exports and pages of the manual by the answers of the verbs, wiring by
/// placement, what drives FMUs by what is exported.
const std::set<std::string> tested_elsewhere = {"app/exports", "app/facts", "app/manual", "discover/wiring",
                                                "blocks/fmi"};
/// Tests of the whole, in folders that mirror no room: of diagrams that are shipped, and against other programs.
const std::set<std::string> tests_of_the_whole = {"app/motion", "discovery", "reference"};

/// Paths below tests/ of all their sources: tests, and samples of blocks, which the tests of all blocks take.
std::vector<std::string> sources_of_tests() {
  std::vector<std::string> sources;
  const fs::path root = fs::path(HYSTERON_SOURCE_DIR) / "tests";
  for (const auto& entry : fs::recursive_directory_iterator(root))
    if (entry.path().extension() == ".cpp") sources.push_back(fs::relative(entry.path(), root).generic_string());
  return sources;
}

TEST(Architecture, TestsMirrorTheRooms) {
  std::set<std::string> rooms, tested;
  std::map<std::string, std::set<std::string>> rooms_with;  // by folder and name: "fit", "profile" -> "fit/estimate"
  for_each_source([&](const std::string& folder, const fs::path& file, const std::string&) {
    const std::string room = folder_of(in_project(file));
    rooms.insert(room);
    rooms_with[folder + " " + file.stem().string()].insert(room);
  });
  for (const auto& test : sources_of_tests()) {
    const std::string room = folder_of(test), folder = test.substr(0, test.find('/')), end = "_test.cpp";
    tested.insert(room);
    if (tests_of_the_whole.contains(room) || !test.ends_with(end)) continue;
    EXPECT_TRUE(rooms.contains(room) || may_include.contains(room)) << "tests/" << test << " mirrors no room";
    const std::string name = test.substr(room.size() + 1, test.size() - room.size() - 1 - end.size());
    const auto& of_its_name = rooms_with[folder + " " + name];
    EXPECT_TRUE(of_its_name.empty() || of_its_name.contains(room))
        << "tests/" << test << " is named as a source of " << *of_its_name.begin() << ": move it there";
  }
  for (const auto& room : rooms) {
    const std::string by_blocks = "blocks" + room.substr(room.find('/') == std::string::npos ? 0 : room.find('/'));
    const bool physics = room.starts_with("models/") && tested.contains(by_blocks);
    EXPECT_TRUE(tested.contains(room) || physics || tested_elsewhere.contains(room)) << "nothing tests " << room;
  }
}

}  // namespace
