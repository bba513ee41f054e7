#include "tools/simulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "config/open_studio.h"
#include "core/errors.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

class Simulate : public ::testing::Test {
 protected:
  fs::path Run(const std::string& name, const std::string& options) {
    CLI::App app("mocap");
    AddSimulateCommand(app);
    app.parse("simulate --out " + (folder_ / name).string() + " " + options);
    return folder_ / name;
  }

  testing::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path();
};

std::string Content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST_F(Simulate, WritesATakeThatOpensWithTruthAndMasks) {
  const fs::path take = Run("take", "--motion stand --seconds 0.1 --cameras 4");
  Studio studio = OpenTake(take, {});
  ASSERT_EQ(studio.cameras.size(), 4u);
  EXPECT_EQ(studio.cameras[0].background().size(), 40u);
  for (StudioCamera& camera : studio.cameras) {
    camera.driver->Start();
    Frame frame;
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(camera.driver->Grab(frame, std::chrono::seconds(1)), GrabStatus::kFrame);
    EXPECT_EQ(camera.driver->Grab(frame, std::chrono::seconds(1)), GrabStatus::kEnd);
    camera.driver->Stop();
    EXPECT_TRUE(fs::exists(take / "silhouette" / (camera.calibration.name + ".mkv")));
  }
  const std::string truth = Content(take / "truth.csv");
  EXPECT_EQ(truth.substr(0, truth.find("_z_mm")),
            "frame,timestamp_ns,pelvis_x_mm,pelvis_y_mm,pelvis");
  EXPECT_NE(
      truth.find(",contact_heel_l,contact_heel_r,contact_toe_l,contact_toe_r\n0,1000000000000,"),
      std::string::npos);
  EXPECT_NE(Content(take / "truth.toml").find("lower_arm_mm"), std::string::npos);
}

TEST_F(Simulate, OnAFullDiskLeavesNothingBehind) {
  const testing::FileSizeLimit full(20'000);
  EXPECT_THROW(Run("take", "--motion stand --seconds 0.1 --cameras 4"), std::runtime_error);
  EXPECT_THROW(Run("board", "--board desk --seconds 0.1 --cameras 4"), std::runtime_error);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(Simulate, SaysHowMuchOfTheDiskTheTakeNeeds) {
  ::testing::internal::CaptureStdout();
  const fs::path take = Run("take", "--motion stand --seconds 0.1 --cameras 2");
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(take)) {
    if (entry.is_regular_file()) bytes += entry.file_size();
  }
  EXPECT_EQ(::testing::internal::GetCapturedStdout(),
            "3 frame sets of 2 cameras, " + std::to_string(std::lround(1e-6 * bytes)) +
                " MB: " + take.string() + "\n");
}

TEST_F(Simulate, OfSeveralPeopleEachHasTruthOfTheFramesInWhichHeIsThere) {
  const fs::path take = Run("take",
                            "--motion visit --people 2 --seconds 6 --fps 2 --cameras 4 "
                            "--width 160 --height 120");
  EXPECT_FALSE(fs::exists(take / "truth.csv"));
  const std::string stays = Content(take / "person-1" / "truth.csv");
  const std::string visits = Content(take / "person-2" / "truth.csv");
  EXPECT_EQ(std::ranges::count(stays, '\n'), 13);
  const auto rows = std::ranges::count(visits, '\n') - 1;
  EXPECT_GT(rows, 0);
  EXPECT_LT(rows, 12);
  // He is the last to come, and stays: frames are the take's.
  EXPECT_NE(visits.find("\n11,1005500000000,"), std::string::npos);
  EXPECT_NE(Content(take / "person-2" / "truth.toml").find("stature_mm"), std::string::npos);
  const std::string description = Content(take / "take.toml");
  EXPECT_NE(description.find("[[person]]\nfolder = \"person-1\"\nin_room = [[0, 11]]\n"),
            std::string::npos)
      << description;
  EXPECT_NE(description.find("folder = \"person-2\"\nin_room = [[" + std::to_string(12 - rows) +
                             ", 11]]\n"),
            std::string::npos)
      << description;
  EXPECT_EQ(OpenTake(take, {}).cameras.size(), 4u);
}

TEST_F(Simulate, TheSameOptionsGiveTheSameBytes) {
  const std::string options = "--seconds 0.1 --cameras 2 --stature 1400 --seed 9 --fps 20";
  // The name of a take is its folder's.
  const fs::path first = Run("a/take", options), second = Run("b/take", options);
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(first)) {
    if (!entry.is_regular_file()) continue;
    EXPECT_EQ(Content(entry.path()), Content(second / fs::relative(entry.path(), first)))
        << entry.path();
    ++files;
  }
  EXPECT_EQ(files, 12);
}

TEST_F(Simulate, PicturesHaveTheSizeThatIsAskedFor) {
  const fs::path take = Run("take", "--seconds 0.1 --cameras 1 --width 320 --height 200");
  const CameraCalibration camera = OpenTake(take, {}).cameras[0].calibration;
  EXPECT_EQ(camera.width_px, 320);
  EXPECT_EQ(camera.height_px, 200);
}

TEST_F(Simulate, TheTakeSaysWhatMakesPeopleHardToSee) {
  const std::string small = "--seconds 0.1 --cameras 2 --width 160 --height 120";
  const std::string usual = Content(Run("usual", small) / "take.toml");
  EXPECT_EQ(usual.find("contrast"), std::string::npos);
  EXPECT_EQ(usual.find("misled"), std::string::npos);
  EXPECT_EQ(usual.find("shadows"), std::string::npos);
  EXPECT_EQ(usual.find("crf"), std::string::npos);
  const std::string hard = Content(
      Run("hard", small + " --contrast 15 --soft-shadows --misled 0.5 --crf 28") / "take.toml");
  EXPECT_NE(hard.find("contrast = \"15\"\nshadows = \"soft\"\nmisled = \"0.5\"\ncrf = \"28\"\n"),
            std::string::npos)
      << hard;
}

TEST_F(Simulate, RefusesWhatCannotBe) {
  EXPECT_THROW(Run("take", "--motion fly"), SetupError);
  for (const char* option :
       {"--stature 20", "--seconds 0", "--seconds nan", "--seconds 1e300", "--fps 1e9",
        "--cameras 0", "--cameras 1000000000", "--people 0", "--people 5", "--width 4",
        "--height 1000000000", "--contrast 4", "--misled 1.1", "--contrast 15 --board floor",
        "--misled 0.5 --board floor", "--apart -1"}) {
    EXPECT_THROW(Run("take", option), CLI::ParseError) << option;
  }
  EXPECT_THROW(Run("take", "--cameras 64 --width 8192 --height 8192"), SetupError);
  EXPECT_THROW(Run("take", "--crf 28 --width 161"), SetupError);
  EXPECT_THROW(Run("take", "--fps 30 --apart 0.02"), SetupError);
  EXPECT_FALSE(fs::exists(folder_ / "take"));
}

}  // namespace
}  // namespace mocap
