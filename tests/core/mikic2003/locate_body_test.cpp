#include "core/mikic2003/locate_body.h"

#include <gtest/gtest.h>

#include "tests/core/mikic2003/paper_person.h"

namespace mocap::mikic2003 {
namespace {

TEST(Figure11, AllPartsAreLocatedInTheFirstFrame) {
  const PaperPerson person;
  const PoseState truth = person.Pose(kSpread);
  const VoxelCloud cloud = person.Cloud(truth);
  const auto located = LocateBody(cloud);
  ASSERT_TRUE(located);
  for (int part = 0; part < kBodyPartCount; ++part) {
    EXPECT_FALSE(VoxelsLabeled(located->frame.labels, static_cast<std::int8_t>(part)).empty())
        << part;
  }
  // Which side is left is not known yet.
  const double facing = located->R_WT.col(0).dot(truth.X_WT.R.col(0));
  EXPECT_GT(std::abs(facing), 0.9);
  EXPECT_GT(located->R_WT.col(2).dot(truth.X_WT.R.col(2)), 0.95);
  EXPECT_NEAR(located->R_WT.determinant(), 1, 1e-9);
}

TEST(Figure11, ArmsAreAtTheShouldersAndLegsAtTheHips) {
  const PaperPerson person;
  const PoseState truth = person.Pose(kSpread);
  const VoxelCloud cloud = person.Cloud(truth);
  const auto located = LocateBody(cloud);
  ASSERT_TRUE(located);
  const bool is_exchanged = located->R_WT.col(0).dot(truth.X_WT.R.col(0)) < 0;
  for (int limb = 0; limb < kLimbCount; ++limb) {
    const Limb& found = kLimbs[limb];
    const Limb& expected = kLimbs[is_exchanged ? limb ^ 1 : limb];
    const Vector3 hand_or_foot_W = person.Place(truth, static_cast<Point>(expected.lower));
    const int voxel = cloud.IndexAt(hand_or_foot_W);
    ASSERT_GE(voxel, 0);
    const int label = located->frame.labels[voxel];
    EXPECT_TRUE(label == LabelOf(found.lower) || label == LabelOf(found.upper)) << limb;
  }
}

// §7.2: "the initial torso will be very long and include much of the legs".
TEST(Figure10, TorsoIncludesLegsThatAreCloseTogetherUntilTheyPart) {
  PaperPerson person;
  BodySizes sizes = person.body.sizes();
  sizes.thigh_width = sizes.hip_width + 20;
  person.body.Resize(sizes);
  Stance closed = kSpread;
  closed.leg_l = closed.leg_r = {.hip = 0, .spread = 0, .knee = 0};
  const PoseState truth = person.Pose(closed);
  const VoxelCloud cloud = person.Cloud(truth);
  const auto located = LocateBody(cloud);
  ASSERT_TRUE(located);
  const int thigh = cloud.IndexAt(person.Place(truth, Point::kThighL));
  const int calf = cloud.IndexAt(Vector3(person.Place(truth, Point::kFootL) + Vector3(0, 0, 60)));
  ASSERT_TRUE(thigh >= 0 && calf >= 0);
  EXPECT_EQ(located->frame.labels[thigh], LabelOf(BodyPart::kTorso));
  EXPECT_NE(located->frame.labels[calf], LabelOf(BodyPart::kTorso));
}

TEST(Figure11, LegsThatNeverPartAreNoFourRegions) {
  const PaperPerson person;
  Stance closed = kSpread;
  closed.leg_l = {.hip = 0, .spread = -7, .knee = 0};
  closed.leg_r = closed.leg_l;
  EXPECT_FALSE(LocateBody(person.Cloud(person.Pose(closed))));
}

TEST(Figure11, ATrunkIsNoWiderThanThoseOfPeopleOfThatHeight) {
  PaperPerson person;
  BodySizes wide = person.body.sizes();
  wide.torso_width *= 1.4, wide.hip_width *= 1.3, wide.shoulder_width *= 1.3;
  person.body.Resize(wide);
  const auto located = LocateBody(person.Cloud(person.Pose(kSpread)));
  ASSERT_TRUE(located);
  const double height_mm = located->height_less_head_mm + located->sizes.head;
  EXPECT_LE(located->sizes.torso_width, 1.15 * AverageSizes(height_mm).torso_width + 1e-9);
}

TEST(Figure10, TorsoGrowsFromTheNeckDownToWhereTheLegsPart) {
  const PaperPerson person;
  const PoseState truth = person.Pose(kSpread);
  const VoxelCloud cloud = person.Cloud(truth);
  const Vector3 neck_W = person.Place(truth, Point::kNeck);
  VoxelIndices below_neck;
  for (int i = 0; i < cloud.size(); ++i) {
    if (cloud.voxels()[i].center_W.z() < neck_W.z()) below_neck.push_back(i);
  }
  const Cylinder torso = GrowTorso(cloud, below_neck, neck_W);
  EXPECT_GT(-torso.axis_W.dot(truth.X_WT.R.col(2)), 0.98);
  EXPECT_NEAR(torso.length_mm, person.body.sizes().torso, 150);
  EXPECT_NEAR(2 * torso.half_depth_mm, person.body.sizes().torso_depth, 60);
  EXPECT_GT(torso.half_width_mm, torso.half_depth_mm);
}

}  // namespace
}  // namespace mocap::mikic2003
