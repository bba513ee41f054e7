#include "core/mikic2003/find_head.h"

#include <gtest/gtest.h>

#include "tests/core/mikic2003/paper_person.h"
#include "tests/support/voxelized_shapes.h"

namespace mocap::mikic2003 {
namespace {

TEST(Figure6, HeadIsFoundInTheWholeVolumeWithoutAPrediction) {
  const PaperPerson person;
  for (const Stance& stance : {Stance{}, kSpread}) {
    const PoseState pose = person.Pose(stance);
    const auto head = FindHead(person.Cloud(pose), kAnyHead, std::nullopt);
    ASSERT_TRUE(head);
    EXPECT_LT((head->center_W - person.Place(pose, Point::kHead)).norm(), 60);
  }
}

// A child's waist is as round as a head, and about as wide.
TEST(Figure6, AChildsHeadIsFoundAboveTheWaist) {
  const PaperPerson child(1200);
  const PoseState pose = child.Pose(kSpread, 0.4, {0, 0, 850});
  const auto head = FindHead(child.Cloud(pose), kAnyHead, std::nullopt);
  ASSERT_TRUE(head);
  EXPECT_LT((head->center_W - child.Place(pose, Point::kHead)).norm(), 60);
}

// The ball fills the crust; the longer head above it does not.
TEST(Figure6, TheUpperOfTwoLikelyHeadsIsTheHead) {
  const Vector3 head_W(0, 0, 400), ball_W(0, 0, 100);
  VoxelCloud both;
  both.Build(FillGrid({-200, -200, -100}, {200, 200, 600}, 25, [&](const Vector3& p_W) {
    const Vector3 from_head = p_W - head_W;
    return (p_W - ball_W).norm() < 90 ||
           Vector3(from_head.x(), from_head.y(), 0.78 * from_head.z()).norm() < 85;
  }));
  for (const std::optional<SearchRegion>& region :
       {std::optional<SearchRegion>(), {SearchRegion{ball_W, 400}}}) {
    const auto head = FindHead(both, kAnyHead, region);
    ASSERT_TRUE(head);
    EXPECT_LT((head->center_W - head_W).norm(), 60);
  }
}

// The sphere cuts a rod of 1.2 m into three pieces; hair would be a smaller one.
TEST(Figure6, WhatIsLargerThanTheHeadIsNoHair) {
  VoxelCloud rod;
  rod.Build(FillGrid({-200, -200, -100}, {200, 200, 1300}, 25, [](const Vector3& p_W) {
    return p_W.head<2>().norm() < 60 && p_W.z() > 0 && p_W.z() < 1200;
  }));
  const auto head = FindHead(rod, kAnyHead, SearchRegion{{0, 0, 520}, 50});
  ASSERT_TRUE(head);
  for (const int voxel : head->voxels) {
    EXPECT_LT((rod.voxels()[voxel].center_W - Vector3(0, 0, 520)).norm(), 50 + kAnyHead.reach_mm);
  }
}

TEST(Figure6, NeckLiesBetweenHeadAndTorso) {
  const PaperPerson person;
  const PoseState pose = person.Pose(kSpread);
  const auto head = FindHead(person.Cloud(pose), CrustOf(person.body.sizes(), 25),
                             SearchRegion{person.Place(pose, Point::kHead), 300});
  ASSERT_TRUE(head);
  const Vector3 up_W = pose.X_WT.R.col(2);
  EXPECT_LT(up_W.dot(head->neck_W), up_W.dot(head->center_W) - 50);
  EXPECT_LT((head->neck_W - person.Place(pose, Point::kNeck)).norm(), 100);
}

TEST(Figure6, HeadIsLookedForNearThePredictionAlone) {
  const PaperPerson person;
  const PoseState pose = person.Pose(kSpread);
  const Vector3 torso_W = person.Place(pose, Point::kTorso);
  const auto found =
      FindHead(person.Cloud(pose), CrustOf(person.body.sizes(), 25), SearchRegion{torso_W, 100});
  ASSERT_TRUE(found);
  EXPECT_LT((found->center_W - torso_W).norm(), 200);
}

TEST(Figure6, CrustSpansTheHeadsSmallestAndLargestDimension) {
  const HeadCrust crust = CrustOf({.head = 240, .head_width = 175}, 0);
  EXPECT_NEAR(crust.inner_mm, 152 / 2.0, 1);  // Mean breadth of men's heads (ANSUR),
  EXPECT_NEAR(crust.outer_mm, 197 / 2.0, 1);  // and length.
  EXPECT_EQ(crust.reach_mm, 120);
}

TEST(Figure6, ThereIsNoHeadWhereThereIsNoBody) {
  EXPECT_FALSE(FindHead(VoxelCloud(), kAnyHead, std::nullopt));
}

}  // namespace
}  // namespace mocap::mikic2003
