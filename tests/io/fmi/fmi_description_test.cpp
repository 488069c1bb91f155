// Model descriptions: what is written is read again in both versions, what others write is understood, and what the
// standard forbids is told.
#include "io/fmi/fmi_description.h"

#include <gtest/gtest.h>

#include "engine/diagram/error.h"

namespace hysteron {
namespace {

FmiScalar scalar(const std::string& name, unsigned reference, const std::string& causality) {
  FmiScalar v;
  v.name = name;
  v.reference = reference;
  v.causality = causality;
  return v;
}

FmiDescription example(int version) {
  FmiDescription d;
  d.version = version;
  d.name = "A <stage> & \"more\"";
  d.token = "{x}";
  d.identifier = "stage";
  d.copies_state = true;
  d.stop = 0.1;
  d.step = 1e-3;
  d.units = {{"um/V", parse_unit("um/V")}, {"Hz", parse_unit("Hz")}, {"degC", parse_unit("degC")}};
  d.variables = {scalar("time", 0, "independent"), scalar("u", 7, "input"), scalar("y", 3, "output")};
  d.variables[1].start = 1.0 / 3;
  d.variables[1].unit = "um/V";
  d.variables[1].lower = -1;
  d.variables[2].initial = "calculated";
  d.variables[2].nominal = 1e-6;
  d.outputs = {{3, std::vector<unsigned>{7}}};
  d.initial_unknowns = {{3, {}}};
  return d;
}

class BothVersions : public testing::TestWithParam<int> {};

TEST_P(BothVersions, WhatIsWrittenIsReadAgain) {
  const FmiDescription d = example(GetParam());
  const FmiDescription again = read_fmi_description(fmi_description_text(d), "x.fmu");
  EXPECT_EQ(again.version, GetParam());
  EXPECT_EQ(again.name, d.name);
  EXPECT_EQ(again.token, d.token);
  EXPECT_EQ(again.identifier, "stage");
  EXPECT_TRUE(again.copies_state);
  EXPECT_EQ(again.stop, 0.1);
  EXPECT_EQ(again.step, 1e-3);
  ASSERT_EQ(again.variables.size(), 3U);
  EXPECT_EQ(again.variables[1].start, 1.0 / 3);  // to the last bit
  EXPECT_EQ(again.variables[1].lower, -1);
  EXPECT_EQ(again.variables[1].unit, "um/V");
  EXPECT_EQ(again.variables[2].reference, 3U);
  EXPECT_EQ(again.variables[2].nominal, 1e-6);
  ASSERT_EQ(again.outputs.size(), 1U);
  EXPECT_EQ(again.outputs[0].reference, 3U);
  EXPECT_EQ(again.outputs[0].dependencies, std::vector<unsigned>{7});
  EXPECT_FALSE(again.initial_unknowns[0].dependencies);
  EXPECT_EQ(again.units[2].unit->offset, 273.15);
  // FMI has no cycle: a hertz is 2 pi rad/s.
  EXPECT_DOUBLE_EQ(again.units[1].unit->scale, 6.283185307179586);
  EXPECT_EQ(again.units[1].unit->dimension, parse_unit("rad/s").dimension);
  EXPECT_EQ(fmi_description_faults(again), std::vector<std::string>());
}
INSTANTIATE_TEST_SUITE_P(Fmi, BothVersions, testing::Values(2, 3));

TEST(FmiDescription, UnderstandsWhatOthersWrite) {
  const FmiDescription d = read_fmi_description(R"(<?xml version="1.0"?>
    <fmiModelDescription fmiVersion="2.0" modelName="m" guid="{1}">
      <ModelExchange modelIdentifier="m"/>
      <TypeDefinitions><SimpleType name="Volt"><Real unit="V"/></SimpleType></TypeDefinitions>
      <ModelVariables><ScalarVariable name="a" valueReference="5" causality="input"><Real declaredType="Volt" start="2"/></ScalarVariable>
        <!-- a remark --><ScalarVariable name="n" valueReference="6"><Integer start="3"/></ScalarVariable></ModelVariables>
      <ModelStructure/></fmiModelDescription>)",
                                                "x.fmu");
  EXPECT_EQ(d.identifier, "");  // no co-simulation
  EXPECT_EQ(d.find("a")->unit, "V");
  EXPECT_EQ(d.find("n")->type, "Integer");
  EXPECT_EQ(d.find("b"), nullptr);
}

TEST(FmiDescription, DamageIsRefusedWithItsPlace) {
  const auto refused = [](const std::string& text) -> std::string {
    try {
      read_fmi_description(text, "x.fmu");
    } catch (const Error& e) {
      return to_text(e.problems);
    }
    return "";
  };
  EXPECT_NE(refused("<a").find("is no XML"), std::string::npos);
  EXPECT_NE(refused("<a/>").find("has no element fmiModelDescription"), std::string::npos);
  EXPECT_NE(refused(R"(<fmiModelDescription fmiVersion="1.0"/>)").find("is \"1.0\""), std::string::npos);
  std::string text = fmi_description_text(example(2));
  text.replace(text.find("min=\"-1\""), 8, "min=\"-a\"");
  EXPECT_NE(refused(text).find("has \"-a\" where a number was expected"), std::string::npos);
}

TEST(FmiDescription, FaultsAreTold) {
  FmiDescription d = example(3);
  d.identifier = "2 stages";
  d.variables[1].unit = "furlong";
  d.variables[1].start = -2;
  d.variables[2].reference = 7;
  d.variables.push_back(scalar("k", 9, "parameter"));
  const auto faults = fmi_description_faults(d);
  const auto tells = [&](const std::string& what) {
    for (const auto& fault : faults)
      if (fault.find(what) != std::string::npos) return true;
    return false;
  };
  EXPECT_TRUE(tells("\"2 stages\" is no name of C"));
  EXPECT_TRUE(tells("\"furlong\", which is not defined"));
  EXPECT_TRUE(tells("starts at -2, outside of its range"));
  EXPECT_TRUE(tells("\"u\" and \"y\" have the same value reference 7"));
  EXPECT_TRUE(tells("output \"y\" is missing in the structure"));
  EXPECT_TRUE(tells("\"k\" needs a start value"));
  EXPECT_TRUE(tells("\"k\" is a parameter and continuous"));
}

}  // namespace
}  // namespace hysteron
