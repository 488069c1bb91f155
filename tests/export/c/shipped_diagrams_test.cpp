// Which diagrams of the project can be written in C as a whole, and which blocks stop the others: docs/export-c.md says
// so in a section that this test holds against what the program says.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "tests/export/c/in_c.h"

namespace hysteron {
namespace {

using process::Folder;
using process::Outcome;
using Json = nlohmann::json;
namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// Those that simulate something, by name; effects as JSON are pieces of diagrams.
std::map<std::string, fs::path> shipped_diagrams() {
  const fs::path folder = HYSTERON_SOURCE_DIR "/diagrams";
  std::map<std::string, fs::path> list;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".json") continue;
    const std::string name = entry.path().lexically_relative(folder).replace_extension().generic_string();
    const Json json = Json::parse(text_of(entry.path()), nullptr, false);
    if (json.is_object() && json.contains("blocks") && !name.starts_with("effects/")) list[name] = entry.path();
  }
  return list;
}

/// What keeps a diagram from being written; nothing: it was written. Its sources of time are made inputs, as the
/// program says that they can be, and what it records is what is worked out where it names no output.
std::set<std::string> what_stops(const fs::path& file) {
  const std::string loop = "a loop at one instant";
  static const std::regex named(R"(^\S+ \((\w+)\) (.*)$)");
  static const std::regex input(R"(--from (\S+))");
  const Folder folder;
  std::vector<std::string> words{file.string(), "--rate", "20 kHz", "--errors", "json"};
  std::set<std::string> from;
  for (;;) {
    const Outcome outcome = in_c::exported(folder, words);
    if (outcome.code == 0) return {};
    const Json problems = Json::parse(outcome.err)["problems"];
    std::set<std::string> stops;
    const std::size_t known = words.size();
    for (const auto& problem : problems) {
      const std::string code = problem["code"], what = problem["what"], cure = problem["cure"];
      std::smatch found;
      if (code == "no_output") {
        const Json diagram = Json::parse(text_of(file));
        for (const auto& signal : diagram["record"]) words.insert(words.end(), {"--to", signal.get<std::string>()});
      } else if (what.find("is a signal of time") != std::string::npos) {
        for (std::sregex_iterator at(cure.begin(), cure.end(), input), end; at != end; ++at)
          if (from.insert((*at)[1]).second) words.insert(words.end(), {"--from", (*at)[1]});
      } else if (code == "algebraic_loop" || what.starts_with("these need each other")) {
        stops.insert(loop);
      } else if (std::regex_match(what, found, named)) {
        stops.insert(fmt::format("`{}` {}", found[1].str(), found[2].str()));
      } else {
        ADD_FAILURE() << file << ": " << code << ": " << what << "; " << cure;
        stops.insert(what);
      }
    }
    if (words.size() == known) {
      EXPECT_FALSE(stops.empty()) << file << outcome.err;
      return stops;
    }
  }
}

std::string joined(const std::vector<std::string>& names) { return fmt::format("`{}`", fmt::join(names, "`, `")); }

std::string told() {
  const auto diagrams = shipped_diagrams();
  std::vector<std::string> written;
  std::map<std::string, std::vector<std::string>> stopped;
  for (const auto& [name, file] : diagrams) {
    const auto stops = what_stops(file);
    if (stops.empty()) written.push_back(name);
    for (const auto& what : stops) stopped[what].push_back(name);
  }
  std::string text = fmt::format(
      "As a whole, with their sources of time as inputs (`--from`), at a `--rate` of 20 kHz, {} of the {} diagrams of\n"
      "`diagrams/` are written: {}.\n\nThe others are stopped by what follows, and can be written up to it and from it "
      "on (`--to`, `--from`):\n\n| what stops | in `diagrams/` |\n|---|---|\n",
      written.size(), diagrams.size(), joined(written));
  for (const auto& [what, names] : stopped) text += fmt::format("| {} | {} |\n", what, joined(names));
  return text;
}

TEST(ExportC, ThePageSaysWhichOfTheShippedDiagramsCanBeWritten) {
  const std::string page = text_of(HYSTERON_SOURCE_DIR "/docs/export-c.md"), heading = "## Of the shipped diagrams\n\n";
  const auto begin = page.find(heading);
  ASSERT_NE(begin, std::string::npos);
  const auto from = begin + heading.size();
  EXPECT_EQ(page.substr(from, page.find("\n## ", from) - from), told()) << "put it into docs/export-c.md";
}

}  // namespace
}  // namespace hysteron
