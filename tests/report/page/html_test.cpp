// Text of any origin is harmless in the page.
#include "report/page/html.h"

#include <gtest/gtest.h>

namespace hysteron {
namespace {

TEST(Escape, TurnsMarkupIntoText) {
  EXPECT_EQ(escape("<b a=\"1\" b='2'>&"), "&lt;b a=&quot;1&quot; b=&#39;2&#39;&gt;&amp;");
}

TEST(Escape, DropsControlCharactersAndKeepsLettersOfAnyLanguage) {
  EXPECT_EQ(escape(std::string("a\0\x01µ\n\tb", 8)), "aµ\n\tb");
}

TEST(EscapeProse, SetsCodeBetweenBackticksAndEscapesInside) {
  EXPECT_EQ(escape_prose("put `a<b` in"), "put <code>a&lt;b</code> in");
  EXPECT_EQ(escape_prose("a lonely ` stays"), "a lonely ` stays");
}

TEST(EscapeProse, KeepsANumberAndItsUnitOnOneLine) {
  EXPECT_EQ(escape_prose("3.2 % of 5 um, 7 V/um"), "3.2\u00a0% of 5\u00a0um, 7\u00a0V/um");
  EXPECT_EQ(escape_prose("11 recordings"), "11 recordings");
  EXPECT_EQ(escape_prose("ends with 3 "), "ends with 3 ");
}

TEST(EscapeJson, NeverEndsTheScriptElementAndMeansTheSame) {
  EXPECT_EQ(escape_json(R"(["</script><!--", "a"])"), R"(["\u003c/script>\u003c!--", "a"])");
}

}  // namespace
}  // namespace hysteron
