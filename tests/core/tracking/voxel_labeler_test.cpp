#include "core/tracking/voxel_labeler.h"

#include <gtest/gtest.h>

#include <tuple>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "tests/support/voxelized_body.h"

namespace mocap {
namespace {

constexpr double kVoxelMm = 20;

class Labeler : public testing::Test {
 protected:
  PoseState PoseOf(const Stance& stance) const {
    PoseState pose;
    pose.X_WT.p = Vector3(300, -200, 1100);
    pose.theta = AnglesOf(stance, body_.table());
    return pose;
  }
  BodyPoints PointsAt(const PoseState& pose) const { return body_.PointsAt(body_.PostureAt(pose)); }
  // Empties what lies near a point.
  static void CutOff(VoxelGrid& grid, const Vector3& p_W, double radius_mm) {
    for (int k = 0; k < grid.size().z(); ++k) {
      for (int j = 0; j < grid.size().y(); ++j) {
        for (int i = 0; i < grid.size().x(); ++i) {
          if ((grid.CenterOf(i, j, k) - p_W).norm() < radius_mm) grid.Clear(i, j, k);
        }
      }
    }
  }
  const LabeledVoxels& Label(const VoxelGrid& grid, const PoseState& pose) {
    cloud_.Build(grid);
    return labeler_.Label(cloud_, body_, pose);
  }
  int LabelAt(const LabeledVoxels& labeled, const Vector3& p_W) const {
    const int index = cloud_.IndexAt(p_W);
    return index < 0 ? LabeledVoxels::kNone : labeled.part[index];
  }

  BodyModel body_{LoadBodyTable("mikic2003"), AverageSizes(1750)};
  VoxelCloud cloud_;
  VoxelLabeler labeler_;
};

TEST_F(Labeler, MeasuresAllPointsOfABodyNearThem) {
  const ArmStance out{.raise = 0};
  const PoseState pose = PoseOf({.arm_l = out, .arm_r = out});
  const LabeledVoxels& labeled = Label(Voxelize(body_, pose, kVoxelMm), pose);
  const BodyPoints points_W = PointsAt(pose);
  for (int i = 0; i < kPointCount; ++i) {
    ASSERT_TRUE(labeled.points_W[i]) << kPointNames[i];
    // A foot's flesh ends at the toes, the point is below the ankle.
    const bool is_foot =
        i == static_cast<int>(Point::kFootL) || i == static_cast<int>(Point::kFootR);
    EXPECT_LT((*labeled.points_W[i] - points_W.col(i)).norm(), is_foot ? 120 : 80)
        << kPointNames[i];
  }
}

TEST_F(Labeler, GivesAHandBesideTheThighToTheArm) {
  const ArmStance hanging{.raise = -85, .elbow = 5};
  const PoseState pose = PoseOf({.arm_l = hanging, .arm_r = hanging});
  const LabeledVoxels& labeled = Label(Voxelize(body_, pose, kVoxelMm), pose);
  const BodyPoints points_W = PointsAt(pose);
  for (const auto& [elbow, tips, part] :
       {std::tuple{Point::kElbowL, Point::kFingertipsL, BodyPart::kLowerArmL},
        std::tuple{Point::kElbowR, Point::kFingertipsR, BodyPart::kLowerArmR}}) {
    const Vector3 hand_W =
        0.15 * points_W.col(static_cast<int>(elbow)) + 0.85 * points_W.col(static_cast<int>(tips));
    EXPECT_EQ(LabelAt(labeled, hand_W), static_cast<int>(part));
  }
}

TEST_F(Labeler, TellsACalfFromTheThighThatItIsFoldedUnder) {
  const LegStance kneeling{.hip = 20, .knee = 125};
  const PoseState pose = PoseOf({.leg_l = kneeling, .leg_r = kneeling});
  const LabeledVoxels& labeled = Label(Voxelize(body_, pose, kVoxelMm), pose);
  const BodyPoints points_W = PointsAt(pose);
  EXPECT_EQ(LabelAt(labeled, points_W.col(static_cast<int>(Point::kCalfL))),
            static_cast<int>(BodyPart::kCalfL));
  EXPECT_TRUE(labeled.points_W[static_cast<int>(Point::kFootL)]);
}

TEST_F(Labeler, InventsNoHandThatWasNotSeen) {
  const ArmStance out{.raise = 0};
  const PoseState pose = PoseOf({.arm_l = out, .arm_r = out});
  VoxelGrid grid = Voxelize(body_, pose, kVoxelMm);
  const Vector3 lower_arm_W = PointsAt(pose).col(static_cast<int>(Point::kLowerArmL));
  CutOff(grid, lower_arm_W, 0.55 * body_.sizes().lower_arm);
  const LabeledVoxels& labeled = Label(grid, pose);
  EXPECT_FALSE(labeled.points_W[static_cast<int>(Point::kFingertipsL)]);
  EXPECT_FALSE(labeled.points_W[static_cast<int>(Point::kLowerArmL)]);
  EXPECT_TRUE(labeled.points_W[static_cast<int>(Point::kFingertipsR)]);
}

TEST_F(Labeler, MeasuresTheRestOfABodyWhoseHeadWasNotSeen) {
  const ArmStance out{.raise = 0};
  const PoseState pose = PoseOf({.arm_l = out, .arm_r = out});
  VoxelGrid grid = Voxelize(body_, pose, kVoxelMm);
  CutOff(grid, PointsAt(pose).col(static_cast<int>(Point::kHead)), 1.2 * body_.sizes().head / 2);
  const LabeledVoxels& labeled = Label(grid, pose);
  EXPECT_FALSE(labeled.points_W[static_cast<int>(Point::kHead)]);
  EXPECT_FALSE(labeled.points_W[static_cast<int>(Point::kNeck)]);
  EXPECT_TRUE(labeled.points_W[static_cast<int>(Point::kTorso)]);
  EXPECT_TRUE(labeled.points_W[static_cast<int>(Point::kFootR)]);
}

}  // namespace
}  // namespace mocap
