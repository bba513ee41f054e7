#include "core/objective/objective.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/fitted_body.h"
#include "tests/support/slopes.h"
#include "tests/support/voxelized_body.h"

namespace mocap {
namespace {

class ObjectiveTest : public FittedBody {
 protected:
  PoseStep GradientAt(const PoseState& pose) {
    UpdateEquations equations;
    equations.Reset(body_.dof());
    objective_.Linearize(body_, pose, {}, equations);
    return equations.gradient();
  }
};

TEST_F(ObjectiveTest, DrawsTheBodyToTheTruth) {
  const PoseState truth = Standing({.arm_l = kArmOut, .leg_r = kStep});
  See(truth);
  const PoseState start = Off(truth, 0.5);
  EXPECT_GT(Error(start, truth), 40);
  EXPECT_LT(Error(FitFrom(start), truth), 6);
  EXPECT_LT(At(truth).Sum(), 0.5 * At(start).Sum());
}

// From as far as this, the foot of the leg that steps may end up turned the wrong way, as it does
// in two of these five directions. All else is drawn to the truth.
TEST_F(ObjectiveTest, DrawsTheBodyNearTheTruthFromFarOff) {
  double mean_mm = 0;
  for (const double yaw : {0.0, 1.0, 2.0, 3.0, 4.0}) {
    PoseState truth = Standing({.arm_l = kArmOut, .leg_r = kStep});
    truth.X_WT.R = ExpRotation(Vector3(0, 0, yaw));
    See(truth);
    const PoseState start = Off(truth);
    EXPECT_GT(Error(start, truth), 80);
    Eigen::VectorXd errors_mm = Errors(FitFrom(start), truth);
    mean_mm += errors_mm.mean() / 5;
    EXPECT_LT(errors_mm.mean(), 20) << yaw;
    errors_mm[static_cast<int>(Point::kCalfR)] = errors_mm[static_cast<int>(Point::kFootR)] = 0;
    EXPECT_LT(errors_mm.maxCoeff(), 20) << yaw;
  }
  EXPECT_LT(mean_mm, 15);
}

// What is linearised leaves habits out. Rays along parts that taper, and the taper of parts that a
// limb is in, are approximate.
TEST_F(ObjectiveTest, DescendsWhatItCosts) {
  const PoseState truth = Standing({.arm_l = kArmOut, .leg_r = kStep});
  See(truth);
  const PoseState pose = Off(truth);
  const auto nats = [&](const PoseState& at) {
    Fitness fitness = At(at);
    return fitness.Sum() - fitness[Term::kHabits];
  };
  ExpectOpposite(GradientAt(pose), SlopeOf(nats, pose), 0.03);
}

TEST_F(ObjectiveTest, AFitNeverCostsMoreThanItsStart) {
  const PoseState truth = Standing({.arm_l = kArmOut, .leg_r = kStep});
  See(truth);
  for (const Stance& stance : {Stance{}, Stance{.arm_l = kArmOut}, Stance{.leg_r = kStep}})
    EXPECT_LT(At(FitFrom(Standing(stance))).Sum(), At(Standing(stance)).Sum());
}

TEST_F(ObjectiveTest, EachTermCostsMoreWhereOnlyItIsViolated) {
  const PoseState truth = Standing({});
  See(truth);
  Fitness right = At(truth);
  const auto more = [&](const PoseState& pose, Term term) { return At(pose)[term] - right[term]; };
  PoseState aside = truth;
  aside.X_WT.p.x() += 60;
  EXPECT_GT(more(aside, Term::kRays), 1);
  EXPECT_GT(more(aside, Term::kSurface), 1);
  EXPECT_GT(more(aside, Term::kBorders), 1);
  EXPECT_GT(more(Standing({.arm_l = {.raise = 0}}), Term::kFlesh), 1);
  EXPECT_GT(more(Standing({.leg_l = {.spread = -12}, .leg_r = {.spread = -12}}), Term::kOverlap),
            1);
  EXPECT_GT(more(Standing({.leg_l = {.knee = -20}}), Term::kJoints), 1);
  evidence_.toes_W = -truth.X_WT.R.col(0);
  objective_.SetEvidence(evidence_);
  EXPECT_GT(more(truth, Term::kHabits), 1);
}

TEST_F(ObjectiveTest, SaysHowMuchNoPartExplains) {
  const PoseState truth = Standing({.arm_l = kArmOut});
  See(truth);
  EXPECT_LT(At(truth).unexplained_share, 0.005);
  EXPECT_GT(At(Standing({})).unexplained_share, 0.02);
  EXPECT_TRUE(At(truth).IsCredible());
  EXPECT_FALSE(At(truth).IsLost());
  PoseState elsewhere = truth;
  elsewhere.X_WT.p.x() += 1500;
  EXPECT_TRUE(At(elsewhere).IsLost());
  EXPECT_FALSE(At(elsewhere).IsCredible());
}

TEST_F(ObjectiveTest, WithoutOutlinesTheSurfaceIsEnough) {
  const PoseState truth = Standing({.arm_l = kArmOut, .leg_r = kStep});
  Evidence voxels;
  const VoxelGrid flesh = Voxelize(body_, truth, 25);
  voxels.Gather({flesh, {}});
  See(std::move(voxels));
  EXPECT_EQ(At(truth)[Term::kRays], 0);
  EXPECT_EQ(At(truth)[Term::kBorders], 0);
  EXPECT_TRUE(At(truth).IsCredible());
  EXPECT_GT(At(Off(truth)).misfit, At(truth).misfit);
  EXPECT_LT(Error(FitFrom(Off(truth)), truth), 0.6 * Error(Off(truth), truth));
}

// A search knows that its poses are off: it takes a pose that is nearly right for hardly worse.
TEST_F(ObjectiveTest, OfPosesThatMayBeOffIsWider) {
  const PoseState truth = Standing({.arm_l = kArmOut});
  See(truth);
  Objective wide({.pose_std_mm = 60});
  wide.SetEvidence(evidence_);
  const PoseState off = Off(truth, 0.5);
  EXPECT_LT(wide.At(body_, off, {}).Sum() - wide.At(body_, truth, {}).Sum(),
            0.5 * (At(off).Sum() - At(truth).Sum()));
}

// What a body may have and has not got is compared with the body: it must pull as well.
TEST_F(ObjectiveTest, OfWhoMayHaveThingsDescendsWhatItCosts) {
  const PoseState truth = Standing({.arm_l = kArmOut});
  See(truth);
  const PoseState pose = Off(truth);
  ASSERT_TRUE(objective_.At(body_, pose, kAnyThings).things.none());
  UpdateEquations equations;
  equations.Reset(body_.dof());
  objective_.Linearize(body_, pose, kAnyThings, equations);
  const auto nats = [&](const PoseState& at) {
    Fitness fitness = objective_.At(body_, at, kAnyThings);
    return fitness.Sum() - fitness[Term::kHabits];
  };
  ExpectOpposite(equations.gradient(), SlopeOf(nats, pose), 0.03);
}

TEST_F(ObjectiveTest, ABodyThatIsElsewhereIsLostThoughNoOutlineIsSeen) {
  const PoseState truth = Standing({});
  Evidence voxels;
  const VoxelGrid flesh = Voxelize(body_, truth, 25);
  voxels.Gather({flesh, {}});
  See(std::move(voxels));
  PoseState elsewhere = truth;
  elsewhere.X_WT.p.x() += 1500;
  EXPECT_TRUE(At(elsewhere).IsLost());
  EXPECT_FALSE(At(elsewhere).IsCredible());
}

TEST_F(ObjectiveTest, GivesTheSameBitsForTheSameEvidence) {
  const PoseState truth = Standing({.arm_l = kArmOut});
  See(truth);
  const PoseState pose = Off(truth, 0.5);
  Objective again;
  again.SetEvidence(evidence_);
  EXPECT_NE(again.At(body_, truth, {}).nats, At(pose).nats);
  EXPECT_EQ(again.At(body_, pose, {}).nats, At(pose).nats);
}

TEST_F(ObjectiveTest, CountsItsEvaluationsByTheirExtent) {
  See(Standing({}));
  const double before = objective_.evaluations();
  At(Standing({}));
  // A contact more or less is spread evenly over what there is.
  EXPECT_NEAR(objective_.evaluations() - before, 1, 0.002);
  GradientAt(Standing({}));
  EXPECT_NEAR(objective_.evaluations() - before, 2, 0.004);
  Objective coarse({.voxels = 125, .rays = 300});
  coarse.SetEvidence(evidence_);
  coarse.At(body_, Standing({}), {});
  EXPECT_GT(coarse.evaluations(), 0.5) << "to pose the body costs the same";
  EXPECT_LT(coarse.evaluations(), 0.7);
}

TEST_F(ObjectiveTest, ResidualsFollowAStepAsTheirJacobiansSay) {
  const PoseState pose =
      Standing({.arm_l = {.raise = -30, .forward = 20, .elbow = 40}, .leg_r = kStep});
  See(pose);
  const std::vector<SurfaceResidual> residuals = objective_.ResidualsAt(body_, pose);
  ASSERT_GT(residuals.size(), 500u);
  constexpr double kStep_rad = 1e-5;
  for (int column = 0; column < pose.dof(); ++column) {
    PoseState moved = pose;
    PoseStep step = PoseStep::Zero(pose.dof());
    step[column] = kStep_rad;
    moved.Add(step);
    const std::vector<SurfaceResidual> after = objective_.ResidualsAt(body_, moved);
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

TEST_F(ObjectiveTest, FingertipsBeyondTheBorderAreDrawnBack) {
  const PoseState truth = Standing({.arm_l = kArmOut});
  See(truth);
  BodySizes sizes = body_.sizes();
  sizes.lower_arm += 70;
  const BodyModel longer(body_.table(), sizes);
  const BodyPoints points_W = longer.PointsAt(longer.PostureAt(truth));
  const Vector3 arm_W = (points_W.col(static_cast<int>(Point::kFingertipsL)) -
                         points_W.col(static_cast<int>(Point::kElbowL)))
                            .normalized();
  int cameras = 0;
  for (const SurfaceResidual& residual : objective_.ResidualsAt(longer, truth)) {
    const Capsule& capsule = longer.shape()[residual.capsule];
    if (capsule.part != BodyPart::kLowerArmL || residual.share < 1) continue;
    cameras += residual.outside_mm < -40 && residual.normal_W.dot(arm_W) > 0.5;
  }
  // Rays are sparse: most cameras have none at the fingertips.
  EXPECT_GE(cameras, 1);
}

// Of rays alone none minds: the collar bone's flesh explains the shoulder's border.
TEST_F(ObjectiveTest, AnUpperArmBesideTheBorderIsDrawnBack) {
  const PoseState truth = Standing({});
  See(truth);
  BodySizes sizes = body_.sizes();
  sizes.shoulder_width += 120;
  const BodyModel broader(body_.table(), sizes);
  const Vector3 left_W = truth.X_WT.R.col(1);
  int drawn_in = 0;
  for (const SurfaceResidual& residual : objective_.ResidualsAt(broader, truth)) {
    const Capsule& capsule = broader.shape()[residual.capsule];
    if (capsule.part != BodyPart::kUpperArmL || residual.share > 0.5) continue;
    drawn_in += residual.outside_mm < -30 && residual.normal_W.dot(left_W) > 0.5;
  }
  EXPECT_GE(drawn_in, 2);
}

TEST_F(ObjectiveTest, StrayBlobsOfSilhouettesDoNotMakeARightPoseIncredible) {
  const PoseState truth = Standing({.arm_l = kArmOut});
  See(truth);
  const Fitness clean = At(truth);
  Evidence evidence = evidence_;
  const std::size_t rays = evidence.edges.size();
  for (std::size_t i = 0; i < rays; ++i) {
    BoundingEdge stray = evidence.edges[i];
    const Vector3 away_W = 500 * stray.outward_W;
    stray.from_W += away_W, stray.to_W += away_W, stray.misses_hull = true;
    evidence.edges.push_back(stray);
  }
  EXPECT_NEAR(evidence.MissingShare(), 0.5, 0.05);
  See(std::move(evidence));
  const Fitness disturbed = At(truth);
  EXPECT_GT(disturbed.Sum(), clean.Sum() + 15);
  EXPECT_NEAR(disturbed.misfit, clean.misfit, 0.1 * clean.misfit);
  EXPECT_TRUE(disturbed.IsCredible());
}

}  // namespace
}  // namespace mocap
