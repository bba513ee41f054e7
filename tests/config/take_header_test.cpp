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

}  // namespace
}  // namespace mocap
