#include "core/acquisition/model_acquirer.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "tests/support/seen_body.h"

namespace mocap {
namespace {

constexpr LegStance kSeated{.hip = 85, .knee = 85};
constexpr ArmStance kHandOnThigh{.elbow = 60};

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
  /// How far the joints are off after some frames of this pose.
  double ErrorAfter(int frames, const PoseState& truth) { return ErrorAfter(frames, truth, body_); }
  double ErrorAfter(int frames, const PoseState& truth, const BodyModel& body) {
    const Evidence evidence = studio_.Show(body, truth);
    ModelAcquirer acquirer(body.table());
    const bool located = acquirer.Locate(evidence, std::nullopt, {});
    EXPECT_TRUE(located);
    if (!located) return 1e9;
    for (int i = 1; i < frames; ++i) acquirer.Refine(evidence, 0.03);
    const Tracker& best = acquirer.best();
    return (best.body().PointsAt(best.body().PostureAt(best.filter().pose())) -
            body.PointsAt(body.PostureAt(truth)))
        .colwise()
        .norm()
        .mean();
  }

  RoundStudio studio_;
  BodyModel body_{LoadBodyTable("full"), AverageSizes(1750)};
};

TEST_F(Acquisition, FindsSomebodyWhoStands) {
  const BodySizes& sizes = body_.sizes();
  EXPECT_LT(ErrorAfter(4, Pose(sizes.torso / 2 + sizes.thigh + sizes.calf, {})), 40);
}

TEST_F(Acquisition, FindsSomebodyWhoseHeightIsNotTheStature) {
  const BodySizes& sizes = body_.sizes();
  EXPECT_LT(ErrorAfter(7, Pose(sizes.torso / 2 + sizes.calf,
                               {kHandOnThigh, kHandOnThigh, kSeated, kSeated})),
            60);
}

TEST_F(Acquisition, FindsAChildWhoseHeadIsSmall) {
  const BodyModel child(body_.table(), AverageSizes(1150));
  const BodySizes& sizes = child.sizes();
  EXPECT_LT(ErrorAfter(4, Pose(sizes.torso / 2 + sizes.thigh + sizes.calf, {}), child), 30);
}

TEST_F(Acquisition, FindsPeopleWhateverTheyWear) {
  const auto standing = [&](const BodySizes& sizes) {
    return Pose(sizes.torso / 2 + sizes.thigh + sizes.calf, {});
  };
  BodySizes round_hair = AverageSizes(1650);
  round_hair.head = 360, round_hair.head_width = 330;
  BodySizes coat = AverageSizes(1700);
  for (const SizeMember width : kStoutWidths) coat.*width *= 1.4;
  BodySizes pack = AverageSizes(1800);
  pack.torso_depth *= 1.7;
  BodySizes wide_trousers = AverageSizes(1600);
  wide_trousers.thigh_width *= 1.5, wide_trousers.calf_width *= 2;
  for (const BodySizes& sizes : {round_hair, coat, pack, wide_trousers}) {
    const BodyModel body(body_.table(), sizes);
    EXPECT_LT(ErrorAfter(3, standing(sizes), body), 60) << sizes.Stature();
  }
}

TEST_F(Acquisition, LegsAreInsideASkirtAndNotAtItsEdges) {
  BodySizes skirt = AverageSizes(1650);
  skirt.drape_hip = 40, skirt.drape_knee = 110, skirt.drape_calf = 60;
  const BodyModel body(body_.table(), skirt);
  const PoseState truth = Pose(skirt.torso / 2 + skirt.thigh + skirt.calf, {});
  const Evidence evidence = studio_.Show(body, truth);
  ModelAcquirer acquirer(body.table());
  ASSERT_TRUE(acquirer.Locate(evidence, std::nullopt, {}));
  for (int i = 1; i < 6; ++i) acquirer.Refine(evidence, 0.03);
  const BodyModel& found = acquirer.best().body();
  EXPECT_TRUE(found.sizes().IsDraped());
  const BodyPoints found_W = found.PointsAt(found.PostureAt(acquirer.best().filter().pose()));
  const BodyPoints truth_W = body.PointsAt(body.PostureAt(truth));
  for (const Point knee : {Point::kKneeL, Point::kKneeR}) {
    const int i = static_cast<int>(knee);
    EXPECT_LT((found_W.col(i) - truth_W.col(i)).norm(), 45);
  }
}

TEST_F(Acquisition, FollowsBothFacingsForSomeTimeAtMost) {
  const BodySizes& sizes = body_.sizes();
  const PoseState truth = Pose(sizes.torso / 2 + sizes.thigh + sizes.calf, {});
  const Evidence evidence = studio_.Show(body_, truth);
  ModelAcquirer acquirer(body_.table());
  ASSERT_TRUE(acquirer.Locate(evidence, std::nullopt, {}));
  for (int i = 0; i < 25 && acquirer.opposite() != nullptr; ++i) acquirer.Refine(evidence, 0.1);
  EXPECT_EQ(acquirer.opposite(), nullptr);
  EXPECT_GT(acquirer.best().filter().pose().X_WT.R.col(0).dot(truth.X_WT.R.col(0)), 0.9);
}

TEST_F(Acquisition, FindsPeopleHoweverTheyStand) {
  const BodySizes& sizes = body_.sizes();
  const double hips_mm = sizes.thigh + sizes.calf;
  constexpr ArmStance kHandAtFace{.raise = -40, .forward = 70, .elbow = 120};
  constexpr ArmStance kOverhead{.raise = 85};
  constexpr LegStance kCrouching{.hip = 100, .spread = 10, .knee = 110};
  constexpr LegStance kLifted{.hip = 90, .knee = 90};
  const std::vector<std::pair<double, Stance>> stances = {
      {hips_mm, {.arm_l = kHandAtFace, .arm_r = kHandAtFace}},
      {hips_mm, {.arm_l = kOverhead, .arm_r = kOverhead}},
      {hips_mm, {.arm_r = kOverhead, .leg_l = kLifted}},
      {0.5 * hips_mm, {.leg_l = kCrouching, .leg_r = kCrouching}}};
  for (const auto& [height_mm, stance] : stances)
    EXPECT_LT(ErrorAfter(3, Pose(sizes.torso / 2 + height_mm, stance)), 60) << height_mm;
}

TEST_F(Acquisition, FindsSomebodyWhoLies) {
  PoseState lying = Pose(120, {});
  lying.X_WT.R *= ExpRotation(Vector3(0, -EIGEN_PI / 2, 0));
  EXPECT_LT(ErrorAfter(3, lying), 60);
}

TEST_F(Acquisition, FindsSomebodyBitByBitWhereThereIsLittleTime) {
  const BodySizes& sizes = body_.sizes();
  const Evidence evidence =
      studio_.Show(body_, Pose(sizes.torso / 2 + sizes.thigh + sizes.calf, {}));
  ModelAcquirer acquirer(body_.table());
  bool located = false;
  for (int i = 0; i < 5 && !located; ++i) located = acquirer.Locate(evidence, std::nullopt, {0.1});
  EXPECT_TRUE(located);
}

TEST_F(Acquisition, RaisedArmsMakeNobodyTaller) {
  const BodySizes& sizes = body_.sizes();
  constexpr ArmStance kRaised{.raise = 80};
  const Evidence evidence = studio_.Show(body_, Pose(sizes.torso / 2 + sizes.thigh + sizes.calf,
                                                     {.arm_l = kRaised, .arm_r = kRaised}));
  ModelAcquirer acquirer(body_.table());
  ASSERT_TRUE(acquirer.Locate(evidence, std::nullopt, {}));
  EXPECT_NEAR(acquirer.best().body().sizes().Stature(), 1750, 50);
}

TEST_F(Acquisition, FindsSomebodyWhoStandsOnTheHands) {
  constexpr ArmStance kUp{.raise = 85, .elbow = 5};
  for (const double stature_mm : {1150, 1750}) {
    const BodyModel body(body_.table(), AverageSizes(stature_mm));
    PoseState handstand = Pose(0.62 * stature_mm, {.arm_l = kUp, .arm_r = kUp});
    handstand.X_WT.R.col(1) *= -1;
    handstand.X_WT.R.col(2) *= -1;
    EXPECT_LT(ErrorAfter(3, handstand, body), 60) << stature_mm;
  }
}

}  // namespace
}  // namespace mocap
