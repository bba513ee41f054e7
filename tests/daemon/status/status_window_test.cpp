#include "daemon/status/status_window.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

TEST(StatusWindow, TellsWhatCameAboutLatelyAndHowFarBackThatGoes) {
  PipelineStatus status;
  status.cameras.resize(2);
  status.sets_complete = 100;
  StatusWindow window;
  EXPECT_EQ(window.Add(status, 0).window_ns, 0) << "nothing can be said yet";
  status.sets_complete += 10;
  status.sets_partial += 4;
  status.cameras[1].frames += 50;
  status.cameras[1].late += 20;
  const StatusReport report = window.Add(status, 2'000'000'000);
  EXPECT_EQ(report.window_ns, 2'000'000'000);
  EXPECT_EQ(report.sets_complete_lately, 10);
  EXPECT_EQ(report.sets_partial_lately, 4);
  EXPECT_DOUBLE_EQ(report.frames_per_second[1], 25);
  EXPECT_DOUBLE_EQ(report.late_per_second[1], 10);
  EXPECT_DOUBLE_EQ(report.late_per_second[0], 0);
}

// While it was lost it gave nothing, which says nothing of the rate that it has now.
TEST(StatusWindow, ACamerasRateIsSinceItCameBack) {
  PipelineStatus status;
  status.cameras.resize(1);
  CameraStatus& camera = status.cameras[0];
  StatusWindow window;
  camera.state = CameraState::kStreaming;
  window.Add(status, 0);
  camera.state = CameraState::kLost;
  window.Add(status, 1'000'000'000);
  camera.state = CameraState::kStreaming;
  camera.frames += 3;
  EXPECT_TRUE(window.Add(status, 2'000'000'000).returns[0]);
  camera.frames += 25;
  const StatusReport report = window.Add(status, 3'000'000'000);
  EXPECT_FALSE(report.returns[0]);
  EXPECT_DOUBLE_EQ(report.frames_per_second[0], 25);
}

}  // namespace
}  // namespace mocap
