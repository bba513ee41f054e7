#include "daemon/base/disk_space.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

TEST(DiskSpace, IsThatOfTheNearestFolderThatIsThere) {
  const testing::TemporaryFolder folder;
  EXPECT_EQ(NearestFolder(folder.path() / "takes" / "more"), folder.path());
  // What may not be looked at counts as absent; a name too long stands for it.
  EXPECT_EQ(NearestFolder(folder.path() / std::string(300, 'x') / "takes"), folder.path());
  EXPECT_EQ(NearestFolder("takes-that-are-nowhere"), std::filesystem::current_path());
  EXPECT_GT(BytesFree("takes-that-are-nowhere"), 0);
}

TEST(DiskSpace, OfAFolderIsThatOfAllItsFiles) {
  const testing::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "takes" / "walk");
  testing::WriteText(folder.path() / "a", std::string(1000, 'a'));
  testing::WriteText(folder.path() / "takes" / "walk" / "b", std::string(23, 'b'));
  EXPECT_EQ(BytesIn(folder.path()), 1023);
  EXPECT_EQ(BytesIn(folder.path() / "nowhere"), 0);
}

}  // namespace
}  // namespace mocap
