// Archives of strangers: what would leave the folder, be a link or fill the disk is refused, and nothing is written.
#include "io/files/zip_archive.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "engine/diagram/error.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using Parts = std::vector<std::pair<std::string, std::string>>;

class ZipArchiveTest : public testing::Test {
 protected:
  /// The error of unpacking it, and that nothing was written.
  std::string refused(const std::string& bytes, ZipArchive::Kind kind = {"FMU", "export it again"}) const {
    fs::create_directories(folder_.path("into"));
    std::string words;
    try {
      ZipArchive(folder_.write("a.zip", bytes), kind).unpack(folder_.path("into"));
      ADD_FAILURE() << "was unpacked";
    } catch (const Error& e) {
      words = to_text(e.problems);
    }
    EXPECT_TRUE(fs::is_empty(folder_.path("into")));
    return words;
  }

  const TemporaryFolder folder_;
};

TEST_F(ZipArchiveTest, WhatIsPackedIsUnpacked) {
  const std::string long_part(100000, 'x');
  const std::string bytes = zipped({{"a.txt", "A"}, {"sub/deeper/b.bin", long_part}, {"empty", ""}});
  EXPECT_LT(bytes.size(), 2000U);
  EXPECT_EQ(bytes, zipped({{"a.txt", "A"}, {"sub/deeper/b.bin", long_part}, {"empty", ""}})) << "made at another time";
  const ZipArchive archive(folder_.write("a.zip", bytes), {"FMU", "export it again"});
  EXPECT_EQ(archive.names(), (std::vector<std::string>{"a.txt", "sub/deeper/b.bin", "empty"}));
  archive.unpack(folder_.path());
  EXPECT_EQ(TemporaryFolder::read(folder_.path("sub/deeper/b.bin")), long_part);
  EXPECT_EQ(TemporaryFolder::read(folder_.path("a.txt")), "A");
  EXPECT_TRUE(fs::exists(folder_.path("empty")));
}

TEST_F(ZipArchiveTest, NamesThatLeadOutAreRefused) {
  EXPECT_NE(
      refused(zipped({{"good.txt", "A"}, {"../out.txt", "B"}})).find("\"../out.txt\" would lie outside of the folder"),
      std::string::npos);
  EXPECT_NE(refused(zipped({{"a/../../out.txt", "B"}})).find("outside"), std::string::npos);
  EXPECT_NE(refused(zipped({{"/tmp/out.txt", "B"}})).find("outside"), std::string::npos);
  EXPECT_NE(refused(zipped({{"a\\..\\out.txt", "B"}})).find("outside"), std::string::npos);
  EXPECT_NE(refused(zipped({{"C:out.txt", "B"}})).find("outside"), std::string::npos);
}

TEST_F(ZipArchiveTest, LinksAreRefused) {
  // The central directory says of which system and kind a part is: version made by (offset 5: 3 = Unix) and external
  // attributes (offset 38, the upper half is the mode), APPNOTE.TXT 4.3.12.
  std::string bytes = zipped({{"link", "/etc/passwd"}});
  const auto entry = bytes.find("PK\x01\x02");
  ASSERT_NE(entry, std::string::npos);
  bytes[entry + 5] = 3;
  bytes[entry + 40] = static_cast<char>(0xff), bytes[entry + 41] = static_cast<char>(0xa1);  // 0120777
  EXPECT_NE(refused(bytes).find("\"link\" is no file but a link or a device"), std::string::npos);
}

TEST_F(ZipArchiveTest, WhatFillsTheDiskIsRefused) {
  const Parts parts{{"a", std::string(3000, '0')}, {"b", std::string(3000, '0')}};
  EXPECT_NE(refused(zipped(parts), {"FMU", "x", 4000, 5000}).find("unpacked it is larger than"), std::string::npos);
  EXPECT_NE(refused(zipped(parts), {"FMU", "x", 2000, 50000}).find("unpacked it is larger than"), std::string::npos);
  const ZipArchive archive(folder_.write("b.zip", zipped(parts)), {"FMU", "x", 2000, 50000});
  EXPECT_THROW(archive.part("a"), Error);
}

TEST_F(ZipArchiveTest, DamageIsTold) {
  const std::string bytes = zipped({{"a.txt", std::string(1000, 'x') + "y"}});
  EXPECT_NE(refused(bytes.substr(0, bytes.size() / 2)).find("its zip archive is damaged"), std::string::npos);
  EXPECT_NE(refused("no archive").find("this FMU cannot be read"), std::string::npos);
  std::string broken = bytes;
  broken[bytes.find("a.txt") + 8] ^= 0x55;  // inside of what is packed
  EXPECT_NE(refused(broken).find("a.txt"), std::string::npos);
}

}  // namespace
}  // namespace hysteron
