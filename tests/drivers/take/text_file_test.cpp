#include "drivers/take/text_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <string_view>

#include "core/errors.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using std::filesystem::perms;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::ReadText;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

class TextFileTest : public ::testing::Test {
 protected:
  bool IsAlone() const {
    return std::distance(std::filesystem::directory_iterator(folder_.path()), {}) == 1;
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "a.toml";
};

TEST_F(TextFileTest, IsReplacedWithItsPermissions) {
  ReplaceText(file_, "a longer text");
  std::filesystem::permissions(file_, perms::owner_read | perms::owner_write);
  ReplaceText(file_, "new");
  EXPECT_EQ(ReadText(file_), "new");
  EXPECT_EQ(std::filesystem::status(file_).permissions(), perms::owner_read | perms::owner_write);
  EXPECT_TRUE(IsAlone());
}

TEST_F(TextFileTest, OfALinkTheFileIsReplaced) {
  WriteText(file_, "old");
  const testing::TemporaryFolder elsewhere;
  const std::filesystem::path link = elsewhere.path() / "link";
  std::filesystem::create_symlink(file_, link);
  ReplaceText(link, "new");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(ReadText(file_), "new");
}

TEST_F(TextFileTest, WhatCannotBeReplacedStays) {
  WriteText(file_, "old");
  // Nothing can be written where the unfinished file belongs.
  std::filesystem::create_directory(file_.string() + ".part");
  EXPECT_THROW(ReplaceText(file_, "new"), std::runtime_error);
  EXPECT_THROW(RequireWritable(file_), SetupError);
  EXPECT_EQ(ReadText(file_), "old");
}

TEST_F(TextFileTest, TryingLeavesAllAsItIs) {
  WriteText(file_, "old");
  RequireWritable(file_);
  EXPECT_EQ(ReadText(file_), "old");
  EXPECT_TRUE(IsAlone());
  RequireWritable("/dev/null");
  ReplaceText("/dev/null", "text");
}

TEST_F(TextFileTest, FoldersForResultsAreMadeUnlessSomethingElseIsThere) {
  MakeFolder(folder_.path() / "new" / "results");
  EXPECT_TRUE(std::filesystem::is_directory(folder_.path() / "new" / "results"));
  MakeFolder(folder_.path());
  WriteText(file_, "text");
  EXPECT_THROW(MakeFolder(file_), SetupError);
}

TEST_F(TextFileTest, WhatSomebodyElseWroteIsNotWrittenOver) {
  constexpr std::array<std::string_view, 2> kOwn = {"# ours", "# also ours"};
  const auto require = [&] { RequireOwn(file_, kOwn, "a report"); };
  require();
  for (const char* text : {"", "# ours, written before", "# also ours"}) {
    WriteText(file_, text);
    require();
  }
  WriteText(file_, "# a day's work");
  EXPECT_THAT(require, ThrowsMessage<SetupError>(AllOf(StartsWith(file_.string()),
                                                       HasSubstr("is not a report of mocap;"))));
  EXPECT_EQ(ReadText(file_), "# a day's work");
  RequireOwn("/dev/null", kOwn, "a report");
}

TEST_F(TextFileTest, ErrorsSayWhyAndWhatIsWanted) {
  const std::filesystem::path nowhere = folder_.path() / "nowhere" / "a";
  const auto says = AllOf(StartsWith(nowhere.string() + ": cannot be written: No such file"),
                          HasSubstr("expected"));
  EXPECT_THAT([&] { WriteText(nowhere, ""); }, ThrowsMessage<std::runtime_error>(says));
  EXPECT_THAT([&] { ReplaceText(nowhere, ""); }, ThrowsMessage<std::runtime_error>(says));
  EXPECT_THAT([&] { RequireWritable(nowhere); }, ThrowsMessage<SetupError>(says));
  EXPECT_THAT([&] { RequireWritable(""); }, ThrowsMessage<SetupError>(HasSubstr("is empty")));
  EXPECT_THAT([] { WriteText("/dev/full", "x"); },
              ThrowsMessage<std::runtime_error>("/dev/full: cannot be written: No space left on "
                                                "device; expected free space on its disk"));
}

}  // namespace
}  // namespace mocap
