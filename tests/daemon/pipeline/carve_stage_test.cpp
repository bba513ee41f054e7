#include "daemon/pipeline/carve_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "config/open_studio.h"
#include "tests/daemon/fake_studio.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;
using testing::FakeStudio;
using testing::kFakeHeight;
using testing::kFakePeriodNs;
using testing::kFakeWidth;
using testing::SteadyFrames;

constexpr int kCameras = 3;

SegmentedFrame EmptyFrame(const CameraCalibration& camera) {
  SegmentedFrame frame;
  frame.X_CW = camera.X_CW;
  for (Silhouette* const plane : {&frame.trimap.person, &frame.trimap.unknown})
    plane->Reset(kFakeWidth, kFakeHeight);
  frame.shading.dark.Reset(kFakeWidth, kFakeHeight);
  frame.shading.tile_columns = kFakeWidth / Shading::kTile_px;
  frame.shading.shades.assign(
      static_cast<std::size_t>(frame.shading.tile_columns * kFakeHeight / Shading::kTile_px), 0);
  return frame;
}

TEST(CarveStage, WhatIsWatchedLacksCamerasThatAreBlind) {
  const std::vector<CameraCalibration> cameras =
      CalibrationsOf(FakeStudio(std::vector<testing::FakeScript>(kCameras, SteadyFrames(1))));
  StageRecorders recorders;
  CarveStage stage(cameras, Synchronizer(kCameras, kFakePeriodNs, Synchronizer::kWaitForever), {},
                   kRaysPerPerson, recorders);
  Doorbell bell;
  SetTap tap;
  tap.Open(1, SeenSet(), bell);
  stage.Show(tap);
  for (int i = 0; i < kCameras; ++i) {
    SegmentedFrame frame = EmptyFrame(cameras[i]);
    frame.is_blind = i == 1;
    stage.Offer(i, frame);
  }
  CarvedSet set;
  ASSERT_EQ(stage.Next(set), Synchronizer::Decision::kSet);
  EXPECT_EQ(set.cameras, 0b101u);
  ASSERT_TRUE(tap.queue().TryPop());
  const SeenSet& seen = tap.queue().front();
  EXPECT_THAT(seen.cameras, ElementsAre(0, 2));
  EXPECT_EQ(seen.trimaps.size(), 2u);
  EXPECT_EQ(seen.hull.voxel_mm(), set.grid.voxel_mm());
  EXPECT_EQ(seen.X_CW.size(), 2u);
}

}  // namespace
}  // namespace mocap
