#include "config/room_limits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "core/errors.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Four cameras in the corners of a room, that look at the middle of its floor.
std::vector<CameraCalibration> Corners(double half_mm, double height_mm) {
  std::vector<CameraCalibration> cameras;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const Vector3 center(x * half_mm, y * half_mm, height_mm);
      const Vector3 forward = -center.stableNormalized();
      const Vector3 right = forward.cross(Vector3::UnitZ()).normalized();
      Matrix3 R;
      R << right.transpose(), forward.cross(right).transpose(), forward.transpose();
      cameras.emplace_back().X_CW = {R, -(R * center)};
    }
  }
  return cameras;
}

std::string Error(const std::vector<CameraCalibration>& cameras, double voxel_mm) {
  try {
    RequireRoom(cameras, voxel_mm, "calibration.toml");
  } catch (const SetupError& error) {
    return error.what();
  }
  return "none";
}

TEST(RoomLimits, StudiosAndHallsPass) {
  EXPECT_EQ(Error(Corners(2500, 2500), 10), "none");
  EXPECT_EQ(Error(Corners(10'000, 5000), 25), "none");
  EXPECT_EQ(Error({Corners(2500, 2500)[0]}, 25), "none") << "one camera alone";
}

TEST(RoomLimits, ACalibrationInOtherUnitsIsToldByItsSize) {
  EXPECT_THAT(Error(Corners(2.5, 2.5), 25),
              AllOf(StartsWith("calibration.toml: "), HasSubstr("within 7.07 mm"),
                    HasSubstr("millimetres, not metres")));
  EXPECT_THAT(Error(Corners(2.5e6, 2.5e6), 25),
              AllOf(HasSubstr("a room of 5002 x 5002 x"), HasSubstr("from lengths in millimetres")));
  EXPECT_THAT(Error(Corners(1e150, 1e150), 25), HasSubstr("millimetres"));
}

TEST(RoomLimits, MoreVoxelsThanMemoryHoldsAreRefusedWithTheSizeThatFits) {
  EXPECT_THAT(Error(Corners(40'000, 9000), 10),
              AllOf(HasSubstr("82 x 82 x"), HasSubstr("voxels of 10 mm"),
                    HasSubstr("mm or more, or a calibration")));
  EXPECT_EQ(Error(Corners(40'000, 9000), 50), "none");
}

TEST(RoomLimits, CamerasThatSeeNoFloorAreTold) {
  std::vector<CameraCalibration> cameras = Corners(2500, 2500);
  for (CameraCalibration& camera : cameras) camera.X_CW.p += camera.X_CW.R * Vector3(0, 0, 20e3);
  EXPECT_THAT(Error(cameras, 25), HasSubstr("nothing above the floor"));
}

}  // namespace
}  // namespace mocap
