// Manual pages and completion are made of the tables of the verbs: nothing is missing in them, man reads them, and
// shells complete what the program then accepts.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "app/cli/verb.h"
#include "tests/app/hysteron_process.h"

namespace hysteron {
namespace {

using process::Folder;
using process::Outcome;
using process::shell;

std::vector<Verb> all_verbs() {
  std::vector<Verb> verbs;
  for (const auto make : verb_functions()) verbs.push_back(make());
  return verbs;
}

bool is_there(const std::string& command) {
  return std::system(("command -v " + command + " > /dev/null").c_str()) == 0;
}

class Manual : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(shell(folder_.path(), "hysteron manual -o share").code, 0); }

  /// What bash offers behind these words, the last of which is being written.
  std::string offered(const std::string& words, int place) const {
    const Outcome outcome = shell(
        folder_.path(), "bash -c 'source share/bash-completion/completions/hysteron; compopt() { :; }; COMP_WORDS=(" +
                            words + fmt::format("); COMP_CWORD={}; _hysteron; echo \"${{COMPREPLY[*]}}\"'", place));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "") << words;
    return outcome.out;
  }

  Folder folder_;
};

TEST_F(Manual, EachVerbHasAPageWithAllOfItsOptions) {
  const std::string program = folder_.read("share/man/man1/hysteron.1");
  for (const auto& verb : all_verbs()) {
    const std::string page = folder_.read("share/man/man1/hysteron-" + verb.name + ".1");
    EXPECT_NE(program.find("hysteron\\-" + verb.name + " (1)"), std::string::npos) << verb.name;
    EXPECT_NE(page.find(".SH EXIT STATUS\n"), std::string::npos) << page;
    std::vector<std::string> names{"\\-\\-quiet", "\\-\\-json", "\\-\\-progress", "\\-\\-errors"};
    for (const auto& spec : verb.options) {
      std::string roff;
      for (const char c : spec.name) roff += c == '-' ? "\\-" : std::string(1, c);
      names.push_back(roff);
    }
    for (const auto& name : names) EXPECT_NE(page.find("\\fB" + name + "\\fR"), std::string::npos) << verb.name << name;
  }
}

TEST_F(Manual, ManReadsThePagesWithoutAWarning) {
  if (!is_there("man")) GTEST_SKIP() << "man is not there";
  const Outcome outcome = shell(folder_.path(),
                                "for page in share/man/man1/*.1; do MANROFFSEQ= MANWIDTH=80 LC_ALL=C.UTF-8 "
                                "man --warnings -E UTF-8 -l -Tutf8 -Z \"$page\" > /dev/null || exit 1; done");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Manual, BashOffersVerbsOptionsNamesAndFiles) {
  folder_.write("stage.json", "{}");
  folder_.write("lab.csv", "");
  for (const auto& verb : all_verbs()) EXPECT_NE(offered("hysteron \"\"", 1).find(verb.name), std::string::npos);
  EXPECT_EQ(offered("hysteron comp", 1), "compare\n");
  EXPECT_EQ(offered("hysteron compare stage.json --dat", 3), "--data\n");
  EXPECT_EQ(offered("hysteron compare stage.json --data l", 4), "lab.csv\n");
  EXPECT_EQ(offered("hysteron run \"\"", 2), "share stage.json\n") << "a diagram is no CSV";
  EXPECT_EQ(offered("hysteron add cree", 2), "creep\n");
  EXPECT_EQ(offered("hysteron blocks bouc_wen_i", 2), "bouc_wen_inverse\n");
  EXPECT_EQ(offered("hysteron run stage.json --errors j", 4), "json\n");
  EXPECT_EQ(offered("hysteron run stage.json -o s", 4), "share\n") << "a folder is no file";
  EXPECT_EQ(offered("hysteron run stage.json --allow s", 4), "share stage.json\n") << "a folder or an FMU";
  EXPECT_EQ(offered("hysteron export c stage.json --number f", 5), "\n") << "no block";
  EXPECT_EQ(offered("hysteron new --from lab.csv \"\"", 4), "lab.csv share stage.json\n");
}

TEST_F(Manual, ZshReadsItsCompletionAndKnowsEveryVerb) {
  const std::string script = folder_.read("share/zsh/site-functions/_hysteron");
  EXPECT_TRUE(script.starts_with("#compdef hysteron\n"));
  for (const auto& verb : all_verbs()) {
    EXPECT_NE(script.find("    '" + verb.name + ":"), std::string::npos) << verb.name;
    EXPECT_NE(script.find("      " + verb.name + ") _arguments"), std::string::npos) << verb.name;
  }
  if (!is_there("zsh")) GTEST_SKIP() << "zsh is not there";
  const Outcome outcome = shell(folder_.path(), "zsh -n share/zsh/site-functions/_hysteron");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(Manual, OnePageIsPrintedAndAWrongNameGetsTheNearest) {
  const Outcome page = shell(folder_.path(), "hysteron manual compare");
  EXPECT_EQ(page.out, folder_.read("share/man/man1/hysteron-compare.1"));
  const Outcome wrong = shell(folder_.path(), "hysteron manual compair");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("Did you mean \"compare\""), std::string::npos) << wrong.err;
  EXPECT_EQ(shell(folder_.path(), "hysteron manual").code, 2);
}

}  // namespace
}  // namespace hysteron
