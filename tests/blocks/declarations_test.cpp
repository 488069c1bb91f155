// What every block says of itself must be complete: the reference, the schemas and the checks are made from it.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <variant>

#include "engine/diagram/diagram.h"
#include "engine/diagram/units.h"
#include "tests/blocks/samples.h"

namespace hysteron {
namespace {

bool is_name(const std::string& s) {
  if (s.empty() || s[0] < 'a' || s[0] > 'z') return false;
  return s.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
}

/// Every token of a unit expression is a variable or a unit that can be read.
void expect_unit(std::string expression, const std::string& where) {
  if (expression.empty()) return;
  for (const std::string index : {"[i]", "[row]", "[column]"})  // of an element of a vector or matrix
    for (auto at = expression.find(index); at != std::string::npos; at = expression.find(index))
      expression.erase(at, index.size());
  std::size_t begin = 0;
  while (begin <= expression.size()) {
    const auto end = std::min(expression.find_first_of("*/", begin), expression.size());
    const std::string token = expression.substr(begin, end - begin);
    if (token.empty() || token[0] != '$') {
      EXPECT_NO_THROW(parse_unit(token)) << where << ": " << expression;
      EXPECT_FALSE(token.empty()) << where;
    } else {
      EXPECT_TRUE(is_name(token.substr(1))) << where << ": " << expression;
    }
    begin = end + 1;
  }
}

class EveryBlock : public testing::TestWithParam<std::string> {
 protected:
  const Declaration& d() const { return bench::kernel_of(GetParam()).declaration; }
};

TEST_P(EveryBlock, SaysWhatItIsByWhichLawAndFromWhere) {
  EXPECT_TRUE(is_name(d().type));
  EXPECT_FALSE(d().summary.empty());
  EXPECT_FALSE(d().equation.empty());
  EXPECT_FALSE(d().source.empty());
  EXPECT_FALSE(d().group.empty());
  for (const auto& remark : d().remarks) EXPECT_FALSE(remark.empty());
}

TEST_P(EveryBlock, NamesEveryNumberWithUnitAndMeaning) {
  std::set<std::string> names;
  const auto check = [&](const auto& list) {
    for (const auto& item : list) {
      EXPECT_TRUE(is_name(item.name)) << item.name;
      EXPECT_FALSE(item.meaning.empty()) << item.name;
      expect_unit(item.unit, d().type + "." + item.name);
    }
  };
  check(d().inputs);
  check(d().outputs);
  check(d().parameters);
  check(d().states);
  for (const auto& p : d().parameters) {
    EXPECT_TRUE(names.insert(p.name).second) << p.name << " twice";
    EXPECT_NE(p.name, "in");  // words of the diagram file itself
    EXPECT_NE(p.name, "type");
    EXPECT_NE(p.name, "choose");
    EXPECT_NE(p.name, "parameters");
  }
  EXPECT_FALSE(d().outputs.empty());
  std::set<std::string> ports;
  for (const auto& port : d().outputs) EXPECT_TRUE(ports.insert(port.name).second) << port.name << " twice";
}

TEST_P(EveryBlock, HasDefaultsThatCanBeRead) {
  for (const auto& p : d().parameters) {
    if (!p.default_text || p.kind == ParameterKind::text) continue;
    if (p.kind != ParameterKind::number && p.default_text->empty()) continue;  // none
    double number = 0;
    std::string unit;
    ASSERT_TRUE(split_quantity(*p.default_text, number, unit)) << p.name;
    // Where the unit is a variable, a plain number other than zero and infinity would fix it to "no unit": only
    // dimensionless ratios may.
    if (p.unit.find('$') != std::string::npos && number != 0 && !std::isinf(number)) {
      EXPECT_EQ(p.unit, "$b/$a") << d().type << "." << p.name;
    }
    if (!unit.empty()) {
      EXPECT_EQ(parse_unit(unit).dimension, parse_unit(p.unit).dimension) << p.name;
    }
  }
}

TEST_P(EveryBlock, NamesListsOfEqualLengthThatExist) {
  for (const auto& p : d().parameters)
    if (!p.same_length_as.empty()) {
      EXPECT_GE(d().parameter_index(p.same_length_as), 0);
    }
}

TEST_P(EveryBlock, HasChoicesThatAFileReadsAsWords) {
  for (const auto& p : d().parameters)
    for (const auto& choice : p.choices)
      EXPECT_TRUE(std::holds_alternative<std::string>(Value(choice).content)) << p.name << ": " << choice;
}

INSTANTIATE_TEST_SUITE_P(Types, EveryBlock, testing::ValuesIn(bench::registry().types()),
                         [](const auto& made) { return made.param; });

TEST(AllBlocks, HaveASampleForTheLawsThatHoldForAll) {
  // The samples of two are series (sources_test.cpp), and of an FMU it takes its file (tests/interop/fmi).
  std::set<std::string> sampled{"recorded", "input", "fmu"};
  for (const auto& s : bench::samples()) sampled.insert(s.type);
  for (const auto& type : bench::registry().types()) EXPECT_TRUE(sampled.contains(type)) << type;
}

}  // namespace
}  // namespace hysteron
