// How a block looks: every type of the library is known by more than its name.
#include "draw/symbol.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "blocks/register_all.h"
#include "draw/pictogram.h"

namespace hysteron::draw {
namespace {

TEST(Symbols, OfEveryTypeAreMoreThanItsName) {
  const Registry registry = all_blocks();
  for (const auto& type : registry.types()) {
    const Declaration& declaration = registry.find(type)->declaration;
    if (declaration.group == "internal") continue;
    const Symbol s = symbol_of(declaration, {}, 1, 1);
    EXPECT_NE(s.text, std::vector<std::string>{type}) << "no picture, no formula";
    if (!s.picture.empty()) {
      EXPECT_NE(find_pictogram(s.picture), nullptr) << type << ": " << s.picture;
    }
    EXPECT_GT(s.width, 0) << type;
  }
}

TEST(Symbols, OfAnUnknownTypeAreItsName) {
  Declaration declaration;
  declaration.type = "something_else";
  EXPECT_EQ(symbol_of(declaration, {}, 1, 1).text, std::vector<std::string>{"something_else"});
}

}  // namespace
}  // namespace hysteron::draw
