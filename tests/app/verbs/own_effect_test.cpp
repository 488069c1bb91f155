// A user's own effect on the command line: shown, added, found, fitted, and its diagram run.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/hysteron_process.h"
#include "tests/app/lab.h"
#include "tests/app/schema_check.h"

namespace hysteron {
namespace {

using process::Folder;
using process::hysteron;

std::string shipped(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(std::string(HYSTERON_SOURCE_DIR) + "/diagrams/effects/" + name).rdbuf();
  return text.str();
}

/// A lag of 30 ms is hidden in the recordings; the only effect to look for is a lag of the user's own.
const char* const own_lag = R"json({"format": 1, "title": "Filter of the cable", "source": "first-order lag",
  "parameters": {"tau": "1 ms"}, "inputs": {"in": {}}, "outputs": {"out": "pole"},
  "blocks": {"pole": {"type": "lag", "times": "$tau", "in": "in"}},
  "effect": {"id": "cable", "cause": "its capacitance", "equation": "tau*dv/dt = u - v", "enters_at": ["command"],
    "free": {"tau": {"meaning": "time constant", "start": "1 row", "lower": "0.001 row", "upper": "0.2 recording",
                     "log_scale": true, "usual": ["1 us", "1 ms"]}},
    "needs": {"text": "quick motion"}, "look_alikes": [], "says": "{tau} late"}})json";

TEST(OwnEffect, IsFoundOnTheCommandLineAndTheProposedDiagramRuns) {
  const Folder folder;
  lab::furnish(folder);
  folder.write("a.csv", lab::noisy_recording(1, 0.03));
  folder.write("b.csv", lab::noisy_recording(2, 0.03));
  folder.write("own/cable.json", own_lag);
  const auto found = hysteron(folder.path(), {"discover", "diagram.json", "--data", "dataset.json", "--effects", "own",
                                              "--only", "cable", "-o", "out"});
  ASSERT_EQ(found.code, 0) << found.err;
  const auto result = nlohmann::json::parse(folder.read("out/result.json"));
  EXPECT_EQ(result.at("facts").at("effects").at(0), "cable") << found.out;
  EXPECT_TRUE(folder.has("out/cable.json")) << "the effect goes along with the diagram that names it";
  EXPECT_EQ(schema::refuses("diagram", folder.read("out/final.json")), "");
  const auto run = hysteron(folder.path(), {"run", "out/final.json", "--data", "a.csv", "-o", "ran"});
  EXPECT_EQ(run.code, 0) << run.err;
  const auto fitted = hysteron(
      folder.path(), {"fit", "out/final.json", "--data", "dataset.json", "--effects", "own/cable.json", "-o", "fit"});
  EXPECT_EQ(fitted.code, 0) << fitted.err;
  EXPECT_NE(fitted.out.find("cable/tau"), std::string::npos) << fitted.out;
  EXPECT_NE(fitted.out.find("usual limit of Filter of the cable"), std::string::npos) << fitted.out;
}

TEST(OwnEffect, IsShownAndAddedFromItsFile) {
  const Folder folder;
  lab::furnish(folder);
  folder.write("cable.json", own_lag);
  const auto shown = hysteron(folder.path(), {"effects", "cable", "--effects", "cable.json", "-o", "cable.html"});
  ASSERT_EQ(shown.code, 0) << shown.err;
  EXPECT_NE(shown.out.find("\npicture\n"), std::string::npos) << shown.out;
  EXPECT_NE(shown.out.find("Drawn with: 0.01 s late"), std::string::npos) << "one row of the picture's signal";
  EXPECT_NE(folder.read("cable.html").find("With the effect and without it"), std::string::npos);
  EXPECT_NE(shown.out.find("\n  tau  ms  time constant"), std::string::npos) << "the unit of \"1 ms\"\n" << shown.out;
  EXPECT_NE(shown.out.find("The diagram cable.json is put on a wire"), std::string::npos) << shown.out;
  const auto added =
      hysteron(folder.path(), {"add", "cable", "diagram.json", "--effects", "cable.json", "-o", "next.json"});
  ASSERT_EQ(added.code, 0) << added.err;
  EXPECT_NE(folder.read("next.json").find(R"("file": "cable.json")"), std::string::npos) << folder.read("next.json");
  EXPECT_EQ(hysteron(folder.path(), {"check", "next.json"}).code, 0);
  const auto wrong = hysteron(folder.path(), {"effects", "--effects", "diagram.json"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("diagram.json:"), std::string::npos) << wrong.err;
}

TEST(OwnEffect, TheShippedOnesSatisfyTheShippedSchema) {
  for (const char* name : {"quadratic_memory.json", "soft_limit.json"})
    EXPECT_EQ(schema::refuses("effect", shipped(name)), "") << name;
  EXPECT_EQ(schema::refuses("effect", own_lag), "");
  auto wrong = nlohmann::json::parse(own_lag);
  wrong["effect"]["free"]["tau"].erase("meaning");
  EXPECT_NE(schema::refuses("effect", wrong.dump()), "") << "the schema takes anything";
  wrong = nlohmann::json::parse(own_lag);
  wrong["effect"]["enter_at"] = "command";
  EXPECT_NE(schema::refuses("effect", wrong.dump()), "");
}

}  // namespace
}  // namespace hysteron
