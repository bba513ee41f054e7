#include "config/read_nodes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/load_config.h"
#include "config/open_studio.h"
#include "core/errors.h"
#include "drivers/simulation/simulated_studio.h"
#include "drivers/take/calibration_file.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class RoleTest : public ::testing::Test {
 protected:
  Config Load(const std::string& text) {
    testing::WriteText(file_, text);
    return LoadConfig(file_);
  }
  std::string Error(const std::string& text) {
    try {
      OpenStudio(Load(text));
    } catch (const SetupError& error) {
      return error.what();
    }
    return "none";
  }
  /// calibration.toml with cam1 to cam3.
  void WriteCameras() {
    SimulatedStudioOptions options = RecordedSimulation();
    options.cameras = 3;
    WriteCalibration(folder_.path() / "calibration.toml",
                     CalibrationsOf(OpenSimulatedStudio(options)));
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "mocapd.toml";
};

const std::string kStudio = R"(role = "studio"
calibration = "calibration.toml"
[source]
driver = "none"
fps = 60
)";

TEST_F(RoleTest, IsAloneWithoutAWord) { EXPECT_EQ(Load("").role, Role::kAlone); }

TEST_F(RoleTest, ANodeHasAName) {
  const Config config = Load("role = \"node\"\n[node]\nname = \"left\"\ncameras = [\"cam2\"]\n");
  EXPECT_EQ(config.role, Role::kNode);
  EXPECT_EQ(config.node.name, "left");
  EXPECT_THAT(config.node.cameras, ElementsAre("cam2"));
  EXPECT_THAT(Error("role = \"node\"\n"), HasSubstr("node is missing"));
  EXPECT_THAT(Error("role = \"node\"\n[node]\nname = \"le ft\"\n"), HasSubstr("is \"le ft\""));
  EXPECT_THAT(Error("[node]\nname = \"left\"\n"), HasSubstr("needs role = \"node\""));
}

TEST_F(RoleTest, ANodeShowsTheCamerasItIsGiven) {
  const std::string node = "role = \"node\"\n[node]\nname = \"left\"\n";
  const Studio studio = OpenStudio(Load(node + "cameras = [\"cam3\", \"cam1\"]\n"));
  ASSERT_EQ(studio.cameras.size(), 2u);
  EXPECT_EQ(studio.cameras[0].calibration.name, "cam3");
  EXPECT_TRUE(studio.cameras[1].driver);
  EXPECT_THAT(Error(node + "cameras = [\"cam9\"]\n"), HasSubstr("node.cameras has \"cam9\""));
  EXPECT_THAT(Error(node + "cameras = [\"cam1\", \"cam1\"]\n"), HasSubstr("cam1"));
}

TEST_F(RoleTest, AStudioHasTheCamerasOfItsNodes) {
  WriteCameras();
  const Config config = Load(kStudio +
                             "[[nodes]]\nname = \"left\"\ncameras = [\"cam2\", \"cam1\"]\n"
                             "control = [\"ssh\", \"left\"]\n"
                             "[[nodes]]\nname = \"right\"\ncameras = [\"cam3\"]\n");
  EXPECT_THAT(config.nodes.at(0).control, ElementsAre("ssh", "left"));
  EXPECT_THAT(config.nodes.at(1).control, IsEmpty());
  const Studio studio = OpenStudio(config);
  EXPECT_EQ(studio.fps_nominal, 60);
  ASSERT_EQ(studio.cameras.size(), 3u);
  EXPECT_EQ(studio.cameras[0].calibration.name, "cam2");
  for (const StudioCamera& camera : studio.cameras) EXPECT_FALSE(camera.driver);
}

TEST_F(RoleTest, WhatAStudioCannotDoWithoutIsNamed) {
  WriteCameras();
  EXPECT_THAT(Error(kStudio), HasSubstr("nodes is missing"));
  EXPECT_THAT(Error(kStudio + "[[nodes]]\nname = \"left\"\ncameras = []\n"),
              HasSubstr("cameras is empty"));
  EXPECT_THAT(Error(kStudio + "[[nodes]]\nname = \"left\"\ncameras = [\"cam9\"]\n"),
              HasSubstr("cameras.cam9 is missing, but node left has it"));
  const std::string left = "[[nodes]]\nname = \"left\"\ncameras = [\"cam1\"]\n";
  EXPECT_THAT(Error(kStudio + left + left), HasSubstr("the name of another node"));
  EXPECT_THAT(Error(kStudio + left + "[[nodes]]\nname = \"right\"\ncameras = [\"cam1\"]\n"),
              HasSubstr("twice"));
  EXPECT_THAT(Error(left), HasSubstr("needs role = \"studio\""));
  EXPECT_THAT(Error("[source]\ndriver = \"none\"\n"), HasSubstr("only role \"studio\""));
}

}  // namespace
}  // namespace mocap
