#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "core/proposals/scheduler.h"
#include "tests/support/seen_body.h"
#include "tests/support/standing_height.h"

namespace mocap {
namespace {

constexpr LegStance kSeated{.hip = 85, .knee = 85};
constexpr ArmStance kHandOnThigh{.elbow = 60};
constexpr double kFrame_s = 0.03;

class Acquisition : public ::testing::Test {
 protected:
  /// Somebody who faces 50 degrees off x, with the torso's middle at a height.
  PoseState Pose(double height_mm, const Stance& stance) const {
    PoseState pose;
    pose.X_WT.R = ExpRotation(Vector3(0, 0, 50 * EIGEN_PI / 180));
    pose.X_WT.p = Vector3(40, -20, height_mm);
    pose.theta = AnglesOf(stance, body_.table());
    return pose;
  }
  PoseState Upright(const BodySizes& sizes, const Stance& stance) const {
    PoseState pose = Pose(0, stance);
    PutOnFloor(BodyModel(body_.table(), sizes), pose);
    return pose;
  }
  /// Looks for whoever is there, and measures for some frames more.
  void Find(const BodyModel& body, const PoseState& truth, int frames) {
    evidence_ = studio_.Show(body, truth);
    objective_.SetEvidence(evidence_);
    std::vector<Hypothesis> found = scheduler_.FindAnybody(objective_, std::nullopt, {});
    ASSERT_FALSE(found.empty());
    hypotheses_.Begin(std::move(found));
    for (int i = 1; i < frames; ++i) {
      hypotheses_.Follow(objective_, kFrame_s);
      scheduler_.Try(objective_, hypotheses_, false, kFrame_s);
      for (Hypothesis& hypothesis : hypotheses_.all()) hypothesis.RefineSizes(objective_);
    }
  }
  /// How far the joints are off after some frames of this pose.
  double ErrorAfter(int frames, const PoseState& truth) { return ErrorAfter(frames, truth, body_); }
  double ErrorAfter(int frames, const PoseState& truth, const BodyModel& body) {
    Find(body, truth, frames);
    if (hypotheses_.empty()) return 1e9;
    const Hypothesis& best = hypotheses_.best();
    EXPECT_TRUE(best.fitness.IsCredible());
    return MeanDistance(best.body, best.filter.pose(), body, truth);
  }

  RoundStudio studio_;
  BodyModel body_{LoadBodyTable("full"), AverageSizes(1750)};
  Evidence evidence_;
  Objective objective_;
  Scheduler scheduler_{body_.table()};
  HypothesisSet hypotheses_;
};

TEST_F(Acquisition, FindsSomebodyWhoStands) {
  EXPECT_LT(ErrorAfter(4, Upright(body_.sizes(), {})), 40);
}

TEST_F(Acquisition, FindsSomebodyWhoseHeightIsNotTheStature) {
  const BodySizes& sizes = body_.sizes();
  EXPECT_LT(ErrorAfter(7, Pose(sizes.torso / 2 + sizes.calf,
                               {kHandOnThigh, kHandOnThigh, kSeated, kSeated})),
            60);
}

TEST_F(Acquisition, FindsAChildWhoseHeadIsSmall) {
  const BodyModel child(body_.table(), AverageSizes(1150));
  EXPECT_LT(ErrorAfter(4, Upright(child.sizes(), {}), child), 30);
}

struct Worn {
  std::string name;
  BodySizes sizes;
};

std::vector<Worn> WhatPeopleWear() {
  BodySizes round_hair = AverageSizes(1650);
  round_hair.head = 360, round_hair.head_width = 330;
  BodySizes coat = AverageSizes(1700);
  for (const SizeMember width : kStoutWidths) coat.*width *= 1.4;
  BodySizes pack = AverageSizes(1800);
  pack.torso_depth *= 1.7;
  BodySizes wide_trousers = AverageSizes(1600);
  wide_trousers.thigh_width *= 1.5, wide_trousers.calf_width *= 2;
  return {{"RoundHair", round_hair}, {"Coat", coat}, {"Pack", pack}, {"Trousers", wide_trousers}};
}

class Clothes : public Acquisition, public ::testing::WithParamInterface<Worn> {};

TEST_P(Clothes, DoNotHideWhoWearsThem) {
  const BodyModel body(body_.table(), GetParam().sizes);
  EXPECT_LT(ErrorAfter(3, Upright(body.sizes(), {}), body), 60);
}

INSTANTIATE_TEST_SUITE_P(Acquisition, Clothes, ::testing::ValuesIn(WhatPeopleWear()),
                         [](const auto& test) { return test.param.name; });

TEST_F(Acquisition, LegsAreInsideASkirtAndNotAtItsEdges) {
  BodySizes skirt = AverageSizes(1650);
  skirt.drape_hip = 40, skirt.drape_knee = 110, skirt.drape_calf = 60;
  const BodyModel body(body_.table(), skirt);
  const PoseState truth = Upright(skirt, {});
  Find(body, truth, 6);
  const BodyModel& found = hypotheses_.best().body;
  EXPECT_TRUE(found.sizes().IsDraped());
  const BodyPoints found_W = found.PointsAt(found.PostureAt(hypotheses_.best().filter.pose()));
  const BodyPoints truth_W = body.PointsAt(body.PostureAt(truth));
  for (const Point knee : {Point::kKneeL, Point::kKneeR}) {
    const int i = static_cast<int>(knee);
    EXPECT_LT((found_W.col(i) - truth_W.col(i)).norm(), 45);
  }
}

TEST_F(Acquisition, FollowsBothFacingsForSomeTimeAtMost) {
  const PoseState truth = Upright(body_.sizes(), {});
  Find(body_, truth, 1);
  for (int i = 0; i < 25; ++i) {
    hypotheses_.Follow(objective_, 0.1);
    scheduler_.Try(objective_, hypotheses_, true, 0.1);
  }
  for (const Hypothesis& hypothesis : hypotheses_.all())
    EXPECT_GT(hypothesis.filter.pose().X_WT.R.col(0).dot(truth.X_WT.R.col(0)), 0.9);
  EXPECT_GT(hypotheses_.ProbabilityOf(hypotheses_.best()), 0.9);
}

struct Stood {
  std::string name;
  double hips;  ///< Height, as a share of a leg's length.
  Stance stance;
};

std::vector<Stood> HowPeopleStand() {
  constexpr ArmStance kHandAtFace{.raise = -40, .forward = 70, .elbow = 120};
  constexpr ArmStance kOverhead{.raise = 85};
  constexpr LegStance kCrouching{.hip = 100, .spread = 10, .knee = 110};
  constexpr LegStance kLifted{.hip = 90, .knee = 90};
  return {{"HandsAtFace", 1, {.arm_l = kHandAtFace, .arm_r = kHandAtFace}},
          {"ArmsOverhead", 1, {.arm_l = kOverhead, .arm_r = kOverhead}},
          {"OnOneLeg", 1, {.arm_r = kOverhead, .leg_l = kLifted}},
          {"Crouching", 0.5, {.leg_l = kCrouching, .leg_r = kCrouching}}};
}

class Stances : public Acquisition, public ::testing::WithParamInterface<Stood> {};

TEST_P(Stances, AreFound) {
  const BodySizes& sizes = body_.sizes();
  const double height_mm = sizes.torso / 2 + GetParam().hips * (sizes.thigh + sizes.calf);
  EXPECT_LT(ErrorAfter(3, Pose(height_mm, GetParam().stance)), 60);
}

INSTANTIATE_TEST_SUITE_P(Acquisition, Stances, ::testing::ValuesIn(HowPeopleStand()),
                         [](const auto& test) { return test.param.name; });

TEST_F(Acquisition, FindsSomebodyWhoLies) {
  PoseState lying = Pose(120, {});
  lying.X_WT.R *= ExpRotation(Vector3(0, -EIGEN_PI / 2, 0));
  EXPECT_LT(ErrorAfter(3, lying), 60);
}

TEST_F(Acquisition, FindsSomebodyBitByBitWhereThereIsLittleTime) {
  evidence_ = studio_.Show(body_, Upright(body_.sizes(), {}));
  objective_.SetEvidence(evidence_);
  bool located = false;
  for (int i = 0; i < 5 && !located; ++i) {
    const auto found = scheduler_.FindAnybody(objective_, std::nullopt, {0.1});
    located = !found.empty() && found.front().fitness.IsCredible();
  }
  EXPECT_TRUE(located);
}

TEST_F(Acquisition, RaisedArmsMakeNobodyTaller) {
  constexpr ArmStance kUp{.raise = 80};
  Find(body_, Upright(body_.sizes(), {.arm_l = kUp, .arm_r = kUp}), 1);
  EXPECT_NEAR(hypotheses_.best().body.sizes().Stature(), 1750, 50);
}

class Handstand : public Acquisition, public ::testing::WithParamInterface<int> {};

TEST_P(Handstand, IsFound) {
  constexpr ArmStance kUp{.raise = 85, .elbow = 5};
  const BodyModel body(body_.table(), AverageSizes(GetParam()));
  PoseState handstand = Pose(0.62 * GetParam(), {.arm_l = kUp, .arm_r = kUp});
  handstand.X_WT.R.col(1) *= -1;
  handstand.X_WT.R.col(2) *= -1;
  EXPECT_LT(ErrorAfter(3, handstand, body), 60);
}

INSTANTIATE_TEST_SUITE_P(Acquisition, Handstand, ::testing::Values(1150, 1750));

TEST_F(Acquisition, KeepsTheSizesOfWhoIsKnown) {
  const PoseState truth = Upright(body_.sizes(), {});
  evidence_ = studio_.Show(body_, truth);
  objective_.SetEvidence(evidence_);
  const auto found = scheduler_.FindAnybody(objective_, body_.sizes(), {});
  ASSERT_FALSE(found.empty());
  for (const Hypothesis& hypothesis : found) {
    EXPECT_EQ(hypothesis.body.sizes(), body_.sizes());
    EXPECT_FALSE(hypothesis.sizes);
  }
  EXPECT_LT(MeanDistance(found.front().body, found.front().filter.pose(), body_, truth), 20);
}

}  // namespace
}  // namespace mocap
