#include "daemon/recording/safe_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::StartsWith;
using ::testing::ThrowsMessage;

TEST(SafeFile, SaysWhatCannotBeKeptSafe) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path nowhere = folder.path() / "nowhere";
  const auto names = [](const std::string& what) {
    return ThrowsMessage<std::runtime_error>(StartsWith(what + ": cannot be flushed"));
  };
  EXPECT_THAT([&] { SafeFile file(nowhere); }, names(nowhere.string()));
  EXPECT_THAT([&] { SyncFileSystem(nowhere); }, names(nowhere.string()));
  EXPECT_THAT([] { SafeFile("/dev/null").Sync(); }, names("/dev/null"));
  SyncFileSystem(folder.path());
}

}  // namespace
}  // namespace mocap
