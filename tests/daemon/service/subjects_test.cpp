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

TEST(Subjects, KnowsAllButThoseWhoseFilesAreDamaged) {
  const testing::TemporaryFolder folder;
  const Subjects subjects(folder.path());
  subjects.Save("anna", AverageSizes(1700));
  testing::WriteText(folder.path() / "bertil.toml", "torn [");
  const std::vector<KnownPerson> known = subjects.Known();
  ASSERT_EQ(known.size(), 1u);
  EXPECT_EQ(known[0].name, "anna");
  EXPECT_NEAR(known[0].sizes.Stature(), 1700, 1);
}

}  // namespace
}  // namespace mocap
