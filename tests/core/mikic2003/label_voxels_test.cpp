#include "core/mikic2003/label_voxels.h"

#include <gtest/gtest.h>

#include "tests/core/mikic2003/paper_person.h"

namespace mocap::mikic2003 {
namespace {

std::optional<LabeledFrame> LabelVoxels(const VoxelCloud& cloud, const BodyModel& body,
                                        const PoseState& predicted) {
  const auto trunk = LabelTrunk(cloud, body, predicted);
  if (!trunk) return std::nullopt;
  return LabelLimbs(cloud, body, *trunk, predicted);
}

class Figure8 : public ::testing::Test {
 protected:
  /// The share of the limbs' voxels whose label is that of the nearest part's axis.
  double ShareRight(const VoxelCloud& cloud, const PoseState& truth, const Labels& labels) const {
    int voxels = 0, right = 0;
    for (int i = 0; i < cloud.size(); ++i) {
      double nearest_mm = 60;
      std::int8_t label = kUnlabeled;
      const auto consider = [&](BodyPart part, Point from, Point to) {
        const PosedCapsule axis(person_.Place(truth, from), person_.Place(truth, to), 0, 0);
        const double distance_mm = axis.DistanceTo(cloud.voxels()[i].center_W).outside_mm;
        if (distance_mm < nearest_mm) nearest_mm = distance_mm, label = LabelOf(part);
      };
      for (const Limb& limb : kLimbs) {
        consider(limb.upper, limb.root, limb.joint);
        consider(limb.lower, limb.joint, limb.end);
      }
      if (label == kUnlabeled) continue;
      ++voxels;
      right += labels[i] == label;
    }
    return static_cast<double>(right) / voxels;
  }

  PaperPerson person_;
  PoseState truth_ = person_.Pose(kSpread);
};

TEST_F(Figure8, VoxelsAreLabeledByAGoodPrediction) {
  const VoxelCloud cloud = person_.Cloud(truth_);
  const auto frame = LabelVoxels(cloud, person_.body, truth_);
  ASSERT_TRUE(frame);
  EXPECT_GT(ShareRight(cloud, truth_, frame->labels), 0.8);
}

TEST_F(Figure8, HeadAndTorsoAreLocatedWithoutRelyingOnThePrediction) {
  PoseState predicted = truth_;
  predicted.X_WT.p += Vector3(250, 0, 0);
  const VoxelCloud cloud = person_.Cloud(truth_);
  const auto near = LabelVoxels(cloud, person_.body, truth_);
  const auto far = LabelVoxels(cloud, person_.body, predicted);
  ASSERT_TRUE(near && far);
  for (const BodyPart part : {BodyPart::kHead, BodyPart::kTorso}) {
    EXPECT_EQ(VoxelsLabeled(near->labels, LabelOf(part)),
              VoxelsLabeled(far->labels, LabelOf(part)));
  }
}

TEST_F(Figure8, LimbsMoveWithTheTorsoAndKeepTheirAngles) {
  PoseState predicted = truth_;
  predicted.X_WT.p += Vector3(250, 100, 0);
  predicted.X_WT.R = ExpRotation(Vector3(0.1, 0, 0)) * predicted.X_WT.R;
  const Vector3 down_W = -truth_.X_WT.R.col(2);
  const PoseState moved =
      MoveToTorso(person_.body, predicted, person_.Place(truth_, Point::kNeck), down_W);
  EXPECT_EQ(moved.theta, predicted.theta);
  EXPECT_LT((moved.X_WT.p - truth_.X_WT.p).norm(), 1);
  EXPECT_LT((moved.X_WT.R.col(2) + down_W).norm(), 1e-9);
}

TEST_F(Figure8, ALargeDisplacementDoesNotSpoilTheLabels) {
  PoseState predicted = truth_;
  predicted.X_WT.p += Vector3(250, 100, 0);
  const VoxelCloud cloud = person_.Cloud(truth_);
  const auto frame = LabelVoxels(cloud, person_.body, predicted);
  ASSERT_TRUE(frame);
  EXPECT_GT(ShareRight(cloud, truth_, frame->labels), 0.8);
}

TEST_F(Figure8, LimbVoxelsGoToTheLimbWithTheLeastMahalanobisDistance) {
  const VoxelCloud cloud = person_.Cloud(truth_);
  for (int limb = 0; limb < kLimbCount; ++limb) {
    const Vector3 middle_W = person_.Place(truth_, static_cast<Point>(kLimbs[limb].lower));
    const int voxel = cloud.IndexAt(middle_W);
    ASSERT_GE(voxel, 0);
    const std::array<int, 1> one = {voxel};
    EXPECT_EQ(AssignToLimbs(cloud, one, person_.body, truth_)[limb].size(), 1) << limb;
  }
}

// The whole limb counts: a foot belongs to the leg that reaches it, not to the calf beside it.
TEST_F(Figure8, AFootBesideTheOtherCalfStaysWithItsOwnLeg) {
  Stance stride = kSpread;
  stride.leg_l = {.hip = 0, .spread = 3, .knee = 0};
  stride.leg_r = {.hip = -25, .spread = 3, .knee = 40};
  const PoseState truth = person_.Pose(stride);
  const VoxelCloud cloud = person_.Cloud(truth);
  const auto frame = LabelVoxels(cloud, person_.body, truth);
  ASSERT_TRUE(frame);
  for (const Limb& leg : {kLimbs[2], kLimbs[3]}) {
    const Vector3 foot_W = person_.Place(truth, leg.end);
    const Vector3 knee_W = person_.Place(truth, leg.joint);
    const int voxel = cloud.IndexAt(Vector3(foot_W + 40 * (knee_W - foot_W).normalized()));
    ASSERT_GE(voxel, 0);
    EXPECT_EQ(frame->labels[voxel], LabelOf(leg.lower));
  }
}

TEST_F(Figure8, TheTorsoGetsTheRimBesideItsTemplate) {
  const VoxelCloud cloud = person_.Cloud(truth_);
  const Vector3 torso_W = person_.Place(truth_, Point::kTorso);
  const Vector3 left_W = truth_.X_WT.R.col(1);
  const double half_mm = person_.body.sizes().torso_width / 2;
  const int rim = cloud.IndexAt(Vector3(torso_W + (half_mm - 10) * left_W));
  ASSERT_GE(rim, 0);
  BodySizes slim = person_.body.sizes();
  slim.torso_width = 2 * (cloud.voxels()[rim].center_W - torso_W).dot(left_W) - cloud.voxel_mm();
  BodyModel body = person_.body;
  body.Resize(slim);
  const auto frame = LabelVoxels(cloud, body, truth_);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->labels[rim], LabelOf(BodyPart::kTorso));
}

TEST_F(Figure8, MeasuredPointsAreCentroidsAndEndsOfTheLabeledParts) {
  const VoxelCloud cloud = person_.Cloud(truth_);
  const auto frame = LabelVoxels(cloud, person_.body, truth_);
  ASSERT_TRUE(frame);
  const MeasuredPoints points = MeasurePoints(cloud, *frame);
  for (int i = 0; i < kPointCount; ++i) {
    ASSERT_TRUE(points[i]) << kPointNames[i];
    EXPECT_LT((*points[i] - person_.Place(truth_, static_cast<Point>(i))).norm(), 110)
        << kPointNames[i];
  }
}

TEST_F(Figure8, APartWithTooFewVoxelsIsNotMeasured) {
  const VoxelCloud cloud = person_.Cloud(truth_);
  auto frame = LabelVoxels(cloud, person_.body, truth_);
  ASSERT_TRUE(frame);
  SetLabel(VoxelsLabeled(frame->labels, LabelOf(BodyPart::kLowerArmL)), kUnlabeled, frame->labels);
  const MeasuredPoints points = MeasurePoints(cloud, *frame);
  EXPECT_FALSE(At(points, Point::kLowerArmL));
  EXPECT_FALSE(At(points, Point::kFingertipsL));
  EXPECT_TRUE(At(points, Point::kFingertipsR));
}

TEST_F(Figure8, NothingIsLabeledWithoutVoxels) {
  EXPECT_FALSE(LabelVoxels(VoxelCloud(), person_.body, truth_));
}

}  // namespace
}  // namespace mocap::mikic2003
