#include "tools/accuracy/true_subject.h"

#include <gtest/gtest.h>

#include "tests/core/mikic2003/paper_person.h"

namespace mocap {
namespace {

using mikic2003::kLimbs;
using mikic2003::Limb;
using mikic2003::PaperPerson;

constexpr double kStatureMm = 1750;

TrueSubject TruthOf(const PaperPerson& person, const PoseState& pose) {
  return {kStatureMm, ScoredPointsOf(person.body.PointsAt(person.body.PostureAt(pose)))};
}

TEST(TrueSubject, LengthsAreThoseOfTheBodyThatThePointsCameFrom) {
  const PaperPerson person(kStatureMm);
  const BodySizes sizes = TrueSizes(TruthOf(person, person.Pose(mikic2003::kSpread)));
  for (const SizeMember length : {&BodySizes::torso, &BodySizes::neck, &BodySizes::thigh,
                                  &BodySizes::calf, &BodySizes::upper_arm, &BodySizes::lower_arm,
                                  &BodySizes::shoulder_width, &BodySizes::hip_width}) {
    EXPECT_NEAR(sizes.*length, person.body.sizes().*length, 1e-6);
  }
}

// Nothing but the truth tells the front of somebody whose arms and legs are straight.
TEST(TrueSubject, StartsInTheTrueOrientation) {
  Stance straight;
  straight.arm_l = straight.arm_r = {.raise = 0, .elbow = 0};
  straight.leg_l = straight.leg_r = {.hip = 0, .spread = 10, .knee = 0};
  const PaperPerson person(kStatureMm);
  for (const double turned_rad : {0.4, 3.5}) {
    const PoseState pose = person.Pose(straight, turned_rad);
    const TrueSubject truth = TruthOf(person, pose);
    const BodyModel body(person.body.table(), TrueSizes(truth));
    const mikic2003::OrientedBody start = TrueStart(body, truth);
    EXPECT_TRUE(start.is_decided());
    const PoseState found = start.best().Pose(body);
    EXPECT_GT(found.X_WT.R.col(0).dot(pose.X_WT.R.col(0)), 0.95);
    const BodyPoints found_W = body.PointsAt(body.PostureAt(found));
    EXPECT_LT((ScoredPointsOf(found_W) - truth.points_W).colwise().norm().mean(), 20);
  }
}

TEST(TrueParts, TouchingLimbsKeepTheirOwnVoxels) {
  const PaperPerson person(kStatureMm);
  Stance together;
  together.arm_l = together.arm_r = {.raise = -85, .elbow = 5};
  together.leg_l = together.leg_r = {.hip = 0, .spread = 0, .knee = 5};
  const TrueSubject truth = TruthOf(person, person.Pose(together));
  const TrueParts parts(truth);
  EXPECT_EQ(parts.PartAt(truth.At(Point::kHead)), BodyPart::kHead);
  for (const double share : {0.1, 0.5, 0.8}) {
    const Vector3 hips_W = (truth.At(Point::kHipL) + truth.At(Point::kHipR)) / 2;
    EXPECT_EQ(parts.PartAt(hips_W + share * (truth.At(Point::kNeck) - hips_W)), BodyPart::kTorso);
    for (const Limb& limb : kLimbs) {
      const auto along = [&](Point from, Point to) -> Vector3 {
        return truth.At(from) + share * (truth.At(to) - truth.At(from));
      };
      EXPECT_EQ(parts.PartAt(along(limb.joint, limb.end)), limb.lower);
      // Shoulders and hips lie in the trunk.
      if (share > 0.4) {
        EXPECT_EQ(parts.PartAt(along(limb.root, limb.joint)), limb.upper);
      }
    }
  }
}

TEST(TrueParts, WhatLiesBesideAThinPartBelongsToTheThickOne) {
  const PaperPerson person(kStatureMm);
  Stance hanging;
  hanging.arm_l = hanging.arm_r = {.raise = -88, .elbow = 5};
  const PoseState pose = person.Pose(hanging);
  const TrueSubject truth = TruthOf(person, pose);
  const Vector3 arm_W = (truth.At(Point::kShoulderL) + truth.At(Point::kElbowL)) / 2;
  const Vector3 right_W = -pose.X_WT.R.col(1);
  // The bone of the arm, of a radius of 51 mm, is nearer than that of the torso's side.
  EXPECT_EQ(TrueParts(truth).PartAt(arm_W + 30 * right_W), BodyPart::kUpperArmL);
  EXPECT_EQ(TrueParts(truth).PartAt(arm_W + 65 * right_W), BodyPart::kTorso);
}

}  // namespace
}  // namespace mocap
