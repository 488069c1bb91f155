// A refusal tells the numbers of a block in the units of the file, not in SI.
#include "engine/program/refusal.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <utility>

#include "blocks/register_all.h"
#include "engine/compile/compile.h"
#include "engine/diagram/error.h"
#include "tests/engine/diagrams_in_code.h"

namespace hysteron {
namespace {

using test::node;

/// What is said of a block on an input in this unit: what is wrong, and the cure.
std::string said(const std::string& input_unit, const std::string& type,
                 std::initializer_list<std::pair<const char*, Value>> parameters, const std::string& output = "b") {
  static const Registry all = all_blocks();
  Diagram d;
  d.inputs["u"] = {input_unit, ""};
  d.blocks["b"] = node(type, {"u"}, parameters);
  d.outputs["y"] = output;
  try {
    compile(d, all);
  } catch (const Error& error) {
    return error.problems.front().what + " | " + error.problems.front().cure;
  }
  return "not refused";
}

TEST(Refusal, TellsNumbersInTheUnitsInWhichTheyWereWritten) {
  EXPECT_EQ(
      said("N", "mass_with_friction",
           {{"mass", "1 kg"}, {"damping", "1 N s/m"}, {"coulomb", "5 mN"}, {"breakaway", "2 mN"}}, "b.position"),
      "mass_with_friction \"b\": breakaway, 2 mN, is below coulomb, 5 mN; give at least coulomb, or leave it out | correct "
      "the parameter values");
  EXPECT_EQ(said("V", "saturation", {{"lower", "10 V"}, {"upper", "500 mV"}}),
            "saturation \"b\": lower, 10 V, is not below upper, 500 mV; exchange them | correct the parameter values");
}

TEST(Refusal, GivesANumberOfItsOwnTheUnitOfAParameter) {
  // The first threshold is the first of a list, written in um.
  const std::string text = said("um", "prandtl_ishlinskii_inverse",
                                {{"thresholds", NumberList{{3, "um"}, {4, "um"}}}, {"weights", test::numbers({1, 1})}});
  EXPECT_NE(text.find("the first threshold is 3 um, so"), std::string::npos) << text;
}

TEST(Refusal, OfARangeIsInTheUnitOfItsValue) {
  EXPECT_EQ(said("N", "mass_spring_damper", {{"mass", "-3 g"}, {"stiffness", "1 N/m"}, {"damping", "1 N s/m"}}),
            "\"mass\" of mass_spring_damper is -3 g, which is outside its range | it must be greater than 0 g");
}

}  // namespace
}  // namespace hysteron
