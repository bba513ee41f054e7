#include "daemon/service/subjects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

TEST(Subjects, FilesThatOtherSystemsHideAreNobody) {
  const testing::TemporaryFolder folder;
  testing::WriteText(folder.path() / "anna.toml", "");
  testing::WriteText(folder.path() / "._anna.toml", "");
  testing::WriteText(folder.path() / ".DS_Store", "");
  EXPECT_THAT(Subjects(folder.path()).Names(), ::testing::ElementsAre("anna"));
}

}  // namespace
}  // namespace mocap
