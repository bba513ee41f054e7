#include "core/acquisition/pose_prior.h"

#include <gtest/gtest.h>

#include <optional>

#include "config/load_config.h"
#include "core/acquisition/facing_watch.h"
#include "core/body/stance.h"
#include "core/tracking/tracker.h"
#include "tests/support/seen_body.h"
#include "tests/support/voxelized_body.h"

namespace mocap {
namespace {

constexpr double kDegree = EIGEN_PI / 180;

class Feet : public ::testing::Test {
 protected:
  // Somebody with the soles at a height, turned about the vertical.
  PoseState Standing(double yaw_deg, double soles_mm) const {
    return Standing(yaw_deg, soles_mm, body_);
  }
  PoseState Standing(double yaw_deg, double soles_mm, const BodyModel& body) const {
    PoseState pose;
    pose.X_WT.R = ExpRotation(Vector3(0, 0, yaw_deg * kDegree));
    pose.theta = AnglesOf({}, body.table());
    pose.X_WT.p = Vector3(200, -100, 1000);
    const auto points_W = body.PointsAt(body.PostureAt(pose));
    pose.X_WT.p.z() += soles_mm - points_W.row(2).minCoeff();
    return pose;
  }
  std::optional<Vector3> ToesAt(const PoseState& pose) {
    VoxelCloud cloud;
    cloud.Build(Voxelize(body_, pose, 25));
    return finder_.ToesBeforeShins(cloud);
  }

  BodyModel body_{LoadBodyTable("full"), AverageSizes(1750)};
  FeetFinder finder_;
};

TEST_F(Feet, PointWhereThePersonFaces) {
  for (double yaw_deg = 0; yaw_deg < 360; yaw_deg += 40) {
    const PoseState pose = Standing(yaw_deg, 20);
    const std::optional<Vector3> toes_W = ToesAt(pose);
    ASSERT_TRUE(toes_W) << yaw_deg;
    EXPECT_GT(toes_W->normalized().dot(pose.X_WT.R.col(0)), 0.9) << yaw_deg;
    EXPECT_EQ(toes_W->z(), 0);
  }
}

TEST_F(Feet, SayNothingInTheAir) { EXPECT_FALSE(ToesAt(Standing(0, 300))); }

TEST_F(Feet, ABackpackChangesNothing) {
  const PoseState pose = Standing(30, 20);
  VoxelGrid grid = Voxelize(body_, pose, 25);
  const std::optional<Vector3> without_W = ToesAt(pose);
  const Vector3 pack_W = pose.X_WT.p - 150 * pose.X_WT.R.col(0);
  for (int k = 0; k < grid.size().z(); ++k)
    for (int j = 0; j < grid.size().y(); ++j)
      for (int i = 0; i < grid.size().x(); ++i)
        if ((grid.CenterOf(i, j, k) - pack_W).norm() < 200) grid.Set(i, j, k);
  VoxelCloud cloud;
  cloud.Build(grid);
  const std::optional<Vector3> with_W = finder_.ToesBeforeShins(cloud);
  ASSERT_TRUE(without_W && with_W);
  EXPECT_EQ(*without_W, *with_W);
}

// The hull between the legs and the chair of somebody who sits: it lies beside the feet and joins
// them. What is more than the feet of a child is less than those of an adult.
TEST_F(Feet, SayNothingWhereMoreThanFeetIsOnTheFloor) {
  for (const double stature_mm : {1150, 1750}) {
    const BodyModel body(body_.table(), AverageSizes(stature_mm));
    const double scale = stature_mm / 1750;
    const PoseState pose = Standing(0, 20, body);
    VoxelGrid grid = Voxelize(body, pose, 25);
    const Vector3 middle_W(pose.X_WT.p.x() - 100 * scale, pose.X_WT.p.y(), 0);
    for (int k = 0; k < grid.size().z(); ++k)
      for (int j = 0; j < grid.size().y(); ++j)
        for (int i = 0; i < grid.size().x(); ++i) {
          const Vector3 from_W = grid.CenterOf(i, j, k) - middle_W;
          if (from_W.head<2>().norm() < 150 * scale && from_W.z() < 200) grid.Set(i, j, k);
        }
    VoxelCloud cloud;
    cloud.Build(grid);
    EXPECT_FALSE(finder_.ToesBeforeShins(cloud)) << stature_mm;
  }
}

TEST_F(Feet, MayTurnWhoIsTrackedBackToFrontButNoneTooSoon) {
  const PoseState right = Standing(30, 20), backwards = Standing(210, 20);
  VoxelCloud cloud;
  cloud.Build(Voxelize(body_, right, 25));
  FacingWatch watch;
  const auto look = [&](const PoseState& pose, int frames) {
    for (int i = 0; i < frames; ++i) watch.Look(cloud, pose, 0.05);
  };
  look(right, 20);
  EXPECT_FALSE(watch.is_backwards());
  look(backwards, 5);
  EXPECT_FALSE(watch.is_backwards());
  look(backwards, 5);
  EXPECT_TRUE(watch.is_backwards());
  look(right, 2);
  EXPECT_FALSE(watch.is_backwards());
  look(backwards, 10);
  watch.StartOver();
  EXPECT_FALSE(watch.is_backwards());
}

TEST_F(Feet, DoNotTurnAnybodyByOneLookAfterAGap) {
  const PoseState right = Standing(30, 20), backwards = Standing(210, 20);
  VoxelCloud cloud;
  cloud.Build(Voxelize(body_, right, 25));
  FacingWatch watch;
  for (int i = 0; i < 20; ++i) watch.Look(cloud, right, 0.05);
  watch.Look(cloud, backwards, 3);
  EXPECT_FALSE(watch.is_backwards());
}

// Nobody's feet are seen here: there is no flesh.
TEST_F(Feet, AreNotNeededToSeeWhichWaySomebodyWalks) {
  FacingWatch watch;
  const auto walk = [&](double mm_per_s, double yaw_deg) {
    PoseState pose = Standing(yaw_deg, 20);
    for (int i = 0; i < 25; ++i) {
      watch.Look({}, pose, 0.04);
      pose.X_WT.p.x() += 0.04 * mm_per_s;
    }
  };
  walk(1000, 0);
  ASSERT_TRUE(watch.walks_W());
  EXPECT_GT(watch.walks_W()->x(), 0);
  EXPECT_EQ(watch.walks_W()->z(), 0);
  EXPECT_FALSE(watch.is_backwards());
  watch.StartOver();
  walk(1000, 180);
  EXPECT_TRUE(watch.is_backwards());
  watch.StartOver();
  walk(300, 180);
  EXPECT_FALSE(watch.walks_W());
  EXPECT_FALSE(watch.is_backwards());
}

TEST(PosePrior, BelievesFeetMoreThanTheWay) {
  PoseState pose;
  pose.X_WT.R = ExpRotation(Vector3(0, 0, EIGEN_PI));
  const Vector3 ahead_W(40, 0, 0), back_W(-500, 0, 0);
  const double against_way_mm = PosePrior(std::nullopt, ahead_W).CostMm(pose);
  EXPECT_GT(against_way_mm, 0);
  EXPECT_GT(PosePrior(ahead_W).CostMm(pose), against_way_mm);
  EXPECT_EQ(PosePrior(back_W, ahead_W).CostMm(pose), 0);
}

TEST(PosePrior, CostsMoreTheFartherAnUprightTrunkIsTurnedFromTheFeet) {
  const PosePrior prior(Vector3(0, 40, 0));
  const auto turned = [](double degrees) {
    PoseState pose;
    pose.X_WT.R = ExpRotation(Vector3(0, 0, (90 + degrees) * kDegree));
    return pose;
  };
  EXPECT_NEAR(prior.CostMm(turned(0)), 0, 1e-9);
  EXPECT_LT(prior.CostMm(turned(60)), 1);
  EXPECT_NEAR(prior.CostMm(turned(180)), 10, 1e-9);
  for (double degrees = 0; degrees < 180; degrees += 20)
    EXPECT_LT(prior.CostMm(turned(degrees)), prior.CostMm(turned(degrees + 20)));
  EXPECT_FALSE(prior.FacesBackwards(turned(80)));
  EXPECT_TRUE(prior.FacesBackwards(turned(100)));
}

TEST(PosePrior, TwistsOfWhoFacesTheOppositeWayCost) {
  const BodyModel body(LoadBodyTable("full"), AverageSizes(1750));
  const ArmStance reaching{.raise = -60, .forward = 50, .elbow = 40};
  PoseState pose;
  pose.X_WT.p = Vector3(0, 0, body.sizes().thigh + body.sizes().calf + body.sizes().torso / 2);
  pose.theta =
      AnglesOf({.arm_l = reaching, .arm_r = reaching, .leg_l = {}, .leg_r = {}}, body.table());
  const Evidence evidence = RoundStudio().Show(body, pose);
  const PosePrior prior(std::nullopt);
  const auto cost_mm = [&](double yaw) {
    PoseState start = pose;
    start.X_WT.R = ExpRotation(Vector3(0, 0, yaw));
    Tracker tracker(body, start);
    tracker.Update(evidence, 0);
    return prior.CostMm(body, tracker.filter().pose());
  };
  EXPECT_LT(cost_mm(0) + 2, cost_mm(EIGEN_PI));
}

TEST(PosePrior, GiantsCostMoreThanChildren) {
  const BodyTable table = LoadBodyTable("full");
  const auto cost_mm = [&](double stature_mm) {
    PoseState pose;
    pose.theta = AnglesOf({}, table);
    return PosePrior(std::nullopt).CostMm(BodyModel(table, AverageSizes(stature_mm)), pose);
  };
  EXPECT_EQ(cost_mm(1100), cost_mm(1750));
  EXPECT_LT(cost_mm(1900), cost_mm(1750) + 1);
  EXPECT_GT(cost_mm(2050), cost_mm(1750) + 4);
}

TEST(PosePrior, LeavesWhoLiesOrHasNoFeetAlone) {
  PoseState lying;
  lying.X_WT.R = ExpRotation(Vector3(0, -90 * kDegree, 0));
  const double without_feet = PosePrior(std::nullopt).CostMm(lying);
  for (const Vector3& toes_W : {Vector3(40, 0, 0), Vector3(-40, 0, 0)})
    EXPECT_NEAR(PosePrior(toes_W).CostMm(lying), without_feet, 1e-9);
  EXPECT_EQ(PosePrior(std::nullopt).CostMm({}), 0);
  PoseState upside_down;
  upside_down.X_WT.R = ExpRotation(Vector3(0, 180 * kDegree, 0));
  EXPECT_GT(PosePrior(std::nullopt).CostMm(upside_down), without_feet);
}

}  // namespace
}  // namespace mocap
