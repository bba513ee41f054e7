#include "tools/gige/own_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/load_config.h"
#include "core/errors.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

class OwnConfig : public ::testing::Test {
 protected:
  bool MayBeReplaced(const std::string& text) {
    testing::WriteText(file_, text);
    try {
      RequireOwnConfig(file_);
    } catch (const SetupError& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr(file_.string()));
      return false;
    }
    return true;
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "studio.toml";
};

TEST_F(OwnConfig, IsReplacedOnlyAsItWasWritten) {
  RequireOwnConfig(file_);
  const std::string written = SignedConfig("body = \"full\"\n");
  EXPECT_TRUE(MayBeReplaced(written));
  EXPECT_TRUE(MayBeReplaced(""));
  EXPECT_FALSE(MayBeReplaced("# my studio, a day of work\n"));
  EXPECT_FALSE(MayBeReplaced(written + "# changed since\n"));
  EXPECT_FALSE(MayBeReplaced(SignedConfig("") + "body = \"full\"\n"));
}

TEST_F(OwnConfig, IsAConfiguration) {
  testing::WriteText(file_, SignedConfig("body = \"mikic2003\"\n"));
  EXPECT_EQ(LoadConfig(file_).body, "mikic2003");
}

}  // namespace
}  // namespace mocap
