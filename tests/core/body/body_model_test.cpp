#include "core/body/body_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "config/load_config.h"

namespace mocap {
namespace {

PoseState RandomPose(const BodyTable& table, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  PoseState pose;
  pose.X_WT.R = ExpRotation(3 * Vector3(unit(random), unit(random), unit(random)));
  pose.X_WT.p = 1000 * Vector3(unit(random), unit(random), unit(random));
  pose.theta.resize(static_cast<Eigen::Index>(table.joints.size()));
  for (Eigen::Index i = 0; i < pose.theta.size(); ++i) {
    const JointAxis& joint = table.joints[i];
    pose.theta[i] = joint.min_rad + (0.5 + 0.5 * unit(random)) * (joint.max_rad - joint.min_rad);
  }
  return pose;
}

PoseStep UnitStep(int dof, int index, double size) {
  PoseStep step = PoseStep::Zero(dof);
  step[index] = size;
  return step;
}

class EveryBody : public ::testing::TestWithParam<std::string> {
 protected:
  BodyModel body_{LoadBodyTable(GetParam()), AverageSizes(1750)};
  std::mt19937 random_{7};
};

TEST_P(EveryBody, MovesSomeAxesAsItMovesAll) {
  const PoseState pose = RandomPose(body_.table(), random_);
  PoseState bent = pose;
  std::vector<int> rows;
  for (int row = body_.joint_count() / 2; row < body_.joint_count(); ++row) {
    bent.theta[row] += 0.1;
    rows.push_back(row);
  }
  Posture moved = body_.PostureAt(pose);
  body_.MoveAxes(bent, rows, moved);
  const Posture anew = body_.PostureAt(bent);
  for (int row = 0; row < body_.joint_count(); ++row) {
    EXPECT_EQ(moved.axis_W[row], anew.axis_W[row]);
    EXPECT_EQ(moved.point_W[row], anew.point_W[row]);
    EXPECT_EQ(moved.X_W[row].R, anew.X_W[row].R);
  }
}

TEST_P(EveryBody, PointJacobiansAgreeWithCentralDifferences) {
  constexpr double kStep = 1e-5;
  Eigen::Matrix<double, 3, Eigen::Dynamic> J(3, body_.dof());
  for (int trial = 0; trial < 20; ++trial) {
    const PoseState pose = RandomPose(body_.table(), random_);
    const Posture posture = body_.PostureAt(pose);
    const BodyPoints points_W = body_.PointsAt(posture);
    for (int i = 0; i < kPointCount; ++i) {
      body_.PointJacobian(posture, body_.CarrierOf(static_cast<Point>(i)), points_W.col(i), J);
      for (int column = 0; column < body_.dof(); ++column) {
        PoseState ahead = pose;
        PoseState behind = pose;
        ahead.Add(UnitStep(body_.dof(), column, kStep));
        behind.Add(UnitStep(body_.dof(), column, -kStep));
        const Vector3 difference = (body_.PointsAt(body_.PostureAt(ahead)).col(i) -
                                    body_.PointsAt(body_.PostureAt(behind)).col(i)) /
                                   (2 * kStep);
        ASSERT_NEAR((J.col(column) - difference).norm(), 0, 1e-4)
            << kPointNames[i] << " by column " << column;
      }
    }
  }
}

TEST_P(EveryBody, DirectionalJacobiansAreRowsOfThePointJacobians) {
  Eigen::Matrix<double, 3, Eigen::Dynamic> J(3, body_.dof());
  PoseStep row;
  for (int trial = 0; trial < 5; ++trial) {
    const PoseState pose = RandomPose(body_.table(), random_);
    const Posture posture = body_.PostureAt(pose);
    const BodyPoints points_W = body_.PointsAt(posture);
    const Vector3 direction_W = Vector3(0.6, -0.5, 0.3 * trial).normalized();
    for (int i = 0; i < kPointCount; ++i) {
      const int carrier = body_.CarrierOf(static_cast<Point>(i));
      body_.PointJacobian(posture, carrier, points_W.col(i), J);
      body_.DirectionalJacobian(posture, carrier, points_W.col(i), direction_W, row);
      EXPECT_NEAR((J.transpose() * direction_W - row).norm(), 0, 1e-9) << kPointNames[i];
    }
  }
}

TEST_P(EveryBody, KeepsTheLengthsOfItsPartsInEveryPose) {
  const auto distance = [&](const BodyPoints& points, Point a, Point b) {
    return (points.col(static_cast<int>(a)) - points.col(static_cast<int>(b))).norm();
  };
  for (int trial = 0; trial < 20; ++trial) {
    const PoseState pose = RandomPose(body_.table(), random_);
    const BodyPoints points = body_.PointsAt(body_.PostureAt(pose));
    EXPECT_NEAR(distance(points, Point::kShoulderL, Point::kElbowL), body_.sizes().upper_arm, 1e-6);
    // Hands bend, but the forearm's middle does not.
    EXPECT_NEAR(distance(points, Point::kElbowR, Point::kLowerArmR), body_.sizes().lower_arm / 2,
                1e-6);
    EXPECT_NEAR(distance(points, Point::kHipR, Point::kKneeR), body_.sizes().thigh, 1e-6);
    EXPECT_NEAR(distance(points, Point::kKneeL, Point::kFootL), body_.sizes().calf, 1e-6);
  }
}

TEST_P(EveryBody, TakesAStepBackThatItTookForward) {
  for (int trial = 0; trial < 20; ++trial) {
    const PoseState from = RandomPose(body_.table(), random_);
    const PoseState to = RandomPose(body_.table(), random_);
    PoseState there = from;
    there.Add(to.Minus(from));
    EXPECT_NEAR(there.Minus(to).norm(), 0, 1e-9);
  }
}

TEST_P(EveryBody, ReadsThePapersNumbersOffThePose) {
  const PoseState pose = RandomPose(body_.table(), random_);
  const PaperState paper = body_.PaperStateOf(pose);
  EXPECT_NEAR((ExpRotation(paper.torso_axis * paper.torso_angle_rad) - pose.X_WT.R).norm(), 0,
              1e-9);
  EXPECT_EQ(paper.torso_mm, pose.X_WT.p);
  for (int i = 0; i < body_.joint_count(); ++i) {
    const int angle = body_.table().joints[i].paper_angle;
    if (angle > 0) {
      EXPECT_EQ(paper.theta_rad[angle - 1], pose.theta[i]);
    }
  }
}

TEST_P(EveryBody, BendsKneesBackwardAndElbowsForward) {
  PoseState pose;
  pose.theta = JointAngles::Zero(body_.joint_count());
  for (int i = 0; i < body_.joint_count(); ++i) {
    const JointAxis& joint = body_.table().joints[i];
    // The far end of the range is the flexed one.
    if (joint.paper_angle == 9 || joint.paper_angle == 10 || joint.paper_angle >= 15) {
      pose.theta[i] =
          0.5 * (std::abs(joint.max_rad) > std::abs(joint.min_rad) ? joint.max_rad : joint.min_rad);
    }
  }
  const BodyPoints points = body_.PointsAt(body_.PostureAt(pose));
  const auto x = [&](Point point) { return points(0, static_cast<int>(point)); };
  EXPECT_LT(x(Point::kFootL), x(Point::kKneeL) - 200);
  EXPECT_LT(x(Point::kFootR), x(Point::kKneeR) - 200);
  EXPECT_GT(x(Point::kFingertipsL), x(Point::kElbowL) + 200);
  EXPECT_GT(x(Point::kFingertipsR), x(Point::kElbowR) + 200);
}

INSTANTIATE_TEST_SUITE_P(Tables, EveryBody, ::testing::Values("mikic2003", "full"),
                         [](const auto& test) { return test.param; });

// Eq. (13) written out for the right foot: R0 (R12 (R14 (R16 p + t16) + t14) + t12) + t0.
TEST(BodyModel, HasThePointsOfSegmentsThatTurnByThemselves) {
  BodyTable table = LoadBodyTable("full");
  table.carrier[static_cast<int>(Segment::kShoulderR)] = -1;
  const BodyModel stiff(table, AverageSizes(1750));
  PoseState pose;
  pose.theta = JointAngles::Zero(stiff.joint_count());
  const FurtherPoints points_W = stiff.FurtherPointsAt(stiff.PostureAt(pose));
  for (int i = 0; i < kFurtherPointCount; ++i)
    EXPECT_EQ(points_W.col(i).allFinite(), kFurtherPointNames[i] != "clavicle_r")
        << kFurtherPointNames[i];
}

TEST(BodyModel, FleshOfToesEndsAtTheTipOfTheFoot) {
  const BodyModel body(LoadBodyTable("full"), AverageSizes(1750));
  for (const Point toe : {Point::kToeL, Point::kToeR}) {
    double front_mm = -1e9;
    for (const Capsule& capsule : body.shape())
      if (capsule.carrier == body.CarrierOf(toe))
        front_mm = std::max(front_mm, capsule.a_T.x() + capsule.radius_a_mm);
    EXPECT_NEAR(front_mm, body.reference_points_T().col(static_cast<int>(toe)).x(), 1e-9);
  }
}

TEST(BodyModel, PutsTheRightFootWhereThePaperPutsIt) {
  const BodyModel body(LoadBodyTable("mikic2003"), AverageSizes(1800));
  std::mt19937 random(3);
  const PoseState pose = RandomPose(body.table(), random);
  const auto at = [&](Point point) {
    return Vector3(body.reference_points_T().col(static_cast<int>(point)));
  };
  const PaperState x = body.PaperStateOf(pose);
  const Vector3 hip = at(Point::kHipR);
  const Vector3 knee = at(Point::kKneeR);
  const RigidTransform M12 = RotationAbout(Vector3::UnitX(), hip, x.theta_rad[11]);
  const RigidTransform M14 = RotationAbout(Vector3::UnitY(), hip, x.theta_rad[13]);
  const RigidTransform M16 = RotationAbout(Vector3::UnitY(), knee, x.theta_rad[15]);
  const Vector3 expected = pose.X_WT * (M12 * (M14 * (M16 * at(Point::kFootR))));
  const BodyPoints points = body.PointsAt(body.PostureAt(pose));
  EXPECT_NEAR((points.col(static_cast<int>(Point::kFootR)) - expected).norm(), 0, 1e-9);
}

}  // namespace
}  // namespace mocap
