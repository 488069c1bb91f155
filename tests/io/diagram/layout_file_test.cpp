// Places of blocks beside a diagram: written and read back, and told where they are wrong.
#include "io/diagram/layout_file.h"

#include <gtest/gtest.h>

#include "engine/diagram/error.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

TEST(LayoutFile, LiesBesideTheDiagram) {
  EXPECT_EQ(layout_file_of("lab/stage.json"), "lab/stage.layout.json");
  EXPECT_EQ(layout_file_of("stage.v2.json"), "stage.v2.layout.json");
}

TEST(LayoutFile, IsReadAsItWasWrittenALinePerBlock) {
  const TemporaryFolder folder;
  const BlockPlaces places{{"motor", {12, -4}}, {"axis", {0, 300}}};
  EXPECT_EQ(layout_text(places),
            "{\n  \"format\": 1,\n  \"blocks\": {\n    \"axis\": [0, 300],\n    \"motor\": [12, -4]\n  }\n}\n");
  (void)folder.write("stage.layout.json", layout_text(places));
  EXPECT_EQ(read_layout(folder.path("stage.json")), places);
}

TEST(LayoutFile, NoFileMovesNothing) {
  const TemporaryFolder folder;
  EXPECT_TRUE(read_layout(folder.path("stage.json")).empty());
  (void)folder.write("stage.layout.json", layout_text({}));
  EXPECT_TRUE(read_layout(folder.path("stage.json")).empty());
}

TEST(LayoutFile, SaysWhatIsWrongAndInWhichLine) {
  const TemporaryFolder folder;
  for (const char* wrong : {"[1]", "[1, 2, 3]", "[1.5, 2]", "[1e9, 2]", "\"left\"", "[null, 2]", "3"}) {
    (void)folder.write("stage.layout.json", std::string("{\"format\": 1, \"blocks\": {\n \"motor\": ") + wrong + "}}");
    try {
      (void)read_layout(folder.path("stage.json"));
      FAIL() << wrong << " was taken for a place";
    } catch (const Error& error) {
      EXPECT_EQ(error.problems.front().line, 2) << wrong;
      EXPECT_TRUE(error.problems.front().path.starts_with("/blocks/motor")) << error.problems.front().path;
      EXPECT_FALSE(error.problems.front().cure.empty());
    }
  }
  (void)folder.write("stage.layout.json", "{\"format\": 1, \"blocs\": {}}");
  EXPECT_THROW((void)read_layout(folder.path("stage.json")), Error);
}

}  // namespace
}  // namespace hysteron
