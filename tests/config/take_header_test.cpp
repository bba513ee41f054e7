#include "config/take_header.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/as_nobody.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

TEST(TakeHeader, OfAFolderThatMayBeEnteredButNotListedItsFileIsWanted) {
  if (!testing::AsNobody::IsPossible()) GTEST_SKIP() << "needs root that can be nobody";
  const testing::TemporaryFolder folder;
  std::filesystem::permissions(folder.path(), static_cast<std::filesystem::perms>(0711));
  const testing::AsNobody nobody;
  EXPECT_THAT(testing::SetupErrorOf([&] { ReadTakeHeader(folder.path()); }),
              ::testing::HasSubstr((folder.path() / "take.toml").string()));
}

TEST(TakeHeader, ForAFileOfATakeItsFolderIsExpected) {
  const testing::TemporaryFolder folder;
  testing::WriteText(folder.path() / "take.toml", "");
  testing::WriteText(folder.path() / "cam1.mkv", "");
  for (const char* name : {"take.toml", "cam1.mkv"}) {
    const std::filesystem::path file = folder.path() / name;
    EXPECT_EQ(
        testing::SetupErrorOf([&] { ReadTakeHeader(file); }),
        file.string() + ": is a file of a take; expected its folder, " + folder.path().string());
  }
}

}  // namespace
}  // namespace mocap
