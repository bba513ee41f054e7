#include "core/acquisition/model_acquirer.h"

#include <gtest/gtest.h>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "tests/support/seen_body.h"

namespace mocap {
namespace {

constexpr LegStance kSeated{.hip = 85, .knee = 85};
constexpr ArmStance kHandOnThigh{.elbow = 60};

class Acquisition : public testing::Test {
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
    ModelAcquirer acquirer(body.table(), {});
    bool located = false;
    for (int i = 0; i < frames; ++i) {
      if (located) {
        acquirer.Refine(evidence, 0.03);
      } else {
        located = acquirer.Locate(evidence, std::nullopt);
      }
    }
    EXPECT_TRUE(located);
    if (!located) return 1e9;
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

TEST_F(Acquisition, RaisedArmsMakeNobodyTaller) {
  const BodySizes& sizes = body_.sizes();
  constexpr ArmStance kRaised{.raise = 80};
  const Evidence evidence = studio_.Show(body_, Pose(sizes.torso / 2 + sizes.thigh + sizes.calf,
                                                     {.arm_l = kRaised, .arm_r = kRaised}));
  ModelAcquirer acquirer(body_.table(), {});
  ASSERT_TRUE(acquirer.Locate(evidence, std::nullopt));
  EXPECT_NEAR(acquirer.best().body().sizes().Stature(), 1750, 50);
}

TEST_F(Acquisition, NobodyIsFoundUpsideDown) {
  for (const double stature_mm : {1150, 1750}) {
    const BodyModel body(body_.table(), AverageSizes(stature_mm));
    PoseState upside_down = Pose(0.57 * stature_mm, {});
    upside_down.X_WT.R.col(1) *= -1;
    upside_down.X_WT.R.col(2) *= -1;
    const Evidence evidence = studio_.Show(body, upside_down);
    ModelAcquirer acquirer(body_.table(), {});
    for (int i = 0; i < 4; ++i) EXPECT_FALSE(acquirer.Locate(evidence, std::nullopt));
  }
}

}  // namespace
}  // namespace mocap
