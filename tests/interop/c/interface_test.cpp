// What stands behind interop/c/hysteron.h: every verb, columns that are not copied, files, and what an installed
// library shows. Threads, errors and steppers are used from C: use.c.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "interop/c/hysteron.h"
#include "tests/io/temporary_folder.h"

namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

const std::string here = HYSTERON_SOURCE_DIR "/tests/interop/";

struct Free {
  void operator()(void* handle) const { hy_free(handle); }
};
using Result = std::unique_ptr<hy_result, Free>;
using Diagram = std::unique_ptr<hy_diagram, Free>;

/// Fails with the error that it gives.
Result carry_out(const std::string& verb, const std::vector<std::string>& words) {
  std::vector<const char*> pointers;
  for (const auto& word : words) pointers.push_back(word.c_str());
  hy_error* error = nullptr;
  Result result(hy_verb(verb.c_str(), static_cast<int>(words.size()), pointers.data(), nullptr, nullptr, &error));
  EXPECT_EQ(error, nullptr) << verb << ": " << hy_error_json(error);
  hy_free(error);
  return result;
}

Diagram load(const std::string& path, const char* overrides = nullptr) {
  hy_error* error = nullptr;
  Diagram diagram(hy_load(path.c_str(), overrides, &error));
  EXPECT_EQ(error, nullptr) << hy_error_json(error);
  hy_free(error);
  return diagram;
}

Json json_of(const Result& result) { return Json::parse(hy_result_json(result.get())); }

std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) text.append(buffer.data(), n);
  EXPECT_EQ(pclose(pipe), 0) << command << "\n" << text;
  return text;
}

TEST(Interop, EveryVerbIsThere) {
  const std::string schemas = HYSTERON_SOURCE_DIR "/schema";
  std::size_t verbs = 0;
  for (const auto& entry : fs::directory_iterator(schemas)) {
    const std::string name = entry.path().filename().string(), end = ".answer.schema.json";
    if (!name.ends_with(end)) continue;
    const std::string verb = name.substr(0, name.size() - end.size());
    const auto help = json_of(carry_out(verb, {"--help"}));
    EXPECT_EQ(help["verb"], verb);
    EXPECT_NE(help["text"].get<std::string>().find("Usage: hysteron " + verb), std::string::npos);
    ++verbs;
  }
  EXPECT_GE(verbs, 19U);
}

TEST(Interop, AFolderIsWrittenWhereTheWordsNameIt) {
  const hysteron::TemporaryFolder folder;
  const auto before = fs::current_path();
  fs::current_path(folder.path());
  const auto silent = json_of(carry_out("run", {here + "stage.json"}));
  EXPECT_TRUE(fs::is_empty(folder.path()));
  EXPECT_EQ(silent["files"], Json::array());
  EXPECT_FALSE(silent.contains("folder"));
  const auto written = json_of(carry_out("run", {here + "stage.json", "-o", "out"}));
  fs::current_path(before);
  EXPECT_TRUE(fs::exists(folder.path("out/traces/signals.csv")));
  EXPECT_EQ(written["folder"], "out");
  for (const auto* member : {"headline", "sentences", "traces", "figures"}) EXPECT_EQ(silent[member], written[member]);
}

TEST(Interop, AColumnIsTheMemoryOfTheResult) {
  const auto result = carry_out("run", {here + "stage.json", "--every", "1 us"});
  const double *t = nullptr, *again = nullptr, *y = nullptr;
  EXPECT_EQ(hy_result_column(result.get(), "signals.csv", "t", &t), 1'000'001);
  EXPECT_EQ(hy_result_column(result.get(), "signals.csv", "t", &again), 1'000'001);
  EXPECT_EQ(t, again);
  EXPECT_EQ(t[1'000'000], 1.0);
  EXPECT_EQ(hy_result_column(result.get(), "signals.csv", "y", &y), 1'000'001);
  const auto told = json_of(result)["traces"][0];
  EXPECT_EQ(told["file"], "signals.csv");
  EXPECT_EQ(told["columns"][2], (Json{{"name", "y"}, {"unit", "V"}}));
  EXPECT_EQ(hy_result_column(result.get(), "other.csv", "y", &y), -1);
  EXPECT_EQ(hy_result_column(nullptr, "signals.csv", "y", &y), -1);
  EXPECT_EQ(hy_result_column(result.get(), "signals.csv", nullptr, &y), -1);
}

TEST(Interop, ATableIsDataForVerbs) {
  const hysteron::TemporaryFolder folder;
  constexpr int rows = 1000;
  std::vector<double> t, y(rows, 0.0);
  for (int k = 0; k < rows; ++k) t.push_back(1e-3 * k);
  const char* names[] = {"t", "u", "y"};
  const char* units[] = {"s", "V", "um"};
  const double* values[] = {t.data(), t.data(), y.data()};
  for (const std::string name : {"table.csv", "table.f64"}) {
    const std::string path = folder.path(name);
    ASSERT_EQ(hy_write_table(path.c_str(), 3, names, units, values, rows, nullptr), HY_DONE);
    const auto run = carry_out("run", {here + "driven.json", "--data", path});
    const double* simulated = nullptr;
    ASSERT_EQ(
        hy_result_column(run.get(), json_of(run)["traces"][0]["file"].get<std::string>().c_str(), "y", &simulated),
        rows);
    for (std::size_t k = 0; k < rows; ++k)
      EXPECT_NEAR(simulated[k], t[k] - 0.02 * (1 - std::exp(-t[k] / 0.02)),
                  1e-7);  // um; a ramp of 1 V/s behind a lag of 20 ms
  }
  hy_error* error = nullptr;
  units[1] = "flurp";
  EXPECT_EQ(hy_write_table(folder.path("no.csv").c_str(), 3, names, units, values, rows, &error), HY_BAD_INPUT);
  EXPECT_NE(std::string(hy_error_json(error)).find("flurp"), std::string::npos);
  hy_free(error);
  EXPECT_FALSE(fs::exists(folder.path("no.csv")));
}

TEST(Interop, ADiagramIsSavedWithWhatWasSet) {
  const hysteron::TemporaryFolder folder;
  const std::string path = folder.path("saved.json");
  const auto diagram = load(here + "driven.json", R"({"set": {"gain.gain": "3 um/V"}})");
  ASSERT_EQ(hy_diagram_save(diagram.get(), path.c_str(), nullptr), HY_DONE);
  const auto facts = Json::parse(hy_diagram_json(load(path).get()));
  bool found = false;
  for (const auto& p : facts["parameters"])
    found = found || (p["name"] == "gain.gain" && p["value"] == 3 && p["unit"] == "um/V");
  EXPECT_TRUE(found);
}

TEST(Interop, TheLibraryShowsItsFunctionsAlone) {
  std::set<std::string> shown;
  std::istringstream lines(output_of("nm -D --defined-only " HYSTERON_LIBRARY));
  for (std::string address, kind, name; lines >> address >> kind >> name;) shown.insert(name);
  EXPECT_TRUE(shown.contains("hy_verb@@HYSTERON_1"));
  for (const auto& name : shown) EXPECT_TRUE(name.starts_with("hy_") || name == "HYSTERON_1") << name;
}

/// The piece of a page between "```language" and the next fence.
std::string fence_of(const std::string& page, const std::string& language) {
  const auto begin = page.find("```" + language + "\n");
  EXPECT_NE(begin, std::string::npos) << language;
  const auto text = page.find('\n', begin) + 1;
  return page.substr(text, page.find("```", text) - text);
}

TEST(Interop, ThePageForCPrintsWhatItShows) {
  const hysteron::TemporaryFolder folder;
  const std::string page = hysteron::TemporaryFolder::read(HYSTERON_SOURCE_DIR "/docs/c.md");
  folder.write("lag.json", fence_of(page, "json lag.json"));
  folder.write("step.c", fence_of(page, "c"));
  const std::string library = HYSTERON_LIBRARY, at = folder.path();
  output_of(HYSTERON_CC " -std=c99 -Wall -Wextra -Wpedantic -Werror -I" HYSTERON_SOURCE_DIR "/interop/c " + at +
            "/step.c -o " + at + "/step " HYSTERON_SANITIZER_FLAGS " " + library + " -Wl,-rpath," +
            library.substr(0, library.rfind('/')) + " 2>&1");
  EXPECT_EQ(output_of("cd " + at + " && ./step"), fence_of(page, "text"));
}

/// As somebody does who has the installed library and a compiler for C.
TEST(Interop, AnInstalledLibraryIsFoundByPkgConfig) {
  if (std::system("pkg-config --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "pkg-config is not there";
  const hysteron::TemporaryFolder folder;
  const std::string at = folder.path();
  output_of(HYSTERON_CMAKE " --install " HYSTERON_BUILD_DIR " --component library --prefix " + at + " > /dev/null");
  folder.write("use.c",
               "#include <hysteron.h>\n#include <stdio.h>\n"
               "int main(void) { puts(hy_version()); return 0; }\n");
  std::string pc;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
    if (entry.path().filename() == "hysteron.pc") pc = entry.path().parent_path().string();
  ASSERT_FALSE(pc.empty());
  const std::string config = "PKG_CONFIG_PATH=" + pc + " pkg-config --define-variable=prefix=" + at + " ";
  const std::string lib = output_of(config + "--variable=libdir hysteron | tr -d '\\n'");
  output_of(HYSTERON_CC " -std=c99 -Wall -Wextra -Wpedantic -Werror " + at + "/use.c -o " + at +
            "/use " HYSTERON_SANITIZER_FLAGS " $(" + config + "--cflags --libs hysteron) -Wl,-rpath," + lib + " 2>&1");
  EXPECT_EQ(output_of(at + "/use"), std::string(hy_version()) + "\n");
}

}  // namespace
