// A sealed file shows every change.
#include "io/files/sealed_file.h"

#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

TEST(SealedFile, IsWholeAsLongAsNothingHasChanged) {
  const TemporaryFolder folder;
  for (const std::string& content : {std::string(), std::string("a"), std::string(3'000'000, 'x')}) {
    const std::string file = folder.write("x", content);
    EXPECT_EQ(seal_of(file), Seal::none);
    folder.write("x", content + seal_line(file));
    EXPECT_EQ(seal_of(file), Seal::whole);
  }
}

TEST(SealedFile, AnyBitThatIsTurnedOverIsSeen) {
  const TemporaryFolder folder;
  std::string content = "some numbers: 0.5, 0.25";
  content += seal_line(folder.write("x", content));
  for (std::size_t bit = 0; bit < 8 * content.size(); ++bit) {
    std::string damaged = content;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    EXPECT_NE(seal_of(folder.write("x", damaged)), Seal::whole) << "bit " << bit;
  }
  for (std::size_t size = 0; size < content.size(); ++size)
    EXPECT_NE(seal_of(folder.write("x", content.substr(0, size))), Seal::whole) << "cut at " << size;
  EXPECT_NE(seal_of(folder.write("x", content + "\n")), Seal::whole);
}

TEST(SealedFile, WhatCannotBeReadIsTold) {
  const TemporaryFolder folder;
  EXPECT_THROW(seal_of(folder.path("nothing")), Error);
  folder.write("x", "content");
  const StopScope scope([] { return true; });
  EXPECT_THROW(seal_of(folder.path("x")), Stopped);
}

}  // namespace
}  // namespace hysteron
