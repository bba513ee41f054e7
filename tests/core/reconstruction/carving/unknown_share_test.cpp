#include "core/reconstruction/carving/unknown_share.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

/// Looks along world z from the origin, at a row of four voxels 1 m away.
class UnknownShareTest : public ::testing::Test {
 protected:
  UnknownShareTest() {
    hull_.Reset({0, 0, 10}, {4, 1, 1}, 100);
    for (int i = 0; i < 4; ++i) hull_.Set(i, 0, 0);
  }
  static CameraCalibration Pinhole() {
    CameraCalibration camera;
    camera.width_px = 320;
    camera.height_px = 240;
    OpenCvLens lens;
    lens.K << 210, 0, 10, 0, 210, 120, 0, 0, 1;
    camera.lens = lens;
    return camera;
  }
  /// Sets the pixels that show a voxel.
  static void Show(int voxel, Silhouette& picture) {
    for (int y = 120; y < 140; ++y) {
      for (int x = 0; x < 20; ++x) picture.Set(10 + 20 * voxel + x, y);
    }
  }
  std::optional<double> Share() const {
    return UnknownShare(hull_, {&table_, &person_, X_CW_, &unknown_});
  }

  VoxelGrid hull_;
  const SensorPlaneTable table_{Pinhole()};
  Silhouette person_{320, 240}, unknown_{320, 240};
  RigidTransform X_CW_;
};

TEST_F(UnknownShareTest, CountsTheVoxelsAtUnknownPixels) {
  for (const int voxel : {0, 1, 2}) Show(voxel, person_);
  EXPECT_EQ(Share(), 0.0);
  Show(3, unknown_);
  EXPECT_EQ(Share(), 0.25);
}

TEST_F(UnknownShareTest, LeavesOutWhatTheCameraCallsEmpty) {
  Show(0, person_);
  Show(1, unknown_);
  EXPECT_EQ(Share(), 0.5);
}

TEST_F(UnknownShareTest, KnowsNothingOfPeopleWhomTheCameraDoesNotShow) {
  EXPECT_EQ(Share(), std::nullopt) << "nobody in the picture";
  Show(0, person_);
  X_CW_.p = Vector3(0, 0, -5000);
  EXPECT_EQ(Share(), std::nullopt) << "behind the camera";
}

TEST_F(UnknownShareTest, ACameraWithoutUnknownPixelsKnowsAll) {
  Show(0, person_);
  EXPECT_EQ(UnknownShare(hull_, {&table_, &person_, X_CW_}), 0.0);
  const Silhouette without_size;
  EXPECT_EQ(UnknownShare(hull_, {&table_, &person_, X_CW_, &without_size}), 0.0);
}

}  // namespace
}  // namespace mocap
