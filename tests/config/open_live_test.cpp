#include "config/open_live.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "config/load_config.h"
#include "config/open_studio.h"
#include "core/errors.h"
#include "drivers/usb/uvc_pan_tilt.h"
#include "tests/support/small_take.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A studio of two cameras, of which a small take has calibration and background.
class LiveStudio : public ::testing::Test {
 protected:
  LiveStudio() {
    testing::WriteSmallTake(folder_.path() / "take", take_);
    std::filesystem::copy(folder_.path() / "take/calibration.toml",
                          folder_.path() / "calibration.toml");
    std::filesystem::copy(folder_.path() / "take/background", folder_.path() / "background");
  }

  Config Load(const std::string& camera_settings = "", const std::string& name = "cam2") {
    const std::filesystem::path file = folder_.path() / "mocapd.toml";
    testing::WriteText(file,
                       "calibration = \"calibration.toml\"\n[source]\ndriver = \"v4l2\"\n"
                       "fps = 50\n[[cameras]]\nname = \"cam1\"\ndevice = \"/dev/video0\"\n"
                       "[[cameras]]\nname = \"" +
                           name + "\"\ndevice = \"/dev/video2\"\n" + camera_settings);
    return LoadConfig(file);
  }

  static std::string Error(const Config& config) {
    try {
      OpenStudio(config);
    } catch (const SetupError& error) {
      return error.what();
    }
    return "none";
  }

  testing::SmallTake take_;
  testing::TemporaryFolder folder_;
};

TEST_F(LiveStudio, KnowsWhoTriggersWhom) {
  const auto waits_for = [this](const std::string& first, const std::string& second) {
    const std::filesystem::path file = folder_.path() / "mocapd.toml";
    testing::WriteText(file,
                       "calibration = \"calibration.toml\"\n[source]\ndriver = \"aravis\"\n"
                       "[[cameras]]\nname = \"cam1\"\ndevice = \"a\"\n" +
                           first + "[[cameras]]\nname = \"cam2\"\ndevice = \"b\"\n" + second);
    return OpenStudio(LoadConfig(file)).cameras.at(1).waits_for;
  };
  EXPECT_EQ(waits_for("strobe = \"Line2\"\n", "trigger = \"Line1\"\n"), "cam1");
  EXPECT_EQ(waits_for("strobe = \"Line2\"\n", "trigger = \"software\"\n"), "");
  EXPECT_EQ(waits_for("", "trigger = \"Line1\"\n"), "") << "who knows what is on the line";
}

TEST_F(LiveStudio, TakesTheCamerasThatTheConfigurationNames) {
  const Studio studio = OpenStudio(Load("fps = 100\n"));
  ASSERT_EQ(studio.cameras.size(), 2u);
  EXPECT_EQ(studio.cameras[1].calibration.name, "cam2");
  EXPECT_EQ(studio.cameras[1].background().size(), 3u);
  EXPECT_NE(studio.cameras[1].driver, nullptr);
  EXPECT_EQ(studio.fps_nominal, 100);
}

TEST_F(LiveStudio, AsksForTheSizeThatIsCalibrated) {
  const std::vector<LiveCamera> cameras = OpenLiveCameras(Load("fps = 25\n"));
  EXPECT_EQ(cameras.at(0).request.width_px, take_.width_px);
  EXPECT_EQ(cameras.at(0).request.height_px, take_.height_px);
  EXPECT_EQ(cameras.at(0).request.fps, 50);
  EXPECT_EQ(cameras.at(1).request.fps, 25);
}

TEST_F(LiveStudio, CanBeLookedAtBeforeItIsCalibrated) {
  std::filesystem::remove(folder_.path() / "calibration.toml");
  const std::vector<LiveCamera> cameras = OpenLiveCameras(Load("size_px = [320, 240]\n"));
  EXPECT_EQ(cameras.at(0).request.width_px, 0);
  EXPECT_EQ(cameras.at(1).request.width_px, 320);
  EXPECT_THAT(Error(Load()), AllOf(HasSubstr("calibration.toml"), HasSubstr("mocap calibrate")));
}

TEST_F(LiveStudio, NamesACameraThatIsNotCalibrated) {
  EXPECT_THAT(Error(Load("", "cam9")), AllOf(HasSubstr("cameras.cam9"), HasSubstr("cam1, cam2")));
}

TEST_F(LiveStudio, NamesASizeThatIsNotTheCalibratedOne) {
  EXPECT_THAT(Error(Load("size_px = [640, 480]\n")),
              AllOf(HasSubstr("cam2"), HasSubstr("640 x 480"), HasSubstr("68 x 50")));
}

TEST_F(LiveStudio, SaysHowToLearnAMissingBackground) {
  std::filesystem::remove(folder_.path() / "background/cam2.mkv");
  EXPECT_THAT(Error(Load()), HasSubstr("cam2.mkv"));
  std::filesystem::remove_all(folder_.path() / "background");
  const std::string file = (folder_.path() / "mocapd.toml").string();
  EXPECT_THAT(Error(Load()), AllOf(HasSubstr(file + ": background is "),
                                   HasSubstr("mocap background learn --config FILE")));
  std::filesystem::remove(folder_.path() / "calibration.toml");
  EXPECT_THAT(Error(Load()), AllOf(HasSubstr(file + ": calibration is "),
                                   HasSubstr("which is not there; `mocap calibrate studio`")));
}

TEST_F(LiveStudio, HeadsAreCalibratedAndCalibratedHeadsAreThere) {
  EXPECT_THAT(Error(Load("head = \"v4l2\"\n")), HasSubstr("cameras.cam2.pan_tilt is missing"));
  std::filesystem::remove_all(folder_.path() / "take");
  take_.heads = true;
  testing::WriteSmallTake(folder_.path() / "take", take_);
  for (const char* part : {"calibration.toml", "background"}) {
    std::filesystem::remove_all(folder_.path() / part);
    std::filesystem::copy(folder_.path() / "take" / part, folder_.path() / part);
  }
  EXPECT_THAT(Error(Load()),
              AllOf(HasSubstr("cam1"), HasSubstr("head = \"v4l2\", \"uvc\" or \"fixed\"")));
  const std::string fixed = "head = \"fixed\"\npan_rad = 0.02\ntilt_rad = -0.1\n";
  testing::ReplaceInFile(folder_.path() / "mocapd.toml", "\"/dev/video0\"\n",
                         "\"/dev/video0\"\n" + fixed);
  EXPECT_THAT(Error(LoadConfig(folder_.path() / "mocapd.toml")), HasSubstr("cam2"));
  testing::ReplaceInFile(folder_.path() / "mocapd.toml", "\"/dev/video2\"\n",
                         "\"/dev/video2\"\nhead = \"v4l2\"\npan_range_rad = [-0.5, 1]\n");
  const Config config = LoadConfig(folder_.path() / "mocapd.toml");
  EXPECT_EQ(Error(config), "none");
  const std::vector<LiveCamera> cameras = OpenLiveCameras(config);
  EXPECT_EQ(cameras.at(0).head->At(0), (PanTiltAngles{0.02, -0.1}));
  EXPECT_EQ(cameras.at(1).range.most.pan_rad, 1);
  EXPECT_EQ(OpenStudio(config).person, nullptr);
  testing::ReplaceInFile(folder_.path() / "mocapd.toml", "pan_range_rad",
                         "follow = true\npan_range_rad");
  EXPECT_NE(OpenStudio(LoadConfig(folder_.path() / "mocapd.toml")).person, nullptr);
}

TEST_F(LiveStudio, HeadsOnUsbAreNamedByThemselves) {
  std::filesystem::remove(folder_.path() / "calibration.toml");
  const std::vector<LiveCamera> cameras =
      OpenLiveCameras(Load("head = \"uvc\"\nhead_device = \"1-2\"\n"));
  EXPECT_EQ(cameras.at(0).head, nullptr);
  EXPECT_NE(dynamic_cast<const UvcPanTilt*>(cameras.at(1).head), nullptr);
}

TEST_F(LiveStudio, HasNoCamerasWhereTheSourceIsNotLive) {
  EXPECT_THROW(OpenLiveCameras(Config()), SetupError);
}

}  // namespace
}  // namespace mocap
