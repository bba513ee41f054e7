#include "core/mikic2003/find_head.h"

#include <gtest/gtest.h>

#include "tests/core/mikic2003/paper_person.h"

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
