#include "drivers/take/input_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>

#include "core/errors.h"
#include "drivers/take/video_reader.h"
#include "tests/support/as_nobody.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using std::filesystem::perms;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

std::string Error(const std::function<void()>& action) {
  try {
    action();
  } catch (const SetupError& error) {
    return error.what();
  }
  return "none";
}

class InputFile : public ::testing::Test {
 protected:
  std::string ErrorOf(const std::filesystem::path& file) {
    return Error([&] { ReadWholeFile(file, "a TOML file", 100); });
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "a.toml";
};

TEST_F(InputFile, IsReadWhole) {
  testing::WriteText(file_, std::string("a\0b\n", 4));
  EXPECT_EQ(ReadWholeFile(file_, "a file", 4), std::string("a\0b\n", 4));
  EXPECT_THAT(Error([&] { ReadWholeFile(file_, "a file", 3); }), HasSubstr("is larger than"));
}

TEST_F(InputFile, EachReasonHasItsWord) {
  EXPECT_THAT(ErrorOf(file_), EndsWith("a.toml: not found; expected a TOML file"));
  EXPECT_THAT(ErrorOf(folder_.path()), EndsWith(": is a folder; expected a TOML file"));
  EXPECT_THAT(ErrorOf("/dev/null"), HasSubstr("is not a regular file"));
  EXPECT_THAT(ErrorOf(""), HasSubstr("a path is empty"));
  ASSERT_EQ(mkfifo((folder_.path() / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(ErrorOf(folder_.path() / "pipe"), HasSubstr("is not a regular file"));
  testing::WriteText(file_, "");
  EXPECT_THAT(ErrorOf(file_ / "below"), HasSubstr("not found"));
  EXPECT_THAT(Error([&] { RequireFolder(file_, "a take"); }),
              EndsWith(": is not a folder; expected a take"));
  EXPECT_THAT(Error([&] { RequireFolder(folder_.path() / "absent", "a take"); }),
              EndsWith(": not found; expected a take"));
  std::filesystem::create_symlink(folder_.path() / "loop", folder_.path() / "loop");
  EXPECT_THAT(ErrorOf(folder_.path() / "loop"), HasSubstr("symbolic links"));
}

TEST_F(InputFile, MissingPermissionIsNotToldAsAbsence) {
  if (!testing::AsNobody::IsPossible()) GTEST_SKIP() << "needs root that can be nobody";
  const std::filesystem::path video = folder_.path() / "cam1.mkv";
  for (const auto& file : {file_, video}) {
    testing::WriteText(file, "a = 1\n");
    std::filesystem::permissions(file, perms::owner_read);
  }
  const auto told = AllOf(HasSubstr("Permission denied"), HasSubstr("expected"));
  std::filesystem::permissions(folder_.path(), perms::all);
  {
    const testing::AsNobody nobody;
    EXPECT_THAT(ErrorOf(file_), told);
    EXPECT_THAT(Error([&] { RequireFile(file_, "a file"); }), told);
    EXPECT_THAT(Error([&] { VideoReader reader(video); }), told);
    EXPECT_TRUE(IsThere(file_));
  }
  std::filesystem::permissions(folder_.path(), perms::owner_all);
  const testing::AsNobody nobody;
  EXPECT_THAT(ErrorOf(file_), told);
  EXPECT_THAT(Error([&] { IsThere(file_); }), told);
  EXPECT_THAT(Error([&] { RequireFolder(folder_.path() / "take", "a take"); }), told);
}

TEST_F(InputFile, AFoldersNameHasNoSlashAtItsEnd) {
  EXPECT_EQ(PlainFolder("take/"), "take");
  EXPECT_EQ(PlainFolder("a/./take/."), "a/take");
  EXPECT_EQ(PlainFolder("a/b/../take//"), "a/take");
  EXPECT_EQ(PlainFolder("/"), "/");
  EXPECT_EQ(PlainFolder("."), ".");
  EXPECT_EQ(PlainFolder(""), "");
}

}  // namespace
}  // namespace mocap
