#include "daemon/status/camera_diagnostics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mocap {
namespace {

using ::testing::ElementsAre;
using ::testing::StartsWith;

/// Three cameras at 25 frames a second, as it should be.
ServiceReport GoodOfThree() {
  ServiceReport report;
  report.fps_nominal = 25;
  report.now.sets_per_second = 25;
  for (const char* name : {"cam1", "cam2", "cam3"}) {
    CameraStatus& camera = report.now.status.cameras.emplace_back();
    camera.name = name;
    camera.state = CameraState::kStreaming;
    report.now.frames_per_second.push_back(25);
  }
  return report;
}

/// What is said if each camera has this fault.
std::vector<std::string> ToldOfAll(void (*damage)(CameraStatus& camera)) {
  ServiceReport report = GoodOfThree();
  for (CameraStatus& camera : report.now.status.cameras) damage(camera);
  return CameraDiagnostics(report);
}

TEST(CameraDiagnostics, OneLineNamesTheCamerasThatASlowComputerSlowsDown) {
  ServiceReport report = GoodOfThree();
  EXPECT_THAT(CameraDiagnostics(report), ::testing::IsEmpty());
  report.now.frames_per_second = {12.4, 12, 25};
  EXPECT_THAT(CameraDiagnostics(report),
              ElementsAre(StartsWith("cam1, cam2 deliver 12.0 to 12.4 of 25.0 frames a second: "
                                     "check the processor's load")));
  report.now.frames_per_second = {12, 12, 12};
  EXPECT_THAT(CameraDiagnostics(report),
              ElementsAre(StartsWith("all 3 cameras deliver 12.0 of 25.0 frames a second: ")));
  report.camera_fps = {0, 0, 15};
  EXPECT_THAT(CameraDiagnostics(report),
              ElementsAre(StartsWith("cam3 delivers 12.0 of 15.0 frames a second: "),
                          StartsWith("cam1, cam2 deliver 12.0 of 25.0 frames a second: ")))
      << "of other rates";
}

TEST(CameraDiagnostics, OneLineNamesTheCamerasWithTheSameFault) {
  EXPECT_THAT(ToldOfAll([](CameraStatus& camera) { camera.state = CameraState::kLost; }),
              ElementsAre("all 3 cameras are lost: check their cables and power"));
  EXPECT_THAT(ToldOfAll([](CameraStatus& camera) { camera.state = CameraState::kStarting; }),
              ElementsAre("all 3 cameras have not delivered a frame yet"));
  EXPECT_THAT(ToldOfAll([](CameraStatus& camera) { camera.is_blind = true; }),
              ElementsAre(StartsWith("all 3 cameras no longer match their backgrounds")));
  EXPECT_THAT(ToldOfAll([](CameraStatus& camera) { camera.light = 0.4; }),
              ElementsAre(StartsWith("the pictures of all 3 cameras have 40 % of the brightness of "
                                     "their backgrounds: restore the light")));
}

// From 10 % on.
void ExpectThatTheSecondIsNamed(std::optional<double> CameraHealth::*share, double high,
                                const char* line) {
  ServiceReport report = GoodOfThree();
  report.now.status.cameras[0].health.*share = 0.09;
  report.now.status.cameras[1].health.*share = high;
  EXPECT_THAT(CameraDiagnostics(report), ElementsAre(StartsWith(line)));
  report.now.status.cameras[1].health.*share = 0.09;
  EXPECT_THAT(CameraDiagnostics(report), ::testing::IsEmpty());
}

TEST(CameraDiagnostics, NamesCamerasBeforeWhichClothesLookLikeTheWall) {
  ExpectThatTheSecondIsNamed(&CameraHealth::unknown_share, 0.4,
                             "cam2 cannot tell 40 % of the people");
}

TEST(CameraDiagnostics, NamesCamerasThatMissPeople) {
  ExpectThatTheSecondIsNamed(&CameraHealth::miss_rate, 0.25,
                             "cam2 misses 25 % of the people whom the others show");
}

}  // namespace
}  // namespace mocap
