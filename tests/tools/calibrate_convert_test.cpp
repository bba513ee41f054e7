#include "tools/calibrate_convert.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "drivers/take/calibration_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/walking_moments.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

class ConvertTest : public ::testing::Test {
 protected:
  /// What the command says, or "done".
  std::string Convert(const std::string& options) {
    CLI::App app("", "mocap");
    AddConvert(&app);
    try {
      app.parse("convert " + (folder_.path() / "ros").string() + " " + options + " --out " +
                out_.string());
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "done";
  }
  void SetUp() override {
    std::filesystem::create_directory(folder_.path() / "ros");
    testing::WriteText(folder_.path() / "ros/cam1.yaml",
                       "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [500, 0, 320, 0, 500, 240, "
                       "0, 0, 1]\ndistortion_model: plumb_bob\ndistortion_coefficients:\n  rows: "
                       "1\n  cols: 5\n  data: [0, 0, 0, 0, 0]\n");
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path out_ = folder_.path() / "out";
};

TEST_F(ConvertTest, TakesTheSizeOfPicturesFromWhoeverKnowsIt) {
  EXPECT_THAT(Convert("--from ros"), HasSubstr("--size"));
  for (const char* wrong : {"1280", "1280x", "x720", "1280x720x3", "0x720", "1280x99999", "ax720"})
    EXPECT_THAT(Convert("--from ros --size " + std::string(wrong)), HasSubstr("WIDTHxHEIGHT"));
  EXPECT_FALSE(std::filesystem::exists(out_));
  EXPECT_EQ(Convert("--from ros --size 640x480"), "done");
  EXPECT_THAT(testing::ReadText(out_), HasSubstr("size_px = [640, 480]"));
}

TEST_F(ConvertTest, RefusesASizeThatTheFilesContradict) {
  testing::WriteText(folder_.path() / "ros/cam1.yaml",
                     "image_width: 640\nimage_height: 480\n" +
                         testing::ReadText(folder_.path() / "ros/cam1.yaml"));
  EXPECT_THAT(Convert("--from ros --size 1280x720"), HasSubstr("640x480; leave --size out"));
  EXPECT_EQ(Convert("--from ros --size 640x480"), "done");
}

TEST_F(ConvertTest, AFileOfAnotherProgramNeedsItsName) {
  std::filesystem::rename(folder_.path() / "ros/cam1.yaml", folder_.path() / "c.yaml");
  std::filesystem::remove(folder_.path() / "ros");
  std::filesystem::rename(folder_.path() / "c.yaml", folder_.path() / "ros");
  EXPECT_THAT(Convert(""), HasSubstr("name the program: --from FORMAT"));
}

TEST_F(ConvertTest, ACalibrationThatShouldNotBeUsedGetsAnotherName) {
  std::vector<CameraCalibration> cameras = testing::WalkCameras();
  for (CameraCalibration& camera : cameras) camera.X_CW.p /= 1000;
  std::filesystem::remove_all(folder_.path() / "ros");
  WriteCalibration(folder_.path() / "ros", cameras);
  EXPECT_THAT(Convert(""), HasSubstr("out.rejected: has 1 error, see above"));
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(ConvertTest, GivesLensesWithoutPosesToNoFormatThatHoldsPoses) {
  EXPECT_THAT(Convert("--from ros --size 640x480 --to easymocap"), HasSubstr("poses"));
  EXPECT_FALSE(std::filesystem::exists(out_));
}

}  // namespace
}  // namespace mocap
