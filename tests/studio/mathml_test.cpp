// Laws as formulas: what is plain text in a declaration is set as a fraction, a power, an index.
#include "studio/mathml.h"

#include <gtest/gtest.h>

#include <pugixml.hpp>

#include "blocks/register_all.h"

namespace hysteron::studio {
namespace {

/// Without what only spaces.
std::string set(const std::string& law, const std::set<std::string>& names = {}) {
  std::string text = mathml_of(law, names);
  for (const std::string space :
       {"<mspace width=\"0.2em\"/>", "<mspace width=\"0.3em\"/>", "<mspace width=\"0.6em\"/>", "<math>", "</math>"})
    for (auto at = text.find(space); at != std::string::npos; at = text.find(space)) text.erase(at, space.size());
  return text;
}

TEST(MathMl, AStrokeIsAFractionOfItsTwoFactors) {
  EXPECT_EQ(set("a/b"), "<mfrac><mrow><mi>a</mi></mrow><mrow><mi>b</mi></mrow></mfrac>");
  EXPECT_EQ(set("(u - x)/time", {"time"}),
            "<mfrac><mrow><mi>u</mi><mo>−</mo><mi>x</mi></mrow><mrow><mi>time</mi></mrow></mfrac>")
      << "the brackets go: the stroke holds them together";
  EXPECT_EQ(set("dx/dt = k u"),
            "<mfrac><mrow><mrow><mi mathvariant=\"normal\">d</mi><mi>x</mi></mrow></mrow><mrow><mrow><mi "
            "mathvariant=\"normal\">d</mi><mi>t</mi></mrow></mrow></mfrac><mo>=</mo><mi>k</mi><mi>u</mi>");
}

TEST(MathMl, PowersAndIndicesStandHighAndLow) {
  EXPECT_EQ(set("z^-1"), "<msup><mrow><mi>z</mi></mrow><mrow><mo>−</mo><mn>1</mn></mrow></msup>");
  EXPECT_EQ(set("u_k"), "<msub><mi>u</mi><mi>k</mi></msub>");
  EXPECT_EQ(set("u_(k-1)"), "<msub><mrow><mi>u</mi></mrow><mrow><mi>k</mi><mo>−</mo><mn>1</mn></mrow></msub>");
  EXPECT_EQ(set("times[k]", {"times"}), "<msub><mrow><mi>times</mi></mrow><mrow><mi>k</mi></mrow></msub>");
  EXPECT_EQ(set("per_decade", {"per_decade"}), "<mi>per_decade</mi>") << "the name of a parameter is one symbol";
}

TEST(MathMl, WordsStayWords) {
  EXPECT_EQ(set("y = 1 if u > 0"), "<mi>y</mi><mo>=</mo><mn>1</mn><mtext>if</mtext><mi>u</mi><mo>&gt;</mo><mn>0</mn>");
  EXPECT_EQ(set("what the text says"), "<mtext>what the text says</mtext>");
  EXPECT_EQ(set("2 pi"), "<mn>2</mn><mi>π</mi>");
}

TEST(MathMl, EachClauseOfALawIsALineOfItsOwn) {
  EXPECT_EQ(mathml_of("y = u, x = 2; z = 3", {}),
            mathml_of("y = u", {}) + "<br/>" + mathml_of("x = 2", {}) + "<br/>" + mathml_of("z = 3", {}));
  EXPECT_EQ(mathml_of("y = max(u, v)", {}).find("<br/>"), std::string::npos) << "a comma within brackets parts nothing";
  EXPECT_EQ(mathml_of("k = 0, 1", {}).find("<br/>"), std::string::npos) << "nor one in a list";
}

TEST(MathMl, WhateverStandsThereIsWellFormed) {
  for (const char* law :
       {"", ")", "((", "|u", "a^", "a_", "/", "a//b", "^_[", "x[", "...", "f(", "\"<&>", "+- <= !=", "a]b"}) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(mathml_of(law, {}).c_str())) << law << ": " << mathml_of(law, {});
  }
}

TEST(MathMl, EveryLawOfABlockIsSetAndLosesNoName) {
  const Registry blocks = all_blocks();
  for (const auto& type : blocks.types()) {
    const Declaration& declaration = blocks.find(type)->declaration;
    std::set<std::string> names;
    for (const auto& parameter : declaration.parameters) names.insert(parameter.name);
    const std::string formula = mathml_of(declaration.equation, names);
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(formula.c_str())) << type << ": " << formula;
    for (const std::string letter : {"alpha", "beta", "gamma"}) names.erase(letter);  // set as Greek letters
    for (const auto& name : names)
      if (declaration.equation.find(name + " ") != std::string::npos) {
        EXPECT_NE(formula.find(name), std::string::npos) << type << " lost " << name;
      }
  }
}

}  // namespace
}  // namespace hysteron::studio
