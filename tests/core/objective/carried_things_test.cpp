#include "core/objective/carried_things.h"

#include <gtest/gtest.h>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "core/hypotheses/hypothesis.h"
#include "tests/support/seen_body.h"
#include "tests/support/standing_height.h"

namespace mocap {
namespace {

class Carried : public ::testing::Test {
 protected:
  PoseState Posed(const Stance& stance, double bent_mm) const {
    PoseState pose;
    pose.X_WT.R = ExpRotation(Vector3(0, 0, 0.4));
    pose.X_WT.p = Vector3(50, -30, StandingHeight(body_.sizes()) - bent_mm);
    pose.theta = AnglesOf(stance, body_.table());
    return pose;
  }
  PoseState Standing() const {
    return Posed({.arm_l = kHanging, .arm_r = kForward, .leg_l = {}, .leg_r = {}}, 0);
  }
  PoseState Sitting() const {
    const LegStance bent{.hip = 85, .knee = 85};
    return Posed({.arm_l = kForward, .arm_r = kForward, .leg_l = bent, .leg_r = bent},
                 body_.sizes().thigh);
  }
  Vector3 At(const PoseState& pose, Point point) const {
    return body_.PointsAt(body_.PostureAt(pose)).col(static_cast<int>(point));
  }
  std::optional<Thing> ThingAt(const PoseState& pose, const Vector3& p_W,
                               Things allowed = kAnyThings) const {
    const Contact contact{{p_W, p_W, Vector3::UnitZ()}, false};
    return ThingPlaces(body_, body_.PostureAt(pose), allowed).At(contact);
  }
  /// The person with more flesh.
  Evidence Show(const PoseState& pose, const std::vector<PosedCapsule>& more) const {
    std::vector<PosedCapsule> flesh;
    body_.PoseShape(body_.PostureAt(pose), flesh);
    flesh.insert(flesh.end(), more.begin(), more.end());
    const RoundStudio::CarvedBody carved = studio_.Carve(flesh, 100);
    Evidence evidence;
    evidence.Gather({carved.hull, carved.outlines});
    return evidence;
  }
  Fitness FitnessOf(const Evidence& evidence, const PoseState& pose, const Things& things) {
    objective_.SetEvidence(evidence);
    return objective_.At(body_, pose, things);
  }
  PosedCapsule HatOf(const PoseState& pose) const {
    const Vector3 brim_W = At(pose, Point::kHead) + Vector3(0, 0, 80);
    return {brim_W - Vector3(150, 0, 0), brim_W + Vector3(150, 0, 0), 80, 80};
  }

  static constexpr ArmStance kHanging{.raise = -85};
  static constexpr ArmStance kForward{.raise = -20, .forward = 90, .elbow = 10};
  RoundStudio studio_;
  BodyModel body_{LoadBodyTable("full"), AverageSizes(1750)};
  Objective objective_;
};

Things Only(Thing thing) { return Things{}.set(static_cast<int>(thing)); }

TEST_F(Carried, HatsAreAroundTheSkullAndNotBelowTheChin) {
  const PoseState pose = Standing();
  const Vector3 head_W = At(pose, Point::kHead);
  EXPECT_EQ(ThingAt(pose, head_W + Vector3(0, 0, 200)), Thing::kHat);
  EXPECT_EQ(ThingAt(pose, head_W + Vector3(120, 120, 50)), Thing::kHat);
  EXPECT_NE(ThingAt(pose, head_W - Vector3(0, 0, 120)), Thing::kHat);
}

TEST_F(Carried, PacksAreBehindTheTrunk) {
  const PoseState pose = Standing();
  const Vector3 chest_W = pose.X_WT.R.col(0);
  EXPECT_EQ(ThingAt(pose, pose.X_WT.p - 200 * chest_W), Thing::kPack);
  EXPECT_EQ(ThingAt(pose, pose.X_WT.p + 200 * chest_W), std::nullopt);
}

TEST_F(Carried, OnlyWhoSitsHasASeat) {
  for (const auto& [pose, seat] : {std::pair{Sitting(), std::optional(Thing::kSeat)},
                                   std::pair{Standing(), std::optional<Thing>()}}) {
    const Vector3 hips_W = (At(pose, Point::kHipL) + At(pose, Point::kHipR)) / 2;
    EXPECT_EQ(ThingAt(pose, hips_W - Vector3(0, 0, 200)), seat);
  }
}

TEST_F(Carried, WhereTwoThingsMayBeTheAllowedOneIs) {
  const PoseState pose = Sitting();
  const Vector3 behind_W = At(pose, Point::kHipL) - 200 * pose.X_WT.R.col(0);
  EXPECT_EQ(ThingAt(pose, behind_W), Thing::kPack);
  EXPECT_EQ(ThingAt(pose, behind_W, Only(Thing::kSeat)), Thing::kSeat);
  EXPECT_EQ(ThingAt(pose, behind_W, Only(Thing::kHat)), std::nullopt);
}

TEST_F(Carried, BagsHangBelowAHandThatHangsDown) {
  const PoseState pose = Standing();
  const Vector3 below_W(0, 0, -150);
  EXPECT_EQ(ThingAt(pose, At(pose, Point::kFingertipsL) + below_W), Thing::kBag);
  EXPECT_EQ(ThingAt(pose, At(pose, Point::kFingertipsR) + below_W), std::nullopt);
}

TEST_F(Carried, AHatIsSeenAndCostsLess) {
  const PoseState pose = Standing();
  const Evidence evidence = Show(pose, {HatOf(pose)});
  Fitness without = FitnessOf(evidence, pose, {}), with = FitnessOf(evidence, pose, kAnyThings);
  EXPECT_EQ(with.things, Only(Thing::kHat));
  EXPECT_LT(with.Sum(), without.Sum());
  with[Term::kThings] = without[Term::kThings] = 0;
  EXPECT_EQ(with.nats, without.nats) << "only the hat differs";
}

TEST_F(Carried, WhoHasNothingCostsTheSame) {
  const PoseState pose = Standing();
  const Evidence evidence = Show(pose, {});
  EXPECT_EQ(FitnessOf(evidence, pose, kAnyThings).things, Things{});
  EXPECT_EQ(FitnessOf(evidence, pose, kAnyThings).nats, FitnessOf(evidence, pose, {}).nats);
}

TEST_F(Carried, WhatIsNotAllowedIsNotSeen) {
  const PoseState pose = Standing();
  const Evidence evidence = Show(pose, {HatOf(pose)});
  const Things others = kAnyThings & ~Only(Thing::kHat);
  EXPECT_EQ(FitnessOf(evidence, pose, others).nats, FitnessOf(evidence, pose, {}).nats);
}

// The head of a single person is drawn aside by where the voxels lie, too: of these 15, ten are
// better by up to 3 mm where things may be, and five are worse by less.
TEST_F(Carried, AHatDoesNotPullTheHead) {
  double without_mm = 0, with_mm = 0;
  for (int person = 0; person < 15; ++person) {
    PoseState pose = Standing();
    pose.X_WT.p.x() = 100 * (person % 3) - 100;
    pose.X_WT.R = ExpRotation(Vector3(0, 0, 0.4 * person));
    const Evidence evidence = Show(pose, {HatOf(pose)});
    objective_.SetEvidence(evidence);
    const auto head_error_mm = [&](const Things& things) {
      PoseFilter filter{MotionNoise{}};
      filter.Reset(pose, 100, 0.5);
      DrawNear(objective_, body_, things, {8, 8}, filter);
      return (At(filter.pose(), Point::kHead) - At(pose, Point::kHead)).norm();
    };
    const double one_without_mm = head_error_mm({}), one_with_mm = head_error_mm(kAnyThings);
    EXPECT_LT(one_with_mm, one_without_mm + 3) << person;
    without_mm += one_without_mm / 15;
    with_mm += one_with_mm / 15;
  }
  EXPECT_LT(with_mm, without_mm - 1);
}

TEST_F(Carried, WhatAFrameDoesNotShowIsPutDown) {
  const PoseState pose = Standing();
  Hypothesis hypothesis(body_, pose, false);
  hypothesis.things = kAnyThings;
  const Evidence with = Show(pose, {HatOf(pose)}), without = Show(pose, {});
  objective_.SetEvidence(with);
  hypothesis.Fit(objective_);
  EXPECT_EQ(hypothesis.things, Only(Thing::kHat));
  objective_.SetEvidence(without);
  hypothesis.Fit(objective_);
  EXPECT_EQ(hypothesis.things, Things{});
}

}  // namespace
}  // namespace mocap
