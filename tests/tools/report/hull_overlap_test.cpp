#include "tools/report/hull_overlap.h"

#include <gtest/gtest.h>

#include <limits>

namespace mocap {
namespace {

/// Looks along world z from the origin: world and camera frame are the same.
CameraCalibration Pinhole() {
  CameraCalibration camera;
  camera.width_px = 320;
  camera.height_px = 240;
  OpenCvLens lens;
  lens.K << 500, 0, 160, 0, 500, 120, 0, 0, 1;
  camera.lens = lens;
  return camera;
}

/// A cube of `count` voxels a side of 100 mm, its near face at z = 1 m, its corner on the axis.
VoxelGrid Cube(int count) {
  VoxelGrid grid;
  grid.Reset({0, 0, 10}, {count, count, count}, 100);
  for (int k = 0; k < count; ++k) {
    for (int j = 0; j < count; ++j) {
      for (int i = 0; i < count; ++i) grid.Set(i, j, k);
    }
  }
  return grid;
}

int Painted(const Image<std::uint8_t>& image) {
  return static_cast<int>(std::ranges::count(image.pixels(), 255));
}

TEST(ProjectVoxels, PaintsWhatAVoxelCovers) {
  // The near face reaches from (160, 120) to (210, 170); the far one lies behind it.
  const Image<std::uint8_t> painted = ProjectVoxels(Cube(1), Pinhole(), {});
  EXPECT_EQ(Painted(painted), 51 * 51);
  EXPECT_EQ(painted(160, 120), 255);
  EXPECT_EQ(painted(210, 170), 255);
  EXPECT_EQ(painted(159, 120), 0);
  EXPECT_EQ(painted(211, 170), 0);
}

TEST(ProjectVoxels, LeavesNoHolesWhereVoxelsHideEachOther) {
  EXPECT_EQ(Painted(ProjectVoxels(Cube(2), Pinhole(), {})), 101 * 101);
}

TEST(ProjectVoxels, FollowsTheCamera) {
  // Moved by 100 mm to the camera's left, 200 mm away from it.
  const RigidTransform X_CW = {Matrix3::Identity(), Vector3(-100, 0, 200)};
  const Image<std::uint8_t> painted = ProjectVoxels(Cube(1), Pinhole(), X_CW);
  EXPECT_EQ(painted(160 - 20, 140), 255);
  EXPECT_EQ(painted(160 + 20, 140), 0);
}

TEST(ProjectVoxels, LeavesOutWhatIsBehindTheCamera) {
  const RigidTransform X_CW = {Matrix3::Identity(), Vector3(0, 0, -5000)};
  EXPECT_EQ(Painted(ProjectVoxels(Cube(2), Pinhole(), X_CW)), 0);
}

TEST(Overlap, IsIntersectionOverUnion) {
  Image<std::uint8_t> painted(100, 10, 0);
  Silhouette silhouette(100, 10);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 60; ++x) painted(x, y) = 255;
    for (int x = 40; x < 100; ++x) silhouette.Set(x, y);
  }
  EXPECT_DOUBLE_EQ(OverlapOf(painted, silhouette), 0.2);
}

TEST(Overlap, OfTwoEmptyPicturesIsWhole) {
  EXPECT_DOUBLE_EQ(OverlapOf(Image<std::uint8_t>(8, 8, 0), Silhouette(8, 8)), 1);
}

TEST(CameraOverlap, LeavesOutFramesThatTheCameraMissed) {
  const CameraOverlap overlap{"cam1", {0.9, std::numeric_limits<double>::quiet_NaN(), 0.7}};
  EXPECT_EQ(overlap.frames(), 2);
  EXPECT_DOUBLE_EQ(overlap.mean(), 0.8);
  EXPECT_DOUBLE_EQ(overlap.lowest(), 0.7);
  EXPECT_EQ((CameraOverlap{"cam2", {std::numeric_limits<double>::quiet_NaN()}}.mean()), 0);
}

}  // namespace
}  // namespace mocap
