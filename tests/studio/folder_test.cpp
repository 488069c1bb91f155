// Which files the page may see, and how it finds them.
#include "studio/folder.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "engine/diagram/error.h"
#include "tests/io/temporary_folder.h"

namespace hysteron::studio {
namespace {

namespace fs = std::filesystem;

class StudioFolder : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& content) const { (void)folder_.write(name, content); }
  std::string refusal(const std::string& name) const {
    try {
      OpenFolder(folder_.path("open")).file(name);
    } catch (const Error& error) {
      return error.problems.front().code;
    }
    return "";
  }
  TemporaryFolder folder_;
};

TEST_F(StudioFolder, HoldsWhatLiesBelowItAndNothingElse) {
  write("secret.json", "{}");
  write("open/sub/a.json", "{}");
  write("open-beside/b.json", "{}");
  fs::create_symlink(folder_.path("secret.json"), folder_.path("open/link.json"));
  fs::create_directory_symlink(folder_.path(), folder_.path("open/up"));
  for (const char* inside : {"sub/a.json", "new.json", "sub/../sub/a.json", "no/such/folder.json"})
    EXPECT_EQ(refusal(inside), "") << inside;
  for (const char* outside : {"", "..", "../secret.json", "sub/../../secret.json", "/etc/passwd", "link.json",
                              "up/secret.json", "../open-beside/b.json"})
    EXPECT_EQ(refusal(outside), "outside_folder") << outside;
  EXPECT_EQ(refusal(std::string("a\0.json", 7)), "outside_folder");
}

TEST_F(StudioFolder, ListsWhatCanBeOpened) {
  write("open/b.json", R"({"format": 1, "title": "Stage", "blocks": {}})");
  write("open/broken.json", R"({"format": 1, "blocks": )");
  write("open/set.json", R"({"format": 1, "recordings": []})");
  write("open/other.json", R"({"name": "x"})");
  write("open/list.json", "[1]");
  write("open/lab/a.csv", "t [s],u [V]\n0,0\n");
  write("open/b.run/result.json", "{}");
  write("open/b.run/traces/x.csv", "t [s]\n0\n");
  write("open/.hysteron/jobs/1/out/final.json", R"({"blocks": {}})");
  std::string told;
  for (const auto& f : OpenFolder(folder_.path("open")).list()) told += f.path + " " + f.kind + " " + f.title + "\n";
  EXPECT_EQ(told, "b.json diagram Stage\nbroken.json diagram \nlab/a.csv recording \nset.json dataset \n");
}

TEST_F(StudioFolder, IsRefusedWhereThereIsNone) { EXPECT_THROW(OpenFolder(folder_.path("none")), Error); }

}  // namespace
}  // namespace hysteron::studio
