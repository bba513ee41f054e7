#include "drivers/take/unfinished_folder.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

TEST(UnfinishedFolder, GoesWithItsContentsUnlessTheWorkWasFinished) {
  const testing::TemporaryFolder temporary;
  const std::filesystem::path failed = temporary.path() / "failed",
                              kept = temporary.path() / "kept";
  {
    UnfinishedFolder first(failed), second(kept);
    std::filesystem::create_directories(failed / "below");
    std::filesystem::create_directories(kept);
    second.Finish();
  }
  EXPECT_FALSE(std::filesystem::exists(failed));
  EXPECT_TRUE(std::filesystem::exists(kept));
}

}  // namespace
}  // namespace mocap
