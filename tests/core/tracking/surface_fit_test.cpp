#include "core/tracking/surface_fit.h"

#include <gtest/gtest.h>

#include "core/acquisition/size_refiner.h"
#include "core/tracking/tracker.h"
#include "tests/support/fitted_body.h"

namespace mocap {
namespace {

using Fit = FittedBody;

TEST_F(Fit, OutlinesDrawTheBodyToTheTruth) {
  const PoseState truth = Standing(body_, {.arm_l = kArmOut, .leg_r = kStep});
  const Evidence evidence = studio_.Show(body_, truth);
  fit_.SetEvidence(evidence);
  PoseState start = truth;
  PoseStep step = PoseStep::Constant(truth.dof(), 0.05);
  step.head<3>() = Vector3(40, -30, 25);
  start.Add(step);
  EXPECT_GT(Error(start, truth), 40);
  EXPECT_LT(Error(FitFrom(start, body_, fit_), truth), 15);
  EXPECT_LT(fit_.QualityAt(body_, truth).Cost(), 0.5 * fit_.QualityAt(body_, start).Cost());
}

TEST_F(Fit, ResidualsFollowAStepAsTheirJacobiansSay) {
  const PoseState pose =
      Standing(body_, {.arm_l = {.raise = -30, .forward = 20, .elbow = 40}, .leg_r = kStep});
  const Evidence evidence = studio_.Show(body_, pose);
  fit_.SetEvidence(evidence);
  const std::vector<SurfaceResidual> residuals = fit_.ResidualsAt(body_, pose);
  ASSERT_GT(residuals.size(), 500u);
  constexpr double kStep_rad = 1e-5;
  for (int column = 0; column < pose.dof(); ++column) {
    PoseState moved = pose;
    PoseStep step = PoseStep::Zero(pose.dof());
    step[column] = kStep_rad;
    moved.Add(step);
    const std::vector<SurfaceResidual> after = fit_.ResidualsAt(body_, moved);
    ASSERT_EQ(after.size(), residuals.size());
    int differing = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
      const double slope = (residuals[i].outside_mm - after[i].outside_mm) / kStep_rad;
      // Along an edge the nearest place slides where a capsule tapers, which the Jacobian leaves
      // out.
      const double share = residuals[i].kind == ResidualKind::kSurface ? 0.01 : 0.12;
      const double tolerance = share * std::abs(residuals[i].J_outside_by_step[column]) + 2;
      differing += std::abs(slope - residuals[i].J_outside_by_step[column]) > tolerance;
    }
    EXPECT_LT(differing, 0.03 * static_cast<double>(after.size())) << "column " << column;
  }
}

TEST_F(Fit, FingertipsBeyondTheBorderAreDrawnBack) {
  const PoseState truth = Standing(body_, {.arm_l = kArmOut});
  const Evidence evidence = studio_.Show(body_, truth);
  BodySizes sizes = body_.sizes();
  sizes.lower_arm += 70;
  const BodyModel longer(body_.table(), sizes);
  fit_.SetEvidence(evidence);
  const BodyPoints points_W = longer.PointsAt(longer.PostureAt(truth));
  const Vector3 arm_W = (points_W.col(static_cast<int>(Point::kFingertipsL)) -
                         points_W.col(static_cast<int>(Point::kElbowL)))
                            .normalized();
  int cameras = 0;
  for (const SurfaceResidual& residual : fit_.ResidualsAt(longer, truth)) {
    const Capsule& capsule = longer.shape()[residual.capsule];
    if (capsule.part != BodyPart::kLowerArmL || residual.share < 1) continue;
    cameras += residual.outside_mm < -40 && residual.normal_W.dot(arm_W) > 0.5;
  }
  // Rays are sparse: most cameras have none at the fingertips.
  EXPECT_GE(cameras, 1);
}

// Of rays alone none minds: the collar bone's flesh explains the shoulder's border.
TEST_F(Fit, AnUpperArmBesideTheBorderIsDrawnBack) {
  const PoseState truth = Standing(body_, {});
  const Evidence evidence = studio_.Show(body_, truth);
  BodySizes sizes = body_.sizes();
  sizes.shoulder_width += 120;
  const BodyModel broader(body_.table(), sizes);
  fit_.SetEvidence(evidence);
  const Vector3 left_W = truth.X_WT.R.col(1);
  int drawn_in = 0;
  for (const SurfaceResidual& residual : fit_.ResidualsAt(broader, truth)) {
    const Capsule& capsule = broader.shape()[residual.capsule];
    if (capsule.part != BodyPart::kUpperArmL || residual.share > 0.5) continue;
    drawn_in += residual.outside_mm < -30 && residual.normal_W.dot(left_W) > 0.5;
  }
  EXPECT_GE(drawn_in, 2);
}

TEST_F(Fit, StrayBlobsOfSilhouettesDoNotMakeARightPoseIncredible) {
  const PoseState truth = Standing(body_, {.arm_l = kArmOut});
  Evidence evidence = studio_.Show(body_, truth);
  fit_.SetEvidence(evidence);
  const SurfaceFitQuality clean = fit_.QualityAt(body_, truth);
  EXPECT_NEAR(clean.CostWithoutStray(), clean.Cost(), 2);
  const std::size_t rays = evidence.edges.size();
  for (std::size_t i = 0; i < rays; ++i) {
    BoundingEdge stray = evidence.edges[i];
    const Vector3 away_W = 500 * stray.outward_W;
    stray.from_W += away_W, stray.to_W += away_W, stray.misses_hull = true;
    evidence.edges.push_back(stray);
  }
  EXPECT_NEAR(evidence.MissingShare(), 0.5, 0.05);
  fit_.SetEvidence(evidence);
  const SurfaceFitQuality disturbed = fit_.QualityAt(body_, truth);
  EXPECT_GT(disturbed.Cost(), clean.Cost() + 15);
  EXPECT_LT(disturbed.CostWithoutStray() - clean.CostWithoutStray(),
            0.6 * (disturbed.Cost() - clean.Cost()));
}

TEST_F(Fit, BonesOutsideOfAHullWithHolesWeighLess) {
  const PoseState truth = Standing(body_, {});
  Evidence evidence = studio_.Show(body_, truth);
  const PoseState arm_out = Standing(body_, {.arm_l = {.raise = 80}});
  fit_.SetEvidence(evidence);
  const SurfaceFitQuality whole = fit_.QualityAt(body_, arm_out);
  ASSERT_GT(whole.hollow_mm, 1);
  for (std::size_t i = 0; i < evidence.edges.size(); i += 2) evidence.edges[i].misses_hull = true;
  fit_.SetEvidence(evidence);
  const SurfaceFitQuality with_holes = fit_.QualityAt(body_, arm_out);
  EXPECT_NEAR(whole.Cost() - with_holes.Cost(),
              (with_holes.missing_share - whole.missing_share) * whole.hollow_mm, 0.01);
}

TEST_F(Fit, ALeapBeyondTheReachIsFollowed) {
  PoseState truth = Standing(body_, {.arm_l = kArmOut});
  Tracker tracker(body_, truth);
  tracker.Update(studio_.Show(body_, truth), 0);
  truth.X_WT.p += Vector3(60, 0, 300);
  tracker.Update(studio_.Show(body_, truth), 0.1);
  EXPECT_LT(Error(tracker.filter().pose(), truth), 20);
}

TEST_F(Fit, SizesApproachTheTruthOverTheFrames) {
  BodySizes person = body_.sizes();
  person.thigh_width *= 0.88;
  person.torso_depth *= 0.92;
  const BodyModel truth(body_.table(), person);
  SizeRefiner refiner(body_);
  BodyModel refined = body_;
  for (int frame = 0; frame < 9; ++frame) {
    const double swing = 25 * std::sin(0.8 * frame);
    const PoseState pose = Standing(
        truth, {.arm_l = {.forward = swing}, .leg_l = {.hip = -swing}, .leg_r = {.hip = swing}});
    const Evidence evidence = studio_.Show(truth, pose);
    fit_.SetEvidence(evidence);
    refiner.Add(refined, fit_, FitFrom(pose, refined, fit_));
    refined.Resize(refiner.Sizes());
  }
  EXPECT_EQ(refiner.frames(), 9);
  EXPECT_NEAR(refined.sizes().thigh_width, person.thigh_width,
              0.6 * (body_.sizes().thigh_width - person.thigh_width));
  EXPECT_NEAR(refined.sizes().torso_depth, person.torso_depth,
              0.8 * (body_.sizes().torso_depth - person.torso_depth));
}

}  // namespace
}  // namespace mocap
