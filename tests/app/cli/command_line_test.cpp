// The command line itself: help that teaches, exit codes, documentation from the declarations.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "blocks/register_all.h"
#include "tests/app/hysteron_process.h"

namespace hysteron {
namespace {

using process::Folder;
using process::Outcome;

const std::vector<std::string> verbs{"new",      "run",     "check",    "explain", "draw",    "linearize",
                                     "inspect",  "compare", "diagnose", "add",     "remove",  "fit",
                                     "discover", "study",   "export",   "blocks",  "effects", "schema"};

std::size_t longest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);)
    longest = std::max(longest, static_cast<std::size_t>(std::count_if(line.begin(), line.end(), [](char c) {
                         return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
                       })));
  return longest;
}

TEST(CommandLine, WithoutWordsItShowsTheVerbsAndAsksForOne) {
  const Folder folder;
  const Outcome outcome = process::hysteron(folder.path(), {});
  EXPECT_EQ(outcome.code, 2);
  for (const auto& verb : verbs) EXPECT_NE(outcome.out.find("  " + verb + " "), std::string::npos) << verb;
}

TEST(CommandLine, VersionIsPrinted) {
  const Folder folder;
  const Outcome outcome = process::hysteron(folder.path(), {"--version"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(outcome.out.starts_with("hysteron ")) << outcome.out;
}

TEST(CommandLine, AnOptionWithoutItsValueAndAVerbThatIsNotThereSayWhatToWrite) {
  const Folder folder;
  const Outcome option = process::hysteron(folder.path(), {"run", "stage.json", "--record"});
  EXPECT_EQ(option.code, 2);
  EXPECT_EQ(option.err,
            "--record\n  its value is missing or given twice\n  write --record=SIGNAL; see hysteron run --help\n");
  const Outcome verb = process::hysteron(folder.path(), {"frobnicate"});
  EXPECT_EQ(verb.code, 2);
  EXPECT_NE(verb.err.find("\"hysteron --help\" lists all verbs"), std::string::npos) << verb.err;
}

class Help : public testing::TestWithParam<std::string> {};
TEST_P(Help, TeachesWithExamplesWhatIsWrittenAndExitCodes) {
  const Folder folder;
  const Outcome outcome = process::hysteron(folder.path(), {GetParam(), "--help"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(outcome.err.empty()) << outcome.err;
  EXPECT_NE(outcome.out.find("Examples:\n  hysteron " + GetParam()), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("Exit codes: 0"), std::string::npos) << outcome.out;
  EXPECT_TRUE(outcome.out.find("rites") != std::string::npos ||
              outcome.out.find("nothing is written") != std::string::npos)
      << "does not say what it writes\n"
      << outcome.out;
  EXPECT_EQ(folder.entries().size(), 0U);
}
INSTANTIATE_TEST_SUITE_P(Verbs, Help, testing::ValuesIn(verbs), [](const auto& tested) { return tested.param; });

TEST(Blocks, EveryTypeIsListedAndShownWithinAHundredColumns) {
  const Folder folder;
  const Outcome all = process::hysteron(folder.path(), {"blocks"});
  ASSERT_EQ(all.code, 0);
  EXPECT_LE(longest_line(all.out), 100U) << all.out;
  const Registry registered = all_blocks();
  for (const std::string& type : registered.types()) {
    if (registered.find(type)->declaration.group == "internal") continue;
    EXPECT_NE(all.out.find("  " + type + " "), std::string::npos) << type;
    const Outcome one = process::hysteron(folder.path(), {"blocks", type});
    EXPECT_EQ(one.code, 0) << type;
    EXPECT_LE(longest_line(one.out), 100U) << one.out;
    for (const char* part : {"\nlaw\n", "\noutputs\n", "\nsource\n", "\nexample\n"})
      EXPECT_NE(one.out.find(part), std::string::npos) << type << " lacks " << part;
  }
}

TEST(Blocks, ShowListsOfALengthThatTheTypeTakes) {
  const Folder folder;
  for (const auto& [type, part] : {std::pair{"preisach", "\"levels\": [1, 2], \"weights\": [1], \"gain\": 1"},
                                   {"prandtl_ishlinskii", "\"thresholds\": [1, 2], \"weights\": [1, 1]"},
                                   {"coupled_tapi", "\"thresholds\": [1], \"weights\": [[1, 0], [0, 1]]"}}) {
    const Outcome shown = process::hysteron(folder.path(), {"blocks", type});
    EXPECT_NE(shown.out.find(part), std::string::npos) << shown.out;
  }
}

TEST(Blocks, TellVariationsAndMemoryToPeopleAndToPrograms) {
  const Folder folder;
  const Outcome shown = process::hysteron(folder.path(), {"blocks", "mass_spring_damper"});
  for (const char* part : {"\nvariations", "mass_with_friction", "coulomb 0 N, breakaway 0 N"})
    EXPECT_NE(shown.out.find(part), std::string::npos) << part << shown.out;
  EXPECT_NE(process::hysteron(folder.path(), {"blocks", "play"}).out.find("\nmemory\n  its output, in the unit of u"),
            std::string::npos);
  const Outcome one = process::hysteron(folder.path(), {"blocks", "mass_spring_damper", "--json"});
  ASSERT_EQ(one.code, 0) << one.err;
  const auto json = nlohmann::json::parse(one.out);
  EXPECT_EQ(json.at("type"), "mass_spring_damper");
  const auto& variations = json.at("variations");
  const auto found =
      std::find_if(variations.begin(), variations.end(), [](const auto& v) { return v.at("name") == "friction"; });
  ASSERT_NE(found, variations.end()) << variations;
  const auto& friction = *found;
  EXPECT_EQ(friction.at("type"), "mass_with_friction");
  EXPECT_EQ(friction.at("neutral").at("breakaway"), "0 N");
  EXPECT_EQ(json.at("parameters").at(0).at("unit"), "kg");
  const auto all = nlohmann::json::parse(process::hysteron(folder.path(), {"blocks", "--json"}).out);
  EXPECT_GT(all.at("blocks").size(), 40U);
}

TEST(Effects, EveryEffectIsListedAndShownWithItsLookAlikes) {
  const Folder folder;
  const Outcome all = process::hysteron(folder.path(), {"effects"});
  EXPECT_NE(all.out.find("or varies"), std::string::npos);
  const auto overflow = all.out.find("overflow ");
  ASSERT_NE(overflow, std::string::npos);
  EXPECT_NE(all.out.substr(overflow, 60).find("tank"), std::string::npos) << "which block can run over";
  ASSERT_EQ(all.code, 0);
  EXPECT_LE(longest_line(all.out), 100U) << all.out;
  for (const char* id :
       {"calibration", "initial_remanence", "hysteresis", "creep", "amplifier_lag", "sensor_lag", "dead_time"}) {
    EXPECT_NE(all.out.find("  " + std::string(id) + " "), std::string::npos) << id;
    const Outcome one = process::hysteron(folder.path(), {"effects", id});
    EXPECT_EQ(one.out.find("the parameter \"\""), std::string::npos) << id << " says what it varies";
    EXPECT_EQ(one.code, 0) << id;
    EXPECT_LE(longest_line(one.out), 100U) << one.out;
    for (const char* part : {"\ncause\n", "\nlaw\n", "\npicture\n", "\nhow it enters\n", "\ndata that show it\n"})
      EXPECT_NE(one.out.find(part), std::string::npos) << id << " lacks " << part;
  }
}

/// What is drawn of a role in a picture: its path.
std::string path_of(const std::string& svg, const std::string& role) {
  const std::string open = "<path class=\"curve line c-" + role + "\" d=\"";
  const auto at = svg.find(open);
  return at == std::string::npos ? ""
                                 : svg.substr(at + open.size(), svg.find('"', at + open.size()) - at - open.size());
}

TEST(Effects, EveryEffectHasAPictureThatIsNoCopyOfTheSignal) {
  const Folder folder;
  std::istringstream lines(process::hysteron(folder.path(), {"effects"}).out);
  int pictures = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::string id = line.substr(0, line.find(' ', 2)).erase(0, line.starts_with("  ") ? 2 : 0);
    if (!line.starts_with("  ") || line.starts_with("   ") || id == "effect") continue;
    const Outcome one = process::hysteron(folder.path(), {"effects", id, "-o", id + ".svg"});
    ASSERT_EQ(one.code, 0) << id << one.err;
    EXPECT_GT(std::count(one.out.begin(), one.out.end(), '*'), 20) << id << " draws nothing in the terminal";
    EXPECT_NE(one.out.find("\nchanges nothing with\n"), std::string::npos) << id;
    const std::string svg = folder.read(id + ".svg");
    EXPECT_GT(path_of(svg, "before").size(), 20U) << id;
    EXPECT_NE(path_of(svg, "before"), path_of(svg, "simulated")) << id;
    ++pictures;
  }
  EXPECT_GE(pictures, 29);
}

TEST(Effects, TheNeutralValueIsThatOfTheBlockThatIsVaried) {
  const Folder folder;
  EXPECT_NE(process::hysteron(folder.path(), {"effects", "sqrt_outflow"}).out.find("nothing with\n  law linear\n"),
            std::string::npos);
  EXPECT_NE(process::hysteron(folder.path(), {"effects", "friction"})
                .out.find("level 0; in a block that has it contact_stiffness 0 N/m"),
            std::string::npos);
}

TEST(Effects, OneThatOnlyBlocksHaveSaysInWhich) {
  const Folder folder;
  for (const auto& [id, block] :
       std::vector<std::pair<std::string, std::string>>{{"rate_dependence", "prandtl_ishlinskii"},
                                                        {"quadratic_drag", "mass_spring_damper"},
                                                        {"stiffening", "mass_spring_damper"},
                                                        {"sqrt_outflow", "tank"},
                                                        {"overflow", "tank"}}) {
    const std::string page = process::hysteron(folder.path(), {"effects", id}).out;
    EXPECT_NE(page.find("Kind of place: a block that can have it, of type"), std::string::npos) << id << page;
    EXPECT_NE(page.find(block, page.find("Kind of place")), std::string::npos) << id;
  }
  EXPECT_EQ(process::hysteron(folder.path(), {"effects", "friction"}).out.find("Kind of place:"), std::string::npos);
}

/// The rows of "taken for it easily" that begin with this effect.
std::size_t look_alike_rows(const std::string& page, const std::string& id) {
  const auto begin = page.find("\ntaken for it easily\n"), end = page.find("\n\n", begin + 1);
  if (begin == std::string::npos) return 0;
  const std::string rows = page.substr(begin, end - begin);
  std::size_t count = 0;
  for (auto at = rows.find("\n  " + id + " "); at != std::string::npos; at = rows.find("\n  " + id + " ", at + 1))
    ++count;
  return count;
}

TEST(Effects, ALookAlikeIsShownOnBothPagesAndOnceOnEach) {
  const Folder folder;
  const std::string calibration = process::hysteron(folder.path(), {"effects", "calibration"}).out;
  EXPECT_EQ(look_alike_rows(calibration, "temperature_gain"), 1U) << "only temperature_gain names this pair";
  EXPECT_NE(calibration.find("temperature_staircase"), std::string::npos);
  const std::string lag = process::hysteron(folder.path(), {"effects", "amplifier_lag"}).out;
  EXPECT_EQ(look_alike_rows(lag, "dead_time"), 1U) << "each names the other";
  EXPECT_EQ(look_alike_rows(lag, "creep"), 1U);
}

TEST(Effects, APictureShowsTheEffectAndNoRounding) {
  const Folder folder;
  const std::string calibration = process::hysteron(folder.path(), {"effects", "calibration"}).out;
  EXPECT_NE(calibration.find("Drawn with: gain 1.05, offset 10 um"), std::string::npos) << calibration;
  EXPECT_NE(calibration.find("\n  15 |"), std::string::npos) << "5 um of the gain at 100 um and 10 um of the offset";
  const std::string pyro = process::hysteron(folder.path(), {"effects", "pyro_charge_drift"}).out;
  EXPECT_EQ(pyro.find("e-13"), std::string::npos) << "without temperature nothing is added: 0, not 4e-13\n" << pyro;
  EXPECT_NE(pyro.find("\n  0 |"), std::string::npos) << pyro;
}

TEST(Effects, APageSaysBetweenWhichValuesAParameterIsSearched) {
  const Folder folder;
  EXPECT_NE(process::hysteron(folder.path(), {"effects", "creep"}).out.find("searched: 0 .. 0.4"), std::string::npos);
  const std::string delay = process::hysteron(folder.path(), {"effects", "dead_time"}).out;
  EXPECT_NE(delay.find("  delay  s  usual:"), std::string::npos) << "a parameter without a meaning\n" << delay;
}

TEST(Effects, APageOfOneHasItsEquationAndItsPictures) {
  const Folder folder;
  ASSERT_EQ(process::hysteron(folder.path(), {"effects", "temperature_gain", "-o", "page.html"}).code, 0);
  const std::string page = folder.read("page.html");
  for (const char* part : {"With the effect and without it", "What it adds", "What it reads besides",
                           "temperature [degC]", "taken for it easily", "Drawn with"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  for (const auto& words :
       {std::vector<std::string>{"effects", "creep", "-o", "creep.png"}, {"effects", "-o", "a.svg"}}) {
    const Outcome wrong = process::hysteron(folder.path(), words);
    EXPECT_EQ(wrong.code, 2);
    EXPECT_TRUE(wrong.out.empty()) << wrong.out;
  }
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"page.html"});
}

TEST(Schema, WritesTheSchemasThatTheProjectShips) {
  const Folder folder;
  ASSERT_EQ(process::hysteron(folder.path(), {"schema", "-o", "made"}).code, 0);
  const std::filesystem::path shipped = HYSTERON_SOURCE_DIR "/schema", made = folder.path() + "/made";
  const auto names = [](const std::filesystem::path& in) {
    std::set<std::string> list;
    for (const auto& entry : std::filesystem::directory_iterator(in)) list.insert(entry.path().filename().string());
    return list;
  };
  EXPECT_EQ(names(made), names(shipped)) << "write them anew: hysteron schema -o schema";
  for (const auto& name : names(made)) {
    std::ostringstream text;
    text << std::ifstream(shipped / name, std::ios::binary).rdbuf();
    EXPECT_TRUE(text.str() == folder.read("made/" + name)) << name << " is out of date: hysteron schema -o schema";
    EXPECT_NE(text.str().find("draft-07"), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace hysteron
