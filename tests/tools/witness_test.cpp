// `mocap witness`, which is another program.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

/// The program in a folder of its own, where its neighbours are what a test puts there.
class LoneMocap : public ::testing::Test {
 protected:
  /// Runs the command with nothing in PATH. @return  what it said.
  std::string Run(const std::string& words) const {
    const std::string line = "PATH=/nowhere " + (folder_.path() / "mocap").string() + " witness " +
                             words + " >" + (folder_.path() / "said").string() + " 2>&1";
    EXPECT_NE(std::system(line.c_str()), -1);
    return testing::ReadText(folder_.path() / "said");
  }
  void SetUp() override { fs::copy_file(MOCAP_BIN_DIR "/mocap", folder_.path() / "mocap"); }

  testing::TemporaryFolder folder_;
};

TEST_F(LoneMocap, LetsItsWitnessDoWhatIsAsked) {
  const fs::path program = folder_.path() / "mocap-witness";
  testing::WriteText(program, "#!/bin/sh\necho \"$@\"\n");
  fs::permissions(program, fs::perms::owner_all);
  EXPECT_EQ(Run("a/take --out k.csv --rate 2 --cameras cam1,cam2"),
            "--out=k.csv --rate=2 --cameras=cam1 --cameras=cam2 -- a/take\n");
  EXPECT_EQ(Run("--fetch"), "--fetch=true --\n");
  EXPECT_EQ(Run("--share 20 --prefix left."), "--share=20 --prefix=left. --\n");
}

TEST_F(LoneMocap, SaysInWhichPackageTheWitnessIs) {
  EXPECT_EQ(Run("--fetch"),
            "mocap: mocap-witness is not installed; it is in the Debian package mocapd-witness\n");
}

}  // namespace
}  // namespace mocap
