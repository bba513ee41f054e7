#include "config/load_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/open_studio.h"
#include "core/errors.h"
#include "tests/support/small_take.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class ConfigFile : public ::testing::Test {
 protected:
  Config Load(const std::string& text) {
    testing::WriteText(file_, text);
    return LoadConfig(file_);
  }

  std::string Error(const std::string& text) {
    try {
      Load(text);
    } catch (const SetupError& error) {
      return error.what();
    }
    return "none";
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "mocapd.toml";
};

void ExpectSame(const Config& a, const Config& b) {
  EXPECT_EQ(a.calibration, b.calibration);
  EXPECT_EQ(a.source.driver, b.source.driver);
  EXPECT_EQ(a.source.take, b.source.take);
  EXPECT_EQ(a.source.rate, b.source.rate);
  EXPECT_EQ(a.source.loop, b.source.loop);
  EXPECT_EQ(a.source.in_memory, b.source.in_memory);
  EXPECT_EQ(a.source.motion, b.source.motion);
  EXPECT_EQ(a.source.people, b.source.people);
  EXPECT_EQ(a.source.stature_mm, b.source.stature_mm);
  EXPECT_EQ(a.source.cameras, b.source.cameras);
  EXPECT_EQ(a.source.width_px, b.source.width_px);
  EXPECT_EQ(a.source.height_px, b.source.height_px);
  EXPECT_EQ(a.source.fps, b.source.fps);
  EXPECT_EQ(a.source.seed, b.source.seed);
  EXPECT_EQ(a.voxel_mm, b.voxel_mm);
  EXPECT_EQ(a.segmentation.detection_rate, b.segmentation.detection_rate);
  EXPECT_EQ(a.segmentation.smallest_blob_share, b.segmentation.smallest_blob_share);
  EXPECT_EQ(a.tracker, b.tracker);
  EXPECT_EQ(a.body, b.body);
  EXPECT_EQ(a.people, b.people);
  EXPECT_EQ(a.lcm.url, b.lcm.url);
  EXPECT_EQ(a.lcm.prefix, b.lcm.prefix);
  EXPECT_EQ(a.lcm.voxels_hz, b.lcm.voxels_hz);
  EXPECT_EQ(a.cameras.size(), b.cameras.size());
}

TEST_F(ConfigFile, EmptyOneGivesTheDefaults) { ExpectSame(Load(""), Config{}); }

TEST_F(ConfigFile, DocumentedExampleSaysTheDefaults) {
  ExpectSame(LoadConfig(std::filesystem::path(MOCAP_SOURCE_DIR) / "config/mocapd.toml"), Config{});
}

TEST_F(ConfigFile, KeysOfTheContractAreRead) {
  const Config config = Load(R"(calibration = "calibration.toml"
[source]
driver = "take"
take = "../takes/walk"
rate = "fast"
loop = true
in_memory = true
[voxels]
size_mm = 50
[people]
most = 4
[lcm]
url = "udpm://239.255.76.67:7700?ttl=1"
prefix = "STAGE_"
[[cameras]]
name = "cam1"
device = "/dev/v4l/by-id/x"
[[cameras]]
name = "cam2"
device = "192.168.0.7"
)");
  EXPECT_EQ(config.calibration, folder_.path() / "calibration.toml");
  EXPECT_EQ(config.source.take, folder_.path().parent_path() / "takes/walk");
  EXPECT_EQ(config.source.rate, ReplayRate::kFast);
  EXPECT_TRUE(config.source.loop);
  EXPECT_TRUE(config.source.in_memory);
  EXPECT_EQ(config.voxel_mm, 50);
  EXPECT_EQ(config.people, 4);
  EXPECT_EQ(config.lcm.url, "udpm://239.255.76.67:7700?ttl=1");
  EXPECT_EQ(config.lcm.prefix, "STAGE_");
  EXPECT_EQ(config.background, folder_.path() / "background");
  ASSERT_EQ(config.cameras.size(), 2u);
  EXPECT_EQ(config.cameras[1].name, "cam2");
  EXPECT_EQ(config.cameras[1].device, "192.168.0.7");
}

TEST_F(ConfigFile, FoldersMayEndWithASlash) {
  EXPECT_EQ(Load("background = \"bg/\"").background, folder_.path() / "bg");
  EXPECT_EQ(Load("background = \"./a/../bg//\"").background, folder_.path() / "bg");
  EXPECT_EQ(Load("background = \"/var/bg/\"").background, "/var/bg");
  EXPECT_EQ(Load("[recording]\nfolder = \"takes/\"").service.recording.folder,
            folder_.path() / "takes");
}

TEST_F(ConfigFile, OnlyPathsAreMadeRelativeToTheFile) {
  EXPECT_EQ(Load("body = \"mikic2003\"").body, "mikic2003");
  EXPECT_EQ(Load("body = \"child.toml\"").body, (folder_.path() / "child.toml").string());
  EXPECT_EQ(Load("[body]\ntable = \"child.toml\"").body, (folder_.path() / "child.toml").string());
  EXPECT_EQ(Load("calibration = \"/etc/calibration.toml\"").calibration, "/etc/calibration.toml");
}

struct WrongConfig {
  const char* text;
  int line;
  const char* says;
};

TEST_F(ConfigFile, MistakesAreNamedWithFileLineAndKey) {
  const WrongConfig cases[] = {
      {"[source\n", 1, "not TOML"},
      {"body = 3\n", 1, "body is 3"},
      {"[body]\ntracker = \"deep\"\n", 2, "body.tracker is \"deep\""},
      {"bodies = \"full\"\n", 1, "bodies is unknown"},
      {"source = 1\n", 1, "source is 1"},
      {"[source]\ndriver = \"webcam\"\n", 2, "source.driver is \"webcam\""},
      {"[source]\nrate = \"slow\"\n", 2, "source.rate is \"slow\""},
      {"[source]\nloop = 1\n", 2, "source.loop is 1"},
      {"[source]\nspeed = 2\n", 2, "source.speed is unknown"},
      {"[source]\ndriver = \"take\"\n", 1, "source.take is missing"},
      {"[source]\nseed = -1\n", 2, "source.seed is -1"},
      {"[source]\ncameras = 2.5\n", 2, "source.cameras is 2.5"},
      {"[source]\nwidth = 8\n", 2, "source.width is 8"},
      {"[source]\nheight = 9000\n", 2, "source.height is 9000"},
      {"[source]\nfps = 0\n", 2, "source.fps is 0"},
      {"[source]\nfps = -0.0\n", 2, "source.fps is 0;"},
      {"[source]\nwidth = 1000000000\n", 2,
       "source.width is 1000000000; expected a whole number from 16"},
      {"[recording]\nbuffer_mb = 1e300\n", 2, "recording.buffer_mb is 1e+300"},
      {"\"x\\u001b]0;owned\\u0007\" = 1\n", 1, "x\\x1b]0;owned\\x07 is unknown"},
      {"[source]\nstature_mm = 1.75\n", 2, "source.stature_mm is 1.75"},
      {"[source]\npeople = 5\n", 2, "source.people is 5"},
      {"[source]\nstature_mm = 990\n", 2, "source.stature_mm is 990"},
      {"[people]\nmost = 9\n", 2, "people.most is 9; expected a whole number from 1 to 8"},
      {"[people]\nmost = 0\n", 2, "people.most is 0"},
      {"[voxels]\nsize_mm = 9.9\n", 2, "voxels.size_mm is 9.9"},
      {"[voxels]\nsize_mm = 101\n", 2, "voxels.size_mm is 101"},
      {"[voxels]\nsize_mm = inf\n", 2, "voxels.size_mm"},
      {"[voxels]\nsize_mm = \"25\"\n", 2, "voxels.size_mm"},
      {"[voxels]\nsize = 25\n", 2, "voxels.size is unknown"},
      {"[segmentation]\ndetection_rate = 1\n", 2, "segmentation.detection_rate is 1"},
      {"[segmentation]\nsmallest_blob_share = -0.1\n", 2, "segmentation.smallest_blob_share"},
      {"[lcm]\nurl = \"\"\n", 2, "lcm.url is empty"},
      {"[lcm]\nprefix = \"0123456789012345678901234567890123456789\"\n", 2, "lcm.prefix"},
      {"[lcm]\nvoxels_hz = -1\n", 2, "lcm.voxels_hz is -1"},
      {"[cameras]\nname = \"cam1\"\n", 1, "cameras is a table"},
      {"[[cameras]]\nname = \"cam1\"\n", 1, "cameras[0].device is missing"},
      {"[[cameras]]\nname = \"a b\"\ndevice = \"x\"\n", 2, "cameras[0].name"},
      {"[[cameras]]\nname = \"a\"\ndevice = \"x\"\n[[cameras]]\nname = \"a\"\ndevice = \"y\"\n", 5,
       "cameras[1].name"},
      {"[[cameras]]\nname = \"a\"\ndevice = \"x\"\n[[cameras]]\nname = \"b\"\ndevice = \"x\"\n", 6,
       "cameras[1].device"},
  };
  for (const WrongConfig& wrong : cases) {
    const std::string where = file_.string() + ":" + std::to_string(wrong.line) + ": ";
    EXPECT_THAT(Error(wrong.text),
                AllOf(HasSubstr(where), HasSubstr(wrong.says), Not(HasSubstr("\n"))))
        << wrong.text;
  }
}

TEST_F(ConfigFile, AMisspeltNameIsToldWithTheOneThatItResembles) {
  const WrongConfig cases[] = {
      {"[source]\nfsp = 3\n", 2, "source.fsp is unknown; did you mean fps? Known here: cameras,"},
      {"[soruce]\nfps = 3\n", 1, "soruce is unknown; did you mean source? Known here: background,"},
      {"[voxels]\nsize = 25\n", 2, "did you mean size_mm? Known here: size_mm"},
      {"[lcm]\nprefxi = \"a\"\n", 2, "did you mean prefix? Known here: prefix, url, voxels_hz"},
      {"[recording]\nbufer_mb = 64\n", 2, "did you mean buffer_mb?"},
      {"[realtime]\nlock_memroy = true\n", 2, "did you mean lock_memory?"},
      {"[control]\nsoket = \"s\"\n", 2, "did you mean socket?"},
      {"[source]\ndriver = \"take\"\ntkae = \"t\"\n", 3, "did you mean take?"},
      {"role = \"studio\"\ncalibraton = \"c\"\n[[nodes]]\nname = \"n\"\ncameras = [\"a\"]\n", 2,
       "did you mean calibration?"},
      {"[source]\ndriver = \"simulatd\"\n", 2,
       "is \"simulatd\"; did you mean simulated? Expected \"take\" or"},
      {"[recording]\ncodec = \"fvv1\"\n", 2, "did you mean ffv1?"},
      {"[source]\nmotion = \"wlak\"\n", 2, "source.motion is \"wlak\"; did you mean walk?"},
      {"[body]\ntracker = \"surfcae\"\n", 2, "did you mean surface?"},
      {"[lcm]\nurl = \"udpm://239.255.76.67:7667?tll=1\"\n", 2, "did you mean ttl?"},
      {"[[cameras]]\nnmae = \"a\"\ndevice = \"b\"\n", 1, "there is nmae: did you mean name?"},
  };
  for (const WrongConfig& wrong : cases) {
    EXPECT_THAT(Error(wrong.text),
                AllOf(HasSubstr(":" + std::to_string(wrong.line) + ": "), HasSubstr(wrong.says)))
        << wrong.text;
  }
}

TEST_F(ConfigFile, PacketsHaveASizeThatNetworksCarry) {
  EXPECT_THAT(Error("[[cameras]]\nname = \"a\"\npacket_bytes = 100\ndevice = \"x\"\n"
                    "[source]\ndriver = \"aravis\"\n"),
              HasSubstr(":3: cameras[0].packet_bytes is 100"));
}

TEST_F(ConfigFile, LiveStudioNeedsCamerasAndCalibration) {
  const std::string source = "[source]\ndriver = \"v4l2\"\n";
  const std::string camera = "[[cameras]]\nname = \"a\"\ndevice = \"x\"\n";
  EXPECT_THAT(Error("calibration = \"c.toml\"\n" + source), HasSubstr("cameras is missing"));
  EXPECT_THAT(Error(source + camera), HasSubstr("calibration is missing"));
  EXPECT_EQ(Error("calibration = \"c.toml\"\n" + source + camera), "none");
}

TEST_F(ConfigFile, SettingsOfV4l2CamerasAreRead) {
  const Config config = Load(R"(calibration = "c.toml"
background = "empty"
[source]
driver = "v4l2"
fps = 60
[[cameras]]
name = "cam1"
device = "/dev/video0"
format = "MJPG"
fps = 25
size_px = [1280, 720]
exposure_us = 8000
gain = 3
white_balance_k = 4600
focus = 20
power_line_hz = 50
[[cameras]]
name = "cam2"
device = "/dev/video2"
)");
  EXPECT_EQ(config.background, folder_.path() / "empty");
  EXPECT_EQ(config.source.fps, 60);
  const CameraConfig& camera = config.cameras.at(0);
  EXPECT_EQ(camera.fps, 25);
  EXPECT_EQ(camera.size_px, (std::array<int, 2>{1280, 720}));
  EXPECT_EQ(camera.v4l2.format, "MJPG");
  EXPECT_EQ(camera.v4l2.exposure_us, 8000);
  EXPECT_EQ(camera.v4l2.gain, 3);
  EXPECT_EQ(camera.v4l2.white_balance_k, 4600);
  EXPECT_EQ(camera.v4l2.focus, 20);
  EXPECT_EQ(camera.v4l2.power_line_hz, 50);
  EXPECT_EQ(config.cameras.at(1).fps, std::nullopt);
  EXPECT_EQ(config.cameras.at(1).v4l2.exposure_us, std::nullopt);
}

TEST_F(ConfigFile, MistakesInACamerasSettingsAreNamed) {
  const WrongConfig cases[] = {
      {"head = \"motor\"", 3, "cameras[0].head is \"motor\""},
      {"head = \"uvc\"", 1, "cameras[0].head_device is missing"},
      {"exposure_us = 0", 3, "cameras[0].exposure_us is 0"},
      {"power_line_hz = 55", 3, "cameras[0].power_line_hz is 55"},
      {"size_px = [640.5, 480]", 3, "cameras[0].size_px"},
      {"fps = 0", 3, "cameras[0].fps is 0"},
      {"exposure = 5", 3, "cameras[0].exposure is unknown"},
      {"packet_bytes = 1500", 3, "cameras[0].packet_bytes needs source.driver = \"aravis\""},
      {"triger = \"ptp\"", 3, "cameras[0].triger is unknown; did you mean trigger?"},
      {"gian = 2", 3, "cameras[0].gian is unknown; did you mean gain? Known here: device,"},
      {"pan_rad = 1", 3, "cameras[0].pan_rad needs head = \"fixed\""},
      {"head_devcie = \"x\"", 3, "did you mean head_device?"},
  };
  for (const WrongConfig& wrong : cases) {
    const std::string text = "[[cameras]]\nname = \"a\"\n" + std::string(wrong.text) +
                             "\ndevice = \"x\"\n[source]\ndriver = \"v4l2\"\n";
    EXPECT_THAT(Error(text),
                AllOf(HasSubstr(":" + std::to_string(wrong.line) + ": "), HasSubstr(wrong.says)))
        << wrong.text;
  }
}

TEST_F(ConfigFile, FormatsHaveTheNamesOfTheirDriver) {
  const auto with = [](const std::string& driver, const std::string& format) {
    return "calibration = \"c.toml\"\n[source]\ndriver = \"" + driver +
           "\"\n[[cameras]]\nname = \"a\"\ndevice = \"x\"\nformat = \"" + format + "\"\n";
  };
  EXPECT_THAT(Error(with("v4l2", "BayerRG8")), HasSubstr("cameras[0].format"));
  EXPECT_EQ(Error(with("aravis", "BayerRG8")), "none");
}

TEST_F(ConfigFile, SettingsOfAravisCamerasAreRead) {
  const Config config = Load(R"(calibration = "c.toml"
[source]
driver = "aravis"
[[cameras]]
name = "cam1"
device = "192.168.1.11"
format = "BayerRG8"
exposure_us = 8000
gain = 3
trigger = "Line1"
strobe = "Line2"
ptp = false
packet_bytes = 9000
packet_delay_us = 12.5
packet_socket = false
[[cameras]]
name = "cam2"
device = "192.168.1.12"
)");
  const AravisSettings& settings = config.cameras.at(0).aravis;
  EXPECT_EQ(settings.format, "BayerRG8");
  EXPECT_EQ(settings.exposure_us, 8000);
  EXPECT_EQ(settings.gain, 3);
  EXPECT_EQ(settings.trigger, "Line1");
  EXPECT_EQ(settings.strobe, "Line2");
  EXPECT_FALSE(settings.ptp);
  EXPECT_EQ(settings.packet_bytes, 9000);
  EXPECT_EQ(settings.packet_delay_us, 12.5);
  EXPECT_EQ(settings.packet_socket, false);
  EXPECT_TRUE(config.cameras.at(1).aravis.ptp);
  EXPECT_EQ(config.cameras.at(1).aravis.packet_socket, std::nullopt);
}

TEST_F(ConfigFile, TriggersThatCannotBeAreRefused) {
  const auto with = [](const std::string& settings) {
    return "calibration = \"c.toml\"\n[source]\ndriver = \"aravis\"\n[[cameras]]\nname = \"a\"\n"
           "device = \"x\"\n" +
           settings;
  };
  EXPECT_THAT(Error(with("trigger = \"ptp\"\nptp = false\n")), HasSubstr("cameras[0].ptp"));
  EXPECT_THAT(Error(with("trigger = \"Line1\"\nstrobe = \"Line1\"\n")),
              HasSubstr("cameras[0].strobe"));
}

TEST_F(ConfigFile, MissingFileIsNamed) {
  EXPECT_THROW(LoadConfig(folder_.path() / "absent.toml"), SetupError);
}

TEST_F(ConfigFile, OpensTheTakeThatItNames) {
  testing::WriteSmallTake(folder_.path() / "take");
  Studio studio =
      OpenStudio(Load("[source]\ndriver = \"take\"\ntake = \"take\"\nrate = \"fast\"\n"));
  EXPECT_EQ(studio.name, "small");
  EXPECT_EQ(studio.cameras.size(), 3u);
}

}  // namespace
}  // namespace mocap
