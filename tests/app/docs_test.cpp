// What the pages of docs/ tell a reader to type is what the program takes, and does. Pages that show files, commands
// and what these print are done from top to bottom.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "app/cli/verb.h"
#include "app/cli/words.h"
#include "engine/diagram/error.h"
#include "tests/app/hysteron_process.h"
#include "tests/app/lab.h"
#include "tests/app/shown.h"
#include "tests/app/source_files.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using process::Folder;
using process::Outcome;
using shown::do_as_shown;

const fs::path root = HYSTERON_SOURCE_DIR;

/// README.md and every page of docs/, as paths below the project.
std::vector<std::string> pages() {
  std::vector<std::string> all{"README.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") all.push_back("docs/" + entry.path().filename().string());
  std::sort(all.begin(), all.end());
  return all;
}

TEST(Docs, EveryCommandIsOneThatTheProgramTakes) {
  int commands = 0;
  for (const auto& page : pages())
    for (const auto& command : shown::commands_of(page)) {
      if (command.find(" [") != std::string::npos) continue;  // a form, not a command
      ++commands;
      try {
        EXPECT_TRUE(read_words(shown::words_of(command)).verb) << page << ": " << command;
      } catch (const Error& error) {
        ADD_FAILURE() << page << ": " << command << "\n" << error.what();
      }
    }
  EXPECT_GT(commands, 50);
}

/// Options of a verb, those included that all verbs have.
std::set<std::string> options_of(const Verb& verb) {
  std::set<std::string> names{"--help"};
  for (const auto& spec : verb.options) names.insert(spec.name);
  for (const auto& common : common_options()) names.insert(common.spec.name);
  return names;
}

/// "hysteron VERB ... --option" in a text: the first option behind a verb that this verb does not have; "" where all
/// are.
std::string unknown_option(const std::string& text) {
  static const std::map<std::string, std::set<std::string>> verbs = [] {
    std::map<std::string, std::set<std::string>> all;
    for (const auto make : verb_functions()) {
      const Verb verb = make();
      all[verb.name] = options_of(verb);
    }
    return all;
  }();
  static const std::regex call("\\bhysteron ([a-z]+)([^`\\n]*)"), option("(^|[\\s\\[])(--[a-z][a-z0-9-]*)"),
      quoted("\"[^\"]*\"");
  for (std::sregex_iterator i(text.begin(), text.end(), call), end; i != end; ++i) {
    const auto verb = verbs.find((*i)[1].str());
    if (verb == verbs.end()) continue;
    const std::string rest = (*i)[2].str();
    // What stands in quotes is the value of an option: --slurm-options="--time=1:00:00".
    const std::string own = std::regex_replace(rest.substr(0, rest.find("hysteron ")), quoted, "");
    for (std::sregex_iterator j(own.begin(), own.end(), option); j != end; ++j)
      if (!verb->second.contains((*j)[2].str())) return "hysteron " + verb->first + " " + (*j)[2].str();
  }
  return "";
}

TEST(Docs, EveryOptionThatASentenceNamesIsOneOfItsVerb) {
  EXPECT_EQ(unknown_option("see `hysteron compare --tolerances`"), "hysteron compare --tolerances");
  for (const auto& page : pages()) EXPECT_EQ(unknown_option(sources::text_of(root / page)), "") << page;
}

/// So that a cure is a command that works: what messages, help texts and reports name, in strings of the sources.
TEST(Docs, EveryOptionThatAMessageNamesIsOneOfItsVerb) {
  static const std::regex literal("\"((\\\\.|[^\"\\\\])*)\"");
  int commands = 0;
  for (const char* folder : {"engine", "blocks", "io", "fit", "discover", "report", "draw", "app", "studio"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (!sources::is_source(entry.path())) continue;
      const std::string text = sources::text_of(entry.path());
      for (std::sregex_iterator i(text.begin(), text.end(), literal), end; i != end; ++i) {
        std::string said = std::regex_replace((*i)[1].str(), std::regex("\\\\n"), "\n");
        if (said.find("hysteron ") == std::string::npos) continue;
        ++commands;
        EXPECT_EQ(unknown_option(said), "") << entry.path() << ": " << said;
      }
    }
  EXPECT_GT(commands, 100);
}

/// The pages that show commands (```sh), and who does as they say. A page that is missing here is done by nobody.
TEST(Docs, EveryPageWithCommandsIsDoneByATest) {
  const std::set<std::string> done{"README.md",
                                   "docs/fit.md",
                                   "docs/compensate.md",  // readme_test.cpp
                                   "docs/compare.md",     // compare_traces_test.cpp
                                   "docs/adding-an-effect.md",
                                   "docs/datasets.md",
                                   "docs/diagrams.md",
                                   "docs/export-c.md",  // readme_test.cpp
                                   "docs/from-measurement-to-controller.md",
                                   "docs/identification.md",
                                   "docs/oscilloscope.md",
                                   "docs/recordings.md",
                                   "docs/reproduce.md",
                                   "docs/study.md"};  // below
  for (const auto& page : pages())
    for (const auto& fence : shown::fences_of((root / page).string()))
      if (fence.language == "sh") {
        EXPECT_TRUE(done.contains(page)) << page << " shows commands that no test runs";
      }
}

/// A folder with the small laboratory: stage.json, dataset.json, a.csv, b.csv, lab.csv.
class DocsLab : public testing::Test {
 protected:
  void SetUp() override {
    lab::furnish(folder_);
    folder_.write("stage.json", lab::diagram());
    folder_.write("lab.csv", lab::noisy_recording(3));
  }
  Folder folder_;
};

TEST_F(DocsLab, PagesOnDataSetsAndOnEffectsOfOnesOwn) {
  EXPECT_EQ(do_as_shown("docs/datasets.md", folder_), 1);
  EXPECT_TRUE(folder_.has("lab.inspect/report.html"));
  EXPECT_EQ(do_as_shown("docs/adding-an-effect.md", folder_), 1);
  EXPECT_NE(folder_.read("next.json").find("cable"), std::string::npos);
}

TEST_F(DocsLab, ThePageOnRecordings) {
  for (const char* day : {"monday.csv", "tuesday.csv"})
    folder_.write(day, "Zeit (s);Kraft (N);Weg (mm)\n0,0;0,0;0,01\n0,1;1,5;0,32\n0,2;3,0;0,61\n0,3;1,5;0,35\n");
  EXPECT_EQ(do_as_shown("docs/recordings.md", folder_), 1);
  EXPECT_TRUE(folder_.has("stage/diagram.json"));
  EXPECT_NE(folder_.read("press/dataset.json").find("tuesday"), std::string::npos);
}

TEST(Docs, ThePageOnDiagrams) {
  const Folder folder;
  folder.write("docs/loop.json", sources::text_of(root / "docs/loop.json"));
  EXPECT_EQ(do_as_shown("docs/diagrams.md", folder), 3);
  EXPECT_TRUE(folder.has("loop.svg"));
}

TEST(Docs, PagesOnStudiesAndOnReproducing) {
  const Folder folder;
  fs::copy(root / "diagrams", folder.path() + "/diagrams", fs::copy_options::recursive);
  fs::copy(root / "diagrams/study/stage.json", folder.path() + "/stage.json");
  fs::copy(root / "diagrams/study/tolerance.json", folder.path() + "/job.json");
  EXPECT_EQ(do_as_shown("docs/study.md", folder), 2);
  EXPECT_TRUE(folder.has("out/study.h5"));
  fs::remove_all(folder.path() + "/out");
  EXPECT_EQ(do_as_shown("docs/reproduce.md", folder), 1);
}

TEST(Docs, ThePageFromAMeasurementToTheController) {
  const Folder folder;
  fs::copy(root / "diagrams", folder.path() + "/diagrams", fs::copy_options::recursive);
  EXPECT_EQ(do_as_shown("docs/from-measurement-to-controller.md", folder), 3);
}

TEST(Docs, ThePageOnAnOscilloscope) {
  const Folder folder;
  EXPECT_GE(do_as_shown("docs/oscilloscope.md", folder), 2);
}

TEST(LongDocs, ThePageOnIdentification) {
  const Folder folder;
  fs::copy(root / "diagrams", folder.path() + "/diagrams", fs::copy_options::recursive);
  EXPECT_EQ(do_as_shown("docs/identification.md", folder), 2);
}

TEST(Docs, TheLinesOfPythonThatReadTracesOfMillionsOfRows) {
  const std::string python = "/usr/bin/python3";
  if (std::system((python + " -c 'import numpy' 2> /dev/null").c_str()) != 0) GTEST_SKIP() << "numpy is not there";
  std::string lines;
  for (const auto& fence : shown::fences_of((root / "docs/programs.md").string()))
    if (fence.language == "python") lines += fence.text;
  const Folder folder;
  folder.write("stage.json", R"({"format": 1, "title": "stage", "simulate": {"until": "1 s", "every": "1 ms"},
    "blocks": {"y": {"type": "sine", "amplitude": "2 um", "frequency": "1 Hz"}}, "record": ["y"]})");
  folder.write("read.py", lines + "print(len(y), round(float(y.max()), 9), len(low), float(low[0]))\n");
  const Outcome outcome =
      process::shell(folder.path(), "hysteron run stage.json --traces f64 --quiet && " + python + " read.py");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  // 1001 rows of a sine of 2 um in 1 s: the highest is at 0.25 s; the first of 16 pieces of 64 rows begins at 0.
  EXPECT_NE(outcome.out.find("1001 2.0 16 0.0"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace hysteron
