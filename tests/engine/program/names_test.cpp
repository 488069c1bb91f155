// Names that a user writes: one language for settings, signals and parameters.
#include "engine/program/names.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "blocks/register_all.h"
#include "engine/diagram/error.h"
#include "engine/diagram/settings.h"
#include "tests/engine/diagrams_in_code.h"

namespace hysteron {
namespace {

using test::node;

const Registry& registry() {
  static const Registry all = all_blocks();
  return all;
}

/// A stage with a mass of its own number and two outputs; "slow" is a list, "both" reads the number twice.
std::shared_ptr<const Diagram> stage() {
  Diagram d;
  d.parameters["k"].value = "2 um/V";
  d.parameters["same"].value = "$k";
  d.inputs["u"] = {"V", ""};
  d.blocks["gain"] = node("gain", {"u"}, {{"gain", "$same"}});
  d.blocks["slow"] = node("lag", {"gain"}, {{"times", NumberList{{1, "s"}, {2, "s"}}}});
  d.outputs["pos"] = "slow";
  d.outputs["raw"] = "gain";
  return std::make_shared<const Diagram>(d);
}

/// Two such stages; x takes its number from the diagram around it.
Diagram axes() {
  Diagram d;
  d.parameters["stiff"].value = "3 um/V";
  d.parameters["bias"].value = "1 V";
  d.blocks["drive"] = node("sine", {}, {{"amplitude", "$bias"}, {"offset", "$bias"}, {"frequency", "5 Hz"}});
  d.blocks["x"] = node("diagram", {"drive"}, {{"k", "$stiff"}});
  d.blocks["y"] = node("diagram", {"drive"});
  for (const char* name : {"x", "y"}) d.blocks[name].nested = stage();
  d.blocks["coupling"] = node("matrix_gain", {"xy"});
  d.blocks["coupling"].parameters["matrix"] = NumberMatrix{{{{1, {}}, {2, {}}}, {{3, {}}, {4, {}}}}};
  d.blocks["xy"] = node("mux", {"x.pos", "y.pos"});
  d.outputs["moved"] = "coupling";
  d.outputs["all"] = "y.raw";
  return d;
}

std::vector<std::string> problems_of_setting(Diagram d, const std::string& path, const std::string& value) {
  std::vector<std::string> told;
  try {
    apply_settings(d, {{path, value}}, {});
    compile(d, registry());
  } catch (const Error& e) {
    for (const auto& p : e.problems) told.push_back(p.code + ": " + p.what + "; " + p.cure);
  }
  return told;
}

double value_after(const std::string& path, const std::string& value, const std::string& read) {
  Diagram d = axes();
  apply_settings(d, {{path, value}}, {});
  const auto program = compile(d, registry());
  return program->parameters[static_cast<std::size_t>(named_parameter(*program, read))].value;
}

TEST(Names, ASettingReachesTheNumberByAnyOfItsNames) {
  // x.k is "$stiff", its block reads "$same", which is "$k": all are one number.
  for (const char* path : {"stiff", "x.k", "x/k", "x.same", "x/gain.gain"})
    for (const char* read : {"stiff", "x.k", "x/k", "x.same", "x/gain.gain"})
      EXPECT_DOUBLE_EQ(value_after(path, "7 um/V", read), 7e-6) << path << " " << read;
  // y has its own: the file's value, which a setting puts where the diagram is used.
  for (const char* path : {"y.k", "y/k", "y/gain.gain", "y.same"}) {
    EXPECT_DOUBLE_EQ(value_after(path, "5 um/V", "y/gain.gain"), 5e-6) << path;
    EXPECT_DOUBLE_EQ(value_after(path, "5 um/V", "x.k"), 3e-6) << path << ": the other stage stays";
  }
}

TEST(Names, ABlocksNumberThatIsTheDiagramsIsSetThereAndStaysRead) {
  Diagram d = axes();
  d.parameters["stiff"].upper = Number{10, {}};
  d.parameters["stiff"].free = true;
  apply_settings(d, {{"x/gain.gain", "4 um/V"}}, {});
  const auto program = compile(d, registry());  // nobody says that "stiff" is not read
  const auto& info = *program->find_parameter("stiff");
  EXPECT_DOUBLE_EQ(info.value, 4e-6);
  EXPECT_DOUBLE_EQ(info.upper, 10e-6);
  EXPECT_TRUE(info.free);
}

TEST(Names, ASettingThatChangesMoreThanItNamesSaysSo) {
  Diagram d = axes();
  const auto notes = settings_applied(d, {{"drive.amplitude", "2 V"}}, {});
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("drive.offset"), std::string::npos) << notes[0];
  const auto program = compile(d, registry());
  EXPECT_DOUBLE_EQ(program->find_parameter("drive.offset")->value, 2);
  EXPECT_TRUE(settings_applied(d, {{"bias", "3 V"}}, {}).empty()) << "the number itself was named";
  EXPECT_TRUE(settings_applied(d, {{"x.k", "3 um/V"}}, {}).empty()) << "one block reads it";
}

TEST(Names, OneElementOfAListOrAMatrixIsSet) {
  EXPECT_DOUBLE_EQ(value_after("y/slow.times[1]", "500 ms", "y/slow.times[1]"), 0.5);
  EXPECT_DOUBLE_EQ(value_after("y/slow.times[1]", "500 ms", "y/slow.times[0]"), 1);
  EXPECT_DOUBLE_EQ(value_after("y/slow.times[1]", "500 ms", "x/slow.times[1]"), 2);
  EXPECT_DOUBLE_EQ(value_after("coupling.matrix[1][0]", "9", "coupling.matrix[1][0]"), 9);
  EXPECT_DOUBLE_EQ(value_after("coupling.matrix[1][0]", "9", "coupling.matrix[0][1]"), 2);
  EXPECT_DOUBLE_EQ(value_after("stiff[0]", "6 um/V", "x.k[0]"), 6e-6);  // "[0]" of a single number is the number
  for (const char* path : {"y/slow.times[2]", "coupling.matrix[2][0]", "coupling.matrix[0]", "stiff[1]"})
    EXPECT_EQ(problems_of_setting(axes(), path, "1").size(), 1U) << path;
}

TEST(Names, SignalsAreNamedAsARecordNamesThem) {
  const Diagram d = axes();
  const auto program = compile(d, registry());
  EXPECT_EQ(named_signal(*program, d, "x.pos"), named_signal(*program, d, "x/slow"));
  EXPECT_EQ(named_signal(*program, d, "x.raw"), named_signal(*program, d, "x/gain.y"));
  EXPECT_EQ(named_signal(*program, d, "x.raw[0]"), named_signal(*program, d, "x/gain"));
  EXPECT_EQ(named_signal(*program, d, "all"), named_signal(*program, d, "y.raw"));
  EXPECT_EQ(named_signal(*program, d, "moved[1]"), named_signal(*program, d, "coupling[1]"));
  for (const char* vector : {"coupling", "moved"}) try {
      named_signal(*program, d, vector);
      FAIL() << vector;
    } catch (const Error& e) {
      EXPECT_NE(e.problems[0].cure.find(std::string(vector) + "[1]"), std::string::npos) << e.what();
    }
  EXPECT_EQ(find_named_signal(*program, d, "x"), -1) << "two outputs";
}

TEST(Names, ARecordTakesTheOutputsOfTheDiagramToo) {
  Diagram d = axes();
  d.record = {"all", "moved[1]", "x.pos"};
  const auto program = compile(d, registry());
  const std::vector<int> wanted{named_signal(*program, d, "y.raw"), named_signal(*program, d, "coupling[1]"),
                                named_signal(*program, d, "x.pos")};
  EXPECT_EQ(program->record_signals, wanted);
}

TEST(Names, AListIsNamedAsAWholeWhereManyAreWantedAndByItsElementsElse) {
  const auto program = compile(axes(), registry());
  EXPECT_EQ(named_parameters(*program, "x/slow.times").size(), 2U);
  EXPECT_EQ(named_parameters(*program, "coupling.matrix").size(), 4U);
  EXPECT_EQ(named_parameters(*program, "x.k").size(), 1U);
  try {
    named_parameter(*program, "x/slow.times");
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(e.problems[0].cure.find("x/slow.times[0]"), std::string::npos) << e.what();
  }
}

TEST(Names, AnUnknownNameIsToldWithTheNearestThreeAtMost) {
  const auto program = compile(axes(), registry());
  try {
    named_parameters(*program, "x/slow.tims");
    FAIL();
  } catch (const Error& e) {
    const std::string& cure = e.problems[0].cure;
    EXPECT_EQ(std::count(cure.begin(), cure.end(), '"'), 6) << cure;
    EXPECT_NE(cure.find("\"x/slow.times[0]\""), std::string::npos) << cure;
  }
  std::vector<std::string> many;
  for (int i = 0; i < 50; ++i) many.push_back("part_" + std::to_string(i) + "/stiffness");
  many.push_back("frame/damping");
  EXPECT_NE(did_you_mean("dampin", many).find("Did you mean \"frame/damping\""), std::string::npos)
      << "by the last part";
  EXPECT_NE(did_you_mean("dampin", many).find("51"), std::string::npos);
  EXPECT_NE(did_you_mean("b", {"a", "bb", "c"}).find("choose one of a, bb, c."), std::string::npos)
      << "a few are all told";
}

TEST(Names, AStateIsFoundOrToldWithTheNearest) {
  const auto program = compile(axes(), registry());
  ASSERT_FALSE(program->state_names.empty());
  for (std::size_t i = 0; i < program->state_names.size(); ++i)
    EXPECT_EQ(named_state(*program, program->state_names[i]), static_cast<int>(i));
  try {
    named_state(*program, program->state_names.front() + "x");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().code, "unknown_state");
    EXPECT_NE(e.problems.front().cure.find(program->state_names.front()), std::string::npos) << e.what();
  }
}

TEST(Names, ABlockWhoseOwnParametersDisagreeIsToldAloneAndInTheUnitsOfTheFile) {
  Diagram d;
  d.blocks["drive"] = node("sine", {}, {{"amplitude", "3 mm"}, {"offset", "3 V"}, {"frequency", "5 Hz"}});
  d.blocks["slow"] = node("lag", {"drive"}, {{"times", NumberList{{1, "s"}}}});
  d.blocks["stage"] = node("bouc_wen", {"slow"},
                           {{"alpha", "0.6 um/V"}, {"beta", "0.2 1/V"}, {"gamma", "0.02 1/V"}, {"d_p", "1.6 um/V"}});
  d.outputs["y"] = "stage";
  try {
    compile(d, registry());
    FAIL();
  } catch (const Error& e) {
    ASSERT_EQ(e.problems.size(), 1U) << e.what();
    EXPECT_NE(e.problems[0].what.find("amplitude (in mm)"), std::string::npos) << e.what();
    EXPECT_NE(e.problems[0].what.find("expected in V"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace hysteron
