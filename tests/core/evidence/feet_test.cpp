#include "core/evidence/feet.h"

#include <gtest/gtest.h>

#include <optional>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "tests/support/voxelized_body.h"

namespace mocap {
namespace {

constexpr double kDegree = EIGEN_PI / 180;

class Feet : public ::testing::Test {
 protected:
  // Somebody with the soles at a height, turned about the vertical.
  PoseState Standing(double yaw_deg, double soles_mm) const {
    return Standing(yaw_deg, soles_mm, body_);
  }
  PoseState Standing(double yaw_deg, double soles_mm, const BodyModel& body) const {
    PoseState pose;
    pose.X_WT.R = ExpRotation(Vector3(0, 0, yaw_deg * kDegree));
    pose.theta = AnglesOf({}, body.table());
    pose.X_WT.p = Vector3(200, -100, 1000);
    const auto points_W = body.PointsAt(body.PostureAt(pose));
    pose.X_WT.p.z() += soles_mm - points_W.row(2).minCoeff();
    return pose;
  }
  std::optional<Vector3> ToesAt(const PoseState& pose) {
    VoxelCloud cloud;
    cloud.Build(Voxelize(body_, pose, 25));
    return finder_.ToesBeforeShins(cloud);
  }

  BodyModel body_{LoadBodyTable("full"), AverageSizes(1750)};
  FeetFinder finder_;
};

TEST_F(Feet, PointWhereThePersonFaces) {
  for (double yaw_deg = 0; yaw_deg < 360; yaw_deg += 40) {
    const PoseState pose = Standing(yaw_deg, 20);
    const std::optional<Vector3> toes_W = ToesAt(pose);
    ASSERT_TRUE(toes_W) << yaw_deg;
    EXPECT_GT(toes_W->normalized().dot(pose.X_WT.R.col(0)), 0.9) << yaw_deg;
    EXPECT_EQ(toes_W->z(), 0);
  }
}

TEST_F(Feet, SayNothingInTheAir) { EXPECT_FALSE(ToesAt(Standing(0, 300))); }

TEST_F(Feet, ABackpackChangesNothing) {
  const PoseState pose = Standing(30, 20);
  VoxelGrid grid = Voxelize(body_, pose, 25);
  const std::optional<Vector3> without_W = ToesAt(pose);
  const Vector3 pack_W = pose.X_WT.p - 150 * pose.X_WT.R.col(0);
  for (int k = 0; k < grid.size().z(); ++k)
    for (int j = 0; j < grid.size().y(); ++j)
      for (int i = 0; i < grid.size().x(); ++i)
        if ((grid.CenterOf(i, j, k) - pack_W).norm() < 200) grid.Set(i, j, k);
  VoxelCloud cloud;
  cloud.Build(grid);
  const std::optional<Vector3> with_W = finder_.ToesBeforeShins(cloud);
  ASSERT_TRUE(without_W && with_W);
  EXPECT_EQ(*without_W, *with_W);
}

// The hull between the legs and the chair of somebody who sits: it lies beside the feet and joins
// them. What is more than the feet of a child is less than those of an adult.
TEST_F(Feet, SayNothingWhereMoreThanFeetIsOnTheFloor) {
  for (const double stature_mm : {1150, 1750}) {
    const BodyModel body(body_.table(), AverageSizes(stature_mm));
    const double scale = stature_mm / 1750;
    const PoseState pose = Standing(0, 20, body);
    VoxelGrid grid = Voxelize(body, pose, 25);
    const Vector3 middle_W(pose.X_WT.p.x() - 100 * scale, pose.X_WT.p.y(), 0);
    for (int k = 0; k < grid.size().z(); ++k)
      for (int j = 0; j < grid.size().y(); ++j)
        for (int i = 0; i < grid.size().x(); ++i) {
          const Vector3 from_W = grid.CenterOf(i, j, k) - middle_W;
          if (from_W.head<2>().norm() < 150 * scale && from_W.z() < 200) grid.Set(i, j, k);
        }
    VoxelCloud cloud;
    cloud.Build(grid);
    EXPECT_FALSE(finder_.ToesBeforeShins(cloud)) << stature_mm;
  }
}

}  // namespace
}  // namespace mocap
