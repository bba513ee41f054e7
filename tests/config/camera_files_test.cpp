#include "config/camera_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
namespace fs = std::filesystem;

class BackgroundFolder : public ::testing::Test {
 protected:
  /// Learns a background that holds one picture.
  static void Learn(const fs::path& folder, const std::string& picture) {
    const fs::path partial = BeginBackground(folder);
    testing::WriteText(partial / "cam1.mkv", picture);
    ReplaceBackground(folder, partial);
  }

  testing::TemporaryFolder studio_;
  fs::path folder_ = studio_.path() / "bg";
};

TEST_F(BackgroundFolder, IsTheSameHoweverItIsWritten) {
  const std::string base = studio_.path().string();
  int count = 0;
  for (const std::string name : {"/bg", "/bg/", "/./bg//", "/absent/../bg/", "/bg/."}) {
    Learn(base + name, std::to_string(++count));
    EXPECT_EQ(testing::ReadText(folder_ / "cam1.mkv"), std::to_string(count)) << name;
    EXPECT_FALSE(fs::exists(base + "/bg.partial")) << name;
  }
}

TEST_F(BackgroundFolder, BehindALinkIsReplacedAndTheLinkStays) {
  const testing::TemporaryFolder elsewhere;
  fs::create_directory(elsewhere.path() / "pictures");
  fs::create_symlink(elsewhere.path() / "pictures", folder_);
  Learn(folder_, "first");
  Learn(folder_ / "", "second");
  EXPECT_TRUE(fs::is_symlink(folder_));
  EXPECT_EQ(testing::ReadText(elsewhere.path() / "pictures" / "cam1.mkv"), "second");
}

TEST_F(BackgroundFolder, WithAnythingElseInItIsNeverTakenAway) {
  fs::create_directories(folder_ / "thesis");
  const auto refused = ThrowsMessage<SetupError>(
      AllOf(HasSubstr("\"thesis\""), HasSubstr("not a picture of the empty studio")));
  EXPECT_THAT([&] { Learn(folder_, "x"); }, refused);
  EXPECT_TRUE(fs::exists(folder_ / "thesis"));
  fs::remove_all(folder_);
  fs::create_directories(studio_.path() / "bg.partial" / "thesis");
  EXPECT_THAT([&] { Learn(folder_, "x"); }, refused);
  testing::WriteText(studio_.path() / "file", "text");
  EXPECT_THAT([&] { Learn(studio_.path() / "file", "x"); },
              ThrowsMessage<SetupError>(HasSubstr("is not a folder")));
}

}  // namespace
}  // namespace mocap
